//! Where the stress is largest.

use super::{Stress, StressPeak, Subsurface};
use crate::{ContactError, Interval, Real};

/// Abscissae and depths of the first look.
const COLUMNS: usize = 33;
const ROWS: usize = 32;

/// The depths looked at, in half-widths.
const SHALLOWEST: f64 = 1e-6;
const DEEPEST: f64 = 4.0;

impl<T: Real> Subsurface<'_, T> {
    /// The largest shear stress in the plane, as far as a grid of 33 abscissae, from half a half-width
    /// beyond either edge, and 32 depths from a millionth of the half-width to four of them shows
    /// which maximum is the largest. Its value has nearly all digits, its place half of them.
    ///
    /// At the least depth it stands for a maximum on the surface itself, where strong friction puts
    /// it.
    ///
    /// # Errors
    /// [`ContactError::Singular`] where the stress is infinite, at an edge where the pressure is; those
    /// of [`at`](Self::at).
    pub fn max_shear(&self) -> Result<StressPeak<T>, ContactError<T>> {
        self.largest(|stress| Ok(stress.max_shear()))
    }

    /// The largest equivalent stress of von Mises, found in the same way.
    ///
    /// # Errors
    /// As [`max_shear`](Self::max_shear); [`ContactError::PoissonRatio`].
    pub fn max_von_mises(&self, poisson: T) -> Result<StressPeak<T>, ContactError<T>> {
        self.largest(|stress| stress.von_mises(poisson))
    }

    fn largest(
        &self,
        value: impl Fn(Stress<T>) -> Result<T, ContactError<T>>,
    ) -> Result<StressPeak<T>, ContactError<T>> {
        let on = self.interval();
        let Interval { left, right } = on;
        for (x, strength) in [(right, self.strengths[0]), (left, self.strengths[1])] {
            if strength.abs() > T::of(64.0) * T::epsilon() * self.mean.abs() {
                return Err(ContactError::Singular { x });
            }
        }
        let (centre, half_width) = (on.centre(), on.half_width());
        // By places in half-widths, the depth by its logarithm.
        let [shallowest, deepest] = [SHALLOWEST, DEEPEST].map(|depth| T::of(depth.ln()));
        let peak = |[along, down]: [T; 2]| {
            let (x, depth) = (centre + half_width * along, half_width * down.exp());
            Ok(StressPeak { x, depth, value: value(self.at(x, depth)?)? })
        };
        let step = [3.0 / (COLUMNS - 1) as f64, (DEEPEST / SHALLOWEST).ln() / (ROWS - 1) as f64];
        let [mut across, mut deeper] = step.map(T::of);
        let mut place = [T::zero(); 2];
        let mut best = StressPeak { x: centre, depth: half_width, value: -T::one() };
        for column in 0..COLUMNS {
            for row in 0..ROWS {
                let along = T::of(-1.5) + across * T::count(column);
                let here = [along, shallowest + deeper * T::count(row)];
                let found = peak(here)?;
                if found.value > best.value {
                    (place, best) = (here, found);
                }
            }
        }
        // Uphill by ever smaller steps, until rounding hides the top.
        let least = T::of(0.1) * T::epsilon().sqrt();
        while across.max(deeper) > least {
            let mut moved = false;
            for [dx, dy] in [[across, T::zero()], [T::zero(), deeper]] {
                for sign in [T::one(), -T::one()] {
                    let down = (place[1] + sign * dy).max(shallowest).min(deepest);
                    let here = [place[0] + sign * dx, down];
                    let found = peak(here)?;
                    if found.value > best.value {
                        (place, best, moved) = (here, found, true);
                    }
                }
            }
            if !moved {
                (across, deeper) = (T::of(0.5) * across, T::of(0.5) * deeper);
            }
        }
        Ok(best)
    }
}
