//! The contact with a given largest pressure.
//!
//! The largest pressure is sought as a function of the half-width, with which it grows. Each trial
//! is a contact of given half-width; the samples of one serve the next.

use super::edges::{Conditions, Edge, Given};
use super::widest::widest;
use super::{Contact, Found, approach};
use crate::gap::{Cost, Gap};
use crate::quadrature::{Engine, Estimate, Pressing, complete};
use crate::search::Bracket;
use crate::{ContactError, Interval, Real};

/// Points at which a largest pressure is first looked for.
const POINTS: usize = 64;

/// Widths tried before the pressure is given up.
const MOST_WIDTHS: usize = 200;

/// Where the pressure of a prepared contact is largest, and how large, adding to `cost` what it takes.
pub(crate) fn peak<T: Real>(
    engine: &dyn Engine<T>,
    gap: &Gap<'_, T>,
    pressing: &Pressing<T>,
    on: Interval<T>,
    cost: &mut Cost,
) -> Result<(T, Estimate<T>), ContactError<T>> {
    let mut x = [T::zero(); POINTS];
    for (i, x) in x.iter_mut().enumerate() {
        *x = on.at_angle(T::pi() * (T::count(i) + T::of(0.5)) / T::count(POINTS));
    }
    let mut pressures = [T::zero(); POINTS];
    engine.pressures(gap, pressing, &x, &mut pressures, cost)?;
    let mut best = 0;
    for i in 0..POINTS {
        if pressures[i] > pressures[best] {
            best = i;
        }
    }
    let around = |i: usize| if i < POINTS { x[i] } else { on.left };
    let before = if best == 0 { on.right } else { x[best - 1] };
    let (mut lo, mut hi) = (around(best + 1), before);
    let mut top = (x[best], engine.estimate(gap, pressing, x[best], cost)?);
    let mut at = |x: T| -> Result<T, ContactError<T>> {
        let pressure = engine.estimate(gap, pressing, x, cost)?;
        if pressure.value > top.1.value {
            top = (x, pressure);
        }
        Ok(pressure.value)
    };
    // Joints are where a pressure is not smooth, and may be infinite.
    for joint in gap.telling_joints(on, T::one(), 4 * POINTS) {
        let pressure = at(joint)?;
        if !pressure.is_finite() && pressure > T::zero() {
            return Ok((joint, Estimate { value: pressure, error: T::zero() }));
        }
    }
    // Golden section: the pressure is flat at its peak, so half the digits of x are enough.
    let golden = T::of(0.618_033_988_749_894_9);
    let (mut left, mut right) = (hi - golden * (hi - lo), lo + golden * (hi - lo));
    let (mut p_left, mut p_right) = (at(left)?, at(right)?);
    while hi - lo > T::epsilon().sqrt() * on.half_width() && left < right {
        if p_left < p_right {
            (lo, left, p_left) = (left, right, p_right);
            right = lo + golden * (hi - lo);
            p_right = at(right)?;
        } else {
            (hi, right, p_right) = (right, left, p_left);
            left = hi - golden * (hi - lo);
            p_left = at(left)?;
        }
    }
    Ok(top)
}

/// Contacts of given half-width between free edges.
struct Trials<'s, T: Real> {
    contact: &'s Contact<'s, T>,
    wanted: T,
    engine: &'s mut dyn Engine<T>,
    cost: &'s mut Cost,
    /// Where the next contact is looked for first.
    last: Option<Interval<T>>,
}

impl<T: Real> Trials<'_, T> {
    fn conditions(&self, half_width: T) -> Conditions<T> {
        let kappa = self.contact.kappa;
        Conditions { kappa, edges: [Edge::Free; 2], given: Given::HalfWidth(half_width) }
    }

    /// A contact and its largest pressure.
    fn at(&mut self, half_width: T) -> Result<(Found<T>, T), ContactError<T>> {
        let (contact, conditions) = (self.contact, self.conditions(half_width));
        let found = approach::find(contact, conditions, self.engine, self.last, self.cost)?;
        let on = found.interval;
        let rounding = T::of(8.0) * T::epsilon() * half_width;
        super::check_within(on, contact.ends(), rounding)?;
        self.engine.prepare(&contact.gap, on)?;
        complete(self.engine, &contact.gap, on, self.cost)?;
        let pressing = Pressing { kappa: contact.kappa, load: found.load, free: found.free };
        let (_, Estimate { value: pressure, error: doubt }) =
            peak(self.engine, &contact.gap, &pressing, on, self.cost)?;
        if pressure.is_finite() {
            self.last = Some(on);
            // The half-width goes with the peak, and is known no better.
            let error = found.error.map(|error| error + doubt / pressure.abs());
            Ok((Found { error, ..found }, pressure))
        } else {
            Err(ContactError::NoPeak { wanted: self.wanted, half_width, found: pressure })
        }
    }

    /// The largest half-width that there is room for, where that can be told.
    fn widest(&mut self) -> Option<T> {
        let conditions = self.conditions(T::one());
        let on = widest(self.contact, conditions, self.engine, self.cost)?;
        self.last = Some(on);
        Some(on.half_width())
    }
}

/// A corner on the bodies may end them; at any other edge but a free one the pressure is infinite.
fn check_edges<T: Real>(contact: &Contact<'_, T>) -> Result<(), ContactError<T>> {
    let edges = contact.checked_edges()?;
    if let [Edge::Fixed(left), Edge::Fixed(right)] = edges {
        return Err(ContactError::Control { interval: Interval { left, right } });
    }
    let range = contact.gap.range();
    for edge in edges {
        match edge {
            Edge::Free => {}
            Edge::UpTo(x) if x >= range[0] && x <= range[1] => {}
            Edge::UpTo(x) => return Err(ContactError::OutsideBodies { x, range }),
            Edge::Fixed(_) | Edge::Adhesive(_) => return Err(ContactError::PeakEdge { edge }),
        }
    }
    Ok(())
}

/// Finds the contact with a given peak pressure.
pub(super) fn find<T: Real>(
    contact: &Contact<'_, T>,
    wanted: T,
    engine: &mut dyn Engine<T>,
    warm: Option<Interval<T>>,
    cost: &mut Cost,
) -> Result<Found<T>, ContactError<T>> {
    check_edges(contact)?;
    let mut trials = Trials { contact, wanted, engine, cost, last: warm };
    let found = by_search(&mut trials, warm)?;
    if T::MORE_STEPS == 0 {
        return Ok(found);
    }
    // The derivatives of the half-width, by a few steps with its rate from a difference.
    let on = found.interval.plain();
    let mut half_width = on.half_width();
    let mut try_out = |half_width| {
        trials.last = Some(on);
        trials.at(half_width)
    };
    let step = T::of(1e-5) * half_width;
    let rate = ((try_out(half_width)?.1 - try_out(half_width - step)?.1) / step).part(0);
    for _ in 0..super::further::STEPS {
        half_width -= (try_out(half_width)?.1 - wanted) / rate;
    }
    Ok(try_out(half_width)?.0)
}

fn by_search<T: Real>(
    trials: &mut Trials<'_, T>,
    warm: Option<Interval<T>>,
) -> Result<Found<T>, ContactError<T>> {
    let (contact, wanted) = (trials.contact, trials.wanted);
    let range = contact.gap.range();
    let start = warm.or(contact.start).map(|on| on.half_width());
    let mut half_width = start.unwrap_or(T::of(1.0 / 64.0) * (range[1] - range[0]));
    let (mut low, mut high): (Option<[T; 2]>, Option<[T; 2]>) = (None, None);
    let (mut too_wide, mut narrowest): (Option<T>, Option<T>) = (None, None);
    let mut widest = None;
    for _ in 0..MOST_WIDTHS {
        let (found, pressure) = match trials.at(half_width) {
            Ok(trial) => trial,
            // Too wide for the bodies, or beyond a place where the pressure is infinite: half the way
            // back.
            Err(
                error @ (ContactError::NoPeak { .. }
                | ContactError::OutsideBodies { .. }
                | ContactError::TooShort { .. }
                | ContactError::NoBalance { .. }),
            ) => {
                let from = low.map_or(T::zero(), |[half_width, _]| half_width);
                too_wide = Some(half_width);
                let no_room = matches!(
                    error,
                    ContactError::OutsideBodies { .. } | ContactError::TooShort { .. }
                );
                if no_room && widest.is_none() {
                    widest = trials.widest().filter(|&widest| widest > from && widest < half_width);
                    if let Some(widest) = widest {
                        half_width = widest;
                        continue;
                    }
                }
                half_width = T::of(0.5) * (from + half_width);
                let first = *narrowest.get_or_insert(T::of(1e-6) * half_width);
                if half_width - from <= T::of(1e-9) * half_width || half_width < first {
                    return Err(match low {
                        Some(low) if no_room => too_high(wanted, low),
                        _ => error,
                    });
                }
                continue;
            }
            Err(error) => return Err(error),
        };
        if pressure == wanted {
            return Ok(found);
        }
        if widest == Some(half_width) && pressure < wanted {
            // All the room there is.
            let met = wanted - pressure <= T::of(8.0) * T::epsilon() * wanted;
            return if met { Ok(found) } else { Err(too_high(wanted, [half_width, pressure])) };
        }
        if pressure <= T::zero() {
            // So narrow a contact there is none: the bodies touch beside a hollow.
            let wider = half_width + half_width;
            let half_way = |end: T| T::of(0.5) * half_width + T::of(0.5) * end;
            half_width = too_wide.filter(|&end| wider >= end).map_or(wider, half_way);
            continue;
        }
        *(if pressure < wanted { &mut low } else { &mut high }) = Some([half_width, pressure]);
        if let (Some(low), Some(high)) = (low, high) {
            let bracket = Bracket::new(low[0].min(high[0]), low[0].max(high[0]));
            let bracket = bracket.values(low[1] - wanted, high[1] - wanted);
            let (mut best, mut failed): (Option<(T, Found<T>)>, _) = (None, None);
            let mut f = |half_width| match trials.at(half_width) {
                Ok((found, pressure)) => {
                    let missed = pressure - wanted;
                    if best.is_none_or(|(least, _)| missed.abs() <= least) {
                        best = Some((missed.abs(), found));
                    }
                    missed
                }
                Err(error) => {
                    failed = Some(error);
                    T::of(f64::NAN)
                }
            };
            let root = contact.strategy().find(&mut f, &bracket);
            return match (failed, root, best) {
                (Some(error), _, _) => Err(error),
                // A strategy may have left something, or more than it says.
                (None, Ok(_), Some((missed, found))) => {
                    let error = found.error.map(|error| error + missed / wanted);
                    Ok(Found { error, ..found })
                }
                (None, Err(source), Some((_, found))) => {
                    Err(ContactError::LimitSearch { best: found.interval, source })
                }
                (None, _, None) => {
                    Err(ContactError::NoPeak { wanted, half_width: low[0], found: low[1] })
                }
            };
        }
        // The pressure of a round body grows with the half-width.
        let factor = wanted / pressure;
        let factor = if pressure < wanted { factor * T::of(1.2) } else { factor / T::of(1.2) };
        let last = half_width;
        half_width *= factor.max(T::of(1e-3)).min(T::of(4.0));
        if let Some(too_wide) = too_wide.filter(|&too_wide| half_width >= too_wide) {
            half_width = T::of(0.5) * (last + too_wide);
        }
    }
    let found = low.or(high).map_or(T::zero(), |[_, pressure]| pressure);
    Err(ContactError::NoPeak { wanted, half_width, found })
}

fn too_high<T: Real>(wanted: T, [half_width, found]: [T; 2]) -> ContactError<T> {
    ContactError::PeakTooHigh { wanted, half_width, found }
}
