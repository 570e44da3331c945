//! Limits held at corners.
//!
//! A corner is an end of the bodies that is declared one, or a breakpoint inside them where the
//! slope of the gap jumps up, by j. With a limit held at a corner z the pressure there is
//! `P ≈ K'/√(distance)`, with `K' = K √(L/2)`. One rule holds for all:
//!
//! | limit | next |
//! |---|---|
//! | free, next to a corner | held there |
//! | held, K < 0 | let go inward |
//! | held, K > 0, inside the bodies | put beyond the corner by `d = (π² K'/(2 κ j))²` |
//! | held, K > 0, d as small as panels resolve | held: d is the error of the limit |
//!
//! The last two are one contact: it ends where the jump makes up for the pressure of the held one,
//! to first order in d/L. At an end of the bodies j is infinite.

use super::super::newton::Stop;
use super::super::newton::several::put;
use super::{Conditions, Given, Search};
use crate::quadrature::panels;
use crate::solution::ContactState;
use crate::{ContactError, Ends, Interval, Real, Side};

/// Largest distance of a limit from a corner that may hold it, as a share of the contact: that of
/// limits by cells.
const NEAR: f64 = 0.1;

/// Largest d, as a share of the half-width, by the pressure of a flat, for which a corner is tried:
/// beyond, the limit finds its place by itself.
const SHARP: f64 = 0.1;

/// Share of a contact's half-width by which a limit leaves a corner inward.
const STEP_INWARD: f64 = 0.01;

impl<T: Real> Search<'_, '_, '_, T> {
    /// Moves the contacts at hand until they bear the load, held at corners or let go; repeats as
    /// long as their panels miss narrow features.
    pub(super) fn converge(
        &mut self,
        conditions: &Conditions<T>,
    ) -> Result<Result<ContactState<T>, Stop<T>>, ContactError<T>> {
        self.hold(conditions);
        loop {
            let mut found = match self.converge_once(conditions)? {
                Ok(found) => found,
                stopped => return Ok(stopped),
            };
            if !self.misses(&found)? && !self.let_go(&mut found) {
                return Ok(Ok(found));
            }
        }
    }

    /// Holds the limits at hand that are at an end of the bodies, or next to a corner inside them.
    fn hold(&mut self, conditions: &Conditions<T>) {
        let (ends, at_corner) = (self.contact.ends(), self.corners());
        self.held.clear();
        let on = &mut self.work.workspace.newton.on;
        let hull = Interval { left: on[0].left, right: on[on.len() - 1].right };
        let reaches = Ends { left: hull.left <= ends.left, right: hull.right >= ends.right };
        for side in Side::BOTH {
            if at_corner[side] && reaches[side] {
                put(on, side, ends[side]);
                self.held.push((ends[side], side));
            }
        }
        if matches!(conditions.given, Given::HalfWidth(_)) {
            return;
        }
        let (gap, load) = (&self.contact.gap, conditions.load() / conditions.kappa);
        let all = on.iter().fold(T::zero(), |sum, on| sum + on.half_width());
        for on in on {
            for side in Side::BOTH {
                let (x, half_width) = (on[side], on.half_width());
                let near = T::of(2.0 * NEAR) * half_width;
                let around = Interval { left: x - near, right: x + near };
                // `F/(κ L)` of a contact with its share of the load.
                let mean = load / all;
                let is_sharp = |&z: &T| {
                    let [jump, size] = gap.jump(z);
                    let by_jump = T::frac_pi_2() * mean / jump;
                    jump > T::epsilon().sqrt() * size
                        && T::of(0.5) * by_jump * by_jump < T::of(SHARP)
                };
                let nearer = |one: T, other: T| {
                    if (other - x).abs() < (one - x).abs() { other } else { one }
                };
                let room = Interval { left: on.left, right: on.right };
                let fits = |&z: &T| match side {
                    Side::Left => z < room.right,
                    Side::Right => z > room.left,
                };
                let corners = gap.breakpoints(around).filter(fits).filter(is_sharp);
                if let Some(z) = corners.reduce(nearer) {
                    match side {
                        Side::Left => on.left = z,
                        Side::Right => on.right = z,
                    }
                    self.held.push((z, side));
                }
            }
        }
    }

    /// Returns the limits of each contact at hand that are held.
    pub(super) fn held_limits(&self) -> Vec<Ends<bool>> {
        let on = self.work.workspace.newton.on.iter();
        on.map(|on| Ends::from_fn(|side| self.held.contains(&(on[side], side)))).collect()
    }

    /// Lets go of the corners that do not hold the contacts found, and tells whether there are any.
    /// Otherwise adds the error of the limits that stay held.
    fn let_go(&mut self, found: &mut ContactState<T>) -> bool {
        let (kappa, ends) = (self.contact.kappa, self.contact.ends());
        let integrator = &*self.work.integrator;
        let several = panels::several(integrator);
        let (mut changed, mut error) = (false, T::zero());
        let held = self.held_limits();
        for (i, on) in self.work.workspace.newton.on.iter_mut().enumerate() {
            let half_width = on.half_width();
            for side in Side::BOTH.into_iter().filter(|&side| held[i][side]) {
                let (z, outward) = (on[side], if side == Side::Left { -T::one() } else { T::one() });
                let strength = match several {
                    Some(several) => kappa * several.strength(i, side),
                    None => found.strengths[side],
                };
                let away = if strength < T::zero() {
                    -T::of(STEP_INWARD)
                } else if z == ends[side] {
                    continue;
                } else {
                    let by_jump = T::pi() * T::pi() * strength / (kappa * self.contact.gap.jump(z)[0]);
                    T::of(0.125) * by_jump * by_jump
                };
                if away >= T::zero() && away < T::epsilon().powf(T::of(2.0 / 3.0)) {
                    error = error.max(away);
                    continue;
                }
                let x = z + outward * away * half_width;
                match side {
                    Side::Left => on.left = x,
                    Side::Right => on.right = x,
                }
                self.held.retain(|&held| held != (z, side));
                changed = true;
            }
        }
        found.error = found.error.map(|known| known.max(error));
        changed
    }
}
