//! Largest pressures and stresses of random bodies, against values at places that crowd wherever a
//! larger one could hide.
//!
//! Scene i is the same in every run. `SCENES=n` in the environment runs n scenes of each test.
#![allow(missing_docs)]

use crate::common::{self, Profile, Shares, graph, join};
use linecontact::profile::Spline;
use linecontact::{
    Contact, ContactError, Control, Cost, EvaluationError, Flat, Interval, Solution,
};

/// Number of places at which a pressure is compared with the largest.
const PLACES: usize = 10_000;

/// Body, joints of its pieces, and a load.
struct Body {
    family: &'static str,
    profile: Profile,
    joints: Vec<f64>,
    load: f64,
}

/// Returns parabolas of these curvatures that meet at `joints`, where the slope jumps up by
/// `jumps`; height and slope are zero at 0.
fn pieces([from, to]: [f64; 2], joints: &[f64], curvatures: &[f64], jumps: &[f64]) -> Profile {
    let ends: Vec<f64> = [from].into_iter().chain(joints.iter().copied()).chain([to]).collect();
    let middle = ends[1..].iter().position(|&end| end > 0.0).expect("0 lies on a piece");
    let at = |[x0, y, dy]: [f64; 3], c: f64, x: f64| {
        let t = x - x0;
        [x, y + t * (dy + 0.5 * c * t), dy + c * t]
    };
    // A point of each piece: the middle one starts at 0, the others at the joint with their
    // neighbour.
    let mut starts = vec![[0.0; 3]; curvatures.len()];
    for i in middle + 1..curvatures.len() {
        let [x, y, dy] = at(starts[i - 1], curvatures[i - 1], ends[i]);
        starts[i] = [x, y, dy + jumps[i - 1]];
    }
    for i in (0..middle).rev() {
        let [x, y, dy] = at(starts[i + 1], curvatures[i + 1], ends[i + 1]);
        starts[i] = [x, y, dy - jumps[i]];
    }
    let curves = curvatures.iter().zip(starts).enumerate().map(|(i, (&c, start))| {
        graph(ends[i], ends[i + 1], move |x| {
            let [_, y, dy] = at(start, c, x);
            [y, dy]
        })
    });
    join(curves.collect())
}

fn punch(dice: &mut Shares) -> Body {
    let radii = [0; 2].map(|_| dice.power_of_ten(-3.0, -0.5));
    let crown = if dice.between(0.0, 1.0) < 0.5 { 0.0 } else { dice.power_of_ten(-5.0, -2.0) };
    let curvatures = [1.0 / radii[0], crown, 1.0 / radii[1]];
    let profile = pieces([-1.0 - radii[0], 1.0 + radii[1]], &[-1.0, 1.0], &curvatures, &[0.0; 2]);
    let load = dice.power_of_ten(-5.0, -2.0);
    Body { family: "punch", profile, joints: vec![-1.0, 1.0], load }
}

fn arcs(dice: &mut Shares) -> Body {
    let count = 3 + dice.between(0.0, 8.0) as usize;
    let mut joints: Vec<f64> = (1..count).map(|_| dice.between(-1.0, 1.0)).collect();
    joints.sort_by(f64::total_cmp);
    let curvatures: Vec<f64> = (0..count).map(|_| dice.power_of_ten(-2.0, 2.0)).collect();
    let profile = pieces([-2.0, 2.0], &joints, &curvatures, &vec![0.0; count - 1]);
    Body { family: "arcs", profile, joints, load: dice.power_of_ten(-4.0, 0.0) }
}

/// Returns a polygon with rounded faces: the pressure is infinite at each corner.
fn polygon(dice: &mut Shares) -> Body {
    let count = 2 + dice.between(0.0, 5.0) as usize;
    let mut joints: Vec<f64> = (1..count).map(|_| dice.between(-1.0, 1.0)).collect();
    joints.sort_by(f64::total_cmp);
    let jumps: Vec<f64> = (1..count).map(|_| dice.power_of_ten(-3.0, -1.0)).collect();
    let profile = pieces([-2.0, 2.0], &joints, &vec![0.1; count], &jumps);
    Body { family: "polygon", profile, joints, load: dice.power_of_ten(-4.0, -1.0) }
}

fn waves(dice: &mut Shares) -> Body {
    let [w, phase] = [dice.between(3.0, 90.0), dice.between(0.0, 6.3)];
    let a = dice.between(0.0, 4.0) / (w * w);
    let profile = graph(-1.0, 1.0, move |x| {
        [x * x / 2.0 + a * (w * x + phase).cos(), x - a * w * (w * x + phase).sin()]
    });
    Body { family: "waves", profile, joints: vec![], load: dice.power_of_ten(-4.0, -1.0) }
}

fn spline(dice: &mut Shares) -> Body {
    let count = 20 + dice.between(0.0, 200.0) as usize;
    let rough = dice.power_of_ten(-7.0, -3.0);
    let x = |i: usize| -1.0 + 2.0 * i as f64 / (count - 1) as f64;
    let points: Vec<[f64; 2]> =
        (0..count).map(|i| [x(i), x(i) * x(i) / 2.0 + dice.between(-rough, rough)]).collect();
    let profile = Box::new(Spline::through(&points).expect("points rise"));
    let joints = points[1..count - 1].iter().map(|point| point[0]).collect();
    Body { family: "spline", profile, joints, load: dice.power_of_ten(-4.0, -1.0) }
}

fn body(number: u64) -> Body {
    let mut dice = Shares(0x9E37_79B9 * (number + 1));
    dice.between(0.0, 1.0);
    [punch, arcs, polygon, waves, spline][(number % 5) as usize](&mut dice)
}

/// Returns places inside a contact, half of them uniform in the angle and half graded to the limits
/// and joints.
fn places(on: Interval<f64>, joints: &[f64], count: usize) -> Vec<f64> {
    let inside = joints.iter().copied().filter(|&joint| on.contains(joint));
    let ends: Vec<f64> = [on.left].into_iter().chain(inside).chain([on.right]).collect();
    let each = 1 + count / (ends.len() - 1);
    let mut places = Vec::new();
    for ends in ends.windows(2) {
        let (left, length) = (ends[0], ends[1] - ends[0]);
        for i in 0..each {
            let share = (i as f64 + 0.5) / each as f64;
            places.push(match i % 4 {
                0 | 2 => left + length * (0.5 * std::f64::consts::PI * share).sin().powi(2),
                1 => left + 0.5 * length * 1e-12f64.powf(share),
                _ => ends[1] - 0.5 * length * 1e-12f64.powf(share),
            });
        }
    }
    places.retain(|&x| on.contains(x) && !ends.contains(&x));
    places
}

/// Returns the largest excess of a pressure over the peak, beyond its error, as a share of the
/// peak.
fn pressure_above(solution: &Solution<f64>, body: &Body) -> f64 {
    let pressure = solution.pressure().unwrap();
    let contacts: Vec<Interval<f64>> = common::intervals(solution);
    let infinite = |x: f64| {
        matches!(pressure.at(x), Err(ContactError::Evaluation(EvaluationError::Singular { .. })))
    };
    let peak = match solution.peak() {
        Ok(peak) => peak,
        Err(ContactError::Evaluation(EvaluationError::Singular { x })) if infinite(x) => {
            return 0.0;
        }
        Err(error) => panic!("{}: {error}", body.family),
    };
    let mut above = (pressure.at(peak.x).unwrap() / peak.pressure - 1.0).abs() - 1e-13;
    for &on in &contacts {
        let x = places(on, &body.joints, PLACES / contacts.len());
        let mut pressures = vec![0.0; x.len()];
        pressure.at_many(&x, &mut pressures).unwrap();
        for (&x, there) in x.iter().zip(pressures) {
            if there > peak.pressure * (1.0 + 1e-13) {
                let error = pressure.estimate(x, &mut Cost::default()).unwrap().error;
                above = above.max((there - error) / peak.pressure - 1.0 - 1e-13);
            }
        }
    }
    above
}

/// Passes the solutions of the first scenes to `look` and counts them; prints refused scenes.
fn scenes(count: u64, mut look: impl FnMut(u64, &Body, &Solution<f64>)) -> u64 {
    let count = std::env::var("SCENES").ok().and_then(|n| n.parse().ok()).unwrap_or(count);
    let mut solved = 0;
    for number in 0..count {
        let body = body(number);
        let contact = Contact::new(&Flat, &*body.profile).unwrap();
        match contact.solve(Control::Load(body.load)) {
            Ok(solution) => {
                solved += 1;
                look(number, &body, &solution);
            }
            Err(error) => eprintln!("{number} {}: {error}", body.family),
        }
    }
    solved
}

#[test]
fn no_pressure_is_above_the_peak() {
    let mut wrong = Vec::new();
    let solved = scenes(1000, |number, body, solution| {
        let above = pressure_above(solution, body);
        if above > 0.0 {
            wrong.push(format!("{number} {} {above:e}", body.family));
        }
    });
    eprintln!("solved {solved}");
    assert!(wrong.is_empty(), "{} of {solved}: {wrong:#?}", wrong.len());
}

/// Returns places and depths graded to the limits, the joints and the surface.
fn graded(on: Interval<f64>, joints: &[f64]) -> Vec<[f64; 2]> {
    let (half_width, inside) =
        (on.half_width(), joints.iter().filter(|&&joint| on.contains(joint)));
    let features: Vec<f64> = [on.left, on.right].into_iter().chain(inside.copied()).collect();
    let mut places = Vec::new();
    let depth = |i: i32| half_width * 10f64.powf(0.6 - 0.25 * f64::from(i));
    for i in 0..28 {
        for away in [-1.0, -0.3, 0.0, 0.3, 1.0] {
            places.extend(features.iter().map(|x| [x + away * depth(i), depth(i)]));
            places.extend(features.iter().map(|x| [x + away * depth(i), 0.0]));
        }
        for j in 0..16 {
            places.push([on.left + 2.0 * half_width * (f64::from(j) + 0.5) / 16.0, depth(i)]);
        }
    }
    places
}

#[test]
fn no_stress_is_above_the_largest() {
    let mut wrong = Vec::new();
    let solved = scenes(8, |number, body, solution| {
        // An integral over so many pieces takes too long.
        if body.family == "spline" {
            return;
        }
        for friction in [0.0, 0.3] {
            let below = solution.subsurface().unwrap().friction(friction).unwrap();
            let [shear, mises] = [below.max_shear(), below.max_von_mises(0.3)];
            let [mut above_shear, mut above_mises] = [0.0f64; 2];
            for on in common::intervals(solution) {
                for [x, depth] in graded(on, &body.joints) {
                    let Ok(stress) = below.at(x, depth) else { continue };
                    if let Ok(shear) = &shear {
                        above_shear = above_shear.max(stress.max_shear() / shear.value - 1.0);
                    }
                    if let Ok(mises) = &mises {
                        above_mises =
                            above_mises.max(stress.von_mises(0.3).unwrap() / mises.value - 1.0);
                    }
                }
            }
            if above_shear.max(above_mises) > 1e-9 {
                wrong.push(format!(
                    "{number} {} {friction}: {above_shear:e} {above_mises:e}",
                    body.family
                ));
            }
        }
    });
    assert!(wrong.is_empty(), "{} of {solved}: {wrong:#?}", wrong.len());
}
