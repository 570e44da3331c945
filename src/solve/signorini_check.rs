//! Check that a solution of the equations is a contact: no tension inside, no overlap outside.
//!
//! Inside, a slope of the gap that rises on every panel is proof: P is an integral of the rate of
//! g' with a kernel that is nowhere negative. Otherwise the series of 32 pressures in each contact
//! shows the sign, and where the slope is less smooth than they are, that of each panel, by the
//! code of a certificate ([`Inside`]). Outside, the gap between the loaded bodies is evaluated
//! where their heights are known.

mod beside;
mod dips;
mod outside;
mod passed;

use super::exterior_field::{ExteriorField, ExteriorFields, POINTS};
use crate::gap::{Cost, Gap};
use crate::quadrature::panels::PanelIntegrator;
use crate::quadrature::{Engine, Integrator, LoadCase};
use crate::solution::{Closeness, ContactState, Inside, Tensions, least_width, parting};
use crate::{Ends, Extremum, Fallible, Interval, Real, Side};
pub(super) use dips::{Dip, Overlaps};
pub(super) use passed::{Passed, Under};

/// Largest number of places with tension whose uncertainty is estimated.
const MAX_DOUBTFUL: usize = 256;

/// Largest number of places in a contact at which the pressure is evaluated for the gap next to it,
/// and of panels of its integral, of 48 places each.
const MAX_POINTS: usize = 4096;

/// Least distance of such a place from a limit, in units of rounding of the contact.
const LEAST_FROM_LIMIT: f64 = 8.0;

/// Slopes that leave the pressure as it is, as a share of those of a wave whose pressure would be
/// the least one found: κ/π times its slope.
const FAINT: f64 = 0.02;

/// Largest distance of a corner from a limit, as a share of the half-width, to act on the series of
/// the pressure.
const BESIDE: f64 = 0.1;

/// Contacts of a solution, ready to be checked.
pub(super) struct SignoriniCheck<'c, T: Real> {
    pub gap: &'c Gap<'c, T>,
    pub panels: &'c PanelIntegrator<T>,
    pub engine: &'c Engine<T>,
    pub contacts: &'c [Interval<T>],
    pub kappa: T,
    pub found: &'c ContactState<T>,
    /// Contacts under a heavier load, if known: the bodies touch nowhere outside them.
    pub widest: &'c [Interval<T>],
    /// Contacts under a lighter load, if known: tension inside them comes with tension outside
    /// them.
    pub pressed: &'c [Interval<T>],
}

/// Spans of tension, the places by which they were found, and the spans that were searched.
#[derive(Clone)]
pub(super) struct TensionSpans<T> {
    pub spans: Vec<Interval<T>>,
    tensions: Tensions<T>,
    uneven: Vec<[T; 2]>,
}

impl<T: Real> TensionSpans<T> {
    pub fn new() -> Self {
        Self { spans: Vec::new(), tensions: Tensions::new(), uneven: Vec::new() }
    }
}

impl<T: Real> SignoriniCheck<'_, T> {
    /// Tells whether a span is in a contact under a lighter load.
    fn is_pressed(&self, [from, to]: [T; 2]) -> bool {
        let on = self.pressed.get(self.pressed.partition_point(|on| on.right < from));
        on.is_some_and(|on| on.contains(from) && on.contains(to))
    }

    fn load_case(&self) -> LoadCase<T> {
        LoadCase { kappa: self.kappa, load: self.found.load, free: self.found.free }
    }

    /// Computes the series of the pressure in each contact.
    pub fn fields(&self, fields: &mut ExteriorFields<T>) -> Fallible<T, ()> {
        fields.each.clear();
        for (i, &on) in self.contacts.iter().enumerate() {
            let x = std::array::from_fn(|i| ExteriorField::place(on, i, POINTS));
            let mut pressures = [T::zero(); POINTS];
            self.pressures(&x, &mut pressures)?;
            let free = self.panels.free_of(i, self.found.free);
            let mut field = ExteriorField::new(on, free, x, pressures);
            let jumps = |breakpoint: T| !self.gap.jump(breakpoint)[0].is_zero();
            field.has_corner = self.gap.breakpoints(on).any(jumps);
            self.doubt_at_corners(&mut field)?;
            fields.each.push(field);
        }
        Ok(())
    }

    fn pressures(&self, x: &[T], pressures: &mut [T]) -> Fallible<T, ()> {
        let cost = &mut Cost::default();
        self.panels.pressures(self.gap, &self.load_case(), x, pressures, cost)
    }

    /// Takes more pressures in contacts whose series leave more than a share of the load uncertain:
    /// they hide many waves, or kinks. Tells whether there were any. Sums up all series.
    fn resolve(&self, fields: &mut ExteriorFields<T>, share: T) -> Fallible<T, bool> {
        let mut is_finer = false;
        // The outermost of N places is `L (π/N)²/8` from a limit, which may be far from the origin.
        let is_apart = |on: Interval<T>, count: usize| {
            let rounding = T::epsilon() * on.left.abs().max(on.right.abs()).max(on.half_width());
            let step = T::pi() / T::count(count);
            step * step * on.half_width() >= T::of(8.0 * LEAST_FROM_LIMIT) * rounding
        };
        for field in &mut fields.each {
            let mut count = field.coefficients().len();
            while field.doubt > share * self.found.load.abs()
                && count < MAX_POINTS
                && is_apart(field.on, 2 * count)
            {
                (count, is_finer) = (2 * count, true);
                let place = |i| ExteriorField::place(field.on, i, count);
                let x: Vec<T> = (0..count).map(place).collect();
                let mut pressures = vec![T::zero(); count];
                self.pressures(&x, &mut pressures)?;
                field.refine(&x, pressures);
                self.doubt_at_corners(field)?;
            }
        }
        fields.gather(self.gap.range());
        Ok(is_finer)
    }

    /// Adds to the uncertainty of a series what corners do: at those inside the pressure is like a
    /// logarithm, and just inside a limit it falls from that of a held one.
    fn doubt_at_corners(&self, field: &mut ExteriorField<T>) -> Fallible<T, ()> {
        let (on, count) = (field.on, T::count(field.coefficients().len()));
        // Place i lies (2 i + 1)² times as far from the limit as the first.
        let fourth = T::of(49.0 / 8.0) * (T::pi() / count).powi(2) * on.half_width();
        let corners = [self.gap.breakpoint_after(on.left), self.gap.breakpoint_before(on.right)];
        let mut unseen = T::zero();
        for (corner, side) in corners.into_iter().zip(Side::BOTH) {
            let away = |corner: T| (corner - on[side]).abs();
            let is_near = |&corner: &T| away(corner) <= T::of(BESIDE) * on.half_width();
            let bulges = |&corner: &T| self.gap.jump(corner)[0] > T::zero();
            let Some(corner) = corner.filter(is_near).filter(bulges) else { continue };
            if away(corner) < fourth {
                let mut pressure = [T::zero()];
                self.pressures(&[corner + (corner - on[side])], &mut pressure)?;
                // About the load up to there, times the logarithm of the spacing over it.
                unseen += T::of(16.0) * away(corner) * pressure[0].abs();
            }
        }
        if field.has_corner {
            // Aliased, coefficients that fall no faster than 1/n² add a logarithm to the potential.
            field.doubt *= T::of(0.75) * count.ln();
        }
        field.doubt += unseen;
        Ok(())
    }

    /// Finds tension inside the contacts: returns the place and the pressure of the largest one,
    /// and puts all spans of tension into `tension_spans`.
    pub fn tension(
        &self,
        fields: &mut ExteriorFields<T>,
        TensionSpans { spans: tension_spans, tensions, uneven }: &mut TensionSpans<T>,
    ) -> Fallible<T, Option<[T; 2]>> {
        tension_spans.clear();
        let adhesive = self.found.adhesive != Ends::both(false);
        let is_same = |(one, other): (&Interval<T>, &Interval<T>)| one.is_same(other);
        let is_pressed = self.pressed.len() == self.contacts.len()
            && self.pressed.iter().zip(self.contacts).all(is_same);
        let allowed = |steepest: T| self.found.negligible_fall(self.kappa, steepest);
        if adhesive || is_pressed || self.panels.rises(allowed) {
            return Ok(None);
        }
        self.fields(fields)?;
        let (x, value) = (self.found.interval.left, T::zero());
        tensions.clear(Extremum { x, value });
        for (i, field) in fields.each.iter().enumerate() {
            self.look_into(i, field, tensions, uneven)?;
        }
        tensions.sort();
        let mut worst = None;
        for &Extremum { x, value: pressure } in tensions.found.iter().take(MAX_DOUBTFUL) {
            if tension_spans.iter().any(|span| span.contains(x)) {
                continue;
            }
            // Next to an undeclared kink a value may be all uncertainty.
            if pressure.is_finite() {
                let cost = &mut Cost::default();
                let estimate = self.panels.estimate(self.gap, &self.load_case(), x, cost)?;
                if pressure + estimate.error >= T::zero() {
                    continue;
                }
            }
            let on = self.contacts.iter().find(|on| on.contains(x));
            let on = *on.unwrap_or(&self.found.interval);
            let least = least_width(self.gap, self.found.interval, x);
            let pressures = &|x: &[T], out: &mut [T]| self.pressures(x, out);
            let (span, is_closed) = parting(pressures, on, [x, pressure], least)?;
            if !is_closed {
                worst.get_or_insert([x, pressure]);
                tension_spans.push(span);
            }
        }
        Ok(worst)
    }

    /// Looks for tension in one contact, given the series of its pressure.
    fn look_into(
        &self,
        contact: usize,
        field: &ExteriorField<T>,
        found: &mut Tensions<T>,
        uneven: &mut Vec<[T; 2]>,
    ) -> Fallible<T, ()> {
        let on = field.on;
        let mean = field.load().abs() / on.half_width();
        // The uncertainty of a pressure is estimated afterwards.
        let allowed = ContactState::<T>::rounding()
            * mean.max(self.found.load.abs() / on.half_width() * T::epsilon());
        let free = self.panels.free_of(contact, self.found.free);
        let (pressures, closeness) =
            (&|x: &[T], out: &mut [T]| self.pressures(x, out), Closeness::OF_A_SOLVE);
        let inside = Inside { pressures, on, free, allowed, closeness };
        found.meet(&field.x, &field.pressures, allowed);
        let mut drops = self.panels.drops(contact).filter(|&x| !self.is_pressed([x; 2]));
        drops.try_for_each(|x| inside.look_at(&[x], found))?;
        // A feature of the slope may be narrower than the distance of these places, but not than
        // its panel.
        let faint = T::of(FAINT) * T::pi() / self.kappa * inside.least(&field.x, &field.pressures);
        uneven.clear();
        self.panels.uneven(contact, |x| faint / inside.factor(x), uneven);
        let mut uneven = uneven.iter().filter(|&&span| !self.is_pressed(span));
        uneven.try_for_each(|&span| inside.bound(span, found))
    }
}
