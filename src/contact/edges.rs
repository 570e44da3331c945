//! Conditions at the edges of a contact.

use crate::quadrature::Moments;
use crate::{Edge, Ends, Interval, Real, Side};

impl<T: Real> Ends<Edge<T>> {
    /// Tells whether adhesion acts at either edge.
    pub(crate) fn are_adhesive(self) -> bool {
        self.into_iter().any(|edge| matches!(edge, Edge::Adhesive(_)))
    }

    /// Tells whether either limit is unknown.
    pub(crate) fn are_sought(self) -> bool {
        self.into_iter().any(|edge| edge.limit().is_none())
    }
}

impl<T> Ends<Option<T>> {
    /// Returns the side of the only limit that is not given.
    pub(crate) fn only_free(&self) -> Option<Side> {
        match self {
            Self { left: Some(_), right: None } => Some(Side::Right),
            Self { left: None, right: Some(_) } => Some(Side::Left),
            _ => None,
        }
    }
}

/// Quantity prescribed of the contact as a whole.
#[derive(Clone, Copy)]
pub(crate) enum Given<T> {
    Load(T),
    HalfWidth(T),
    /// Load and the place where it acts: the bodies tilt.
    Centre {
        load: T,
        at: T,
    },
}

/// Conditions that a contact has to meet.
#[derive(Clone, Copy)]
pub(crate) struct Conditions<T> {
    pub kappa: T,
    pub edges: Ends<Edge<T>>,
    pub given: Given<T>,
}

impl<T: Real> Conditions<T> {
    /// Returns the load, or zero if it is not known.
    pub fn load(&self) -> T {
        match self.given {
            Given::Load(load) | Given::Centre { load, .. } => load,
            Given::HalfWidth(_) => T::zero(),
        }
    }

    /// Returns the place where the load acts, if it is given.
    pub fn at(&self) -> Option<T> {
        match self.given {
            Given::Centre { at, .. } => Some(at),
            Given::Load(_) | Given::HalfWidth(_) => None,
        }
    }

    /// Returns the conditions under another load, if a load is given.
    pub fn under(&self, load: T) -> Self {
        let given = match self.given {
            Given::Load(_) => Given::Load(load),
            Given::Centre { at, .. } => Given::Centre { load, at },
            Given::HalfWidth(half_width) => Given::HalfWidth(half_width),
        };
        Self { given, ..*self }
    }

    /// Returns the limits that are given.
    pub fn limits(&self) -> Ends<Option<T>> {
        self.edges.map(|edge| edge.limit())
    }

    /// Returns the load that adhesion takes at each edge, half of `2 sqrt(κ w L)`. Each factor has
    /// its own root, to avoid underflow.
    pub fn edge_strengths(&self, half_width: T) -> Ends<T> {
        self.edges.map(|edge| match edge {
            Edge::Adhesive(work) => self.kappa.sqrt() * work.sqrt() * half_width.sqrt(),
            _ => T::zero(),
        })
    }

    /// Returns the angle τ by which body 2 has to turn counter-clockwise so that the load acts at
    /// its given place, once the limits are right: the conditions at the edges then hold with
    /// `m₀ + τ` in place of `m₀`.
    pub fn tilt(&self, on: Interval<T>, m: &Moments<T>) -> T {
        let Given::Centre { load, at } = self.given else { return T::zero() };
        let half_width = on.half_width();
        let by_load = load / (self.kappa * half_width);
        let away = (on.centre() - at) / half_width;
        m.m2.unwrap_or(T::zero()) - m.m0 + (by_load + by_load) * away
    }

    /// Returns the load that meets the conditions at the edges that are not fixed, on average;
    /// `None` if both are fixed.
    pub fn balance(&self, on: Interval<T>, m: &Moments<T>) -> Option<T> {
        let half_width = on.half_width();
        let pulls = self.edge_strengths(half_width);
        let bears = |side| {
            let sum = if side == Side::Left { m.m1 - m.m0 } else { m.m1 + m.m0 };
            self.kappa * half_width * sum - pulls[side] - pulls[side]
        };
        match self.limits().only_free() {
            Some(side) => Some(bears(side)),
            None if !self.edges.are_sought() => None,
            None => Some(T::of(0.5) * (bears(Side::Left) + bears(Side::Right))),
        }
    }

    /// Returns the interval, moved to the limits that are given.
    pub fn with_given_limits(&self, on: Interval<T>) -> Interval<T> {
        let width = on.right - on.left;
        match self.limits() {
            Ends { left: Some(left), right: None } if left >= on.right => {
                Interval { left, right: left + width }
            }
            Ends { left: None, right: Some(right) } if right <= on.left => {
                Interval { left: right - width, right }
            }
            Ends { left, right } => {
                Interval { left: left.unwrap_or(on.left), right: right.unwrap_or(on.right) }
            }
        }
    }

    /// Returns the interval, with the half-width or the limits that are given, within a range.
    pub fn with_given(&self, on: Interval<T>, range: [T; 2]) -> Interval<T> {
        let Given::HalfWidth(half_width) = self.given else { return self.with_given_limits(on) };
        let around = |centre| Interval { left: centre - half_width, right: centre + half_width };
        let given = around(on.centre());
        if given.left > range[0] && given.right < range[1] {
            return given;
        }
        // Away from the ends of the bodies, where the slope may be infinite, if there is room.
        let room = (range[1] - range[0] - half_width - half_width).max(T::zero());
        let inset = half_width + T::of(0.125) * room;
        around(on.centre().max(range[0] + inset).min(range[1] - inset))
    }

    /// Returns the interval if both limits are given, or the half-width and one of them.
    pub fn both_limits(&self) -> Option<Interval<T>> {
        let Ends { left, right } = self.limits();
        match (left, right, self.given) {
            (Some(left), Some(right), _) => Some(Interval { left, right }),
            (Some(left), None, Given::HalfWidth(half_width)) => {
                Some(Interval { left, right: left + half_width + half_width })
            }
            (None, Some(right), Given::HalfWidth(half_width)) => {
                Some(Interval { left: right - half_width - half_width, right })
            }
            _ => None,
        }
    }
}
