//! First points of a piece, near the targets by an approximate series or on it.

use super::TargetBatch;
use super::curve_samples::{CurveSample, CurveSamples};
use crate::Real;
use crate::gap::Cost;
use crate::gap::survey::Series;
use crate::real::is_finite;

impl<const N: usize, T: Real> TargetBatch<'_, N, T> {
    /// Returns the points of a series at the targets; `None` beyond its range, or where rounding
    /// counts.
    pub fn by_series(&self, guide: &Series<T>) -> Option<[CurveSample<T>; N]> {
        let [from, to] = self.piece.x();
        if self.targets[N - 1] - self.targets[0] < T::epsilon().sqrt() * (to - from) {
            return None;
        }
        let mut samples = [self.ends[0]; N];
        for (sample, &target) in samples.iter_mut().zip(self.targets) {
            *sample = guide.sample_near(target)?;
        }
        Some(samples)
    }

    /// Evaluates points where a guide has the targets, all in one batch, and keeps them if they
    /// rise.
    pub fn follow(&self, guide: &Series<T>, known: &mut CurveSamples<T>, cost: &mut Cost) {
        let mut k = [T::zero(); N];
        for (k, &target) in k.iter_mut().zip(self.targets) {
            let Some(found) = guide.parameter_near(target) else { return };
            *k = found;
        }
        let mut points = [self.piece.ends[0]; N];
        self.piece.curve.at_many(&k, &mut points);
        cost.evaluations = cost.evaluations.saturating_add(N);
        let samples: [_; N] = std::array::from_fn(|i| CurveSample::new(k[i], points[i]));
        let [start, end] = self.ends;
        let rise = |one: &CurveSample<T>, other: &CurveSample<T>| one.x < other.x;
        let inside = rise(&start, &samples[0]) && rise(&samples[N - 1], &end);
        let is_finite = samples.iter().all(|sample| is_finite(sample.slope));
        if inside && is_finite && samples.windows(2).all(|pair| rise(&pair[0], &pair[1])) {
            known.set(self.ends, &samples);
        }
    }
}
