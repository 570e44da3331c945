//! Cost and errors of one contact, solved in one way.

use super::common::NanSafe;
use super::methods::{self, Way};
use super::scenes::Scene;
use linecontact::{Contact, ContactError, Cost, Solution};
use std::hint::black_box;
use std::time::Instant;

/// Cost and errors.
#[derive(Clone, Copy, Debug)]
pub struct Outcome {
    pub cost: Cost,
    /// Evaluations of the curves for the limits alone.
    pub for_limits: usize,
    /// Relative errors of a and of b.
    pub limits: [f64; 2],
    /// Largest relative errors of P, inside and next to an edge.
    pub pressure: [f64; 2],
}

impl Outcome {
    /// Returns the largest error of the two limits and the pressure inside.
    pub fn error(&self) -> f64 {
        self.limits.into_iter().fold(self.pressure[0], NanSafe::nan_max)
    }
}

fn contact<'a>(scene: &'a Scene, way: &'a Way) -> Result<Contact<'a, f64>, ContactError<f64>> {
    let mut contact = scene.contact()?.quadrature(&*way.quadrature);
    if let Some(wanted) = way.edge_pressure {
        contact = contact.edge_pressure(wanted);
    }
    if let Some(search) = methods::search(way.inversion) {
        contact = contact.inversion(search);
    }
    if let Some(search) = methods::search(way.limits) {
        contact = contact.limit_search(search);
    }
    Ok(contact)
}

/// Counts the work for the limits and the pressure at 101 points, and compares the results.
pub fn outcome(scene: &Scene, way: &Way) -> Result<Outcome, ContactError<f64>> {
    let contact = contact(scene, way)?;
    let solution = contact.solve(scene.load())?;
    let pressure = solution.pressure()?;
    let for_limits = solution.cost().evaluations;
    let mut cost = solution.cost() + pressure.cost();
    for x in scene.grid() {
        pressure.estimate(x, &mut cost)?;
    }
    let largest = |points: &[[f64; 2]]| -> Result<f64, ContactError<f64>> {
        let mut largest = 0.0;
        for &[x, exact] in points {
            // Taken even if doubtful.
            let error = (pressure.estimate(x, &mut Cost::default())?.value / exact - 1.0).abs();
            largest = if error > largest || error.is_nan() { error } else { largest };
        }
        Ok(largest)
    };
    let pressure = [largest(&scene.inside)?, largest(&scene.edge)?];
    Ok(Outcome { cost, for_limits, limits: of_limits(scene, &solution), pressure })
}

fn of_limits(scene: &Scene, solution: &Solution<f64>) -> [f64; 2] {
    let (got, want) = (solution.hull(), scene.limits);
    [got.right / want.right - 1.0, got.left / want.left - 1.0].map(f64::abs)
}

/// Measures the microseconds of a solve from the bodies on, with the pressure at 101 points: the
/// least of five batches, or of one if a solve takes long.
pub fn micros(scene: &Scene, way: &Way) -> Result<f64, ContactError<f64>> {
    let (x, mut p) = (scene.grid(), [0.0; 101]);
    let mut solve = || -> Result<(), ContactError<f64>> {
        let contact = contact(black_box(scene), black_box(way))?;
        contact.solve(scene.load())?.pressure()?.at_many(&x, &mut p)?;
        black_box(&p);
        Ok(())
    };
    let mut batch = |calls: u32| -> Result<f64, ContactError<f64>> {
        let start = Instant::now();
        (0..calls).try_for_each(|_| solve())?;
        Ok(start.elapsed().as_secs_f64() * 1e6 / f64::from(calls))
    };
    let mut least = batch(1)?;
    if least < 2e4 {
        least = least.min(batch(1)?);
        let calls = (2e3 / least).ceil() as u32;
        for _ in 0..5 {
            least = least.min(batch(calls)?);
        }
    }
    Ok(least)
}
