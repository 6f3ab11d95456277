//! The page of `docs/` about all scenes whose exact motion is known, from points that were measured before.

use crate::lab::front::{error, factor_text, plain, short};
use crate::lab::{CLOCK, Family, Front, Gain, Point, Setting};
use crate::scene::{Shipped, every_scene, parse, truth_scenes};
use serde::{Deserialize, Serialize};

const TEMPLATE: &str = include_str!("accuracy.md");

/// What the points were measured on.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Machine {
    /// Kind of processor as the system names it.
    pub cpu: String,
    /// Cores that the program may use, at least 1.
    pub cores: usize,
    /// "linux, x86_64"
    pub system: String,
    /// Of this program.
    pub version: String,
    /// What the costs were timed with: [`CLOCK`] there.
    pub clock: String,
}

impl Machine {
    /// This one.
    pub fn here() -> Machine {
        let about = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        let model = about.lines().find(|line| line.starts_with("model name")).and_then(|line| line.split(": ").nth(1));
        Machine {
            cpu: model.unwrap_or("unknown processor").trim().to_owned(),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            system: format!("{}, {}", std::env::consts::OS, std::env::consts::ARCH),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            clock: CLOCK.to_owned(),
        }
    }
}

/// The points of one scene.
#[derive(Clone, Debug, PartialEq)]
pub struct ScenePoints {
    /// "truth/rope"
    pub name: String,
    /// "Exact rope"
    pub title: String,
    /// All that was measured on it, in the order of the file.
    pub points: Vec<Point>,
}

impl ScenePoints {
    /// What its files in `docs/` are called.
    pub fn stem(&self) -> String {
        stem(&self.name)
    }

    /// Whether it is one of the truth scenes, and not a hard case with a formula.
    fn is_truth(&self) -> bool {
        self.name.starts_with(TRUTH)
    }
}

const TRUTH: &str = "truth/";

/// What the files of a scene in `docs/` are called: "rope" for "truth/rope", "hard-pendulum" for "hard/pendulum".
pub fn stem(name: &str) -> String {
    name.strip_prefix(TRUTH).unwrap_or(name).replace('/', "-")
}

/// The scenes of the page: the truth scenes, then all others that name a formula.
pub fn scenes() -> Vec<Shipped> {
    let has_formula = |scene: &&Shipped| {
        let setup = parse(scene.name, scene.text);
        setup.is_ok_and(|setup| setup.truth.is_some_and(|truth| truth.form.is_some()))
    };
    let others = every_scene().iter().filter(|scene| !truth_scenes().contains(scene)).filter(has_formula);
    truth_scenes().iter().chain(others).copied().collect()
}

/// The whole page. Diagrams are expected in the folder `lab` beside it.
pub fn page(machine: &Machine, scenes: &[ScenePoints]) -> String {
    let Machine { cpu, cores, system, version, clock } = machine;
    let about = format!("Measured on: {cpu}, {cores} cores, {system}; Tautline {version}, optimised build; {clock}.");
    let (truth, hard): (Vec<&ScenePoints>, Vec<&ScenePoints>) = scenes.iter().partition(|scene| scene.is_truth());
    TEMPLATE
        .replace("{{machine}}", &about)
        .replace("{{gains}}", gains(&truth).trim_end())
        .replace("{{diagrams}}", diagrams(&truth).trim_end())
        .replace("{{hard gains}}", gains(&hard).trim_end())
        .replace("{{hard diagrams}}", diagrams(&hard).trim_end())
        .replace("{{losses}}", losses(scenes).trim_end())
}

/// By how much the best method beats the baseline, a row a scene.
pub fn gains(scenes: &[&ScenePoints]) -> String {
    let mut text = "| Scene | Baseline | Best at its cost | Error smaller by | Cheapest at its error | Cheaper by |\n\
                    |---|---|---|---|---|---|\n"
        .to_owned();
    for scene in scenes {
        let Some(gain) = Front::of(&scene.points).gain(&scene.points, Setting::BASELINE) else { continue };
        let Gain { baseline, at_its_cost, at_its_error } = gain;
        let start = match baseline.error {
            Some(error) => format!("{} at {} µs/s", short(error), plain(baseline.cpu_us_per_second)),
            None => "diverges".to_owned(),
        };
        let cells = |beats: Option<(Point, f64)>, own: fn(&Point) -> String| match beats {
            Some((point, factor)) if factor.is_finite() => {
                format!("{}: {} | {}", point.setting().label(), own(&point), factor_text(factor))
            }
            Some((point, _)) => format!("{}: {} | —", point.setting().label(), own(&point)),
            None => "none | —".to_owned(),
        };
        let at_cost = cells(at_its_cost, |point| short(error(point)));
        let at_error = cells(at_its_error, |point| format!("{} µs/s", plain(point.cpu_us_per_second)));
        text += &format!("| {} | {start} | {at_cost} | {at_error} |\n", scene.stem());
    }
    text
}

fn diagrams(scenes: &[&ScenePoints]) -> String {
    let one = |scene: &ScenePoints| {
        let front = Front::of(&scene.points);
        let advice = [1e-3, 1e-6, 1e-9].map(|wanted| format!("- {}", front.advice_for_error(wanted))).join("\n");
        let (title, stem) = (&scene.title, scene.stem());
        format!("### {title}\n\n![Speed against error: {title}](lab/{stem}.svg)\n\n{advice}\n\n")
    };
    scenes.iter().copied().map(one).collect()
}

/// Errors below this say no more than this.
const ROUNDING: f64 = 1e-14;

/// Where the dial is not the best choice, a row a scene.
fn losses(scenes: &[ScenePoints]) -> String {
    let mut text =
        "| Scene | Dial beaten most | by | error smaller by | Below the cheapest accuracy |\n|---|---|---|---|---|\n"
            .to_owned();
    for scene in scenes {
        let dial: Vec<&Point> = scene.points.iter().filter(|point| point.method == Family::Dial).collect();
        let others: Vec<Point> = scene.points.iter().filter(|point| point.method != Family::Dial).cloned().collect();
        let front = Front::of(&others);
        let beaten = dial.iter().filter_map(|point| {
            let better = front.best_within(point.cpu_us_per_second)?;
            Some((point, better, error(point).max(ROUNDING) / error(better).max(ROUNDING)))
        });
        let worst = beaten.max_by(|a, b| a.2.total_cmp(&b.2)).filter(|(.., factor)| *factor > 1.0);
        let most = match worst {
            Some((point, better, factor)) => {
                let (point, better) = (point.setting().label(), better.setting().label());
                format!("{point} | {better} | {}", factor_text(factor))
            }
            None => "never | — | —".to_owned(),
        };
        let cheapest = dial.iter().map(|point| point.cpu_us_per_second).fold(f64::INFINITY, f64::min);
        let below = front.points().iter().rev().find(|point| point.cpu_us_per_second < cheapest);
        let below = below.map_or("nothing with an error".to_owned(), |point| {
            let cost = plain(point.cpu_us_per_second);
            format!("{}: {} at {cost} µs/s", point.setting().label(), short(error(point)))
        });
        text += &format!("| {} | {most} | {below} |\n", scene.stem());
    }
    text
}
