//! Derivatives of contacts of layers by the numbers of the layers.
#![allow(missing_docs)]

use linecontact::autodiff::num_dual::Dual64;
use linecontact::profile::Parabola;
use linecontact::{
    Base, Body, Contact, Control, Flat, Layer, Material, PlaneState, Real, Reference, References,
};

/// Returns half-width and peak under a load, stresses in layer and base, the largest tension and
/// approaches, given E, ν, h and E of the base.
fn answers<T: Real>([modulus, ratio, thickness, base]: [T; 4]) -> [T; 7] {
    let of = |value: f64| T::of(value);
    let body = Parabola::new(of(1.0), [of(-6.0), of(6.0)]).unwrap();
    let base = Base::HalfPlane(Material::elastic(base, of(0.3)));
    let layer = Layer { material: Material::elastic(modulus, ratio), thickness, base };
    let contact = Contact::new(&Flat, &body).unwrap();
    let contact = contact.materials(layer, Material::Rigid, PlaneState::Strain);
    let solution = contact.solve(Control::Load(of(0.6))).unwrap();
    let below = solution.subsurface_of(Body::Lower).unwrap();
    let [layer, base] = [0.5, 1.2].map(|depth| below.at(of(0.3), of(depth)).unwrap());
    let tension = below.max_tension().unwrap().value;
    let [near, far] = [0.5, 4.0].map(|depth| {
        let depth = Reference::Depth(of(depth));
        let to = References { x: of(0.3), lower: depth, upper: depth };
        solution.approach(&to).unwrap().bodies
    });
    let peak = solution.peak().unwrap().pressure;
    [solution.a(), peak, layer.sigma_x, base.tau_xy, tension, near, far]
}

#[test]
fn derivatives_by_layers_against_differences() {
    let at = [1.0, 0.35, 0.8, 3.0];
    for i in 0..4 {
        let seeded = std::array::from_fn(|j| Dual64::new(at[j], f64::from(u8::from(i == j))));
        let found = answers(seeded);
        let step = 1e-4;
        let moved =
            |by: f64| answers(std::array::from_fn(|j| at[j] + if i == j { by } else { 0.0 }));
        let (fine, coarse) = ([moved(step), moved(-step)], [moved(2.0 * step), moved(-2.0 * step)]);
        for k in 0..7 {
            let slope = |pair: [[f64; 7]; 2], step: f64| (pair[0][k] - pair[1][k]) / (2.0 * step);
            let expected = (4.0 * slope(fine, step) - slope(coarse, 2.0 * step)) / 3.0;
            let off = (found[k].eps - expected).abs();
            assert!(off < 1e-9, "{i} {k}: {} {expected} {off:e}", found[k].eps);
        }
    }
}
