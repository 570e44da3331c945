//! Overlap of the loaded bodies outside their contacts, where their heights are known and at their
//! corners.

use super::SignoriniCheck;
use super::beside::{Beside, Verdict};
use super::dips::{Dip, Overlaps};
use crate::gap::{Cost, LowPoint, MAX_NEAR_UNCERTAINTY, Sampler, Survey, crossing};
use crate::numerics::ascending;
use crate::quadrature::panels::Rises;
use crate::solve::exterior_field::ExteriorFields;
use crate::{Ends, Fallible, Interval, Real, Side};

/// Share of the load that the series of the pressures may leave uncertain before more pressures are
/// taken; and the factor on this share if it hides whether the bodies overlap.
const MAX_TRUNCATION: f64 = 1e-3;
const HIDING_FACTOR: f64 = 0.01;

/// Largest difference of heights and slopes on the rise over a contact, as a share of F/κ.
const STEP: f64 = 0.01;

/// Largest number of refinements of the survey for one check.
const MAX_ROUNDS: usize = 40;

/// Halvings of a span between two heights in search of its lowest place, and cuts at the zero of
/// the chord of the slope, each of which leaves a thousandth of the distance: a contact is born
/// there with as little as a millionth.
pub(super) const MAX_HALVES: usize = 8;
const MAX_CHORDS: usize = 2;

/// Spans of x, or places as spans without width.
type Spans<T> = Vec<[T; 2]>;

impl<T: Real> SignoriniCheck<'_, T> {
    /// Returns about the lowest place of the loaded gap between two places, by its slope; the gap
    /// falls at the first and rises at the second.
    pub(super) fn lowest_between(
        slope: impl Fn(T) -> T,
        halves: usize,
        [mut left, mut right]: [T; 2],
    ) -> T {
        let half = T::of(0.5);
        let (mut falls, mut rises) = (None, None);
        let mut share = half;
        for step in 1..=halves + MAX_CHORDS {
            let x = left + share * (right - left);
            let slope = slope(x);
            if slope > T::zero() {
                (right, rises) = (x, Some(slope));
            } else {
                (left, falls) = (x, Some(-slope));
            }
            // Where finite, the slope is almost straight once the span is short.
            if step >= halves {
                let crossing = falls.zip(rises).map(|(falls, rises)| falls / (falls + rises));
                share = crossing.filter(|share| share.is_finite()).unwrap_or(half);
            }
        }
        left + share * (right - left)
    }

    /// Returns the slope of the displacement outside the contacts.
    pub(super) fn rate(&self, fields: &ExteriorFields<T>, x: T) -> T {
        fields.slope(x) / self.kappa
    }

    /// Finds where the loaded bodies would overlap outside the contacts, up to their ends: the
    /// lowest place of each dip with the gap there, `[x, gap]`. Refines the survey if it cannot
    /// decide.
    pub fn overlap(
        &self,
        fields: &mut ExteriorFields<T>,
        overlaps: &mut Overlaps<T>,
        look: &mut Survey<T>,
        ends: Ends<T>,
        cost: &mut Cost,
    ) -> Fallible<T, ()> {
        self.compare_heights(look, cost)?;
        let Overlaps { dips, closed_before, .. } = &mut *overlaps;
        self.list_closed_before(closed_before);
        if !self.widest.is_empty() && closed_before.is_empty() {
            return Ok(());
        }
        if fields.each.is_empty() {
            self.fields(fields)?;
        }
        let corners = [self.corner(Side::Left, ends, cost)?, self.corner(Side::Right, ends, cost)?];
        let is_new = |low: &LowPoint<T>| {
            let [from, to] = low.between.map_or([low.x; 2], |ends| ends.map(|end| end[0]));
            let after = closed_before.partition_point(|on| on.right < from);
            self.widest.is_empty() || closed_before.get(after).is_some_and(|on| on.left <= to)
        };
        let mut share = T::of(MAX_TRUNCATION);
        self.resolve(fields, share)?;
        let (mut open, mut hidden) = (Vec::new(), Vec::new());
        for _ in 0..MAX_ROUNDS {
            let [first, last] = corners;
            let lows = look.low_points().filter_map(|low| self.within(ends, low));
            let lows = lows.flat_map(|low| self.outside(look, low)).filter(is_new);
            let heights = first.into_iter().chain(lows).chain(last);
            open.clear();
            hidden.clear();
            let found = (&mut *dips, &mut open, &mut hidden);
            self.overlap_at(fields, look, heights, found, cost)?;
            if !dips.is_empty() {
                return Ok(());
            }
            open.sort_by(|one, other| ascending(&one[0], &other[0]));
            let mut is_finer =
                !open.is_empty() && look.refine_at(self.gap, [&open; 2], T::zero(), cost)?;
            // A narrow contact hides little of the load.
            while !hidden.is_empty() && !is_finer && share > T::epsilon() {
                share *= T::of(HIDING_FACTOR);
                is_finer = self.resolve(fields, share)?;
            }
            if !is_finer {
                break;
            }
        }
        // What the series leave open, the pressures themselves decide.
        self.overlap_by_pressures(fields, &hidden, overlaps, cost)
    }

    /// Returns a height of the turned gap, or the part of a span, within the ends of the bodies.
    fn within(&self, ends: Ends<T>, low: LowPoint<T>) -> Option<LowPoint<T>> {
        let height = self.gap.turned(low.x, low.height);
        let Some(span) = low.between else {
            let is_inside = ends.left <= low.x && low.x <= ends.right;
            return is_inside.then_some(LowPoint { height, ..low });
        };
        // At a corner inside the span, the height follows the tangent.
        let cut = |[x, height, slope]: [T; 3]| {
            let (height, slope) = (self.gap.turned(x, height), slope + self.gap.tilt());
            let at = x.max(ends.left).min(ends.right);
            if at == x { [x, height, slope] } else { [at, height + slope * (at - x), slope] }
        };
        let [from, to] = span.map(cut);
        let x = low.x.max(from[0]).min(to[0]);
        (from[0] < to[0]).then_some(LowPoint { x, height, between: Some([from, to]), ..low })
    }

    /// Compares the rise of the gap over one contact by its slopes and by the heights of the
    /// survey: the contact itself does not see a step between two panels. If they disagree, the
    /// curves themselves decide.
    fn compare_heights(&self, look: &Survey<T>, cost: &mut Cost) -> Fallible<T, ()> {
        let Interval { left, right } = self.found.interval;
        let [from, to] = [left, right].map(|x| self.gap.nearest(x));
        let Some(by_slopes) = self.panels.rise(from, to) else { return Ok(()) };
        let deformed = T::of(STEP) * self.found.load.abs() / self.kappa;
        let rises = |[before, after]: [T; 2], doubt: T| {
            let (highest, open) = (before.abs().max(after.abs()), doubt + deformed);
            Rises { between: [from, to], by_heights: after - before, by_slopes, highest, open }
        };
        let doubt = look.doubt_at(from) + look.doubt_at(to);
        if rises([from, to].map(|x| look.height_as_described(x)), doubt).compare().is_ok() {
            return Ok(());
        }
        let mut sampler = Sampler::default();
        let before = sampler.height_as_described(self.gap, from)?;
        let after = sampler.height_as_described(self.gap, to)?;
        let found = rises([before, after], T::zero()).compare_beside_noise(self.gap, &mut sampler);
        cost.heights += sampler.cost.evaluations;
        found
    }

    /// Returns the height of the gap at a place, before the bodies are loaded.
    pub(super) fn height_at(&self, look: &Survey<T>, x: T) -> T {
        self.gap.turned(x, look.height(self.gap, x))
    }

    /// Returns a height at a place as it is, and a span without what lies in contacts.
    fn outside<'s>(
        &'s self,
        look: &'s Survey<T>,
        low: LowPoint<T>,
    ) -> impl Iterator<Item = LowPoint<T>> + use<'s, T> {
        let contacts = self.contacts;
        let [first, after] = low.between.map_or([0, 0], |[from, to]| {
            let first = contacts.partition_point(|on| on.right <= from[0]);
            [first, first + contacts[first..].iter().take_while(|on| on.left < to[0]).count()]
        });
        // At a limit the opening slope decides.
        let limit = |x: T| [x, T::one() / T::zero(), T::zero()];
        (first..=after).filter_map(move |i| {
            let Some([from, to]) = low.between.filter(|_| first < after) else { return Some(low) };
            let from = if i == first { from } else { limit(contacts[i - 1].right) };
            let to = if i == after { to } else { limit(contacts[i].left) };
            let is_inside = from[0] < low.x && low.x < to[0];
            let x = if is_inside { low.x } else { T::of(0.5) * (from[0] + to[0]) };
            let height = if is_inside { low.height } else { self.height_at(look, x) };
            let between = Some([from, to]);
            (from[0] < to[0]).then_some(LowPoint { x, height, between, ..low })
        })
    }

    /// Returns a corner before the end of the bodies that the contacts do not reach: if the gap
    /// falls towards it, no height before it is as low.
    fn corner(
        &self,
        side: Side,
        ends: Ends<T>,
        cost: &mut Cost,
    ) -> Fallible<T, Option<LowPoint<T>>> {
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

    /// Finds the dips in which bodies overlap outside the contacts, by rising x, as far as the
    /// given heights show them. Puts the spans in which the survey hides dips into `open`, and the
    /// places where the series of the pressures do into `hidden`.
    fn overlap_at(
        &self,
        fields: &ExteriorFields<T>,
        look: &Survey<T>,
        heights: impl Iterator<Item = LowPoint<T>>,
        (dips, open, hidden): (&mut Vec<Dip<T>>, &mut Spans<T>, &mut Spans<T>),
        cost: &mut Cost,
    ) -> Fallible<T, ()> {
        let (contacts, hull) = (self.contacts, self.found.interval);
        let last = contacts.len() - 1;
        // The gap is open somewhere after the last dip.
        let mut is_parted = true;
        let load = fields.each.iter().fold(T::zero(), |sum, field| sum + field.load());
        let mut beside: Option<Beside<T>> = None;
        let mut next = 0;
        for low in heights {
            let LowPoint { x, height, between, doubt } = low;
            while next <= last && contacts[next].right <= x {
                next += 1;
            }
            if next <= last && contacts[next].left <= x {
                is_parted = true;
                continue;
            }
            let known = beside.filter(|beside| beside.next == next);
            let from = *beside.insert(known.unwrap_or_else(|| self.beside(fields, look, next)));
            // A span is no lower than its ends, or than where its tangents cross; no part of the
            // load acts from further away than the far end of the contacts.
            let ends = between.unwrap_or([[x, height, T::zero()]; 2]);
            let least = height.min(ends[0][1]).min(ends[1][1]);
            let most = load * (ends[1][0] - hull.left).max(hull.right - ends[0][0]).ln();
            let taken = (most - from.taken) / self.kappa + from.hidden + from.at_corners;
            if least - doubt - from.height >= taken {
                is_parted |= between.is_none();
                continue;
            }
            if between.is_some() && from.is_near(x) || from.is_blind(x) {
                continue;
            }
            let judged = self.judge(fields, look, &from, low, open);
            let Some((x, verdict)) = judged else { continue };
            if verdict == Verdict::Overlap {
                let (found, is_open) = self.verified(fields, &from, x, cost)?;
                hidden.extend(is_open.then_some([x; 2]));
                if let Some(found) = found {
                    match dips.last_mut().filter(|_| !is_parted) {
                        None => dips.push(found),
                        Some(dip) if found.gap < dip.gap => *dip = found,
                        Some(_) => {}
                    }
                    is_parted = false;
                }
            }
            is_parted |= between.is_none() && verdict == Verdict::Apart;
            // Next to a limit the series do not tell the slope: a span beside a hollow corner there
            // is left to the pressures.
            let span = between.map(|ends| from.within(ends.map(|end| end[0])));
            let span = span.filter(|&span| from.is_beside_hollow(span)).unwrap_or([x; 2]);
            let is_open = verdict == Verdict::Unresolved || span[0] < span[1];
            hidden.extend(is_open.then_some(span));
        }
        Ok(())
    }

    /// Judges a height, or a span at its lowest place; returns the place with the verdict. Returns
    /// `None` for a span next to a limit, where the pressure inside decides. Puts the span into
    /// `open` if the survey hides the verdict.
    fn judge(
        &self,
        fields: &ExteriorFields<T>,
        look: &Survey<T>,
        from: &Beside<T>,
        LowPoint { x, height, between, doubt }: LowPoint<T>,
        open: &mut Vec<[T; 2]>,
    ) -> Option<(T, Verdict)> {
        let hidden = doubt + from.hidden;
        let judged = |height: T| self.verdict(fields, from, [x, height, hidden]);
        let Some(ends) = between else {
            let verdict = judged(height);
            // Only the height at the limit is uncertain.
            if verdict == Verdict::Hidden {
                open.push([from.edge; 2]);
            }
            return Some((x, verdict));
        };
        let verdict = judged(self.floor(fields, [x, height], ends));
        if verdict == Verdict::Apart {
            return Some((x, verdict));
        }
        // The height so far was a bound, or interpolated.
        let span = ends.map(|end| end[0]);
        let tilt = self.gap.tilt();
        let slope = |x| look.slope(self.gap, x) + tilt - self.rate(fields, x);
        let x = Self::lowest_between(slope, MAX_HALVES, from.within(span));
        let verdict = if !from.is_near(x) {
            let height = self.height_at(look, x);
            self.verdict(fields, from, [x, height, hidden])
        } else {
            // A span this vague does not show its lowest place.
            let vague = T::of(MAX_NEAR_UNCERTAINTY) * self.found.load.abs() / self.kappa;
            Some(verdict).filter(|&verdict| verdict == Verdict::Hidden && hidden > vague)?
        };
        if verdict == Verdict::Hidden {
            open.extend([span, [from.edge; 2]]);
        }
        Some((x, verdict))
    }

    /// Returns a height at a place of a span that represents the lowest loaded gap in it. A
    /// potential is concave, and rises to both sides of the place no more than its tangent; the
    /// loaded gap is as low as the crossing of its tangents at both ends.
    fn floor(&self, fields: &ExteriorFields<T>, [x, height]: [T; 2], ends: [[T; 3]; 2]) -> T {
        let rate = self.rate(fields, x);
        let loaded = |[end, height, slope]: [T; 3]| {
            [end, height + rate * (x - end), slope - self.rate(fields, end)]
        };
        let [[left, before, falls], [right, after, rises]] = ends.map(loaded);
        let chord = (after - before) / (right - left);
        // At a limit the opening slope decides.
        let both = Some([chord - falls, rises - chord]).filter(|_| chord.is_finite());
        let Some([t, below]) = both.and_then(crossing) else { return height };
        before + (right - left) * (t * chord - below)
    }

    /// Lists the spans that a heavier load has closed and this load may leave open: the contacts
    /// under that load, less the present ones and the spans next to them on which the gap is
    /// convex.
    fn list_closed_before(&self, closed: &mut Vec<Interval<T>>) {
        let contacts = self.contacts;
        closed.clear();
        for wide in self.widest {
            let first = contacts.partition_point(|on| on.right <= wide.left);
            let after = contacts.partition_point(|on| on.left < wide.right).max(first);
            let lefts = std::iter::once(wide.left);
            let lefts = lefts.chain(contacts[first..after].iter().map(|on| on.right));
            let rights = contacts[first..after].iter().map(|on| on.left).chain([wide.right]);
            for (i, (left, right)) in (first..).zip(lefts.zip(rights)) {
                let span = Interval { left, right };
                // Between two contacts that were one, the gap is not convex.
                let beside = match (i == first, i == after) {
                    (true, false) => Some(i),
                    (false, true) => Some(i - 1),
                    _ => None,
                };
                let opens = |contact| self.panels.rises_on(contact, span);
                if left < right && !beside.is_some_and(opens) {
                    closed.push(span);
                }
            }
        }
    }

    /// Judges an unloaded height, given its place and its uncertainty.
    fn verdict(&self, fields: &ExteriorFields<T>, from: &Beside<T>, at: [T; 3]) -> Verdict {
        let ([x, height, hidden], allowed) = (at, self.allowed(at[1], from.height));
        let gap = height - from.height - (fields.potential(x) - from.taken) / self.kappa;
        // The series of the pressures leave this uncertain.
        let doubt = from.doubt;
        if gap - hidden - from.at_corners >= -allowed {
            Verdict::Apart
        } else if gap - hidden >= -(allowed + doubt) {
            Verdict::Unresolved
        } else if gap + hidden >= -(allowed + doubt) {
            Verdict::Hidden
        } else {
            Verdict::Overlap
        }
    }

    /// Returns the overlap that counts as rounding.
    pub(super) fn allowed(&self, height: T, at_edge: T) -> T {
        self.found.zero_tolerance() * (height - at_edge).abs()
            + T::of(64.0) * T::epsilon() * (height.abs() + at_edge.abs())
    }

    /// Evaluates the curves themselves where the bodies seem to overlap. Returns the place and the
    /// gap if they do, and whether the series of the pressures leave this open.
    fn verified(
        &self,
        fields: &ExteriorFields<T>,
        from: &Beside<T>,
        x: T,
        cost: &mut Cost,
    ) -> Fallible<T, (Option<Dip<T>>, bool)> {
        let mut sampler = Sampler::default();
        let height = sampler.height(self.gap, x)?;
        let at_edge = match self.panels.several() {
            Some(_) => from.height,
            None => sampler.height(self.gap, self.gap.nearest(from.edge))?,
        };
        let gap = height - at_edge - (fields.potential(x) - from.taken) / self.kappa;
        // If the formulas are all noise, heights do not match the slopes on both sides.
        let aside = T::epsilon().sqrt() * self.found.interval.half_width();
        let beside = self.gap.nearest(x + aside);
        let rise = sampler.height(self.gap, beside)? - height;
        // At a ridge the slope towards that place: the mean of both sides would match no rise.
        let slopes =
            sampler.slope_again(self.gap, beside) + sampler.slope_from(self.gap, x, Side::Right)?;
        let due = T::of(0.5) * slopes * (beside - x);
        // The gap is a difference of the bodies' heights, and has their rounding.
        let rounding = T::of(64.0) * T::epsilon() * sampler.highest;
        let mut allowed = self.allowed(height, at_edge) + rounding;
        let is_sound = (rise - due).abs() <= T::of(0.1) * due.abs() + rounding;
        if !is_sound {
            allowed += T::of(8.0) * (rise - due).abs() + sampler.noise_of_height(self.gap, x)?;
        }
        let is_open = gap >= -(allowed + from.doubt);
        let dip = if is_open { None } else { self.dip(fields, [x, gap], &mut sampler)? };
        cost.heights += sampler.cost.evaluations;
        Ok((dip, is_open && gap - from.at_corners < -allowed))
    }
}
