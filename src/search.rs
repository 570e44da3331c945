//! Searches for the root of one function of one variable.
//!
//! The solver meets two such problems, and takes any [`LimitSearch`] for either: inverting
//! `X(k) = x` on a profile, and adjusting the limits `a` and `b` until the conditions at the edges
//! hold.
//!
//! | strategy | needs | evaluations, smooth function | hard ones |
//! |---|---|---|---|
//! | [`Bisection`] | a sign change | 50 to 60, one for each bit | the same |
//! | [`Secant`] | a sign change | 7 to 10 | 20 to 60 |
//! | [`Brent`] | a sign change | 7 to 10 | 20 to 50 |
//! | [`Newton`] | a sign change; the slope helps | 5 to 7; 2 to 3 from a close guess | 10 to 60 |
//!
//! (From a wide bracket to all digits; `cargo run --release --example compare_searches` counts
//! them on the curves of this field.)
//!
//! All of them keep the tightest sign change they have seen and never evaluate outside the
//! bracket. None compares with an absolute number unless told to: multiplying `x` and `f`
//! by powers of two gives the same iterates, bit for bit, and the same counts.

mod bisection;
mod bracket_state;
mod fallible;
mod newton;
mod roots_adapter;

pub use fallible::{TryFindError, try_find, try_find_with_slope};

use crate::Real;
use crate::rounded::{apart, six};
use bracket_state::BracketState;
use thiserror::Error;

/// Strategy that finds a zero of a function.
///
/// Usable as a trait object, so that [strategies] can sit side by side.
///
/// Implement [`find`](Self::find) for a strategy of your own; override
/// [`find_with_slope`](Self::find_with_slope) if it can use the derivative. The solver relies on
/// three properties: the root lies in the bracket; it is a point that was evaluated (the inversion
/// takes `Root::x`, and is cheaper if it is the last one; the search for the limits takes the best
/// of the contacts tried); a value that is not finite ends the search with an error. The accuracy
/// of the root shows in the solution's error estimate; a solution with a large error is not
/// reported as checked ([`Outcome::Doubtful`](crate::Outcome::Doubtful)).
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

    /// Finds a zero of a function that returns its value and its slope together. A strategy that
    /// has no use for the slope need not implement this.
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

/// Makes the strategies, whose only settings are their stopping criteria, of their names and the
/// functions by which they narrow the sign change.
macro_rules! strategies {
    ($($(#[$documentation:meta])* $name:literal $strategy:ident: $narrow:path;)*) => {
        $(
            $(#[$documentation])*
            #[derive(Clone, Copy, Debug, Default, PartialEq)]
            #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
            #[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
            pub struct $strategy {
                /// Stopping criteria.
                pub tolerance: StoppingCriteria,
            }

            impl $strategy {
                /// All digits of the number type.
                pub const DEFAULT: Self = Self { tolerance: StoppingCriteria::FULL };
            }

            impl<T: Real> LimitSearch<T> for $strategy {
                fn find(
                    &self,
                    f: &mut dyn FnMut(T) -> T,
                    bracket: &Bracket<T>,
                ) -> Result<Root<T>, SearchError<T>> {
                    let mut f = |x| (f(x), None);
                    let mut state = BracketState::new(&mut f, bracket, self.tolerance)?;
                    $narrow(&mut state)?;
                    Ok(state.root())
                }

                fn find_with_slope(
                    &self,
                    f: &mut dyn FnMut(T) -> (T, T),
                    bracket: &Bracket<T>,
                ) -> Result<Root<T>, SearchError<T>> {
                    let with_slope = |(value, slope)| (value, Some(slope));
                    let mut f = |x| with_slope(f(x));
                    let mut state = BracketState::new(&mut f, bracket, self.tolerance)?;
                    $narrow(&mut state)?;
                    Ok(state.root())
                }
            }
        )*

        /// Returns the strategies of this module by name, with these stopping criteria.
        ///
        /// ```
        /// use linecontact::search::{Bracket, StoppingCriteria, strategies};
        ///
        /// for (name, search) in strategies(StoppingCriteria::FULL) {
        ///     let root = search.find(&mut |x| x * x - 2.0, &Bracket::new(1.0, 2.0))?;
        ///     assert!((root.x / 2f64.sqrt() - 1.0).abs() < 1e-15, "{name}");
        /// }
        /// # Ok::<(), linecontact::search::SearchError<f64>>(())
        /// ```
        #[must_use]
        pub fn strategies<T: Real>(
            tolerance: StoppingCriteria,
        ) -> Vec<(&'static str, Box<dyn LimitSearch<T>>)> {
            vec![$(($name, Box::new($strategy { tolerance }))),*]
        }
    };
}

strategies! {
    /// Bisection: one bit of `x` for each evaluation, whatever the function.
    "bisection" Bisection: bisection::bisect;

    /// Secant method of the `roots` crate, kept inside the bracket: where it would step out, meets
    /// two equal values or crawls, the bracket is halved and the method starts again.
    "secant" Secant: roots_adapter::secant;

    /// Brent's method: inverse quadratic interpolation where it converges, halving where not.
    ///
    /// Brent, *Algorithms for Minimization without Derivatives* (1973), chapter 4, as
    /// implemented by the `roots` crate.
    "brent" Brent: roots_adapter::brent;

    /// Newton's method with the slope that comes with the value, kept inside the sign change.
    ///
    /// If the function gives no slope, the chord through the last two points stands in for it (a
    /// safeguarded secant). A step that would leave the sign change, or that did not halve the step
    /// before last, is replaced by a halving of the bracket.
    ///
    /// The value of a function that cancels large terms has noise, and near the root the steps then
    /// stop shrinking long before they reach the tolerance. The search ends there. (It looks for
    /// noise only if the slope is known, for a chord shows no such regularity.) A step counts as
    /// noise if the steps have shrunk a hundredfold at once, as they do close to a simple root, and
    /// it then fails to shrink though it is tiny: below the square root of the rounding unit
    /// compared with `x`, or with a value at the rounding of both values at the ends of the
    /// bracket. A value of that size counts as noise, too, if it stays the same where the slope
    /// says that it should change.
    "newton" Newton: newton::newton;
}

/// Interval over which a function changes its sign, with known values and a guess.
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
    /// Values of the function at `lo` and `hi`, if they are known; this saves two evaluations. They
    /// are taken on trust.
    pub values: Option<[T; 2]>,
    /// Point to evaluate first. Ignored unless it lies inside.
    pub guess: Option<T>,
}

impl<T: Real> Bracket<T> {
    /// Returns the bracket from `lo` to `hi`, with nothing else known.
    pub fn new(lo: T, hi: T) -> Self {
        Self { lo, hi, values: None, guess: None }
    }

    /// Adds the values of the function at `lo` and `hi`.
    #[must_use]
    pub fn values(self, at_lo: T, at_hi: T) -> Self {
        Self { values: Some([at_lo, at_hi]), ..self }
    }

    /// Adds a first guess.
    #[must_use]
    pub fn guess(self, x: T) -> Self {
        Self { guess: Some(x), ..self }
    }
}

/// Result of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Root<T> {
    /// Point with the smallest value of the function found.
    pub x: T,
    /// Value of the function at `x`.
    pub residual: T,
    /// Tightest sign change seen; both ends are `x` if the function is zero there.
    pub bracket: [T; 2],
    /// Number of evaluations of the function.
    pub evaluations: usize,
}

/// Criteria that end a search. The default asks for full accuracy of the number type.
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
    /// Largest error of `x` as a fraction of `|x|`. Never taken below four units in the last place
    /// of the number type; the default 0 stands for these.
    pub relative: f64,
    /// Largest `|f(x)|` at which a point counts as the root. Default 0: no such test.
    pub residual: f64,
    /// Number of evaluations of the function after which the search gives up (the ends of the
    /// bracket are evaluated in any case, unless their values are known). Default 2200, which
    /// bisection needs at worst to reach any `f64` from any bracket.
    pub max_evaluations: usize,
}

impl StoppingCriteria {
    /// Full accuracy of the number type.
    pub const FULL: Self =
        Self { absolute: 0.0, relative: 0.0, residual: 0.0, max_evaluations: 2200 };

    /// Returns criteria with a relative error of `x`, and defaults otherwise.
    #[must_use]
    pub const fn relative(relative: f64) -> Self {
        Self { relative, ..Self::FULL }
    }

    /// Returns the error allowed in a root of about the size of `x`.
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

/// Reason why a search found no root.
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
    #[error("the function is {} at {}; it must be finite on the whole bracket", six(*value), six(*x))]
    NotFinite {
        /// Point of the evaluation.
        x: T,
        /// Value returned.
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
        /// Best point so far.
        best: Root<T>,
    },
    /// A strategy has evaluated, or returned, a point outside the bracket it was given.
    #[error(
        "the strategy went to {}, which is not in the bracket [{}, {}]: it must stay there",
        apart(*x, &[*lo, *hi]), apart(*lo, &[*x, *hi]), apart(*hi, &[*x, *lo])
    )]
    LeftBracket {
        /// Point outside the bracket.
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
        /// Point returned.
        x: T,
        /// Value of the function there.
        residual: T,
    },
    /// A tolerance is negative, NaN or infinite.
    #[error("tolerance {} is out of range: use a finite number >= 0", six(*value))]
    Tolerance {
        /// The tolerance as given.
        value: f64,
    },
}
