//! Which free bodies can meet in the coming step: those that can hang together, directly or through others, are carried together, and what else moves
//! takes only those with it that it can reach.
//!
//! Each body has a ball that it cannot leave while nothing makes it faster than it is: its radius, the way of its speed, that of its surface by turning, and
//! what gravity adds. Two bodies whose balls do not meet cannot touch. A body that is hit may get faster and leave its ball, so [`super::few`] watches how
//! far each came, and where that is into another's ball the clusters are found anew with what is known by then.
//!
//! Cost: O(n log n) a step, and O(n) for each body that reaches much farther than the others.

use crate::engine::body::Motion;
use crate::engine::collide::Grid;
use crate::engine::plan::Plan;
use crate::engine::world::World;

/// Room beside the way, as a part of the radius.
const ROOM: f64 = 0.05;
/// Bodies that reach farther than so many times the usual are tried against all others.
const LARGE: f64 = 4.0;

/// What a body is to a free one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Role {
    /// Touches nothing.
    #[default]
    Nothing,
    Free,
    /// In the way.
    Static,
    /// Moves by other laws: kinematic, held by the mouse, or joined to others.
    Other,
}

/// The clusters of a step, and scratch memory by dense index.
#[derive(Debug, Default)]
pub(super) struct Clusters {
    role: Vec<Role>,
    /// Radius of the ball that a body cannot leave [m]; 0 of one that touches nothing.
    reach: Vec<f64>,
    /// Disjoint sets of free bodies, named by their smallest member.
    parent: Vec<u32>,
    /// Free bodies that something else can reach.
    reached: Vec<u32>,
    /// A free body and a static one in its way.
    blocked: Vec<(u32, u32)>,
    /// (cluster, body), ascending; and (cluster, static body).
    members: Vec<(u32, u32)>,
    obstacles: Vec<(u32, u32)>,
    /// Clusters that something else can reach, ascending.
    near: Vec<u32>,
    grid: Grid,
    sorted: Vec<f64>,
    large: Vec<u32>,
}

/// Bodies that can hang together in a step, as pairs of the cluster's name and a dense index, ascending.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cluster<'a> {
    members: &'a [(u32, u32)],
    /// Static bodies in their way.
    obstacles: &'a [(u32, u32)],
    /// Something that moves by other laws can reach them.
    pub near: bool,
}

impl<'a> Cluster<'a> {
    /// Number of bodies, those in the way included.
    pub fn len(&self) -> usize {
        self.members.len() + self.obstacles.len()
    }

    /// Its only body, if it has but one and nothing is in its way.
    pub fn single(&self) -> Option<u32> {
        match (self.members, self.obstacles) {
            ([(_, body)], []) => Some(*body),
            _ => None,
        }
    }

    /// All bodies, those in the way included, ascending.
    pub fn bodies(self) -> impl Iterator<Item = u32> + 'a {
        let indices = |pairs: &'a [(u32, u32)]| pairs.iter().map(|pair| pair.1).peekable();
        let (mut one, mut other) = (indices(self.members), indices(self.obstacles));
        std::iter::from_fn(move || match (one.peek(), other.peek()) {
            (Some(a), Some(b)) if b < a => other.next(),
            (Some(_), _) => one.next(),
            _ => other.next(),
        })
    }
}

impl Clusters {
    /// Finds the clusters of the bodies `free` (dense indices, ascending) for the next `time` seconds. Bodies that `strayed` have balls of at
    /// least that radius [m].
    pub fn find(&mut self, world: &World, plan: &Plan, free: &[u32], time: f64, strayed: &[(u32, f64)]) {
        self.measure(world, free, time);
        self.enlarge(strayed);
        self.sort_by_reach(world);
        let Clusters { role, reach, parent, reached, blocked, grid, large, .. } = self;
        parent.clear();
        parent.extend(0..role.len() as u32);
        reached.clear();
        blocked.clear();
        let position = &world.bodies.position;
        let mut look = |a: u32, b: u32| {
            let (i, j) = (a as usize, b as usize);
            let far = reach[i] + reach[j];
            // Written so that a NaN is close.
            if (position[i] - position[j]).length_squared() > far * far || !world.bodies.may_touch(&plan.joined, a, b) {
                return;
            }
            match (role[i], role[j]) {
                (Role::Free, Role::Free) => join(parent, a, b),
                (Role::Free, Role::Static) => blocked.push((a, b)),
                (Role::Static, Role::Free) => blocked.push((b, a)),
                (Role::Free, Role::Other) => reached.push(a),
                (Role::Other, Role::Free) => reached.push(b),
                _ => {}
            }
        };
        grid.pairs(&mut look);
        for (rank, one) in large.iter().enumerate() {
            let before = |b: &u32| large[..rank].binary_search(b).is_ok();
            let others =
                (0..role.len() as u32).filter(|b| b != one && role[*b as usize] != Role::Nothing && !before(b));
            others.for_each(|b| look(*one, b));
        }
        let held = world.grip.and_then(|grip| world.bodies.index_of(grip.body)).map(|body| body as u32);
        reached.extend(held.filter(|body| free.binary_search(body).is_ok()));
        self.gather(free);
    }

    /// The clusters in the order of their smallest members.
    pub fn iter(&self) -> impl Iterator<Item = Cluster<'_>> {
        self.members.chunk_by(|one, next| one.0 == next.0).map(|members| {
            let cluster = members[0].0;
            let first = self.obstacles.partition_point(|obstacle| obstacle.0 < cluster);
            let last = self.obstacles.partition_point(|obstacle| obstacle.0 <= cluster);
            let near = self.near.binary_search(&cluster).is_ok();
            Cluster { members, obstacles: &self.obstacles[first..last], near }
        })
    }

    /// How far the centre of a free body may go in the step without leaving its ball [m]; anywhere if it touches nothing.
    pub fn room(&self, world: &World, body: u32, time: f64) -> f64 {
        let i = body as usize;
        match self.role[i] {
            Role::Free => self.reach[i] - world.bodies.radius[i] - bulge(world, time),
            _ => f64::INFINITY,
        }
    }

    /// Radius of the ball in which a body was whose centre came as far as `way` [m].
    pub fn ball(world: &World, body: u32, way: f64, time: f64) -> f64 {
        way + world.bodies.radius[body as usize] + bulge(world, time)
    }

    /// Whether bodies that left their balls, with those in which they were, came near to nothing that is not of their own clusters.
    pub fn stay_apart(&mut self, world: &World, plan: &Plan, strayed: &[(u32, f64)]) -> bool {
        self.enlarge(strayed);
        let Clusters { role, reach, parent, obstacles, .. } = self;
        let position = &world.bodies.position;
        strayed.iter().all(|(body, _)| {
            let (i, cluster) = (*body as usize, root(parent, *body));
            (0..role.len() as u32).all(|other| {
                let j = other as usize;
                let far = reach[i] + reach[j];
                let own = match role[j] {
                    Role::Nothing => true,
                    Role::Free => root(parent, other) == cluster,
                    Role::Static => obstacles.binary_search(&(cluster, other)).is_ok(),
                    Role::Other => false,
                };
                own || (position[i] - position[j]).length_squared() > far * far
                    || !world.bodies.may_touch(&plan.joined, *body, other)
            })
        })
    }

    fn enlarge(&mut self, strayed: &[(u32, f64)]) {
        for (body, ball) in strayed {
            let reach = &mut self.reach[*body as usize];
            *reach = reach.max(*ball);
        }
    }

    fn measure(&mut self, world: &World, free: &[u32], time: f64) {
        let bodies = &world.bodies;
        let held = world.grip.as_ref().and_then(|grip| Some((bodies.index_of(grip.body)?, grip)));
        self.role.clear();
        self.role.extend((0..bodies.len()).map(|i| match bodies.motion[i] {
            _ if !bodies.is_solid(i) => Role::Nothing,
            Motion::Static if held.is_none_or(|held| held.0 != i) => Role::Static,
            _ => Role::Other,
        }));
        for body in free.iter().map(|body| *body as usize).filter(|body| bodies.radius[*body] > 0.0) {
            if self.role[body] == Role::Other {
                self.role[body] = Role::Free;
            }
        }
        let drop = 8.0 * bulge(world, time);
        self.reach.clear();
        self.reach.extend(self.role.iter().enumerate().map(|(i, role)| {
            let radius = bodies.radius[i];
            let turning = bodies.spin(i).map_or(0.0, |spin| radius * spin.omega.abs());
            match role {
                Role::Nothing => 0.0,
                Role::Static => radius,
                _ => radius * (1.0 + ROOM) + time * (bodies.velocity[i].length() + turning) + drop,
            }
        }));
        if let Some((body, grip)) = held.filter(|held| self.reach[held.0] > 0.0) {
            // It goes no farther than to where it is led.
            self.reach[body] += (world.to_world(body, grip.local) - grip.target).length();
        }
    }

    /// The grid of all that can touch, and the list of what is too large for it.
    fn sort_by_reach(&mut self, world: &World) {
        self.sorted.clear();
        self.sorted.extend(self.reach.iter().copied().filter(|reach| *reach > 0.0));
        let middle = self.sorted.len() / 2;
        let usual =
            if self.sorted.is_empty() { 0.0 } else { *self.sorted.select_nth_unstable_by(middle, f64::total_cmp).1 };
        let reach = &self.reach;
        let touching = || (0..reach.len()).filter(|i| reach[*i] > 0.0);
        // Written so that a NaN is large.
        let small = |i: &usize| reach[*i] <= LARGE * usual;
        self.large.clear();
        self.large.extend(touching().filter(|i| !small(i)).map(|i| i as u32));
        let widest = touching().filter(small).map(|i| reach[i]).fold(0.0, f64::max);
        self.grid
            .fill((2.0 * widest).max(1e-9), touching().filter(small).map(|i| (i as u32, world.bodies.position[i])));
    }

    fn gather(&mut self, free: &[u32]) {
        let Clusters { parent, members, obstacles, near, reached, blocked, .. } = self;
        members.clear();
        members.extend(free.iter().map(|body| (root(parent, *body), *body)));
        members.sort_unstable();
        obstacles.clear();
        obstacles.extend(blocked.iter().map(|(body, obstacle)| (root(parent, *body), *obstacle)));
        obstacles.sort_unstable();
        obstacles.dedup();
        near.clear();
        near.extend(reached.iter().map(|body| root(parent, *body)));
        near.sort_unstable();
        near.dedup();
    }
}

/// How far a path under gravity is from the straight way between two of its places, at most [m].
fn bulge(world: &World, time: f64) -> f64 {
    0.125 * world.gravity.length() * time * time
}

fn root(parent: &mut [u32], mut i: u32) -> u32 {
    while parent[i as usize] != i {
        // Path halving (Tarjan and van Leeuwen 1984).
        parent[i as usize] = parent[parent[i as usize] as usize];
        i = parent[i as usize];
    }
    i
}

fn join(parent: &mut [u32], a: u32, b: u32) {
    let (a, b) = (root(parent, a), root(parent, b));
    parent[a.max(b) as usize] = a.min(b);
}
