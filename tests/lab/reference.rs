//! Refined references: what they say of themselves covers what they are wrong by.

use std::sync::atomic::AtomicBool;
use std::time::Duration;
use tautline::engine::Method;
use tautline::lab::{ErrorKind, Lost, NoReference, Reference, Source, refine, scene_length};
use tautline::measure::error_against;
use tautline::scene;
use tautline::truth;

/// Enough for every level on a loaded machine.
const PLENTY: Duration = Duration::from_secs(20);

fn refined(world: &tautline::engine::World, seconds: f64, length: f64) -> Result<Reference, NoReference> {
    refine(world, Method::default(), seconds, length, PLENTY, &AtomicBool::new(false), &mut |_| {})
}

#[test]
fn the_stated_convergence_covers_the_true_error_on_stored_truths() {
    for name in
        ["truth/pendulum", "truth/double_pendulum", "truth/rope", "truth/bridge", "truth/stiff_chain", "truth/cloth"]
    {
        let setup = scene::open(name).unwrap();
        let exact = truth::stored(name).unwrap();
        let seconds = exact.times.last().unwrap().min(2.0);
        let reference = refined(&setup.world, seconds, exact.length).unwrap();
        let count = reference.positions.len();
        assert_eq!(count, (seconds * 60.0).round() as usize + 1, "{name} is known to its end");
        let error = error_against(&exact.positions[..count], &reference.positions, exact.length).unwrap();
        println!("{name}: {}, known to {:.1e}, true error {error:.1e}", reference.label(), reference.known_to);
        assert!(reference.source == Source::Refined && reference.lost.is_none());
        // Below 1e-15 the exact motion's own rounding to doubles shows.
        assert!(error <= reference.known_to.max(1e-15), "{name}: {error:e} beyond {:e}", reference.known_to);
        assert!(reference.known_to < 1e-10, "{name} is smooth: {:e}", reference.known_to);
    }
}

#[test]
fn a_chaotic_scene_says_from_when_on_nothing_is_known() {
    let setup = scene::open("truth/double_pendulum").unwrap();
    let reference = refined(&setup.world, 60.0, 2.0).unwrap();
    println!("{}", reference.label());
    let Some(Lost::Chaotic(after)) = reference.lost else { panic!("{:?}", reference.lost) };
    // Errors of 1e-14 grow by a factor of ten every second or two: lost after some tens of seconds, not at once.
    assert!(after > 10.0 && after < 60.0, "{after}");
    assert!(reference.label().contains(&format!("no reference: chaotic after {after:.1} s")), "{}", reference.label());
    // As far as it goes it is right, as a solver says that shares nothing with the engine.
    let exact = truth::converge(&setup.world, reference.seconds(), 2.0).unwrap();
    let error = error_against(&exact.positions, &reference.positions, 2.0).unwrap();
    println!("until {:.2} s known to {:.1e}, true error {error:.1e}", reference.seconds(), reference.known_to);
    assert!(error <= reference.known_to, "{error:e}");
}

#[test]
fn what_is_lost_too_early_is_no_reference() {
    // A hundred discs fall into a heap: every touch multiplies what the one before was off by.
    let text = r#"(version: 1, walls: [Box(min: (-3, -1), max: (3, 0))],
        generators: [Pile(count: 100, min: (-1, 0.5), max: (1, 8), radius: (0.05, 0.1))])"#;
    let setup = scene::parse("heap", text).unwrap();
    let length = scene_length(&setup.world);
    let cancel = AtomicBool::new(false);
    let found = refine(&setup.world, setup.method, 8.0, length, Duration::from_secs(4), &cancel, &mut |_| {});
    println!("{}", found.as_ref().map_or_else(|none| none.to_string(), Reference::label));
    let after = match found {
        Err(NoReference::Lost(Lost::Chaotic(after) | Lost::NotConverged(after))) => after,
        Ok(Reference { lost: Some(Lost::Chaotic(after) | Lost::NotConverged(after)), .. }) => after,
        other => panic!("{other:?}"),
    };
    // They fall freely for 0.3 s at least.
    assert!(after > 0.1 && after < 8.0, "{after}");
}

#[test]
fn refining_can_be_cancelled_and_tells_how_far_it_is() {
    let setup = scene::open("truth/rope").unwrap();
    let cancel = AtomicBool::new(false);
    let mut told = Vec::new();
    let found = refine(&setup.world, setup.method, 1.5, 5.0, PLENTY, &cancel, &mut |report| {
        told.push(report);
        if report.level == 1 {
            cancel.store(true, std::sync::atomic::Ordering::Relaxed);
        }
    });
    assert_eq!(found, Err(NoReference::Cancelled));
    // A level of 90 samples, then the one at whose first sample it was cancelled.
    assert_eq!((told.len(), told[89].part, told[90].level), (91, 1.0, 1));
    assert_eq!(told[90].agreement, None);
}

#[test]
fn what_does_not_fit_is_refused_with_advice() {
    let setup = scene::open("pile").unwrap();
    let cancel = AtomicBool::new(false);
    let too_large = refine(&setup.world, setup.method, 1e4, 1.0, PLENTY, &cancel, &mut |_| {});
    assert!(too_large.unwrap_err().to_string().contains("compare over fewer seconds"));
    let too_slow = refine(&setup.world, setup.method, 10.0, 1.0, Duration::from_millis(1), &cancel, &mut |_| {});
    assert!(too_slow.unwrap_err().to_string().contains("give more time"));
}

#[test]
fn known_references_come_from_the_program() {
    let rope = scene::open("truth/rope").unwrap();
    let reference = Reference::known(&rope).unwrap();
    assert_eq!((reference.kind(), reference.label().as_str()), (ErrorKind::Stored, "stored truth"));
    assert_eq!(reference.seconds(), 1.5);
    assert_eq!(reference.clone().until(0.5).positions.len(), 31);
    // Errors are never told below what the reference is known to.
    let own = Reference { known_to: 1e-7, ..reference.clone() };
    assert_eq!(own.error(&reference.positions, 1), Some(1e-7));
    assert_eq!(Reference::known(&scene::open("bridge").unwrap()), None);
}
