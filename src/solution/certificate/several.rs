//! The certificate of several contacts.
//!
//! Each is compared with short cells, as one alone is. By those cells all limits must meet their conditions:
//! what is left of these is turned into steps of the limits. In each contact the pressure is bounded from
//! below; and from each limit the gap is followed to the end of the bodies, or half the way to the next
//! contact. There the pressure pulls with Φ/κ, which falls with x as P ≥ 0: where the bodies are steeper than
//! at the limit, the gap grows.

use super::inside::Inside;
use super::missed::{Solved, compare};
use super::outside::Outside;
use super::{Certificate, Extremum, SHARE, followed, lifts, nearer, steepest, undecided};
use crate::gap::{Cost, Gap};
use crate::numerics::LinearSystem;
use crate::quadrature::panels::{self, Several, System};
use crate::quadrature::{Integrator, LoadCase, Quadrature};
use crate::solution::{ContactState, SignoriniCheck};
use crate::{ContactError, Interval, Panels, Real, Side};

/// Points at which the pressure of a contact is summed up, at first and at most.
const POINTS: [usize; 2] = [32, 2048];

/// Looks at several contacts.
pub(super) fn certify<T: Real>(
    gap: &Gap<'_, T>,
    kappa: T,
    found: &ContactState<T>,
    solved: &Several<T>,
) -> Result<Certificate<T>, ContactError<T>> {
    let ContactState { interval: hull, load, free, ends, .. } = *found;
    let contacts = solved.contacts();
    let (last, range, share) = (contacts.len() - 1, gap.range(), found.nothing());
    let half = T::of(0.5);
    let corners = free.map(|free| !free);
    lifts(found, corners)?;
    let mut integrator = Panels::FULL.integrator()?;
    let Some(own) = panels::several_mut(&mut *integrator) else {
        return Err(undecided(hull.left, Cost::default()));
    };
    let (mut own_system, mut system) = (System::new(), System::new());
    own.set(gap, contacts, corners, ends)?;
    own.system(load / kappa, &mut own_system);
    own.press();
    let mut cost = own.cost();
    let ends = followed(ends, hull);
    let spacing = (ends.right - ends.left) * T::of(SHARE);
    let (mut cells, mut doubt) = (Vec::new(), T::zero());
    for (i, &on) in contacts.iter().enumerate() {
        let on = Interval { left: on.left.max(range[0]), right: on.right.min(range[1]) };
        own.panel_set(i).heights(gap, [on.left, on.centre(), on.right], &mut cost)?;
        let steep = steepest(&own.panel_set(i).panels, on);
        let assumed = Solved(solved.panel_set(i));
        let here = compare(gap, [own.panel_set(i), &assumed], on, spacing, steep)?;
        cost += here.cost;
        doubt = doubt.max(here.doubt);
        cells.push(here.panels);
    }
    let mut by_cells = Several::sampled(T::epsilon().sqrt(), gap.tilt(), cells.into_iter());
    by_cells.set(gap, contacts, corners, found.ends)?;
    by_cells.system(load / kappa, &mut system);
    cost += by_cells.cost();
    balanced(kappa, found, &by_cells, &system, doubt)?;

    let mut pressure: Option<Extremum<T>> = None;
    for (i, &on) in contacts.iter().enumerate() {
        let free = free.of_contact(i, last);
        let load_case = LoadCase { kappa, load, free };
        let mean = half * borne(&*integrator, gap, &load_case, on)?.abs() / on.half_width();
        let allowed = share * mean;
        let inside = Inside { integrator: &*integrator, gap, load_case, on, hull, allowed };
        let Extremum { x, value } = inside.least(&mut cost)?;
        pressure = nearer(pressure, Some(Extremum { x, value: value / mean }));
    }

    let check = SignoriniCheck::new(gap, &*integrator, kappa, found, &[]);
    let gap = Outside::look(check, ends, spacing, &mut cost)?;
    Ok(Certificate { pressure, gap, spacing, cost })
}

/// The load of one contact, to a thousandth or so: a pressure may be infinite at kinks.
fn borne<T: Real>(
    integrator: &dyn Integrator<T>,
    gap: &Gap<'_, T>,
    load_case: &LoadCase<T>,
    on: Interval<T>,
) -> Result<T, ContactError<T>> {
    let [mut points, most] = POINTS;
    let mut before: Option<T> = None;
    loop {
        let angle = |i: usize| T::pi() * (T::count(i) + T::of(0.5)) / T::count(points);
        let x: Vec<T> = (0..points).map(|i| on.at_angle(angle(i))).collect();
        let mut pressures = vec![T::zero(); points];
        integrator.pressures(gap, load_case, &x, &mut pressures, &mut Cost::default())?;
        let term = |sum, (&x, &pressure): (&T, &T)| {
            if pressure.is_finite() { sum + pressure * on.chebyshev_weight(x) } else { sum }
        };
        let sum = T::pi() * x.iter().zip(&pressures).fold(T::zero(), term) / T::count(points);
        let converged = |before: T| (sum - before).abs() <= T::of(1e-4) * sum.abs();
        if points >= most || before.is_some_and(converged) {
            return Ok(sum);
        }
        (before, points) = (Some(sum), 2 * points);
    }
}

/// Whether the limits are by the cells where they were found to be: the steps that their conditions still ask
/// for, as strengths at the limits, are within what the solver said and what the cells leave open.
fn balanced<T: Real>(
    kappa: T,
    found: &ContactState<T>,
    cells: &Several<T>,
    system: &System<T>,
    doubt: T,
) -> Result<(), ContactError<T>> {
    let n = system.residual.len();
    let mut linear = LinearSystem::new();
    let (mut steps, mut open) = (Vec::new(), vec![T::zero(); n]);
    if linear.factor(&system.jacobian, n) {
        let mut unit = vec![T::zero(); n];
        for (k, &error) in system.open.iter().enumerate() {
            unit.fill(T::zero());
            unit[k] = error;
            linear.solve(&unit, &mut steps);
            open.iter_mut().zip(&steps).for_each(|(open, step)| *open += step.abs());
        }
        linear.solve(&system.residual, &mut steps);
    } else {
        // No strength meets this.
        steps.resize(n, T::one() / T::zero());
    }
    let contacts = cells.contacts();
    let limits = (0..contacts.len()).flat_map(|i| Side::BOTH.map(|side| (i, side)));
    let is_free = |&(i, side): &(usize, Side)| found.free.of_contact(i, contacts.len() - 1)[side];
    let mut fault = Ok(());
    for (((i, side), step), open) in limits.filter(is_free).zip(steps).zip(open) {
        let on = contacts[i];
        let x = on[side];
        let rounding = T::of(64.0) * T::epsilon() * (x.abs() + on.half_width());
        let said = T::of(10.0) * found.error.unwrap_or(T::zero()) * on.half_width();
        let by_limit = kappa * cells.strength_by_limit(system, i, side);
        let strength = by_limit * step.abs();
        // An estimate may be off by as much; a tolerance is kept.
        let allowed = by_limit * (said + T::of(16.0) * open + rounding) + kappa * doubt;
        let met = strength <= allowed;
        // Of those at fault it is the rightmost that is named, as of two.
        if !met {
            fault = Err(ContactError::Unbalanced { x, strength, allowed });
        }
    }
    fault
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Ends;
    use crate::gap::Shape;
    use crate::profile::{Curve, CurvePoint, Flat};
    use crate::search::Newton as Inversion;
    use std::f64::consts::{FRAC_PI_2, PI};

    const LOAD: f64 = 1.0;

    /// What the conditions of two contacts make of `x⁴ - 2x²` less so many times `exp(-((x - at)/width)²)`.
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
        let mut several = Several::new(16.0 * f64::EPSILON);
        let (mut system, mut linear, mut steps) = (System::new(), LinearSystem::new(), Vec::new());
        let d = (LOAD / PI).sqrt();
        let [from, to] = [(1.0 - d).sqrt(), (1.0 + d).sqrt()];
        let mut limits = [-to, -from, from, to];
        for _ in 0..30 {
            let [one, two, three, four] = limits;
            let on = [Interval { left: one, right: two }, Interval { left: three, right: four }];
            several.set(&gap, &on, corners, ends)?;
            several.system(LOAD / kappa, &mut system);
            assert!(linear.factor(&system.jacobian, 4));
            linear.solve(&system.residual, &mut steps);
            for (limit, step) in limits.iter_mut().zip(&steps) {
                *limit -= step.clamp(-0.02, 0.02);
            }
        }
        assert!(steps.iter().all(|step| step.abs() < 1e-12), "{steps:?}");
        let found = ContactState {
            interval: Interval { left: limits[0], right: limits[3] },
            load: LOAD,
            strengths: Ends::both(0.0),
            free: Ends::both(true),
            adhesive: Ends::both(false),
            error: Some(1e-14),
            error_by_load: None,
            force: None,
            trend: None,
            tilt: 0.0,
            ends,
        };
        certify(&gap, kappa, &found, &several)
    }

    /// Solutions of the equations that the bodies do not have.
    #[test]
    fn what_is_no_contact() {
        certified([0.0, 0.0, 1.0]).unwrap();
        certified([-1e-3, 1.0, 0.1]).unwrap();
        let error = certified([-0.3, 1.0, 0.1]).unwrap_err();
        assert!(
            matches!(error, ContactError::Tension { x, pressure, .. }
                if (x - 1.0).abs() < 0.02 && pressure < 0.0),
            "{error}"
        );
        let near = certified([0.3, 0.1, 0.1]).unwrap().gap.unwrap();
        assert!((near.x - 0.1).abs() < 0.02 && near.value > 0.0, "{near:?}");
        let error = certified([0.6, 0.1, 0.1]).unwrap_err();
        assert!(
            matches!(error, ContactError::Overlap { x, gap, .. }
                if (x - 0.1).abs() < 0.02 && gap < 0.0),
            "{error}"
        );
    }
}
