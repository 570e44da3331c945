//! The weight of several contacts.
//!
//! With `R(x) = Π (x - α_j)(x - β_j)` over the contacts `[α_j, β_j]`, z their corners (the outermost limits
//! only) and ν_k the middles of the gaps between them,
//!
//! ```text
//! p(x) = Π (x - ν_k)        S(x) = sqrt(R(x))/Π (x - z)        w = 1/S
//! ```
//!
//! with the sign of `(-1)^(number of contacts to the right)`. The plain w of many contacts overflows; `w p`
//! does not: to each factor of R there is one of p close by, and `w p` keeps its sign over a contact. With two
//! corners the degree of p is one less, and the last gap has no zero.

use crate::{Ends, Interval, Real, Side};
use std::ops::Range;

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Weight<T> {
    on: Vec<Interval<T>>,
    /// Whether the outermost limits are corners.
    corners: Ends<bool>,
    zeros: Vec<T>,
}

impl<T: Real> Weight<T> {
    pub fn new() -> Self {
        Self { on: Vec::new(), corners: Ends::both(false), zeros: Vec::new() }
    }

    pub fn set(&mut self, on: &[Interval<T>], corners: Ends<bool>) {
        self.on.clear();
        self.on.extend_from_slice(on);
        self.corners = corners;
        let last = usize::from(corners == Ends::both(true));
        let half = T::of(0.5);
        self.zeros.clear();
        let gaps = on.windows(2).map(|pair| half * pair[0].right + half * pair[1].left);
        self.zeros.extend(gaps.take((on.len() - 1).saturating_sub(last)));
    }

    pub fn contacts(&self) -> &[Interval<T>] {
        &self.on
    }

    pub fn corners(&self) -> Ends<bool> {
        self.corners
    }

    /// The zeros of p: that of gap k is number k.
    pub fn zeros(&self) -> &[T] {
        &self.zeros
    }

    /// `Π (x - z)` over the corners.
    fn corner_factor(&self, x: T) -> T {
        let (first, last) = (self.on[0].left, self.on[self.on.len() - 1].right);
        let Ends { left, right } = self.corners;
        (if left { x - first } else { T::one() }) * (if right { x - last } else { T::one() })
    }

    /// `w p sqrt((x - α_i)(β_i - x))` at a place in contact i.
    pub fn on_contact(&self, i: usize, x: T) -> T {
        self.near(i, 0..self.on.len(), x)
    }

    /// The same without the contacts that are not among these.
    pub fn near(&self, i: usize, contacts: Range<usize>, x: T) -> T {
        self.smooth(i, contacts, x) * self.corner_factor(x)
    }

    /// What the contacts that are not among these make of it.
    pub fn far(&self, i: usize, contacts: Range<usize>, x: T) -> T {
        let [left, right] = [0..contacts.start, contacts.end..self.on.len()];
        (self.square(i, left, x) * self.square(i, right, x)).sqrt()
    }

    /// The numbers of a contact and of those next to it, two on either side.
    pub fn next_to(&self, i: usize) -> Range<usize> {
        i.saturating_sub(2)..(i + 3).min(self.on.len())
    }

    /// Some contacts' share without the corners, with the sign of all.
    fn smooth(&self, i: usize, contacts: Range<usize>, x: T) -> T {
        // Contacts and zeros of p to the right of this one.
        let flips = self.on.len() - 1 - i + self.zeros.len().saturating_sub(i);
        let sign = if flips.is_multiple_of(2) { T::one() } else { -T::one() };
        sign * self.square(i, contacts, x).sqrt()
    }

    /// The square of what some contacts make of it.
    fn square(&self, i: usize, contacts: Range<usize>, x: T) -> T {
        let mut square = T::one();
        for k in contacts {
            if k == i {
                continue;
            }
            let (on, zero) = (self.on[k], self.zeros.get(if k < i { k } else { k - 1 }));
            let factor = zero.map_or(T::one(), |&zero| (x - zero) * (x - zero));
            square *= factor / ((x - on.left) * (x - on.right));
        }
        square
    }

    /// The same at the left or the right corner, without the factor that vanishes there.
    pub fn beside_corner(&self, side: Side) -> T {
        let (first, last) = (self.on[0].left, self.on[self.on.len() - 1].right);
        let (i, x, other, has_other) = match side {
            Side::Left => (0, first, last, self.corners.right),
            Side::Right => (self.on.len() - 1, last, first, self.corners.left),
        };
        let other = if has_other { x - other } else { T::one() };
        self.smooth(i, 0..self.on.len(), x) * other
    }

    /// `S/p` at a place in gap k, without the zero of p in that gap, by the distances to both ends of the
    /// gap.
    pub fn in_gap(&self, k: usize, x: T, [from_left, to_right]: [T; 2]) -> T {
        let [left, right] = [self.on[k], self.on[k + 1]];
        let mut square = T::one();
        for (m, on) in self.on.iter().enumerate() {
            if m == k || m == k + 1 {
                continue;
            }
            let zero = self.zeros.get(if m < k { m } else { m - 1 });
            let factor = zero.map_or(T::one(), |&zero| (x - zero) * (x - zero));
            square *= (x - on.left) * (x - on.right) / factor;
        }
        let near = (from_left * (x - left.left)).sqrt() * (to_right * (right.right - x)).sqrt();
        let flips = self.on.len() - 1 - k + self.zeros.len().saturating_sub(k + 1);
        let sign = if flips.is_multiple_of(2) { T::one() } else { -T::one() };
        sign * near * square.sqrt() / self.corner_factor(x)
    }

    /// `S/p` beyond all contacts, on their left or on their right, by the distance from the outermost limit.
    pub fn beyond(&self, side: Side, x: T, distance: T) -> T {
        let (own, flips) = match side {
            Side::Left => (0, self.on.len() + self.zeros.len()),
            Side::Right => (self.on.len() - 1, 0),
        };
        let mut size = T::one();
        for (k, on) in self.on.iter().enumerate() {
            let [near, far] = if k == own {
                [distance, distance + (on.right - on.left)]
            } else {
                [(x - on.left).abs(), (x - on.right).abs()]
            };
            size *= near.sqrt() * far.sqrt();
            if let Some(&zero) = self.zeros.get(k) {
                size /= (x - zero).abs();
            }
        }
        let sign = if flips.is_multiple_of(2) { T::one() } else { -T::one() };
        // A corner on this side is as far as the limit is.
        let outward = if side == Side::Left { -distance } else { distance };
        let other = side.other();
        let far = self.on[self.on.len() - 1 - own][other];
        let factor = if self.corners[side] { outward } else { T::one() };
        let factor = if self.corners[other] { factor * (x - far) } else { factor };
        sign * size / factor
    }
}
