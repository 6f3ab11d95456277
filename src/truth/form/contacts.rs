//! Bodies on a plane: bouncing, sliding, rolling.

use super::impacts::can_touch;
use super::motion::{Course, Ground, Part};
use super::{refuse_drag, refuse_links};
use crate::engine::{DVec2, Shape, Wall, World};
use crate::truth::closed_form::{BouncingBall, Roll, Slide};

/// Surfaces nearer than this touch [m]: the rounding of a scene file's decimals.
const TOUCHING: f64 = 1e-9;

/// What a body stands over.
struct Plane {
    ground: Ground,
    /// Towards the body.
    normal: DVec2,
    /// From the body's surface to the plane [m].
    gap: f64,
    restitution: f64,
    friction: f64,
}

pub(super) fn bounce(world: &World, body: usize) -> Result<Part, String> {
    let plane = plane_under(world, body)?;
    let (velocity, gravity) = (world.bodies().velocity[body], world.gravity());
    let along = plane.normal.perp();
    let spins = world.bodies().spin(body).is_some_and(|spin| spin.omega != 0.0);
    let slips = velocity.dot(along) != 0.0 || gravity.dot(along).abs() > 1e-12 * gravity.length() || spins;
    if plane.friction > 0.0 && slips {
        return Err("friction at an impact that is not straight".into());
    }
    let ball = BouncingBall {
        height: plane.gap.max(0.0),
        velocity: velocity.dot(plane.normal),
        gravity: -gravity.dot(plane.normal),
        restitution: plane.restitution,
    };
    let sideways = Course::Accelerated { velocity: velocity.dot(along), acceleration: gravity.dot(along) };
    let courses = [Course::Bounce(ball), if slips { sideways } else { Course::Still }];
    Ok(Part::Axes { body, axes: [plane.normal, along], courses, ground: Some(plane.ground) })
}

pub(super) fn slide(world: &World, body: usize) -> Result<Part, String> {
    if world.bodies().spin(body).is_some() {
        return Err("a disc that turns".into());
    }
    let (plane, down, slope) = slope_under(world, body)?;
    let velocity = world.bodies().velocity[body].dot(down);
    let slide = Slide { slope, friction: plane.friction, gravity: world.gravity().length(), velocity };
    Ok(on_slope(body, &plane, down, Course::Slide(slide)))
}

pub(super) fn roll(world: &World, body: usize) -> Result<Part, String> {
    let bodies = world.bodies();
    let Some(spin) = bodies.spin(body) else { return Err("a particle, which does not turn".into()) };
    let (plane, down, slope) = slope_under(world, body)?;
    let roll = Roll {
        radius: bodies.radius[body],
        inertia: 0.5,
        slope,
        friction: plane.friction,
        gravity: world.gravity().length(),
        velocity: bodies.velocity[body].dot(down),
        // Counter-clockwise turns roll the body towards n turned by +90°.
        omega: spin.omega * plane.normal.perp().dot(down).signum(),
    };
    Ok(on_slope(body, &plane, down, Course::Roll(roll)))
}

/// Refuses a body that does not lie on a plane without friction.
pub(super) fn refuse_rough_floor(world: &World, body: usize) -> Result<(), String> {
    let plane = plane_under(world, body)?;
    if plane.gap > TOUCHING || plane.friction > 0.0 {
        return Err(format!("body {body} in the air or on a floor with friction {:?}", plane.friction));
    }
    Ok(())
}

/// Checks that bodies are at rest, each on a level plane or exactly above another one, and touch what they stand on.
pub(super) fn stack(world: &World, moving: &[usize]) -> Result<(), String> {
    let (bodies, gravity) = (world.bodies(), world.gravity().length());
    let down = world.gravity().try_normalize().ok_or("no gravity")?;
    for &i in moving {
        if bodies.velocity[i] != DVec2::ZERO || bodies.spin(i).is_some_and(|spin| spin.omega != 0.0) {
            return Err(format!("body {i}, which moves"));
        }
        let stands_on = |&b: &usize| {
            let below = bodies.position[b] - bodies.position[i];
            let touches = (below.length() - bodies.radius[i] - bodies.radius[b]).abs() <= TOUCHING;
            b != i && can_touch(world, i, b) && touches && below.perp_dot(down) == 0.0 && below.dot(down) > 0.0
        };
        let level = |plane: Plane| plane.gap <= TOUCHING && plane.normal.dot(down) <= -1.0 + 1e-15;
        if (0..bodies.len()).any(|b| stands_on(&b)) {
            refuse_links(world, i)?;
        } else if !plane_under(world, i).is_ok_and(level) {
            return Err(format!("body {i}, which stands on nothing level under {gravity:?} m/s²"));
        }
    }
    Ok(())
}

fn on_slope(body: usize, plane: &Plane, down: DVec2, course: Course) -> Part {
    Part::Axes { body, axes: [down, plane.normal], courses: [course, Course::Still], ground: Some(plane.ground) }
}

/// The plane that `body` touches without leaving or meeting it, the direction down it, and its angle with the horizontal [rad].
fn slope_under(world: &World, body: usize) -> Result<(Plane, DVec2, f64), String> {
    let plane = plane_under(world, body)?;
    if plane.gap > TOUCHING {
        return Err(format!("a gap of {:?} m to the plane", plane.gap));
    }
    let (velocity, gravity) = (world.bodies().velocity[body], world.gravity());
    if velocity.dot(plane.normal).abs() > 1e-12 * velocity.length() {
        return Err("a velocity into the plane or off it".into());
    }
    let along = plane.normal.perp();
    let down = if gravity.dot(along) < 0.0 { -along } else { along };
    let slope = libm::atan2(gravity.dot(down), -gravity.dot(plane.normal));
    // What a file's decimals leave of a level plane.
    Ok((plane, down, if slope < 1e-15 { 0.0 } else { slope }))
}

/// The plane that gravity pulls `body` to: of those below it the nearest.
fn plane_under(world: &World, body: usize) -> Result<Plane, String> {
    refuse_drag(world)?;
    refuse_links(world, body)?;
    let bodies = world.bodies();
    if !bodies.collides[body] || bodies.radius[body] == 0.0 {
        return Err("a body that cannot touch anything".into());
    }
    let below = world.walls().iter().filter_map(|wall| plane(world, body, wall));
    let nearest = below.min_by(|a, b| a.gap.total_cmp(&b.gap));
    nearest.ok_or_else(|| "no wall under it that gravity pulls it to".into())
}

/// The side of `wall` that `body` stands over, if gravity pulls it there.
fn plane(world: &World, body: usize, wall: &Wall) -> Option<Plane> {
    let (bodies, tuning) = (world.bodies(), world.tuning());
    let (centre, radius) = (bodies.position[body], bodies.radius[body]);
    sides(&wall.shape).into_iter().find_map(|ground| {
        let way = ground.to - ground.from;
        let along = way.try_normalize()?;
        let foot = (centre - ground.from).dot(along);
        // A segment is solid from both sides.
        let height = along.perp_dot(centre - ground.from);
        let normal = along.perp() * if height < 0.0 { -1.0 } else { 1.0 };
        let one_sided = matches!(wall.shape, Shape::Box { .. });
        let gap = height.abs() - radius;
        let fits = (0.0..=way.length()).contains(&foot)
            && gap > -TOUCHING
            && !(one_sided && height < 0.0)
            && world.gravity().dot(normal) < 0.0;
        let own = (bodies.restitution[body], bodies.friction[body]);
        fits.then(|| Plane {
            ground,
            normal,
            gap,
            restitution: tuning.restitution.unwrap_or(own.0.max(wall.restitution)),
            friction: tuning.friction.unwrap_or((own.1 * wall.friction).sqrt()),
        })
    })
}

/// The straight sides of a wall; of a box clockwise, so that what is outside lies on their left.
pub(super) fn sides(shape: &Shape) -> Vec<Ground> {
    match *shape {
        Shape::Segment { from, to } => vec![Ground { from, to }],
        Shape::Box { min, max } => {
            let corners = [min, DVec2::new(min.x, max.y), max, DVec2::new(max.x, min.y)];
            (0..4).map(|i| Ground { from: corners[i], to: corners[(i + 1) % 4] }).collect()
        }
    }
}
