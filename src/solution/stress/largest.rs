//! Where the stress is largest.

use super::super::pressure_integral::Density;
use super::{Stress, StressPeak, Subsurface, checked_ratio};
use crate::{ContactError, Interval, Real, Side};

/// Abscissae and depths of the first look.
const COLUMNS: usize = 33;
const ROWS: usize = 32;

/// The depths of the first look, in half-widths, besides the surface. The way up may end nearer to it.
const SHALLOWEST: f64 = 1e-6;
const DEEPEST: f64 = 4.0;

impl<T: Real> Subsurface<'_, T> {
    /// The largest shear stress in the plane, as far as a grid of 33 abscissae, from half a half-width
    /// beyond either edge, and 32 depths from the surface to four half-widths shows which maximum is
    /// the largest. Its value has nearly all digits, its place half of them.
    ///
    /// Below a tip, where the pressure is infinite but the shear is not, it may be approached only as
    /// the depth goes to zero: then the depth is next to nothing.
    ///
    /// It takes some thousand stresses, each of them time for each piece of the bodies in the contact,
    /// but pressures only next to its place: three seconds for a thousand pieces.
    ///
    /// # Errors
    /// [`ContactError::Singular`] where the shear is infinite: at an edge where the pressure is, and
    /// with friction also where the slope of the gap jumps; those of [`at`](Self::at);
    /// [`ContactError::Cancelled`] by who [watches](crate::Contact::watch).
    pub fn max_shear(&self) -> Result<StressPeak<T>, ContactError<T>> {
        self.check_edges()?;
        if !self.friction.is_zero() {
            self.check_breakpoints()?;
        }
        self.largest(|stress| Ok(stress.max_shear()))
    }

    /// The largest equivalent stress of von Mises, found in the same way.
    ///
    /// # Errors
    /// As [`max_shear`](Self::max_shear), and without friction, too, where the slope of the gap jumps,
    /// unless ν is 1/2; [`ContactError::InvalidPoissonRatio`].
    pub fn max_von_mises(&self, poisson: T) -> Result<StressPeak<T>, ContactError<T>> {
        let poisson = checked_ratio(poisson)?;
        self.check_edges()?;
        if !(self.friction.is_zero() && poisson == T::of(0.5)) {
            self.check_breakpoints()?;
        }
        self.largest(|stress| stress.von_mises(poisson))
    }

    /// Refuses edges at which all stress is infinite.
    fn check_edges(&self) -> Result<(), ContactError<T>> {
        let (found, hull) = (self.solution.found(), self.hull());
        let least = T::of(64.0) * T::epsilon() * self.solution.mean_pressure().abs();
        // Where both are it is the right one that is named.
        for side in [Side::Right, Side::Left] {
            if !found.free[side] && found.strengths[side].abs() > least {
                return Err(ContactError::Singular { x: hull[side] });
            }
        }
        Ok(())
    }

    /// Refuses breakpoints at which the pressure is infinite.
    fn check_breakpoints(&self) -> Result<(), ContactError<T>> {
        match self.tips()?.first() {
            Some(&x) => Err(ContactError::Singular { x }),
            None => Ok(()),
        }
    }

    /// Those breakpoints, from left to right.
    fn tips(&self) -> Result<Vec<T>, ContactError<T>> {
        let mut breakpoints: Vec<_> = self.integrals.breakpoints().collect();
        let mut pressures = vec![T::zero(); breakpoints.len()];
        self.integrals.density.values(&breakpoints, &mut pressures)?;
        let mut pressure = pressures.iter();
        breakpoints.retain(|_| pressure.next().is_some_and(|pressure| !pressure.is_finite()));
        Ok(breakpoints)
    }

    fn largest(
        &self,
        value: impl Fn(Stress<T>) -> Result<T, ContactError<T>>,
    ) -> Result<StressPeak<T>, ContactError<T>> {
        let mut best: Option<StressPeak<T>> = None;
        for &on in self.solution.intervals() {
            let peak = self.largest_below(on, &value)?;
            if best.is_none_or(|best| peak.value > best.value) {
                best = Some(peak);
            }
        }
        let value = self.solution.load();
        best.ok_or(ContactError::InvalidLoad { quantity: "load", value })
    }

    /// Below one contact.
    fn largest_below(
        &self,
        on: Interval<T>,
        value: &impl Fn(Stress<T>) -> Result<T, ContactError<T>>,
    ) -> Result<StressPeak<T>, ContactError<T>> {
        let (centre, half_width) = (on.centre(), on.half_width());
        // By places in half-widths, the depth by its logarithm: where places are not told apart any more is the surface.
        let [shallowest, deepest] = [SHALLOWEST, DEEPEST].map(|depth| T::of(depth.ln()));
        let surface = T::epsilon().ln();
        let peak = |[along, down]: [T; 2]| {
            let depth = if down > surface { half_width * down.exp() } else { T::zero() };
            let x = centre + half_width * along;
            self.solution.gap().check_watch(self.solution.cost(), on)?;
            match self.at(x, depth) {
                Ok(stress) => Ok(StressPeak { x, depth, value: value(stress)? }),
                // Shear that is bounded, or an edge whose strength is nothing but rounding.
                Err(ContactError::Singular { .. }) => Ok(StressPeak { x, depth, value: -T::one() }),
                Err(error) => Err(error),
            }
        };
        let grid = [3.0 / (COLUMNS - 1) as f64, (DEEPEST / SHALLOWEST).ln() / (ROWS - 1) as f64];
        let grid = grid.map(T::of);
        let mut place = [T::zero(); 2];
        let mut best = StressPeak { x: centre, depth: half_width, value: -T::one() };
        for column in 0..COLUMNS {
            for row in 0..ROWS {
                let along = T::of(-1.5) + grid[0] * T::count(column);
                let down = if row == 0 { surface } else { shallowest + grid[1] * T::count(row) };
                let here = [along, down];
                let found = peak(here)?;
                if found.value > best.value {
                    (place, best) = (here, found);
                }
            }
        }
        // The way up to a corner or a tip is a ridge that narrows with the depth, and bends. Below a tip it is too narrow
        // in the end, but there it is known where it ends.
        for x in self.tips()?.into_iter().filter(|&x| on.contains(x)) {
            let here = [(x - centre) / half_width, T::of(0.5) * surface];
            let found = peak(here)?;
            if found.value > best.value {
                (place, best) = (here, found);
            }
        }
        let (least, rounding) = (T::of(0.1) * T::epsilon().sqrt(), T::of(4.0) * T::epsilon());
        // Uphill by Rosenbrock's method, until rounding hides the top. Steps are tried along two axes: one that gains is
        // made longer, one that does not shorter and turned round. Once both have gained and then not, the first axis
        // is laid along the way that was made.
        let mut axes = [[T::one(), T::zero()], [T::zero(), T::one()]];
        let mut steps = grid;
        loop {
            let start = place;
            let (mut has_gained, mut has_failed) = ([false; 2], [false; 2]);
            while has_failed != [true; 2] {
                for i in 0..2 {
                    let mut here = [0, 1].map(|j| place[j] + steps[i] * axes[i][j]);
                    here[1] = here[1].max(surface).min(deepest);
                    let found = peak(here)?;
                    if found.value - best.value > rounding * best.value {
                        (place, best) = (here, found);
                        steps[i] *= T::of(3.0);
                        has_gained[i] = true;
                    } else {
                        steps[i] *= T::of(-0.5);
                        has_failed[i] |= has_gained[i];
                    }
                }
                if steps[0].abs().max(steps[1].abs()) < least {
                    return Ok(best);
                }
            }
            let way = [0, 1].map(|j| place[j] - start[j]);
            let length = way[0].hypot(way[1]);
            if length > T::zero() {
                let [x, y] = way.map(|part| part / length);
                axes = [[x, y], [-y, x]];
            }
        }
    }
}
