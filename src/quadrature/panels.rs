//! The slope of the gap as polynomial panels, and the integrals over them.
//!
//! The user's curves are the cost, so they are sampled once: on panels, each with a Chebyshev
//! series, over a span a little wider than the contact. Edge integrals, their derivatives by
//! the limits, and the pressure then come from the series alone.
//!
//! The panels end at the breakpoints of the bodies. Each starts with a few nodes and takes more
//! while the coefficients promise convergence. Where they do not fall (an undeclared kink, an end
//! like a square root) the panel is halved. Where they have sunk into the noise of the user's
//! formulas more samples would not help: the panel is left as it is, and the noise goes into the
//! error estimates.

// Loops over lanes index several arrays at once, which is what the compiler vectorises.
#![allow(clippy::needless_range_loop)]

mod cauchy_transform;
mod edge_integrals;
mod half_angle;
mod hilbert_transform;
mod interpolation;
mod near_far_sum;
mod panel;
mod panel_set;
mod reexpansion;
mod several;
mod treecode;

use super::{Estimate, Integrator, LoadCase, Moments, Quadrature};
use crate::gap::{Cost, Gap};
use crate::numerics::chebyshev::{MAX_SIZE, SIZES};
use crate::{Ends, Fallible, InputError, Interval, Real, Side, SolveError};
pub(crate) use cauchy_transform::{CauchyTransform, inverse, length, sqrt};
pub(crate) use edge_integrals::rise as rises_over;
pub(crate) use half_angle::{Arc, HalfAngle};
use hilbert_transform::{BATCH, Edges, HilbertTransform};
use panel::Series;
pub(crate) use panel::{Panel, rise};
use panel_set::{LEAST_ULPS, MIN_NODES};
pub(crate) use panel_set::{PanelSet, Rises};
pub(crate) use several::{LoadResponse, Several, System};

/// The default quadrature: panels.
///
/// ```
/// use linecontact::profile::Parabola;
/// use linecontact::{Contact, Control, Flat, Panels};
///
/// let body = Parabola::new(1.0f64, [-1.0, 1.0])?;
/// let coarse = Panels { tolerance: 1e-6 };
/// let contact = Contact::new(&Flat, &body)?.quadrature(&coarse);
/// let solution = contact.solve(Control::Load(0.02))?;
/// assert!((solution.a() / 0.2 - 1.0).abs() < 1e-6); // sqrt(2 F R/κ)
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct Panels {
    /// Largest error of the slope of the gap on a panel, as a fraction of the largest slope in the
    /// contact. Never taken below sixteen units in the last place; the default 0 stands for these.
    /// With a looser tolerance the error is estimated from a few coefficients, and the estimates
    /// may be too small; the tolerance itself bounds the error.
    pub tolerance: f64,
}

impl Panels {
    /// Full accuracy of the number type and of the profiles' formulas.
    pub const FULL: Self = Self { tolerance: 0.0 };

    pub(crate) fn prepared<T: Real>(&self) -> Fallible<T, Box<PanelIntegrator<T>>> {
        if !(self.tolerance >= 0.0 && self.tolerance < 1.0) {
            return Err(InputError::InvalidTolerance { tolerance: T::of(self.tolerance) }.into());
        }
        let tolerance = T::of(self.tolerance).max(T::of(LEAST_ULPS) * T::epsilon());
        Ok(Box::new(PanelIntegrator {
            rule: *self,
            panel_set: PanelSet::new(tolerance),
            transform: HilbertTransform::new(),
            is_prepared: false,
            moments: None,
            over: None,
            decay: None,
            several: Several::new(tolerance),
            is_several: false,
        }))
    }
}

impl<T: Real> Quadrature<T> for Panels {
    fn integrator(&self) -> Fallible<T, Box<dyn Integrator<T>>> {
        T::panels(self)
    }

    fn panels(&self) -> Option<Self> {
        Some(*self)
    }
}

/// Panels at work: on one contact, or on several at once.
#[derive(Clone)]
pub(crate) struct PanelIntegrator<T> {
    pub(super) rule: Panels,
    /// Panels of the only contact.
    pub(crate) panel_set: PanelSet<T>,
    transform: HilbertTransform<T>,
    /// True if the transform belongs to the moments last remembered.
    is_prepared: bool,
    /// Interval last integrated over, in the end the one of the transform, and its moments.
    moments: Option<(Interval<T>, Moments<T>)>,
    /// Series over the interval, if one panel holds it.
    over: Option<Series<T>>,
    /// First estimate only: ratio of coefficients two apart, and the half-width covered.
    decay: Option<[T; 2]>,
    /// Several contacts at once, and a flag: they were last in use.
    several: Several<T>,
    is_several: bool,
}

impl<T: Real> PanelIntegrator<T> {
    /// Returns the panels of the only contact, and the contact; `None` with several.
    fn only(&self) -> Option<(&PanelSet<T>, Interval<T>)> {
        (!self.is_several).then_some((&self.panel_set, self.transform.on))
    }

    /// Returns the contacts, if they are several.
    pub(crate) fn several(&self) -> Option<&Several<T>> {
        self.is_several.then_some(&self.several)
    }

    /// Returns the free limits of a contact, given those of the only one.
    pub(crate) fn free_of(&self, contact: usize, of_one: Ends<bool>) -> Ends<bool> {
        self.several().map_or(of_one, |several| several.held()[contact].map(|held| !held))
    }

    /// Switches to several contacts.
    pub(crate) fn several_mut(&mut self) -> &mut Several<T> {
        self.is_several = true;
        self.several.spent = self.panel_set.cost;
        &mut self.several
    }

    /// Returns the panels that hold one contact, and the contact.
    pub(crate) fn contact(&self, i: usize) -> (&PanelSet<T>, Interval<T>) {
        self.only().unwrap_or_else(|| (self.several.panel_set(i), self.several.contacts()[i]))
    }

    /// Lists the panels of one contact, each with its part of the contact.
    pub(crate) fn spans(&self, contact: usize) -> impl Iterator<Item = (&Panel<T>, [T; 2])> {
        let (PanelSet { panels, .. }, on) = self.contact(contact);
        panel::spans(panel::within(panels, on), on)
    }

    /// Tells whether the slope of the gap rises all over the only contact, up to a fall by the
    /// largest slope.
    pub(crate) fn rises(&self, allowed: impl Fn(T) -> T) -> bool {
        let only = self.only();
        only.is_some_and(|(own, on)| edge_integrals::rise(&own.panels, on, allowed(own.size)))
    }

    /// Tells whether the slope of the gap falls somewhere on the panels of the only contact.
    pub(crate) fn falls(&self) -> bool {
        self.only().is_some_and(|(panel_set, _)| panel_set.falls().next().is_some())
    }

    /// Tells whether the panels of one contact cover an interval, and the slope of the gap rises
    /// there.
    pub(crate) fn rises_on(&self, contact: usize, on: Interval<T>) -> bool {
        let (panel_set, _) = self.contact(contact);
        panel_set.covers(on)
            && edge_integrals::rise(&panel_set.panels, on, T::epsilon() * panel_set.size)
    }

    /// Returns the rise of the gap of the only contact from one place to another, of the bodies as
    /// described.
    pub(crate) fn rise(&self, from: T, to: T) -> Option<T> {
        let (panel_set, _) = self.only()?;
        Some(rise(panel_set.as_described(), from, to))
    }

    /// Samples between the nodes of the panels of each contact, and anew the panels that miss a
    /// feature. Tells whether that moves the contacts: an only one stays if its integrals do,
    /// within their errors.
    ///
    /// # Errors
    /// Those of sampling the bodies.
    pub(crate) fn probe(&mut self, gap: &Gap<'_, T>, on: Interval<T>) -> Fallible<T, bool> {
        if self.is_several {
            return self.several.probe(gap);
        }
        let is_turned = self.panel_set.add(gap);
        let before = self.moments.take().filter(|&(of, _)| of == on && !is_turned);
        if !self.panel_set.probe(gap, on)? {
            self.moments = before;
            return Ok(false);
        }
        let after = self.remember(gap, on);
        let moved = |m: Moments<T>| (m.m0 - after.m0).abs() + (m.m1 - after.m1).abs() - m.error;
        Ok(!before.is_some_and(|(_, m)| moved(m) <= after.error))
    }

    /// Returns the slope over the only contact as a cosine series, and a flag: all of it, not only
    /// the terms that count from afar. `None` with several contacts.
    pub(crate) fn cosines(&self) -> Option<(Series<T>, bool)> {
        let (panel_set, on) = self.only()?;
        Some(edge_integrals::cosines(panel::within(&panel_set.panels, on), on))
    }

    fn turn_to_one(&mut self) {
        self.is_several = false;
        self.panel_set.spent = self.several.cost;
    }

    fn remember(&mut self, gap: &Gap<'_, T>, on: Interval<T>) -> Moments<T> {
        self.panel_set.own_up(gap);
        let from = self.moments.map(|(from, _)| from);
        let m = edge_integrals::moments(&self.panel_set.panels, on, &mut self.over, from);
        (self.moments, self.is_prepared) = (Some((on, m)), false);
        m
    }

    /// Tells whether the error of the integrals exceeds both the tolerance and the rounding of the
    /// bodies' slopes, which other samples would not lower.
    fn is_poor(&self, m: &Moments<T>) -> bool {
        let PanelSet { tolerance, least, .. } = self.panel_set;
        m.error > T::of(4.0) * (tolerance * m.l1_norm).max(T::epsilon() * least)
    }

    /// Returns the edge integrals from panels sampled on that interval alone.
    fn sample_anew(&mut self, gap: &Gap<'_, T>, on: Interval<T>) -> Fallible<T, Moments<T>> {
        self.clear_samples();
        self.panel_set.extend(gap, on)?;
        Ok(self.remember(gap, on))
    }

    /// Returns the number of nodes that should suffice, from the first ratio of the coefficients
    /// two apart. Next to a root, as at the side of a circle, the ratios rise from it like 2 - 1/m.
    fn expected_size(&self, on: Interval<T>) -> usize {
        let Some([decay, half_width]) = self.decay else { return MIN_NODES };
        let shrunk = on.half_width() / half_width;
        let (first, mut left) = (decay * shrunk * shrunk, T::one());
        for m in 1..=MAX_SIZE / 2 {
            left *= (first * (T::of(2.0) - T::one() / T::count(m))).min(T::one());
            let n = 2 * m;
            if n >= MIN_NODES && SIZES.contains(&n) && left <= self.panel_set.tolerance {
                return n;
            }
        }
        // Where the first ratio would do, few panels of many nodes.
        let would_do = first.powf(T::count(MAX_SIZE / 2)) <= self.panel_set.tolerance;
        if would_do { MAX_SIZE } else { MIN_NODES }
    }
}

impl<T: Real> Integrator<T> for PanelIntegrator<T> {
    fn fork(&self) -> Box<dyn Integrator<T>> {
        Box::new(self.clone())
    }

    fn sample_over(
        &mut self,
        gap: &Gap<'_, T>,
        on: Interval<T>,
        coarse: bool,
    ) -> Fallible<T, Option<T>> {
        self.turn_to_one();
        self.moments = None;
        self.panel_set.clear(true);
        (self.panel_set.coarse, self.panel_set.initial) = (coarse, self.expected_size(on));
        self.panel_set.extend(gap, on)?;
        self.decay = coarse.then(|| {
            let ratio = |a: &[T]| a[2].abs().max(a[3].abs()) / a[0].abs().max(a[1].abs());
            let largest = |max: T, panel: &Panel<T>| max.max(ratio(&panel.series));
            let decay = self.panel_set.as_described().iter().fold(T::epsilon(), largest);
            [decay.min(T::one()), on.half_width()]
        });
        self.panel_set.coarse = false;
        Ok(Some(self.decay.map_or(self.panel_set.tolerance, |[decay, _]| decay * decay)))
    }

    fn moments(&mut self, gap: &Gap<'_, T>, on: Interval<T>) -> Fallible<T, Moments<T>> {
        self.turn_to_one();
        if self.panel_set.add(gap) {
            self.moments = None;
        }
        if let Some((_, m)) = self.moments.as_ref().filter(|(last, _)| last.is_same(&on)) {
            return Ok(*m);
        }
        let range = gap.range();
        let rounding = T::of(8.0) * T::epsilon() * range[0].abs().max(range[1].abs());
        let rounding = rounding.min(T::epsilon().sqrt() * on.half_width());
        let is_inside = |&x: &T| x >= range[0] - rounding && x <= range[1] + rounding;
        if let Some(x) = [on.left, on.right].into_iter().find(|x| !is_inside(x)) {
            return Err(SolveError::OutsideBodies { x, range }.into());
        }
        if self.decay.is_some() {
            let panels = &self.panel_set.panels;
            return Ok(edge_integrals::moments(panels, on, &mut self.over, None));
        }
        if !self.panel_set.covers(on) {
            self.moments = None;
            self.panel_set.extend(gap, on)?;
        }
        let m = self.remember(gap, on);
        // An error small enough on a wide span may be too large for a narrow one in its middle.
        let is_wide = |have: Interval<T>| have.half_width() > T::of(1.25) * on.half_width();
        if self.is_poor(&m) && self.panel_set.interval().is_some_and(is_wide) {
            return self.sample_anew(gap, on);
        }
        Ok(m)
    }

    fn prepare(&mut self, gap: &Gap<'_, T>, on: Interval<T>) -> Fallible<T, ()> {
        self.turn_to_one();
        let m = self.moments(gap, on)?;
        // It may also be too large for a short part of the contact beyond a breakpoint.
        if self.decay.is_none() && self.is_poor(&m) && self.panel_set.overshoots(gap, on) {
            let sampled = self.sample_anew(gap, on)?;
            // Limits and load still come from the earlier panels.
            self.moments = Some((on, Moments { error: m.error.max(sampled.error), ..sampled }));
        }
        if !self.is_prepared {
            let PanelSet { panels, size, tolerance, .. } = &self.panel_set;
            self.transform.set(panels, self.over.as_ref(), on, *size, *tolerance);
            self.is_prepared = self.decay.is_none();
        }
        Ok(())
    }

    fn pressures(
        &self,
        _gap: &Gap<'_, T>,
        load_case: &LoadCase<T>,
        x: &[T],
        out: &mut [T],
        _cost: &mut Cost,
    ) -> Fallible<T, ()> {
        if self.is_several {
            self.several.pressures(x, out);
            out.iter_mut().for_each(|pressure| *pressure *= load_case.kappa);
            return Ok(());
        }
        let (whole, rest) = x.as_chunks::<BATCH>();
        let (out, rest_out) = out.as_chunks_mut::<BATCH>();
        for (x, out) in whole.iter().zip(out) {
            *out = self.in_lanes(load_case, x, BATCH);
        }
        if let [first, ..] = rest {
            let mut lanes = [*first; BATCH];
            lanes[..rest.len()].copy_from_slice(rest);
            rest_out.copy_from_slice(&self.in_lanes(load_case, &lanes, rest.len())[..rest.len()]);
        }
        Ok(())
    }

    fn estimate(
        &self,
        gap: &Gap<'_, T>,
        load_case: &LoadCase<T>,
        x: T,
        cost: &mut Cost,
    ) -> Fallible<T, Estimate<T>> {
        let mut value = [T::zero()];
        self.pressures(gap, load_case, &[x], &mut value, cost)?;
        let LoadCase { kappa, .. } = *load_case;
        if self.is_several {
            let error = kappa * self.several.error(x) + T::of(4.0) * T::epsilon() * value[0].abs();
            return Ok(Estimate { value: value[0], error });
        }
        let on = self.transform.on;
        let of_series =
            kappa * self.transform.error(&self.panel_set.panels, x) / (T::pi() * T::pi());
        // An error of the edge integrals is an error of the strengths.
        let strength = self.moments.map_or(T::zero(), |(_, m)| kappa * on.half_width() * m.error);
        let of_edges = T::of(6.0) * strength / (T::pi() * on.chebyshev_weight(x));
        let error = of_series + of_edges + T::of(4.0) * T::epsilon() * value[0].abs();
        Ok(Estimate { value: value[0], error })
    }

    fn cost(&self) -> Cost {
        self.panel_set.cost + self.several.cost
    }

    fn sampled_interval(&self) -> Option<Interval<T>> {
        self.panel_set.interval().filter(|_| self.decay.is_none())
    }

    fn prescribe_limits(&mut self, gap: &Gap<'_, T>, limits: Ends<Option<T>>) {
        for end in Side::BOTH {
            if self.panel_set.held[end].map(|held| held.limit) != limits[end] {
                self.panel_set.held[end] =
                    limits[end].and_then(|x| self.panel_set.look_at(gap, end, x));
            }
        }
    }

    fn slope(&self, x: T) -> Option<T> {
        self.panel_set.slope(x)
    }

    fn clear_samples(&mut self) {
        self.panel_set.clear(true);
        (self.decay, self.moments) = (None, None);
    }

    fn reset(&mut self, same_bodies: bool) {
        self.panel_set.cost = Cost::default();
        self.panel_set.look_back();
        // Each solve expands anew, so that no rounding adds up from one to the next.
        self.over = None;
        self.several.reset(same_bodies);
        self.turn_to_one();
        if !same_bodies {
            self.panel_set.clear(false);
            (self.decay, self.moments) = (None, None);
        }
    }
}

impl<T: Real> PanelIntegrator<T> {
    /// Returns the pressure at `count` points strictly inside the contact.
    #[inline(always)]
    fn in_lanes(&self, load_case: &LoadCase<T>, x: &[T; BATCH], count: usize) -> [T; BATCH] {
        let on = self.transform.on;
        let scale = load_case.kappa / (T::pi() * T::pi());
        let (half, least) = (T::of(0.5), T::of(0.1));
        let [free, bound] = self.strengths(load_case);
        let edges = Edges::of(on, x);
        let regular = self.transform.at(x, count, &edges);
        std::array::from_fn(|i| {
            let (left, right) = (edges.left[i], edges.right[i]);
            let by_root = half / edges.root[i];
            let pressure = scale * regular[i] + (bound.right * left + bound.left * right) * by_root;
            // The rounding left in a strength that should be zero makes up for the load error of
            // the rounded limits. Close to the edge only the limit counts.
            let left_over = (free.right * left + free.left * right) * by_root;
            let counts = left_over.abs() < least * pressure.abs();
            pressure + if counts { left_over } else { T::zero() }
        })
    }

    /// Returns K_b and K_a: the remainder at free edges, and the strength at the others.
    pub(crate) fn strengths(&self, load_case: &LoadCase<T>) -> [Ends<T>; 2] {
        let zero = T::zero();
        let Some((_, m)) = self.moments else { return [Ends::both(zero); 2] };
        let mean_pressure = load_case.load / self.transform.on.half_width();
        let strength = |sum: T| (mean_pressure - load_case.kappa * sum) / T::pi();
        let both = Ends { left: strength(m.m1 - m.m0), right: strength(m.m1 + m.m0) };
        let pick = |free: bool| {
            both.zip(load_case.free).map(|(k, is_free)| if is_free == free { k } else { zero })
        };
        [pick(true), pick(false)]
    }
}
