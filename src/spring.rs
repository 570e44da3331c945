//! Two bodies in contact as a spring: load and stiffness for each step of a simulator, from a
//! table.
//!
//! The table has the exact load, stiffness dF/dδ, half-width and peak pressure, with their exact
//! derivatives, at chosen loads. Between the points, the logarithms of these quantities are cubic
//! in the logarithm of the approach δ (Hermite): for power laws, such as the exponent 10/9 of
//! ISO/TS 16281, two points suffice. If two test solves between two points show an error above the
//! tolerance, a point is added between them. From first touch to the first point the quantities are
//! powers of the approach.

use crate::contact::check_given;
use crate::real::same;
use crate::solution::Approaching;
use crate::{
    Contact, ContactError, Control, EvaluationError, Fallible, InputError, Real, References,
    Solution, Solver,
};
use std::collections::VecDeque;

/// Largest number of points of a table.
const MAX_TABLE: usize = 4096;

/// Least distance of two points, as a share of the load: closer ones follow a kink, as where a
/// corner is reached.
const LEAST_STEP_OF_TABLE: f64 = 1e-6;

/// Place of the second test between two points: here the error of the slopes is largest, in the
/// middle the error of the values.
const STEEPEST: f64 = 0.211_324_865_405_187_1;

/// Safety factor on the observed errors, since they may be half of the largest.
const SAFETY_FACTOR: f64 = 2.0;

/// Loads below the first one at which the powers are tested, as shares of it: the error of the load
/// is largest at about a third.
const LIGHTER_SHARES: [f64; 3] = [0.5, 0.25, 0.05];

/// Ratio of the steepest slope to the largest value of the error of a cubic, which goes like
/// `t² (1 - t)²`. A kink between two tests shows in the slopes.
const SLOPE_OF_ERROR: f64 = 3.08;

/// State of a spring.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SpringPoint<T> {
    /// [Approach](Solution::approach) δ: a length.
    pub approach: T,
    /// Load per unit length F: force/length.
    pub load: T,
    /// [Stiffness](Solution::stiffness) dF/dδ: a pressure.
    pub stiffness: T,
    /// Half the length in contact: the half-width L, or half the sum of all widths; a length.
    pub half_contact: T,
    /// Largest pressure p₀; `None` if it is infinite, at a corner.
    pub peak: Option<T>,
}

/// Load, stiffness, half-width and peak pressure against the approach of the bodies.
///
/// ```
/// use linecontact::profile::Ellipse;
/// use linecontact::{Contact, Flat, Material, PlaneState, Reference, References, SpringTable};
///
/// // A steel roller of 10 mm on a steel block, 30 mm to its foot: mm, MPa, N/mm.
/// let roller = Ellipse::circle(10.0, [-1.0, 1.0])?;
/// let steel = Material::elastic(210e3, 0.3);
/// let contact = Contact::new(&Flat, &roller)?.materials(steel, steel, PlaneState::Strain);
/// let to = References { x: 0.0, lower: Reference::Depth(30.0), upper: Reference::Disc(10.0) };
/// let table = SpringTable::new(&contact, &to, [1.0, 1000.0], 1e-6)?;
/// assert!(table.error() < 1e-6 && table.points().len() < 20);
///
/// let spring = table.at(0.01)?;
/// println!("{} N/mm, {} MPa", spring.load, spring.stiffness);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "serde", serde(bound(deserialize = "T: Real + serde::Deserialize<'de>")))]
pub struct SpringTable<T> {
    #[cfg_attr(feature = "serde", serde(deserialize_with = "checked"))]
    points: Vec<Node<T>>,
    error: T,
    stiffness_error: T,
    touch_error: T,
}

/// Point with the data of the cubics: the derivatives of ln F, ln L and ln p₀ by ln δ.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Node<T> {
    #[cfg_attr(feature = "serde", serde(flatten))]
    point: SpringPoint<T>,
    exponents: [T; 3],
}

impl<T: Real> Node<T> {
    /// Returns the state at another approach, by powers of it.
    fn at(self, approach: T) -> SpringPoint<T> {
        let Self { mut point, exponents } = self;
        if !same(point.approach, approach) {
            let ratio = approach / point.approach;
            point.load *= ratio.powf(exponents[0]);
            point.stiffness = exponents[0] * point.load / approach;
            point.half_contact *= ratio.powf(exponents[1]);
            point.peak = point.peak.map(|peak| peak * ratio.powf(exponents[2]));
            point.approach = approach;
        }
        point
    }
}

/// Reads the points of a table.
#[cfg(feature = "serde")]
fn checked<'de, T: Real + serde::Deserialize<'de>, D: serde::Deserializer<'de>>(
    file: D,
) -> Result<Vec<Node<T>>, D::Error> {
    let points = <Vec<Node<T>> as serde::Deserialize>::deserialize(file)?;
    let positive = |value: T| value > T::zero() && value.is_finite();
    let is_state = |Node { point, exponents }: &Node<T>| {
        let SpringPoint { approach, load, stiffness, half_contact, peak } = *point;
        [approach, load, stiffness, half_contact].into_iter().all(positive)
            && peak.is_none_or(positive)
            && exponents.iter().all(|exponent| exponent.is_finite())
            && exponents[0] > T::zero()
    };
    let rises = |pair: &[Node<T>]| {
        let [from, to] = [pair[0].point, pair[1].point];
        from.approach < to.approach && from.load < to.load
    };
    if points.len() > 1 && points.iter().all(is_state) && points.windows(2).all(rises) {
        return Ok(points);
    }
    Err(serde::de::Error::custom(
        "a table of springs has two points or more, of positive numbers, with rising approach and load",
    ))
}

impl<T: Real> SpringTable<T> {
    /// Computes the table over a range of loads per unit length, from the least to the largest.
    ///
    /// The tolerance is a share of the load, the half-width and the peak, whichever is worst; of
    /// smooth bodies 1e-14 is reached. Points stand apart by a millionth of the load or more: next
    /// to a load under which the contact meets a corner the error stays larger.
    ///
    /// # Errors
    /// [`InputError::InvalidLoad`] for a range that is not positive and rising;
    /// [`InputError::InvalidTolerance`] for a tolerance that is not above 0 and below 1;
    /// [`ToleranceNotReached`](crate::SolveError::ToleranceNotReached) for one that 4096 points, or
    /// such close ones, do not reach, with the error that they leave; the errors of
    /// [`Contact::solve`], [`Solution::approach`], [`Solution::stiffness`] and [`Solution::peak`];
    /// [`SolveError::Falls`](crate::SolveError::Falls).
    pub fn new(
        contact: &Contact<'_, T>,
        references: &References<T>,
        loads: [T; 2],
        tolerance: T,
    ) -> Result<Self, ContactError<T>> {
        T::spring_table(contact, references, loads, tolerance)
    }

    pub(crate) fn solve(
        contact: &Contact<'_, T>,
        references: &References<T>,
        loads: [T; 2],
        tolerance: T,
    ) -> Fallible<T, Self> {
        let [least, largest] = loads;
        check_given("least load", least, least > T::zero(), "positive")?;
        check_given("largest load", largest, least < largest, "more than the least load")?;
        if !(tolerance > T::zero() && tolerance < T::one()) {
            return Err(InputError::InvalidTolerance { tolerance }.into());
        }
        let mut solver = Solver::new();
        let mut solve = |load| node(&solver.solve(contact, Control::Load(load))?, references);
        let (first, last) = (solve(least)?, solve(largest)?);
        let (zero, mut touch_error) = (T::zero(), T::zero());
        for share in LIGHTER_SHARES.map(T::of) {
            let off = match solve(share * least) {
                Ok(at) => (first.at(at.point.approach).load - at.point.load).abs() / least,
                // Corners may not hold so light a load.
                Err(ContactError::Solve(_)) => T::one(),
                Err(error) => return Err(error),
            };
            touch_error = touch_error.max(T::of(SAFETY_FACTOR) * off);
        }
        let (points, mut pending) = (vec![first, last], VecDeque::from([[first, last]]));
        let mut table = Self { points, error: zero, stiffness_error: zero, touch_error };
        // Halves wait until all wider intervals are tested, so that the points are spread.
        while let Some([from, to]) = pending.pop_front() {
            let ratio = to.point.load / from.point.load;
            let place = |share: f64| from.point.load * ratio.powf(T::of(share));
            let (middle, beside) = (solve(place(0.5))?, solve(place(STEEPEST))?);
            let width = (to.point.approach / from.point.approach).ln();
            let off = [middle, beside].map(|exact| {
                difference(&exact, &between(&[from, to], exact.point.approach), width)
            });
            let [error, stiffness_error] =
                [0, 1].map(|of| T::of(SAFETY_FACTOR) * off[0][of].max(off[1][of]));
            let is_apart = ratio > T::one() + T::of(LEAST_STEP_OF_TABLE);
            if error > tolerance && is_apart && table.points.len() < MAX_TABLE {
                pending.extend([[from, middle], [middle, to]]);
                let before = |node: &Node<T>| node.point.load < middle.point.load;
                table.points.insert(table.points.partition_point(before), middle);
                continue;
            }
            table.error = table.error.max(error);
            table.stiffness_error = table.stiffness_error.max(stiffness_error);
        }
        if table.error > tolerance {
            let reached = table.error;
            return Err(crate::SolveError::ToleranceNotReached { tolerance, reached }.into());
        }
        Ok(table)
    }

    /// Returns the solved points, by rising approach.
    pub fn points(&self) -> impl ExactSizeIterator<Item = SpringPoint<T>> {
        self.points.iter().map(|node| node.point)
    }

    /// Returns the largest error between the points, as a share of the load, the half-width or the
    /// peak: twice the observed error.
    pub fn error(&self) -> T {
        self.error
    }

    /// Returns the largest error of the stiffness between the points, as a share: twice the
    /// observed error.
    pub fn stiffness_error(&self) -> T {
        self.stiffness_error
    }

    /// Returns the error of the table near first touch, between an approach of zero and the first
    /// point, at δ₁ with the least load F₁. There the table has `F₁ (δ/δ₁)ⁿ`, with the exponent n
    /// of the first point, in place of the true load F(δ). The error is the largest difference of
    /// both as a share of F₁, a number without unit: with 0.002 and a least load of 10 N/mm the
    /// loads up to there are exact to 0.02 N/mm. It is twice the largest one at 1/2, 1/4 and 1/20
    /// of F₁; more than 1, so that nothing is known, where corners do not hold so light a load. A
    /// smaller least load makes it slowly smaller.
    pub fn touch_error(&self) -> T {
        self.touch_error
    }

    /// Returns the state at an approach up to that of the last point, which may be passed by
    /// rounding. At an approach of zero and below the bodies are apart, and all but the approach is
    /// zero.
    ///
    /// # Errors
    /// [`EvaluationError::OutsideTable`].
    pub fn at(&self, approach: T) -> Result<SpringPoint<T>, ContactError<T>> {
        let range = self.range();
        let rounding = T::of(4.0) * T::epsilon() * range[1];
        // NaN is not known either.
        if approach <= range[1] + rounding {
            return Ok(self.continued(approach.min(range[1])));
        }
        Err(EvaluationError::OutsideTable { approach, range }.into())
    }

    /// Returns the state at any approach: beyond the last point, too, load, half-width and peak go
    /// on as powers of the approach.
    pub(crate) fn continued(&self, approach: T) -> SpringPoint<T> {
        if approach <= T::zero() {
            let zero = T::zero();
            let (load, stiffness, half_contact, peak) = (zero, zero, zero, Some(zero));
            return SpringPoint { approach, load, stiffness, half_contact, peak };
        }
        let range = self.range();
        let within = approach.max(range[0]).min(range[1]);
        let next = self.points.partition_point(|node| node.point.approach < within);
        let next = next.clamp(1, self.points.len() - 1);
        between(&[self.points[next - 1], self.points[next]], within).at(approach)
    }

    /// Returns an approach, that of the last point or more, at which the continued table has at
    /// least this load.
    pub(crate) fn approach_for(&self, load: T) -> T {
        let Node { point, exponents } = self.points[self.points.len() - 1];
        point.approach * (load / point.load).max(T::one()).powf(T::one() / exponents[0])
    }

    /// Returns the least and the largest approach.
    pub(crate) fn range(&self) -> [T; 2] {
        [0, self.points.len() - 1].map(|i| self.points[i].point.approach)
    }
}

/// Returns the point of a solution.
fn node<T: Real>(solution: &Solution<'_, T>, references: &References<T>) -> Fallible<T, Node<T>> {
    let approaching =
        Approaching::new(solution.solved(), solution.elasticity.as_ref(), references)?;
    let [approach, rate] = approaching.with_rate()?;
    let (load, rates) = (solution.load(), solution.load_rates()?);
    let half_contact = solution.intervals().iter().fold(T::zero(), |sum, on| sum + on.half_width());
    let widening = rates.limits.iter().fold(T::zero(), |sum, on| sum + (on.right - on.left));
    let (peak, growth) = match solution.peak() {
        Ok(peak) => (Some(peak.pressure), rates.pressure(peak.x)? / peak.pressure),
        Err(ContactError::Evaluation(EvaluationError::Singular { .. })) => (None, T::zero()),
        Err(error) => return Err(error),
    };
    let stiffness = T::one() / rate;
    let by = approach * stiffness;
    let exponents = [by / load, by * T::of(0.5) * widening / half_contact, by * growth];
    Ok(Node { point: SpringPoint { approach, load, stiffness, half_contact, peak }, exponents })
}

/// Interpolates between two points by Hermite's cubics.
fn between<T: Real>([from, to]: &[Node<T>; 2], approach: T) -> Node<T> {
    let width = (to.point.approach / from.point.approach).ln();
    let t = (approach / from.point.approach).ln() / width;
    let (one, two, three, six) = (T::one(), T::of(2.0), T::of(3.0), T::of(6.0));
    // The value, and the derivative of its logarithm by the logarithm of the approach.
    let cubic = |i: usize, first: T, last: T| {
        let rise = (last / first).ln();
        let slopes = [from.exponents[i] * width, to.exponents[i] * width];
        let u = one - t;
        let value = t * t * (three - two * t) * rise + t * u * (u * slopes[0] - t * slopes[1]);
        let slope = six * t * u * rise
            + u * (one - three * t) * slopes[0]
            + t * (three * t - two) * slopes[1];
        (first * value.exp(), slope / width)
    };
    let (load, exponent) = cubic(0, from.point.load, to.point.load);
    let (half_contact, widening) = cubic(1, from.point.half_contact, to.point.half_contact);
    let peak = from.point.peak.zip(to.point.peak).map(|(first, last)| cubic(2, first, last));
    let exponents = [exponent, widening, peak.map_or(T::zero(), |(_, growth)| growth)];
    let (stiffness, peak) = (exponent * load / approach, peak.map(|(peak, _)| peak));
    Node { point: SpringPoint { approach, load, stiffness, half_contact, peak }, exponents }
}

/// Returns the largest relative difference of two states between two points of this distance
/// (`width`), and the relative difference of their stiffnesses.
fn difference<T: Real>(exact: &Node<T>, other: &Node<T>, width: T) -> [T; 2] {
    let share = |exact: T, other: T| (other / exact - T::one()).abs();
    let (point, found) = (exact.point, other.point);
    let peaks = point.peak.zip(found.peak).map_or(T::zero(), |(exact, other)| share(exact, other));
    let values = share(point.load, found.load).max(share(point.half_contact, found.half_contact));
    let slopes = exact.exponents.iter().zip(other.exponents);
    let slopes = slopes.fold(T::zero(), |max, (&exact, other)| max.max((exact - other).abs()));
    let values = values.max(peaks).max(slopes * width / T::of(SLOPE_OF_ERROR));
    [values, share(point.stiffness, found.stiffness)]
}
