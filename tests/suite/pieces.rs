//! Bodies of pieces: their breakpoints, and the cost of very many pieces.
#![allow(missing_docs)]

use crate::common::{Profile, graph, join, on_flat, parabola};
use crate::undeclared::assert_solved;
use approx::assert_relative_eq;
use linecontact::profile::{Fit, Spline};
use linecontact::reference::{ClosedForm, Ellipse};
use linecontact::{Contact, Control, Curve, CurvePoint, Flat, Interval, Midpoint, Piecewise};
use std::f64::consts::PI;

/// Returns unevenly spaced breakpoints from -1 to 1.
fn breakpoints(pieces: u32) -> Vec<f64> {
    let place = |i: u32| {
        let z = 2.0 * f64::from(i) / f64::from(pieces) - 1.0;
        z - 0.15 * (PI * z).sin()
            + 0.3 / f64::from(pieces) * (2.3 * f64::from(i)).sin() * (1.0 - z * z)
    };
    (0..=pieces).map(place).collect()
}

/// Returns points from 1e-9 half-widths from an edge to the middle, and next to breakpoints.
fn points(half_width: f64, breakpoints: &[f64]) -> Vec<f64> {
    let mut points = Vec::new();
    for i in 1..60 {
        let inward = 10f64.powf(-9.0 * f64::from(i) / 60.0);
        points.extend([(inward - 1.0) * half_width, (1.0 - inward) * half_width]);
    }
    let inside = breakpoints.iter().filter(|breakpoint| breakpoint.abs() < 0.99 * half_width);
    points.extend(inside.step_by(31).flat_map(|breakpoint| [breakpoint - 1e-7, breakpoint + 3e-5]));
    points
}

/// Breakpoints must not show: the closed form of a circle has none.
#[test]
fn a_circle_in_thousands_of_arcs() {
    let (form, shift) = (Ellipse::circle(1.0, 0.3).unwrap(), 2.0);
    let breakpoints: Vec<f64> = breakpoints(3000).iter().map(|z| 1.2 * z).collect();
    let arc = |ends: &[f64]| {
        Curve::new([ends[0], ends[1]], move |k: f64| {
            let (sin, cos) = k.sin_cos();
            let y = 2.0 * (0.5 * k).sin().powi(2);
            CurvePoint { x: shift + sin, y, dx: cos, dy: sin }
        })
    };
    let body = Piecewise::new(breakpoints.windows(2).map(arc).collect()).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap();
    let solution = contact.solve(Control::Load(form.load(1.0))).unwrap();
    assert_relative_eq!(solution.a() - shift, 0.3, epsilon = 0.0, max_relative = 1e-14);
    let pressure = solution.pressure().unwrap();
    let sines: Vec<f64> = breakpoints.iter().map(|k| k.sin()).collect();
    for x in points(0.3, &sines) {
        // Rounding of x, relative to the distance from the edge.
        let rounding = 1e-12 + 1e-15 / (0.3 - x.abs());
        let x = shift + x;
        let exact = form.pressure(x - shift, 1.0);
        assert_relative_eq!(pressure.at(x).unwrap(), exact, epsilon = 0.0, max_relative = rounding);
    }
    let moment = solution.moment().unwrap();
    assert_relative_eq!(moment, shift * form.load(1.0), epsilon = 0.0, max_relative = 1e-12);
}

/// Breakpoints do not show in the certificate of a gap that is not convex.
#[test]
fn a_certified_wave_in_thousands_of_pieces() {
    let wave = |ends: &[f64]| {
        Curve::new([ends[0], ends[1]], |x: f64| {
            let (sin, cos) = (12.0 * x).sin_cos();
            CurvePoint { x, y: x * x / 2.0 + 0.0072 * cos, dx: 1.0, dy: x - 0.0864 * sin }
        })
    };
    let least = [1, 9000].map(|pieces| {
        let body = Piecewise::new(breakpoints(pieces).windows(2).map(wave).collect()).unwrap();
        let contact = Contact::new(&Flat, &body).unwrap();
        let solution = contact.solve(Control::HalfWidth(0.6)).unwrap();
        solution.certify().unwrap().pressure.unwrap()
    });
    assert_relative_eq!(least[0].value, least[1].value, epsilon = 0.0, max_relative = 1e-7);
    assert!((least[0].x.abs() - least[1].x.abs()).abs() < 1e-3, "{least:?}");
}

/// A polygon has a jump of the slope at each breakpoint, with a logarithm each:
/// `P = (κ/π²) Σ Δ_j 2 artanh(min(m, n)/max(m, n))`.
#[test]
fn a_polygon_of_a_thousand_sides() {
    let breakpoints = breakpoints(1000);
    let slope = |i: usize| 0.5 * (breakpoints[i] + breakpoints[i + 1]);
    let mut sides: Vec<Profile> = Vec::new();
    let mut height = 0.0;
    for (i, ends) in breakpoints.windows(2).enumerate() {
        let ([from, to], slope, start) = ([ends[0], ends[1]], slope(i), height);
        sides.push(graph(from, to, move |x| [start + slope * (x - from), slope]));
        height += slope * (to - from);
    }
    let body = Piecewise::new(sides).unwrap();
    // With both ends of the contact free and -b given, a is the root of ∫ g dθ.
    let left = -0.612_345;
    let jumps: Vec<[f64; 2]> =
        (1..breakpoints.len() - 1).map(|i| [breakpoints[i], slope(i) - slope(i - 1)]).collect();
    let first = (0..).find(|&i| breakpoints[i + 1] > left).unwrap();
    let angle = |x: f64, right: f64| {
        2.0 * ((right - x) / (right - left)).sqrt().atan2(((x - left) / (right - left)).sqrt())
    };
    let inside = |right: f64| {
        jumps.iter().filter(move |[x, _]| *x > left && *x < right).copied().collect::<Vec<_>>()
    };
    let mean = |right: f64| {
        let sum: f64 = inside(right).iter().map(|&[x, jump]| jump * angle(x, right)).sum();
        slope(first) * PI + sum
    };
    let (mut low, mut high) = (0.3, 0.95);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if mean(middle) < 0.0 { low = middle } else { high = middle }
    }
    let right = 0.5 * (low + high);
    let first_moment: f64 =
        inside(right).iter().map(|&[x, jump]| jump * angle(x, right).sin()).sum::<f64>() / PI;
    let load = 0.5 * (right - left) * first_moment;

    let contact = Contact::new(&Flat, &body).unwrap();
    let solution = contact.solve(Control::Load(load)).unwrap();
    assert_relative_eq!(solution.a(), right, epsilon = 0.0, max_relative = 1e-12);
    assert_relative_eq!(solution.b(), -left, epsilon = 0.0, max_relative = 1e-12);
    let pressure = solution.pressure().unwrap();
    for z in points(0.5 * (right - left), &breakpoints) {
        let x = 0.5 * (left + right) + z;
        let term = |[t, jump]: [f64; 2]| {
            let m = ((right - t) * (x - left)).sqrt();
            let n = ((right - x) * (t - left)).sqrt();
            jump * 2.0 * (m.min(n) / m.max(n)).atanh()
        };
        let exact = inside(right).into_iter().map(term).sum::<f64>() / (PI * PI);
        // Limits and x are rounded.
        let rounding = 1e-11 + 1e-15 / (0.5 * (right - left) - z.abs());
        assert_relative_eq!(pressure.at(x).unwrap(), exact, epsilon = 0.0, max_relative = rounding);
    }
}

/// Returns a parabola cut into equal pieces.
fn cut(pieces: usize, reach: f64) -> impl linecontact::ParametricProfile<f64> {
    let x = move |i: usize| reach * (2.0 * i as f64 / pieces as f64 - 1.0);
    let piece = |i: usize| {
        Curve::new([x(i), x(i + 1)], |k: f64| CurvePoint { x: k, y: k * k / 2.0, dx: 1.0, dy: k })
    };
    Piecewise::new((0..pieces).map(piece).collect()).unwrap()
}

#[test]
fn the_cost_of_pieces_is_linear() {
    // The contact covers all but a part of the outermost pieces.
    let mut shares = Vec::new();
    for pieces in [10, 50, 100, 200, 400, 1000] {
        let body = cut(pieces, 1.0);
        let l = 1.0 - 0.7 / pieces as f64;
        let contact = Contact::new(&Flat, &body).unwrap();
        let contact = contact.start(Interval { left: -l, right: l });
        let solution = contact.solve(Control::Load(l * l / 2.0)).unwrap();
        assert_solved(&solution, Interval { left: -l, right: l }, 1e-13, 20 * pieces);
        let pressure = solution.pressure().unwrap();
        for i in -9..10 {
            let x = 0.1 * f64::from(i) * l + 0.0123;
            let exact = (l * l - x * x).sqrt() / PI;
            let got = pressure.at(x).unwrap();
            assert_relative_eq!(got, exact, epsilon = 0.0, max_relative = 1e-13);
        }
        shares.push(solution.cost().evaluations as f64 / pieces as f64);
    }
    println!("evaluations a piece: {shares:?}");
    let (least, most) =
        shares.iter().fold((f64::MAX, 0.0f64), |(lo, hi), &s| (lo.min(s), hi.max(s)));
    assert!(most <= 1.3 * least, "{shares:?}");
}

#[test]
fn few_of_many_pieces_are_looked_at() {
    // The contact covers a hundredth of them.
    let body = cut(1000, 1.0);
    let contact = Contact::new(&Flat, &body).unwrap();
    let l = 0.0103;
    for contact in [contact.clone(), contact.start(Interval { left: -0.02, right: 0.02 })] {
        let solution = contact.solve(Control::Load(l * l / 2.0)).unwrap();
        assert_solved(&solution, Interval { left: -l, right: l }, 1e-13, 20_000);
    }
    let smooth = parabola(1.0);
    let smooth = Contact::new(&Flat, &*smooth).unwrap();
    let smooth = smooth.solve(Control::Load(l * l / 2.0)).unwrap();
    assert_solved(&smooth, Interval { left: -l, right: l }, 1e-14, 60);
}

/// With |x|ⁿ and F = c Lⁿ, P(0) = (1/π) ∫ F'(l)/l dl = n F/((n - 1) π L). The slope is hardly
/// continuous at the breakpoint, where features unseen by any integral matter.
#[test]
fn the_pressure_at_the_tip_of_powers_close_to_one() {
    for n in [1.1, 1.2, 1.25, 1.5, 1.75] {
        let side = |sign: f64| {
            let ends = [sign.min(0.0) * 3.0, sign.max(0.0) * 3.0];
            graph(ends[0], ends[1], move |x: f64| {
                [x.abs().powf(n), sign * n * x.abs().powf(n - 1.0)]
            })
        };
        let contact = on_flat(join(vec![side(-1.0), side(1.0)]));
        let solution = contact.solve(Control::Load(0.7)).unwrap();
        let exact = n * 0.7 / ((n - 1.0) * PI * solution.a());
        let there = solution.pressure().unwrap().at(0.0).unwrap();
        assert_relative_eq!(there, exact, epsilon = 0.0, max_relative = 1e-12);
    }
}

/// X = ±k², Y = k⁴/2 from k = 0 is Hertz's parabola, in two pieces whose derivatives both vanish at
/// the joint; X = ±k³, Y = k⁶/2 is another such pair.
#[test]
fn pieces_that_meet_where_their_derivatives_vanish() {
    for power in [2, 3] {
        let side = |sign: f64| {
            Curve::new([0.0, 3.0], move |k: f64| {
                let (x, dx) = (sign * k.powi(power), sign * f64::from(power) * k.powi(power - 1));
                CurvePoint { x, y: x * x / 2.0, dx, dy: x * dx }
            })
        };
        let body = Piecewise::new(vec![side(-1.0), side(1.0)]).unwrap();
        let contact = Contact::new(&Flat, &body).unwrap();
        for l in [1e-3f64, 0.7, 3.9] {
            let solution = contact.solve(Control::Load(l * l / 2.0)).unwrap();
            assert_solved(&solution, Interval { left: -l, right: l }, 1e-13, 3000);
            assert!(solution.certify().is_ok());
            let pressure = solution.pressure().unwrap();
            for z in [-0.9, -0.1, 0.0, 1e-9, 0.4] {
                let exact = l * ((1.0 - z) * (1.0f64 + z)).sqrt() / PI;
                let got = pressure.at(z * l).unwrap();
                assert_relative_eq!(got, exact, epsilon = 0.0, max_relative = 1e-12);
            }
        }
    }
}

/// Next to a root of high order at such an end the curve is sampled so close to the end that
/// rounding puts a parameter on it, where Y'/X' is 0/0. The gap is even about the breakpoint, and
/// so is the contact.
#[test]
fn a_root_beside_an_end_where_the_derivatives_vanish() {
    let breakpoint: f64 = -0.002783964073710917;
    let shape = move |x: f64| {
        let (u, power) = (x - breakpoint, 0.0026600581838);
        let root = 0.25 * u.abs().powf(power);
        (0.5 * u * u + root * u.abs() / (1.0 + power), u + root * u.signum())
    };
    let left = Curve::new([0.0, 1.0], move |k: f64| {
        let width = 2.94 + breakpoint;
        let x = if k == 1.0 {
            breakpoint
        } else {
            breakpoint - width + width * k * k * (3.0 - 2.0 * k)
        };
        let ((y, slope), dx) = (shape(x), width * 6.0 * k * (1.0 - k));
        CurvePoint { x, y, dx, dy: slope * dx }
    });
    let right = graph(breakpoint, breakpoint + 2.9, move |x| [shape(x).0, shape(x).1]);
    let body = Piecewise::new(vec![Box::new(left), right]).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap();
    for [before, after] in [[1.2e-4, 1.7e-4], [3e-4, 3e-4], [1e-4, 7e-4]] {
        let contact = contact
            .clone()
            .start(Interval { left: breakpoint - before, right: breakpoint + after });
        let solution = contact.solve(Control::HalfWidth(1e-4)).unwrap();
        let [left, right] = [breakpoint - solution.hull().left, solution.hull().right - breakpoint];
        assert_relative_eq!(left, 1e-4, epsilon = 0.0, max_relative = 1e-10);
        assert_relative_eq!(right, 1e-4, epsilon = 0.0, max_relative = 1e-10);
    }
}

#[test]
fn a_curvature_that_jumps_by_two_to_the_27th() {
    // Mirrored, from any start, and by the paper's integrator, which shares no code with the
    // panels.
    let steep = f64::from(1 << 27);
    let bent = |bend: f64| move |x: f64| [bend * x * x / 2.0, bend * x];
    let body = |left, right| join(vec![graph(-9.0, 0.0, bent(left)), graph(0.0, 9.0, bent(right))]);
    let (right, left) = (body(1.0, steep), body(steep, 1.0));
    let rule = Midpoint::default();
    let scene = Contact::new(&Flat, &*right).unwrap().quadrature(&rule);
    let other = scene.solve(Control::Load(0.3)).unwrap();
    for start in [None, Some((-0.3, 0.3)), Some((3.0, 4.0)), Some((-1e-7, 1e-7))] {
        for (body, mirrored) in [(&right, false), (&left, true)] {
            let mut contact = Contact::new(&Flat, &**body).unwrap();
            if let Some((left, right)) = start {
                contact = contact.start(Interval { left, right });
            }
            let solution = contact.solve(Control::Load(0.3)).unwrap();
            let [a, b] =
                if mirrored { [solution.b(), solution.a()] } else { [solution.a(), solution.b()] };
            assert_relative_eq!(b, other.b(), epsilon = 0.0, max_relative = 2e-15);
            // A millionth of the other limit, and accurate to rounding of the half-width.
            assert!((a - other.a()).abs() < 1e-15 * b, "{start:?} {a:e} {:e}", other.a());
        }
    }
}

#[test]
fn an_edge_at_a_kink() {
    // x²/2 up to the kink, which the contact just misses, and much steeper beyond. L = sqrt(2 C/π)
    // from Hertz's F = L²/2.
    for jump in [0.5, 3.0, 5.0] {
        for short in [0.0, 1e-14, 1e-12, 1e-10, 1e-6] {
            let half_width = 1.0 - short;
            let load = Control::Load(half_width * half_width / 2.0);
            let inner = graph(-1.0, 9.0, |x| [x * x / 2.0, x]);
            let outer = graph(-9.0, -1.0, move |x| {
                let d = x + 1.0;
                [0.5 - (1.0 + jump) * d + d * d / 4.0, -1.0 - jump + d / 2.0]
            });
            let contact = on_flat(join(vec![outer, inner]));
            let solution = contact.solve(load).unwrap();
            for limit in [solution.a(), solution.b()] {
                let error = (limit - half_width).abs();
                assert!(error <= 2e-15, "{jump} {short:e}: {error:e}");
            }
        }
    }
}

/// Pieces that a load cannot reach are excluded by their ends, many of them at a time.
#[test]
fn pieces_above_the_reach_of_a_load_are_not_sampled() {
    let wave = |ends: &[f64]| {
        Curve::new([ends[0], ends[1]], |x: f64| {
            let (sin, cos) = (40.0 * x).sin_cos();
            CurvePoint { x, y: x * x / 2.0 + 1e-3 * cos, dx: 1.0, dy: x - 0.04 * sin }
        })
    };
    let pieces = 9000;
    let body = Piecewise::new(breakpoints(pieces).windows(2).map(wave).collect()).unwrap();
    let solution = Contact::new(&Flat, &body).unwrap().solve(Control::Load(1e-4)).unwrap();
    assert!(solution.intervals().len() > 1);
    // Nine evaluations a piece would be 81 000.
    let heights = solution.cost().heights;
    assert!(heights < 9 * pieces as usize / 4, "{heights}");
}

/// A run of pieces is as uncertain as its highest point is high.
#[test]
fn one_raised_point_of_thousands_is_touched() {
    let (count, height, load) = (4001, 0.05, 1e-3);
    for raised in [2600, 2601, 2617, 2639] {
        let point = |i: usize| {
            let x = i as f64 / 2000.0 - 1.0;
            [x, x * x / 2.0 - if i == raised { height } else { 0.0 }]
        };
        let points: Vec<_> = (0..count).map(point).collect();
        let fit = Fit { outliers: None, ..Fit::default() };
        let body = Spline::fitted(&points, fit).unwrap();
        let solution = Contact::new(&Flat, &body).unwrap().solve(Control::Load(load)).unwrap();
        let [x, _] = point(raised);
        assert!(solution.intervals().iter().any(|on| on.contains(x)), "{raised}");
    }
}
