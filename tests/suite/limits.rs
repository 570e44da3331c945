//! The limits a and b: against 25-digit references, in any unit, and by every search.
#![allow(missing_docs)]

use crate::common;

use approx::assert_relative_eq;
use common::{assert_close, graph, join, on_flat, parabola, reference, scenes};
use linecontact::search::{StoppingCriteria, strategies};
use linecontact::{Contact, Control, Curve, CurvePoint, Flat, Interval};
use std::f64::consts::PI;

/// Solves the scenes that have a reference, and returns the larger relative error of a and b of
/// each.
pub fn errors() -> Vec<(&'static str, f64)> {
    let solved = |scene: common::Scene| {
        let want = reference(scene.name);
        let contact = scene.contact();
        let solution = contact.solve(Control::Load(want.c / PI)).expect(scene.name);
        println!(
            "{:32} a {:9.1e}  b {:9.1e}  estimate {:8.1e}  {:?}",
            scene.name,
            solution.a() / want.a - 1.0,
            solution.b() / want.b - 1.0,
            solution.limits_error().unwrap(),
            solution.cost()
        );
        assert_close(solution.a(), want.a, scene.accuracy);
        assert_close(solution.b(), want.b, scene.accuracy);
        let errors = [solution.a() / want.a - 1.0, solution.b() / want.b - 1.0];
        (scene.name, common::worst(errors.map(f64::abs)))
    };
    scenes().into_iter().map(solved).collect()
}

#[test]
fn limits_agree_with_the_references() {
    errors();
}

#[test]
fn every_strategy_serves_for_either_search() {
    let strategies = strategies(StoppingCriteria::FULL);
    for scene in scenes() {
        let want = reference(scene.name);
        for (_, strategy) in &strategies {
            let strategy = &**strategy;
            for contact in
                [scene.contact().limit_search(strategy), scene.contact().inversion(strategy)]
            {
                // Bisection of a curve with its zero at k = 0 continues down to the smallest
                // number.
                let solution = contact.solve(Control::Load(want.c / PI)).expect(scene.name);
                assert_close(solution.a(), want.a, scene.accuracy);
                assert_close(solution.b(), want.b, scene.accuracy);
            }
        }
    }
}

#[test]
fn the_scale_has_two_names() {
    let contact = on_flat(parabola(1.0));
    let by_modulus = contact.clone().contact_modulus(3.0);
    let modulus = by_modulus.solve(Control::Load(0.1)).unwrap();
    let kappa = contact.kappa(1.5 * PI).solve(Control::Load(0.1)).map(|s| [s.a(), s.load()]);
    assert_eq!(kappa.unwrap(), [modulus.a(), modulus.load()]);
    // Hertz: L² = 4 F R/(π E*).
    assert_close(modulus.a(), (0.4 / (3.0 * PI)).sqrt(), 1e-15);
}

#[test]
fn single_precision() {
    let body =
        Curve::new([-2.0f32, 2.0], |k: f32| CurvePoint { x: k, y: k * k, dx: 1.0, dy: 2.0 * k });
    for (_, strategy) in strategies(StoppingCriteria::FULL) {
        let contact =
            Contact::new(&Flat, &body).unwrap().limit_search(&*strategy).inversion(&*strategy);
        let solution = contact.solve(Control::Load(0.25)).unwrap();
        assert_relative_eq!(solution.a(), 0.5, epsilon = 0.0, max_relative = 1e-6);
        assert_relative_eq!(solution.b(), 0.5, epsilon = 0.0, max_relative = 1e-6);
        // P(0) = 2 L/π.
        let peak = solution.pressure().unwrap().at(0.1f32).unwrap();
        let exact = 2.0 * (0.25f64 - 0.01).sqrt() / PI;
        assert_relative_eq!(f64::from(peak), exact, epsilon = 0.0, max_relative = 1e-5);
    }
}

#[test]
fn units_do_not_decide() {
    // A flat bottom with parabolic shoulders carries nothing until the contact reaches them.
    let shoulder = |x: f64, at: f64| [(x - at).powi(2) / 2.0, x - at];
    let body = join(vec![
        graph(-3.0, -1.0, move |x| shoulder(x, -1.0)),
        graph(-1.0, 1.0, |_| [0.0, 0.0]),
        graph(1.0, 3.0, move |x| shoulder(x, 1.0)),
    ]);
    let start = Interval { left: -0.3, right: 0.3 };
    let contact = Contact::new(&Flat, &*body).unwrap().start(start);
    let plain = contact.solve(Control::Load(0.1)).unwrap();
    for scale in [1e-20, 1e30] {
        let scaled = contact.clone().kappa(scale);
        let solution = scaled.solve(Control::Load(0.1 * scale)).unwrap();
        assert!((solution.a() / plain.a() - 1.0).abs() < 1e-14, "{solution:?}");
        assert!(solution.limits_error().unwrap() < 1e-13);
    }
}

/// F = L I₁(L) of cosh: a contact of 1.4e-3 on bodies with slopes of e^300.
#[test]
fn a_small_contact_on_steep_bodies() {
    let contact = on_flat(graph(-300.0, 300.0, |x| [(x - 3.7).cosh(), (x - 3.7).sinh()]));
    let half_width = 1.4e-3;
    let load = half_width * half_width / 2.0 * (1.0 + half_width * half_width / 8.0);
    let solution = contact.solve(Control::Load(load)).unwrap();
    let on = solution.hull();
    // To the rounding of x = 3.7.
    assert!((on.centre() - 3.7).abs() < 1e-12 * half_width + 2e-15, "{on:?}");
    assert_relative_eq!(on.half_width(), half_width, epsilon = 0.0, max_relative = 3e-12);
}
