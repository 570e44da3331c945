//! Solution in numbers alone.

use super::{Peak, Report, Solution};
use crate::gap::Cost;
use crate::{ContactError, Ends, EvaluationError, Interval, Real};

/// Numbers of a solution, without its bodies: a row of a table, or with the feature `serde` of a
/// file. [`Solution::summary`] makes it.
///
/// ```
/// use linecontact::profile::Parabola;
/// use linecontact::{Contact, Control, Flat};
///
/// let body = Parabola::new(1.0f64, [-1.0, 1.0])?;
/// let row = Contact::new(&Flat, &body)?.solve(Control::Load(0.02))?.summary()?;
/// let mean = 0.02 / 0.4; // F/(a + b)
/// assert!((row.mean_pressure / mean - 1.0).abs() < 1e-14);
/// assert!((row.peak.unwrap().pressure / mean - 4.0 / std::f64::consts::PI).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Summary<T> {
    /// Intervals `[-b, a]` in which the bodies touch, from left to right: lengths.
    pub intervals: Vec<Interval<T>>,
    /// Load per unit length F, of all contacts: force/length.
    pub load: T,
    /// Load per unit length on each contact, in the order of the intervals: force/length.
    pub loads: Vec<T>,
    /// Scale κ: a pressure.
    pub kappa: T,
    /// Tilt τ of body 2, counter-clockwise: an angle in radians.
    pub tilt: T,
    /// Mean pressure, F over the widths of all contacts: a pressure.
    pub mean_pressure: T,
    /// Largest pressure p₀ and its x, a pressure and a length; `None` where the pressure is
    /// infinite.
    pub peak: Option<Peak<T>>,
    /// Centre of pressure x̄, a length; `None` if the load is zero, as it may be with adhesion.
    pub centre_of_pressure: Option<T>,
    /// K_b and K_a, the strengths of the edge singularities at the first and at the last limit:
    /// pressures.
    pub edge_singularities: Ends<T>,
    /// Estimated error of the limits as a share of the half-width L, no unit; `None` if both were
    /// given.
    pub limits_error: Option<T>,
    /// True if the solution was checked to be the contact of the bodies ([`Report::is_checked`]).
    pub checked: bool,
    /// Evaluations and samples of the search for the limits: counts.
    pub cost: Cost,
    /// Starts that were tried, and the results of the checks.
    pub report: Report,
}

impl<T: Real> Solution<'_, T> {
    /// Returns the numbers of the solution, to be kept without the bodies: limits, loads, largest
    /// pressure, quality and cost. It takes some hundred pressures for each contact.
    ///
    /// # Errors
    /// Those of [`contacts`](Self::contacts) and [`centre_of_pressure`](Self::centre_of_pressure),
    /// except for a load of zero.
    pub fn summary(&self) -> Result<Summary<T>, ContactError<T>> {
        let contacts = self.contacts()?;
        let peak = match self.peak() {
            Ok(peak) => Some(peak),
            Err(ContactError::Evaluation(EvaluationError::Singular { .. })) => None,
            Err(error) => return Err(error),
        };
        let centre_of_pressure =
            if self.load().is_zero() { None } else { Some(self.centre_of_pressure()?) };
        Ok(Summary {
            intervals: self.intervals().to_vec(),
            load: self.load(),
            loads: contacts.iter().map(|contact| contact.load).collect(),
            kappa: self.kappa,
            tilt: self.tilt(),
            mean_pressure: self.mean_pressure(),
            peak,
            centre_of_pressure,
            edge_singularities: self.edge_singularities(),
            limits_error: self.limits_error(),
            checked: self.report().is_checked(),
            cost: self.cost(),
            report: *self.report(),
        })
    }
}
