//! Outliers among points of lines and arcs: a jump of the curvature is none.
//!
//! Scene i is the same in every run. `SCENES=n` in the environment runs n scenes.

use crate::common::Shares;
use linecontact::profile::{Fit, Spline, SplineError};

/// Lines and arcs that meet without a kink: curvature and length along x of each.
struct Arcs {
    /// Place, height, sine of the slope angle and curvature at the start of each.
    starts: Vec<[f64; 4]>,
    end: f64,
}

impl Arcs {
    fn new(sine: f64, parts: &[[f64; 2]]) -> Self {
        let (mut starts, mut end) = (Vec::new(), [0.0, 0.0, sine]);
        for &[curvature, length] in parts {
            let [x, y, sine] = end;
            starts.push([x, y, sine, curvature]);
            end = along([x, y, sine, curvature], x + length);
        }
        Self { starts, end: end[0] }
    }

    fn height(&self, x: f64) -> f64 {
        let part = self.starts.iter().rev().find(|start| start[0] <= x).unwrap_or(&self.starts[0]);
        along(*part, x)[1]
    }

    /// Returns points at equal distances.
    fn points(&self, step: f64, shares: &mut Shares) -> Vec<[f64; 2]> {
        let first = shares.between(0.0, step);
        let n = ((self.end - first) / step) as u32;
        (0..=n).map(|i| first + step * f64::from(i)).map(|x| [x, self.height(x)]).collect()
    }
}

/// Follows an arc, given by its start, up to a place.
fn along([from, height, sine, curvature]: [f64; 4], x: f64) -> [f64; 3] {
    let last = sine + curvature * (x - from);
    let cosines = (1.0 - sine * sine).sqrt() + (1.0 - last * last).sqrt();
    [x, height + (sine + last) * (x - from) / cosines, last]
}

/// Returns a line and an arc, the head of a rail, or a tread from its flange to its outer side;
/// none steeper than 65°.
fn body(kind: u64, shares: &mut Shares) -> Arcs {
    let mut about = |size: f64| size * shares.between(0.7, 1.3);
    match kind % 3 {
        0 => {
            let radius = about(10.0);
            Arcs::new(0.0, &[[0.0, about(1.0)], [1.0 / radius, radius * about(0.15)]])
        }
        1 => {
            let [corner, side, crown] = [about(13.0), about(80.0), about(300.0)];
            let ([steep, end], lengths) = ([about(0.7), about(0.7)], [16.0, 20.0, 16.0].map(about));
            let curvatures = [1.0 / side, 1.0 / crown, 1.0 / side];
            let head: Vec<_> = curvatures.into_iter().zip(lengths).map(|(c, l)| [c, l]).collect();
            let sine: f64 = -0.5 * head.iter().map(|[c, l]| c * l).sum::<f64>();
            let first = [1.0 / corner, corner * (steep + sine)];
            let last = [1.0 / corner, corner * (end + sine)];
            Arcs::new(-steep, &[&[first], &head[..], &[last]].concat())
        }
        _ => {
            let (steep, tip) = (about(0.7), about(20.5));
            // The flange, its root, the tread, its line and a chamfer.
            let (mut sine, mut parts) = (steep, vec![[1.0 / tip, tip * steep], [0.0, about(1.0)]]);
            for (radius, share) in [(13.0, 0.6), (40.0, 0.6), (100.0, 0.4), (330.0, 0.5)] {
                let (radius, turned) = (about(radius), about(share) * (sine - 0.02));
                parts.push([-1.0 / radius, turned * radius]);
                sine -= turned;
            }
            parts.extend([[0.0, about(20.0)], [1.0 / about(3.0), 0.8]]);
            Arcs::new(0.0, &parts)
        }
    }
}

fn seeds(default: u64) -> std::ops::Range<u64> {
    0..std::env::var("SCENES").map_or(default, |count| count.parse().unwrap())
}

/// Returns a body, points of it, 5 to 100 a millimetre, and their noise.
fn scene(seed: u64) -> (Arcs, Vec<[f64; 2]>, f64) {
    let mut shares = Shares(seed + 1);
    (0..3).for_each(|_| _ = shares.between(0.0, 1.0));
    let arcs = body(seed, &mut shares);
    let mut points = arcs.points(1.0 / shares.power_of_ten(5f64.log10(), 2.0), &mut shares);
    let noise = if (seed / 3).is_multiple_of(2) { 0.0 } else { shares.power_of_ten(-7.0, -4.0) };
    points.iter_mut().for_each(|point| point[1] += noise * shares.normal());
    (arcs, points, noise)
}

#[test]
fn a_line_and_an_arc() {
    let height = |x: f64| if x < 0.0 { 0.0 } else { 10.0 - (100.0 - x * x).sqrt() };
    let points: Vec<_> =
        (0..=100).map(|i| 0.02 * f64::from(i) - 1.0).map(|x| [x, height(x)]).collect();
    Spline::through(&points).map(|_| ()).unwrap();
    for row in [1, 2, 3, 20, 49, 50, 51, 52, 53, 80, 99, 100, 101] {
        let mut bad = points.clone();
        bad[row - 1][1] += 1e-3;
        let error = Spline::through(&bad).map(|_| ()).unwrap_err();
        assert!(
            matches!(error, SplineError::Outlier { row: found, .. } if found == row),
            "{error}"
        );
    }
}

/// Errors that neighbouring points share, as of dust, are found as well.
#[test]
fn errors_side_by_side() {
    let points: Vec<_> =
        (-50..=50).map(|i| 0.02 * f64::from(i)).map(|x| [x, 0.1 * x.cos()]).collect();
    for off in [&[1.0, 1.0][..], &[1.0, -1.0], &[1.0; 3], &[1.0; 50]] {
        let mut bad = points.clone();
        bad[40..].iter_mut().zip(off).for_each(|(point, off)| point[1] += 1e-3 * off);
        let found = Spline::through(&bad).map(|_| ());
        assert!(matches!(found, Err(SplineError::Outlier { .. })), "{off:?}: {found:?}");
    }
}

/// Heights that differ are shown with the digits in which they do.
#[test]
fn the_message_tells_two_heights_apart() {
    let mut points: Vec<_> =
        (-50..=50).map(|i| 0.02 * f64::from(i)).map(|x| [x, 14.0 + x.cos()]).collect();
    points[50][1] += 1e-6;
    let text = Spline::through(&points).map(|_| ()).unwrap_err().to_string();
    assert!(text.contains("y = 15.000001 at x = 0, where its neighbours suggest 15: "), "{text}");
    assert!(text.contains("curvature"), "{text}");
}

#[test]
fn a_jump_of_the_curvature_is_no_outlier() {
    let (mut faults, mut scenes) = (Vec::new(), 0);
    for seed in seeds(100) {
        let (_, points, noise) = scene(seed);
        scenes += 1;
        if let Err(error) = Spline::through(&points) {
            faults.push(format!("{seed}, noise {noise:e}, {} points: {error}", points.len()));
        }
    }
    println!("{scenes} scenes, {} refused", faults.len());
    assert!(2000 * faults.len() <= scenes, "{}", faults.join("\n"));
}

/// Returns how far a point stands out by fourth differences, in standard deviations estimated from
/// their medians everywhere and among 21 points.
fn deviations(points: &[[f64; 2]], row: usize) -> f64 {
    let difference = |five: &[[f64; 2]]| {
        let sum: f64 = five.iter().zip([1.0, -4.0, 6.0, -4.0, 1.0]).map(|(p, c)| c * p[1]).sum();
        sum.abs() / 70f64.sqrt()
    };
    let all: Vec<_> = points.windows(5).map(difference).collect();
    let (at, median) = (row - 3, |part: &[f64]| {
        let mut part = part.to_vec();
        part.sort_by(f64::total_cmp);
        part[part.len() / 2]
    });
    all[at] / 1.4826 / median(&all).max(median(&all[at - 10..=at + 10]))
}

/// In smooth parts of the bodies points are found as by fourth differences alone, from 1.1 times
/// the limit on. (Noise decides at the limit itself, and may name the next row.)
#[test]
fn slips_are_found_beside_jumps_of_the_curvature() {
    let (mut faults, mut found, mut scenes) = (Vec::new(), 0, 0);
    for seed in seeds(100) {
        let (arcs, mut points, noise) = scene(seed);
        let mut shares = Shares(seed + 1_000_000);
        (0..3).for_each(|_| _ = shares.between(0.0, 1.0));
        if points.len() < 40 {
            continue;
        }
        let row = shares.between(14.0, points.len() as f64 - 13.0) as usize;
        let [from, to] = [points[row - 7][0], points[row + 5][0]];
        if arcs.starts.iter().any(|start| from < start[0] && start[0] < to) {
            continue;
        }
        // Exact heights of a line are taken for heights in steps: an error shows from the least on.
        let slip = if noise > 0.0 { noise * shares.between(6.0, 14.0) } else { 0.01 };
        points[row - 1][1] += slip;
        if deviations(&points, row) < 5.5 {
            continue;
        }
        scenes += 1;
        let fit = Fit { outliers: Some(5.0), ..Fit::default() };
        match Spline::fitted(&points, fit).map(|_| ()) {
            Err(SplineError::Outlier { row: at, .. }) if at.abs_diff(row) < 2 => found += 1,
            other => faults.push(format!("{seed}, row {row}, noise {noise:e}: {other:?}")),
        }
    }
    println!("{found} slips of {scenes} found");
    assert!(scenes > 30 && 2000 * faults.len() <= scenes, "{}", faults.join("\n"));
}
