//! The closed forms of `linecontact::reference`, against the equations they solve, by a quadrature
//! that shares nothing with the solver, and against solutions of 25 digits.
#![allow(missing_docs)]

use crate::common;
use crate::common::NanSafe;
use crate::forms;
use crate::integrals::{integral, principal, strength};

use approx::assert_relative_eq;
use common::reference;
use forms::{Form, KAPPA, Unrolled, forms};
use linecontact::Edge;
use linecontact::reference::{
    Biquadratic, ClosedForm, Cosine, Crowning, Ellipse, Exponential, FlatPunch, Hertz, Hyperbola,
    Jkr, PowerLaw, ReferenceError, RoundedPunch, UnequalRadii, Wedge, Westergaard,
};
use std::f64::consts::PI;

/// Returns the largest residuals of `PV∫ P(s)/(x - s) ds = κ g(x)`, relative to the larger side,
/// and of `∫ P ds = F`.
fn residuals(form: &dyn ClosedForm<f64>) -> [f64; 2] {
    // x = 0 lies above the poles of a hyperbola: a panel ends there, breakpoint or not.
    let (limits, mut breakpoints) = (form.limits(), form.breakpoints());
    if limits.contains(0.0) && !breakpoints.contains(&0.0) {
        breakpoints.push(0.0);
    }
    let pressure = |s: f64| form.pressure(s, KAPPA);
    let strength = strength(limits, pressure);
    let load = integral(limits, &breakpoints, &strength);
    let size = integral(limits, &breakpoints, |s| strength(s).abs());
    let mut worst = 0.0f64;
    let steepest = form.slope_left(limits.right).abs().max(form.slope(limits.left).abs());
    for i in 1..24 {
        let x = limits.at_angle(PI * (f64::from(i) + 0.2) / 24.6);
        let left = principal(limits, &breakpoints, x, pressure);
        let scale = (KAPPA * steepest).max(size / limits.half_width());
        worst = worst.nan_max((left - KAPPA * form.slope(x)).abs() / scale);
    }
    [worst, (load - form.load(KAPPA)).abs() / size]
}

#[test]
fn they_solve_the_equations() {
    for Form { name, form, .. } in forms::<f64>() {
        let [equation, load] = residuals(&*form);
        println!("{name:24} equation {equation:8.1e}  load {load:8.1e}");
        assert!(equation < 1e-12, "{name}: {equation}");
        assert!(load < 1e-12, "{name}: {load}");
    }
}

#[test]
fn in_single_precision_too() {
    for (single, double) in forms::<f32>().into_iter().zip(forms::<f64>()) {
        let (name, single, double) = (double.name, single.form, double.form);
        let close = |got: f32, want: f64, most: f64| {
            let error = (f64::from(got) / want - 1.0).abs();
            assert!(error < most, "{name}: {got} is not {want}");
        };
        let [got, want] = [single.load(KAPPA as f32), double.load(KAPPA) as f32];
        assert!((got - want).abs() < 1e-5 * (1.0 + want), "{name}: {got} is not {want}");
        let limits = double.limits();
        close(single.limits().right, limits.right, 1e-5);
        close(single.limits().left, limits.left, 1e-5);
        for i in 1..20 {
            let x = limits.at_angle(PI * (f64::from(i) + 0.3) / 20.6) as f32;
            if name.starts_with("JKR") && x.abs() > 0.3 {
                continue;
            }
            let slack = 1e-6 / (1.0 - (x / limits.right as f32).abs()).abs();
            let got = single.pressure(x, KAPPA as f32);
            close(got, double.pressure(f64::from(x), KAPPA), 3e-5 + f64::from(slack));
        }
    }
}

#[test]
fn they_agree_with_solutions_of_25_digits() {
    let half = |name| reference(name).half_width();
    let power = |n: f64, name| Box::new(PowerLaw::new(1.0 / n, n, half(name)).unwrap());
    let hertz = |name| Box::new(Hertz::new(1.0, half(name)).unwrap());
    let load = |name| reference(name).c / PI;
    let forms: [(&str, Box<dyn ClosedForm<f64>>); 12] = [
        ("power_n_1", power(1.0, "power_n_1")),
        ("power_n_3_over_2", power(1.5, "power_n_3_over_2")),
        ("power_n_3", power(3.0, "power_n_3")),
        ("power_n_6", power(6.0, "power_n_6")),
        ("power_n_20", power(20.0, "power_n_20")),
        ("hertz_tiny", hertz("hertz_tiny")),
        ("hertz_huge", hertz("hertz_huge")),
        (
            "tilted_wedge",
            Box::new(Wedge::under_load(0.25, 1.75, load("tilted_wedge"), 1.0).unwrap()),
        ),
        ("power_n_1", Box::new(Wedge::new(1.0, half("power_n_1")).unwrap())),
        (
            "asym_parabola_1e6",
            Box::new(UnequalRadii::under_load(1.0, 1e-6, load("asym_parabola_1e6"), 1.0).unwrap()),
        ),
        (
            "rounded_punch_1e-6",
            Box::new(RoundedPunch::under_load(1.0, 1.0, load("rounded_punch_1e-6"), 1.0).unwrap()),
        ),
        (
            "circle_on_flat_nearly_full",
            Box::new(Ellipse::circle(1.0, half("circle_on_flat_nearly_full")).unwrap()),
        ),
    ];
    for (name, form) in forms {
        let want = reference(name);
        let limits = form.limits();
        let (a, b) = (limits.right / want.a - 1.0, -limits.left / want.b - 1.0);
        let load = form.load(1.0) / (want.c / PI) - 1.0;
        // In units of the effect of rounding x and the limits on the pressure.
        let [mut worst, mut steep] = [0.0f64; 2];
        for (&[x, exact], amplification) in want.points.iter().zip(&want.amplification) {
            if !limits.contains(x) || !exact.is_finite() {
                continue;
            }
            let got = form.pressure(x, 1.0);
            worst = worst.nan_max((got / exact - 1.0).abs() / (1.0 + amplification));
            steep = steep.max(*amplification);
        }
        println!("{name:28} a {a:8.1e} b {b:8.1e} load {load:8.1e} P {worst:8.1e} of {steep:8.1e}");
        // An ulp of a half-width close to the radius is an ulp of their difference 1e-7, too.
        let stiff = if name.starts_with("circle") { 1e5 } else { 10.0 };
        assert!(a.abs() < 1e-15 && b.abs() < 1e-15, "{name}: {a} {b}");
        assert!(load.abs() < 1e-15 * stiff, "{name}: {load}");
        assert!(worst < 1e-15 * stiff, "{name}: {worst}");
    }
}

/// Constructor of a form from its half-width.
type ByHalfWidth = fn(f64) -> Box<dyn ClosedForm<f64>>;

#[test]
fn a_pressure_rises_from_the_edge_as_the_load_does_with_the_contact() {
    // P → F'(L)/(π L) w at either edge of a symmetric contact.
    let cases: [(&str, f64, ByHalfWidth); 10] = [
        ("Hertz", 0.6, |l| Box::new(Hertz::new(1.3, l).unwrap())),
        ("wedge", 0.6, |l| Box::new(Wedge::new(0.3, l).unwrap())),
        ("power", 0.6, |l| Box::new(PowerLaw::new(0.7, 2.7, l).unwrap())),
        ("biquadratic", 0.6, |l| Box::new(Biquadratic::new(0.7, 0.9, l).unwrap())),
        ("rounded punch", 1.01, |l| Box::new(RoundedPunch::new(1.0, 0.3, l).unwrap())),
        ("circle", 0.97, |l| Box::new(Ellipse::circle(1.0, l).unwrap())),
        ("hyperbola", 0.6, |l| Box::new(Hyperbola::new(0.4, 0.1, l).unwrap())),
        ("crowning", 0.9, |l| Box::new(Crowning::new(0.3, 1.0, l).unwrap())),
        ("cosine", 0.6, |l| Box::new(Cosine::new(0.3, 2.0, l).unwrap())),
        ("radii", 0.6, |l| Box::new(UnequalRadii::new(2.0, 2.0, l).unwrap())),
    ];
    for (name, l, form) in cases {
        let step = 1e-4 * (l - if name == "rounded punch" { 1.0 } else { 0.0 });
        let load = |steps: f64| form(l + steps * step).load(1.0);
        let near = load(1.0) - load(-1.0);
        let stiffness = (8.0 * near - (load(2.0) - load(-2.0))) / (12.0 * step);
        for x in [l * (1.0 - 1e-12), l * (1e-12 - 1.0)] {
            let form = form(l);
            let want = stiffness / (PI * l) * form.limits().chebyshev_weight(x);
            assert_relative_eq!(form.pressure(x, 1.0), want, epsilon = 0.0, max_relative = 1e-9);
        }
    }
}

#[test]
fn the_exponential_keeps_its_digits_at_the_flat_edge() {
    // There ∫ e^s I₀(s) ds = z e^z (I₀ - I₁), so that P → κ/π 2 sqrt(d/(2L)) z (1 - I₁/I₀).
    let (z, kappa, distance) = (9.0f64, 1.0, 0.5f64.powi(32));
    let form = Exponential::new(1.0, 1.0, z).unwrap();
    let x = form.limits().left + distance;
    let ratio = form.load(kappa) / (kappa * z);
    let want = kappa / PI * (2.0 * distance / z).sqrt() * z * (1.0 - ratio);
    assert_relative_eq!(form.pressure(x, kappa), want, epsilon = 0.0, max_relative = 1e-8);
}

#[test]
fn a_load_gives_the_limits_back() {
    let kappa = KAPPA;
    for load in [1e-12, 1e-3, 0.2, 5.0, 1e7] {
        let forms: [Box<dyn ClosedForm<f64>>; 9] = [
            Box::new(Hertz::under_load(0.3, load, kappa).unwrap()),
            Box::new(Wedge::under_load(0.3, 0.01, load, kappa).unwrap()),
            Box::new(PowerLaw::under_load(0.3, 2.3, load, kappa).unwrap()),
            Box::new(Biquadratic::under_load(0.3, 2.0, load, kappa).unwrap()),
            Box::new(UnequalRadii::under_load(0.3, 1e-9, load, kappa).unwrap()),
            Box::new(RoundedPunch::under_load(0.3, 2.0, load, kappa).unwrap()),
            Box::new(Jkr::under_load(0.3, 2.0, load, kappa).unwrap()),
            Box::new(FlatPunch::under_load(0.3, 0.0, load, kappa).unwrap()),
            Box::new(FlatPunch::under_load(0.3, -0.8, load, kappa).unwrap()),
        ];
        for (i, form) in forms.iter().enumerate() {
            let error = (form.load(kappa) - load).abs();
            // The adhesive load is a difference.
            let of = if i == 6 { load + 1.0 } else { load };
            assert!(error < 8e-15 * of, "{i}: {load} {}", form.load(kappa));
        }
    }
    // Only loads that do not flatten the crowning.
    for load in [1e-12, 1e-3, 0.2, 5.0] {
        let form = Crowning::under_load(10.0, 0.3, load, kappa).unwrap();
        assert_relative_eq!(form.load(kappa), load, epsilon = 0.0, max_relative = 4e-15);
    }
    // Down to pull-off, where L⁹ᐟ² goes as the root of the remaining load.
    let work = 0.02;
    let narrowest = (work / kappa).cbrt();
    let least = -1.5 * kappa * narrowest * narrowest;
    for part in [0.0, 0.5, 0.999, 0.999_999_999] {
        let form = Jkr::under_load(1.0, work, part * least, kappa).unwrap();
        assert!(form.limits().right >= narrowest);
        assert!((form.load(kappa) - part * least).abs() < 4e-15 * least.abs());
    }
}

#[test]
fn a_row_of_contacts_is_what_it_is_unrolled() {
    for half_width in [1e-3, 0.1, 0.25, 0.4, 0.49] {
        let form = Unrolled::<f64>::new(0.3, 1.0, half_width);
        let (row, limits) = (form.row, form.row.limits());
        for i in 1..20 {
            let x = limits.at_angle(PI * f64::from(i) / 20.0);
            let want = form.pressure((PI * x).tan(), KAPPA);
            let tolerance = if x.abs() < 0.99 * half_width { 1e-14 } else { 1e-12 };
            let got = row.pressure(x, KAPPA);
            assert_relative_eq!(got, want, epsilon = 0.0, max_relative = tolerance);
        }
        let strength = |x: f64| row.pressure(x, KAPPA) * limits.chebyshev_weight(x);
        let load = integral(limits, &[0.0], strength);
        assert_relative_eq!(row.load(KAPPA), load, epsilon = 0.0, max_relative = 1e-14);
        let again = Westergaard::under_load(0.3, 1.0, load, KAPPA).unwrap();
        assert_relative_eq!(again.limits().right, half_width, epsilon = 0.0, max_relative = 1e-12);
        assert_eq!(row.pressure(limits.right.next_up(), KAPPA), 0.0);
    }
    refused(Westergaard::new(0.3, 1.0, 0.5), "half-width");
    refused(Westergaard::under_load(0.3, 1.0, 0.6 * KAPPA, KAPPA), "load");
}

#[test]
fn the_gap_outside_hertz_opens_as_it_should() {
    let (radius, l) = (1.3, 0.7);
    let form = Hertz::new(radius, l).unwrap();
    for x in [0.0, 0.5, -0.7, 0.7] {
        assert_eq!(form.gap(x), 0.0);
    }
    for x in [0.9f64, -2.0, 30.0, 1e6, 1e12] {
        let (root, u) = ((x * x - l * l).sqrt(), (x.abs() / l).acosh());
        let want = (x.abs() * root - l * l * u) / (2.0 * radius);
        assert_relative_eq!(form.gap(x), want, epsilon = 0.0, max_relative = 1e-14);
    }
    // (2 d/3) sqrt(2 L d)/R at a small distance d.
    let d = 0.5f64.powi(33);
    let want = 2.0 * d / 3.0 * (2.0 * d).sqrt();
    let unit = Hertz::new(1.0, 1.0).unwrap();
    assert_relative_eq!(unit.gap(-1.0 - d), want, epsilon = 0.0, max_relative = 1e-9);
    assert!(unit.gap(1e200).is_infinite() && unit.gap(1e150).is_finite());
}

#[test]
fn outside_and_at_the_edges() {
    for Form { name, form, .. } in forms::<f64>() {
        let limits = form.limits();
        let far = 2.0 * limits.half_width();
        for x in [limits.left - far, limits.left.next_down(), limits.right.next_up(), far * 9.0] {
            assert_eq!(form.pressure(x, KAPPA), 0.0, "{name} at {x}");
        }
        for (x, edge) in [limits.left, limits.right].into_iter().zip(form.edges()) {
            let want = match edge {
                Edge::Adhesive(_) => f64::NEG_INFINITY,
                Edge::Fixed(_) => f64::INFINITY,
                _ => 0.0,
            };
            assert_eq!(form.pressure(x, KAPPA), want, "{name} at {x}");
        }
        for breakpoint in form.breakpoints() {
            assert!(form.pressure(breakpoint, KAPPA) > 0.0, "{name}");
        }
        assert!(form.pressure(f64::NAN, KAPPA).is_nan(), "{name}");
    }
}

/// Asserts that a parameter was refused.
fn refused<F>(form: Result<F, ReferenceError<f64>>, name: &str) {
    match form {
        Err(ReferenceError::Parameter { name: which, .. }) => assert!(which.contains(name)),
        Err(error) => panic!("{error}"),
        Ok(_) => panic!("a wrong {name} was taken"),
    }
}

#[test]
fn parameters_that_make_no_sense_are_refused() {
    for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        refused(Hertz::new(wrong, 1.0), "radius");
        refused(Hertz::new(1.0, wrong), "half-width");
        refused(Hertz::under_load(1.0, wrong, 1.0), "load");
        refused(Wedge::unequal(wrong, 1.0, 1.0), "left");
        refused(Wedge::unequal(1.0, wrong, 1.0), "right");
        refused(PowerLaw::new(wrong, 2.0, 1.0), "coefficient");
        refused(UnequalRadii::under_load(wrong, 1.0, 1.0, 1.0), "left");
        refused(UnequalRadii::under_load(1.0, wrong, 1.0, 1.0), "right");
        refused(RoundedPunch::new(wrong, 1.0, 2.0), "flat");
        refused(FlatPunch::under_load(1.0, 0.1, wrong, 1.0), "load");
        refused(Ellipse::new(1.0, wrong, 0.5), "across");
        refused(Hyperbola::new(1.0, wrong, 0.5), "tip");
        refused(Crowning::new(wrong, 1.0, 0.5), "depth");
        refused(Crowning::under_load(1.0, wrong, 0.5, 1.0), "half-length");
        refused(Exponential::new(wrong, 1.0, 0.5), "length");
        refused(Cosine::new(1.0, wrong, 0.5), "wavelength");
        refused(Jkr::under_load(1.0, wrong, 0.5, 1.0), "work");
        refused(Jkr::new(1.0, wrong, 0.5), "work");
    }
    for wrong in [0.99, f64::NAN, 1001.0] {
        refused(PowerLaw::new(1.0, wrong, 1.0), "exponent");
    }
    refused(RoundedPunch::new(1.0, 1.0, 1.0), "half-width");
    refused(RoundedPunch::under_load(1.0, 1.0, 1e-60, 1.0), "load");
    refused(Biquadratic::new(1.0, -1.0, 0.5), "half-width");
    refused(Biquadratic::under_load(1.0, -1.0, 0.05, 1.0), "load");
    refused(Ellipse::circle(1.0, 1.0), "half-width");
    refused(Crowning::new(1.0, 1.0, 1.0), "half-width");
    refused(Crowning::under_load(1.0, 1.0, 1e20, 1.0), "load");
    refused(Exponential::new(1.0, 1.0, 360.0), "half-width");
    refused(Cosine::new(1.0, 1.0, 0.383), "half-width");
    refused(FlatPunch::under_load(1.0, f64::NAN, 1.0, 1.0), "slope");
    let error = Jkr::under_load(1.0, 1.0, -1.6, 1.0).unwrap_err();
    assert_eq!(error, ReferenceError::PullOff { load: -1.6, least: -1.5 });
}

/// The same bodies in other units: all quantities scale, even if a power of a length overflows or
/// underflows.
#[test]
fn other_units() {
    let forms = |u: f64| -> Vec<Box<dyn ClosedForm<f64>>> {
        let f = 0.2 * u;
        vec![
            Box::new(Hertz::under_load(1.3 * u, f, KAPPA).unwrap()),
            Box::new(Jkr::under_load(1.3 * u, 0.3 * u, f, KAPPA).unwrap()),
            Box::new(Jkr::under_load(1.3 * u, 0.3 * u, -f, KAPPA).unwrap()),
            Box::new(PowerLaw::under_load(0.4 / u / u, 3.0, f, KAPPA).unwrap()),
            Box::new(PowerLaw::under_load(0.4 / u.sqrt(), 1.5, f, KAPPA).unwrap()),
            Box::new(Biquadratic::under_load(1.3 * u, 0.0, f, KAPPA).unwrap()),
            Box::new(Biquadratic::new(1.3 * u, 0.0, 0.7 * u).unwrap()),
            Box::new(UnequalRadii::under_load(0.3 * u, 5.0 * u, f, KAPPA).unwrap()),
            Box::new(RoundedPunch::under_load(0.3 * u, 5.0 * u, f, KAPPA).unwrap()),
            Box::new(FlatPunch::under_load(0.3 * u, 0.1, f, KAPPA).unwrap()),
            Box::new(Wedge::under_load(0.3, 0.7, f, KAPPA).unwrap()),
            Box::new(Ellipse::circle(u, 0.99 * u).unwrap()),
            Box::new(Hyperbola::new(0.3, 0.2 * u, u).unwrap()),
            Box::new(Exponential::new(0.3 * u, 0.2 * u, u).unwrap()),
            Box::new(Cosine::new(0.3 * u, 5.0 * u, u).unwrap()),
        ]
    };
    for power in [-510, -400, 400, 508] {
        let unit = 2f64.powi(power);
        for (i, (ours, other)) in forms(1.0).iter().zip(forms(unit)).enumerate() {
            let close = |got: f64, want: f64| {
                assert_relative_eq!(got, want, epsilon = 0.0, max_relative = 4e-15);
            };
            close(other.limits().right / unit, ours.limits().right);
            close(other.load(KAPPA) / unit, ours.load(KAPPA));
            let x = 0.3 * ours.limits().right;
            println!("{i} in units of 2^{power}");
            close(other.pressure(x * unit, KAPPA), ours.pressure(x, KAPPA));
            close(other.height(x * unit) / unit, ours.height(x));
            close(other.slope(x * unit), ours.slope(x));
        }
    }
    // A quartic as strong as its parabola, near 2^340 and 2^-340.
    for unit in [2f64.powi(330), 2f64.powi(-330)] {
        let cubed = unit * unit * unit;
        let other = Biquadratic::under_load(1.3 * unit, -0.01 / cubed, 0.2 * unit, KAPPA).unwrap();
        let ours = Biquadratic::under_load(1.3, -0.01, 0.2, KAPPA).unwrap();
        assert_eq!(other.limits().right / unit, ours.limits().right);
        assert_eq!(other.pressure(0.1 * unit, KAPPA), ours.pressure(0.1, KAPPA));
        assert_eq!(other.height(0.1 * unit) / unit, ours.height(0.1));
    }
}

#[test]
fn extreme_parameters_give_finite_answers() {
    let forms: [Box<dyn ClosedForm<f64>>; 14] = [
        Box::new(Hertz::new(1e-100, 1e-120).unwrap()),
        Box::new(Wedge::unequal(1e-12, 1e12, 1e100).unwrap()),
        Box::new(PowerLaw::new(1.0, 1000.0, 1.0).unwrap()),
        Box::new(PowerLaw::new(1.0, 1.0 + 1e-15, 1.0).unwrap()),
        Box::new(PowerLaw::new(1.0, 3.0 - 1e-15, 1.0).unwrap()),
        Box::new(UnequalRadii::new(1e-15, 1e15, 1.0).unwrap()),
        Box::new(UnequalRadii::new(1.0, 1e-300, 1.0).unwrap()),
        Box::new(RoundedPunch::under_load(1.0, 1e-6, 1e-12, 1.0).unwrap()),
        Box::new(RoundedPunch::new(1e-200, 1.0, 1.0).unwrap()),
        Box::new(Ellipse::circle(1.0, 1.0f64.next_down()).unwrap()),
        Box::new(Hyperbola::new(1.0, 1e-200, 1.0).unwrap()),
        Box::new(Exponential::new(1.0, 1.0, 350.0).unwrap()),
        Box::new(Exponential::new(1e12, 1.0, 1.0).unwrap()),
        Box::new(Cosine::new(1e-9, 1e9, 1.0).unwrap()),
    ];
    for (i, form) in forms.iter().enumerate() {
        let limits = form.limits();
        assert!(limits.left < 0.0 && limits.right > 0.0, "{i}: {limits:?}");
        assert!(form.load(1.0) > 0.0 && form.load(1.0).is_finite(), "{i}: {}", form.load(1.0));
        for k in 1..60 {
            let x = limits.at_angle(PI * (f64::from(k) + 0.1) / 60.2);
            let pressure = form.pressure(x, 1.0);
            assert!(pressure > 0.0 && pressure.is_finite(), "{i}: {pressure} at {x}");
            assert!(form.slope(x).is_finite() && form.height(x).is_finite(), "{i} at {x}");
        }
    }
}
