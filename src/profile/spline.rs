//! A profile through measured points.
//!
//! Written here because no crate was found that takes any [`Real`] and smooths to a given noise.
//! `csaps` smooths by a weight between 0 and 1, through the normal equations, which lose all digits
//! where the smoothing reaches over some ten thousand points.

mod points;
mod slopes;
mod smooth;
#[cfg(feature = "serde")]
mod stored;

pub use points::SplineError;

use super::{CurvePoint, ParametricProfile, Piece, Piecewise, PiecewiseError, Placed, Placement};
use crate::Real;

/// Settings of the fit of a [`Spline`] to points.
///
/// ```
/// use linecontact::profile::{Fit, Spline};
///
/// // A parabola, with a ripple of 2e-6 that is none of it.
/// let point = |i: i32| [0.01 * f64::from(i), 5e-5 * f64::from(i * i) + 2e-6 * f64::from(i % 2)];
/// let points: Vec<_> = (-100..=100).map(point).collect();
/// let smooth = Spline::fitted(&points, Fit { noise: 1e-6, ..Fit::default() })?;
/// # use linecontact::ParametricProfile;
/// assert!((smooth.slope_at(0.3).unwrap() - 0.3).abs() < 1e-3);
/// # Ok::<(), linecontact::profile::SplineError<f64>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(default, deny_unknown_fields, bound(deserialize = "T: Real + serde::Deserialize<'de>"))
)]
pub struct Fit<T> {
    /// Standard deviation of the heights, in their own unit: the noise of the measuring machine. Of
    /// all curves at this distance from the points the smoothest is taken, with the least
    /// `∫ Y''² dX`; the sum of the squared distances may be up to `N + sqrt(2 N)` in units of the
    /// noise (Reinsch, *Numer. Math.* 10, 1967, 177). An even smoother curve is taken where it is
    /// expected to be nearer to the surface. With 0, the default, the curve goes through the
    /// points.
    ///
    /// A tenth too much is better than a tenth too little; either changes the pressure little. With
    /// much less than half of the true noise the curve follows the noise: it is then a rough
    /// surface, with many contacts and several times the pressure. Estimates and checks are then
    /// for this surface.
    pub noise: T,
    /// Distance at which a point is taken for an error of the measurement: its distance from the
    /// cubic through its four neighbours, in standard deviations. These are estimated from the
    /// median of all such distances, or from the 21 points around it if their median is larger.
    /// Default 10; `None` disables the check. It needs twelve points. The two outermost points have
    /// neighbours on one side only: there it detects only errors several times as large. A corner
    /// between two points, or an end that is nearly upright, looks like such an error.
    pub outliers: Option<T>,
}

impl<T: Real> Default for Fit<T> {
    fn default() -> Self {
        Self { noise: T::zero(), outliers: Some(T::of(10.0)) }
    }
}

/// Profile through points `[x, y]`, or near them: a cubic spline with two continuous derivatives,
/// `X = k`.
///
/// The points are in order of rising x, at any distances. At either end the outermost two cubics
/// are one (de Boor's "not a knot"), so that four points of a cubic give that cubic; a smoothed
/// spline ends straight.
///
/// The third derivative jumps at the knots, which are the breakpoints of the profile. A contact
/// costs some ten samples for each knot in it; no curve is evaluated for them, as the slope is
/// known.
///
/// ```
/// use linecontact::profile::Spline;
/// use linecontact::{Contact, Control, Flat};
///
/// let points: Vec<[f64; 2]> =
///     (-20..=20).map(|i| 0.05 * f64::from(i)).map(|x| [x, x * x / 2.0]).collect();
/// let body = Spline::through(&points)?;
/// let contact = Contact::new(&Flat, &body)?;
/// let solution = contact.solve(Control::Load(0.02))?;
/// assert!((solution.a() - 0.2).abs() < 1e-14); // the parabola
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Spline<T> {
    cubics: Vec<Cubic<T>>,
}

/// Part of the spline between two knots.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Cubic<T> {
    x: [T; 2],
    /// Coefficients of `Y` by the distance from the left knot, the constant first.
    coefficients: [T; 4],
}

impl<T: Real> Spline<T> {
    /// Builds the spline through the points. A point that stands out from its neighbours is
    /// refused, as in any [`Fit`] by default. Exact points next to a corner or an upright end may
    /// stand out, too: `Fit { outliers: None, ..Fit::default() }` accepts them.
    ///
    /// # Errors
    /// [`SplineError`], with the row of the faulty point.
    pub fn through(points: &[[T; 2]]) -> Result<Self, SplineError<T>> {
        Self::fitted(points, Fit::default())
    }

    /// Builds the spline through the points, or near them.
    ///
    /// ```
    /// use linecontact::profile::{Fit, Spline};
    /// use linecontact::{Contact, Control, Flat};
    ///
    /// let points = (-40..=40).map(|i| 0.025 * f64::from(i)).map(|x| [x, x * x / 2.0]);
    /// let points: Vec<[f64; 2]> = points.collect();
    /// let body = Spline::fitted(&points, Fit { noise: 1e-7, ..Fit::default() })?;
    /// let solution = Contact::new(&Flat, &body)?.solve(Control::Load(0.02))?;
    /// assert!((solution.a() / 0.2 - 1.0).abs() < 1e-4); // of the parabola, sqrt(2 F R/κ)
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`SplineError`], with the row of the faulty point.
    pub fn fitted(points: &[[T; 2]], fit: Fit<T>) -> Result<Self, SplineError<T>> {
        if !(fit.noise.is_finite() && fit.noise >= T::zero()) {
            return Err(SplineError::Noise { noise: fit.noise });
        }
        points::check(points)?;
        if let Some(most) = fit.outliers {
            points::check_outliers(points, most)?;
        }
        if fit.noise > T::zero() {
            Self::of(points, &smooth::smooth(points, fit.noise)?)
        } else {
            let slopes = slopes::slopes(points);
            let knots: Vec<_> =
                points.iter().zip(slopes).map(|(&[_, y], slope)| [y, slope]).collect();
            Self::of(points, &knots)
        }
    }

    /// Builds the spline from height and slope at each knot.
    fn of(points: &[[T; 2]], knots: &[[T; 2]]) -> Result<Self, SplineError<T>> {
        let cubic = |(x, y): (&[[T; 2]], &[[T; 2]])| {
            let (x, [from, to]) = ([x[0][0], x[1][0]], [y[0], y[1]]);
            let (h, two, three) = (x[1] - x[0], T::of(2.0), T::of(3.0));
            let chord = (to[0] - from[0]) / h;
            let second = (three * chord - two * from[1] - to[1]) / h;
            let third = (from[1] + to[1] - two * chord) / h / h;
            Cubic { x, coefficients: [from[0], from[1], second, third] }
        };
        let cubics = points.windows(2).zip(knots.windows(2)).map(cubic).collect();
        let spline = Self { cubics };
        // Coefficients that have overflowed or vanished do not lead to the next knot.
        match spline.first_gap(knots) {
            Some((i, _)) => {
                let [before, x] = spline.cubics[i].x;
                Err(SplineError::Overflow { row: i + 2, x, before })
            }
            None => Ok(spline),
        }
    }

    /// Finds the first cubic that does not end with the height and the slope of the next knot, and
    /// tells whether the numbers are finite there.
    fn first_gap(&self, knots: &[[T; 2]]) -> Option<(usize, bool)> {
        let size = |i: usize| knots.iter().fold(T::zero(), |size, knot| size.max(knot[i].abs()));
        let allowed = [0, 1].map(|i| T::epsilon().sqrt() * size(i));
        self.cubics.iter().zip(&knots[1..]).enumerate().find_map(|(i, (cubic, to))| {
            let CurvePoint { y, dy, .. } = cubic.at(cubic.x[1]);
            let is_finite = allowed[0].is_finite() && allowed[1].is_finite() && dy.is_finite();
            let meets = (y - to[0]).abs() <= allowed[0] && (dy - to[1]).abs() <= allowed[1];
            (!(meets && is_finite)).then_some((i, is_finite))
        })
    }

    /// Places the body: moved, mirrored, flipped, turned or scaled.
    ///
    /// ```
    /// use linecontact::profile::{Parabola, Placement, Spline};
    /// use linecontact::{Contact, Control};
    ///
    /// let points: Vec<[f64; 2]> =
    ///     (-20..=20).map(|i| 0.05 * f64::from(i)).map(|x| [x, x * x / 2.0]).collect();
    /// let below = Spline::through(&points)?.placed(Placement::default().flipped())?;
    /// let above = Parabola::new(1.0, [-1.0, 1.0])?;
    /// let solution = Contact::new(&below, &above)?.solve(Control::Load(0.04))?;
    /// assert!((solution.a() - 0.2).abs() < 1e-14); // two equal parabolas
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`Piecewise::placed`].
    pub fn placed(
        self,
        placement: Placement<T>,
    ) -> Result<Piecewise<T, Placed<T, impl ParametricProfile<T>>>, PiecewiseError<T>> {
        Piecewise::new(self.cubics)?.placed(placement)
    }

    fn cubic(&self, x: T) -> &Cubic<T> {
        let index = self.cubics.partition_point(|cubic| cubic.x[1] < x);
        &self.cubics[index.min(self.cubics.len() - 1)]
    }
}

impl<T: Real> ParametricProfile<T> for Cubic<T> {
    fn domain(&self) -> [T; 2] {
        self.x
    }

    fn at(&self, k: T) -> CurvePoint<T> {
        let (t, [a, b, c, d]) = (k - self.x[0], self.coefficients);
        CurvePoint { x: k, y: a + t * (b + t * (c + t * d)), dx: T::one(), dy: self.slope(t) }
    }

    fn slope_at(&self, x: T) -> Option<T> {
        Some(self.slope(x - self.x[0]))
    }
}

impl<T: Real> Cubic<T> {
    fn slope(&self, t: T) -> T {
        let [_, b, c, d] = self.coefficients;
        b + t * (T::of(2.0) * c + T::of(3.0) * t * d)
    }
}

impl<T: Real> ParametricProfile<T> for Spline<T> {
    fn domain(&self) -> [T; 2] {
        [self.cubics[0].x[0], self.cubics[self.cubics.len() - 1].x[1]]
    }

    fn at(&self, k: T) -> CurvePoint<T> {
        self.cubic(k).at(k)
    }

    fn slope_at(&self, x: T) -> Option<T> {
        self.cubic(x).slope_at(x)
    }

    fn pieces(&self) -> usize {
        self.cubics.len()
    }

    fn piece(&self, index: usize) -> Option<Piece<'_, T>> {
        let cubic = self.cubics.get(index)?;
        Some(Piece { curve: cubic, k: cubic.x, ends: cubic.x.map(|x| cubic.at(x)) })
    }
}
