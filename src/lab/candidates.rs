//! Which settings a sweep tries, and in which order.

use super::setting::{Family, Setting};
use crate::engine::{Integrator, Solver};

/// Wanted accuracies of the dial and of the series.
const TOLERANCES: [f64; 9] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-9, 1e-11, 1e-13];
/// Those that are tried at a lower rate too.
const SLOW: [f64; 3] = [1e-3, 1e-6, 1e-9];
/// Substeps and iterations of the substep loop: few sweeps in many substeps and many in few.
const LOOPS: [(u32, u32); 11] =
    [(1, 10), (4, 1), (4, 10), (16, 1), (1, 100), (4, 40), (16, 10), (64, 1), (64, 10), (16, 100), (256, 2)];
/// Substeps of the integrators of islands.
const SUBSTEPS: [u32; 7] = [1, 2, 4, 8, 16, 32, 64];

/// Every setting that is worth a try at these rates [Hz], the most telling ones first, then each family from cheap to costly, all
/// families in turn. Without rates: 60 Hz, and a few settings at 30 and 240 Hz.
pub(super) fn candidates(families: &[Family], rates: &[f64]) -> Vec<Setting> {
    let plain = rates.is_empty();
    let mut ladders: Vec<Vec<Setting>> = families.iter().map(|family| ladder(*family, plain)).collect();
    if !plain {
        let at = |setting: Setting| rates.iter().map(move |hz| Setting { hz: *hz, ..setting });
        ladders = ladders.into_iter().map(|ladder| ladder.into_iter().flat_map(at).collect()).collect();
    }
    ladders.iter_mut().for_each(|ladder| ladder.sort_by(|a, b| a.work().total_cmp(&b.work())));
    let (mut order, mut rest) = (headlines(), Vec::new());
    let rungs = ladders.iter().map(Vec::len).max().unwrap_or(0);
    for rung in 0..rungs {
        rest.extend(ladders.iter().filter_map(|ladder| ladder.get(rung)).copied());
    }
    order.retain(|setting| rest.contains(setting));
    rest.retain(|setting| !order.contains(setting));
    order.extend(rest);
    order
}

/// What a reader wants to know first.
fn headlines() -> Vec<Setting> {
    let mut first = vec![Setting::BASELINE];
    first.extend([1e-3, 1e-6, 1e-9].map(Setting::dial));
    first.push(Setting::direct(Integrator::EnergyMomentum, 1));
    first.push(Setting::direct(Integrator::Rattle, 4));
    first.push(Setting::substepped(Integrator::SemiImplicitEuler, Solver::Projection, 4, 10));
    first.push(Setting::dial(1e-13));
    first
}

fn ladder(family: Family, with_other_rates: bool) -> Vec<Setting> {
    let other = |hz: f64, setting: Setting| with_other_rates.then_some(Setting { hz, ..setting });
    match family {
        Family::Dial => {
            // Where something touches the substeps say how well.
            let finer = |substeps| Setting { substeps: Some(substeps), ..Setting::dial(1e-6) };
            let slow = SLOW.into_iter().filter_map(|tolerance| other(30.0, Setting::dial(tolerance)));
            slow.chain(TOLERANCES.map(Setting::dial)).chain([16, 64].map(finer)).collect()
        }
        Family::Direct(Integrator::Taylor) => {
            let slow = SLOW.into_iter().filter_map(|tolerance| other(30.0, Setting::taylor(tolerance)));
            slow.chain(TOLERANCES.into_iter().map(Setting::taylor)).filter(|at| at.tolerance <= Some(1e-5)).collect()
        }
        Family::Direct(integrator) => {
            let slow = [1, 2].into_iter().filter_map(|substeps| other(30.0, Setting::direct(integrator, substeps)));
            slow.chain(SUBSTEPS.map(|substeps| Setting::direct(integrator, substeps))).collect()
        }
        Family::Substepped(integrator, solver) => {
            let with = |(substeps, iterations)| Setting::substepped(integrator, solver, substeps, iterations);
            let slow = other(30.0, with((1, 10)));
            let fast = other(240.0, with((1, 10)));
            slow.into_iter().chain(fast).chain(LOOPS.map(with)).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_starts_with_the_baseline_and_names_everything_once() {
        let all = candidates(&Family::ALL, &[]);
        assert_eq!(all[0], Setting::BASELINE);
        assert_eq!(all[1], Setting::dial(1e-3));
        for (i, setting) in all.iter().enumerate() {
            assert!(!all[..i].contains(setting), "{setting:?} twice");
            assert!(setting.method(crate::engine::Method::default()).validate().is_ok());
        }
        let of = |family: Family| all.iter().filter(|setting| setting.family == family).count();
        println!("{} settings: {:?}", all.len(), Family::ALL.map(of));
        assert!(Family::ALL.into_iter().all(|family| of(family) >= 6));
    }

    #[test]
    fn families_and_rates_can_be_chosen() {
        let some = candidates(&[Family::Dial], &[60.0, 120.0]);
        assert!(some.iter().all(|setting| setting.family == Family::Dial));
        assert_eq!(some.iter().filter(|setting| setting.hz == 120.0).count(), some.len() / 2);
    }
}
