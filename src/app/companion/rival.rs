//! "B": the same scene and the same inputs under another method, shown beside the simulation.

use super::report::{Report, Standing};
use super::separation::{Gap, Separation};
use super::{Beginning, Follower, Input, Pose};
use crate::app::error::Lost;
use crate::app::frame::{Frame, SceneInfo, Speed};
use crate::app::laboratory::Lab;
use crate::app::plot_data::{Plots, Sample};
use crate::app::trace::Trace;
use crate::engine::Method;
use crate::measure::Measures;
use std::sync::Arc;
use std::time::Instant;

/// A world beside the simulation, with everything that its picture needs.
pub(super) struct Rival {
    follower: Follower,
    scene: Arc<SceneInfo>,
    before: Pose,
    measures: Measures,
    plots: Plots,
    trace: Trace,
    separation: Separation,
    length: f64,
    since: f64,
}

impl Rival {
    /// # Errors
    /// If the method cannot be used.
    pub fn new(beginning: Box<Beginning>, method: Method) -> Result<Rival, Lost> {
        let length = beginning.length();
        let Beginning { world, scene, hz, .. } = *beginning;
        let (since, here, measures) = (world.time(), Pose::of(&world), Measures::of(&world));
        let follower = Follower::new(world, Method { hz, ..method })?;
        let mut separation = Separation::default();
        separation.compare(&follower.world().bodies().id, &here, &here, length, 0.0);
        let (plots, trace) = (Plots::default(), Trace::default());
        Ok(Rival { follower, scene, before: Pose::default(), measures, plots, trace, separation, length, since })
    }

    /// Steps with another method from now on.
    pub fn set_method(&mut self, method: Method) -> Result<(), Lost> {
        Ok(self.follower.set_method(method)?)
    }

    pub fn input(&mut self, input: &Input) -> Result<(), Lost> {
        self.follower.apply(input)?;
        if matches!(input, Input::Edit(_)) {
            self.before = Pose::default();
            self.trace.clear();
        }
        self.measures = Measures::of(self.follower.world());
        Ok(())
    }

    /// Follows a step, after which the simulation is `here`. The new distance.
    pub fn step(&mut self, here: &Pose) -> Result<Option<Gap>, Lost> {
        self.before = Pose::of(self.follower.world());
        self.follower.step()?;
        let world = self.follower.world();
        self.measures = Measures::of(world);
        let automatic = self.follower.method().automatic;
        self.plots.push(Sample::new(self.measures, self.follower.report(), automatic));
        self.trace.push(world);
        self.separation.compare(&world.bodies().id, here, &Pose::of(world), self.length, 0.0);
        Ok(self.separation.gap)
    }

    /// What there is to tell, its picture included.
    pub fn report(&mut self, generation: u64) -> Report {
        let frame = self.frame();
        let world = self.follower.world();
        Report {
            generation,
            tick: world.tick(),
            time: world.time(),
            since: self.since,
            standing: Standing::Following,
            length: self.length,
            gap: self.separation.gap,
            so_far: self.separation.so_far(),
            parting: self.separation.parting,
            growth: None,
            offsets: self.separation.offsets.clone(),
            frame: Some(Arc::new(frame)),
        }
    }

    fn frame(&mut self) -> Frame {
        let plan = self.follower.plan();
        let world = self.follower.world();
        // Angles are kept for every body or for none; a picture wants one for each.
        let mut previous_angle = self.before.angle.clone();
        previous_angle.resize(self.before.position.len(), 0.0);
        Frame {
            sequence: world.tick(),
            published: Instant::now(),
            scene: self.scene.clone(),
            world: world.clone(),
            previous_position: self.before.position.clone(),
            previous_angle,
            method: *self.follower.method(),
            report: self.follower.report().clone(),
            measures: self.measures,
            plots: self.plots.clone(),
            trace: self.trace.clone(),
            plan,
            running: true,
            speed: Speed { wanted: 1.0, slow: false, achieved: 1.0 },
            fault: None,
            note: None,
            saved: None,
            unsaved: None,
            undo: None,
            redo: None,
            touched: Arc::default(),
            companions: super::Companions::default(),
            lab: Lab::default(),
            trial: None,
        }
    }
}
