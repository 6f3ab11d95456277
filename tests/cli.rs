//! The program as a user runs it from a shell: what it prints, what it writes, and how it ends.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

fn tautline(arguments: &[&str]) -> Output {
    command(arguments).output().expect("the program runs")
}

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_tautline"));
    command.args(arguments);
    command
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

/// Runs a command that must succeed and returns what it printed.
fn prints(arguments: &[&str]) -> String {
    let output = tautline(arguments);
    assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
    text(&output.stdout)
}

/// Runs a command that must fail with `code`, in one message that contains `phrase`.
fn fails(arguments: &[&str], code: i32, phrase: &str) {
    let output = tautline(arguments);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {message}");
    assert!(message.contains(phrase), "{arguments:?}: {message:?} does not contain {phrase:?}");
    assert!(!message.contains("panicked"), "{arguments:?}: {message}");
}

fn folder() -> TempDir {
    tempfile::tempdir().expect("a folder")
}

fn path_in(folder: &TempDir, name: &str) -> String {
    folder.path().join(name).display().to_string()
}

/// The rows of a CSV file as numbers, without the header; NaN for an empty cell.
fn rows(csv: &str) -> Vec<Vec<f64>> {
    let number = |cell: &str| {
        if cell.is_empty() { "NaN" } else { cell }.parse().unwrap_or_else(|_| panic!("{cell:?} is a number"))
    };
    csv.lines().skip(1).map(|line| line.split(',').map(number).collect()).collect()
}

const TRAJECTORY: &str = "time,id,x,y,angle,vx,vy,omega";
const MEASURES: &str = "time,kinetic,potential,elastic,momentum_x,momentum_y,angular_momentum,violation_max,\
                        penetration_max,contacts,step_us,local_error,violation_rms,energy,energy_drift,\
                        error_rms,error_max,error_rms_percent,error_max_percent,order,growth";

#[test]
fn every_command_explains_itself() {
    for arguments in [
        &["--help"][..],
        &["truth", "--help"],
        &["run", "--help"],
        &["check", "--help"],
        &["shot", "--help"],
        &["open", "--help"],
    ] {
        assert!(prints(arguments).contains("Usage: tautline"), "{arguments:?}");
    }
    assert!(prints(&["--version"]).starts_with("tautline "));
    assert!(prints(&["run", "--help"]).contains("nearest"), "sampling between steps is explained");
}

#[test]
fn what_is_not_understood_ends_with_two_and_a_hint() {
    fails(&["rum", "bridge"], 2, "run");
    fails(&["run"], 2, "<SCENE>");
    fails(&["check"], 2, "<FILE>");
    fails(&["run", "rope", "--integrator", "rk4"], 2, "velocity-verlet");
    fails(&["run", "rope", "--solver", "magic"], 2, "projection");
    for wrong in ["NaN", "-1", "1e300", "inf", "soon"] {
        fails(&["run", "rope", "--seconds", wrong], 2, "from 0 to 1000000");
    }
    for wrong in ["0", "1/0", "-0.1", "NaN"] {
        fails(&["run", "rope", "--every", wrong], 2, "1/60");
    }
    fails(&["run", "rope", "--hz", "0"], 2, "steps per second");
    fails(&["run", "rope", "--iterations", "-4"], 2, "a whole number from 1 to 100000");
    for wrong in ["2.5", "0", "1001", "99999999999", "many"] {
        fails(&["run", "rope", "--substeps", wrong], 2, "a whole number from 1 to 1000");
    }
    fails(&["run", "rope", "--every", "1e-10"], 2, "from 1e-9 to 1000000");
    fails(&["run", "rope", "--baumgarte", "2"], 2, "from 0 to 1");
    fails(&["shot", "rope", "a.png", "--size", "big"], 2, "1280x800");
    fails(&["shot", "rope", "a.jpg"], 2, "such as picture.png");
    fails(&["shot", "rope", "a.png", "--theme", "pink"], 2, "dark");
}

#[test]
fn scenes_are_listed_by_name_and_title() {
    let list = prints(&["scenes"]);
    let sections = tautline::scene::sections();
    let [sandbox, hard, _] = sections.map(|(_, scenes)| scenes);
    assert_eq!(list.lines().count(), sections.iter().map(|(_, scenes)| 1 + scenes.len()).sum::<usize>());
    let lines: Vec<&str> = list.lines().collect();
    assert_eq!((lines[0], lines[sandbox.len() + 1]), ("Sandbox:", "Hard cases:"));
    assert!(lines[1].starts_with("  bridge ") && lines[1].ends_with("Rope bridge"));
    let first_exact = lines[sandbox.len() + hard.len() + 3];
    assert!(first_exact.starts_with("  truth/pendulum ") && first_exact.ends_with("Exact pendulum"));
}

#[test]
fn check_tells_good_scenes_from_wrong_ones() {
    assert!(prints(&["check", "pile", "scenes/rope.ron"]).contains("scenes/rope.ron: good"));
    let wrong = "tests/broken_scenes/negative_mass.ron";
    fails(&["check", wrong], 1, "tests/broken_scenes/negative_mass.ron:6:31: found mass -2.0");
    let both = tautline(&["check", wrong, "rope"]);
    assert!(text(&both.stdout).contains("rope: good"), "the others are checked all the same");
    assert_eq!(both.status.code(), Some(1));
    let folder = folder();
    let long = path_in(&folder, "long.ron");
    std::fs::write(&long, format!("(version: 1, title: {:?})", "a".repeat(10_000))).expect("a scene file");
    assert!(prints(&["check", &long]).len() < 1000, "a title that fills pages is not printed whole");
}

#[test]
fn a_scene_that_is_not_there_is_named_and_its_neighbour_suggested() {
    fails(&["run", "brige"], 1, "Did you mean `bridge`?");
    fails(&["open", "brige"], 1, "Did you mean `bridge`?");
    fails(&["shot", "brige", "a.png"], 1, "Did you mean `bridge`?");
    fails(&["run", "no/such/scene.ron"], 1, "no such file");
}

#[test]
fn a_run_writes_every_body_at_the_start_and_at_every_sample() {
    let folder = folder();
    let (csv, measures) = (path_in(&folder, "out.csv"), path_in(&folder, "measures.csv"));
    prints(&["run", "double_pendulum", "--seconds", "1", "--every", "1/20", "--csv", &csv, "--measures", &measures]);
    let (csv, measures) = (read(&csv), read(&measures));
    assert_eq!(csv.lines().next(), Some(TRAJECTORY));
    assert_eq!(measures.lines().next(), Some(MEASURES));
    let (csv, measures) = (rows(&csv), rows(&measures));
    assert_eq!((csv.len(), measures.len()), (2 * 21, 21));
    assert_eq!(csv[0][..4], [0.0, 1.0, 1.0, 0.0], "the first body at its place at time 0");
    for (k, row) in measures.iter().enumerate() {
        // The time of a step is a sum or product of 1/60 s: right to a few ulps.
        assert!((row[0] - k as f64 / 20.0).abs() < 1e-12, "{row:?}");
        assert_eq!([csv[2 * k][0], csv[2 * k + 1][0]], [row[0]; 2]);
    }
    let last = &csv[csv.len() - 1];
    assert!(last[3] < -0.5, "the lower bob has fallen: {last:?}");
}

/// The columns of a run's measures by name.
fn measured(arguments: &[&str]) -> impl Fn(&str) -> Vec<f64> + use<> {
    let rows = rows(&prints(&[&["run"], arguments, &["--measures", "-"]].concat()));
    move |name| {
        let column = MEASURES.split(',').position(|known| known == name).unwrap_or_else(|| panic!("no column {name}"));
        rows.iter().map(|row| row[column]).collect()
    }
}

#[test]
fn measures_tell_the_error_where_the_truth_is_known() {
    let truth = tautline::truth::stored("truth/pendulum").expect("a stored truth");
    // Half a second at 120 Hz: every other step is a sample of the truth.
    let columns = measured(&["truth/pendulum", "--seconds", "0.5", "--hz", "120"]);
    let (rms, max, percent) = (columns("error_rms"), columns("error_max"), columns("error_max_percent"));
    assert_eq!((rms.len(), rms[0]), (61, 0.0));
    for k in 1..61 {
        assert_eq!(rms[k].is_nan(), k % 2 == 1, "row {k}");
        // Two bodies, one of which is fixed; the length is 1 m.
        assert!(k % 2 == 1 || ((max[k] - rms[k] * 2f64.sqrt()).abs() < 1e-15 && percent[k] == 100.0 * max[k]));
    }
    let columns = measured(&["truth/pendulum", "--seconds", "11"]);
    let (time, error) = (columns("time"), columns("error_max"));
    assert_eq!(error.iter().filter(|error| error.is_finite()).count(), truth.times.len(), "10 s are known");
    assert!(time.iter().zip(&error).all(|(t, error)| error.is_finite() == (*t <= 10.0 + 1e-9)));
    // A scene with a formula, one without any truth.
    let columns = measured(&["hard/pendulum", "--seconds", "1"]);
    assert!(columns("error_max").iter().all(|error| *error < 1e-8), "{:?}", columns("error_max"));
    assert!(measured(&["rope", "--seconds", "0.1"])("error_rms").iter().all(|error| error.is_nan()));
}

#[test]
fn no_output_holds_what_is_no_number() {
    let folder = folder();
    let scene = |name: &str, text: &str| {
        std::fs::write(path_in(&folder, name), text).expect("a scene file");
        path_in(&folder, name)
    };
    let oscillators: String = ["0", "0.2", "20", "40", "1e6", "1e12"]
        .iter()
        .enumerate()
        .map(|(i, damping)| format!("Spring(a: (-1, {i}), b: \"{i}\", rest: 1, stiffness: 100, damping: {damping}), "))
        .collect();
    let balls: String = (0..6)
        .map(|i| format!("Particle(name: \"{i}\", position: (0.25, {i}), radius: 0, collides: false), "))
        .collect();
    let damped = scene(
        "damped.ron",
        &format!(
            "(version: 1, truth: (seconds: 1, length: 0.25, form: Oscillator), settings: (gravity: (0, 0), automatic: true, \
             accuracy: 1e-9), bodies: [{balls}], constraints: [{oscillators}])"
        ),
    );
    let still = "settings: (gravity: (0, 0), automatic: true)";
    let scenes = [
        damped.clone(),
        scene("empty.ron", "(version: 1)"),
        scene("still.ron", &format!("(version: 1, {still}, bodies: [Particle()])")),
        scene("fixed.ron", &format!("(version: 1, {still}, bodies: [Disc(motion: Static)])")),
        scene("light.ron", &format!("(version: 1, {still}, bodies: [Disc(mass: 1e-12, radius: 1e-9)])")),
        scene("heavy.ron", "(version: 1, bodies: [Disc(mass: 1e12, position: (1e8, -1e8), velocity: (1e6, 0))])"),
        scene(
            "drag.ron",
            "(version: 1, truth: (seconds: 1, length: 1, form: Projectile), settings: (drag: 1e-300), bodies: [Particle()])",
        ),
        scene(
            "point.ron",
            "(version: 1, bodies: [Particle(name: \"a\")], constraints: [Spring(a: \"a\", b: (0, 0), rest: 0, stiffness: 9)])",
        ),
        "hard/weighing".to_owned(),
        "hard/circle_stack".to_owned(),
    ];
    let is_clean = |text: &str| {
        !["nan", "inf"]
            .iter()
            .any(|word| text.to_lowercase().split(|c: char| !c.is_ascii_alphanumeric()).any(|found| found == *word))
    };
    let [csv, json, table] = ["out.csv", "out.jsonl", "table.csv"].map(|name| path_in(&folder, name));
    for scene in &scenes {
        for more in [
            &["--accuracy", "1e-6"][..],
            &["--integrator", "velocity-verlet"],
            &["--integrator", "velocity-verlet", "--order"],
        ] {
            let run = ["run", scene, "--seconds", "1", "--csv", &csv, "--measures"];
            let output = tautline(&[&run[..], &["-"], more].concat());
            let (rows, said) = (text(&output.stdout), text(&output.stderr));
            assert!(output.status.success() && is_clean(&said), "{scene} {more:?}: {said}");
            assert!(is_clean(&rows), "{scene} {more:?}: {rows}");
            assert!(is_clean(&read(&csv)), "{scene} {more:?}");
        }
        let lab =
            ["lab", scene, "--seconds", "0.5", "--methods", "accuracy,rattle,semi-implicit-euler+pgs", "--budget", "1"];
        let output = tautline(&[&lab[..], &["--json", &json, "--csv", &table]].concat());
        let said = text(&output.stdout) + &text(&output.stderr);
        assert!(output.status.success() && is_clean(&said), "{scene}: {said}");
        assert!(is_clean(&read(&table)) && is_clean(&read(&json)), "{scene}: {}", read(&table));
        tautline::lab::report::json::read(&read(&json)).unwrap_or_else(|error| panic!("{scene}: {error}"));
    }
    let errors = measured(&[&damped, "--seconds", "1"]);
    assert!(errors("error_rms").iter().chain(&errors("error_max")).all(|error| *error < 1e-6), "known and small");
}

#[test]
fn measures_add_up_the_energy_and_tell_its_drift() {
    let columns = measured(&["hard/oscillator", "--seconds", "2"]);
    let drift = columns("energy_drift");
    assert!(drift.iter().all(|drift| drift.abs() < 1e-8), "{drift:?}");
    let (kinetic, elastic, energy) = (columns("kinetic"), columns("elastic"), columns("energy"));
    // ½ k A² = 3.125 J
    assert!((0..energy.len()).all(|i| energy[i] == kinetic[i] + elastic[i] && (energy[i] - 3.125).abs() < 1e-7));
    // Drag takes what is there.
    let fade = measured(&["hard/damped_oscillator", "--seconds", "3"])("energy_drift");
    assert!(fade[fade.len() - 1] < -0.4, "{fade:?}");
    let columns = measured(&["hard/rope", "--seconds", "1", "--substeps", "2", "--solver", "pgs"]);
    let (rms, max) = (columns("violation_rms"), columns("violation_max"));
    assert!((1..rms.len()).all(|i| rms[i] > 0.0 && rms[i] <= max[i]), "{rms:?}");
}

#[test]
fn a_run_by_accuracy_says_when_the_motion_amplifies_errors() {
    let folder = folder();
    let scene = |name: &str, y: f64| {
        let text = format!(
            "(version: 1, settings: (automatic: true), bodies: [Particle(name: \"bob\", position: (0, {y}), radius: 0)], \
             constraints: [Rod(a: (0, 0), b: \"bob\")])"
        );
        std::fs::write(path_in(&folder, name), text).expect("a scene file");
        path_in(&folder, name)
    };
    let (upright, hanging) = (scene("upright.ron", 1.0), scene("hanging.ron", -1.0));
    let said = prints(&["run", &upright, "--seconds", "3", "--hash"]);
    // sinh(3 s √(9.81/s²))
    assert!(said.contains("; errors grow 6e3-fold in this motion\n"), "{said}");
    assert!(!prints(&["run", &hanging, "--seconds", "3"]).contains("errors grow"));
    let by_hand = prints(&["run", &upright, "--seconds", "3", "--integrator", "velocity-verlet"]);
    assert!(!by_hand.contains("errors grow"), "nobody asked for an accuracy: {by_hand}");
    let growth = measured(&[&upright, "--seconds", "3"])("growth");
    assert!(growth[0].is_nan() && growth[1..].windows(2).all(|pair| pair[0] <= pair[1]), "{growth:?}");
    for (step, growth) in growth.iter().enumerate().skip(60) {
        let expected = (9.81f64.sqrt() * step as f64 / 60.0).sinh();
        assert!((growth / expected - 1.0).abs() < 0.02, "{step}: {growth} {expected}");
    }
    // What follows a run does not change it.
    let mut setup = tautline::scene::open(&upright).expect("a scene");
    let mut stepper = tautline::engine::Stepper::new(setup.method).expect("a sound method");
    (0..180).for_each(|_| drop(stepper.step(&mut setup.world)));
    assert_eq!(said.lines().last(), Some(format!("{:016x}", setup.world.hash()).as_str()));
}

#[test]
fn the_observed_order_is_that_of_the_integrator() {
    let order = |arguments: &[&str]| {
        let line = prints(&[&["run"], arguments, &["--order"]].concat());
        let order = line.trim_end().rsplit_once("observed order ").unwrap_or_else(|| panic!("{line}")).1.to_owned();
        order.parse::<f64>().unwrap_or_else(|_| panic!("{line}"))
    };
    for (integrator, expected) in [("semi-implicit-euler", 1.0), ("velocity-verlet", 2.0), ("runge-kutta-4", 4.0)] {
        // Against the formula, and among three runs of a scene of which no truth is known.
        for scene in ["hard/oscillator", "hard/stiff_with_soft"] {
            let substeps = if integrator == "runge-kutta-4" { "4" } else { "16" };
            let found = order(&[scene, "--seconds", "1", "--integrator", integrator, "--substeps", substeps]);
            println!("{scene}, {integrator}: {found}");
            assert!((found - expected).abs() < 0.2, "{scene}, {integrator}: {found}");
        }
    }
    let columns = measured(&["hard/oscillator", "--seconds", "1", "--integrator", "velocity-verlet", "--order"]);
    assert!(columns("order")[60] > 1.8 && columns("order")[0].is_nan());
    fails(&["run", "hard/oscillator", "--order"], 1, "choose an integrator");
}

fn read(path: &str) -> String {
    std::fs::read_to_string(Path::new(path)).expect("the file that was asked for")
}

#[test]
fn rows_come_at_the_step_nearest_to_each_sample_and_once_only() {
    let times = |every: &str| {
        let csv = prints(&["run", "pendulum", "--seconds", "0.1", "--hz", "100", "--every", every, "--csv", "-"]);
        rows(&csv).iter().map(|row| (row[0] * 100.0).round()).collect::<Vec<_>>()
    };
    // 0, 2.4, 4.8, 7.2 and 9.6 steps
    assert_eq!(times("0.024"), [0.0, 2.0, 5.0, 7.0, 10.0]);
    assert_eq!(times("0.001"), (0..=10).map(f64::from).collect::<Vec<_>>());
}

#[test]
fn samples_within_a_step_cost_nothing() {
    let started = std::time::Instant::now();
    let csv = prints(&["run", "pendulum", "--hz", "1", "--seconds", "20", "--every", "1e-9", "--csv", "-"]);
    assert_eq!(rows(&csv).iter().map(|row| row[0].to_bits()).collect::<BTreeSet<_>>().len(), 21, "{csv}");
    // 20 steps take a millisecond; a look at each of the 2·10¹⁰ samples takes more than a minute.
    assert!(started.elapsed().as_secs() < 10, "{:?}", started.elapsed());
}

#[test]
fn written_numbers_are_read_back_with_the_same_bits() {
    let csv = prints(&["run", "bridge", "--seconds", "0.5", "--every", "0.5", "--csv", "-"]);
    let mut setup = tautline::scene::open("bridge").expect("a shipped scene");
    let mut stepper = tautline::engine::Stepper::new(setup.method).expect("a sound method");
    for _ in 0..30 {
        stepper.step(&mut setup.world);
    }
    let rows = rows(&csv);
    let last = &rows[setup.world.bodies().len()..];
    for ((_, body), row) in setup.world.bodies().iter().zip(last) {
        let spin = body.spin.unwrap_or_default();
        let expected = [body.position.x, body.position.y, spin.angle, body.velocity.x, body.velocity.y, spin.omega];
        assert_eq!(row[2..].iter().map(|x| x.to_bits()).collect::<Vec<_>>(), expected.map(f64::to_bits));
    }
}

#[test]
fn settings_on_the_command_line_replace_those_of_the_scene() {
    let hash = |more: &[&str]| {
        prints(&[&["run", "double_pendulum", "--seconds", "0.5", "--hash"], more].concat())
            .lines()
            .nth(1)
            .map(str::to_owned)
    };
    let plain = hash(&[]);
    assert_eq!(plain, hash(&[]), "the same run, the same hash");
    for more in [
        &["--hz", "120"][..],
        &["--substeps", "3"],
        &["--iterations", "2"],
        &["--integrator", "velocity-verlet"],
        &["--solver", "projection"],
        &["--no-warm-start"],
        &["--baumgarte", "0.05"],
    ] {
        assert_ne!(plain, hash(more), "{more:?} changes the run");
    }
    // Sweeps of the linear solver are not a way of going by hand, and a method that solves with it is taken.
    let chosen = hash(&["--linear", "gauss-seidel", "--iterations", "2"]);
    assert_ne!(chosen, hash(&["--linear", "cholesky"]), "two sweeps do not solve it");
    let exact = hash(&["--accuracy", "1e-6"]);
    assert_ne!(exact, hash(&["--accuracy", "1e-6", "--linear", "gauss-seidel"]), "ten sweeps do not solve it");
}

#[test]
fn the_summary_stays_out_of_rows_on_standard_output() {
    let output = tautline(&["run", "pendulum", "--seconds", "0.1", "--measures", "-", "--hash"]);
    let (out, messages) = (text(&output.stdout), text(&output.stderr));
    assert!(out.lines().all(|line| line.split(',').count() == 21), "{out}");
    assert_eq!(messages.lines().count(), 2, "summary and hash: {messages}");
}

#[test]
fn two_outputs_to_one_place_are_refused() {
    fails(&["run", "rope", "--csv", "-", "--measures", "-"], 1, "give one of them another file name");
    fails(&["run", "rope", "--csv", "same.csv", "--measures", "same.csv"], 1, "give one of them another file name");
    assert!(!Path::new("same.csv").exists());
}

#[test]
fn two_names_of_one_file_are_one_place() {
    let folder = folder();
    let both = |csv: &str, measures: &str| {
        let message = "give one of them another file name";
        fails(&["run", "rope", "--csv", &path_in(&folder, csv), "--measures", &path_in(&folder, measures)], 1, message);
    };
    both("new.csv", "./new.csv");
    assert_eq!(std::fs::read_dir(&folder).expect("the folder").count(), 0, "nothing is written");
    std::fs::write(path_in(&folder, "old.csv"), "old").expect("a file");
    std::fs::hard_link(path_in(&folder, "old.csv"), path_in(&folder, "hard.csv")).expect("a second name");
    both("old.csv", "./old.csv");
    #[cfg(unix)]
    {
        use std::os::unix::fs::symlink;
        symlink("old.csv", path_in(&folder, "soft.csv")).expect("a link");
        symlink("new.csv", path_in(&folder, "dangling.csv")).expect("a link to nothing");
        both("old.csv", "hard.csv");
        both("soft.csv", "old.csv");
        both("dangling.csv", "new.csv");
    }
    assert_eq!(read(&path_in(&folder, "old.csv")), "old");
    let two = [path_in(&folder, "a.csv"), path_in(&folder, "b.csv")];
    prints(&["run", "rope", "--seconds", "0.1", "--csv", &two[0], "--measures", &two[1]]);
}

#[test]
#[cfg(unix)]
fn standard_output_by_another_name_is_still_standard_output() {
    fails(&["run", "rope", "--csv", "-", "--measures", "/dev/stdout"], 1, "give one of them another file name");
    let folder = folder();
    let out = path_in(&folder, "out.csv");
    for name in ["/dev/stdout", &out] {
        let file = std::fs::File::create(&out).expect("a file");
        let mut run = command(&["run", "pendulum", "--seconds", "0.1", "--csv", name]);
        assert!(run.stdout(file).stderr(Stdio::null()).status().expect("the program runs").success());
        assert!(read(&out).starts_with(TRAJECTORY), "the summary is not written over the rows");
    }
}

#[test]
fn a_run_does_not_overwrite_its_scene() {
    let folder = folder();
    let (scene, again) = (path_in(&folder, "scene.ron"), path_in(&folder, "./scene.ron"));
    let text = "(version: 1, bodies: [Particle()])";
    std::fs::write(&scene, text).expect("a scene file");
    for option in ["--csv", "--measures"] {
        fails(&["run", &scene, option, &again], 1, "would overwrite the scene");
    }
    assert_eq!(read(&scene), text);
}

#[test]
fn a_file_that_cannot_be_written_is_named() {
    let folder = folder();
    fails(&["run", "rope", "--csv", &path_in(&folder, "missing/out.csv")], 1, "missing/out.csv");
    fails(&["run", "rope", "--csv", &folder.path().display().to_string()], 1, "cannot create");
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_reported_once() {
    fails(&["run", "rope", "--seconds", "0.1", "--csv", "/dev/full"], 1, "/dev/full: the disk is full");
    for arguments in [
        &["--help"][..],
        &["run", "--help"],
        &["--version"],
        &["scenes"],
        &["check", "rope"],
        &["truth", "truth/pendulum"],
        &["run", "rope", "--seconds", "0.1"],
        &["run", "rope", "--seconds", "0.1", "--csv", "-"],
    ] {
        let output = command(arguments).stdout(full()).output().expect("the program runs");
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}: {message}");
        assert!(message.contains("standard output: the disk is full"), "{arguments:?}: {message}");
        assert_eq!(message.lines().count(), 1, "{arguments:?}: {message}");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn messages_that_cannot_be_written_leave_the_exit_code() {
    for (arguments, code) in [(["check", "missing"], 1), (["run", "missing"], 1), (["run", "--what"], 2)] {
        let status = command(&arguments).stderr(full()).status().expect("the program runs");
        assert_eq!(status.code(), Some(code), "{arguments:?}");
    }
}

#[cfg(target_os = "linux")]
fn full() -> std::fs::File {
    std::fs::OpenOptions::new().write(true).open("/dev/full").expect("a device that is always full")
}

/// Names in a folder, sorted.
fn names(folder: &TempDir) -> Vec<std::ffi::OsString> {
    let entries = std::fs::read_dir(folder).expect("the folder");
    let mut names: Vec<_> = entries.map(|entry| entry.expect("an entry").file_name()).collect();
    names.sort();
    names
}

#[test]
#[cfg(unix)]
fn an_output_that_does_not_fit_leaves_the_old_file_and_no_trace() {
    let folder = folder();
    let csv = path_in(&folder, "out.csv");
    std::fs::write(&csv, "old").expect("a file");
    // As on a full disk: no file may be longer than a block of 512 bytes or a kilobyte.
    let limited = |arguments: &str| {
        let shell = format!("trap '' XFSZ; ulimit -f 1; exec {} {arguments}", env!("CARGO_BIN_EXE_tautline"));
        Command::new("sh").args(["-c", &shell]).current_dir(&folder).output().expect("a shell")
    };
    for arguments in [
        "run rope --seconds 1 --csv out.csv",
        "run rope --seconds 1 --measures out.csv",
        "truth truth/rope --write .",
        "lab truth/pendulum --seconds 0.5 --methods rattle,accuracy --json out.csv",
        "lab truth/pendulum --seconds 0.5 --methods rattle,accuracy --svg out.svg",
    ] {
        let output = limited(arguments);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{arguments}: {message}");
        assert!(message.contains("cannot write") && message.lines().count() == 1, "{arguments}: {message}");
        let kept = read(&csv);
        // What a journal has already is whole.
        assert!(kept == "old" || arguments.contains("--json") && kept.ends_with('\n'), "{arguments}: {kept:?}");
        assert_eq!(names(&folder), ["out.csv"], "{arguments}");
        std::fs::write(&csv, "old").expect("a file");
    }
}

#[test]
fn no_command_overwrites_the_scene_that_it_reads() {
    let folder = folder();
    let text = "(version: 1, truth: (seconds: 0.1, length: 1), bodies: [Particle()])";
    let scene = |name: &str| {
        std::fs::write(path_in(&folder, name), text).expect("a scene file");
        path_in(&folder, name)
    };
    let (truth, svg) = (scene("s.truth"), scene("s.svg"));
    fails(&["truth", &truth, "--write", &path_in(&folder, ".")], 1, "would overwrite the scene");
    fails(&["lab", &svg, "--svg", &path_in(&folder, "./s.svg")], 1, "would overwrite the scene");
    if cfg!(feature = "desktop") {
        let picture = scene("s.png");
        fails(&["shot", &picture, &picture], 1, "would overwrite the scene");
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("s.png", path_in(&folder, "link.png")).expect("a link");
            fails(&["shot", &picture, &path_in(&folder, "link.png")], 1, "would overwrite the scene");
        }
    }
    for name in names(&folder) {
        assert_eq!(std::fs::read_to_string(folder.path().join(&name)).expect("a file"), text, "{name:?}");
    }
}

/// Starts a run without end into `out.csv`, and waits until it has begun the file.
#[cfg(unix)]
fn endless(folder: &TempDir) -> std::process::Child {
    endless_with(folder, HEARD)
}

#[cfg(unix)]
const HEARD: &str = "--default-signal=INT,TERM,HUP";

/// The same, begun by `env` with this about signals: what a test runner in the background ignores is inherited.
#[cfg(unix)]
fn endless_with(folder: &TempDir, signals: &str) -> std::process::Child {
    let mut run = Command::new("env");
    run.arg(signals).arg(env!("CARGO_BIN_EXE_tautline"));
    run.args(["run", "pendulum", "--seconds", "1000000", "--every", "0.1", "--csv", "out.csv"]);
    let child = run.current_dir(folder).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn();
    let begun = std::time::Instant::now();
    let is_part = |name: &std::ffi::OsString| name.to_string_lossy().ends_with(".part");
    let long = |name: &std::ffi::OsString| folder.path().join(name).metadata().is_ok_and(|about| about.len() > 1000);
    while !names(folder).iter().any(|name| is_part(name) && long(name)) {
        assert!(begun.elapsed().as_secs() < 60, "nothing is written");
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    child.expect("the program starts")
}

#[test]
#[cfg(unix)]
fn a_run_that_is_stopped_keeps_its_rows() {
    for (signal, signals) in [("-INT", HEARD), ("-TERM", HEARD), ("-TERM", "--ignore-signal=INT,HUP")] {
        let folder = folder();
        std::fs::write(path_in(&folder, "out.csv"), "old").expect("a file");
        let mut child = endless_with(&folder, signals);
        if signals != HEARD {
            for ignored in ["-INT", "-HUP"] {
                let asked = Command::new("kill").args([ignored, &child.id().to_string()]).status().expect("kill");
                assert!(asked.success());
            }
            std::thread::sleep(std::time::Duration::from_millis(200));
            assert!(child.try_wait().expect("it can be asked").is_none(), "what is ignored stays ignored");
        }
        assert_eq!(read(&path_in(&folder, "out.csv")), "old", "until it is complete the old one stays");
        let stopped = Command::new("kill").args([signal, &child.id().to_string()]).status().expect("kill");
        assert!(stopped.success());
        let output = child.wait_with_output().expect("it ends");
        assert_eq!(output.status.code(), Some(130), "{signal} {signals}: {}", text(&output.stderr));
        assert!(text(&output.stdout).contains("stopped early"), "{}", text(&output.stdout));
        let rows = rows(&read(&path_in(&folder, "out.csv")));
        assert!(rows.len() > 10 && rows.iter().all(|row| row.len() == 8), "{}", rows.len());
        assert_eq!(names(&folder), ["out.csv"]);
    }
}

#[test]
#[cfg(unix)]
fn what_a_killed_run_left_is_removed_by_the_next_and_nothing_else() {
    let folder = folder();
    let out = path_in(&folder, "out.csv");
    std::fs::write(&out, "old").expect("a file");
    let others = [".tautline.notes.part", ".tautline.1.part", "my.part", ".tautline.7.0.part.bak"];
    others.iter().for_each(|name| std::fs::write(path_in(&folder, name), "mine").expect("a file"));
    let mut child = endless(&folder);
    child.kill().expect("it runs");
    child.wait().expect("it has ended");
    assert_eq!((read(&out).as_str(), names(&folder).len()), ("old", 6), "the old file and the unfinished one");
    // One that still runs keeps its own.
    let mut running = endless(&folder);
    assert_eq!(names(&folder).len(), 6, "the dead one's is removed, the new one's is there");
    prints(&["run", "pendulum", "--seconds", "0.1", "--csv", &out]);
    assert_eq!(names(&folder).len(), 6, "the other one still runs");
    running.kill().expect("it runs");
    running.wait().expect("it has ended");
    prints(&["run", "pendulum", "--seconds", "0.1", "--csv", &out]);
    assert_eq!(names(&folder).len(), 5);
    assert!(read(&out).starts_with(TRAJECTORY));
    assert!(others.iter().all(|name| read(&path_in(&folder, name)) == "mine"));
}

#[test]
#[cfg(unix)]
fn an_output_keeps_its_link_and_its_permissions() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = folder();
    let [out, link] = ["out.csv", "link.csv"].map(|name| path_in(&folder, name));
    std::fs::write(&out, "old").expect("a file");
    std::fs::set_permissions(&out, PermissionsExt::from_mode(0o640)).expect("own permissions");
    symlink("out.csv", &link).expect("a link");
    prints(&["run", "pendulum", "--seconds", "0.1", "--csv", &link]);
    assert!(Path::new(&link).is_symlink() && read(&out).starts_with(TRAJECTORY));
    assert_eq!(Path::new(&out).metadata().expect("the file").permissions().mode() & 0o777, 0o640);
    prints(&["run", "pendulum", "--seconds", "0.1", "--csv", "/dev/null"]);
    let pipe = path_in(&folder, "pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().expect("mkfifo runs").success());
    let reader = {
        let pipe = pipe.clone();
        std::thread::spawn(move || std::fs::read_to_string(pipe).expect("rows"))
    };
    prints(&["run", "pendulum", "--seconds", "0.1", "--csv", &pipe]);
    assert!(reader.join().expect("it was written").starts_with(TRAJECTORY), "a pipe takes rows as they come");
}

#[test]
#[cfg(target_os = "linux")]
fn a_path_need_not_be_text() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let folder = folder();
    let own = folder.path().join(OsStr::from_bytes(b"caf\xe9"));
    std::fs::create_dir(&own).expect("a folder");
    let name = |bytes: &[u8]| own.join(OsStr::from_bytes(bytes)).into_os_string();
    let scene = name(b"sc\xe8ne.ron");
    std::fs::write(&scene, "(version: 1, truth: (seconds: 0.1, length: 1), bodies: [Particle()])").expect("a scene");
    let [csv, measures, json, svg] = [&b"\xff.csv"[..], b"\xfe.csv", b"\xfd.jsonl", b"\xfc.svg"].map(name);
    let given = |words: &[&OsStr]| {
        let output = Command::new(env!("CARGO_BIN_EXE_tautline")).args(words).output().expect("the program runs");
        (output.status.code(), text(&output.stdout) + &text(&output.stderr))
    };
    let o = OsStr::new;
    let done = |words: &[&OsStr]| {
        let (code, said) = given(words);
        assert_eq!(code, Some(0), "{words:?}: {said}");
        said
    };
    assert!(done(&[o("check"), &scene]).contains("sc\u{fffd}ne.ron: good"));
    done(&[o("run"), &scene, o("--seconds"), o("0.1"), o("--csv"), &csv, o("--measures"), &measures]);
    done(&[o("truth"), &scene, o("--write"), own.as_os_str()]);
    let quick = [o("lab"), &scene, o("--seconds"), o("0.1"), o("--methods"), o("rattle")];
    done(&[&quick[..], &[o("--json"), &json, o("--svg"), &svg]].concat());
    done(&[&quick[..], &[o("--resume"), &json]].concat());
    for written in [&csv, &measures, &json, &svg, &name(b"sc\xe8ne.truth")] {
        assert!(Path::new(written).metadata().is_ok_and(|about| about.len() > 0), "{written:?}");
    }
    let (code, said) = given(&[o("run"), &scene, o("--csv"), &scene]);
    assert!(code == Some(1) && said.contains("would overwrite the scene"), "{said}");
    let (code, said) = given(&[o("check"), &name(b"\xffmissing\x1b[31m")]);
    assert!(code == Some(1) && said.contains("\u{fffd}missing\\u{1b}[31m: found no such file"), "{said}");
}

#[test]
#[cfg(target_os = "linux")]
fn what_never_ends_is_refused_at_once() {
    let folder = folder();
    let pipe = path_in(&folder, "pipe.ron");
    assert!(Command::new("mkfifo").arg(&pipe).status().expect("mkfifo runs").success());
    let zero = path_in(&folder, "zero.ron");
    std::os::unix::fs::symlink("/dev/zero", &zero).expect("a link");
    let hole = path_in(&folder, "hole.ron");
    std::fs::File::create(&hole).and_then(|file| file.set_len(1 << 40)).expect("a hole of a terabyte");
    let started = std::time::Instant::now();
    for (path, found) in [
        (pipe.as_str(), "a pipe or a device"),
        (&zero, "a pipe or a device"),
        (&hole, "a file of more than"),
        ("/proc/kmsg", "a pseudo file of the system"),
        ("/proc/self/pagemap", "a pseudo file of the system"),
    ] {
        fails(&["check", path], 1, found);
        fails(&["run", path], 1, found);
        fails(&["lab", "truth/pendulum", "--resume", path], 1, found);
    }
    assert!(started.elapsed().as_secs() < 30, "{:?}", started.elapsed());
}

#[test]
fn nothing_in_a_message_acts_on_the_terminal() {
    let acts = |text: &str| text.chars().any(|c| c.is_control() && c != '\n' || c == '\u{202e}');
    let folder = folder();
    let evil = "\u{1b}[31m\u{7}\u{9b}2J\u{202e}red";
    let wrong = path_in(&folder, "wrong.ron");
    for text in [
        format!("(version: 1, {evil})"),
        format!("(version: 1, title: {evil})"),
        format!("(version: 1, bodies: [{evil}()])"),
        format!("(version: 1, bodies: [Disc(name: \"{evil}.\")])"),
        format!("(version: 1, bodies: [Disc()], constraints: [Rod(a: \"{evil}\", b: (0, 0))])"),
        format!("(version: 1) {evil}"),
        format!("#![enable({evil})] (version: 1)"),
    ] {
        std::fs::write(&wrong, &text).expect("a scene file");
        for command in ["check", "run", "truth", "lab", "shot", "open"] {
            let picture = path_in(&folder, "a.png");
            let more = if command == "shot" { vec![picture.as_str()] } else { vec![] };
            let output = tautline(&[&[command, &wrong][..], &more].concat());
            let said = String::from_utf8_lossy(&output.stderr).into_owned();
            assert!(output.status.code() == Some(1) && !acts(&said), "{text:?}: {said:?}");
        }
    }
    let good = folder.path().join(format!("{}.ron", &evil[..4]));
    let good = good.to_str().expect("text");
    std::fs::write(good, format!("(version: 1, title: {evil:?}, bodies: [Particle()])")).expect("a scene file");
    let picture = path_in(&folder, "a.jpg\u{1b}[31m");
    for arguments in [
        &["check", good][..],
        &["run", good, "--seconds", "0.1"],
        &["lab", good, "--seconds", "0.1", "--methods", "rattle"],
        &["truth", good],
        &["run", evil],
        &["run", "rope", evil],
        &["run", "rope", "--seconds", evil],
        &["run", "rope", "--csv", &path_in(&folder, &format!("{evil}/out.csv"))],
        &[evil],
        &["shot", "rope", &picture],
    ] {
        let output = tautline(arguments);
        let said = text(&output.stdout) + &text(&output.stderr);
        assert!(!said.is_empty() && !acts(&said), "{arguments:?}: {said:?}");
    }
}

#[test]
#[cfg(unix)]
fn a_reader_that_leaves_early_ends_the_run_quietly() {
    for arguments in
        [&["run", "pile", "--seconds", "2", "--csv", "-"][..], &["--help"], &["scenes"], &["check", "rope"]]
    {
        let mut child =
            command(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program starts");
        drop(child.stdout.take());
        let output = child.wait_with_output().expect("the program ends");
        assert!(output.status.success(), "{arguments:?}: {:?}", output.status);
        assert_eq!(text(&output.stderr), "", "{arguments:?}");
    }
}

#[test]
fn a_run_that_diverges_writes_what_it_has_and_fails() {
    let folder = folder();
    let (scene, csv) = (path_in(&folder, "wild.ron"), path_in(&folder, "out.csv"));
    // Falls at a million m/s² from just below the largest speed that a world accepts: reached after a second.
    let wild = r#"(version: 1, settings: (gravity: (0, -1e6)), bodies: [Particle(velocity: (0, -9.9e7))])"#;
    std::fs::write(&scene, wild).expect("a scene file");
    fails(&["run", &scene, "--csv", &csv], 1, "the run diverged");
    let rows = rows(&read(&csv));
    assert!(rows.len() > 10 && rows.iter().flatten().all(|number| number.is_finite()), "{rows:?}");
}

#[test]
#[cfg(not(feature = "desktop"))]
fn a_build_without_a_window_says_so() {
    let folder = folder();
    let picture = path_in(&folder, "a.png");
    fails(&[], 1, "this build has no window");
    fails(&["open", "rope"], 1, "this build has no window");
    fails(&["shot", "rope", &picture], 1, "this build has no window");
    assert!(!Path::new(&picture).exists());
}

#[test]
fn truth_is_computed_compared_and_written() {
    let folder = folder();
    let said = prints(&["truth", "truth/pendulum", "--write", &folder.path().display().to_string()]);
    assert!(said.starts_with("truth/pendulum: agreement ") && said.contains("stored one differs by 0.0e0"), "{said}");
    let written = std::fs::read(folder.path().join("pendulum.truth")).expect("the file that was asked for");
    let written = tautline::truth::from_bytes(&written).expect("a trajectory");
    assert_eq!(Some(written.positions), tautline::truth::stored("truth/pendulum").map(|stored| stored.positions));
    let own = path_in(&folder, "own.ron");
    std::fs::write(&own, "(version: 1, truth: (seconds: 0.1, length: 1), bodies: [Particle()])").expect("a scene file");
    assert!(prints(&["truth", &own]).contains("not stored, 7 samples of 1 bodies"));
    prints(&["truth", "truth/pendulum", "--check"]);
    fails_late(&["truth", &own, "--check"], "write it anew");
}

#[test]
fn a_closed_form_is_compared_with_the_reference_solver_and_never_stored() {
    let said = prints(&["truth", "hard/pendulum"]);
    assert!(said.starts_with("hard/pendulum: closed form Pendulum, 601 samples of 2 bodies; the reference"), "{said}");
    let folder = folder();
    let ball = path_in(&folder, "ball.ron");
    let walls = "bodies: [Particle(position: (0, 1))], walls: [Segment(from: (-1, 0), to: (1, 0))]";
    let text = format!("(version: 1, truth: (seconds: 1, length: 1, form: Bounce), {walls})");
    std::fs::write(&ball, text).expect("a scene file");
    assert!(prints(&["truth", &ball]).contains("61 samples of 1 bodies; a body that can touch a wall"));
    fails(&["truth", &ball, "--check"], 1, "leave out --write and --check");
}

/// Fails after something was printed.
fn fails_late(arguments: &[&str], phrase: &str) {
    let output = tautline(arguments);
    let message = text(&output.stderr);
    assert!(output.status.code() == Some(1) && message.contains(phrase), "{message}");
}

#[test]
fn what_has_no_truth_is_refused_with_advice() {
    let folder = folder();
    fails(&["truth"], 2, "--all");
    fails(&["truth", "rope", "--all"], 2, "cannot be used with");
    fails(&["truth", "rope"], 1, "add `truth: (seconds: 10, length: 1)`");
    fails(&["truth", "truth/rop"], 1, "Did you mean `truth/rope`?");
    let nowhere = tautline(&["truth", "truth/pendulum", "--write", &path_in(&folder, "missing")]);
    assert!(text(&nowhere.stderr).contains("create it first") && nowhere.status.code() == Some(1), "{nowhere:?}");
    assert!(nowhere.stdout.is_empty(), "nothing is computed that could not be kept");
    let disc = path_in(&folder, "disc.ron");
    std::fs::write(&disc, "(version: 1, truth: (seconds: 1, length: 1), bodies: [Disc()])").expect("a scene file");
    fails(&["truth", &disc], 1, "a disc that turns");
}
