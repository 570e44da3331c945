//! The contact with a given largest pressure.
//!
//! The largest pressure grows with the load, on bodies of any shape: the contact being what it is, by
//! `1/(π sqrt((a - x)(x + b)))` for each unit of it. So the load is sought. Each trial is a contact of given
//! load; the samples of one serve the next.

use super::Contact;
use super::capacity::{Capacity, capacity};
use super::edges::{Conditions, Edge, Given};
use super::single_contact::Single;
use crate::gap::{Cost, Survey};
use crate::quadrature::{Estimate, Integrator, LoadCase, complete};
use crate::search::{Bracket, Newton, TryFindError, try_find_with_slope};
use crate::solution::ContactState;
use crate::solution::largest_pressure;
use crate::{ContactError, Ends, Interval, Real};

/// Loads tried before the pressure is given up.
const MOST_LOADS: usize = 200;

/// The largest power of the peak that the load goes with: 2 for a round body, 1 for a flat.
const MOST_POWER: f64 = 5.0;

/// Contacts of given load between free edges.
struct Trials<'s, T: Real> {
    contact: &'s Contact<'s, T>,
    wanted: T,
    look: Option<&'s Survey<T>>,
    integrator: &'s mut dyn Integrator<T>,
    cost: &'s mut Cost,
    /// Where the next contact is looked for first.
    last: Option<Interval<T>>,
    /// What the bodies bear, once looked at.
    bears: Option<Option<Capacity<T>>>,
}

/// A contact, its largest pressure, and how that grows with the load.
type PeakTrial<T> = (ContactState<T>, T, T);

impl<T: Real> Trials<'_, T> {
    fn conditions(&self, given: Given<T>) -> Conditions<T> {
        Conditions { kappa: self.contact.kappa, edges: Ends::both(Edge::Free), given }
    }

    fn at(&mut self, given: Given<T>) -> Result<PeakTrial<T>, ContactError<T>> {
        let (contact, conditions) = (self.contact, self.conditions(given));
        let (start, look, bears) = (contact.start, self.look, self.bears);
        let (integrator, cost) = (&mut *self.integrator, &mut *self.cost);
        let mut single = Single { contact, conditions, start, look, integrator, cost, bears };
        let found = single.find(self.last);
        // A corner may end them before they end themselves.
        if contact.ends() == contact.gap.range().into() {
            self.bears = single.bears;
        }
        let found = found?;
        let on = found.interval;
        let rounding = T::of(8.0) * T::epsilon() * on.half_width();
        super::check_within(on, contact.ends(), rounding)?;
        self.integrator.prepare(&contact.gap, on)?;
        complete(self.integrator, &contact.gap, on, self.cost)?;
        let load_case = LoadCase { kappa: contact.kappa, load: found.load, free: found.free };
        let (x, Estimate { value: pressure, error: doubt }) =
            largest_pressure(self.integrator, &contact.gap, &load_case, (0, on), self.cost)?;
        if !doubt.is_finite() {
            return Err(ContactError::Unresolved { x, pressure, error: doubt });
        }
        self.last = Some(on.plain());
        // The half-width goes with the peak, and is known no better.
        let error = found.error.map(|error| error + doubt / pressure.abs());
        let rate = T::frac_1_pi() / on.chebyshev_weight(x);
        Ok((ContactState { error, ..found }, pressure, rate))
    }
}

/// A corner on the bodies may end them; at any other edge but a free one the pressure is infinite.
fn check_edges<T: Real>(contact: &Contact<'_, T>) -> Result<(), ContactError<T>> {
    let edges = contact.checked_edges()?;
    if let Ends { left: Edge::Fixed(left), right: Edge::Fixed(right) } = edges {
        return Err(ContactError::BothLimitsGiven { interval: Interval { left, right } });
    }
    match edges.into_iter().find(|edge| !edge.is_free()) {
        Some(edge) => Err(ContactError::PeakEdge { edge }),
        None => Ok(()),
    }
}

/// Finds the contact with a given peak pressure.
pub(super) fn find<T: Real>(
    contact: &Contact<'_, T>,
    wanted: T,
    look: Option<&Survey<T>>,
    integrator: &mut dyn Integrator<T>,
    warm: Option<Interval<T>>,
    cost: &mut Cost,
) -> Result<ContactState<T>, ContactError<T>> {
    check_edges(contact)?;
    let mut trials = Trials { contact, wanted, look, integrator, cost, last: warm, bears: None };
    let found = by_search(&mut trials, warm)?;
    if T::DERIVATIVE_ORDER == 0 {
        return Ok(found);
    }
    // The derivatives of the load. From one step to the next one more is exact, but for the rate, which
    // is that at a peak found to half the digits.
    let mut load = found.load.component(0);
    for _ in 0..T::DERIVATIVE_ORDER + 2 {
        let (_, pressure, rate) = trials.at(Given::Load(load))?;
        load += (wanted - pressure) / rate.component(0);
    }
    Ok(trials.at(Given::Load(load))?.0)
}

fn by_search<T: Real>(
    trials: &mut Trials<'_, T>,
    warm: Option<Interval<T>>,
) -> Result<ContactState<T>, ContactError<T>> {
    let (contact, wanted) = (trials.contact, trials.wanted);
    let (zero, one) = (T::zero(), T::one());
    let (range, infinite) = (contact.gap.range(), one / zero);
    let half_width = match warm.or(contact.start) {
        Some(on) => on.half_width(),
        None => T::of(1.0 / 64.0) * (range[1] - range[0]),
    };
    // That of Hertz: or of a contact as wide as that, if there is one.
    let hertz = T::frac_pi_2() * wanted * half_width;
    let begin = trials.at(Given::HalfWidth(half_width));
    let mut bears = trials.bears.flatten();
    // The load of a width that fits on a flat is nothing but rounding.
    let carries = |found: &ContactState<T>| found.load > found.force.unwrap_or(zero);
    let mut begin =
        begin.ok().filter(|(found, pressure, _)| carries(found) && pressure.is_finite());
    let first = match (&begin, bears) {
        (Some((found, ..)), _) => found.load,
        (None, Some(widest)) => widest.load,
        (None, None) => hertz,
    };
    let interval = trials.last.unwrap_or(Interval { left: range[0], right: range[1] });
    if !(hertz > zero && hertz.is_finite()) {
        return Err(ContactError::Overflow { interval });
    }
    let mut load = first;
    // Loads and peaks on either side of the one wanted: infinite where the pressure is, or there is no
    // contact, and zero where so small a load does not close a hollow.
    let (mut low, mut high): (Option<[T; 2]>, Option<[T; 2]>) = (None, None);
    let mut found = T::of(f64::NAN);
    for _ in 0..MOST_LOADS {
        let has_start = begin.is_some() || trials.last.is_some();
        let trial = match (begin.take(), bears) {
            (Some(trial), _) => Ok(trial),
            (None, Some(widest)) if load >= widest.load => Err(widest.too_short(load)),
            _ => trials.at(Given::Load(load)),
        };
        let (pressure, rate) = match trial {
            Ok((found, pressure, _)) if pressure == wanted => return Ok(found),
            Ok((_, pressure, rate)) => {
                found = pressure;
                (pressure, rate)
            }
            Err(ContactError::NoEquilibrium { .. }) if high.is_none() => (zero, zero),
            Err(
                ContactError::DomainTooShort { .. }
                | ContactError::OutsideBodies { .. }
                | ContactError::NoEquilibrium { .. },
            ) => {
                let conditions = trials.conditions(Given::Load(load));
                let look = || capacity(contact, &conditions, contact.ends(), trials.cost);
                bears = *trials.bears.get_or_insert_with(look);
                match bears.filter(|widest| widest.load <= load) {
                    Some(widest) => {
                        let room = T::of(8.0) * T::epsilon() * wanted;
                        if (widest.peak - wanted).abs() <= room {
                            trials.last = Some(widest.on);
                            let half_width = widest.on.half_width();
                            return Ok(trials.at(Given::HalfWidth(half_width))?.0);
                        }
                        if widest.peak < wanted {
                            return Err(widest.peak_too_high(wanted));
                        }
                        load = widest.load;
                        (widest.peak, T::frac_1_pi() / widest.on.half_width())
                    }
                    None => (infinite, infinite),
                }
            }
            Err(error) => return Err(error),
        };
        let power = pressure / (load * rate);
        if power > T::of(MOST_POWER) && has_start {
            // Most of such a pressure is no load's: the contact spans a hollow, and pulls there.
            trials.last = None;
            continue;
        }
        *(if pressure < wanted { &mut low } else { &mut high }) = Some([load, pressure]);
        // By Newton's rule for the logarithms, and a little further, so as to enclose it.
        let power = power.max(T::of(0.5)).min(T::of(MOST_POWER));
        let step = (wanted / pressure).powf(power);
        let step = if pressure < wanted { step * T::of(1.1) } else { step / T::of(1.1) };
        let sure = pressure.is_finite() && pressure > zero;
        let most = T::of(if sure { 1e12 } else { 1e3 });
        let mut next = load * step.max(most.recip()).min(most);
        // So small a number has no digits left.
        if (next * T::epsilon()).is_zero() {
            return Err(ContactError::Overflow { interval });
        }
        if let (Some([from, at_from]), Some([to, at_to])) = (low, high) {
            if to <= T::of(4.0) * from && at_to.is_finite() {
                let bracket = Bracket::new(from, to).values(at_from - wanted, at_to - wanted);
                return enclosed(trials, &bracket.guess(next));
            }
            if to <= from * (one + T::epsilon().sqrt()) {
                break;
            }
            if !(next > from && next < to) {
                next = from.sqrt() * to.sqrt();
            }
        } else if !(sure || next > T::of(1e-12) * first && next < T::of(1e12) * first) {
            break;
        }
        load = next;
    }
    let half_width = trials.last.map_or(half_width, |on| on.half_width());
    Err(ContactError::NoPeak { wanted, half_width, found })
}

/// Finds the load between one that is too small and one that is too large.
fn enclosed<T: Real>(
    trials: &mut Trials<'_, T>,
    bracket: &Bracket<T>,
) -> Result<ContactState<T>, ContactError<T>> {
    let wanted = trials.wanted;
    let strategy = trials.contact.search.unwrap_or(&Newton::DEFAULT);
    let mut best: Option<(T, ContactState<T>)> = None;
    let function = |load| {
        let (found, pressure, rate) = trials.at(Given::Load(load))?;
        let missed = pressure - wanted;
        if best.is_none_or(|(least, _)| missed.abs() <= least) {
            best = Some((missed.abs(), found));
        }
        Ok((missed, rate))
    };
    let root = try_find_with_slope(strategy, function, bracket);
    match (root, best) {
        (Err(TryFindError::Function(error)), _) => Err(error),
        // A strategy may have left something, or more than it says.
        (Ok(_), Some((missed, found))) => {
            let error = found.error.map(|error| error + missed / wanted);
            Ok(ContactState { error, ..found })
        }
        (Err(TryFindError::Search(source)), Some((_, found))) => {
            Err(ContactError::LimitSearch { best: found.interval, source })
        }
        (_, None) => Err(ContactError::NoPeak {
            wanted,
            half_width: trials.last.map_or(T::zero(), |on| on.half_width()),
            found: T::of(f64::NAN),
        }),
    }
}
