//! Check of derivatives written by hand against their functions.
//!
//! Differences at single points would need a step, and its choice would depend on the slope and the
//! noise of the curve. Therefore the change of X over a short range of k is compared with the
//! integral of X' over it (Gauss-Legendre, eight nodes), and likewise for Y. The domain is divided
//! into 64 ranges; a range that disagrees is divided into sixteen parts:
//!
//! - a wrong derivative disagrees in nearly all sixteen parts, with one sign, and again in the
//!   sixteen parts of a typical one;
//! - details that the nodes do not resolve (waves, steep places) vanish;
//! - an undeclared kink, or an end like a square root, stays in one or two of the sixteen;
//! - rounding of a formula changes its sign, and its sum does not grow with the number of parts.

use super::{ParametricProfile, Piece, ProfileError, finite_at, interval};
use crate::Real;
use crate::numerics::ascending;
use crate::numerics::gauss_legendre::GaussLegendre;

/// Number of ranges into which the domain is divided at first.
const RANGES: usize = 64;
/// Number of parts into which a range that disagrees is divided.
const COMPONENTS: usize = 16;
/// Number of parts that have to disagree with the same sign.
const PARTS_THAT_DISAGREE: usize = 12;
/// Largest number of times that a range is divided.
const LEVELS: usize = 4;

/// Compares `X'` and `Y'` with `X` and `Y` all over the domain, and
/// [`slope_at`](ParametricProfile::slope_at) with both: for profiles whose derivatives are written
/// by hand. A compound profile is checked piece by piece.
///
/// The derivatives may be off by the square root of the rounding unit (1.5e-8 in `f64`, 3.5e-4 in
/// `f32`), as a share of their mean size over about a thousandth of the domain, or by the rounding
/// of the formulas. Kinks, jumps and infinite ends are not faults. It takes about 600 evaluations
/// for each smooth piece, and more where something disagrees at first. A fault in less than 1/500
/// of the domain can pass.
///
/// ```
/// use linecontact::{Curve, CurvePoint, ProfileError, check_derivatives};
///
/// let wrong = Curve::new([-1.0, 1.0], |k: f64| {
///     let (sin, cos) = k.sin_cos();
///     CurvePoint { x: sin, y: 1.0 - cos, dx: cos, dy: -sin } // the sign of Y'
/// });
/// match check_derivatives(&wrong) {
///     Err(ProfileError::Derivative { quantity, given, difference, .. }) => {
///         assert_eq!(quantity, "Y'");
///         assert!((given / difference + 1.0).abs() < 1e-3);
///     }
///     other => panic!("{other:?}"),
/// }
/// ```
///
/// # Errors
/// [`ProfileError::Derivative`] at the place with the largest fault (`Y'` only if `X'` has none,
/// and `slope_at` only if neither has), [`ProfileError::Domain`], [`ProfileError::NotFinite`],
/// [`ProfileError::Pieces`].
pub fn check_derivatives<T: Real>(
    profile: &dyn ParametricProfile<T>,
) -> Result<(), ProfileError<T>> {
    let Some((count, _)) = Piece::first_of(profile)? else { return check(profile) };
    (0..count).try_for_each(|index| match profile.piece(index) {
        Some(piece) => check(piece.curve),
        None => Err(ProfileError::Pieces { count, index }),
    })
}

fn check<T: Real>(curve: &dyn ParametricProfile<T>) -> Result<(), ProfileError<T>> {
    let ranges = ranges(curve, interval(curve.domain())?, RANGES)?;
    for (i, quantity) in ["X'", "Y'"].into_iter().enumerate() {
        let mut worst: Option<Fault<T>> = None;
        for range in &ranges {
            let fault = range.fault(curve, i, LEVELS)?;
            let is_worse = |fault: &Fault<T>| worst.is_none_or(|worst| fault.share > worst.share);
            worst = fault.filter(is_worse).or(worst);
        }
        if let Some(Fault { k, missed, .. }) = worst {
            let at = curve.at(k);
            let given = if i == 0 { at.dx } else { at.dy };
            let difference = given - missed;
            return Err(ProfileError::Derivative { quantity, k, given, difference });
        }
    }
    check_slope_at(curve, &ranges)
}

/// Compares `slope_at`, where it is given, with `Y'/X'` in the middle of each range.
fn check_slope_at<T: Real>(
    curve: &dyn ParametricProfile<T>,
    ranges: &[Range<T>],
) -> Result<(), ProfileError<T>> {
    let (mut worst, mut largest): (Option<(T, [T; 3])>, _) = (None, T::zero());
    for range in ranges {
        let k = range.middle();
        let at = curve.at(k);
        let slope = at.dy / at.dx;
        let Some(given) = curve.slope_at(at.x).filter(|given| (*given - slope).is_finite()) else {
            continue;
        };
        largest = largest.max(slope.abs());
        let missed = (given - slope).abs();
        if worst.is_none_or(|(most, _)| missed > most) {
            worst = Some((missed, [k, given, slope]));
        }
    }
    match worst {
        Some((missed, [k, given, difference])) if missed > T::epsilon().sqrt() * largest => {
            let quantity = "slope_at(x)";
            Err(ProfileError::Derivative { quantity, k, given, difference })
        }
        _ => Ok(()),
    }
}

/// Short range of k, with values for X and for Y.
#[derive(Clone, Copy)]
struct Range<T> {
    k: [T; 2],
    /// Excess of the integral of the derivative over the change.
    missed: [T; 2],
    /// Integral of the absolute value of the derivative.
    size: [T; 2],
    /// Uncertainty of the change by rounding.
    rounding: [T; 2],
}

/// Fault of a derivative.
#[derive(Clone, Copy)]
struct Fault<T> {
    k: T,
    /// Excess of the derivative.
    missed: T,
    /// Excess as a share of the size of the derivative.
    share: T,
}

/// Divides a range into others of equal length.
fn ranges<T: Real>(
    curve: &dyn ParametricProfile<T>,
    [from, to]: [T; 2],
    count: usize,
) -> Result<Vec<Range<T>>, ProfileError<T>> {
    let k = |i: usize| {
        let share = T::count(i) / T::count(count);
        if i == count { to } else { from + (to - from) * share }
    };
    let ends = |k: T| -> Result<[T; 2], ProfileError<T>> {
        let point = curve.at(k);
        Ok([finite_at("X", k, point.x)?, finite_at("Y", k, point.y)?])
    };
    let mut ranges = Vec::with_capacity(count);
    let mut left = ends(from)?;
    for i in 0..count {
        let right = ends(k(i + 1))?;
        ranges.push(Range::new(curve, [k(i), k(i + 1)], [left, right])?);
        left = right;
    }
    Ok(ranges)
}

impl<T: Real> Range<T> {
    fn new(
        curve: &dyn ParametricProfile<T>,
        k: [T; 2],
        ends: [[T; 2]; 2],
    ) -> Result<Self, ProfileError<T>> {
        let half = T::of(0.5);
        let (centre, reach) = (half * k[0] + half * k[1], half * (k[1] - k[0]));
        let rule = GaussLegendre::coarsest();
        let (mut sum, mut size) = ([T::zero(); 2], [T::zero(); 2]);
        for (&node, &weight) in rule.nodes.iter().zip(&rule.weights).take(rule.n) {
            let k = centre + reach * T::of(node);
            let point = curve.at(k);
            let slopes = [finite_at("X'", k, point.dx)?, finite_at("Y'", k, point.dy)?];
            for i in 0..2 {
                let term = reach * T::of(weight) * slopes[i];
                sum[i] += term;
                size[i] += term.abs();
            }
        }
        let missed = std::array::from_fn(|i| sum[i] - (ends[1][i] - ends[0][i]));
        // From both ends, and from k where the curve is steep.
        let rounding = std::array::from_fn(|i| {
            let by_k = size[i] * (centre / reach).abs();
            T::of(4.0) * T::epsilon() * (ends[0][i].abs().max(ends[1][i].abs()) + by_k + size[i])
        });
        Ok(Self { k, missed, size, rounding })
    }

    /// Tells whether the derivative seems to be off in this range.
    fn is_off(&self, i: usize) -> bool {
        self.missed[i].abs() > T::epsilon().sqrt() * self.size[i] + self.rounding[i]
    }

    /// Returns the fault of the derivative within this range, if there is one.
    fn fault(
        &self,
        curve: &dyn ParametricProfile<T>,
        i: usize,
        levels: usize,
    ) -> Result<Option<Fault<T>>, ProfileError<T>> {
        let wide = self.k[1] - self.k[0] > T::of(1e3) * T::epsilon() * self.k[1].abs();
        if !self.is_off(i) || levels == 0 || !wide {
            return Ok(None);
        }
        let parts = ranges(curve, self.k, COMPONENTS)?;
        if is_wrong(&parts, i) {
            // A typical part: the one at the end of a body may have troubles of its own.
            let typical = typical(&parts, i);
            if is_wrong(&ranges(curve, typical.k, COMPONENTS)?, i) {
                return Ok(Some(typical.as_fault(i)));
            }
        }
        let worse = |max: Self, part: Self| {
            if part.missed[i].abs() > max.missed[i].abs() { part } else { max }
        };
        parts.iter().copied().fold(parts[0], worse).fault(curve, i, levels - 1)
    }

    /// Returns the excess of the derivative as a share of its size.
    fn share(&self, i: usize) -> T {
        self.missed[i].abs() / self.size[i]
    }

    fn middle(&self) -> T {
        T::of(0.5) * self.k[0] + T::of(0.5) * self.k[1]
    }

    fn as_fault(&self, i: usize) -> Fault<T> {
        let missed = self.missed[i] / (self.k[1] - self.k[0]);
        Fault { k: self.middle(), missed, share: self.share(i) }
    }
}

/// Returns the part whose share of error is the median.
fn typical<T: Real>(parts: &[Range<T>], i: usize) -> Range<T> {
    let mut parts = parts.to_vec();
    parts.sort_by(|a, b| ascending(&a.share(i), &b.share(i)));
    parts[parts.len() / 2]
}

/// Tells whether the parts of a range disagree as for a wrong derivative.
fn is_wrong<T: Real>(parts: &[Range<T>], i: usize) -> bool {
    let sum = parts.iter().fold(T::zero(), |sum, part| sum + part.missed[i]);
    let total = parts.iter().fold(T::zero(), |sum, part| sum + part.missed[i].abs());
    let agrees =
        |part: &&Range<T>| part.is_off(i) && (part.missed[i] > T::zero()) == (sum > T::zero());
    parts.iter().filter(agrees).count() >= PARTS_THAT_DISAGREE && sum.abs() >= T::of(0.5) * total
}
