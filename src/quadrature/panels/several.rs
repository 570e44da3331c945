//! Several contacts at once: the equations for their limits, and the pressure.
//!
//! With the weight w and the polynomial p of [`weight`], κ = 1 and g the slope of the gap, everything
//! follows from one function,
//!
//! ```text
//! V(x) = Σ_j PV∫ w p g/(s - x) ds over contact j
//! P(x) = S(x)/p(x) V(x)/π²  on the contacts         Φ(x) = ∫ P/(x - s) ds = -S(x)/p(x) V(x)/π  off them
//! ```
//!
//! (Muskhelishvili, *Singular Integral Equations*, 1953, §§ 88 and 89, with p in place of 1: whatever the
//! limits balance, `V` is p times the same integral without p.) The limits are right when
//!
//! ```text
//! V(ν_k) = 0 at each zero of p,    without corners ∫ w p g ds = 0           balance
//! (1/π) ∫ w p q g ds = F,          q = x - c without corners, 1 with one    load
//! ∫ Φ dx over a gap = h at its right end - h at its left end                each gap closes at both ends
//! ```
//!
//! with h the height of the gap between the bodies. As many as there are free limits: two a contact. A limit e
//! acts on each through `V(e)`, taken without what is infinite there (Hadamard's finite part), so that the
//! Jacobian is exact:
//!
//! ```text
//! of V(ν):  (V(e) - V(ν))/(2 (e - ν))        of ∫ w p g:  V(e)/2       of the load:  ((e - c) V(e) + ∫ w p g)/(2π)
//! of a gap: V_k(e)/(2π) ∫ S/p_k dx/(x - e)    p_k = p/(x - ν_k),  V_k = (V - V(ν_k))/(x - ν_k)
//! ```
//!
//! As a gap of width w closes, `V(ν)` becomes π²/S times the pressure in its place. The condition of the gap vanishes with
//! w² whatever the pressure does, so that a gap of no width would meet it anywhere; over w² it says where that
//! pressure is least. Newton's method is given the condition over `w²/(w² + c²)`, c half the width of the narrower
//! contact beside the gap.
//!
//! With one contact these are the equations of [`quadrature`](crate::quadrature).

mod distant_contacts;
mod exterior;
mod load_response;
mod one_of_several;
mod weight;

use super::hilbert_transform::LANES;
use super::panel_set::PanelSet;
use crate::gap::{Cost, Gap};
use crate::{ContactError, Ends, Interval, Real, Side};
use distant_contacts::DistantContacts;
pub(crate) use load_response::LoadResponse;
use one_of_several::{OneOfSeveral, gauss};
use std::ops::Range;
use weight::Weight;

/// The longest span of the way through a gap that one Gauss rule takes, in the variable t of
/// `x = β + 2 L sinh²(t/2)`: the next singularity lies at least a third as far beyond its end.
const STRETCH: f64 = 2.0;

/// More than those of any gap and contact whose widths are numbers.
const MOST_STRETCHES: usize = 1000;

/// Several contacts on their panels.
#[derive(Clone)]
pub(crate) struct Several<T> {
    parts: Vec<OneOfSeveral<T>>,
    /// How many of the parts are in use.
    count: usize,
    weight: Weight<T>,
    tolerance: T,
    /// What V has besides: of one contact between two corners, whose load is given, `-π F/κ`.
    constant: T,
    /// The cost of sampling, and what one contact had cost before.
    pub cost: Cost,
    pub spent: Cost,
}

/// The conditions on the free limits, from left to right, linearised.
#[derive(Clone)]
pub(crate) struct System<T> {
    /// By how much each condition fails.
    pub residual: Vec<T>,
    /// How much of that the quadrature and rounding leave open.
    pub open: Vec<T>,
    /// The derivatives by the limits, a row for each condition.
    pub jacobian: Vec<T>,
    /// A gap so narrow that the rounding of the heights moves it by more than its width.
    pub lost: Option<usize>,
    /// Which of the conditions is that of the load.
    pub load_row: usize,
    /// The limits, from left to right.
    limits: Vec<T>,
    /// V at the limits, and at the zeros of p.
    at_ends: Vec<T>,
    at_zeros: Vec<T>,
    /// `∫ S/p dx` over the last gap, where that has no zero of p.
    over_last: T,
    /// `∫ S/p_k dx/(x - e)` over a gap, for all limits e.
    sums: Vec<T>,
}

impl<T: Real> System<T> {
    pub fn new() -> Self {
        let [residual, open, jacobian, limits, at_ends, at_zeros, sums] =
            std::array::from_fn(|_| Vec::new());
        Self {
            residual,
            open,
            jacobian,
            lost: None,
            load_row: 0,
            limits,
            at_ends,
            at_zeros,
            sums,
            over_last: T::zero(),
        }
    }

    /// The condition that does not hold where a gap has closed, and the pressure in its place is positive.
    pub fn row_of_gap(&self, gap: usize) -> usize {
        if gap < self.at_zeros.len() { gap } else { self.load_row }
    }
}

impl<T: Real> Several<T> {
    pub fn new(tolerance: T) -> Self {
        let (parts, weight, constant) = (Vec::new(), Weight::new(), T::zero());
        let [cost, spent] = [Cost::default(); 2];
        Self { parts, count: 0, weight, tolerance, constant, cost, spent }
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

    /// Turns to contacts between the ends of the bodies, and whether the outermost limits are corners: ready for
    /// the conditions on the limits, not yet for pressures. The
    /// samples of contacts that have been there are kept, where they are as many.
    pub fn set(
        &mut self,
        gap: &Gap<'_, T>,
        on: &[Interval<T>],
        corners: Ends<bool>,
        ends: Ends<T>,
    ) -> Result<(), ContactError<T>> {
        self.weight.set(on, corners);
        if on.len() != self.count {
            self.parts.iter_mut().for_each(|part| part.clear(true));
            self.count = on.len();
        }
        while self.parts.len() < self.count {
            self.parts.push(OneOfSeveral::new(self.tolerance));
        }
        let half = T::of(0.5);
        for (i, part) in self.parts[..self.count].iter_mut().enumerate() {
            // No contact is sampled beyond the middle of a gap.
            let from = if i == 0 { ends.left } else { half * on[i - 1].right + half * on[i].left };
            let to = on.get(i + 1).map_or(ends.right, |next| half * on[i].right + half * next.left);
            part.panel_set.spent = self.spent + self.cost;
            let sampled = part.sample(gap, on[i], [from, to]);
            self.cost += std::mem::take(&mut part.panel_set.cost);
            sampled?;
            let (near, weight) = (self.weight.next_to(i), &self.weight);
            let far = |x| weight.far(i, near.clone(), x);
            let apart = DistantContacts::new(near.clone(), self.count, on[i], self.tolerance, far);
            part.set(|x| weight.near(i, apart.near.clone(), x) * apart.far(x, T::one()));
            (part.weight, part.value) = (apart, DistantContacts::near(self.count));
        }
        Ok(())
    }

    /// Looks between the nodes of all contacts.
    pub fn probe(&mut self, gap: &Gap<'_, T>) -> Result<bool, ContactError<T>> {
        let mut is_missed = false;
        for part in &mut self.parts[..self.count] {
            let on = part.on;
            part.panel_set.spent = self.spent + self.cost;
            let probed = part.panel_set.probe(gap, on);
            self.cost += std::mem::take(&mut part.panel_set.cost);
            is_missed |= probed?;
        }
        Ok(is_missed)
    }

    /// Makes ready for pressures.
    pub fn press(&mut self) {
        for i in 0..self.count {
            self.parts[i].press();
            self.parts[i].value = self.apart(self.weight.next_to(i), self.parts[i].on);
        }
    }

    /// A limit, by its number from left to right, and whether it is free.
    fn limit(&self, i: usize) -> T {
        let on = self.parts[i / 2].on;
        if i.is_multiple_of(2) { on.left } else { on.right }
    }

    fn is_free(&self, i: usize) -> bool {
        let corners = self.weight.corners();
        !(i == 0 && corners.left || i + 1 == 2 * self.count && corners.right)
    }

    fn parts(&self) -> &[OneOfSeveral<T>] {
        &self.parts[..self.count]
    }

    /// What some contacts make of V off them. Near contact `near` by the distance from that.
    fn outside(&self, contacts: impl Iterator<Item = usize>, x: T, near: Option<(usize, T)>) -> T {
        contacts.fold(T::zero(), |sum, i| {
            sum + match near {
                Some((j, distance)) if i == j => self.parts[i].outside(x, distance),
                _ => self.parts[i].seen_from(x),
            }
        })
    }

    /// The numbers of all contacts but one.
    fn others(&self, but: usize) -> impl Iterator<Item = usize> + use<T> {
        (0..self.count).filter(move |&i| i != but)
    }

    /// What all contacts make of V over an interval, next to which are these.
    fn apart(&self, near: Range<usize>, on: Interval<T>) -> DistantContacts<T> {
        let far = || (0..near.start).chain(near.end..self.count);
        let value = |x| self.outside(far(), x, None);
        DistantContacts::new(near.clone(), self.count, on, self.tolerance, value)
    }

    /// The conditions for a load, that is F/κ.
    pub fn system(&self, load: T, system: &mut System<T>) {
        let (zero, one, half) = (T::zero(), T::one(), T::of(0.5));
        let n = self.count;
        let corners = self.weight.corners();
        let hull = Interval { left: self.parts[0].on.left, right: self.parts[n - 1].on.right };
        let centre = hull.plain().centre();
        let System {
            residual,
            open,
            jacobian,
            lost,
            load_row,
            limits,
            at_ends,
            at_zeros,
            sums,
            over_last,
        } = system;
        limits.clear();
        limits.extend(self.parts().iter().flat_map(|part| [part.on.left, part.on.right]));
        at_ends.clear();
        at_zeros.clear();
        for (i, part) in self.parts().iter().enumerate() {
            for side in Side::BOTH {
                let x = part.on[side];
                at_ends.push(part.at_end(side) + self.outside(self.others(i), x, None));
            }
        }
        let at_zero = |&x: &T| self.outside(0..n, x, None);
        at_zeros.extend(self.weight.zeros().iter().map(at_zero));
        residual.clear();
        open.clear();
        jacobian.clear();
        let (is_free, end) = (|i: usize| self.is_free(i), |i: usize| limits[i]);
        let mut row = |value: T, error: T, by: &mut dyn FnMut(usize) -> T| {
            residual.push(value);
            open.push(error);
            jacobian.extend((0..2 * n).filter(|&i| is_free(i)).map(by));
        };
        let error = |share: &dyn Fn(&OneOfSeveral<T>) -> T| {
            self.parts()
                .iter()
                .fold(zero, |sum, part| sum + T::pi() * part.moments.error * share(part))
        };
        for (&x, &value) in self.weight.zeros().iter().zip(&*at_zeros) {
            let away = |part: &OneOfSeveral<T>| {
                one / (x - part.on.right).abs().min((x - part.on.left).abs())
            };
            row(value, error(&away), &mut |i| half * (at_ends[i] - value) / (end(i) - x));
        }
        *load_row = at_zeros.len() + usize::from(corners == Ends::both(false));
        let total = T::pi() * self.parts().iter().fold(zero, |sum, part| sum + part.moments.m0);
        if corners == Ends::both(false) {
            row(total, error(&|_| one), &mut |i| half * at_ends[i]);
            let borne = self.parts().iter().fold(zero, |sum, OneOfSeveral { on, moments, .. }| {
                sum + (on.centre() - centre) * moments.m0 + on.half_width() * moments.m1
            });
            let reach = |part: &OneOfSeveral<T>| {
                (part.on.left - centre).abs().max((part.on.right - centre).abs())
            };
            row(borne - load, error(&reach) / T::pi(), &mut |i| {
                half * ((end(i) - centre) * at_ends[i] + total) / T::pi()
            });
        } else {
            row(total / T::pi() - load, error(&|_| one) / T::pi(), &mut |i| {
                half * at_ends[i] / T::pi()
            });
        }
        sums.clear();
        sums.resize(2 * n, zero);
        (*over_last, *lost) = (zero, None);
        for k in 0..n - 1 {
            let zero_of_p = self.weight.zeros().get(k).map(|&x| (x, at_zeros[k]));
            sums.fill(zero);
            let [mut closed, mut size] = [zero; 2];
            let [left, right] = [k, k + 1].map(|i| self.parts[i].on);
            let width = right.left - left.right;
            let near = k.saturating_sub(1)..(k + 3).min(n);
            let apart = self.apart(near, Interval { left: left.right, right: right.left });
            for at_right in [false, true] {
                let (near, from) = if at_right { (k + 1, right) } else { (k, left) };
                let edge = if at_right { right.left } else { left.right };
                let sign = if at_right { -one } else { one };
                // Half the gap.
                let last = T::of(2.0) * (width / (T::of(4.0) * from.half_width())).sqrt().asinh();
                let is_enough = |&n: &usize| T::of(STRETCH) * T::count(n) >= last;
                let pieces = (1..MOST_STRETCHES).find(is_enough).unwrap_or(1);
                let step = last / T::count(pieces);
                for piece in 0..pieces {
                    let start = step * T::count(piece);
                    for (&node, &weight) in
                        gauss().nodes.iter().zip(&gauss().weights).take(gauss().n)
                    {
                        let t = start + half * step * T::of(1.0 + node);
                        let sinh = (half * t).sinh();
                        let sinh_t = (sinh + sinh) * (one + sinh * sinh).sqrt();
                        let distance = (from.half_width() + from.half_width()) * sinh * sinh;
                        let x = edge + sign * distance;
                        let dx = half * step * T::of(weight) * from.half_width() * sinh_t;
                        let here = Some((near, distance));
                        let value = self.outside(apart.near.clone(), x, here) + apart.far(x, zero);
                        let distances = [distance, width - distance];
                        let [from_left, to_right] =
                            if at_right { [distances[1], distances[0]] } else { distances };
                        let scale = self.weight.in_gap(k, x, [from_left, to_right]) * dx;
                        let without =
                            zero_of_p.map_or(value, |(zero, at)| (value - at) / (x - zero));
                        closed -= scale * without / T::pi();
                        if zero_of_p.is_none() {
                            *over_last += scale;
                        }
                        size += (scale * without).abs() / T::pi();
                        let (before, beside) = sums.split_at_mut(2 * k + 1);
                        let (beside, after) = beside.split_at_mut(2);
                        for (sum, &end) in before.iter_mut().zip(&*limits) {
                            *sum += scale / (x - end);
                        }
                        beside[0] += scale / from_left;
                        beside[1] -= scale / to_right;
                        for (sum, &end) in after.iter_mut().zip(&limits[2 * k + 3..]) {
                            *sum += scale / (x - end);
                        }
                    }
                }
            }
            let at_left = self.parts[k].height(left.right);
            let at_right = self.parts[k + 1].height(right.left);
            let due = at_right - at_left;
            let heights =
                self.parts[k].height_size(at_left) + self.parts[k + 1].height_size(at_right);
            let rounding = T::of(4.0) * T::epsilon() * (heights + size);
            let open = closed - due;
            // What dividing by w²/(w² + c²) adds to the derivatives, times that.
            let known = (open.abs() - rounding).max(zero) * open.signum();
            let square = left.half_width().min(right.half_width()).powi(2);
            let by_width = (known + known) / width * square / (square + width * width);
            let by_limit = |i: usize| {
                let acting =
                    zero_of_p.map_or(at_ends[i], |(zero, at)| (at_ends[i] - at) / (end(i) - zero));
                acting / (T::pi() + T::pi()) * sums[i]
            };
            let by_place = by_limit(2 * k + 1).abs() + by_limit(2 * k + 2).abs();
            if by_place * width <= rounding {
                lost.get_or_insert(k);
            }
            row(open, rounding, &mut |i| {
                let widens = match i {
                    i if i == 2 * k + 1 => -by_width,
                    i if i == 2 * k + 2 => by_width,
                    _ => zero,
                };
                by_limit(i) - widens
            });
        }
    }

    /// `(1/π) ∫ w p (x - x₀)ⁱ g dx`, i from 0 to 2.
    fn powers(&self, about: T) -> [T; 3] {
        let (half, two) = (T::of(0.5), T::of(2.0));
        let mut powers = [T::zero(); 3];
        for OneOfSeveral { on, moments, .. } in self.parts() {
            let (away, half_width) = (on.centre() - about, on.half_width());
            let arm = half_width * moments.m1;
            let second = moments.m2.unwrap_or(T::zero());
            let square = half * half_width * half_width * (moments.m0 + second);
            powers[0] += moments.m0;
            powers[1] += away * moments.m0 + arm;
            powers[2] += away * (away * moments.m0 + two * arm) + square;
        }
        powers
    }

    /// NearFarSum from the contacts `p/S` is `1 + ρ₁/x + ρ₂/x²`, times 1/x without corners, with x counted from
    /// x₀: the two numbers.
    fn afar(&self, about: T) -> [T; 2] {
        let half = T::of(0.5);
        let [mut first, mut second] = [T::zero(); 2];
        let mut add = |x: T, share: T| {
            let x = x - about;
            first += share * x;
            second += share * half * x * x;
        };
        for on in self.contacts() {
            add(on.left, half);
            add(on.right, half);
        }
        self.weight.zeros().iter().for_each(|&x| add(x, -T::one()));
        let contacts = self.contacts();
        let ends = [contacts[0].left, contacts[contacts.len() - 1].right];
        for (corner, end) in self.weight.corners().into_iter().zip(ends) {
            if corner {
                add(end, -T::one());
            }
        }
        [first, second + half * first * first]
    }

    /// Whether the outermost limits are corners.
    pub fn corners(&self) -> Ends<bool> {
        self.weight.corners()
    }

    /// The load as an unknown in place of the first or the last free limit, which stays where it is: its column
    /// is the last.
    pub fn by_load(&self, side: Side, system: &mut System<T>) {
        let columns = system.residual.len();
        for (i, row) in system.jacobian.chunks_mut(columns).enumerate() {
            if side == Side::Left {
                row.rotate_left(1);
            }
            row[columns - 1] = if i == system.load_row { -T::one() } else { T::zero() };
        }
    }

    /// One more unknown, the tilt of the bodies, and one more condition, that the load acts at a place:
    ///
    /// ```text
    /// M = (1/π) ∫ w p q (x - x₀) g ds - ρ₁ F = 0        by a limit e:  (e - x₀)² V(e)/2π, with corners (e - x₀) V(e)/2π
    /// ```
    ///
    /// All conditions are linear in g, so the column of the tilt is what they are for g = 1 and a gap that
    /// rises by its width: there `V = -π p/S` off the contacts, plus π with corners.
    pub fn turning(&self, load: T, at: T, system: &mut System<T>) {
        let (zero, half) = (T::zero(), T::of(0.5));
        let corners = self.corners();
        let none = corners == Ends::both(false);
        let n = self.count;
        let hull = Interval { left: self.parts[0].on.left, right: self.parts[n - 1].on.right };
        let System { residual, open, jacobian, at_ends, over_last, .. } = system;
        let (rows, columns) = (residual.len(), jacobian.len() / residual.len());
        let zeros = self.weight.zeros().len();
        let by_tilt = |row: usize| {
            if row < zeros {
                if none { zero } else { T::pi() }
            } else if none && row == zeros {
                T::pi()
            } else if row == zeros + usize::from(none) {
                self.afar(if none { hull.plain().centre() } else { at })[0]
            } else if row + 1 == rows {
                -*over_last
            } else {
                zero
            }
        };
        for row in (0..rows).rev() {
            jacobian.insert((row + 1) * columns, by_tilt(row));
        }
        let powers = self.powers(at);
        let (borne, before, last) =
            if none { (powers[2], powers[1], powers[0]) } else { (powers[1], powers[0], zero) };
        let [first, second] = self.afar(at);
        residual.push(borne - first * load);
        let reach = (hull.left - at).abs().max((hull.right - at).abs());
        let power = if none { reach * reach } else { reach };
        let error = self.parts().iter().fold(zero, |sum, part| sum + part.moments.error);
        open.push(error * power);
        let limits = self.contacts().iter().flat_map(|on| [on.left, on.right]);
        for (i, (x, &value)) in limits.zip(&*at_ends).enumerate() {
            if i == 0 && corners.left || i + 1 == 2 * n && corners.right {
                continue;
            }
            let away = x - at;
            let acting = if none { away * away } else { away } * value / T::pi();
            jacobian.push(half * (acting + away * last + before - load));
        }
        jacobian.push(second);
    }

    /// The slope of the gap around a contact.
    pub fn panel_set(&self, contact: usize) -> &PanelSet<T> {
        &self.parts[contact].panel_set
    }

    /// The height of the gap between the unloaded bodies at a limit of a contact.
    pub fn height(&self, contact: usize, side: Side) -> T {
        let part = &self.parts[contact];
        part.height(part.on[side])
    }

    /// The number of the contact in which a place lies.
    fn contact_with(&self, x: T) -> Option<usize> {
        let i = self.parts().partition_point(|part| part.on.right <= x);
        self.parts().get(i).filter(|part| part.on.contains(x)).map(|_| i)
    }

    /// `P/κ`, zero in the gaps between the contacts.
    pub fn pressures(&self, x: &[T], pressures: &mut [T]) {
        let mut done = 0;
        while done < x.len() {
            let contact = self.contact_with(x[done]);
            let mut lanes = [x[done]; LANES];
            let alike = |&&x: &&T| self.contact_with(x) == contact;
            let count = x[done..].iter().take(LANES).take_while(alike).count();
            lanes[..count].copy_from_slice(&x[done..done + count]);
            let out = &mut pressures[done..done + count];
            match contact {
                None => out.fill(T::zero()),
                Some(i) => {
                    let part = &self.parts[i];
                    let (own, root) = part.inside(&lanes, count);
                    for (lane, pressure) in out.iter_mut().enumerate() {
                        let x = lanes[lane];
                        let others = part.value.near.clone().filter(|&k| k != i);
                        let others =
                            self.outside(others, x, None) + part.value.far(x, self.constant);
                        let weight = self.weight.near(i, part.weight.near.clone(), x)
                            * part.weight.far(x, T::one());
                        *pressure =
                            (own[lane] + root[lane] * others) / (T::pi() * T::pi() * weight);
                    }
                }
            }
            done += count;
        }
    }

    /// Estimated error of `P/κ` at a place in one of the contacts.
    pub fn error(&self, x: T) -> T {
        let Some(i) = self.contact_with(x) else { return T::zero() };
        let (part, sixth) = (&self.parts[i], T::of(6.0));
        // An error of the edge integrals is one of what is infinite at the edges; the other contacts'
        // add to it.
        let others = self.parts().iter().enumerate().filter(|&(k, _)| k != i);
        let by_others = others.fold(T::zero(), |sum, (_, other)| {
            let away = (other.on.left - x).max(x - other.on.right);
            sum + other.moments.error / away
        });
        let root = part.on.chebyshev_weight(x);
        let of_edges = sixth * T::pi() * part.on.half_width() * part.moments.error / root;
        let scale = T::pi() * T::pi() * self.weight.on_contact(i, x).abs();
        (part.error(x) + of_edges + T::pi() * root * by_others) / scale
    }

    /// The strength `K/κ` of the singularity at a corner, `P ≈ K/sin θ`; zero at a free limit.
    pub fn strength(&self, side: Side) -> T {
        if !self.weight.corners()[side] {
            return T::zero();
        }
        let (i, sign) = match side {
            Side::Left => (0, T::of(2.0)),
            Side::Right => (self.count - 1, -T::of(2.0)),
        };
        let (part, corner) = (&self.parts[i], self.parts[i].on[side]);
        let value = part.at_end(side) + self.outside(self.others(i), corner, None);
        sign * value / (T::pi() * T::pi() * self.weight.beside_corner(side))
    }
}
