//! Whether the loaded bodies overlap beside their contacts, where their heights are known and at
//! their corners.

use super::SignoriniCheck;
use crate::gap::{Cost, LowPoint, Sampler, Survey};
use crate::quadrature::panels::{self, Rises};
use crate::solution::ExteriorField;
use crate::{ContactError, Ends, Interval, Real, Side};

/// The share of the load that the series of its pressures may leave open before more of them are
/// taken; and the share of that, where it hides whether the bodies overlap.
const OPEN: f64 = 1e-3;
const LESS_OPEN: f64 = 0.01;

/// The share of a contact's half-width beyond its limits that is sampled with it: there the pressure inside tells that
/// the gap opens.
const BESIDE: f64 = 0.002;

/// The share of F/κ by which heights and slopes may disagree on the rise over a contact.
const STEP: f64 = 0.01;

/// Refinements of the survey for one check.
const MOST_ROUNDS: usize = 40;

/// How often a span between two heights is halved in search of its lowest place.
const MOST_HALVES: usize = 8;

impl<T: Real> SignoriniCheck<'_, T> {
    /// Returns about where the loaded gap is lowest between two places, at the first of which it falls and at the second
    /// rises.
    pub fn lowest_between(
        &self,
        fields: &[ExteriorField<T>],
        look: &Survey<T>,
        [mut left, mut right]: [T; 2],
    ) -> T {
        let half = T::of(0.5);
        let (mut falls, mut rises) = (None, None);
        for _ in 0..MOST_HALVES {
            let x = half * (left + right);
            let pushed = fields.iter().fold(T::zero(), |sum, field| sum + field.slope(x));
            let slope = look.slope(x) + self.gap.tilt() - pushed / self.kappa;
            if slope > T::zero() {
                (right, rises) = (x, Some(slope));
            } else {
                (left, falls) = (x, Some(-slope));
            }
        }
        // The slope is all but straight by now.
        let share = match (falls, rises) {
            (Some(falls), Some(rises)) => falls / (falls + rises),
            _ => half,
        };
        left + share * (right - left)
    }

    /// Whether one contact leaves nothing of the bodies outside.
    pub fn covers(&self, ends: Ends<T>) -> bool {
        let Interval { left, right } = self.found.interval;
        panels::several(self.integrator).is_none() && left <= ends.left && right >= ends.right
    }

    /// Finds where the loaded bodies would overlap outside the contacts, up to their ends, and the gap there. Where the
    /// survey leaves that open, it is refined.
    pub fn overlap(
        &self,
        fields: &mut Vec<ExteriorField<T>>,
        look: &mut Survey<T>,
        ends: Ends<T>,
        cost: &mut Cost,
    ) -> Result<Option<[T; 2]>, ContactError<T>> {
        self.compare_heights(look)?;
        let seen = self.seek_overlap(fields, look, ends, None, cost)?;
        Ok(if let Seen::Overlap(place) = seen { Some(place) } else { None })
    }

    /// Seeks an overlap, `opens` being the distances from the limits, before and beyond each contact, within which the
    /// gap is proved to open.
    pub fn seek_overlap(
        &self,
        fields: &mut Vec<ExteriorField<T>>,
        look: &mut Survey<T>,
        ends: Ends<T>,
        opens: Option<&[[T; 2]]>,
        cost: &mut Cost,
    ) -> Result<Seen<T>, ContactError<T>> {
        if fields.is_empty() {
            self.fields(fields)?;
        }
        let corners = [self.corner(Side::Left, ends, cost)?, self.corner(Side::Right, ends, cost)?];
        let within = |low: LowPoint<T>| {
            let height = self.gap.turned(low.x, low.height);
            let [from, to] = low.between.unwrap_or([low.x; 2]);
            let (from, to) = (from.max(ends.left), to.min(ends.right));
            let between = low.between.map(|_| [from, to]);
            (from <= to).then(|| LowPoint { x: low.x.max(from).min(to), height, between, ..low })
        };
        let mut share = T::of(OPEN);
        self.resolve(fields, share)?;
        let (mut open, mut hidden) = (Vec::new(), None);
        for _ in 0..MOST_ROUNDS {
            let [first, last] = corners;
            let lows = look.low_points().filter_map(within);
            let lows = lows.flat_map(|low| self.outside(look, low)).flatten();
            let heights = first.into_iter().chain(lows).chain(last);
            open.clear();
            let seen = self.overlap_at(fields, look, opens, heights, &mut open, cost)?;
            share *= T::of(LESS_OPEN);
            let unresolved = match seen {
                Seen::Overlap(_) => return Ok(seen),
                Seen::Open(x) => Some(x),
                Seen::Apart => None,
            };
            hidden = unresolved.or(open.first().map(|on| on[0]));
            open.sort_by(|one, other| super::by_size(one[0], other[0]));
            let is_finer =
                !open.is_empty() && look.refine_at(self.gap, &open, Some(T::zero()), cost)?;
            if is_finer || unresolved.is_some() && self.resolve(fields, share)? {
                continue;
            }
            break;
        }
        Ok(hidden.map_or(Seen::Apart, Seen::Open))
    }

    /// Compares the rise of the gap over one contact by its slopes with that by the heights of the survey: between two
    /// panels the contact itself sees no step.
    fn compare_heights(&self, look: &Survey<T>) -> Result<(), ContactError<T>> {
        let Interval { left, right } = self.found.interval;
        let [from, to] = [left, right].map(|x| self.gap.nearest(x));
        let Some(by_slopes) = panels::rise(self.integrator, from, to) else { return Ok(()) };
        let by_heights = look.height(to) - look.height(from);
        let highest = look.height(to).abs().max(look.height(from).abs());
        let deformed = self.found.load.abs() / self.kappa;
        let open = look.doubt_at(from) + look.doubt_at(to) + T::of(STEP) * deformed;
        Rises { between: [from, to], by_heights, by_slopes, highest, open }.compare()
    }

    /// Returns a low place as it is; or if it is inside a contact the middles of what its span has outside.
    fn outside(&self, look: &Survey<T>, low: LowPoint<T>) -> [Option<LowPoint<T>>; 2] {
        let contacts = self.contacts();
        let on = contacts.get(contacts.partition_point(|on| on.right <= low.x));
        let (Some(on), Some([from, to])) = (on.filter(|on| on.left <= low.x), low.between) else {
            return [Some(low), None];
        };
        [[from, on.left], [on.right, to]].map(|[from, to]| {
            let x = T::of(0.5) * (from + to);
            let height = || self.gap.turned(x, look.height(x));
            (from < to).then(|| LowPoint { x, height: height(), between: Some([from, to]), ..low })
        })
    }

    /// A corner before the end of the bodies that the contacts do not reach: where the gap falls
    /// towards it, no height before it is as low.
    fn corner(
        &self,
        side: Side,
        ends: Ends<T>,
        cost: &mut Cost,
    ) -> Result<Option<LowPoint<T>>, ContactError<T>> {
        let x = ends[side];
        let reached = [self.gap.range()[side as usize], self.found.interval[side]];
        if reached.contains(&x) {
            return Ok(None);
        }
        let mut sampler = Sampler::default();
        let height = sampler.height(self.gap, x)?;
        cost.heights += sampler.cost.evaluations;
        Ok(Some(LowPoint { x, height, between: None, doubt: T::zero() }))
    }

    /// Finds the worst overlap outside the contacts as far as some heights show it, by rising x, or a place where the
    /// series of the pressures hide whether there is one; `open` takes the spans where the survey hides it.
    fn overlap_at(
        &self,
        fields: &[ExteriorField<T>],
        look: &Survey<T>,
        opens: Option<&[[T; 2]]>,
        heights: impl Iterator<Item = LowPoint<T>>,
        open: &mut Vec<[T; 2]>,
        cost: &mut Cost,
    ) -> Result<Seen<T>, ContactError<T>> {
        let (contacts, hull) = (self.contacts(), self.found.interval);
        let last = contacts.len() - 1;
        let (mut worst, mut hides) = (None::<[T; 2]>, None);
        let load = fields.iter().fold(T::zero(), |sum, field| sum + field.load());
        let mut beside: Option<Beside<T>> = None;
        let mut next = 0;
        for low in heights {
            let LowPoint { x, height, between, doubt: hidden } = low;
            while next <= last && contacts[next].right <= x {
                next += 1;
            }
            if next <= last && contacts[next].left <= x {
                continue;
            }
            let known = beside.filter(|beside| beside.next == next);
            let from = known.unwrap_or_else(|| self.beside(fields, look, opens, next));
            beside = Some(from);
            // From no place does the load act further away than from the far end of the contacts.
            let most = load * (x - hull.left).max(hull.right - x).ln();
            if height - hidden - from.height >= (most - from.taken) / self.kappa + from.hidden {
                continue;
            }
            if (between.is_some() || opens.is_some()) && from.is_near(x) {
                continue;
            }
            let hidden = hidden + from.hidden;
            let mut verdict = self.verdict(fields, &from, [x, height, hidden])?;
            let mut x = x;
            if let (Verdict::Overlap | Verdict::Hidden, Some([left, right])) = (verdict, between) {
                // A bound, or an interpolated height.
                let on = [left.max(from.room.left), right.min(from.room.right)];
                x = self.lowest_between(fields, look, on);
                if from.is_near(x) {
                    continue;
                }
                let height = self.gap.turned(x, look.height(x));
                verdict = self.verdict(fields, &from, [x, height, hidden])?;
                if verdict == Verdict::Hidden {
                    open.extend([[left, right], [from.edge; 2]]);
                }
            }
            if verdict == Verdict::Overlap {
                let (found, is_open) = self.verified(fields, &from, x, cost)?;
                hides = hides.or(is_open.then_some(x));
                worst =
                    found.filter(|&[_, gap]| worst.is_none_or(|[_, least]| gap < least)).or(worst);
            }
            hides = hides.or((verdict == Verdict::Unresolved).then_some(x));
        }
        Ok(worst.map(Seen::Overlap).or(hides.map(Seen::Open)).unwrap_or(Seen::Apart))
    }

    /// Describes what lies beside a contact: before one of them, or beyond the last.
    pub fn beside(
        &self,
        fields: &[ExteriorField<T>],
        look: &Survey<T>,
        opens: Option<&[[T; 2]]>,
        next: usize,
    ) -> Beside<T> {
        let (contacts, [from, to]) = (self.contacts(), self.gap.range());
        let (contact, side) = match next.checked_sub(1) {
            None => (0, Side::Left),
            Some(before) => (before, Side::Right),
        };
        let edge = contacts[contact][side];
        let at = self.gap.nearest(edge);
        let (height, hidden) = match panels::several(self.integrator) {
            Some(several) => (several.height(contact, side), T::zero()),
            None => (self.gap.turned(at, look.height(at)), look.doubt_at(at)),
        };
        let left = next.checked_sub(1).map_or(from, |i| contacts[i].right);
        let right = contacts.get(next).map_or(to, |on| on.left);
        let room = Interval { left, right };
        let near = T::of(BESIDE) * contacts[contact].half_width();
        let is_limit = [next > 0, next < contacts.len()];
        let near = is_limit.map(|is_limit| if is_limit { near } else { T::zero() });
        let near = opens.map_or(near, |opens| opens[next]);
        Beside { next, edge, room, near, height, hidden, taken: total(fields, edge) }
    }

    /// Returns the gap that is left of a height under the load, and its uncertainty, by the series of the pressures.
    pub fn gap_left(
        &self,
        fields: &[ExteriorField<T>],
        from: &Beside<T>,
        [x, height]: [T; 2],
    ) -> [T; 2] {
        let gap = height - from.height - (total(fields, x) - from.taken) / self.kappa;
        let doubt = fields.iter().fold(T::zero(), |sum, field| sum + field.doubt());
        // Coefficients that fall slowly, as those of a kink beside an edge, add up to several times the last ones.
        [gap, T::of(4.0) * doubt / self.kappa]
    }

    /// Returns the same by the pressures themselves, if their integrals are at hand.
    pub fn exact_gap_left(
        &self,
        fields: &[ExteriorField<T>],
        from: &Beside<T>,
        [x, height]: [T; 2],
    ) -> Result<[T; 2], ContactError<T>> {
        let Some(exact) = &self.exact else { return Ok(self.gap_left(fields, from, [x, height])) };
        let beyond = x - from.edge;
        let pushed = |distance: T, strength: T| [strength * (beyond / distance).ln_1p()];
        let [taken] = exact.over(from.edge, pushed)?;
        let doubt = T::epsilon().powf(T::of(0.75)) * taken.abs();
        Ok([height - from.height - taken / self.kappa, T::of(4.0) * doubt / self.kappa])
    }

    /// Judges a height before loading, given its uncertainty.
    fn verdict(
        &self,
        fields: &[ExteriorField<T>],
        from: &Beside<T>,
        [x, height, hidden]: [T; 3],
    ) -> Result<Verdict, ContactError<T>> {
        let allowed = self.allowed(height, from.height);
        let [gap, _] = self.gap_left(fields, from, [x, height]);
        if gap - hidden >= -allowed {
            return Ok(Verdict::Apart);
        }
        let [gap, doubt] = self.exact_gap_left(fields, from, [x, height])?;
        Ok(if gap - hidden >= -allowed {
            Verdict::Apart
        } else if gap - hidden >= -(allowed + doubt) {
            Verdict::Unresolved
        } else if gap + hidden >= -(allowed + doubt) {
            Verdict::Hidden
        } else {
            Verdict::Overlap
        })
    }

    /// Returns the overlap that is put down to rounding.
    pub fn allowed(&self, height: T, at_edge: T) -> T {
        self.found.nothing() * (height - at_edge).abs()
            + T::of(64.0) * T::epsilon() * (height.abs() + at_edge.abs())
            + self.noise
    }

    /// Looks at the curves themselves where the bodies seem to overlap: whether they do, and whether that is open.
    pub fn verified(
        &self,
        fields: &[ExteriorField<T>],
        from: &Beside<T>,
        x: T,
        cost: &mut Cost,
    ) -> Result<(Option<[T; 2]>, bool), ContactError<T>> {
        let mut sampler = Sampler::default();
        let height = sampler.height(self.gap, x)?;
        let at_edge = match panels::several(self.integrator) {
            Some(_) => from.height,
            None => sampler.height(self.gap, self.gap.nearest(from.edge))?,
        };
        let counted = Beside { height: at_edge, ..*from };
        let [gap, doubt] = self.exact_gap_left(fields, &counted, [x, height])?;
        // Where the formulas are all rounding, heights do not go with the slopes on both sides, and tell nothing.
        let aside = T::epsilon().sqrt() * self.found.interval.half_width();
        let beside = self.gap.nearest(x + aside);
        let rise = sampler.height(self.gap, beside)? - height;
        let slopes = sampler.slope_again(self.gap, beside) + sampler.slope(self.gap, x)?;
        let due = T::of(0.5) * slopes * (beside - x);
        cost.heights += sampler.cost.evaluations;
        let rounding = T::of(64.0) * T::epsilon() * (height.abs() + at_edge.abs());
        let is_sound = (rise - due).abs() <= T::of(0.1) * due.abs() + rounding;
        let allowed = self.allowed(height, at_edge) + T::of(8.0) * (rise - due).abs();
        let is_open = gap >= -(allowed + doubt) || !is_sound;
        Ok(((!is_open).then_some([x, gap]), is_open && is_sound && gap < -allowed))
    }
}

/// The potential of all contacts.
fn total<T: Real>(fields: &[ExteriorField<T>], x: T) -> T {
    fields.iter().fold(T::zero(), |sum, field| sum + field.potential(x))
}

/// What lies between two contacts, or beyond the outermost ones.
#[derive(Clone, Copy)]
pub(crate) struct Beside<T> {
    /// The number of the contact on its right.
    pub next: usize,
    pub room: Interval<T>,
    /// The limit that heights are counted from.
    pub edge: T,
    /// The distances from the limits on the left and on the right within which the gap opens as the pressure says.
    near: [T; 2],
    /// The height of the gap at that limit, its uncertainty, and the potential there.
    pub height: T,
    hidden: T,
    pub taken: T,
}

impl<T: Real> Beside<T> {
    /// Tells whether a place is so near to a limit that the pressure inside tells of the gap.
    fn is_near(&self, x: T) -> bool {
        x - self.room.left < self.near[0] || self.room.right - x < self.near[1]
    }
}

/// The outcome of a search for an overlap.
#[derive(Clone, Copy)]
pub(crate) enum Seen<T> {
    /// There is none.
    Apart,
    /// The worst one, and the gap there.
    Overlap([T; 2]),
    /// A place where neither the survey nor the series of the pressures tell.
    Open(T),
}

/// What a height says of the gap between the loaded bodies.
#[derive(Clone, Copy, PartialEq)]
enum Verdict {
    Apart,
    /// They may overlap by no more than the series of the pressures leave open.
    Unresolved,
    /// They may overlap by no more than the survey leaves open.
    Hidden,
    Overlap,
}
