//! A ball that bounces on a plane, with the times of its impacts, to where it comes to rest.
//!
//! Every flight is a parabola; an impact turns the speed u into e u (Newton's law of impact). The first impact comes at
//! t₁ = (v₀ + u)/g with u² = v₀² + 2 g h₀; the flight after impact k lasts 2 u eᵏ/g, so that for e < 1 infinitely many impacts
//! end at t₁ + 2 u e/(g (1 − e)), and the ball lies still from then on (a geometric series; Zeno's paradox).

use libm::{expm1, log1p, pow};

/// A ball above a plane. Heights are those of its lowest point, along the plane's normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BouncingBall {
    /// At time 0, ≥ 0 [m].
    pub height: f64,
    /// At time 0, away from the plane [m/s].
    pub velocity: f64,
    /// Towards the plane, > 0 [m/s²].
    pub gravity: f64,
    /// e, 0 … 1.
    pub restitution: f64,
}

/// Where a bouncing ball is in its course.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flight {
    /// [m]
    pub height: f64,
    /// Away from the plane [m/s]; just after the impact where the time is that of one.
    pub velocity: f64,
    /// Impacts so far; `None` once it rests, after infinitely many (for e = 0: after one).
    pub impacts: Option<u64>,
}

impl BouncingBall {
    /// Height [m] and velocity [m/s] at time `t` ≥ 0.
    pub fn at(&self, t: f64) -> Flight {
        if t < self.first_impact() {
            let height = self.height + t * (self.velocity - 0.5 * self.gravity * t);
            return Flight { height: height.max(0.0), velocity: self.velocity - self.gravity * t, impacts: Some(0) };
        }
        if !(t < self.rest_time()) {
            return Flight { height: 0.0, velocity: 0.0, impacts: None };
        }
        let impacts = self.impacts_before(t);
        let since = t - self.impact_time(impacts);
        let velocity = self.speed_after(impacts);
        let height = since * (velocity - 0.5 * self.gravity * since);
        Flight { height: height.max(0.0), velocity: velocity - self.gravity * since, impacts: Some(impacts) }
    }

    /// Speed at which it first reaches the plane [m/s].
    pub fn impact_speed(&self) -> f64 {
        (self.velocity * self.velocity + 2.0 * self.gravity * self.height).sqrt()
    }

    /// Time of impact `count`, from 1 [s].
    pub fn impact_time(&self, count: u64) -> f64 {
        self.first_impact() + 2.0 * self.impact_speed() / self.gravity * self.powers(count.saturating_sub(1))
    }

    /// Speed away from the plane after impact `count`, from 1 [m/s].
    pub fn speed_after(&self, count: u64) -> f64 {
        self.impact_speed() * pow(self.restitution, count as f64)
    }

    /// Height of the flight after impact `count`, from 1 [m].
    pub fn apex_after(&self, count: u64) -> f64 {
        let speed = self.speed_after(count);
        0.5 * speed * speed / self.gravity
    }

    /// When it comes to rest [s]; infinite for e = 1 unless it lay still from the start.
    pub fn rest_time(&self) -> f64 {
        let (u, e) = (self.impact_speed(), self.restitution);
        if u == 0.0 { 0.0 } else { self.first_impact() + 2.0 * u / self.gravity * (e / (1.0 - e)) }
    }

    fn first_impact(&self) -> f64 {
        let u = self.impact_speed();
        // Of the two roots the later one, in the form that does not cancel.
        if self.velocity >= 0.0 { (self.velocity + u) / self.gravity } else { 2.0 * self.height / (u - self.velocity) }
    }

    /// e + e² + … + eⁿ.
    fn powers(&self, n: u64) -> f64 {
        let e = self.restitution;
        if e == 1.0 {
            n as f64
        } else if e == 0.0 {
            0.0
        } else {
            e / (1.0 - e) * -expm1(n as f64 * log1p(e - 1.0))
        }
    }

    /// Impacts up to `t`, which is between the first and the time of rest.
    fn impacts_before(&self, t: f64) -> u64 {
        let (u, e) = (self.impact_speed(), self.restitution);
        // What is left of the series after k impacts is its eᵏ-th part.
        let flights = 0.5 * self.gravity * (t - self.first_impact()) / u;
        let guess = if e == 1.0 { flights } else { log1p(-flights * (1.0 - e) / e) / log1p(e - 1.0) };
        let mut count = 1 + guess.max(0.0) as u64;
        // Rounding of the logarithms leaves the guess one off at most, near an impact.
        while count > 1 && self.impact_time(count) > t {
            count -= 1;
        }
        while self.impact_time(count + 1) <= t && self.impact_time(count + 1) > self.impact_time(count) {
            count += 1;
        }
        count
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dropped(height: f64, restitution: f64) -> BouncingBall {
        BouncingBall { height, velocity: 0.0, gravity: 10.0, restitution }
    }

    /// Impact by impact, each flight by its own parabola: the definition, without the sums of the formula.
    fn event_by_event(ball: &BouncingBall, t: f64) -> (f64, f64) {
        let (mut now, mut height, mut velocity) = (0.0, ball.height, ball.velocity);
        loop {
            let lands = (velocity + (velocity * velocity + 2.0 * ball.gravity * height).sqrt()) / ball.gravity;
            if now + lands > t {
                let s = t - now;
                return (height + s * (velocity - 0.5 * ball.gravity * s), velocity - ball.gravity * s);
            }
            now += lands;
            height = 0.0;
            velocity = ball.restitution * (ball.gravity * lands - velocity);
        }
    }

    #[test]
    fn it_is_where_flight_after_flight_leads() {
        let mut worst: f64 = 0.0;
        for restitution in [0.3, 0.8, 0.999, 1.0] {
            for (height, velocity) in [(1.0, 0.0), (0.0, 3.0), (2.0, -4.0), (0.5, 2.0)] {
                let ball = BouncingBall { height, velocity, ..dropped(0.0, restitution) };
                let end = ball.rest_time().min(20.0);
                // Up to an instant before rest, which the loop would never reach.
                for i in 0..1000 {
                    let t = 0.999 * end * f64::from(i) / 1000.0;
                    let (expected, found) = (event_by_event(&ball, t), ball.at(t));
                    worst = worst.max((found.height - expected.0).abs());
                    assert!(found.height >= 0.0 && found.impacts.is_some());
                }
            }
        }
        println!("{worst:.1e} m");
        // Some dozens of flights, each rounding times up to 20 s by 4e-15 at speeds up to 6 m/s.
        assert!(worst < 1e-11, "{worst:e}");
    }

    #[test]
    fn impacts_come_at_the_times_of_the_series_and_end_in_rest() {
        let ball = dropped(1.25, 0.5);
        // Falls for 0.5 s to 5 m/s; flights of 0.5, 0.25, … s, 1 s in all.
        assert_eq!([1, 2, 3].map(|k| ball.impact_time(k)), [0.5, 1.0, 1.25]);
        assert_eq!(ball.rest_time(), 1.5);
        assert_eq!((ball.speed_after(1), ball.apex_after(1)), (2.5, 0.3125));
        assert_eq!(ball.at(1.25).impacts, Some(3));
        assert!(ball.at(1.5 - 1e-6).height < 1e-11 && ball.at(1.5 - 1e-6).impacts.is_some_and(|n| n > 15));
        assert_eq!(ball.at(1.5), Flight { height: 0.0, velocity: 0.0, impacts: None });
        assert_eq!(ball.at(1e9).height, 0.0);
    }

    #[test]
    fn without_restitution_it_stops_at_the_first_impact_and_with_all_of_it_it_never_does() {
        assert_eq!(dropped(1.25, 0.0).at(0.5), Flight { height: 0.0, velocity: 0.0, impacts: None });
        assert_eq!(dropped(1.25, 0.0).at(0.25).height, 1.25 - 0.3125);
        let ball = dropped(1.25, 1.0);
        assert_eq!(ball.rest_time(), f64::INFINITY);
        // A thousand bounces later, at the top again.
        let late = ball.at(1000.0);
        assert_eq!((late.height, late.velocity, late.impacts), (1.25, 0.0, Some(1000)));
        assert_eq!(dropped(0.0, 1.0).at(3.0), Flight { height: 0.0, velocity: 0.0, impacts: None });
    }

    #[test]
    fn nearly_elastic_balls_are_counted_right() {
        let ball = dropped(1.25, 1.0 - 1e-9);
        // In 1000 s a ball that loses 1e-9 of its speed a bounce gains 1e-9 · 1000²/2 s on one that loses nothing.
        let early = dropped(1.25, 1.0).impact_time(1000) - ball.impact_time(1000);
        let sum: f64 = (1..1000).map(|k| 1e-9 * f64::from(k)).sum();
        assert!((early - sum).abs() < 1e-9, "{early} and {sum}");
        assert_eq!(ball.at(ball.impact_time(777)).impacts, Some(777));
    }
}
