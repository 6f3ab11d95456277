//! Chains and bridges at rest: links between two anchors, with a weight at every node.
//!
//! A link carries no bending, so its pull P points along it, and at a node the pulls differ by the weight: Pᵢ = P₀ + (0, w₁ + … + wᵢ).
//! Link i is the vector (lᵢ + cᵢ |Pᵢ|) Pᵢ/|Pᵢ|, and all of them must lead from one anchor to the other: two equations for the two
//! unknowns of P₀. They are the gradient of a convex function, F(P₀) = Σ (lᵢ |Pᵢ| + ½ cᵢ |Pᵢ|²) − P₀·D, the complementary energy,
//! whose minimum Newton's method finds from anywhere if a step is halved while F would not fall.
//! Source: the funicular polygon of graphic statics; Irvine, Cable Structures, 1981, chapter 1, for the continuous limit.

use crate::engine::DVec2;

/// Links in a row from one anchor to the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Hanging {
    /// Lengths without load [m], at least one, all > 0.
    pub lengths: Vec<f64>,
    /// 1/k of each link [m/N]; 0 for a rigid one.
    pub compliances: Vec<f64>,
    /// Weight of each node between two links [N], one fewer than links, ≥ 0.
    pub weights: Vec<f64>,
    /// First anchor [m]; gravity points down the y axis.
    pub from: DVec2,
    /// Second anchor [m].
    pub to: DVec2,
}

/// Why nothing is said about a chain.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NoBalance {
    /// Rigid links that do not reach from one anchor to the other.
    #[error("rigid links of {length} m in all between anchors that are {distance} m apart: lengthen them")]
    TooShort {
        /// Of all links together [m].
        length: f64,
        /// Of the anchors [m].
        distance: f64,
    },
    /// A link without pull has no direction.
    #[error(
        "a chain that hangs in a fold, or slack: its anchors are closer than a link is long, or nothing weighs on it"
    )]
    Folded,
    /// The lists have wrong lengths, or numbers outside their ranges.
    #[error(
        "lengths, compliances and weights that do not belong together: n, n and n − 1 of them, finite, lengths above 0"
    )]
    Malformed,
}

impl Hanging {
    /// `links` equal rigid links of `length` [m] and nodes of `weight` [N] between two anchors.
    pub fn chain(links: usize, length: f64, weight: f64, from: DVec2, to: DVec2) -> Hanging {
        let weights = vec![weight; links.saturating_sub(1)];
        Hanging { lengths: vec![length; links], compliances: vec![0.0; links], weights, from, to }
    }

    /// Nodes, anchors included [m], and the tension of each link [N], to some ulps of the whole length.
    pub fn balance(&self) -> Result<(Vec<DVec2>, Vec<f64>), NoBalance> {
        self.check()?;
        let mut pull = self.guess();
        let mut best = (f64::INFINITY, pull);
        for _ in 0..200 {
            let (gradient, [xx, xy, yy]) = self.derivatives(pull);
            // Near the minimum rounding makes the gradient wander: the smallest one is the answer.
            if gradient.length() < best.0 {
                best = (gradient.length(), pull);
            } else if best.0 < 1e-10 * self.total_length() {
                break;
            }
            let determinant = xx * yy - xy * xy;
            let step = DVec2::new(yy * gradient.x - xy * gradient.y, xx * gradient.y - xy * gradient.x) / determinant;
            // Close to the minimum F is too flat to tell, and the gradient does.
            let (before, mut part) = (self.complementary_energy(pull), 1.0);
            let is_better = |at: DVec2| {
                let energy = self.complementary_energy(at);
                let flat = (energy - before).abs() < 1e-12 * before.abs();
                energy < before || flat && self.derivatives(at).0.length() < gradient.length()
            };
            while part > 1e-9 && !is_better(pull - part * step) {
                part *= 0.5;
            }
            pull -= part * step;
        }
        if best.0 < 1e-10 * self.total_length() { Ok(self.shape(best.1)) } else { Err(NoBalance::Folded) }
    }

    fn check(&self) -> Result<(), NoBalance> {
        let (n, loads) = (self.lengths.len(), self.weights.len());
        let sound = |values: &[f64], least: f64| values.iter().all(|v| v.is_finite() && *v >= least);
        let counted = n > 0 && self.compliances.len() == n && loads + 1 == n;
        if !counted
            || !sound(&self.lengths, f64::MIN_POSITIVE)
            || !sound(&self.compliances, 0.0)
            || !sound(&self.weights, 0.0)
        {
            return Err(NoBalance::Malformed);
        }
        let (length, distance) = (self.total_length(), (self.to - self.from).length());
        if distance >= length && self.compliances.iter().all(|c| *c == 0.0) {
            return Err(NoBalance::TooShort { length, distance });
        }
        // Straight down or without weight the links are free to fold anywhere.
        if (self.to.x - self.from.x).abs() < 1e-9 * length || self.weights.iter().sum::<f64>() <= 0.0 {
            return Err(NoBalance::Folded);
        }
        Ok(())
    }

    fn total_length(&self) -> f64 {
        self.lengths.iter().sum()
    }

    /// The parabola's tension, which is right for flat chains and a beginning for others.
    fn guess(&self) -> DVec2 {
        let (d, length, weight) = (self.to - self.from, self.total_length(), self.weights.iter().sum::<f64>());
        let slack = (length * length - d.length_squared()).max(1e-4 * length * length).sqrt();
        DVec2::new(0.5 * weight * d.x / slack, -0.5 * weight)
    }

    /// Pull of every link for a pull of the first.
    fn pulls(&self, first: DVec2) -> impl Iterator<Item = DVec2> + '_ {
        let mut pull = first;
        (0..self.lengths.len()).map(move |i| {
            pull.y += if i == 0 { 0.0 } else { self.weights[i - 1] };
            pull
        })
    }

    fn complementary_energy(&self, first: DVec2) -> f64 {
        let own = |(i, pull): (usize, DVec2)| {
            self.lengths[i] * pull.length() + 0.5 * self.compliances[i] * pull.length_squared()
        };
        self.pulls(first).enumerate().map(own).sum::<f64>() - first.dot(self.to - self.from)
    }

    /// Gradient of the complementary energy, which is the gap at the far anchor, and its second derivatives xx, xy, yy.
    fn derivatives(&self, first: DVec2) -> (DVec2, [f64; 3]) {
        let (mut gap, mut hessian) = (self.from - self.to, [0.0; 3]);
        for (i, pull) in self.pulls(first).enumerate() {
            let (size, compliance) = (pull.length().max(f64::MIN_POSITIVE), self.compliances[i]);
            let along = pull / size;
            gap += self.lengths[i] * along + compliance * pull;
            let across = self.lengths[i] / size;
            hessian[0] += across * along.y * along.y + compliance;
            hessian[1] -= across * along.x * along.y;
            hessian[2] += across * along.x * along.x + compliance;
        }
        (gap, hessian)
    }

    fn shape(&self, first: DVec2) -> (Vec<DVec2>, Vec<f64>) {
        let (mut nodes, mut tensions) = (vec![self.from], Vec::new());
        for (i, pull) in self.pulls(first).enumerate() {
            let size = pull.length();
            nodes.push(nodes[i] + (self.lengths[i] / size + self.compliances[i]) * pull);
            tensions.push(size);
        }
        (nodes, tensions)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Worst force left over at a node [N], from the geometry alone, and gap at the far anchor [m].
    fn out_of_balance(chain: &Hanging) -> (f64, f64) {
        let (nodes, tensions) = chain.balance().unwrap();
        let along = |i: usize| (nodes[i + 1] - nodes[i]).normalize();
        let left_over =
            |i: usize| (tensions[i + 1] * along(i + 1) - tensions[i] * along(i) - chain.weights[i] * DVec2::Y).length();
        let worst = (0..chain.weights.len()).map(left_over).fold(0.0, f64::max);
        (worst, (nodes[nodes.len() - 1] - chain.to).length())
    }

    #[test]
    fn chains_and_loaded_bridges_are_in_balance_at_every_node() {
        let to = DVec2::new(8.0, 1.0);
        let chain = Hanging::chain(100, 0.1, 1.0, DVec2::ZERO, to);
        let mut bridge = Hanging::chain(60, 0.175, 10.0, DVec2::ZERO, DVec2::new(10.0, 0.0));
        bridge.weights[29] = 500.0;
        let soft = Hanging { compliances: vec![1e-3; 100], lengths: vec![0.05; 100], ..chain.clone() };
        let deep = Hanging::chain(200, 0.1, 1.0, DVec2::ZERO, DVec2::new(0.3, -0.03));
        let flat = Hanging::chain(50, 0.1, 1.0, DVec2::ZERO, DVec2::new(-4.999_99, 0.0));
        for (name, chain) in [("chain", chain), ("bridge", bridge), ("soft", soft), ("deep", deep), ("flat", flat)] {
            let (force, gap) = out_of_balance(&chain);
            let scale = chain.weights.iter().sum::<f64>();
            println!("{name}: {:.1e} of the weight left over, anchor {gap:.1e} m off", force / scale);
            // Directions are differences of rounded positions: an ulp of 10 m over 0.1 m, times the tension, which in the
            // flat chain is 300 times its weight.
            assert!(force < 1e-10 * scale && gap < 1e-11, "{name}: {force:e}, {gap:e}");
        }
    }

    #[test]
    fn a_single_weight_hangs_in_the_triangle_of_its_links() {
        let chain =
            Hanging { lengths: vec![3.0, 4.0], ..Hanging::chain(2, 1.0, 10.0, DVec2::ZERO, DVec2::new(5.0, 0.0)) };
        let (nodes, tensions) = chain.balance().unwrap();
        // A right angle at the weight: 1.8 m along, 2.4 m down; each link carries the weight's part along it.
        assert!((nodes[1] - DVec2::new(1.8, -2.4)).length() < 1e-14);
        assert!((tensions[0] - 8.0).abs() < 1e-13 && (tensions[1] - 6.0).abs() < 1e-13);
    }

    #[test]
    fn short_links_tend_to_the_catenary_with_order_two() {
        // Half the length s = 5 and half the span x = 4 fix the parameter: a sinh(x/a) = s; sag a (cosh(x/a) − 1).
        let (mut low, mut high) = (0.1, 100.0);
        for _ in 0..200 {
            let a = 0.5 * (low + high);
            *(if a * f64::sinh(4.0 / a) > 5.0 { &mut low } else { &mut high }) = a;
        }
        let sag = low * (f64::cosh(4.0 / low) - 1.0);
        let error = |links: usize| {
            // The nodes next to the anchors leave half a link's weight to them.
            let chain = Hanging::chain(links, 10.0 / links as f64, 1.0, DVec2::ZERO, DVec2::new(8.0, 0.0));
            chain.balance().unwrap().0[links / 2].y + sag
        };
        let [coarse, fine] = [100, 200].map(error);
        println!("sag {sag:.6} m: {coarse:.1e} and {fine:.1e} off");
        assert!(((coarse / fine).log2() - 2.0).abs() < 0.05, "{coarse:e}, {fine:e}");
    }

    #[test]
    fn what_has_no_single_balance_is_refused() {
        let refused = |chain: Hanging| chain.balance().unwrap_err();
        let at = |x, y| DVec2::new(x, y);
        assert!(matches!(
            refused(Hanging::chain(10, 0.1, 1.0, at(0.0, 0.0), at(1.0, 0.1))),
            NoBalance::TooShort { .. }
        ));
        assert_eq!(refused(Hanging::chain(10, 0.1, 1.0, at(0.0, 0.0), at(0.0, 0.5))), NoBalance::Folded);
        assert_eq!(refused(Hanging::chain(10, 0.1, 0.0, at(0.0, 0.0), at(0.5, 0.0))), NoBalance::Folded);
        assert_eq!(refused(Hanging::chain(10, f64::NAN, 1.0, at(0.0, 0.0), at(0.5, 0.0))), NoBalance::Malformed);
        assert_eq!(refused(Hanging::chain(0, 0.1, 1.0, at(0.0, 0.0), at(0.5, 0.0))), NoBalance::Malformed);
    }
}
