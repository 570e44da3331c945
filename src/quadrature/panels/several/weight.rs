//! The weight of several contacts.
//!
//! With `R(x) = Π (x - α_j)(x - β_j)` over the N contacts `[α_j, β_j]` and z the n limits that are
//! held at corners,
//!
//! ```text
//! S(x) = sqrt(R(x))/Π (x - z)        w = 1/S        p(x) = Π (x - ν)
//! ```
//!
//! with the sign of `(-1)^(number of contacts to the right)` in the root. For many contacts w alone
//! overflows; `w p` does not: with zeros ν in the middle of gaps, each factor of S has one of p
//! close by, and `w p` keeps its sign over a contact. Without corners every gap has a zero. Among
//! more corners than contacts p has *poles* μ instead, each in a gap between two corners, so that
//! it stays: `p = Π (x - ν)/Π (x - μ)`. With n corners there are N - n more zeros than poles, one
//! more than that if n exceeds N.

use crate::numerics::{Combine, FarField};
use crate::{Ends, Interval, Real, Side};
use std::ops::Range;

/// Zero or pole of p in a gap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in super::super) enum Middle<T> {
    Zero(T),
    Pole(T),
}

impl<T: Copy> Middle<T> {
    pub fn place(self) -> T {
        let (Self::Zero(x) | Self::Pole(x)) = self;
        x
    }
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Weight<T> {
    on: Vec<Interval<T>>,
    /// Squares of the factors by far contacts, for each contact and for the gap after it; coarse
    /// for a trial.
    pub far: FarField<T>,
    /// Flags: a corner holds this limit of a contact.
    held: Vec<Ends<bool>>,
    /// Number of them.
    corners: usize,
    /// Zero or pole of p in each gap, if it has one.
    middles: Vec<Option<Middle<T>>>,
    /// Zeros less poles of each gap, and the number of zeros before it.
    signs: Vec<i32>,
    before: Vec<usize>,
    /// Flags: `w p` changes its sign an odd number of times to the right of a contact.
    flips: Vec<bool>,
}

impl<T: Real> Weight<T> {
    pub fn new() -> Self {
        let (far, held) = (FarField::new(Combine::Product), Vec::new());
        let (on, middles, flips) = (Vec::new(), Vec::new(), Vec::new());
        let (signs, before) = (Vec::new(), Vec::new());
        Self { on, far, held, corners: 0, middles, signs, before, flips }
    }

    /// Sets the contacts, and the limits of each that are held.
    pub fn set(&mut self, on: &[Interval<T>], held: &[Ends<bool>], is_coarse: bool) {
        self.on.clear();
        self.on.extend_from_slice(on);
        self.held.clear();
        self.held.extend_from_slice(held);
        self.corners = held.iter().map(|&held| count(held)).sum();
        self.choose_middles();
        self.flips.clear();
        self.flips.resize(on.len(), false);
        for k in (0..on.len() - 1).rev() {
            let to_right = 1 + count(held[k + 1]) + usize::from(self.middles[k].is_some());
            self.flips[k] = self.flips[k + 1] != (to_right % 2 == 1);
        }
        let gap = |i: usize| Interval { left: on[i].right, right: on[i + 1].left };
        let place = |i: usize| if i.is_multiple_of(2) { on[i / 2] } else { gap(i / 2) };
        let mut far = std::mem::replace(&mut self.far, FarField::new(Combine::Product));
        far.set(on, (0..2 * on.len() - 1).map(place), is_coarse, &|k, x| {
            let mut square = [T::one()];
            self.multiply(&mut square, k, x > on[k].right, &[x]);
            square[0]
        });
        self.far = far;
    }

    /// Puts zeros or poles into gaps, next to contacts with few or with many corners: far away the
    /// factors of neighbours then cancel, and rounding at one contact is no larger at the others.
    fn choose_middles(&mut self) {
        let gaps = self.on.len() - 1;
        let is_fixed = |k: usize| self.held[k].right && self.held[k + 1].left;
        let beyond_one = |held: Ends<bool>| i32::from(held.left) + i32::from(held.right) - 1;
        // Corners and zeros so far, less poles and contacts.
        let mut have = 0;
        let mut signs = std::mem::take(&mut self.signs);
        signs.clear();
        for k in 0..gaps {
            have += beyond_one(self.held[k]);
            let sign = if have > 0 { -i32::from(is_fixed(k)) } else { -have.signum() };
            have += sign;
            signs.push(sign);
        }
        have += beyond_one(self.held[gaps]);
        let wanted = match self.corners {
            0 => -1,
            n => i32::from(n > self.on.len()),
        };
        for k in (0..gaps).rev() {
            let least = -i32::from(is_fixed(k));
            let by = (wanted - have).clamp(least - signs[k], 1 - signs[k]);
            (signs[k], have) = (signs[k] + by, have + by);
        }
        let (half, mut zeros) = (T::of(0.5), 0);
        self.middles.clear();
        self.before.clear();
        for (k, &sign) in signs.iter().enumerate() {
            let middle = half * self.on[k].right + half * self.on[k + 1].left;
            self.before.push(zeros);
            zeros += usize::from(sign == 1);
            self.middles.push(match sign {
                0 => None,
                1 => Some(Middle::Zero(middle)),
                _ => Some(Middle::Pole(middle)),
            });
        }
        self.signs = signs;
    }

    pub fn contacts(&self) -> &[Interval<T>] {
        &self.on
    }

    /// Returns the limits of each contact that are held.
    pub fn held(&self) -> &[Ends<bool>] {
        &self.held
    }

    /// Returns the number of limits that are held.
    pub fn corners(&self) -> usize {
        self.corners
    }

    /// Returns the corners at which limits are held.
    pub fn held_limits(&self) -> impl Iterator<Item = T> {
        self.on.iter().zip(&self.held).flat_map(|(on, held)| {
            Side::BOTH.into_iter().filter(|&side| held[side]).map(|side| on[side])
        })
    }

    /// Tells whether there are more corners than contacts: V has a constant, which bears the load.
    pub fn is_inverse(&self) -> bool {
        self.corners > self.on.len()
    }

    /// Returns the zero or pole of p in each gap, if it has one.
    pub fn middles(&self) -> &[Option<Middle<T>>] {
        &self.middles
    }

    /// Returns the zero of p in a gap, and its number.
    pub fn zero(&self, k: usize) -> Option<(usize, T)> {
        match self.middles[k] {
            Some(Middle::Zero(zero)) => Some((self.before[k], zero)),
            _ => None,
        }
    }

    /// Returns the pole of p in a gap.
    pub fn pole(&self, k: usize) -> Option<T> {
        match self.middles[k] {
            Some(Middle::Pole(pole)) => Some(pole),
            _ => None,
        }
    }

    /// Returns the zeros of p, each with the number of its gap.
    pub fn zeros(&self) -> impl Iterator<Item = (usize, T)> {
        (0..self.middles.len()).filter_map(|k| Some((k, self.zero(k)?.1)))
    }

    /// Returns the poles of p, each with the number of its gap.
    pub fn poles(&self) -> impl Iterator<Item = (usize, T)> {
        (0..self.middles.len()).filter_map(|k| Some((k, self.pole(k)?)))
    }

    /// Returns the number of the first or the last contact.
    fn outermost(&self, side: Side) -> usize {
        if side == Side::Left { 0 } else { self.on.len() - 1 }
    }

    /// Returns `w p sqrt((x - α_i)(β_i - x))` at places in contact i.
    pub fn on_contact<const W: usize>(&self, i: usize, x: [T; W]) -> [T; W] {
        let squares = self.squares([i, i], self.far.near(2 * i), self.far.far(2 * i, x), x);
        let (on, held, sign) = (self.on[i], self.held[i], self.sign_on(i));
        std::array::from_fn(|j| {
            let by_corners = from_held(held, [x[j] - on.left, on.right - x[j]]);
            sign * squares[j].sqrt() * by_corners
        })
    }

    /// Returns the sign of `w p` on a contact.
    fn sign_on(&self, i: usize) -> T {
        sign(self.flips[i] != self.held[i].right)
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
            self.multiply(&mut squares, k, k < first, &x);
        }
        squares
    }

    /// Multiplies by the squares of the factors at places x by contact k, and by the zero or pole
    /// between it and them.
    #[inline(always)]
    fn multiply<const W: usize>(&self, squares: &mut [T; W], k: usize, to_right: bool, x: &[T; W]) {
        let (on, gap) = (self.on[k], if to_right { Some(k) } else { k.checked_sub(1) });
        let middle = gap.and_then(|gap| *self.middles.get(gap)?);
        for (square, &x) in squares.iter_mut().zip(x) {
            let distances = [x - on.left, x - on.right];
            let mut factor = match middle {
                None => T::one(),
                Some(Middle::Zero(zero)) => x - zero,
                Some(Middle::Pole(pole)) => T::one() / (x - pole),
            };
            if self.corners > 0 {
                factor *= from_held(self.held[k], distances);
            }
            *square *= factor * factor / (distances[0] * distances[1]);
        }
    }

    /// Returns [`on_contact`](Self::on_contact) at a corner over the distance from it.
    pub fn beside_corner(&self, i: usize, side: Side) -> T {
        let on = self.on[i];
        let [square] = self.squares([i, i], 0..self.on.len(), [T::one()], [on[side]]);
        let width = if self.held[i][side.other()] { on.right - on.left } else { T::one() };
        self.sign_on(i) * square.sqrt() * width
    }

    /// Returns `S/p` at a place in gap k, without the zero or pole of p in that gap, given the
    /// distances to both ends of the gap.
    pub fn in_gap(&self, k: usize, x: T, [from_left, to_right]: [T; 2]) -> T {
        let [left, right] = [self.on[k], self.on[k + 1]];
        let (others, far) = (self.far.near(2 * k + 1), self.far.far(2 * k + 1, [x]));
        let [square] = self.squares([k, k + 1], others, far, [x]);
        let near = root_over(self.held[k], [x - left.left, from_left])
            * root_over(self.held[k + 1], [to_right, right.right - x]);
        sign::<T>(self.flips[k] != self.middles[k].is_some()) * near / square.sqrt()
    }

    /// Returns `S/p` beyond all contacts, on one side, given the distance from the outermost limit.
    pub fn beyond(&self, side: Side, x: T, distance: T) -> T {
        let own = self.outermost(side);
        let far = distance + (self.on[own].right - self.on[own].left);
        let (distances, flips) = match side {
            Side::Left => {
                ([distance, far], self.flips[0] != (count(self.held[0]).is_multiple_of(2)))
            }
            Side::Right => ([far, distance], false),
        };
        let [square] = self.squares([own, own], 0..self.on.len(), [T::one()], [x]);
        sign::<T>(flips) * root_over(self.held[own], distances) / square.sqrt()
    }
}

/// Returns the number of limits of a contact that are held.
fn count(held: Ends<bool>) -> usize {
    held.into_iter().filter(|&held| held).count()
}

/// Returns the root of the distances from both limits of a contact, over those from held ones.
fn root_over<T: Real>(held: Ends<bool>, [left, right]: [T; 2]) -> T {
    (left * right).sqrt() / from_held(held, [left, right])
}

/// Returns the product of the distances from the limits of a contact that are held.
fn from_held<T: Real>(held: Ends<bool>, [left, right]: [T; 2]) -> T {
    match held {
        Ends { left: false, right: false } => T::one(),
        Ends { left: true, right: false } => left,
        Ends { left: false, right: true } => right,
        Ends { left: true, right: true } => left * right,
    }
}

/// Returns the sign after an odd or even number of changes.
fn sign<T: Real>(flips: bool) -> T {
    if flips { -T::one() } else { T::one() }
}
