//! A number as the unevaluated sum of two doubles: 106 bits, relative error of an operation below 2^−102.
//!
//! Sources: Dekker, A floating-point technique for extending the available precision (1971); Knuth, The Art of Computer
//! Programming 2, section 4.2.2; Hida, Li, Bailey, Algorithms for quad-double precision floating point arithmetic (2001).
//! Products are split in halves after Dekker rather than fused, so that the bits do not depend on the machine.

use std::cmp::Ordering;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// `high + low` with |low| at most half an ulp of `high`. Overflows to NaN beyond 1e300.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
}

impl DoubleDouble {
    /// +0, of which both parts are +0.
    pub const ZERO: DoubleDouble = DoubleDouble { high: 0.0, low: 0.0 };

    /// The nearest double.
    pub fn value(self) -> f64 {
        self.high
    }

    /// The absolute value.
    pub fn abs(self) -> DoubleDouble {
        if self.high < 0.0 { -self } else { self }
    }

    /// The square root; 0 of 0, NaN of a negative number. One Newton step from the double (Karp, Markstein 1997).
    pub fn sqrt(self) -> DoubleDouble {
        if self.high == 0.0 {
            return DoubleDouble::ZERO;
        }
        let root = DoubleDouble::from(self.high.sqrt());
        root + DoubleDouble::from((self - root * root).high / (2.0 * root.high))
    }

    /// This times a power of two, exact.
    pub fn scaled(self, power_of_two: f64) -> DoubleDouble {
        DoubleDouble { high: self.high * power_of_two, low: self.low * power_of_two }
    }
}

/// a + b and its rounding error (Knuth).
#[inline]
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_part = sum - a;
    (sum, (a - (sum - b_part)) + (b - b_part))
}

/// The same where |a| ≥ |b| (Dekker).
#[inline]
fn quick_two_sum(a: f64, b: f64) -> DoubleDouble {
    let high = a + b;
    DoubleDouble { high, low: b - (high - a) }
}

/// Upper and lower 26 bits (Dekker, after Veltkamp).
#[inline]
fn split(a: f64) -> (f64, f64) {
    const SPLITTER: f64 = 134_217_729.0; // 2^27 + 1
    let t = SPLITTER * a;
    let high = t - (t - a);
    (high, a - high)
}

/// a · b and its rounding error (Dekker).
#[inline]
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let ((ah, al), (bh, bl)) = (split(a), split(b));
    (product, ((ah * bh - product) + ah * bl + al * bh) + al * bl)
}

impl From<f64> for DoubleDouble {
    #[inline]
    fn from(high: f64) -> Self {
        DoubleDouble { high, low: 0.0 }
    }
}

impl Add for DoubleDouble {
    type Output = DoubleDouble;

    #[inline]
    fn add(self, other: DoubleDouble) -> DoubleDouble {
        let (high, error) = two_sum(self.high, other.high);
        let (low, last) = two_sum(self.low, other.low);
        let sum = quick_two_sum(high, error + low);
        quick_two_sum(sum.high, sum.low + last)
    }
}

impl Neg for DoubleDouble {
    type Output = DoubleDouble;

    #[inline]
    fn neg(self) -> DoubleDouble {
        DoubleDouble { high: -self.high, low: -self.low }
    }
}

impl Sub for DoubleDouble {
    type Output = DoubleDouble;

    #[inline]
    fn sub(self, other: DoubleDouble) -> DoubleDouble {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = DoubleDouble;

    #[inline]
    fn mul(self, other: DoubleDouble) -> DoubleDouble {
        let (high, error) = two_product(self.high, other.high);
        quick_two_sum(high, error + (self.high * other.low + self.low * other.high))
    }
}

impl Div for DoubleDouble {
    type Output = DoubleDouble;

    /// Three digits of a long division in base 2^53.
    #[inline]
    fn div(self, other: DoubleDouble) -> DoubleDouble {
        let first = self.high / other.high;
        let rest = self - other * first.into();
        let second = rest.high / other.high;
        let third = (rest - other * second.into()).high / other.high;
        quick_two_sum(first, second) + third.into()
    }
}

impl AddAssign for DoubleDouble {
    #[inline]
    fn add_assign(&mut self, other: DoubleDouble) {
        *self = *self + other;
    }
}

impl SubAssign for DoubleDouble {
    #[inline]
    fn sub_assign(&mut self, other: DoubleDouble) {
        *self = *self - other;
    }
}

impl PartialOrd for DoubleDouble {
    fn partial_cmp(&self, other: &DoubleDouble) -> Option<Ordering> {
        match self.high.partial_cmp(&other.high) {
            Some(Ordering::Equal) => self.low.partial_cmp(&other.low),
            order => order,
        }
    }
}

/// A point or a vector of the plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Vector {
    pub x: DoubleDouble,
    pub y: DoubleDouble,
}

impl Vector {
    pub(super) const ZERO: Vector = Vector { x: DoubleDouble::ZERO, y: DoubleDouble::ZERO };

    #[inline]
    pub(super) fn dot(self, other: Vector) -> DoubleDouble {
        self.x * other.x + self.y * other.y
    }

    #[inline]
    pub(super) fn times(self, factor: DoubleDouble) -> Vector {
        Vector { x: self.x * factor, y: self.y * factor }
    }

    /// The nearest point in doubles.
    pub(super) fn value(self) -> glam::DVec2 {
        glam::DVec2::new(self.x.value(), self.y.value())
    }

    /// The length, rounded.
    pub(super) fn size(self) -> f64 {
        self.value().length()
    }
}

impl From<glam::DVec2> for Vector {
    fn from(v: glam::DVec2) -> Vector {
        Vector { x: v.x.into(), y: v.y.into() }
    }
}

impl Add for Vector {
    type Output = Vector;

    #[inline]
    fn add(self, other: Vector) -> Vector {
        Vector { x: self.x + other.x, y: self.y + other.y }
    }
}

impl Sub for Vector {
    type Output = Vector;

    #[inline]
    fn sub(self, other: Vector) -> Vector {
        Vector { x: self.x - other.x, y: self.y - other.y }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 2^−102: what the sources promise for an operation, with a little room.
    const ROUNDING: f64 = 2e-31;

    fn double(value: f64) -> DoubleDouble {
        value.into()
    }

    #[test]
    fn roots_and_quotients_are_undone_by_products_to_a_hundred_bits() {
        for n in 1..200 {
            let x = double(f64::from(n)) / double(7.0);
            let root = x.sqrt();
            assert!((root * root - x).abs().value() <= ROUNDING * x.value());
            let quotient = double(1.0) / x;
            assert!((quotient * x - double(1.0)).abs().value() <= ROUNDING);
        }
    }

    #[test]
    fn the_root_of_two_has_the_digits_of_the_tables() {
        // 1.41421356237309504880168872420969807856967… as a double and the remainder (OEIS A002193).
        let root = double(2.0).sqrt();
        let (high, rest) = (std::f64::consts::SQRT_2, -9.667_293_313_452_913e-17);
        assert_eq!(root.value(), high);
        assert!(((root - double(high)).value() - rest).abs() < 1e-31);
    }

    #[test]
    fn what_cancels_in_doubles_is_kept() {
        let sum = double(1.0) + double(1e-25);
        assert!(((sum - double(1.0)).value() - 1e-25).abs() < 1e-32);
        assert!(sum > double(1.0));
    }
}
