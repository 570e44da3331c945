//! Uncertainty of a contact by the noise of measured points.

use super::{LoadRates, Solution};
use crate::{ContactError, EvaluationError, Real};

/// Least number of places at which slopes of the gap are taken.
const LEAST_PLACES: usize = 64;

/// Number of places for each breakpoint in the contact, so that they resolve a smoothed spline.
const PLACES_PER_BREAKPOINT: usize = 4;

/// Standard deviations of a contact whose bodies were measured with noise, under the load of the
/// solution.
///
/// An error δ of the slope of the gap moves the pressure at fixed limits and load by
///
/// ```text
/// δP(x) = κ/(π² w(x)) PV∫ w(s) δ(s)/(s - x) ds,    w(x) = sqrt((x + b)(a - x))
/// ```
///
/// (Johnson, *Contact Mechanics*, 1985, §2.7). The singularities that this leaves at the limits
/// move them, in proportion to their [derivatives by the load](LoadRates), so that with
/// `s = c + L cos θ`
///
/// ```text
/// δa = -(κ L/π) da/dF ∫ δ (1 + cos θ) dθ,    δb = (κ L/π) db/dF ∫ δ (1 - cos θ) dθ
/// ```
///
/// All are linear in δ, and so their variances follow from the covariance of the fit
/// ([`ParametricProfile::slope_deviation`](crate::ParametricProfile::slope_deviation)). It is that
/// of a curve which is as rough as the penalty of the fit allows (Wahba, *J. R. Stat. Soc. B* 45,
/// 1983, 133): rather too large for a smoother body, and too small where the curvature jumps.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Uncertainty<T> {
    /// Standard deviation of the limit a, a length.
    pub a: T,
    /// Standard deviation of the limit b, a length.
    pub b: T,
    /// Standard deviation of the half-width, a length.
    pub half_width: T,
    /// Standard deviation of the largest pressure, a pressure.
    pub peak_pressure: T,
}

impl<T: Real> Solution<'_, T> {
    /// Returns the standard deviations that the noise of measured points leaves in limits and
    /// largest pressure: of bodies by [`Spline::fitted`](crate::profile::Spline::fitted) with
    /// [`Fit::smooth`](crate::profile::Fit::smooth). They are 0 for exact bodies. Compare
    /// [`limits_error`](Self::limits_error), the numerical error for the bodies as given.
    ///
    /// # Errors
    /// [`EvaluationError::NoUncertainty`] for several contacts, and for a smoothed spline that was
    /// placed or read from a file; those of [`load_rates`](Self::load_rates) and
    /// [`peak`](Self::peak).
    pub fn uncertainty(&self) -> Result<Uncertainty<T>, ContactError<T>> {
        self.solved().of_half_planes("the uncertainty")?;
        let (on, LoadRates { a, b, .. }) = (self.hull(), self.load_rates()?);
        if self.intervals().len() > 1 {
            return Err(EvaluationError::NoUncertainty { why: "there are several contacts" }.into());
        }
        let breakpoints = self.gap.breakpoints(on).count();
        let count = LEAST_PLACES.max(PLACES_PER_BREAKPOINT * breakpoints);
        let step = T::pi() / T::count(count);
        let angles: Vec<T> = (0..count).map(|i| step * (T::count(i) + T::of(0.5))).collect();
        let x: Vec<T> = angles.iter().map(|&angle| on.at_angle(angle)).collect();
        let why = "a smoothed spline was placed, or read from a file: place its points, then fit";
        let unknown = EvaluationError::NoUncertainty { why };
        let deviation = |weight: &dyn Fn(usize) -> T| {
            let weights: Vec<T> = (0..count).map(weight).collect();
            self.gap.slope_deviation(&x, &weights).ok_or_else(|| unknown.clone())
        };
        let factor = self.kappa * on.half_width() / T::pi() * step;
        let moves = |i: usize| {
            let cos = angles[i].cos();
            [-factor * a * (T::one() + cos), factor * b * (T::one() - cos)]
        };
        // The rule is exact between its places: the peak is flat, and the nearest will do.
        let peak = self.peak()?.x;
        let cos = ((peak - on.centre()) / on.half_width()).max(-T::one()).min(T::one());
        let middle = T::count(count - 1).min((cos.acos() / step).round().max(T::one())) * step;
        let place = on.at_angle(middle);
        let pressure = |i: usize| {
            let share = angles[i].sin().powi(2) / middle.sin();
            self.kappa * on.half_width() / T::pi().powi(2) * step * share / (x[i] - place)
        };
        Ok(Uncertainty {
            a: deviation(&|i| moves(i)[0])?,
            b: deviation(&|i| moves(i)[1])?,
            half_width: deviation(&|i| T::of(0.5) * (moves(i)[0] + moves(i)[1]))?,
            peak_pressure: deviation(&pressure)?,
        })
    }
}
