//! Bending of a body.

use crate::Real;

/// Bending of the height Y of a body over X, as far as it is known.
///
/// Where the upper body is convex and the lower one concave (each may be straight) the gap between
/// them is convex, so that they touch in one interval: the solver then samples no heights to look
/// for others. Declare it for a body that is certainly convex and solved from scratch often: a
/// first solve takes a tenth to two thirds of the time.
///
/// The slopes of the gap at the nodes of [`Panels`](crate::Panels) are checked: where they fall by
/// more than their uncertainty, and by more than `sqrt(ε)` of the largest, the solve ends with
/// [`InputError::NotConvex`](crate::InputError::NotConvex). The gap between the nodes or beyond
/// the sampled span is not checked, nor is anything with another quadrature: there
/// [`Solution::certify`](crate::Solution::certify) finds a wrong declaration. With
/// [`Contact::resolution`](crate::Contact::resolution) the solver samples heights whatever was
/// declared.
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
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Convexity {
    /// Unknown bending: the solver samples heights.
    #[default]
    Unknown,
    /// Constant slope dY/dX.
    Straight,
    /// Slope that never falls with X, at breakpoints either: an upper body that bulges towards the
    /// contact.
    Convex,
    /// Slope that never rises with X: a lower body that bulges towards the contact.
    Concave,
}

impl Convexity {
    /// Returns the convexity of a body whose slope rises with a quantity of this sign.
    pub(super) fn of_sign<T: Real>(sign: T) -> Self {
        match sign {
            _ if sign > T::zero() => Self::Convex,
            _ if sign < T::zero() => Self::Concave,
            _ => Self::Straight,
        }
    }

    /// Returns the convexity of the body turned upside down.
    pub(super) fn flipped(self) -> Self {
        match self {
            Self::Convex => Self::Concave,
            Self::Concave => Self::Convex,
            same => same,
        }
    }

    /// Returns the convexity of a body in two parts, given the change of slope from one to the
    /// other.
    pub(super) fn joined(self, other: Self, change: Self) -> Self {
        let both = |one: Self, other: Self| match (one, other) {
            (Self::Straight, known) | (known, Self::Straight) => known,
            (one, other) if one == other => one,
            _ => Self::Unknown,
        };
        both(both(self, other), change)
    }

    /// Tells whether the gap between two bodies is convex.
    pub(crate) fn gap_is_convex(lower: Self, upper: Self) -> bool {
        matches!(lower, Self::Straight | Self::Concave)
            && matches!(upper, Self::Straight | Self::Convex)
    }
}
