//! Searches on functions that may fail.

use super::{Bracket, LimitSearch, Root, SearchError};
use crate::Real;

/// Why [`try_find`] has no root.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TryFindError<T: Real, E> {
    /// The function failed; this is its first error.
    Function(E),
    /// The search failed.
    Search(SearchError<T>),
}

impl<T: Real, E> TryFindError<T, E> {
    /// The error of the function, or what `search` makes of that of the search.
    pub fn or_else(self, search: impl FnOnce(SearchError<T>) -> E) -> E {
        match self {
            Self::Function(error) => error,
            Self::Search(source) => search(source),
        }
    }
}

/// Finds a zero of a function that may fail, by any strategy: the first error of the function ends the search,
/// and comes out as it is. A strategy that leaves the bracket is stopped there
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
    mut function: impl FnMut(T) -> Result<T, E>,
    bracket: &Bracket<T>,
) -> Result<Root<T>, TryFindError<T, E>> {
    guarded(bracket, |guard| {
        strategy.find(&mut |x| guard.call(x, &mut function).unwrap_or(T::of(f64::NAN)), bracket)
    })
}

/// The same for a function that returns its value and its slope together.
///
/// # Errors
/// As [`try_find`].
pub fn try_find_with_slope<T: Real, E>(
    strategy: &(impl LimitSearch<T> + ?Sized),
    mut function: impl FnMut(T) -> Result<(T, T), E>,
    bracket: &Bracket<T>,
) -> Result<Root<T>, TryFindError<T, E>> {
    let nothing = (T::of(f64::NAN), T::zero());
    guarded(bracket, |guard| {
        strategy.find_with_slope(&mut |x| guard.call(x, &mut function).unwrap_or(nothing), bracket)
    })
}

/// What stands between a strategy and the function.
struct Guard<T: Real, E> {
    ends: [T; 2],
    failed: Option<TryFindError<T, E>>,
}

impl<T: Real, E> Guard<T, E> {
    fn check(&self, x: T) -> Result<(), TryFindError<T, E>> {
        let [lo, hi] = self.ends;
        if x >= lo && x <= hi {
            Ok(())
        } else {
            Err(TryFindError::Search(SearchError::LeftBracket { x, lo, hi }))
        }
    }

    /// `None`, which becomes NaN, ends any search.
    fn call<R>(&mut self, x: T, function: &mut impl FnMut(T) -> Result<R, E>) -> Option<R> {
        if self.failed.is_some() {
            return None;
        }
        let value = self.check(x).and_then(|()| function(x).map_err(TryFindError::Function));
        value.map_err(|error| self.failed = Some(error)).ok()
    }
}

fn guarded<T: Real, E>(
    bracket: &Bracket<T>,
    run: impl FnOnce(&mut Guard<T, E>) -> Result<Root<T>, SearchError<T>>,
) -> Result<Root<T>, TryFindError<T, E>> {
    let mut guard = Guard { ends: [bracket.lo, bracket.hi], failed: None };
    let root = run(&mut guard);
    if let Some(error) = guard.failed {
        return Err(error);
    }
    let root = root.map_err(TryFindError::Search)?;
    guard.check(root.x)?;
    Ok(root)
}
