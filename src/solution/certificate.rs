//! Proof that a solution of the equations is a contact: no tension inside, no overlap outside.
//!
//! All of the gap is sampled in short [cells]. The contacts come first: have the panels of the
//! solver missed anything, and do the limits [balance](balance) the bodies? Then the gap is
//! followed from each limit to the end of the bodies, or half the way to the next contact. Signs
//! are proved piece by piece: a Chebyshev series is bounded by its coefficients, on shorter and
//! shorter pieces until the sign is certain. If the slope of the gap rises over a single contact,
//! and is larger yet beyond, the cells alone are enough. One contact is treated as several.

mod balance;
mod cells;
mod outside;

use super::check::{
    Closeness, Inside, Pressures, Tensions, extremes, least_width, nearer, parting,
};
use super::{ContactState, Solved};
use crate::gap::{Cost, Gap};
use crate::quadrature::panels::{Several, System, rises_over};
use crate::{ContactError, Ends, Fallible, Interval, Real, Side, SolveError};
use balance::balanced;
use cells::Cells;
use outside::{Loaded, OutsideOf};

/// Largest number of evaluations, and of samples, before the certificate is given up.
const MAX_EVALUATIONS: usize = 1 << 20;

/// Largest length of a cell as a share of the bodies' range; each has eight nodes or more.
const LONGEST_CELL: f64 = 1.0 / 400.0;

/// Length of a cell in widths of the narrowest feature that is sure to be seen in it.
const WIDTHS: f64 = 4.0;

/// Number of points at which the pressure of one of several contacts is summed up.
const SUMMED: usize = 512;

/// Largest number of breakpoints at which the pressure is taken, besides those where the slope
/// jumps down.
const MAX_JOINTS: usize = 512;

/// Proof that a solution is a contact.
///
/// It proves `P ≥ 0` in the whole contact and a gap `≥ 0` from its edges to the ends of the bodies,
/// or to the next of several contacts; [`is_proved`](Self::is_proved) tells whether up to rounding.
/// The proof holds as far as the curves are known from the points at which they are evaluated:
/// eight or more in each `spacing`, and more near the edges, at breakpoints, and wherever the slope
/// of the gap is not a polynomial of low degree. A gap at a hollow corner inside a contact that is
/// narrower than 64 times the rounding of x, or of the heights, is not told from none: the pressure
/// touches zero there.
///
/// ```
/// use linecontact::{Contact, Control, Curve, CurvePoint, Flat};
///
/// let hollow = Curve::new([-1.0, 1.0], |k: f64| {
///     let k2 = k * k;
///     CurvePoint { x: k, y: k2 * (k2 / 4.0 - 0.05), dx: 1.0, dy: k * (k2 - 0.1) }
/// });
/// let solution = Contact::new(&Flat, &hollow)?.solve(Control::HalfWidth(0.6))?;
/// let pressure = solution.certify()?.pressure.unwrap();
/// // 2 κ L²/(π F) (L²/2 - 0.1) at x = 0
/// let exact = 0.72 * 0.08 / (std::f64::consts::PI * solution.load());
/// assert!((pressure.value / exact - 1.0).abs() < 1e-6);
/// # Ok::<(), linecontact::ContactError<f64>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Certificate<T> {
    /// Least ratio of `P` to the mean pressure times `sqrt((x + b)(a - x))/L`, 4/π for a parabola;
    /// at an edge that is not free the root of its distance is in the denominator. Each of several
    /// contacts has its own limits and load. It is a value, no doubt: `None` where none is needed,
    /// as the slope of the gap rises throughout a single contact, which implies `P > 0`, or between
    /// adhesive edges, which may pull.
    pub pressure: Option<Extremum<T>>,
    /// Least gap at a place outside where the bodies approach each other again, a length. `None`
    /// where there is no such place: the gap grows on both sides up to the ends, and between two
    /// contacts has a single maximum.
    pub gap: Option<Extremum<T>>,
    /// Length of the longest cell: a feature at least a quarter as wide cannot have been missed. It
    /// is a 400th of the bodies, or four times the [resolution](crate::Contact::resolution) if that
    /// is shorter.
    pub spacing: T,
    /// Cost of the certificate.
    pub cost: Cost,
}

impl<T: Real> Certificate<T> {
    /// Tells whether no sign hangs on rounding: the least ratio and the least gap are positive, or
    /// there is none. Else the pressure touches zero, or the bodies touch once more, and may be
    /// negative by the rounding, or by what the estimated error of the limits leaves open.
    #[must_use]
    pub fn is_proved(&self) -> bool {
        [self.pressure, self.gap].iter().flatten().all(|least| least.value > T::zero())
    }
}

/// Place and value of an extremum.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Extremum<T> {
    /// Place of the extremum.
    pub x: T,
    /// Value of the extremum.
    pub value: T,
}

fn undecided<T: Real>(x: T, Cost { evaluations, samples, .. }: Cost) -> ContactError<T> {
    ContactError::Solve(SolveError::Undecided { x, evaluations, samples })
}

/// Certifies contacts, whatever quadrature they were found with.
pub(crate) fn certify<T: Real>(solved: Solved<'_, T>) -> Fallible<T, Certificate<T>> {
    let Solved { gap, kappa, found, .. } = solved;
    let ContactState { interval: hull, free, adhesive, .. } = *found;
    let ends = followed(found.ends, hull);
    let by_default = (ends.right - ends.left) * T::of(LONGEST_CELL);
    let spacing = gap.resolution().map_or(by_default, |w| by_default.min(T::of(WIDTHS) * w));
    let mut cells = Cells::new(gap, spacing);
    if found.apart.is_some() {
        return apart(found, gap, cells);
    }
    // With Eq. (6) the strength left at an edge says no more than at a free one.
    let at_end = Ends { left: hull.left <= found.ends.left, right: hull.right >= found.ends.right };
    let at_corner = Ends::from_fn(|side| !free[side] && !adhesive[side] && at_end[side]);
    presses_at(found, at_corner)?;
    if found.is_doubtful() {
        return Err(undecided(hull.left, Cost::default()));
    }
    let [from, to] = gap.range();
    let within = |on: &Interval<T>| Interval { left: on.left.max(from), right: on.right.min(to) };
    let contacts: Vec<_> = solved.contacts().iter().map(within).collect();

    let steepest = |&[least, most]: &[T; 2]| most.max(-least);
    let (mut rows, mut slopes, mut doubt) = (Vec::new(), Vec::new(), T::zero());
    for (i, on) in contacts.iter().enumerate() {
        let row = cells.over(&cells.places(on.left, on.right, on.half_width()))?;
        slopes.push(extremes(&row.panels));
        let assumed = |x| solved.sampled_slope(i, x);
        doubt = doubt.max(cells.compare(&row.panels, assumed, steepest(&slopes[i]))?);
        rows.push(row);
    }
    let (mut several, mut system) = (Several::sampled(rows), System::new());
    let (load, share) = (found.load / kappa, found.zero_tolerance());
    let held: Vec<_> = (0..contacts.len()).map(|i| solved.free(i).map(|free| !free)).collect();
    several.set(gap, &contacts, &held, found.ends, false)?;
    several.bear(load, &mut system);
    let cost = several.cost;
    for (i, on) in contacts.iter().enumerate() {
        cells.check_heights(several.panel_set(i), [on.left, on.centre(), on.right])?;
    }
    balanced(kappa, found, &several, &mut system, doubt)?;
    let steepest = slopes.iter().map(steepest).fold(T::zero(), T::max);
    let rises = |fall| rises_over(&several.panel_set(0).panels, contacts[0], fall);
    let is_plain = contacts.len() == 1 && rises(found.negligible_fall(kappa, steepest));
    let pressure = match is_plain || adhesive != Ends::both(false) {
        true => None,
        false => {
            several.press();
            Some(least_pressure(gap, kappa, found, &several, cells.cost())?)
        }
    };

    // A corner inside the bodies holds the limit, too.
    let at_inner = |side: Side| !free[side] && !at_end[side] && gap.is_breakpoint(hull[side]);
    let is_held = Ends::from_fn(|side| adhesive[side] || at_corner[side] || at_inner(side));
    if contacts.len() == 1 && [is_held] != *several.held() {
        several.set(gap, &contacts, &[is_held], found.ends, false)?;
        several.bear(load, &mut system);
    }
    let allowed = share * steepest * hull.half_width();
    let pressed = Some((&several, &system));
    let state = Loaded { found, contacts: &contacts, pressed, slopes: &slopes, allowed };
    let gap = state.outside([is_held, at_corner], &mut cells)?;
    Ok(Certificate { pressure, gap, spacing: cells.spacing, cost: cost + cells.cost() })
}

/// Certifies bodies that are apart: they are nowhere closer than where they would touch first.
fn apart<T: Real>(
    found: &ContactState<T>,
    gap: &Gap<'_, T>,
    mut cells: Cells<'_, T>,
) -> Fallible<T, Certificate<T>> {
    let (contacts, slopes) = (&[found.interval], &[[T::zero(); 2]]);
    let allowed = ContactState::least_height(gap.range());
    let state = Loaded { found, contacts, pressed: None, slopes, allowed };
    let gap = state.outside([Ends::both(false); 2], &mut cells)?;
    Ok(Certificate { pressure: None, gap, spacing: cells.spacing, cost: cells.cost() })
}

impl<T: Real> Loaded<'_, T> {
    /// Returns the least gap outside the contacts and between them, or fails at an overlap;
    /// `is_held` marks edges that may pull.
    fn outside(
        &self,
        [is_held, at_corner]: [Ends<bool>; 2],
        cells: &mut Cells<'_, T>,
    ) -> Fallible<T, Option<Extremum<T>>> {
        let (found, contacts) = (self.found, self.contacts);
        let ends = followed(found.ends, found.interval);
        let strengths = found.strengths.zip(is_held);
        let strengths = strengths.map(|(k, is_held)| if is_held { k } else { T::zero() });
        let (mut worst, mut closest, last, half) = (None, None, contacts.len() - 1, T::of(0.5));
        // Place left of the middle of a gap, if the bodies come closer up to there.
        let mut falling: Option<Extremum<T>> = None;
        for (contact, &on) in contacts.iter().enumerate() {
            for side in Side::BOTH {
                let is_outer = contact == if side == Side::Right { last } else { 0 };
                if is_outer && at_corner[side] {
                    continue;
                }
                let end = match side {
                    _ if is_outer => ends[side],
                    Side::Right => half * on.right + half * contacts[contact + 1].left,
                    Side::Left => half * contacts[contact - 1].right + half * on.left,
                };
                let falls = last > 0 || strengths[side] <= T::zero().min(strengths[side.other()]);
                let mut outside = OutsideOf::new(self, contact, side, falls);
                outside.follow(end, cells)?;
                if is_outer {
                    outside.part_again();
                } else if side == Side::Right {
                    falling = outside.falling;
                } else if falling.is_some() && outside.falling.is_some() {
                    outside.part_again();
                }
                (worst, closest) = (nearer(worst, outside.worst), nearer(closest, outside.closest));
            }
        }
        worst.map_or(Ok(closest), |Extremum { x, value }| Err(found.overlap(x, value).into()))
    }
}

/// Refuses corners that pull.
fn presses_at<T: Real>(found: &ContactState<T>, at_corner: Ends<bool>) -> Fallible<T, ()> {
    let ContactState { interval, load, strengths, .. } = *found;
    let mean = T::of(0.5) * load.abs() / interval.half_width();
    // With adhesion the load may be zero.
    let pressed = strengths.into_iter().fold(mean, |max, strength| max.max(strength.abs()));
    // If both edges pull, the error names the right one.
    for side in [Side::Right, Side::Left] {
        let presses = strengths[side] >= -found.zero_tolerance() * pressed;
        if at_corner[side] && !presses {
            return Err(found.tension(interval[side], -T::one() / T::zero()).into());
        }
    }
    Ok(())
}

/// Finds the least pressure of all contacts, each relative to a smooth body under the same load.
/// Fails at the deepest tension in the first contact with any.
fn least_pressure<T: Real>(
    gap: &Gap<'_, T>,
    kappa: T,
    state: &ContactState<T>,
    several: &Several<T>,
    cost: Cost,
) -> Fallible<T, Extremum<T>> {
    let pressures = |x: &[T], pressures: &mut [T]| {
        several.pressures(x, pressures);
        pressures.iter_mut().for_each(|pressure| *pressure *= kappa);
        Ok(())
    };
    let last = several.contacts().len() - 1;
    let mut least = None;
    for (i, &on) in several.contacts().iter().enumerate() {
        let borne = if last == 0 { state.load } else { borne(&pressures, on)? };
        let mean = T::of(0.5) * borne.abs() / on.half_width();
        let free = several.held()[i].map(|held| !held);
        let (allowed, closeness) = (state.zero_tolerance() * mean, Closeness::OF_A_PROOF);
        let inside = Inside { pressures: &pressures, on, free, allowed, closeness };
        let mut found = Tensions::new();
        let joints: Vec<T> = gap.telling_breakpoints(on, -T::one(), MAX_JOINTS).collect();
        inside.look_at(&joints, &mut found)?;
        let mut left = on.left;
        for right in gap.breakpoints(on).chain([on.right]) {
            inside.bound([left, right], &mut found)?;
            left = right;
        }
        found.sort();
        let mut closed: Vec<(Interval<T>, T)> = Vec::new();
        for Extremum { x, value: pressure } in found.found {
            if closed.iter().any(|(span, _)| span.contains(x)) {
                continue;
            }
            let least = least_width(gap, state.interval, x);
            let (span, is_closed) = parting(&pressures, on, [x, pressure], least)?;
            if !is_closed {
                let is_known = pressure.partial_cmp(&pressure).is_some();
                let tension = || state.tension(x, pressure).into();
                return Err(if is_known { tension() } else { undecided(x, cost) });
            }
            closed.push((span, x));
        }
        let ratio = found.given_up.map_or(found.ratio.ok_or(on.centre()), Err);
        let ratio = ratio.map_err(|x| undecided(x, cost))?;
        // The ratio has no value in a gap that is too narrow to be told.
        let touching = closed.first().map(|&(_, x)| Extremum { x, value: T::zero() });
        let Extremum { x, value } = touching.unwrap_or(ratio);
        least = nearer(least, Some(Extremum { x, value: value / mean }));
    }
    least.ok_or_else(|| undecided(state.interval.left, cost))
}

/// Returns the load of one of several contacts, to about a thousandth: a pressure may be infinite
/// at kinks.
fn borne<T: Real>(pressures: Pressures<'_, T>, on: Interval<T>) -> Fallible<T, T> {
    let angle = |i: usize| T::pi() * (T::count(i) + T::of(0.5)) / T::count(SUMMED);
    let x: Vec<T> = (0..SUMMED).map(|i| on.at_angle(angle(i))).collect();
    let mut values = vec![T::zero(); SUMMED];
    pressures(&x, &mut values)?;
    let finite = x.iter().zip(&values).filter(|(_, pressure)| pressure.is_finite());
    let sum = finite.fold(T::zero(), |sum, (&x, &p)| sum + p * on.chebyshev_weight(x));
    Ok(T::pi() * sum / T::count(SUMMED))
}

/// Returns the ends up to which bodies are followed: a million half-widths where they have no end.
fn followed<T: Real>(ends: Ends<T>, on: Interval<T>) -> Ends<T> {
    let reach = T::of(1e6) * on.half_width();
    let finite = |end: T, instead: T| if end.is_finite() { end } else { instead };
    Ends { left: finite(ends.left, on.left - reach), right: finite(ends.right, on.right + reach) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Panels;
    use crate::gap::Shape;
    use crate::profile::{Curve, CurvePoint, Flat};
    use crate::quadrature::Engine;
    use crate::search::Newton as Inversion;
    use std::f64::consts::{FRAC_PI_2, PI};

    const LOAD: f64 = 1.0;

    fn state(interval: Interval<f64>, strengths: Ends<f64>, ends: Ends<f64>) -> ContactState<f64> {
        ContactState {
            interval,
            load: LOAD,
            strengths,
            free: Ends::both(true),
            adhesive: Ends::both(false),
            error: Some(1e-14),
            error_by_load: None,
            load_error: None,
            moment_derivatives: None,
            tilt: 0.0,
            ends,
            apart: None,
        }
    }

    /// A slope that is off by a millionth in the solve is off from the curves sampled anew.
    #[test]
    fn a_panel_that_is_falsified_is_not_certified() {
        let body =
            Curve::new([-1.0, 1.0], |k: f64| CurvePoint { x: k, y: 0.5 * k * k, dx: 1.0, dy: k });
        let inversion = Inversion::default();
        let gap = Gap::new(Shape::Lent(&Flat), Shape::Lent(&body), &inversion).unwrap();
        // F = κ L²/2 by R = 1.
        let (l, kappa) = (0.3, LOAD / 0.045);
        let on = Interval { left: -l, right: l };
        let found = state(on, Ends::both(0.0), Ends::from(gap.range()));
        for off in [0.0, 1e-6, -1e-6] {
            let mut solver = Engine::new(&Panels::FULL).unwrap();
            solver.moments(&gap, on).unwrap();
            for panel in &mut solver.panels_mut().unwrap().panel_set.panels {
                panel.series.iter_mut().for_each(|a| *a *= 1.0 + off);
            }
            let solved = Solved { gap: &gap, integrator: &solver, kappa, found: &found };
            let is_accused = matches!(
                certify(solved),
                Err(ContactError::Solve(SolveError::FeatureMissed { .. }))
            );
            assert_eq!(is_accused, off != 0.0, "{off}: {:?}", certify(solved));
        }
    }

    /// Certifies the solution for two contacts of `x⁴ - 2x²` less `height` times
    /// `exp(-((x - at)/width)²)`.
    fn certified([height, at, width]: [f64; 3]) -> Result<Certificate<f64>, ContactError<f64>> {
        let body = Curve::new([-2.5, 2.5], move |k: f64| {
            let s = (k - at) / width;
            let bump = height * (-s * s).exp();
            let (y, dy) = (k.powi(4) - 2.0 * k * k - bump, 4.0 * k.powi(3) - 4.0 * k);
            CurvePoint { x: k, y, dx: 1.0, dy: dy + 2.0 * s / width * bump }
        });
        let inversion = Inversion::default();
        let gap = Gap::new(Shape::Lent(&Flat), Shape::Lent(&body), &inversion)?;
        let (kappa, ends, corners) = (FRAC_PI_2, Ends::from(gap.range()), Ends::both(false));
        let mut solver = Engine::new(&Panels::FULL)?;
        let several = solver.panels_mut().unwrap().several_mut();
        let (mut system, mut steps) = (System::new(), Vec::new());
        let d = (LOAD / PI).sqrt();
        let [from, to] = [(1.0 - d).sqrt(), (1.0 + d).sqrt()];
        let mut limits = [-to, -from, from, to];
        for _ in 0..30 {
            let [one, two, three, four] = limits;
            let on = [Interval { left: one, right: two }, Interval { left: three, right: four }];
            several.set(&gap, &on, &[corners; 2], ends, false)?;
            several.system(LOAD / kappa, &mut system);
            assert!(system.factor());
            system.step(&mut steps);
            for (limit, step) in limits.iter_mut().zip(&steps) {
                *limit -= step.clamp(-0.02, 0.02);
            }
        }
        assert!(steps.iter().all(|step| step.abs() < 1e-12), "{steps:?}");
        let interval = Interval { left: limits[0], right: limits[3] };
        let found = state(interval, Ends::both(0.0), ends);
        certify(Solved { gap: &gap, integrator: &solver, kappa, found: &found })
    }

    /// A corner whose strength is unknown may pull.
    #[test]
    fn a_corner_of_unknown_strength_does_not_press() {
        let (interval, ends) = (Interval { left: -0.2, right: 0.2 }, Ends::both(0.2));
        let corners = Ends::both(true);
        for (strength, presses) in [(1.0, true), (0.0, true), (-1.0, false), (f64::NAN, false)] {
            let strengths = Ends { left: 1.0, right: strength };
            let found = state(interval, strengths, ends);
            assert_eq!(presses_at(&found, corners).is_ok(), presses, "{strength}");
        }
    }

    /// A load that is unknown, or bears nothing, leaves no fall of the slope unlooked at.
    #[test]
    fn beside_an_unknown_load_every_fall_counts() {
        let on = Interval { left: -0.2, right: 0.2 };
        let found = |load| ContactState { load, ..state(on, Ends::both(0.0), Ends::both(0.2)) };
        assert!(found(1.0).negligible_fall(1.0, 0.1) > 0.0);
        for load in [f64::NAN, 0.0, -1.0] {
            let allows = found(load).negligible_fall(1.0, 0.1) > 0.0;
            assert!(!allows, "{load}");
        }
    }

    /// Tests solutions of the equations that are not contacts of the bodies.
    #[test]
    fn what_is_no_contact() {
        certified([0.0, 0.0, 1.0]).unwrap();
        certified([-1e-3, 1.0, 0.1]).unwrap();
        let error = certified([-0.3, 1.0, 0.1]).unwrap_err();
        assert!(
            matches!(error, ContactError::Solve(SolveError::Tension { x, pressure, .. })
                if (x - 1.0).abs() < 0.02 && pressure < 0.0),
            "{error}"
        );
        let near = certified([0.3, 0.1, 0.1]).unwrap().gap.unwrap();
        assert!((near.x - 0.1).abs() < 0.02 && near.value > 0.0, "{near:?}");
        let error = certified([0.6, 0.1, 0.1]).unwrap_err();
        assert!(
            matches!(error, ContactError::Solve(SolveError::Overlap { x, gap, .. })
                if (x - 0.1).abs() < 0.02 && gap < 0.0),
            "{error}"
        );
    }
}
