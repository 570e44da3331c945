//! What has to hold at the edges of a contact.

use crate::quadrature::Moments;
use crate::solution::ContactState;
use crate::{ContactError, Ends, Interval, Real, Side};

/// What becomes of one edge of the contact.
///
/// ```
/// use linecontact::{Contact, Control, Edge, Flat};
///
/// // A flat punch from -1 to 1.
/// let contact = Contact::new(&Flat, &Flat)?.edges(Edge::Fixed(-1.0f64), Edge::Fixed(1.0));
/// let solution = contact.solve(Control::Load(0.3))?;
/// // F/(π sqrt(1 - x²))
/// let exact = 0.3 / (0.8 * std::f64::consts::PI);
/// assert!((solution.pressure()?.at(0.6)? / exact - 1.0).abs() < 1e-14);
/// # Ok::<(), linecontact::ContactError<f64>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub enum Edge<T> {
    /// A smooth body: the limit is where the pressure ends at zero.
    Free,
    /// A sharp corner at this `x`, from which the contact does not part. The pressure may be
    /// infinite there; where it would have to pull, or the contact ends before the corner, the body
    /// lifts off ([`ContactError::LiftsOff`](crate::ContactError::LiftsOff)). Between two such
    /// corners the load must be positive, and the contacts may be several, unless [a single
    /// interval](crate::Contact::single_interval) is asked for: the paper's fixed limits.
    Fixed(T),
    /// A smooth body with a sharp corner at this `x`: free as long as the contact does not reach
    /// the corner, fixed from then on.
    FreeUntil(T),
    /// Adhesion over so short a range that it acts at the edge alone (Johnson, Kendall and
    /// Roberts), with this work of adhesion w: energy per unit area, not negative.
    Adhesive(T),
}

impl<T: Real> Edge<T> {
    /// The limit, where it is known.
    pub(crate) fn limit(&self) -> Option<T> {
        match *self {
            Self::Fixed(x) => Some(x),
            _ => None,
        }
    }

    /// Lets go of a corner where it does not press.
    pub(crate) fn let_go(self) -> Self {
        if let Self::Fixed(x) = self { Self::FreeUntil(x) } else { self }
    }

    pub(crate) fn is_free(&self) -> bool {
        matches!(self, Self::Free | Self::FreeUntil(_))
    }
}

impl<T: Real> Ends<Edge<T>> {
    /// Whether adhesion acts at either edge.
    pub(crate) fn are_adhesive(self) -> bool {
        self.into_iter().any(|edge| matches!(edge, Edge::Adhesive(_)))
    }

    /// Whether either limit is to be found.
    pub(crate) fn are_sought(self) -> bool {
        self.into_iter().any(|edge| edge.limit().is_none())
    }
}

/// What is asked of the contact as a whole.
#[derive(Clone, Copy)]
pub(crate) enum Given<T> {
    Load(T),
    HalfWidth(T),
    /// A load, and where it acts: the bodies turn.
    Centre {
        load: T,
        at: T,
    },
}

/// What a contact has to meet.
#[derive(Clone, Copy)]
pub(crate) struct Conditions<T> {
    pub kappa: T,
    pub edges: Ends<Edge<T>>,
    pub given: Given<T>,
}

impl<T: Real> Conditions<T> {
    /// The load, or zero where it is not known.
    pub fn load(&self) -> T {
        match self.given {
            Given::Load(load) | Given::Centre { load, .. } => load,
            Given::HalfWidth(_) => T::zero(),
        }
    }

    /// Where the load acts, if that is given.
    pub fn at(&self) -> Option<T> {
        match self.given {
            Given::Centre { at, .. } => Some(at),
            Given::Load(_) | Given::HalfWidth(_) => None,
        }
    }

    /// The limits that are given.
    pub fn limits(&self) -> Ends<Option<T>> {
        self.edges.map(|edge| edge.limit())
    }

    /// What adhesion takes from the load at each edge: half of `2 sqrt(κ w L)`. By roots, so as not to
    /// underflow.
    pub fn edge_strengths(&self, half_width: T) -> Ends<T> {
        self.edges.map(|edge| match edge {
            Edge::Adhesive(work) => self.kappa.sqrt() * work.sqrt() * half_width.sqrt(),
            _ => T::zero(),
        })
    }

    /// By how much body 2 has to be turned counter-clockwise for the load to act where it is given to, once
    /// the limits are right: what is asked of the edges then holds with `m₀ + τ` in place of `m₀`.
    pub fn tilt(&self, on: Interval<T>, m: &Moments<T>) -> T {
        let Given::Centre { load, at } = self.given else { return T::zero() };
        let half_width = on.half_width();
        let by_load = load / (self.kappa * half_width);
        match self.limits() {
            Ends { left: None, right: None } => -m.m0,
            Ends { left: Some(_), right: None } => by_load - m.m1 - m.m0,
            Ends { left: None, right: Some(_) } => m.m1 - by_load - m.m0,
            Ends { left: Some(_), right: Some(_) } => {
                let second = m.m2.unwrap_or(T::zero());
                let away = (on.centre() - at) / half_width;
                second - m.m0 + (by_load + by_load) * away
            }
        }
    }

    /// Returns the only edge that is not fixed.
    pub fn only_free(&self) -> Option<Side> {
        match self.limits() {
            Ends { left: Some(_), right: None } => Some(Side::Right),
            Ends { left: None, right: Some(_) } => Some(Side::Left),
            _ => None,
        }
    }

    /// Returns the load under which the edges that are not fixed are as they should be, on an average;
    /// `None` if both are fixed.
    pub fn balance(&self, on: Interval<T>, m: &Moments<T>) -> Option<T> {
        let half_width = on.half_width();
        let pulls = self.edge_strengths(half_width);
        let bears = |side| {
            let sum = if side == Side::Left { m.m1 - m.m0 } else { m.m1 + m.m0 };
            self.kappa * half_width * sum - pulls[side] - pulls[side]
        };
        match self.only_free() {
            Some(side) => Some(bears(side)),
            None if !self.edges.are_sought() => None,
            None => Some(T::of(0.5) * (bears(Side::Left) + bears(Side::Right))),
        }
    }

    /// The interval, with those limits that are given.
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

    /// The interval, with the width or those limits that are given, within a range.
    pub fn with_given(&self, on: Interval<T>, range: [T; 2]) -> Interval<T> {
        let Given::HalfWidth(half_width) = self.given else { return self.with_given_limits(on) };
        let around = |centre| Interval { left: centre - half_width, right: centre + half_width };
        let given = around(on.centre());
        if given.left > range[0] && given.right < range[1] {
            return given;
        }
        // Not at an end of them, where the slope may be infinite, unless they are just wide enough.
        let room = (range[1] - range[0] - half_width - half_width).max(T::zero());
        let inset = half_width + T::of(0.125) * room;
        around(on.centre().max(range[0] + inset).min(range[1] - inset))
    }

    /// The interval, where both limits are given, or the half-width and one of them.
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

impl<T: Real> ContactState<T> {
    pub(crate) fn new(
        conditions: &Conditions<T>,
        interval: Interval<T>,
        load: T,
        error: Option<T>,
        m: &Moments<T>,
    ) -> Self {
        let kappa = conditions.kappa;
        let mean_pressure = load / interval.half_width();
        let tilt = conditions.tilt(interval, m);
        let mean = m.m0 + tilt;
        let strength = |sum: T| (mean_pressure - kappa * sum) / T::pi();
        let strengths = Ends { left: strength(m.m1 - mean), right: strength(m.m1 + mean) };
        let free = conditions.edges.map(|edge| edge.is_free());
        let adhesive = conditions.edges.map(|edge| matches!(edge, Edge::Adhesive(_)));
        let ends = Ends { left: interval.left, right: interval.right };
        Self {
            interval,
            load,
            strengths,
            free,
            adhesive,
            error,
            error_by_load: None,
            force: None,
            trend: m.derivatives,
            tilt,
            ends,
        }
    }

    /// Whether the contact ends at those corners that are said to hold it, to rounding.
    pub(crate) fn reaches(&self, edges: Ends<Edge<T>>) -> Ends<bool> {
        let rounding = T::epsilon().sqrt() * self.interval.half_width();
        let ends = Ends { left: self.interval.left, right: self.interval.right };
        let is_near = |(edge, end): (Edge<T>, T)| {
            edge.limit().is_none_or(|corner| (end - corner).abs() <= rounding)
        };
        edges.zip(ends).map(is_near)
    }

    /// A corner that is said to hold the contact, and would have to pull at it, or is not reached.
    pub(crate) fn lifts_off(&self, edges: Ends<Edge<T>>) -> Option<ContactError<T>> {
        let (interval, load, reaches) = (self.interval, self.load, self.reaches(edges));
        let mean = T::of(0.5) * load.abs() / interval.half_width();
        let rounding = T::epsilon().sqrt() * mean;
        Side::BOTH.into_iter().find_map(|side| match (edges[side], self.strengths[side]) {
            (Edge::Fixed(x), strength) if strength < -rounding || !reaches[side] => {
                Some(ContactError::LiftsOff { x, strength, interval, load })
            }
            _ => None,
        })
    }
}
