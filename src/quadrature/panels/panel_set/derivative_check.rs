//! Whether a body's derivatives are those of its heights.

use super::PanelSet;
use crate::gap::{Gap, CurveSample};
use crate::{Body, ContactError, ProfileError, Real};

impl<T: Real> PanelSet<T> {
    /// Whether the heights of the last points agree with the slopes there, to a third: a wrong
    /// sign or factor in a derivative, not a formula that is merely hard to evaluate.
    pub(super) fn check_slopes(&self, gap: &Gap<'_, T>) -> Result<(), ContactError<T>> {
        for (body, trace) in [Body::Lower, Body::Upper].into_iter().zip(&self.traces) {
            let curve_samples = trace.curve_samples();
            let n = curve_samples.len();
            if trace.direct || n < 8 {
                continue;
            }
            // How far two points are apart in height, and how far they should be.
            let rise = |i: usize| {
                let [one, other] = [&curve_samples[i], &curve_samples[i + 1]];
                let due = T::of(0.5) * (other.x - one.x) * (one.slope + other.slope);
                [other.y - one.y, due]
            };
            let (mut off, mut sum, mut rounded) = (T::zero(), T::zero(), T::zero());
            for i in 0..n - 1 {
                let [rise, due] = rise(i);
                off += (rise - due).abs();
                sum += rise.abs() + due.abs();
                rounded = rounded.max(curve_samples[i].y.abs() + (curve_samples[i].x * curve_samples[i].slope).abs());
            }
            if !sum.is_finite()
                && let Some(curve_sample) = curve_samples.iter().find(|curve_sample| !curve_sample.y.is_finite())
            {
                let source = ProfileError::NotFinite { quantity: "Y", k: curve_sample.k, value: curve_sample.y };
                return Err(ContactError::Profile { body, source });
            }
            let noise = T::of(1e4) * T::epsilon() * rounded.max(trace.height());
            let noise = noise + T::of(1e-6) * self.size * (curve_samples[n - 1].x - curve_samples[0].x);
            if off > T::of(0.3) * sum + noise {
                let miss = |i: usize| rise(i)[0] - rise(i)[1];
                let worse = |i: usize, j: usize| if miss(j).abs() > miss(i).abs() { j } else { i };
                let i = (0..n - 1).fold(0, worse);
                // A wave that both bodies have is in no gap, and need not be resolved.
                let near = |curve_sample: &CurveSample<T>| {
                    // Nor need it be longer than the step of a difference.
                    let differences = [T::epsilon().cbrt(), T::epsilon().sqrt()]
                        .map(|share| gap.difference(body, curve_sample.x, curve_sample.k, share));
                    let is_wrong = |difference: &T| {
                        let apart = (*difference - curve_sample.slope).abs();
                        apart > T::of(0.2) * difference.abs().max(curve_sample.slope.abs())
                    };
                    let wrong = differences.iter().all(is_wrong);
                    wrong.then_some((curve_sample.k, curve_sample.slope, differences[0]))
                };
                let Some((k, given, difference)) = near(&curve_samples[i]).or(near(&curve_samples[i + 1])) else {
                    continue;
                };
                let quantity = "the slope Y'/X'";
                let source = ProfileError::Derivative { quantity, k, given, difference };
                return Err(ContactError::Profile { body, source });
            }
        }
        Ok(())
    }
}
