//! A contact in angles measured from a point.

use super::{Kept, NODES};
use crate::{Ends, Interval, Real};

/// Contact in angles from the point nearest to x, positive away from the edge nearest to x.
pub(super) struct GradedRule<T> {
    pub on: Interval<T>,
    /// True if the edge nearest to x is the right one.
    right: bool,
    /// Angle between the nearest edge and the nearest point, up to π/2.
    theta: T,
    /// Distance of x from the contact, zero inside.
    beyond: T,
    /// Distance of x from the nearest edge, negative outside the contact.
    inward: T,
    x: T,
}

impl<T: Real> GradedRule<T> {
    pub fn new(on: Interval<T>, x: T) -> Self {
        let right = x > on.centre();
        let inward = if right { on.right - x } else { x - on.left };
        let beyond = (-inward).max(T::zero());
        let mut graded_rule = Self { on, right, theta: T::zero(), beyond, inward, x };
        if inward > T::zero() {
            graded_rule.theta = graded_rule.angle(x);
        }
        graded_rule
    }

    /// Returns the angle between the nearest edge and a point of the contact.
    fn angle(&self, x: T) -> T {
        let angle = self.on.angle(x);
        if self.right {
            angle
        } else {
            let Interval { left, right } = self.on;
            T::of(2.0) * (x - left).sqrt().atan2((right - x).sqrt())
        }
    }

    /// Lists the edges and the breakpoints, the nearest edge first. A breakpoint within rounding of
    /// the nearest point is moved there.
    pub fn ends(&self, breakpoints: &[T]) -> Vec<T> {
        let turn = |&breakpoint: &T| {
            let turn = self.angle(breakpoint) - self.theta;
            if turn.abs() > T::of(16.0) * T::epsilon() { turn } else { T::zero() }
        };
        let mut ends = Vec::with_capacity(breakpoints.len() + 2);
        ends.push(-self.theta);
        if self.right {
            ends.extend(breakpoints.iter().rev().map(turn));
        } else {
            ends.extend(breakpoints.iter().map(turn));
        }
        ends.push(T::pi() - self.theta);
        ends
    }

    /// Lists the panels between edges and breakpoints, with their numbers from the right. The panel
    /// with the nearest point inside is divided there; its two parts have no number.
    pub fn panels(&self, breakpoints: &[T]) -> Vec<([T; 2], Option<usize>)> {
        let (zero, last) = (T::zero(), breakpoints.len());
        let mut panels = Vec::with_capacity(last + 2);
        for (i, ends) in self.ends(breakpoints).windows(2).enumerate() {
            let [from, to] = [ends[0], ends[1]];
            if from < zero && to > zero {
                panels.extend([([from, zero], None), ([zero, to], None)]);
            } else if from < to {
                panels.push(([from, to], Some(if self.right { i } else { last - i })));
            }
        }
        panels
    }

    /// Returns the kept values of a panel (0), or of its nearer (1) or farther half (2), in the
    /// order of angles here.
    pub fn seen(&self, kept: &Kept<T>, part: usize) -> [T; NODES] {
        if self.right {
            return kept[part];
        }
        let mut seen = kept[[0, 2, 1][part]];
        seen.reverse();
        seen
    }

    /// Returns `x - s` for a point s of the contact.
    pub fn distance(&self, turn: T) -> T {
        let half_turn = T::of(0.5) * turn;
        let width = self.on.right - self.on.left;
        let distance = self.beyond + width * (self.theta + half_turn).sin() * half_turn.sin();
        if self.right { distance } else { -distance }
    }

    /// Returns a point s strictly inside the contact, and the factor by which rounding changed the
    /// distance of s from the nearer edge, if free: `P w` is proportional to it there.
    pub fn place(&self, turn: T, free: Ends<bool>) -> (T, T) {
        let half = T::of(0.5);
        let Interval { left, right } = self.on;
        let width = right - left;
        let half_angle = half * (self.theta + turn);
        let rounding = T::epsilon() * left.abs().max(right.abs());
        let near = half_angle < T::frac_pi_4();
        let inward = width * if near { half_angle.sin() } else { half_angle.cos() }.powi(2);
        let at_right = near == self.right;
        let distance = self.distance(turn);
        // Computed from x or from the edge, whichever is nearer.
        let s = if distance.abs() < half * self.inward {
            self.x - distance
        } else if at_right {
            right - inward
        } else {
            left + inward
        };
        let s = s.max(left + rounding).min(right - rounding);
        let share = match at_right {
            true if free.right => inward / (right - s),
            false if free.left => inward / (s - left),
            _ => T::one(),
        };
        (s, share)
    }
}
