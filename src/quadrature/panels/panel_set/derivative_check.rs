//! Check of a body's derivatives against its heights.

use super::PanelSet;
use crate::gap::{Cost, CurveSample, Gap, Sampler};
use crate::numerics::chebyshev::{Table, middle};
use crate::quadrature::panels::panel::{Panel, rise, within};
use crate::{Body, ContactError, InputError, Interval, ProfileError, Real};

impl<T: Real> PanelSet<T> {
    /// Refuses a wrong sign or factor in a derivative. Looks at the two last points whose heights
    /// contradict their slopes most.
    pub(super) fn check_slopes(&self, gap: &Gap<'_, T>) -> Result<(), ContactError<T>> {
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

    /// Returns the noise of a body's height at a given slope; zero if it was not measured.
    fn noise_of_height(&self, body: usize, slope: T) -> T {
        self.noise.map_or(T::zero(), |noise| noise[body].of_height(slope))
    }

    /// Checks that the gap rises between the first node, a middle one and the last by the same
    /// amount by heights as by slopes, within the uncertainty of both: a step in the heights shows
    /// in no slope. `steepest` is the largest sum of the slopes of both bodies. (Waves that both
    /// bodies share are not in the gap, and their slopes need not be resolved.)
    pub(super) fn check_heights(
        &self,
        panel: &Panel<T>,
        steepest: T,
    ) -> Result<(), ContactError<T>> {
        if self.traces.iter().all(|cache| cache.direct) {
            return Ok(());
        }
        let zero = T::zero();
        let (n, half, table) = (panel.n, panel.half(), Table::of(panel.n));
        let nodes = [0, middle(n), n - 1];
        let places = nodes.map(|i| panel.x[0] + half * T::of(1.0 + table.z[i]));
        let sloped = [0, 1].map(|i| table.rises(&self.slopes[i][..n]).map(|rise| half * rise));
        let (mut by_heights, mut doubt, mut rounded) = ([zero; 2], [zero; 3], zero);
        for (i, cache) in self.traces.iter().enumerate() {
            let sign = if i == 0 { -T::one() } else { T::one() };
            let mut rises = sloped[i];
            if !cache.direct {
                // The point is near the node, not at it; the next point bounds the change of slope
                // between them.
                let points = cache.curve_samples();
                let mut heights = [zero; 3];
                for (j, &node) in nodes.iter().enumerate() {
                    let [near, next] =
                        [node, if node == 0 { 1 } else { node - 1 }].map(|i| points[i]);
                    let missed = places[j] - near.x;
                    heights[j] = near.y + missed * near.slope;
                    doubt[j] += (missed * (next.slope - near.slope)).abs();
                    doubt[j] += self.noise_of_height(i, near.slope);
                    rounded = rounded.max(near.y.abs() + (near.x * near.slope).abs());
                }
                rises = [heights[1] - heights[0], heights[2] - heights[1]];
                rounded = rounded.max(cache.height());
            }
            by_heights = [0, 1].map(|i| by_heights[i] + sign * rises[i]);
        }
        let share = T::epsilon().cbrt() * steepest + T::of(16.0) * panel.error;
        for i in 0..2 {
            let [between, doubts] = [places, doubt].map(|all| [all[i], all[i + 1]]);
            let by_slopes = sloped[1][i] - sloped[0][i];
            let open = doubts[0] + doubts[1] + share * (between[1] - between[0]);
            let by_heights = by_heights[i];
            Rises { between, by_heights, by_slopes, highest: rounded, open }.compare()?;
        }
        Ok(())
    }

    /// Returns the heights of the gap of the bodies as described, at rising places; refuses heights
    /// that contradict the slopes between them.
    pub fn heights<const N: usize>(
        &self,
        gap: &Gap<'_, T>,
        places: [T; N],
        cost: &mut Cost,
    ) -> Result<[T; N], ContactError<T>> {
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
            let doubt = |sum, panel: &Panel<T>| sum + panel.error * (panel.x[1] - panel.x[0]);
            let open = T::of(8.0) * span.iter().fold(T::zero(), doubt);
            let rises = Rises { between: [from, to], by_heights, by_slopes, highest, open };
            rises.compare_beside_noise(gap, &mut sampler)?;
        }
        cost.heights += sampler.cost.evaluations;
        Ok(heights)
    }
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
        let apart = (by_heights - by_slopes).abs() - T::of(128.0) * T::epsilon() * highest;
        let share = || T::epsilon().cbrt() * (by_heights.abs() + by_slopes.abs());
        // Most need no root.
        if apart <= open || apart <= open + share() {
            return Ok(());
        }
        Err(InputError::InconsistentHeights { between, by_heights, by_slopes }.into())
    }

    /// Refuses heights that contradict the slopes by more than their noise, measured at both places
    /// after a contradiction.
    pub fn compare_beside_noise(
        self,
        gap: &Gap<'_, T>,
        sampler: &mut Sampler<T>,
    ) -> Result<(), ContactError<T>> {
        let Err(error) = self.compare() else { return Ok(()) };
        let mut open = self.open;
        for x in self.between {
            open += sampler.noise_of_height(gap, x)?;
        }
        Self { open, ..self }.compare().map_err(|_| error)
    }
}
