//! Curves without hand-written derivatives, and solutions with derivatives (feature `autodiff`).
//!
//! # Curves
//! A curve written once for numbers of any kind is evaluated on the dual numbers of
//! [`num_dual`], which carry its derivatives along, exact to rounding.
//!
//! ```
//! use linecontact::autodiff::{Autodiff, Formula};
//! use linecontact::{Contact, Control, Flat, Real};
//!
//! /// The lower half of a circle, by the angle from its lowest point.
//! struct Roller { r: f64 }
//!
//! impl Formula<f64> for Roller {
//!     fn domain(&self) -> [f64; 2] {
//!         [-1.5, 1.5]
//!     }
//!     fn point<N: Real>(&self, k: N) -> (N, N) {
//!         let r = N::of(self.r);
//!         (r * k.sin(), r * (N::one() - k.cos()))
//!     }
//! }
//!
//! let roller = Autodiff(Roller { r: 10.0 });
//! let contact = Contact::new(&Flat, &roller)?.contact_modulus(115e3);
//! let solution = contact.solve(Control::Load(500.0))?;
//! assert!((solution.a() / 0.2354 - 1.0).abs() < 1e-3);
//! # Ok::<(), linecontact::ContactError<f64>>(())
//! ```
//!
//! Where `X` or `Y` has no derivative (the `|k|` of a wedge, the ends of `sqrt(1 - k²)`) it has
//! none here either: make a piece of each side ([`Piecewise`](crate::Piecewise)), or take an angle
//! as the parameter. At zero the derivative of `powf` is NaN, unlike the derivative of `powi`.
//!
//! # Solutions
//! The solver itself works on dual numbers. Give one parameter (of a shape, a load, κ, a limit, an
//! x) the derivative 1, and every result has its derivative by that parameter:
//!
//! ```
//! use linecontact::autodiff::num_dual::Dual64;
//! use linecontact::{Contact, Control, Curve, CurvePoint, Flat};
//!
//! let radius = Dual64::from_re(0.01).derivative();
//! let parabola = Curve::new([-0.01, 0.01].map(Dual64::from_re), move |k| {
//!     CurvePoint { x: k, y: k * k / (radius * 2.0), dx: Dual64::from_re(1.0), dy: k / radius }
//! });
//! let contact = Contact::new(&Flat, &parabola)?.contact_modulus(Dual64::from_re(115e9));
//! let solution = contact.solve(Control::Load(Dual64::from_re(50e3)))?;
//!
//! // Hertz: a is proportional to the root of R, and the largest pressure to its reciprocal.
//! let a = solution.a();
//! assert!((a.eps / (a.re / (2.0 * 0.01)) - 1.0).abs() < 1e-13);
//! let peak = solution.pressure()?.at(Dual64::from_re(0.0))?;
//! assert!((peak.eps / (-peak.re / (2.0 * 0.01)) - 1.0).abs() < 1e-13);
//! # Ok::<(), linecontact::ContactError<num_dual::Dual64>>(())
//! ```
//!
//! [`Dual`] has one derivative, [`DualSVec`] a gradient from a single solution, [`HyperDual`]
//! second derivatives. The derivatives are those of the exact solution, not of the steps that led
//! to it: the panels are refined until the derivatives of the slope have converged too, and the
//! limits take one more Newton step for each order, whatever search has found them. The derivatives
//! of the closed forms of [`reference`](mod@crate::reference) come out to 1e-14; with noisy
//! formulas, to the noise of their derivatives. Their error is not estimated.
//!
//! A kink or jump of the slope that moves with the parameter must be declared as a breakpoint:
//! halving finds where it is, not that it moves. There is no derivative where edges change their
//! kind ([`Edge::FreeUntil`](crate::Edge::FreeUntil)), where a contact gives way, or where contacts
//! appear or merge; the result is then the derivative on one side, or not finite. (Up to a merger
//! the inner limits go like the root of the remaining load: their derivatives grow without bound.)
//! The number of several contacts and their approximate limits follow from the values; then all
//! limits take the steps for the derivatives at once. Two derivatives are not finite: of a pressure
//! at the limits, and of [`Solution::gap_at`](crate::Solution::gap_at) by a parameter that moves
//! the limits. The value of [`Solution::peak`](crate::Solution::peak) has its derivative, its place
//! has not.
//!
//! Comparisons, and so all decisions, use the values: these are the same as without derivatives,
//! but for rounding.

pub use num_dual;

use crate::{CurvePoint, ParametricProfile, Real};
use nalgebra::RealField;
use num_dual::{Dual, DualNumFloat, DualSVec, HyperDual};

impl<F: DualNumFloat> Real for Dual<F>
where
    Self: RealField,
{
    const COMPONENTS: usize = 2;
    const DERIVATIVE_ORDER: usize = 1;

    fn component(self, index: usize) -> Self {
        Self::from_re(if index == 0 { self.re } else { self.eps })
    }
}

impl<F: DualNumFloat, const N: usize> Real for DualSVec<F, N>
where
    Self: RealField + Copy,
{
    const COMPONENTS: usize = 1 + N;
    const DERIVATIVE_ORDER: usize = 1;

    fn component(self, index: usize) -> Self {
        let derivative = |i: usize| self.eps.0.map_or(F::zero(), |eps| eps[i]);
        Self::from_re(index.checked_sub(1).map_or(self.re, derivative))
    }
}

impl<F: DualNumFloat> Real for HyperDual<F>
where
    Self: RealField,
{
    const COMPONENTS: usize = 4;
    const DERIVATIVE_ORDER: usize = 2;

    fn component(self, index: usize) -> Self {
        Self::from_re([self.re, self.eps1, self.eps2, self.eps1eps2][index])
    }
}

/// Curve `[X(k), Y(k)]` for numbers of any kind; [`Autodiff`] makes a profile of it.
///
/// `T` is the number type of the solver. Constants become numbers of the kind at hand by
/// [`Real::of`], and shape parameters of type `T` by [`Over::lift`].
///
/// ```
/// use linecontact::Real;
/// use linecontact::autodiff::{Formula, Over};
///
/// /// `y = x²/(2R)`, whose radius may itself be a dual number.
/// struct Parabola<T> { radius: T }
///
/// impl<T: Real> Formula<T> for Parabola<T> {
///     fn domain(&self) -> [T; 2] {
///         [-T::one(), T::one()]
///     }
///     fn point<N: Over<T>>(&self, k: N) -> (N, N) {
///         (k, k * k / (N::of(2.0) * N::lift(self.radius)))
///     }
/// }
/// ```
pub trait Formula<T: Real>: Send + Sync {
    /// Returns the range of `k`, both ends finite, over which `X` rises or falls strictly.
    fn domain(&self) -> [T; 2];

    /// Returns `(X(k), Y(k))`. If all constants are plain, the bound `N: Real` is enough.
    fn point<N: Over<T>>(&self, k: N) -> (N, N);
}

/// Numbers that contain the numbers of type `T`.
pub trait Over<T>: Real {
    /// Converts the number.
    fn lift(value: T) -> Self;
}

impl<T: Real> Over<T> for T {
    fn lift(value: T) -> Self {
        value
    }
}

/// Numbers by which a [`Formula`] can be differentiated: `f32` and `f64`, and the [`Dual`] numbers
/// of both, so that a solution can have derivatives by parameters of such a curve.
#[diagnostic::on_unimplemented(
    message = "an `Autodiff` profile cannot be differentiated in numbers of type `{Self}`",
    note = "`f32`, `f64`, `Dual<f32>` and `Dual<f64>` can; for others implement `ParametricProfile`, with X' and Y'"
)]
pub trait Differentiable: Real {
    /// Numbers that carry one more derivative.
    type Jet: Over<Self>;

    /// Returns the number as the variable of differentiation.
    fn variable(self) -> Self::Jet;

    /// Returns value and derivative.
    fn value_and_slope(jet: Self::Jet) -> [Self; 2];
}

/// Profile of a [`Formula`].
#[derive(Clone, Copy, Debug)]
pub struct Autodiff<F>(pub F);

impl<T: Differentiable, F: Formula<T>> ParametricProfile<T> for Autodiff<F> {
    fn domain(&self) -> [T; 2] {
        self.0.domain()
    }

    fn at(&self, k: T) -> CurvePoint<T> {
        let (x, y) = self.0.point(k.variable());
        let ([x, dx], [y, dy]) = (T::value_and_slope(x), T::value_and_slope(y));
        CurvePoint { x, y, dx, dy }
    }

    fn x(&self, k: T) -> T {
        self.0.point(k).0
    }

    fn y(&self, k: T) -> T {
        self.0.point(k).1
    }
}

/// Implements the traits for plain numbers and their dual numbers.
macro_rules! plain {
    ($($plain:ty),*) => {$(
        impl Over<$plain> for Dual<$plain> {
            fn lift(value: $plain) -> Self {
                Self::from_re(value)
            }
        }

        impl Differentiable for $plain {
            type Jet = Dual<$plain>;

            fn variable(self) -> Self::Jet {
                Dual::new(self, 1.0)
            }

            fn value_and_slope(jet: Self::Jet) -> [Self; 2] {
                [jet.re, jet.eps]
            }
        }

        // The first derivative of a hyper-dual number is the dual number's own, the second is by k.
        impl Over<Dual<$plain>> for HyperDual<$plain> {
            fn lift(value: Dual<$plain>) -> Self {
                Self::new(value.re, value.eps, 0.0, 0.0)
            }
        }

        impl Differentiable for Dual<$plain> {
            type Jet = HyperDual<$plain>;

            fn variable(self) -> Self::Jet {
                HyperDual::new(self.re, self.eps, 1.0, 0.0)
            }

            fn value_and_slope(jet: Self::Jet) -> [Self; 2] {
                [Dual::new(jet.re, jet.eps1), Dual::new(jet.eps2, jet.eps1eps2)]
            }
        }
    )*};
}
plain!(f32, f64);
