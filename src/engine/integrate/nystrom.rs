//! Symplectic Runge–Kutta–Nyström methods of order 4 and 6, for springs and gravity alone.
//!
//! Kicks and drifts in turn, v += b h a(x), x += a h v, symmetric in time; the coefficients are those of S. Blanes and P. C.
//! Moan, "Practical symplectic partitioned Runge–Kutta and Runge–Kutta–Nyström methods", J. Comput. Appl. Math. 142 (2002). The
//! last kick of a step is the first of the next, so a step costs 6 evaluations of the forces in order 4 and 11 in order 6. The
//! energy stays bounded. Stable up to h ω = 5.0 and 9.0; the step is cut before. Forces that depend on velocities and
//! constraints do not fit in: such islands go by Taylor series.

use super::outcome::Outcome;
use super::pace::{Pace, steps_next, steps_within};
use crate::engine::island::System;

/// Coefficients of the kicks and of the drifts between them.
struct Scheme {
    order: u32,
    kicks: &'static [f64],
    drifts: &'static [f64],
    /// Error of a step over h^(order + 1) ω^(order − 2) times the third derivative: some ten times that of a linear oscillator, 1.5e-5 and
    /// 8e-8, for what is not linear.
    constant: f64,
    /// Largest h ω in a step.
    swing: f64,
}

const B4: [f64; 3] = [0.0829844064174052, 0.396309801498368, -0.0390563049223486];
const A4: [f64; 2] = [0.245298957184271, 0.604872665711080];
const A4_3: f64 = 0.5 - (A4[0] + A4[1]);
const ORDER_4: Scheme = Scheme {
    order: 4,
    kicks: &[B4[0], B4[1], B4[2], 1.0 - 2.0 * (B4[0] + B4[1] + B4[2]), B4[2], B4[1], B4[0]],
    drifts: &[A4[0], A4[1], A4_3, A4_3, A4[1], A4[0]],
    constant: 1.5e-4,
    swing: 3.0,
};

const B6: [f64; 5] =
    [0.0414649985182624, 0.198128671918067, -0.0400061921041533, 0.0752539843015807, -0.0115113874206879];
const B6_6: f64 = 0.5 - (B6[0] + B6[1] + B6[2] + B6[3] + B6[4]);
const A6: [f64; 5] = [0.123229775946271, 0.290553797799558, -0.127049212625417, -0.246331761062075, 0.357208872795928];
const ORDER_6: Scheme = Scheme {
    order: 6,
    kicks: &[B6[0], B6[1], B6[2], B6[3], B6[4], B6_6, B6_6, B6[4], B6[3], B6[2], B6[1], B6[0]],
    drifts: &[
        A6[0],
        A6[1],
        A6[2],
        A6[3],
        A6[4],
        1.0 - 2.0 * (A6[0] + A6[1] + A6[2] + A6[3] + A6[4]),
        A6[4],
        A6[3],
        A6[2],
        A6[1],
        A6[0],
    ],
    constant: 1e-6,
    swing: 6.0,
};

/// Largest change of a spring's difference in a step, in parts of its length: beyond it its force turns farther than the stages follow.
const TURN: f64 = 0.5;
/// Most that an error counts as, in parts of what is allowed.
const MOST_EXCESS: f64 = 1e4;
/// Most steps for an accuracy, beyond what is stable.
const MOST_WITHIN: f64 = 100.0;
/// Times that the number of steps is corrected.
const MOST_CHANGES: u32 = 4;

/// How a run of equal steps ended.
enum Run {
    /// With an estimate of the local errors' sum [m].
    Done(f64),
    /// So many steps will do.
    Again(f64),
}

/// Scratch memory, by node.
#[derive(Debug, Default)]
pub(crate) struct Nystrom {
    /// Accelerations at the present positions.
    ax: Vec<f64>,
    ay: Vec<f64>,
    /// x, v, a at the start of the time, and of the step.
    start: [Vec<f64>; 6],
    before: [Vec<f64>; 6],
    load: Vec<f64>,
}

impl Nystrom {
    /// Whether an island is of the kind that these methods take.
    pub fn takes(system: &System) -> bool {
        system.unconstrained() && !system.damped()
    }

    /// Carries the island through `time` [s] with order 4 or 6, for an accuracy in about `most` steps.
    pub fn advance(&mut self, system: &mut System, time: f64, (pace, most): (Pace, f64), order: u32) -> Outcome {
        let most = most.min(MOST_WITHIN);
        let scheme = if order == 6 { &ORDER_6 } else { &ORDER_4 };
        let fresh = Outcome { order: scheme.order, ..Outcome::default() };
        let nodes = system.nodes.len();
        self.ax.resize(nodes, 0.0);
        self.ay.resize(nodes, 0.0);
        let least = match pace {
            Pace::Steps(steps) => f64::from(steps),
            Pace::Within(_) => f64::from(system.foresight.steps).clamp(1.0, most),
        };
        let swing = system.rates(&mut self.load).swing;
        let mut steps = libm::ceil(time * swing / scheme.swing).max(least);
        if !(steps <= super::MOST_STEPS) {
            return Outcome { failed: true, kept: false, ..fresh };
        }
        system.force_accelerations(&mut self.ax, &mut self.ay);
        let Self { ax, ay, start, .. } = self;
        keep(start, system, ax, ay);
        let mut changes = 0;
        loop {
            match self.run(scheme, system, (time, steps, swing), (pace, changes)) {
                Run::Done(error) => {
                    let kept = pace.keeps(error);
                    let next = match pace {
                        Pace::Steps(_) => 0,
                        Pace::Within(tolerance) => steps_next(steps, error / tolerance, f64::from(scheme.order), 0.0),
                    };
                    return Outcome { retries: changes, steps: steps as u32, error, kept, next, ..fresh };
                }
                Run::Again(more) => {
                    // What takes more is not carried well: the last run, as it comes out.
                    changes = if more > most { MOST_CHANGES } else { changes + 1 };
                    steps = more.min(most).max(steps);
                    restore(&self.start, system, &mut self.ax, &mut self.ay);
                }
            }
        }
    }

    /// So many equal steps. Ends early where the errors so far say that it takes more of them.
    fn run(
        &mut self,
        scheme: &Scheme,
        system: &mut System,
        (time, steps, swing): (f64, f64, f64),
        (pace, changes): (Pace, u32),
    ) -> Run {
        let h = time / steps;
        let mut sum = 0.0;
        for step in 0..steps as u32 {
            let Pace::Within(tolerance) = pace else {
                self.step(scheme, system, h);
                continue;
            };
            keep(&mut self.before, system, &self.ax, &self.ay);
            self.step(scheme, system, h);
            sum += self.error(scheme, system, h, swing);
            // The first step tells what the others will be like; they tell themselves whether they were.
            let expected = sum * steps / f64::from(step + 1);
            let judged = if step == 0 { expected } else { sum };
            if changes < MOST_CHANGES && !pace.keeps(judged) {
                let more = steps_within(steps, (expected / tolerance).min(MOST_EXCESS), f64::from(scheme.order));
                return Run::Again(more.unwrap_or(2.0 * steps));
            }
        }
        Run::Done(sum)
    }

    fn step(&mut self, scheme: &Scheme, system: &mut System, h: f64) {
        for (i, kick) in scheme.kicks.iter().enumerate() {
            if i > 0 {
                let (part, nodes) = (h * scheme.drifts[i - 1], &mut system.nodes);
                add(&mut nodes.x, part, &nodes.vx);
                add(&mut nodes.y, part, &nodes.vy);
                system.force_accelerations(&mut self.ax, &mut self.ay);
            }
            let nodes = &mut system.nodes;
            add(&mut nodes.vx, h * kick, &self.ax);
            add(&mut nodes.vy, h * kick, &self.ay);
        }
    }

    /// Estimate of the error of the step just taken, RMS over the nodes [m]; the island's size where a spring turns too far to
    /// tell.
    ///
    /// What a method of order p leaves out are elementary differentials, h^(p+1) ω^(p−2) times the third derivative where the fastest part
    /// swings with ω: of that part itself, and of all that moves slowly with it, whose stages are off the way that stiff springs leave
    /// free. The motion alone, however smooth, does not tell. Where springs turn faster than they swing, that is what further derivatives
    /// grow with. h² (a' − a) stands for h³ times the third derivative.
    fn error(&self, scheme: &Scheme, system: &System, h: f64, swing: f64) -> f64 {
        let nodes = &system.nodes;
        let [x, y, _, _, ax, ay] = &self.before;
        let turn = system.springs.largest_turn(nodes, x, y);
        if !(turn <= TURN) {
            return system.length;
        }
        let mut third = 0.0;
        for (before, after) in [(ax, &self.ax), (ay, &self.ay)] {
            for (before, after) in before.iter().zip(after) {
                third += (after - before) * (after - before);
            }
        }
        let growth = (0..scheme.order - 2).fold(1.0, |product, _| product * (h * swing + turn));
        scheme.constant * growth * h * h * (third / nodes.len() as f64).sqrt()
    }
}

fn keep(to: &mut [Vec<f64>; 6], system: &System, ax: &[f64], ay: &[f64]) {
    let nodes = &system.nodes;
    for (to, from) in to.iter_mut().zip([&nodes.x[..], &nodes.y, &nodes.vx, &nodes.vy, ax, ay]) {
        to.clear();
        to.extend_from_slice(from);
    }
}

fn restore(from: &[Vec<f64>; 6], system: &mut System, ax: &mut [f64], ay: &mut [f64]) {
    let nodes = &mut system.nodes;
    for (to, from) in [&mut nodes.x[..], &mut nodes.y, &mut nodes.vx, &mut nodes.vy, ax, ay].into_iter().zip(from) {
        to.copy_from_slice(from);
    }
}

fn add(to: &mut [f64], factor: f64, what: &[f64]) {
    to.iter_mut().zip(what).for_each(|(to, what)| *to += factor * what);
}
