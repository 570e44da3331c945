//! A solver that is used again gives what one just made gives.
#![allow(missing_docs)]

use crate::common;

use common::join;
use linecontact::{Contact, Curve, CurvePoint, Flat, Load, ParametricProfile};

fn arc(from: f64, to: f64) -> Box<dyn ParametricProfile<f64>> {
    Box::new(Curve::new([from, to], |k: f64| {
        let (sin, cos) = k.sin_cos();
        CurvePoint { x: sin, y: 1.0 - cos, dx: cos, dy: sin }
    }))
}

#[test]
fn loads_up_and_down() {
    let pieces = |n: i32| {
        let end = move |i: i32| 0.6 * f64::from(2 * i - n) / f64::from(n);
        join((0..n).map(|i| arc(end(i), end(i + 1))).collect())
    };
    for body in [arc(-1.5, 1.5), pieces(2), pieces(7), pieces(50)] {
        let contact = Contact::new(&Flat, &*body).unwrap();
        let mut solver = contact.solver().unwrap();
        for load in [0.03, 0.031, 0.02, 0.04, 0.03, 0.03, 1e-3, 0.05, 0.04, 0.005, 0.03] {
            let cold = contact.solve(Load::PerLength(load)).unwrap();
            let warm = solver.solve(&contact, Load::PerLength(load)).unwrap();
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
