//! Whether what solves the equations is a contact: nothing pulls inside, nothing overlaps outside.
//!
//! Inside, a slope of the gap that rises on every panel proves it: P is an integral of the rate of g'
//! with a kernel that is nowhere negative. Only otherwise pressures are looked at. Outside, the gap
//! between the loaded bodies is looked at where their heights are known.

use super::Found;
use super::field::{Field, POINTS};
use crate::gap::{Cost, Gap, LowPlace, Sampler};
use crate::quadrature::panels::{self, Several};
use crate::quadrature::{Engine, Pressing};
use crate::{ContactError, Interval, Real};

/// Joints of a contact at which the pressure is looked at, besides those where the slope jumps down.
const MOST_JOINTS: usize = 64;

/// Places with tension of which it is asked how far they can be trusted.
const MOST_DOUBTFUL: usize = 256;

/// How often a stretch between two heights is halved in search of its lowest place.
const MOST_HALVES: usize = 8;

/// How much of the contact is not looked at beside a gap that has closed.
const CLOSED: f64 = 1e-6;

/// Steps to a least pressure between those that were looked at.
const MOST_STEPS: usize = 4;

/// The contacts of a solution, ready to be checked.
pub(super) struct Check<'c, T: Real> {
    pub gap: &'c Gap<'c, T>,
    pub engine: &'c dyn Engine<T>,
    pub kappa: T,
    pub found: &'c Found<T>,
    /// Places at which two contacts have met with nothing but rounding between them: a concave kink, say.
    pub closed: &'c [T],
}

impl<T: Real> Check<'_, T> {
    fn contacts(&self) -> &[Interval<T>] {
        let several = panels::several(self.engine).map(Several::contacts);
        several.unwrap_or(std::slice::from_ref(&self.found.interval))
    }

    fn pressing(&self) -> Pressing<T> {
        Pressing { kappa: self.kappa, load: self.found.load, free: self.found.free }
    }

    /// The share of the mean pressure, or of the heights in the contact, that is taken for zero.
    fn share(&self) -> T {
        let rounding = T::epsilon().cbrt() * T::epsilon().cbrt();
        let error = T::of(16.0) * self.found.error.unwrap_or(T::zero());
        rounding.max(error).min(T::of(0.01))
    }

    /// The pressures in each contact.
    pub fn fields(&self, fields: &mut Vec<Field<T>>) -> Result<(), ContactError<T>> {
        fields.clear();
        for &on in self.contacts() {
            let x = Field::places(on);
            let mut pressures = [T::zero(); POINTS];
            let pressing = self.pressing();
            self.engine.pressures(self.gap, &pressing, &x, &mut pressures, &mut Cost::default())?;
            fields.push(Field::new(on, &x, &pressures));
        }
        Ok(())
    }

    /// Where the bodies would have to pull at each other inside a contact, and the pressure there.
    pub fn tension(&self, fields: &mut Vec<Field<T>>) -> Result<Option<[T; 2]>, ContactError<T>> {
        let pulled = self.found.adhesive != [false; 2];
        if pulled || panels::rises(self.engine, self.share()) == Some(true) {
            return Ok(None);
        }
        self.fields(fields)?;
        let hull = self.found.interval;
        let mut found: Vec<[T; 2]> = Vec::new();
        let mut meet = |x: T, pressure: T, allowed: T| {
            let is_closed = |&closed: &T| (x - closed).abs() <= T::of(CLOSED) * hull.half_width();
            // NaN does not press either.
            let presses = pressure >= -allowed;
            if !presses && !self.closed.iter().any(is_closed) {
                found.push([x, pressure]);
            }
        };
        for (i, field) in fields.iter().enumerate() {
            let on = field.interval();
            let mean = field.load().abs() / on.half_width();
            let allowed =
                self.share() * mean.max(self.found.load.abs() / on.half_width() * T::epsilon());
            let (at, known) = (Field::places(on), field.pressures());
            for (&x, &pressure) in at.iter().zip(known) {
                meet(x, pressure, allowed);
            }
            // Between them, at the vertex of the parabola through each least value and its neighbours.
            for i in 1..POINTS - 1 {
                let [before, least, after] = [known[i - 1], known[i], known[i + 1]];
                if !(least <= before && least <= after) {
                    continue;
                }
                let (mut x, mut p) = ([at[i + 1], at[i], at[i - 1]], [after, least, before]);
                for _ in 0..MOST_STEPS {
                    let [one, two] = [x[1] - x[0], x[2] - x[1]];
                    let [fall, rise] = [(p[1] - p[0]) / one, (p[2] - p[1]) / two];
                    let bend = (rise - fall) / (one + two);
                    let slope = (fall * two + rise * one) / (one + two);
                    let vertex = x[1] - T::of(0.5) * slope / bend;
                    let below = p[1] - T::of(0.25) * slope * slope / bend;
                    // A least value that is far above nothing needs no closer look.
                    let is_near = below < T::of(0.5) * p[1];
                    if !(is_near && vertex > x[0] && vertex < x[2]) || vertex == x[1] {
                        break;
                    }
                    let mut pressure = [T::zero()];
                    let cost = &mut Cost::default();
                    self.engine.pressures(
                        self.gap,
                        &self.pressing(),
                        &[vertex],
                        &mut pressure,
                        cost,
                    )?;
                    meet(vertex, pressure[0], allowed);
                    (x, p) = if vertex < x[1] {
                        ([x[0], vertex, x[1]], [p[0], pressure[0], p[1]])
                    } else {
                        ([x[1], vertex, x[2]], [p[1], pressure[0], p[2]])
                    };
                }
            }
            let mut places = [T::zero(); POINTS];
            let mut count = 0;
            let mut look = |places: &[T]| {
                let mut pressures = [T::zero(); POINTS];
                let out = &mut pressures[..places.len()];
                let cost = &mut Cost::default();
                self.engine.pressures(self.gap, &self.pressing(), places, out, cost)?;
                places.iter().zip(out).for_each(|(&x, &mut pressure)| meet(x, pressure, allowed));
                Ok::<_, ContactError<T>>(())
            };
            // Where the slope jumps down the pressure goes to minus infinity.
            for joint in self.gap.telling_joints(on, -T::one(), MOST_JOINTS) {
                let doubt = self.engine.doubt(joint).unwrap_or(T::zero());
                if self.gap.jump(joint)[0].abs() > T::of(16.0) * doubt {
                    look(&[joint])?;
                }
            }
            // What the panels resolve is not narrower than their nodes.
            panels::nodes(self.engine, i, &mut |x| {
                (places[count], count) = (x, count + 1);
                if count == POINTS {
                    count = 0;
                    look(&places)?;
                }
                Ok(())
            })?;
            look(&places[..count])?;
        }
        found.sort_by(|one, other| {
            one[1].partial_cmp(&other[1]).unwrap_or(std::cmp::Ordering::Less)
        });
        for &[x, pressure] in found.iter().take(MOST_DOUBTFUL) {
            if !pressure.is_finite() {
                return Ok(Some([x, pressure]));
            }
            // Beside a kink that nobody declared a value may be all doubt.
            let cost = &mut Cost::default();
            let estimate = self.engine.estimate(self.gap, &self.pressing(), x, cost)?;
            if pressure + estimate.error < T::zero() {
                return Ok(Some([x, pressure]));
            }
        }
        Ok(None)
    }

    /// About where the loaded gap is lowest between two places, at the first of which it falls and at the
    /// second rises.
    fn lowest_between(
        &self,
        fields: &[Field<T>],
        sampler: &mut Sampler<T>,
        [mut left, mut right]: [T; 2],
    ) -> Result<T, ContactError<T>> {
        let half = T::of(0.5);
        for _ in 0..MOST_HALVES {
            let x = half * (left + right);
            let pulled = fields.iter().fold(T::zero(), |sum, field| sum + field.pull(x));
            let slope = sampler.slope(self.gap, x)? - pulled / self.kappa;
            if slope > T::zero() { right = x } else { left = x }
        }
        Ok(half * (left + right))
    }

    /// Where the loaded bodies would overlap outside the contacts, and the gap there, as far as heights of
    /// the gap before loading show it, by rising x.
    pub fn overlap(
        &self,
        fields: &[Field<T>],
        heights: impl Iterator<Item = LowPlace<T>>,
        cost: &mut Cost,
    ) -> Result<Option<[T; 2]>, ContactError<T>> {
        let (contacts, hull) = (self.contacts(), self.found.interval);
        let last = contacts.len() - 1;
        let mut sampler = Sampler::default();
        let mut worst: Option<[T; 2]> = None;
        let total = |x: T| fields.iter().fold(T::zero(), |sum, field| sum + field.potential(x));
        let doubt = fields.iter().fold(T::zero(), |sum, field| sum + field.doubt()) / self.kappa;
        // The edge from which the gap is followed to x, the height of the gap there, and what the pressure
        // takes off it.
        let mut from: Option<(usize, T, T)> = None;
        let mut next = 0;
        for LowPlace { x, height, between } in heights {
            while next <= last && contacts[next].right <= x {
                next += 1;
            }
            if next <= last && contacts[next].left <= x {
                continue;
            }
            let (edge, contact, right) = match next.checked_sub(1) {
                None => (contacts[0].left, 0, false),
                Some(before) => (contacts[before].right, before, true),
            };
            let (_, at_edge, taken) = match from.filter(|&(at, ..)| at == next) {
                Some(known) => known,
                None => {
                    let height = match panels::several(self.engine) {
                        Some(several) => several.height(contact, right),
                        None => sampler.height(self.gap, self.gap.nearest(edge))?,
                    };
                    *from.insert((next, height, total(edge)))
                }
            };
            let gap = |height: T| height - at_edge - (total(x) - taken) / self.kappa;
            let allowed = doubt
                + self.share() * (height - at_edge).abs()
                + T::of(64.0) * T::epsilon() * (height.abs() + at_edge.abs());
            if gap(height) >= -allowed {
                continue;
            }
            // The height may be an interpolated one, or a bound.
            let x = match between {
                Some([from, to]) => {
                    // Not in the contacts on either side.
                    let from = next.checked_sub(1).map_or(from, |i| from.max(contacts[i].right));
                    let to = contacts.get(next).map_or(to, |on| to.min(on.left));
                    self.lowest_between(fields, &mut sampler, [from, to])?
                }
                None => x,
            };
            let height = sampler.height(self.gap, x)?;
            let gap = height - at_edge - (total(x) - taken) / self.kappa;
            // Where the formulas are all rounding, heights do not go with slopes, and tell nothing.
            let aside = T::epsilon().sqrt() * hull.half_width();
            let beside = self.gap.nearest(x + aside);
            let rise = sampler.height(self.gap, beside)? - height;
            let due = sampler.slope(self.gap, x)? * (beside - x);
            let rounding = T::of(64.0) * T::epsilon() * (height.abs() + at_edge.abs());
            let is_sound = (rise - due).abs() <= T::of(0.1) * due.abs() + rounding;
            let noise = T::of(8.0) * (rise - due).abs();
            let is_open = gap >= -(allowed + noise) || !is_sound;
            if !is_open && worst.is_none_or(|[_, least]| gap < least) {
                worst = Some([x, gap]);
            }
        }
        cost.heights += sampler.cost.evaluations;
        Ok(worst)
    }
}
