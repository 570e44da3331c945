//! The solution in a reference file.

use linecontact::Interval;
use serde_json::Value;
use std::f64::consts::{FRAC_PI_2, PI};

/// Result that a solver must return for a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Limits and pressure.
    Contact,
    /// Pressure between given limits.
    Fixed,
    /// Limits of all contacts, and the pressure.
    Several,
    /// Contact in several places; the file says only that one interval is not enough.
    Unphysical,
    /// Error: there is no solution.
    Error,
}

/// Solution with several contacts.
pub struct Several {
    /// Contacts from left to right.
    pub contacts: Vec<Interval<f64>>,
    /// True where the outermost limit, on the left or on the right, is a corner that ends the upper
    /// body.
    pub corners: [bool; 2],
    /// Largest error of a limit that passes, as a share of the width of its contact.
    pub of_width: f64,
    /// Largest error of a pressure that passes, as a share of the largest pressure.
    pub of_largest: f64,
}

/// Solution of some 30 digits.
pub struct Reference {
    /// Name of the kind in the file.
    pub kind_name: String,
    /// Kind of result that is expected.
    pub kind: Kind,
    /// Scale κ.
    pub kappa: f64,
    /// π times the load.
    pub c: f64,
    /// `[-b, a]`, where there is a solution.
    pub limits: Option<Interval<f64>>,
    /// Solution with several contacts, if the file has one.
    pub several: Option<Several>,
    /// True if the limits are one of several solutions in one interval under the same load.
    pub one_of_several: bool,
    /// Variant of the error that must come, if the file names it.
    pub error: Option<String>,
    /// Breakpoints of both bodies.
    pub breakpoints: Vec<f64>,
    /// Breakpoints that are not numbers of 64 bits, such as 1/3, rounded.
    pub rounded_breakpoints: Vec<f64>,
    /// Points with a finite, nonzero pressure.
    pub points: Vec<Point>,
}

/// Pressure at a point.
pub struct Point {
    /// Exact x of the point.
    pub x: f64,
    /// Pressure there.
    pub pressure: f64,
    /// Factor by which relative changes of `C`, `x`, `a` and `b` are magnified in the pressure, if
    /// given.
    pub amplification: Option<f64>,
}

impl Reference {
    /// Reads the solution; `None` if something is missing.
    pub fn read(file: &Value) -> Option<Self> {
        let kind_name = file["kind"].as_str()?.to_owned();
        let kind = match &*kind_name {
            "contact" => Kind::Contact,
            "fixed_interval_unbounded_ends" => Kind::Fixed,
            "several_contacts" => Kind::Several,
            "single_interval_solution_is_unphysical" => Kind::Unphysical,
            "must_report_error" => Kind::Error,
            _ => return None,
        };
        let limits = match (number(&file["a"]), number(&file["b"])) {
            (Some(a), Some(b)) => Some(Interval { left: -b, right: a }),
            _ if matches!(kind, Kind::Contact | Kind::Fixed) => return None,
            _ => None,
        };
        let list = |key: &str| file[key].as_array().map_or(&[][..], Vec::as_slice);
        let several = if kind == Kind::Several {
            let contact =
                |on: &Value| Some(Interval { left: number(&on[0])?, right: number(&on[1])? });
            let contacts: Vec<_> = list("limits").iter().map(contact).collect::<Option<_>>()?;
            let corner = |i: usize| file["edges"][i] == "fixed";
            let of_width = number(&file["tolerance_limits_per_width"])?;
            let of_largest = number(&file["tolerance_pressure_per_max"])?;
            if contacts.is_empty() {
                return None;
            }
            Some(Several { contacts, corners: [corner(0), corner(1)], of_width, of_largest })
        } else {
            None
        };
        let mut points = Vec::new();
        for (i, point) in list("points").iter().enumerate() {
            let amplification = list("points_amplification").get(i).and_then(number);
            let (x, pressure) = (number(&point[0])?, number(&point[1])?);
            if pressure.is_finite() && pressure != 0.0 {
                points.push(Point { x, pressure, amplification });
            }
        }
        let breakpoints = list("breakpoints_x").iter().filter_map(number).collect();
        let rounded = list("breakpoints_x").iter().filter(|breakpoint| !is_exact(breakpoint));
        let rounded_breakpoints = rounded.filter_map(number).collect();
        let kappa = number(&file["scale_value"]).or_else(|| scale(file["scale"].as_str()?))?;
        Some(Self {
            kind_name,
            kind,
            kappa,
            c: number(&file["C"]).or_else(|| Some(PI * number(&file["F"])?))?,
            limits,
            several,
            one_of_several: file["all_single_interval_roots"].is_array(),
            error: file["expected_error"].as_str().map(str::to_owned),
            breakpoints,
            rounded_breakpoints,
            points,
        })
    }
}

/// Reads a scale without a value: `1`, `pi/2`, or `pi/2*E` with a decimal for E.
fn scale(text: &str) -> Option<f64> {
    match text.strip_prefix("pi/2") {
        None => text.parse().ok(),
        Some("") => Some(FRAC_PI_2),
        Some(modulus) => Some(FRAC_PI_2 * modulus.strip_prefix('*')?.parse::<f64>().ok()?),
    }
}

/// Writes a decimal without an exponent.
fn plain(text: &str) -> Option<String> {
    let Some((decimal, exponent)) = text.split_once(['e', 'E']) else {
        return Some(text.to_owned());
    };
    let (sign, digits) = decimal.strip_prefix('-').map_or(("", decimal), |digits| ("-", digits));
    let (whole, part) = digits.split_once('.').unwrap_or((digits, ""));
    let (digits, places) = (format!("{whole}{part}"), exponent.parse::<i16>().ok()?);
    let point = i32::try_from(whole.len()).ok()? + i32::from(places);
    let zeros = |count: i32| "0".repeat(usize::try_from(count).unwrap_or(0));
    let missing = point - i32::try_from(digits.len()).ok()?;
    let all = format!("{}{digits}{}", zeros(1 - point), zeros(missing));
    let (whole, part) = all.split_at(usize::try_from(point.max(1)).ok()?);
    let whole = Some(whole.trim_start_matches('0')).filter(|text| !text.is_empty()).unwrap_or("0");
    Some(format!("{sign}{whole}.{part}"))
}

/// Tells whether a decimal is exactly a number of 64 bits, which has at most 1074 decimal places.
fn is_exact(value: &Value) -> bool {
    let trimmed = |text: &str| match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text.to_owned(),
    };
    let exact = number(value).map(|x| trimmed(&format!("{x:.1074}")));
    exact == value.as_str().and_then(plain).map(|text| trimmed(&text))
}

/// Reads a decimal in a string, correctly rounded, or a number as it is.
fn number(value: &Value) -> Option<f64> {
    value.as_f64().or_else(|| value.as_str()?.parse().ok())
}

#[cfg(test)]
mod tests {
    use super::is_exact;
    use serde_json::Value;

    #[test]
    fn breakpoints_that_are_rounded() {
        let is_exact = |text: &str| is_exact(&Value::from(text));
        for text in [
            "0.25",
            "-1.0",
            "0",
            "3",
            "0.0009765625",
            "100.000",
            "-5.0e-01",
            "1.25e2",
            "3e+1",
            "2.5E-1",
        ] {
            assert!(is_exact(text), "{text}");
        }
        for text in [
            "0.1",
            "-0.3333333333333333333333333333",
            "0.99",
            "9007199254740993",
            "1.0e-1",
            "3.3e0",
        ] {
            assert!(!is_exact(text), "{text}");
        }
    }
}
