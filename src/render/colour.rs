//! Colours: the maps that stand for numbers, and the quiet greys of everything else.

use bytemuck::{Pod, Zeroable};

/// Red, green, blue and opacity in sRGB, not premultiplied.
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct Colour(pub [u8; 4]);

impl Colour {
    /// Nothing at all.
    pub const CLEAR: Colour = Colour([0; 4]);

    /// An opaque colour from 0xRRGGBB.
    pub const fn hex(rgb: u32) -> Colour {
        Colour([(rgb >> 16) as u8, (rgb >> 8) as u8, rgb as u8, 255])
    }

    /// The same colour with another opacity, 0 … 1.
    pub fn with_opacity(self, opacity: f64) -> Colour {
        let [r, g, b, _] = self.0;
        Colour([r, g, b, (opacity.clamp(0.0, 1.0) * 255.0).round() as u8])
    }

    /// Mixes with `other`, of which there is `part`, 0 … 1.
    pub fn mix(self, other: Colour, part: f64) -> Colour {
        let part = part.clamp(0.0, 1.0);
        let channel = |i: usize| {
            let (from, to) = (f64::from(self.0[i]), f64::from(other.0[i]));
            (from + (to - from) * part).round() as u8
        };
        Colour([channel(0), channel(1), channel(2), channel(3)])
    }
}

/// Light or dark.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Theme {
    /// For a dark window; the canvas is darker than every panel.
    #[default]
    Dark,
    /// For a light window.
    Light,
}

/// The colours of one theme's scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Palette {
    /// The empty canvas.
    pub background: Colour,
    /// Lines between the labelled ones.
    pub grid_minor: Colour,
    /// Lines with a label.
    pub grid_major: Colour,
    /// The lines x = 0 and y = 0.
    pub axis: Colour,
    /// The inside of boxes.
    pub wall_fill: Colour,
    /// The slanted lines on the inside of boxes.
    pub wall_hatch: Colour,
    /// Edges of walls, and segment walls.
    pub wall_edge: Colour,
    /// Fills of dynamic bodies, given out in turn so that neighbours differ.
    pub bodies: [Colour; 6],
    /// Particles within a rope, a bridge, a cloth.
    pub node: Colour,
    /// Mixed into the fill of a body for its edge.
    pub body_stroke: Colour,
    /// Static bodies and anchors in the world.
    pub fixed: Colour,
    /// Edges of static bodies and anchors, and the ring in kinematic bodies.
    pub fixed_stroke: Colour,
    /// Rods, ropes and springs without a force, or with the map switched off.
    pub link: Colour,
    /// Selection, and what is about to be made.
    pub accent: Colour,
    /// The outline of what lies under the cursor.
    pub hover: Colour,
    /// Where bodies touch, and the tick for the force.
    pub contact: Colour,
    /// Arrows of the velocities.
    pub velocity: Colour,
    /// The truth, translucent.
    pub ghost: Colour,
    /// A cut, and a body at which the run diverged.
    pub warning: Colour,
    /// −1, −½, 0, ½, 1 of the diverging map.
    diverging: [Colour; 5],
}

/// For a dark window. The canvas is darker than every panel.
const DARK: Palette = Palette {
    background: Colour::hex(0x0F1114),
    grid_minor: Colour::hex(0x1A1D22),
    grid_major: Colour::hex(0x262B32),
    axis: Colour::hex(0x3A414B),
    wall_fill: Colour::hex(0x242930),
    wall_hatch: Colour::hex(0x343B45),
    wall_edge: Colour::hex(0x8D97A5),
    bodies: [
        Colour::hex(0x8FA6C0),
        Colour::hex(0x93B0A2),
        Colour::hex(0xC0AF90),
        Colour::hex(0xAD99B5),
        Colour::hex(0xBD9A8C),
        Colour::hex(0xA3AEB9),
    ],
    node: Colour::hex(0x66707D),
    body_stroke: Colour::hex(0x2B3138),
    fixed: Colour::hex(0x5B6470),
    fixed_stroke: Colour::hex(0xC3CAD3),
    link: Colour::hex(0xB4BBC5),
    accent: Colour::hex(0x4DA3FF),
    hover: Colour::hex(0xE6EAF0),
    contact: Colour::hex(0x4FD6A8),
    velocity: Colour::hex(0xE9C46A),
    ghost: Colour([0xC9, 0xAE, 0xFF, 0xB8]),
    warning: Colour::hex(0xFF4F64),
    diverging: [
        Colour::hex(0x2F86FF),
        Colour::hex(0x86B6EE),
        Colour::hex(0xC9CED6),
        Colour::hex(0xF2A277),
        Colour::hex(0xFF5326),
    ],
};

/// For a light window.
const LIGHT: Palette = Palette {
    background: Colour::hex(0xE9EBEE),
    grid_minor: Colour::hex(0xDFE2E6),
    grid_major: Colour::hex(0xD0D4DA),
    axis: Colour::hex(0xABB2BC),
    wall_fill: Colour::hex(0xCBD0D7),
    wall_hatch: Colour::hex(0xB6BDC7),
    wall_edge: Colour::hex(0x59626E),
    bodies: [
        Colour::hex(0x6F8BAA),
        Colour::hex(0x71957F),
        Colour::hex(0xA98F63),
        Colour::hex(0x8E749A),
        Colour::hex(0xA6766A),
        Colour::hex(0x7E8C9A),
    ],
    node: Colour::hex(0xA7AFBA),
    body_stroke: Colour::hex(0x39414B),
    fixed: Colour::hex(0x8A929D),
    fixed_stroke: Colour::hex(0x2F363F),
    link: Colour::hex(0x5F6772),
    accent: Colour::hex(0x0B6BD6),
    hover: Colour::hex(0x20252B),
    contact: Colour::hex(0x0B8A60),
    velocity: Colour::hex(0x8A6100),
    ghost: Colour([0x7A, 0x45, 0xD6, 0xC8]),
    warning: Colour::hex(0xC9152E),
    diverging: [
        Colour::hex(0x0A55C4),
        Colour::hex(0x4F83BF),
        Colour::hex(0x7F868F),
        Colour::hex(0xC2713F),
        Colour::hex(0xC5300B),
    ],
};

impl Theme {
    /// The scene's colours in this theme.
    pub fn palette(self) -> &'static Palette {
        match self {
            Theme::Dark => &DARK,
            Theme::Light => &LIGHT,
        }
    }

    /// Colour of a signed share of a range: −1 (full push) blue, 0 neutral grey, 1 (full pull) orange-red.
    ///
    /// Blue against orange-red is told apart with every common colour deficiency (Brewer, Harrower 2003: the pair of the
    /// scheme RdBu); the neutral middle is grey instead of white, because it must stand out from both canvases.
    pub fn diverging(self, share: f64) -> Colour {
        let share = if share.is_nan() { 0.0 } else { share.clamp(-1.0, 1.0) };
        sample(&self.palette().diverging, (share + 1.0) / 2.0)
    }
}

/// Colour of a share, 0 … 1, in viridis: evenly lighter from dark blue to yellow, also in grey and with colour deficiencies.
///
/// Nine samples of the map by van der Walt and Smith (matplotlib, 2015, public domain), linear in between.
pub fn viridis(share: f64) -> Colour {
    const SAMPLES: [Colour; 9] = [
        Colour::hex(0x440154),
        Colour::hex(0x472D7B),
        Colour::hex(0x3B528B),
        Colour::hex(0x2C728E),
        Colour::hex(0x21918C),
        Colour::hex(0x28AE80),
        Colour::hex(0x5EC962),
        Colour::hex(0xADDC30),
        Colour::hex(0xFDE725),
    ];
    sample(&SAMPLES, share)
}

/// Linear interpolation in evenly spaced samples; what is not a number is taken as 0.
fn sample(samples: &[Colour], share: f64) -> Colour {
    let last = samples.len() - 1;
    let share = if share.is_nan() { 0.0 } else { share.clamp(0.0, 1.0) };
    let at = share * last as f64;
    let index = (at as usize).min(last - 1);
    samples[index].mix(samples[index + 1], at - index as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pull_is_red_push_is_blue_and_nothing_is_grey() {
        for theme in [Theme::Dark, Theme::Light] {
            let [[red, _, blue, _], [r, _, b, _]] = [theme.diverging(1.0).0, theme.diverging(-1.0).0];
            assert!(red > 2 * blue && b > 2 * r, "{theme:?}");
            let Colour([r, g, b, _]) = theme.diverging(0.0);
            assert!(r.abs_diff(b) < 20 && r.abs_diff(g) < 20, "{theme:?}");
            assert_eq!(theme.diverging(7.0), theme.diverging(1.0));
            assert_eq!(theme.diverging(f64::NAN), theme.diverging(0.0));
        }
    }

    #[test]
    fn viridis_grows_lighter_all_the_way() {
        let luminance = |share: f64| {
            let [r, g, b, _] = viridis(share).0.map(f64::from);
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        let steps: Vec<f64> = (0..=64).map(|i| luminance(f64::from(i) / 64.0)).collect();
        assert!(steps.windows(2).all(|pair| pair[0] < pair[1]));
        assert_eq!((viridis(0.0), viridis(1.0)), (Colour::hex(0x440154), Colour::hex(0xFDE725)));
    }
}
