//! `tautline lab` as a user runs it from a shell.

use std::path::Path;
use std::process::{Command, Output, Stdio};
use tautline::lab::report::{csv, json};
use tempfile::TempDir;

fn lab(arguments: &[&str]) -> Output {
    command(arguments).output().expect("the program runs")
}

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_tautline"));
    command.arg("lab").args(arguments);
    command
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

/// Runs a command that must succeed and returns what it printed.
fn prints(arguments: &[&str]) -> String {
    let output = lab(arguments);
    assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
    text(&output.stdout)
}

/// Runs a command that must fail with `code`, in a message that contains `phrase`.
fn fails(arguments: &[&str], code: i32, phrase: &str) {
    let output = lab(arguments);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {message}");
    assert!(message.contains(phrase), "{arguments:?}: {message:?} does not contain {phrase:?}");
    assert!(!message.contains("panicked"), "{arguments:?}: {message}");
}

fn path_in(folder: &TempDir, name: &str) -> String {
    folder.path().join(name).display().to_string()
}

fn read(path: &str) -> String {
    std::fs::read_to_string(Path::new(path)).expect("the file that was asked for")
}

/// A quick sweep.
const QUICK: [&str; 5] = ["truth/double_pendulum", "--seconds", "0.5", "--methods", "accuracy,semi-implicit-euler+pgs"];

fn quick<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&QUICK[..], more].concat()
}

#[test]
fn the_front_is_printed_as_a_table_a_diagram_and_in_words() {
    let said = prints(&quick(&[]));
    assert!(said.starts_with("truth/double_pendulum: ") && said.contains("; stored truth\n"), "{said}");
    assert!(said.contains("\n* Accuracy 1e-") && said.contains("Semi-implicit Euler + PGS, 4 × 10"));
    assert!(said.contains("CPU time per simulated second [us/s]") && said.contains("Capital: on the front"));
    assert!(said.contains("For an error of 1e-9 use Accuracy 1e-"), "{said}");
    assert!(said.contains("times smaller (Accuracy"), "{said}");
}

#[test]
fn help_explains_every_option() {
    let help = prints(&["--help"]);
    for option in [
        "--json",
        "--csv",
        "--svg",
        "--resume",
        "--seconds",
        "--methods",
        "--hz",
        "--budget",
        "--longest",
        "--refine",
        "--runs",
        "--docs",
        "--redraw",
        "--truth",
        "--all",
    ] {
        let about = help.split(&format!("\n      {option}")).nth(1).unwrap_or_else(|| panic!("{option} in {help}"));
        assert!(about.lines().nth(1).is_some_and(|line| line.trim().len() > 10), "{option} is explained");
    }
}

#[test]
fn points_go_to_json_csv_and_svg_while_they_are_measured() {
    let folder = tempfile::tempdir().unwrap();
    let [json, csv, svg] = ["a.jsonl", "a.csv", "a.svg"].map(|name| path_in(&folder, name));
    prints(&quick(&["--json", &json, "--csv", &csv, "--svg", &svg]));
    let (points, _) = json::read(&read(&json)).unwrap();
    assert!(points.len() > 10, "{}", points.len());
    let table = read(&csv);
    assert_eq!((table.lines().next(), table.lines().count()), (Some(csv::HEADER), points.len() + 1));
    assert!(read(&svg).contains("Exact double pendulum"));
}

#[test]
fn lines_on_standard_output_stay_alone() {
    let output = lab(&quick(&["--json", "-"]));
    let (out, messages) = (text(&output.stdout), text(&output.stderr));
    let (points, whole) = json::read(&out).unwrap();
    assert!(!points.is_empty() && whole == out.len());
    assert!(messages.contains("Capital: on the front"), "{messages}");
}

#[test]
fn a_stopped_sweep_is_resumed_from_its_file() {
    let folder = tempfile::tempdir().unwrap();
    let file = path_in(&folder, "a.jsonl");
    prints(&quick(&["--json", &file]));
    let whole = read(&file);
    let lines: Vec<&str> = whole.lines().collect();
    // Killed in the middle of the sixth line.
    let kept = lines[..5].join("\n") + "\n";
    std::fs::write(&file, format!("{kept}{}", &lines[5][..20])).unwrap();
    let csv = path_in(&folder, "a.csv");
    prints(&quick(&["--resume", &file, "--csv", &csv]));
    let resumed = read(&file);
    assert!(resumed.starts_with(&kept), "what was measured stands as it was");
    let settings = |text: &str| json::read(text).unwrap().0.iter().map(|point| point.setting()).collect::<Vec<_>>();
    assert_eq!(settings(&resumed), settings(&whole));
    assert_eq!(read(&csv).lines().count(), resumed.lines().count() + 1, "the table has the old points too");
    // Once more there is nothing left to measure; into another file, or the same one by another name.
    let copy = path_in(&folder, "b.jsonl");
    prints(&quick(&["--resume", &file, "--json", &copy]));
    assert_eq!(read(&copy), resumed);
    prints(&quick(&["--resume", &file, "--json", &path_in(&folder, "./a.jsonl")]));
    assert_eq!(read(&file), resumed);
}

#[test]
#[cfg(unix)]
fn ctrl_c_leaves_what_is_measured_on_disk() {
    use std::io::BufRead;
    let folder = tempfile::tempdir().unwrap();
    let (file, svg) = (path_in(&folder, "a.jsonl"), path_in(&folder, "a.svg"));
    let mut run = command(&["truth/rigid_net", "--json", &file, "--svg", &svg]);
    let child = run.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program starts");
    let enough = || std::fs::read_to_string(&file).is_ok_and(|text| text.lines().count() >= 2);
    let begun = std::time::Instant::now();
    while !enough() {
        assert!(begun.elapsed().as_secs() < 60, "no points");
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    let stopped = Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill");
    assert!(stopped.success());
    let output = child.wait_with_output().expect("it ends");
    assert_eq!(output.status.code(), Some(130), "{}", text(&output.stderr));
    let said = output.stdout.lines().map(Result::unwrap).last().unwrap();
    assert!(said.starts_with("stopped: what was measured"), "{said}");
    let (points, whole) = json::read(&read(&file)).unwrap();
    assert!(points.len() >= 2 && whole == read(&file).len());
    assert!(read(&svg).ends_with("</svg>\n"), "the diagram of what there is");
}

#[test]
fn a_scene_without_a_truth_is_compared_with_a_refined_run() {
    let folder = tempfile::tempdir().unwrap();
    let (scene, file) = (path_in(&folder, "own.ron"), path_in(&folder, "own.jsonl"));
    let own = "(version: 1, bodies: [Particle(position: (1, 0), radius: 0, name: \"a\")], constraints: [Rod(a: \"a\", b: (0, 0))])";
    std::fs::write(&scene, own).unwrap();
    let said = prints(&[&scene, "--seconds", "1", "--methods", "accuracy,rattle", "--json", &file]);
    assert!(said.contains("errors against a refined run, converged to "), "{said}");
    let (points, _) = json::read(&read(&file)).unwrap();
    assert!(points.iter().all(|point| point.error_kind.to_string().starts_with("converged to ")));
    assert!(points.iter().all(|point| point.error.is_some_and(|error| error < 0.1)));
    // Longer than the stored truth
    let longer = prints(&["truth/rope", "--seconds", "1.6", "--methods", "rattle"]);
    assert!(longer.contains("errors against a refined run"), "{longer}");
}

#[test]
fn what_is_not_understood_or_cannot_be_is_told_with_advice() {
    fails(&[], 2, "<SCENE|--truth|--all>");
    fails(&["rope", "--truth"], 2, "cannot be used with");
    fails(&["brige"], 1, "Did you mean `bridge`?");
    fails(&["rope", "--methods", "magic"], 2, "semi-implicit-euler+pgs");
    fails(&["rope", "--hz", "50"], 2, "a multiple of 60");
    fails(&["rope", "--runs", "3"], 2, "from 5 to 1000");
    fails(&["rope", "--budget", "0"], 2, "from 0.001");
    fails(&["rope", "--seconds", "-1"], 2, "from 0 to 1000000");
    fails(&["rope", "--svg", "a.png"], 2, "such as diagram.svg");
    fails(&["rope", "cloth", "--svg", "a.svg"], 1, "--svg draws one scene");
    fails(&["rope", "--docs", "docs"], 2, "cannot be used with");
    fails(&["--truth", "--redraw"], 2, "--docs");
    fails(&["--truth", "--docs", "no/such/folder"], 1, "create it first");
    fails(&["--truth", "--docs", "no/such/folder", "--redraw"], 1, "measure anew without --redraw");
    assert!(!Path::new("a.svg").exists());
}

#[test]
fn files_that_get_in_the_way_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let [a, b] = ["a.jsonl", "./a.jsonl"].map(|name| path_in(&folder, name));
    fails(&quick(&["--json", &a, "--csv", &b]), 1, "give one of them another file name");
    fails(&quick(&["--json", "-", "--csv", "-"]), 1, "give one of them another file name");
    assert!(!Path::new(&a).exists(), "nothing is written");
    fails(&quick(&["--resume", &a]), 1, "with --json");
    fails(&quick(&["--resume", "-"]), 1, "name the file");
    std::fs::write(&a, "nonsense\n").unwrap();
    fails(&quick(&["--resume", &a]), 1, "line 1");
    fails(&quick(&["--resume", &a, "--csv", &b]), 1, "give one of them another file name");
    assert_eq!(read(&a), "nonsense\n", "what is not understood is left alone");
    let scene = path_in(&folder, "scene.ron");
    std::fs::write(&scene, "(version: 1, bodies: [Particle()])").unwrap();
    fails(&[&scene, "--json", &scene], 1, "would overwrite the scene");
    fails(&quick(&["--json", &path_in(&folder, "missing/a.jsonl")]), 1, "missing/a.jsonl");
    let other = path_in(&folder, "other.jsonl");
    prints(&["truth/pendulum", "--seconds", "0.1", "--methods", "rattle", "--json", &other]);
    fails(&quick(&["--resume", &other]), 1, "has points of truth/pendulum");
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_reported_once() {
    fails(&quick(&["--json", "/dev/full"]), 1, "/dev/full: the disk is full");
    fails(&quick(&["--csv", "/dev/full"]), 1, "/dev/full: the disk is full");
    fails(&quick(&["--svg", "/dev/full"]), 1, "/dev/full: the disk is full");
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let output = command(&quick(&[])).stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("standard output: the disk is full"));
}

#[test]
fn the_page_is_drawn_from_data_that_are_there() {
    let folder = tempfile::tempdir().unwrap();
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    std::fs::create_dir(folder.path().join("data")).unwrap();
    for entry in std::fs::read_dir(docs.join("data")).unwrap() {
        let entry = entry.unwrap();
        std::fs::copy(entry.path(), folder.path().join("data").join(entry.file_name())).unwrap();
    }
    prints(&["--truth", "--docs", &folder.path().display().to_string(), "--redraw"]);
    let read = |path: std::path::PathBuf| std::fs::read_to_string(path).unwrap().replace("\r\n", "\n");
    assert_eq!(read(folder.path().join("accuracy.md")), read(docs.join("accuracy.md")));
    assert!(folder.path().join("lab/rope.svg").exists());
}
