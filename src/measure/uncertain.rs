//! A value and its error, as a person reads them: "1.302 ± 0.002 m".

/// Most decimals of a value; an error beyond them is written as a power of ten.
const MOST_DECIMALS: i32 = 6;

/// A measured or calculated value and how far it may be from the truth, in the same unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertain {
    /// The best estimate; NaN or infinite is shown as such, without an error.
    pub value: f64,
    /// ≥ 0; `None` where nothing is known about it.
    pub error: Option<f64>,
}

impl Uncertain {
    /// Value and error with the same SI prefix and the same last digit. The error has one significant digit, two if it begins with
    /// 1 (so that rounding changes it by a quarter at most); the value ends where the error does. Units that take no prefix (none,
    /// kg, °, %) are written as they are. A value without an error shows four digits.
    pub fn shown(&self, unit: &str) -> String {
        let Uncertain { value, error } = *self;
        if !value.is_finite() {
            return with_unit(format!("{value}"), unit);
        }
        let largest = value.abs().max(error.filter(|error| error.is_finite()).unwrap_or(0.0));
        let (prefix, power) = prefix(largest, unit);
        let unit = format!("{prefix}{unit}");
        let value = value / 10f64.powi(power);
        let text = match error.map(|error| error / 10f64.powi(power)) {
            None => format!("{value:.*}", (3 - leading_power(value, 1)).clamp(0, MOST_DECIMALS) as usize),
            Some(error) if !error.is_finite() => {
                format!("{value:.*} ± {error}", (3 - leading_power(value, 1)).clamp(0, MOST_DECIMALS) as usize)
            }
            Some(error) => both(value, error.abs()),
        };
        with_unit(text, &unit)
    }
}

fn both(value: f64, error: f64) -> String {
    if error == 0.0 {
        return format!("{value:.*} ± 0", MOST_DECIMALS as usize);
    }
    let mantissa = format!("{error:.1e}");
    let digits = if mantissa.starts_with('1') { 2 } else { 1 };
    let decimals = digits - 1 - leading_power(error, 2);
    if decimals > MOST_DECIMALS {
        format!("{value:.*} ± {error:.0e}", MOST_DECIMALS as usize)
    } else if decimals >= 0 {
        let decimals = decimals as usize;
        format!("{value:.decimals$} ± {error:.decimals$}")
    } else {
        // Tens, hundreds: zeros stand for what is not known.
        let unit = 10f64.powi(-decimals);
        format!("{:.0} ± {:.0}", (value / unit).round() * unit, (error / unit).round() * unit)
    }
}

/// The power of ten of the first digit of a number that is rounded to `digits` significant ones; 0 for 0.
fn leading_power(value: f64, digits: usize) -> i32 {
    let text = format!("{value:.*e}", digits - 1);
    text.split_once('e').and_then(|(_, power)| power.parse().ok()).unwrap_or(0)
}

/// The SI prefix that leaves 1 … 999 before the point of `largest`, and its power of ten.
fn prefix(largest: f64, unit: &str) -> (&'static str, i32) {
    let takes_none = unit.is_empty() || ["kg", "°", "%"].iter().any(|whole| unit.starts_with(whole));
    if takes_none || largest == 0.0 {
        return ("", 0);
    }
    let step = leading_power(largest, 4).div_euclid(3).clamp(-4, 4);
    (["p", "n", "µ", "m", "", "k", "M", "G", "T"][(step + 4) as usize], 3 * step)
}

/// The number with signs as they are printed, and the unit after a space, unless it has none.
fn with_unit(number: String, unit: &str) -> String {
    let number = number.replace('-', "−");
    if unit.is_empty() { number } else { format!("{number} {unit}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(value: f64, error: f64, unit: &str) -> String {
        Uncertain { value, error: Some(error) }.shown(unit)
    }

    #[test]
    fn a_value_ends_where_its_error_does() {
        assert_eq!(shown(1.302, 0.002, "m"), "1.302 ± 0.002 m");
        assert_eq!(shown(1.30249, 0.00151, "m"), "1.3025 ± 0.0015 m");
        assert_eq!(shown(-0.013_02, 0.000_02, "m"), "−13.02 ± 0.02 mm");
        assert_eq!(shown(4517.3, 261.0, "N"), "4.5 ± 0.3 kN");
        assert_eq!(shown(9.99, 0.0096, "J"), "9.990 ± 0.010 J");
        assert_eq!(shown(0.999_96, 0.0002, "J"), "1.0000 ± 0.0002 J");
        assert_eq!(shown(130.0, 20.0, "m"), "130 ± 20 m");
        assert_eq!(shown(1302.0, 240.0, "kg"), "1300 ± 200 kg");
        assert_eq!(shown(12.34, 0.5, "%"), "12.3 ± 0.5 %");
        assert_eq!(shown(0.5, 0.25, ""), "0.5 ± 0.2");
    }

    #[test]
    fn an_error_larger_than_its_value_sets_the_prefix() {
        assert_eq!(shown(1e-6, 0.003, "m"), "0 ± 3 mm");
        assert_eq!(shown(0.0, 0.02, "m"), "0 ± 20 mm");
    }

    #[test]
    fn errors_far_below_the_value_are_powers_of_ten() {
        assert_eq!(shown(1.302, 3e-10, "m"), "1.302000 ± 3e−10 m");
        assert_eq!(shown(1.302, 0.0, "m"), "1.302000 ± 0 m");
        assert_eq!(shown(2.5e-7, 1e-20, "m"), "250.000000 ± 1e−11 nm");
    }

    #[test]
    fn what_is_not_known_is_not_invented() {
        assert_eq!(Uncertain { value: 1.302_49, error: None }.shown("m"), "1.302 m");
        assert_eq!(Uncertain { value: 130_249.0, error: None }.shown("kg"), "130249 kg");
        assert_eq!(Uncertain { value: 0.0, error: None }.shown("m"), "0.000 m");
        assert_eq!(Uncertain { value: f64::NAN, error: Some(1.0) }.shown("m"), "NaN m");
        assert_eq!(shown(1.5, f64::INFINITY, "m"), "1.500 ± inf m");
    }

    #[test]
    fn rounding_is_right_to_half_of_the_last_digit_for_any_pair() {
        // The last printed digit of both is worth one unit; neither may be off by more than half of it.
        for i in 0..2000 {
            let value = (f64::from(i) * 0.731).sin() * 10f64.powi(i % 7 - 3);
            let error = (0.01 + (f64::from(i) * 0.37).sin().abs()) * 10f64.powi(i % 5 - 4);
            let text = Uncertain { value, error: Some(error) }.shown("%").replace('−', "-");
            let (first, second) = text.strip_suffix(" %").and_then(|text| text.split_once(" ± ")).expect("both");
            if second.contains('e') {
                continue;
            }
            let decimals = first.split_once('.').map_or(0, |(_, decimals)| decimals.len());
            assert_eq!(second.split_once('.').map_or(0, |(_, decimals)| decimals.len()), decimals, "{text}");
            let unit = if decimals > 0 { 10f64.powi(-(decimals as i32)) } else { 10f64.powf(error.log10().floor()) };
            let [first, second] = [first, second].map(|text| text.parse::<f64>().expect("a number"));
            assert!(
                (first - value).abs() <= 0.501 * unit && (second - error).abs() <= 0.501 * unit,
                "{text}: {value} {error}"
            );
        }
    }
}
