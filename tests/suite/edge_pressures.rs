//! Given pressures at given distances from the edges: Eq. (6) of the paper.
#![allow(missing_docs)]

use crate::common::{self, NanSafe, assert_close, paper, parabola, reference};
use linecontact::search::{StoppingCriteria, strategies};
use linecontact::{
    Attempt, Contact, ContactError, Control, EdgePressure, Exponents, Flat, Interval, Midpoint,
    Outcome, SolveError, Start,
};
use std::f64::consts::PI;

#[test]
fn edge_pressures_of_the_exact_solution_give_its_limits() {
    // Eq. (6) with the A and B of the exact pressure at these distances.
    let example = paper::two();
    let (eps_a, eps_b) = (0.05, 0.02);
    let wanted = EdgePressure {
        at_a: common::example_2_exact(1.0 - eps_a),
        at_b: common::example_2_exact(eps_b - 0.6),
        distance_a: eps_a,
        distance_b: eps_b,
        tolerance_a: 1e-7,
        tolerance_b: 1e-7,
    };
    let rule = Midpoint { segments: 512, extrapolations: 4, exponents: Exponents::HalfInteger };
    let starts = [(0.6, 1.0), (6.0, 10.0), (0.06, 0.1), (-0.5, 3.0)];
    let starts = starts.into_iter().cycle();
    for ((name, strategy), (b, a)) in strategies(StoppingCriteria::FULL).into_iter().zip(starts) {
        let contact = Contact::new(&*example.lower, &*example.upper).unwrap().kappa(PI / 2.0);
        let contact = contact.edge_pressure(wanted).quadrature(&rule).limit_search(&*strategy);
        let contact = contact.start(Interval { left: -b, right: a });
        let solution = contact.solve(Control::Load(example.c / PI)).expect(name);
        assert_close(solution.a(), 1.0, 1e-7);
        assert_close(solution.b(), 0.6, 1e-7);
        let given = Attempt { start: Start::Given, outcome: Outcome::Unchecked };
        assert_eq!(solution.report().attempts(), [given]);
        // The condition itself, as a user would check it.
        let pressure = solution.pressure().unwrap();
        let at_a = pressure.at(solution.a() - eps_a).unwrap();
        let at_b = pressure.at(eps_b - solution.b()).unwrap();
        assert!((at_a - wanted.at_a).abs() <= 1e-7 && (at_b - wanted.at_b).abs() <= 1e-7);
    }
}

#[test]
fn edge_pressures_approach_the_free_limits() {
    // With A = B = 0 the limits are too narrow by about ε, and the rule adds its own error.
    let example = paper::three();
    let want = reference("paper_example_3_scale_one");
    let rule = Midpoint::paper(1024, 2);
    let mut last = f64::INFINITY;
    for eps in [4e-3, 1e-3, 2.5e-4] {
        let edges = EdgePressure::zero(eps, 1e-6);
        let contact = Contact::new(&*example.lower, &*example.upper).unwrap();
        let contact = contact.edge_pressure(edges).quadrature(&rule);
        let solution = contact.solve(Control::Load(example.c / PI)).unwrap();
        let error =
            (solution.a() / want.a - 1.0).abs().nan_max((solution.b() / want.b - 1.0).abs());
        assert!(error < 0.6 * last, "{error} at ε = {eps}, {last} at four times that");
        last = error;
    }
    assert!(last < 1e-2);
}

#[test]
fn edge_pressures_that_cannot_be_met() {
    let body = parabola(1.0);
    // A tolerance below rounding: the error carries the pressures reached.
    let strict = EdgePressure { at_a: 0.1, at_b: 0.1, ..EdgePressure::zero(0.05, 1e-30) };
    let contact = Contact::new(&Flat, &*body).unwrap().edge_pressure(strict);
    match contact.solve(Control::Load(0.1)) {
        Err(ContactError::Solve(SolveError::EdgePressureNotMet { best, at_a, at_b })) => {
            assert!(at_a.abs() < 1e-12 && at_b.abs() < 1e-12);
            assert!((best.half_width() / 0.2f64.sqrt() - 1.0).abs() < 0.2, "{best:?}");
        }
        Ok(solution) => panic!("{solution:?}"),
        Err(other) => panic!("{other}"),
    }
}

#[test]
fn edge_pressures_that_take_a_wider_contact_than_the_bodies() {
    // For a parabola with both limits given, P = κ sqrt(L² - x²)/π + (F - κ L²/2)/(π sqrt(L² -
    // x²)).
    let (load, distance) = (2.0, 0.01);
    let body = parabola(1.0);
    let wanted = EdgePressure::zero(distance, 1e-3);
    let contact = Contact::new(&Flat, &*body).unwrap().edge_pressure(wanted);
    let error = contact.solve(Control::Load(load)).unwrap_err();
    let ContactError::Solve(SolveError::EdgePressureNotMet { best, at_a, at_b }) = error else {
        panic!("{error}")
    };
    for limit in [best.right, -best.left] {
        assert!((limit - 1.0).abs() < 1e-12, "{best:?}");
    }
    let root = (1.0 - (1.0 - distance) * (1.0 - distance)).sqrt();
    let left_over = (root + (load - 0.5) / root) / std::f64::consts::PI;
    for at in [at_a, at_b] {
        assert!((at / left_over - 1.0).abs() < 1e-3, "{at} {left_over}");
    }
}
