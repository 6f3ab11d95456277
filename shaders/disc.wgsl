// Discs: a fill, a stroke inside the edge, and a spoke that shows the rotation.

struct Disc {
    @location(0) centre: vec2<f32>,
    @location(1) radius: f32,
    // Distance from the middle of the canvas to the disc's edge, found in double precision.
    @location(2) edge: f32,
    @location(3) heading: vec2<f32>,
    @location(4) stroke_width: f32,
    @location(5) fill: vec4<f32>,
    @location(6) stroke: vec4<f32>,
}

struct Fragment {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat) centre: vec2<f32>,
    // Radius, edge, stroke width [px].
    @location(1) @interpolate(flat) sizes: vec3<f32>,
    @location(2) @interpolate(flat) heading: vec2<f32>,
    @location(3) @interpolate(flat) fill: vec4<f32>,
    @location(4) @interpolate(flat) stroke: vec4<f32>,
}

// Above this radius [px] the plain distance would lose hundredths of a pixel to single precision.
const LARGE_RADIUS: f32 = 16384.0;

@vertex
fn vertex(disc: Disc, @builtin(vertex_index) index: u32) -> Fragment {
    let centre = to_pixels(disc.centre);
    let radius = disc.radius * view.pixels_per_point;
    let reach = vec2(radius + 1.0);
    let limit = view.half_size + 1.0;
    let low = clamp(centre - reach, -limit, limit);
    let high = clamp(centre + reach, -limit, limit);
    var out: Fragment;
    out.position = to_clip(mix(low, high, unit_corner(index)));
    out.centre = centre;
    out.sizes = vec3(disc.radius, disc.edge, disc.stroke_width) * view.pixels_per_point;
    out.heading = vec2(disc.heading.x, -disc.heading.y);
    out.fill = disc.fill;
    out.stroke = disc.stroke;
    return out;
}

// |p - c| - r, for a large r from its difference of squares: (|p|² - 2 p·c + |c|² - r²) / (|p - c| + r).
fn disc_distance(p: vec2<f32>, centre: vec2<f32>, radius: f32, edge: f32) -> f32 {
    let away = length(p - centre);
    if radius < LARGE_RADIUS {
        return away - radius;
    }
    return (dot(p, p) - 2.0 * dot(p, centre) + edge * (length(centre) + radius)) / (away + radius);
}

@fragment
fn fragment(in: Fragment) -> @location(0) vec4<f32> {
    let p = in.position.xy - view.origin;
    let radius = in.sizes.x;
    let distance = disc_distance(p, in.centre, radius, in.sizes.y);
    let whole = coverage(distance);
    let inner = coverage(distance + in.sizes.z);
    let spoke = capsule(p - in.centre - in.heading * (0.3 * radius), in.heading * (0.45 * radius), 0.6 * in.sizes.z);
    let marked = select(0.0, coverage(spoke), dot(in.heading, in.heading) > 0.0);
    let face = mix(in.fill, in.stroke, marked);
    return premultiplied(face, inner) + premultiplied(in.stroke, whole - inner);
}
