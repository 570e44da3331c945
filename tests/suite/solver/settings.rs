//! A used solver gives the results of a new one.
#![allow(missing_docs)]

use crate::common;

use common::{circle, join};
use linecontact::{
    Contact, ContactError, Control, Flat, InputError, Interval, Midpoint, Panels, Solution, Solver,
};

#[test]
fn loads_up_and_down() {
    let pieces = |n: i32| {
        let end = move |i: i32| 0.6 * f64::from(2 * i - n) / f64::from(n);
        join((0..n).map(|i| circle(end(i), end(i + 1), 1.0)).collect())
    };
    for body in [circle(-1.5, 1.5, 1.0), pieces(2), pieces(7), pieces(50)] {
        let contact = Contact::new(&Flat, &*body).unwrap();
        let mut solver = Solver::new();
        for load in [0.03, 0.031, 0.02, 0.04, 0.03, 0.03, 1e-3, 0.05, 0.04, 0.005, 0.03] {
            let cold = contact.solve(Control::Load(load)).unwrap();
            let warm = solver.solve(&contact, Control::Load(load)).unwrap();
            assert!((warm.a() / cold.a() - 1.0).abs() < 1e-14, "{load}");
            assert!((warm.b() / cold.b() - 1.0).abs() < 1e-14, "{load}");
            let [cold_pressure, pressure] = [&cold, &warm].map(|s| s.pressure().unwrap());
            for share in [-0.9, -0.5, -0.1, 0.0, 0.3, 0.7, 0.99] {
                let x = share * cold.a();
                let [want, got] = [&cold_pressure, &pressure].map(|p| p.at(x).unwrap());
                assert!((got / want - 1.0).abs() < 1e-12, "{load} {share}: {got} {want}");
            }
        }
    }
}

/// Returns the interval, a pressure, an error and the cost, to tell one quadrature from another.
fn seen(solution: &Solution<f64>) -> (Interval<f64>, [f64; 2], usize) {
    let mut cost = linecontact::Cost::default();
    let pressure = solution.pressure().unwrap();
    let estimate = pressure.estimate(0.1 * solution.a(), &mut cost).unwrap();
    (solution.hull(), [estimate.value, estimate.error], solution.cost().evaluations)
}

#[test]
fn the_quadrature_is_that_of_each_contact() {
    let body = circle(-1.5, 1.5, 1.0);
    let rules = [Midpoint::paper(16, 2), Midpoint::paper(32, 2)];
    let panels = [Panels::FULL, Panels { tolerance: 1e-6 }];
    let contact = Contact::new(&Flat, &*body).unwrap();
    let contacts = [
        contact.clone(),
        contact.clone().quadrature(&rules[0]),
        contact.clone().quadrature(&panels[1]),
        contact.clone().quadrature(&rules[1]),
        contact.clone().quadrature(&panels[0]),
    ];
    let load = Control::Load(0.03);
    let mut solver = Solver::new();
    for which in [0, 1, 0, 3, 1, 2, 0, 2, 4, 3] {
        let alone = seen(&contacts[which].solve(load).unwrap());
        assert_eq!(seen(&solver.solve(&contacts[which], load).unwrap()), alone, "{which}");
    }
    // The same settings at another address: no new samples.
    solver.solve(&contacts[0], load).unwrap();
    assert_eq!(solver.solve(&contacts[4], load).unwrap().cost().evaluations, 0);
    // Unusable settings are refused here, too, and leave the solver intact.
    let never = Panels { tolerance: 1.0 };
    let refused = solver.solve(&contact.clone().quadrature(&never), load).unwrap_err();
    assert_eq!(refused, ContactError::Input(InputError::InvalidTolerance { tolerance: 1.0 }));
    let alone = seen(&contact.solve(load).unwrap());
    assert_eq!(seen(&solver.solve(&contact, load).unwrap()), alone);
}
