//! The rows of CSV that a run writes.

use super::stepping::Since;
use super::watch::Seen;
use crate::engine::World;
use std::io::Write;

/// Where the rows go.
pub(super) struct Rows<'a> {
    /// A row a body: `time,id,x,y,angle,vx,vy,omega`.
    pub trajectory: Option<&'a mut dyn Write>,
    /// A row an instant: all measures, the time of a step and its local error, and what is known of the true error.
    pub measures: Option<&'a mut dyn Write>,
}

impl Rows<'_> {
    pub(super) fn headers(&mut self) -> std::io::Result<()> {
        if let Some(out) = &mut self.trajectory {
            writeln!(out, "time,id,x,y,angle,vx,vy,omega")?;
        }
        if let Some(out) = &mut self.measures {
            write!(out, "time,kinetic,potential,elastic,momentum_x,momentum_y,angular_momentum,")?;
            write!(out, "violation_max,penetration_max,contacts,step_us,local_error,")?;
            write!(out, "violation_rms,energy,energy_drift,")?;
            writeln!(out, "error_rms,error_max,error_rms_percent,error_max_percent,order,growth")?;
        }
        Ok(())
    }

    /// One instant. `{:?}` writes the fewest digits that are read back to the same bits.
    pub(super) fn write(&mut self, world: &World, seen: &Seen, since: Since) -> std::io::Result<()> {
        if let Some(out) = &mut self.trajectory {
            for (id, body) in world.bodies().iter() {
                let (p, v, spin) = (body.position, body.velocity, body.spin.unwrap_or_default());
                let (time, angle, omega) = (world.time(), spin.angle, spin.omega);
                writeln!(out, "{time:?},{id},{:?},{:?},{angle:?},{:?},{:?},{omega:?}", p.x, p.y, v.x, v.y)?;
            }
        }
        if let Some(out) = &mut self.measures {
            let m = &seen.measures;
            let (time, momentum, contacts) = (m.time, m.momentum, m.contacts);
            write!(out, "{time:?},{:?},{:?},{:?},", m.kinetic, m.potential, m.elastic)?;
            write!(out, "{:?},{:?},{:?},", momentum.x, momentum.y, m.angular_momentum)?;
            let Since { step_us, local_error } = since;
            write!(out, "{:?},{:?},{contacts},{step_us:?},", m.violation_max, m.penetration_max)?;
            if local_error.is_finite() {
                write!(out, "{local_error:?}")?;
            }
            write!(out, ",")?;
            write!(out, "{:?},{:?},{:?}", m.violation_rms, m.total_energy(), seen.energy_drift)?;
            let (rms, max) = (seen.error.map(|error| error.rms), seen.error.map(|error| error.max));
            let percent = |error: Option<f64>| error.map(|error| 100.0 * error / seen.length);
            for value in [rms, max, percent(rms), percent(max), seen.order, seen.growth] {
                match value {
                    Some(value) => write!(out, ",{value:?}")?,
                    None => write!(out, ",")?,
                }
            }
            writeln!(out)?;
        }
        Ok(())
    }
}
