//! Left and right: the two sides of a contact, and values that belong to them.

use std::array::IntoIter;
use std::ops::{Index, IndexMut};

/// Side of a contact, or of a breakpoint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// Side of smaller `x`: the edge at `-b`.
    Left,
    /// Side of larger `x`: the edge at `a`.
    Right,
}

impl Side {
    /// Left side, then right side.
    pub const BOTH: [Self; 2] = [Self::Left, Self::Right];

    /// Returns the opposite side.
    #[must_use]
    pub const fn other(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }
}

/// Values at the left and the right edge of a contact.
///
/// ```
/// use linecontact::{Ends, Side};
///
/// let limits = Ends { left: -0.2, right: 0.4 };
/// assert_eq!(limits[Side::Left], limits.left);
/// assert_eq!(limits.map(f64::abs), Ends { left: 0.2, right: 0.4 });
/// assert_eq!(limits.into_iter().sum::<f64>(), 0.2);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Ends<T> {
    /// Value at `-b`.
    pub left: T,
    /// Value at `a`.
    pub right: T,
}

impl<T> Ends<T> {
    /// Builds the pair from a function of the side.
    pub fn from_fn(mut of: impl FnMut(Side) -> T) -> Self {
        Self { left: of(Side::Left), right: of(Side::Right) }
    }

    /// Applies a function to both values, the left one first.
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Ends<U> {
        Ends { left: f(self.left), right: f(self.right) }
    }

    /// Pairs the values of two pairs by side.
    pub fn zip<U>(self, other: Ends<U>) -> Ends<(T, U)> {
        Ends { left: (self.left, other.left), right: (self.right, other.right) }
    }
}

impl<T: Copy> Ends<T> {
    /// Gives both sides the same value.
    pub const fn both(value: T) -> Self {
        Self { left: value, right: value }
    }
}

impl<T> Index<Side> for Ends<T> {
    type Output = T;

    fn index(&self, side: Side) -> &T {
        match side {
            Side::Left => &self.left,
            Side::Right => &self.right,
        }
    }
}

impl<T> IndexMut<Side> for Ends<T> {
    fn index_mut(&mut self, side: Side) -> &mut T {
        match side {
            Side::Left => &mut self.left,
            Side::Right => &mut self.right,
        }
    }
}

/// Takes the left value and the right one.
impl<T> From<[T; 2]> for Ends<T> {
    fn from([left, right]: [T; 2]) -> Self {
        Self { left, right }
    }
}

/// Yields the left value, then the right one.
impl<T> IntoIterator for Ends<T> {
    type Item = T;
    type IntoIter = IntoIter<T, 2>;

    fn into_iter(self) -> Self::IntoIter {
        [self.left, self.right].into_iter()
    }
}
