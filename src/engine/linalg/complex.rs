//! Complex numbers, some side by side: the systems that an implicit method falls apart into differ in nothing but a complex
//! factor, and are worked off together.

use std::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

/// `L` complex numbers, real and imaginary parts apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Complex<const L: usize> {
    pub re: [f64; L],
    pub im: [f64; L],
}

impl<const L: usize> Default for Complex<L> {
    fn default() -> Self {
        Complex { re: [0.0; L], im: [0.0; L] }
    }
}

impl<const L: usize> Complex<L> {
    /// The same real number everywhere.
    #[inline(always)]
    pub fn real(value: f64) -> Self {
        Complex { re: [value; L], im: [0.0; L] }
    }

    #[inline(always)]
    pub fn scaled(mut self, factor: f64) -> Self {
        (0..L).for_each(|l| self.re[l] *= factor);
        (0..L).for_each(|l| self.im[l] *= factor);
        self
    }

    /// Adds a real number everywhere.
    #[inline(always)]
    pub fn plus(mut self, value: f64) -> Self {
        (0..L).for_each(|l| self.re[l] += value);
        self
    }

    /// 1/z; not finite for 0.
    #[inline(always)]
    pub fn reciprocal(self) -> Self {
        let mut to = self;
        for l in 0..L {
            let over = 1.0 / (self.re[l] * self.re[l] + self.im[l] * self.im[l]);
            (to.re[l], to.im[l]) = (self.re[l] * over, -self.im[l] * over);
        }
        to
    }

    /// Whether all parts are numbers.
    pub fn is_finite(&self) -> bool {
        self.re.iter().chain(&self.im).all(|part| part.is_finite())
    }
}

impl<const L: usize> Add for Complex<L> {
    type Output = Self;
    #[inline(always)]
    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl<const L: usize> AddAssign for Complex<L> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        (0..L).for_each(|l| self.re[l] += other.re[l]);
        (0..L).for_each(|l| self.im[l] += other.im[l]);
    }
}

impl<const L: usize> Sub for Complex<L> {
    type Output = Self;
    #[inline(always)]
    fn sub(mut self, other: Self) -> Self {
        self -= other;
        self
    }
}

impl<const L: usize> SubAssign for Complex<L> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        (0..L).for_each(|l| self.re[l] -= other.re[l]);
        (0..L).for_each(|l| self.im[l] -= other.im[l]);
    }
}

impl<const L: usize> Neg for Complex<L> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.scaled(-1.0)
    }
}

impl<const L: usize> Mul for Complex<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let mut to = self;
        (0..L).for_each(|l| to.re[l] = self.re[l] * other.re[l] - self.im[l] * other.im[l]);
        (0..L).for_each(|l| to.im[l] = self.re[l] * other.im[l] + self.im[l] * other.re[l]);
        to
    }
}
