//! Compares searches in the two places where the solver takes one: those of the crate, and one
//! of this example, the Illinois method.
//!
//! Run with `cargo run --release --example compare_searches`. Lines that start with `#` explain the
//! table below them. The run fails if a search fails or is less exact than the data allow.

#[allow(dead_code, reason = "Example 1 has given limits")]
#[path = "../paper/curves.rs"]
mod curves;
mod illinois;
mod inversion;
mod limits;
mod scenes;

use illinois::Illinois;
use linecontact::ContactError;
use linecontact::search::{LimitSearch, StoppingCriteria, strategies};
use std::collections::BTreeMap;

/// Search under its name.
type Named = (&'static str, Box<dyn LimitSearch<f64>>);

/// Returns the searches to compare. One of your own is a line more.
fn searches() -> Vec<Named> {
    let mut all = strategies(StoppingCriteria::FULL);
    all.push(("illinois", Box::new(Illinois)));
    all
}

/// Counts by each search, with equal weight for every problem, and the number of failures.
#[derive(Default)]
struct Tally {
    /// Logarithms of the counts.
    logarithms: BTreeMap<&'static str, Vec<f64>>,
    failures: usize,
}

impl Tally {
    fn count(&mut self, search: &'static str, count: usize) {
        self.logarithms.entry(search).or_default().push((count.max(1) as f64).ln());
    }

    fn fail(&mut self, search: &str, why: &str) {
        println!("    {search} failed: {why}");
        self.failures += 1;
    }

    fn winner(&self) -> String {
        let mean = |of: &Vec<f64>| (of.iter().sum::<f64>() / of.len() as f64).exp();
        let mut means: Vec<_> = self.logarithms.iter().map(|(name, of)| (mean(of), name)).collect();
        means.sort_by(|one, other| one.0.total_cmp(&other.0));
        means.iter().map(|(mean, name)| format!("{name} {mean:.0}")).collect::<Vec<_>>().join(", ")
    }
}

pub(crate) fn main() -> Result<(), ContactError<f64>> {
    let cold = inversion::cold();
    let limits = limits::limits()?;
    let poor = limits::poor_starts()?;
    let warm = limits::inversions()?;

    println!();
    println!("# Function values, geometric mean over the rows of a table, the fewest first");
    println!("X(k) = x from the whole domain:      {}", cold.winner());
    println!("limits, from the solver's start:     {}", limits.winner());
    println!("limits, from poor starts:            {}", poor.winner());
    println!("X(k) = x from the sample next to it: {}", warm.winner());
    assert_eq!([cold.failures, limits.failures, poor.failures, warm.failures], [0; 4]);
    Ok(())
}
