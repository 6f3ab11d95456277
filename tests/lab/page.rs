//! The page of `docs`: what is committed is what the committed data give, and what the data promise.

use std::path::{Path, PathBuf};
use tautline::lab::report::page::{Machine, ScenePoints, gains, page, scenes};
use tautline::lab::report::{json, svg::svg};
use tautline::lab::{Front, Setting};

fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs")
}

/// Line ends as a checkout on any system has them.
fn read(path: PathBuf) -> String {
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    text.replace("\r\n", "\n")
}

fn committed() -> Vec<ScenePoints> {
    let scene = |shipped: &tautline::scene::Shipped| {
        let mut scene =
            ScenePoints { name: shipped.name.to_owned(), title: shipped.title.to_owned(), points: Vec::new() };
        scene.points = json::read(&read(docs().join("data").join(scene.stem()).with_extension("jsonl"))).unwrap().0;
        scene
    };
    scenes().iter().map(scene).collect()
}

const REDRAW: &str = "draw it anew: cargo run --release -- lab --truth --docs docs --redraw";

#[test]
fn the_committed_page_and_diagrams_are_those_of_the_committed_data() {
    let machine: Machine = serde_json::from_str(&read(docs().join("data/machine.json"))).unwrap();
    let scenes = committed();
    assert!(page(&machine, &scenes) == read(docs().join("accuracy.md")), "docs/accuracy.md: {REDRAW}");
    for scene in &scenes {
        let picture = read(docs().join("lab").join(scene.stem()).with_extension("svg"));
        assert!(svg(&scene.title, &scene.points) == picture, "docs/lab/{}.svg: {REDRAW}", scene.stem());
        assert!(scene.points.iter().all(|point| point.scene == scene.name), "{}", scene.name);
        assert!(page(&machine, &scenes).contains(&format!("lab/{}.svg", scene.stem())));
    }
    println!("{}", gains(&scenes.iter().collect::<Vec<_>>()));
}

#[test]
fn at_the_cost_of_the_baseline_the_best_error_is_a_thousand_times_smaller_on_every_truth_scene() {
    for scene in committed().into_iter().filter(|scene| scene.name.starts_with("truth/")) {
        let gain = Front::of(&scene.points).gain(&scene.points, Setting::BASELINE).unwrap();
        let (point, factor) = gain.at_its_cost.unwrap();
        println!("{}: {factor:.1e} ({})", scene.name, point.setting().label());
        assert!(factor >= 1000.0, "{}: {factor:.0}", scene.name);
    }
}
