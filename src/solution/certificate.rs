//! Whether a solution of the equations is a contact: no tension inside, no overlap outside.
//!
//! All of the gap is sampled. The contact comes first, as panels of the slope, and once more in short
//! cells to see whether the panels, or those of the solver, have missed anything, and whether its
//! limits balance the bodies. The sign of the pressure is that of pieces: bounds on a Chebyshev series
//! by its coefficients, on shorter and shorter pieces until they leave no doubt. The outside is
//! [checked](outside) as in a solve, on a survey of its own with points in each cell. A gap whose slope
//! rises over the contact, and is larger yet beyond, is seen to be one from its slopes alone.
//!
//! Several contacts at once are looked at [one after the other](several), and the gaps between them.

mod inside;
mod missed;
mod outside;
mod series_bounds;
mod several;

use super::{ContactState, SignoriniCheck};
use crate::gap::{Cost, Gap};
use crate::quadrature::panels::{self, Panel, PanelSet};
use crate::quadrature::{Integrator, LoadCase, Quadrature};
use crate::{ContactError, Ends, Interval, Panels, Real, Side};
use inside::Inside;
use missed::Cells;
use outside::Outside;
use series_bounds::{above, below};

/// Evaluations, and samples, after which the certificate is given up.
const MOST_EVALUATIONS: usize = 1 << 20;

/// The share of the bodies' range that a cell may be long, and have no fewer than eight nodes.
const SHARE: f64 = 1.0 / 4096.0;

/// A proof that a solution is a contact.
///
/// What is proved: `P ≥ 0` in the whole contact and a gap `≥ 0` from its edges to the ends of the
/// bodies, or to the next of several contacts, up to rounding, and to what the curves do between the
/// points at which they are evaluated. No two neighbouring ones are further apart than a quarter of
/// `spacing`; they are closer near the edges and at breakpoints, in the contact wherever the slope of
/// the gap is not a polynomial of low degree, and outside wherever heights and slopes leave open
/// whether the loaded bodies overlap.
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
    /// Where the pressure is nearest to zero beside that of a smooth body: the least ratio of `P` to
    /// the mean pressure times `sqrt((x + b)(a - x))/L`, 4/π for a parabola, of several contacts each by its
    /// own limits and load; with the reciprocal of the root of a distance at an edge that is not free. `None` where the slope of the
    /// gap rises throughout the one contact, which says that `P > 0`, and between adhesive edges.
    pub pressure: Option<Extremum<T>>,
    /// The least gap at a place outside where the bodies approach each other again, a length, negative
    /// by no more than rounding; `None` where the gap grows on both sides up to the ends, and between two
    /// contacts has but one largest value.
    pub gap: Option<Extremum<T>>,
    /// A length: what is a quarter as wide, or more, cannot have passed unseen.
    pub spacing: T,
    /// What it has cost; all points outside the contacts count as heights.
    pub cost: Cost,
}

/// A place and a value there.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Extremum<T> {
    /// Where.
    pub x: T,
    /// The value.
    pub value: T,
}

fn undecided<T: Real>(x: T, Cost { evaluations, samples, .. }: Cost) -> ContactError<T> {
    ContactError::Undecided { x, evaluations, samples }
}

/// Looks at a contact, whatever quadrature it was found with.
pub(crate) fn certify<T: Real>(
    gap: &Gap<'_, T>,
    kappa: T,
    found: &ContactState<T>,
    solver: &dyn Integrator<T>,
) -> Result<Certificate<T>, ContactError<T>> {
    if let Some(solved) = panels::several(solver).filter(|several| several.contacts().len() > 1) {
        return several::certify(gap, kappa, found, solved);
    }
    let ContactState { interval: on, free, adhesive, ends, .. } = *found;
    let share = found.nothing();
    let mean = T::of(0.5) * found.load.abs() / on.half_width();

    let mut panel_set = PanelSet::new(T::epsilon().sqrt() * T::epsilon().sqrt().sqrt());
    let range = gap.range();
    let sampled = Interval { left: on.left.max(range[0]), right: on.right.min(range[1]) };
    panel_set.look_at_ends(gap, sampled);
    panel_set.extend(gap, sampled)?;
    let steepest = steepest(&panel_set.panels, on);

    // Of an edge where Eq. (6) has left a strength no more is known than at a free one.
    let at_end = Ends { left: on.left <= ends.left, right: on.right >= ends.right };
    let at_corner = Ends::from_fn(|side| !free[side] && !adhesive[side] && at_end[side]);
    lifts(found, at_corner)?;
    let ends = followed(ends, on);
    let spacing = (ends.right - ends.left) * T::of(SHARE);
    let mut more = Cost::default();
    panel_set.heights(gap, [sampled.left, sampled.centre(), sampled.right], &mut more)?;
    let cells = missed::compare(gap, [&panel_set, &solver], sampled, spacing, steepest)?;
    more += cells.cost;
    balanced(kappa, found, &cells)?;
    let mut integrator = Panels::FULL.integrator()?;
    integrator.prepare(gap, on)?;
    more += integrator.cost();
    let integrator = &*integrator;
    let pressure =
        if adhesive != Ends::both(false) || rises(&panel_set.panels, on, share * steepest) {
            None
        } else {
            let load_case = LoadCase { kappa, load: found.load, free };
            let (hull, allowed) = (on, share * mean);
            let inside = Inside { integrator, gap, load_case, on, hull, allowed };
            let Extremum { x, value } = inside.least(&mut more)?;
            Some(Extremum { x, value: value / mean })
        };
    let check = SignoriniCheck::new(gap, integrator, kappa, found, &[]);
    let gap = Outside::look(check, ends, spacing, &mut more)?;
    Ok(Certificate { pressure, gap, spacing, cost: panel_set.cost + more })
}

/// Refuses a corner that pulls.
fn lifts<T: Real>(found: &ContactState<T>, corners: Ends<bool>) -> Result<(), ContactError<T>> {
    let ContactState { interval, load, strengths, .. } = *found;
    // With adhesion there may be no load.
    let mean = T::of(0.5) * load.abs() / interval.half_width();
    let pressed = strengths.into_iter().fold(mean, |most, strength| most.max(strength.abs()));
    // Where both edges are at fault it is the right one that is named.
    for side in [Side::Right, Side::Left] {
        if corners[side] && strengths[side] < -found.nothing() * pressed {
            let (x, pressure) = (interval[side], -T::one() / T::zero());
            return Err(ContactError::Tension { x, pressure, interval, load });
        }
    }
    Ok(())
}

/// Returns the largest |slope| in a contact.
fn steepest<T: Real>(panels: &[Panel<T>], on: Interval<T>) -> T {
    panels.iter().fold(T::zero(), |most, panel| {
        let [left, right] = [panel.x[0].max(on.left), panel.x[1].min(on.right)];
        if left < right {
            let (series, n) = panel.over(Interval { left, right });
            most.max(above(&series[..n])).max(-below(&series[..n]))
        } else {
            most
        }
    })
}

/// How far bodies are followed: without an end, which are given by x itself, for a million half-widths.
fn followed<T: Real>(ends: Ends<T>, on: Interval<T>) -> Ends<T> {
    let reach = T::of(1e6) * on.half_width();
    let finite = |end: T, instead: T| if end.is_finite() { end } else { instead };
    Ends { left: finite(ends.left, on.left - reach), right: finite(ends.right, on.right + reach) }
}

/// The lower one.
fn nearer<T: Real>(one: Option<Extremum<T>>, other: Option<Extremum<T>>) -> Option<Extremum<T>> {
    match (one, other) {
        (Some(one), Some(other)) => Some(if one.value < other.value { one } else { other }),
        (one, other) => one.or(other),
    }
}

/// Whether free edges are as free by the cells as the limits were found to be.
fn balanced<T: Real>(
    kappa: T,
    found: &ContactState<T>,
    cells: &Cells<T>,
) -> Result<(), ContactError<T>> {
    let ContactState { interval: on, load, free, .. } = *found;
    let (stiffness, m) = (kappa * on.half_width(), cells.moments(on));
    let size = load.abs().max(stiffness * m.l1_norm);
    let error = found.error.unwrap_or(T::zero());
    let said = found.force.unwrap_or(T::of(3.0) * size * error);
    let rounding = T::of(64.0) * T::epsilon() * size;
    let rounding = rounding * (T::one() + on.left.abs().max(on.right.abs()) / on.half_width());
    // An estimate may be off by as much; a tolerance is kept.
    let open = T::of(16.0) * m.error + cells.doubt;
    let allowed = T::of(10.0) * said + stiffness * open + rounding;
    let by_force = T::frac_1_pi() / on.half_width();
    // Where both are at fault it is the right one that is named.
    for (x, sign, free) in [(on.right, T::one(), free.right), (on.left, -T::one(), free.left)] {
        let missed = load - stiffness * (m.m1 + sign * m.m0);
        let met = missed.abs() <= allowed;
        if free && !met {
            let [strength, allowed] = [missed, allowed].map(|force| force * by_force);
            return Err(ContactError::Unbalanced { x, strength, allowed });
        }
    }
    Ok(())
}

/// Whether the slope of the gap rises over the contact, up to rounding and errors that do not matter.
fn rises<T: Real>(panels: &[Panel<T>], on: Interval<T>, allowed: T) -> bool {
    let mut before: Option<[T; 2]> = None;
    for panel in panels {
        let part = Interval { left: panel.x[0].max(on.left), right: panel.x[1].min(on.right) };
        let (series, n) = panel.over(part);
        let size = series[..n].iter().fold(T::zero(), |sum, a| sum + a.abs());
        let error = panel.tail + T::of(16.0) * T::epsilon() * size;
        let jumps_down =
            |[value, doubt]: [T; 2]| panel.value(part.left) - value < -T::of(4.0) * (error + doubt);
        if error > allowed || before.is_some_and(jumps_down) {
            return false;
        }
        if !series_bounds::rises(&series[..n], error) {
            return false;
        }
        before = Some([panel.value(part.right), error]);
    }
    true
}
