//! The camera: which part of the world is seen, and where on the canvas a point of it lies.

use crate::engine::DVec2;

/// A view of the world without rotation. Canvas coordinates are in points (logical pixels), y down, from the canvas's corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// World point in the middle of the canvas [m].
    pub centre: DVec2,
    /// Canvas points a metre.
    pub scale: f64,
    /// Size of the canvas [points].
    pub size: DVec2,
}

/// Scales from which a view can still be read: from a million kilometres to a micrometre across the canvas.
const SCALE_RANGE: [f64; 2] = [1e-6, 1e9];

impl Camera {
    /// World point under a canvas point.
    pub fn to_world(&self, canvas: DVec2) -> DVec2 {
        let from_middle = canvas - self.size / 2.0;
        self.centre + DVec2::new(from_middle.x, -from_middle.y) / self.scale
    }

    /// Canvas point of a world point.
    pub fn to_canvas(&self, world: DVec2) -> DVec2 {
        let from_centre = (world - self.centre) * self.scale;
        self.size / 2.0 + DVec2::new(from_centre.x, -from_centre.y)
    }

    /// Zooms by `factor`, so that the world point under `canvas` stays there.
    pub fn zoom_at(&mut self, canvas: DVec2, factor: f64) {
        let fixed = self.to_world(canvas);
        self.scale = (self.scale * factor).clamp(SCALE_RANGE[0], SCALE_RANGE[1]);
        self.centre += fixed - self.to_world(canvas);
    }

    /// Moves the view with a drag of the canvas.
    pub fn pan(&mut self, canvas_delta: DVec2) {
        self.centre -= DVec2::new(canvas_delta.x, -canvas_delta.y) / self.scale;
    }

    /// Shows the rectangle from `min` to `max` whole, with a margin of a tenth.
    pub fn fit(&mut self, min: DVec2, max: DVec2) {
        let (middle, half) = ((min + max) / 2.0, (max - min).max(DVec2::splat(1e-3)) * 0.6);
        self.show(middle - half, middle + half);
    }

    /// Shows the rectangle from `min` to `max` as large as it fits.
    pub fn show(&mut self, min: DVec2, max: DVec2) {
        let extent = max - min;
        self.centre = (min + max) / 2.0;
        self.scale = (self.size.x / extent.x).min(self.size.y / extent.y).clamp(SCALE_RANGE[0], SCALE_RANGE[1]);
    }
}
