//! Scenes per second, with one thread and with several.
//!
//! `cargo bench --features rayon --bench sweep [scenes]`
#![allow(missing_docs)]

use linecontact::{Contact, ContactError, Control, Curve, CurvePoint, Flat, Panels, sweep};
use std::time::Instant;

const PANELS: Panels = Panels { tolerance: 1e-12 };

/// Solves rollers of slightly different radii, each with its peak pressure.
fn solve(scenes: &[f64]) -> Vec<Result<f64, ContactError<f64>>> {
    let one = |solver: &mut linecontact::Solver<f64>, &radius: &f64| {
        let arc = Curve::new([-1.5, 1.5], |k: f64| {
            let (s, c) = k.sin_cos();
            CurvePoint { x: radius * s, y: radius * (1.0 - c), dx: radius * c, dy: radius * s }
        });
        let contact = Contact::new(&Flat, &arc)?.quadrature(&PANELS);
        Ok(solver.solve(&contact, Control::Load(0.1))?.peak()?.pressure)
    };
    sweep(scenes, one, |_| {})
}

fn main() {
    let given = std::env::args().skip(1).find_map(|arg| arg.parse().ok());
    let n: usize = given.unwrap_or(50_000);
    let scenes: Vec<f64> = (0..n).map(|i| 1.0 + i as f64 / n as f64).collect();
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let mut alone = f64::INFINITY;
    let mut threads = 1;
    while threads <= cores {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        let mut least = f64::INFINITY;
        for _ in 0..5 {
            let start = Instant::now();
            let failed = pool.install(|| solve(&scenes)).iter().filter(|r| r.is_err()).count();
            assert_eq!(failed, 0);
            least = least.min(start.elapsed().as_secs_f64());
        }
        alone = if threads == 1 { least } else { alone };
        let efficiency = 100.0 * alone / least / threads as f64;
        let rate = n as f64 / least;
        println!("{threads} threads: {rate:.0} scenes a second, efficiency {efficiency:.0} %");
        threads *= 2;
    }
}
