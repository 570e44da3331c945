//! Limits held at corners.
//!
//! A corner is an end of the bodies that is declared one, or a breakpoint inside them beyond which
//! the gap opens steeply: its slope jumps up, or rises over a short wall. With a limit held at a
//! corner z the pressure there is `P ≈ K'/√(distance)`, with `K' = K √(L/2)`. One rule holds for
//! all:
//!
//! | limit | next |
//! |---|---|
//! | free, next to a corner, or beyond one at an end | held there |
//! | free, beyond a corner by hardly more than x is known | held there |
//! | held, and nothing found, or contacts that vanish or meet | let go, where it was |
//! | held, K < 0 | let go inward, to about where P = 0, the lowest first |
//! | held, K > 0, inside the bodies | put beyond the corner by d, the furthest first |
//! | held, K > 0, d/L less than the rounding of x over d | held: d is the error of the limit |
//!
//! The last two are one contact. It ends where the slope s outside, above that at z, makes up for
//! the pressure of the held one, to first order in d/L:
//!
//! ```text
//! π² K'/κ = ∫ s(t) dt/√(d - t) from 0 to d,      for a jump j  d = (π² K'/(2 κ j))²
//! ```

use super::super::newton::several::{NewtonSeveral, put};
use super::{Given, Search, Workspace};
use crate::gap::Sampler;
use crate::numerics::gauss_legendre::GaussLegendre;
use crate::solution::{ContactState, Solved};
use crate::{Edge, Ends, Fallible, Interval, Pressure, Real, Side};

/// Largest distance of a limit from a corner that may hold it, as a share of the half-width: that
/// of limits by cells.
const NEAR_CORNER: f64 = 0.2;

/// Largest d, as a share of the half-width, by the pressure of a flat, for which a corner is tried:
/// beyond, the limit finds its place by itself.
const SHARP: f64 = 0.1;

/// Distance beyond a corner within which the gap opens so far, as a share of the half-width.
const SHORT_WALL: f64 = 1e-4;

/// Share of a contact's half-width by which a limit leaves a corner inward at most; and from which,
/// or from the width of the gap there, one found free is sought as free in the next set, too.
const STEP_INWARD: f64 = 0.01;

/// Least ratio of distances d that are let go together.
const TOGETHER: f64 = 0.01;

/// Doublings of √d from its least value, and halvings of its logarithm after them: a start.
const MAX_ROOT_DOUBLINGS: usize = 40;
const HALVINGS: usize = 5;

/// Limit at a corner that holds it: the contact, the side, and the strength of the singularity.
type Held<T> = (usize, Side, T);

/// Breakpoint on one side of a contact, with the slope of the gap on its inner side.
#[derive(Clone, Copy)]
struct Corner<T> {
    z: T,
    side: Side,
    slope: T,
}

impl<T: Real> Search<'_, '_, '_, T> {
    /// Returns the conditions at the ends of the bodies for the contacts at hand: a corner is known
    /// to press only from the contacts found without it, but a contact alone is not checked
    /// otherwise.
    pub(super) fn edges(&self) -> Ends<Edge<T>> {
        let edges = self.conditions.edges;
        if self.is_of_one() { edges } else { edges.map(Edge::let_go) }
    }

    /// Returns the conditions at the edges of the only contact.
    pub(super) fn edges_of_one(&self) -> Ends<Edge<T>> {
        let (edges, ends) = (self.edges(), self.contact.ends());
        let NewtonSeveral { on, held, .. } = &self.work.workspace.newton;
        Ends::from_fn(|side| {
            let limit = on.first().map_or(ends[side], |on| on[side]);
            if held[0][side] { Edge::Fixed(limit) } else { edges[side] }
        })
    }

    /// Holds the limits at hand that are at an end of the bodies, or next to a corner inside them.
    /// A contact whose place is not known is held at both ends. Tells whether limits may be held at
    /// all.
    pub(super) fn hold(&mut self) -> Fallible<T, bool> {
        let (ends, conditions, is_of_one) =
            (self.contact.ends(), self.conditions, self.is_of_one());
        let at_corner = self.edges().map(|edge| matches!(edge, Edge::FreeUntil(_)));
        let by_load = !matches!(conditions.given, Given::HalfWidth(_));
        let Workspace { newton: NewtonSeveral { on, held, .. }, before, .. } =
            &mut *self.work.workspace;
        held.clear();
        if is_of_one && at_corner == Ends::both(false) {
            return Ok(self.contact.gap.breakpoint_after(ends.left).is_some());
        }
        before.clone_from(on);
        held.resize(on.len().max(1), Ends::both(false));
        let (last, mut is_held) = (held.len() - 1, false);
        let outermost = |side| if side == Side::Left { 0 } else { last };
        for side in Side::BOTH {
            let reaches = match (side, on.first(), on.last()) {
                (Side::Left, Some(on), _) => on.left <= ends.left,
                (Side::Right, _, Some(on)) => on.right >= ends.right,
                _ => by_load,
            };
            // A given width cannot be held at both.
            if at_corner[side] && self.end != Some(side) && reaches && (by_load || !is_held) {
                is_held = true;
                held[outermost(side)][side] = true;
                if !on.is_empty() {
                    put(on, side, ends[side]);
                }
            }
        }
        if is_of_one {
            return Ok(true);
        }
        let sum = |sum: T, on: &Interval<T>| sum + on.half_width();
        let all = on.iter().fold(T::zero(), sum);
        let (mean, width) = (conditions.load() / conditions.kappa / all, all / T::count(on.len()));
        for i in 0..on.len() {
            for side in Side::BOTH {
                // The load is sought under which this limit is at the end.
                if self.end == Some(side) && i == outermost(side) {
                    continue;
                }
                let on = self.work.workspace.newton.on[i];
                // A contact narrower than the others, as one just born, bears less.
                let share = on.half_width() / width;
                let corner = self.corner_next_to(i, side, mean * share.min(T::one()))?;
                // Beside other contacts, a limit found free is about where it was.
                let step = T::of(STEP_INWARD) * on.half_width();
                let gap = self.next_limit(i, side).map_or(step, |next| (next - on[side]).abs());
                let away = |z: T| (on[side] - z).abs() > gap.min(step);
                let is_free = |&z: &T| away(z) && self.free.contains(&on[side]);
                if let Some(z) = corner.filter(|z| !is_free(z)) {
                    self.hold_at(i, side, z);
                }
            }
        }
        Ok(true)
    }

    /// Holds a limit at a corner.
    fn hold_at(&mut self, contact: usize, side: Side, z: T) {
        let NewtonSeveral { on, held, .. } = &mut self.work.workspace.newton;
        put(&mut on[contact..=contact], side, z);
        held[contact][side] = true;
    }

    /// Holds the limits that have passed a corner inside the bodies by less than x is known, and
    /// those of an only contact beyond a corner at an end; tells whether there are any, and notes
    /// them in `passed`.
    pub(super) fn passes(
        &mut self,
        found: &ContactState<T>,
        passed: &mut Vec<(usize, Side)>,
    ) -> Fallible<T, bool> {
        let (edges, count) = (self.edges(), self.work.workspace.newton.on.len());
        let mut any = false;
        for at @ (i, side) in (0..count).flat_map(|i| Side::BOTH.map(|side| (i, side))) {
            let NewtonSeveral { on, held, .. } = &self.work.workspace.newton;
            let (on, is_held) = (on[i], held.get(i).is_some_and(|held| held[side]));
            let least = |z: T| T::of(8.0) * T::epsilon() * (z.abs() + on.half_width());
            let is_beyond = |z: T| outward::<T>(side) * (on[side] - z) > least(z);
            let z = match edges[side] {
                Edge::FreeUntil(z) if count == 1 && is_beyond(z) => Some(z),
                Edge::FreeUntil(_) | Edge::Free if !is_held && !passed.contains(&at) => {
                    self.corner_untold(at, found.load)?
                }
                _ => None,
            };
            if let Some(z) = z {
                let Workspace { newton, before, .. } = &mut *self.work.workspace;
                if !any {
                    before.clone_from(&newton.on);
                    newton.held.resize(count, Ends::both(false));
                }
                self.hold_at(i, side, z);
                passed.push(at);
                any = true;
            }
        }
        Ok(any)
    }

    /// Returns the corner inside the bodies that a limit found is at, to less than x is known: its
    /// rounding, or its error, changes the pressure there by more than ε^(1/3), to hold the limit
    /// by less than ε^(2/3).
    fn corner_untold(&mut self, (i, side): (usize, Side), load: T) -> Fallible<T, Option<T>> {
        let NewtonSeveral { on: all, errors, .. } = &self.work.workspace.newton;
        let (x, half_width, outward) = (all[i][side], all[i].half_width(), outward::<T>(side));
        let error = if all.len() > 1 { errors[2 * i + side as usize] } else { T::zero() };
        let sum = all.iter().fold(T::zero(), |sum, on| sum + on.half_width());
        let mean = load / self.contact.kappa / sum;
        let near = ((T::epsilon() * x.abs() + error * half_width).powi(2) * half_width).cbrt();
        let corners = self.breakpoints(x - outward * near, x + outward * near);
        let Some(&z) = corners.first() else { return Ok(None) };
        let corner = self.corner(z, side)?;
        let rise = self.steepest_beyond(&corner, T::of(SHORT_WALL) * half_width)?;
        Ok((rise > least_rise(mean)).then_some(z))
    }

    /// Returns the corner inside the bodies next to a limit of a contact, if there is one. `mean`
    /// is `F/(κ L)`.
    fn corner_next_to(&mut self, i: usize, side: Side, mean: T) -> Fallible<T, Option<T>> {
        let (on, outward) = (self.work.workspace.newton.on[i], outward::<T>(side));
        let (x, near) = (on[side], T::of(NEAR_CORNER) * on.half_width());
        let inside = on[side.other()];
        let free = self.next_limit(i, side).map_or(near, |next| near.min((next - x).abs()));
        let mut corners = self.breakpoints(x - outward * near, x + outward * free);
        corners.retain(|&z| outward * (z - inside) > T::zero());
        let reach = T::of(SHORT_WALL) * on.half_width();
        for z in corners {
            let corner = self.corner(z, side)?;
            if outward * (z - x) > T::zero() {
                // Beyond a hollow corner the limit does not get.
                let rise = outward * (corner.slope - self.corner(x, side)?.slope);
                if rise < -least_rise(mean) {
                    break;
                }
            }
            if self.steepest_beyond(&corner, reach)? > least_rise(mean) {
                return Ok(Some(z));
            }
        }
        Ok(None)
    }

    /// Parts the contacts of cells at slits, which cells do not see.
    pub(super) fn parted_at_slits(
        &mut self,
        on: Vec<Interval<T>>,
    ) -> Fallible<T, Vec<Interval<T>>> {
        let all = on.iter().fold(T::zero(), |sum, on| sum + on.half_width());
        let least = least_rise(self.conditions.load() / self.contact.kappa / all);
        let mut parted = Vec::with_capacity(on.len());
        for mut on in on {
            let (narrow, mut from) = (T::of(NEAR_CORNER) * on.half_width(), None);
            for z in self.breakpoints(on.left, on.right) {
                if self.contact.gap.jump(z)[0] <= least {
                    continue;
                }
                // The foot of the wall is no end.
                let mut ends = [false; 2];
                for side in Side::BOTH {
                    ends[side as usize] = outward::<T>(side) * self.corner(z, side)?.slope > -least;
                }
                if let Some(end) = from.filter(|&from| ends[0] && z - from <= narrow) {
                    parted.push(Interval { right: end, ..on });
                    (on.left, from) = (z, None);
                }
                from = if ends[1] { Some(z) } else { from };
            }
            parted.push(on);
        }
        Ok(parted)
    }

    /// Returns the limit of the next contact on a side.
    fn next_limit(&self, contact: usize, side: Side) -> Option<T> {
        let on = &self.work.workspace.newton.on;
        match side {
            Side::Left => contact.checked_sub(1).map(|next| on[next].right),
            Side::Right => on.get(contact + 1).map(|next| next.left),
        }
    }

    /// Lists the breakpoints from one place to another.
    fn breakpoints(&self, from: T, to: T) -> Vec<T> {
        let on = Interval { left: from.min(to), right: from.max(to) };
        let mut breakpoints: Vec<T> = self.contact.gap.breakpoints(on).collect();
        if to < from {
            breakpoints.reverse();
        }
        breakpoints
    }

    /// Tells whether a limit may end at a corner inside the bodies.
    pub(super) fn has_corners(&mut self) -> Fallible<T, bool> {
        let ends = self.contact.ends();
        let width = ends.right - ends.left;
        let mean = self.conditions.load() / self.contact.kappa / width;
        let reach = T::of(0.5 * SHORT_WALL) * width;
        for side in Side::BOTH {
            for z in self.breakpoints(ends[side.other()], ends[side]) {
                let corner = self.corner(z, side)?;
                if self.steepest_beyond(&corner, reach)? > least_rise(mean) {
                    return Ok(true);
                }
            }
        }
        Ok(false)
    }

    /// Returns a breakpoint, or a limit, with the slope on its inner side.
    fn corner(&mut self, z: T, side: Side) -> Fallible<T, Corner<T>> {
        let mut sampler = Sampler::default();
        let slope = sampler.slope_from(&self.contact.gap, z, side.other())?;
        self.work.cost.heights += sampler.cost.evaluations;
        Ok(Corner { z, side, slope })
    }

    /// Returns the steepest slope, outward, up to a distance beyond a breakpoint, above the slope
    /// inside: at the ends of the pieces there.
    fn steepest_beyond(&mut self, corner: &Corner<T>, reach: T) -> Fallible<T, T> {
        let &Corner { z, side, .. } = corner;
        let ends = self.breakpoints(z, z + outward::<T>(side) * reach);
        let away: Vec<T> = ends.iter().map(|&x| (x - z).abs()).chain([reach]).collect();
        let rises = self.rise_beyond(corner, &away)?;
        Ok(rises.into_iter().fold(self.contact.gap.jump(z)[0], T::max))
    }

    /// Returns the slopes, outward, at some distances beyond a corner, above the slope inside.
    fn rise_beyond(
        &mut self,
        &Corner { z, side, slope }: &Corner<T>,
        away: &[T],
    ) -> Fallible<T, Vec<T>> {
        let (gap, mut sampler) = (&self.contact.gap, Sampler::default());
        let [from, to] = gap.range();
        let outward: T = outward(side);
        let slopes = away.iter().map(|&away| {
            let x = (z + outward * away).max(from).min(to);
            Ok(outward * (sampler.slope_from(gap, x, side.other())? - slope))
        });
        let slopes = slopes.collect();
        self.work.cost.heights += sampler.cost.evaluations;
        slopes
    }

    /// Lets go of corners that do not hold the contacts found; tells whether there are any.
    /// Otherwise adds the error of the limits that stay held.
    pub(super) fn lets_go(&mut self, found: &mut ContactState<T>) -> Fallible<T, bool> {
        if !self.work.workspace.newton.held.iter().any(|held| *held != Ends::both(false)) {
            return Ok(false);
        }
        let held = self.strengths(found);
        let lower = |one: Held<T>, other: Held<T>| if other.2 < one.2 { other } else { one };
        let lowest = held.iter().copied().reduce(lower);
        if let Some((contact, side, _)) = lowest.filter(|held| held.2 < T::zero()) {
            let inward = -self.retreat(found, contact, side)?;
            self.let_go(contact, side, inward);
            return Ok(true);
        }
        let ends = self.contact.ends();
        let mut beyond = Vec::new();
        let mut error = T::zero();
        for (contact, side, strength) in held {
            let on = self.work.workspace.newton.on[contact];
            let (z, half_width) = (on[side], on.half_width());
            if z == ends[side] {
                continue;
            }
            let d = self.beyond(contact, side, strength)?;
            // The rounding of x changes the pressure by a share ε x/(2 d).
            let rounding = T::epsilon() * z.abs().max(half_width);
            if d.abs() > (rounding * half_width).sqrt() {
                beyond.push((contact, side, d));
            } else {
                // A distance that is no number leaves the contact doubtful.
                error += (d + d).abs() / half_width;
            }
        }
        // A step that is small for a wide contact moves a narrow one next to it far.
        let most = beyond.iter().fold(T::zero(), |most, &(.., d)| most.max(d.abs()));
        for &(contact, side, d) in &beyond {
            if d.abs() >= T::of(TOGETHER) * most {
                self.let_go(contact, side, d);
            }
        }
        // An error of zero is that of corners at the ends.
        if !error.is_zero() {
            found.error = Some(found.error.unwrap_or(T::zero()) + error);
        }
        Ok(!beyond.is_empty())
    }

    /// Returns the distance inward from a corner that pulls to where the pressure turns positive,
    /// within a factor of four. Next to a slit it is far less than the width of the contact.
    fn retreat(&mut self, found: &ContactState<T>, contact: usize, side: Side) -> Fallible<T, T> {
        let (on, kappa) = (self.work.workspace.newton.on[contact], self.contact.kappa);
        let (half_width, outward) = (on.half_width(), outward::<T>(side));
        let gap = &self.contact.gap.tilted(found.tilt);
        self.work.integrator.ready(gap, found.interval)?;
        let solved = Solved { gap, integrator: &*self.work.integrator, kappa, found };
        let pressure = Pressure::new(solved)?;
        let least = T::of(8.0) * T::epsilon() * (on[side].abs() + half_width);
        let (most, quarter) = (T::of(STEP_INWARD) * half_width, T::of(0.25));
        let mut away = most;
        while away > least && pressure.at(on[side] - outward * away)? > T::zero() {
            away *= quarter;
        }
        Ok((away / quarter).min(most))
    }

    /// Puts the limits that are held back where they were, free unless they were at an end of the
    /// bodies; tells whether there are any.
    pub(super) fn lets_all_go(&mut self) -> bool {
        let (ends, is_of_one) = (self.contact.ends(), self.is_of_one());
        let Workspace { newton: NewtonSeveral { on, held, .. }, before, .. } =
            &mut *self.work.workspace;
        let mut any = false;
        for (i, held) in held.iter_mut().enumerate() {
            for side in Side::BOTH {
                let stays = held[side] && !is_of_one && on[i][side] == ends[side];
                any |= held[side] && !stays;
                held[side] = stays;
            }
        }
        on.clone_from(before);
        for (i, held) in held.iter().enumerate() {
            for side in Side::BOTH.into_iter().filter(|&side| held[side]) {
                put(&mut on[i..=i], side, ends[side]);
            }
        }
        any
    }

    /// Puts a held limit at a distance beyond its corner.
    fn let_go(&mut self, contact: usize, side: Side, away: T) {
        let NewtonSeveral { on, held, .. } = &mut self.work.workspace.newton;
        held[contact][side] = false;
        let x = on[contact][side] + outward::<T>(side) * away;
        put(&mut on[contact..=contact], side, x);
    }

    /// Lists the limits that are held, with the strengths of their singularities.
    fn strengths(&self, found: &ContactState<T>) -> Vec<Held<T>> {
        let held = &self.work.workspace.newton.held;
        let (gap, kappa) = (&self.contact.gap, self.contact.kappa);
        let solved = Solved { gap, integrator: self.work.integrator, kappa, found };
        solved.held_limits().filter(|&(i, side, _)| held[i][side]).collect()
    }

    /// Returns the distance d beyond a corner at which a contact ends, given the strength with the
    /// limit held there: up to half a half-width, half the gap to the next contact, or a hollow
    /// corner.
    fn beyond(&mut self, contact: usize, side: Side, strength: T) -> Fallible<T, T> {
        let rule = GaussLegendre::coarsest();
        let (half, on) = (T::of(0.5), self.work.workspace.newton.on[contact]);
        let (z, half_width) = (on[side], on.half_width());
        let free = half * half_width;
        let next = self.next_limit(contact, side);
        let reach = next.map_or(free, |x| free.min(half * (x - z).abs()));
        let ends = self.breakpoints(z, z + outward::<T>(side) * reach);
        let hollow = ends.into_iter().find(|&x| self.contact.gap.jump(x)[0] < T::zero());
        let reach = hollow.map_or(reach, |x| reach.min((x - z).abs()));
        let due = T::pi() * T::pi() * strength * (half * half_width).sqrt() / self.contact.kappa;
        let corner = self.corner(z, side)?;
        let steepest = self.steepest_beyond(&corner, reach)?;
        let most = reach.sqrt();
        // In u = √(1 - t/d) the integral is 2 √d ∫ s du.
        let shares = rule.nodes.map(|z| T::of(1.0 - (0.5 * (1.0 + z)).powi(2)));
        let mut share_at = |root: T| -> Fallible<T, T> {
            let away: Vec<T> = shares[..rule.n].iter().map(|&by| root * root * by).collect();
            let both = self.rise_beyond(&corner, &away)?.into_iter().zip(&rule.weights);
            let sum = both.fold(T::zero(), |sum, (rise, &weight)| sum + T::of(weight) * rise);
            Ok(sum * root / due)
        };
        // No wall is steeper, so d is at least as large. A place within the rounding of x cannot be
        // told from the corner.
        let rounding = (T::of(8.0) * T::epsilon() * z.abs()).sqrt();
        let mut low = (due / (steepest + steepest)).max(rounding).min(most);
        let mut high = low;
        for _ in 0..MAX_ROOT_DOUBLINGS {
            if high >= most || share_at(high)? >= T::one() {
                break;
            }
            (low, high) = (high, (high + high).min(most));
        }
        for _ in 0..HALVINGS {
            let root = (low * high).sqrt();
            if share_at(root)? < T::one() { low = root } else { high = root }
        }
        Ok(low * high)
    }
}

/// Returns the direction of x out of a contact.
fn outward<T: Real>(side: Side) -> T {
    if side == Side::Left { -T::one() } else { T::one() }
}

/// Returns the least rise of the slope at a sharp corner: for a flat `d/L = (π F/(2 κ L j))²/2`.
fn least_rise<T: Real>(mean: T) -> T {
    T::frac_pi_2() * mean / T::of(2.0 * SHARP).sqrt()
}
