//! Solutions are owned values: returned, kept, cloned, sent.
#![allow(missing_docs)]

use crate::common;

use common::{graph, join};
use linecontact::quadrature::Quadrature;
use linecontact::search::{Bisection, Brent, Newton, Secant};
use linecontact::{
    Contact, ContactError, Control, Curve, CurvePoint, Flat, Midpoint, Panels, ParametricProfile,
    Solution, Solver,
};
use std::sync::Arc;

fn arc(radius: f64) -> impl ParametricProfile<f64> {
    Curve::new([-1.0, 1.0], move |k: f64| {
        let (sin, cos) = k.sin_cos();
        CurvePoint { x: radius * sin, y: radius * (1.0 - cos), dx: radius * cos, dy: radius * sin }
    })
}

/// Returns a parabola whose right half bends more.
fn bent() -> impl ParametricProfile<f64> {
    join(vec![
        graph(-1.0, 0.1, |x| [x * x / 2.0, x]),
        graph(0.1, 1.0, |x| [x * x / 2.0 + 3.0 * (x - 0.1).powi(2), x + 6.0 * (x - 0.1)]),
    ])
}

/// Returns limits, load, pressures and derived results, as bits.
fn bits(solution: &Solution<f64>) -> Vec<u64> {
    let (on, pressure) = (solution.hull(), solution.pressure().unwrap());
    let mut pressures = [0.0; 11];
    let x = [0.3, 0.5, 0.8, 1.1, 1.4, 1.7, 2.0, 2.3, 2.6, 2.8, 2.9].map(|t| on.at_angle(t));
    pressure.at_many(&x, &mut pressures).unwrap();
    let moment = solution.moment().unwrap();
    let numbers = [on.left, on.right, solution.load(), solution.peak().unwrap().pressure, moment];
    numbers.into_iter().chain(pressures).map(f64::to_bits).collect()
}

/// Solves bodies that are dropped with this function.
fn of_local_bodies(load: f64) -> Result<Solution<'static, f64>, ContactError<f64>> {
    let (below, above) = (arc(-2.0), bent());
    Contact::owned(Arc::new(below), Arc::new(above))?.solve(Control::Load(load))
}

#[test]
fn a_function_returns_the_solution_of_bodies_of_its_own() {
    let owned = of_local_bodies(0.03).unwrap();
    let (below, above) = (arc(-2.0), bent());
    let lent = Contact::new(&below, &above).unwrap().solve(Control::Load(0.03)).unwrap();
    assert_eq!(bits(&owned), bits(&lent));
    assert_eq!(owned.cost(), lent.cost());
    let x = owned.a() + 0.1;
    assert_eq!(owned.gap_at(x).unwrap().to_bits(), lent.gap_at(x).unwrap().to_bits());
    assert_eq!(owned.certify().unwrap(), lent.certify().unwrap());
}

#[test]
fn settings_outlive_the_function_that_sets_them() {
    let scene = || -> Result<Contact<'static, f64>, ContactError<f64>> {
        let contact = Contact::owned(Arc::new(Flat), Arc::new(arc(1.0)))?;
        Ok(contact
            .inversion(&Newton::DEFAULT)
            .limit_search(&Brent::DEFAULT)
            .quadrature(&Midpoint::DEFAULT))
    };
    let plain = Contact::owned(Arc::new(Flat), Arc::new(arc(1.0))).unwrap();
    let [set, plain] = [scene().unwrap(), plain].map(|of| of.solve(Control::Load(0.02)).unwrap());
    assert!((set.a() / plain.a() - 1.0).abs() < 1e-13, "{set:?}");
    assert!(set.cost().evaluations > plain.cost().evaluations, "{set:?}");
    // Full accuracy is the default of each search.
    assert_eq!((Brent::DEFAULT, Newton::DEFAULT), Default::default());
    assert_eq!((Bisection::DEFAULT, Secant::DEFAULT), Default::default());
    assert_eq!((Midpoint::DEFAULT, Panels::FULL), Default::default());
}

#[test]
fn a_solution_outlives_the_contact_and_the_solver() {
    let body = arc(1.0);
    let solutions = {
        let contact = Contact::new(&Flat, &body).unwrap();
        let mut solver = Solver::new();
        let warm = [0.01, 0.02].map(|load| solver.solve(&contact, Control::Load(load)).unwrap());
        [warm, [0.01, 0.02].map(|load| contact.solve(Control::Load(load)).unwrap())]
    };
    let [warm, cold] = solutions.map(|of| of.map(|s| s.pressure().unwrap().at(0.01).unwrap()));
    for (warm, cold) in warm.into_iter().zip(cold) {
        assert!((warm / cold - 1.0).abs() < 1e-13, "{warm} {cold}");
    }
}

#[test]
fn solutions_that_are_kept_stay_what_they_were() {
    let (below, above, other) = (arc(-2.0), bent(), arc(0.7));
    let rule = Midpoint { segments: 16, ..Midpoint::DEFAULT };
    for quadrature in [&Panels::FULL as &dyn Quadrature<f64>, &rule] {
        let contacts = [Contact::new(&below, &above), Contact::new(&Flat, &other)]
            .map(|contact| contact.unwrap().quadrature(quadrature));
        // The first solver keeps each solution, the second drops it before the next solve.
        let [mut keeper, mut dropper] = [Solver::new(), Solver::new()];
        let (mut kept, mut seen) = (Vec::new(), Vec::new());
        for (which, load) in [(0, 0.05), (0, 0.04), (0, 0.2), (1, 0.01), (1, 0.03), (0, 0.05)] {
            let load = Control::Load(load);
            kept.push(keeper.solve(&contacts[which], load).unwrap());
            let dropped = dropper.solve(&contacts[which], load).unwrap();
            seen.push((bits(&dropped), dropped.cost()));
            let afresh = contacts[which].solve(load).unwrap();
            for (dropped, afresh) in [(dropped.a(), afresh.a()), (dropped.b(), afresh.b())] {
                assert!((dropped / afresh - 1.0).abs() < 1e-13, "{dropped} {afresh}");
            }
        }
        for (kept, seen) in kept.iter().zip(&seen) {
            assert_eq!((bits(kept), kept.cost()), *seen);
        }
        // A new solver gives the result of the contact alone.
        let load = Control::Load(0.03);
        let first = Solver::new().solve(&contacts[0], load).unwrap();
        assert_eq!(bits(&first), bits(&contacts[0].solve(load).unwrap()));
    }
}

#[test]
fn a_clone_goes_to_a_thread() {
    fn is_sent_and_shared<S: Clone + Send + Sync + std::fmt::Debug>(_: &S) {}
    let mut solver = Solver::new();
    let contact = Contact::owned(Arc::new(Flat), Arc::new(arc(1.0))).unwrap();
    let solution = solver.solve(&contact, Control::Load(0.02)).unwrap();
    is_sent_and_shared(&solution);
    let here = bits(&solution);
    let sent = solution.clone();
    let thread = std::thread::spawn(move || bits(&sent));
    // Meanwhile the solver goes on.
    for load in [0.05, 0.001, 0.03] {
        solver.solve(&contact, Control::Load(load)).unwrap();
    }
    assert_eq!(thread.join().unwrap(), here);
    assert_eq!(bits(&solution), here);
}
