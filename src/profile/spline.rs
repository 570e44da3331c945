//! A profile through measured points.
//!
//! Written here because no crate was found that takes any [`Real`], estimates the noise and returns
//! the covariance of the curve. `csaps` smooths by a given weight, through the normal equations,
//! which lose all digits where the smoothing reaches over some ten thousand points.

mod points;
mod slopes;
mod smooth;
#[cfg(feature = "serde")]
mod stored;

pub use points::SplineError;

use super::{CurvePoint, ParametricProfile, Piece, Piecewise, PiecewiseError, Placed, Placement};
use crate::Real;
use smooth::Smooth;
use std::sync::Arc;

/// Settings of the fit of a [`Spline`] to points.
///
/// ```
/// use linecontact::profile::{Fit, Spline};
///
/// // A parabola, in steps of 2.3e-6.
/// let height = |x: f64| (x * x / 2.0 / 2.3e-6).round() * 2.3e-6;
/// let points: Vec<_> = (-100..=100).map(|i| 0.01 * f64::from(i)).map(|x| [x, height(x)]).collect();
/// let smooth = Spline::fitted(&points, Fit { smooth: true, ..Fit::default() })?;
/// # use linecontact::ParametricProfile;
/// assert!((smooth.slope_at(0.3).unwrap() - 0.3).abs() < 1e-5);
/// assert!((smooth.noise() / 0.66e-6 - 1.0).abs() < 0.1); // 2.3e-6/sqrt(12)
/// # Ok::<(), linecontact::profile::SplineError<f64>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
#[cfg_attr(feature = "serde", serde(bound(serialize = "T: Real + serde::Serialize")))]
#[cfg_attr(feature = "serde", serde(bound(deserialize = "T: Real + serde::Deserialize<'de>")))]
pub struct Fit<T> {
    /// True to smooth the points, false (the default) for a curve through them.
    ///
    /// The noise of the measurement and the smoothing that it requires are estimated from the
    /// points, by restricted maximum likelihood; [`Spline::noise`] returns the noise, and
    /// [`Solution::uncertainty`](crate::Solution::uncertainty) what it leaves open. The penalty is
    /// `∫ Y'''² dX`, so that a round body is smoothed over all of its points.
    ///
    /// Noise means heights that are off independently of each other. Roughness that neighbouring
    /// points share is part of the body, and is kept.
    pub smooth: bool,
    /// Distance at which a point is taken for an error of the measurement: its distance from the
    /// cubic through its four neighbours, in standard deviations. These are estimated from the
    /// median of all such distances, or from the 21 points around it if their median is larger.
    /// Default 10; `None` disables the check. It needs twelve points. The two outermost points have
    /// neighbours on one side only: there it detects only errors several times as large. A jump of
    /// the curvature is no such error; a corner, an arc of fewer than three points or an end
    /// that is nearly upright looks like one. In a file 0 stands for `None`.
    #[cfg_attr(feature = "serde", serde(with = "stored"))]
    pub outliers: Option<T>,
    /// Length after which the body repeats, for [`Contact::period`](crate::Contact::period): one
    /// period from the first point on is described, which the first point ends, too, with the same
    /// slope and curvature. The points are those of one period, without that at its end, which is
    /// a step behind the last one, two of the largest at most. A jump there is found like any
    /// outlier: a scan that repeats is level. Default `None`: the ends are free.
    ///
    /// ```
    /// use linecontact::profile::{Fit, Spline};
    /// use linecontact::{Contact, Control, Flat};
    /// use std::f64::consts::PI;
    ///
    /// let points: Vec<_> = (0..100).map(|i| 0.01 * f64::from(i)).map(|x| [x, -0.01 * (2.0 * PI * x).cos()]).collect();
    /// let body = Spline::fitted(&points, Fit { period: Some(1.0), ..Fit::default() })?;
    /// let contact = Contact::new(&Flat, &body)?.contact_modulus(1.0).period(1.0);
    /// let solution = contact.solve(Control::Load(0.005 * PI))?; // Westergaard: half of that which closes all gaps
    /// assert!((solution.hull().half_width() - 0.25).abs() < 1e-6);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub period: Option<T>,
}

/// Number of points beside a period after which its end is forgotten: a slope changes the next by
/// half of its own change or less, at even distances by 0.27 of it.
const FORGOTTEN: usize = 64;

impl<T: Real> Default for Fit<T> {
    fn default() -> Self {
        Self { smooth: false, outliers: Some(T::of(10.0)), period: None }
    }
}

/// Profile through points `[x, y]`, or near them: a cubic spline with two continuous derivatives,
/// `X = k`.
///
/// The points are in order of rising x, at any distances. At either end the outermost two cubics
/// are one (de Boor's "not a knot"), so that four points of a cubic give that cubic. A smoothed
/// spline has even knots, as many as the smoothing needs.
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
pub struct Spline<T> {
    cubics: Vec<Cubic<T>>,
    noise: T,
    /// Uncertainty of a smoothed spline.
    smooth: Option<Arc<Smooth<T>>>,
}

/// Part of the spline between two knots.
#[derive(Clone, Copy, Debug)]
struct Cubic<T> {
    /// Points at both knots.
    ends: [CurvePoint<T>; 2],
    /// Coefficients of `Y` by the distance from the left knot, the constant first.
    coefficients: [T; 4],
    /// False if the spline has noise, which a placement forgets.
    is_exact: bool,
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
    /// // Heights of a parabola, off by 1e-5 up and down.
    /// let height = |i: i32| 2.5e-5 * f64::from(i * i) / 2.0 + 1e-5 * f64::from(i * i * 7 % 5 - 2);
    /// let points: Vec<_> = (-200..=200).map(|i| [0.005 * f64::from(i), height(i)]).collect();
    /// let body = Spline::fitted(&points, Fit { smooth: true, ..Fit::default() })?;
    /// let solution = Contact::new(&Flat, &body)?.solve(Control::Load(0.02))?;
    /// let off = solution.hull().half_width() - 0.2; // of the parabola, sqrt(2 F R/κ)
    /// assert!(off.abs() < 1e-3 && off.abs() < 3.0 * solution.uncertainty()?.half_width);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`SplineError`], with the row of the faulty point.
    pub fn fitted(points: &[[T; 2]], fit: Fit<T>) -> Result<Self, SplineError<T>> {
        T::spline(points, fit)
    }

    pub(crate) fn fit(points: &[[T; 2]], fit: Fit<T>) -> Result<Self, SplineError<T>> {
        points::check(points, fit)?;
        match fit.period {
            Some(period) => return Self::repeated(points, fit, period),
            None if fit.smooth => return Self::smoothed(points),
            None => {}
        }
        let knots = points.iter().zip(slopes::slopes(points)).map(|(&[_, y], slope)| [y, slope]);
        let x: Vec<T> = points.iter().map(|point| point[0]).collect();
        Self::of(&x, &knots.collect::<Vec<_>>())
    }

    /// Fits the spline to points that are placed first. A smoothed spline that is
    /// [placed](Self::placed) after the fit has lost its uncertainty.
    ///
    /// ```
    /// use linecontact::profile::{Fit, Placement, Spline};
    ///
    /// let height = |i: i32| 5e-5 * f64::from(i * i) + 1e-6 * f64::from(i * 7 % 5 - 2);
    /// let points: Vec<_> = (-100..=100).map(|i| [0.01 * f64::from(i), height(i)]).collect();
    /// let (fit, to) = (Fit { smooth: true, ..Fit::default() }, Placement::default());
    /// let [here, there] = [to, to.mirrored().flipped().scaled(3.0)]
    ///     .map(|to| Spline::fitted_at(&points, fit, to));
    /// assert!((there?.noise() / here?.noise() / 3.0 - 1.0).abs() < 1e-6);
    /// # Ok::<(), linecontact::profile::SplineError<f64>>(())
    /// ```
    ///
    /// # Errors
    /// [`SplineError`], with the row of the faulty point; a placement that is not finite, or whose
    /// factor is zero, makes all points faulty.
    pub fn fitted_at(
        points: &[[T; 2]],
        fit: Fit<T>,
        placement: Placement<T>,
    ) -> Result<Self, SplineError<T>> {
        // Rows are counted where the points were measured.
        points::check(points, fit)?;
        let mut placed: Vec<_> = points.iter().map(|&point| placement.apply(point)).collect();
        if placed[placed.len() - 1][0] < placed[0][0] {
            placed.reverse();
        }
        let period = fit.period.map(|period| {
            let [from, to] = [T::zero(), period].map(|x| placement.apply([x, T::zero()]));
            // A body that is turned does not repeat along x.
            if (to[1] - from[1]).is_zero() { (to[0] - from[0]).abs() } else { T::zero() }
        });
        Self::fitted(&placed, Fit { outliers: None, period, ..fit })
    }

    /// Fits the middle one of several periods.
    fn repeated(points: &[[T; 2]], fit: Fit<T>, period: T) -> Result<Self, SplineError<T>> {
        let beside = FORGOTTEN / points.len() + 1;
        let copy = |i| {
            let by = period * (T::count(i) - T::count(beside));
            points.iter().map(move |&[x, y]| [x + by, y])
        };
        let row: Vec<_> = (0..=2 * beside).flat_map(copy).collect();
        let row = Self::fit(&row, Fit { outliers: None, period: None, ..fit })?;
        if fit.smooth {
            let heights: Vec<_> = points.iter().map(|&[x, _]| [x, row.at(x).y]).collect();
            let spline = Self::repeated(&heights, Fit { smooth: false, ..fit }, period)?;
            return Ok(Self { noise: row.noise, smooth: row.smooth, ..spline });
        }
        let x: Vec<_> =
            points.iter().map(|point| point[0]).chain([points[0][0] + period]).collect();
        let knots: Vec<_> = x.iter().map(|&x| row.at(x)).map(|at| [at.y, at.dy]).collect();
        Self::of(&x, &knots)
    }

    fn smoothed(points: &[[T; 2]]) -> Result<Self, SplineError<T>> {
        let (smooth, knots) = Smooth::new(points);
        let x: Vec<T> = (0..knots.len()).map(|knot| smooth.place(knot)).collect();
        let [before, x_last] = [x[0], x[x.len() - 1]];
        let overflow = SplineError::Overflow { row: points.len(), x: x_last, before };
        let spline = Self::of(&x, &knots).map_err(|_| overflow)?;
        Ok(Self { noise: smooth.noise, smooth: Some(Arc::new(smooth)), ..spline })
    }

    /// Returns the standard deviation of the heights, in their own unit, estimated by the fit; 0
    /// for a curve through its points.
    pub fn noise(&self) -> T {
        self.noise
    }

    /// Builds the spline from height and slope at each knot.
    fn of(x: &[T], knots: &[[T; 2]]) -> Result<Self, SplineError<T>> {
        let cubic = |(x, y): (&[T], &[[T; 2]])| {
            let (x, [from, to]) = ([x[0], x[1]], [y[0], y[1]]);
            let (h, two, three) = (x[1] - x[0], T::of(2.0), T::of(3.0));
            let chord = (to[0] - from[0]) / h;
            let second = (three * chord - two * from[1] - to[1]) / h;
            let third = (from[1] + to[1] - two * chord) / h / h;
            let end = |x, [y, dy]: [T; 2]| CurvePoint { x, y, dx: T::one(), dy };
            let ends = [end(x[0], from), end(x[1], to)];
            Cubic { ends, coefficients: [from[0], from[1], second, third], is_exact: true }
        };
        let cubics = x.windows(2).zip(knots.windows(2)).map(cubic).collect();
        let spline = Self { cubics, noise: T::zero(), smooth: None };
        // Coefficients that have overflowed or vanished do not lead to the next knot.
        match spline.first_gap(knots) {
            Some(i) => {
                let [before, x] = spline.cubics[i].domain();
                Err(SplineError::Overflow { row: i + 2, x, before })
            }
            None => Ok(spline),
        }
    }

    /// Finds the first cubic that does not end with the height and the slope of the next knot.
    fn first_gap(&self, knots: &[[T; 2]]) -> Option<usize> {
        let size = |i: usize| knots.iter().fold(T::zero(), |size, knot| size.max(knot[i].abs()));
        let allowed = [0, 1].map(|i| T::epsilon().sqrt() * size(i));
        self.cubics.iter().zip(&knots[1..]).position(|(cubic, to)| {
            let CurvePoint { y, dy, .. } = cubic.at(cubic.ends[1].x);
            let is_finite = allowed[0].is_finite() && allowed[1].is_finite() && dy.is_finite();
            let meets = (y - to[0]).abs() <= allowed[0] && (dy - to[1]).abs() <= allowed[1];
            !(meets && is_finite)
        })
    }

    /// Places the body: moved, mirrored, flipped, turned or scaled.
    ///
    /// The uncertainty of a smoothed spline is lost; [`fitted_at`](Self::fitted_at) keeps it.
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
        let is_exact = self.noise.is_zero();
        let part = |cubic| Cubic { is_exact, ..cubic };
        Piecewise::new(self.cubics.into_iter().map(part).collect())?.placed(placement)
    }

    fn cubic(&self, x: T) -> &Cubic<T> {
        let index = self.cubics.partition_point(|cubic| cubic.ends[1].x < x);
        &self.cubics[index.min(self.cubics.len() - 1)]
    }
}

impl<T: Real> ParametricProfile<T> for Cubic<T> {
    fn domain(&self) -> [T; 2] {
        self.ends.map(|end| end.x)
    }

    fn at(&self, k: T) -> CurvePoint<T> {
        let (t, [a, b, c, d]) = (k - self.ends[0].x, self.coefficients);
        CurvePoint { x: k, y: a + t * (b + t * (c + t * d)), dx: T::one(), dy: self.slope(t) }
    }

    fn slope_at(&self, x: T) -> Option<T> {
        Some(self.slope(x - self.ends[0].x))
    }

    fn slope_deviation(&self, _: &[T], _: &[T]) -> Option<T> {
        self.is_exact.then(T::zero)
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
        [self.cubics[0].ends[0].x, self.cubics[self.cubics.len() - 1].ends[1].x]
    }

    fn at(&self, k: T) -> CurvePoint<T> {
        self.cubic(k).at(k)
    }

    fn slope_at(&self, x: T) -> Option<T> {
        self.cubic(x).slope_at(x)
    }

    fn slope_deviation(&self, x: &[T], weights: &[T]) -> Option<T> {
        match &self.smooth {
            Some(smooth) => Some(smooth.slope_deviation(x, weights)),
            None => self.noise.is_zero().then(T::zero),
        }
    }

    fn pieces(&self) -> usize {
        self.cubics.len()
    }

    fn piece(&self, index: usize) -> Option<Piece<'_, T>> {
        let cubic = self.cubics.get(index)?;
        Some(Piece { curve: cubic, k: cubic.domain(), ends: cubic.ends })
    }
}
