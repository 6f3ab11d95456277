//! The points behind `docs/accuracy.md`, part of the program: what is known of a scene before anything is measured here.

use super::Point;
use super::report::json;

/// Names of scenes and their points, as `tautline lab --docs` wrote them.
const FILES: [(&str, &str); 25] = [
    ("truth/bridge", include_str!("../../docs/data/bridge.jsonl")),
    ("truth/cloth", include_str!("../../docs/data/cloth.jsonl")),
    ("truth/double_pendulum", include_str!("../../docs/data/double_pendulum.jsonl")),
    ("truth/heavy_rope", include_str!("../../docs/data/heavy_rope.jsonl")),
    ("truth/pendulum", include_str!("../../docs/data/pendulum.jsonl")),
    ("truth/rigid_net", include_str!("../../docs/data/rigid_net.jsonl")),
    ("truth/rope", include_str!("../../docs/data/rope.jsonl")),
    ("truth/stiff_chain", include_str!("../../docs/data/stiff_chain.jsonl")),
    ("truth/stiff_chain_1e4", include_str!("../../docs/data/stiff_chain_1e4.jsonl")),
    ("hard/bounce_box", include_str!("../../docs/data/hard-bounce_box.jsonl")),
    ("hard/bouncing_ball", include_str!("../../docs/data/hard-bouncing_ball.jsonl")),
    ("hard/circle_stack", include_str!("../../docs/data/hard-circle_stack.jsonl")),
    ("hard/cradle", include_str!("../../docs/data/hard-cradle.jsonl")),
    ("hard/damped_oscillator", include_str!("../../docs/data/hard-damped_oscillator.jsonl")),
    ("hard/oscillator", include_str!("../../docs/data/hard-oscillator.jsonl")),
    ("hard/pendulum", include_str!("../../docs/data/hard-pendulum.jsonl")),
    ("hard/physical_pendulum", include_str!("../../docs/data/hard-physical_pendulum.jsonl")),
    ("hard/projectile", include_str!("../../docs/data/hard-projectile.jsonl")),
    ("hard/ramp_row", include_str!("../../docs/data/hard-ramp_row.jsonl")),
    ("hard/restitution_row", include_str!("../../docs/data/hard-restitution_row.jsonl")),
    ("hard/roll", include_str!("../../docs/data/hard-roll.jsonl")),
    ("hard/slide", include_str!("../../docs/data/hard-slide.jsonl")),
    ("hard/small_pendulum", include_str!("../../docs/data/hard-small_pendulum.jsonl")),
    ("hard/two_body_exchange", include_str!("../../docs/data/hard-two_body_exchange.jsonl")),
    ("hard/weighing", include_str!("../../docs/data/hard-weighing.jsonl")),
];

/// The processor that they were measured on, as `docs/data/machine.json` names it.
pub fn published_on() -> String {
    let machine = serde_json::from_str::<serde_json::Value>(include_str!("../../docs/data/machine.json"));
    let cpu = machine.ok().and_then(|machine| machine.get("cpu")?.as_str().map(str::to_owned));
    cpu.unwrap_or_else(|| "another machine".into())
}

/// The points that were published of a scene; none if it is not among those.
pub fn published(scene: &str) -> Vec<Point> {
    let text = FILES.iter().find(|(name, _)| *name == scene).map_or("", |(_, text)| text);
    // A test reads them all; a file that cannot be read is as good as none.
    json::read(text).map(|(points, _)| points).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_of_the_documents_is_here_whole_and_of_its_scene() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/data");
        let files = std::fs::read_dir(folder).expect("the repository's own folder");
        let is_points = |name: &String| name.ends_with(".jsonl");
        let names = files.map(|file| file.expect("readable").file_name().to_string_lossy().into_owned());
        assert_eq!(names.filter(is_points).count(), FILES.len());
        for (scene, text) in FILES {
            let (points, whole) = json::read(text).unwrap_or_else(|error| panic!("{scene}: {error}"));
            assert!(points.len() > 10 && whole == text.len(), "{scene}");
            assert!(points.iter().all(|point| point.scene == scene), "{scene}");
        }
        assert!(published("bridge").is_empty());
        assert!(!published_on().is_empty());
    }
}
