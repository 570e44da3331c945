//! Curves that turn back, and curves that stand still, far from the contact.
#![allow(missing_docs)]

use crate::common::{circle, limits_off};
use linecontact::profile::Ellipse;
use linecontact::{
    Contact, ContactError, Control, Curve, CurvePoint, Flat, InputError, Interval, ProfileError,
};
use std::f64::consts::{FRAC_PI_2, PI};

#[test]
fn a_closed_curve_turns_back_at_once() {
    for sign in [1.0, -1.0] {
        for end in [PI - 2.65e-6, 2.0, 3.0, 3.1, PI, 3.125] {
            let body = circle(-end, end, sign);
            let error = Contact::new(&Flat, &*body).map(|_| ()).unwrap_err();
            let ContactError::Input(InputError::Profile {
                source: ProfileError::TurnsBack { k, x, .. },
                ..
            }) = error
            else {
                panic!("{error}")
            };
            assert!((k.abs() - FRAC_PI_2).abs() < 1e-12 && (x.abs() - 1.0).abs() < 1e-12, "{k}");
        }
        // Up to X' = 0, or just beyond by rounding, the body is valid.
        for end in [FRAC_PI_2, 1.5] {
            let body = circle(-end, end, sign);
            let contact = Contact::new(&Flat, &*body).unwrap();
            let exact = Ellipse::circle(1.0, [-1.5, 1.5]).unwrap();
            let exact = Contact::new(&Flat, &exact).unwrap();
            let [found, exact] =
                [contact, exact].map(|contact| contact.solve(Control::Load(0.01)).unwrap().a());
            assert!((found / exact - 1.0).abs() < 1e-12, "{found} {exact}");
        }
    }
    // X = k³ stands still in its middle, X = ±sqrt at neither end.
    let cube = Curve::new([-1.0, 1.0], |k: f64| CurvePoint {
        x: k * k * k,
        y: k.powi(6),
        dx: 3.0 * k * k,
        dy: 6.0 * k.powi(5),
    });
    Contact::new(&Flat, &cube).unwrap();
}

/// Degrees taken for radians: the error names the turns nearest to the contact.
#[test]
fn the_first_turn_is_named() {
    for end in [80.0, 5.0, 45.0, 360.0] {
        let body = circle(-end, end, 1.0);
        let error = Contact::new(&Flat, &body)
            .and_then(|contact| contact.solve(Control::Load(0.01)).map(|_| ()))
            .unwrap_err();
        let ContactError::Input(InputError::Profile {
            source: ProfileError::TurnsBack { k, .. },
            ..
        }) = error
        else {
            panic!("{end}: {error}")
        };
        assert!((k.abs() - FRAC_PI_2).abs() < 1e-12, "{end}: {k}");
    }
}

/// A parabola by parameters at which X saturates long before their ends.
#[test]
fn where_x_has_saturated_is_no_matter() {
    type Way = (&'static str, f64, fn(f64) -> [f64; 2]);
    let ways: [Way; 9] = [
        ("tanh 10k", 1.0, |k| [(10.0 * k).tanh(), 10.0 / (10.0 * k).cosh().powi(2)]),
        ("tanh 20k", 1.0, |k| [(20.0 * k).tanh(), 20.0 / (20.0 * k).cosh().powi(2)]),
        ("tanh 20k, rounded", 1.0, |k| {
            [(20.0 * k).tanh(), 20.0 - 20.0 * (20.0 * k).tanh().powi(2)]
        }),
        ("tanh 400k", 1.0, |k| [(400.0 * k).tanh(), 400.0 / (400.0 * k).cosh().powi(2)]),
        ("tanh 400k, rounded", 1.0, |k| {
            [(400.0 * k).tanh(), 400.0 - 400.0 * (400.0 * k).tanh().powi(2)]
        }),
        ("logistic", 100.0, |k| {
            let e = (-k).exp();
            [1.0 / (1.0 + e) - 0.5, e / (1.0 + e).powi(2)]
        }),
        ("logistic about zero", 100.0, |k| {
            let e = (-k.abs()).exp();
            [k.signum() * (0.5 - e / (1.0 + e)), e / (1.0 + e).powi(2)]
        }),
        ("tanh 30k, rounded", 1.0, |k| {
            [(30.0 * k).tanh(), 30.0 * (1.0 - (30.0 * k).tanh().powi(2))]
        }),
        ("falling", 1.0, |k| [-(400.0 * k).tanh(), -400.0 / (400.0 * k).cosh().powi(2)]),
    ];
    let (mut faults, on) = (Vec::new(), Interval { left: -0.1, right: 0.1 });
    for (name, end, way) in ways {
        let body = Curve::new([-end, end], move |k: f64| {
            let [x, dx] = way(k);
            CurvePoint { x, y: x * x / 2.0, dx, dy: x * dx }
        });
        let contact = Contact::new(&Flat, &body).unwrap();
        for load in [Control::Load(0.005), Control::HalfWidth(0.1), Control::PeakPressure(0.1 / PI)]
        {
            match contact.solve(load) {
                Ok(solution) if limits_off(solution.hull(), on) < 1e-12 => {
                    if let Err(error) = solution.certify() {
                        faults.push(format!("{name} {load:?}: certify: {error}"));
                    }
                }
                other => faults.push(format!("{name} {load:?}: {other:?}")),
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
