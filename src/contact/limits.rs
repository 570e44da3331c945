//! The search for the limits.
//!
//! Two conditions, one at each edge, fix two unknowns. They are taken as a *balance* (their
//! difference, which decides where a contact of given width sits) inside a *load* (their sum,
//! which decides how wide it is). Where the slope of the gap rises with x both are monotone,
//! each has one root, and each is a problem of one unknown for any [`LimitSearch`]:
//!
//! ```text
//! outer:  half-width L        spread(L, u(L)) = 0
//! inner:  distance u          shift(L, u) = 0,     a = x₀ + u,  -b = x₀ + u - 2L
//!                                             or   -b = x₀ - u,  a = x₀ - u + 2L
//! ```
//!
//! u belongs to the edge closer to `x₀`, which may be a millionth of the width away: it keeps its digits.
//! `x₀` is a point of first contact, where the slope of the gap passes through zero. Every
//! contact contains it, so `u` and the half-width are positive lengths of the contact's own
//! size, and a relative tolerance means the same on either side and wherever the origin is.
//!
//! Both searches are handed a narrow bracket: the inner one steps out from the place that the
//! last width had, the outer one from the start, by factors that a round body would need.

use super::Contact;
use super::edges::{Excess, Goal};
use super::first_contact::first_contact;
use super::further::further;
use super::stride::{Stride, ulps};
use crate::gap::{Cost, Gap, Sampler};
use crate::quadrature::Engine;
use crate::search::{Bracket, LimitSearch, SearchError};
use crate::{ContactError, Interval, Real};

/// Widths tried before the search gives up bracketing the load: what halving takes from the
/// largest number to the smallest.
const MOST_WIDTHS: usize = 2200;

/// How much wider than a contact the panels may be that it is tried on: a tip of the bodies that is
/// as much narrower would fall between the nodes.
const WIDEST: f64 = 16.0;

/// Contacts side by side that are looked at for one that is pulled away from the point of first
/// contact. (A parabola that is pulled at one edge presses at the other up to two half-widths away.)
const MOST_BESIDE: usize = 16;

/// Limits that meet the conditions at the edges.
pub(super) struct Nested<T> {
    pub on: Interval<T>,
    /// Estimated error of the limits relative to the half-width.
    pub error: T,
}

/// Finds the limits that meet the conditions, from a start or without one.
pub(super) fn find<T: Real>(
    contact: &Contact<'_, T>,
    load: T,
    goal: Goal<T>,
    engine: &mut dyn Engine<T>,
    start: Option<Interval<T>>,
    cost: &mut Cost,
) -> Result<Nested<T>, ContactError<T>> {
    let gap = &contact.gap;
    let range = gap.range();
    goal.check(range)?;
    let origin = match goal.limits() {
        [Some(given), _] | [_, Some(given)] => given,
        [None, None] => {
            let mut sampler = Sampler::default();
            let first = first_contact(&mut sampler, gap, start);
            *cost += sampler.cost;
            first?
        }
    };
    let half_width = match (start, goal.limits()) {
        (Some(start), _) => start.half_width(),
        (None, [Some(_), _]) => T::of(0.125) * (range[1] - origin),
        (None, [_, Some(_)]) => T::of(0.125) * (origin - range[0]),
        (None, _) => T::of(0.25) * (origin - range[0]).min(range[1] - origin),
    };
    let mut search = Search { load, ..Search::new(contact, goal, engine, origin, cost) };
    let trial = search.widen(half_width)?;
    if let Goal::Pressure { wanted, .. } = goal {
        wanted.met(trial.on, &trial.excess)?;
    }
    // What the quadrature leaves open, and what the search has left of the conditions.
    let Excess { at_a, at_b, size, .. } = trial.excess;
    let missed = T::of(0.5) * (at_a.abs() + at_b.abs()) / size;
    let on = further(&goal, gap, search.engine, trial.on, None, search.cost)?;
    Ok(Nested { on, error: trial.excess.error + missed })
}

/// The balanced contact of a given half-width.
pub(super) fn place<T: Real>(
    contact: &Contact<'_, T>,
    goal: Goal<T>,
    engine: &mut dyn Engine<T>,
    half_width: T,
    cost: &mut Cost,
) -> Result<Nested<T>, ContactError<T>> {
    let gap = &contact.gap;
    let mut sampler = Sampler::default();
    let first = first_contact(&mut sampler, gap, contact.start);
    *cost += sampler.cost;
    let (origin, range) = (first?, gap.range());
    // The load is not known, and tells nothing of how well the contact has to be in balance.
    let unbalance = Excess::shift;
    let mut search = Search { unbalance, ..Search::new(contact, goal, engine, origin, cost) };
    for _ in 0..MOST_BESIDE {
        match search.place(half_width)? {
            Placed::At(trial) => {
                let Excess { at_a, at_b, size, error, .. } = trial.excess;
                let missed = T::of(0.5) * (at_a - at_b).abs() / size;
                let width = Some(half_width);
                let on = further(&goal, gap, search.engine, trial.on, width, search.cost)?;
                return Ok(Nested { on, error: error + missed });
            }
            Placed::Beyond(end) => {
                let x = [search.origin - half_width, search.origin + half_width][end];
                return Err(ContactError::OutsideBodies { x, range });
            }
            // Pulled at one edge more than at the other, it may sit further on.
            Placed::Adrift(on) if goal.is_lopsided() => {
                let before = search.origin;
                search.origin = if on.left < before { on.left } else { on.right };
            }
            Placed::Adrift(_) => break,
        }
    }
    Err(search.no_balance(half_width))
}

/// A contact tried, and by how much it misses the conditions.
#[derive(Clone, Copy)]
struct Trial<T> {
    on: Interval<T>,
    excess: Excess<T>,
}

/// What became of a contact of given width.
enum Placed<T> {
    /// It sits here.
    At(Trial<T>),
    /// It would have to reach beyond the left (0) or the right (1) end of the bodies.
    Beyond(usize),
    /// It would have to let go of the point of first contact, and be no contact; or one beyond this.
    Adrift(Interval<T>),
}

struct Search<'s, T: Real> {
    goal: Goal<T>,
    gap: &'s Gap<'s, T>,
    engine: &'s mut dyn Engine<T>,
    cost: &'s mut Cost,
    strategy: &'s dyn LimitSearch<T>,
    /// The point of first contact.
    origin: T,
    range: [T; 2],
    load: T,
    /// The edge whose distance from the origin is looked for: the left (0) or the right one (1).
    near: usize,
    /// The share of the width that lay between it and the origin the last time.
    share: T,
    /// By how much the shift fell the last time for each unit of length moved to the right.
    stiffness: Option<T>,
    /// What has to vanish where a contact of given width sits.
    unbalance: fn(&Excess<T>) -> T,
}

impl<'s, T: Real> Search<'s, T> {
    fn new(
        contact: &'s Contact<'s, T>,
        goal: Goal<T>,
        engine: &'s mut dyn Engine<T>,
        origin: T,
        cost: &'s mut Cost,
    ) -> Self {
        Self {
            goal,
            gap: &contact.gap,
            engine,
            cost,
            strategy: contact.strategy(),
            origin,
            range: contact.gap.range(),
            load: T::one(),
            near: 1,
            share: T::of(0.5),
            stiffness: None,
            unbalance: Excess::rough_shift,
        }
    }

    fn attempt(&mut self, on: Interval<T>) -> Result<Trial<T>, ContactError<T>> {
        // Panels much wider than the contact are not as good as they look.
        let covered = self.engine.covered().map_or(T::zero(), |covered| covered.half_width());
        if covered > T::of(WIDEST) * on.half_width() {
            self.engine.forget();
        }
        let excess = self.goal.excess(self.gap, on, self.engine, self.cost)?;
        if !excess.is_finite() {
            return Err(ContactError::Overflow { interval: on });
        }
        Ok(Trial { on, excess })
    }

    /// Finds the half-width at which the spread vanishes, starting from a guess.
    fn widen(&mut self, guess: T) -> Result<Trial<T>, ContactError<T>> {
        let [narrow, wide] = self.enclose(guess)?;
        if narrow.excess.spread() == T::zero() {
            return Ok(narrow);
        }
        let ends = Bracket::new(narrow.on.half_width(), wide.on.half_width())
            .values(narrow.excess.deficit(), wide.excess.deficit());
        let mut best = nearer(narrow, wide, Excess::deficit);
        self.run(&ends, &mut best, Excess::deficit, |search, half_width| {
            match search.place(half_width)? {
                Placed::At(trial) => Ok(trial),
                Placed::Beyond(_) | Placed::Adrift(_) => Err(search.no_balance(half_width)),
            }
        })
    }

    /// Finds a contact too narrow for the load and one too wide, or twice the one that is right.
    fn enclose(&mut self, guess: T) -> Result<[Trial<T>; 2], ContactError<T>> {
        let (zero, half) = (T::zero(), T::of(0.5));
        let given = self.goal.limits().iter().any(Option::is_some);
        // Closer to a given limit the other is the same number.
        let resolution = if given { self.resolution() } else { zero };
        let least = (half * self.goal.least_width()).max(resolution);
        let most = half * (self.range[1] - self.range[0]);
        let (mut narrow, mut wide): (Option<Trial<T>>, Option<Trial<T>>) = (None, None);
        let mut half_width = guess.max(least * T::of(1.5)).min(most * half);
        let mut stride = Stride::new();
        // The least width known to have no balance.
        let mut adrift: Option<T> = None;
        let mut tries = 0;
        loop {
            tries += 1;
            let trial = match (self.place(half_width)?, narrow) {
                (Placed::At(trial), _) => trial,
                (Placed::Adrift(_), _) => {
                    adrift = Some(half_width);
                    let from = narrow.map_or(zero, |narrow| narrow.on.half_width());
                    half_width = half * from + half * half_width;
                    if half_width - from <= T::of(1e-3) * from || half_width <= least {
                        return Err(self.no_balance(half_width));
                    }
                    continue;
                }
                (Placed::Beyond(end), Some(narrow)) => {
                    let trial = self.pin(end, narrow.on)?;
                    if trial.excess.spread() > zero {
                        return Err(self.too_short(end, trial.on));
                    }
                    trial
                }
                (Placed::Beyond(_), None) if half_width * half > least && tries < MOST_WIDTHS => {
                    half_width *= half;
                    continue;
                }
                (Placed::Beyond(_), None) => return Err(self.no_balance(half_width)),
            };
            let (last, spread) = (trial.on.half_width(), trial.excess.spread());
            if spread == zero {
                return Ok([trial, trial]);
            }
            if tries > MOST_WIDTHS {
                return Err(self.no_balance(last));
            }
            if given && spread > zero {
                for (end, x) in [trial.on.left, trial.on.right].into_iter().enumerate() {
                    if self.goal.limits()[end].is_none() && x == self.range[end] {
                        return Err(self.too_short(end, trial.on));
                    }
                }
            }
            half_width = stride.next(last, trial.excess.growth, spread > zero);
            *(if spread > zero { &mut narrow } else { &mut wide }) = Some(trial);
            match (narrow, wide) {
                // A wide bracket is narrowed from the end last tried, as long as that helps.
                (Some(narrow), Some(wide)) => {
                    let (from, to) = (narrow.on.half_width(), wide.on.half_width());
                    let inside = half_width > from && half_width < to;
                    if !inside || to <= T::of(1.5) * from {
                        return Ok([narrow, wide]);
                    }
                }
                _ if spread > zero => {
                    half_width = half_width.min(most);
                    if let Some(adrift) = adrift.filter(|&adrift| half_width >= adrift) {
                        half_width = half * last + half * adrift;
                    }
                    if half_width <= last {
                        return Err(match adrift {
                            Some(_) => self.no_balance(last),
                            None => self.too_short(1, trial.on),
                        });
                    }
                }
                _ => {
                    half_width = half_width.max(least * (T::one() + ulps()));
                    if half_width >= last || half_width <= zero {
                        return Err(self.no_balance(last));
                    }
                }
            }
        }
    }

    /// Finds where a contact of given half-width sits.
    fn place(&mut self, half_width: T) -> Result<Placed<T>, ContactError<T>> {
        let zero = T::zero();
        let width = T::of(2.0) * half_width;
        let room = self.room();
        let [room_left, room_right] = room;
        match self.goal.limits() {
            [Some(left), _] if width >= room_right => {
                return self.attempt(Interval { left, right: self.range[1] }).map(Placed::At);
            }
            [Some(left), _] => {
                return self.attempt(Interval { left, right: left + width }).map(Placed::At);
            }
            [_, Some(right)] if width >= room_left => {
                return self.attempt(Interval { left: self.range[0], right }).map(Placed::At);
            }
            [_, Some(right)] => {
                return self.attempt(Interval { left: right - width, right }).map(Placed::At);
            }
            [None, None] => {}
        }
        let (near, far) = (self.near, 1 - self.near);
        let (lo, hi) = ((width - room[far]).max(zero), width.min(room[near]));
        if lo >= hi {
            // All of the bodies, up to rounding, may be just wide enough.
            let [left, right] = self.range;
            if lo - hi <= ulps::<T>() * (left.abs() + right.abs()) {
                let trial = self.attempt(Interval { left, right })?;
                if (self.unbalance)(&trial.excess) == zero {
                    return Ok(Placed::At(trial));
                }
            }
            return Ok(Placed::Beyond(usize::from(room_right < room_left)));
        }
        let origin = self.origin;
        let on = |reach: T| match near {
            0 => Interval { left: origin - reach, right: origin + (width - reach) },
            _ => Interval { left: origin + (reach - width), right: origin + reach },
        };
        let reached = |trial: &Trial<T>| reaches(trial.on, origin)[near];
        let mut reach = (self.share * width).max(lo).min(hi);
        let mut trial = self.attempt(on(reach))?;
        let widest = T::of(0.125) * width;
        let mut factor = T::of(2.0);
        let [low, high] = loop {
            let shift = (self.unbalance)(&trial.excess);
            if shift == zero {
                return Ok(self.placed(trial, width));
            }
            // Twice as far as the balance seems to be, so as to pass it.
            let past = self.stiffness.map(|stiffness| shift.abs() / stiffness * factor);
            let step = past.filter(|&past| past < widest).unwrap_or(widest * factor * T::of(0.5));
            let step = step.max(ulps::<T>() * reach).max(self.resolution());
            let outward = (shift > zero) == (near == 1);
            let next = if outward { (reach + step).min(hi) } else { (reach - step).max(lo) };
            if next == reach {
                // The balance lies beyond what is left of the bodies, or of the contact.
                return if reach == room[near] {
                    Ok(Placed::Beyond(near))
                } else if reach == width - room[far] {
                    Ok(Placed::Beyond(far))
                } else {
                    Ok(match self.goal {
                        Goal::Strength { .. } => Placed::Adrift(trial.on),
                        // Not balanced, it still tells whether to widen; then it may find its
                        // balance, and if not, the pressures at its edges show it.
                        Goal::Pressure { .. } => Placed::At(trial),
                    })
                };
            }
            let before = trial;
            trial = self.attempt(on(next))?;
            let moved = (self.unbalance)(&trial.excess);
            reach = next;
            if moved != zero {
                let rightward = reached(&trial) - reached(&before);
                let rightward = if near == 1 { rightward } else { -rightward };
                let stiffness = (shift - moved) / rightward;
                self.stiffness = Some(stiffness).filter(|&stiffness| stiffness > zero);
                if (shift > zero) != (moved > zero) {
                    break if outward { [before, trial] } else { [trial, before] };
                }
            }
            factor *= T::of(4.0);
        };
        let unbalance = self.unbalance;
        let ends = Bracket::new(reached(&low), reached(&high))
            .values(unbalance(&low.excess), unbalance(&high.excess));
        let mut best = nearer(low, high, unbalance);
        let trial =
            self.run(&ends, &mut best, unbalance, |search, reach| search.attempt(on(reach)))?;
        Ok(self.placed(trial, width))
    }

    /// Remembers the near edge of a placed contact, and its share, for the next.
    fn placed(&mut self, trial: Trial<T>, width: T) -> Placed<T> {
        let reaches = reaches(trial.on, self.origin);
        if reaches[1 - self.near] < T::of(0.125) * reaches[self.near] {
            self.near = 1 - self.near;
        }
        self.share = reaches[self.near] / width;
        Placed::At(trial)
    }

    /// The balanced contact that reaches just to one end of the bodies, wider than a given one.
    fn pin(&mut self, end: usize, narrow: Interval<T>) -> Result<Trial<T>, ContactError<T>> {
        let (origin, range, room) = (self.origin, self.range, self.room());
        let on = |other: T| match end {
            0 => Interval { left: range[0], right: origin + other },
            _ => Interval { left: origin - other, right: range[1] },
        };
        let least = if end == 0 { narrow.right - origin } else { origin - narrow.left };
        let (near, far) = (self.attempt(on(least))?, self.attempt(on(room[1 - end]))?);
        let [f_near, f_far] = [near.excess.shift(), far.excess.shift()];
        if f_far == T::zero() || (f_near > T::zero()) == (f_far > T::zero()) {
            return Ok(far);
        }
        let ends = Bracket::new(least, room[1 - end]).values(f_near, f_far);
        let mut best = nearer(near, far, Excess::shift);
        self.run(&ends, &mut best, Excess::shift, |search, other| search.attempt(on(other)))
    }

    /// Runs the user's strategy on one of the conditions and returns the best trial met.
    fn run(
        &mut self,
        bracket: &Bracket<T>,
        best: &mut Trial<T>,
        condition: fn(&Excess<T>) -> T,
        mut attempt: impl FnMut(&mut Self, T) -> Result<Trial<T>, ContactError<T>>,
    ) -> Result<Trial<T>, ContactError<T>> {
        let mut failed = None;
        let strategy = self.strategy;
        let resolution = self.resolution();
        let falls = bracket.values.is_some_and(|[at_lo, _]| at_lo > T::zero());
        let [mut lo, mut hi] = [bracket.lo, bracket.hi];
        let on = best.on;
        let inside = |x: T| {
            if x >= bracket.lo && x <= bracket.hi {
                return Ok(());
            }
            let source = SearchError::Astray { x, lo: bracket.lo, hi: bracket.hi };
            Err(ContactError::LimitSearch { best: on, source })
        };
        let found = strategy.find(
            &mut |unknown| match inside(unknown).and_then(|()| attempt(self, unknown)) {
                Ok(trial) => {
                    *best = nearer(trial, *best, condition);
                    let value = condition(&trial.excess);
                    if (value > T::zero()) == falls {
                        lo = unknown
                    } else {
                        hi = unknown
                    }
                    if hi - lo <= resolution { T::zero() } else { value }
                }
                Err(error) => {
                    // A value that is not finite ends any search.
                    failed = Some(error);
                    T::of(f64::NAN)
                }
            },
            bracket,
        );
        match (failed, found) {
            (Some(error), _) => Err(error),
            (None, Ok(_)) => Ok(*best),
            (None, Err(source)) => Err(ContactError::LimitSearch { best: best.on, source }),
        }
    }

    /// Far from x = 0, contacts closer than this are the same numbers.
    fn resolution(&self) -> T {
        T::of(2.0) * T::epsilon() * self.origin.abs()
    }

    /// How far a contact can reach to the left and to the right of the origin.
    fn room(&self) -> [T; 2] {
        [self.origin - self.range[0], self.range[1] - self.origin]
    }

    fn no_balance(&self, half_width: T) -> ContactError<T> {
        ContactError::NoBalance { half_width, near: self.origin }
    }

    /// The error for a contact that reaches the end of the bodies and must still widen.
    fn too_short(&mut self, end: usize, on: Interval<T>) -> ContactError<T> {
        match self.goal {
            Goal::Pressure { wanted, .. } => {
                let met = self.attempt(on).and_then(|trial| wanted.met(on, &trial.excess));
                met.err().unwrap_or(self.no_balance(on.half_width()))
            }
            Goal::Strength { conditions, .. } => match self.engine.moments(self.gap, on) {
                Ok(m) => ContactError::TooShort {
                    end: self.range[end],
                    carried: conditions.balance(on, &m).unwrap_or(self.load),
                    load: self.load,
                },
                Err(error) => error,
            },
        }
    }
}

/// How far a contact reaches to the left and to the right of a point in it.
fn reaches<T: Real>(on: Interval<T>, origin: T) -> [T; 2] {
    [origin - on.left, on.right - origin]
}

fn nearer<T: Real>(one: Trial<T>, other: Trial<T>, condition: fn(&Excess<T>) -> T) -> Trial<T> {
    if condition(&other.excess).abs() < condition(&one.excess).abs() { other } else { one }
}
