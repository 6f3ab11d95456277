//! How a family is drawn: a letter in text; a shape and a colour in a picture.

use crate::engine::{Integrator, Solver};
use crate::lab::Family;

/// The shape of a mark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A disc, or a ring if hollow.
    Circle,
    /// Its sides lie along the axes.
    Square,
    /// A square that stands on a corner.
    Diamond,
    /// A triangle that points upwards.
    Up,
    /// A triangle that points downwards.
    Down,
    /// Two bars along the axes.
    Plus,
    /// Two bars along the diagonals.
    Cross,
}

/// The letter of a family; in a diagram it is a capital on the front.
pub fn letter(family: Family) -> char {
    use Integrator::*;
    match family {
        Family::Dial => 'a',
        Family::Direct(Taylor) => 't',
        Family::Direct(EnergyMomentum) => 'm',
        Family::Direct(Rattle) => 'r',
        Family::Direct(RungeKutta4) => 'k',
        Family::Direct(Nystrom4) => 'n',
        Family::Direct(Radau3) => 'u',
        Family::Direct(Radau5) => 'd',
        Family::Direct(_) => 'y',
        Family::Substepped(SemiImplicitEuler, Solver::Pgs) => 's',
        Family::Substepped(SemiImplicitEuler, Solver::Projection) => 'e',
        Family::Substepped(VelocityVerlet, Solver::Pgs) => 'v',
        Family::Substepped(VelocityVerlet, Solver::Projection) => 'w',
        Family::Substepped(PositionVerlet, Solver::Pgs) => 'p',
        Family::Substepped(PositionVerlet, Solver::Projection) => 'q',
        Family::Substepped(_, Solver::Pgs) => 'x',
        Family::Substepped(_, Solver::Projection) => 'z',
    }
}

/// Shape, whether it is filled, and which of the colours of a picture. What is solved whole is filled, what is swept is hollow.
pub fn look(family: Family) -> (Shape, bool, usize) {
    use Integrator::*;
    match family {
        Family::Dial => (Shape::Circle, true, 0),
        Family::Direct(Taylor) => (Shape::Diamond, true, 1),
        Family::Direct(EnergyMomentum) => (Shape::Square, true, 2),
        Family::Direct(Rattle) => (Shape::Up, true, 3),
        Family::Direct(RungeKutta4) => (Shape::Down, true, 4),
        Family::Direct(Nystrom4) => (Shape::Plus, true, 5),
        Family::Direct(Radau3) => (Shape::Square, true, 6),
        Family::Direct(Radau5) => (Shape::Diamond, true, 6),
        Family::Direct(_) => (Shape::Cross, true, 5),
        Family::Substepped(integrator, solver) => {
            let shape = if solver == Solver::Pgs { Shape::Circle } else { Shape::Square };
            let colour = match integrator {
                SemiImplicitEuler => 6,
                VelocityVerlet => 4,
                PositionVerlet => 2,
                _ => 3,
            };
            (shape, false, colour)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_families_look_alike() {
        for (i, a) in Family::ALL.into_iter().enumerate() {
            for b in Family::ALL.into_iter().skip(i + 1) {
                assert_ne!(letter(a), letter(b));
                assert_ne!(look(a), look(b));
            }
        }
    }
}
