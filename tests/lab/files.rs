//! What is written of points, and read back.

use super::point;
use tautline::lab::report::{csv, json, svg::svg, table::table, text::diagram};
use tautline::lab::{ErrorKind, Family, Point, Setting};

/// Points with every kind of value.
fn some() -> Vec<Point> {
    let base = Setting::BASELINE;
    vec![
        Point {
            iterations: base.iterations,
            violation_max: 1.0 / 3.0,
            ..point("semi-implicit-euler+pgs", 4, 123.456, Some(0.1 + 0.2))
        },
        Point {
            substeps: None,
            tolerance: Some(1e-9),
            error_kind: ErrorKind::Converged(3e-12),
            ..point("accuracy", 1, 1e-3, Some(5e-324))
        },
        Point { error_kind: ErrorKind::None, ..point("rattle", 1, 7.0, None) },
        Point { scene: "a, \"b\".ron".to_owned(), ..point("explicit-euler+projection", 256, 1e5, None) },
        Point { hz: 240.0, error_kind: ErrorKind::ClosedForm, ..point("nystrom-6", 2, 50.0, Some(1e-15)) },
    ]
}

fn lines(points: &[Point]) -> String {
    let mut bytes = Vec::new();
    points.iter().for_each(|point| json::write(&mut bytes, point).unwrap());
    String::from_utf8(bytes).unwrap()
}

#[test]
fn a_line_of_json_has_the_fields_and_comes_back_with_the_same_bits() {
    let text = lines(&some());
    assert_eq!(
        text.lines().next().unwrap(),
        "{\"scene\":\"hand\",\"method\":\"semi-implicit-euler+pgs\",\"hz\":60.0,\"substeps\":4,\"iterations\":10,\
         \"tolerance\":null,\"cpu_us_per_second\":123.456,\"error\":0.30000000000000004,\"error_kind\":\"stored\",\
         \"violation_max\":0.3333333333333333,\"energy_drift\":0.0}"
    );
    assert!(text.contains("\"error_kind\":\"converged to 3e-12\"") && text.contains("\"error_kind\":\"closed form\""));
    assert_eq!(json::read(&text), Ok((some(), text.len())));
}

#[test]
fn a_line_cut_short_is_left_out_and_a_wrong_one_is_named() {
    let text = lines(&some()[..2]);
    let whole = text.len();
    let cut = text.clone() + "{\"scene\":\"hand\",\"meth";
    assert_eq!(json::read(&cut), Ok((some()[..2].to_vec(), whole)));
    assert_eq!(json::read(""), Ok((Vec::new(), 0)));
    for (wrong, phrase) in [
        ("nonsense\n", "line 3: expected"),
        (&*text.lines().next().unwrap().replace("+pgs", "+magic").to_string(), "line 3: there is no method"),
        (&*text.lines().next().unwrap().replace("\"hz\":60.0", "\"hz\":-1.0"), "line 3: hz is -1, but must be between"),
        (&*text.lines().next().unwrap().replace("stored", "guessed"), "line 3: there is no kind of error \"guessed\""),
        ("{\"scene\":\"hand\"}", "line 3: missing field"),
    ] {
        let error = json::read(&format!("{text}{}\n", wrong.trim_end())).unwrap_err().to_string();
        assert!(error.contains(phrase) && error.contains("remove the line"), "{error}");
    }
}

#[test]
fn csv_has_the_same_fields_and_empty_cells() {
    let mut bytes = Vec::new();
    some().iter().for_each(|point| csv::write(&mut bytes, point).unwrap());
    let text = String::from_utf8(bytes).unwrap();
    let rows: Vec<&str> = text.lines().collect();
    assert_eq!(
        rows[0],
        "hand,semi-implicit-euler+pgs,60.0,4,10,,123.456,0.30000000000000004,stored,0.3333333333333333,0.0"
    );
    assert_eq!(rows[1], "hand,accuracy,60.0,,,1e-9,0.001,5e-324,converged to 3e-12,0.0,0.0");
    assert_eq!(rows[3], "\"a, \"\"b\"\".ron\",explicit-euler+projection,60.0,256,,,100000.0,,diverged,0.0,0.0");
    assert_eq!(csv::HEADER.split(',').count(), rows[0].split(',').count());
    let json = lines(&some()[..1]);
    assert!(csv::HEADER.split(',').all(|name| json.contains(&format!("\"{name}\":"))), "the names of JSON");
}

#[test]
fn the_diagram_puts_marks_where_their_logarithms_are() {
    // Two decades of cost, four of error: the corners, and the middle of the costs at the third of four error decades.
    let points = [
        Point { iterations: Some(10), ..point("semi-implicit-euler+pgs", 4, 100.0, Some(1.0)) },
        point("rattle", 1, 10.0, Some(1e-1)),
        point("taylor", 1, 1000.0, Some(1e-4)),
        point("rattle", 2, 1000.0, Some(1e-2)),
    ];
    let text = diagram(&points);
    println!("{text}");
    let rows: Vec<&str> = text.lines().collect();
    let at = |row: usize| rows[row + 1].chars().skip(9).collect::<Vec<char>>();
    // 21 rows over four decades are five a decade; 70 columns over two.
    assert_eq!((at(0)[35], at(5)[0], at(10)[69], at(20)[69]), ('#', 'R', 'r', 'T'));
    assert!(rows[1].starts_with("    1e0 +") && rows[21].starts_with("   1e-4 +"));
    assert!(rows.iter().all(|row| row.chars().count() <= 80), "fits a terminal");
    assert!(text.contains("r RATTLE") && text.contains("# Semi-implicit Euler + PGS, 4 × 10"));
    assert_eq!(diagram(&[point("rattle", 1, 1.0, None)]), "");
    // One point, and an error of nothing, have a place too.
    assert!(diagram(&[point("rattle", 1, 1.0, Some(0.0))]).contains('R'));
}

#[test]
fn a_diagram_of_every_method_fits_a_terminal() {
    let all: Vec<Point> = Family::ALL
        .iter()
        .enumerate()
        .map(|(i, family)| point(&family.key(), 1, 10f64.powi(i as i32 - 6), Some(1e-3)))
        .collect();
    assert!(diagram(&all).lines().all(|row| row.chars().count() <= 80));
}

#[test]
fn the_table_lists_the_front_and_the_baseline() {
    let points = [
        Point { iterations: Some(10), ..point("semi-implicit-euler+pgs", 4, 100.0, Some(1.0)) },
        point("rattle", 1, 10.0, Some(1e-1)),
        point("rattle", 2, 11.0, Some(1.0)),
    ];
    let text = table(&points);
    let rows: Vec<&str> = text.lines().collect();
    assert_eq!(rows.len(), 3, "{text}");
    assert!(rows[1].starts_with("* RATTLE, 1 substep") && rows[2].starts_with("  Semi-implicit Euler + PGS, 4 × 10"));
    let diverged = table(&[point("rattle", 1, 1.0, None)]);
    assert!(diverged.lines().nth(1).unwrap().contains("diverged"), "{diverged}");
}

#[test]
fn the_picture_names_its_axes_and_every_point() {
    let points = some();
    let text = svg("A <title> & more", &points);
    assert!(text.starts_with("<svg xmlns=") && text.ends_with("</svg>\n"));
    assert!(text.contains("A &lt;title&gt; &amp; more"), "text is escaped");
    assert!(text.contains("CPU time per simulated second [µs/s]") && text.contains("RMS distance"));
    assert!(text.contains("prefers-color-scheme:dark"));
    // Marks have a title under the pointer: three points with an error, three families in the legend.
    assert_eq!(text.matches("<title>").count(), 1 + 3 + 3);
    assert_eq!(text.matches("class=\"front\"").count(), 2, "the front and its entry");
    assert_eq!(text.matches("class=\"ring\"").count(), 2, "the baseline and its entry");
    assert_eq!(text.matches('<').count(), text.matches('>').count());
    assert!(svg("Nothing", &[]).contains("No point has an error."));
}
