//! Sliding and rolling on an inclined plane under Coulomb's friction, the same coefficient at rest and in motion.
//!
//! Sources: Coulomb's law; for the disc Euler's equations with the slip as the only switch (Routh, Dynamics of a System of
//! Rigid Bodies, I, § 144 ff.). A way x is counted down the slope, a turn φ in the sense in which rolling down turns it.

/// A block on a ramp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slide {
    /// Angle of the ramp with the horizontal, 0 … π/2 [rad].
    pub slope: f64,
    /// μ ≥ 0.
    pub friction: f64,
    /// [m/s²]
    pub gravity: f64,
    /// At time 0, down the slope; negative is up [m/s].
    pub velocity: f64,
}

impl Slide {
    /// Way down the slope [m] and velocity [m/s] at time `t`.
    ///
    /// Friction brakes with μ g cos θ while it moves. When it has stopped it stays if tan θ ≤ μ, and slides down otherwise.
    pub fn at(&self, t: f64) -> (f64, f64) {
        let (pull, hold) = self.forces();
        let against = if self.velocity < 0.0 { 1.0 } else { -1.0 };
        let braked = pull + against * hold;
        let moving = |v: f64, a: f64, t: f64| (t * (v + 0.5 * a * t), v + a * t);
        match self.stop_time() {
            Some(stop) if t >= stop => {
                let way = 0.5 * self.velocity * stop;
                let (after, speed) = moving(0.0, (pull - hold).max(0.0), t - stop);
                (way + after, speed)
            }
            _ => moving(self.velocity, braked, t),
        }
    }

    /// When it first stands still [s]; 0 if it starts so, `None` if it never does.
    pub fn stop_time(&self) -> Option<f64> {
        let (pull, hold) = self.forces();
        if self.velocity < 0.0 {
            Some(-self.velocity / (pull + hold))
        } else if self.velocity == 0.0 {
            Some(0.0)
        } else {
            (hold > pull).then(|| self.velocity / (hold - pull))
        }
    }

    /// g sin θ and μ g cos θ [m/s²].
    fn forces(&self) -> (f64, f64) {
        (self.gravity * libm::sin(self.slope), self.friction * self.gravity * libm::cos(self.slope))
    }
}

/// A round body on a ramp, from whatever slip it starts with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roll {
    /// [m]
    pub radius: f64,
    /// Moment of inertia in parts of m r²: ½ for a solid disc, 1 for a hoop.
    pub inertia: f64,
    /// Angle of the ramp with the horizontal, 0 … π/2 [rad].
    pub slope: f64,
    /// μ ≥ 0.
    pub friction: f64,
    /// [m/s²]
    pub gravity: f64,
    /// At time 0, down the slope [m/s].
    pub velocity: f64,
    /// Angular velocity at time 0; v/r is rolling [rad/s].
    pub omega: f64,
}

/// State of a round body on a ramp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rolling {
    /// Down the slope [m].
    pub way: f64,
    /// [m/s]
    pub velocity: f64,
    /// Turned since time 0 [rad].
    pub angle: f64,
    /// [rad/s]
    pub omega: f64,
}

impl Roll {
    /// The state at time `t`.
    ///
    /// While the surfaces slip, s = v − rω ≠ 0, friction is μ g cos θ against s and turns the body by a k-th of that, k being
    /// `inertia`. Slip that has ended stays ended if tan θ ≤ μ (1 + k)/k; then a = g sin θ/(1 + k).
    pub fn at(&self, t: f64) -> Rolling {
        let start = Rolling { way: 0.0, velocity: self.velocity, angle: 0.0, omega: self.omega };
        match self.grip_time() {
            Some(grip) if t >= grip => {
                let at_grip = self.slipping(start, self.slip_sign(), grip);
                let rest = t - grip;
                if self.can_roll() {
                    let a = self.gravity * libm::sin(self.slope) / (1.0 + self.inertia);
                    self.moved(at_grip, a, a / self.radius, rest)
                } else {
                    self.slipping(at_grip, 1.0, rest)
                }
            }
            _ => self.slipping(start, self.slip_sign(), t),
        }
    }

    /// When the slip it starts with has ended [s]; 0 if it starts rolling, `None` if it slips for ever.
    pub fn grip_time(&self) -> Option<f64> {
        let slip = self.velocity - self.radius * self.omega;
        if slip == 0.0 {
            return Some(0.0);
        }
        // Rate at which |s| shrinks.
        let closing = self.brake() * (1.0 + 1.0 / self.inertia) - self.slip_sign() * self.pull();
        (closing > 0.0).then(|| slip.abs() / closing)
    }

    /// Whether rolling, once reached, goes on.
    pub fn can_roll(&self) -> bool {
        self.pull() * self.inertia <= self.brake() * (1.0 + self.inertia)
    }

    fn slip_sign(&self) -> f64 {
        (self.velocity - self.radius * self.omega).signum()
    }

    /// g sin θ [m/s²].
    fn pull(&self) -> f64 {
        self.gravity * libm::sin(self.slope)
    }

    /// μ g cos θ [m/s²].
    fn brake(&self) -> f64 {
        self.friction * self.gravity * libm::cos(self.slope)
    }

    fn slipping(&self, from: Rolling, sign: f64, t: f64) -> Rolling {
        let turning = sign * self.brake() / (self.inertia * self.radius);
        self.moved(from, self.pull() - sign * self.brake(), turning, t)
    }

    /// Uniformly accelerated for `t`.
    fn moved(&self, from: Rolling, a: f64, turning: f64, t: f64) -> Rolling {
        Rolling {
            way: from.way + t * (from.velocity + 0.5 * a * t),
            velocity: from.velocity + a * t,
            angle: from.angle + t * (from.omega + 0.5 * turning * t),
            omega: from.omega + turning * t,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const G: f64 = 9.81;
    /// Step of the integrations that the formulas are held against [s].
    const H: f64 = 1e-5;

    #[test]
    fn a_block_slides_sticks_stops_and_turns_round_as_an_integration_does() {
        for (slope, friction, velocity) in
            [(0.5, 0.3, 0.0), (0.5, 0.3, -2.0), (0.5, 0.7, 3.0), (0.5, 0.7, -3.0), (0.0, 0.2, 1.0), (0.3, 0.0, -1.0)]
        {
            let slide = Slide { slope, friction, gravity: G, velocity };
            let (mut x, mut v) = (0.0, velocity);
            let (pull, hold) = (G * f64::sin(slope), friction * G * f64::cos(slope));
            for _ in 0..200_000 {
                // Friction takes what it can of the speed and of the pull.
                let free = v + H * pull;
                v = free - free.clamp(-H * hold, H * hold);
                x += H * v;
            }
            let (way, speed) = slide.at(200_000.0 * H);
            println!("{slope} rad, μ {friction}, {velocity} m/s: {:.1e} m off", x - way);
            // Euler's first-order error: ½ a h t, and one step at each stop.
            assert!((x - way).abs() < 1e-4 && (v - speed).abs() < 2e-4, "{x} and {way}, {v} and {speed}");
        }
    }

    #[test]
    fn a_block_stops_where_its_energy_is_used_up() {
        let slide = Slide { slope: 0.0, friction: 0.3, gravity: G, velocity: 3.0 };
        let (way, speed) = slide.at(10.0);
        assert!((way - 9.0 / (2.0 * 0.3 * G)).abs() < 1e-15 && speed == 0.0);
        let stuck = Slide { slope: 0.5, friction: 0.6, gravity: G, velocity: 0.0 };
        assert_eq!(stuck.at(10.0), (0.0, 0.0));
        let free = Slide { slope: 0.5, friction: 0.3, gravity: G, velocity: 0.0 };
        // ½ g (sin θ − μ cos θ) t²
        assert!((free.at(2.0).0 - 2.0 * G * (f64::sin(0.5) - 0.3 * f64::cos(0.5))).abs() < 1e-14);
    }

    #[test]
    fn a_disc_slips_grips_and_rolls_as_an_integration_does() {
        for (slope, friction, velocity, omega) in [
            (0.35, 0.8, 0.0, 0.0),
            (1.0, 0.2, 0.0, 0.0),
            (0.0, 0.3, 2.0, 0.0),
            (0.0, 0.3, 0.0, -30.0),
            (0.3, 0.2, -3.0, 40.0),
            (1.2, 0.3, 1.0, 60.0),
            (0.2, 0.0, 1.0, 5.0),
        ] {
            let roll = Roll { radius: 0.1, inertia: 0.5, slope, friction, gravity: G, velocity, omega };
            let (mut x, mut v, mut angle, mut turning) = (0.0, velocity, 0.0, omega);
            let (pull, hold) = (G * f64::sin(slope), friction * G * f64::cos(slope));
            for _ in 0..150_000 {
                let free = v + H * pull;
                // Ends the slip of the surface if it can: a push changes the slip by 1 + 1/k of what it does to the speed.
                let push = ((free - 0.1 * turning) / 3.0).clamp(-H * hold, H * hold);
                v = free - push;
                turning += push / (0.5 * 0.1);
                x += H * v;
                angle += H * turning;
            }
            let found = roll.at(150_000.0 * H);
            let off = (x - found.way).abs().max(0.1 * (angle - found.angle).abs());
            println!("{slope} rad, μ {friction}, {velocity} m/s, {omega} rad/s: {off:.1e} m off");
            assert!(off < 2e-4, "{off:e}");
            assert!((v - found.velocity).abs() < 4e-4 && 0.1 * (turning - found.omega).abs() < 4e-4);
        }
    }

    #[test]
    fn a_disc_rolls_with_two_thirds_of_the_pull_and_a_hoop_with_half() {
        for (inertia, part) in [(0.5, 2.0 / 3.0), (1.0, 0.5)] {
            let roll = Roll { radius: 0.2, inertia, slope: 0.35, friction: 0.8, gravity: G, velocity: 0.0, omega: 0.0 };
            let state = roll.at(2.0);
            assert!((state.way - 2.0 * part * G * f64::sin(0.35)).abs() < 1e-14);
            assert!(
                (state.velocity - 0.2 * state.omega).abs() < 1e-14 && (state.way - 0.2 * state.angle).abs() < 1e-14
            );
        }
    }

    #[test]
    fn angular_momentum_about_the_plane_is_kept_while_a_disc_on_the_flat_finds_its_grip() {
        let roll = Roll { radius: 0.1, inertia: 0.5, slope: 0.0, friction: 0.3, gravity: G, velocity: 3.0, omega: 0.0 };
        // Two thirds of the speed are left, whatever the friction.
        assert!((roll.at(5.0).velocity - 2.0).abs() < 1e-14);
        assert!((roll.grip_time().unwrap() - 3.0 / (3.0 * 0.3 * G)).abs() < 1e-15);
    }
}
