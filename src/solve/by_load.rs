//! Contact under which a quantity that grows with the load has a given value.
//!
//! Without adhesion the peak pressure, the approach of the bodies and the half-width never fall
//! with the load, whatever the number of contacts, and their derivatives are known:
//!
//! ```text
//! peak         ∂P/∂F at its place, a flat punch on the contacts
//! approach     dδ/dF = 1/stiffness
//! half-width   (da/dF + db/dF)/2
//! ```
//!
//! So Newton's method on ln q over ln F finds the load, between loads that are too small and too
//! large; for a power law it takes one step. Each trial is a solve by load, and its samples serve
//! the next. A quantity may jump: the half-width when a contact is born outside the others, the
//! peak when a corner is reached. A value inside a jump has no load.

use super::capacity::Capacity;
use super::edges::{Conditions, Given};
use super::{Contact, Work, topology};
use crate::gap::Asked;
use crate::material::Elasticity;
use crate::search::SearchError;
use crate::solution::{Approaching, ContactState, LoadRates, Report, Solved};
use crate::{
    ContactError, Edge, Ends, EvaluationError, InputError, Interval, Real, References, SolveError,
};

/// Loads tried before the search is given up.
const MAX_LOADS: usize = 100;

/// First load for an approach, as a share of `κ δ`: a third is right twenty half-widths above the
/// references, and less further off. The samples of a contact serve a narrower one, but not a
/// wider one.
const FIRST_LOAD: f64 = 0.4;

/// Largest factor between the loads of two trials.
const MAX_STEP: f64 = 1e3;

/// Largest factor between a load and the first one while the load is not enclosed.
const MAX_FACTOR: f64 = 1e12;

/// Quantity that is given instead of the load.
#[derive(Clone, Copy)]
pub(super) enum Quantity<T> {
    HalfWidth,
    Peak,
    Approach { references: References<T>, bodies: Option<[Elasticity<T>; 2]> },
}

/// Checks the edges for a given peak: a corner on the bodies may end them; at any other edge that
/// is not free the pressure is infinite.
pub(super) fn check_edges<T: Real>(contact: &Contact<'_, T>) -> Result<(), ContactError<T>> {
    let edges = contact.checked_edges()?;
    if let Ends { left: Edge::Fixed(left), right: Edge::Fixed(right) } = edges {
        return Err(InputError::BothLimitsGiven { interval: Interval { left, right } }.into());
    }
    match edges.into_iter().find(|edge| !edge.is_free()) {
        Some(edge) => Err(InputError::PeakEdge { edge }.into()),
        None => Ok(()),
    }
}

/// Search for the load under which a quantity has the wanted value.
pub(super) struct ByLoad<'s, 'w, 'b, T: Real> {
    contact: &'s Contact<'b, T>,
    quantity: Quantity<T>,
    wanted: T,
    work: &'s mut Work<'w, T>,
}

/// Conclusion from a failed trial.
enum Bound<T> {
    /// Load, and an estimate of the quantity under it.
    At(T, T),
    /// Widest contact, which has the wanted value.
    Widest(ContactState<T>),
}

/// Contact, its quantity, and the derivative of the quantity by the load.
type Trial<T> = (ContactState<T>, [T; 2]);

/// Loads that are too small and too large, each with its quantity.
#[derive(Clone, Copy)]
struct Enclosure<T> {
    low: Option<[T; 2]>,
    high: Option<[T; 2]>,
}

impl<T: Real> Enclosure<T> {
    fn add(&mut self, at: [T; 2], wanted: T) {
        *(if at[1] < wanted { &mut self.low } else { &mut self.high }) = Some(at);
    }

    /// Returns this load, or one within the enclosure if this one is known to be too small or too
    /// large.
    fn inside(&self, load: T) -> T {
        let step = T::of(MAX_STEP);
        match [self.low, self.high].map(|end| end.map(|[load, _]| load)) {
            [Some(low), Some(high)] if !(load > low && load < high) => low.sqrt() * high.sqrt(),
            [Some(low), None] if load <= low => low * step,
            [None, Some(high)] if load >= high => high / step,
            _ => load,
        }
    }

    /// Tells whether the enclosure has no load left inside.
    fn is_closed(&self) -> bool {
        let nothing = T::one() + T::epsilon().sqrt();
        matches!((self.low, self.high), (Some([low, _]), Some([high, _])) if high <= low * nothing)
    }
}

impl<'s, 'w, 'b, T: Real> ByLoad<'s, 'w, 'b, T> {
    /// Finds the contact under the load sought.
    pub fn find(
        contact: &'s Contact<'b, T>,
        quantity: Quantity<T>,
        wanted: T,
        work: &'s mut Work<'w, T>,
    ) -> Result<ContactState<T>, ContactError<T>> {
        Self { contact, quantity, wanted, work }.run()
    }

    fn run(&mut self) -> Result<ContactState<T>, ContactError<T>> {
        let mut first = self.first()?;
        let (mut load, mut fault) = (first, None);
        let mut enclosure = Enclosure { low: None, high: None };
        // Number of steps left without a check, once the next one squares the error.
        let mut last_steps: Option<usize> = None;
        for _ in 0..MAX_LOADS {
            // So small a number has no digits left.
            if !load.is_finite() || (load * T::epsilon()).is_zero() {
                return Err(SolveError::Overflow { interval: self.whole() }.into());
            }
            let [value, rate] = match self.at(load) {
                Ok((found, at)) => {
                    let step = (self.wanted - at[0]) / at[1].component(0);
                    let size = step.abs() / load;
                    let is_there = T::DERIVATIVE_ORDER == 0 && size <= T::epsilon();
                    if last_steps == Some(0) || is_there {
                        let error = found.error.map(|error| error + size);
                        return Ok(ContactState { error, ..found });
                    }
                    last_steps = match last_steps {
                        Some(left) => Some(left - 1),
                        // The rate of a peak is known to only half the digits.
                        None => (size <= T::epsilon().sqrt()).then_some(2 * T::DERIVATIVE_ORDER),
                    };
                    if last_steps.is_some() {
                        load += step;
                        continue;
                    }
                    fault = fault.filter(|_| at[0] < self.wanted);
                    at
                }
                Err(error) => match self.bound(&error, load)? {
                    Bound::Widest(found) => return Ok(found),
                    Bound::At(at, value) => {
                        // The capacity of the bodies is a better estimate than the first guess.
                        (first, load) = (if at < load { at } else { first }, at);
                        fault = Some(error);
                        [value, T::zero()]
                    }
                },
            };
            enclosure.add([load, value], self.wanted);
            load = enclosure.inside(self.next(load, [value, rate]));
            let is_known = enclosure.low.is_some() && enclosure.high.is_some();
            let is_far = load > first * T::of(MAX_FACTOR) || load < first / T::of(MAX_FACTOR);
            if enclosure.is_closed() || !is_known && is_far {
                return Err(self.none(&enclosure, fault));
            }
        }
        let best = self.work.workspace.hull().unwrap_or(self.whole());
        let residual = enclosure.high.map_or(self.wanted, |[_, value]| value - self.wanted);
        let source = SearchError::NotConverged { x: load, residual };
        Err(SolveError::LimitSearch { best, source }.into())
    }

    /// Returns the load to start with.
    fn first(&mut self) -> Result<T, ContactError<T>> {
        let (kappa, wanted, gap) = (self.contact.kappa, self.wanted, &self.contact.gap);
        let known = self.work.workspace.hull().or(self.contact.start);
        let [left, right] = gap.range();
        let sixty_fourth = T::of(1.0 / 64.0) * (right - left);
        let half_width = known.map_or(sixty_fourth, |on| on.half_width());
        let hertz = T::frac_pi_2() * wanted * half_width;
        let asked = match self.quantity {
            Quantity::Approach { .. } => return Ok(T::of(FIRST_LOAD) * kappa * wanted),
            Quantity::HalfWidth => Asked::HalfWidth(wanted),
            Quantity::Peak => {
                if known.is_some() || gap.is_convex() {
                    return Ok(hertz);
                }
                Asked::Peak(wanted / kappa)
            }
        };
        let load = kappa * self.work.workspace.about(gap, asked, self.work.cost)?;
        Ok(if load > T::zero() { load } else { hertz })
    }

    /// Finds the contact under a load, with its quantity.
    fn at(&mut self, load: T) -> Result<Trial<T>, ContactError<T>> {
        let (contact, conditions) = (self.contact, self.contact.under(load)?);
        let found = self.solve(conditions)?;
        let (gap, kappa) = (&contact.gap, contact.kappa);
        let solved = Solved { gap, integrator: &*self.work.integrator, kappa, found: &found };
        let (at, doubt) = match self.quantity {
            Quantity::HalfWidth => {
                let (on, wanted, peak) = (found.interval, self.wanted, T::one() / T::zero());
                // No load widens a contact from corner to corner.
                if found.free == Ends::both(false) && on.half_width() < wanted {
                    let widest = Capacity { on, end: on.right, load, peak };
                    return Err(widest.too_wide(wanted));
                }
                let rates = LoadRates::new(solved)?;
                let half = T::of(0.5);
                ([found.interval.half_width(), half * (rates.a + rates.b)], T::zero())
            }
            Quantity::Peak => match solved.largest_pressure(self.work.cost) {
                Ok((_, x, top)) => {
                    let rate = match solved.several() {
                        Some(_) => LoadRates::new(solved)?.pressure(x)?,
                        None => T::frac_1_pi() / found.interval.chebyshev_weight(x),
                    };
                    ([top.value, rate], top.error / top.value.abs())
                }
                Err(ContactError::Evaluation(EvaluationError::Singular { .. })) => {
                    let widest =
                        topology::up_to_corner(contact, &conditions, found.free, self.work);
                    if let Some(widest) = widest {
                        return Err(widest.too_short(load));
                    }
                    ([T::one() / T::zero(), T::zero()], T::zero())
                }
                Err(error) => return Err(error),
            },
            Quantity::Approach { references, bodies } => {
                let at = Approaching::new(solved, bodies, &references)?.with_rate()?;
                let rate = at[1];
                if !(rate > T::zero() && rate.is_finite()) {
                    return Err(SolveError::ApproachFalls { load, rate }.into());
                }
                (at, T::zero())
            }
        };
        // The half-width follows from the peak, and is known no better.
        let error = found.error.map(|error| error + doubt);
        Ok((ContactState { error, ..found }, at))
    }

    /// Finds the contacts under some conditions, ready for their pressures.
    fn solve(&mut self, conditions: Conditions<T>) -> Result<ContactState<T>, ContactError<T>> {
        let Self { contact, work, .. } = self;
        work.workspace.report = Report::new();
        let found = topology::find(contact, conditions, work)?;
        work.keep(&contact.gap, found.interval)?;
        Ok(found)
    }

    /// Returns the next load by Newton's method for the logarithms, within its trusted range.
    fn next(&self, load: T, [value, rate]: [T; 2]) -> T {
        let power = value / (load * rate);
        // The exponent of a round body, if the rate is unknown.
        let power = if power.is_finite() { power } else { T::of(2.0) };
        let (step, largest) = ((self.wanted / value).powf(power), T::of(MAX_STEP));
        let step = if step.is_finite() && value > T::zero() { step } else { largest };
        load.component(0) * step.component(0).min(largest).max(largest.recip())
    }

    /// Returns the conclusion from a failed trial on its load.
    fn bound(&mut self, error: &ContactError<T>, load: T) -> Result<Bound<T>, ContactError<T>> {
        let (wanted, infinite) = (self.wanted, T::one() / T::zero());
        Ok(match *error {
            ContactError::Solve(SolveError::DomainTooShort {
                end,
                carried,
                half_width,
                peak,
                kappa_is_default,
                ..
            }) => {
                let given = Given::HalfWidth(half_width);
                let (at, load) = (carried.min(load), carried);
                let (value, too_large) = match self.quantity {
                    Quantity::HalfWidth => (
                        half_width,
                        ContactError::Solve(SolveError::HalfWidthTooLarge {
                            wanted,
                            half_width,
                            end,
                            load,
                            peak,
                            kappa_is_default,
                        }),
                    ),
                    Quantity::Peak => (
                        peak,
                        ContactError::Solve(SolveError::PeakTooHigh {
                            wanted,
                            half_width,
                            found: peak,
                            end,
                            load,
                            kappa_is_default,
                        }),
                    ),
                    // The further approach of the bodies is unknown.
                    Quantity::Approach { .. } => (infinite, error.clone()),
                };
                if (value - wanted).abs() <= T::of(8.0) * T::epsilon() * wanted {
                    let conditions = self.contact.under(load)?;
                    return Ok(Bound::Widest(self.solve(Conditions { given, ..conditions })?));
                }
                if value < wanted {
                    return Err(too_large);
                }
                Bound::At(at, value)
            }
            // So small a load is not held by a corner, or does not close a hollow.
            ContactError::Solve(SolveError::NoEquilibrium { .. } | SolveError::LiftsOff { .. }) => {
                Bound::At(load, T::zero())
            }
            _ => return Err(error.clone()),
        })
    }

    /// Returns the error for a value that occurs under no load.
    fn none(&self, enclosure: &Enclosure<T>, fault: Option<ContactError<T>>) -> ContactError<T> {
        let (wanted, Enclosure { low, high }) = (self.wanted, *enclosure);
        match (fault, low, high, self.quantity) {
            (Some(_), Some([load, approach]), Some(_), Quantity::Approach { .. })
                if approach > T::zero() =>
            {
                ContactError::Solve(SolveError::ApproachTooLarge { wanted, approach, load })
            }
            (Some(error), ..) => error,
            // The peak is too large under any load.
            (None, None, high, Quantity::Peak) => {
                let half_width = self.work.workspace.hull().unwrap_or(self.whole()).half_width();
                let found = high.map_or(T::of(f64::NAN), |[_, found]| found);
                ContactError::Solve(SolveError::NoPeak { wanted, half_width, found })
            }
            (None, low, Some([load, above]), _) => {
                let below = low.map_or(T::zero(), |[_, below]| below);
                ContactError::Solve(SolveError::InJump { wanted, load, below, above })
            }
            (None, _, None, _) => {
                let whole = self.whole();
                ContactError::Solve(SolveError::NoEquilibrium {
                    half_width: whole.half_width(),
                    near: whole.left,
                })
            }
        }
    }

    fn whole(&self) -> Interval<T> {
        let Ends { left, right } = self.contact.ends();
        Interval { left, right }
    }
}
