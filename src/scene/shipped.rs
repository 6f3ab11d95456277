//! The scenes that come with the program, inside it.

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

/// The scene of that name, of the sandbox or with a truth.
pub fn find_shipped(name: &str) -> Option<&'static Shipped> {
    shipped().iter().chain(truth_scenes()).find(|scene| scene.name == name)
}
