//! The four searches side by side, in the two places where the solver takes one.
//!
//! Run with `cargo run --release --example compare_searches`. Lines that start with `#` explain
//! the table below them. The run fails if a search fails, or misses what the numbers allow.

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

/// Evaluations that each strategy has taken, and how often it failed.
#[derive(Default)]
struct Tally {
    evaluations: [usize; 4],
    failures: usize,
}

impl Tally {
    fn winner(&self) -> String {
        let least = (0..4).min_by_key(|&i| self.evaluations[i]).expect("there are four");
        let others = (0..4).map(|i| format!("{} {}", NAMES[i], self.evaluations[i]));
        format!("{} ({})", NAMES[least], others.collect::<Vec<_>>().join(", "))
    }
}

fn main() -> Result<(), ContactError<f64>> {
    let cold = inversion::cold();
    let limits = limits::limits()?;
    let poor = limits::poor_starts()?;
    let warm = limits::inversions()?;

    println!();
    println!("Fewest evaluations to invert X(k) = x, cold: {}", cold.winner());
    println!("Fewest to invert X(k) = x within a contact:  {}", warm.winner());
    println!("Fewest for the limits, the solver's start:   {}", limits.winner());
    println!("Fewest for the limits, poor starts:          {}", poor.winner());
    assert_eq!([cold.failures, limits.failures, poor.failures, warm.failures], [0; 4]);
    Ok(())
}
