//! The ends of bodies: corners, and the range of the boundary elements.

use linecontact::ParametricProfile;
use linecontact::profile::Piece;

/// Returns the two ends of a body; NaN if it has none.
pub fn of(body: &dyn ParametricProfile<f64>) -> [f64; 2] {
    let ends = |piece: Piece<f64>| piece.x();
    let [left, right] = match body.pieces() {
        0 => [0, 1].map(|_| Piece::new(body).ok()),
        count => [0, count - 1].map(|i| body.piece(i)),
    };
    [left.map_or(f64::NAN, |piece| ends(piece)[0]), right.map_or(f64::NAN, |piece| ends(piece)[1])]
}
