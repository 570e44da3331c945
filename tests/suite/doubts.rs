//! What is doubtful must look doubtful: sloppy searches, wrong derivatives, coarse rules, breakpoints.
#![allow(missing_docs)]

use crate::common;

use common::{graph, join, parabola, power};
use linecontact::search::{
    Bracket, Brent, LimitSearch, Newton, Root, SearchError, StoppingCriteria,
};
use linecontact::{
    Body, Contact, ContactError, Control, Cost, Curve, CurvePoint, EdgePressure, Exponents, Flat,
    Interval, Midpoint, ParametricProfile, Piece, Piecewise, PiecewiseError, ProfileError,
};
use std::f64::consts::PI;

#[test]
fn a_sloppy_search_for_the_limits_shows() {
    let body = graph(-1.0, 1.0, |x| [x * x / 2.0 + x.powi(3) / 5.0, x + 0.6 * x * x]);
    let contact = Contact::new(&Flat, &*body).unwrap();
    let exact = contact.solve(Control::Load(0.03)).unwrap().a();
    for relative in [0.1, 1e-2, 1e-4, 1e-8] {
        let sloppy = Brent { tolerance: StoppingCriteria::relative(relative) };
        let contact = contact.clone().limit_search(&sloppy);
        let solution = contact.solve(Control::Load(0.03)).unwrap();
        let error = (solution.a() - exact).abs() / solution.hull().half_width();
        assert!(error <= 2.0 * solution.limits_error().unwrap(), "{relative}: {error:e}");
    }
}

/// A user's strategy that does not do its work.
struct Guess(fn(&Bracket<f64>) -> f64);

impl LimitSearch<f64> for Guess {
    fn find(
        &self,
        f: &mut dyn FnMut(f64) -> f64,
        bracket: &Bracket<f64>,
    ) -> Result<Root<f64>, SearchError<f64>> {
        let x = self.0(bracket);
        Ok(Root { x, residual: f(x), bracket: [bracket.lo, bracket.hi], evaluations: 1 })
    }
}

#[test]
fn a_sloppy_inversion_shows() {
    let body = Curve::new([-1.0, 1.0], |k: f64| {
        let (x, dx) = (k + 0.2 * k * k * k, 1.0 + 0.6 * k * k);
        CurvePoint { x, y: x * x / 2.0, dx, dy: x * dx }
    });
    let rule = Midpoint::default();
    let contact = Contact::new(&Flat, &body).unwrap().quadrature(&rule);
    let chord = Guess(|b| {
        let [f_lo, f_hi] = b.values.unwrap();
        b.lo - f_lo * (b.hi - b.lo) / (f_hi - f_lo)
    });
    let sloppy = contact.clone().inversion(&chord);
    let solution = sloppy.solve(Control::Load(0.02)).unwrap();
    let error = (solution.a() / 0.2 - 1.0).abs();
    assert!(error > 0.05 && error <= 2.0 * solution.limits_error().unwrap(), "{error}");

    for astray in [Guess(|b| 5.0 * b.hi), Guess(|_| f64::NAN)] {
        let contact = contact.clone().inversion(&astray);
        let error = contact.solve(Control::Load(0.02)).unwrap_err();
        assert!(
            matches!(
                error,
                ContactError::Inversion { source: SearchError::LeftBracket { .. }, .. }
            ),
            "{error}"
        );
    }
}

#[test]
fn units_do_not_decide() {
    // A flat bottom with parabolic shoulders carries nothing until it reaches them.
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

#[test]
fn lopsided_domains() {
    for (left, right) in [(-1.0, 3e3), (-1.0, 1e4), (-1e5, 1.0), (-0.2001, 1e9)] {
        let body = graph(left, right, |x| [x * x / 2.0, x]);
        let contact = Contact::new(&Flat, &*body).unwrap();
        let solution = contact.solve(Control::Load(0.02)).unwrap();
        assert!((solution.a() / 0.2 - 1.0).abs() < 1e-14, "[{left}, {right}]: {solution:?}");
        // A start that is not on the bodies is no start.
        let off = contact.clone().start(Interval { left: 2e9, right: 3e9 });
        assert!((off.solve(Control::Load(0.02)).unwrap().a() / 0.2 - 1.0).abs() < 1e-14);
    }
}

#[test]
fn a_steep_body_by_every_chord() {
    // |x|^100/100: the load rises with the hundredth power of the width.
    let body = power(100.0);
    let contact = Contact::new(&Flat, &*body).unwrap();
    let wanted = contact.solve(Control::Load(1e-17)).unwrap().a();
    let newton = Newton::default();
    let started = contact.start(Interval { left: -0.3, right: 0.3 }).limit_search(&newton);
    let solution = started.solve(Control::Load(1e-17)).unwrap();
    assert!((solution.a() / wanted - 1.0).abs() < 1e-14, "{solution:?} for {wanted}");
}

#[test]
fn starts_inside_a_wave() {
    // y = x²/2 + cos(24 x)/256 is level in many places; the contact covers them all.
    let body = graph(-3.0, 3.0, |x| {
        let (s, c) = (24.0 * x).sin_cos();
        [x * x / 2.0 + c / 256.0, x - 3.0 * s / 32.0]
    });
    let contact = Contact::new(&Flat, &*body).unwrap();
    for half_width in [0.01, 0.03, 0.05, 0.3, 2.0] {
        let start = Interval { left: -half_width, right: half_width };
        let solution = contact.clone().start(start);
        let solution = solution.solve(Control::Load(2.0 / PI)).unwrap();
        assert!((solution.a() / 1.142738838438643 - 1.0).abs() < 1e-13, "{solution:?}");
    }
}

#[test]
fn pressure_next_to_a_jump_of_the_slope() {
    // The wedge m|x|: P = (2 m/π²) arcosh(L/|x|), infinite at the breakpoint.
    let m = 0.25;
    let wedge =
        join(vec![graph(-1.0, 0.0, move |x| [-m * x, -m]), graph(0.0, 1.0, move |x| [m * x, m])]);
    let rule = Midpoint::default();
    let contact = Contact::new(&Flat, &*wedge).unwrap().quadrature(&rule);
    let solution = contact.solve(Control::Load(2.0 * m * 0.2 / PI)).unwrap();
    let pressure = solution.pressure().unwrap();
    for x in [1e-12, 1e-9, 1e-6, 1e-5, 1e-4, 1e-3, 3e-3, 0.01, 0.05, 0.15] {
        let exact = 2.0 * m / (PI * PI) * (0.2f64 / x).acosh();
        for x in [x, -x] {
            let estimate = pressure.estimate(x, &mut Cost::default()).unwrap();
            let error = (estimate.value - exact).abs();
            assert!(error <= estimate.error, "{x:e}: {error:e} {estimate:?}");
            if let Ok(value) = pressure.at(x) {
                assert!((value / exact - 1.0).abs() < 0.5, "{x:e}: {value} for {exact}");
            }
        }
    }
    assert!(matches!(pressure.at(0.0), Err(ContactError::Unresolved { .. })));
}

#[test]
fn rules_too_coarse_to_know() {
    let body = parabola(1.0);
    for (segments, extrapolations) in [(1, 0), (1, 1), (2, 0), (2, 1), (3, 0), (3, 2)] {
        let rule = Midpoint { segments, extrapolations, exponents: Exponents::Even };
        let contact = Contact::new(&Flat, &*body).unwrap().quadrature(&rule);
        let solution = contact.solve(Control::Load(0.02)).unwrap();
        let pressure = solution.pressure().unwrap();
        for z in [-0.9, -0.4, 0.0, 0.01, 0.6, 0.99] {
            let exact = 0.2 * (1.0f64 - z * z).sqrt() / PI;
            let estimate = pressure.estimate(0.2 * z, &mut Cost::default()).unwrap();
            assert!((estimate.value - exact).abs() <= estimate.error + 1e-15, "{rule:?} {z}");
        }
    }
    // So are the limits that such a rule finds by Eq. (6).
    let rule = Midpoint::paper(1, 0);
    let edges = EdgePressure::zero(0.01, 1e-6);
    let contact = Contact::new(&Flat, &*body).unwrap().edge_pressure(edges).quadrature(&rule);
    if let Ok(solution) = contact.solve(Control::Load(0.02)) {
        assert!(solution.limits_error().unwrap() > 0.1, "{solution:?}");
    }
}

#[test]
fn derivatives_that_are_wrong() {
    let with = |fx: f64, fy: f64| {
        Curve::new([-1.0, 1.0], move |k: f64| {
            let (x, dx) = (k + 0.2 * k * k * k, 1.0 + 0.6 * k * k);
            CurvePoint { x, y: x * x / 2.0, dx: fx * dx, dy: fy * x * dx }
        })
    };
    let solve = |body: &dyn ParametricProfile<f64>| {
        Contact::new(&Flat, body).and_then(|contact| contact.solve(Control::Load(0.02)).map(|_| ()))
    };
    assert!(Piece::checked(&with(1.0, 1.0)).is_ok());
    assert_eq!(solve(&with(1.0, 1.0)), Ok(()));
    for (fx, fy, name) in [(2.0, 1.0, "X'"), (0.5, 1.0, "X'"), (10.0, 1.0, "X'"), (1.0, -1.0, "Y'")]
    {
        let body = with(fx, fy);
        let error = Piece::checked(&body).map(|_| ()).unwrap_err();
        let ProfileError::Derivative { quantity, .. } = error else { panic!("{error}") };
        assert_eq!(quantity, name);
        // Without that check the solver finds that slopes and heights do not go together.
        let error = solve(&body).unwrap_err();
        let ContactError::Profile { source: ProfileError::Derivative { quantity, .. }, .. } = error
        else {
            panic!("{error}")
        };
        assert_eq!(quantity, "the slope Y'/X'");
    }
}

#[test]
fn slopes_that_are_a_third_off() {
    // The slope of a parabola is x, whatever its parameter; heights may be counted from far away.
    let with = |factor: f64, sign: f64, falls: f64, height: f64| {
        Curve::new([-1.0, 1.0], move |k: f64| {
            let (x, dx) = (falls * (k + 0.2 * k * k * k), falls * (1.0 + 0.6 * k * k));
            let y = height + sign * x * x / 2.0;
            CurvePoint { x, y, dx, dy: factor * sign * x * dx }
        })
    };
    for (falls, height) in [(1.0, 0.0), (-1.0, 0.0), (1.0, 1e3)] {
        for (factor, seen) in [(0.6, false), (1.8, false), (0.45, true), (2.1, true), (9.0, true)] {
            let bodies = [with(factor, -1.0, falls, height), with(factor, 1.0, falls, height)];
            let (left, right) = (Contact::new(&bodies[0], &Flat), Contact::new(&Flat, &bodies[1]));
            for (body, contact) in [(Body::Lower, left), (Body::Upper, right)] {
                let error = contact.unwrap().solve(Control::Load(0.02)).map(|_| ()).unwrap_err();
                // What is less is seen in the rise of all of a panel.
                let by_rise = matches!(error, ContactError::InconsistentHeights { .. });
                assert_eq!(by_rise, !seen, "{factor}: {error:?}");
                if by_rise {
                    continue;
                }
                let ContactError::Profile { body: at_fault, source } = error else { panic!() };
                let ProfileError::Derivative { k, given, difference, .. } = source else {
                    panic!()
                };
                assert_eq!(at_fault, body);
                let sign = if body == Body::Lower { -1.0 } else { 1.0 };
                let slope = sign * falls * (k + 0.2 * k * k * k);
                assert!((given / slope - factor).abs() < 1e-12, "{given} {slope}");
                assert!((difference / slope - 1.0).abs() < 1e-4, "{difference} {slope}");
            }
        }
    }
}

#[test]
fn tolerances_of_breakpoints() {
    let far = || -> Vec<Box<dyn ParametricProfile<f64>>> {
        vec![graph(-1.0, -0.5, |x| [x, 1.0]), graph(0.5, 1.0, |x| [x + 7.0, 1.0])]
    };
    for tolerance in [f64::NAN, f64::INFINITY, -1.0] {
        let error = Piecewise::with_tolerance(far(), tolerance).map(|_| ()).unwrap_err();
        assert!(matches!(error, PiecewiseError::Tolerance { .. }), "{error}");
    }
}

#[test]
fn a_wave_that_both_bodies_have_is_in_no_gap() {
    // F = L²/2, however fast the wave.
    for (height, count) in [(1e-3, 500.0), (1e-2, 3000.0)] {
        let wave = move |x: f64| {
            let (sin, cos) = (count * x).sin_cos();
            [height * cos, -height * count * sin]
        };
        let lower = graph(-1.0, 1.0, wave);
        let upper = graph(-1.0, 1.0, move |x| {
            let [y, slope] = wave(x);
            [y + x * x / 2.0, slope + x]
        });
        let contact = Contact::new(&*lower, &*upper).unwrap();
        let solution = contact.solve(Control::Load(0.08)).unwrap();
        assert!((solution.a() / 0.4 - 1.0).abs() < 1e-9, "{count}: {solution:?}");
    }
}
