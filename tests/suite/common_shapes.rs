//! A shape common to both bodies is not in the gap, however bent or wavy.
#![allow(missing_docs)]

use crate::common::{graph, limits_off};
use linecontact::{Contact, Control, Curve, CurvePoint};

#[test]
fn a_wave_that_both_bodies_have_is_in_no_gap() {
    // F = L²/2, however fast the wave: the last is shorter than a difference.
    for (height, count, bend, l) in
        [(1e-3, 500.0, 0.0, 0.4), (1e-2, 3000.0, 0.0, 0.4), (1e-5, 3e5, 1.0, 0.1)]
    {
        let wavy = move |bend: f64| {
            graph(-1.0, 1.0, move |x| {
                let (sin, cos) = (count * x).sin_cos();
                [bend * x * x / 2.0 + height * cos, bend * x - height * count * sin]
            })
        };
        let bodies = [wavy(bend), wavy(bend + 1.0)];
        let contact = Contact::new(&*bodies[0], &*bodies[1]).unwrap();
        let solution = contact.solve(Control::Load(l * l / 2.0)).unwrap();
        assert!((solution.a() / l - 1.0).abs() < 1e-9, "{count}: {solution:?}");
    }
}

/// A shape common to both bodies is not in the gap, but must still be resolved if the bodies have
/// different parameters.
#[test]
fn a_shape_common_to_both_bodies() {
    let solve = |common: f64| {
        let wave = move |x: f64| [-common / 1.094 * (1.094 * x).cos(), common * (1.094 * x).sin()];
        let upper = Curve::new([-2.296, 2.27], move |k: f64| {
            let (x, dx) = (k.sinh(), k.cosh());
            let rise = 5.05 * (-0.1398 * x).exp() + 2.564 * (x + 0.6673).powi(2) + 0.694 * x;
            let slope = -0.706 * (-0.1398 * x).exp() + 5.128 * (x + 0.6673) + 0.694;
            CurvePoint { x, y: rise + wave(x)[0], dx, dy: (slope + wave(x)[1]) * dx }
        });
        let lower = Curve::new([-4.9, 4.7], move |x: f64| {
            let (rise, slope) = (-0.256 * (x + 0.4004).powi(2), -0.512 * (x + 0.4004));
            CurvePoint { x, y: rise + wave(x)[0], dx: 1.0, dy: slope + wave(x)[1] }
        });
        let contact = Contact::new(&lower, &upper).unwrap();
        let solution = contact.solve(Control::Load(0.4519)).unwrap();
        (solution.hull(), solution.limits_error().unwrap())
    };
    let (plain, _) = solve(0.0);
    for common in [0.152, 1.0, 30.0] {
        let (got, error) = solve(common);
        let off = limits_off(got, plain);
        assert!(off <= error, "{common}: off {off:e}, said {error:e}");
    }
}
