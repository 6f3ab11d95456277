//! Numbers as a person reads them: three significant digits and a prefixed unit.

use crate::measure::Uncertain;

/// Where the smallest prefix ends: what rounds to 1 of it.
const LEAST: f64 = 0.9995e-12;

/// `value` with three significant digits and the SI prefix that leaves 1 … 999 before the point: `si(0.00123, "m")` is
/// "1.23 mm". Units that carry a prefix already (kg) or that take none (%, °) are written without a further one. What is
/// too small for the smallest prefix is "<1 pm": rounding of the computer, and no value to read.
pub fn si(value: f64, unit: &str) -> String {
    if !value.is_finite() {
        return format!("{value} {unit}");
    }
    if value == 0.0 {
        return format!("0 {unit}");
    }
    if !takes_prefix(unit) {
        return format!("{} {unit}", digits(value));
    }
    if value.abs() < LEAST {
        return format!("<1 p{unit}");
    }
    let exponent = (value.abs().log10() / 3.0).floor().clamp(-4.0, 4.0) as i32;
    let (mut scaled, mut exponent) = (value / 1000f64.powi(exponent), exponent);
    // 999.6 would round to 1000.
    if scaled.abs() >= 999.5 && exponent < 4 {
        scaled /= 1000.0;
        exponent += 1;
    }
    let prefix = ["p", "n", "µ", "m", "", "k", "M", "G", "T"][(exponent + 4) as usize];
    format!("{} {prefix}{unit}", digits(scaled))
}

fn takes_prefix(unit: &str) -> bool {
    !(unit.is_empty() || unit.starts_with("kg") || unit.starts_with('°') || unit.starts_with('%'))
}

/// The same without trailing zeros, for round numbers on axes and legends: "1 kN", "0.5 m". Where the prefixes end a power of
/// ten stands in their place, for an axis needs every one of its values.
pub fn round_si(value: f64, unit: &str) -> String {
    if value != 0.0 && value.abs() < LEAST && takes_prefix(unit) {
        return minus(format!("{value:.0e} {unit}"));
    }
    let text = si(value, unit);
    match text.split_once(' ') {
        Some((number, unit)) if number.contains('.') && !number.contains('e') => {
            format!("{} {unit}", number.trim_end_matches('0').trim_end_matches('.'))
        }
        _ => text,
    }
}

/// `value` with three significant digits; very large and small ones in powers of ten.
pub fn digits(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".into()
    } else if !(1e-3..1e6).contains(&size) {
        minus(format!("{value:.2e}"))
    } else {
        // What rounds up to the next power of ten has one digit more before the point.
        let rounded = size * 1.0005;
        let decimals = (2.0 - rounded.log10().floor()).clamp(0.0, 5.0) as usize;
        minus(format!("{value:.decimals$}"))
    }
}

/// A value and what it may be off by: "1.302 ± 0.002 mm". An error below a millionth of the value is left out, since every digit
/// shown is certain then.
pub fn with_error(value: f64, error: f64, unit: &str) -> String {
    if !(error > 1e-6 * value.abs()) {
        return si(value, unit);
    }
    Uncertain { value, error: Some(error) }.shown(unit)
}

/// `value` with at most `decimals` decimals and no trailing zeros.
pub fn plain(value: f64, decimals: usize) -> String {
    let text = minus(format!("{value:.decimals$}"));
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// The sign as it is printed: as wide as a plus.
pub fn minus(text: String) -> String {
    text.replace('-', "−")
}

/// A count with thin groups of three: "12 345".
pub fn count(n: usize) -> String {
    let plain = n.to_string();
    let mut text = String::new();
    for (i, digit) in plain.chars().enumerate() {
        if i > 0 && (plain.len() - i).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_carry_the_prefix_that_reads_best() {
        assert_eq!(si(0.00123, "m"), "1.23 mm");
        assert_eq!(si(-45_600.0, "N"), "−45.6 kN");
        assert_eq!(si(999.7, "J"), "1.00 kJ");
        assert_eq!(si(0.0, "m"), "0 m");
        assert_eq!(si(0.25, "kg"), "0.250 kg");
        assert_eq!(si(1.44e-15, "m"), "<1 pm");
        assert_eq!(si(-4.03e-13, "J"), "<1 pJ");
        assert_eq!(si(0.9996e-12, "m"), "1.00 pm");
        assert_eq!(si(f64::NAN, "J"), "NaN J");
    }

    #[test]
    fn an_error_that_no_digit_shows_is_left_out() {
        assert_eq!(with_error(1.302e-3, 2e-6, "m"), "1.302 ± 0.002 mm");
        assert_eq!(with_error(1.302, 1e-13, "m"), "1.30 m");
        assert_eq!(with_error(1.302, 0.0, "m"), "1.30 m");
        assert_eq!(with_error(0.0, 3e-3, "m"), "0 ± 3 mm");
        assert_eq!(with_error(f64::NAN, 1.0, "m"), "NaN m");
    }

    #[test]
    fn round_numbers_have_no_trailing_zeros() {
        assert_eq!(round_si(1000.0, "N"), "1 kN");
        assert_eq!(round_si(-0.25, "J"), "−250 mJ");
        assert_eq!(round_si(1.5, "m"), "1.5 m");
        assert_eq!(round_si(1e-15, "m"), "1e−15 m");
    }

    #[test]
    fn a_plain_number_shows_the_decimals_that_it_has() {
        assert_eq!([0.125, 1.0, 10.0, 0.0625].map(|value| plain(value, 4)), ["0.125", "1", "10", "0.0625"]);
        assert_eq!((plain(100.0, 0), plain(0.03125, 4)), ("100".into(), "0.0312".into()));
    }

    #[test]
    fn counts_are_grouped_by_three() {
        assert_eq!(count(7), "7");
        assert_eq!(count(12_345), "12 345");
        assert_eq!(count(1_000_000), "1 000 000");
    }
}
