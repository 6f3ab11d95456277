//! The scenes that come with the program, inside it.

use super::document::Document;
use super::pass::Pass;
use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::sync::LazyLock;

/// A scene inside the program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shipped {
    /// What a user types.
    pub name: &'static str,
    /// What a user reads.
    pub title: &'static str,
    /// The scene file.
    pub text: &'static str,
}

impl Shipped {
    /// What a run of it must keep to, if it is a trial. Read once, all of them together.
    pub fn pass(&self) -> Option<&'static Pass> {
        static PASSES: LazyLock<BTreeMap<&'static str, Pass>> = LazyLock::new(|| {
            let read = |scene: &Shipped| Document::from_text(scene.name, scene.text).ok()?.pass;
            every_scene().iter().filter_map(|scene| Some((scene.name, read(scene)?))).collect()
        });
        PASSES.get(self.name)
    }

    /// Title of the section that it is listed in.
    pub fn section(&self) -> &'static str {
        sections().into_iter().find(|(_, scenes)| scenes.contains(self)).map_or("", |(title, _)| title)
    }
}

macro_rules! shipped {
    ($($name:literal: $title:literal,)*) => {
        &[$(Shipped { name: $name, title: $title, text: include_str!(concat!("../../scenes/", $name, ".ron")) },)*]
    };
}

/// The scenes of the sandbox, in the order in which they are listed; the first is the one that opens by itself.
pub fn shipped() -> &'static [Shipped] {
    shipped! {
        "bridge": "Rope bridge",
        "playground": "Playground",
        "rope": "Rope",
        "heavy_rope": "Heavy rope",
        "cloth": "Cloth",
        "soft_body": "Soft bodies",
        "pendulum": "Pendulum",
        "double_pendulum": "Double pendulum",
        "newtons_cradle": "Newton's cradle",
        "bouncing_balls": "Bouncing balls",
        "pile": "Pile of 2,000 discs",
        "stack": "Stack of ten",
        "spring_chain": "Spring chain",
        "disc_chain": "Chain of discs",
        "crank": "Crank",
        "bullet": "Bullet",
        "joint_grid": "Joint grid",
    }
}

/// The scenes whose exact motion is stored in the program ([`crate::truth::stored`]): for comparing methods.
pub fn truth_scenes() -> &'static [Shipped] {
    shipped! {
        "truth/pendulum": "Exact pendulum",
        "truth/double_pendulum": "Exact double pendulum",
        "truth/rope": "Exact rope",
        "truth/heavy_rope": "Exact heavy rope",
        "truth/bridge": "Exact bridge",
        "truth/cloth": "Exact cloth",
        "truth/stiff_chain": "Exact stiff chain",
        "truth/stiff_chain_1e4": "Exact stiff chain, 10000 to 1",
        "truth/rigid_net": "Exact rigid net",
    }
}

/// Scenes that break engines, with a pass for each (`cargo test --test hard`).
pub fn hard_scenes() -> &'static [Shipped] {
    shipped! {
        "hard/projectile": "Projectile",
        "hard/oscillator": "Oscillator",
        "hard/damped_oscillator": "Damped oscillators",
        "hard/pendulum": "Pendulum from the horizontal",
        "hard/small_pendulum": "Pendulum at one degree",
        "hard/double_pendulum": "Double pendulum",
        "hard/rope": "Rope of fifty links",
        "hard/heavy_rope": "A hundred kilograms on twenty grams",
        "hard/hanging_chain": "Hanging chain",
        "hard/stiff_with_soft": "Stiff with soft",
        "hard/ball_and_chain": "Ball and chain",
        "hard/ball_and_chain_light": "Ball and chain, lighter",
        "hard/stretched_chain": "Stretched chain",
        "hard/far_chain": "Far chain",
        "hard/joint_grid": "Joint grid of ten thousand",
        "hard/rigid_net": "Rigid net",
        "hard/braced_net": "Rigid net with diagonals",
        "hard/wheel": "Braced wheel",
        "hard/physical_pendulum": "Pinned disc",
        "hard/heavy_disc_chain": "A hundred kilograms on discs of ten grams",
        "hard/bouncing_ball": "Bouncing balls",
        "hard/restitution_row": "Restitution row",
        "hard/bounce_box": "Bounce box",
        "hard/two_body_exchange": "Two-body exchange",
        "hard/cradle": "Row of five",
        "hard/slide": "Slide",
        "hard/roll": "Roll",
        "hard/ramp_row": "Ramp row",
        "hard/weighing": "Weighing",
        "hard/circle_stack": "Circle stack",
        "hard/bullet": "Bullet at a thin wall",
        "hard/wedge": "Wedge",
    }
}

/// All scenes, section by section, as they are listed.
pub fn sections() -> [(&'static str, &'static [Shipped]); 3] {
    [("Sandbox", shipped()), ("Hard cases", hard_scenes()), ("Truth", truth_scenes())]
}

/// All scenes in one list.
pub fn every_scene() -> &'static [Shipped] {
    static ALL: LazyLock<Vec<Shipped>> =
        LazyLock::new(|| sections().into_iter().flat_map(|(_, scenes)| scenes).copied().collect());
    &ALL
}

/// The scene of that name, of any section.
pub fn find_shipped(name: impl AsRef<OsStr>) -> Option<&'static Shipped> {
    every_scene().iter().find(|scene| name.as_ref() == scene.name)
}
