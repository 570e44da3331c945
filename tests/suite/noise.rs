//! Rounding of formulas: slopes with noise, and heights that consist of rounding.
#![allow(missing_docs)]

use crate::common::{NanSafe, gear, graph, on_flat};
use linecontact::{Contact, Control, Cost, Curve, CurvePoint, Flat, Interval};
use std::f64::consts::PI;

/// Returns a number between -1 and 1, random but the same for the same k.
fn hash(k: f64) -> f64 {
    let mut bits = k.to_bits().wrapping_mul(0x9E37_79B9_7F4A_7C15);
    bits = (bits ^ (bits >> 32)).wrapping_mul(0xD6E8_FEB8_6659_FD93);
    bits ^= bits >> 32;
    (bits >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// Solves parabolas with noisy slopes, at 40 levels a decade: the cost of one of them, and the
/// ratio of its error to its estimate, are a matter of luck.
fn check_noise(powers: std::ops::Range<i32>) {
    let l = 0.4;
    let levels = powers.clone().flat_map(|power| {
        (0..40).map(move |part| 10f64.powf(f64::from(power) + f64::from(part) / 40.0))
    });
    let (mut count, mut evaluations, mut most, mut beyond) = (0, 0, 0, 0);
    for noise in levels {
        let contact = on_flat(graph(-1.0, 1.0, move |x| [x * x / 2.0, x + noise * hash(x)]));
        let solution = contact.solve(Control::Load(l * l / 2.0)).unwrap();
        let (on, cost) = (solution.hull(), solution.cost());
        let error = (on.left + l).abs().nan_max((on.right - l).abs()) / l;
        let estimate = solution.limits_error().unwrap();
        assert!(error <= 10.0 * noise / l, "noise {noise:e}: {on:?}");
        assert!(estimate >= 0.1 * noise / l && estimate <= 100.0 * noise / l, "{estimate:e}");
        assert!(error <= 2.0 * estimate, "error {error:e}, said to be {estimate:e}");
        beyond += usize::from(error > estimate);
        count += 1;
        evaluations += cost.evaluations;
        most = most.max(cost.evaluations);
        let pressure = solution.pressure().unwrap();
        for i in -9..10 {
            let x = 0.1 * f64::from(i) * l;
            let exact = (l * l - x * x).sqrt() / PI;
            let got = pressure.estimate(x, &mut Cost::default()).unwrap();
            let error = (got.value - exact).abs();
            assert!(error <= 20.0 * noise, "noise {noise:e}: P({x}) is off by {error:e}");
            // The noise is known from a few coefficients only.
            assert!(error <= 4.0 * got.error, "P({x}): {error:e}, said to be {:e}", got.error);
        }
    }
    println!(
        "{powers:?}: {evaluations} of {count}, at most {most}; {beyond} beyond their estimate"
    );
    assert!(evaluations <= 1200 * count && most <= 10_000, "{evaluations} of {count}, {most}");
    assert!(50 * beyond <= count, "{beyond} of {count}");
}

#[test]
fn a_little_noise_is_seen_reported_and_not_followed() {
    check_noise(-13..-8);
}

#[test]
fn much_noise_is_seen_reported_and_not_followed() {
    check_noise(-8..-3);
}

/// Three crests of a fine wave, far from the origin: the rounding of x changes the slope by far
/// more than the tolerance of the panels.
#[test]
fn rounding_of_x_is_not_taken_for_a_feature() {
    let wave = 1600.0 * PI;
    let costs: Vec<usize> = (100..400)
        .map(|crest| {
            let top = 2.0 * PI * f64::from(crest) / wave;
            let around = [top - 9.0 / wave, top + 9.0 / wave];
            let body = graph(around[0], around[1], move |x| {
                [-0.3 * (wave * x).cos() / wave, 0.3 * (wave * x).sin()]
            });
            let cost = on_flat(body).solve(Control::Load(3e-5)).unwrap().cost();
            cost.evaluations + cost.heights
        })
        .collect();
    let [least, most] = [costs.iter().min(), costs.iter().max()].map(Option::unwrap);
    println!("{least} to {most} evaluations");
    assert!(*most <= least + least / 4, "{least} to {most}");
}

/// Solves the circle of radius 1 under F = L²/2, where its height `1 - cos k` keeps few digits or
/// none; the slope keeps all digits, and decides.
fn touch_lightly<T: linecontact::Real>(half_widths: &[f64], tolerance: f64) {
    let circle = Curve::new([-T::one(), T::one()], |k: T| {
        let (sin, cos) = k.sin_cos();
        CurvePoint { x: sin, y: T::one() - cos, dx: cos, dy: sin }
    });
    let contact = Contact::new(&Flat, &circle).unwrap();
    for &half_width in half_widths {
        let l = T::of(half_width);
        let solution = contact.solve(Control::Load(l * l * T::of(0.5)));
        let solution = solution.unwrap_or_else(|error| panic!("L = {half_width:e}: {error}"));
        // F = L²/2 (1 + 3 L²/8 + ...).
        let close = T::of(tolerance + half_width * half_width);
        for limit in [solution.a(), solution.b()] {
            assert!((limit / l - T::one()).abs() <= close, "{limit} is not {half_width:e}");
        }
    }
}

#[test]
fn a_circle_whose_height_has_few_digits_or_none() {
    touch_lightly::<f64>(&[1e-3, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-12], 1e-14);
    let single = [1e-1, 1e-2, 2e-3, 1e-3, 7.5e-4, 5e-4, 2e-4, 1e-4, 1e-5, 1e-6];
    touch_lightly::<f32>(&single, 1e-5);
}

/// The terms of X are a thousand times larger than the contact: coefficients fall fast and level
/// off.
#[test]
fn the_rounding_of_involutes_is_not_followed_from_any_start() {
    let (pinion, wheel) = (gear(37.5e-3, -1.0), gear(112.5e-3, 1.0));
    let contact = Contact::new(&*pinion, &*wheel).unwrap().contact_modulus(113.187e9);
    for half_width in [2e-4, 2.4e-4, 2.9e-4, 3.06e-4, 4e-4, 1e-3, 2e-3] {
        for aside in [8.2e-8, 3e-7] {
            let start = Interval { left: aside - half_width, right: aside + half_width };
            let contact = contact.clone().start(start).single_interval(true);
            let solution = contact.solve(Control::Load(1571e3 / PI)).unwrap();
            let (evaluations, error) = (solution.cost().evaluations, solution.limits_error());
            assert!(evaluations <= 100, "{half_width:e} {aside:e}: {evaluations}");
            assert!(error.unwrap() <= 2e-14, "{half_width:e} {aside:e}: {error:?}");
            assert!((solution.a() / 2.3773942151913456e-4 - 1.0).abs() < 1e-13);
        }
    }
}

/// As in a row of uniform places from -b to a, the last of which may be an ulp inside.
#[test]
fn a_pressure_at_a_limit_but_for_rounding_is_a_number() {
    let (pinion, wheel) = (gear(37.5e-3, -1.0), gear(112.5e-3, 1.0));
    let contact = Contact::new(&*pinion, &*wheel).unwrap().contact_modulus(113.187e9);
    let solution = contact.solve(Control::Load(1571e3 / PI)).unwrap();
    let (on, pressure) = (solution.hull(), solution.pressure().unwrap());
    let peak = solution.peak().unwrap().pressure;
    for x in [on.left, on.left.next_up(), on.right.next_down(), on.right] {
        let value = pressure.at(x).unwrap();
        assert!((0.0..1e-6 * peak).contains(&value), "{x:e}: {value:e}");
    }
}
