// Segments of constant width, with round or square ends.

struct Line {
    @location(0) start: vec2<f32>,
    @location(1) end: vec2<f32>,
    @location(2) width: f32,
    @location(3) ends: u32,
    @location(4) colour: vec4<f32>,
}

struct Fragment {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat) start: vec2<f32>,
    @location(1) @interpolate(flat) along: vec2<f32>,
    @location(2) @interpolate(flat) half_width: f32,
    @location(3) @interpolate(flat) ends: u32,
    @location(4) @interpolate(flat) colour: vec4<f32>,
}

const ROUND: u32 = 0u;
// Square ends, half open: segments laid end to end share no pixel, so that a translucent path has no knots.
const SQUARE: u32 = 1u;
// Square, and moved to the nearest whole pixels: for lines along the axes.
const CRISP: u32 = 2u;

// `at` moved so that a line of `width` whole pixels through it covers whole pixels.
fn crisp(at: vec2<f32>, width: f32) -> vec2<f32> {
    let offset = select(0.0, 0.5, fract(width * 0.5) > 0.0);
    return floor(view.origin + at - offset + 0.5) + offset - view.origin;
}

@vertex
fn vertex(line: Line, @builtin(vertex_index) index: u32) -> Fragment {
    var start = to_pixels(line.start);
    var end = to_pixels(line.end);
    var width = max(line.width * view.pixels_per_point, 1.0);
    if line.ends == CRISP {
        width = round(width);
        start = crisp(start, width);
        end = crisp(end, width);
    }
    let along = end - start;
    let span = length(along);
    let direction = select(vec2(1.0, 0.0), along / span, span > 0.0);
    let normal = vec2(-direction.y, direction.x);
    let reach = 0.5 * width + 1.0;
    let corner = unit_corner(index);
    let at = start + direction * mix(-reach, span + reach, corner.x) + normal * mix(-reach, reach, corner.y);
    var out: Fragment;
    out.position = to_clip(at);
    out.start = start;
    out.along = along;
    out.half_width = 0.5 * width;
    out.ends = line.ends;
    out.colour = line.colour;
    return out;
}

@fragment
fn fragment(in: Fragment) -> @location(0) vec4<f32> {
    let p = in.position.xy - view.origin - in.start;
    if in.ends == ROUND {
        return premultiplied(in.colour, coverage(capsule(p, in.along, in.half_width)));
    }
    let span = max(length(in.along), 1e-6);
    let direction = in.along / span;
    let along = dot(p, direction);
    let across = abs(dot(p, vec2(-direction.y, direction.x)));
    let within = select(0.0, 1.0, along >= 0.0 && along < span);
    return premultiplied(in.colour, within * coverage(across - in.half_width));
}
