//! Edges by the paper's conditions, Eq. (6).

use crate::{Fallible, InputError, Interval, Real, SolveError};

/// Conditions of the paper at the edges, Eq. (6): `|P(a - ε_a) - A| ≤ ε₁` and
/// `|P(ε_b - b) - B| ≤ ε₂`.
///
/// A is the pressure *at* a distance from the edge, where a smooth contact has
/// `P ≈ p₀ sqrt(2 ε_a/L)`. With A = 0 the limits come out too wide, by about 2 ε_a: the pressure
/// then ends in a small negative singularity. The paper's quadrature also needs some segments
/// between the two: a distance below a segment's width 2L/N gains nothing.
/// [`Edge::Free`](crate::Edge::Free) has neither flaw, and costs a twentieth or less.
///
/// ```
/// use linecontact::profile::Parabola;
/// use linecontact::{Contact, Control, EdgePressure, Flat};
///
/// let body = Parabola::new(1.0f64, [-1.0, 1.0])?;
/// let contact = Contact::new(&Flat, &body)?.edge_pressure(EdgePressure::zero(1e-3, 1e-9));
/// let solution = contact.solve(Control::Load(0.02))?;
/// // 2 ε_a + sqrt(L² + 2 ε_a²) with L = 0.2, the half-width between free edges
/// let exact = 2e-3 + (0.04f64 + 2e-6).sqrt();
/// assert!((solution.a() / exact - 1.0).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct EdgePressure<T> {
    /// Pressure A wanted at `a - ε_a`.
    pub at_a: T,
    /// Pressure B wanted at `ε_b - b`.
    pub at_b: T,
    /// Distance ε_a from `a`: a length, positive.
    pub distance_a: T,
    /// Distance ε_b from `-b`: a length, positive.
    pub distance_b: T,
    /// Tolerance ε₁ of A: a pressure, positive.
    pub tolerance_a: T,
    /// Tolerance ε₂ of B: a pressure, positive.
    pub tolerance_b: T,
}

impl<T: Real> EdgePressure<T> {
    /// Returns A = B = 0, with the same distance and the same tolerance on both sides.
    pub fn zero(distance: T, tolerance: T) -> Self {
        Self {
            at_a: T::zero(),
            at_b: T::zero(),
            distance_a: distance,
            distance_b: distance,
            tolerance_a: tolerance,
            tolerance_b: tolerance,
        }
    }

    /// Returns the places `ε_b - b` and `a - ε_a`.
    pub(crate) fn places(&self, on: Interval<T>) -> [T; 2] {
        [on.left + self.distance_b, on.right - self.distance_a]
    }

    /// Checks the pressures at the edges, given as their differences from A and B times
    /// `π sqrt((x + b)(a - x))`.
    pub(crate) fn met(&self, on: Interval<T>, [at_a, at_b]: [T; 2]) -> Fallible<T, ()> {
        let [x_b, x_a] = self.places(on);
        let at_a = at_a / (T::pi() * on.chebyshev_weight(x_a));
        let at_b = at_b / (T::pi() * on.chebyshev_weight(x_b));
        if at_a.abs() <= self.tolerance_a && at_b.abs() <= self.tolerance_b {
            Ok(())
        } else {
            Err(SolveError::EdgePressureNotMet { best: on, at_a, at_b }.into())
        }
    }

    /// Checks the numbers, given the width of the bodies.
    pub(crate) fn check(&self, width: T) -> Fallible<T, ()> {
        let infinity = T::one() / T::zero();
        for (name, value, above, below) in [
            ("A", self.at_a, -infinity, infinity),
            ("B", self.at_b, -infinity, infinity),
            ("ε_a", self.distance_a, T::zero(), width),
            ("ε_b", self.distance_b, T::zero(), width),
            ("ε₁", self.tolerance_a, T::zero(), infinity),
            ("ε₂", self.tolerance_b, T::zero(), infinity),
        ] {
            if !(value > above && value < below) {
                return Err(InputError::InvalidEdgePressure { name, value }.into());
            }
        }
        Ok(())
    }
}
