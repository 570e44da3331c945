//! Bodies that repeat with a period, seen over one period at a time.
//!
//! A body described over one period is repeated, and the gap has the range of one period from its
//! cut, a place where the bodies are far apart.

use super::repeated::Repeated;
use super::{Gap, Sampler, Shape, Surface};
use crate::{Body, Cost, Fallible, InputError, Real, Side};
use std::sync::Arc;

/// Number of places at which the first cut is sought; they lie as multiples of the golden ratio do,
/// so that no wave has the same height at all of them.
const CUT_PLACES: usize = 64;
const GOLDEN: f64 = 0.618_033_988_749_895;

/// Number of parts of a gap at whose ends a cut is sought.
const PLACES_IN_GAP: usize = 8;

/// Difference of both ends of a period, as a share of the range of heights or of the steepest
/// slope, up to which they are one place.
const SAME: f64 = 1e-9;

/// Number of places at which the heights are taken for the load of complete contact: sixteen for
/// each of 64 waves.
const HEIGHTS: usize = 1024;

/// Steps of Newton's method to the lowest pressure of complete contact: from half a place they
/// leave its rounding.
const STEPS: usize = 4;

impl<T: Real> Gap<'_, T> {
    /// Returns the gap of bodies that repeat with this period, cut where they are furthest apart.
    pub(crate) fn repeated(&self, period: T, cost: &mut Cost) -> Fallible<T, Self> {
        let start = self.start_of_period(period)?;
        let repeat = |body: Body| {
            let surface = &self.bodies[body as usize];
            if surface.is_endless() {
                return Ok(surface.shape.clone());
            }
            // Bodies may be described over different periods: the copies cover two from the start.
            let [left, _] = surface.extent();
            let first = period * ((start - left) / period + T::of(SAME)).floor();
            let is_exact = (left + first - start).abs() <= T::of(SAME) * period;
            let copies = if is_exact { 2 } else { 3 };
            let shifts: Vec<T> = (0..copies).map(|i| first + period * T::count(i)).collect();
            let body = Repeated::new(&surface.shape, &shifts);
            body.map(|body| Shape::Repeated(Arc::new(body)))
        };
        let repeat = |body| repeat(body).map_err(|source| InputError::Profile { body, source });
        let new = Self::new(repeat(Body::Lower)?, repeat(Body::Upper)?, self.inversion)?;
        let Self { watch, resolution, number, .. } = *self;
        let new = Self { watch, resolution, number, convex: false, period: Some(period), ..new };
        let gap = new.cut_at(start);
        let (mut sampler, mut steep) = (Sampler::default(), T::zero());
        let mut samples = Vec::with_capacity(CUT_PLACES);
        // The end of the description is the first: where it is the highest place, results are in x
        // as described.
        for i in 0..CUT_PLACES {
            let x = start + period * T::of((i as f64 * GOLDEN).fract());
            let mut slope = |body| sampler.body_slope(&gap, body, x, Side::Left);
            let [lower, upper] = [slope(Body::Lower)?, slope(Body::Upper)?];
            steep = steep.max(lower.abs()).max(upper.abs());
            samples.push([x, sampler.height(&gap, x)?, upper - lower]);
        }
        cost.heights += sampler.cost.evaluations;
        self.check_ends(&samples, [sampler.highest, steep])?;
        let higher = |one: [T; 3], other: [T; 3]| if other[1] > one[1] { other } else { one };
        let [highest, ..] =
            samples.into_iter().fold([start, -T::one() / T::zero(), T::zero()], higher);
        Ok(gap.cut_at(highest))
    }

    /// Returns the left end of the period over which a body is described, after a check of the
    /// length of both.
    fn start_of_period(&self, period: T) -> Fallible<T, T> {
        let mut start = None;
        for body in [Body::Lower, Body::Upper] {
            let surface = &self.bodies[body as usize];
            if surface.is_endless() {
                continue;
            }
            let [left, right] = surface.extent();
            if (right - left - period).abs() > tolerance::<T>() * period {
                let ends = [left, right - period];
                let what = "x, less the period on the right,";
                return Err(InputError::NotPeriodic { body, what, ends }.into());
            }
            start = start.or(Some(left));
        }
        Ok(start.unwrap_or(T::of(-0.5) * period))
    }

    /// Checks that heights and slopes of each body are the same at both ends of a period, given
    /// places all over it with the height and the slope of the gap there, and the largest of the
    /// bodies, whose rounding is no difference: bodies may be alike.
    fn check_ends(&self, samples: &[[T; 3]], largest: [T; 2]) -> Fallible<T, ()> {
        let zero = T::zero();
        let [low, high, steepest] = samples.iter().fold([zero; 3], |[low, high, steepest], at| {
            let above = at[1] - samples[0][1];
            [low.min(above), high.max(above), steepest.max(at[2].abs())]
        });
        for body in [Body::Lower, Body::Upper] {
            let surface = &self.bodies[body as usize];
            if surface.is_endless() {
                continue;
            }
            let (first, last) = (surface.piece(0), surface.piece(surface.len() - 1));
            let of_heights = [first.ends[0].y, last.ends[1].y];
            let of_slopes = [first.end_slope(0, &mut 0), last.end_slope(1, &mut 0)];
            let pairs =
                [("the height", of_heights, high - low), ("the slope", of_slopes, steepest)];
            for ((what, ends, size), largest) in pairs.into_iter().zip(largest) {
                let rounding = T::of(64.0) * T::epsilon() * largest;
                let is_same = (ends[1] - ends[0]).abs() <= tolerance::<T>() * size + rounding;
                if !is_same {
                    return Err(InputError::NotPeriodic { body, what, ends }.into());
                }
            }
        }
        Ok(())
    }

    /// Returns the same bodies over the period that begins at x, or one or more periods beside it.
    fn cut_at(&self, x: T) -> Self {
        let Some(period) = self.period else { return self.clone() };
        // Two periods are there.
        let first = self.bodies.iter().filter(|surface| !surface.is_endless());
        let first = first.map(|surface| surface.extent()[0]);
        let first = first.reduce(T::max).unwrap_or(x);
        let from = x - period * ((x - first) / period).floor();
        Self { range: [from, from + period], ..self.clone() }
    }

    /// Returns the same bodies over the period that begins where they are furthest apart between
    /// two places.
    pub(crate) fn cut_at_highest(
        &self,
        [from, to]: [T; 2],
        drawn: impl Fn(T) -> T,
        cost: &mut Cost,
    ) -> Fallible<T, Self> {
        let mut sampler = Sampler::default();
        let mut highest: Option<[T; 2]> = None;
        for i in 0..=PLACES_IN_GAP {
            let x = from + (to - from) * (T::count(i) / T::count(PLACES_IN_GAP));
            let height = sampler.height(self, self.folded(x))? - drawn(x);
            if highest.is_none_or(|[_, most]| height > most) {
                highest = Some([x, height]);
            }
        }
        cost.heights += sampler.cost.evaluations;
        Ok(highest.map_or_else(|| self.clone(), |[x, _]| self.cut_at(x)))
    }

    /// Tells whether the bodies repeat with a period.
    pub(crate) fn is_repeated(&self) -> bool {
        self.period.is_some()
    }

    /// Tells whether a body begins anew at a joint: its ends differ there by what [`SAME`] allows.
    pub(crate) fn is_seam(&self, joint: T) -> bool {
        let is_start = |period: T, surface: &Surface<'_, T>| {
            let periods = (joint - surface.extent()[0]) / period;
            (periods - periods.round()).abs() <= T::of(SAME)
        };
        let mut bodies = self.bodies.iter().filter(|surface| !surface.is_endless());
        self.period.is_some_and(|period| bodies.any(|surface| is_start(period, surface)))
    }

    /// Returns the same place in the period at hand.
    pub(crate) fn folded(&self, x: T) -> T {
        let [left, right] = self.range;
        match self.period {
            Some(period) if !(x >= left && x <= right) => {
                x - period * ((x - left) / period).floor()
            }
            _ => x,
        }
    }

    /// Returns the load at which the bodies touch all over the period, with the pressure
    ///
    /// ```text
    /// P = F/p + κ/π Σ (b_n cos ω_n x - a_n sin ω_n x)/K(ω_n)
    /// ```
    ///
    /// given K, with the coefficients `a_n` and `b_n` of g, from those of the heights: between
    /// walls no slope tells of them.
    pub(crate) fn complete_load(
        &self,
        kappa: T,
        compliance: impl Fn(T) -> T,
        cost: &mut Cost,
    ) -> Fallible<T, T> {
        let Some(period) = self.period else { return Ok(T::one() / T::zero()) };
        let (step, mut sampler) = (period / T::count(HEIGHTS), Sampler::default());
        let height = |i: usize| sampler.height(self, self.range[0] + step * T::count(i));
        let heights = (0..HEIGHTS).map(height).collect::<Result<Vec<T>, _>>()?;
        let highest = heights.iter().fold(T::zero(), |most, h| most.max(h.abs()));
        cost.heights += sampler.cost.evaluations;
        let turn = |i: usize| T::two_pi() * T::count(i % HEIGHTS) / T::count(HEIGHTS);
        let turns: Vec<[T; 2]> = (0..HEIGHTS).map(|i| [turn(i).cos(), turn(i).sin()]).collect();
        let (mut pressures, mut waves) = (vec![T::zero(); HEIGHTS], Vec::new());
        for n in 1..HEIGHTS / 2 {
            let wave = [0, 1].map(|which| {
                let terms = heights.iter().enumerate();
                let turned = |(i, &h): (usize, &T)| h * turns[i * n % HEIGHTS][which];
                T::of(2.0) / T::count(HEIGHTS) * terms.map(turned).fold(T::zero(), |sum, h| sum + h)
            });
            // What is rounding is no wave.
            if wave.iter().all(|h| h.abs() <= T::epsilon() * highest) {
                continue;
            }
            let omega = turn(1) * T::count(n) / step;
            let [b, a] = [-wave[0], wave[1]].map(|h| omega * h / compliance(omega));
            for (i, pressure) in pressures.iter_mut().enumerate() {
                let [cos, sin] = turns[i * n % HEIGHTS];
                *pressure += b * cos - a * sin;
            }
            waves.push([omega, b, a]);
        }
        let lowest = (1..HEIGHTS).fold(0, |i, j| if pressures[j] < pressures[i] { j } else { i });
        let (mut least, mut x) = (pressures[lowest], step * T::count(lowest));
        // Newton's method from the lowest of the places to the lowest between them.
        for _ in 0..STEPS {
            let [pressure, slope, bend] =
                waves.iter().fold([T::zero(); 3], |sums, &[omega, b, a]| {
                    let (sin, cos) = (omega * x).sin_cos();
                    let (value, slope) = (b * cos - a * sin, -(b * sin + a * cos) * omega);
                    [sums[0] + value, sums[1] + slope, sums[2] - omega * omega * value]
                });
            least = least.min(pressure);
            let by = slope / bend;
            x -= if by.abs() < step { by } else { T::zero() };
        }
        Ok(kappa * T::frac_1_pi() * period * (T::zero() - least))
    }
}

/// Returns the share up to which both ends of a period may differ.
fn tolerance<T: Real>() -> T {
    T::of(SAME).max(T::of(64.0) * T::epsilon())
}
