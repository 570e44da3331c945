//! Tables 1 and 2: the absolute errors of the paper's quadrature for known limits.

use super::curves::{self, Example};
use linecontact::{Contact, ContactError, Control, Edge, Interval, Midpoint};
use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt;

/// Row of a table: x, then the errors for each N with ET = 1 and 2.
type Row = (f64, [&'static str; 6]);

const SEGMENTS_1: [usize; 3] = [1 << 6, 1 << 8, 1 << 10];
const TABLE_1: [Row; 7] = [
    (-0.75, ["4.26E-05", "2.95E-08", "2.67E-06", "1.16E-10", "1.67E-07", "4.55E-13"]),
    (-0.50, ["1.27E-05", "2.40E-09", "7.93E-07", "9.41E-12", "4.96E-08", "3.68E-14"]),
    (-0.25, ["4.54E-06", "4.69E-10", "2.84E-07", "1.83E-12", "1.77E-08", "7.17E-15"]),
    (0.00, ["0.00E+00", "0.00E+00", "0.00E+00", "0.00E+00", "0.00E+00", "0.00E+00"]),
    (0.25, ["4.54E-06", "4.69E-10", "2.84E-07", "1.83E-12", "1.77E-08", "7.17E-15"]),
    (0.50, ["1.27E-05", "2.40E-09", "7.93E-07", "9.41E-12", "4.96E-08", "3.68E-14"]),
    (0.75, ["4.26E-05", "2.95E-08", "2.67E-06", "1.16E-10", "1.67E-07", "4.55E-13"]),
];

const SEGMENTS_2: [usize; 3] = [1 << 8, 1 << 10, 1 << 12];
const TABLE_2: [Row; 9] = [
    (-0.5, ["4.33E-03", "5.84E-04", "5.36E-04", "7.35E-05", "6.68E-05", "9.21E-06"]),
    (-0.3, ["1.02E-03", "1.40E-04", "1.27E-04", "1.76E-05", "1.59E-05", "2.20E-06"]),
    (-0.1, ["6.08E-04", "8.40E-05", "7.60E-05", "1.05E-05", "9.50E-06", "1.31E-06"]),
    (0.1, ["4.96E-04", "6.85E-05", "6.20E-05", "8.56E-06", "7.75E-06", "1.07E-06"]),
    (0.2, ["4.84E-04", "6.69E-05", "6.06E-05", "8.36E-06", "7.57E-06", "1.05E-06"]),
    (0.3, ["4.96E-04", "6.85E-05", "6.20E-05", "8.56E-06", "7.75E-06", "1.07E-06"]),
    (0.5, ["6.08E-04", "8.40E-05", "7.60E-05", "1.05E-05", "9.50E-06", "1.31E-06"]),
    (0.7, ["1.02E-03", "1.40E-04", "1.27E-04", "1.76E-05", "1.59E-05", "2.20E-06"]),
    (0.9, ["4.33E-03", "5.84E-04", "5.36E-04", "7.35E-05", "6.68E-05", "9.21E-06"]),
];

/// Error of our quadrature, and the paper's value of it.
pub struct Entry {
    table: u32,
    x: f64,
    rule: Midpoint,
    error: f64,
    paper: &'static str,
}

impl Entry {
    /// Tells whether all digits of the paper are met. Below 1e-13 they are its own rounding errors.
    pub fn agrees(&self) -> bool {
        let paper: f64 = self.paper.parse().expect("the tables hold numbers");
        if paper == 0.0 {
            self.error < 1e-16
        } else if paper < 1e-13 {
            (self.error / paper - 1.0).abs() < 0.05
        } else {
            scientific(self.error) == self.paper
        }
    }
}

impl fmt::Display for Entry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { table, x, rule: Midpoint { segments, extrapolations, .. }, error, paper } = self;
        write!(f, "table{table} {x} {segments} {extrapolations} {} {paper}", scientific(*error))
    }
}

/// Formats a number as the paper prints it, such as `4.26E-05`.
fn scientific(value: f64) -> String {
    let text = format!("{value:.2e}");
    let (mantissa, exponent) = text.split_once('e').expect("{:e} writes an e");
    let exponent: i32 = exponent.parse().expect("{:e} writes an integer after the e");
    format!("{mantissa}E{exponent:+03}")
}

/// Computes Table 1: Example 1, whose pressure is infinite at both limits.
pub fn table1() -> Result<Vec<Entry>, ContactError<f64>> {
    let exact = |x: f64| {
        let root = 1.0 - x * x;
        -(2.0 * x + root * ((1.0 + x) / (1.0 - x)).ln()) / (PI * PI * root.sqrt())
    };
    let Example { lower, upper, c } = curves::one();
    let on = Interval { left: -1.0, right: 1.0 };
    // Tension is allowed here, and any load has a solution.
    let contact = Contact::new(&lower, &upper)?
        .edges(Edge::Fixed(on.left), Edge::Fixed(on.right))
        .single_interval(true);
    table(1, &contact, Control::Load(c / PI), SEGMENTS_1, &TABLE_1, exact)
}

/// Computes Table 2: Example 2, whose pressure ends at zero. The paper's Eq. (32) holds for κ =
/// π/2.
pub fn table2() -> Result<Vec<Entry>, ContactError<f64>> {
    let Example { lower, upper, c } = curves::two();
    let (a, b) = (1.0, 0.6);
    let exact = |x: f64| 16.0 * ((a - x) * (b + x)).sqrt();
    let on = Interval { left: -b, right: a };
    let contact = Contact::new(&lower, &upper)?
        .kappa(FRAC_PI_2)
        .edges(Edge::Fixed(on.left), Edge::Fixed(on.right))
        .single_interval(true);
    table(2, &contact, Control::Load(c / PI), SEGMENTS_2, &TABLE_2, exact)
}

/// Computes the entries of a table, row by row.
fn table(
    number: u32,
    contact: &Contact<'_, f64>,
    load: Control<f64>,
    segments: [usize; 3],
    rows: &[Row],
    exact: impl Fn(f64) -> f64,
) -> Result<Vec<Entry>, ContactError<f64>> {
    let rules = segments.into_iter().flat_map(|n| [1, 2].map(|et| Midpoint::paper(n, et)));
    let mut entries = Vec::new();
    for (column, rule) in rules.enumerate() {
        let contact = contact.clone().quadrature(&rule);
        let solution = contact.solve(load)?;
        let pressure = solution.pressure()?;
        for &(x, paper) in rows {
            let error = (pressure.at(x)? - exact(x)).abs();
            entries.push(Entry { table: number, x, rule, error, paper: paper[column] });
        }
    }
    // Computed column by column, but read row by row; the stable sort keeps the columns in order.
    entries.sort_by(|one, other| one.x.total_cmp(&other.x));
    Ok(entries)
}
