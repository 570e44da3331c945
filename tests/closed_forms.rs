//! The closed forms of `linecontact::reference`: against the equations they solve, by a quadrature
//! that shares nothing with the solver; against solutions of 25 digits; and the solver against them.
#![allow(missing_docs)]

mod common;

use approx::assert_relative_eq;
use common::reference;
use linecontact::reference::{
    Biquadratic, ClosedForm, Cosine, Ellipse, Exponential, FlatPunch, Hertz, Hyperbola, Jkr,
    PowerLaw, ReferenceError, RoundedPunch, UnequalRadii, Wedge, body,
};
use linecontact::{Contact, Cost, Edge, Flat, Interval, Load, Real};
use std::f64::consts::PI;

const KAPPA: f64 = 1.7;

struct Form<T> {
    name: String,
    form: Box<dyn ClosedForm<T>>,
    /// How far the body goes.
    reach: T,
}

/// Forms of half-widths near 1.
fn forms<T: Real>() -> Vec<Form<T>> {
    let (n, kappa) = (T::of, T::of(KAPPA));
    let mut forms = Vec::new();
    let mut add = |name: &str, reach: f64, form: Box<dyn ClosedForm<T>>| {
        forms.push(Form { name: name.into(), form, reach: n(reach) });
    };
    let [half, one, two] = [0.5, 1.0, 2.0].map(n);
    add("Hertz", 9.0, Box::new(Hertz::new(n(1.3), n(0.7)).unwrap()));
    add("wedge", 9.0, Box::new(Wedge::new(n(0.3), n(0.8)).unwrap()));
    for right in [0.02, 0.7, 30.0] {
        let form = Wedge::unequal(n(0.3), n(right), n(0.8)).unwrap();
        add(&format!("wedge 0.3, {right}"), 9.0, Box::new(form));
    }
    for exponent in [1.0, 1.2, 1.5, 2.0, 2.6, 3.0, 3.5, 4.0, 6.3, 11.0, 30.5] {
        let form = PowerLaw::new(n(0.4), n(exponent), n(0.9)).unwrap();
        add(&format!("power {exponent}"), 2.0, Box::new(form));
    }
    for quartic in [0.5, -0.1, 0.0] {
        let form = Biquadratic::new(n(1.1), n(quartic), n(0.9)).unwrap();
        add(&format!("biquadratic {quartic}"), 1.4, Box::new(form));
    }
    for right in [1e-3, 0.4, 1.0, 2.5, 100.0] {
        let form = UnequalRadii::new(one, n(right), n(0.9)).unwrap();
        add(&format!("radii 1, {right}"), 9.0, Box::new(form));
    }
    for flat in [1e-3, 0.4, 0.9, 0.9999] {
        let form = RoundedPunch::new(n(flat), n(0.7), one).unwrap();
        add(&format!("rounded punch {flat}"), 9.0, Box::new(form));
    }
    let punch = |slope: f64, load: f64| FlatPunch::under_load(half, n(slope), n(load), kappa);
    add("flat punch", 1.0, Box::new(punch(0.0, 2.0).unwrap()));
    add("flat punch, tilted", 1.0, Box::new(punch(-0.3, 2.0).unwrap()));
    add("flat punch on one edge", 1.0, Box::new(punch(0.3, 0.2).unwrap()));
    add("flat punch on the other", 1.0, Box::new(punch(-0.9, 0.2).unwrap()));
    for half_width in [0.05, 0.6, 0.95] {
        let form = Ellipse::circle(one, n(half_width)).unwrap();
        add(&format!("circle {half_width}"), 0.99, Box::new(form));
    }
    add("ellipse", 1.9, Box::new(Ellipse::new(two, n(0.3), n(1.5)).unwrap()));
    for tip in [3.0, 0.3, 0.03] {
        let form = Hyperbola::new(n(0.6), n(tip), n(1.2)).unwrap();
        add(&format!("hyperbola {tip}"), 9.0, Box::new(form));
    }
    for half_width in [0.01, 1.0, 4.0] {
        let form = Exponential::new(n(0.8), n(1.5), n(half_width)).unwrap();
        add(&format!("exponential {half_width}"), 8.0, Box::new(form));
    }
    for half_width in [0.05, 0.6, 0.74] {
        let form = Cosine::new(n(0.1), two, n(half_width)).unwrap();
        add(&format!("cosine {half_width}"), 1.0, Box::new(form));
    }
    for load in [-0.3, 0.0, 0.4] {
        let form = Jkr::under_load(n(1.3), n(0.3), n(load), kappa).unwrap();
        add(&format!("JKR {load}"), 9.0, Box::new(form));
    }
    forms
}

/// An integral over the contact in θ, from panels that end at the edges, the joints and the pole:
/// by the rule of Takahasi and Mori (tanh-sinh) on each.
fn integral(limits: Interval<f64>, ends: &[f64], integrand: impl Fn(f64) -> f64) -> f64 {
    let mut angles: Vec<f64> = ends.iter().map(|&x| limits.angle(x)).collect();
    angles.extend([0.0, PI]);
    angles.sort_by(f64::total_cmp);
    let width = limits.right - limits.left;
    let place = |theta: f64| {
        let x = if theta < PI / 2.0 {
            limits.right - width * (theta / 2.0).sin().powi(2)
        } else {
            limits.left + width * ((PI - theta) / 2.0).sin().powi(2)
        };
        // At the edges themselves P sin θ may be inf times 0.
        x.clamp(limits.left.next_up(), limits.right.next_down())
    };
    const STEP: f64 = 1.0 / 32.0;
    let mut total = 0.0;
    for panel in angles.windows(2) {
        let half = (panel[1] - panel[0]) / 2.0;
        for i in -128i32..=128 {
            let t = STEP * f64::from(i);
            let u = PI / 2.0 * t.sinh();
            // The distance from the nearer end of the panel.
            let distance = half * (-u.abs()).exp() / u.cosh();
            let theta = if i < 0 { panel[0] + distance } else { panel[1] - distance };
            let weight = half * STEP * PI / 2.0 * t.cosh() / u.cosh().powi(2);
            let value = integrand(place(theta));
            if value.is_finite() {
                total += weight * value;
            }
        }
    }
    total
}

/// The largest residuals of `PV∫ P(s)/(x - s) ds = κ g(x)`, in terms of the largest of either side,
/// and of `∫ P ds = F`.
fn residuals(form: &dyn ClosedForm<f64>) -> [f64; 2] {
    let (limits, joints) = (form.limits(), form.joints());
    // P sin θ/L of the place as it is rounded.
    let strength = |s: f64| form.pressure(s, KAPPA) * limits.edge_root(s);
    let load = integral(limits, &joints, strength);
    let size = integral(limits, &joints, |s| strength(s).abs());
    let mut worst = 0.0f64;
    let steepest = form.slope_left(limits.right).abs().max(form.slope(limits.left).abs());
    for i in 1..24 {
        let x = limits.at_angle(PI * (f64::from(i) + 0.3) / 24.6);
        let at_x = strength(x);
        let mut ends = joints.clone();
        ends.push(x);
        // PV∫ ds/((x - s) w(s)) is zero.
        let left = integral(limits, &ends, |s| (strength(s) - at_x) / (x - s));
        let scale = (KAPPA * steepest).max(size / limits.half_width());
        worst = worst.max((left - KAPPA * form.slope(x)).abs() / scale);
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
fn the_solver_agrees_with_them() {
    for Form { name, form, reach } in forms::<f64>() {
        let (want, load) = (form.limits(), form.load(KAPPA));
        let body = body(&*form, -reach, reach).unwrap_or_else(|e| panic!("{name}: {e}"));
        let [left, right] = form.edges();
        let contact = Contact::new(&Flat, &body).expect(&name).kappa(KAPPA).edges(left, right);
        let solution = contact.solve(Load::PerLength(load)).expect(&name);
        let (got, l) = (solution.interval(), want.half_width());
        let limits = [got.right - want.right, got.left - want.left].map(|d| d.abs() / l);
        let relative = [got.right / want.right - 1.0, got.left / want.left - 1.0].map(f64::abs);
        let pressure = solution.pressure().expect(&name);
        let estimate = |x| pressure.estimate(x, &mut Cost::default()).expect(&name).value;
        let mut inside = 0.0f64;
        for i in 1..40 {
            let x = want.at_angle(PI * (f64::from(i) + 0.1) / 40.0);
            let exact = form.pressure(x, KAPPA);
            let share = limits[0].max(limits[1]) * l * l / (x - want.left).min(want.right - x);
            // A JKR pressure passes through zero.
            let size = exact.abs().max(0.1 * load.abs() / l);
            inside = inside.max((estimate(x) - exact).abs() / size - share);
        }
        // Next to an edge, at the same distance from the limits of each.
        let distance = 1e-6 * l;
        let pairs = [
            (got.right - distance, want.right - distance),
            (got.left + distance, want.left + distance),
        ];
        let mut beside = 0.0f64;
        for (got, exact) in pairs {
            beside = beside.max((estimate(got) / form.pressure(exact, KAPPA) - 1.0).abs());
        }
        println!(
            "{name:24} a {:8.1e} b {:8.1e}  P {inside:8.1e}, beside an edge {beside:8.1e}",
            relative[0], relative[1]
        );
        assert!(limits.into_iter().all(|error| error < 1e-12), "{name}: {limits:?}");
        assert!(inside < 1e-12, "{name}: {inside}");
        // One ulp of a limit is a share of 1e-10 of the distance.
        let far = want.right.abs().max(want.left.abs()) / distance;
        assert!(beside < 1e-12 + 2.0 * f64::EPSILON * far, "{name}: {beside}");
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
