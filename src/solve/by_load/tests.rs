//! Quantities that fall, made up: where a contact is born, or anywhere.

use super::{ByLoad, Quantity, Value, find};
use crate::gap::Cost;
use crate::quadrature::{Engine, Panels};
use crate::solution::{ContactState, LoadRates, Solved};
use crate::solve::{Contact, Work, Workspace};
use crate::{ContactError, Control, Curve, CurvePoint, Flat, ParametricProfile, SolveError};

/// Value and rate of a quantity in a contact.
type Of = fn(Solved<'_, f64>) -> [f64; 2];

/// Load over the total width, which falls when a contact is born.
fn mean_pressure(solved: Solved<'_, f64>) -> [f64; 2] {
    let width: f64 = solved.contacts().iter().map(|on| on.right - on.left).sum();
    let limits = LoadRates::new(solved).unwrap().limits;
    let widening: f64 = limits.iter().map(|rates| rates.right - rates.left).sum();
    let mean = solved.found.load / width;
    [mean, (1.0 - mean * widening) / width]
}

/// Load over the width of the hull, which jumps down when a contact is born outside it.
fn pressure_of_hull(solved: Solved<'_, f64>) -> [f64; 2] {
    let (load, on) = (solved.found.load, solved.found.interval);
    let (width, rates) = (on.right - on.left, LoadRates::new(solved).unwrap());
    [load / width, (1.0 - load / width * (rates.a + rates.b)) / width]
}

/// Cubic of the load, which falls from 0.44 to 0.76 while there is one contact.
fn cubic(solved: Solved<'_, f64>) -> [f64; 2] {
    let load = solved.found.load;
    [load * (1.0 - load * (1.8 - load)), 1.0 - load * (3.6 - 3.0 * load)]
}

/// The same, with a root of the load that makes Newton's method go too far from light loads.
fn steepening(solved: Solved<'_, f64>) -> [f64; 2] {
    let ([value, rate], root) = (cubic(solved), 0.05 * solved.found.load.sqrt().sqrt());
    [value + root, rate + 0.25 * root / solved.found.load]
}

/// Load that jumps down under 0.4, and rises before and after.
fn sawtooth(solved: Solved<'_, f64>) -> [f64; 2] {
    let load = solved.found.load;
    [if load < 0.4 { load } else { load - 0.2 }, 1.0]
}

/// Cubic of the load, which falls by half a percent.
fn shallow(solved: Solved<'_, f64>) -> [f64; 2] {
    let load = solved.found.load;
    [load * (1.0 - load * (1.745 - load)), 1.0 - load * (3.49 - 3.0 * load)]
}

/// Quantity with the load to try first.
struct Made {
    of: Of,
    first: f64,
}

impl Quantity<f64> for Made {
    fn first_load(&self, _: &mut ByLoad<'_, '_, '_, f64>) -> Result<f64, ContactError<f64>> {
        Ok(self.first)
    }

    fn at(&self, found: &ContactState<f64>, search: &mut ByLoad<'_, '_, '_, f64>) -> Value<f64> {
        let [value, rate] = (self.of)(search.solved(found));
        Ok([value, rate, 0.0])
    }

    fn may_fall(&self, _: &Contact<'_, f64>) -> bool {
        true
    }
}

/// Returns x²/2 with a hill beside it.
fn body(tall: f64) -> Box<dyn ParametricProfile<f64>> {
    Box::new(Curve::new([-1.5, 3.0], move |x: f64| {
        let (bell, slope) = (tall * (-2.0 * (x - 1.5).powi(2)).exp(), -4.0 * (x - 1.5));
        CurvePoint { x, y: x * x / 2.0 - bell, dx: 1.0, dy: x - bell * slope }
    }))
}

/// Finds the load under which a quantity has a value.
fn sought(contact: &Contact<'_, f64>, made: &Made, wanted: f64) -> Result<f64, ContactError<f64>> {
    let mut integrator = Engine::new(&Panels::FULL).unwrap();
    let (mut workspace, mut cost) = (Workspace::new(), Cost::default());
    let (integrator, workspace) = (&mut integrator, &mut workspace);
    let mut work = Work { integrator, workspace, cost: &mut cost };
    find(contact, made, ("quantity", wanted), &mut work).map(|found| found.load)
}

/// A value that the quantity has before and after it falls has several loads.
#[test]
fn a_quantity_that_falls_is_sought_on_the_branch_from_first_touch() {
    let (mut found, mut refused) = (0, 0);
    let made: [(Of, f64); 9] = [
        (mean_pressure, 0.9),
        (mean_pressure, 1.0),
        (mean_pressure, 1.1),
        (pressure_of_hull, 0.9),
        (pressure_of_hull, 1.1),
        (cubic, 0.0),
        (shallow, 0.0),
        (steepening, 0.0),
        (sawtooth, 0.0),
    ];
    for (of, tall) in made {
        let body = body(tall);
        let contact = Contact::new(&Flat, &*body).unwrap();
        let value = |load: f64| {
            let solution = contact.solve(Control::Load(load)).ok()?;
            Some(of(solution.solved())[0])
        };
        let points: Vec<[f64; 2]> = (0..300)
            .map(|i| 1e-3 * 1.025f64.powi(i))
            .map_while(|load| Some([load, value(load)?]))
            .collect();
        let top = points.windows(2).position(|pair| pair[1][1] < pair[0][1]).unwrap();
        let [last, most] = points[top];
        let least = points[top..].iter().map(|at| at[1]).fold(f64::INFINITY, f64::min);
        let between = least + 0.9 * (most - least);
        for wanted in [0.3 * most, 0.8 * most, between, 1.05 * most] {
            // The last of its loads.
            let above = points.iter().rev().take_while(|at| at[1] > wanted).last();
            let mut ends = above.map_or([last; 2], |at| [at[0] / 1.025, at[0]]);
            for _ in 0..50 {
                let middle = 0.5 * (ends[0] + ends[1]);
                let is_above = value(middle).unwrap() > wanted;
                ends = if is_above { [ends[0], middle] } else { [middle, ends[1]] };
            }
            let after = ends[1];
            for first in [1e-3, 0.1, 0.3, 1.0, 1.7, 1e3, 1e7].map(|factor| factor * after) {
                match sought(&contact, &Made { of, first }, wanted) {
                    Ok(load) => {
                        found += 1;
                        assert!(load < 1.03 * last, "{tall}: {wanted} under {load}");
                        assert!((value(load).unwrap() / wanted - 1.0).abs() < 1e-9);
                    }
                    Err(ContactError::Solve(SolveError::Falls { quantity, load, rate })) => {
                        refused += 1;
                        assert!(quantity == "quantity" && rate <= 0.0, "{quantity} {rate}");
                        assert!(wanted > 0.99 * most, "{tall}: {wanted} of {most}, {first}");
                        assert!((load / last - 1.0).abs() < 0.03, "{tall}: {load} for {last}");
                    }
                    Err(error) => panic!("{tall}, {wanted}, {first}: {error}"),
                }
            }
        }
    }
    println!("{found} found, {refused} refused");
    assert!(found > 50 && refused > 10);
}
