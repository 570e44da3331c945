//! Joints of pieces: the size by which a jump of Y is measured.
#![allow(missing_docs)]

use crate::common::{Profile, graph, intervals, join, on_flat, quartic};
use crate::random_scenes::Dice;
use approx::assert_relative_eq;
use linecontact::{Control, Curve, CurvePoint, Piecewise, PiecewiseError};
use std::f64::consts::PI;
use std::sync::Arc;

/// Body in pieces.
struct Body {
    /// Height and slope `[Y, Y']` of each piece by x.
    height: Box<dyn Fn(usize, f64) -> [f64; 2] + Send + Sync>,
    /// Ends of each piece.
    ends: Vec<[f64; 2]>,
    /// Height of the body.
    size: f64,
}

/// Returns scallops, waves cut at their zeros, or wedges, at x = 0 or far from it. Neighbouring
/// ends differ by rounding: one is a sum, the other a product.
fn body(dice: &mut Dice) -> Body {
    let pieces = 2 + (6.0 * dice.uniform()) as usize;
    let [size, period] = [dice.power_of_ten(-6.0, 3.0), dice.power_of_ten(-3.0, 2.0)];
    let far = if dice.uniform() < 0.5 { 0.0 } else { dice.power_of_ten(0.0, 4.0) };
    let from = dice.within(-1.0, 1.0) * far * period;
    let height: Box<dyn Fn(usize, f64) -> [f64; 2] + Send + Sync> =
        match (3.0 * dice.uniform()) as u32 {
            0 => Box::new(move |i, x| {
                let z = (x - from) / period - i as f64 - 0.5;
                [size * (z * z - 0.25), 2.0 * size * z / period]
            }),
            1 => Box::new(move |i, x| {
                let (sin, cos) = (PI * (x - from) / period).sin_cos();
                let sign = if i % 2 == 0 { size } else { -size };
                [sign * sin, sign * cos * PI / period]
            }),
            _ => Box::new(move |i, x| {
                let (steps, slope) = (x - from - (i + i % 2) as f64 * period, size / period);
                let slope = if i % 2 == 0 { slope } else { -slope };
                [slope * steps, slope]
            }),
        };
    let mut sum = from;
    let ends = (0..pieces).map(|i| {
        sum += period;
        [from + i as f64 * period, sum]
    });
    Body { height, ends: ends.collect(), size }
}

/// Returns a body with X and Y scaled, and lifted from one piece on.
fn built(
    body: &Arc<Body>,
    [wide, high]: [f64; 2],
    (first, by): (usize, f64),
) -> Result<Piecewise<f64, Profile>, PiecewiseError<f64>> {
    let piece = |(i, &ends): (usize, &[f64; 2])| -> Profile {
        let body = body.clone();
        let up = if i >= first { by } else { 0.0 };
        Box::new(Curve::new(ends, move |k: f64| {
            let [y, slope] = (body.height)(i, k);
            CurvePoint { x: wide * k, y: high * (y + up), dx: wide, dy: high * slope }
        }))
    };
    Piecewise::new(body.ends.iter().enumerate().map(piece).collect())
}

/// In any unit of X and Y, pieces that meet at Y = 0 to within rounding are joined. A step a
/// thousand times the rounding of Y, or of X on a steep piece, is refused.
#[test]
fn random_joints_at_height_zero() {
    let (mut refused, mut passed, scenes) = (Vec::new(), Vec::new(), 2000);
    for seed in 0..scenes {
        let mut dice = Dice::new(seed);
        let body = Arc::new(body(&mut dice));
        let unit = |dice: &mut Dice| 2f64.powi(dice.within(-60.0, 60.0) as i32);
        let units = [[1.0, 1.0], [unit(&mut dice), 1.0], [1.0, unit(&mut dice)]];
        let first = 1 + (dice.uniform() * (body.ends.len() - 1) as f64) as usize;
        let [from, to] = [body.ends[0][0], body.ends[body.ends.len() - 1][1]];
        let steepest = PI * body.size / (body.ends[0][1] - body.ends[0][0]);
        let step = 3e-11 * (body.size + steepest * from.abs().max(to.abs()));
        for unit in units {
            refused.extend(built(&body, unit, (0, 0.0)).err().map(|error| (seed, error)));
            passed.extend(built(&body, unit, (first, step)).is_ok().then_some((seed, unit)));
        }
    }
    println!("{} of {scenes} refused, {} steps passed", refused.len(), passed.len());
    assert!(refused.is_empty(), "{:?}", refused[0]);
    assert!(passed.is_empty(), "{:?}", passed[0]);
}

/// A long, level body has no height by which a step could be negligible.
#[test]
fn steps_on_long_flat_bodies_are_refused() {
    let level = |from: f64, to: f64, up: f64| graph(from, to, move |_| [up, 0.0]);
    let bulge = |x: f64| [1e-6 * x * x, 2e-6 * x];
    for up in [1e-30, 1e-9, -1e-3] {
        let bodies: [Vec<Profile>; 3] = [
            vec![level(-1e6, 0.0, 0.0), level(0.0, 1e6, up)],
            vec![level(1e6, 2e6, 7.0), level(2e6, 3e6, 7.0 * (1.0 + 1e-13) + up)],
            vec![graph(-1.0, 0.0, bulge), level(0.0, 1e9, up.signum() * up.abs().max(1e-18))],
        ];
        for (i, body) in bodies.into_iter().enumerate() {
            let error = Piecewise::new(body).map(|_| ()).unwrap_err();
            assert!(matches!(error, PiecewiseError::Jump { breakpoint: 1, .. }), "{i}: {error}");
        }
    }
}

/// A step is also refused where the pieces are upright.
#[test]
fn steps_beside_upright_ends_are_refused() {
    let arc = |from: f64, to: f64, up: f64| -> Profile {
        Box::new(Curve::new([from, to], move |k: f64| {
            let (sin, cos) = k.sin_cos();
            CurvePoint { x: sin, y: up + 1.0 - cos, dx: cos, dy: sin }
        }))
    };
    let beyond = |x: f64| graph(1.0, 2.0, move |_| [x, 0.0]);
    let quarter = || arc(0.0, PI / 2.0, 0.0);
    assert!(Piecewise::new(vec![quarter(), beyond(1.0)]).is_ok());
    let error = Piecewise::new(vec![quarter(), beyond(1.0 + 1e-5)]).map(|_| ()).unwrap_err();
    assert!(matches!(error, PiecewiseError::Jump { .. }), "{error}");
}

/// `|T₃|/3`, cut at the zeros of the polynomial, touches on the preimages of a wedge's contact,
/// `|v| ≤ π F/2`.
#[test]
fn a_polynomial_cut_at_its_zeros() {
    let zeros: Vec<f64> = (0..3).map(|i| -(PI * (2.0 * f64::from(i) + 1.0) / 6.0).cos()).collect();
    let [low, high] = [-1.0, 1.0];
    let cuts = [low, zeros[0], zeros[1], zeros[2], high];
    let side = |i: usize| {
        let sign = if i.is_multiple_of(2) { -1.0 / 3.0 } else { 1.0 / 3.0 };
        graph(cuts[i], cuts[i + 1], move |x| {
            [sign * x * (4.0 * x * x - 3.0), sign * (12.0 * x * x - 3.0)]
        })
    };
    let load = 0.3;
    let contact = on_flat(join((0..4).map(side).collect()));
    let solution = contact.solve(Control::Load(load)).unwrap();
    let contacts = intervals(&solution);
    assert_eq!(contacts.len(), 3);
    let angle = (PI * load / 2.0).asin() / 3.0;
    for (i, on) in contacts.iter().enumerate() {
        let middle = PI * (2.0 * i as f64 + 1.0) / 6.0;
        assert_relative_eq!(on.left, -(middle - angle).cos(), epsilon = 1e-13);
        assert_relative_eq!(on.right, -(middle + angle).cos(), epsilon = 1e-13);
    }
}

/// Two contacts on x⁴ - 2x², of which one, or both, end hardly beyond a joint: one panel holds
/// nearly all of a contact, and is seen from the gap next to it.
#[test]
fn a_contact_that_ends_hardly_beyond_a_joint() {
    // κ = 1: F = d²/2, limits ±√(1 ± d/2).
    for load in [0.01, 0.3, 1.0] {
        let d = f64::sqrt(2.0 * load);
        let [inner, outer] = [(1.0 - d / 2.0).sqrt(), (1.0 + d / 2.0).sqrt()];
        for share in [1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 0.01, 0.05] {
            let beyond = share * (outer - inner);
            for joints in [
                vec![beyond - outer],
                vec![-inner - beyond],
                vec![inner + beyond],
                vec![beyond - outer, inner + beyond],
            ] {
                let ends = [&[-2.0], &joints[..], &[2.0]].concat();
                let body = join(ends.windows(2).map(|ends| quartic(ends[0], ends[1])).collect());
                let solution = on_flat(body).solve(Control::Load(load)).unwrap();
                let found = intervals(&solution);
                let due = [[-outer, -inner], [inner, outer]];
                let limits = found.iter().flat_map(|on| [on.left, on.right]);
                for (x, due) in limits.zip(due.as_flattened()) {
                    let off = (x - due).abs() / (outer - inner);
                    assert!(off < 1e-13, "F {load}, joints {joints:?}: {x} for {due}");
                }
            }
        }
    }
}

/// A limit that the last step moves from one side of a plain joint to the other, within the
/// rounding of x, takes no other start.
#[test]
fn a_joint_within_rounding_of_a_limit_is_as_none() {
    let well = |x: f64| [(x * x - 1.0).powi(2), 4.0 * x * (x * x - 1.0)];
    for i in 0..40 {
        let load = Control::Load(0.01 * 250f64.powf(f64::from(i) / 39.0));
        let whole = graph(-2.0, 2.0, well);
        let limits = on_flat(whole).solve(load).unwrap().intervals().to_vec();
        for limit in limits.iter().flat_map(|on| [on.left, on.right]) {
            for ulps in -2..=2 {
                let at = f64::from_bits(limit.to_bits().wrapping_add_signed(ulps));
                let body = join(vec![graph(-2.0, at, well), graph(at, 2.0, well)]);
                let solution = on_flat(body).solve(load).unwrap();
                assert_eq!(solution.report().attempts().len(), 1, "{load:?}, {at}: {solution}");
            }
        }
    }
}
