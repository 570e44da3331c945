//! Compares the four searches in the two places where the solver takes one.
//!
//! Run with `cargo run --release --example compare_searches`. Lines that start with `#` explain the
//! table below them. The run fails if a search fails or is less exact than the data allow.

#[allow(dead_code, reason = "Example 1 has given limits")]
#[path = "../paper/curves.rs"]
mod curves;
mod inversion;
mod limits;
mod scenes;

use linecontact::ContactError;
use linecontact::search::{Bisection, Brent, LimitSearch, Newton, Secant};

const NAMES: [&str; 4] = ["bisection", "secant", "Brent", "Newton"];

fn searches() -> [Box<dyn LimitSearch<f64>>; 4] {
    [
        Box::<Bisection>::default(),
        Box::<Secant>::default(),
        Box::<Brent>::default(),
        Box::<Newton>::default(),
    ]
}

/// Evaluations by each strategy, with equal weight for every problem, and the number of failures.
#[derive(Default)]
struct Tally {
    logarithms: [f64; 4],
    problems: [usize; 4],
    failures: usize,
}

impl Tally {
    fn count(&mut self, strategy: usize, evaluations: f64) {
        self.logarithms[strategy] += evaluations.max(1.0).ln();
        self.problems[strategy] += 1;
    }

    fn fail(&mut self, strategy: usize, why: &str) {
        println!("    {} failed: {why}", NAMES[strategy]);
        self.failures += 1;
    }

    fn winner(&self) -> String {
        let mean = |i: usize| (self.logarithms[i] / self.problems[i] as f64).exp();
        let mut order = [0, 1, 2, 3];
        order.sort_by(|&i, &j| mean(i).total_cmp(&mean(j)));
        order.map(|i| format!("{} {:.0}", NAMES[i], mean(i))).join(", ")
    }
}

pub(crate) fn main() -> Result<(), ContactError<f64>> {
    let cold = inversion::cold();
    let limits = limits::limits()?;
    let poor = limits::poor_starts()?;
    let warm = limits::inversions()?;

    println!();
    println!("# Evaluations, geometric mean over the rows of a table, the fewest first");
    println!("X(k) = x from the whole domain:      {}", cold.winner());
    println!("limits, from the solver's start:     {}", limits.winner());
    println!("limits, from poor starts:            {}", poor.winner());
    println!("contact, by the search that inverts: {}", warm.winner());
    assert_eq!([cold.failures, limits.failures, poor.failures, warm.failures], [0; 4]);
    Ok(())
}
