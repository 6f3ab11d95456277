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

/// All shipped scenes, in the order in which they are listed; the first is the one that opens by itself.
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
