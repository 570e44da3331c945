//! Profiles from measured points.
#![allow(missing_docs)]

use crate::common::NanSafe;
use approx::assert_relative_eq;
use linecontact::profile::{Fit, Spline, SplineError};
use linecontact::reference::{ClosedForm, Ellipse, Hertz};
use linecontact::{Contact, Control, Flat, ParametricProfile};

/// Approximately normal random numbers: sums of twelve from a linear congruential generator.
struct Noise(u64);

impl Noise {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }
}

/// Returns points of y(x) at distances that vary by a factor of three.
fn uneven(n: usize, y: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
    let mut noise = Noise(1);
    let mut x = -1.0;
    let mut points = Vec::new();
    for _ in 0..n {
        points.push([x, y(x)]);
        x += (0.5 + noise.uniform()) * 2.0 / n as f64;
    }
    points
}

/// Returns points of y(x) at equal distances from -1 to 1.
fn even(n: usize, mut y: impl FnMut(f64) -> f64) -> Vec<[f64; 2]> {
    let x = |i: usize| 2.0 * i as f64 / (n - 1) as f64 - 1.0;
    (0..n).map(|i| [x(i), y(x(i))]).collect()
}

fn circle(radius: f64) -> impl Fn(f64) -> f64 {
    move |x| x * x / (radius + ((radius - x) * (radius + x)).sqrt())
}

/// Returns the second and third derivative at the two ends of each piece, from its slope, a
/// parabola.
fn bends(spline: &Spline<f64>) -> Vec<([f64; 2], f64)> {
    let piece = |i| {
        let piece = spline.piece(i).expect("as many as it says");
        let [from, to] = piece.x();
        let slope = |share: f64| piece.curve.slope_at(from + share * (to - from)).unwrap();
        let [left, middle, right] = [slope(0.0), slope(0.5), slope(1.0)];
        let h = to - from;
        let seconds =
            [(4.0 * middle - 3.0 * left - right) / h, (3.0 * right + left - 4.0 * middle) / h];
        (seconds, 4.0 * (left - 2.0 * middle + right) / (h * h))
    };
    (0..spline.pieces()).map(piece).collect()
}

#[test]
fn a_cubic_is_reproduced() {
    let cubic = |x: f64| 1.0 + x * (0.5 + x * (2.0 - 3.0 * x));
    let slope = |x: f64| 0.5 + x * (4.0 - 9.0 * x);
    for n in [4, 5, 40] {
        let points = uneven(n, cubic);
        let spline = Spline::through(&points).unwrap();
        let [from, to] = spline.domain();
        assert_eq!([from, to], [points[0][0], points[n - 1][0]]);
        for i in 0..=100 {
            let x = from + (to - from) * f64::from(i) / 100.0;
            let got = spline.at(x);
            assert!((got.y - cubic(x)).abs() < 1e-14 * n as f64, "{n} {x}: {got:?}");
            assert!((got.dy - slope(x)).abs() < 1e-13 * n as f64, "{n} {x}: {got:?}");
        }
    }
}

#[test]
fn two_derivatives_are_continuous_and_the_error_falls_like_the_third_power() {
    let error = |n| {
        let points = uneven(n, f64::sin);
        let spline = Spline::through(&points).unwrap();
        let size = 16.0 * f64::EPSILON * (n * n) as f64;
        for pair in bends(&spline).windows(2) {
            assert!((pair[0].0[1] - pair[1].0[0]).abs() < size, "{pair:?}");
        }
        for (i, point) in points.iter().enumerate().take(n - 1).skip(1) {
            let [left, right] = [i - 1, i].map(|j| spline.piece(j).unwrap());
            assert!((left.ends[1].y - point[1]).abs() < 1e-15 && right.ends[0].y == point[1]);
            assert!((left.ends[1].dy - right.ends[0].dy).abs() < 1e-13);
        }
        let [from, to] = spline.domain();
        let off = |i: i32| {
            let x = from + (to - from) * f64::from(i) / 1000.0;
            (spline.at(x).dy - x.cos()).abs()
        };
        (0..=1000).map(off).fold(0.0, NanSafe::nan_max)
    };
    let [coarse, fine] = [error(40), error(160)];
    assert!(coarse / fine > 40.0, "{coarse:e} {fine:e}"); // 4³ = 64
}

#[test]
fn solves_agree_with_the_shape_that_the_points_are_of() {
    let load = 0.02;
    for points in [uneven(60, |x| x * x / 2.0), even(4, |x| x * x / 2.0)] {
        let body = Spline::through(&points).unwrap();
        let contact = Contact::new(&Flat, &body).unwrap();
        let solution = contact.solve(Control::Load(load)).unwrap();
        let form = Hertz::under_load(1.0, load, 1.0).unwrap();
        let right = form.limits().right;
        assert_relative_eq!(solution.a(), right, epsilon = 0.0, max_relative = 1e-13);
        assert_relative_eq!(solution.b(), right, epsilon = 0.0, max_relative = 1e-13);
        let pressure = solution.pressure().unwrap().at(0.05).unwrap();
        let exact = form.pressure(0.05, 1.0);
        assert_relative_eq!(pressure, exact, epsilon = 0.0, max_relative = 1e-12);
    }
    // 2000 points of a circle: h³ is 1e-9.
    let form = Ellipse::circle(2.0, 0.5).unwrap();
    let body = Spline::through(&even(2000, circle(2.0))).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap();
    let solution = contact.solve(Control::Load(form.load(1.0))).unwrap();
    assert_relative_eq!(solution.a(), 0.5, epsilon = 0.0, max_relative = 1e-10);
    assert_eq!(solution.cost().evaluations, 0);
    let pressure = solution.pressure().unwrap().at(0.3).unwrap();
    assert_relative_eq!(pressure, form.pressure(0.3, 1.0), epsilon = 0.0, max_relative = 1e-8);
}

/// Returns the root mean square distance that Reinsch allows, in units of the noise.
fn reinsch(points: usize) -> f64 {
    (1.0 + (2.0 / points as f64).sqrt()).sqrt()
}

/// `Σ (Y - y)² + α ∫ Y''²` is least if Y'' is zero at the ends, and at each knot the jump of Y'''
/// times α is the height of the point above the curve. The problem is convex: the curve is unique.
#[test]
fn the_smoothed_spline_is_the_smoothest() {
    let mut random = Noise(7);
    let mut points = uneven(40, |x| 3.0 + 0.5 * x + (2.0 * x).cos());
    points.iter_mut().for_each(|point| point[1] += 0.02 * random.normal());
    for noise in [0.002, 0.02, 0.1] {
        let spline = Spline::fitted(&points, Fit { noise, outliers: None }).unwrap();
        let left: Vec<f64> = points.iter().map(|&[x, y]| y - spline.at(x).y).collect();
        let rms = (left.iter().map(|d| d * d).sum::<f64>() / points.len() as f64).sqrt();
        let allowed = noise * reinsch(points.len());
        assert_relative_eq!(rms, allowed, epsilon = 0.0, max_relative = 1.1e-4);

        let bends = bends(&spline);
        let n = bends.len();
        let largest = bends.iter().map(|bend| bend.0[0].abs()).fold(0.0, f64::max);
        assert!(bends[0].0[0].abs() < 1e-9 * largest && bends[n - 1].0[1].abs() < 1e-9 * largest);
        let jumps: Vec<f64> = (0..=n)
            .map(|i| bends.get(i).map_or(0.0, |b| b.1) - if i > 0 { bends[i - 1].1 } else { 0.0 })
            .collect();
        let square = |values: &[f64]| values.iter().map(|v| v * v).sum::<f64>().sqrt();
        let alpha = square(&left) / square(&jumps);
        for (left, jump) in left.iter().zip(jumps) {
            assert!((left - alpha * jump).abs() < 1e-8 * noise, "{noise}: {left} {jump}");
        }
        for pair in bends.windows(2) {
            assert!((pair[0].0[1] - pair[1].0[0]).abs() < 1e-9 * largest, "{pair:?}");
        }
    }
}

/// The bound of the slope is the noise over the distance within which the smoothing averages: many
/// points are as good as few with less noise.
#[test]
fn many_noisy_points_give_the_contact() {
    let noise = 1e-5;
    let mut random = Noise(3);
    let points = even(20_000, |x| circle(2.0)(x) + noise * random.normal());
    let body = Spline::fitted(&points, Fit { noise, ..Fit::default() }).unwrap();
    let off = |&[x, y]: &[f64; 2]| (body.at(x).y - y).powi(2);
    let rms = (points.iter().map(off).sum::<f64>() / points.len() as f64).sqrt();
    let allowed = noise * reinsch(points.len());
    assert_relative_eq!(rms, allowed, epsilon = 0.0, max_relative = 1.1e-4);

    let form = Ellipse::circle(2.0, 0.5).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap();
    let solution = contact.solve(Control::Load(form.load(1.0))).unwrap();
    assert_relative_eq!(solution.a(), 0.5, epsilon = 0.0, max_relative = 3e-4);
    assert_relative_eq!(solution.b(), 0.5, epsilon = 0.0, max_relative = 3e-4);
    let pressure = solution.pressure().unwrap();
    for x in [-0.4, -0.1, 0.2, 0.35] {
        let (got, exact) = (pressure.at(x).unwrap(), form.pressure(x, 1.0));
        assert_relative_eq!(got, exact, epsilon = 0.0, max_relative = 2e-3);
    }
    // Without smoothing the slope errors are those of the noise, ten times as large.
    let raw = Spline::through(&points).unwrap();
    let error = |body: &Spline<f64>| {
        let off = |i: i32| f64::from(i) / 1e3;
        let off = |i| (body.at(off(i)).dy - form.slope(off(i))).powi(2);
        ((-500..500).map(off).sum::<f64>() / 1000.0).sqrt()
    };
    assert!(error(&raw) > 0.05 && error(&body) < 2e-4, "{:e} {:e}", error(&raw), error(&body));
}

/// With a noise known to 10 % only, the smoothed curve does not follow it, however many the points.
#[test]
fn a_noise_that_is_not_quite_known_leaves_the_peak() {
    let (radius, half_width, noise) = (10.0, 0.25, 1e-4);
    let form = Ellipse::circle(radius, half_width).unwrap();
    let top = form.pressure(0.0, 1.0);
    for (seed, n) in [401, 1001, 4001, 20_001, 4001, 1001].into_iter().enumerate() {
        let mut random = Noise(seed as u64 + 21);
        let mut height = |x: f64| circle(radius)(x) + noise * random.normal();
        let points: Vec<_> = even(n, |_| 0.0).iter().map(|&[x, _]| [x, height(x)]).collect();
        for share in [0.9, 0.98, 1.0, 1.02, 1.1] {
            let fit = Fit { noise: share * noise, ..Fit::default() };
            let body = Spline::fitted(&points, fit).unwrap();
            let contact = Contact::new(&Flat, &body).unwrap();
            let solution = contact.solve(Control::Load(form.load(1.0))).unwrap();
            assert_eq!(solution.intervals().len(), 1, "{n} points, {share} of the noise");
            let peak = solution.peak().unwrap().pressure;
            let off = peak / top - 1.0;
            assert!(off.abs() < 0.03, "{n} points, {share} of the noise: off by {off:.1e}");
        }
    }
}

#[test]
fn bad_points_are_named_by_their_row() {
    let points = even(50, |x| x * x);
    let with = |row: usize, x: Option<f64>, y: Option<f64>| {
        let mut points = points.clone();
        points[row - 1][0] = x.unwrap_or(points[row - 1][0]);
        points[row - 1][1] = y.unwrap_or(points[row - 1][1]);
        Spline::through(&points).map(|_| ()).expect_err("a bad point")
    };
    assert!(matches!(with(7, Some(f64::NAN), None), SplineError::NotFinite { row: 7, .. }));
    assert!(matches!(with(50, None, Some(f64::INFINITY)), SplineError::NotFinite { row: 50, .. }));
    let before = points[8][0];
    assert_eq!(with(10, Some(before), None), SplineError::Duplicate { row: 10, x: before });
    let unsorted = SplineError::Unsorted { row: 10, x: -3.0, before };
    assert_eq!(with(10, Some(-3.0), None), unsorted);
    assert!(unsorted.to_string().starts_with("row 10: x = -3 after"));
    for few in 0..4 {
        let error = Spline::through(&points[..few]).map(|_| ()).unwrap_err();
        assert_eq!(error, SplineError::TooFew { points: few });
    }
    for noise in [-1.0, f64::NAN, f64::INFINITY] {
        let error = Spline::fitted(&points, Fit { noise, ..Fit::default() }).map(|_| ());
        assert!(matches!(error, Err(SplineError::Noise { .. })));
    }
    for limit in [0.0, -1.0, f64::NAN] {
        let fit = Fit { outliers: Some(limit), ..Fit::default() };
        let error = Spline::fitted(&points, fit).map(|_| ());
        assert!(matches!(error, Err(SplineError::Limit { .. })), "{limit}");
    }
    // The root mean square distance of x² from its line, 1/3, is sqrt(4/45).
    let fit = Fit { noise: 0.4, ..Fit::default() };
    match Spline::fitted(&points, fit).map(|_| ()) {
        Err(SplineError::NothingLeft { line, .. }) => assert!((line - 0.31).abs() < 0.01, "{line}"),
        other => panic!("{other:?}"),
    }
    let huge: Vec<_> = points.iter().map(|&[x, y]| [x, 1e308 * y]).collect();
    let error = Spline::fitted(&huge, Fit { noise: 1e306, outliers: None }).map(|_| ());
    assert!(matches!(error, Err(SplineError::Smoothing { .. })), "{error:?}");
}

#[test]
fn slips_of_the_measurement_are_found_and_nothing_else() {
    let noise = 1e-4;
    let mut random = Noise(11);
    let noisy = even(5000, |x| circle(1.05)(x) + noise * random.normal());
    let steps: Vec<_> = noisy.iter().map(|&[x, y]| [x, (y / 1e-3).round() * 1e-3]).collect();
    let exact = even(300, circle(1.05));
    let tilted = even(300, |x| 0.7 * x + circle(3.0)(x) + noise * random.normal());
    for points in [&noisy, &steps, &exact, &tilted, &uneven(80, f64::exp), &even(12, f64::cos)] {
        Spline::through(points).unwrap();
        for row in [1, 2, 3, points.len() / 2, points.len()] {
            let mut bad = points.clone();
            let slip = if points.len() > 100 { 0.05 } else { 0.5 };
            bad[row - 1][1] += slip;
            match Spline::through(&bad).map(|_| ()) {
                Err(SplineError::Outlier { row: found, y, expected, deviations, .. }) => {
                    assert_eq!(found, row, "{} points", points.len());
                    assert!((y - expected - slip).abs() < 0.7 * slip && deviations > 10.0);
                }
                other => panic!("row {row} of {}: {other:?}", points.len()),
            }
            let all = Fit { outliers: None, ..Fit::default() };
            assert!(Spline::fitted(&bad, all).is_ok(), "unless that is turned off");
        }
    }
    // Between too few points an outlier cannot be detected.
    let few = [[0.0, 0.0], [1.0, 0.0], [2.0, 5.0], [3.0, 0.0], [4.0, 0.0]];
    assert!(Spline::through(&few).is_ok());
}

#[test]
fn a_spline_of_single_precision() {
    let points: Vec<[f32; 2]> =
        (-40..=40).map(|i| 0.025 * i as f32).map(|x| [x, x * x / 2.0]).collect();
    for noise in [0.0, 1e-4] {
        let body = Spline::fitted(&points, Fit { noise, ..Fit::default() }).unwrap();
        let contact = Contact::new(&Flat, &body).unwrap();
        let solution = contact.solve(Control::Load(0.02)).unwrap();
        assert!((solution.a() / 0.2 - 1.0).abs() < 0.01, "{noise} {}", solution.a());
    }
}

#[test]
fn a_spline_and_its_pieces_tell_their_ranges_and_slopes() {
    // A parabola is reproduced exactly.
    let points = uneven(12, |x| x * x / 3.0);
    let spline = Spline::through(&points).unwrap();
    assert_eq!(spline.domain(), [points[0][0], points[11][0]]);
    for i in 0..spline.pieces() {
        let piece = spline.piece(i).unwrap();
        assert_eq!(piece.curve.domain(), piece.k);
        assert_eq!(piece.curve.domain(), [points[i][0], points[i + 1][0]]);
    }
    for x in [-0.9, -0.3, 0.2, 0.7] {
        let slope = spline.slope_at(x).unwrap();
        assert_relative_eq!(slope, spline.at(x).dy, epsilon = 0.0, max_relative = 1e-15);
    }
}

#[test]
fn noise_far_below_that_of_the_points_leaves_them_as_they_are() {
    let mut scatter = Noise(3);
    let points = even(40, |x| x * x / 2.0 + 0.01 * scatter.normal());
    let fit = Fit { noise: 1e-14, outliers: None };
    let spline = Spline::fitted(&points, fit).unwrap();
    for &[x, y] in &points {
        assert!((spline.at(x).y - y).abs() < 1e-10, "{x}: {} {y}", spline.at(x).y);
    }
}

/// In any unit the spline is the same, or an error says that its numbers are too large or too
/// small.
#[test]
fn points_of_any_size() {
    let height = |x: f64| 0.5 * x * x + 0.1 * x * x * x + 0.2 * (3.0 * x).sin();
    let points = |[along, across]: [f64; 2]| -> Vec<[f64; 2]> {
        (-10..=10).map(|i| 0.1 * f64::from(i)).map(|x| [x * along, height(x) * across]).collect()
    };
    let units = [1e-320, 1e-300, 1e-200, 1e-155, 1e-100, 1.0, 1e100, 1e160, 1e300, 1e308];
    for noise in [0.0, 1e-4] {
        let fit = |unit| Fit { noise: noise * unit, ..Fit::default() };
        let plain = Spline::fitted(&points([1.0; 2]), fit(1.0)).unwrap();
        let mut made = 0;
        let pairs = units.map(|along| units[1..].iter().map(move |&across| [along, across]));
        for [along, across] in pairs.into_iter().flatten() {
            let body = match Spline::fitted(&points([along, across]), fit(across)) {
                Ok(body) => body,
                Err(error) => {
                    let cubic = across.log10() - 3.0 * along.log10();
                    let extreme =
                        cubic.abs() > 290.0 || along.log10().abs().max(across.log10()) > 290.0;
                    assert!(extreme, "{along:e} {across:e}: {error}");
                    assert!(error.to_string().contains("unit of their own size"), "{error}");
                    continue;
                }
            };
            made += 1;
            for i in 0..200 {
                let x = 0.01 * f64::from(i) - 0.995;
                let (got, wanted) = (body.at(x * along), plain.at(x));
                let missed = (got.y / across - wanted.y).abs();
                let tilted = (got.dy / (across / along) - wanted.dy).abs();
                assert!(missed < 1e-9 && tilted < 1e-9, "{along:e} {across:e}: {missed} {tilted}");
            }
        }
        assert!(made >= 20, "{made}");
    }
}
