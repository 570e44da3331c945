//! Regions next to contacts, and what is known of the gap there.

use crate::{Interval, Real};

/// Region between two contacts, or beyond the outermost ones.
#[derive(Clone, Copy)]
pub(super) struct Beside<T> {
    /// Number of the contact on its right.
    pub next: usize,
    pub room: Interval<T>,
    /// Limit from which heights are counted.
    pub edge: T,
    /// Distances from the left and the right limit within which the gap opens by the pressure
    /// inside.
    pub near: [T; 2],
    /// Distances from both within which nothing is known.
    pub blind: [T; 2],
    /// If a hollow corner is that near: the distance from the limit within which the pressure
    /// inside decides without one, and the slope of the gap at the limit.
    pub hollow: [Option<[T; 2]>; 2],
    /// Height of the gap at this limit, its uncertainty, and the potential there.
    pub height: T,
    pub hidden: T,
    pub taken: T,
    /// Uncertainty of the potentials in the region, as a height: a bound, and the part by contacts
    /// with corners, by which the potentials are indeed off.
    pub doubt: T,
    pub at_corners: T,
}

impl<T: Real> Beside<T> {
    /// Returns the part of a span that lies in the region.
    pub fn within(&self, [left, right]: [T; 2]) -> [T; 2] {
        [left.max(self.room.left), right.min(self.room.right)]
    }

    /// Tells whether part of a span in the region is next to a hollow corner at a limit.
    pub fn is_beside_hollow(&self, span: [T; 2]) -> bool {
        span.iter().any(|&x| self.rate_at_limit(x).is_some())
    }

    /// Tells whether a place is closer to a corner that holds a limit than the limit is known.
    pub fn is_blind(&self, x: T) -> bool {
        x - self.room.left < self.blind[0] || self.room.right - x < self.blind[1]
    }

    /// Returns the slope of the displacement at the limit next to a place, if a hollow corner lies
    /// there.
    pub fn rate_at_limit(&self, x: T) -> Option<T> {
        let away = [x - self.room.left, self.room.right - x];
        let within = |([near, slope], away): ([T; 2], T)| (away < near).then_some(slope);
        self.hollow.into_iter().zip(away).find_map(|(hollow, away)| within((hollow?, away)))
    }

    /// Tells whether a place is so close to a limit that the pressure inside decides about the gap.
    pub fn is_near(&self, x: T) -> bool {
        x - self.room.left < self.near[0] || self.room.right - x < self.near[1]
    }
}

/// Verdict on the gap between the loaded bodies.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Verdict {
    Apart,
    /// Overlap, if any, within the uncertainty of the series of the pressures.
    Unresolved,
    /// Overlap, if any, within the uncertainty of the survey.
    Hidden,
    Overlap,
}
