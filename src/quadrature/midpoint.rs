//! The paper's quadrature: the midpoint rule, extrapolated, at any x.
//!
//! With `x = c + L z` the Cauchy integral is `I(x) = L PV∫ h(t)/(z - t) dt` over [-1, 1] with
//! `h(t) = sqrt(1 - t²) g(c + L t)`. Let N be the number of segments and w = 2/N.
//!
//! **ET = 0** is the trapezoidal sum of Eq. (17): the point at the pole is left out, which costs
//! about `w h'(z)`. **ET = 1** (Eq. (20)) combines two of these so that the left-out points
//! cancel, and what remains is the midpoint rule `M_N`; **ET = 2** (Eq. (26)) is
//! `(4 M_2N - M_N)/3`, and each further extrapolation takes away one more power of w.
//!
//! **Any x.** See [`level`].
//!
//! **The exponents.** The error expands in w², w⁴, ... if h is smooth at both ends, as in the
//! paper's Example 1. Where `g` does not vanish at an edge (any free edge), h ends like a square
//! root and the error expands in w^{3/2}, w^{5/2}, ...: then the paper's extrapolation gains a
//! factor 7 and no order, and [`Exponents::HalfInteger`] restores it. A breakpoint inside the
//! contact breaks either expansion unless it lies on the grid.
//!
//! **Next to an edge** the expansion holds from about a segment inward. Closer, the error of the
//! rule stays while the pressure of a free edge goes to zero, and soon exceeds the pressure.
//!
//! **The error estimate.** The ends of h spoil the rule, and there g is nearly the line A + B t
//! through its values at the edges. The rule is run on that line as well, for which the integrals
//! are known (π z for 1, π (z² - 1/2) for t); the difference is the error of the rule, up to and
//! into the last segment. The change by the last extrapolation is added, because it shows kinks. A
//! jump of the slope at a breakpoint is added by its size and distance.

mod level;
mod moments;

use super::{Estimate, Integrator, LoadCase, Moments, Quadrature, UNCACHED_FACTOR};
use crate::gap::{Cost, Gap, Sampler};
use crate::{Fallible, InputError, Interval, Real, Side};
use level::{Level, Pole};
use moments::moments;
use std::any::Any;
use std::sync::OnceLock;

/// Midpoint rule with N segments and Richardson extrapolation.
///
/// ```
/// use linecontact::profile::Parabola;
/// use linecontact::{Contact, Control, Flat, Midpoint};
///
/// let body = Parabola::new(1.0f64, [-1.0, 1.0])?;
/// let contact = Contact::new(&Flat, &body)?.quadrature(&Midpoint::DEFAULT);
/// let solution = contact.solve(Control::Load(0.02))?;
/// let exact = 0.04 / (0.2 * std::f64::consts::PI); // 2 F/(π L)
/// assert!((solution.pressure()?.at(0.0)? / exact - 1.0).abs() < 1e-11);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct Midpoint {
    /// Number N of segments of the coarsest level; each level has twice the segments of the one
    /// before.
    pub segments: usize,
    /// Number ET of extrapolations: 0 for the trapezoidal sum, 1 for the midpoint rule, one more
    /// for each power of w taken away. Level ET has `N 2^(ET-1)` segments.
    pub extrapolations: u32,
    /// Powers of w that are taken away.
    pub exponents: Exponents,
}

/// Powers of the segment width in which the error expands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Exponents {
    /// 2, 4, 6, ...: as in the paper; right where `sqrt(1 - t²) g` is smooth at the edges.
    Even,
    /// 3/2, 5/2, 7/2, ...: right where `g` is finite and not zero at the edges.
    HalfInteger,
}

impl Exponents {
    fn power<T: Real>(self, i: usize) -> T {
        match self {
            Self::Even => T::count(2 * (i + 1)),
            Self::HalfInteger => T::count(i + 1) + T::of(0.5),
        }
    }
}

impl Midpoint {
    /// Returns the rule of the paper: N segments, ET extrapolations, even exponents.
    #[must_use]
    pub const fn paper(segments: usize, extrapolations: u32) -> Self {
        Self { segments, extrapolations, exponents: Exponents::Even }
    }

    /// 64 segments and three powers of w taken away, for free edges: 960 samples. Where the gap
    /// is smooth the relative error is about 1e-13 in the middle of the contact, 1e-9 at 0.8 L
    /// from it, and 1e-5 a segment (L/32) from an edge.
    pub const DEFAULT: Self =
        Self { segments: 64, extrapolations: 4, exponents: Exponents::HalfInteger };

    /// Returns the number of segments of each level.
    fn levels(&self) -> Option<Vec<usize>> {
        let finest = self.segments.checked_shl(self.extrapolations.saturating_sub(1))?;
        let counted = finest >> self.extrapolations.saturating_sub(1) == self.segments;
        if self.segments == 0 || !counted || finest as u64 >= 1 << 24 {
            return None;
        }
        Some((0..self.extrapolations.max(1)).map(|i| self.segments << i).collect())
    }
}

impl Default for Midpoint {
    fn default() -> Self {
        Self::DEFAULT
    }
}

impl<T: Real> Quadrature<T> for Midpoint {
    fn integrator(&self) -> Fallible<T, Box<dyn Integrator<T>>> {
        let Self { segments, extrapolations, .. } = *self;
        let Some(levels) = self.levels() else {
            return Err(InputError::InvalidSegments { segments, extrapolations }.into());
        };
        let (rule, on, moments) = (*self, None, None);
        let (sampler, sums) = (Sampler::default(), OnceLock::new());
        Ok(Box::new(MidpointIntegrator { rule, levels, sampler, on, sums, moments }))
    }

    fn serves(&self, integrator: &dyn Integrator<T>) -> bool {
        let own = (integrator as &dyn Any).downcast_ref::<MidpointIntegrator<T>>();
        own.is_some_and(|own| own.rule == *self)
    }
}

#[derive(Clone)]
struct MidpointIntegrator<T: Real> {
    rule: Midpoint,
    levels: Vec<usize>,
    /// Sampler, kept from one trial to the next because it knows its place on the curves.
    sampler: Sampler<T>,
    /// Interval prepared, and the levels, which are sampled on it when first needed.
    on: Option<Interval<T>>,
    sums: OnceLock<MidpointSums<T>>,
    /// Interval last integrated over, and the error of its edge integrals.
    moments: Option<(Interval<T>, T)>,
}

impl<T: Real> Integrator<T> for MidpointIntegrator<T> {
    fn fork(&self) -> Box<dyn Integrator<T>> {
        Box::new(self.clone())
    }

    fn reset(&mut self, same_bodies: bool) {
        self.sampler.cost = Cost::default();
        if !same_bodies {
            (self.sampler, self.on, self.moments) = (Sampler::default(), None, None);
        }
    }

    fn moments(&mut self, gap: &Gap<'_, T>, on: Interval<T>) -> Fallible<T, Moments<T>> {
        gap.check_budget(self.sampler.cost, UNCACHED_FACTOR, 0, on)?;
        let m = moments(&mut self.sampler, gap, on)?;
        self.moments = Some((on, m.error));
        Ok(m)
    }

    fn prepare(&mut self, _gap: &Gap<'_, T>, on: Interval<T>) -> Fallible<T, ()> {
        (self.on, self.sums) = (Some(on), OnceLock::new());
        Ok(())
    }

    fn complete(&self, gap: &Gap<'_, T>) -> Fallible<T, Cost> {
        let Some(on) = self.on.filter(|_| self.sums.get().is_none()) else {
            return Ok(Cost::default());
        };
        let mut sampler = Sampler::default();
        let trapezoidal = self.rule.extrapolations == 0;
        let mut levels = Vec::with_capacity(self.levels.len());
        for &n in &self.levels {
            levels.push(Level::sample(&mut sampler, gap, on, n, trapezoidal)?);
        }
        let mut jumps = Vec::new();
        for x in gap.breakpoints(on) {
            let left = sampler.slope_from(gap, x, Side::Left)?;
            jumps.push((x, (sampler.slope_from(gap, x, Side::Right)? - left).abs()));
        }
        let exponents = self.rule.exponents;
        self.sums.get_or_init(|| MidpointSums { on, levels, jumps, exponents });
        Ok(sampler.cost)
    }

    fn estimate(
        &self,
        gap: &Gap<'_, T>,
        load_case: &LoadCase<T>,
        x: T,
        cost: &mut Cost,
    ) -> Fallible<T, Estimate<T>> {
        let Some(sums) = self.sums.get() else {
            // Not prepared, so nothing is known.
            return Ok(Estimate { value: T::zero(), error: T::one() / T::zero() });
        };
        let Estimate { value, error } = sums.at(gap, x, cost)?;
        let edge = T::pi() * T::pi() * sums.on.chebyshev_weight(x);
        let LoadCase { kappa, load, .. } = *load_case;
        let value = (T::pi() * load - kappa * value) / edge;
        // An error of the edge integrals is an error of the limits, or of the load.
        let same = |(on, _): &(Interval<T>, T)| on.is_same(&sums.on);
        let of_edges = self.moments.filter(same).map_or(T::zero(), |(_, error)| error);
        let of_edges = T::of(6.0) * T::pi() * sums.on.half_width() * of_edges;
        Ok(Estimate { value, error: kappa * (error + of_edges) / edge })
    }

    fn cost(&self) -> Cost {
        self.sampler.cost
    }
}

/// All levels, sampled on one interval.
#[derive(Clone)]
struct MidpointSums<T: Real> {
    on: Interval<T>,
    levels: Vec<Level<T>>,
    /// Breakpoints in the interval, and the jump of the slope at each.
    jumps: Vec<(T, T)>,
    exponents: Exponents,
}

impl<T: Real> MidpointSums<T> {
    /// Returns the Cauchy integral `I(x)`.
    fn at(&self, gap: &Gap<'_, T>, x: T, cost: &mut Cost) -> Fallible<T, Estimate<T>> {
        let mut pole = Pole::new(gap, self.on, x);
        let mut rows = Vec::with_capacity(self.levels.len());
        for level in &self.levels {
            rows.push(level.at(&mut pole)?);
        }
        *cost += pole.cost();
        let [value, of_one, of_t] =
            [0, 1, 2].map(|i| self.extrapolate(rows.iter().map(|row| row[i]).collect()));

        // The line through the slopes at the two edges, A + B t.
        let [left, right] = self.levels[self.levels.len() - 1].edge_slopes();
        let [a, b] = [T::of(0.5) * (right + left), T::of(0.5) * (right - left)];
        let z = (x - self.on.centre()) / self.on.half_width();
        let one_missed = of_one.0 - T::pi() * z;
        let t_missed = of_t.0 - T::pi() * (z * z - T::of(0.5));
        // g is not quite that line.
        let bend = T::one() + T::count(self.levels[0].n).recip();
        let error = bend * (a * one_missed + b * t_missed).abs() + value.1.abs();
        // Fewer than four points are too few to judge a rule by.
        let is_coarse = self.levels[0].n < 4;
        let error = if is_coarse { T::one() / T::zero() } else { error + self.jump_error(x) };
        let half_width = self.on.half_width();
        Ok(Estimate { value: half_width * value.0, error: half_width * error })
    }

    /// Returns the error that the rule can make in `PV∫ h/(z - t) dt` where h jumps at a
    /// breakpoint: the breakpoint may lie anywhere in its segment, and next to it the integral has
    /// a logarithm.
    fn jump_error(&self, x: T) -> T {
        let half = T::of(0.5);
        let coarsest = self.levels[0].n;
        let segment = (self.on.right - self.on.left) / T::count(coarsest);
        let missed = |&(breakpoint, jump): &(T, T)| {
            let segments = (x - breakpoint).abs() / segment;
            let shape = if segments > half {
                half / segments
            } else {
                T::one() - (segments + segments).ln()
            };
            // A mere kink has no logarithm; without a jump the product with ln 0 is zero.
            if jump.is_zero() { jump } else { jump * shape }
        };
        let root = |x| self.on.chebyshev_weight(x) / self.on.half_width();
        let sum = |sum, jump: &(T, T)| sum + root(jump.0) * missed(jump);
        self.jumps.iter().fold(T::zero(), sum)
    }

    /// Returns the Richardson extrapolation of the levels, and the change by its last step.
    fn extrapolate(&self, mut values: Vec<T>) -> (T, T) {
        let mut changed = T::zero();
        for i in 0..values.len() - 1 {
            let gain = T::of(2.0).powf(self.exponents.power(i)) - T::one();
            for finer in 1..values.len() - i {
                changed = (values[finer] - values[finer - 1]) / gain;
                values[finer - 1] = values[finer] + changed;
            }
        }
        (values[0], changed)
    }
}
