//! Derivatives of limits and pressure by the load.

use super::pressure_integral::Density;
use super::solved::Solved;
use crate::kernel::{Spread, punch};
use crate::quadrature::panels::LoadResponse;
use crate::{ContactError, Ends, EvaluationError, Fallible, Interval, Real, Solution};

/// Exact derivatives of a contact by its load per unit length F, at constant other data.
///
/// Whether or not the limits change, the derivative of the pressure solves the equation of a flat
/// punch, `PV∫ P_F(s)/(x - s) ds = 0`, under a unit load. In one contact it is
///
/// ```text
/// ∂P/∂F = 1/(π sqrt((x + b)(a - x)))
/// ```
///
/// (Johnson, *Contact Mechanics*, 1985, Eq. 2.64). The limits follow from `K_a = 0`, `K_b = 0`,
/// that is from `F = κ L (m₁ ± m₀)` (see [`quadrature`](crate::quadrature)), at each free edge:
///
/// ```text
/// dF/da = κ ( m₀/2 + L/π ∫ g'(x) (1 + cos θ) dθ),   dF/db = κ (-m₀/2 + L/π ∫ g'(x) (1 - cos θ) dθ)
/// ```
///
/// with θ from 0 to π. The limits of several contacts follow from their linearised equations, and
/// so does the pressure. It grows everywhere and all contacts widen (Buyarov and Rakhmanov, *Sb.
/// Math.* 190, 1999, 791). Where contacts appear or merge the limits have no derivative.
///
/// ```
/// use linecontact::profile::Parabola;
/// use linecontact::{Contact, Control, Flat};
///
/// let body = Parabola::new(1.0f64, [-1.0, 1.0])?;
/// let solution = Contact::new(&Flat, &body)?.solve(Control::Load(0.02))?;
/// let rates = solution.load_rates()?;
/// assert!((rates.a / 5.0 - 1.0).abs() < 1e-14); // R/(κ L)
/// let at_centre = 1.0 / (0.2 * std::f64::consts::PI); // 1/(π L)
/// assert!((rates.pressure(0.0)? / at_centre - 1.0).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LoadRates<T> {
    /// da/dF, length² per force; zero at a fixed edge.
    pub a: T,
    /// db/dF, length² per force; zero at a fixed edge.
    pub b: T,
    /// dx/dF of both limits of each contact, from left to right.
    pub limits: Vec<Ends<T>>,
    #[cfg_attr(feature = "serde", serde(skip))]
    punch: Touching<T>,
}

/// Contacts that the flat punch covers.
#[derive(Clone, Debug, PartialEq)]
enum Touching<T> {
    One(Interval<T>),
    /// Contacts of bodies that are not half-planes, each with its part of the rate, and the period.
    Bent(Vec<Spread<T>>, Option<T>),
    Several(Box<LoadResponse<T>>),
}

impl<T: Real> Density<T> for &LoadRates<T> {
    fn values(&self, x: &[T], rates: &mut [T]) -> Fallible<T, ()> {
        rates.iter_mut().zip(x).try_for_each(|(rate, &x)| {
            *rate = self.pressure(x)?;
            Ok(())
        })
    }
}

impl<T: Real> LoadRates<T> {
    /// Creates the derivatives of a single contact.
    fn of_one(limits: Ends<T>, on: Interval<T>) -> Self {
        let Ends { left, right } = limits;
        Self { a: right, b: -left, limits: vec![limits], punch: Touching::One(on) }
    }

    /// Returns ∂P/∂F at a fixed `x`, in any period, one over a length; zero outside the contacts.
    ///
    /// # Errors
    /// [`EvaluationError::Singular`] at the edges, where it is infinite;
    /// [`EvaluationError::InvalidPosition`] for NaN.
    pub fn pressure(&self, x: T) -> Result<T, ContactError<T>> {
        let contact = |i: usize| match &self.punch {
            Touching::One(on) => (i == 0).then_some(on),
            Touching::Bent(spreads, _) => spreads.get(i).map(|spread| &spread.on),
            Touching::Several(punch) => punch.contacts().get(i),
        };
        let x = match &self.punch {
            Touching::Bent(spreads, Some(period)) => {
                x - *period * ((x - spreads[0].on.left) / *period).floor()
            }
            _ => x,
        };
        // NaN is beyond no limit.
        let is_beyond = |on: &Interval<T>| on.right < x;
        let i = (0..self.limits.len()).position(|i| contact(i).is_none_or(|on| !is_beyond(on)));
        let i = i.unwrap_or(self.limits.len());
        match contact(i) {
            Some(on) if on.contains(x) => Ok(match &self.punch {
                Touching::One(on) => T::frac_1_pi() / on.chebyshev_weight(x),
                Touching::Bent(spreads, _) => spreads[i].at(x),
                Touching::Several(punch) => punch.pressure(i, x),
            }),
            Some(on) if x == on.left || x == on.right => {
                Err(EvaluationError::Singular { x }.into())
            }
            // NaN lies in no contact.
            Some(&interval) if x >= interval.left || x.partial_cmp(&x).is_none() => {
                Err(EvaluationError::InvalidPosition { x, inside: true, interval }.into())
            }
            _ => Ok(T::zero()),
        }
    }
}

impl<T: Real> Solution<'_, T> {
    /// Returns the derivatives of pressure and limits by the load.
    ///
    /// # Errors
    /// [`EvaluationError::NoLoadDerivative`] with adhesion; with edges by the paper's Eq. (6); with
    /// a quadrature that does not know the derivatives of its integrals
    /// ([`Midpoint`](crate::Midpoint)), unless both limits are given; where contacts appear or
    /// merge.
    pub fn load_rates(&self) -> Result<LoadRates<T>, ContactError<T>> {
        T::load_rates(self)
    }
}

impl<T: Real> LoadRates<T> {
    /// Returns the derivatives of a contact, of bodies with a layer or another kernel, too: the
    /// bend changes with the load.
    pub(crate) fn of(solved: Solved<'_, T>) -> Fallible<T, Self> {
        let held = Self::new(solved)?;
        let Some(bend) = solved.gap.bend() else { return Ok(held) };
        let Some(spreads) = punch(bend.kernel_of_bodies(), solved.contacts(), false) else {
            let why = "the equation of a punch on the bodies is singular";
            return Err(EvaluationError::NoLoadDerivative { why }.into());
        };
        // A limit moves by the strength of the punch there.
        let Self { mut limits, punch, .. } = held;
        for (i, (rates, spread)) in limits.iter_mut().zip(&spreads).enumerate() {
            let held = match &punch {
                Touching::Several(response) => Ends::from_fn(|side| response.strength(i, side)),
                _ => Ends::both(T::one()),
            };
            let ratio = spread.strengths().zip(held).map(|(new, held)| new / held);
            // A limit that is held stays.
            *rates = rates
                .zip(ratio)
                .map(|(rate, ratio)| if rate.is_zero() { rate } else { rate * ratio });
        }
        let [b, a] = [-limits[0].left, limits[limits.len() - 1].right];
        let period = bend.kernel_of_bodies().row.as_ref().map(|row| row.period);
        Ok(Self { a, b, limits, punch: Touching::Bent(spreads, period) })
    }

    /// Returns the derivatives of a contact of half-planes, or of bodies with a given bend.
    pub(crate) fn new(solved: Solved<'_, T>) -> Fallible<T, Self> {
        let Solved { found, kappa, .. } = solved;
        let Some(several) = solved.several().filter(|_| found.apart.is_none()) else {
            return Ok(Self::of_one(Self::limits_of_one(solved)?, found.interval));
        };
        let Some((mut limits, punch)) = several.rates(found.load / kappa) else {
            let why = "two contacts are about to merge, or one is about to vanish";
            return Err(EvaluationError::NoLoadDerivative { why }.into());
        };
        limits.iter_mut().for_each(|rates| *rates = rates.map(|rate| rate / kappa));
        let [b, a] = [-limits[0].left, limits[limits.len() - 1].right];
        Ok(Self { a, b, limits, punch: Touching::Several(Box::new(punch)) })
    }

    /// Returns the derivatives of the limits of a single contact.
    pub(crate) fn limits_of_one(solved: Solved<'_, T>) -> Fallible<T, Ends<T>> {
        let Solved { found, kappa, .. } = solved;
        let on = found.interval;
        let refuse = |why| Err(EvaluationError::NoLoadDerivative { why }.into());
        if found.apart.is_some() {
            return refuse("the bodies are not pressed together, and have no limits");
        }
        if found.adhesive != Ends::both(false) {
            return refuse(
                "an adhesive edge moves with a singular pressure; prescribe a load in place of an approach",
            );
        }
        if found.free == Ends::both(false) {
            let Ends { left, right } = found.ends;
            let at_corner = |x: T| x == left || x == right || solved.gap.is_breakpoint(x);
            return if found.error.is_none() || at_corner(on.left) && at_corner(on.right) {
                Ok(Ends::both(T::zero()))
            } else {
                refuse("the limits were sought by Eq. (6), not by free edges")
            };
        }
        let Some(derivatives) = found.moment_derivatives else {
            return refuse("the quadrature has no derivatives of its integrals; use Panels");
        };
        let half_width = on.half_width();
        let mean = if found.free == Ends::both(true) {
            T::zero()
        } else {
            T::frac_pi_2() * (found.strengths.left - found.strengths.right) / kappa
        };
        let rate = |free: bool, sign: T| {
            let slope = half_width * (derivatives.by_0 + sign * derivatives.by_1);
            let stiffness = kappa * (T::of(0.5) * sign * mean + slope);
            if free { T::one() / stiffness } else { T::zero() }
        };
        let Ends { left, right } = found.free;
        Ok(Ends { left: -rate(left, -T::one()), right: rate(right, T::one()) })
    }
}
