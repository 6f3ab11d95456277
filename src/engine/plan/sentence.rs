//! The plan in words: what was decided and why, in one sentence for the user.

use super::{Carrier, FewPlan, IslandPlan, Plan};
use crate::engine::body::Motion;
use crate::engine::constraint::Kind;
use crate::engine::impact::MOST_TOGETHER;
use crate::engine::{Integrator, LinearSolver, Method, World};
use std::fmt::Write;

impl Plan {
    /// What carries how many islands.
    fn describe_islands(&self, sentence: &mut String, method: &Method) {
        let mut first = true;
        let mut item = |count: usize, how: std::fmt::Arguments| {
            if count > 0 {
                let _ = write!(sentence, "{}{} {how}", if first { "" } else { ", " }, plural(count, "island"));
                first = false;
            }
        };
        let count = |which: &dyn Fn(&IslandPlan) -> bool| self.islands.iter().filter(|island| which(island)).count();
        let cheapest = |island: &IslandPlan| island.carrier == Carrier::Cheapest;
        item(
            count(&|island| cheapest(island) && island.turning == 0),
            format_args!("by the cheapest method within {:.0e}", method.accuracy),
        );
        let rattle =
            |island: &IslandPlan| island.turning > 0 && !island.damped && !island.ropes && island.second_order();
        item(
            count(&|island| cheapest(island) && rattle(island)),
            format_args!("by RATTLE within {:.0e}, Taylor series where it is stiff", method.accuracy),
        );
        item(
            count(&|island| cheapest(island) && island.turning > 0 && !rattle(island)),
            format_args!("by Taylor series to {:.0e}", method.accuracy),
        );
        for integrator in Integrator::ALL {
            let count = count(&|island| island.carrier == Carrier::ByHand(integrator));
            if integrator == Integrator::Taylor {
                item(count, format_args!("by Taylor series to {:.0e}", method.accuracy));
            } else {
                let steps = plural(method.substeps as usize, "substep");
                item(count, format_args!("by {}, {steps} a step", spoken(integrator)));
            }
        }
        sentence.push_str(&self.describe_linear(method));
        if self.islands.iter().any(|island| island.guarded) {
            sentence.push_str(" while nothing is near");
        }
        let turning: usize = self.islands.iter().map(|island| island.turning).sum();
        if turning > 0 {
            let _ = write!(sentence, ", {} off a centre", plural(turning, "anchor"));
        }
    }

    /// What solves the islands' rows.
    fn describe_linear(&self, method: &Method) -> String {
        // The midpoint rule has a Newton matrix of its own.
        let takes = |island: &&IslandPlan| island.carrier != Carrier::ByHand(Integrator::EnergyMomentum);
        let with = |linear| self.islands.iter().filter(takes).filter(move |island| island.linear.0 == linear).count();
        if method.linear == LinearSolver::SparseLdl || with(method.linear) == 0 && with(LinearSolver::SparseLdl) == 0 {
            return ", solved directly".to_owned();
        }
        let mut text = format!(", solved by {}", method.linear.name());
        if method.linear.is_iterative() {
            text += &format!(" in at most {}", plural(method.iterations as usize, "sweep"));
        }
        if with(LinearSolver::SparseLdl) > 0 {
            let islands = plural(with(LinearSolver::SparseLdl), "island");
            text += &format!(" ({islands} of more than {} rows by sparse LDL)", LinearSolver::MOST_DENSE);
        }
        text
    }

    /// How free bodies are carried, and which of them not.
    fn describe_few(&self, world: &World, few: &FewPlan, sentence: &mut String) {
        let free = few.bodies.len();
        let bodies = if free == 1 { "1 free body".to_string() } else { format!("{free} free bodies") };
        let _ = write!(sentence, "; {bodies} from impact to impact in closed form, contact forces solved directly");
        let moves_otherwise = |body: u32| {
            let i = body as usize;
            let others = few.bodies.binary_search(&body).is_err() && world.bodies.motion[i] != Motion::Static;
            others && world.bodies.is_solid(i)
        };
        if free > MOST_TOGETHER {
            let _ = write!(sentence, ", heaps of more than {MOST_TOGETHER} through the substeps");
        }
        if (0..world.bodies.len() as u32).any(moves_otherwise) {
            sentence.push_str(", those near what moves otherwise through the substeps");
        }
    }

    /// What was decided and why for the world and the method that it was derived from, in one sentence for the user.
    /// O(constraints).
    pub fn sentence(&self, world: &World, method: &Method) -> String {
        let mut parts = Vec::new();
        let counts = [
            ("rod", count(world, |kind| matches!(kind, Kind::Rod { .. }))),
            ("rope", count(world, |kind| matches!(kind, Kind::Rope { .. }))),
            ("pin", count(world, |kind| matches!(kind, Kind::Pin))),
        ];
        for (name, number) in counts.into_iter().filter(|(_, number)| *number > 0) {
            parts.push(plural(number, name));
        }
        let stiff = self.joints.iter().filter(|joint| joint.form.stiffness.is_finite()).count();
        if stiff > 0 {
            let as_rows = if stiff == 1 { "a row" } else { "rows" };
            let dies = if stiff == 1 { "its vibration dies away" } else { "their vibration dies away" };
            parts.push(format!("{} as {as_rows} (too stiff for the substep: {dies})", plural(stiff, "spring")));
        }
        if !self.springs.is_empty() {
            let as_forces = if self.springs.len() == 1 { "a force" } else { "forces" };
            parts.push(format!("{} as {as_forces}", plural(self.springs.len(), "spring")));
        }
        if parts.is_empty() {
            parts.push("No constraints".to_string());
        }
        let mut sentence = parts.join(", ");
        if !self.islands.is_empty() {
            sentence.push_str("; ");
            self.describe_islands(&mut sentence, method);
        }
        if let Some(few) = &self.few {
            self.describe_few(world, few, &mut sentence);
        }
        if (method.automatic || method.integrator.is_direct()) && self.rest {
            let bodies = (0..world.bodies.len()).filter(|i| !self.in_island[*i] && world.bodies.inverse_mass[*i] > 0.0);
            let _ = match bodies.count() {
                0 => Ok(()),
                1 => sentence.write_str("; 1 body can touch and goes through the substeps"),
                n => write!(sentence, "; {n} bodies can touch and go through the substeps"),
            };
        }
        let turns = self.spin || self.islands.iter().any(|island| island.turning > 0);
        sentence.push_str(if turns { "; rotations" } else { "; particles only" });
        sentence.push_str(match (self.contacts, self.restitution) {
            _ if self.few.is_some() => ", the next impact is the first root of a gap",
            (false, _) => ", nothing can touch: no broad phase",
            (true, false) => ", contacts from a sorted grid",
            (true, true) => ", contacts from a sorted grid, impacts with restitution",
        });
        let solver = match (self.rows, self.contacts) {
            (0, false) => "nothing to solve".to_string(),
            _ => format!("{}, {}", method.solver.name(), plural(self.rows, "row")),
        };
        if self.rest {
            let _ = write!(sentence, "; {solver}; {}.", self.integrator.name());
        } else {
            sentence.push('.');
        }
        sentence
    }
}

/// The name of an integrator of islands within a sentence.
fn spoken(integrator: Integrator) -> &'static str {
    match integrator {
        Integrator::Taylor => "Taylor series",
        Integrator::EnergyMomentum => "the energy–momentum midpoint rule",
        Integrator::RungeKutta4 => "Runge–Kutta of order 4",
        Integrator::Nystrom4 => "symplectic Nyström of order 4",
        Integrator::Nystrom6 => "symplectic Nyström of order 6",
        Integrator::Radau3 => "Radau's method of 3 stages",
        Integrator::Radau5 => "Radau's method of 5 stages",
        _ => integrator.name(),
    }
}

fn count(world: &World, which: impl Fn(&Kind) -> bool) -> usize {
    world.constraints.kind.iter().filter(|kind| which(kind)).count()
}

fn plural(number: usize, name: &str) -> String {
    if number == 1 { format!("1 {name}") } else { format!("{number} {name}s") }
}
