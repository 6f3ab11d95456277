//! Which ropes are in force at an instant: the active set.

use super::System;

/// A rope closer to its length than this part of L² counts as taut.
const TIGHT: f64 = 1e-12;
/// Ends that approach slower than this part of the fastest node's speed may only seem to, by round-off.
const STILL: f64 = 1e-9;
/// Most changes of the ropes in force at one instant, per rope.
const MOST_CHANGES: usize = 8;

/// The first two derivatives of ½ |d|² by time, in any unit of time, and the size of what the second is the sum of.
pub(crate) struct Stretching {
    pub rate: f64,
    pub growth: f64,
    pub size: f64,
}

impl Stretching {
    /// Of d, ḋ and d̈.
    pub fn new([dx, dy]: [f64; 2], [vx, vy]: [f64; 2], [ax, ay]: [f64; 2]) -> Self {
        let (square, along) = (vx * vx + vy * vy, [dx * ax, dy * ay]);
        Stretching {
            rate: dx * vx + dy * vy,
            growth: square + along[0] + along[1],
            size: square + along[0].abs() + along[1].abs(),
        }
    }
}

impl System {
    fn ropes(&self) -> std::ops::Range<usize> {
        self.rods.first_rope..self.rods.a.len()
    }

    /// Factors at the present positions; an edit's positions and velocities are projected onto the constraints.
    /// Returns whether there is a position that meets them.
    pub fn meet_constraints(&mut self) -> bool {
        if self.unconstrained() {
            return true;
        }
        self.tighten();
        self.factor();
        if self.position_error() > TIGHT && !self.project_positions() {
            return false;
        }
        self.settle_velocities();
        true
    }

    /// Takes those ropes in force that have reached their length and do not come together. What it decides follows from
    /// positions and velocities alone; a rope that it holds wrongly would push, and is let go for that.
    fn tighten(&mut self) {
        let speed = self.nodes.fastest();
        for r in self.ropes() {
            let (a, b) = (self.rods.a[r] as usize, self.rods.b[r] as usize);
            let nodes = &self.nodes;
            let (dx, dy) = (nodes.x[b] - nodes.x[a], nodes.y[b] - nodes.y[a]);
            let square = self.rods.square[r];
            let tight = dx * dx + dy * dy >= square * (1.0 - 2.0 * TIGHT);
            let parting = dx * (nodes.vx[b] - nodes.vx[a]) + dy * (nodes.vy[b] - nodes.vy[a]);
            self.rods.held[r] = tight && parting >= -STILL * speed * square.sqrt();
        }
    }

    /// Projects the velocities as an inelastic hit of all ropes at their length at once would: none pushes, and none stretches.
    pub fn settle_velocities(&mut self) {
        let speed = self.nodes.fastest();
        for left in (0..=self.most_changes()).rev() {
            self.velocity_error();
            self.matrix.solve(&mut self.rhs);
            let pushes = |r: &usize| {
                let noise = 1e-12 * speed / self.rods.square[*r].sqrt();
                self.rods.held[*r] && self.rhs[*r] * self.mobility(*r) > noise
            };
            if let Some(first) = self.ropes().find(pushes).filter(|_| left > 0) {
                self.change(first);
                self.factor();
                continue;
            }
            self.push_velocities();
            let stretches = |r: &usize| self.may_tighten(*r) && self.parting(*r) > STILL * speed * self.rods.length[*r];
            let Some(first) = self.ropes().find(stretches).filter(|_| left > 0) else { break };
            self.rhs.iter_mut().for_each(|impulse| *impulse = -*impulse);
            self.push_velocities();
            self.change(first);
            self.factor();
        }
    }

    /// Takes a rope in that has reached its length, with the speed away that would stretch it.
    pub fn take_in(&mut self, rope: usize) {
        self.rods.held[rope] = true;
        self.factor();
        // The end of the step has moved it a little since.
        if self.position_error() > TIGHT && self.project_positions() {
            self.factor();
        }
        self.settle_velocities();
    }

    /// Puts ropes back to their length that are not in force, but longer by more than `tight` in parts of L²; returns whether that
    /// could be done.
    pub(super) fn shorten_ropes(&mut self, tight: f64) -> bool {
        let rods = &self.rods;
        let too_long = |r: &usize| {
            let square = self.dx[*r] * self.dx[*r] + self.dy[*r] * self.dy[*r];
            !rods.held[*r] && square > rods.square[*r] * (1.0 + 2.0 * tight)
        };
        let mut long = std::mem::take(&mut self.long);
        long.clear();
        long.extend(self.ropes().filter(too_long));
        let mut done = true;
        if !long.is_empty() {
            long.iter().for_each(|r| self.rods.held[*r] = true);
            done = self.project_positions();
            long.iter().for_each(|r| self.rods.held[*r] = false);
            self.factor();
        }
        self.long = long;
        done
    }

    /// Lets go of the rope that pushes hardest with these multipliers, or, if none does, takes in the one at its length that
    /// stretches most; returns whether there was one. The first two derivatives of ½ |d|² of a rope are `motion`.
    pub fn choose_rope(&mut self, lambda: &[f64], motion: impl Fn(&System, usize) -> Stretching) -> bool {
        let mut worst = (0.0, None);
        for r in self.ropes().filter(|r| self.rods.held[*r]) {
            if lambda[r] > worst.0 {
                worst = (lambda[r], Some(r));
            }
        }
        if worst.1.is_none() {
            for r in self.ropes().filter(|r| self.may_tighten(*r)) {
                let Stretching { rate, growth, size } = motion(self, r);
                // What comes back before it has left is at rest.
                let still = rate * rate <= 2.0 * TIGHT * self.rods.square[r] * growth;
                if growth > STILL * size && growth > worst.0 && still {
                    worst = (growth, Some(r));
                }
            }
        }
        worst.1.inspect(|r| self.change(*r)).is_some()
    }

    /// Changes of the ropes in force at one instant after which the choice is left as it is: letting go and taking in ends after
    /// few, but nothing says that it must.
    pub fn most_changes(&self) -> usize {
        MOST_CHANGES * self.ropes().len()
    }

    fn change(&mut self, r: usize) {
        self.rods.held[r] = !self.rods.held[r];
        self.rods.lambda[r] = 0.0;
    }

    /// Whether the rope is not in force, but at its length.
    fn may_tighten(&self, r: usize) -> bool {
        let square = self.dx[r] * self.dx[r] + self.dy[r] * self.dy[r];
        !self.rods.held[r] && square >= self.rods.square[r] * (1.0 - 2.0 * TIGHT)
    }

    /// d · ḋ of a rope [m²/s].
    fn parting(&self, r: usize) -> f64 {
        let (a, b, nodes) = (self.rods.a[r] as usize, self.rods.b[r] as usize, &self.nodes);
        self.dx[r] * (nodes.vx[b] - nodes.vx[a]) + self.dy[r] * (nodes.vy[b] - nodes.vy[a])
    }
}
