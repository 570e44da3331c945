//! Profiles from measured points.
#![allow(missing_docs)]

use crate::common::{NanSafe, Shares};
use approx::assert_relative_eq;
use linecontact::profile::{Fit, Placement, Spline, SplineError};
use linecontact::reference::{ClosedForm, Ellipse, Hertz};
use linecontact::{
    Contact, ContactError, Control, Curve, CurvePoint, EvaluationError, Flat, ParametricProfile,
    Piecewise, Uncertainty,
};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::PI;

/// Returns points of y(x) at distances that vary by a factor of three.
fn uneven(n: usize, y: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
    let mut noise = Shares(1);
    let mut x = -1.0;
    let mut points = Vec::new();
    for _ in 0..n {
        points.push([x, y(x)]);
        x += (0.5 + noise.between(0.0, 1.0)) * 2.0 / n as f64;
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

/// Likelihood of points by dense matrices: of the curve, the noise and a sum of slopes.
struct Dense {
    /// Height at each point.
    heights: DVector<f64>,
    noise: f64,
    deviation: f64,
    unlikelihood: f64,
}

impl Dense {
    /// Fits `spans` spans, with the penalty of weight α in units of a span, to points in [0, 1].
    fn new(points: &[[f64; 2]], spans: usize, alpha: f64, slopes: &[[f64; 2]]) -> Self {
        let (n, k) = (points.len(), spans as f64);
        let b = DMatrix::from_fn(n, spans + 3, |i, j| basis(k * points[i][0] - j as f64 + 3.0));
        let third = [-1.0, 3.0, -3.0, 1.0];
        let bend = DMatrix::from_fn(spans, spans + 3, |i, j| {
            j.checked_sub(i).and_then(|d| third.get(d)).copied().unwrap_or(0.0)
        });
        let y = DVector::from_iterator(n, points.iter().map(|point| point[1]));
        let equations = b.transpose() * &b + bend.transpose() * &bend * alpha;
        let factors = equations.cholesky().unwrap();
        let c = factors.solve(&(b.transpose() * &y));
        let heights = &b * &c;
        let rest = (&y - &heights).norm_squared() + alpha * (&bend * &c).norm_squared();
        let free = (n - 3) as f64;
        let noise = (rest / free).sqrt();
        let rate = |u: f64| 1e5 * (basis(u + 5e-6) - basis(u - 5e-6));
        let weights = DVector::from_fn(spans + 3, |j, _| {
            slopes.iter().map(|[x, w]| w * k * rate(k * x - j as f64 + 3.0)).sum()
        });
        let deviation = noise * weights.dot(&factors.solve(&weights)).sqrt();
        let determinant: f64 = factors.l().diagonal().iter().map(|l| 2.0 * l.ln()).sum();
        let unlikelihood = free * rest.ln() + determinant - k * alpha.ln();
        Self { heights, noise, deviation, unlikelihood }
    }
}

/// Returns the cubic B-spline on the knots 0, 1, 2, 3 and 4, by truncated powers.
fn basis(u: f64) -> f64 {
    let power = |from: f64| (u - from).max(0.0).powi(3);
    if u >= 4.0 {
        return 0.0;
    }
    (power(0.0) - 4.0 * power(1.0) + 6.0 * power(2.0) - 4.0 * power(3.0)) / 6.0
}

#[test]
fn the_smoothed_spline_is_the_most_likely() {
    let mut random = Shares(7);
    for (noise, amplitude) in [(0.02, 1.0), (0.002, 1.0), (0.1, 0.3)] {
        let mut points: Vec<_> = uneven(60, |_| 0.0);
        let [from, to] = [points[0][0], points[59][0]];
        for [x, y] in &mut points {
            *x = (*x - from) / (to - from);
            *y = 3.0 + 0.5 * *x + amplitude * (6.0 * *x).cos() + noise * random.normal();
        }
        let fit = Fit { smooth: true, outliers: None, period: None };
        let spline = Spline::fitted(&points, fit).unwrap();
        let slopes = [[0.1, 1.0], [0.25, -2.0], [0.7, 0.5]];
        let of = |log: f64| Dense::new(&points, spline.pieces(), log.exp(), &slopes);
        let likeliest = |centre: f64, step: f64, count: i32| {
            let logs = (-count..=count).map(|i| centre + step * f64::from(i));
            let tried = logs.map(|log| (of(log).unlikelihood, log));
            tried.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap().1
        };
        let best = likeliest(likeliest(7.5, 0.5, 35), 0.01, 50);
        let dense = of(best);
        for (&[x, _], height) in points.iter().zip(&dense.heights) {
            assert!((spline.at(x).y - height).abs() < 2e-3 * noise, "{noise}: {x}");
        }
        assert_relative_eq!(spline.noise(), dense.noise, epsilon = 0.0, max_relative = 1e-3);
        assert!((spline.noise() / noise - 1.0).abs() < 0.25, "{noise}: {}", spline.noise());
        let (x, weights): (Vec<f64>, Vec<f64>) = slopes.iter().map(|&[x, w]| (x, w)).unzip();
        // With the least penalty that is likely, and with that before it, a reach 1.05 times as
        // long.
        let mut low = best;
        while of(low - 0.01).unlikelihood <= dense.unlikelihood + 3.84 {
            low -= 0.01;
        }
        let [most, least] = [0.0, 6.0 * 1.05f64.ln()].map(|more| {
            let Dense { deviation, noise, .. } = of(low + more);
            deviation / noise * dense.noise
        });
        let deviation = spline.slope_deviation(&x, &weights).unwrap();
        assert!(deviation < 1.003 * most && deviation > 0.997 * least, "{least} {most}");
    }
}

/// Heights of a circle that are known to rounding only, or exactly those of a parabola or a line.
#[test]
fn exact_points_are_smoothed_to_their_curve() {
    let fit = Fit { smooth: true, outliers: None, period: None };
    for points in [even(41, |x| x * x / 2.0), uneven(300, |x| 3.0 - x), even(200, circle(2.0))] {
        let spline = Spline::fitted(&points, fit).unwrap();
        for &[x, y] in &points {
            assert!((spline.at(x).y - y).abs() < 1e-9, "{x}: {} {y}", spline.at(x).y);
        }
        assert!(spline.noise() < 1e-9, "{}", spline.noise());
    }
}

/// Regular waves, as of chatter, are longer than the distance of the points: neighbours share them,
/// and they are no noise.
#[test]
fn waves_are_not_smoothed_away() {
    let (mut random, height) = (Shares(5), 1e-3);
    for points_a_wave in [16.0, 25.0, 50.0, 80.0, 105.0, 160.0] {
        for (count, noise) in [(1001, 0.0), (3001, 0.0), (1001, 2e-4), (3001, 2e-4)] {
            let waves = PI * count as f64 / points_a_wave;
            let exact = |x: f64| x * x / 10.0 + height * (waves * x).sin();
            let points = even(count, |x| exact(x) + noise * random.normal());
            let body = Spline::fitted(&points, Fit { smooth: true, ..Fit::default() }).unwrap();
            let scene = format!("{points_a_wave} {count} {noise}");
            let off = body.noise() - noise;
            assert!(off.abs() <= 0.1 * noise + 1e-4 * height, "{scene}: {off:e}");
            let squares = points.iter().map(|&[x, _]| (body.at(x).y - exact(x)).powi(2));
            let off = (squares.sum::<f64>() / count as f64).sqrt();
            assert!(off <= 0.6 * noise + 1e-4 * height, "{scene}: {off:e}");
        }
    }
}

/// The bound of the slope is the noise over the distance within which the smoothing averages: many
/// points are as good as few with less noise.
#[test]
fn many_noisy_points_give_the_contact() {
    let noise = 1e-5;
    let mut random = Shares(3);
    let points = even(20_000, |x| circle(2.0)(x) + noise * random.normal());
    let body = Spline::fitted(&points, Fit { smooth: true, ..Fit::default() }).unwrap();
    assert!((body.noise() / noise - 1.0).abs() < 0.02, "{}", body.noise());

    let form = Ellipse::circle(2.0, 0.5).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap();
    let solution = contact.solve(Control::Load(form.load(1.0))).unwrap();
    assert_relative_eq!(solution.a(), 0.5, epsilon = 0.0, max_relative = 1e-4);
    assert_relative_eq!(solution.b(), 0.5, epsilon = 0.0, max_relative = 1e-4);
    let pressure = solution.pressure().unwrap();
    for x in [-0.4, -0.1, 0.2, 0.35] {
        let (got, exact) = (pressure.at(x).unwrap(), form.pressure(x, 1.0));
        assert_relative_eq!(got, exact, epsilon = 0.0, max_relative = 1e-3);
    }
    // Without smoothing the slope errors are those of the noise, a thousand times as large.
    let raw = Spline::through(&points).unwrap();
    let error = |body: &Spline<f64>| {
        let off = |i: i32| f64::from(i) / 1e3;
        let off = |i| (body.at(off(i)).dy - form.slope(off(i))).powi(2);
        ((-500..500).map(off).sum::<f64>() / 1000.0).sqrt()
    };
    assert!(error(&raw) > 0.05 && error(&body) < 5e-5, "{:e} {:e}", error(&raw), error(&body));
}

/// Circles and crowned rollers: in 19 of 20 measurements the exact contact lies within two standard
/// deviations, or in more, since the body is smoother than the penalty expects.
#[test]
fn the_exact_contact_lies_within_the_uncertainty() {
    let crowned = |x: f64| [x * x / 2.0 + 5.0 * x.powi(6), x + 30.0 * x.powi(5)];
    let circle = |x: f64| [circle(1.0)(x), x / ((1.0 - x) * (1.0 + x)).sqrt()];
    type Shape = dyn Fn(f64) -> [f64; 2] + Sync;
    let shapes: [(&str, &Shape); 2] = [("circle", &circle), ("crowned", &crowned)];
    for (name, shape) in shapes {
        // In the last row the points hardly tell the body from a parabola.
        for (range, half_width, noise, n) in [
            (0.5, 0.02, 1e-5, 1000),
            (0.5, 0.1, 1e-4, 300),
            (0.5, 0.3, 1e-6, 1000),
            (0.1, 0.025, 1e-5, 1000),
        ] {
            let exact = Curve::new([-range, range], |x| {
                let [y, dy] = shape(x);
                CurvePoint { x, y, dx: 1.0, dy }
            });
            let contact = Contact::new(&Flat, &exact).unwrap();
            let solution = contact.solve(Control::HalfWidth(half_width)).unwrap();
            let (load, peak) = (solution.load(), solution.peak().unwrap().pressure);
            let (mut within, mut squares) = ([0; 4], [0.0; 4]);
            for seed in 0..40 {
                let mut random = Shares(seed);
                let points = even(n, |x| shape(range * x)[0] + noise * random.normal());
                let points: Vec<_> = points.iter().map(|&[x, y]| [range * x, y]).collect();
                let fit = Fit { smooth: true, ..Fit::default() };
                let body = Spline::fitted(&points, fit).unwrap();
                let solution = Contact::new(&Flat, &body).unwrap().solve(Control::Load(load));
                let solution = solution.unwrap();
                let Uncertainty { a, b, half_width: half, peak_pressure } =
                    solution.uncertainty().unwrap();
                let off = [
                    (solution.a() - half_width) / a,
                    (solution.b() - half_width) / b,
                    (solution.hull().half_width() - half_width) / half,
                    (solution.peak().unwrap().pressure - peak) / peak_pressure,
                ];
                within = std::array::from_fn(|i| within[i] + i32::from(off[i].abs() <= 2.0));
                squares = std::array::from_fn(|i| squares[i] + off[i] * off[i] / 40.0);
            }
            let name =
                format!("{name}, half-width {half_width}, noise {noise}: {within:?} {squares:.2?}");
            println!("{name}");
            assert!(within.iter().all(|&count| count >= 36), "{name}");
            assert!(squares.iter().all(|&square| square > 0.05 && square < 1.3), "{name}");
        }
    }
}

/// Exact bodies add no uncertainty; pieces and placed points keep it, and a placed fit has lost it.
#[test]
fn uncertainty_is_known_where_the_fit_is() {
    let mut random = Shares(5);
    let points = even(500, |x| x * x / 2.0 + 1e-4 * random.normal());
    let smooth = Fit { smooth: true, ..Fit::default() };
    let body = Spline::fitted(&points, smooth).unwrap();
    let load = Control::Load(0.02);
    let of = |lower: &dyn ParametricProfile<f64>, upper: &dyn ParametricProfile<f64>| {
        Contact::new(lower, upper).unwrap().solve(load).unwrap().uncertainty()
    };
    let alone = of(&Flat, &body).unwrap();
    assert!(alone.a > 0.0 && alone.peak_pressure > 0.0);
    // Exact bodies add nothing.
    let none = of(&Flat, &Spline::through(&even(50, |x| x * x / 2.0)).unwrap()).unwrap();
    assert_eq!(none, Uncertainty { a: 0.0, b: 0.0, half_width: 0.0, peak_pressure: 0.0 });
    // A piece of a longer body.
    let line = |on: [f64; 2], slope: f64, y: f64| {
        Curve::new(on, move |x| CurvePoint { x, y: y + slope * (x - on[0]), dx: 1.0, dy: slope })
    };
    let end = body.at(1.0).y;
    let parts: Vec<Box<dyn ParametricProfile<f64>>> =
        vec![Box::new(body.clone()), Box::new(line([1.0, 2.0], 1.0, end))];
    let joined = of(&Flat, &Piecewise::new(parts).unwrap()).unwrap();
    assert_relative_eq!(joined.half_width, alone.half_width, max_relative = 1e-9);
    // Placed, its deviation is not known.
    let placed = body.placed(Placement::default().mirrored()).unwrap();
    let error = of(&Flat, &placed).unwrap_err();
    assert!(matches!(error, ContactError::Evaluation(EvaluationError::NoUncertainty { .. })));
    let mirrored = Spline::fitted_at(&points, smooth, Placement::default().mirrored()).unwrap();
    let turned = of(&Flat, &mirrored).unwrap();
    assert_relative_eq!(turned.a, alone.b, max_relative = 1e-9);
    assert_relative_eq!(turned.b, alone.a, max_relative = 1e-9);
    let exact = Spline::through(&points).unwrap().placed(Placement::default().mirrored()).unwrap();
    assert_eq!(exact.slope_deviation(&[0.0], &[1.0]), Some(0.0));
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
    for limit in [0.0, -1.0, f64::NAN] {
        let fit = Fit { outliers: Some(limit), ..Fit::default() };
        let error = Spline::fitted(&points, fit).map(|_| ());
        assert!(matches!(error, Err(SplineError::Limit { .. })), "{limit}");
    }
    let huge: Vec<_> = points.iter().map(|&[x, y]| [x, 1e308 * (y - 0.5) * 3.0]).collect();
    let error =
        Spline::fitted(&huge, Fit { smooth: true, outliers: None, period: None }).map(|_| ());
    assert!(matches!(error, Err(SplineError::Overflow { row: 50, .. })), "{error:?}");
}

/// Exact points of a circle, a quartic and a wave at any x, far from even: a cubic through the
/// neighbours is off where they are far apart, and the curve of the fifth degree shows why.
#[test]
fn exact_points_at_uneven_places_are_no_outliers() {
    let quartic = |x: f64| 0.05 * x * x + 0.025 * x.powi(4);
    let wave = |x: f64| 0.05 * x * x - 1e-3 * (6.0 * x).cos();
    let (mut count, mut refused) = (0, 0);
    for seed in 1..=60 {
        for points in [20, 100, 1000] {
            for curve in [&circle(10.0) as &dyn Fn(f64) -> f64, &quartic, &wave] {
                let mut random = Shares(seed);
                let mut places: Vec<f64> = (0..points).map(|_| random.between(-1.0, 1.0)).collect();
                places.sort_by(f64::total_cmp);
                places.dedup_by(|x, before| *x - *before < 1e-5);
                let exact: Vec<_> = places.into_iter().map(|x| [x, curve(x)]).collect();
                count += 1;
                refused += usize::from(Spline::through(&exact).is_err());
            }
        }
    }
    println!("{refused} of {count} refused");
    assert!(50 * refused <= count, "{refused} of {count}");
}

#[test]
fn slips_of_the_measurement_are_found_and_nothing_else() {
    let noise = 1e-4;
    let mut random = Shares(11);
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
    for smooth in [false, true] {
        let body = Spline::fitted(&points, Fit { smooth, ..Fit::default() }).unwrap();
        let contact = Contact::new(&Flat, &body).unwrap();
        let solution = contact.solve(Control::Load(0.02)).unwrap();
        assert!((solution.a() / 0.2 - 1.0).abs() < 1e-3, "{smooth} {}", solution.a());
    }
}

#[test]
fn a_spline_and_its_pieces_tell_their_ranges_and_slopes() {
    // A parabola is reproduced exactly.
    let points = uneven(12, |x| x * x / 3.0);
    let spline = Spline::through(&points).unwrap();
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

/// In any unit the spline is the same, or an error says that its numbers are too large or too
/// small.
#[test]
fn points_of_any_size() {
    let height = |x: f64| 0.5 * x * x + 0.1 * x * x * x + 0.2 * (3.0 * x).sin();
    let points = |[along, across]: [f64; 2]| -> Vec<[f64; 2]> {
        (-10..=10).map(|i| 0.1 * f64::from(i)).map(|x| [x * along, height(x) * across]).collect()
    };
    let units = [1e-320, 1e-300, 1e-200, 1e-155, 1e-100, 1.0, 1e100, 1e160, 1e300, 1e308];
    for smooth in [false, true] {
        let fit = Fit { smooth, ..Fit::default() };
        let plain = Spline::fitted(&points([1.0; 2]), fit).unwrap();
        let mut made = 0;
        let pairs = units.map(|along| units[1..].iter().map(move |&across| [along, across]));
        for [along, across] in pairs.into_iter().flatten() {
            let body = match Spline::fitted(&points([along, across]), fit) {
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

#[test]
fn rows_of_placed_points_are_those_measured() {
    let (fit, to) = (Fit { smooth: true, ..Fit::default() }, Placement::default().mirrored());
    let mut points = even(50, |x| x * x);
    points[9][1] += 0.5;
    let error = Spline::fitted_at(&points, fit, to).unwrap_err();
    assert!(matches!(error, SplineError::Outlier { row: 10, .. }), "{error}");
    assert!(matches!(Spline::fitted_at(&[], fit, to), Err(SplineError::TooFew { .. })));
    let nowhere = Placement::default().scaled(0.0);
    assert!(Spline::fitted_at(&even(50, |x: f64| x * x), fit, nowhere).is_err());
}

#[test]
fn points_of_a_period_are_closed_to_it() {
    const PERIOD: f64 = 1.3;
    let mut random = Shares(11);
    for count in [4, 7, 40, 200] {
        let mut point = |i: i32| {
            let within = if i > 0 { random.between(0.0, 0.8) } else { 0.0 };
            let share = (f64::from(i) + within) / f64::from(count);
            [PERIOD * share, 0.3 * (2.0 * PI * share).sin() + 0.1 * random.normal()]
        };
        let mut points: Vec<_> = (0..count).map(&mut point).collect();
        let fit = Fit { outliers: None, period: Some(PERIOD), ..Fit::default() };
        let body = Spline::fitted(&points, fit).unwrap();
        assert_eq!(body.domain(), [0.0, PERIOD]);
        // Height, slope and curvature go on over the end; the slope of a piece is a parabola.
        let curvature = |piece: usize, end: usize| {
            let [from, to] = body.piece(piece).unwrap().x();
            let [g0, g1, g2] = [from, 0.5 * (from + to), to]
                .map(|x| body.piece(piece).unwrap().curve.slope_at(x).unwrap());
            [4.0 * g1 - 3.0 * g0 - g2, 3.0 * g2 - 4.0 * g1 + g0][end] / (to - from)
        };
        let [start, end] = [0.0, PERIOD].map(|x| body.at(x));
        let [bend, back] = [curvature(0, 0), curvature(count as usize - 1, 1)];
        assert!(
            (start.y - end.y).abs() < 1e-14
                && (start.dy - end.dy).abs() < 1e-11 * (1.0 + start.dy.abs()),
            "{count}"
        );
        assert!((bend - back).abs() < 1e-9 * (1.0 + bend.abs()), "{count}: {bend} {back}");
        // Where the period begins is of no account.
        let place = 0.37 * points[1][0] + 0.63 * points[2][0];
        points.rotate_left(2);
        points.iter_mut().rev().take(2).for_each(|point| point[0] += PERIOD);
        let again = Spline::fitted(&points, fit).unwrap();
        assert!((again.at(place + PERIOD).y - body.at(place).y).abs() < 1e-13, "{count}");
    }
}

#[test]
fn noisy_points_of_a_period_are_smoothed_over_its_end() {
    let (mut random, noise) = (Shares(5), 1e-4);
    let height = |x: f64| 0.01 * (2.0 * PI * x).cos() + 0.002 * (6.0 * PI * x).sin();
    let points: Vec<_> = (0..300)
        .map(|i| f64::from(i) / 300.0)
        .map(|x| [x, height(x) + noise * random.normal()])
        .collect();
    let fit = Fit { smooth: true, period: Some(1.0), ..Fit::default() };
    let body = Spline::fitted(&points, fit).unwrap();
    assert!((body.noise() / noise - 1.0).abs() < 0.1, "{}", body.noise());
    for x in [0.0, 0.001, 0.3, 0.5, 0.999, 1.0] {
        assert!((body.at(x).y - height(x)).abs() < 0.6 * noise, "{x}");
    }
    let contact = Contact::new(&Flat, &body).unwrap().contact_modulus(1.0).period(1.0);
    let solution = contact.solve(Control::Load(0.005)).unwrap();
    let exact = Curve::new([0.0, 1.0], |k: f64| CurvePoint {
        x: k,
        y: height(k),
        dx: 1.0,
        dy: PI * (0.012 * (6.0 * PI * k).cos() - 0.02 * (2.0 * PI * k).sin()),
    });
    let exact = Contact::new(&Flat, &exact).unwrap().contact_modulus(1.0).period(1.0);
    let width = exact.solve(Control::Load(0.005)).unwrap().hull().half_width();
    assert!((solution.hull().half_width() / width - 1.0).abs() < 1e-2);
    // The ends are known as well as the middle.
    let [end, middle] = [0.0, 0.5].map(|x| body.slope_deviation(&[x], &[1.0]).unwrap());
    assert!(middle > 0.0 && (end / middle - 1.0).abs() < 0.01, "{end} {middle}");
    let to = Placement::default().mirrored().flipped().scaled(3.0).shifted(0.2, 5.0);
    let placed = Spline::fitted_at(&points, fit, to).unwrap();
    let [from, end] = placed.domain();
    assert!(
        (end - from - 3.0).abs() < 1e-14 && (placed.at(from).y - placed.at(end).y).abs() < 1e-13
    );
    let turned = Spline::fitted_at(&points, fit, Placement::default().rotated(0.1));
    assert!(matches!(turned, Err(SplineError::Period { .. })));
    for period in [-1.0, 0.0, 0.9, 299.0 / 300.0, f64::NAN, f64::INFINITY] {
        let error =
            Spline::fitted(&points, Fit { period: Some(period), ..fit }).map(|_| ()).unwrap_err();
        assert!(
            matches!(error, SplineError::Period { last, .. } if last == 299.0 / 300.0),
            "{error}"
        );
    }
}

#[test]
fn points_of_a_period_go_on_over_its_end() {
    // The height of a wave that is not level jumps where it closes; a tilt by rounding is none.
    let wave = |tilt: f64, n: u32| -> Vec<_> {
        let x = (0..n).map(|i| f64::from(i) / f64::from(n));
        x.map(|x| [x, tilt * x - 1.5e-4 * (2.0 * PI * x).cos()]).collect()
    };
    let fit = Fit { period: Some(1.0), ..Fit::default() };
    for smooth in [false, true] {
        let fit = Fit { smooth, ..fit };
        let found = Spline::fitted(&wave(1e-4, 400), fit).map(|_| ());
        assert!(
            matches!(found, Err(SplineError::Outlier { row: 1..=2 | 399..=400, .. })),
            "{found:?}"
        );
        Spline::fitted(&wave(1e-16, 400), fit).unwrap();
    }
    // One point may be missing at the end, but not a part of the period.
    let points = wave(0.0, 400);
    Spline::fitted(&points[..399], fit).unwrap();
    for (points, period) in [(&points[..398], 1.0), (&points[..], 2.0)] {
        let fit = Fit { outliers: None, period: Some(period), ..fit };
        let error = Spline::fitted(points, fit).map(|_| ()).unwrap_err();
        assert!(matches!(error, SplineError::Period { .. }), "{error}");
    }
}
