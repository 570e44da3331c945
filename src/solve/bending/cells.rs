//! Start from cells with the whole kernel.
//!
//! On a thin layer, or on a base far softer than its coating, the contact of half-planes is no
//! start. There an active set finds the contacts, to a part of the thickness; Eq. (1) on them, with
//! singular edges, has pressures whose bend fits them. From there on the limits are moved as by
//! Newton's method for the whole equation.

use super::{Bending, THINNEST, check_width, ends};
use crate::gap::Sampler;
use crate::kernel::{Given, Kept, at_least, pressed};
use crate::solve::active_set::{Coarse, FIRST_CELLS, LENGTH, NotFound, Scene, active_set};
use crate::solve::capacity::Capacity;
use crate::{ContactError, Control, Edge, Ends, Fallible, Interval, Real, Side};

/// Factor by which cells may be wrong in a contact that is too wide.
const DOUBT: f64 = 1.01;

/// Factor by which an estimate may be wrong, and the number of estimates, each with half of the
/// logarithm of the error of the last or less.
const SURELY: f64 = 1.25;
const ESTIMATES: usize = 12;

/// Load and the place where it acts, if the bodies turn.
type Load<T> = (T, Option<T>);

impl<T: Real> Bending<'_, '_, '_, T> {
    /// Begins with the contacts of cells. Tells whether there are any: a load must be given.
    pub(super) fn begin_with_cells(&mut self) -> Fallible<T, bool> {
        let Some((load, at)) = line_of_load(self.control) else { return Ok(false) };
        let Some(coarse) = self.coarse((load, at))? else { return Ok(false) };
        let reaches = self.end_reached(&coarse);
        // A period has no ends.
        if reaches.is_some() && self.kernel.row.is_some() {
            return Ok(false);
        }
        self.reaches = reaches;
        check_width(&self.kernel, coarse.hull().half_width(), DOUBT)?;
        let (kappa, gap, contacts) = (self.contact.kappa, &self.gap, &coarse.intervals);
        let kept = if at.is_some() { Kept::Moment(kappa) } else { Kept::Load };
        let loads = [Some(load), at.map(|at| load * at)];
        let loads: Vec<T> = loads.into_iter().flatten().collect();
        let [mut slopes, mut heights] = [Sampler::default(), Sampler::default()];
        let given = Given {
            slope: |x| slopes.slope(gap, x).map(|slope| kappa * slope),
            height: |x| heights.height(gap, x).map(|height| kappa * height),
        };
        let pressed = pressed(&self.kernel, contacts, kept, &loads, given);
        self.work.cost.evaluations += slopes.cost.evaluations;
        self.work.cost.heights += heights.cost.evaluations;
        let Some(spreads) = pressed? else { return Ok(false) };
        self.work.workspace.keep(contacts);
        // Waves may be shorter than a cell.
        self.is_checked = true;
        self.restart(spreads);
        self.cut(false)?;
        Ok(true)
    }

    /// Returns the end of the bodies that contacts reach with no corner to hold them.
    fn end_reached(&self, coarse: &Coarse<T>) -> Option<Side> {
        let edges = self.contact.edges;
        Side::BOTH.into_iter().find(|&side| coarse.reaches[side] && edges[side] == Edge::Free)
    }

    /// Returns the error for contacts that reach an end. What the bodies bear in others is not
    /// known: cells tell it to a tenth.
    pub(super) fn too_short(&self, end: T) -> ContactError<T> {
        let [load, half_width, peak] = [T::of(f64::NAN); 3];
        let unknown = Capacity { half_width, end, load, peak };
        line_of_load(self.control).map_or_else(|| self.stuck(), |of| unknown.too_short(of.0))
    }

    /// Estimates the contact: that on half-planes as soft as the surfaces are to waves of its
    /// width. Springs have such a wave in 1.33 of the width, incompressible layers in 0.96.
    fn estimated(&mut self) -> Fallible<T, Option<Interval<T>>> {
        let Some(distance) = self.kernel.layer_distance() else { return Ok(None) };
        let mut scene = self.contact.clone();
        (scene.gap, scene.is_trial) = (self.gap.clone(), true);
        let (mut half_width, mut on) = (T::of(0.5 * THINNEST) * distance, None);
        for _ in 0..ESTIMATES {
            scene.kappa = self.contact.kappa / self.kernel.compliance(T::pi() / half_width);
            match self.found_on(&scene) {
                Ok(found) => on = Some(found.interval),
                Err(error) if ends(&error) => return Err(error),
                Err(_) => return Ok(None),
            }
            // The width grows with the compliance and its root, or falls with up to its cube.
            half_width = (half_width * on.map_or(half_width, |on| on.half_width())).sqrt();
        }
        Ok(on)
    }

    /// Returns the contacts of cells: of those around the contact as estimated, and of all if they
    /// do not suffice. Fails if the estimate is surely too wide.
    fn coarse(&mut self, load: Load<T>) -> Fallible<T, Option<Coarse<T>>> {
        let Ends { left, right } = self.contact.ends_of(&self.gap);
        if let Some(on) = self.estimated()? {
            let room = on.half_width();
            check_width(&self.kernel, room, SURELY)?;
            let around = [(on.left - room).max(left), (on.right + room).min(right)];
            let coarse = self.coarse_within(load, around)?;
            if let Some(coarse) = coarse.filter(|coarse| coarse.reaches == Ends::both(false)) {
                return Ok(Some(coarse));
            }
        }
        self.coarse_within(load, [left, right])
    }

    /// Returns the contacts of cells of a part of the bodies.
    fn coarse_within(
        &mut self,
        (load, at): Load<T>,
        range: [T; 2],
    ) -> Fallible<T, Option<Coarse<T>>> {
        let (kernel, gap, kappa) = (&self.kernel, &self.gap, self.contact.kappa);
        // Cut in three again and again, the cells have the width that resolves the kernel.
        let mut count = (range[1] - range[0]) / (T::of(LENGTH) * kernel.distance());
        while count > T::count(3 * FIRST_CELLS) && count.is_finite() {
            count /= T::of(3.0);
        }
        let cells = at_least(count.component(0)).max(FIRST_CELLS);
        let (known, start, kernel, mut work) = (&[][..], &[][..], Some(kernel), 0);
        let (cost, [left, right]) = (*self.work.cost, range);
        let watch = &|| gap.check_watch(cost, Interval { left, right });
        let scene = Scene { kappa, load, at, range, cells, known, start, kernel, watch };
        let mut heights = Sampler::default();
        let mut height = |x: T| heights.height(gap, gap.nearest(x));
        let found = active_set(&scene, &mut work, &mut height);
        self.work.cost.heights += heights.cost.evaluations;
        match found {
            Ok(coarse) if !coarse.intervals.is_empty() => Ok(Some(coarse)),
            Err(NotFound::Height(error)) => Err(error),
            _ => Ok(None),
        }
    }
}

/// Returns the load of a control that gives one.
pub(super) fn load<T: Real>(control: Control<T>) -> Option<T> {
    line_of_load(control).map(|(load, _)| load)
}

/// Returns the load of a control, and the place where it acts if the bodies turn.
pub(super) fn line_of_load<T: Real>(control: Control<T>) -> Option<Load<T>> {
    match control {
        Control::Load(load) => Some((load, None)),
        Control::Moment { load, moment, about } => Some((load, Some(about + moment / load))),
        Control::CentreOfPressure { load, at } => Some((load, Some(at))),
        _ => None,
    }
}
