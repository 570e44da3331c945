//! Which way a body bulges.

use crate::Real;

/// How the height Y of a body bends as a function of X, as far as it is known.
///
/// Where the upper body is convex and the lower one concave (each may be straight) the gap between them is
/// convex, and so they touch in one interval: the solver then takes no heights to look for others. Declare it of a body
/// that is certainly convex and solved from scratch often: a first solve takes a tenth to two thirds of the time.
///
/// The slopes of the gap at the nodes of [`Panels`](crate::Panels) are checked: where they fall by more than they are
/// uncertain, and by more than `sqrt(ε)` of the largest, the solve ends with
/// [`ContactError::NotConvex`](crate::ContactError::NotConvex). What lies between the nodes, or beyond the span sampled,
/// is not looked at, nor is anything with another quadrature: there a wrong word is found out by
/// [`Solution::certify`](crate::Solution::certify), and with
/// [`Contact::resolution`](crate::Contact::resolution) the solver looks whatever was declared.
///
/// ```
/// use linecontact::profile::Parabola;
/// use linecontact::{Contact, Control, Convexity, ParametricProfile};
///
/// let (lower, upper) = (Parabola::new(-3.0f64, [-1.0, 1.0])?, Parabola::new(1.5, [-1.0, 1.0])?);
/// assert_eq!([&lower, &upper].map(|body| body.convexity()), [Convexity::Concave, Convexity::Convex]);
/// let solution = Contact::new(&lower, &upper)?.solve(Control::Load(0.02))?;
/// assert!((solution.a() / 0.2 - 1.0).abs() < 1e-14); // sqrt(2 F R/κ) with 1/R = 1/3 + 1/1.5
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Convexity {
    /// Nothing is known: the solver looks.
    #[default]
    Unknown,
    /// The slope dY/dX is the same everywhere.
    Straight,
    /// The slope never falls with X, at breakpoints either: an upper body that bulges towards the contact.
    Convex,
    /// The slope never rises with X: a lower body that bulges towards the contact.
    Concave,
}

impl Convexity {
    /// That of a body whose slope rises with a quantity of this sign.
    pub(super) fn of_sign<T: Real>(sign: T) -> Self {
        match sign {
            _ if sign > T::zero() => Self::Convex,
            _ if sign < T::zero() => Self::Concave,
            _ => Self::Straight,
        }
    }

    /// With Y turned upside down.
    pub(super) fn flipped(self) -> Self {
        match self {
            Self::Convex => Self::Concave,
            Self::Concave => Self::Convex,
            same => same,
        }
    }

    /// Of a body in two parts, given how the slope changes from one to the other.
    pub(super) fn joined(self, other: Self, change: Self) -> Self {
        let both = |one: Self, other: Self| match (one, other) {
            (Self::Straight, known) | (known, Self::Straight) => known,
            (one, other) if one == other => one,
            _ => Self::Unknown,
        };
        both(both(self, other), change)
    }

    /// Whether the gap between two bodies is convex.
    pub(crate) fn gap_is_convex(lower: Self, upper: Self) -> bool {
        matches!(lower, Self::Straight | Self::Concave)
            && matches!(upper, Self::Straight | Self::Convex)
    }
}
