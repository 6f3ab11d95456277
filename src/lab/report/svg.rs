//! The work–precision diagram as a picture that is readable on light and dark ground and without telling colours apart: every
//! family has a shape of its own as well.

use super::axis::Axis;
use super::mark::{Shape, look};
use crate::lab::front::{error, plain, short};
use crate::lab::{Family, Front, Point, Setting};
use std::fmt::Write;

/// Size of the picture, and the edges of the plot in it [px].
const SIZE: [f64; 2] = [860.0, 500.0];
const LEFT: f64 = 72.0;
const RIGHT: f64 = 590.0;
const TOP: f64 = 40.0;
const BOTTOM: f64 = 440.0;

/// Colours that people with any kind of colour blindness tell apart (Okabe, Ito 2008), dark enough for white ground, and
/// light enough for dark ground; and the ink, grid and ground.
const STYLE: &str = "\
text{font:12px sans-serif;fill:#24292f}.title{font-size:15px;font-weight:600}.grid{stroke:#d0d7de;fill:none}\
.axis{stroke:#57606a;fill:none}.front{stroke:#24292f;stroke-width:2;fill:none;stroke-linejoin:round}.ground{fill:#ffffff}\
.c0{color:#0072b2}.c1{color:#d55e00}.c2{color:#007a5a}.c3{color:#b0568f}.c4{color:#2a7fb8}.c5{color:#8a6d00}.c6{color:#57606a}\
.f{fill:currentColor;stroke:currentColor}.h{fill:none;stroke:currentColor;stroke-width:1.6}.off{opacity:.55}\
.ring{fill:none;stroke:#24292f;stroke-width:1.4}\
@media(prefers-color-scheme:dark){text{fill:#e6edf3}.grid{stroke:#30363d}.axis{stroke:#8b949e}.front,.ring{stroke:#e6edf3}\
.ground{fill:#0d1117}.c0{color:#56b4e9}.c1{color:#ff9d5c}.c2{color:#3fcf9f}.c3{color:#e6a3cc}.c4{color:#8fd0ff}.c5{color:#e5c34a}\
.c6{color:#a0a8b0}}";

/// Error over cost, both logarithmic, with the front as a line. `title` is what is measured.
pub fn svg(title: &str, points: &[Point]) -> String {
    let [width, height] = SIZE;
    let mut out = String::new();
    // Writing to a String cannot fail.
    let _ = writeln!(
        out,
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" role="img">"#
    );
    let _ = writeln!(out, "<title>{}: error over cost of every method</title>\n<style>{STYLE}</style>", escape(title));
    let _ = writeln!(out, r#"<rect class="ground" width="{width}" height="{height}"/>"#);
    let _ = writeln!(out, r#"<text class="title" x="{LEFT}" y="24">{}</text>"#, escape(title));
    let shown: Vec<&Point> = points.iter().filter(|point| error(point).is_finite()).collect();
    let (costs, errors) = (shown.iter().map(|point| point.cpu_us_per_second), shown.iter().map(|point| error(point)));
    match Axis::over(costs).zip(Axis::over(errors)) {
        Some((x, y)) => {
            let plot = Plot { x, y };
            plot.grid(&mut out);
            plot.marks(&mut out, &shown, &Front::of(points));
            legend(&mut out, &shown);
        }
        None => {
            let _ = writeln!(out, r#"<text x="{LEFT}" y="70">No point has an error.</text>"#);
        }
    }
    out + "</svg>\n"
}

struct Plot {
    x: Axis,
    y: Axis,
}

impl Plot {
    fn x(&self, cost: f64) -> f64 {
        LEFT + self.x.place(cost) * (RIGHT - LEFT)
    }

    fn y(&self, error: f64) -> f64 {
        BOTTOM - self.y.place(error) * (BOTTOM - TOP)
    }

    fn grid(&self, out: &mut String) {
        let ten = |exponent: i32| libm::pow(10.0, f64::from(exponent));
        for exponent in self.x.ticks(8) {
            let x = self.x(ten(exponent));
            let _ = writeln!(out, r#"<path class="grid" d="M{x:.1} {TOP}V{BOTTOM}"/>"#);
            let _ = writeln!(
                out,
                r#"<text x="{x:.1}" y="{}" text-anchor="middle">{}</text>"#,
                BOTTOM + 18.0,
                power(exponent)
            );
        }
        for exponent in self.y.ticks(12) {
            let y = self.y(ten(exponent));
            let _ = writeln!(out, r#"<path class="grid" d="M{LEFT} {y:.1}H{RIGHT}"/>"#);
            let _ = writeln!(
                out,
                r#"<text x="{}" y="{:.1}" text-anchor="end">{}</text>"#,
                LEFT - 6.0,
                y + 4.0,
                power(exponent)
            );
        }
        let _ = writeln!(out, r#"<path class="axis" d="M{LEFT} {TOP}V{BOTTOM}H{RIGHT}"/>"#);
        let middle = 0.5 * (LEFT + RIGHT);
        let _ = writeln!(
            out,
            r#"<text x="{middle}" y="{}" text-anchor="middle">CPU time per simulated second [µs/s]</text>"#,
            BOTTOM + 42.0
        );
        let centre = 0.5 * (TOP + BOTTOM);
        let _ = writeln!(
            out,
            r#"<text transform="translate(18 {centre}) rotate(-90)" text-anchor="middle">error: RMS distance in parts of the scene's length</text>"#
        );
    }

    fn marks(&self, out: &mut String, points: &[&Point], front: &Front) {
        let place = |point: &Point| [self.x(point.cpu_us_per_second), self.y(error(point))];
        let along: Vec<String> = front.points().iter().map(place).map(|[x, y]| format!("{x:.1} {y:.1}")).collect();
        if !along.is_empty() {
            let _ = writeln!(out, r#"<path class="front" d="M{}"/>"#, along.join("L"));
        }
        // What is on the front lies on top.
        let (on, off): (Vec<&Point>, Vec<&Point>) = points.iter().partition(|point| front.contains(point));
        for (point, class) in off.iter().map(|point| (point, " off")).chain(on.iter().map(|point| (point, ""))) {
            let about = format!(
                "{}: error {} at {} µs/s",
                point.setting().label(),
                short(error(point)),
                plain(point.cpu_us_per_second)
            );
            mark(out, point.method, place(point), class, &about);
        }
        if let Some(baseline) = points.iter().find(|point| point.setting() == Setting::BASELINE) {
            let [x, y] = place(baseline);
            let _ = writeln!(out, r#"<circle class="ring" cx="{x:.1}" cy="{y:.1}" r="8"/>"#);
        }
    }
}

/// The mark of a family round a place; `about` appears under the pointer.
fn mark(out: &mut String, family: Family, [x, y]: [f64; 2], class: &str, about: &str) {
    let (shape, filled, colour) = look(family);
    let path = match shape {
        Shape::Circle => format!("M{:.1} {y:.1}a4 4 0 1 0 8 0a4 4 0 1 0-8 0z", x - 4.0),
        Shape::Square => format!("M{:.1} {:.1}h7v7h-7z", x - 3.5, y - 3.5),
        Shape::Diamond => format!("M{x:.1} {:.1}l5 5l-5 5l-5-5z", y - 5.0),
        Shape::Up => format!("M{x:.1} {:.1}l5 8.5h-10z", y - 5.0),
        Shape::Down => format!("M{x:.1} {:.1}l5-8.5h-10z", y + 5.0),
        Shape::Plus => format!("M{:.1} {y:.1}h10m-5-5v10", x - 5.0),
        Shape::Cross => format!("M{:.1} {:.1}l8 8m0-8l-8 8", x - 4.0, y - 4.0),
    };
    let kind = if filled { 'f' } else { 'h' };
    let about = escape(about);
    let _ = writeln!(out, r#"<path class="c{colour} {kind}{class}" d="{path}"><title>{about}</title></path>"#);
}

fn legend(out: &mut String, points: &[&Point]) {
    let left = RIGHT + 28.0;
    let mut y = TOP + 12.0;
    let mut line = |out: &mut String, text: &str, draw: &dyn Fn(&mut String, f64)| {
        draw(out, y);
        let _ = writeln!(out, r#"<text x="{}" y="{:.1}">{}</text>"#, left + 16.0, y + 4.0, escape(text));
        y += 21.0;
    };
    for family in Family::ALL.into_iter().filter(|family| points.iter().any(|point| point.method == *family)) {
        line(out, &family.name(), &|out, y| mark(out, family, [left, y], "", &family.name()));
    }
    line(out, "Front", &|out, y| {
        let _ = writeln!(out, r#"<path class="front" d="M{:.1} {y:.1}h16"/>"#, left - 8.0);
    });
    if points.iter().any(|point| point.setting() == Setting::BASELINE) {
        line(out, "Baseline: PGS, 4 × 10", &|out, y| {
            let _ = writeln!(out, r#"<circle class="ring" cx="{left:.1}" cy="{y:.1}" r="8"/>"#);
        });
    }
}

/// A power of ten with a raised exponent.
fn power(exponent: i32) -> String {
    match exponent {
        0 => "1".to_owned(),
        1 => "10".to_owned(),
        _ => format!(r#"10<tspan dy="-5" font-size="9">{}</tspan>"#, exponent.to_string().replace('-', "−")),
    }
}

fn escape(text: &str) -> String {
    let kept = |c: &char| !c.is_control();
    text.chars()
        .filter(kept)
        .collect::<String>()
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}
