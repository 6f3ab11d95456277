//! Free flight, with and without drag.

use crate::engine::DVec2;

/// Where a body without drag is at time `t` [m]: p + v t + ½ g t².
pub fn projectile(position: DVec2, velocity: DVec2, gravity: DVec2, t: f64) -> DVec2 {
    position + t * (velocity + 0.5 * t * gravity)
}

/// Position [m] and velocity [m/s] under gravity and a drag that takes away the part `drag` [1/s] of the velocity every second:
/// v̇ = g − drag v, hence v = u + (v₀ − u) e^(−drag t) with the terminal velocity u = g/drag. No drag makes a projectile.
pub fn fall_with_drag(position: DVec2, velocity: DVec2, gravity: DVec2, drag: f64, t: f64) -> (DVec2, DVec2) {
    if drag == 0.0 {
        return (projectile(position, velocity, gravity, t), velocity + t * gravity);
    }
    let terminal = gravity / drag;
    // 1 − e^(−drag t), without cancellation for small drag
    let lost = -libm::expm1(-drag * t);
    let position = position + terminal * t + (velocity - terminal) * (lost / drag);
    (position, velocity + (terminal - velocity) * lost)
}
