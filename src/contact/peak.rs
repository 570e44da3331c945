//! The contact with a given largest pressure.
//!
//! The largest pressure is sought as a function of the half-width, with which it grows. Each trial
//! is a contact of given half-width; the samples of one serve the next.

use super::edges::{Conditions, Control};
use super::{Contact, Found, approach};
use crate::gap::{Cost, Gap};
use crate::quadrature::{Engine, Pressing, complete};
use crate::search::Bracket;
use crate::{ContactError, Interval, Real};

/// Points at which a largest pressure is first looked for.
const POINTS: usize = 64;

/// Widths tried before the pressure is given up.
const MOST_WIDTHS: usize = 200;

/// Where the pressure of a prepared contact is largest, and how large.
pub(crate) fn peak<T: Real>(
    engine: &dyn Engine<T>,
    gap: &Gap<'_, T>,
    pressing: &Pressing<T>,
    on: Interval<T>,
) -> Result<[T; 2], ContactError<T>> {
    let mut x = [T::zero(); POINTS];
    for (i, x) in x.iter_mut().enumerate() {
        *x = on.at_angle(T::pi() * (T::count(i) + T::of(0.5)) / T::count(POINTS));
    }
    let mut pressures = [T::zero(); POINTS];
    engine.pressures(gap, pressing, &x, &mut pressures, &mut Cost::default())?;
    let mut best = 0;
    for i in 0..POINTS {
        if pressures[i] > pressures[best] {
            best = i;
        }
    }
    let around = |i: usize| if i < POINTS { x[i] } else { on.left };
    let before = if best == 0 { on.right } else { x[best - 1] };
    let (mut lo, mut hi) = (around(best + 1), before);
    let mut top = [x[best], pressures[best]];
    // Joints are where a pressure is not smooth, and may be infinite.
    let mut cost = Cost::default();
    let mut at = |x: T| -> Result<T, ContactError<T>> {
        let pressure = engine.estimate(gap, pressing, x, &mut cost)?.value;
        if pressure > top[1] {
            top = [x, pressure];
        }
        Ok(pressure)
    };
    for joint in gap.telling_joints(on, T::one(), 4 * POINTS) {
        let pressure = at(joint)?;
        if !pressure.is_finite() && pressure > T::zero() {
            return Ok([joint, pressure]);
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

/// A contact of given half-width, and its largest pressure.
fn attempt<T: Real>(
    contact: &Contact<'_, T>,
    wanted: T,
    half_width: T,
    last: Option<Interval<T>>,
    engine: &mut dyn Engine<T>,
    cost: &mut Cost,
) -> Result<(Found<T>, T), ContactError<T>> {
    let (kappa, edges, gap) = (contact.kappa, contact.checked_edges()?, &contact.gap);
    let conditions = Conditions { kappa, edges, control: Control::HalfWidth(half_width) };
    let found = approach::find(contact, conditions, engine, last, cost)?;
    engine.prepare(gap, found.interval)?;
    complete(engine, gap, found.interval, cost)?;
    let pressing = Pressing { kappa, load: found.load, free: found.free };
    let [_, pressure] = peak(engine, gap, &pressing, found.interval)?;
    if pressure.is_finite() && found.free == [true; 2] {
        Ok((found, pressure))
    } else {
        let found = if pressure.is_finite() { T::one() / T::zero() } else { pressure };
        Err(ContactError::NoPeak { wanted, half_width, found })
    }
}

/// Finds the contact with a given peak pressure.
pub(super) fn find<T: Real>(
    contact: &Contact<'_, T>,
    wanted: T,
    engine: &mut dyn Engine<T>,
    warm: Option<Interval<T>>,
    cost: &mut Cost,
) -> Result<Found<T>, ContactError<T>> {
    let found = by_search(contact, wanted, engine, warm, cost)?;
    if T::MORE_STEPS == 0 {
        return Ok(found);
    }
    // The derivatives of the half-width, by a few steps with its rate from a difference.
    let on = found.interval.plain();
    let mut half_width = on.half_width();
    let mut try_out = |half_width| attempt(contact, wanted, half_width, Some(on), engine, cost);
    let step = T::of(1e-5) * half_width;
    let rate = ((try_out(half_width)?.1 - try_out(half_width - step)?.1) / step).part(0);
    for _ in 0..super::further::STEPS {
        half_width -= (try_out(half_width)?.1 - wanted) / rate;
    }
    Ok(try_out(half_width)?.0)
}

fn by_search<T: Real>(
    contact: &Contact<'_, T>,
    wanted: T,
    engine: &mut dyn Engine<T>,
    warm: Option<Interval<T>>,
    cost: &mut Cost,
) -> Result<Found<T>, ContactError<T>> {
    let mut last = warm;
    let mut attempt = |half_width: T| -> Result<(Found<T>, T), ContactError<T>> {
        let trial = attempt(contact, wanted, half_width, last, engine, cost);
        if let Ok((found, _)) = &trial {
            last = Some(found.interval);
        }
        trial
    };
    let range = contact.gap.range();
    let start = warm.or(contact.start).map(|on| on.half_width());
    let mut half_width = start.unwrap_or(T::of(1.0 / 64.0) * (range[1] - range[0]));
    let (mut low, mut high): (Option<[T; 2]>, Option<[T; 2]>) = (None, None);
    let (mut too_wide, mut narrowest): (Option<T>, Option<T>) = (None, None);
    for _ in 0..MOST_WIDTHS {
        let (found, pressure) = match attempt(half_width) {
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
                half_width = T::of(0.5) * (from + half_width);
                let first = *narrowest.get_or_insert(T::of(1e-6) * half_width);
                if half_width - from <= T::of(1e-9) * half_width || half_width < first {
                    return Err(error);
                }
                continue;
            }
            Err(error) => return Err(error),
        };
        if pressure == wanted {
            return Ok(found);
        }
        *(if pressure < wanted { &mut low } else { &mut high }) = Some([half_width, pressure]);
        if let (Some(low), Some(high)) = (low, high) {
            let bracket = Bracket::new(low[0].min(high[0]), low[0].max(high[0]));
            let bracket = bracket.values(low[1] - wanted, high[1] - wanted);
            let (mut best, mut failed): (Option<(T, Found<T>)>, _) = (None, None);
            let mut f = |half_width| match attempt(half_width) {
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
                (None, Ok(_), Some((_, found))) => Ok(found),
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
