//! Bodies of very many pieces, where a pressure is summed up over groups of them.
#![allow(missing_docs)]

use approx::assert_relative_eq;
use linecontact::reference::{ClosedForm, Ellipse};
use linecontact::{Contact, Control, Curve, CurvePoint, Flat, ParametricProfile, Piecewise};
use std::f64::consts::PI;

type Profile = Box<dyn ParametricProfile<f64>>;

/// Breakpoints from -1 to 1, unevenly.
fn breakpoints(pieces: u32) -> Vec<f64> {
    let place = |i: u32| {
        let z = 2.0 * f64::from(i) / f64::from(pieces) - 1.0;
        z - 0.15 * (PI * z).sin()
            + 0.3 / f64::from(pieces) * (2.3 * f64::from(i)).sin() * (1.0 - z * z)
    };
    (0..=pieces).map(place).collect()
}

/// Points from 1e-9 half-widths from an edge to the middle, and beside breakpoints.
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

/// The closed form of a circle knows of no breakpoints.
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
        // The rounding of x counts by its distance from the edge.
        let rounding = 1e-12 + 1e-15 / (0.3 - x.abs());
        let x = shift + x;
        let exact = form.pressure(x - shift, 1.0);
        assert_relative_eq!(pressure.at(x).unwrap(), exact, epsilon = 0.0, max_relative = rounding);
    }
    let moment = solution.moment().unwrap();
    assert_relative_eq!(moment, shift * form.load(1.0), epsilon = 0.0, max_relative = 1e-12);
}

/// Neither does the certificate of a gap that is not convex.
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
        sides.push(Box::new(Curve::new([from, to], move |x: f64| CurvePoint {
            x,
            y: start + slope * (x - from),
            dx: 1.0,
            dy: slope,
        })));
        height += slope * (to - from);
    }
    let body = Piecewise::new(sides).unwrap();
    // Where the two ends of the contact are free and -b is given, a is where ∫ g dθ vanishes.
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
