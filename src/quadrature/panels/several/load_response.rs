//! Response of several contacts to a change of the load.
//!
//! The conditions on the limits hold under every load, therefore `J de = e_F dF/κ`, with the
//! Jacobian J and a vector e_F that is 1 in the row of the load and 0 elsewhere. A limit e acts on
//! `P = κ S/p V/π²` through S and V, with p left as it is, in total by
//!
//! ```text
//! ∂P/∂e = -κ S/(2 π² p) V(e)/(x - e)
//! ```
//!
//! The sum of these over the free limits, each times de/dF, is ∂P/∂F: the pressure of a flat punch
//! on all contacts under a unit load, whatever the bodies. With more corners than contacts the
//! [terms](super::terms) of V follow the load, too.

use super::weight::Weight;
use super::{Several, System};
use crate::{Ends, Interval, Real, Side};

/// Pressure of a flat punch on several contacts under a unit load.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LoadResponse<T> {
    weight: Weight<T>,
    /// Free limits e and poles of p, and the numerators over `x - e`.
    terms: Vec<[T; 2]>,
    /// Constant term.
    constant: T,
}

impl<T: Real> Several<T> {
    /// Returns the derivatives of all limits by F/κ, left and right of each contact, and the
    /// derivative of the pressure by F; `None` where the limits do not follow the load.
    pub fn rates(&self, load: T) -> Option<(Vec<Ends<T>>, LoadResponse<T>)> {
        let mut system = System::new();
        self.system(load, &mut system);
        if !system.factor() {
            return None;
        }
        let (mut unit, mut step) = (vec![T::zero(); system.residual.len()], Vec::new());
        unit[system.load_row] = T::one();
        system.solve(&unit, &mut step);
        let mut rates = vec![Ends::both(T::zero()); self.parts.len()];
        let mut terms = Vec::with_capacity(step.len());
        let per_pi = -T::frac_1_pi();
        let of_poles = &step[system.free.len()..];
        let by_poles = system.poles.of_p.iter().zip(of_poles);
        let inverse = self.weight.is_inverse();
        let constant = if inverse { per_pi } else { T::zero() };
        terms.extend(by_poles.map(|(&[x, _], &rate)| [x, per_pi * rate]));
        for (&i, &rate) in system.free.iter().zip(&step) {
            if !rate.is_finite() {
                return None;
            }
            rates[i / 2][Side::BOTH[i % 2]] = rate;
            let share = T::of(0.5) * system.at_ends[i] * rate * per_pi * T::frac_1_pi();
            terms.push([system.limits[i], share]);
        }
        Some((rates, LoadResponse { weight: self.weight.clone(), terms, constant }))
    }
}

impl<T: Real> LoadResponse<T> {
    pub fn contacts(&self) -> &[Interval<T>] {
        self.weight.contacts()
    }

    /// Returns the strength of the singularity at a limit, as a share of that of a unit load on
    /// this contact alone; zero at a limit that is held.
    pub fn strength(&self, contact: usize, side: Side) -> T {
        let on = self.contacts()[contact];
        let (limit, towards) = match side {
            Side::Left => (on.left, T::one()),
            Side::Right => (on.right, -T::one()),
        };
        let term = self.terms.iter().find(|&&[e, _]| e == limit);
        let share = term.map_or(T::zero(), |&[_, share]| share);
        let width = T::of(2.0) * on.half_width();
        towards * T::pi() * width * share / self.weight.on_contact(contact, [limit])[0]
    }

    /// Returns the pressure at a place strictly inside a contact, given its number.
    pub fn pressure(&self, contact: usize, x: T) -> T {
        let sum = self.terms.iter().fold(self.constant, |sum, &[e, share]| sum + share / (x - e));
        let root = self.contacts()[contact].chebyshev_weight(x);
        root / self.weight.on_contact(contact, [x])[0] * sum
    }
}
