//! Check of a body's derivatives against its heights.

use super::PanelSet;
use crate::gap::{Cost, CurveSample, Gap, Sampler};
use crate::numerics::chebyshev::{Table, primitive, values};
use crate::quadrature::panels::panel::{NodeHeight, Panel, rise, within};
use crate::{Body, ContactError, Fallible, InputError, Interval, ProfileError, Real};

impl<T: Real> PanelSet<T> {
    /// Refuses a wrong sign or factor in a derivative. Looks at the two last points whose heights
    /// contradict their slopes most.
    pub(super) fn check_slopes(&self, gap: &Gap<'_, T>) -> Fallible<T, ()> {
        for (body, cache) in [Body::Lower, Body::Upper].into_iter().zip(&self.traces) {
            let samples = cache.curve_samples();
            if cache.direct || samples.len() < 8 {
                continue;
            }
            let refuse = |source| Err(InputError::Profile { body, source }.into());
            if let Some(&CurveSample { k, y, .. }) = samples.iter().find(|one| !one.y.is_finite()) {
                return refuse(ProfileError::NotFinite { quantity: "Y", k, value: y });
            }
            let miss = |pair: &[CurveSample<T>]| {
                let rise = T::of(0.5) * (pair[1].x - pair[0].x) * (pair[0].slope + pair[1].slope);
                (pair[1].y - pair[0].y - rise).abs()
            };
            let worse = |one, other| if miss(other) > miss(one) { other } else { one };
            for &CurveSample { k, x, slope, .. } in
                samples.windows(2).reduce(worse).into_iter().flatten()
            {
                // A wave that both bodies share is not in the gap, and may be shorter than the step
                // of a difference.
                let differences = [T::epsilon().cbrt(), T::epsilon().sqrt()]
                    .map(|share| gap.difference(body, x, k, share));
                let is_wrong = |difference: &T| {
                    let apart = (*difference - slope).abs();
                    apart > T::of(0.3) * (difference.abs() + slope.abs())
                };
                if differences.iter().all(is_wrong) {
                    let (quantity, given, difference) = ("the slope Y'/X'", slope, differences[0]);
                    return refuse(ProfileError::Derivative { quantity, k, given, difference });
                }
            }
        }
        Ok(())
    }

    /// Checks that the gap rises from each node to the next by the same amount by heights as by
    /// slopes, within the uncertainty of both: a step in the heights shows in no slope. `steepest`
    /// is the largest sum of the slopes of both bodies. (Waves that both bodies share are not in
    /// the gap, and their slopes need not be resolved.)
    pub(super) fn check_heights<const N: usize>(
        &self,
        panel: &mut Panel<T>,
        steepest: T,
    ) -> Fallible<T, ()> {
        if self.traces.iter().all(|cache| cache.direct) {
            return Ok(());
        }
        let (half, table) = (panel.half(), Table::of(N));
        let place = |i: usize| panel.x[0] + half * T::of(1.0 + table.z[i]);
        let mut near = self.heights_near::<N>(std::array::from_fn(place));
        panel.outermost = Some([near[0], near[N - 1]]);
        let z: [T; N] = std::array::from_fn(|i| T::of(table.z[i]));
        let rises = |series: &[T]| values(&primitive(series)[..=series.len()], &z);
        for (i, slopes) in self.slopes.iter().enumerate() {
            // Bodies that know their slopes rise by these; flat ones do not.
            let known: [T; N] = std::array::from_fn(|j| sign::<T>(i) * half * slopes[j]);
            if self.traces[i].direct && known.iter().any(|slope| !slope.is_zero()) {
                let risen = rises(&table.coefficients(&known));
                near.iter_mut().zip(risen).for_each(|(near, rise)| near.height += rise);
            }
        }
        let share = T::epsilon().cbrt() * steepest + T::of(16.0) * panel.error;
        // Those left out add up to less than a sixteenth of what is allowed.
        let counts = |a: &T| T::of(16.0 * N as f64) * a.abs() > share;
        let last = panel.coefficients().iter().rposition(counts).unwrap_or(0);
        let by_slopes = rises(&panel.series[..=last]).map(|rise| half * rise);
        match self.contradiction(&near, &by_slopes, share) {
            Some((_, error)) => Err(error),
            None => Ok(()),
        }
    }

    /// Returns the heights at places, of the bodies whose points were taken near them. The next
    /// point bounds the change of slope up to a place.
    pub(super) fn heights_near<const N: usize>(&self, places: [T; N]) -> [NodeHeight<T>; N] {
        let (height, doubt) = (T::zero(), T::zero());
        let mut nodes = places.map(|x| NodeHeight { x, height, doubt, slopes: [T::zero(); 2] });
        for (body, cache) in self.traces.iter().enumerate() {
            if cache.direct {
                let both = nodes.iter_mut().zip(&self.slopes[body]);
                both.for_each(|(node, &slope)| node.slopes[body] = slope);
                continue;
            }
            let (points, highest) = (cache.curve_samples(), cache.height());
            for (i, node) in nodes.iter_mut().enumerate() {
                let (near, next) = (points[i], points[if i == 0 { 1 } else { i - 1 }]);
                let missed = node.x - near.x;
                let highest = highest.max(near.y.abs() + (near.x * near.slope).abs());
                node.height += sign::<T>(body) * (near.y + missed * near.slope);
                node.doubt += (missed * (next.slope - near.slope)).abs() + rounding(highest);
                node.slopes[body] = near.slope;
            }
        }
        nodes
    }

    /// Checks that the gap rises from the last node of a panel to the first of the next one by the
    /// same amount by heights as by slopes: both walls of a groove or a land may lie between them.
    pub(super) fn check_between(&self, left: &Panel<T>, right: &Panel<T>) -> Fallible<T, ()> {
        let (Some([_, from]), Some([mut to, _])) = (left.outermost, right.outermost) else {
            return Ok(());
        };
        // Where the panels do not meet, one of them holds up to an unknown place between the nodes.
        let mismatch = (left.at_ends()[1] - right.at_ends()[0]).abs();
        let mut share = T::of(16.0) * (left.error + right.error) + mismatch;
        for (body, cache) in self.traces.iter().enumerate() {
            let [one, other] = [from.slopes[body], to.slopes[body]];
            share += T::epsilon().cbrt() * one.abs().max(other.abs());
            if cache.direct {
                to.height += sign::<T>(body) * T::of(0.5) * (one + other) * (to.x - from.x);
                share += (other - one).abs();
            }
        }
        let by_slopes = left.rise(from.x, left.x[1]) + right.rise(right.x[0], to.x);
        self.compare([&from, &to], by_slopes, share)
    }

    /// Refuses heights at two places between which the slopes rise by another amount. The share of
    /// the distance between them is uncertain.
    fn compare(&self, nodes: [&NodeHeight<T>; 2], by_slopes: T, share: T) -> Fallible<T, ()> {
        let [from, to] = nodes;
        let mut open = from.doubt + to.doubt + share * (to.x - from.x);
        for (body, noise) in self.noise.iter().flatten().enumerate() {
            open += noise.of_height(from.slopes[body]) + noise.of_height(to.slopes[body]);
        }
        let (between, by_heights) = ([from.x, to.x], to.height - from.height);
        Rises { between, by_heights, by_slopes, highest: T::zero(), open }.compare()
    }

    /// Returns the first of some places up to which the gap rises otherwise by heights than by
    /// slopes, from the place before, with the error that tells so.
    pub(super) fn contradiction(
        &self,
        near: &[NodeHeight<T>],
        by_slopes: &[T],
        share: T,
    ) -> Option<(usize, ContactError<T>)> {
        (1..near.len()).find_map(|i| {
            let nodes = [&near[i - 1], &near[i]];
            let found = self.compare(nodes, by_slopes[i] - by_slopes[i - 1], share);
            found.err().map(|error| (i, error))
        })
    }

    /// Returns the heights of the gap of the bodies as described, at rising places, and the largest
    /// height of either body; refuses heights that contradict the slopes between them.
    pub fn heights<const N: usize>(
        &self,
        gap: &Gap<'_, T>,
        places: [T; N],
        cost: &mut Cost,
    ) -> Result<([T; N], T), ContactError<T>> {
        let mut sampler = Sampler::default();
        let mut heights = [T::zero(); N];
        for (height, x) in heights.iter_mut().zip(places) {
            *height = sampler.height_as_described(gap, x)?;
        }
        for (between, heights) in places.windows(2).zip(heights.windows(2)) {
            let (from, to) = (between[0], between[1]);
            let (by_slopes, highest) = (rise(self.as_described(), from, to), sampler.highest);
            let by_heights = heights[1] - heights[0];
            let span = within(self.as_described(), Interval { left: from, right: to });
            // Flats have the rounding of the rest, too.
            let doubt = |on: &Panel<T>| (on.error + self.tolerance * self.size) * on.half();
            let open = span.iter().fold(T::zero(), |sum, on| sum + T::of(16.0) * doubt(on));
            let rises = Rises { between: [from, to], by_heights, by_slopes, highest, open };
            rises.compare_beside_noise(gap, &mut sampler)?;
        }
        cost.heights += sampler.cost.evaluations;
        Ok((heights, sampler.highest))
    }
}

/// Returns the sign of a body's height in the gap.
fn sign<T: Real>(body: usize) -> T {
    if body == 0 { -T::one() } else { T::one() }
}

/// Returns the rounding of a height.
fn rounding<T: Real>(highest: T) -> T {
    T::of(64.0) * T::epsilon() * highest
}

/// Rise of the gap from one place to another, by heights and by slopes: lengths.
#[derive(Clone, Copy)]
pub(crate) struct Rises<T> {
    pub between: [T; 2],
    pub by_heights: T,
    pub by_slopes: T,
    /// Largest height of either body.
    pub highest: T,
    /// Uncertainty of heights and slopes, apart from rounding.
    pub open: T,
}

impl<T: Real> Rises<T> {
    /// Refuses heights that contradict the slopes.
    pub fn compare(self) -> Result<(), ContactError<T>> {
        let Self { between, by_heights, by_slopes, highest, open } = self;
        let apart = (by_heights - by_slopes).abs() - T::of(2.0) * rounding(highest);
        let share = || T::epsilon().cbrt() * (by_heights.abs() + by_slopes.abs());
        // Most need no root.
        if apart <= open || apart <= open + share() {
            return Ok(());
        }
        Err(InputError::InconsistentHeights { between, by_heights, by_slopes }.into())
    }

    /// Refuses heights that contradict the slopes by more than their noise, measured at both places
    /// after a contradiction. A joint between them with a step that is one by itself is named, but
    /// where a period begins anew.
    pub fn compare_beside_noise(
        self,
        gap: &Gap<'_, T>,
        sampler: &mut Sampler<T>,
    ) -> Result<(), ContactError<T>> {
        let Err(error) = self.compare() else { return Ok(()) };
        let ([left, right], mut known) = (self.between, self);
        for x in self.between {
            known.open += sampler.noise_of_height(gap, x)?;
        }
        // The height at a joint is that on its left.
        for x in std::iter::once(left).chain(gap.breakpoints(Interval { left, right })) {
            let [turn, by_heights] = gap.jump(x);
            // A wall is as high as the x of both of its ends tell.
            let wall = rounding((x * turn).abs());
            known.open += if wall.is_finite() { wall } else { T::zero() };
            if gap.is_seam(x) {
                known.open += by_heights.abs();
                continue;
            }
            Self { between: [x; 2], by_heights, by_slopes: T::zero(), ..known }.compare()?;
        }
        known.compare().map_err(|_| error)
    }
}
