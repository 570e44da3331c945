//! The solver for bodies with several contacts, against closed forms and through births and
//! mergers.
#![allow(missing_docs)]

use crate::boundary_elements::solve;
use crate::common::NanSafe;
use crate::common::{graph, intervals, several};
use crate::forms::KAPPA;

use linecontact::reference::{
    ClosedForm, Hertz, PolynomialMap, Quartic, RoundedPunch, UnequalRadii, Wedge, body,
};
use linecontact::{
    Contact, ContactError, Control, Cost, Edge, Flat, Interval, Real, Solution, Solver,
};
use std::f64::consts::PI;

const COUNTS: [usize; 5] = [2, 3, 5, 8, 16];

/// Returns forms with N contacts, and the reach of their bodies.
fn forms<T: Real>() -> Vec<(String, Box<dyn ClosedForm<T>>, T)> {
    let n = T::of;
    let mut forms: Vec<(String, Box<dyn ClosedForm<T>>, T)> = Vec::new();
    for count in COUNTS {
        let mut add = |name: &str, form: Box<dyn ClosedForm<T>>| {
            // Place where v is nearly four times its value between the contacts.
            let reach = n(2.0 / count as f64).cosh();
            forms.push((format!("{name}, {count}"), form, reach));
        };
        for share in [1.1, 3.0, 40.0] {
            let hertz = Hertz::new(n(0.7), n(0.3)).unwrap();
            let form = PolynomialMap::new(hertz, count, n(0.3 * share), n(1.0)).unwrap();
            add(&format!("Hertz {share}"), Box::new(form));
        }
        let wedge = Wedge::unequal(n(0.2), n(0.3), n(0.4)).unwrap();
        add("wedge", Box::new(PolynomialMap::new(wedge, count, n(0.7), n(1.0)).unwrap()));
        let radii = UnequalRadii::new(n(1.0), n(0.1), n(0.4)).unwrap();
        add("radii", Box::new(PolynomialMap::new(radii, count, n(1.0), n(1.0)).unwrap()));
        let punch = RoundedPunch::new(n(0.2), n(0.7), n(0.3)).unwrap();
        add("rounded punch", Box::new(PolynomialMap::new(punch, count, n(0.5), n(1.0)).unwrap()));
    }
    forms
}

/// Returns the largest error of a limit, relative to the width of its contact, and of a pressure,
/// relative to the peak.
fn errors<T: Real>(name: &str, form: &dyn ClosedForm<T>, solution: &Solution<T>) -> [T; 2] {
    let (want, got) = (form.contacts(), intervals(solution));
    assert_eq!(got.len(), want.len(), "{name}: {got:?}, but {want:?}");
    let pressure = solution.pressure().unwrap();
    let [mut of_width, mut of_peak, mut peak] = [T::zero(); 3];
    for (got, want) in got.iter().zip(&want) {
        let width = want.right - want.left;
        of_width = of_width.nan_max((got.left - want.left).abs() / width);
        of_width = of_width.nan_max((got.right - want.right).abs() / width);
        for i in 1..20 {
            let x = want.at_angle(T::pi() * T::of((f64::from(i) + 0.1) / 20.0));
            let exact = form.pressure(x, T::of(KAPPA));
            let off = pressure.estimate(x, &mut Cost::default()).unwrap().value - exact;
            (of_peak, peak) = (of_peak.nan_max(off.abs()), peak.max(exact));
        }
    }
    for pair in want.windows(2) {
        let gap = T::of(0.5) * (pair[0].right + pair[1].left);
        assert_eq!(pressure.at(gap).unwrap(), T::zero(), "{name}, between two contacts");
    }
    [of_width, of_peak / peak]
}

#[test]

fn the_solver_agrees_with_closed_forms() {
    for (name, form, reach) in forms::<f64>() {
        let body = body(&*form, -reach, reach).unwrap_or_else(|error| panic!("{name}: {error}"));
        let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA);
        let solution = contact.solve(Control::Load(form.load(KAPPA)));
        let solution = solution.unwrap_or_else(|error| panic!("{name}: {error}"));
        let [of_width, of_peak] = errors(&name, &*form, &solution);
        let said = solution.limits_error().unwrap();
        println!("{name:20} limits {of_width:8.1e}, said {said:8.1e}; P {of_peak:8.1e}");
        assert!(of_width < 1e-11 || of_width < 10.0 * said && said < 1e-9, "{name}: {of_width:e}");
        assert!(of_peak < 1e-10, "{name}: {of_peak:e}");
    }
}

#[test]

fn in_single_precision_too() {
    for (name, form, reach) in forms::<f32>() {
        // Many narrow contacts leave few digits of x in each.
        if !["2", "3", "5"].iter().any(|count| name.ends_with(&format!(", {count}"))) {
            continue;
        }
        let kappa = KAPPA as f32;
        let body = body(&*form, -reach, reach).unwrap_or_else(|error| panic!("{name}: {error}"));
        let contact = Contact::new(&Flat, &body).unwrap().kappa(kappa);
        let solution = contact.solve(Control::Load(form.load(kappa)));
        let solution = solution.unwrap_or_else(|error| panic!("{name}: {error}"));
        let [of_width, of_peak] = errors(&name, &*form, &solution);
        let allowed = 1e-4f32.max(10.0 * solution.limits_error().unwrap());
        assert!(of_width < allowed && of_peak < 10.0 * allowed, "{name}: {of_width:e} {of_peak:e}");
    }
}

/// `x⁴ - 2x²` up and down through F = π, cold and warm.
#[test]

fn two_contacts_merge_and_part() {
    let kappa = PI / 2.0;
    let quartic = graph(-4.0, 4.0, |x| [x.powi(4) - 2.0 * x * x, 4.0 * x.powi(3) - 4.0 * x]);
    let contact = Contact::new(&Flat, &*quartic).unwrap().kappa(kappa);
    let mut solver = Solver::new();
    let mut loads: Vec<f64> = (0..40).map(|i| PI * 0.02 * 1.2f64.powi(i)).collect();
    for near in [0.9, 0.99, 0.999, 1.001, 1.01, 1.1] {
        loads.push(PI * near);
    }
    loads.sort_by(f64::total_cmp);
    let down: Vec<f64> = loads.iter().rev().copied().collect();
    for load in loads.into_iter().chain(down) {
        let form = Quartic::under_load(1.0, 1.0, load, kappa).unwrap();
        // The inner limits go as the root of the remaining load.
        let near = 1.0 / (1.0 - load / PI).abs().min(1.0);
        let cold = contact.solve(Control::Load(load)).unwrap();
        let warm = solver.solve(&contact, Control::Load(load)).unwrap();
        for solution in [&cold, &warm] {
            let (got, want) = (intervals(solution), form.contacts());
            assert_eq!(got.len(), want.len(), "F = {load}: {got:?}");
            for (got, want) in got.iter().zip(&want) {
                let off = (got.left - want.left).abs().nan_max((got.right - want.right).abs());
                assert!(off < 1e-12 * near * want.half_width(), "F = {load}: {got:?}, {want:?}");
            }
        }
    }
}

/// A rough body: as the load grows its limits only move outwards, through births and mergers, and
/// its pressures change gradually; the way back gives the same contacts.
#[test]
fn limits_only_move_outwards() {
    let height = |x: f64| {
        let waves =
            [[0.024, 9.0, 0.4], [-0.016, 17.3, 1.9], [0.008, 31.0, 4.0], [0.0032, 53.0, 1.0]];
        let mut sum = [x * x / 2.0, x];
        for [a, k, phase] in waves {
            let (sin, cos) = (k * x + phase).sin_cos();
            sum = [sum[0] + a * cos, sum[1] - a * k * sin];
        }
        sum
    };
    let kappa = PI / 2.0;
    let body = graph(-2.0, 2.0, height);
    let contact = Contact::new(&Flat, &*body).unwrap().kappa(kappa);
    let mut solver = Solver::new();
    let loads: Vec<f64> = (0..120).map(|i| 1e-4 * 5e3f64.powf(f64::from(i) / 119.0)).collect();
    let x: Vec<f64> = (-400..=400).map(|i| 0.003 * f64::from(i)).collect();
    let mut kept: Vec<(Vec<Interval<f64>>, Vec<f64>)> = Vec::new();
    let (mut most, mut changes) = (0, 0);
    for &load in &loads {
        let solution = solver.solve(&contact, Control::Load(load));
        let solution = solution.unwrap_or_else(|error| panic!("F = {load}: {error}"));
        let contacts = intervals(&solution);
        let pressure = solution.pressure().unwrap();
        let at = |&x: &f64| pressure.estimate(x, &mut Cost::default()).unwrap().value;
        let pressures: Vec<f64> = x.iter().map(at).collect();
        if let Some((before, lower)) = kept.last() {
            for light in before {
                let rounding = 1e-10;
                let within = |heavy: &Interval<f64>| {
                    heavy.left <= light.left + rounding && light.right <= heavy.right + rounding
                };
                assert!(
                    contacts.iter().any(within),
                    "F = {load}: {light:?} is not in {contacts:?}"
                );
            }
            // ∂P/∂F is the pressure of a punch, which is positive.
            let peak = pressures.iter().fold(0.0f64, |peak, &p| peak.max(p));
            for ((&x, &more), &less) in x.iter().zip(&pressures).zip(lower) {
                assert!(more >= less - 1e-9 * peak, "F = {load}: P({x}) has fallen to {more}");
                // From one load to the next, 7 % more, no pressure rises by half the peak.
                assert!(more <= less + 0.5 * peak, "F = {load}: P({x}) has leapt to {more}");
            }
            changes += usize::from(before.len() != contacts.len());
        }
        most = most.max(contacts.len());
        kept.push((contacts, pressures));
    }
    assert!(most >= 4 && changes >= 6, "{most} contacts at most, {changes} births and mergers");
    for (&load, (contacts, _)) in loads.iter().zip(&kept).rev() {
        let solution = solver.solve(&contact, Control::Load(load)).unwrap();
        let back = intervals(&solution);
        assert_eq!(back.len(), contacts.len(), "F = {load}, on the way down");
        for (one, other) in back.iter().zip(contacts) {
            let off = (one.left - other.left).abs().nan_max((one.right - other.right).abs());
            assert!(
                off < 1e-9 * one.half_width(),
                "F = {load}, on the way down: {one:?}, {other:?}"
            );
        }
    }
    // The oracle finds the same contact.
    for (&load, (contacts, _)) in loads.iter().zip(&kept).step_by(17) {
        let oracle = solve(&|x| height(x)[0], kappa, load, [-2.0, 2.0], &[]).unwrap();
        assert_eq!(oracle.disagreement(contacts), None, "F = {load}");
    }
}

/// An independently computed solution: `tests/data/several`.
#[test]

fn contacts_without_a_closed_form() {
    let want = several("rough_parabola");
    let body = graph(-2.0, 2.0, |x| {
        let waves = [[0.01, 9.0, 0.4], [-0.006, 17.3, 1.9], [0.003, 31.0, 4.0]];
        let mut sum = [x * x / 2.0, x];
        for [a, k, phase] in waves {
            let (sin, cos) = f64::sin_cos(k * x + phase);
            sum = [sum[0] + a * cos, sum[1] - a * k * sin];
        }
        sum
    });
    let contact = Contact::new(&Flat, &*body).unwrap().kappa(PI / 2.0);
    let solution = contact.solve(Control::Load(0.02)).unwrap();
    let got = intervals(&solution);
    assert_eq!(got.len(), want.contacts.len());
    for (got, want) in got.iter().zip(&want.contacts) {
        let off = (got.left - want.left).abs().nan_max((got.right - want.right).abs());
        assert!(off < 1e-10 * (want.right - want.left), "{got:?}, {want:?}");
    }
    let pressure = solution.pressure().unwrap();
    for [x, exact] in want.points {
        assert!((pressure.at(x).unwrap() - exact).abs() < 1e-10, "P({x})");
    }
}

/// Two bumps, x⁴ - 2x², with a Y that is not the integral of its Y'.
#[test]
fn heights_that_do_not_go_with_the_slopes() {
    for share in [0.9, 1.0 + 1e-3, 1.5] {
        let body =
            graph(-2.0, 2.0, move |x| [share * x * x * (x * x - 2.0), 4.0 * x * (x * x - 1.0)]);
        let contact = Contact::new(&Flat, &*body).unwrap().contact_modulus(1.0);
        let error = contact.solve(Control::Load(1.0)).map(|_| ()).unwrap_err();
        let ContactError::InconsistentHeights { by_heights, by_slopes, .. } = error else {
            panic!("{share}: {error}")
        };
        assert!((by_heights / by_slopes / share - 1.0).abs() < 1e-9, "{by_heights} {by_slopes}");
    }
}

/// x⁴ - 2x² has two bumps. Several contacts with adhesion are not supported: an error is right, two
/// contacts without adhesion are not.
#[test]
fn one_adhesive_edge_is_not_forgotten_between_two_bumps() {
    let body = graph(-2.5, 2.5, |x| [x * x * (x * x - 2.0), 4.0 * x * (x * x - 1.0)]);
    let contact = Contact::new(&Flat, &*body).unwrap();
    for edges in [[Edge::Adhesive(1e-3), Edge::Free], [Edge::Free, Edge::Adhesive(1e-3)]] {
        let contact = contact.clone().edges(edges[0], edges[1]);
        for load in [0.1, 0.5, 1.0] {
            match contact.solve(Control::Load(load)) {
                Ok(solution) => assert_eq!(solution.intervals().len(), 1),
                Err(error) => println!("{load}: {error}"),
            }
        }
    }
}
