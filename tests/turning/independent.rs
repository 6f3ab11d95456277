//! Gragg's modified midpoint rule extrapolated by Bulirsch and Stoer (Hairer, Nørsett, Wanner, Solving ODEs I, II.9), and chains of
//! bodies pinned to one another in the angles alone.

/// Columns of the table: order 16.
const COLUMNS: usize = 8;

/// y after `time` in `steps` steps of y' = `rate`(t, y).
pub fn integrate(rate: impl Fn(f64, &[f64]) -> Vec<f64>, y: &[f64], time: f64, steps: usize) -> Vec<f64> {
    let h = time / steps as f64;
    (0..steps).fold(y.to_vec(), |y, i| extrapolated(&rate, &y, i as f64 * h, h))
}

/// The same, and how far the result is from that of half as many steps.
pub fn converged(rate: impl Fn(f64, &[f64]) -> Vec<f64>, y: &[f64], time: f64, steps: usize) -> (Vec<f64>, f64) {
    let (fine, coarse) = (integrate(&rate, y, time, steps), integrate(&rate, y, time, steps / 2));
    let apart = fine.iter().zip(&coarse).fold(0.0f64, |most, (a, b)| most.max((a - b).abs()));
    (fine, apart)
}

fn extrapolated(rate: &impl Fn(f64, &[f64]) -> Vec<f64>, y: &[f64], t: f64, h: f64) -> Vec<f64> {
    let mut table: Vec<Vec<f64>> = Vec::new();
    for i in 0..COLUMNS {
        let mut row = midpoint(rate, y, t, h, 2 * (i + 1));
        // Aitken and Neville in h², from right to left in place: table[j] becomes T(i, j).
        for (j, entry) in table.iter_mut().enumerate() {
            let ratio = ((i + 1) as f64 / (i - j) as f64).powi(2);
            let next: Vec<f64> = row.iter().zip(&*entry).map(|(new, old)| new + (new - old) / (ratio - 1.0)).collect();
            *entry = std::mem::replace(&mut row, next);
        }
        table.push(row);
    }
    table.pop().unwrap()
}

fn midpoint(rate: &impl Fn(f64, &[f64]) -> Vec<f64>, y: &[f64], t: f64, h: f64, n: usize) -> Vec<f64> {
    let part = h / n as f64;
    let go = |from: &[f64], by: f64, rate: &[f64]| -> Vec<f64> {
        from.iter().zip(rate).map(|(from, rate)| from + by * rate).collect()
    };
    let (mut before, mut now) = (y.to_vec(), go(y, part, &rate(t, y)));
    for i in 1..n {
        let next = go(&before, 2.0 * part, &rate(t + i as f64 * part, &now));
        (before, now) = (now, next);
    }
    now
}

/// A body of a chain: it hangs on a pin at its upper end, and the next on its lower one.
#[derive(Clone, Copy)]
pub struct Link {
    /// [kg], [kg·m²] about the centre
    pub mass: f64,
    pub inertia: f64,
    /// Distance of the centre, and of the lower pin, from the upper pin [m].
    pub centre: f64,
    pub length: f64,
}

/// Angles from straight down, then their rates, differentiated: Σ_k M_jk θ_k'' = −Σ_k S_jk sin(θ_j − θ_k) θ_k'² − g sin θ_j Σ_i m_i a_ij.
///
/// From the Lagrangian with x_i = Σ_j a_ij (sin θ_j, −cos θ_j), S_jk = Σ_i m_i a_ij a_ik, M_jk = S_jk cos(θ_j − θ_k) + I_j δ_jk.
pub fn chain_rate(links: &[Link], gravity: f64, y: &[f64]) -> Vec<f64> {
    let n = links.len();
    let (angle, rate) = y.split_at(n);
    let reach = |i: usize, j: usize| match i.cmp(&j) {
        std::cmp::Ordering::Less => 0.0,
        std::cmp::Ordering::Equal => links[j].centre,
        std::cmp::Ordering::Greater => links[j].length,
    };
    let coupling = |j: usize, k: usize| (0..n).map(|i| links[i].mass * reach(i, j) * reach(i, k)).sum::<f64>();
    let mut matrix = nalgebra::DMatrix::zeros(n, n);
    let mut force = nalgebra::DVector::zeros(n);
    for j in 0..n {
        for k in 0..n {
            let (s, between) = (coupling(j, k), angle[j] - angle[k]);
            matrix[(j, k)] = s * between.cos();
            force[j] -= s * between.sin() * rate[k] * rate[k];
        }
        matrix[(j, j)] += links[j].inertia;
        force[j] -= gravity * angle[j].sin() * (0..n).map(|i| links[i].mass * reach(i, j)).sum::<f64>();
    }
    let acceleration = matrix.lu().solve(&force).expect("a positive definite mass matrix");
    rate.iter().chain(acceleration.iter()).copied().collect()
}

#[test]
fn the_extrapolation_has_the_order_that_it_claims() {
    // y'' = −y over 10 s: from y = 1 at rest to cos 10.
    let error = |steps| {
        let y = integrate(|_, y| vec![y[1], -y[0]], &[1.0, 0.0], 10.0, steps);
        (y[0] - 10.0f64.cos()).abs()
    };
    let (coarse, fine) = (error(6), error(9));
    let order = (coarse / fine).ln() / 1.5f64.ln();
    println!("extrapolated midpoint rule: {coarse:.1e} and {fine:.1e}, order {order:.1}");
    assert!(order > 14.0 && error(20) < 1e-13, "{coarse:e}, {fine:e}, {:e}", error(20));
}
