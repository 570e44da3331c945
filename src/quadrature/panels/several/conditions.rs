//! The conditions on the limits of several contacts, and their changes in a step.

use super::Several;
use super::one_of_several::OneOfSeveral;
use super::system::{Besides, System};
use super::terms::Terms;
use crate::numerics::FarField;
use crate::numerics::gauss_legendre::GaussLegendre;
use crate::{Interval, Real, Side};

/// Longest span in a gap for one Gauss rule, in the variable t of `x = β + 2 L sinh²(t/2)`: the
/// next singularity lies at least a third as far beyond its end. Sixteen nodes leave an error of
/// 3⁻³², and the eight of a trial 3⁻¹⁶.
const MAX_GAUSS_SPAN: f64 = 2.0;

/// Limit on the number of such spans: more than any gap and contact of finite widths have.
const MAX_STRETCHES: usize = 1000;

impl<T: Real> Several<T> {
    /// Sets the load, given as F/κ, and the residues at the poles of p.
    pub fn carry(&mut self, load: T, residues: &[T]) {
        self.terms = self.weight.terms(load, residues);
    }

    /// Sets up the conditions for a load, given as F/κ.
    pub fn system(&self, load: T, system: &mut System<T>) {
        (system.lost, system.besides) = (None, None);
        system.free.clear();
        let is_free = |i: &usize| !self.held()[i / 2][Side::BOTH[i % 2]];
        system.free.extend((0..2 * self.parts.len()).filter(is_free));
        let contacts = self.contacts();
        let gap = |pair: &[Interval<T>]| Interval { left: pair[0].right, right: pair[1].left };
        let part = |k: usize, x: T| self.parts[k].seen_from(x);
        system.far.set(contacts, contacts.windows(2).map(gap), self.weight.far.is_coarse, &part);
        let System { residual, open, limits, at_ends, slopes, rows, poles, by_tilt, .. } = system;
        let [at, squares] = [&mut poles.at, &mut poles.squares];
        for known in [residual, open, limits, at_ends, slopes, rows, at, squares, by_tilt] {
            known.clear();
        }
        poles.of_p.clear();
        for (i, on) in contacts.iter().enumerate() {
            for side in Side::BOTH {
                let (x, weight) = (on[side], self.weight.on_contact(i, [on[side]])[0]);
                let size = self.at_end(&system.far, i, side).abs();
                system.limits.push(x);
                system.at_ends.push(size * weight.signum());
                system.slopes.push((x - on[side.other()]) / (weight * weight));
            }
        }
        self.balance(load, system);
        for k in 0..self.parts.len() - 1 {
            self.close(k, system);
        }
    }

    /// Returns V at a place in a gap; near contact `near`, given the distance from it.
    fn in_gap(&self, far: &FarField<T>, k: usize, x: T, near: Option<(usize, T)>) -> T {
        self.outside(far.near(k), x, near) + far.far(k, [x])[0]
    }

    /// Returns V at a limit, without its infinite part.
    fn at_end(&self, far: &FarField<T>, contact: usize, side: Side) -> T {
        let gap = match side {
            Side::Left => contact.checked_sub(1),
            Side::Right => Some(contact).filter(|k| k + 1 < self.parts.len()),
        };
        let Some(k) = gap else { return self.at_end_by_each(contact, side) };
        let (part, others) = (&self.parts[contact], far.near(k).filter(|&i| i != contact));
        let x = part.on[side];
        let integrals = part.at_end(side) + self.outside(others, x, None) + far.far(k, [x])[0];
        integrals + self.terms.at(x)
    }

    /// Adds the poles of the step, the balance conditions and the load condition.
    fn balance(&self, load: T, system: &mut System<T>) {
        let (zero, one, per_pi) = (T::zero(), T::one(), -T::frac_1_pi());
        let (inverse, free) = (self.weight.is_inverse(), self.weight.corners() == 0);
        let square = |(k, x): (usize, T)| {
            let ends = [x - self.parts[k].on.right, self.parts[k + 1].on.left - x];
            self.weight.in_gap(k, x, ends).powi(2)
        };
        system.poles.of_p.extend(self.weight.poles().map(|pole| [pole.1, square(pole)]));
        for (k, x) in self.weight.zeros() {
            system.poles.at.push(x);
            system.poles.squares.push(square((k, x)));
            let share = |on: Interval<T>| one / (x - on.right).abs().min((x - on.left).abs());
            let value = self.in_gap(&system.far, k, x, None) + self.terms.at(x);
            system.add(value, self.moments_error(share));
        }
        system.poles.at.extend(self.weight.held_limits());
        system.poles.squares.resize(system.poles.at.len(), zero);
        let centre = self.hull().plain().centre();
        system.poles.centre = free.then_some(centre);
        system.polynomial = self.polynomial(centre);
        let (total, n) = (self.sum(|part| part.moments.m0), system.poles.count());
        system.load_row = system.residual.len();
        if inverse {
            self.bear_by_terms(centre, system);
            return;
        }
        system.rows.resize(n, if free { zero } else { per_pi });
        system.rows.resize(2 * n, zero);
        let by_terms = self.terms.residues(centre, 0) * per_pi;
        let (mut borne, mut error) = (total + by_terms, self.moments_error(|_| one));
        if let Some(centre) = system.poles.centre {
            system.add(T::pi() * total, error);
            system.rows[n - 1] = per_pi;
            system.rows[2 * n - 1] = T::of(2.0) * self.afar(&system.poles.at, centre)[0] * per_pi;
            borne = self.powers(centre)[0];
            error =
                self.moments_error(|on| (on.left - centre).abs().max((on.right - centre).abs()));
            system.load_row += 1;
        }
        system.add(borne - load, error * T::frac_1_pi());
        self.vanish_at_poles(system);
    }

    /// Adds the conditions on the constants with more corners than contacts. The constant of V
    /// bears the load.
    fn bear_by_terms(&self, about: T, system: &mut System<T>) {
        let (zero, one, per_pi) = (T::zero(), T::one(), T::frac_1_pi());
        let System { poles, rows, .. } = &mut *system;
        rows.extend(poles.at.iter().map(|&at| (about - at) * per_pi));
        rows.extend(poles.squares.iter().map(|&square| square * per_pi));
        rows.resize(rows.len() + poles.count(), one);
        rows.resize(rows.len() + poles.count(), zero);
        for _ in 0..2 {
            system.add(zero, zero);
        }
        self.vanish_at_poles(system);
    }

    /// Adds the conditions that Q vanishes at the poles of p.
    fn vanish_at_poles(&self, system: &mut System<T>) {
        for i in 0..system.poles.of_p.len() {
            let System { poles, rows, .. } = &mut *system;
            let first = rows.len();
            rows.resize(first + 2 * poles.count(), T::zero());
            poles.add(poles.of_p[i][0], T::one(), &mut rows[first..]);
            system.add(T::zero(), T::zero());
        }
    }

    /// Returns the polynomial part of `p/S` far away, with the poles of p: the part of V by a tilt
    /// that is no `p/S`. `about` is near the contacts.
    fn polynomial(&self, about: T) -> Terms<T> {
        let (zero, one) = (T::zero(), T::one());
        let residue = |(k, x): (usize, T)| {
            let ends = [x - self.parts[k].on.right, self.parts[k + 1].on.left - x];
            (k, x, one / self.weight.in_gap(k, x, ends))
        };
        let poles = self.weight.poles().map(residue).collect();
        let by_power = match (self.weight.is_inverse(), self.weight.corners()) {
            (true, _) => {
                let zeros = self.weight.zeros().map(|(_, zero)| zero);
                let at: Vec<_> = zeros.chain(self.weight.held_limits()).collect();
                [self.afar(&at, about)[0], one]
            }
            (false, 0) => [zero; 2],
            (false, _) => [one, zero],
        };
        Terms { about, by_power, poles }
    }

    /// Adds the condition that a gap closes at both ends.
    fn close(&self, k: usize, system: &mut System<T>) {
        let (zero, pi) = (T::zero(), T::pi());
        let (own, pole) = (self.weight.zero(k), self.weight.pole(k));
        let [mut closed, mut size, mut by_tilt, mut by_own] = [zero; 4];
        // The integrals ∫ S/p_k dx/(x - e) for the two limits at the ends.
        let mut by_ends = [zero; 2];
        let mut row = std::mem::take(&mut system.row);
        row.clear();
        row.resize(2 * system.poles.count(), zero);
        self.through_gap(k, &system.far, |x, [from_left, to_right], value, root, dx| {
            let scale = root * dx;
            let share = scale * self.without_zero(k, system, x, value);
            closed -= share / pi;
            size += share.abs() / pi;
            by_ends[0] += scale / from_left;
            by_ends[1] -= scale / to_right;
            let away = own.map_or(T::one(), |(_, own)| x - own);
            let by_constants = -away * dx / (root * pi);
            if let Some(pole) = pole {
                // Q vanishes there.
                let by_constants = by_constants / (x - pole);
                system.poles.add(x, by_constants, &mut row);
                system.poles.add(pole, -by_constants, &mut row);
            } else {
                system.poles.add(x, by_constants, &mut row);
            }
            by_tilt -= scale
                * match own {
                    Some((_, zero)) => {
                        by_own -= scale / (away * pi);
                        system.polynomial.chord([zero, x])
                    }
                    None => system.polynomial.in_gap(k, x),
                };
        });
        if let Some((zero, _)) = own {
            row[system.poles.count() + zero] += by_own;
        }
        system.by_tilt.push(by_tilt);
        self.compare_heights(k, [closed, size], by_ends, &mut row, system);
        system.rows.extend_from_slice(&row);
        system.row = row;
    }

    /// Adds the residual of a gap, divided as by its width, given the rise by the pressure, the
    /// size of its terms, and the integrals for the limits at its ends.
    fn compare_heights(
        &self,
        k: usize,
        [closed, size]: [T; 2],
        by_ends: [T; 2],
        row: &mut [T],
        system: &mut System<T>,
    ) {
        let [left, right] = [&self.parts[k], &self.parts[k + 1]];
        let width = right.on.left - left.on.right;
        let is_free = [!self.held()[k].right, !self.held()[k + 1].left];
        let [from, to] = [left.height(left.on.right), right.height(right.on.left)];
        let heights = left.height_size(from) + right.height_size(to);
        let rounding = T::of(4.0) * T::epsilon() * (heights + size);
        let open = closed - (to - from);
        // Term that dividing by w²/(w² + c²) adds to the derivatives, times that divisor.
        let known = (open.abs() - rounding).max(T::zero()) * open.signum();
        let square = left.on.half_width().min(right.on.half_width()).powi(2);
        let by_width = (known + known) / width * square / (square + width * width);
        let mut by_limits = T::zero();
        for (end, sign) in [(0, T::one()), (1, -T::one())].into_iter().filter(|e| is_free[e.0]) {
            let i = 2 * k + 1 + end;
            let away = match (self.weight.zero(k), self.weight.pole(k)) {
                (Some((_, zero)), _) => system.limits[i] - zero,
                (_, Some(pole)) => T::one() / (system.limits[i] - pole),
                _ => T::one(),
            };
            by_limits += (system.at_ends[i] / away / T::two_pi() * by_ends[end]).abs();
            let share = -(by_width + by_width) / (system.slopes[i] * system.at_ends[i]);
            system.poles.add(system.limits[i], sign * share, row);
        }
        if is_free.contains(&true) && by_limits * width <= rounding {
            system.lost.get_or_insert(k);
        }
        system.add(open, rounding);
    }

    /// Shows the nodes of rules from both ends of a gap to its middle: the place, its distances to
    /// the ends, V, `S/p` without the zero of p, and dx.
    fn through_gap(&self, k: usize, far: &FarField<T>, mut show: impl FnMut(T, [T; 2], T, T, T)) {
        let (one, half) = (T::one(), T::of(0.5));
        let rule = if far.is_coarse { GaussLegendre::coarsest() } else { GaussLegendre::sixteen() };
        let [left, right] = [k, k + 1].map(|i| self.parts[i].on);
        let width = right.left - left.right;
        for (near, on, edge, sign) in [(k, left, left.right, one), (k + 1, right, right.left, -one)]
        {
            // Half the gap.
            let last = T::of(2.0) * (width / (T::of(4.0) * on.half_width())).sqrt().asinh();
            let side = if near == k { Side::Right } else { Side::Left };
            // A singularity of the slope as near as this is one of Φ, at ±i times its t.
            let wall = self.parts[near].wall(side);
            let mut longest = match wall {
                Some(wall) => T::of(2.0) * (wall / (T::of(4.0) * on.half_width())).sqrt().asinh(),
                None => T::of(MAX_GAUSS_SPAN),
            };
            let mut start = T::zero();
            while last - start > T::of(8.0) * T::epsilon() * last {
                let rest = last - start;
                let pieces =
                    (1..MAX_STRETCHES).find(|&n| longest * T::count(n) >= rest).unwrap_or(1);
                let step = if wall.is_some() { rest.min(longest) } else { rest / T::count(pieces) };
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
                    show(x, distances, value, self.weight.in_gap(k, x, distances), dx);
                }
                start += step;
                longest = (start + start).max(longest).min(T::of(MAX_GAUSS_SPAN));
            }
        }
    }

    /// Returns `V_k`, given the integrals of V: V minus its value at the zero of p in gap k,
    /// divided by the distance from that zero; V times the distance from a pole of p; or V itself.
    pub(super) fn without_zero(&self, k: usize, system: &System<T>, x: T, value: T) -> T {
        if let Some((i, zero)) = self.weight.zero(k) {
            return (value + self.terms.at(x) - system.residual[i]) / (x - zero);
        }
        let away = self.weight.pole(k).map_or(T::one(), |pole| x - pole);
        value * away + self.terms.in_gap(k, x)
    }

    /// Returns π times the sum of the errors of all moments, each times its share.
    fn moments_error(&self, share: impl Fn(Interval<T>) -> T) -> T {
        T::pi() * self.sum(|part| part.moments.error * share(part.on))
    }

    fn sum(&self, of: impl Fn(&OneOfSeveral<T>) -> T) -> T {
        self.parts.iter().fold(T::zero(), |sum, part| sum + of(part))
    }

    /// Returns the interval from the first limit to the last.
    fn hull(&self) -> Interval<T> {
        Interval { left: self.parts[0].on.left, right: self.parts[self.parts.len() - 1].on.right }
    }

    /// Returns `(1/π) ∫ w p (x - x₀)ⁱ g dx` for i = 1 and 2.
    fn powers(&self, about: T) -> [T; 2] {
        let (half, two) = (T::of(0.5), T::of(2.0));
        let mut powers = [T::zero(); 2];
        for OneOfSeveral { on, moments, .. } in &self.parts {
            let (away, half_width) = (on.centre() - about, on.half_width());
            let arm = half_width * moments.m1;
            let second = moments.m2.unwrap_or(T::zero());
            let square = half * half_width * half_width * (moments.m0 + second);
            powers[0] += away * moments.m0 + arm;
            powers[1] += away * (away * moments.m0 + two * arm) + square;
        }
        powers
    }

    /// Returns ρ₁ and ρ₂, given the poles of a step: far from the contacts `p/S` is
    /// `1 + ρ₁/x + ρ₂/x²`, times 1/x without corners, with x counted from x₀.
    fn afar(&self, poles: &[T], about: T) -> [T; 2] {
        let half = T::of(0.5);
        let limits = self.contacts().iter().flat_map(|on| [(on.left, half), (on.right, half)]);
        let all = limits.chain(poles.iter().map(|&x| (x, -T::one())));
        let all = all.chain(self.weight.poles().map(|(_, x)| (x, T::one())));
        let [first, second] = all.fold([T::zero(); 2], |[first, second], (x, share)| {
            let x = x - about;
            [first + share * x, second + share * half * x * x]
        });
        [first, second + half * first * first]
    }

    /// Makes the load an unknown. The condition for it: the first or the last free limit stays
    /// where it is.
    pub fn by_load(&self, side: Side, system: &mut System<T>) {
        let [zero, one] = [T::zero(), T::one()];
        let mut others = vec![zero; system.residual.len()];
        others[system.load_row] = -one;
        let mut by_limits = vec![zero; system.free.len() + system.poles.of_p.len()];
        let last = system.free.len() - 1;
        by_limits[if side == Side::Left { 0 } else { last }] = one;
        system.besides = Some(Besides { by_limits, by_unknown: zero, others });
    }

    /// Adds one unknown, the tilt of the bodies, and one condition: the load acts at a given place.
    ///
    /// ```text
    /// M = (1/π) ∫ w p q (x - x₀) g ds - ρ₁ F = 0
    /// with corners (1/π) ∫ w p (x - x₀) g ds + Σ c (μ - x₀) - ρ₁ F
    /// with more corners than contacts (1/π) ∫ w p g ds + Σ c - ρ₁ F
    /// by a limit e: (e - x₀)² V(e)/2π, with corners (e - x₀) V(e)/2π, with more V(e)/2π
    /// ```
    ///
    /// All conditions are linear in g, so their derivatives by the tilt are their values for g = 1
    /// and a gap that rises by its width: there `V = -π p/S` off the contacts, plus π times the
    /// [polynomial](Self::polynomial).
    pub fn turning(&self, load: T, at: T, system: &mut System<T>) {
        let (zero, half, pi) = (T::zero(), T::of(0.5), T::pi());
        let (centre, inverse) = (self.hull().plain().centre(), self.weight.is_inverse());
        let mut others = vec![zero; system.residual.len()];
        let gaps = others.len() - system.by_tilt.len();
        others[gaps..].copy_from_slice(&system.by_tilt);
        let no_corners = self.weight.corners() == 0;
        let zeros = system.load_row - usize::from(no_corners);
        let by_zeros = self.weight.zeros().map(|(_, x)| pi * system.polynomial.at(x));
        others.iter_mut().zip(by_zeros).for_each(|(other, by)| *other = by);
        if no_corners {
            others[zeros] = pi;
        }
        if !inverse {
            let by_terms = system.polynomial.residues(centre, 0);
            others[system.load_row] = self.afar(&system.poles.at, centre)[0] - by_terms;
        }
        let [first, mut by_unknown] = self.afar(&system.poles.at, at);
        let mut borne = match inverse {
            true => self.sum(|part| part.moments.m0),
            false => self.powers(at)[usize::from(no_corners)],
        };
        let power = if no_corners { 2 } else { 1 - i32::from(inverse) };
        borne -= self.terms.residues(at, power) * T::frac_1_pi();
        by_unknown -= system.polynomial.residues(at, power);
        let reach = (self.hull().left - at).abs().max((self.hull().right - at).abs());
        let error = self.sum(|part| part.moments.error) * reach.powi(power);
        system.add(borne - first * load, error);
        let by_limit = |&i: &usize| {
            let away = system.limits[i] - at;
            half * away.powi(power) * system.at_ends[i] / pi
        };
        let mut by_limits: Vec<_> = system.free.iter().map(by_limit).collect();
        by_limits.extend(system.poles.of_p.iter().map(|&[x, _]| (x - at).powi(power)));
        system.besides = Some(Besides { by_limits, by_unknown, others });
    }
}
