//! The pressure of a solution.

use super::potential::Potential;
use super::pressure_integral::Density;
use super::solved::Solved;
use super::{ContactState, Solution};
use crate::gap::{Cost, Gap};
use crate::quadrature::panels::CauchyTransform;
use crate::quadrature::{Engine, Estimate, LoadCase};
use crate::{ContactError, Ends, EvaluationError, Fallible, Interval, Real, Side, SolveError};

/// Largest number of points of a contact that [`Pressure::sample`] takes.
const MAX_SAMPLE: usize = 1 << 20;

/// Number of points of a row, the unit in which points are retried one by one after a failure.
const ROW: usize = 256;

impl<T: Real> Solution<'_, T> {
    /// Returns the pressure distribution. With [`Panels`](crate::Panels) it takes no further
    /// sample.
    ///
    /// # Errors
    /// Those of sampling the gap.
    pub fn pressure(&self) -> Result<Pressure<'_, T>, ContactError<T>> {
        Pressure::new(self.solved())
    }
}

/// Pressure over a contact.
///
/// ```
/// use linecontact::profile::Parabola;
/// use linecontact::{Contact, Control, Flat};
///
/// let body = Parabola::new(1.0f64, [-1.0, 1.0])?;
/// let solution = Contact::new(&Flat, &body)?.solve(Control::Load(0.02))?;
/// let pressure = solution.pressure()?;
/// // κ/(π R) sqrt(L² - x²)
/// let exact = (0.04f64 - 0.01).sqrt() / std::f64::consts::PI;
/// assert!((pressure.at(0.1)? / exact - 1.0).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Pressure<'p, T: Real> {
    gap: &'p Gap<'p, T>,
    integrator: &'p Engine<T>,
    load_case: LoadCase<T>,
    /// Interval from the first limit to the last.
    on: Interval<T>,
    contacts: &'p [Interval<T>],
    /// Load error that corresponds to the error of the limits.
    load_error: T,
    /// Relative error of the limits times the strengths of the edges at -b and a, with adhesion.
    held: Ends<T>,
    cost: Cost,
}

impl<'p, T: Real> Pressure<'p, T> {
    /// Prepares the pressure, and takes the samples still missing.
    pub(crate) fn new(solved: Solved<'p, T>) -> Fallible<T, Self> {
        let Solved { gap, integrator, kappa, found } = solved;
        let contacts = solved.contacts();
        let cost = if contacts.is_empty() { Cost::default() } else { integrator.complete(gap)? };
        let ContactState {
            interval: on, load, free, error, load_error, strengths, adhesive, ..
        } = *found;
        let error = error.unwrap_or(T::zero());
        let load_error = load_error.unwrap_or(T::of(3.0) * load.abs() * error);
        let held =
            |(glued, strength): (bool, T)| if glued { strength.abs() * error } else { T::zero() };
        let held = adhesive.zip(strengths).map(held);
        let load_case = LoadCase { kappa, load, free };
        Ok(Self { gap, integrator, load_case, on, contacts, load_error, held, cost })
    }
}

impl<T: Real> Pressure<'_, T> {
    /// Returns `P(x)`, zero outside the contact and at a free edge.
    ///
    /// # Errors
    /// [`EvaluationError::Unresolved`] where, between free edges, the estimated error is more than
    /// a third of the pressure, as it becomes very close to an edge, unless `x` is the limit to
    /// rounding; [`EvaluationError::Singular`] where the pressure is infinite;
    /// [`SolveError::OutsideBodies`] beyond either body, and for NaN; those of sampling the gap at
    /// `x`.
    pub fn at(&self, x: T) -> Result<T, ContactError<T>> {
        T::pressure(self, x)
    }

    pub(crate) fn at_one(&self, x: T) -> Fallible<T, T> {
        let x = self.gap.folded(x);
        let estimate = self.estimated(x, &mut Cost::default())?;
        let Estimate { value: pressure, error } = estimate;
        // With other edges a pressure may pass through zero, where only its absolute error counts.
        let free = self.load_case.free == Ends::both(true);
        if free && !estimate.is_resolved() && self.on.contains(x) && !self.is_at_limit(x) {
            Err(EvaluationError::Unresolved { x, pressure, error }.into())
        } else {
            Ok(pressure)
        }
    }

    /// Tells whether x is a limit of a contact to the rounding of `-b + (a + b) t`.
    fn is_at_limit(&self, x: T) -> bool {
        Interval::find(self.contacts, x).1.is_some_and(|on| {
            let rounding = T::of(4.0) * T::epsilon() * (on.left.abs() + on.right.abs());
            (x - on.left).min(on.right - x) <= rounding
        })
    }

    /// Fills in `P(x)` at any number of points, in any order, faster than one by one. Pressures
    /// that [`at`](Self::at) refuses as unresolved are returned unchanged.
    ///
    /// # Errors
    /// As [`estimate`](Self::estimate). The points before the failing one have been filled in.
    /// [`EvaluationError::LengthMismatch`] if the two slices are not of the same length.
    pub fn at_many(&self, x: &[T], pressures: &mut [T]) -> Result<(), ContactError<T>> {
        T::pressures(self, x, pressures)
    }

    pub(crate) fn at_all(&self, x: &[T], pressures: &mut [T]) -> Fallible<T, ()> {
        if x.len() != pressures.len() {
            return Err(
                EvaluationError::LengthMismatch { x: x.len(), pressures: pressures.len() }.into()
            );
        }
        if self.gap.is_repeated() {
            let x: Vec<T> = x.iter().map(|&x| self.gap.folded(x)).collect();
            return self.fill(&x, pressures, &mut Cost::default());
        }
        self.fill(x, pressures, &mut Cost::default())
    }

    /// Fills in all pressures at once if all points are strictly inside and all pressures finite,
    /// otherwise row by row; a row that fails goes point by point.
    fn fill(&self, x: &[T], pressures: &mut [T], cost: &mut Cost) -> Fallible<T, ()> {
        // No early exit from the loops, for speed.
        if x.iter().fold(true, |all, &x| all & self.on.contains(x)) {
            self.integrator.pressures(self.gap, &self.load_case, x, pressures, cost)?;
            if pressures.iter().fold(true, |all, pressure| all & pressure.is_finite()) {
                return Ok(());
            }
        }
        if x.len() > ROW {
            let mut rows = x.chunks(ROW).zip(pressures.chunks_mut(ROW));
            return rows.try_for_each(|(x, pressures)| self.fill(x, pressures, cost));
        }
        for (&x, pressure) in x.iter().zip(pressures) {
            *pressure = self.estimated(x, cost)?.value;
        }
        Ok(())
    }

    /// Returns `[x, P(x)]` at `count` points of each contact, from 2 to 2²⁰, limits included, by
    /// rising x. They crowd towards the limits, where the pressure falls like a square root, so
    /// that lines between them draw it. Points where the pressure is infinite, at a limit or
    /// inside, are left out.
    ///
    /// ```
    /// use linecontact::profile::Parabola;
    /// use linecontact::{Contact, Control, Flat};
    ///
    /// let parabola = Parabola::new(1.0, [-1.0, 1.0])?;
    /// let solution = Contact::new(&Flat, &parabola)?.solve(Control::Load(0.02))?;
    /// let points = solution.pressure()?.sample(65)?;
    /// assert_eq!(points.len(), 65);
    /// assert_eq!(points[0], [solution.hull().left, 0.0]);
    /// assert!((points[32][1] - 0.2 / std::f64::consts::PI).abs() < 1e-15); // a/π in the middle
    /// # Ok::<(), linecontact::ContactError<f64>>(())
    /// ```
    ///
    /// # Errors
    /// As [`at_many`](Self::at_many).
    pub fn sample(&self, count: usize) -> Result<Vec<[T; 2]>, ContactError<T>> {
        let count = count.clamp(2, MAX_SAMPLE);
        let mut points = Vec::with_capacity(count * self.contacts.len());
        for (i, on) in self.contacts.iter().enumerate() {
            let free = self.integrator.free_of(i, self.load_case.free);
            if free.left {
                points.push([on.left, T::zero()]);
            }
            let angle = |j: usize| T::pi() * T::count(j) / T::count(count - 1);
            let x: Vec<T> = (1..count - 1).rev().map(|j| on.at_angle(angle(j))).collect();
            let mut pressures = vec![T::zero(); x.len()];
            self.values(&x, &mut pressures)?;
            let inside = x.into_iter().zip(pressures).map(|(x, pressure)| [x, pressure]);
            points.extend(inside.filter(|[_, pressure]| pressure.is_finite()));
            if free.right {
                points.push([on.right, T::zero()]);
            }
        }
        Ok(points)
    }

    /// Returns `P(x)`, however uncertain, with its estimated error, and adds the cost of this point
    /// to `cost`: nothing with [`Panels`](crate::Panels); with [`Midpoint`](crate::Midpoint)
    /// nothing on the grid of the rule, one sample of the gap elsewhere, seven next to one of its
    /// points.
    ///
    /// The error is the error of the quadrature plus the effect of the error of the limits.
    ///
    /// # Errors
    /// As [`at`](Self::at), without [`EvaluationError::Unresolved`].
    pub fn estimate(&self, x: T, cost: &mut Cost) -> Result<Estimate<T>, ContactError<T>> {
        T::estimate(self, x, cost)
    }

    /// Returns `P(x)` with its estimated error, as [`estimate`](Self::estimate) does, uncounted.
    ///
    /// # Errors
    /// As [`estimate`](Self::estimate).
    pub fn with_error(&self, x: T) -> Result<Estimate<T>, ContactError<T>> {
        self.estimate(x, &mut Cost::default())
    }

    pub(crate) fn estimated(&self, x: T, cost: &mut Cost) -> Fallible<T, Estimate<T>> {
        let (x, range) = (self.gap.folded(x), self.gap.range());
        if !(x >= range[0] && x <= range[1]) {
            return Err(SolveError::OutsideBodies { x, range }.into());
        }
        let (_, Some(on)) = Interval::find(self.contacts, x) else {
            let free = |i| self.integrator.free_of(i, self.load_case.free);
            let is_held = |(i, on): (usize, &Interval<T>)| {
                Side::BOTH.into_iter().any(|side| x == on[side] && !free(i)[side])
            };
            return match self.contacts.iter().enumerate().any(is_held) {
                true => Err(EvaluationError::Singular { x }.into()),
                false => Ok(Estimate { value: T::zero(), error: T::zero() }),
            };
        };
        let estimate = self.integrator.estimate(self.gap, &self.load_case, x, cost)?;
        if !estimate.value.is_finite() {
            return Err(EvaluationError::Singular { x }.into());
        }
        Ok(self.with_limits(on, x, estimate))
    }

    /// Adds the effect of the error of the limits to the error of a pressure in a contact.
    pub(super) fn with_limits(
        &self,
        on: Interval<T>,
        x: T,
        mut estimate: Estimate<T>,
    ) -> Estimate<T> {
        // If the limits move, P changes as under the load that would move them, by 1/(π w) for each
        // unit of it. The load is given, so the change is of second order, except at points so
        // close to an edge that they might lie on its other side.
        let change = self.load_error / (T::pi() * on.chebyshev_weight(x));
        let share = change / estimate.value.abs();
        estimate.error += if share < T::of(0.1) { change * share } else { change };
        // An adhesive edge that moves takes its singularity along: `P ≈ K sqrt(L/2d)`.
        for (held, distance) in
            [(self.held.right, self.on.right - x), (self.held.left, x - self.on.left)]
        {
            let share = self.on.half_width() / distance;
            estimate.error += T::of(0.5) * held * share * share.sqrt();
        }
        estimate
    }

    /// Returns the Cauchy transform of the pressure.
    pub(crate) fn cauchy_transform(&self) -> Fallible<T, CauchyTransform<T>> {
        let Self { gap, integrator, load_case, on, .. } = self;
        Ok(CauchyTransform::of(&*integrator.panels_over(gap, *on)?, load_case))
    }

    /// Fills in the pressure unchecked, infinite where a slope jumps.
    pub(crate) fn unchecked(&self, x: &[T], pressures: &mut [T]) -> Fallible<T, ()> {
        self.integrator.pressures(self.gap, &self.load_case, x, pressures, &mut Cost::default())
    }

    /// Returns the cost of preparing the pressure.
    pub fn cost(&self) -> Cost {
        self.cost
    }
}

impl<T: Real> Density<T> for Pressure<'_, T> {
    fn values(&self, x: &[T], pressures: &mut [T]) -> Fallible<T, ()> {
        T::density(self, x, pressures)
    }

    fn potential(&self) -> Fallible<T, Option<Potential<T>>> {
        let Self { gap, integrator, load_case, on, .. } = self;
        let LoadCase { kappa, load, .. } = *load_case;
        let panels = integrator.panels_over(gap, *on)?;
        // With the strength that the rounding of a free limit leaves there, this rounding changes
        // integrals of the pressure to second order only.
        let [left_over, held] = panels.strengths(load_case);
        let strengths = left_over.zip(held).map(|(free, held)| free + held);
        let of =
            |(series, is_whole)| Potential { on: *on, series, is_whole, strengths, kappa, load };
        Ok(panels.cosines().map(of))
    }
}

impl<T: Real> std::fmt::Debug for Pressure<'_, T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut debug = f.debug_struct("Pressure");
        debug.field("on", &self.on).field("load_case", &self.load_case);
        debug.field("cost", &self.cost).finish_non_exhaustive()
    }
}
