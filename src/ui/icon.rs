//! Icons, drawn as strokes in a square, so that they are sharp at every scale and need no glyph.

use egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, Vec2};

/// What can be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Icon {
    Run,
    Pause,
    Step,
    Restart,
    Slower,
    Faster,
    Undo,
    Redo,
    Hand,
    Pointer,
    Cut,
    Rod,
    Spring,
    Rope,
    Wall,
    Particle,
    Disc,
    Dumbbell,
    SpringPair,
    Chain,
    Cloth,
    Pile,
    Help,
    Search,
    Panels,
    Left,
    Right,
    Fit,
    Light,
    Dark,
}

/// Draws `icon` into the square `rect`.
pub fn paint(painter: &Painter, rect: Rect, icon: Icon, colour: Color32) {
    Pen { painter, rect, stroke: Stroke::new(1.5, colour) }.draw(icon);
}

/// Draws in the unit square, y down.
struct Pen<'a> {
    painter: &'a Painter,
    rect: Rect,
    stroke: Stroke,
}

impl Pen<'_> {
    fn at(&self, (x, y): (f32, f32)) -> Pos2 {
        self.rect.min + Vec2::new(x, y) * self.rect.size()
    }

    fn line(&self, points: &[(f32, f32)]) {
        let points = points.iter().map(|&point| self.at(point)).collect();
        self.painter.add(Shape::line(points, self.stroke));
    }

    fn fill(&self, points: &[(f32, f32)]) {
        let points = points.iter().map(|&point| self.at(point)).collect();
        self.painter.add(Shape::convex_polygon(points, self.stroke.color, Stroke::NONE));
    }

    fn dot(&self, centre: (f32, f32), radius: f32) {
        self.painter.circle_filled(self.at(centre), radius * self.rect.width(), self.stroke.color);
    }

    fn ring(&self, centre: (f32, f32), radius: f32) {
        self.painter.circle_stroke(self.at(centre), radius * self.rect.width(), self.stroke);
    }

    /// Part of a circle, from one angle to another [turns, clockwise from the right].
    fn arc(&self, centre: (f32, f32), radius: f32, from: f32, to: f32) {
        let points: Vec<_> = (0..=16)
            .map(|i| {
                let angle = std::f32::consts::TAU * (from + (to - from) * i as f32 / 16.0);
                (centre.0 + radius * angle.cos(), centre.1 + radius * angle.sin())
            })
            .collect();
        self.line(&points);
    }

    fn draw(&self, icon: Icon) {
        match icon {
            Icon::Run | Icon::Pause | Icon::Step | Icon::Slower | Icon::Faster => self.transport(icon),
            Icon::Restart | Icon::Undo | Icon::Redo => self.turns(icon),
            Icon::Hand | Icon::Pointer | Icon::Cut | Icon::Rod | Icon::Spring | Icon::Rope | Icon::Wall => {
                self.tools(icon);
            }
            Icon::Particle
            | Icon::Disc
            | Icon::Dumbbell
            | Icon::SpringPair
            | Icon::Chain
            | Icon::Cloth
            | Icon::Pile => self.things(icon),
            Icon::Help
            | Icon::Search
            | Icon::Panels
            | Icon::Left
            | Icon::Right
            | Icon::Fit
            | Icon::Light
            | Icon::Dark => self.signs(icon),
        }
    }

    fn transport(&self, icon: Icon) {
        match icon {
            Icon::Run => self.fill(&[(0.25, 0.12), (0.88, 0.5), (0.25, 0.88)]),
            Icon::Pause => {
                self.fill(&[(0.2, 0.14), (0.4, 0.14), (0.4, 0.86), (0.2, 0.86)]);
                self.fill(&[(0.6, 0.14), (0.8, 0.14), (0.8, 0.86), (0.6, 0.86)]);
            }
            Icon::Step => {
                self.fill(&[(0.15, 0.16), (0.66, 0.5), (0.15, 0.84)]);
                self.fill(&[(0.72, 0.16), (0.86, 0.16), (0.86, 0.84), (0.72, 0.84)]);
            }
            Icon::Slower => self.line(&[(0.2, 0.5), (0.8, 0.5)]),
            _ => {
                self.line(&[(0.2, 0.5), (0.8, 0.5)]);
                self.line(&[(0.5, 0.2), (0.5, 0.8)]);
            }
        }
    }

    fn turns(&self, icon: Icon) {
        match icon {
            Icon::Restart => {
                self.arc((0.5, 0.53), 0.35, -0.17, 0.62);
                self.fill(&[(0.56, 0.02), (0.94, 0.12), (0.68, 0.4)]);
            }
            Icon::Undo => {
                self.line(&[(0.36, 0.14), (0.12, 0.36), (0.36, 0.58)]);
                self.line(&[(0.12, 0.36), (0.6, 0.36)]);
                self.arc((0.6, 0.6), 0.24, -0.25, 0.25);
                self.line(&[(0.6, 0.84), (0.36, 0.84)]);
            }
            _ => {
                self.line(&[(0.64, 0.14), (0.88, 0.36), (0.64, 0.58)]);
                self.line(&[(0.88, 0.36), (0.4, 0.36)]);
                self.arc((0.4, 0.6), 0.24, 0.25, 0.75);
                self.line(&[(0.4, 0.84), (0.64, 0.84)]);
            }
        }
    }

    fn tools(&self, icon: Icon) {
        match icon {
            // Four arrows: what is dragged goes anywhere.
            Icon::Hand => {
                self.line(&[(0.5, 0.08), (0.5, 0.92)]);
                self.line(&[(0.08, 0.5), (0.92, 0.5)]);
                self.line(&[(0.36, 0.22), (0.5, 0.08), (0.64, 0.22)]);
                self.line(&[(0.36, 0.78), (0.5, 0.92), (0.64, 0.78)]);
                self.line(&[(0.22, 0.36), (0.08, 0.5), (0.22, 0.64)]);
                self.line(&[(0.78, 0.36), (0.92, 0.5), (0.78, 0.64)]);
            }
            Icon::Pointer => {
                self.fill(&[(0.24, 0.06), (0.8, 0.6), (0.24, 0.66)]);
                self.fill(&[(0.24, 0.06), (0.38, 0.5), (0.24, 0.84)]);
                self.line(&[(0.44, 0.56), (0.6, 0.92)]);
            }
            Icon::Cut => {
                self.ring((0.24, 0.76), 0.14);
                self.ring((0.76, 0.76), 0.14);
                self.line(&[(0.32, 0.65), (0.72, 0.08)]);
                self.line(&[(0.68, 0.65), (0.28, 0.08)]);
            }
            Icon::Rod => {
                self.line(&[(0.2, 0.8), (0.8, 0.2)]);
                self.dot((0.18, 0.82), 0.13);
                self.dot((0.82, 0.18), 0.13);
            }
            Icon::Spring => self.line(&[
                (0.06, 0.5),
                (0.2, 0.5),
                (0.28, 0.24),
                (0.42, 0.76),
                (0.56, 0.24),
                (0.7, 0.76),
                (0.8, 0.5),
                (0.94, 0.5),
            ]),
            Icon::Rope => {
                self.dot((0.12, 0.22), 0.1);
                self.dot((0.88, 0.22), 0.1);
                self.sag();
            }
            _ => {
                self.line(&[(0.08, 0.4), (0.92, 0.4)]);
                for x in [0.1, 0.34, 0.58, 0.82] {
                    self.line(&[(x + 0.1, 0.42), (x - 0.04, 0.72)]);
                }
            }
        }
    }

    fn sag(&self) {
        let points: Vec<_> = (0..=12)
            .map(|i| {
                let x = i as f32 / 6.0 - 1.0;
                (0.5 + 0.38 * x, 0.8 - 0.58 * x * x)
            })
            .collect();
        self.line(&points);
    }

    fn things(&self, icon: Icon) {
        match icon {
            Icon::Particle => self.dot((0.5, 0.5), 0.16),
            Icon::Disc => {
                self.ring((0.5, 0.5), 0.38);
                self.line(&[(0.5, 0.5), (0.86, 0.5)]);
            }
            Icon::Dumbbell => {
                self.line(&[(0.25, 0.5), (0.75, 0.5)]);
                self.dot((0.18, 0.5), 0.16);
                self.dot((0.82, 0.5), 0.16);
            }
            Icon::SpringPair => {
                self.dot((0.12, 0.5), 0.12);
                self.dot((0.88, 0.5), 0.12);
                self.line(&[(0.2, 0.5), (0.3, 0.28), (0.43, 0.72), (0.57, 0.28), (0.7, 0.72), (0.8, 0.5)]);
            }
            Icon::Chain => {
                for (x, y) in [(0.14, 0.2), (0.3, 0.54), (0.5, 0.7), (0.7, 0.54), (0.86, 0.2)] {
                    self.dot((x, y), 0.08);
                }
                self.line(&[(0.14, 0.2), (0.3, 0.54), (0.5, 0.7), (0.7, 0.54), (0.86, 0.2)]);
            }
            Icon::Cloth => {
                for t in [0.14, 0.5, 0.86] {
                    self.line(&[(0.14, t), (0.86, t)]);
                    self.line(&[(t, 0.14), (t, 0.86)]);
                }
            }
            _ => {
                for centre in [(0.2, 0.78), (0.5, 0.78), (0.8, 0.78), (0.35, 0.51), (0.65, 0.51), (0.5, 0.24)] {
                    self.ring(centre, 0.13);
                }
            }
        }
    }

    fn signs(&self, icon: Icon) {
        match icon {
            Icon::Help => {
                self.arc((0.5, 0.34), 0.22, 0.5, 1.15);
                self.line(&[(0.63, 0.52), (0.5, 0.62), (0.5, 0.7)]);
                self.dot((0.5, 0.86), 0.07);
            }
            Icon::Search => {
                self.ring((0.42, 0.42), 0.28);
                self.line(&[(0.63, 0.63), (0.9, 0.9)]);
            }
            Icon::Panels => {
                self.line(&[(0.1, 0.16), (0.9, 0.16), (0.9, 0.84), (0.1, 0.84), (0.1, 0.16)]);
                self.line(&[(0.34, 0.16), (0.34, 0.84)]);
                self.line(&[(0.66, 0.16), (0.66, 0.84)]);
            }
            Icon::Left | Icon::Right => {
                self.line(&[(0.1, 0.16), (0.9, 0.16), (0.9, 0.84), (0.1, 0.84), (0.1, 0.16)]);
                let x = if icon == Icon::Left { 0.1 } else { 0.6 };
                self.fill(&[(x, 0.16), (x + 0.3, 0.16), (x + 0.3, 0.84), (x, 0.84)]);
            }
            Icon::Fit => {
                for (x, y) in [(0.1, 0.1), (0.9, 0.1), (0.1, 0.9), (0.9, 0.9)] {
                    let inwards = |t: f32| if t < 0.5 { t + 0.24 } else { t - 0.24 };
                    self.line(&[(inwards(x), y), (x, y), (x, inwards(y))]);
                }
                self.dot((0.5, 0.5), 0.12);
            }
            Icon::Light => {
                self.ring((0.5, 0.5), 0.2);
                for i in 0..8 {
                    let (sin, cos) = (std::f32::consts::TAU * i as f32 / 8.0).sin_cos();
                    self.line(&[(0.5 + 0.32 * cos, 0.5 + 0.32 * sin), (0.5 + 0.44 * cos, 0.5 + 0.44 * sin)]);
                }
            }
            _ => {
                // A crescent: most of a circle, and the shadow's edge between its two ends.
                self.arc((0.48, 0.52), 0.38, 0.07, 0.68);
                self.arc((0.66, 0.32), 0.32, 0.28, 0.53);
            }
        }
    }
}
