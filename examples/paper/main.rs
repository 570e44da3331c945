//! Computes the numbers and figures of the paper anew, and compares them with the printed ones.
//!
//! Run with `cargo run --release --example paper`. Lines that start with `#` explain the lines
//! below them; the figures go to `target/figures`. The run fails if a digit differs.

mod curves;
#[path = "../shared/drawing.rs"]
mod drawing;
mod figures;
mod limits;
mod tables;

use limits::{CASES, Solved, Zero};
use std::error::Error;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    println!("# Tables 1 and 2, known limits: x, N, ET, |P - exact|, the same in the paper");
    let mut entries = tables::table1()?;
    entries.extend(tables::table2()?);
    for entry in &entries {
        println!("{entry}");
    }

    println!("# Examples 3 to 5, limits where the pressure ends: number, kappa, a, b,");
    println!("# their relative errors, values of the gap's slope, evaluations of the curves");
    let free = solve_all("example", Zero::AtLimits)?;
    println!("# The same by Eq. (6), zero pressure one segment inside the limits");
    solve_all("boundary", Zero::OneSegmentInside)?;

    println!("# Figures 2 to 7");
    for (case, solved) in CASES.iter().zip(&free) {
        println!("{}", figures::draw(case, solved)?);
    }

    for entry in &entries {
        assert!(entry.agrees(), "the paper has another value: {entry}");
    }
    for solved in free.iter().flatten() {
        assert!(solved.errors().iter().all(|&error| error < 1e-12), "limits are off: {solved}");
    }
    Ok(())
}

/// Solves and prints each example with both of its scales κ.
fn solve_all(keyword: &str, zero: Zero) -> Result<Vec<[Solved; 2]>, Box<dyn Error>> {
    let mut all = Vec::new();
    for case in &CASES {
        let [one, half_pi] = case.readings;
        let solved = [limits::solve(case, one, zero)?, limits::solve(case, half_pi, zero)?];
        for contact in &solved {
            println!("{keyword} {contact}");
        }
        all.push(solved);
    }
    Ok(all)
}
