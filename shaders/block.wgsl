// Boxes along the axes: a fill with slanted hatching, as solid ground is drawn by hand, and a stroke inside the edge.

struct Block {
    @location(0) low: vec2<f32>,
    @location(1) high: vec2<f32>,
    @location(2) stroke_width: f32,
    // Where the hatching starts, so that it stays with the box when the view moves.
    @location(3) phase: f32,
    @location(4) fill: vec4<f32>,
    @location(5) stroke: vec4<f32>,
    @location(6) hatch: vec4<f32>,
}

struct Fragment {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat) middle: vec2<f32>,
    @location(1) @interpolate(flat) half_extent: vec2<f32>,
    @location(2) @interpolate(flat) stroke_width: f32,
    @location(3) @interpolate(flat) phase: f32,
    @location(4) @interpolate(flat) fill: vec4<f32>,
    @location(5) @interpolate(flat) stroke: vec4<f32>,
    @location(6) @interpolate(flat) hatch: vec4<f32>,
}

// Distance of two hatch lines along an axis, and their width [points].
const HATCH_PERIOD: f32 = 12.0;
const HATCH_WIDTH: f32 = 1.0;

@vertex
fn vertex(block: Block, @builtin(vertex_index) index: u32) -> Fragment {
    let first = to_pixels(block.low);
    let second = to_pixels(block.high);
    var out: Fragment;
    out.middle = 0.5 * (first + second);
    out.half_extent = max(0.5 * abs(second - first), vec2(0.75));
    let corner = 2.0 * unit_corner(index) - 1.0;
    out.position = to_clip(out.middle + corner * (out.half_extent + 1.0));
    out.stroke_width = block.stroke_width * view.pixels_per_point;
    out.phase = block.phase;
    out.fill = block.fill;
    out.stroke = block.stroke;
    out.hatch = block.hatch;
    return out;
}

@fragment
fn fragment(in: Fragment) -> @location(0) vec4<f32> {
    let p = in.position.xy - view.origin;
    let outside = abs(p - in.middle) - in.half_extent;
    // Along each axis by itself: the coverage of an axis-aligned box is the product of both.
    let whole = coverage(outside.x) * coverage(outside.y);
    let inner = coverage(outside.x + in.stroke_width) * coverage(outside.y + in.stroke_width);
    let along = (p.x - p.y) / view.pixels_per_point + in.phase;
    let turn = abs(fract(along / HATCH_PERIOD) - 0.5) * HATCH_PERIOD;
    // The stripes are measured along the axis; across them they are narrower by √½.
    let stripe = coverage((turn * 0.70710678 - 0.5 * HATCH_WIDTH) * view.pixels_per_point);
    let face = over(premultiplied(in.hatch, stripe), premultiplied(in.fill, 1.0));
    return face * inner + premultiplied(in.stroke, whole - inner);
}
