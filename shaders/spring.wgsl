// Springs: a coil seen from the side, a zigzag between two straight stubs. The strokes at the back are fainter.

struct Spring {
    @location(0) start: vec2<f32>,
    @location(1) end: vec2<f32>,
    // Half the coil's width, width of the wire, length of a stub.
    @location(2) sizes: vec3<f32>,
    @location(3) windings: f32,
    @location(4) colour: vec4<f32>,
}

struct Fragment {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat) start: vec2<f32>,
    @location(1) @interpolate(flat) direction: vec2<f32>,
    // Length, half the coil's width, half the wire's width, length of a stub [px].
    @location(2) @interpolate(flat) sizes: vec4<f32>,
    @location(3) @interpolate(flat) windings: f32,
    @location(4) @interpolate(flat) colour: vec4<f32>,
}

@vertex
fn vertex(spring: Spring, @builtin(vertex_index) index: u32) -> Fragment {
    let start = to_pixels(spring.start);
    let along = to_pixels(spring.end) - start;
    let span = length(along);
    let direction = select(vec2(1.0, 0.0), along / span, span > 0.0);
    let normal = vec2(-direction.y, direction.x);
    let scaled = spring.sizes * view.pixels_per_point;
    let half_wire = max(0.5 * scaled.y, 0.5);
    let reach = half_wire + 1.0;
    let wide = scaled.x + reach;
    let corner = unit_corner(index);
    let at = start + direction * mix(-reach, span + reach, corner.x) + normal * mix(-wide, wide, corner.y);
    var out: Fragment;
    out.position = to_clip(at);
    out.start = start;
    out.direction = direction;
    out.sizes = vec4(span, scaled.x, half_wire, min(scaled.z, 0.5 * span));
    out.windings = spring.windings;
    out.colour = spring.colour;
    return out;
}

// Corner `k` of the wire, 0 … 2·windings + 1: on the axis at both ends, else on alternate sides.
fn wire_corner(k: f32, last: f32, stroke: f32, sizes: vec4<f32>) -> vec2<f32> {
    if k <= 0.0 {
        return vec2(sizes.w, 0.0);
    }
    if k >= last {
        return vec2(sizes.x - sizes.w, 0.0);
    }
    let side = select(-1.0, 1.0, fract(k * 0.5) > 0.25);
    return vec2(sizes.w + (k - 0.5) * stroke, side * sizes.y);
}

@fragment
fn fragment(in: Fragment) -> @location(0) vec4<f32> {
    let offset = in.position.xy - view.origin - in.start;
    let p = vec2(dot(offset, in.direction), dot(offset, vec2(-in.direction.y, in.direction.x)));
    let sizes = in.sizes;
    let last = 2.0 * in.windings + 1.0;
    let stroke = (sizes.x - 2.0 * sizes.w) / (last - 1.0);
    let nearest = clamp(floor((p.x - sizes.w) / max(stroke, 1e-6) + 0.5), 0.0, last - 1.0);
    let stub = vec2(sizes.w, 0.0);
    var front = min(capsule(p, stub, sizes.z), capsule(p - vec2(sizes.x - sizes.w, 0.0), stub, sizes.z));
    var back = 1e9;
    for (var i = -1.0; i <= 1.0; i += 1.0) {
        let k = clamp(nearest + i, 0.0, last - 1.0);
        let from_corner = wire_corner(k, last, stroke, sizes);
        let distance = capsule(p - from_corner, wire_corner(k + 1.0, last, stroke, sizes) - from_corner, sizes.z);
        if fract(k * 0.5) > 0.25 {
            back = min(back, distance);
        } else {
            front = min(front, distance);
        }
    }
    return over(premultiplied(in.colour, coverage(front)), premultiplied(in.colour, 0.5 * coverage(back)));
}
