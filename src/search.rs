//! Searches for the root of one function of one variable.
//!
//! The solver meets two such problems, and takes any [`LimitSearch`] for either:
//! inverting `X(k) = x` on a profile, and adjusting the limits `a` and `b` until the
//! conditions at the edges hold.
//!
//! | strategy | wants | evaluations, smooth function | hard ones |
//! |---|---|---|---|
//! | [`Bisection`] | a sign change | 50 to 60, one for each bit | the same |
//! | [`Secant`] | a sign change | 7 to 10 | 20 to 60 |
//! | [`Brent`] | a sign change | 7 to 10 | 20 to 50 |
//! | [`Newton`] | a sign change and, where it is at hand, the slope | 5 to 7; 2 to 3 from a close guess | 10 to 60 |
//!
//! (From a wide bracket to all digits; `cargo run --release --example compare_searches` counts
//! them on the curves of this field.)
//!
//! All four keep the tightest sign change they have seen and never evaluate outside the
//! bracket. None compares with an absolute number unless told to: multiplying `x` and `f`
//! by powers of two gives the same iterates, bit for bit, and the same counts.

/// A strategy that is told no more than when to stop.
macro_rules! strategy {
    ($(#[$documentation:meta])* $name:ident) => {
        $(#[$documentation])*
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
        pub struct $name {
            /// When to stop.
            pub tolerance: StoppingCriteria,
        }

        impl $name {
            /// All digits.
            pub const DEFAULT: Self = Self { tolerance: StoppingCriteria::FULL };
        }
    };
}

mod bisection;
mod bracket_state;
mod fallible;
mod newton;
mod roots_adapter;

pub use bisection::Bisection;
pub use fallible::{TryFindError, try_find, try_find_with_slope};
pub use newton::Newton;
pub use roots_adapter::{Brent, Secant};

use crate::Real;
use crate::rounded::{apart, six};
use thiserror::Error;

/// A strategy that finds where a function is zero.
///
/// Usable as a trait object, so that strategies can sit side by side in one array:
///
/// ```
/// use linecontact::search::{Bisection, Bracket, Brent, LimitSearch, Newton, Secant};
///
/// let all: [&dyn LimitSearch<f64>; 4] =
///     [&Bisection::default(), &Secant::default(), &Brent::default(), &Newton::default()];
/// for search in all {
///     let root = search.find(&mut |x| x * x - 2.0, &Bracket::new(1.0, 2.0))?;
///     assert!((root.x / 2f64.sqrt() - 1.0).abs() < 1e-15);
/// }
/// # Ok::<(), linecontact::search::SearchError<f64>>(())
/// ```
///
/// Implement [`find`](Self::find) for a strategy of your own; override
/// [`find_with_slope`](Self::find_with_slope) if it can use the derivative. The solver relies on
/// this much: the root lies in the bracket; it is a point that was evaluated (the inversion takes
/// `Root::x`, and is cheaper if it is the last one; the search for the limits takes the best of
/// the contacts tried); a value that is not finite ends the search with an error. How closely the
/// root was found shows in the solution's error estimate; a solution that leaves much open is not
/// said to be checked ([`Outcome::Doubtful`](crate::Outcome::Doubtful)).
pub trait LimitSearch<T: Real>: Send + Sync {
    /// Finds a zero of `f` in the bracket.
    ///
    /// # Errors
    /// See [`SearchError`]; each variant says where the search stood.
    fn find(
        &self,
        f: &mut dyn FnMut(T) -> T,
        bracket: &Bracket<T>,
    ) -> Result<Root<T>, SearchError<T>>;

    /// The same, for a function that returns its value and its slope together. A strategy
    /// that has no use for the slope need not implement this.
    ///
    /// # Errors
    /// As [`find`](Self::find).
    fn find_with_slope(
        &self,
        f: &mut dyn FnMut(T) -> (T, T),
        bracket: &Bracket<T>,
    ) -> Result<Root<T>, SearchError<T>> {
        self.find(&mut |x| f(x).0, bracket)
    }
}

/// An interval over which a function changes its sign, with what is known beforehand.
///
/// ```
/// use linecontact::search::{Bracket, LimitSearch, Newton};
///
/// let bracket = Bracket::new(1.0, 2.0).values(-1.0, 2.0).guess(1.4);
/// let root = Newton::DEFAULT.find_with_slope(&mut |x: f64| (x * x - 2.0, 2.0 * x), &bracket)?;
/// assert!((root.x - 2.0f64.sqrt()).abs() < 1e-15);
/// # Ok::<(), linecontact::search::SearchError<f64>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bracket<T> {
    /// Lower end.
    pub lo: T,
    /// Upper end.
    pub hi: T,
    /// The function at `lo` and `hi`, where they are known: two evaluations saved. They are
    /// believed.
    pub values: Option<[T; 2]>,
    /// Where to look first. Ignored unless it lies inside.
    pub guess: Option<T>,
}

impl<T: Real> Bracket<T> {
    /// The bracket from `lo` to `hi`, about which nothing else is known.
    pub fn new(lo: T, hi: T) -> Self {
        Self { lo, hi, values: None, guess: None }
    }

    /// With the values of the function at `lo` and `hi`.
    #[must_use]
    pub fn values(self, at_lo: T, at_hi: T) -> Self {
        Self { values: Some([at_lo, at_hi]), ..self }
    }

    /// With a first guess.
    #[must_use]
    pub fn guess(self, x: T) -> Self {
        Self { guess: Some(x), ..self }
    }
}

/// What a search found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Root<T> {
    /// The point with the smallest value of the function met.
    pub x: T,
    /// The function at `x`.
    pub residual: T,
    /// The tightest sign change seen; both ends are `x` where the function is zero.
    pub bracket: [T; 2],
    /// How often the function was evaluated.
    pub evaluations: usize,
}

/// When a search stops. The default asks for all that the number type can give.
///
/// ```
/// use linecontact::search::{Bisection, Bracket, LimitSearch, StoppingCriteria};
///
/// let loose = Bisection { tolerance: StoppingCriteria::relative(1e-3) };
/// let root = loose.find(&mut |x: f64| x * x - 2.0, &Bracket::new(1.0, 2.0))?;
/// assert!((root.x / 2.0f64.sqrt() - 1.0).abs() < 1e-3 && root.evaluations < 15);
/// # Ok::<(), linecontact::search::SearchError<f64>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct StoppingCriteria {
    /// Largest error of `x`, in the unit of `x`. Default 0: no absolute scale.
    pub absolute: f64,
    /// Largest error of `x` as a fraction of `|x|`. Never taken below four units in the
    /// last place of the number type, which is what the default 0 stands for.
    pub relative: f64,
    /// A point with `|f(x)|` up to this counts as the root. Default 0: no such test.
    pub residual: f64,
    /// Evaluations of the function after which the search gives up (the ends of the bracket,
    /// where their values are not known, are looked at in any case). Default 2200, which
    /// is what bisection needs at worst to reach any `f64` from any bracket.
    pub max_evaluations: usize,
}

impl StoppingCriteria {
    /// All that the number type can give.
    pub const FULL: Self =
        Self { absolute: 0.0, relative: 0.0, residual: 0.0, max_evaluations: 2200 };

    /// A relative error of `x`, the rest as by default.
    #[must_use]
    pub const fn relative(relative: f64) -> Self {
        Self { relative, ..Self::FULL }
    }

    /// The error allowed in a root of about the size of `x`.
    fn width<T: Real>(&self, x: T) -> T {
        let relative = T::of(self.relative).max(T::of(4.0) * T::epsilon());
        T::of(self.absolute).max(relative * x.abs())
    }

    fn check<T: Real>(&self) -> Result<(), SearchError<T>> {
        for value in [self.absolute, self.relative, self.residual] {
            if !(value.is_finite() && value >= 0.0) {
                return Err(SearchError::Tolerance { value });
            }
        }
        Ok(())
    }
}

impl Default for StoppingCriteria {
    fn default() -> Self {
        Self::FULL
    }
}

/// Why a search found no root.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SearchError<T: Real> {
    /// The bracket has a NaN or infinite end, or its ends are the wrong way round.
    #[error("[{}, {}] is no bracket: give two finite ends in rising order", six(*lo), six(*hi))]
    Bracket {
        /// Lower end as given.
        lo: T,
        /// Upper end as given.
        hi: T,
    },
    /// The function has the same sign at both ends.
    #[error(
        "no sign change: f({lo}) = {f_lo} and f({hi}) = {f_hi}; widen or move the bracket",
        lo = six(*lo), f_lo = six(*f_lo), hi = six(*hi), f_hi = six(*f_hi)
    )]
    NoSignChange {
        /// Lower end.
        lo: T,
        /// Upper end.
        hi: T,
        /// Value at the lower end.
        f_lo: T,
        /// Value at the upper end.
        f_hi: T,
    },
    /// The function returned NaN or an infinity.
    #[error(
        "the function is {} at {}; it must be finite on the whole bracket", six(*value), six(*x)
    )]
    NotFinite {
        /// Where.
        x: T,
        /// What it returned.
        value: T,
    },
    /// The evaluations ran out.
    #[error(
        "no convergence in {} evaluations; best so far f({}) = {}, sign change in [{}, {}]; \
         raise max_evaluations or loosen the tolerance",
        best.evaluations, six(best.x), six(best.residual), apart(best.bracket[0], &[best.bracket[1]]),
        apart(best.bracket[1], &[best.bracket[0]])
    )]
    Budget {
        /// The best point so far.
        best: Root<T>,
    },
    /// A strategy has looked at, or returned, a point that is not in the bracket it was given.
    #[error(
        "the strategy went to {}, which is not in the bracket [{}, {}]: it must stay there",
        apart(*x, &[*lo, *hi]), apart(*lo, &[*x, *hi]), apart(*hi, &[*x, *lo])
    )]
    LeftBracket {
        /// Where it went.
        x: T,
        /// Lower end of the bracket.
        lo: T,
        /// Upper end of the bracket.
        hi: T,
    },
    /// A strategy has stopped where the function is still far from zero.
    #[error(
        "the search stopped at {x}, where the function is still {residual}: tighten the tolerance, if one was set, or \
         write the function so that no large terms cancel", x = six(*x), residual = six(*residual)
    )]
    NotConverged {
        /// What it returned.
        x: T,
        /// The function there.
        residual: T,
    },
    /// A tolerance is negative, NaN or infinite.
    #[error("{} is no tolerance: give a finite number that is not negative", six(*value))]
    Tolerance {
        /// The tolerance as given.
        value: f64,
    },
}
