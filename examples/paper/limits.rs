//! Examples 3 to 5: curves without an inverse in closed form, and unknown limits.

use super::curves::{self, Example};
use linecontact::{Contact, ContactError, Control, Cost, EdgePressure, Interval, Midpoint};
use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt;

/// Example of the paper.
pub struct Case {
    pub number: u32,
    pub example: fn() -> Example,
    /// Number of segments N in the paper.
    segments: usize,
    /// The paper's Eq. (3) has κ = 1, but its Example 2 comes out only with κ = π/2. The paper does
    /// not say which of the two Examples 3 to 5 use, so both are solved.
    pub readings: [Reading; 2],
}

/// Scale κ, and its limits: solutions to 25 digits, rounded to `f64`.
#[derive(Clone, Copy)]
pub struct Reading {
    kappa: f64,
    a: f64,
    b: f64,
}

const fn readings(one: [f64; 2], half_pi: [f64; 2]) -> [Reading; 2] {
    [
        Reading { kappa: 1.0, a: one[0], b: one[1] },
        Reading { kappa: FRAC_PI_2, a: half_pi[0], b: half_pi[1] },
    ]
}

pub const CASES: [Case; 3] = [
    Case {
        number: 3,
        example: curves::three,
        segments: 1 << 10,
        readings: readings(
            [0.05763680561192331, 0.05786118098062241],
            [0.04600584835063904, 0.04614868950712323],
        ),
    },
    Case {
        number: 4,
        example: curves::four,
        segments: 1 << 9,
        readings: readings(
            [0.0006616627213322833, 0.0031041172941531454],
            [0.0005279280526943882, 0.002476512314534651],
        ),
    },
    Case {
        number: 5,
        example: curves::five,
        segments: 1 << 8,
        readings: readings(
            [0.004386593301132873, 0.0018764934666551272],
            [0.0034997873759605824, 0.0014972300754615038],
        ),
    },
];

/// Place at which the pressure is required to be zero.
#[derive(Clone, Copy)]
pub enum Zero {
    /// At the limits themselves.
    AtLimits,
    /// One segment inside the limits: the paper's Eq. (6) with A = B = 0.
    OneSegmentInside,
}

/// Solution of an example.
pub struct Solved {
    number: u32,
    reading: Reading,
    pub contact: Interval<f64>,
    /// Points (x, P) where segments meet, as in the paper. Closer to a limit than the first of
    /// these, the error of the rule exceeds P.
    pub pressure: Vec<(f64, f64)>,
    cost: Cost,
}

impl Solved {
    /// Returns the relative errors of a and b.
    pub fn errors(&self) -> [f64; 2] {
        let Interval { left, right } = self.contact;
        [right / self.reading.a, -left / self.reading.b].map(|ratio| (ratio - 1.0).abs())
    }
}

impl fmt::Display for Solved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { number, reading: Reading { kappa, .. }, contact, cost, .. } = self;
        let (a, b) = (contact.right, -contact.left);
        let [rel_a, rel_b] = self.errors();
        let Cost { samples, evaluations, .. } = cost;
        write!(f, "{number} {kappa} {a} {b} {rel_a:.1e} {rel_b:.1e} {samples} {evaluations}")
    }
}

/// Solves an example, with the paper's N, and ET = 2 for the pressure.
pub fn solve(case: &Case, reading: Reading, zero: Zero) -> Result<Solved, ContactError<f64>> {
    let Reading { kappa, a, b } = reading;
    let Example { lower, upper, c } = (case.example)();
    let rule = Midpoint::paper(case.segments, 2);
    let contact = Contact::new(&lower, &upper)?.kappa(kappa).quadrature(&rule);
    let contact = match zero {
        Zero::AtLimits => contact,
        Zero::OneSegmentInside => {
            let segment = (a + b) / case.segments as f64;
            let mean_pressure = c / PI / (a + b);
            contact.edge_pressure(EdgePressure::zero(segment, 1e-6 * mean_pressure))
        }
    };
    let solution = contact.solve(Control::Load(c / PI))?;
    let (contact, cost) = (solution.hull(), solution.cost());
    let pressure = solution.pressure()?;
    let cost = cost + pressure.cost();
    let segment = (contact.right - contact.left) / case.segments as f64;
    let mut points = Vec::new();
    for i in 1..case.segments {
        let x = contact.left + segment * i as f64;
        // Taken even if doubtful: one segment from a limit the paper's rule has an error of 4 %.
        points.push((x, pressure.estimate(x, &mut Cost::default())?.value));
    }
    Ok(Solved { number: case.number, reading, contact, pressure: points, cost })
}
