//! Bodies with undeclared features: kinks and fine waves inside a curve, ends like square roots,
//! uneven parameters.
#![allow(missing_docs)]

use crate::common;
use crate::integrals::edge_integrals;
use crate::random_scenes::Dice;

use approx::assert_relative_eq;
use common::{assert_close, graph, join, limits_off, on_flat, reference};
use linecontact::reference::{ClosedForm, PowerLaw};
use linecontact::{Contact, Control, Cost, Curve, CurvePoint, Flat, Interval, Panels};
use linecontact::{ParametricProfile, Piecewise, Solution};
use std::f64::consts::PI;

pub fn assert_solved(solution: &Solution<f64>, want: Interval<f64>, tolerance: f64, most: usize) {
    let (got, cost) = (solution.hull(), solution.cost());
    let (error, estimate) = (limits_off(got, want), solution.limits_error().unwrap());
    println!("error {error:.1e}, said to be {estimate:.1e}, {cost:?}");
    assert!(error <= tolerance, "{got:?} is not {want:?}");
    assert!(cost.evaluations <= most, "{cost:?}");
    assert!(error <= estimate, "error {error:e}, said to be {estimate:e}");
}

#[test]
fn a_wedge_as_one_curve() {
    // F = 2 m L/π, P = (2 m/π²) arcosh(L/|x - s|). The kink is at no special place.
    for (m, s, l) in [(1.0, 0.1, 0.3), (0.2, -0.237, 0.6), (3.0, 0.0123, 1e-3)] {
        let contact = on_flat(graph(-1.0, 1.0, move |x| [m * (x - s).abs(), m * (x - s).signum()]));
        let solution = contact.solve(Control::Load(2.0 * m * l / PI)).unwrap();
        assert_solved(&solution, Interval { left: s - l, right: s + l }, 1e-10, 5000);
        let pressure = solution.pressure().unwrap();
        for i in -9..10 {
            let z = 0.1 * f64::from(i) + 0.033;
            let exact = 2.0 * m / (PI * PI) * (1.0 / z.abs()).acosh();
            assert_close(pressure.at(s + z * l).unwrap(), exact, 1e-9);
        }
    }
}

/// Returns `abs(x - s)ⁿ` on an interval that ends at s, or beyond it on both sides.
fn power(n: f64, s: f64, ends: [f64; 2]) -> common::Profile {
    let sign = move |x: f64| {
        if x == s { (ends[0] + ends[1] - 2.0 * s).signum() } else { (x - s).signum() }
    };
    graph(ends[0], ends[1], move |x| {
        let distance = (x - s).abs();
        [distance.powf(n), n * distance.powf(n - 1.0) * sign(x)]
    })
}

/// Returns the largest pressure of a power of the distance, its estimated error, and the text.
fn peak_of(body: common::Profile, load: f64) -> (f64, f64, String) {
    let contact = on_flat(body).kappa(1.0);
    let solution = contact.solve(Control::Load(load)).unwrap();
    let peak = solution.peak().unwrap();
    let all = solution.pressure().unwrap();
    let estimate = all.estimate(peak.x, &mut Cost::default()).unwrap();
    assert_eq!((peak.pressure, peak.error), (estimate.value, estimate.error));
    assert_eq!(solution.contacts().unwrap()[0].peak, Some(peak));
    assert_eq!(solution.summary().unwrap().peak, Some(peak));
    (peak.pressure, peak.error, solution.to_string())
}

/// Next to its tip the slope of such a body changes as much from 1e-200 to 1e-100 as from 1e-100
/// to 1, and so does the pressure: the estimate has what no sample sees, and the text says so.
#[test]
fn the_peak_at_a_corner_that_is_no_breakpoint_is_uncertain() {
    let aside = [1e-3, 0.1, 0.3, 0.7].map(|s| [(1.05, s), (1.1, s)]).concat();
    let steep = [0.0, 1e-3, 0.3, 0.7].map(|s| (1.02, s));
    for (n, s) in [(1.05, 0.0), (1.1, 0.0)].into_iter().chain(aside).chain(steep) {
        let exact = PowerLaw::new(1.0, n, 0.2).unwrap();
        let (value, error, text) = peak_of(power(n, s, [-1.0, 1.0]), exact.load(1.0));
        let missed = exact.pressure(0.0, 1.0) - value;
        println!("{n} at {s}: {missed:.2e} of {value}, said to be {error:.2e}");
        assert!(missed.abs() <= error, "{missed:e} {error:e}");
        let told = format!("is a corner at x = {s} no breakpoint");
        assert!(text.contains("uncertain by") && text.contains(&told), "{text}");
    }
    // Of a jump it may be seen that the pressure is infinite.
    for s in [0.0, 0.1, 1e-3] {
        let text = on_flat(power(1.0, s, [-1.0, 1.0])).solve(Control::Load(0.1)).unwrap();
        let text = text.to_string();
        let is_told = text.contains(&format!("is a corner at x = {s} no breakpoint"));
        assert!(is_told || text.contains(&format!("infinite at x = {s}\n")), "{text}");
    }
    // Halved often enough, panels may end at it, and each is smooth.
    for i in 0..100 {
        let load = Control::Load(0.01 * 1.03f64.powi(i));
        let found = on_flat(power(1.0, 0.0, [-1.0, 1.0])).solve(load).unwrap();
        let is_told = found.peak().is_err() || found.peak().unwrap().error > 0.1 * found.load();
        assert!(is_told, "{load:?}: {:?}", found.peak());
    }
    let (.., text) = peak_of(power(1.5, 0.1, [-1.0, 1.0]), 0.1);
    assert!(!text.contains("uncertain"), "{text}");
}

/// At a joint the slope is continuous, whatever the power: no pressure is infinite.
#[test]
fn the_peak_at_a_joint_of_low_powers_is_finite() {
    for (n, most) in [(1.02, 1.0), (1.05, 1e-6), (1.1, 1e-12)] {
        let exact = PowerLaw::new(1.0, n, 0.2).unwrap();
        let body = join(vec![power(n, 0.0, [-1.0, 0.0]), power(n, 0.0, [0.0, 1.0])]);
        let (value, error, _) = peak_of(body, exact.load(1.0));
        let missed = exact.pressure(0.0, 1.0) / value - 1.0;
        println!("{n}: {missed:.2e}, said to be {:.2e}", error / value);
        assert!(missed.abs() <= (error / value).max(1e-12) && error <= most * value, "{error:e}");
    }
}

#[test]
fn a_parabola_with_a_kink_as_one_curve() {
    // The slope x + m sign(x - s): with sin φ = (s - c)/L the moments of the sign are elementary,
    // m₀ = c - 2 m φ/π and m₁ = L/2 + 2 m cos φ/π. Both vanish, but for the load, at
    // φ = π c/(2 m), F = L m₁.
    let (m, c, l) = (0.2f64, 0.03, 0.4);
    let phi = PI * c / (2.0 * m);
    let s = c + l * phi.sin();
    let load = l * (l / 2.0 + 2.0 * m * phi.cos() / PI);
    let body =
        graph(-1.0, 1.0, move |x| [x * x / 2.0 + m * (x - s).abs(), x + m * (x - s).signum()]);
    let contact = Contact::new(&Flat, &*body).unwrap();
    let solution = contact.solve(Control::Load(load)).unwrap();
    assert_solved(&solution, Interval { left: c - l, right: c + l }, 1e-10, 1000);
    // Declared, the kink gives the same contact.
    let declared = join(vec![
        graph(-1.0, s, move |x| [x * x / 2.0 - m * (x - s), x - m]),
        graph(s, 1.0, move |x| [x * x / 2.0 + m * (x - s), x + m]),
    ]);
    let contact = Contact::new(&Flat, &*declared).unwrap();
    let declared = contact.solve(Control::Load(load)).unwrap();
    assert_solved(&declared, Interval { left: c - l, right: c + l }, 1e-14, 200);
    let [one, two] = [&solution, &declared].map(|solution| solution.pressure().unwrap());
    for i in -9..10 {
        let x = c + l * (0.1 * f64::from(i) + 0.033);
        let (one, two) = (one.at(x).unwrap(), two.at(x).unwrap());
        assert_relative_eq!(one, two, epsilon = 0.0, max_relative = 1e-9);
    }
}

/// V grooves and ridges of three kinks, which panels are cut around until they are as narrow as
/// rounding. (Between the last of them the slope fell unseen: tension was "checked".)
#[test]
fn grooves_and_ridges_of_kinks_as_one_curve() {
    let mut refused = 0;
    for seed in 0..60 {
        let dice = &mut Dice::new(300 + seed);
        let w = dice.within(0.013, 0.024);
        let slope = dice.within(0.01, 0.05) * if seed % 2 == 0 { 1.0 } else { -1.0 };
        let at = [0.0, dice.within(-0.075, 0.075), 0.03125, -0.05][seed as usize % 4];
        // Its side: before and behind it, on its left and on its right flank.
        let tooth = move |x: f64, side: f64| {
            let height = if side == 0.0 { 0.0 } else { slope * (w - (x - at).abs()) };
            [x * x / 20.0 + height, x / 10.0 + slope * side]
        };
        let solve = |body: &common::Profile| {
            let contact = Contact::new(&Flat, &**body).unwrap().contact_modulus(1e5);
            contact.solve(Control::Load(78.54)).map(|found| found.intervals().to_vec())
        };
        let parts =
            [(-1.0, at - w, 0.0), (at - w, at, 1.0), (at, at + w, -1.0), (at + w, 1.0, 0.0)];
        let part = |(from, to, side)| graph(from, to, move |x| tooth(x, side));
        let exact = solve(&join(parts.map(part).into())).unwrap();
        let whole = graph(-1.0, 1.0, move |x| {
            let is_on = (x - at).abs() < w;
            tooth(x, if is_on { -(x - at).signum() } else { 0.0 })
        });
        let Ok(found) = solve(&whole) else {
            refused += 1;
            continue;
        };
        assert_eq!(found.len(), exact.len(), "{seed}: {found:?} {exact:?}");
        for (one, other) in found.iter().zip(&exact) {
            let off = limits_off(*one, *other);
            assert!(off < 1e-4 * other.half_width(), "{seed}: {found:?} {exact:?}");
        }
    }
    assert!(refused <= 5, "{refused}");
}

#[test]
fn a_slope_like_a_square_root_as_one_curve() {
    // |x|^(3/2)/(3/2), its lowest point moved to 0.1.
    let want = reference("power_n_3_over_2");
    let s = 0.1;
    let contact = on_flat(graph(-2.0, 2.0, move |x| {
        let root = (x - s).abs().sqrt();
        [(x - s).abs() * root / 1.5, root * (x - s).signum()]
    }))
    .kappa(want.kappa);
    let solution = contact.solve(Control::Load(want.c / PI)).unwrap();
    assert_solved(&solution, Interval { left: s - want.b, right: s + want.a }, 1e-10, 5000);
    let pressure = solution.pressure().unwrap();
    let largest = want.points.iter().fold(0.0f64, |most, [_, p]| most.max(*p));
    for &[x, exact] in want.points.iter().filter(|[x, _]| want.z(*x).abs() < 0.99) {
        let got = pressure.estimate(s + x, &mut Cost::default()).unwrap();
        let error = (got.value - exact).abs();
        println!("z = {:9.1e}: error {error:.1e}, said to be {:.1e}", want.z(x), got.error);
        // At the breakpoint itself P has a cusp of infinite slope.
        let tolerance = if want.z(x).abs() < 1e-2 { 1e-5 } else { 1e-9 };
        assert!(error <= tolerance * largest, "P({x}): off by {error:e}");
    }
}

#[test]
fn an_end_like_a_square_root() {
    // A parabola whose right half goes over into a vertical tangent just outside the contact: slope
    // x + h(x) with h of a square-root end at x = e.
    let e = 0.301;
    let slope = move |x: f64| x + 0.01 * (1.0 - (1.0 - (x / e).min(1.0)).sqrt());
    let primitive = move |x: f64| {
        let rest = 1.0 - (x / e).min(1.0);
        x * x / 2.0 + 0.01 * (x + e * 2.0 / 3.0 * (rest * rest.sqrt() - 1.0))
    };
    let contact = on_flat(graph(-0.6, e, move |x| [primitive(x), slope(x)]));
    // The contact whose right limit is 0.3; its left limit by bisection on the mean slope, by
    // Gauss's rule in θ, in which the slope is periodic and, short of e, analytic.
    let moments = |on: Interval<f64>| edge_integrals(on, slope);
    let (mut lo, mut hi) = (-0.4, -0.2);
    for _ in 0..60 {
        let left = 0.5 * (lo + hi);
        // The mean slope rises with the left limit.
        if moments(Interval { left, right: 0.3 })[0] < 0.0 { lo = left } else { hi = left }
    }
    let on = Interval { left: lo, right: 0.3 };
    let load = on.half_width() * moments(on)[1];
    let solution = contact.solve(Control::Load(load)).unwrap();
    assert_solved(&solution, on, 1e-10, 3000);
}

#[test]
fn parameters_that_run_unevenly() {
    // A circle by its angle, by sinh, by a cube: the same contact.
    let curve = |steep: f64| {
        let scale = 1.4 / steep.sinh();
        Curve::new([-1.0, 1.0], move |k: f64| {
            let (angle, rate) = (scale * (steep * k).sinh(), scale * steep * (steep * k).cosh());
            let (sin, cos) = angle.sin_cos();
            CurvePoint { x: sin, y: 1.0 - cos, dx: cos * rate, dy: sin * rate }
        })
    };
    // L₁ of the circle: m₁ = (1/π) ∫ L cos²θ/sqrt(1 - L² cos²θ) dθ, by the midpoint rule.
    let l = 0.4f64;
    let first = (0..200).map(|i| {
        let x = l * (PI * (f64::from(i) + 0.5) / 200.0).cos();
        x * x / l / (1.0 - x * x).sqrt() / 200.0
    });
    let load = l * first.sum::<f64>();
    for (steep, most) in [(1e-3, 80), (1.0, 80), (3.0, 200), (10.0, 400), (40.0, 2000)] {
        let body = curve(steep);
        let contact = Contact::new(&Flat, &body).unwrap();
        let solution = contact.solve(Control::Load(load)).unwrap();
        assert_solved(&solution, Interval { left: -l, right: l }, 1e-13, most);
    }
}

/// The contact sampled first ends next to the kink, beyond its last node; the kink shows only
/// against the samples next to it.
#[test]
fn a_kink_at_the_seam_to_what_is_sampled_later() {
    for (steep, at) in [0.5, 5.0, 500.0].into_iter().flat_map(|s| [(s, 0.7525), (s, 0.7475)]) {
        let point = move |x: f64| {
            let beyond = (x - at).max(0.0);
            let y = 0.5 * (x * x + steep * beyond * beyond);
            CurvePoint { x, y, dx: 1.0, dy: x + steep * beyond }
        };
        let whole = Curve::new([-4.0, 4.0], point);
        let parts = [Curve::new([-4.0, at], point), Curve::new([at, 4.0], point)];
        let parts = Piecewise::new(parts.into()).unwrap();
        for start in [0.3, 2.0] {
            let solve = |body: &dyn ParametricProfile<f64>| {
                let contact = Contact::new(&Flat, body).unwrap();
                let contact = contact.start(Interval { left: -start, right: start });
                let solution = contact.solve(Control::Load(0.3)).unwrap();
                (solution.hull(), solution.limits_error().unwrap())
            };
            let ((got, error), (want, _)) = (solve(&whole), solve(&parts));
            let off = limits_off(got, want);
            assert!(off <= error + 1e-14, "{steep} {at} {start}: off {off:e}, said {error:e}");
        }
    }
}

#[test]
fn a_tip_far_narrower_than_a_panel_beside_a_breakpoint() {
    // The slope x + A (1 - exp(-x/ε)) on the right, x - A on the left. With θ₀ the angle of the
    // breakpoint, cos θ₀ = -c/L, the balance π m₀ = 0 is that of a wedge on a parabola, less the
    // integral of A exp(-x/ε)/sqrt((x + b)(a - x)).
    let steep = 0.3;
    for tip in [1e-3, 1e-5, 1e-7] {
        let contact = on_flat(join(vec![
            graph(-1.0, 0.0, move |x| [x * x / 2.0 - steep * x, x - steep]),
            graph(0.0, 1.0, move |x| {
                let rest = (-x / tip).exp_m1();
                [x * x / 2.0 + steep * (x + tip * rest), x - steep * rest]
            }),
        ]));
        let solution = contact.solve(Control::HalfWidth(0.4)).unwrap();
        let (on, error) = (solution.hull(), solution.limits_error().unwrap());
        let (a, b, c) = (on.right, -on.left, on.centre());
        // Simpson's rule in x/ε.
        let (n, step) = (4000, 0.01);
        let lost: f64 = (0..=n)
            .map(|i| {
                let (t, ends) = (step * f64::from(i), i == 0 || i == n);
                let weight = if ends { 1.0 } else { 2.0 + 2.0 * f64::from(i % 2) };
                let x = tip * t;
                weight * (-t).exp() / ((x + b) * (a - x)).sqrt()
            })
            .sum();
        let lost = steep * tip * lost * step / 3.0;
        let balance = PI * c + steep * (2.0 * (-c / 0.4).acos() - PI) - lost;
        // A step in c changes the balance by π and more.
        println!("{tip:e}: c = {c:e}, {balance:e}, error {error:e}, {:?}", solution.cost());
        assert!(balance.abs() < 1e-13, "{tip}: {balance:e}");
        assert!(solution.cost().evaluations < 1000);
    }
}

/// `x²/2 + ε cos ωx`: L²/2 - ε ω L J₁(ω L) = F. The half-widths are roots of this equation, by
/// mpmath in 40 digits. Samples at a few nodes of a panel look like noise, in both halves of it
/// alike.
#[test]
fn waves_far_shorter_than_a_panel() {
    for (epsilon, omega, l, most) in [
        (5e-5, 200.0, 0.977_127_199_697_351, 6000),
        (2.5e-5, 400.0, 0.977_444_724_143_534_1, 8000),
        (1e-5, 200.0, 0.977_190_900_869_927_6, 6000),
        (1e-10, 100.0, 0.977_205_024_157_236_3, 3000),
    ] {
        let contact = on_flat(graph(-4.0, 4.0, move |x: f64| {
            let (sin, cos) = (omega * x).sin_cos();
            [x * x / 2.0 + epsilon * cos, x - epsilon * omega * sin]
        }));
        let solution = contact.solve(Control::Load(1.5 / PI)).unwrap();
        assert_solved(&solution, Interval { left: -l, right: l }, 2e-14, most);
        assert!(solution.certify().is_ok());
    }
}

/// Hertz's parabola, all but a millionth of which has its left end within two ulps of X = -1: the
/// searched range may end in a sliver there.
#[test]
fn a_sliver_at_the_end_of_a_body() {
    let body = Curve::new([-30.0, 30.0], |k: f64| {
        let (x, dx) = (k.exp() - 1.0, k.exp());
        CurvePoint { x, y: x * x / 2.0, dx, dy: x * dx }
    });
    let contact = Contact::new(&Flat, &body).unwrap();
    for load in [0.1, 1.5 / PI, 0.49, 0.499] {
        let l = (2.0 * load).sqrt();
        let solution = contact.solve(Control::Load(load)).unwrap();
        assert_solved(&solution, Interval { left: -l, right: l }, 1e-13, 1000);
    }
}

/// A kink between the last nodes of two panels shows only at their joint. The kink that a loose
/// tolerance lets pass there is in the estimate of the pressure. Declared, and at full accuracy, it
/// is resolved.
#[test]
fn a_kink_between_two_panels_that_a_loose_tolerance_lets_pass() {
    let tolerance = Panels { tolerance: 3e-7 };
    for i in 0..400 {
        let s = 0.41 + 1.37e-4 * f64::from(i);
        let smooth = |x: f64| [x * x / 2.0 - 0.45 * x, x - 0.45];
        let kinked = move |x: f64| {
            let ([y, dy], more) = (smooth(x), x - s);
            [y + 0.8 * more * more, dy + 1.6 * more]
        };
        let body = graph(-4.0, 4.0, move |x| if x > s { kinked(x) } else { smooth(x) });
        let declared = join(vec![graph(-4.0, s, smooth), graph(s, 4.0, kinked)]);
        let contact = Contact::new(&Flat, &*body).unwrap().quadrature(&tolerance);
        let known = Contact::new(&Flat, &*declared).unwrap();
        let [got, known] =
            [contact, known].map(|contact| contact.solve(Control::Load(0.006)).unwrap());
        let [got, known] = [&got, &known].map(|solution| solution.pressure().unwrap());
        for x in [0.42, 0.44, 0.452, 0.47, 0.49] {
            let due = known.at(x).unwrap();
            let estimate = got.estimate(x, &mut Cost::default()).unwrap();
            let off = (estimate.value - due).abs();
            assert!(off <= 3.0 * estimate.error + 2e-12 * due, "{s} {x}: {off:e}, {estimate:?}");
        }
    }
}
