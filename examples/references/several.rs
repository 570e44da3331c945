//! Contacts in several places.

use linecontact::profile::Piece;
use linecontact::{Interval, ParametricProfile, Solution};

/// Whether the solver finds several contacts. Until it does, the files that need that are looked at only
/// where they are asked for, and an error passes where one interval is not enough.
pub const SOLVED: bool = false;

/// The contacts of a solution, from left to right.
pub fn contacts(solution: &Solution<f64>) -> Vec<Interval<f64>> {
    vec![solution.hull()]
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
