//! Largest pressure of a contact.

use super::{ContactState, LoadRates, Pressure, Solution, Solved};
use crate::gap::{Cost, Gap};
use crate::numerics::ascending;
use crate::quadrature::{Engine, Estimate, LoadCase};
use crate::{ContactError, EvaluationError, Fallible, Interval, Real};

/// Least number of grid points for the first search of a largest pressure.
const LEAST_GRID: usize = 64;

/// Largest number of grid points, unless more than half as many panels are present.
const MAX_GRID: usize = 1 << 14;

/// Largest number of breakpoints at which the pressure, known to be finite, is evaluated.
const MAX_BREAKPOINTS: usize = 256;

/// Number of parts into which a bracket of a maximum is divided: the 16 points between them cost no
/// more than one, as they are evaluated at once.
const PARTS: usize = 17;

/// Largest pressure and its place.
///
/// ```
/// use linecontact::profile::Parabola;
/// use linecontact::{Contact, Control, Flat};
///
/// let body = Parabola::new(1.0f64, [-1.0, 1.0])?;
/// let solution = Contact::new(&Flat, &body)?.solve(Control::Load(0.02))?;
/// let peak = solution.peak()?;
/// assert!(peak.x.abs() < 1e-6);
/// let exact = 0.04 / (0.2 * std::f64::consts::PI); // 2F/(πL)
/// assert!((peak.pressure - exact).abs() < peak.error && peak.error < 1e-12 * exact);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Peak<T> {
    /// Abscissa of the largest pressure.
    pub x: T,
    /// Largest pressure.
    pub pressure: T,
    /// Estimated absolute error of the pressure: more than its rounding where the quadrature is
    /// coarse, or next to a corner that is no breakpoint.
    pub error: T,
}

impl<T> Peak<T> {
    pub(super) fn new(x: T, Estimate { value: pressure, error }: Estimate<T>) -> Self {
        Self { x, pressure, error }
    }
}

impl<T: Real> Solution<'_, T> {
    /// Finds the largest pressure (a pressure) and its place. The pressure is flat there: its value
    /// has all digits, its place half of them.
    ///
    /// If the pressure goes to minus infinity at an edge, as at an adhesive one, the peak is the
    /// largest pressure inside.
    ///
    /// The search takes some two hundred pressures for each contact, more if the contact took many
    /// samples. They cost evaluations with [`Midpoint`](crate::Midpoint) only; these are not in
    /// [`cost`](Self::cost).
    ///
    /// # Errors
    /// [`EvaluationError::Singular`] where the pressure is infinite: at a fixed edge, or where the
    /// slope of the gap jumps up ([`contacts`](Self::contacts) has the peaks of the other
    /// contacts); [`EvaluationError::Unresolved`] from a [`Midpoint`](crate::Midpoint) of fewer
    /// than four segments; those of sampling the gap.
    pub fn peak(&self) -> Result<Peak<T>, ContactError<T>> {
        T::peak(self)
    }
}

impl<T: Real> Solved<'_, T> {
    pub fn peak(&self) -> Result<Peak<T>, ContactError<T>> {
        if self.found.apart.is_some() {
            let none = Estimate { value: T::zero(), error: T::zero() };
            return Ok(Peak::new(self.found.interval.left, none));
        }
        let pressure = Pressure::new(*self)?;
        let (x, top) = self.largest_pressure(&mut Cost::default())?;
        let on = Interval::find(self.contacts(), x).1.unwrap_or(self.found.interval);
        Ok(Peak::new(x, pressure.with_limits(on, x, top)))
    }

    /// Finds the largest pressure of all contacts: its place and value.
    pub fn largest_pressure(&self, cost: &mut Cost) -> Result<(T, Estimate<T>), ContactError<T>> {
        let last = self.contacts().len() - 1;
        let mut best = self.peak_in(last, cost)?;
        for i in (0..last).rev() {
            let found = self.peak_in(i, cost)?;
            best = if found.1.value >= best.1.value { found } else { best };
        }
        Ok(best)
    }

    /// Finds the largest pressure, its derivative by the load, which is that at its place, and its
    /// relative error. The bend of the bodies changes with the load, or `is_held`.
    pub fn peak_with_rate(
        &self,
        is_held: bool,
        cost: &mut Cost,
    ) -> Result<[T; 3], ContactError<T>> {
        let (x, Estimate { value, error }) = self.largest_pressure(cost)?;
        let rate = match self.several() {
            _ if !is_held => LoadRates::of(*self)?.pressure(x)?,
            Some(_) => LoadRates::new(*self)?.pressure(x)?,
            None => T::frac_1_pi() / self.found.interval.chebyshev_weight(x),
        };
        Ok([value, rate, error / value.abs()])
    }

    /// Finds the largest pressure of one contact, given by its number.
    pub(super) fn peak_in(&self, contact: usize, cost: &mut Cost) -> Fallible<T, (T, Estimate<T>)> {
        let (on, ContactState { load, free, .. }) = (self.contacts()[contact], *self.found);
        let load_case = LoadCase { kappa: self.kappa, load, free };
        let (x, top) =
            largest_pressure(self.integrator, self.gap, &load_case, (contact, on), cost)?;
        let Estimate { value: pressure, error } = top;
        if !pressure.is_finite() {
            return Err(EvaluationError::Singular { x }.into());
        }
        if !error.is_finite() {
            return Err(EvaluationError::Unresolved { x, pressure, error }.into());
        }
        let rounding = T::of(64.0) * T::epsilon() * pressure.abs();
        // If both edges are singular, the error names the right one.
        let mut own = self.held_limits().filter(|&(i, ..)| i == contact);
        match own.find(|&(.., strength)| strength > rounding) {
            Some((_, side, _)) => Err(EvaluationError::Singular { x: on[side] }.into()),
            None => Ok((x, top)),
        }
    }
}

/// Finds the place and the value of the largest pressure in a prepared contact, and adds the cost
/// of the search to `cost`.
///
/// A grid crowds at the ends of all panels, and so at the limits and breakpoints. A maximum lies
/// between the neighbours of each grid point that is higher than both. It is refined if it might be
/// the largest: a pressure rises above a grid point by less than it has risen from the lower
/// neighbour.
pub(crate) fn largest_pressure<T: Real>(
    integrator: &Engine<T>,
    gap: &Gap<'_, T>,
    load_case: &LoadCase<T>,
    (contact, on): (usize, Interval<T>),
    cost: &mut Cost,
) -> Fallible<T, (T, Estimate<T>)> {
    let x = places(integrator, gap, contact, on);
    let mut pressures = vec![T::zero(); x.len()];
    integrator.pressures(gap, load_case, &x, &mut pressures, cost)?;
    let mut grid: Vec<[T; 2]> = x.into_iter().zip(pressures).map(|(x, p)| [x, p]).collect();
    let higher = |top: [T; 2], next: [T; 2]| if next[1] > top[1] { next } else { top };
    let highest = grid.iter().copied().reduce(higher).map_or(on.centre(), |[x, _]| x);
    let top = (highest, integrator.estimate(gap, load_case, highest, cost)?);
    let mut search = Search { integrator, gap, load_case, cost, top };
    for breakpoint in gap.telling_breakpoints(on, T::one(), MAX_BREAKPOINTS) {
        let there = search.meet(breakpoint)?.value;
        if !there.is_finite() && there > T::zero() {
            return Ok((breakpoint, Estimate { value: there, error: T::zero() }));
        }
    }
    if !search.counts(search.top.1) {
        // Next to an edge a rule of few segments has no correct digit, and may give any value.
        search.keep_resolved(&mut grid)?;
    }
    for Rise { bracket, bound, .. } in rises(&grid) {
        let (_, Estimate { value, error }) = search.top;
        if bound <= value + error {
            break;
        }
        search.climb(bracket)?;
    }
    // Panels halved down to a corner that is no breakpoint may end there.
    let (x, short) = (search.top.0, T::epsilon() * on.half_width());
    let spans = integrator.panels().into_iter().flat_map(|own| own.spans(contact));
    let tips = spans
        .map(|(_, ends)| ends)
        .filter(|[from, to]| *to - *from <= short && *from <= x + short && x - short <= *to);
    for tip in tips.flatten() {
        let there = search.meet(tip)?;
        if !there.value.is_finite() && there.value > T::zero() {
            return Ok((tip, there));
        }
    }
    search.polished(on)
}

/// Returns rising places over a contact that crowd at the ends of its panels, about twice as many
/// as the panels have nodes. Without panels they crowd at the limits and breakpoints.
pub(super) fn places<T: Real>(
    integrator: &Engine<T>,
    gap: &Gap<'_, T>,
    contact: usize,
    on: Interval<T>,
) -> Vec<T> {
    let spans = integrator.panels().into_iter().flat_map(|own| own.spans(contact));
    let spans = spans.map(|(panel, [left, right])| (Interval { left, right }, panel.n));
    let mut spans: Vec<_> = spans.collect();
    if spans.is_empty() {
        let mut left = on.left;
        let breakpoints = gap.telling_breakpoints(on, T::one(), MAX_BREAKPOINTS);
        for right in breakpoints.chain([on.right]) {
            spans.push((Interval { left, right }, LEAST_GRID));
            left = right;
        }
    }
    let [least, most] = [LEAST_GRID, MAX_GRID].map(|points| points / spans.len());
    let mut places = Vec::new();
    for (span, nodes) in spans {
        let count = (2 * nodes).max(least).min(most.max(2));
        let angle = |i: usize| T::pi() * (T::count(i) + T::of(0.5)) / T::count(count);
        places.extend((0..count).rev().map(|i| span.at_angle(angle(i))));
    }
    // A narrow span may have no number between its ends.
    places.retain(|&x| on.contains(x));
    places.dedup();
    places
}

/// Grid point with less pressure on either side, and a bound of the pressure between its
/// neighbours.
pub(super) struct Rise<T> {
    pub bracket: [T; 2],
    pub highest: T,
    pub bound: T,
}

/// Lists the points of a grid `[x, P]` with less pressure on either side, the highest bound first.
pub(super) fn rises<T: Real>(grid: &[[T; 2]]) -> Vec<Rise<T>> {
    let rise = |i: usize| {
        let ([highest, here], last) = (grid[i], grid.len() - 1);
        let beside = [grid[i.saturating_sub(1)], grid[last.min(i + 1)]];
        let falls = beside.map(|[_, pressure]| here - pressure);
        let is_top = here.is_finite() && falls.iter().all(|&fall| fall >= T::zero());
        let bound = here + falls[0].max(falls[1]);
        is_top.then_some(Rise { bracket: beside.map(|[x, _]| x), highest, bound })
    };
    let mut rises: Vec<_> = (0..grid.len()).filter_map(rise).collect();
    rises.sort_by(|one, other| ascending(&other.bound, &one.bound));
    rises
}

/// Narrows a bracket of a maximum to half the digits of x, which are enough as the function is flat
/// there.
pub(super) fn narrow<T: Real>(
    [mut lo, mut hi]: [T; 2],
    mut values: impl FnMut(&[T], &mut [T]) -> Fallible<T, ()>,
) -> Fallible<T, T> {
    let mut highest = T::of(0.5) * (lo + hi);
    let resolution = T::epsilon().sqrt() * (hi - lo);
    while hi - lo > resolution {
        let step = (hi - lo) / T::count(PARTS);
        let x: [T; PARTS - 1] = std::array::from_fn(|i| lo + step * T::count(i + 1));
        let mut found = [T::zero(); PARTS - 1];
        values(&x, &mut found)?;
        let higher = |best: usize, i: usize| if found[i] > found[best] { i } else { best };
        highest = x[(0..x.len()).fold(0, higher)];
        (lo, hi) = (highest - step, highest + step);
    }
    Ok(highest)
}

/// Search for the largest pressure.
struct Search<'s, 'g, T: Real> {
    integrator: &'s Engine<T>,
    gap: &'s Gap<'g, T>,
    load_case: &'s LoadCase<T>,
    cost: &'s mut Cost,
    /// Largest pressure so far and its place; a pressure with a correct digit goes before one
    /// without.
    top: (T, Estimate<T>),
}

impl<T: Real> Search<'_, '_, T> {
    /// Tells whether a pressure counts: of panels one without a correct digit does, too, as next to
    /// a corner that is no breakpoint.
    fn counts(&self, pressure: Estimate<T>) -> bool {
        self.integrator.panels().is_some() || pressure.is_resolved()
    }

    /// Takes the pressure at `x` into account, and returns it.
    fn meet(&mut self, x: T) -> Fallible<T, Estimate<T>> {
        let found = self.integrator.estimate(self.gap, self.load_case, x, self.cost)?;
        let top = self.top.1;
        let are_alike = self.counts(found) == self.counts(top);
        let is_higher = if are_alike { found.value > top.value } else { self.counts(found) };
        if is_higher {
            self.top = (x, found);
        }
        Ok(found)
    }

    /// Drops the grid points whose pressure has no correct digit, unless all are so.
    fn keep_resolved(&mut self, grid: &mut Vec<[T; 2]>) -> Fallible<T, ()> {
        let mut resolved = Vec::new();
        for &place in &*grid {
            if self.meet(place[0])?.is_resolved() {
                resolved.push(place);
            }
        }
        if !resolved.is_empty() {
            *grid = resolved;
        }
        Ok(())
    }

    /// Finds the maximum in a bracket, and takes it into account.
    fn climb(&mut self, bracket: [T; 2]) -> Fallible<T, ()> {
        let Self { integrator, gap, load_case, cost, .. } = self;
        let highest = narrow(bracket, |x, pressures| {
            integrator.pressures(gap, load_case, x, pressures, cost)
        })?;
        self.meet(highest)?;
        Ok(())
    }

    /// Refines the place of the maximum to as many digits as derivatives by parameters need.
    fn polished(self, on: Interval<T>) -> Fallible<T, (T, Estimate<T>)> {
        let mut top = self.top;
        // Half the digits are not enough for derivatives: a Newton step moves the place with the
        // parameters.
        for _ in 0..T::DERIVATIVE_ORDER {
            let (x, here) = top;
            let beside = |from: T, breakpoint: T| from.min((x - breakpoint).abs());
            let room = self.gap.breakpoints(on).fold((x - on.left).min(on.right - x), beside);
            let step = T::epsilon().sqrt().sqrt() * room;
            let mut pressure =
                |x: T| self.integrator.estimate(self.gap, self.load_case, x, self.cost);
            let [before, after] = [pressure(x - step)?.value, pressure(x + step)?.value];
            let move_on =
                T::of(0.5) * step * (after - before) / (here.value + here.value - before - after);
            if move_on.abs() < step {
                top = (x + move_on, pressure(x + move_on)?);
            }
        }
        Ok(top)
    }
}
