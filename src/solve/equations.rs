//! Residual of the conditions of a trial contact.

use super::EdgePressure;
use super::edges::{Conditions, Given};
use crate::gap::{Cost, Gap};
use crate::quadrature::{Engine, LoadCase, Moments, complete};
use crate::{Ends, Fallible, InputError, Interval, Real, SolveError};

/// Largest ratio of the width of the panels to that of a contact tried on them: a tip of the bodies
/// that is as much narrower would fall between the nodes.
const MAX_WIDTH_RATIO: f64 = 16.0;

/// Conditions at the edges, as two numbers to be brought to zero.
#[derive(Clone, Copy)]
pub(super) enum Equations<T> {
    /// Singularities of given strength.
    Strength(Conditions<T>),
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
    /// Load that the contact needs, and that it carries.
    needed: T,
    carried: T,
    /// Force to which the residual is compared.
    pub size: T,
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
        self.above(T::of(1e-3) * (self.at_a + self.at_b).abs(), self.shift())
    }

    /// Returns the logarithm of the load needed over the load carried, positive if the contact must
    /// widen: over the logarithm of the width it falls evenly, whatever the shape of the bodies.
    pub fn deficit(&self) -> T {
        let (half, spread) = (T::of(0.5), self.above(self.floor, self.at_a + self.at_b));
        let relative = half * spread / self.carried;
        if spread.is_zero() {
            spread
        } else if relative.abs() < half {
            // From the ratio, which may be huge, only where this is far from one.
            relative.ln_1p()
        } else if self.carried > T::zero() {
            self.needed.ln() - self.carried.ln()
        } else {
            // No load is carried, or tension.
            T::of(2.0) - self.carried / (self.needed + self.size)
        }
    }

    /// Tells whether a contact is beyond the most that the bodies bear: it is wider than one that
    /// carries load, too little, and lacks more, or is under tension. (That a narrower one is under
    /// tension tells nothing: next to a given limit, from which the gap closes at first, tension
    /// grows with the width.)
    pub fn is_beyond_most(&self, narrower: &Self) -> bool {
        let (zero, deficit) = (T::zero(), narrower.deficit());
        let lacks_more = self.carried <= zero || self.deficit() > deficit;
        narrower.carried > zero && deficit > zero && lacks_more
    }

    fn above(&self, floor: T, value: T) -> T {
        if value.abs() <= floor { T::zero() } else { value }
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
            Self::Strength(conditions) => conditions.limits(),
            Self::Pressure { .. } => Ends::both(None),
        }
    }

    /// Returns the half-width, if it is given instead of the load.
    pub fn half_width(&self) -> Option<T> {
        let Self::Strength(Conditions { given: Given::HalfWidth(half_width), .. }) = *self else {
            return None;
        };
        Some(half_width)
    }

    /// Returns the width that a contact must exceed.
    pub fn least_width(&self) -> T {
        match self {
            Self::Strength(_) => T::zero(),
            Self::Pressure { wanted, .. } => wanted.distance_a.max(wanted.distance_b),
        }
    }

    /// Tells whether adhesion is stronger at one edge than at the other.
    pub fn is_lopsided(&self) -> bool {
        let Self::Strength(conditions) = self else { return false };
        let pulls = conditions.edge_strengths(T::one());
        pulls.left != pulls.right
    }

    /// Returns the residual of a trial contact.
    pub fn residual(
        &self,
        gap: &Gap<'_, T>,
        on: Interval<T>,
        integrator: &mut Engine<T>,
        cost: &mut Cost,
    ) -> Fallible<T, Residual<T>> {
        // Panels much wider than the contact are less accurate than they seem.
        let covered = integrator.sampled_interval().map_or(T::zero(), |on| on.half_width());
        if covered > T::of(MAX_WIDTH_RATIO) * on.half_width() {
            integrator.clear_samples();
        }
        let residual = match *self {
            Self::Strength(conditions) => {
                of_strengths(&conditions, on, &integrator.moments(gap, on)?)
            }
            Self::Pressure { kappa, load, wanted } => {
                let load_case = LoadCase { kappa, load, free: Ends::both(false) };
                of_pressures(&load_case, wanted, gap, on, integrator, cost)?
            }
        };
        let [at_a, at_b] = [residual.at_a, residual.at_b];
        if (at_a - at_b).is_finite() && (at_a + at_b).is_finite() {
            Ok(residual)
        } else {
            Err(SolveError::Overflow { interval: on }.into())
        }
    }
}

/// Returns `π L K` at each edge: a force, which stays finite as the contact shrinks.
fn of_strengths<T: Real>(
    conditions: &Conditions<T>,
    on: Interval<T>,
    m: &Moments<T>,
) -> Residual<T> {
    let (half, rounding) = (T::of(0.5), rounding(on));
    let stiffness = conditions.kappa * on.half_width();
    let [middle, balance] = [stiffness * m.m1, stiffness * m.m0];
    let pulls = conditions.edge_strengths(on.half_width());
    let needed = pulls.map(|pull| conditions.load() + pull + pull);
    let carried = Ends { left: middle - balance, right: middle + balance };
    // At a corner only the free edge counts: there the two moments may cancel, with little load
    // left.
    let (at, needed, carried, sum) = match conditions.limits().only_free() {
        Some(side) => {
            let missing = Ends::both(needed[side] - carried[side]);
            (missing, needed[side], carried[side], m.m1.abs() + m.m0.abs())
        }
        None => {
            let missing = Ends::from_fn(|side| needed[side] - carried[side]);
            (missing, half * (needed.left + needed.right), middle, m.m1.abs())
        }
    };
    Residual {
        at_a: at.right,
        at_b: at.left,
        // The estimated error errs on the safe side.
        floor: stiffness * (T::of(0.25) * m.error).max(rounding * m.l1_norm),
        needed,
        carried,
        size: stiffness * sum,
        error: relative_error(on, m, sum),
    }
}

/// Returns `π sqrt((x + b)(a - x)) (P - A)` at both places: a narrow contact is then in balance in
/// the middle, however different the two distances are.
fn of_pressures<T: Real>(
    load_case: &LoadCase<T>,
    wanted: EdgePressure<T>,
    gap: &Gap<'_, T>,
    on: Interval<T>,
    integrator: &mut Engine<T>,
    cost: &mut Cost,
) -> Fallible<T, Residual<T>> {
    let ([x_b, x_a], load, half) = (wanted.places(on), load_case.load, T::of(0.5));
    for (name, value, x, end) in
        [("ε_a", wanted.distance_a, x_a, on.right), ("ε_b", wanted.distance_b, x_b, on.left)]
    {
        if x == end {
            return Err(InputError::InvalidEdgePressure { name, value }.into());
        }
    }
    integrator.prepare(gap, on)?;
    complete(integrator, gap, on, cost)?;
    let mut error = T::zero();
    let mut at = |x, pressure, tolerance| -> Fallible<T, [T; 2]> {
        let estimate = integrator.estimate(gap, load_case, x, cost)?;
        let root = T::pi() * on.chebyshev_weight(x);
        error += root * estimate.error / load;
        Ok([root * (estimate.value - pressure), root * tolerance])
    };
    let [at_a, tolerance_a] = at(x_a, wanted.at_a, wanted.tolerance_a)?;
    let [at_b, tolerance_b] = at(x_b, wanted.at_b, wanted.tolerance_b)?;
    let (floor, carried) = (half * tolerance_a.min(tolerance_b), load - half * (at_a + at_b));
    Ok(Residual { at_a, at_b, floor, needed: load, carried, size: load, error })
}
