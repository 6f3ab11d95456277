// Shared by every pipeline: the canvas and how its points become pixels and clip coordinates.
// Pixels are physical, counted from the middle of the canvas, y down; points are logical, y up.

struct View {
    // Middle of the canvas in the target [px].
    origin: vec2<f32>,
    // Size of the target [px].
    target_size: vec2<f32>,
    // Half the size of the canvas [px].
    half_size: vec2<f32>,
    pixels_per_point: f32,
    padding: f32,
}

@group(0) @binding(0) var<uniform> view: View;

fn to_pixels(points: vec2<f32>) -> vec2<f32> {
    return vec2(points.x, -points.y) * view.pixels_per_point;
}

fn to_clip(pixels: vec2<f32>) -> vec4<f32> {
    let at = (view.origin + pixels) / view.target_size;
    return vec4(2.0 * at.x - 1.0, 1.0 - 2.0 * at.y, 0.0, 1.0);
}

// Corner of a unit square for a strip of two triangles: (0, 0), (1, 0), (0, 1), (1, 1).
fn unit_corner(index: u32) -> vec2<f32> {
    return vec2(f32(index & 1u), f32(index >> 1u));
}

// Part of a pixel that an edge covers, from the pixel's signed distance [px], negative inside.
fn coverage(distance: f32) -> f32 {
    return clamp(0.5 - distance, 0.0, 1.0);
}

fn premultiplied(colour: vec4<f32>, part: f32) -> vec4<f32> {
    let alpha = colour.a * part;
    return vec4(colour.rgb * alpha, alpha);
}

fn over(top: vec4<f32>, below: vec4<f32>) -> vec4<f32> {
    return top + below * (1.0 - top.a);
}

// Signed distance [px] to a segment from (0, 0) to `to`, thickened by `half_width`.
fn capsule(p: vec2<f32>, to: vec2<f32>, half_width: f32) -> f32 {
    let t = clamp(dot(p, to) / max(dot(to, to), 1e-12), 0.0, 1.0);
    return length(p - to * t) - half_width;
}
