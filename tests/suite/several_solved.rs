//! The solver for bodies with several contacts, against closed forms and boundary elements, and
//! through births and mergers.
#![allow(missing_docs)]

use crate::boundary_elements::{height, solve};
use crate::common::NanSafe;
use crate::common::{
    Profile, Shares, graph, intervals, limits_off, on_flat, quartic, several, worst,
};
use crate::forms::KAPPA;
use crate::several_quantities::all_scenes;

use linecontact::profile::{Fit, Parabola, Spline, rounded_punch};
use linecontact::reference::{
    ClosedForm, Hertz, PolynomialMap, Quartic, RoundedPunch, UnequalRadii, Wedge, body,
};
use linecontact::{
    Contact, ContactError, Control, Cost, Curve, CurvePoint, Edge, Flat, InputError, Interval,
    ParametricProfile, Real, Solution, Solver,
};
use std::f64::consts::PI;

const COUNTS: [usize; 5] = [2, 3, 5, 8, 16];

/// Returns forms with N contacts, and the reach of their bodies.
pub fn forms<T: Real>() -> Vec<(String, Box<dyn ClosedForm<T>>, T)> {
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
    let quartic = quartic(-4.0, 4.0);
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

/// Independently computed solutions: `tests/data/several`.
#[test]
fn contacts_of_the_files() {
    for scene in all_scenes() {
        let (name, want) = (scene.name, several(scene.name));
        let solution = scene.solve(scene.load);
        let got = intervals(&solution);
        assert_eq!(got.len(), want.contacts.len(), "{name}");
        let off = got.iter().zip(&want.contacts).map(|(&got, &want)| limits_off(got, want));
        let off = worst(off);
        let pressure = solution.pressure().unwrap();
        let largest = want.points.iter().fold(0.0f64, |most, [_, p]| most.max(*p));
        let pressures =
            want.points.iter().map(|&[x, p]| (pressure.at(x).unwrap() - p).abs() / largest);
        let of_peak = worst(pressures);
        println!("{name:24} limits {off:.1e}, P {of_peak:.1e}");
        assert!(off < 1e-12 && of_peak < 2e-11, "{name}: {off:e} {of_peak:e}");
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
        let ContactError::Input(InputError::InconsistentHeights { by_heights, by_slopes, .. }) =
            error
        else {
            panic!("{share}: {error}")
        };
        // Over a short span: the slopes are known to the panels' error.
        assert!((by_heights / by_slopes / share - 1.0).abs() < 1e-7, "{by_heights} {by_slopes}");
    }
}

/// x⁴ - 2x² has two bumps. Several contacts with adhesion are not supported: an error is right, two
/// contacts without adhesion are not.
#[test]
fn one_adhesive_edge_is_not_forgotten_between_two_bumps() {
    let body = quartic(-2.5, 2.5);
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

/// Asserts that a solution agrees with boundary elements for the same bodies.
fn assert_contact(
    name: &str,
    bodies: [&dyn ParametricProfile<f64>; 2],
    kappa: f64,
    range: [f64; 2],
    kinks: &[f64],
    solution: &Solution<f64>,
) {
    let gap = |x: f64| height(bodies[1], x) - height(bodies[0], x);
    let oracle = solve(&gap, kappa, solution.load(), range, kinks).expect("boundary elements");
    let contacts = intervals(solution);
    let differs = oracle.disagreement(&contacts);
    assert_eq!(differs, None, "{name}: {contacts:?}, but {:?}", oracle.contacts);
    let pressure = solution.pressure().expect(name);
    let at = |x: f64| match contacts.iter().any(|on| on.contains(x)) {
        true => pressure.estimate(x, &mut Cost::default()).map_or(f64::NAN, |p| p.value),
        false => 0.0,
    };
    let [off, x] = oracle.pressure_off(kinks, at);
    assert!(off < 0.01, "{name}: P({x}) off by {off:e} of the peak");
}

/// Returns `|x/A|ⁿ + |1 - y/B|ⁿ = 1` by the polar angle from its lowest point.
fn superellipse(along: f64, across: f64, n: f64) -> Profile {
    Box::new(Curve::new([-0.6, 0.6], move |k: f64| {
        let (sin, cos) = k.sin_cos();
        let [one, two] = [(sin / along).abs(), cos / across];
        let sum = one.powf(n) + two.powf(n);
        let dsum =
            one.powf(n - 1.0) * cos * sin.signum() / along - two.powf(n - 1.0) * sin / across;
        let r = sum.powf(-1.0 / n);
        let dr = -r * dsum / sum;
        let (dx, dy) = (dr * sin + r * cos, r * sin - dr * cos);
        CurvePoint { x: r * sin, y: across - r * cos, dx, dy }
    }))
}

/// A flat-bottomed body in a groove touches in two places: as one contact it would have -157 MPa in
/// its middle.
#[test]
fn a_superellipse_in_a_groove() {
    let modulus = 115e3;
    let body = superellipse(10.0, 8.0, 2.5);
    // The lower body is hollow.
    let groove = graph(-5.0, 5.0, |x| {
        let root = (1600.0 - x * x).sqrt();
        [40.0 - root, x / root]
    });
    let contact = Contact::new(&*groove, &*body).unwrap().contact_modulus(modulus);
    for (load, count) in [(20.0, 2), (500.0, 2), (1500.0, 1), (3000.0, 1)] {
        let solution = contact.solve(Control::Load(load)).unwrap();
        assert_eq!(intervals(&solution).len(), count, "{load}");
        let on = solution.hull();
        assert!((on.left + on.right).abs() < 1e-9, "{on:?}");
        let name = format!("{load} N/mm");
        let kappa = PI / 2.0 * modulus;
        assert_contact(&name, [&*groove, &*body], kappa, [-4.9, 4.9], &[], &solution);
        solution.certify().unwrap();
    }
}

/// Returns measured points of a roller of radius 20 with a wave, and noise of 0.05 µm.
fn measured(wave: f64) -> Vec<[f64; 2]> {
    let mut shares = Shares(1);
    let point = |i: i32| {
        let x = 0.005 * f64::from(i);
        let y = x * x / 40.0 + wave * (2.0 * PI / 0.7 * x + 1.0).cos() + 0.05e-3 * shares.normal();
        [x, y]
    };
    (-600..=600).map(point).collect()
}

/// No solve is `Ok` at the wrong bump. With 0.5 µm the body stays convex, with 3 µm it does not.
#[test]
fn measured_rollers_with_waves() {
    let modulus = 115e3;
    for wave in [0.5e-3, 3e-3] {
        let fit = Fit { smooth: true, ..Fit::default() };
        let body = Spline::fitted(&measured(wave), fit).unwrap();
        let contact = Contact::new(&Flat, &body).unwrap().contact_modulus(modulus);
        for load in [2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 300.0, 1000.0] {
            let name = format!("wave {wave}, {load} N/mm");
            let solution = contact.solve(Control::Load(load));
            let solution = solution.unwrap_or_else(|error| panic!("{name}: {error}"));
            let kappa = PI / 2.0 * modulus;
            assert_contact(&name, [&Flat, &body], kappa, [-3.0, 3.0], &[], &solution);
        }
    }
}

/// A rounded punch in a groove stands on its two edges.
#[test]
fn a_rounded_punch_in_a_groove() {
    let punch = rounded_punch(1.0, 0.1, 1.3).unwrap();
    let groove = Parabola::new(3.0, [-1.3, 1.3]).unwrap();
    let contact = Contact::new(&groove, &punch).unwrap();
    for load in [1e-3, 1e-2] {
        let solution = contact.solve(Control::Load(load)).unwrap();
        assert_eq!(intervals(&solution).len(), 2, "{load}");
        let name = format!("F = {load}");
        assert_contact(&name, [&groove, &punch], 1.0, [-1.3, 1.3], &[], &solution);
    }
}

/// Contacts 2e-3 of their width apart: one over both would have a pressure of -7.6e-6 of the mean
/// between them.
#[test]
fn two_contacts_about_to_merge_are_two() {
    let contact = on_flat(graph(-2.0, 2.0, |k| {
        let k2 = k * k;
        [1e-3 * (k2 * (k2 - 2.0) + 0.02 * k), 1e-3 * (4.0 * k * (k2 - 1.0) + 0.02)]
    }));
    let (lower, upper) = ((1.0 - 0.33f64.powi(2)) / 70e3, (1.0 - 0.3f64.powi(2)) / 210e3);
    let contact = contact.contact_modulus(1.0 / (lower + upper));
    for load in [184.1149, 184.1150, 184.1160, 184.117_101, 184.117_106] {
        let solution = contact.solve(Control::Load(load)).unwrap();
        assert_eq!(solution.intervals().len(), 2, "{load}");
    }
}

/// Two gaps that close under nearly the same load, next to a corner that does not hold: the
/// uncertainty of the limits at one gap is no tension at the other, where it would be -4.6e-7 of
/// the mean.
#[test]
fn a_gap_that_is_in_doubt_hides_no_tension_at_another() {
    let wave = graph(-1.3, 1.3, |k| {
        let angle = 10.0 * k;
        [0.05 * angle.cos() + 0.2 * k * k, -0.5 * angle.sin() + 0.4 * k]
    });
    let contact = on_flat(wave).contact_modulus(1.0).edges(Edge::Free, Edge::FreeUntil(1.15));
    for (share, count) in [(-1e-5, 3), (1e-7, 3), (1e-8, 3), (1e-5, 1)] {
        let solution = contact.solve(Control::Load(0.600_968_279_198 * (1.0 + share))).unwrap();
        assert_eq!(solution.intervals().len(), count, "{share}");
        assert!(solution.certify().is_ok(), "{share}");
    }
    // One bump begins to touch: the lowest place of the gap there is found to 1e-8.
    for (share, count) in [(-1e-6, 2), (-1e-7, 3), (1e-6, 4)] {
        let solution = contact.solve(Control::Load(0.137_125_153_359 * (1.0 + share))).unwrap();
        assert!(solution.intervals().len() >= count, "{share}");
        assert!(solution.certify().is_ok(), "{share}");
    }
}

/// Two bumps are about to touch, one on either side. The uncertainty of the one found must not hide
/// the overlap of the other.
#[test]
fn of_two_bumps_that_are_alike_both_touch_or_none() {
    let wave = graph(-1.5, 1.5, |x| {
        let angle = 2.0 * PI * x;
        [x * x / 200.0 + 0.02 * (1.0 - angle.cos()), x / 100.0 + 0.04 * PI * angle.sin()]
    });
    let contact = on_flat(wave).contact_modulus(1.0);
    let (mut one, mut three) = (0, 0);
    for i in 0..200 {
        let load = 0.001_902_3 + 1e-9 * f64::from(i);
        let solution = contact.solve(Control::Load(load)).unwrap();
        let on = solution.intervals();
        match on.len() {
            1 => one += 1,
            3 => three += 1,
            count => panic!("{load}: {count}"),
        }
        assert!((solution.a() - solution.b()).abs() < 1e-8, "{load}: {on:?}");
        let certificate = solution.certify().unwrap();
        assert!(certificate.gap.is_none_or(|gap| gap.value > -1e-10), "{load}: {certificate:?}");
    }
    assert!(one > 30 && three > 30, "{one} {three}");
}

/// Double wells up to 1e-7 of the load at which the contacts merge, and beyond: no pressure is
/// negative, and the number of contacts is that of the load.
#[test]
fn up_to_a_merge_two_contacts_are_two_and_one_from_there_on() {
    let mut random = Shares(20);
    for scene in 0..6 {
        let [lean, cubic] = [random.between(-0.05, 0.05), random.between(-0.1, 0.1)];
        let kink = if scene % 3 == 0 { random.between(0.0, 0.02) } else { 0.0 };
        let contact = on_flat(graph(-2.0, 2.0, move |k| {
            let (square, rounded) = (k * k, (k * k + 1e-6).sqrt());
            [
                square * (square - 2.0) + lean * k + cubic * square * k - kink * rounded,
                4.0 * k * (square - 1.0) + lean + 3.0 * cubic * square - kink * k / rounded,
            ]
        }));
        let [mut low, mut high] = [1.0f64, 6.0];
        while high > low * (1.0 + 1e-9) {
            let load = 0.5 * (low + high);
            // Closer than 1e-9 the heights cannot resolve a contact.
            let one = contact.solve(Control::Load(load)).is_ok_and(|at| at.intervals().len() == 1);
            (low, high) = if one { (low, load) } else { (load, high) };
        }
        for exponent in 1..=7 {
            for (side, count) in [(-1.0, 2), (1.0, 1)] {
                let load = high * (1.0 + side * 10f64.powi(-exponent));
                let solution = contact.solve(Control::Load(load)).unwrap();
                let on = solution.intervals();
                assert_eq!(on.len(), count, "{scene} {side} {exponent}");
                let between = if count == 2 { 0.5 * (on[0].right + on[1].left) } else { 0.0 };
                let pressure = solution.pressure().unwrap();
                let mean = load / solution.hull().half_width();
                for i in -400..400 {
                    // Next to a narrow gap the small pressure may be unresolved.
                    let x = between + 0.3 * (f64::from(i) / 400.0).powi(3);
                    let least = pressure.at(x).unwrap_or(0.0);
                    assert!(least >= -1e-10 * mean, "{scene} {side} {exponent}: P({x}) = {least}");
                }
                assert!(solution.certify().is_ok(), "{scene} {side} {exponent}");
            }
        }
    }
}

/// Under a heavier load crests touch that did not touch before.
#[test]
fn contacts_that_are_born_cost_only_their_own_samples() {
    let wave = 100.0 * PI;
    let body = graph(-1.0, 1.0, move |x| {
        let (sin, cos) = (wave * x).sin_cos();
        [0.05 * x * x - 0.3 * cos / wave, 0.1 * x + 0.3 * sin]
    });
    let contact = on_flat(body);
    let mut solver = Solver::new();
    let mut solve = |load: f64| {
        let solution = solver.solve(&contact, Control::Load(load)).unwrap();
        (solution.intervals().len(), solution.cost().evaluations)
    };
    let [(few, cold), (more, next)] = [0.02, 0.021].map(&mut solve);
    println!("{few} contacts by {cold} evaluations, {more} by {next} more");
    assert!(more > few && next < cold / 5, "{few} by {cold}, {more} by {next}");
}

/// Two contacts about to merge are two, or one without tension: quartics under loads close to that
/// under which they merge. (Of 100, 10 passed as one with a tension of up to 1e-7 of the mean.)
#[test]
fn contacts_about_to_merge_pass_without_tension() {
    let count = std::env::var("SCENES").ok().and_then(|count| count.parse().ok()).unwrap_or(100);
    let mut faults = Vec::new();
    for seed in 0..count {
        let mut shares = Shares(seed + 1);
        (0..3).for_each(|_| _ = shares.between(0.0, 1.0));
        // At the merge P is as x² sqrt((x + left)(right - x)), and g' as the polynomial part of
        // x² sqrt((x + left)(x - right)) far away.
        let [left, right] = [0; 2].map(|_| shares.between(1.0, 2.0));
        let half = 0.5 * (left + right);
        let centre = 0.5 * (right - left);
        let scale = shares.power_of_ten(-3.0, 3.0);
        let slope = move |x: f64| {
            let t = x - centre;
            let c = centre;
            (t + c).powi(2) * t - 0.5 * half * half * (t + 2.0 * c)
        };
        let height = move |x: f64| {
            let (t, c, h) = (x - centre, centre, half * half);
            t.powi(4) / 4.0 + 2.0 * c * t.powi(3) / 3.0 + c * c * t * t / 2.0
                - 0.5 * h * (t * t / 2.0 + 2.0 * c * t)
        };
        let body = graph(-4.0, 4.0, move |x| [scale * height(x), scale * slope(x)]);
        // F = κ (L/π) ∫ g' cos θ dθ of the contact of the merge.
        let terms = 64;
        let merge = (0..terms).fold(0.0, |sum, i| {
            let theta = PI * (f64::from(i) + 0.5) / f64::from(terms);
            sum + slope(centre + half * theta.cos()) * theta.cos()
        }) * half
            / f64::from(terms)
            * scale;
        let contact = Contact::new(&Flat, &*body).unwrap();
        let share = shares.power_of_ten(-9.5, -5.5);
        match contact.solve(Control::Load(merge * (1.0 - share))) {
            Ok(found) if found.intervals().len() == 1 => {
                let on = found.intervals()[0];
                let mean = found.load() / on.half_width();
                let pressure = found.pressure().unwrap();
                let least = (-400..=400)
                    .map(|i| pressure.at(f64::from(i).powi(3) * 1e-9 * half).unwrap())
                    .fold(f64::INFINITY, f64::min);
                if least < -4e-11 * mean {
                    faults.push(format!("{seed}: {share:e}: {:e} {left} {right}", least / mean));
                }
            }
            Ok(_) => {}
            Err(error) => faults.push(format!("{seed}: {share:e}: {error}")),
        }
    }
    assert!(faults.is_empty(), "{}:\n{}", faults.len(), faults.join("\n"));
}
