//! Displacements of the surfaces, inside and beside the contact, against Hertz's contact and a flat
//! punch, and against the gap between the loaded bodies.
#![allow(missing_docs)]

use crate::common::{graph, quartic};
use linecontact::profile::Parabola;
use linecontact::{
    Base, Body, Contact, ContactError, Control, Edge, Flat, InputError, Layer, Material,
    PlaneState, Reference, References, Solution, SolveError,
};
use std::f64::consts::{PI, TAU};

const STEEL: Material<f64> = Material::Elastic { youngs_modulus: 2.1, poisson_ratio: 0.3 };
const SOFT: Material<f64> = Material::Elastic { youngs_modulus: 0.7, poisson_ratio: 0.45 };

/// Places inside a contact from -1 to 1, at its limits, beside it and beyond the bodies.
const PLACES: [f64; 9] = [0.0, 0.3, -0.99, 1.0, -1.0, 1.0 + 1e-9, -1.7, 3.0, 1e4];

/// Asserts displacements in a contact of half-width 0.2 towards a length, against
/// `∫ P ln|x - s| ds/F - ln(L/2)` by x/L.
fn assert_exact(solution: &Solution<f64>, shape: impl Fn(f64) -> f64) {
    let (half_width, length) = (0.2, 7.0);
    let to = References { x: 0.1, lower: Reference::Length(length), upper: Reference::Disc(3.0) };
    for (body, ratio, modulus, length) in [
        (Body::Lower, 0.3f64, 2.1, length),
        (Body::Upper, 0.45, 0.7, 2.0 * 3.0 / std::f64::consts::E),
    ] {
        let unit = (1.0 - ratio * ratio) / (PI * modulus) * solution.load();
        for place in PLACES {
            let exact = 2.0 * unit * ((2.0 * length / half_width).ln() - shape(place));
            let found = solution.displacement(body, half_width * place, &to).unwrap();
            let off = (found - exact).abs() / unit;
            assert!(off < 2e-13 * (1.0 + place.abs().ln_1p()), "{body:?} at {place}: {off:e}");
        }
    }
}

#[test]
fn below_and_beside_hertz_and_a_punch_it_is_the_closed_form() {
    let body = Parabola::new(1.0, [-0.5, 0.4]).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().materials(STEEL, SOFT, PlaneState::Strain);
    let eta = |z: f64| (z.abs() - 1.0).max(0.0);
    let eta = |z: f64| (eta(z) + (eta(z) * (eta(z) + 2.0)).sqrt()).ln_1p();
    let hertz = contact.solve(Control::HalfWidth(0.2)).unwrap();
    assert_exact(&hertz, |z| match z.abs() < 1.0 {
        true => z * z - 0.5,
        false => eta(z) + 0.5 * (-2.0 * eta(z)).exp(),
    });
    let flat = graph(-0.2, 0.2, |_| [0.0, 0.0]);
    let contact = Contact::new(&Flat, &*flat).unwrap().materials(STEEL, SOFT, PlaneState::Strain);
    let contact = contact.edges(Edge::Fixed(-0.2), Edge::Fixed(0.2));
    assert_exact(&contact.solve(Control::Load(0.02)).unwrap(), eta);
    // A rigid body keeps its shape.
    let rigid =
        Contact::new(&Flat, &*flat).unwrap().materials(STEEL, Material::Rigid, PlaneState::Strain);
    let rigid =
        rigid.edges(Edge::Fixed(-0.2), Edge::Fixed(0.2)).solve(Control::Load(0.02)).unwrap();
    let to = References { x: 0.0, lower: Reference::Depth(2.0), upper: Reference::Depth(2.0) };
    assert_eq!(rigid.displacement(Body::Upper, 0.1, &to).unwrap(), 0.0);
}

/// Asserts that displacements of both surfaces open the gap as the solution says, and are the
/// approach of the surfaces at the reference.
fn assert_consistent(
    name: &str,
    solution: &Solution<f64>,
    heights: impl Fn(f64) -> f64,
    x: &[f64],
) {
    let to = References { x: x[0], lower: Reference::Depth(2.0), upper: Reference::Depth(3.0) };
    let of = |body, x| solution.displacement(body, x, &to).unwrap();
    let both = |x| of(Body::Lower, x) + of(Body::Upper, x);
    let approach = solution.approach(&to).unwrap();
    let scale = approach.bodies.abs();
    for (body, exact) in [(Body::Lower, approach.lower), (Body::Upper, approach.upper)] {
        assert!((of(body, x[0]) - exact).abs() < 1e-12 * scale, "{name}: {body:?}");
    }
    let (edge, intervals) = (solution.a(), solution.intervals());
    for &x in x {
        let touches = intervals.iter().any(|on| x >= on.left && x <= on.right);
        let gap = if touches { 0.0 } else { solution.gap_at(x).unwrap() };
        let exact = gap - (heights(x) - heights(edge));
        let off = (both(x) - both(edge) - exact).abs();
        assert!(off < 3e-12 * scale, "{name} at {x}: {off:e} of {scale:e}");
    }
}

#[test]
fn both_surfaces_together_open_the_gap() {
    let quartic = quartic(-2.5, 2.5);
    let height = |x: f64| x * x * (x * x - 2.0);
    let two = Contact::new(&Flat, &*quartic).unwrap().materials(STEEL, SOFT, PlaneState::Strain);
    let x = [0.2, 1.0, -0.95, 0.0, 2.4, -1.9];
    assert_consistent("two", &two.solve(Control::Load(0.1)).unwrap(), height, &x);
    let material = Material::elastic(0.2, 0.4);
    let body = Parabola::new(1.0, [-2.0, 2.0]).unwrap();
    for base in [Base::Bonded, Base::Frictionless, Base::HalfPlane(STEEL)] {
        let layer = Layer { material, thickness: 0.3, base };
        let coated =
            Contact::new(&Flat, &body).unwrap().materials(layer, STEEL, PlaneState::Strain);
        let solution = coated.solve(Control::HalfWidth(0.2)).unwrap();
        let x = [0.1, 0.0, -0.15, 0.25, -1.0, 1.9];
        assert_consistent("coated", &solution, |x| 0.5 * x * x, &x);
    }
    let wave = graph(0.0, 1.0, |x| [0.01 * (TAU * x).sin(), 0.01 * TAU * (TAU * x).cos()]);
    let row = Contact::new(&Flat, &*wave).unwrap().materials(STEEL, SOFT, PlaneState::Strain);
    let solution = row.period(1.0).solve(Control::Load(2e-3)).unwrap();
    let x = [0.7, 0.75, 0.4, 0.1, 2.3];
    assert_consistent("row", &solution, |x| 0.01 * (TAU * x).sin(), &x);
}

#[test]
fn of_nothing_it_is_zero_and_what_is_unknown_is_refused() {
    let body = Parabola::new(1.0, [-2.0, 2.0]).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap();
    let to = References { x: 0.0, lower: Reference::Depth(2.0), upper: Reference::Depth(3.0) };
    let unknown = contact.solve(Control::Load(0.1)).unwrap().displacement(Body::Lower, 0.1, &to);
    assert!(matches!(unknown, Err(ContactError::Input(InputError::NoMaterials))));
    let contact = contact.materials(STEEL, SOFT, PlaneState::Stress);
    let apart = contact.solve(Control::Load(0.0)).unwrap();
    assert_eq!(apart.displacement(Body::Upper, 0.7, &to).unwrap(), 0.0);
    let solution = contact.solve(Control::Load(0.1)).unwrap();
    for x in [f64::NAN, f64::INFINITY] {
        let refused = solution.displacement(Body::Lower, x, &to);
        assert!(matches!(refused, Err(ContactError::Solve(SolveError::OutsideBodies { .. }))));
    }
}
