//! The conditions on the limits of several contacts, and their derivatives by the limits.

use super::Several;
use super::one_of_several::OneOfSeveral;
use crate::numerics::gauss_legendre::GaussLegendre;
use crate::numerics::{Combine, FarField};
use crate::{Ends, Interval, Real, Side};
use std::ops::Range;

/// Longest span in a gap for one Gauss rule, in the variable t of `x = β + 2 L sinh²(t/2)`: the
/// next singularity lies at least a third as far beyond its end.
const MAX_GAUSS_SPAN: f64 = 2.0;

/// Limit on the number of such spans: more than any gap and contact of finite widths have.
const MAX_STRETCHES: usize = 1000;

/// Conditions on the free limits, from left to right, linearised.
#[derive(Clone)]
pub(crate) struct System<T> {
    /// Residual of each condition.
    pub residual: Vec<T>,
    /// Uncertainty of each residual, by quadrature and rounding.
    pub open: Vec<T>,
    /// Derivatives by the limits, a row for each condition.
    pub jacobian: Vec<T>,
    /// Gap so narrow that the rounding of the heights moves it by more than its width.
    pub lost: Option<usize>,
    /// Row of the load condition.
    pub load_row: usize,
    /// Limits, from left to right.
    pub(super) limits: Vec<T>,
    /// V at the limits, signed as where the pressure next to them is positive, and V at the zeros
    /// of p.
    pub(super) at_ends: Vec<T>,
    at_zeros: Vec<T>,
    /// Parts of V by the contacts far from each gap.
    far: FarField<T>,
    /// Integral `∫ S/p dx` over the last gap, if that has no zero of p.
    over_last: T,
    /// Integrals `∫ S/p_k dx/(x - e)` over a gap, for all limits e.
    sums: Vec<T>,
}

impl<T: Real> System<T> {
    pub fn new() -> Self {
        let [residual, open, jacobian, limits, at_ends, at_zeros, sums] = Default::default();
        let (lost, load_row, over_last) = (None, 0, T::zero());
        let far = FarField::new(Combine::Sum);
        Self {
            residual,
            open,
            jacobian,
            lost,
            load_row,
            limits,
            at_ends,
            at_zeros,
            far,
            over_last,
            sums,
        }
    }

    /// Adds a condition: its residual, its uncertainty, and its derivative by each free limit.
    fn add(&mut self, value: T, open: T, free: Range<usize>, by: impl Fn(&Self, usize) -> T) {
        self.residual.push(value);
        self.open.push(open);
        for i in free {
            self.jacobian.push(by(self, i));
        }
    }
}

impl<T: Real> Several<T> {
    /// Sets up the conditions for a load, given as F/κ.
    pub fn system(&self, load: T, system: &mut System<T>) {
        let System { residual, open, jacobian, limits, at_ends, at_zeros, .. } = system;
        for known in [residual, open, jacobian, limits, at_ends, at_zeros] {
            known.clear();
        }
        (system.over_last, system.lost) = (T::zero(), None);
        system.limits.extend(self.contacts().iter().flat_map(|on| [on.left, on.right]));
        let contacts = self.contacts();
        let gap = |pair: &[Interval<T>]| Interval { left: pair[0].right, right: pair[1].left };
        let part = |k: usize, x: T| self.parts[k].seen_from(x);
        system.far.set(contacts, contacts.windows(2).map(gap), &part);
        for (i, on) in contacts.iter().enumerate() {
            system.at_ends.extend(Side::BOTH.map(|side| {
                let size = self.at_end(&system.far, i, side).abs();
                size * self.weight.on_contact(i, on[side]).signum()
            }));
        }
        let zeros = self.weight.zeros().iter().enumerate();
        system.at_zeros.extend(zeros.map(|(k, &x)| self.in_gap(&system.far, k, x, None)));
        self.balance(load, system);
        for k in 0..self.count - 1 {
            self.close(k, system);
        }
    }

    /// Returns V at a place in a gap; near contact `near`, given the distance from it.
    fn in_gap(&self, far: &FarField<T>, k: usize, x: T, near: Option<(usize, T)>) -> T {
        self.outside(far.near(k), x, near) + far.far(k, x)
    }

    /// Returns V at a limit, without its infinite part.
    fn at_end(&self, far: &FarField<T>, contact: usize, side: Side) -> T {
        let gap = match side {
            Side::Left => contact.checked_sub(1),
            Side::Right => Some(contact).filter(|k| k + 1 < self.count),
        };
        let Some(k) = gap else { return self.at_outer_end(side) };
        let (part, others) = (&self.parts[contact], far.near(k).filter(|&i| i != contact));
        let x = part.on[side];
        part.at_end(side) + self.outside(others, x, None) + far.far(k, x)
    }

    /// Adds the balance conditions and the load condition.
    fn balance(&self, load: T, system: &mut System<T>) {
        let (one, half, pi) = (T::one(), T::of(0.5), T::pi());
        let (hull, free, no_corners) = (self.hull(), self.free(), self.has_no_corners());
        let centre = hull.plain().centre();
        let moments =
            |of: &dyn Fn(T, &OneOfSeveral<T>) -> T| self.parts().iter().fold(T::zero(), of);
        let total = pi * moments(&|sum, part| sum + part.moments.m0);
        for (k, &x) in self.weight.zeros().iter().enumerate() {
            let value = system.at_zeros[k];
            let share = |on: Interval<T>| one / (x - on.right).abs().min((x - on.left).abs());
            system.add(value, self.moments_error(share), free.clone(), |known, i| {
                half * known.at_ends[i] / (known.limits[i] - x)
            });
        }
        let mut borne = total / pi;
        if no_corners {
            borne = moments(&|sum, OneOfSeveral { on, moments, .. }| {
                sum + (on.centre() - centre) * moments.m0 + on.half_width() * moments.m1
            });
            let error = self.moments_error(|_| one);
            system.add(total, error, free.clone(), |known, i| half * known.at_ends[i]);
        }
        system.load_row = system.residual.len();
        let error = self.moments_error(|on| match no_corners {
            true => (on.left - centre).abs().max((on.right - centre).abs()),
            false => one,
        });
        system.add(borne - load, error / pi, free, |known, i| {
            let value = known.at_ends[i];
            let arm = if no_corners { known.limits[i] - centre } else { one };
            half * arm * value / pi
        });
    }

    /// Adds the condition that a gap closes at both ends.
    fn close(&self, k: usize, system: &mut System<T>) {
        let (zero, pi) = (T::zero(), T::pi());
        let [left, right] = [&self.parts[k], &self.parts[k + 1]];
        let width = right.on.left - left.on.right;
        let [mut closed, mut size, mut over] = [zero; 3];
        let mut sums = std::mem::take(&mut system.sums);
        sums.clear();
        sums.resize(2 * self.count, zero);
        self.through_gap(k, &system.far, |x, [from_left, to_right], value, scale| {
            let share = scale * self.without_zero(k, system, x, value);
            closed -= share / pi;
            size += share.abs() / pi;
            over += scale;
            let mut add = |ends: Range<usize>| {
                for (sum, &end) in sums[ends.clone()].iter_mut().zip(&system.limits[ends]) {
                    *sum += scale / (x - end);
                }
            };
            add(0..2 * k + 1);
            add(2 * k + 3..2 * self.count);
            sums[2 * k + 1] += scale / from_left;
            sums[2 * k + 2] -= scale / to_right;
        });
        system.sums = sums;
        if k == self.weight.zeros().len() {
            system.over_last = over;
        }
        let [from, to] = [left.height(left.on.right), right.height(right.on.left)];
        let heights = left.height_size(from) + right.height_size(to);
        let rounding = T::of(4.0) * T::epsilon() * (heights + size);
        let open = closed - (to - from);
        // Term that dividing by w²/(w² + c²) adds to the derivatives, times that divisor.
        let known = (open.abs() - rounding).max(zero) * open.signum();
        let square = left.on.half_width().min(right.on.half_width()).powi(2);
        let by_width = (known + known) / width * square / (square + width * width);
        let by_limit = |known: &System<T>, i: usize| {
            let zero = self.weight.zeros().get(k);
            let away = zero.map_or(T::one(), |&zero| known.limits[i] - zero);
            known.at_ends[i] / away / (pi + pi) * known.sums[i]
        };
        let ends = [2 * k + 1, 2 * k + 2];
        let [by_left, by_right] = ends.map(|i| by_limit(system, i).abs());
        if (by_left + by_right) * width <= rounding {
            system.lost.get_or_insert(k);
        }
        system.add(open, rounding, self.free(), |known, i| match i {
            i if i == ends[0] => by_limit(known, i) + by_width,
            i if i == ends[1] => by_limit(known, i) - by_width,
            i => by_limit(known, i),
        });
    }

    /// Shows the nodes of rules from both ends of a gap to its middle: the place, its distances to
    /// the ends, V, and `S/p dx` without the zero of p.
    fn through_gap(&self, k: usize, far: &FarField<T>, mut show: impl FnMut(T, [T; 2], T, T)) {
        let (one, half, rule) = (T::one(), T::of(0.5), GaussLegendre::sixteen());
        let [left, right] = [k, k + 1].map(|i| self.parts[i].on);
        let width = right.left - left.right;
        for (near, on, edge, sign) in [(k, left, left.right, one), (k + 1, right, right.left, -one)]
        {
            // Half the gap.
            let last = T::of(2.0) * (width / (T::of(4.0) * on.half_width())).sqrt().asinh();
            let is_enough = |&n: &usize| T::of(MAX_GAUSS_SPAN) * T::count(n) >= last;
            let pieces = (1..MAX_STRETCHES).find(is_enough).unwrap_or(1);
            let step = last / T::count(pieces);
            for piece in 0..pieces {
                let start = step * T::count(piece);
                for (&node, &weight) in rule.nodes.iter().zip(&rule.weights).take(rule.n) {
                    let t = start + half * step * T::of(1.0 + node);
                    let sinh = (half * t).sinh();
                    let sinh_t = (sinh + sinh) * (one + sinh * sinh).sqrt();
                    let distance = (on.half_width() + on.half_width()) * sinh * sinh;
                    let x = edge + sign * distance;
                    let dx = half * step * T::of(weight) * on.half_width() * sinh_t;
                    let value = self.in_gap(far, k, x, Some((near, distance)));
                    let mut distances = [distance, width - distance];
                    if near > k {
                        distances.reverse();
                    }
                    show(x, distances, value, self.weight.in_gap(k, x, distances) * dx);
                }
            }
        }
    }

    /// Returns `V_k`: V minus its value at the zero of p in gap k, divided by the distance from
    /// that zero; V itself if the gap has no zero.
    pub(super) fn without_zero(&self, k: usize, system: &System<T>, x: T, value: T) -> T {
        let zero = self.weight.zeros().get(k);
        zero.map_or(value, |&zero| (value - system.at_zeros[k]) / (x - zero))
    }

    /// Returns π times the sum of the errors of all moments, each times its share.
    fn moments_error(&self, share: impl Fn(Interval<T>) -> T) -> T {
        let add = |sum, part: &OneOfSeveral<T>| sum + T::pi() * part.moments.error * share(part.on);
        self.parts().iter().fold(T::zero(), add)
    }

    /// Returns the interval from the first limit to the last.
    fn hull(&self) -> Interval<T> {
        Interval { left: self.parts[0].on.left, right: self.parts[self.count - 1].on.right }
    }

    fn has_no_corners(&self) -> bool {
        self.corners() == Ends::both(false)
    }

    /// Returns `(1/π) ∫ w p (x - x₀)ⁱ g dx` for i = 1 and 2.
    fn powers(&self, about: T) -> [T; 2] {
        let (half, two) = (T::of(0.5), T::of(2.0));
        let mut powers = [T::zero(); 2];
        for OneOfSeveral { on, moments, .. } in self.parts() {
            let (away, half_width) = (on.centre() - about, on.half_width());
            let arm = half_width * moments.m1;
            let second = moments.m2.unwrap_or(T::zero());
            let square = half * half_width * half_width * (moments.m0 + second);
            powers[0] += away * moments.m0 + arm;
            powers[1] += away * (away * moments.m0 + two * arm) + square;
        }
        powers
    }

    /// Returns ρ₁ and ρ₂: far from the contacts `p/S` is `1 + ρ₁/x + ρ₂/x²`, times 1/x without
    /// corners, with x counted from x₀.
    fn afar(&self, about: T) -> [T; 2] {
        let (half, hull, corners) = (T::of(0.5), self.hull(), self.corners());
        let limits = self.contacts().iter().flat_map(|on| [(on.left, half), (on.right, half)]);
        let zeros = self.weight.zeros().iter().copied();
        let corners = Side::BOTH.into_iter().filter(|&side| corners[side]).map(|side| hull[side]);
        let all = limits.chain(zeros.chain(corners).map(|x| (x, -T::one())));
        let [first, second] = all.fold([T::zero(); 2], |[first, second], (x, share)| {
            let x = x - about;
            [first + share * x, second + share * half * x * x]
        });
        [first, second + half * first * first]
    }

    /// Makes the load an unknown, with the last column, in place of the first or the last free
    /// limit, which stays where it is.
    pub fn by_load(&self, side: Side, system: &mut System<T>) {
        let columns = system.residual.len();
        for (i, row) in system.jacobian.chunks_mut(columns).enumerate() {
            if side == Side::Left {
                row.rotate_left(1);
            }
            row[columns - 1] = if i == system.load_row { -T::one() } else { T::zero() };
        }
    }

    /// Adds one unknown, the tilt of the bodies, and one condition: the load acts at a given place.
    ///
    /// ```text
    /// M = (1/π) ∫ w p q (x - x₀) g ds - ρ₁ F = 0
    /// by a limit e: (e - x₀)² V(e)/2π, with corners (e - x₀) V(e)/2π
    /// ```
    ///
    /// All conditions are linear in g, so the column of the tilt holds their values for g = 1 and a
    /// gap that rises by its width: there `V = -π p/S` off the contacts, plus π with corners.
    pub fn turning(&self, load: T, at: T, system: &mut System<T>) {
        let (zero, half, pi) = (T::zero(), T::of(0.5), T::pi());
        let (hull, no_corners) = (self.hull(), self.has_no_corners());
        let (rows, columns) =
            (system.residual.len(), system.jacobian.len() / system.residual.len());
        let zeros = self.weight.zeros().len();
        for row in (0..rows).rev() {
            let by_tilt = if row == system.load_row {
                self.afar(hull.plain().centre())[0]
            } else if row < system.load_row {
                if no_corners && row < zeros { zero } else { pi }
            } else if row + 1 == rows {
                -system.over_last
            } else {
                zero
            };
            system.jacobian.insert((row + 1) * columns, by_tilt);
        }
        let powers = self.powers(at);
        let [first, second] = self.afar(at);
        let reach = (hull.left - at).abs().max((hull.right - at).abs());
        let (reach, borne) = match no_corners {
            true => (reach * reach, powers[1]),
            false => (reach, powers[0]),
        };
        let error = self.parts().iter().fold(zero, |sum, part| sum + part.moments.error) * reach;
        system.add(borne - first * load, error, self.free(), |known, i| {
            let away = known.limits[i] - at;
            half * if no_corners { away * away } else { away } * known.at_ends[i] / pi
        });
        system.jacobian.push(second);
    }
}
