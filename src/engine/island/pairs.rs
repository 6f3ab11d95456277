//! The pairs of nodes that rods or springs join, and the loops over them.
//!
//! Ropes, cloth and nets number their nodes along rows, so that from one pair to the next both ends go up by one: a run. Its
//! differences and sums are then loops over slices, which the compiler works off side by side, where single pairs have to be
//! gathered and wait for each other's sums. Pairs sorted by the distance of their ends ([`order`]) form the longest runs.

/// Runs shorter than this cost more than they save.
const SHORTEST: usize = 4;

/// Ends by pair, and the runs that they form.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pairs {
    a: Vec<u32>,
    b: Vec<u32>,
    parts: Vec<Part>,
}

/// Consecutive pairs: a run from nodes `a` and `b` on, or such that form none.
#[derive(Clone, Copy, Debug)]
struct Part {
    first: usize,
    count: usize,
    run: Option<(usize, usize)>,
}

/// The order that makes the longest runs of these pairs; equal ones stay as they are.
pub(crate) fn order(a: u32, b: u32) -> (i64, u32) {
    (i64::from(b) - i64::from(a), a)
}

impl Pairs {
    pub fn new(a: &[u32], b: &[u32]) -> Pairs {
        let mut pairs = Pairs { a: a.to_vec(), b: b.to_vec(), parts: Vec::new() };
        let follows = |k: usize| a[k] == a[k - 1] + 1 && b[k] == b[k - 1] + 1;
        let mut first = 0;
        while first < a.len() {
            let count = 1 + (first + 1..a.len()).take_while(|k| follows(*k)).count();
            let run = (count >= SHORTEST).then_some((a[first] as usize, b[first] as usize));
            match pairs.parts.last_mut().filter(|last| last.run.is_none() && run.is_none()) {
                Some(last) => last.count += count,
                None => pairs.parts.push(Part { first, count, run }),
            }
            first += count;
        }
        pairs
    }

    /// to = x_b − x_a
    pub fn differences(&self, x: &[f64], to: &mut [f64]) {
        for part in &self.parts {
            self.part_differences(part, 0..part.count, x, &mut to[part.first..part.first + part.count]);
        }
    }

    #[inline]
    fn part_differences(&self, part: &Part, range: std::ops::Range<usize>, x: &[f64], to: &mut [f64]) {
        let n = range.len();
        if let Some((a, b)) = part.run {
            let (xa, xb, to) = (&x[a + range.start..][..n], &x[b + range.start..][..n], &mut to[..n]);
            for k in 0..n {
                to[k] = xb[k] - xa[k];
            }
            return;
        }
        let from = part.first + range.start;
        for ((to, a), b) in to.iter_mut().zip(&self.a[from..from + n]).zip(&self.b[from..from + n]) {
            *to = x[*b as usize] - x[*a as usize];
        }
    }

    /// x_a −= f, x_b += f
    pub fn add(&self, f: &[f64], x: &mut [f64]) {
        for part in &self.parts {
            self.part_add(part, 0..part.count, &f[part.first..part.first + part.count], x);
        }
    }

    #[inline]
    fn part_add(&self, part: &Part, range: std::ops::Range<usize>, f: &[f64], x: &mut [f64]) {
        let n = range.len();
        if let Some((a, b)) = part.run {
            let f = &f[..n];
            let to = &mut x[a + range.start..][..n];
            (0..n).for_each(|k| to[k] -= f[k]);
            let to = &mut x[b + range.start..][..n];
            (0..n).for_each(|k| to[k] += f[k]);
            return;
        }
        let from = part.first + range.start;
        for ((f, a), b) in f.iter().zip(&self.a[from..from + n]).zip(&self.b[from..from + n]) {
            x[*a as usize] -= f;
            x[*b as usize] += f;
        }
    }

    /// x_a += s, x_b += s
    #[inline]
    fn part_add_to_both(&self, part: &Part, range: std::ops::Range<usize>, s: &[f64], x: &mut [f64]) {
        let n = range.len();
        if let Some((a, b)) = part.run {
            for end in [a, b] {
                let (to, s) = (&mut x[end + range.start..][..n], &s[..n]);
                (0..n).for_each(|k| to[k] += s[k]);
            }
            return;
        }
        let from = part.first + range.start;
        for ((s, a), b) in s.iter().zip(&self.a[from..from + n]).zip(&self.b[from..from + n]) {
            x[*a as usize] += s;
            x[*b as usize] += s;
        }
    }

    /// x_a −= w_a f, x_b += w_b f
    pub fn add_weighted(&self, w: &[f64], f: &[f64], x: &mut [f64]) {
        for part in &self.parts {
            let (first, n) = (part.first, part.count);
            let f = &f[first..first + n];
            let Some((a, b)) = part.run else {
                for ((a, b), f) in self.a[first..first + n].iter().zip(&self.b[first..first + n]).zip(f) {
                    let (a, b) = (*a as usize, *b as usize);
                    x[a] -= w[a] * f;
                    x[b] += w[b] * f;
                }
                continue;
            };
            let (to, w_a) = (&mut x[a..][..n], &w[a..][..n]);
            (0..n).for_each(|k| to[k] -= w_a[k] * f[k]);
            let (to, w_b) = (&mut x[b..][..n], &w[b..][..n]);
            (0..n).for_each(|k| to[k] += w_b[k] * f[k]);
        }
    }

    /// x_a −= w_a λ d, x_b += w_b λ d
    pub fn push(&self, w: &[f64], lambda: &[f64], d: &[f64], x: &mut [f64]) {
        for part in &self.parts {
            let range = part.first..part.first + part.count;
            let (lambda, d) = (&lambda[range.clone()], &d[range.clone()]);
            match part.run {
                Some((a, b)) if b == a + 1 => push_chain(&w[a..], lambda, d, &mut x[a..]),
                Some((a, b)) => push_run((&w[a..], &w[b..]), lambda, d, x, (a, b)),
                None => {
                    let ends = self.a[range.clone()].iter().zip(&self.b[range]);
                    for ((a, b), (lambda, d)) in ends.zip(lambda.iter().zip(d)) {
                        let (a, b, f) = (*a as usize, *b as usize, lambda * d);
                        x[a] -= w[a] * f;
                        x[b] += w[b] * f;
                    }
                }
            }
        }
    }

    /// Goes over the pairs in blocks of at most `SIDE`, all of one part: for what is worth keeping in registers and the nearest
    /// memory between gathering and adding up.
    #[inline]
    pub fn blocks<const SIDE: usize>(&self) -> impl Iterator<Item = Block<'_>> {
        self.parts.iter().flat_map(move |part| {
            (0..part.count).step_by(SIDE).map(move |start| Block {
                pairs: self,
                part,
                start,
                count: SIDE.min(part.count - start),
            })
        })
    }
}

/// A run in which every pair ends where the next begins: both its forces on a node at once.
#[inline]
fn push_chain(w: &[f64], lambda: &[f64], d: &[f64], x: &mut [f64]) {
    let n = lambda.len();
    x[0] -= w[0] * (lambda[0] * d[0]);
    x[n] += w[n] * (lambda[n - 1] * d[n - 1]);
    let (before, after) = ((&lambda[..n - 1], &d[..n - 1]), (&lambda[1..n], &d[1..n]));
    let (w, x) = (&w[1..n], &mut x[1..n]);
    for k in 0..n - 1 {
        x[k] += w[k] * (before.0[k] * before.1[k] - after.0[k] * after.1[k]);
    }
}

#[inline]
fn push_run((w_a, w_b): (&[f64], &[f64]), lambda: &[f64], d: &[f64], x: &mut [f64], (a, b): (usize, usize)) {
    let n = lambda.len();
    let d = &d[..n];
    let (to, w) = (&mut x[a..][..n], &w_a[..n]);
    (0..n).for_each(|k| to[k] -= w[k] * (lambda[k] * d[k]));
    let (to, w) = (&mut x[b..][..n], &w_b[..n]);
    (0..n).for_each(|k| to[k] += w[k] * (lambda[k] * d[k]));
}

/// Some consecutive pairs.
pub(crate) struct Block<'a> {
    pairs: &'a Pairs,
    part: &'a Part,
    start: usize,
    count: usize,
}

impl Block<'_> {
    /// Indices of its pairs.
    #[inline]
    pub fn range(&self) -> std::ops::Range<usize> {
        let first = self.part.first + self.start;
        first..first + self.count
    }

    #[inline]
    pub fn differences(&self, x: &[f64], to: &mut [f64]) {
        self.pairs.part_differences(self.part, self.start..self.start + self.count, x, to);
    }

    #[inline]
    pub fn add(&self, f: &[f64], x: &mut [f64]) {
        self.pairs.part_add(self.part, self.start..self.start + self.count, f, x);
    }

    #[inline]
    pub fn add_to_both(&self, s: &[f64], x: &mut [f64]) {
        self.pairs.part_add_to_both(self.part, self.start..self.start + self.count, s, x);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Runs, single pairs and runs that go backwards, against the plain loops.
    #[test]
    fn loops_over_runs_do_what_single_pairs_do() {
        let a = [0, 1, 2, 3, 4, 9, 2, 5, 6, 7, 8, 9, 1];
        let b = [1, 2, 3, 4, 5, 0, 7, 0, 1, 2, 3, 4, 8];
        let pairs = Pairs::new(&a, &b);
        assert_eq!(pairs.parts.iter().map(|part| part.count).collect::<Vec<_>>(), [5, 2, 5, 1]);
        let value = |k: usize| f64::from((7 * k as u32 + 3) % 11) - 4.0;
        let x: Vec<f64> = (0..10).map(value).collect();
        let (w, f): (Vec<f64>, Vec<f64>) =
            ((0..10).map(|k| value(k + 20)).collect(), (0..13).map(|k| value(k + 40)).collect());
        let mut found = vec![0.0; 13];
        pairs.differences(&x, &mut found);
        assert!((0..13).all(|k| found[k] == x[b[k] as usize] - x[a[k] as usize]));
        // Small whole numbers: sums are exact in any order.
        let (mut added, mut both, mut pushed) = (x.clone(), x.clone(), x.clone());
        pairs.add(&f, &mut added);
        pairs.blocks::<3>().for_each(|block| block.add_to_both(&f[block.range()], &mut both));
        pairs.push(&w, &f, &found, &mut pushed);
        let [mut expected, mut expected_both, mut expected_push] = [x.clone(), x.clone(), x.clone()];
        for k in 0..13 {
            let (a, b) = (a[k] as usize, b[k] as usize);
            (expected[a], expected[b]) = (expected[a] - f[k], expected[b] + f[k]);
            (expected_both[a], expected_both[b]) = (expected_both[a] + f[k], expected_both[b] + f[k]);
            let force = f[k] * found[k];
            (expected_push[a], expected_push[b]) = (expected_push[a] - w[a] * force, expected_push[b] + w[b] * force);
        }
        assert_eq!((&added, &both, &pushed), (&expected, &expected_both, &expected_push));
        let mut blocks = x.clone();
        for block in pairs.blocks::<2>() {
            block.add(&f[block.range()], &mut blocks);
        }
        assert_eq!(blocks, added);
        assert_eq!(pairs.blocks::<2>().map(|block| block.range().len()).sum::<usize>(), 13);
    }
}
