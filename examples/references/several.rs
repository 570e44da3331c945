//! Contacts in several places.

use linecontact::profile::Piece;
use linecontact::{Interval, ParametricProfile, Solution};

/// The contacts of a solution, from left to right.
pub fn contacts(solution: &Solution<f64>) -> Vec<Interval<f64>> {
    solution.intervals().to_vec()
}

/// Where a body begins and ends; NaN if it has no ends.
pub fn range(body: &dyn ParametricProfile<f64>) -> [f64; 2] {
    let ends = |piece: Piece<f64>| piece.x();
    let [left, right] = match body.pieces() {
        0 => [0, 1].map(|_| Piece::new(body).ok()),
        count => [0, count - 1].map(|i| body.piece(i)),
    };
    [left.map_or(f64::NAN, |piece| ends(piece)[0]), right.map_or(f64::NAN, |piece| ends(piece)[1])]
}
