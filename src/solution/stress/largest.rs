//! Largest stress below a contact.

use super::super::peak::{places, rises};
use super::super::pressure_integral::Density;
use super::{Stress, StressPeak, Subsurface, checked_ratio};
use crate::numerics::ascending;
use crate::{ContactError, EvaluationError, Fallible, Interval, Real, Side};

/// Number of abscissae and of depths on the first grid.
const COLUMNS: usize = 33;
const ROWS: usize = 32;

/// Range of depths on the first grid, in half-widths, besides the surface, and half its width. A
/// climb may end nearer to the surface. Stress at greater depths is looked for over ranges as much
/// greater.
const SHALLOWEST: f64 = 1e-6;
const DEEPEST: f64 = 4.0;
const WIDEST: f64 = 1.5;

/// Largest number of maxima of the pressure, and of the surface stress, below which stress is
/// searched.
const MAX_TOPS: usize = 8;

/// Share of the largest stress on the first grid, above which a place may lead to a higher maximum:
/// from one depth to the next, a factor of 1.6, stress changes by a few hundredths.
const LEAST_PROMISING: f64 = 0.9;

impl<T: Real> Subsurface<'_, T> {
    /// Finds the largest shear stress in the plane. Its value has nearly all digits, its place half
    /// of them.
    ///
    /// The search covers a grid of 33 abscissae, from half a half-width beyond either edge, and 32
    /// depths from the surface to four half-widths; all of the surface; and points below the limits
    /// of each contact and the highest maxima of its pressure, ever closer to them. A layer and its
    /// base have a search each, which covers its side of the interface as it covers the surface.
    ///
    /// Below a tip, where the pressure is infinite but the shear is not, the largest shear may be
    /// approached only as the depth goes to zero: then the depth returned is next to zero.
    ///
    /// The search takes some three thousand stresses below each contact: milliseconds for one,
    /// seconds for a hundred.
    ///
    /// # Errors
    /// [`EvaluationError::Singular`] where the shear is infinite: at an edge of infinite pressure,
    /// and with friction also where the slope of the gap jumps; those of [`at`](Self::at);
    /// [`SolveError::Cancelled`](crate::SolveError::Cancelled) by the function that
    /// [watches](crate::Contact::watch).
    pub fn max_shear(&self) -> Result<StressPeak<T>, ContactError<T>> {
        T::largest_shear(self)
    }

    pub(crate) fn largest_shear(&self) -> Fallible<T, StressPeak<T>> {
        self.check_surface(false)?;
        self.largest(|stress| Ok(stress.max_shear()))
    }

    /// Finds the largest von Mises equivalent stress, in the same way. ν is that at all depths
    /// [looked at](Self::within): a layer and its base are asked one by one if theirs differ.
    ///
    /// # Errors
    /// As [`max_shear`](Self::max_shear), without friction also where the slope of the gap jumps,
    /// unless ν is 1/2;
    /// [`InputError::InvalidPoissonRatio`](crate::InputError::InvalidPoissonRatio).
    pub fn max_von_mises(&self, poisson: T) -> Result<StressPeak<T>, ContactError<T>> {
        T::largest_von_mises(self, poisson)
    }

    pub(crate) fn largest_von_mises(&self, poisson: T) -> Fallible<T, StressPeak<T>> {
        let poisson = checked_ratio(poisson, None)?;
        self.check_surface(poisson != T::of(0.5))?;
        self.largest(|stress| stress.von_mises(poisson))
    }

    /// Refuses edges and breakpoints at which the stress is infinite, if the surface is looked at.
    fn check_surface(&self, at_all_tips: bool) -> Fallible<T, ()> {
        if self.depths[0] > T::zero() {
            return Ok(());
        }
        self.check_edges(|_, _, _| true)?;
        self.check_tips(at_all_tips)
    }

    /// Refuses edges of infinite pressure, if the stress is infinite for a side, its place and its
    /// strength.
    pub(super) fn check_edges(&self, is_infinite: impl Fn(Side, T, T) -> bool) -> Fallible<T, ()> {
        let least = T::of(64.0) * T::epsilon() * self.solution.mean_pressure().abs();
        // If several edges are singular, the error names the rightmost.
        for (i, side, strength) in self.solution.solved().held_limits() {
            let x = self.solution.intervals()[i][side];
            if strength.abs() > least && is_infinite(side, x, strength) {
                return Err(EvaluationError::Singular { x }.into());
            }
        }
        Ok(())
    }

    /// Refuses breakpoints at which the pressure is infinite: all of them, or those that slip.
    fn check_tips(&self, all: bool) -> Fallible<T, ()> {
        if !all && self.friction.is_zero() {
            return Ok(());
        }
        let sticks = |x| self.stick_zones().any(|zone| zone.contains(x));
        match self.tips()?.into_iter().find(|&x| all || !sticks(x)) {
            Some(x) => Err(EvaluationError::Singular { x }.into()),
            None => Ok(()),
        }
    }

    /// Lists the intervals that stick, from left to right.
    fn stick_zones(&self) -> impl Iterator<Item = Interval<T>> {
        self.stick.iter().flat_map(|stick| stick.solution.intervals().iter().copied())
    }

    /// Lists the breakpoints at which the pressure is infinite, from left to right.
    fn tips(&self) -> Fallible<T, Vec<T>> {
        let Self { solution, pressure, .. } = self;
        let inside = |&on: &Interval<T>| solution.gap.breakpoints(on);
        let mut breakpoints: Vec<_> = solution.intervals().iter().flat_map(inside).collect();
        let mut pressures = vec![T::zero(); breakpoints.len()];
        pressure.values(&breakpoints, &mut pressures)?;
        let mut pressure = pressures.iter();
        breakpoints.retain(|_| pressure.next().is_some_and(|pressure| !pressure.is_finite()));
        Ok(breakpoints)
    }

    fn largest(&self, value: impl Fn(Stress<T>) -> Fallible<T, T>) -> Fallible<T, StressPeak<T>> {
        let mut best: Option<StressPeak<T>> = None;
        for (contact, &on) in self.solution.intervals().iter().enumerate() {
            let features = self.features(contact, on)?;
            for depths in self.materials() {
                let peak = Hill::new(self, on, depths, &value).top(&features)?;
                if best.is_none_or(|best| peak.value > best.value) {
                    best = Some(peak);
                }
            }
        }
        let [x, zero] = [self.hull().left, T::zero()];
        Ok(best.unwrap_or(StressPeak { x, depth: zero, value: zero }))
    }

    /// Lists places on the surface of a contact: its grid of pressures, and the places where stress
    /// concentrates.
    fn features(&self, contact: usize, on: Interval<T>) -> Fallible<T, Features<T>> {
        let grid = self.grid(contact, on);
        let mut pressures = vec![T::zero(); grid.len()];
        self.pressure.values(&grid, &mut pressures)?;
        let pressures: Vec<_> = grid.iter().zip(pressures).map(|(&x, p)| [x, p]).collect();
        let tops = rises(&pressures).into_iter().take(MAX_TOPS).map(|top| top.highest);
        let tips = self.tips()?.into_iter().filter(|&x| on.contains(x)).collect();
        let (grid, limits) = (self.wide_grid(contact, on), self.limits(on));
        Ok(Features { grid, limits, tops: tops.collect(), tips })
    }

    /// Lists the limits of a contact and of the stick zones in it, from left to right.
    pub(super) fn limits(&self, on: Interval<T>) -> Vec<T> {
        let zones = self.stick_zones().flat_map(|zone| [zone.left, zone.right]);
        let inside = zones.filter(|&x| on.contains(x));
        [on.left].into_iter().chain(inside).chain([on.right]).collect()
    }

    /// Lists places in a contact that crowd at its limits and at breakpoints.
    fn grid(&self, contact: usize, on: Interval<T>) -> Vec<T> {
        places(&self.solution.integrator, &self.solution.gap, contact, on)
    }

    /// Lists the same places, and those beside a contact at which a coating bends.
    pub(super) fn wide_grid(&self, contact: usize, on: Interval<T>) -> Vec<T> {
        let beside: Vec<T> = self.layered.iter().flat_map(|layered| layered.beside()).collect();
        let left = beside.iter().rev().map(|&distance| on.left - distance);
        let right = beside.iter().map(|&distance| on.right + distance);
        left.chain(self.grid(contact, on)).chain(right).collect()
    }
}

/// Places on the surface of a contact.
struct Features<T> {
    /// Grid that crowds at the limits and breakpoints, and goes on beside a coated contact.
    grid: Vec<T>,
    /// Limits of the contact and of its stick zones.
    limits: Vec<T>,
    /// Highest maxima of the pressure.
    tops: Vec<T>,
    /// Breakpoints where the pressure is infinite.
    tips: Vec<T>,
}

/// Stress below one contact in one material by its place: the distance from the centre along the
/// surface, in half-widths, and the logarithm of the depth in half-widths.
struct Hill<'s, T: Real, V> {
    below: &'s Subsurface<'s, T>,
    on: Interval<T>,
    /// Depths at which stress is looked for.
    depths: [T; 2],
    /// Flag: they end in another material, or where they were said to.
    ends: bool,
    value: &'s V,
}

/// Place and the stress there.
type Found<T> = ([T; 2], StressPeak<T>);

impl<'s, T: Real, V: Fn(Stress<T>) -> Fallible<T, T>> Hill<'s, T, V> {
    fn new(below: &'s Subsurface<'s, T>, on: Interval<T>, depths: [T; 2], value: &'s V) -> Self {
        let [from, to] = depths;
        let deepest = T::of(DEEPEST) * on.half_width().max(from);
        Self { below, on, depths: [from, to.min(deepest)], ends: to < deepest, value }
    }

    /// Returns a depth as a place: the logarithm in half-widths, of the surface that above which
    /// places count as the surface.
    fn down(&self, depth: T) -> T {
        let share = depth / self.on.half_width();
        if share.is_zero() { T::epsilon().ln() } else { share.ln() }
    }

    /// Returns the first place of the first grid, and its steps.
    fn first_grid(&self) -> [[T; 2]; 2] {
        let (count, [from, to]) = (|n: usize| T::count(n - 1), self.depths);
        let [from, to] = [from, to].map(|depth| depth / self.on.half_width());
        let side = T::of(WIDEST) * from.max(T::one());
        let shallowest = T::of(SHALLOWEST) * to.min(T::one());
        let top = if from.is_zero() { shallowest } else { from };
        [[-side, top.ln()], [(side + side) / count(COLUMNS), (to / top).ln() / count(ROWS)]]
    }

    fn at(&self, place: [T; 2]) -> Fallible<T, Found<T>> {
        let ([from, to], half_width) = (self.depths, self.on.half_width());
        let is_below = place[1] > self.down(from);
        let depth = if is_below { (half_width * place[1].exp()).max(from).min(to) } else { from };
        self.found(place, self.on.centre() + half_width * place[0], depth)
    }

    /// Returns the stress at a depth at x itself, of which a place keeps fewer digits.
    fn at_depth(&self, x: T, depth: T) -> Fallible<T, Found<T>> {
        self.found([self.along(x), self.down(depth)], x, depth)
    }

    fn found(&self, place: [T; 2], x: T, depth: T) -> Fallible<T, Found<T>> {
        let solution = self.below.solution;
        solution.gap.check_watch(solution.cost(), self.on)?;
        let value = match self.below.stress(x, depth) {
            Ok(stress) => (self.value)(stress)?,
            // The shear is bounded, or the strength of the edge is only rounding.
            Err(ContactError::Evaluation(EvaluationError::Singular { .. })) => -T::one(),
            Err(error) => return Err(error),
        };
        let x = solution.gap.folded(x);
        Ok((place, StressPeak { x, depth, value }))
    }

    /// Returns the abscissa x as a place, in half-widths from the centre.
    fn along(&self, x: T) -> T {
        (x - self.on.centre()) / self.on.half_width()
    }

    /// Finds the largest stress: climbs from the highest place of each part of the first search,
    /// unless it is too low to lead to the highest maximum.
    fn top(&self, features: &Features<T>) -> Fallible<T, StressPeak<T>> {
        let mut feet = self.first_look(features)?;
        feet.sort_by(|(_, one), (_, other)| ascending(&other.value, &one.value));
        let least = T::of(LEAST_PROMISING) * feet[0].1.value;
        let mut best = feet[0].1;
        for foot in feet.into_iter().take_while(|(_, foot)| foot.value >= least) {
            let top = self.climb(foot)?;
            if top.value > best.value {
                best = top;
            }
        }
        Ok(best)
    }

    /// Finds the highest place of the grid and of the neighbourhood of each feature, and the maxima
    /// along the surface and the interface.
    fn first_look(&self, features: &Features<T>) -> Fallible<T, Vec<Found<T>>> {
        let [[left, top], [step, down]] = self.first_grid();
        let rows = || (0..ROWS).map(|row| top + down * T::count(row));
        let columns = (0..COLUMNS).map(|column| left + step * T::count(column));
        let mut feet = vec![self.highest(columns.flat_map(|x| rows().map(move |y| [x, y])))?];
        let neighbourhood = |x: T| {
            let x = self.along(x);
            let near = rows()
                .flat_map(|row| [-0.5, 0.0, 0.5].map(|share| [x + T::of(share) * row.exp(), row]));
            self.highest(near)
        };
        for &x in features.limits.iter().chain(&features.tops) {
            feet.push(neighbourhood(x)?);
        }
        let [from, to] = self.depths;
        for depth in [from, to].into_iter().take(if self.ends { 2 } else { 1 }) {
            let mut level = Vec::with_capacity(features.grid.len());
            for &x in &features.grid {
                level.push([x, self.at_depth(x, depth)?.1.value]);
            }
            for top in rises(&level).into_iter().take(MAX_TOPS) {
                feet.push(self.at_depth(top.highest, depth)?);
                feet.push(neighbourhood(top.highest)?);
            }
            // From a limit a stress may fall like a square root.
            for &limit in &features.limits {
                feet.push(self.at_depth(limit, depth)?);
            }
        }
        // The stress rises to a corner or a tip along a ridge that narrows with the depth, and
        // bends. Below a tip the ridge becomes too narrow to follow, but its end is known.
        for &x in &features.tips {
            feet.push(self.at([self.along(x), T::of(0.5) * T::epsilon().ln()])?);
        }
        Ok(feet)
    }

    fn highest(&self, places: impl Iterator<Item = [T; 2]>) -> Fallible<T, Found<T>> {
        let mut best = self.at([T::zero(); 2])?;
        for place in places {
            let found = self.at(place)?;
            if found.1.value > best.1.value {
                best = found;
            }
        }
        Ok(best)
    }

    /// Climbs by Rosenbrock's method, until rounding hides the maximum. Steps are tried along two
    /// axes: a step that gains is lengthened, one that fails is shortened and reversed. Once both
    /// axes have gained and then failed, the first one is turned to the direction of progress.
    fn climb(&self, (mut place, mut best): Found<T>) -> Fallible<T, StressPeak<T>> {
        let [top, bottom] = self.depths.map(|depth| self.down(depth));
        let (least, rounding) = (T::of(0.1) * T::epsilon().sqrt(), T::of(4.0) * T::epsilon());
        let mut axes = [[T::one(), T::zero()], [T::zero(), T::one()]];
        let [_, mut steps] = self.first_grid();
        loop {
            let start = place;
            let (mut has_gained, mut has_failed) = ([false; 2], [false; 2]);
            while has_failed != [true; 2] {
                for i in 0..2 {
                    let mut here = [0, 1].map(|j| place[j] + steps[i] * axes[i][j]);
                    here[1] = here[1].max(top).min(bottom);
                    let (_, found) = self.at(here)?;
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
