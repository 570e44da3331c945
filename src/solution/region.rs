//! The contacts of a solution, one by one.

use super::pressure_integral::Integrals;
use super::{Peak, Solution, Solved};
use crate::contact::check_given;
use crate::gap::Cost;
use crate::{ContactError, Ends, EvaluationError, Interval, Real};

/// One of the intervals in which the bodies touch, with its load and largest pressure.
///
/// ```
/// use linecontact::profile::Parabola;
/// use linecontact::{Contact, Control, Flat};
///
/// let body = Parabola::new(1.0f64, [-1.0, 1.0])?;
/// let solution = Contact::new(&Flat, &body)?.solve(Control::Load(0.02))?;
/// let contacts = solution.contacts()?;
/// assert_eq!((contacts.len(), contacts[0].load), (1, 0.02));
/// assert!((contacts[0].mean_pressure() / 0.05 - 1.0).abs() < 1e-14); // F/(2 L)
/// assert!(contacts[0].centre_of_pressure()?.abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ContactRegion<T> {
    /// Interval from the left limit to the right one.
    pub interval: Interval<T>,
    /// Load per unit length on this contact, `∫ P dx` over it.
    pub load: T,
    /// Flags: a corner of the bodies holds this limit, an [`Edge::Fixed`](crate::Edge::Fixed) end
    /// or a breakpoint where the slope of the gap jumps up.
    pub held: Ends<bool>,
    /// Strengths of the singularities at the left and at the right limit, pressures: near the right
    /// one `P ≈ K/sin θ` with `x = c + L cos θ`, c and L of this contact. Zero, or zero to
    /// rounding, at a free limit.
    pub edge_singularities: Ends<T>,
    /// Largest pressure; `None` where the pressure is infinite.
    pub peak: Option<Peak<T>>,
    /// Abscissa where the pressure is infinite, at a corner or where the slope of the gap jumps up;
    /// `None` where there is a largest pressure.
    pub infinite_at: Option<T>,
    /// Moment about the centre over the half-width: force per unit length.
    turning: T,
}

impl<T: Real> ContactRegion<T> {
    /// Returns the half-width L.
    pub fn half_width(&self) -> T {
        self.interval.half_width()
    }

    /// Returns the mean pressure, the load over the width.
    pub fn mean_pressure(&self) -> T {
        T::of(0.5) * self.load / self.half_width()
    }

    /// Returns the moment of the pressure about x = 0, `∫ x P dx` over this contact: a force. Not
    /// finite if it exceeds the largest number.
    pub fn moment(&self) -> T {
        self.interval.centre() * self.load + self.half_width() * self.turning
    }

    /// Returns the centre of pressure, `∫ x P dx/∫ P dx` over this contact.
    ///
    /// # Errors
    /// [`InputError::InvalidLoad`](crate::InputError::InvalidLoad) if the load is zero, as it may
    /// be with adhesion.
    pub fn centre_of_pressure(&self) -> Result<T, ContactError<T>> {
        let load = self.load;
        check_given("load", load, !load.is_zero(), "not zero")?;
        Ok(self.interval.centre() + self.half_width() * (self.turning / load))
    }
}

impl<T: Real> Solution<'_, T> {
    /// Returns the contacts one by one, from left to right, with loads, edges and peaks.
    ///
    /// The loads are good to rounding, next to a kink of the slope to a relative error of 1e-12;
    /// they add up to [`load`](Self::load). Each contact takes some hundred pressures.
    ///
    /// ```
    /// use linecontact::{Contact, Control, Curve, CurvePoint, Flat};
    ///
    /// // Two bumps, at -1 and at 1.
    /// let body = Curve::new([-2.0, 2.0], |k: f64| {
    ///     let k2 = k * k;
    ///     CurvePoint { x: k, y: k2 * (k2 - 2.0), dx: 1.0, dy: 4.0 * k * (k2 - 1.0) }
    /// });
    /// let contact = Contact::new(&Flat, &body)?.contact_modulus(1.0);
    /// let solution = contact.solve(Control::Load(1.0))?;
    /// let contacts = solution.contacts()?;
    /// assert_eq!(contacts.len(), 2);
    /// assert!((contacts[1].load - 0.5).abs() < 1e-13);
    /// assert!(contacts[1].interval.contains(contacts[1].centre_of_pressure()?));
    /// # Ok::<(), linecontact::ContactError<f64>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`pressure`](Self::pressure), and [`EvaluationError::Integral`].
    pub fn contacts(&self) -> Result<Vec<ContactRegion<T>>, ContactError<T>> {
        T::regions(self)
    }
}

impl<T: Real> Solved<'_, T> {
    pub fn regions(&self) -> Result<Vec<ContactRegion<T>>, ContactError<T>> {
        let integrals = Integrals::new(*self)?;
        let (is_one, whole) = (self.contacts().len() == 1, self.found.load);
        let region = |(i, &interval): (usize, &Interval<T>)| {
            let half_width = interval.half_width();
            let both = |distance: T, strength: T| [strength, -(distance / half_width) * strength];
            let [load, turning] = integrals.over_one(i, interval.centre(), both)?;
            let (peak, infinite_at) = match self.peak_in(i, &mut Cost::default()) {
                Ok((x, top)) => {
                    (Some(Peak::new(x, integrals.density.with_limits(interval, x, top))), None)
                }
                Err(ContactError::Evaluation(EvaluationError::Singular { x })) => (None, Some(x)),
                Err(error) => return Err(error),
            };
            Ok(ContactRegion {
                interval,
                // The load of a single contact is known.
                load: if is_one { whole } else { load },
                held: self
                    .free(i)
                    .zip(self.found.adhesive)
                    .map(|(free, adhesive)| !(free || adhesive)),
                edge_singularities: self.strengths(i),
                peak,
                infinite_at,
                turning,
            })
        };
        self.contacts().iter().enumerate().map(region).collect()
    }
}
