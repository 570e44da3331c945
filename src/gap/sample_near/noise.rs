//! The noise of a curve: what the rounding of its formula leaves of it.

use crate::gap::Cost;
use crate::profile::Piece;
use crate::{CurvePoint, Real};

/// Points by which the noise is measured.
const POINTS: usize = 12;

/// How far values of `X` and `Y` may be off, by about three standard deviations: lengths.
#[derive(Clone, Copy)]
pub(crate) struct Noise<T> {
    pub x: T,
    pub y: T,
}

impl<T: Real> Noise<T> {
    /// Measures the noise near a parameter of a piece, as the median of divided third differences. Of what is
    /// smooth they are nothing over so short a way, and an undeclared kink is in three of them.
    pub fn near(piece: &Piece<'_, T>, k: T, cost: &mut Cost) -> Self {
        let [from, to] = [piece.k[0].min(piece.k[1]), piece.k[0].max(piece.k[1])];
        // A second difference over this is less than rounding, too.
        let width = T::epsilon().sqrt() * (to - from);
        let start = (k - T::of(0.5) * width).min(to - width).max(from);
        // Unevenly, as multiples of one step may all be rounded alike.
        let share = |i: usize| T::count(i) * T::count(i).sqrt();
        let places: [T; POINTS] =
            std::array::from_fn(|i| start + width * (share(i) / share(POINTS)));
        let zero = T::zero();
        let mut points = [CurvePoint { x: zero, y: zero, dx: zero, dy: zero }; POINTS];
        piece.curve.at_many(&places, &mut points);
        cost.evaluations += POINTS;
        let size = |of: fn(&CurvePoint<T>) -> T| {
            let mut sizes: [T; POINTS - 3] = std::array::from_fn(|first| {
                let (mut sum, mut weights) = (zero, zero);
                for i in first..first + 4 {
                    let others = (first..first + 4).filter(|&j| j != i);
                    let product = others.fold(T::one(), |all, j| all * (share(i) - share(j)));
                    sum += (of(&points[i]) - of(&points[first])).component(0) / product;
                    weights += product.abs().recip();
                }
                // As of even steps, whose weights are 1, 3, 3 and 1.
                T::of(8.0) * (sum / weights).abs()
            });
            sizes.sort_by(|one, other| one.partial_cmp(other).unwrap_or(std::cmp::Ordering::Equal));
            let median = sizes[sizes.len() / 2];
            if median.is_finite() { median } else { zero }
        };
        Self { x: size(|point| point.x), y: size(|point| point.y) }
    }
}
