//! The coefficients of Radau's right-hand collocation, "IIA".
//!
//! The nodes are the roots of P_s − P_{s−1} on [0, 1], the last of them 1; the weights integrate the polynomial through the stages up to
//! each node. The stage matrix a is diagonalised, a = T μ T⁻¹, with one real eigenvalue and pairs of complex ones, of which one each is
//! kept. All numbers were calculated with 50 digits from that definition; the tests check what they must satisfy.
//!
//! Hairer and Wanner, "Solving Ordinary Differential Equations II" (1996), sections IV.5 and IV.8.

use crate::engine::linalg::complex::Complex;

/// `S` stages, `L` = (S + 1)/2 eigenvalues.
#[derive(Debug)]
pub(super) struct Scheme<const S: usize, const L: usize> {
    pub order: u32,
    /// c, in parts of the step.
    pub nodes: [f64; S],
    /// a, whose last row is also the weights of the step.
    pub weights: [[f64; S]; S],
    /// a²
    pub squared: [[f64; S]; S],
    /// μ
    pub eigenvalues: Complex<L>,
    /// By stage j: x_j = Σ Re(T_jl z_l), pairs counted twice.
    pub from_eigen: [Complex<L>; S],
    /// By stage j: z = Σ x_j (T⁻¹)_j.
    pub to_eigen: [Complex<L>; S],
    /// Weights of the last Legendre coefficient of the stages' polynomial.
    pub last_legendre: [f64; S],
}

const fn square<const S: usize>(a: [[f64; S]; S]) -> [[f64; S]; S] {
    let mut to = [[0.0; S]; S];
    let mut i = 0;
    while i < S {
        let mut j = 0;
        while j < S {
            let mut k = 0;
            while k < S {
                to[i][j] += a[i][k] * a[k][j];
                k += 1;
            }
            j += 1;
        }
        i += 1;
    }
    to
}

/// 3 stages, order 5.
pub(super) static RADAU_3: Scheme<3, 2> = Scheme {
    order: 5,
    nodes: [0.1550510257216822, 0.6449489742783178, 1.0],
    weights: [
        [0.1968154772236604, -0.06553542585019839, 0.02377097434822015],
        [0.3944243147390873, 0.2920734116652285, -0.04154875212599793],
        [0.37640306270046725, 0.5124858261884216, 0.1111111111111111],
    ],
    squared: square([
        [0.1968154772236604, -0.06553542585019839, 0.02377097434822015],
        [0.3944243147390873, 0.2920734116652285, -0.04154875212599793],
        [0.37640306270046725, 0.5124858261884216, 0.1111111111111111],
    ]),
    eigenvalues: Complex { re: [0.27488882959567734, 0.16255558520216132], im: [0.0, 0.1849493244071408] },
    from_eigen: [
        Complex { re: [0.09443876248897524, -0.2825105900419084], im: [0.0, -0.06005838821029485] },
        Complex { re: [0.2502131229653333, 0.4082587045875999], im: [0.0, 0.7658842255145238] },
        Complex { re: [1.0, 2.0], im: [0.0, 0.0] },
    ],
    to_eigen: [
        Complex { re: [4.178718591551905, -2.0893592957759526], im: [0.0, 0.2514363174728934] },
        Complex { re: [0.32768282076106237, -0.16384141038053118], im: [0.0, -1.2859634749278026] },
        Complex { re: [0.5233764454994495, 0.23831177725027522], im: [0.0, 0.29801960241411246] },
    ],
    last_legendre: [0.4026360396619939, -0.9581915952175495, 0.5555555555555556],
};

/// 5 stages, order 9.
pub(super) static RADAU_5: Scheme<5, 3> = Scheme {
    order: 9,
    nodes: [0.05710419611451768, 0.2768430136381238, 0.5835904323689168, 0.8602401356562195, 1.0],
    weights: [
        [0.07299886431790333, -0.02673533110794557, 0.018676929763984353, -0.01287910609330644, 0.005042839233882015],
        [0.15377523147918246, 0.14621486784749352, -0.03644456890512809, 0.02123306311930472, -0.007935579902728777],
        [0.14006304568480987, 0.29896712949128346, 0.16758507013524895, -0.03396910168661774, 0.010944288744192253],
        [0.14489430810953477, 0.2765000687601592, 0.32579792291042103, 0.12875675325490976, -0.015708917378805327],
        [0.14371356079122594, 0.28135601514946207, 0.31182652297574126, 0.22310390108357075, 0.04],
    ],
    squared: square([
        [0.07299886431790333, -0.02673533110794557, 0.018676929763984353, -0.01287910609330644, 0.005042839233882015],
        [0.15377523147918246, 0.14621486784749352, -0.03644456890512809, 0.02123306311930472, -0.007935579902728777],
        [0.14006304568480987, 0.29896712949128346, 0.16758507013524895, -0.03396910168661774, 0.010944288744192253],
        [0.14489430810953477, 0.2765000687601592, 0.32579792291042103, 0.12875675325490976, -0.015708917378805327],
        [0.14371356079122594, 0.28135601514946207, 0.31182652297574126, 0.22310390108357075, 0.04],
    ]),
    eigenvalues: Complex {
        re: [0.15906584442746913, 0.1331790770182996, 0.06506577854574362],
        im: [0.0, 0.07499451183581853, 0.11646852774031707],
    },
    from_eigen: [
        Complex {
            re: [0.013576867344947943, -0.02295703051045903, -0.020484095635817653],
            im: [0.0, -0.02803971778575082, 0.09534775458059144],
        },
        Complex {
            re: [0.0016179004017190875, -0.015337661498360326, 0.10034572903474212],
            im: [0.0, 0.049417156853037054, -0.18866363836322286],
        },
        Complex {
            re: [0.07915785334744721, 0.0387969279976579, -0.4610790680868359],
            im: [0.0, 0.16360070740750235, 0.2054060907602518],
        },
        Complex {
            re: [0.41225608268046143, 0.8152023425603981, 0.7557878044977225],
            im: [0.0, 0.39936485577360503, 0.9334882606649887],
        },
        Complex { re: [1.0, 2.0, 2.0], im: [0.0, 0.0, 0.0] },
    ],
    to_eigen: [
        Complex {
            re: [27.697693775684087, -16.5209401067595, 2.672093218917456],
            im: [0.0, 4.305721989937646, -1.8740299037199024],
        },
        Complex {
            re: [12.783337911304406, -8.688476739531783, 2.2968077838795806],
            im: [0.0, -4.849995704764404, 1.9924828681719424],
        },
        Complex {
            re: [3.20848938671343, -0.08606453162700278, -1.5181801617297122],
            im: [0.0, -0.9573643198484372, 0.5222078208040094],
        },
        Complex {
            re: [-0.9514904122489162, -0.04958488899127132, 0.5253300951157295],
            im: [0.0, -1.20934600304247, -0.5920492840689743],
        },
        Complex {
            re: [0.7415504960259897, 0.2656140579191533, -0.13638930593214812],
            im: [0.0, 0.5237317439676688, 0.22495888507839018],
        },
    ],
    last_legendre: [0.1630629861297485, -0.502362706349683, 0.7678618887474027, -0.7885621685274681, 0.36],
};

#[cfg(test)]
mod tests {
    use super::*;

    fn check<const S: usize, const L: usize>(scheme: &Scheme<S, L>) {
        for i in 0..S {
            // Collocation: polynomials up to degree S − 1 are integrated exactly up to every node, up to 2 S − 2 over the step.
            let highest = if i + 1 == S { 2 * S - 1 } else { S };
            for k in 1..=highest {
                let sum: f64 = (0..S).map(|j| scheme.weights[i][j] * scheme.nodes[j].powi(k as i32 - 1)).sum();
                assert!((sum - scheme.nodes[i].powi(k as i32) / k as f64).abs() < 1e-15, "{S} stages: {i} {k}");
            }
            // T μ T⁻¹ = a and T T⁻¹ = 1.
            for j in 0..S {
                let product = |z: Complex<L>| -> f64 { z.re.iter().sum() };
                let one = product(scheme.from_eigen[i] * scheme.to_eigen[j]);
                let a = product(scheme.from_eigen[i] * scheme.eigenvalues * scheme.to_eigen[j]);
                assert!((one - f64::from(i == j)).abs() < 1e-14, "{i} {j}: {one}");
                assert!((a - scheme.weights[i][j]).abs() < 1e-14, "{i} {j}: {a}");
            }
        }
        // The last Legendre coefficient of xᵏ is 0 below degree S − 1 and that of P_{S−1} there: (S−1)!² / (2S−2)!.
        for k in 0..S {
            let found: f64 = (0..S).map(|j| scheme.last_legendre[j] * scheme.nodes[j].powi(k as i32)).sum();
            let factorial = |n: usize| (1..=n).map(|i| i as f64).product::<f64>();
            let expected = if k + 1 == S { factorial(S - 1).powi(2) / factorial(2 * S - 2) } else { 0.0 };
            assert!((found - expected).abs() < 1e-15, "{k}: {found}");
        }
    }

    #[test]
    fn the_coefficients_satisfy_what_defines_them() {
        check(&RADAU_3);
        check(&RADAU_5);
    }
}
