//! Residual of the conditions of a trial contact.

use super::EdgePressure;
use super::edges::Conditions;
use crate::gap::{Cost, Gap};
use crate::quadrature::{Engine, LoadCase, Moments, complete};
use crate::{Ends, Fallible, InputError, Interval, Real, Side};

/// Conditions at the edges, as two numbers to be brought to zero.
#[derive(Clone, Copy)]
pub(super) enum Equations<T> {
    /// Singularities of given strength.
    Strength { conditions: Conditions<T>, load: T },
    /// Pressures by Eq. (6).
    Pressure { kappa: T, load: T, wanted: EdgePressure<T> },
}

/// Residual of a trial contact, as forces per unit length. Positive at an edge: the edge must move
/// outward (the paper's readjustment rule).
#[derive(Clone, Copy)]
pub(super) struct Residual<T> {
    /// Residual at `a`.
    pub at_a: T,
    /// Residual at `-b`.
    pub at_b: T,
    /// Value up to which shift and spread count as zero, by rounding or by the tolerances.
    floor: T,
    /// Load that the contact carries, if known.
    pub carried: Option<T>,
    /// Force to which the residual is compared.
    pub size: T,
    /// Factor by which the width of a round body should change; its load is proportional to its
    /// square.
    pub growth: T,
    /// Estimated error of the edges relative to the half-width, from the quadrature.
    pub error: T,
}

impl<T: Real> Residual<T> {
    /// Returns the shift; positive if the whole contact must move to the right.
    pub fn shift(&self) -> T {
        self.above(self.floor, self.at_a - self.at_b)
    }

    /// Returns the shift, or zero if it is small enough to judge the load: moving a contact changes
    /// its spread by less than its shift, so with a shift a thousandth of the spread the sign of
    /// the spread is certain. As the spread vanishes this tightens.
    pub fn rough_shift(&self) -> T {
        let spread = self.at_a + self.at_b;
        self.above(self.floor.max(T::of(1e-3) * spread.abs()), self.at_a - self.at_b)
    }

    /// Returns the spread; positive if the contact must widen.
    pub fn spread(&self) -> T {
        self.above(self.floor, self.at_a + self.at_b)
    }

    /// Returns the spread on a scale on which the width is found in fewer steps: the logarithm of
    /// the load over the load carried, which falls evenly whatever the shape of the bodies.
    pub fn deficit(&self) -> T {
        let (half, spread) = (T::of(0.5), self.spread());
        match self.carried {
            Some(carried) if carried > T::zero() => {
                let residual = half * spread / carried;
                // Close to zero from the difference, elsewhere from the ratio, which may be huge.
                if residual.abs() < half { residual.ln_1p() } else { self.growth.ln() / half }
            }
            // No load is carried: a value larger than any logarithm.
            Some(_) => T::epsilon().recip(),
            None => spread,
        }
    }

    fn above(&self, floor: T, value: T) -> T {
        if value.abs() <= floor { T::zero() } else { value }
    }

    pub fn is_finite(&self) -> bool {
        (self.at_a - self.at_b).is_finite() && (self.at_a + self.at_b).is_finite()
    }
}

/// Returns the rounding of the abscissae, relative to the half-width: it matters far from x = 0.
fn rounding<T: Real>(on: Interval<T>) -> T {
    T::epsilon() * on.left.abs().max(on.right.abs()) / on.half_width()
}

/// Returns the estimated error of the edges relative to the half-width, if their conditions fix a
/// sum of the moments of this size.
pub(super) fn relative_error<T: Real>(on: Interval<T>, m: &Moments<T>, sum: T) -> T {
    m.error / sum + m.inversion / on.half_width() + rounding(on)
}

impl<T: Real> Equations<T> {
    /// Returns the limits -b and a, if given.
    pub fn limits(&self) -> Ends<Option<T>> {
        match *self {
            Self::Strength { conditions, .. } => conditions.limits(),
            Self::Pressure { .. } => Ends::both(None),
        }
    }

    /// Tells whether adhesion is stronger at one edge than at the other.
    pub fn is_lopsided(&self) -> bool {
        let Self::Strength { conditions, .. } = self else { return false };
        let pulls = conditions.edge_strengths(T::one());
        pulls.left != pulls.right
    }

    /// Checks that the conditions can be evaluated on bodies that cover this range of x.
    pub fn check(&self, range: [T; 2]) -> Fallible<T, ()> {
        if let Self::Pressure { wanted, .. } = self {
            for (name, value) in [("ε_a", wanted.distance_a), ("ε_b", wanted.distance_b)] {
                if value >= range[1] - range[0] {
                    return Err(InputError::InvalidEdgePressure { name, value }.into());
                }
            }
        }
        Ok(())
    }

    /// Returns the width that a contact must exceed.
    pub fn least_width(&self) -> T {
        match self {
            Self::Strength { .. } => T::zero(),
            Self::Pressure { wanted, .. } => wanted.distance_a.max(wanted.distance_b),
        }
    }

    /// Returns the residual of a trial contact.
    pub fn residual(
        &self,
        gap: &Gap<'_, T>,
        on: Interval<T>,
        integrator: &mut Engine<T>,
        cost: &mut Cost,
    ) -> Fallible<T, Residual<T>> {
        match *self {
            Self::Strength { conditions, load } => {
                let m = integrator.moments(gap, on)?;
                Ok(Residual::of_strengths(&conditions, load, on, &m))
            }
            Self::Pressure { kappa, load, wanted } => {
                of_pressures(kappa, load, wanted, gap, on, integrator, cost)
            }
        }
    }
}

impl<T: Real> Residual<T> {
    /// Returns `π L K` at each edge: a force, which stays finite as the contact shrinks.
    fn of_strengths(conditions: &Conditions<T>, load: T, on: Interval<T>, m: &Moments<T>) -> Self {
        let (half, rounding) = (T::of(0.5), rounding(on));
        let stiffness = conditions.kappa * on.half_width();
        let [carried, balance] = [stiffness * m.m1, stiffness * m.m0];
        let pulls = conditions.edge_strengths(on.half_width()).map(|pull| pull + pull);
        let needed = pulls.map(|pull| load + pull);
        // At a corner only the free edge counts: there the two moments may cancel, with little load
        // left.
        let (missing, needed, borne, sum) = match conditions.limits().only_free() {
            Some(side) => {
                let borne = if side == Side::Left { carried - balance } else { carried + balance };
                let sum = m.m1.abs() + m.m0.abs();
                (Ends::both(needed[side] - borne), needed[side], borne, sum)
            }
            None => {
                let missing = needed.map(|needed| needed - carried);
                let missing = Ends { left: missing.left + balance, right: missing.right - balance };
                (missing, load + half * (pulls.left + pulls.right), carried, m.m1.abs())
            }
        };
        let ratio = needed / borne;
        let least = T::epsilon().powi(5);
        let growth = if !(borne > T::zero() && needed > T::zero()) {
            T::of(2.0)
        } else if ratio > least && ratio < least.recip() {
            ratio.sqrt()
        } else {
            // Roots avoid underflow.
            needed.sqrt() / borne.sqrt()
        };
        Self {
            at_a: missing.right,
            at_b: missing.left,
            // The estimated error errs on the safe side.
            floor: stiffness * (T::of(0.25) * m.error).max(rounding * m.l1_norm),
            carried: Some(borne),
            size: stiffness * sum,
            growth,
            error: relative_error(on, m, sum),
        }
    }
}

/// Returns `π sqrt((x + b)(a - x)) (P - A)` at both places: a narrow contact is then in balance in
/// the middle, however different the two distances are.
fn of_pressures<T: Real>(
    kappa: T,
    load: T,
    wanted: EdgePressure<T>,
    gap: &Gap<'_, T>,
    on: Interval<T>,
    integrator: &mut Engine<T>,
    cost: &mut Cost,
) -> Fallible<T, Residual<T>> {
    let (two, [x_b, x_a]) = (T::of(2.0), wanted.places(on));
    for (name, value, x, end) in
        [("ε_a", wanted.distance_a, x_a, on.right), ("ε_b", wanted.distance_b, x_b, on.left)]
    {
        if x == end {
            return Err(InputError::InvalidEdgePressure { name, value }.into());
        }
    }
    integrator.prepare(gap, on)?;
    complete(integrator, gap, on, cost)?;
    let load_case = LoadCase { kappa, load, free: Ends::both(false) };
    let mut error = T::zero();
    let mut residual = |x, pressure| -> Fallible<T, T> {
        let estimate = integrator.estimate(gap, &load_case, x, cost)?;
        let root = T::pi() * on.chebyshev_weight(x);
        error += root * estimate.error / load;
        Ok(root * (estimate.value - pressure))
    };
    let (at_a, at_b) = (residual(x_a, wanted.at_a)?, residual(x_b, wanted.at_b)?);
    let growth = if at_a + at_b > T::zero() { two } else { two.recip() };
    let tolerance = |x, tolerance| T::pi() * on.chebyshev_weight(x) * tolerance;
    let tolerance_a = tolerance(x_a, wanted.tolerance_a);
    let floor = T::of(0.5) * tolerance_a.min(tolerance(x_b, wanted.tolerance_b));
    Ok(Residual { at_a, at_b, floor, carried: None, size: load, growth, error })
}
