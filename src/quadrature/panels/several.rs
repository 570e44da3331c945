//! Several contacts at once: the equations for their limits, and the pressure.
//!
//! With the weight w and the polynomial p of [`weight`], κ = 1 and g the slope of the gap,
//! everything follows from one function,
//!
//! ```text
//! V(x) = Σ_j PV∫ w p g/(s - x) ds over contact j
//! P(x) = S(x)/p(x) V(x)/π²                       on the contacts
//! Φ(x) = ∫ P/(x - s) ds = -S(x)/p(x) V(x)/π      off them
//! ```
//!
//! (Muskhelishvili, *Singular Integral Equations*, 1953, §§ 88 and 89, with p in place of 1: if the
//! limits balance, `V` is p times the same integral without p.) The limits are right when
//!
//! ```text
//! V(ν_k) = 0 at each zero of p, without corners ∫ w p g ds = 0     balance
//! (1/π) ∫ w p q g ds = F, q = x - c without corners, 1 with one    load
//! ∫ Φ dx over a gap = h at its right end - h at its left end       each gap closes at both ends
//! ```
//!
//! with h the height of the gap between the bodies. There are as many conditions as free limits,
//! two per contact without corners. At the poles of p V has further [terms](terms), which close the
//! gaps between corners; with more corners than contacts a constant bears the load. A limit e acts
//! on each through `V(e)`, taken without its infinite part (Hadamard's finite part), up to terms
//! that vanish with the other conditions:
//!
//! ```text
//! of V(ν):      V(e)/(2 (e - ν))
//! of ∫ w p g:   V(e)/2
//! of the load:  (e - c) V(e)/(2π)
//! of a gap:     V(e)/(2π (e - ν)) ∫ S/p_k dx/(x - e)        p_k = p/(x - ν_k)
//! ```
//!
//! These are the conditions on a pressure `-κ S/(2 π² p) V(e)/(x - e)`, singular at e. So a step δ
//! of Newton's method (`system.rs`) gives the pressure that meets all conditions on the contacts at
//! hand, with a singularity of the strength `V(e) δ` at each limit. A limit has to move outward
//! where that is positive, and does if `V(e)` has the sign of a positive pressure next to it. At
//! trial contacts with tension there, the sign of `V(e)` is reversed, so that it still does.
//!
//! As a gap of width w closes, `V(ν)` becomes π²/S times the pressure in its place. The condition
//! of the gap vanishes with w² whatever the pressure does, so that a gap of no width would meet it
//! anywhere; divided by w² it says where that pressure is least. Newton's method is given the
//! condition divided by `w²/(w² + c²)`, with c half the width of the narrower contact next to the
//! gap.
//!
//! With one contact these are the equations of [`quadrature`](crate::quadrature).

mod conditions;
mod exterior;
mod load_response;
mod one_of_several;
mod pressure;
mod system;
mod terms;
mod weight;

use super::cauchy_transform::CauchyTransform;
use super::panel_set::PanelSet;
use crate::gap::{Cost, Gap};
use crate::numerics::{Combine, FarField};
use crate::{ContactError, Ends, Interval, Real, Side};
pub(crate) use load_response::LoadResponse;
use one_of_several::OneOfSeveral;
pub(crate) use system::System;
pub(super) use terms::Terms;
pub(super) use weight::Middle;
use weight::Weight;

/// Least half of a gap, in half-widths of the contact next to it, for a trial.
const LEAST_TRIAL_ROOM: f64 = 0.005;

/// Several contacts on their panels.
#[derive(Clone)]
pub(crate) struct Several<T> {
    parts: Vec<OneOfSeveral<T>>,
    weight: Weight<T>,
    /// Parts of V by the contacts far from each.
    far: FarField<T>,
    tolerance: T,
    /// Terms of V besides the integrals.
    terms: Terms<T>,
    /// Cost of sampling; `spent` is the earlier cost of a single contact.
    pub cost: Cost,
    pub spent: Cost,
}

impl<T: Real> Several<T> {
    pub fn new(tolerance: T) -> Self {
        let (parts, weight) = (Vec::new(), Weight::new());
        let ([cost, spent], terms) = ([Cost::default(); 2], Terms::none());
        let far = FarField::new(Combine::Sum);
        Self { parts, weight, far, tolerance, terms, cost, spent }
    }

    /// Counts costs from zero, and forgets the samples unless the bodies are the same.
    pub fn reset(&mut self, same_bodies: bool) {
        self.cost = Cost::default();
        if !same_bodies {
            self.parts.iter_mut().for_each(|part| part.clear(false));
        }
    }

    pub fn contacts(&self) -> &[Interval<T>] {
        self.weight.contacts()
    }

    /// Sets the contacts, between the ends of the bodies, and the limits of each that are held at
    /// corners: ready for the conditions on the limits, not yet for pressures. Keeps the samples of
    /// earlier contacts. For a trial a few digits suffice.
    pub fn set(
        &mut self,
        gap: &Gap<'_, T>,
        on: &[Interval<T>],
        held: &[Ends<bool>],
        ends: Ends<T>,
        is_trial: bool,
    ) -> Result<(), ContactError<T>> {
        self.weight.set(on, held, is_trial);
        if on.len() != self.parts.len() {
            let mut known = std::mem::take(&mut self.parts);
            self.parts.extend(on.iter().map(|on| {
                let is_of = |part: &OneOfSeveral<T>| on.contains(part.on.centre());
                let found = known.iter().position(is_of).map(|i| known.swap_remove(i));
                found.unwrap_or_else(|| OneOfSeveral::new(self.tolerance))
            }));
        }
        let half = T::of(0.5);
        for (i, part) in self.parts.iter_mut().enumerate() {
            // No contact is sampled beyond a corner that holds it, or the middle of a gap.
            let from = match i {
                _ if held[i].left => on[i].left,
                0 => ends.left,
                _ => half * on[i - 1].right + half * on[i].left,
            };
            let to = match on.get(i + 1) {
                _ if held[i].right => on[i].right,
                Some(next) => half * on[i].right + half * next.left,
                None => ends.right,
            };
            part.panel_set.spent = self.spent + self.cost;
            let sampled = part.sample(gap, on[i], [from, to]);
            self.cost += std::mem::take(&mut part.panel_set.cost);
            sampled?;
            // A gap narrower than a trial's outermost node is far from the limit would not count.
            let room = (on[i].left - from).min(to - on[i].right);
            let is_trial = is_trial && room > T::of(LEAST_TRIAL_ROOM) * on[i].half_width();
            part.set(|x| self.weight.on_contact(i, x), is_trial);
        }
        Ok(())
    }

    /// Samples between the nodes of all contacts; tells whether panels have missed a feature.
    pub fn probe(&mut self, gap: &Gap<'_, T>) -> Result<bool, ContactError<T>> {
        let mut is_missed = false;
        for part in &mut self.parts {
            part.panel_set.spent = self.spent + self.cost;
            let probed = part.panel_set.probe(gap, part.on);
            self.cost += std::mem::take(&mut part.panel_set.cost);
            is_missed |= probed?;
        }
        Ok(is_missed)
    }

    /// Prepares for pressures.
    pub fn press(&mut self) {
        let Self { parts, weight, far, .. } = self;
        parts.iter_mut().for_each(OneOfSeveral::press);
        let on = weight.contacts();
        far.set(on, on.iter().copied(), false, &|k, x| parts[k].seen_from(x));
    }

    /// Returns the part of V by some contacts, at a place off them; near contact `near`, given the
    /// distance from it.
    fn outside(&self, contacts: impl Iterator<Item = usize>, x: T, near: Option<(usize, T)>) -> T {
        contacts.fold(T::zero(), |sum, i| {
            sum + match near {
                Some((j, distance)) if i == j => self.parts[i].outside(x, distance),
                _ => self.parts[i].seen_from(x),
            }
        })
    }

    /// Returns the Cauchy transform of the pressure for κ and F.
    pub fn cauchy_transform(&self, kappa: T, load: T) -> CauchyTransform<T> {
        let contacts = self.parts.iter().map(OneOfSeveral::in_plane).collect();
        let (strengths, far_away) = (Ends::both(T::zero()), T::zero());
        let corners = self.weight.held_limits().collect();
        let middles = self.weight.middles().to_vec();
        let terms = self.terms.clone();
        CauchyTransform { contacts, middles, corners, terms, strengths, far_away, kappa, load }
    }

    /// Returns the number of poles of p.
    pub fn poles(&self) -> usize {
        self.weight.poles().count()
    }

    /// Returns the limits of each contact that are held at corners.
    pub fn held(&self) -> &[Ends<bool>] {
        self.weight.held()
    }

    /// Returns V at a limit, without its infinite part, with the parts by each of the contacts.
    fn at_end_by_each(&self, contact: usize, side: Side) -> T {
        let (part, others) =
            (&self.parts[contact], (0..self.parts.len()).filter(|&i| i != contact));
        let x = part.on[side];
        part.at_end(side) + self.outside(others, x, None) + self.terms.at(x)
    }

    /// Returns the slope of the gap around a contact.
    pub fn panel_set(&self, contact: usize) -> &PanelSet<T> {
        &self.parts[contact].panel_set
    }

    /// Returns the height of the gap between the unloaded bodies at a limit of a contact.
    pub fn height(&self, contact: usize, side: Side) -> T {
        let part = &self.parts[contact];
        part.height(part.on[side])
    }
}
