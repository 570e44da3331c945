//! Check of a body's derivatives against its heights.

use super::PanelSet;
use crate::gap::{Cost, CurveSample, Gap, Sampler};
use crate::numerics::chebyshev::{Coeffs, MAX_SIZE, Table};
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

    /// Checks that the gap rises from each node to the next by the same amount by heights as by
    /// slopes, within the uncertainty of both: a step in the heights shows in no slope. `steepest`
    /// is the largest sum of the slopes of both bodies. (Waves that both bodies share are not in
    /// the gap, and their slopes need not be resolved.)
    pub(super) fn check_heights(
        &self,
        panel: &Panel<T>,
        steepest: T,
    ) -> Result<(), ContactError<T>> {
        if self.traces.iter().all(|cache| cache.direct) {
            return Ok(());
        }
        let (n, half, table) = (panel.n, panel.half(), Table::of(panel.n));
        let place = |i: usize| panel.x[0] + half * T::of(1.0 + table.z[i]);
        let places: Coeffs<T> = std::array::from_fn(|i| place(i.min(n - 1)));
        // Of bodies with heights to be compared, and of others.
        let mut rises = [[T::zero(); MAX_SIZE]; 2];
        for (i, cache) in self.traces.iter().enumerate() {
            let (slopes, sum) = (&self.slopes[i][..n], &mut rises[usize::from(cache.direct)]);
            if slopes.iter().all(T::is_zero) {
                continue;
            }
            let reach = sign::<T>(i) * half;
            for (sum, rise) in sum[..n].iter_mut().zip(table.rises(slopes)) {
                *sum += reach * rise;
            }
        }
        let share = T::epsilon().cbrt() * steepest + T::of(16.0) * panel.error;
        match self.contradiction(&places[..n], rises, share) {
            Some((_, error)) => Err(error),
            None => Ok(()),
        }
    }

    /// Returns the first place up to which the gap rises otherwise by heights than by slopes, from
    /// the place before, with the error that tells so. The rises up to each place are those of
    /// bodies whose heights were taken near the places, and of others.
    pub(super) fn contradiction(
        &self,
        places: &[T],
        [sought, known]: [Coeffs<T>; 2],
        share: T,
    ) -> Option<(usize, ContactError<T>)> {
        let (mut heights, mut doubt, mut highest) = (known, [T::zero(); MAX_SIZE], T::zero());
        for (i, cache) in self.traces.iter().enumerate().filter(|(_, cache)| !cache.direct) {
            let points = &cache.curve_samples()[..places.len()];
            for (j, (near, place)) in points.iter().zip(places).enumerate() {
                // The point is near the place, not at it; the next point bounds the change of slope
                // between them.
                let next = points[if j == 0 { 1 } else { j - 1 }];
                let missed = *place - near.x;
                heights[j] += sign::<T>(i) * (near.y + missed * near.slope);
                doubt[j] += (missed * (next.slope - near.slope)).abs();
                doubt[j] += self.noise_of_height(i, near.slope);
                highest = highest.max(near.y.abs() + (near.x * near.slope).abs());
            }
            highest = highest.max(cache.height());
        }
        (1..places.len()).find_map(|i| {
            let between = [places[i - 1], places[i]];
            let open = doubt[i - 1] + doubt[i] + share * (between[1] - between[0]);
            let by_heights = heights[i] - heights[i - 1];
            let by_slopes = (sought[i] - sought[i - 1]) + (known[i] - known[i - 1]);
            let rises = Rises { between, by_heights, by_slopes, highest, open };
            rises.compare().err().map(|error| (i, error))
        })
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

/// Returns the sign of a body's height in the gap.
fn sign<T: Real>(body: usize) -> T {
    if body == 0 { -T::one() } else { T::one() }
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
