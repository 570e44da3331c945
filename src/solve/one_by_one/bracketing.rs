//! Search for one unknown: steps outward until a root is enclosed, then the user's strategy.

use super::{NestedSearch, Trial, ulps};
use crate::search::{Bracket, try_find};
use crate::{Fallible, Real, SolveError};

/// Factor by which steps go further beyond a root each time that they do not reach it.
const STEP_GROWTH: f64 = 4.0;

/// Unknown of a search.
pub(super) struct Unknown<T> {
    /// Place of the first trial, and the ends of all trials.
    pub from: T,
    pub ends: [T; 2],
    /// Decrease of the condition per unit of the unknown, or of its logarithm; zero if unknown.
    pub slope: T,
    /// Longest distance of a root that the slope alone tells; `None` if steps and slope are those
    /// of the logarithm.
    pub longest: Option<T>,
}

/// End of a search that has met no root: the last trial, and the first place without one.
pub(super) struct Missed<T> {
    pub last: Option<Trial<T>>,
    pub at: T,
}

/// Trial that meets a condition, or the end of the search for it.
type Sought<T> = Fallible<T, Result<Trial<T>, Missed<T>>>;

impl<T: Real> Unknown<T> {
    fn moved(&self, from: T, step: T) -> T {
        if self.longest.is_some() { from + step } else { from * step.exp() }
    }

    fn step(&self, from: T, to: T) -> T {
        if self.longest.is_some() { to - from } else { (to / from).ln() }
    }

    /// Returns the place a little beyond the root, as far as the value at the last place tells;
    /// the next time further.
    fn after(&self, x: T, value: T, times: T) -> T {
        let distance = value.abs() / self.slope;
        let (step, least) = match self.longest {
            // Twice as far as it seems, the root is in the middle.
            Some(longest) => (distance.min(longest) * (T::one() + times), x.abs()),
            None => (distance + T::of(0.1) * times * distance.min(T::one()), T::one()),
        };
        let step = step.max(ulps::<T>() * least);
        let next = self.moved(x, if value > T::zero() { step } else { -step });
        next.max(self.ends[0]).min(self.ends[1])
    }
}

impl<T: Real> NestedSearch<'_, T> {
    /// Finds the root of a condition that is positive where the unknown is too small. Some values
    /// of the unknown may have no trial.
    pub fn root(
        &mut self,
        unknown: &mut Unknown<T>,
        condition: impl Fn(&Trial<T>) -> T,
        mut attempt: impl FnMut(&mut Self, T) -> Fallible<T, Option<Trial<T>>>,
    ) -> Sought<T> {
        let (half, [least, most]) = (T::of(0.5), unknown.ends);
        let mut x = unknown.from.max(least).min(most);
        let mut last: Option<(T, Trial<T>)> = None;
        let (mut missed, mut end, mut times) = (None, None, T::one());
        let enclosed = loop {
            let narrower = last.filter(|_| unknown.longest.is_none());
            let is_borne = |Trial { residual, .. }: &Trial<T>| {
                narrower.is_none_or(|(_, was)| !residual.is_beyond_most(&was.residual))
            };
            let Some(trial) = attempt(self, x)?.filter(is_borne) else {
                let at = *missed.get_or_insert(x);
                let back = last.map_or(least, |(at, _)| at);
                if (x - back).abs() <= T::epsilon().sqrt() * back.abs() {
                    return Ok(Err(Missed { last: last.map(|(_, trial)| trial), at }));
                }
                (end, x) = (Some(x), half * back + half * x);
                continue;
            };
            let value = condition(&trial);
            if value.is_zero() {
                return Ok(Ok(trial));
            }
            if let Some((at, before)) = last.replace((x, trial)) {
                let was = condition(&before);
                let slope = (was - value) / unknown.step(at, x);
                // The load of convex bodies grows no slower than the width.
                if slope > unknown.longest.map_or(T::one(), |_| T::zero()) {
                    unknown.slope = slope;
                }
                if (was > T::zero()) != (value > T::zero()) {
                    break [(x, trial), (at, before)];
                }
            }
            let mut next = unknown.after(x, value, times);
            if let Some(end) = end.filter(|&end| (x < end) != (next < end)) {
                next = half * x + half * end;
            }
            if next == x {
                return Ok(Err(Missed { last: Some(trial), at: missed.unwrap_or(x) }));
            }
            (x, times) = (next, times * T::of(STEP_GROWTH));
        };
        self.between(enclosed, unknown, condition, attempt).map(Ok)
    }

    /// Finds an enclosed root by the user's strategy: the best trial on its way.
    fn between(
        &mut self,
        mut enclosed: [(T, Trial<T>); 2],
        unknown: &Unknown<T>,
        condition: impl Fn(&Trial<T>) -> T,
        mut attempt: impl FnMut(&mut Self, T) -> Fallible<T, Option<Trial<T>>>,
    ) -> Fallible<T, Trial<T>> {
        let missing =
            enclosed.map(|(_, Trial { residual: r, .. })| (r.at_a + r.at_b).abs() / r.size);
        if missing[1] < missing[0] {
            enclosed.swap(0, 1);
        }
        let [(near, mut best), (far, other)] = enclosed;
        let (zero, one) = (T::zero(), T::one());
        // From one upward, an error of a logarithm is relative to the unknown near this end.
        let [from, first, way] = match unknown.longest {
            Some(_) => [zero, zero, one],
            None => [near, one, if near < far { one } else { -one }],
        };
        let end = |x, trial| (first + way * unknown.step(from, x), condition(trial));
        let (mut lo, mut hi) = (end(near, &best), end(far, &other));
        if lo.0 > hi.0 {
            (lo, hi) = (hi, lo);
        }
        let bracket = Bracket::new(lo.0, hi.0).values(lo.1, hi.1);
        let mut value_of = |trial: Trial<T>| {
            let value = condition(&trial);
            if value.abs() <= condition(&best).abs() {
                best = trial;
            }
            value
        };
        value_of(other);
        self.cost.searches += 1;
        let strategy = self.contact.strategy();
        let function = |place: T| {
            self.cost.search_values += 1;
            let x = unknown.moved(from, way * (place - first));
            Ok(value_of(attempt(self, x)?.ok_or_else(|| self.no_balance(x))?))
        };
        let found = try_find(strategy, function, &bracket);
        let failed = |source| SolveError::LimitSearch { best: best.on, source }.into();
        found.map_err(|error| error.or_else(failed)).map(|_| best)
    }
}
