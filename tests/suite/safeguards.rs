//! Rules needed by few scenes only: for each rule, scenes that fail without it.
#![allow(missing_docs)]

use crate::common;

use crate::integrals::edge_integrals;
use common::{Counting, Profile, graph, join, limits_off, on_flat, quartic};
use linecontact::search::Brent;
use linecontact::{
    Contact, Control, Curve, CurvePoint, Edge, Flat, Interval, Panels, Piecewise, Solver,
};
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::atomic::{AtomicUsize, Ordering};

const UNIT: Interval<f64> = Interval { left: -1.0, right: 1.0 };

/// Returns contacts of half-width l around x₀ on a step of the slope, `tanh((t - t₀)/w) + t/100`
/// over t = (x - x₀)/l: the body, the load and the contact. The bodies extend to ±4 and have a
/// breakpoint at t₁ across which the curve is smooth.
fn steps_with_a_seam() -> Vec<(Profile, f64, Interval<f64>)> {
    let mut scenes = Vec::new();
    for (w, t0, t1) in [(0.14, 0.8, -0.3), (0.16, -0.5, 0.8), (0.16, 0.6, -0.7), (0.18, 0.8, -0.7)]
    {
        let rise = move |t: f64| ((t - t0) / w).tanh() + 0.01 * t;
        let [mean, first] = edge_integrals(UNIT, rise);
        for x0 in [0.0, 0.3, 0.7] {
            for l in [1e-2, 3e-3, 1e-3, 3e-4, 1e-4] {
                let at = move |x: f64| {
                    let t = (x - x0) / l;
                    let u = ((t - t0) / w).abs();
                    let step = w * (u + (-2.0 * u).exp().ln_1p());
                    [l * (step + 0.005 * t * t - mean * t), rise(t) - mean]
                };
                let seam = x0 + t1 * l;
                let body = join(vec![graph(-4.0, seam, at), graph(seam, 4.0, at)]);
                scenes.push((body, l * first, Interval { left: x0 - l, right: x0 + l }));
            }
        }
    }
    scenes
}

/// Samples around a poor guess are too coarse for a much narrower contact: the search is repeated
/// on samples around that contact. (Seeds 721, 2573, 3266, 3942 and 5772.)
#[test]
fn a_contact_much_narrower_than_the_guess_that_was_sampled() {
    for (body, load, on) in steps_with_a_seam() {
        let contact = on_flat(body).single_interval(true);
        let solution = contact.solve(Control::Load(load)).unwrap();
        let (off, estimate) = (limits_off(solution.hull(), on), solution.limits_error().unwrap());
        assert!(off <= 3.0 * estimate + 1e-14, "{on:?}: {off:e}, {estimate:e}");
    }
}

/// Narrower contacts by a search of one limit at a time. (Seeds 1477 and 3981.)
#[test]
fn a_contact_much_narrower_than_the_trials_of_a_nested_search() {
    let brent = Brent::default();
    for (body, load, on) in steps_with_a_seam() {
        let contact = on_flat(body).single_interval(true).limit_search(&brent);
        let solution = contact.solve(Control::Load(load)).unwrap();
        let (off, estimate) = (limits_off(solution.hull(), on), solution.limits_error().unwrap());
        assert!(off <= 3.0 * estimate + 1e-13, "{on:?}: {off:e}, {estimate:e}");
    }
}

/// The slope of the gap jumps down by j at z, inside the contact of a parabola with half-width 1.
/// However small the jump, the pressure goes to minus infinity there: the bodies part, by a gap
/// that holds no node of a panel. Next to the jump, `P = (j/π²) ln(2 |t|/δ)` between the two
/// contacts around a gap of half-width δ, and in one contact
///
/// ```text
/// P = sin φ/π - (j/π²) ln|sin((θ + φ)/2)/sin((θ - φ)/2)|     x = cos φ, z = cos θ
/// ```
///
/// so that `δ = 4 sin² θ exp(-π sin θ/j)`, to a share of about δ². (Seeds 1158 and 2468.)
#[test]
fn the_bodies_part_at_any_jump_down_of_the_slope() {
    for jump in [0.12, 0.15, 0.2, 0.25, 0.3] {
        for z in [-0.7f64, -0.5, -0.3, 0.1, 0.3, 0.55, 0.8] {
            let (theta, sin) = (z.acos(), (1.0 - z * z).sqrt());
            let tilt = jump * theta / PI;
            let at =
                move |x: f64, less: f64| [x * x / 2.0 + tilt * x - less * (x - z), x + tilt - less];
            let body = join(vec![
                graph(-4.0, z, move |x| at(x, 0.0)),
                graph(z, 4.0, move |x| at(x, jump)),
            ]);
            let solution = on_flat(body).solve(Control::Load(0.5 - jump * sin / PI)).unwrap();
            let &[left, right] = solution.intervals() else {
                panic!("{jump} {z}: {:?}", solution.intervals())
            };
            assert!(left.right < z && z < right.left, "{jump} {z}: {left:?} {right:?}");
            let gap = 4.0 * sin * sin * (-PI * sin / jump).exp();
            let off = ((right.left - left.right) / (2.0 * gap) - 1.0).abs();
            // Limits are rounded.
            let allowed = 200.0 * gap * gap + 1e-16 / gap;
            assert!(off <= allowed + 1e-8, "{jump} {z}: {gap:e} off by {off:e}");
        }
    }
}

/// A wave on both bodies, which have different parameters: it is not in the gap `cosh(q x)/q²`,
/// which few nodes resolve. But no node lies at a point where the bodies were evaluated, and
/// between these points the wave matters. (Seed 4081.)
#[test]
fn a_wave_on_both_bodies_between_the_points_that_were_sampled() {
    for k in [0.6, 0.8, 1.0, 1.5, 2.5] {
        let body = |parameter: fn(f64) -> [f64; 2], q: f64| {
            Curve::new([-2.0, 2.0], move |p: f64| {
                let [x, dx] = parameter(p);
                let (sin, cos) = (k * x).sin_cos();
                let [y, slope] =
                    if q > 0.0 { [(q * x).cosh() / (q * q), (q * x).sinh() / q] } else { [0.0; 2] };
                CurvePoint { x, y: y - cos / k, dx, dy: (slope + sin) * dx }
            })
        };
        let lower = body(|p| [p.sinh(), p.cosh()], 0.0);
        for (q, l) in [(0.1, 1.0), (0.15, 0.5), (0.2, 1.2), (0.3, 0.3), (0.7, 0.6)] {
            let upper = body(|p| [-p, -1.0], q);
            let [_, first] = edge_integrals(UNIT, |t| (q * l * t).sinh() / q);
            for tolerance in [0.0, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4] {
                let rule = Panels { tolerance };
                let contact = Contact::new(&lower, &upper).unwrap().quadrature(&rule);
                let solution = contact.solve(Control::Load(l * first)).unwrap();
                let off = limits_off(solution.hull(), Interval { left: -l, right: l });
                let estimate = solution.limits_error().unwrap();
                assert!(
                    off <= 3.0 * estimate + 1e-14,
                    "{k} {q} {l} {tolerance:e}: {off:e}, {estimate:e}"
                );
            }
        }
    }
}

/// The slope `x - x³/100`, and j more beyond ±x₁. Newton's method comes from a lower load, on the
/// near side, where each step is the square of the one before; the last step goes a little beyond
/// x₁, where the body is far stiffer.
#[test]
fn a_last_step_across_a_jump_of_the_slope() {
    let (x1, bend) = (0.5, 0.01);
    for (jump, beyond) in [(0.01, 1e-12), (0.01, 1e-11), (0.1, 1e-13), (0.03, 1e-12)] {
        let smooth = move |x: f64| [x * x / 2.0 - bend * x.powi(4) / 4.0, x - bend * x.powi(3)];
        let steep = move |x: f64| {
            let [y, dy] = smooth(x);
            [y + jump * (x.abs() - x1), dy + jump.copysign(x)]
        };
        let pieces = [graph(-2.0, -x1, steep), graph(-x1, x1, smooth), graph(x1, 2.0, steep)];
        let contact = on_flat(join(pieces.into()));
        let load = |l: f64| {
            let sin = (l - x1).max(0.0).sqrt() * (l + x1).sqrt() / l;
            l * (l / 2.0 - 0.375 * bend * l.powi(3) + 2.0 * jump * sin / PI)
        };
        let l = x1 * (1.0 + beyond);
        for short in [3e-4, 1e-3, 2e-3, 3e-3, 5e-3, 1e-2, 3e-2] {
            let mut solver = Solver::new();
            solver.solve(&contact, Control::Load(load(l * (1.0 - short)))).unwrap();
            let solution = solver.solve(&contact, Control::Load(load(l))).unwrap();
            let off = limits_off(solution.hull(), Interval { left: -l, right: l });
            let estimate = solution.limits_error().unwrap();
            assert!(off <= estimate + 1e-14, "{jump} {beyond} {short}: {off:e}, {estimate:e}");
        }
    }
}

/// The quartic `x⁴ - 2x²` touches between `1 - d/2` and `1 + d/2` of x², `d² = 4 F/(π E*)`, with
/// `P = 2 E* |x| sqrt((x² - α²)(β² - x²))`. Cells reach corners slightly beyond these limits; held
/// there, the contacts would be in tension.
#[test]
fn a_corner_lets_go_of_two_contacts_that_it_would_pull_at() {
    let body = quartic(-3.0, 3.0);
    let contact = Contact::new(&Flat, &*body).unwrap().kappa(FRAC_PI_2);
    for load in [0.01, 0.3, 1.0, 3.0] {
        let d = f64::sqrt(4.0 * load / PI);
        let [inner, outer] = [(1.0 - d / 2.0).sqrt(), (1.0 + d / 2.0).sqrt()];
        let width = outer - inner;
        for beyond in [1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 1e-2] {
            let corner = outer + beyond * width;
            for left in [Edge::FreeUntil(-corner), Edge::Free] {
                let contact = contact.clone().edges(left, Edge::FreeUntil(corner));
                // From scratch, and from contacts held by the corner.
                for more in [None, Some(1.02)] {
                    let mut solver = Solver::new();
                    if let Some(more) = more {
                        let held = solver.solve(&contact, Control::Load(more * load)).unwrap();
                        assert!(beyond > 1e-3 || held.hull().right == corner);
                    }
                    let solution = solver.solve(&contact, Control::Load(load)).unwrap();
                    let found = solution.intervals().iter().flat_map(|on| [on.left, on.right]);
                    let found: Vec<f64> = found.collect();
                    let &[a, b, c, e] = &found[..] else { panic!("{load} {beyond}: {found:?}") };
                    for (found, known) in [(a, -outer), (b, -inner), (c, inner), (e, outer)] {
                        let off = (found - known).abs() / width;
                        assert!(off < 1e-12, "{load} {beyond} {more:?}: {known} off by {off:e}");
                    }
                    let pressure = solution.pressure().unwrap();
                    for share in [0.01f64, 0.5, 0.99, 0.9999] {
                        let x = inner + share * width;
                        let root = (x * x - inner * inner) * (outer * outer - x * x);
                        let known = 2.0 * x * root.sqrt();
                        let off = (pressure.at(x).unwrap() / known - 1.0).abs();
                        assert!(off < 1e-10, "{load} {beyond} {x}: off by {off:e}");
                    }
                }
            }
        }
    }
}

/// A parabola with a kink inside the contact, to the right of which it is 2 000 times as stiff; the
/// search starts from the middle of far wider bodies. The load of the first trials is not
/// proportional to the square of the half-width: steps that assume it overshoot, and the search has
/// to sample again and again. (Seed 5194.)
#[test]
fn calls_for_a_contact_far_narrower_than_bodies_of_unlike_stiffness() {
    let stiff = 2048.0;
    for bend in [0.05, 0.2, 1.0] {
        for (x0, l) in [(-0.7, 0.01), (-0.3, 1e-4), (0.0, 1e-4), (0.2, 0.01), (0.5, 1e-4)] {
            for z in [-0.9f64, -0.23, 0.2, 0.7] {
                // A ramp `k (t - z)` has the integrals k (sin θ - z θ)/π and k (θ - z sin θ)/(2π).
                let (theta, sin) = (z.acos(), (1.0 - z * z).sqrt());
                let mean = stiff * (sin - theta * z) / PI;
                let first = bend / 2.0 + stiff * (theta - sin * z) / (2.0 * PI);
                let at = move |x: f64, stiff: f64| {
                    let (t, u) = ((x - x0) / l, (x - x0) / l - z);
                    let y = bend * t * t / 2.0 - mean * t + stiff * u * u / 2.0;
                    [l * l * y, l * (bend * t - mean + stiff * u)]
                };
                let (kink, calls) = (x0 + l * z, AtomicUsize::new(0));
                let pieces = [
                    graph(-4.0, kink, move |x| at(x, 0.0)),
                    graph(kink, 4.5, move |x| at(x, stiff)),
                ];
                let body = Piecewise::new(pieces.map(|piece| Counting(piece, &calls)).into());
                let body = body.unwrap();
                let contact = Contact::new(&Flat, &body).unwrap().single_interval(true);
                calls.store(0, Ordering::Relaxed);
                let solution = contact.solve(Control::Load(l * l * first)).unwrap();
                let off = limits_off(solution.hull(), Interval { left: x0 - l, right: x0 + l });
                assert!(off < 1e-10, "{bend} {x0} {l} {z}: off by {off:e}");
                let calls = calls.load(Ordering::Relaxed);
                assert!(calls <= 44, "{bend} {x0} {l} {z}: {calls} calls");
            }
        }
    }
}

/// A contact a millionth as wide as the bodies, just next to a step of the slope ten times as
/// narrow. Newton's method gets there, but each of its long steps takes samples of bodies as steep
/// as exponentials: a start at first touch is better. (Seed 3735.)
#[test]
fn calls_for_a_contact_beside_a_narrow_step() {
    let calls = AtomicUsize::new(0);
    for (c, k, q, x0, single) in [
        (0.1155, 5.0, 1.0, 0.2087, true),
        (0.1155, 5.58, 1.7, 0.2087, false),
        (0.1155, 1.0, 1.7, -0.3, true),
        (0.1155, 5.58, 1.7, -0.3, false),
        (1.0, 1.0, 3.0, 0.2087, true),
        (1.0, 1.0, 1.7, 0.2087, true),
    ] {
        let (l, w, t0) = (1e-6, 0.1, 1.2);
        let steep = k * f64::exp(q * x0);
        let rise = move |t: f64| c * ((t - t0) / w).tanh() + steep * (q * l * t).exp_m1();
        let [mean, first] = edge_integrals(UNIT, rise);
        let at = move |x: f64| {
            let t = (x - x0) / l;
            let u = ((t - t0) / w).abs();
            let step = c * w * (u + (-2.0 * u).exp().ln_1p());
            [l * (step - (mean + steep) * t) + steep / q * (q * l * t).exp_m1(), rise(t) - mean]
        };
        let body = Counting(graph(-4.8, 5.0, at), &calls);
        let contact = Contact::new(&Flat, &body).unwrap().single_interval(single);
        let solution = contact.solve(Control::Load(l * first)).unwrap();
        let off = limits_off(solution.hull(), Interval { left: x0 - l, right: x0 + l });
        assert!(off < 1e-9, "{c} {k} {x0}: off by {off:e}");
    }
    let calls = calls.load(Ordering::Relaxed);
    assert!(calls < 23_000, "{calls} calls");
}

/// A parabola whose slope jumps at 0.5, with a limit beyond the jump by a share of 3e-17 to 3e-9:
/// Newton's steps cross the jump to and fro unless growing steps are halved, however short they
/// are; the last step may end on the jump. Closed form: each jump adds the pressure j sin θ/π, at
/// cos θ = 0.5/L.
#[test]
fn a_limit_just_beyond_a_jump_of_the_slope() {
    const JUMP_AT: f64 = 0.5;
    for (jump, is_on_both) in [0.01, 0.1, 10.0].into_iter().flat_map(|j| [(j, false), (j, true)]) {
        let mut refused = 0;
        for i in 0..200 {
            let beyond = 10f64.powf(-16.5 + 0.04 * f64::from(i));
            let half_width: f64 = JUMP_AT * (1.0 + beyond);
            let sin = ((half_width - JUMP_AT) * (half_width + JUMP_AT)).sqrt() / half_width;
            let (jumps, turn) = if is_on_both { (2.0, 0.0) } else { (1.0, jump * sin.asin() / PI) };
            let load = half_width * (half_width / 2.0 + jumps * jump * sin / PI);
            let at = move |x: f64, j: f64| {
                [x * x / 2.0 - turn * x + j * (x.abs() - JUMP_AT), x - turn + j * x.signum()]
            };
            let left = if is_on_both { jump } else { 0.0 };
            let body = join(vec![
                graph(-2.0, -JUMP_AT, move |x| at(x, left)),
                graph(-JUMP_AT, JUMP_AT, move |x| at(x, 0.0)),
                graph(JUMP_AT, 2.0, move |x| at(x, jump)),
            ]);
            let contact = on_flat(body);
            let Ok(solution) = contact.solve(Control::Load(load)) else {
                refused += 1;
                continue;
            };
            let off =
                limits_off(solution.hull(), Interval { left: -half_width, right: half_width });
            let estimate = solution.limits_error().unwrap();
            assert!(off <= estimate + 1e-15, "{jump} {is_on_both} {beyond}: {off} {estimate}");
        }
        // Next to a larger jump an ulp of the limit is a hundred-millionth of the load and more:
        // limits within some tens of ulps of the jump are refused.
        assert!(refused == 0 || jump > 1.0, "{jump} {is_on_both}: {refused} refused");
    }
}

/// The kink of a wedge far from the origin is next to a limit, and the outermost of the places that
/// resolve its pressures rounded onto the limit: the gap there was no number.
#[test]
fn no_place_of_a_pressure_rounds_onto_a_limit() {
    // Slopes of both flanks, the place of the kink, and the load.
    let scenes = [(-0.1, 0.3, 1.11e9, 1e-3), (-0.02, 0.7, 3e8, 1e-3), (-0.6, 0.05, 1e9, 1e-2)];
    for (left, right, at, load) in scenes {
        let wedge = |at: f64| {
            let flank = |slope: f64, on: [f64; 2]| -> Profile {
                let point =
                    move |k: f64| CurvePoint { x: at + k, y: slope * k, dx: 1.0, dy: slope };
                Box::new(Curve::new(on, point))
            };
            join(vec![flank(left, [-1.0, 0.0]), flank(right, [0.0, 1.0])])
        };
        let hull = |body: Profile| on_flat(body).solve(Control::Load(load)).unwrap().hull();
        let [here, there] = [0.0, at].map(|at| hull(wedge(at)));
        let moved = Interval { left: there.left - at, right: there.right - at };
        let rounding = 4.0 * f64::EPSILON * at / here.half_width();
        assert!(limits_off(moved, here) < rounding, "{at}: {moved:?} for {here:?}");
    }
}
