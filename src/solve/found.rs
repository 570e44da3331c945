//! A contact found, from its limits and moments.

use super::edges::Conditions;
use crate::quadrature::Moments;
use crate::solution::ContactState;
use crate::{ContactError, Edge, Ends, Interval, Real, Side, SolveError};

impl<T: Real> ContactState<T> {
    pub(crate) fn new(
        conditions: &Conditions<T>,
        interval: Interval<T>,
        load: T,
        error: Option<T>,
        m: &Moments<T>,
    ) -> Self {
        let kappa = conditions.kappa;
        let mean_pressure = load / interval.half_width();
        let tilt = conditions.tilt(interval, m);
        let mean = m.m0 + tilt;
        let strength = |sum: T| (mean_pressure - kappa * sum) / T::pi();
        let strengths = Ends { left: strength(m.m1 - mean), right: strength(m.m1 + mean) };
        let free = conditions.edges.map(|edge| edge.is_free());
        let adhesive = conditions.edges.map(|edge| matches!(edge, Edge::Adhesive(_)));
        let ends = Ends { left: interval.left, right: interval.right };
        Self {
            interval,
            load,
            strengths,
            free,
            adhesive,
            error,
            error_by_load: None,
            load_error: None,
            moment_derivatives: m.derivatives,
            tilt,
            ends,
            apart: None,
        }
    }

    /// Tells on which sides the contact ends, to rounding, at the corner declared to hold it; true
    /// without a corner.
    pub(crate) fn reaches(&self, edges: Ends<Edge<T>>) -> Ends<bool> {
        let rounding = T::epsilon().sqrt() * self.interval.half_width();
        let ends = Ends { left: self.interval.left, right: self.interval.right };
        let is_near = |(edge, end): (Edge<T>, T)| {
            edge.limit().is_none_or(|corner| (end - corner).abs() <= rounding)
        };
        edges.zip(ends).map(is_near)
    }

    /// Returns the error for a corner declared to hold the contact that is in tension or not
    /// reached, or for another one at an end that pulls where it holds the contact.
    pub(crate) fn lifts_off(&self, edges: Ends<Edge<T>>) -> Option<ContactError<T>> {
        let (interval, load, reaches) = (self.interval, self.load, self.reaches(edges));
        let mean = T::of(0.5) * load.abs() / interval.half_width();
        let rounding = T::epsilon().sqrt() * mean;
        Side::BOTH.into_iter().find_map(|side| {
            let strength = self.strengths[side];
            let (x, is_loose) = match (edges[side], strength < -rounding) {
                (Edge::Fixed(x), pulls) => (x, pulls || !reaches[side]),
                (Edge::FreeUntil(x), pulls) => (x, pulls && !self.free[side]),
                _ => return None,
            };
            is_loose.then(|| SolveError::LiftsOff { x, strength, interval, load }.into())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A corner that pulls where it holds a contact is a fault, whether it is declared to hold it
    /// or not; a free limit within it is none.
    #[test]
    fn a_corner_that_pulls_is_no_contact() {
        let on = Interval { left: -1.0, right: 1.0 };
        let found = |free: Ends<bool>, left: f64| ContactState {
            interval: on,
            load: 1.0,
            strengths: Ends { left, right: 0.0 },
            free,
            adhesive: Ends::both(false),
            error: None,
            error_by_load: None,
            load_error: None,
            moment_derivatives: None,
            tilt: 0.0,
            ends: Ends { left: -1.0, right: 1.0 },
            apart: None,
        };
        let held = Ends { left: false, right: true };
        for corner in [Edge::Fixed(-1.0), Edge::FreeUntil(-1.0)] {
            let edges = Ends { left: corner, right: Edge::Free };
            assert!(found(held, 0.1).lifts_off(edges).is_none());
            assert!(found(held, -0.1).lifts_off(edges).is_some());
        }
        let within = Ends { left: Edge::FreeUntil(-1.0), right: Edge::Free };
        assert!(found(Ends::both(true), -1e-3).lifts_off(within).is_none());
    }
}
