//! What comes back.

use crate::contact::Found;
use crate::gap::{Cost, Gap};
use crate::quadrature::{Engine, Estimate, Quadrature, Transform};
use crate::{ContactError, Interval, Real};

/// A solved contact: its limits, and on request its pressure.
///
/// It is the solution for one contact interval. Where the slope of the gap rises throughout it is
/// the physical one; otherwise the pressure may turn out negative inside, or the bodies may
/// overlap outside, and neither is looked for.
pub struct Solution<'s, T: Real> {
    gap: &'s Gap<'s, T>,
    engine: Box<dyn Engine<T> + 's>,
    quadrature: &'s dyn Quadrature<T>,
    kappa: T,
    load: T,
    found: Found<T>,
    cost: Cost,
}

impl<'s, T: Real> Solution<'s, T> {
    pub(crate) fn new(
        gap: &'s Gap<'s, T>,
        engine: Box<dyn Engine<T> + 's>,
        quadrature: &'s dyn Quadrature<T>,
        kappa: T,
        load: T,
        found: Found<T>,
        cost: Cost,
    ) -> Self {
        Self { gap, engine, quadrature, kappa, load, found, cost }
    }

    /// The limit `a`.
    pub fn a(&self) -> T {
        self.found.interval.right
    }

    /// The limit `b`; the contact runs from `-b`, so `b` is negative where the whole contact
    /// lies at positive `x`.
    pub fn b(&self) -> T {
        -self.found.interval.left
    }

    /// The contact `[-b, a]`.
    pub fn interval(&self) -> Interval<T> {
        self.found.interval
    }

    /// Load per unit length F.
    pub fn load(&self) -> T {
        self.load
    }

    /// Estimated error of the edges, relative to the half-width, where the limits are
    /// [`Free`](crate::Limits::Free): what rounding, the noise of the profiles' formulas and
    /// the quadrature leave open of the conditions at the edges. `None` for limits that were
    /// given, and for those of Eq. (6), which are in error by the rule they were found with.
    ///
    /// It is a few units in the last place where the slope of the gap is analytic between the
    /// joints. Much more says that a profile is noisy or has a kink not declared as a joint.
    pub fn limits_error(&self) -> Option<T> {
        self.found.error
    }

    /// `K_a` and `K_b`, the strengths of the singularities at the two edges: near `a`,
    /// `P ≈ K_a/sin θ` with `x = c + L cos θ`. Zero to rounding for free edges; at a fixed edge
    /// a negative strength means that the body lifts off there.
    ///
    /// Known already where the limits were found by them; sampled now otherwise.
    ///
    /// # Errors
    /// Those of sampling the gap.
    pub fn edge_strengths(&self) -> Result<[T; 2], ContactError<T>> {
        if let Some(strengths) = self.found.strengths {
            return Ok(strengths);
        }
        let on = self.found.interval;
        let m = self.quadrature.prepare(self.gap)?.moments(on)?;
        let mean_pressure = self.load / on.half_width();
        let strength = |sum: T| (mean_pressure - self.kappa * sum) / T::pi();
        Ok([strength(m.first + m.mean), strength(m.first - m.mean)])
    }

    /// What finding the limits has cost.
    pub fn cost(&self) -> Cost {
        self.cost
    }

    /// Samples the gap over the contact, so that the pressure can be asked for at any point.
    ///
    /// # Errors
    /// Those of sampling the gap.
    pub fn pressure(&self) -> Result<Pressure<'_, T>, ContactError<T>> {
        let mut cost = Cost::default();
        let transform = self.engine.transform(self.found.interval, &mut cost)?;
        let free = self.found.strengths.is_some();
        let Self { kappa, load, .. } = *self;
        let range = self.gap.range();
        Ok(Pressure { transform, on: self.found.interval, kappa, load, free, range, cost })
    }
}

/// The pressure over a contact.
pub struct Pressure<'p, T: Real> {
    transform: Box<dyn Transform<T> + 'p>,
    on: Interval<T>,
    kappa: T,
    load: T,
    free: bool,
    range: [T; 2],
    cost: Cost,
}

impl<T: Real> Pressure<'_, T> {
    /// `P(x)`. Zero outside the contact and at a free edge.
    ///
    /// # Errors
    /// [`ContactError::Unresolved`] where, between free edges, the estimated error is more than
    /// a third of what the rule gives, as it becomes in the last segment before an edge;
    /// [`ContactError::OutsideBodies`] beyond either body, and for NaN;
    /// [`ContactError::SingularEdge`]; those of sampling the gap at `x`.
    pub fn at(&self, x: T) -> Result<T, ContactError<T>> {
        let Estimate { value: pressure, error } = self.estimate(x, &mut Cost::default())?;
        // Elsewhere a pressure may pass through zero, and an absolute error is all there is.
        if self.free && T::of(3.0) * error > pressure.abs() && self.on.contains(x) {
            Err(ContactError::Unresolved { x, pressure, error })
        } else {
            Ok(pressure)
        }
    }

    /// `P(x)`, however doubtful, with its estimated error, adding to `cost` what this point
    /// takes: nothing on the grid of the rule, one sample of the gap elsewhere, seven next to
    /// one of its points.
    ///
    /// The error is that of the quadrature, on the limits as they are.
    ///
    /// # Errors
    /// As [`at`](Self::at), without [`ContactError::Unresolved`].
    pub fn estimate(&self, x: T, cost: &mut Cost) -> Result<Estimate<T>, ContactError<T>> {
        if !(x >= self.range[0] && x <= self.range[1]) {
            return Err(ContactError::OutsideBodies { x, range: self.range });
        }
        if !self.on.contains(x) {
            let at_edge = x == self.on.left || x == self.on.right;
            return if at_edge && !self.free {
                Err(ContactError::SingularEdge { x })
            } else {
                Ok(Estimate { value: T::zero(), error: T::zero() })
            };
        }
        let Estimate { value, error } = self.transform.at(x, cost)?;
        let edge = T::pi() * T::pi() * self.on.edge_root(x);
        Ok(Estimate {
            value: (T::pi() * self.load - self.kappa * value) / edge,
            error: self.kappa * error / edge,
        })
    }

    /// What sampling the gap has cost.
    pub fn cost(&self) -> Cost {
        self.cost
    }
}

impl<T: Real> std::fmt::Debug for Solution<'_, T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { found: Found { interval, .. }, load, kappa, cost, .. } = self;
        let mut debug = f.debug_struct("Solution");
        debug.field("interval", interval).field("load", load).field("kappa", kappa);
        debug.field("cost", cost).finish_non_exhaustive()
    }
}

impl<T: Real> std::fmt::Debug for Pressure<'_, T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { on, load, kappa, cost, .. } = self;
        let mut debug = f.debug_struct("Pressure");
        debug.field("on", on).field("load", load).field("kappa", kappa);
        debug.field("cost", cost).finish_non_exhaustive()
    }
}
