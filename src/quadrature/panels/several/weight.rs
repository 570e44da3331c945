//! The weight of several contacts.
//!
//! With `R(x) = Π (x - α_j)(x - β_j)` over the contacts `[α_j, β_j]`, z their corners (outermost
//! limits only) and ν_k the middles of the gaps between them,
//!
//! ```text
//! p(x) = Π (x - ν_k)        S(x) = sqrt(R(x))/Π (x - z)        w = 1/S
//! ```
//!
//! with the sign of `(-1)^(number of contacts to the right)`. For many contacts w alone overflows;
//! `w p` does not: each factor of R has one of p close by, and `w p` keeps its sign over a contact.
//! With two corners the degree of p is one less, and the last gap has no zero.

use crate::numerics::{Combine, FarField};
use crate::{Ends, Interval, Real, Side};
use std::ops::Range;

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Weight<T> {
    on: Vec<Interval<T>>,
    /// Squares of the factors by far contacts, for each contact and for the gap after it; coarse
    /// for a trial.
    pub far: FarField<T>,
    /// True at an outermost limit that is a corner.
    corners: Ends<bool>,
    zeros: Vec<T>,
}

impl<T: Real> Weight<T> {
    pub fn new() -> Self {
        let (corners, far) = (Ends::both(false), FarField::new(Combine::Product));
        Self { on: Vec::new(), far, corners, zeros: Vec::new() }
    }

    pub fn set(&mut self, on: &[Interval<T>], corners: Ends<bool>, is_coarse: bool) {
        self.on.clear();
        self.on.extend_from_slice(on);
        self.corners = corners;
        let last = usize::from(corners == Ends::both(true));
        let half = T::of(0.5);
        self.zeros.clear();
        let gaps = on.windows(2).map(|pair| half * pair[0].right + half * pair[1].left);
        self.zeros.extend(gaps.take((on.len() - 1).saturating_sub(last)));
        let gap = |i: usize| Interval { left: on[i].right, right: on[i + 1].left };
        let place = |i: usize| if i.is_multiple_of(2) { on[i / 2] } else { gap(i / 2) };
        let mut far = std::mem::replace(&mut self.far, FarField::new(Combine::Product));
        far.set(on, (0..2 * on.len() - 1).map(place), is_coarse, &|k, x| {
            let [on, zero] = self.factors(k, x > on[k].right, x);
            zero / on
        });
        self.far = far;
    }

    pub fn contacts(&self) -> &[Interval<T>] {
        &self.on
    }

    pub fn corners(&self) -> Ends<bool> {
        self.corners
    }

    /// Returns the zeros of p: number k lies in gap k.
    pub fn zeros(&self) -> &[T] {
        &self.zeros
    }

    /// Returns the number of the first or the last contact.
    fn outermost(&self, side: Side) -> usize {
        if side == Side::Left { 0 } else { self.on.len() - 1 }
    }

    /// Returns `x - z` for the corner z on one side; 1 without a corner.
    fn corner_distance(&self, side: Side, x: T) -> T {
        let limit = self.on[self.outermost(side)][side];
        if self.corners[side] { x - limit } else { T::one() }
    }

    /// Returns `Π (x - z)` over the corners.
    fn corner_factor(&self, x: T) -> T {
        self.corner_distance(Side::Left, x) * self.corner_distance(Side::Right, x)
    }

    /// Returns `w p sqrt((x - α_i)(β_i - x))` at places in contact i.
    pub fn on_contact<const W: usize>(&self, i: usize, x: [T; W]) -> [T; W] {
        let squares = self.squares([i, i], self.far.near(2 * i), self.far.far(2 * i, x), x);
        std::array::from_fn(|j| self.sign_on(i) * squares[j].sqrt() * self.corner_factor(x[j]))
    }

    /// Returns the sign of `w p` on a contact.
    fn sign_on(&self, i: usize) -> T {
        // Contacts and zeros of p to the right of this one.
        Self::sign(self.on.len() - 1 - i + self.zeros.len().saturating_sub(i))
    }

    /// Multiplies by the squares of the factors at places x by some contacts, but those from the
    /// first to the last beside x.
    fn squares<const W: usize>(
        &self,
        [first, last]: [usize; 2],
        contacts: Range<usize>,
        mut squares: [T; W],
        x: [T; W],
    ) -> [T; W] {
        for k in contacts.filter(|k| !(first..=last).contains(k)) {
            for (square, &x) in squares.iter_mut().zip(&x) {
                let [on, zero] = self.factors(k, k < first, x);
                *square *= zero / on;
            }
        }
        squares
    }

    /// Returns `(x - α_k)(x - β_k)`, and the square of the distance to the zero of p between
    /// contact k and x, to its right or to its left.
    fn factors(&self, k: usize, to_right: bool, x: T) -> [T; 2] {
        let (on, zero) = (self.on[k], self.zeros.get(if to_right { k } else { k - 1 }));
        let square = zero.map_or(T::one(), |&zero| (x - zero) * (x - zero));
        [(x - on.left) * (x - on.right), square]
    }

    /// Returns [`on_contact`](Self::on_contact) at a corner, without the factor that vanishes
    /// there.
    pub fn beside_corner(&self, side: Side) -> T {
        let i = self.outermost(side);
        let corner = self.on[i][side];
        let [square] = self.squares([i, i], 0..self.on.len(), [T::one()], [corner]);
        self.sign_on(i) * square.sqrt() * self.corner_distance(side.other(), corner)
    }

    /// Returns `S/p` at a place in gap k, without the zero of p in that gap, given the distances to
    /// both ends of the gap.
    pub fn in_gap(&self, k: usize, x: T, [from_left, to_right]: [T; 2]) -> T {
        let [left, right] = [self.on[k], self.on[k + 1]];
        let (others, far) = (self.far.near(2 * k + 1), self.far.far(2 * k + 1, [x]));
        let [square] = self.squares([k, k + 1], others, far, [x]);
        let near = (from_left * (x - left.left)).sqrt() * (to_right * (right.right - x)).sqrt();
        let flips = self.on.len() - 1 - k + self.zeros.len().saturating_sub(k + 1);
        Self::sign(flips) * near / (square.sqrt() * self.corner_factor(x))
    }

    /// Returns `S/p` beyond all contacts, on one side, given the distance from the outermost limit.
    pub fn beyond(&self, side: Side, x: T, distance: T) -> T {
        let own = self.outermost(side);
        let size = distance.sqrt() * (distance + (self.on[own].right - self.on[own].left)).sqrt();
        let (outward, flips) = match side {
            Side::Left => (-distance, self.on.len() + self.zeros.len()),
            Side::Right => (distance, 0),
        };
        // A corner on this side is at the distance of the limit.
        let factor = if self.corners[side] { outward } else { T::one() };
        let factor = factor * self.corner_distance(side.other(), x);
        let [square] = self.squares([own, own], 0..self.on.len(), [T::one()], [x]);
        Self::sign(flips) * size / (square.sqrt() * factor)
    }

    /// Returns the sign of a root after a number of branch points.
    fn sign(flips: usize) -> T {
        if flips.is_multiple_of(2) { T::one() } else { -T::one() }
    }
}
