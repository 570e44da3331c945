//! Searches on functions that may fail.

use super::{Bracket, LimitSearch, Root, SearchError};
use crate::Real;

/// Reason for a failure of [`try_find`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TryFindError<T: Real, E> {
    /// The function failed; this is its first error.
    Function(E),
    /// The search failed.
    Search(SearchError<T>),
}

impl<T: Real, E> TryFindError<T, E> {
    /// Returns the error of the function, or applies `search` to the error of the search.
    pub fn or_else(self, search: impl FnOnce(SearchError<T>) -> E) -> E {
        match self {
            Self::Function(error) => error,
            Self::Search(source) => search(source),
        }
    }
}

/// Finds a zero of a function that may fail, by any strategy. The first error of the function ends
/// the search, and is returned unchanged. A strategy that leaves the bracket is stopped there
/// ([`SearchError::LeftBracket`]).
///
/// ```
/// use linecontact::search::{Bracket, Brent, try_find};
/// use linecontact::{Contact, ContactError, Control, Flat, profile::Parabola};
///
/// // The radius on which a load of 0.02 makes a contact of half-width 0.25.
/// let half_width = |radius: f64| -> Result<f64, ContactError<f64>> {
///     let roller = Parabola::new(radius, [-1.0, 1.0])?;
///     Ok(Contact::new(&Flat, &roller)?.solve(Control::Load(0.02))?.a())
/// };
/// let wanted = |radius: f64| half_width(radius).map(|a| a - 0.25);
/// let root = try_find(&Brent::default(), wanted, &Bracket::new(1.0, 3.0)).unwrap();
/// assert!((root.x - 0.25f64.powi(2) / 0.04).abs() < 1e-13);
/// ```
///
/// # Errors
/// [`TryFindError`].
pub fn try_find<T: Real, E>(
    strategy: &(impl LimitSearch<T> + ?Sized),
    function: impl FnMut(T) -> Result<T, E>,
    bracket: &Bracket<T>,
) -> Result<Root<T>, TryFindError<T, E>> {
    guarded(bracket, function, T::of(f64::NAN), |function| strategy.find(function, bracket))
}

/// Finds a zero of a function that may fail, and that returns its value and its slope together.
///
/// # Errors
/// As [`try_find`].
pub fn try_find_with_slope<T: Real, E>(
    strategy: &(impl LimitSearch<T> + ?Sized),
    function: impl FnMut(T) -> Result<(T, T), E>,
    bracket: &Bracket<T>,
) -> Result<Root<T>, TryFindError<T, E>> {
    let failed = (T::of(f64::NAN), T::zero());
    guarded(bracket, function, failed, |function| strategy.find_with_slope(function, bracket))
}

/// Stands between a strategy and the function. After an error it returns `failed`, which is not
/// finite and ends any search.
fn guarded<T: Real, E, R: Copy>(
    bracket: &Bracket<T>,
    mut function: impl FnMut(T) -> Result<R, E>,
    failed: R,
    find: impl FnOnce(&mut dyn FnMut(T) -> R) -> Result<Root<T>, SearchError<T>>,
) -> Result<Root<T>, TryFindError<T, E>> {
    let Bracket { lo, hi, .. } = *bracket;
    let check = |x: T| {
        let is_inside = x >= lo && x <= hi;
        let left = || TryFindError::Search(SearchError::LeftBracket { x, lo, hi });
        if is_inside { Ok(()) } else { Err(left()) }
    };
    let mut first_error = None;
    let root = find(&mut |x| {
        if first_error.is_some() {
            return failed;
        }
        let value = check(x).and_then(|()| function(x).map_err(TryFindError::Function));
        value.map_err(|error| first_error = Some(error)).unwrap_or(failed)
    });
    match first_error {
        Some(error) => Err(error),
        None => root.map_err(TryFindError::Search).and_then(|root| check(root.x).map(|()| root)),
    }
}
