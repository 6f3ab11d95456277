//! Converged trajectories inside the program, and the bytes they are kept in.
//!
//! All numbers are little-endian. A header: the eight letters `TAUTRUTH`, the version (u32, 1), the number of bodies (u32),
//! the number of samples (u32), samples a second (u32), the length [m] and the agreement (f64). Then a byte for each body, 1 if
//! it moves; the position of each body at time 0 (two f64); and for every later sample the positions of those that move.

use super::{SAMPLES_PER_SECOND, Trajectory};
use crate::engine::DVec2;

const MAGIC: &[u8; 8] = b"TAUTRUTH";
const VERSION: u32 = 1;

/// Why bytes are no trajectory.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StoreError {
    /// The bytes do not begin as those of this version do.
    #[error("not a stored trajectory, or one of another version: write it anew with `tautline truth`")]
    Unknown,
    /// The beginning is right, but what follows is too short or too long.
    #[error("a stored trajectory that is cut short or damaged: write it anew with `tautline truth`")]
    Damaged,
}

/// The bytes of a trajectory that is sampled at [`SAMPLES_PER_SECOND`] from 0 on.
pub fn to_bytes(trajectory: &Trajectory) -> Vec<u8> {
    let start = trajectory.positions.first().map_or(&[][..], Vec::as_slice);
    let moves = |i: usize| trajectory.positions.iter().any(|sample| sample[i] != start[i]);
    let mut moves: Vec<bool> = (0..start.len()).map(moves).collect();
    if !moves.contains(&true) {
        // Some bytes a sample, so that a reader can tell a long rest from a damaged count.
        moves.fill(true);
    }
    let mut bytes = MAGIC.to_vec();
    let counts = [VERSION, start.len() as u32, trajectory.positions.len() as u32, SAMPLES_PER_SECOND];
    counts.iter().for_each(|count| bytes.extend(count.to_le_bytes()));
    [trajectory.length, trajectory.agreement].iter().for_each(|value| bytes.extend(value.to_le_bytes()));
    bytes.extend(moves.iter().map(|&moves| u8::from(moves)));
    for (k, sample) in trajectory.positions.iter().enumerate() {
        for (point, _) in sample.iter().zip(&moves).filter(|(_, moves)| k == 0 || **moves) {
            [point.x, point.y].iter().for_each(|value| bytes.extend(value.to_le_bytes()));
        }
    }
    bytes
}

/// The trajectory in `bytes`.
pub fn from_bytes(bytes: &[u8]) -> Result<Trajectory, StoreError> {
    let mut reader = Reader { bytes };
    if reader.take(MAGIC.len()) != Ok(MAGIC) || reader.count()? != VERSION {
        return Err(StoreError::Unknown);
    }
    let [bodies, samples] = [reader.count()? as usize, reader.count()? as usize];
    let rate = f64::from(reader.count()?);
    let [length, agreement] = [reader.number()?, reader.number()?];
    let moves: Vec<bool> = reader.take(bodies)?.iter().map(|&byte| byte != 0).collect();
    let later = samples.saturating_sub(1).saturating_mul(moves.iter().filter(|moves| **moves).count());
    let bytes_due = later.saturating_add(bodies * samples.min(1)).saturating_mul(2 * size_of::<f64>());
    if reader.bytes.len() != bytes_due || (later == 0 && samples > 1) {
        return Err(StoreError::Damaged);
    }
    let mut positions: Vec<Vec<DVec2>> = Vec::with_capacity(samples);
    for k in 0..samples {
        let mut sample = positions.first().cloned().unwrap_or_default();
        sample.resize(bodies, DVec2::ZERO);
        for (point, _) in sample.iter_mut().zip(&moves).filter(|(_, moves)| k == 0 || **moves) {
            *point = DVec2::new(reader.number()?, reader.number()?);
        }
        positions.push(sample);
    }
    let times = (0..samples).map(|k| k as f64 / rate).collect();
    Ok(Trajectory { times, positions, length, agreement })
}

struct Reader<'a> {
    bytes: &'a [u8],
}

impl<'a> Reader<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8], StoreError> {
        let (taken, rest) = self.bytes.split_at_checked(count).ok_or(StoreError::Damaged)?;
        self.bytes = rest;
        Ok(taken)
    }

    fn count(&mut self) -> Result<u32, StoreError> {
        let bytes = self.take(4)?.try_into().map_err(|_| StoreError::Damaged)?;
        Ok(u32::from_le_bytes(bytes))
    }

    fn number(&mut self) -> Result<f64, StoreError> {
        let bytes = self.take(8)?.try_into().map_err(|_| StoreError::Damaged)?;
        Ok(f64::from_le_bytes(bytes))
    }
}

macro_rules! stored {
    ($($name:literal,)*) => {
        &[$(($name, include_bytes!(concat!("../../scenes/", $name, ".truth"))),)*]
    };
}

/// Scenes with a stored truth, by the names under which [`crate::scene::open`] finds them.
const STORED: &[(&str, &[u8])] = stored! {
    "truth/pendulum", "truth/double_pendulum", "truth/rope", "truth/heavy_rope", "truth/bridge", "truth/cloth",
    "truth/stiff_chain", "truth/stiff_chain_1e4", "truth/rigid_net",
};

/// The converged trajectory of a shipped scene such as "truth/rope"; `None` for a scene that has none.
pub fn stored(name: &str) -> Option<Trajectory> {
    let (_, bytes) = STORED.iter().find(|(known, _)| *known == name)?;
    from_bytes(bytes).ok()
}
