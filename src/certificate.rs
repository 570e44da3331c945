//! Whether a solution of the equations is a contact: no tension inside, no overlap outside.
//!
//! Outside the contact the gap opens with the slope
//!
//! ```text
//! g(x) - W(x)/κ,      W(x) = ∫ P(s)/(x - s) ds
//! ```
//!
//! which is integrated outward from either edge. Both conditions are looked at on a grid, fine
//! next to the edges: what is narrower than a five-hundredth of the way from an edge to the end of
//! the bodies can pass unseen.

use crate::gap::{Gap, Sampler};
use crate::quadrature::{Engine, Pressing};
use crate::{ContactError, Interval, Real};

/// Points inside, and on each side outside.
const POINTS: usize = 512;

/// Looks at a contact that the engine has prepared; at its pressure only where there must be no
/// tension.
pub(crate) fn certify<T: Real>(
    engine: &dyn Engine<T>,
    gap: &Gap<'_, T>,
    pressing: &Pressing<T>,
    on: Interval<T>,
    tension: bool,
) -> Result<(), ContactError<T>> {
    let inside = Inside::new(engine, gap, pressing, on)?;
    let largest = inside.pressure.iter().fold(T::zero(), |max, p| max.max(p.abs()));
    let allowed = T::epsilon().sqrt() * largest;
    for (&x, &pressure) in inside.x.iter().zip(&inside.pressure) {
        if pressure < -allowed && !tension {
            return Err(ContactError::Tension { x, pressure });
        }
    }
    for x in gap.telling_joints(on, -T::one(), POINTS) {
        let mut pressure = [T::zero()];
        engine.pressures(gap, pressing, &[x], &mut pressure, &mut Default::default())?;
        if pressure[0] < -allowed && !tension {
            return Err(ContactError::Tension { x, pressure: pressure[0] });
        }
    }
    let [left, right] = gap.range();
    inside.outward(gap, pressing.kappa, on.right, right)?;
    inside.outward(gap, pressing.kappa, on.left, left)
}

/// The pressure at equal angles.
struct Inside<T> {
    on: Interval<T>,
    x: [T; POINTS],
    pressure: [T; POINTS],
}

impl<T: Real> Inside<T> {
    fn new(
        engine: &dyn Engine<T>,
        gap: &Gap<'_, T>,
        pressing: &Pressing<T>,
        on: Interval<T>,
    ) -> Result<Self, ContactError<T>> {
        let step = T::pi() / T::count(POINTS);
        let x = std::array::from_fn(|i| on.at_angle(step * (T::count(i) + T::of(0.5))));
        let mut pressure = [T::zero(); POINTS];
        engine.pressures(gap, pressing, &x, &mut pressure, &mut Default::default())?;
        Ok(Self { on, x, pressure })
    }

    /// `W(x)`, by the midpoint rule in the angle, which is exact but for the distance from the
    /// edge.
    fn pull(&self, x: T) -> T {
        let mut sum = T::zero();
        for (&s, &pressure) in self.x.iter().zip(&self.pressure) {
            sum += pressure * self.on.edge_root(s) / (x - s);
        }
        sum * T::pi() / T::count(POINTS)
    }

    /// Integrates the slope of the gap from an edge to an end of the bodies.
    fn outward(&self, gap: &Gap<'_, T>, kappa: T, edge: T, end: T) -> Result<(), ContactError<T>> {
        let mut sampler = Sampler::default();
        let half = T::of(0.5);
        let mut height = T::zero();
        // Next to the edge the slope of the gap is the difference of two that are the same.
        let (mut last, mut largest): (Option<T>, _) = (None, T::zero());
        let mut before = edge;
        for i in 2..POINTS {
            let share = T::count(i) / T::count(POINTS);
            let x = edge + (end - edge) * share * share;
            if (x - edge).abs() < T::of(1e-3) * self.on.half_width() || x == before {
                continue;
            }
            let bodies = sampler.slope(gap, x)?;
            let slope = bodies - self.pull(x) / kappa;
            largest = largest.max(bodies.abs());
            height += half * (x - before) * (slope + last.unwrap_or(T::zero()));
            if height < T::of(-1e-5) * largest * self.on.half_width() {
                return Err(ContactError::Overlap { x, gap: height });
            }
            (last, before) = (Some(slope), x);
        }
        Ok(())
    }
}
