//! Measures the noise of the bodies' formulas, evaluated in `f64` as written.
//!
//! Formulas that cancel large terms, such as `12 cos k - 12` at a small `k`, return `X` with an
//! error far beyond the rounding of `X` itself; where a body is steep, its slope magnifies that
//! error. Neighbouring values show the noise: over a millionth of the contact a formula is a
//! straight line but for rounding, so its sixth differences are all noise (Moré and Wild,
//! *Estimating computational noise*, SIAM J. Sci. Comput. 33, 2011).

use linecontact::profile::Piece;
use linecontact::{Interval, ParametricProfile, ProfileError};
use std::f64::consts::PI;

/// Number of neighbouring values at each place.
const NEIGHBOURS: usize = 64;
/// Distance of the neighbours, as a share of the contact, and its bound as a share of the distance
/// to the end of the piece, where there may be a singularity.
const STEP: [f64; 2] = [1.0 / (1u64 << 24) as f64, 1.0 / 1024.0];

/// Square root of the least number of samples of a solver, whose errors are independent.
const ROOT_OF_SAMPLES: f64 = 10.0;

/// Uncertainties due to the noise of the formulas: the largest rounding error that fits the
/// observed deviation.
#[derive(Clone, Debug)]
pub struct Noise {
    /// Uncertainty of the edges of the contact, relative to its half-width.
    pub edges: f64,
    /// Uncertainty of the slope of the gap at each place.
    pub slope: Vec<f64>,
    /// Weighted mean of this uncertainty over the contact.
    pub mean_slope: f64,
    /// Largest `|f₂' - f₁'|` at all places and at the edges.
    pub steepest: f64,
}

/// Measures the noise at places within a contact, given from left to right. The breakpoints
/// `rounded` are not exactly those of the bodies' formulas. `weight` is the weight of the slope in
/// its mean, as a function of the angle θ in `x = c + L cos θ`.
///
/// # Errors
/// The errors of [`Piece::new`].
pub fn measure(
    bodies: [&dyn ParametricProfile<f64>; 2],
    on: Interval<f64>,
    places: &[f64],
    rounded: &[f64],
    weight: fn(f64) -> f64,
) -> Result<Noise, ProfileError<f64>> {
    let bodies = [pieces(bodies[0])?, pieces(bodies[1])?];
    let at = |x: f64| {
        let [lower, upper] = bodies.each_ref().map(|body| Local::at(body, x, on));
        (on.angle(x), lower, upper)
    };
    let total = |(_, lower, upper): &(f64, Local, Local)| lower.total() + upper.total();
    let inside: Vec<_> = places.iter().map(|&x| at(x)).collect();
    let edges = [on.left, on.right].map(at);
    let largest = |of: fn(&Local, &Local) -> f64| {
        inside.iter().fold(0.0f64, |most, (_, lower, upper)| most.max(of(lower, upper)))
    };
    // If all places are on a flat, only the edges have a slope.
    let slope = |(_, lower, upper): &(f64, Local, Local)| (upper.slope - lower.slope).abs();
    let finite = inside.iter().chain(&edges).map(slope).filter(|slope| slope.is_finite());
    let steepest = finite.fold(0.0f64, f64::max);
    let of_x = largest(|lower, upper| lower.of_x + upper.of_x);
    let of_slope = largest(|lower, upper| lower.of_slope + upper.of_slope);

    // The edges follow from averages over the contact, and so does the nonlocal part of the
    // pressure.
    let of_edges = (of_x / on.half_width() + of_slope / steepest) / ROOT_OF_SAMPLES;
    let jumps = jumps(&bodies, rounded);
    let of_jumps = |x: f64| jumps.iter().map(|jump| jump.noise(x, on)).sum::<f64>();
    let slope = inside.iter().zip(places).map(|(at, &x)| total(at) + of_jumps(x)).collect();
    let [left, right] = edges;
    let all = [left].into_iter().chain(inside).chain([right]);
    let weighted: Vec<_> = all.map(|place| (place.0, weight(place.0) * total(&place))).collect();
    let strips = weighted.windows(2).map(|two| (two[0].0 - two[1].0) * (two[0].1 + two[1].1));
    let mean_slope = strips.sum::<f64>() / (2.0 * PI * ROOT_OF_SAMPLES);
    Ok(Noise { edges: of_edges, slope, mean_slope, steepest })
}

fn pieces(body: &dyn ParametricProfile<f64>) -> Result<Vec<Piece<'_, f64>>, ProfileError<f64>> {
    match body.pieces() {
        0 => Ok(vec![Piece::new(body)?]),
        count => Ok((0..count).filter_map(|i| body.piece(i)).collect()),
    }
}

/// Breakpoint at which the slope of the gap jumps, or may jump.
struct Jump {
    x: f64,
    by: f64,
    /// Additional jump of the slope if the breakpoint is rounded, due to the jump of the curvature.
    perhaps: f64,
}

impl Jump {
    /// Returns the uncertainty of the pressure at x due to this jump. The pressure contains the
    /// logarithm of the distance from the breakpoint, whose place, such as 1/3, is rounded. At the
    /// breakpoint itself nothing is certain.
    fn noise(&self, x: f64, on: Interval<f64>) -> f64 {
        let rounded = place_rounding(self.x);
        let distance = (x - self.x).abs();
        if rounded <= 0.0 {
            return 0.0;
        }
        // Infinite at the breakpoint, but only if the slope jumps.
        let by = self.by.abs();
        let place = if by > 0.0 { by * (rounded / distance).ln_1p() } else { 0.0 };
        (place + self.perhaps * (on.half_width() / distance.max(rounded)).ln_1p()) / PI
    }
}

/// Returns the largest rounding error of a breakpoint.
fn place_rounding(x: f64) -> f64 {
    0.5 * f64::EPSILON * x.abs()
}

/// Returns `d²Y/dX²` next to an end of a piece.
fn end_bend(piece: &Piece<'_, f64>, end: usize) -> f64 {
    let slope = |k| piece.curve.dy(k) / piece.curve.dx(k);
    let [near, far] = [piece.k[end], piece.k[1 - end]];
    let beside = near + STEP[1] * (far - near);
    (slope(beside) - slope(near)) / (piece.curve.x(beside) - piece.curve.x(near))
}

fn jumps(bodies: &[Vec<Piece<'_, f64>>; 2], rounded: &[f64]) -> Vec<Jump> {
    let slope = |piece: &Piece<'_, f64>, end: usize| piece.ends[end].dy / piece.ends[end].dx;
    let of_body = |body: &Vec<Piece<'_, f64>>, sign: f64| -> Vec<Jump> {
        let jump = |two: &[Piece<'_, f64>]| {
            let [from, to] = [slope(&two[0], 1), slope(&two[1], 0)];
            let by = sign * (to - from);
            // A jump as small as the rounding of the formulas does not count.
            let counts = by.is_finite() && by.abs() > 64.0 * f64::EPSILON * (from.abs() + to.abs());
            let by = if counts { by } else { 0.0 };
            let x = two[0].x()[1];
            let bend = (end_bend(&two[1], 0) - end_bend(&two[0], 1)).abs();
            let is_rounded = rounded.contains(&x) && bend.is_finite();
            let perhaps = if is_rounded { bend * place_rounding(x) } else { 0.0 };
            (by != 0.0 || perhaps > 0.0).then_some(Jump { x, by, perhaps })
        };
        body.windows(2).filter_map(jump).collect()
    };
    let [lower, upper] = bodies;
    let mut all: Vec<Jump> = Vec::new();
    for jump in of_body(lower, -1.0).into_iter().chain(of_body(upper, 1.0)) {
        // Jumps of both bodies may cancel.
        match all.iter_mut().find(|other| other.x == jump.x) {
            Some(other) => {
                other.by += jump.by;
                other.perhaps += jump.perhaps;
            }
            None => all.push(jump),
        }
    }
    all
}

/// Slope, curvature and noise of a body at a place.
struct Local {
    slope: f64,
    /// `d²Y/dX²`.
    bend: f64,
    /// Noise of `X` and of the slope at a given `k`.
    of_x: f64,
    of_slope: f64,
}

impl Local {
    fn at(body: &[Piece<'_, f64>], x: f64, on: Interval<f64>) -> Self {
        let piece = body.iter().find(|piece| x <= piece.x()[1]).unwrap_or(&body[body.len() - 1]);
        let slope = |k| piece.curve.dy(k) / piece.curve.dx(k);
        let k = parameter(piece, x);
        let mut local = Self { slope: slope(k), bend: 0.0, of_x: 0.0, of_slope: 0.0 };
        let [from, to] = [on.left.max(piece.x()[0]), on.right.min(piece.x()[1])];
        let width = (parameter(piece, to) - parameter(piece, from)).abs();
        let room = (k - piece.k[0]).abs().min((k - piece.k[1]).abs()) * STEP[1];
        // A power of two, so that the neighbours are equidistant.
        let step = (STEP[0] * width).min(room).log2().floor().exp2();
        let neighbour = |i: usize| k + step * (i as f64 - 0.5 * NEIGHBOURS as f64);
        if neighbour(1) != neighbour(0) {
            let xs: [f64; NEIGHBOURS] = std::array::from_fn(|i| piece.curve.x(neighbour(i)));
            let slopes: [f64; NEIGHBOURS] = std::array::from_fn(|i| slope(neighbour(i)));
            local.bend = (slopes[NEIGHBOURS - 1] - slopes[0]) / (xs[NEIGHBOURS - 1] - xs[0]);
            (local.of_x, local.of_slope) = (noise(xs), noise(slopes));
        }
        local
    }

    /// Returns the noise of the slope at a given `x`; 0 at an end where the slope is infinite.
    fn total(&self) -> f64 {
        let noise = self.of_slope + self.bend.abs() * self.of_x;
        if noise.is_finite() { noise } else { 0.0 }
    }
}

/// Finds the `k` of `x` by bisection.
fn parameter(piece: &Piece<'_, f64>, x: f64) -> f64 {
    let [mut left, mut right] = piece.k;
    loop {
        let k = 0.5 * left + 0.5 * right;
        if k == left || k == right {
            return k;
        }
        if piece.curve.x(k) < x { left = k } else { right = k }
    }
}

/// Returns the noise in equidistant values of a smooth function: the largest error, if all errors
/// up to it are equally likely.
fn noise(mut values: [f64; NEIGHBOURS]) -> f64 {
    const ORDER: usize = 6;
    /// Variance of the sixth difference for noise of variance 1: 12!/(6!)².
    const VARIANCE: f64 = 924.0;
    let largest = values.iter().fold(f64::MIN_POSITIVE, |most, value| most.max(value.abs()));
    for count in (NEIGHBOURS - ORDER..NEIGHBOURS).rev() {
        for i in 0..count {
            values[i] = values[i + 1] - values[i];
        }
    }
    // Squared relative to the largest value, which may itself be 1e150.
    let differences = &values[..NEIGHBOURS - ORDER];
    let sum: f64 = differences.iter().map(|value| (value / largest).powi(2)).sum();
    largest * (3.0 * sum / differences.len() as f64 / VARIANCE).sqrt()
}

#[cfg(test)]
mod tests {
    use super::measure;
    use linecontact::{Curve, CurvePoint, Flat, Interval, Piecewise};

    #[test]
    fn a_breakpoint_that_is_rounded() {
        // x²/2 up to 1/3, and from there on a curvature of 1 + bend. If the breakpoint is off by u,
        // the slope jumps by bend u, and the pressure at a distance d is uncertain by (bend u/π²)
        // ln(L/d).
        let (bend, third) = (1e8, 1.0 / 3.0);
        let piece = |from: f64, to: f64, bend: f64| {
            Curve::new([from, to], move |k: f64| {
                let beyond = k - third;
                let y = k * k / 2.0 + bend * beyond * beyond / 2.0;
                CurvePoint { x: k, y, dx: 1.0, dy: k + bend * beyond }
            })
        };
        let body = Piecewise::new(vec![piece(-2.0, third, 0.0), piece(third, 2.0, bend)]);
        let body = body.expect("the pieces meet");
        let on = Interval { left: -1.0, right: 0.5 };
        let noise = |rounded: &[f64]| {
            let places = [-0.2, third - 1e-6, third];
            measure([&Flat, &body], on, &places, rounded, |_| 1.0).expect("pieces").slope
        };
        let (exact, rounded) = (noise(&[]), noise(&[third]));
        let jump = bend * third * f64::EPSILON / 2.0;
        for (i, logarithm) in [0.9, 13.5, 36.0].into_iter().enumerate() {
            let more = (rounded[i] - exact[i]) * std::f64::consts::PI / jump;
            assert!((more / logarithm - 1.0).abs() < 0.1, "{i}: {more}");
        }
    }
}
