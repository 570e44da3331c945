//! Derivatives of the approach, and with respect to it, by dual numbers.

use linecontact::autodiff::num_dual::Dual64;
use linecontact::profile::Parabola;
use linecontact::{Contact, Control, Flat, Material, PlaneState, Real, Reference, References};

fn references<T: Real>(depth: T) -> References<T> {
    let lower = Reference::Depth(depth);
    References { x: T::of(0.03), lower, upper: Reference::Disc(T::of(2.0)) }
}

fn materials<T: Real>(contact: Contact<'_, T>) -> Contact<'_, T> {
    let [steel, soft] = [[2.1, 0.3], [0.7, 0.45]]
        .map(|[modulus, ratio]| Material::elastic(T::of(modulus), T::of(ratio)));
    contact.materials(steel, soft, PlaneState::Strain)
}

/// Returns δ as a function of the radius, the load and the depth.
fn approach<T: Real>([radius, load, depth]: [T; 3]) -> T {
    let body = Parabola::new(radius, [-T::one(), T::one()]).unwrap();
    let contact = materials(Contact::new(&Flat, &body).unwrap());
    contact.solve(Control::Load(load)).unwrap().approach(&references(depth)).unwrap().bodies
}

/// Returns F as a function of the radius, the approach and the depth.
fn load<T: Real>([radius, approach, depth]: [T; 3]) -> T {
    let body = Parabola::new(radius, [-T::one(), T::one()]).unwrap();
    let contact = materials(Contact::new(&Flat, &body).unwrap());
    let control = Control::Approach { approach, references: references(depth) };
    contact.solve(control).unwrap().load()
}

fn gradient(of: impl Fn([Dual64; 3]) -> Dual64, at: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| {
        of(std::array::from_fn(|k| Dual64::new(at[k], if i == k { 1.0 } else { 0.0 }))).eps
    })
}

#[test]
fn the_approach_has_the_derivatives_of_its_differences() {
    let at = [1.5, 0.02, 0.7];
    let exact = gradient(approach, at);
    for (i, exact) in exact.into_iter().enumerate() {
        let moved = |share: f64| {
            let mut at = at;
            at[i] *= 1.0 + share;
            approach(at)
        };
        let h = 1e-3;
        let difference = (8.0 * (moved(h) - moved(-h)) - (moved(2.0 * h) - moved(-2.0 * h)))
            / (12.0 * h * at[i]);
        assert!((difference / exact - 1.0).abs() < 1e-9, "{i}: {difference} {exact}");
    }
}

#[test]
fn the_load_of_an_approach_has_the_derivatives_of_the_inverse() {
    let at = [1.5, 0.02, 0.7];
    let [by_radius, by_load, by_depth] = gradient(approach, at);
    let there = [at[0], approach(at), at[2]];
    let found = gradient(load, there);
    assert!((load(there) / at[1] - 1.0).abs() < 1e-13);
    let exact = [-by_radius / by_load, 1.0 / by_load, -by_depth / by_load];
    for (found, exact) in found.into_iter().zip(exact) {
        assert!((found / exact - 1.0).abs() < 1e-11, "{found} {exact}");
    }
}
