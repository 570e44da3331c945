//! Certificates of right answers: none is refused. Chains of arcs, two of them with joints at the
//! same places, B-splines in the plane and splines through exact points, near the origin and far.

use super::{Bodies, Dice, SPLINES, judge, scenes};
use crate::common::{Profile, intervals, pieces};
use linecontact::profile::{Ellipse, Placed, Placement, Spline};
use linecontact::{Contact, Control, Curve, CurvePoint, Flat, ParametricProfile, Piecewise};
use std::f64::consts::PI;

/// Returns an arc of a circle above its lowest point, as a shape or as a closure.
fn arc(is_shape: bool, radius: f64, angles: [f64; 2], [x, y]: [f64; 2]) -> Profile {
    if is_shape {
        let circle = Ellipse::circle(radius, angles).unwrap();
        return Box::new(Placed::new(circle, Placement::default().shifted(x, y)).unwrap());
    }
    Box::new(Curve::new(angles, move |k: f64| {
        let (sin, cos) = k.sin_cos();
        let (y, dy) = (y + radius * (1.0 - cos), radius * sin);
        CurvePoint { x: x + radius * sin, y, dx: radius * cos, dy }
    }))
}

/// Returns arcs that meet at given places without a kink, or at kinks that bulge; `sign` is -1 for
/// a lower body.
fn chain(dice: &mut Dice, joints: &[f64], sign: f64) -> Profile {
    let [is_shape, is_kinked] = [0.5; 2].map(|share| dice.uniform() < share);
    let (from, to) = (joints[0], joints[joints.len() - 1]);
    let radius = |dice: &mut Dice| (to - from) * dice.power_of_ten(0.0, 1.0);
    let mut sine = 0.5 * (from - to) / radius(dice);
    let (mut at, mut parts) = ([from, 0.0], Vec::new());
    for pair in joints.windows(2) {
        let (radius, angle) = (radius(dice), sine.asin());
        let lowest = [at[0] - radius * sine, at[1] - radius * (1.0 - angle.cos())];
        let end = ((pair[1] - lowest[0]) / radius).asin();
        let part = arc(is_shape, radius, [angle, end], lowest);
        at = [lowest[0] + radius * end.sin(), lowest[1] + radius * (1.0 - end.cos())];
        sine = end.sin() + if is_kinked { dice.power_of_ten(-6.0, -2.0) } else { 0.0 };
        let to = Placement::default();
        let to = if sign < 0.0 { to.flipped() } else { to };
        parts.push(Box::new(Placed::new(part, to).unwrap()) as Profile);
    }
    Box::new(Piecewise::with_tolerance(parts, 1e-9).unwrap())
}

/// Returns one or two chains with joints at the same places.
fn chains(dice: &mut Dice, origin: f64, is_pair: bool) -> [Profile; 2] {
    let mut joints: Vec<f64> = (0..3 + (4.0 * dice.uniform()) as usize)
        .map(|i| origin + i as f64 + dice.within(-0.4, 0.4))
        .collect();
    joints.sort_by(f64::total_cmp);
    let lower = if is_pair { chain(dice, &joints, -1.0) } else { Box::new(Flat) };
    [lower, chain(dice, &joints, 1.0)]
}

/// Returns a cubic B-spline, X rising, on a plane. Its 7 to 40 control points are off a parabola.
fn b_spline(dice: &mut Dice, origin: f64) -> [Profile; 2] {
    let count = dice.power_of_ten(7f64.log10(), 1.6) as usize;
    let step = 2.0 / (count - 1) as f64;
    let rough = dice.power_of_ten(-5.0, -0.5) * step * step;
    let mut control = |i: usize| {
        let x = -1.0 + step * (i as f64 + dice.within(-0.3, 0.3));
        [origin + x, x * x / 2.0 + rough * dice.within(-1.0, 1.0)]
    };
    let controls: Vec<[f64; 2]> = (0..count).map(&mut control).collect();
    let piece = |i: usize| -> Profile {
        let near: [[f64; 2]; 4] = std::array::from_fn(|j| controls[i + j]);
        Box::new(Curve::new([i as f64, i as f64 + 1.0], move |k: f64| {
            let (t, s) = (k - i as f64, i as f64 + 1.0 - k);
            let inner = |t: f64| 4.0 + t * t * (3.0 * t - 6.0);
            let slope = |t: f64| t * (1.5 * t - 2.0);
            let sum = |weights: [f64; 4], i: usize| -> f64 {
                weights.iter().zip(near).map(|(w, point)| w * point[i]).sum()
            };
            let [x, y] = [0, 1].map(|i| sum([s * s * s, inner(t), inner(s), t * t * t], i) / 6.0);
            let [dx, dy] = [0, 1].map(|i| sum([-0.5 * s * s, slope(t), -slope(s), 0.5 * t * t], i));
            CurvePoint { x, y, dx, dy }
        }))
    };
    let body = Piecewise::with_tolerance((0..count - 3).map(piece).collect(), 1e-9).unwrap();
    [Box::new(Flat), Box::new(body)]
}

/// Returns the spline through exact points of a parabola and a wave, 20 to 600, on a plane.
fn points(dice: &mut Dice, origin: f64) -> [Profile; 2] {
    let count = dice.power_of_ten(1.3, 2.8) as usize;
    let (w, phase) = (dice.power_of_ten(0.0, 1.3), dice.within(-PI, PI));
    let wave = dice.power_of_ten(-3.0, 0.3) / (w * w);
    let at = |i: usize| {
        let x = -1.0 + 2.0 * i as f64 / (count - 1) as f64;
        [origin + x, x * x / 2.0 + wave * (w * x + phase).cos()]
    };
    let points: Vec<_> = (0..count).map(at).collect();
    [Box::new(Flat), Box::new(Spline::through(&points).unwrap())]
}

/// Returns the height at a place, by bisection for the parameter.
fn height(body: &dyn ParametricProfile<f64>, x: f64) -> f64 {
    let pieces = pieces(body);
    let Some(last) = pieces.len().checked_sub(1) else { return 0.0 };
    let piece = pieces.iter().find(|piece| x <= piece.x()[1]).unwrap_or(&pieces[last]);
    let [mut from, mut to] = piece.k;
    for _ in 0..60 {
        let k = 0.5 * (from + to);
        *(if piece.curve.at(k).x < x { &mut from } else { &mut to }) = k;
    }
    piece.curve.at(from).y
}

/// The seeds by number were accused, or not solved, by an inversion for a place between two joints
/// within rounding.
#[test]
fn right_answers_are_certified() {
    let (mut accused, mut certified, mut refused) = (Vec::new(), 0, 0);
    for seed in scenes(100).chain([5089, 15233]) {
        let dice = &mut Dice::new(seed);
        let origin = if dice.uniform() < 0.5 { 0.0 } else { dice.power_of_ten(-1.0, 4.0) };
        let [lower, upper] = match seed % 4 {
            0 => chains(dice, origin, false),
            1 => chains(dice, origin, true),
            2 => b_spline(dice, origin),
            _ => points(dice, origin),
        };
        let load = dice.power_of_ten(-7.0, -1.5);
        let contact = Contact::new(&*lower, &*upper).unwrap();
        let solution = match contact.solve(Control::Load(load)) {
            Ok(solution) => solution,
            Err(error) => {
                refused += 1;
                if error.to_string().contains("inverted") {
                    accused.push(format!("{seed}: {error}"));
                }
                continue;
            }
        };
        let Err(error) = solution.certify() else {
            certified += 1;
            continue;
        };
        let gap = |x: f64| height(&*upper, x) - height(&*lower, x);
        let [from, to] = contact_range(&*upper);
        let places = (0..=4000).map(|i| from + (to - from) * f64::from(i) / 4000.0).collect();
        let faults = judge(
            &Bodies { tail: super::TAIL[0], height: &gap, kappa: 1.0, places },
            &solution,
            load,
        );
        if !faults.is_wrong(SPLINES) {
            accused.push(format!("{seed}, {:?}: {error}", intervals(&solution)));
        }
    }
    println!("{certified} certified, {refused} not solved");
    assert!(certified > 80 && accused.is_empty(), "{}", accused.join("\n"));
}

/// Returns the ends of a body of pieces; those of a chain below it are the same.
fn contact_range(body: &dyn ParametricProfile<f64>) -> [f64; 2] {
    let pieces = pieces(body);
    [pieces[0].x()[0], pieces[pieces.len() - 1].x()[1]]
}
