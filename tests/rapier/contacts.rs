//! Impacts, slides and rolls that a formula gives. Both sides of a contact are of the same material, for which the mean that
//! Rapier takes, and the larger and the geometric mean that we take, are the same.

use super::ours;
use super::witness::{BETTER, DEFAULT, Setting, double, single};
use tautline::engine::Method;
use tautline::scene;

/// A scene, and the largest error of ours at default settings and of the better of Rapier's two fine settings, in parts of 1 m.
struct Case {
    name: &'static str,
    text: &'static str,
    ours: f64,
    rapier: f64,
}

/// Ours at default settings is of first order in a substep of 4 ms wherever something slides or bounces under gravity: some
/// mm a second. Rapier's contacts are soft, and a bounce comes at the end of a step: centimetres at the default settings, and a
/// fraction of one at the fine ones, 1 ms at 4 m/s. A row of balls that touch is no witness: it sends off several of them at once.
const CASES: [Case; 9] = [
    Case {
        name: "bounce, e = 0.8",
        text: "form: Bounce), bodies: [Particle(position: (0, 1.25), radius: 0.25, restitution: 0.8)],
               walls: [Segment(from: (-5, 0), to: (5, 0), restitution: 0.8)]",
        ours: 0.05,
        rapier: 0.01,
    },
    Case {
        name: "bounce, e = 1",
        text: "form: Bounce), bodies: [Particle(position: (0, 1.25), radius: 0.25, restitution: 1)],
               walls: [Segment(from: (-5, 0), to: (5, 0), restitution: 1)]",
        ours: 0.05,
        rapier: 0.01,
    },
    Case {
        name: "head-on, 10 kg on 1 kg",
        text: "form: Exchange), settings: (gravity: (0, 0)),
               bodies: [Particle(position: (-1, 0), velocity: (2, 0), mass: 10, restitution: 1), Particle(restitution: 1)]",
        ours: 0.02,
        rapier: 1e-3,
    },
    Case {
        name: "oblique, rough discs",
        text: "form: Exchange), settings: (gravity: (0, 0)),
               bodies: [Disc(position: (-1, 0.05), velocity: (2, 0), omega: 5, restitution: 0.5, friction: 0.3),
                        Disc(restitution: 0.5, friction: 0.3)]",
        ours: 0.05,
        rapier: 0.01,
    },
    Case {
        name: "cradle of five",
        text: "form: Row), settings: (gravity: (0, 0)),
               bodies: [Particle(position: (-1, 0), velocity: (5, 0), restitution: 1), Particle(position: (0, 0), restitution: 1),
                        Particle(position: (0.2, 0), restitution: 1), Particle(position: (0.4, 0), restitution: 1),
                        Particle(position: (0.6, 0), restitution: 1)]",
        ours: 0.02,
        rapier: f64::INFINITY,
    },
    Case {
        name: "slide, μ = 0.3",
        text: "form: Slide), settings: (gravity: (4.905, -8.495709211125343)),
               bodies: [Particle(position: (0, 0.1), friction: 0.3)], walls: [Segment(from: (-1, 0), to: (20, 0), friction: 0.3)]",
        ours: 0.01,
        rapier: 1e-3,
    },
    Case {
        name: "stick, μ = 0.7",
        text: "form: Slide), settings: (gravity: (4.905, -8.495709211125343)),
               bodies: [Particle(position: (0, 0.1), friction: 0.7)], walls: [Segment(from: (-1, 0), to: (20, 0), friction: 0.7)]",
        ours: 1e-3,
        rapier: 1e-4,
    },
    Case {
        name: "roll, 20°",
        text: "form: Roll), settings: (gravity: (3.3552176, -9.2183847)),
               bodies: [Disc(position: (0, 0.1), friction: 0.8)], walls: [Segment(from: (-1, 0), to: (20, 0), friction: 0.8)]",
        ours: 0.02,
        rapier: 1e-3,
    },
    Case {
        name: "slip to roll",
        text: "form: Roll), bodies: [Disc(position: (0, 0.1), velocity: (3, 0), friction: 0.3)],
               walls: [Segment(from: (-1, 0), to: (20, 0), friction: 0.3)]",
        ours: 0.01,
        rapier: 1e-3,
    },
];

#[test]
fn formulas_ours_and_rapiers_tell_the_same_motion() {
    let mut broken = Vec::new();
    for Case { name, text, ours, rapier } in CASES {
        let text = format!("(version: 1, truth: (seconds: 2, length: 1, {text})");
        let setup = scene::parse(name, &text).unwrap_or_else(|error| panic!("{error}"));
        let truth = setup.known_motion().expect("a formula");
        let (world, samples) = (&setup.world, truth.times.len());
        println!("{name}");
        let found = ours::run(world, Method::default(), samples).report("ours, 4 substeps of 10", &truth);
        let exact = ours::run(world, ours::to(1e-9), samples).report("ours to 1e-9", &truth);
        single::run(world, DEFAULT, samples).report("Rapier f32, default", &truth);
        double::run(world, DEFAULT, samples).report("Rapier f64, default", &truth);
        let better = double::run(world, BETTER, samples).report("Rapier f64, better", &truth);
        // Impacts with restitution come at the end of a step there, whatever its iterations: more steps are what helps.
        let finest = Setting { steps: 16, iterations: 4, ..BETTER };
        let finest = double::run(world, finest, samples).report("Rapier f64, 960 Hz", &truth);
        if !(found <= ours && exact <= ours && better.min(finest) <= rapier) {
            broken.push(format!("{name}: {found:e}, {exact:e}, {better:e}, {finest:e}"));
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}
