//! Line contact of two bodies, each given as a parametric curve `[X(k), Y(k)]`.
//!
//! Two bodies are pressed together with a load per unit length. This crate finds where they touch,
//! the interval `[-b, a]` of `x` or several, and the pressure `P(x)` between them, for elastic
//! half-planes without friction. Curves stay parametric: no y = f(x) is needed.
//!
//! ```text
//! PV∫ P(s)/(x - s) ds = κ (f₂'(x) - f₁'(x)),   -b < x < a,      ∫ P ds = F
//! f_i'(x) = Y_i'(k)/X_i'(k)   at the k that solves X_i(k) = x
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `x`, `X`, `Y`, `a`, `b` | lengths along and across the contact | free, the same for all |
//! | `k` | parameter of a curve, its own in each body and piece | none |
//! | `P` | pressure, positive in compression | pressure |
//! | `F` | load per unit length; `C = π F` | pressure × length |
//! | κ | `π E*/2`, E* the contact modulus of plane strain | pressure |
//! | `L`, `c` | half-width `(a + b)/2` and centre `(a - b)/2` of the contact | length |
//! | `K_a`, `K_b` | strengths of the edge singularities of `P`, zero at a free edge | pressure |
//!
//! Body 1 is the lower one. The equation numbers in this documentation are those of the paper
//! *An approximate numerical method for solving Cauchy singular integral equations composed of
//! multiple implicit parameter functions with unknown integral limits in contact mechanics*,
//! whose method this crate implements, with three corrections: the integral in Eqs. (7), (9)
//! and (11) carries a minus sign, `C` in Eqs. (9) and (14) is not multiplied by `(a + b)/2`,
//! and Example 2 of the paper has κ = π/2.
//!
//! # Contents
//! - [`profile`]: bodies, from a closure, a struct of your own, built-in shapes, lines and arcs of
//!   a drawing, or joined pieces.
//! - [`check_derivatives`]: a check that X' and Y' written by hand are the derivatives of X and Y.
//!   With the feature `autodiff` they need not be written, and solutions have derivatives by any
//!   parameter.
//! - [`search`]: root finders, for `X(k) = x` and for the limits; bring your own.
//! - [`gap`]: two bodies as one function, the slope of the gap.
//! - [`quadrature`]: from that slope to edge strengths and pressure: panels, and the paper's rule.
//! - [`contact`]: the scene, its edges, and the prescribed quantity. [`Contact::solve`] finds the
//!   number of contacts; [`Solution::report`] lists the starts of the search and the result of each
//!   check.
//! - [`reference`](mod@reference): closed forms to test against.
//! - [`stress`]: the stress below the surface of either body.
//! - [`Material`], [`Solution::approach`], [`Solution::stiffness`], [`SpringTable`]: the approach
//!   of the bodies under load.
//! - [`FiniteRoller`]: a roller of finite length as slices, each with the load of such a table.
//! - [`PartialSlip`]: a tangential force that friction carries.
//! - [`Certificate`]: a proof that a solution is a contact in all of the bodies.
//! - [`Solution`], [`Pressure`], [`Peak`]: results, with [each contact](ContactRegion), moment,
//!   [`LoadRates`], the gap outside the contact and a check of the equation on request. [`Solver`]
//!   solves again and again; with the feature `rayon`, `sweep` solves many scenes on all cores.
//! - [`Summary`]: a solution as a row of numbers. With the feature `serde`, summaries, all plain
//!   data, the settings and the bodies of [`profile`] can be kept in files; a body that is read is
//!   checked as by its constructor. (JSON keeps all digits with the feature `float_roundtrip` of
//!   `serde_json`.)
//!
//! # Example
//! ```
//! use linecontact::{Contact, Control, Curve, CurvePoint, Flat};
//! use std::f64::consts::PI;
//!
//! // A roller of 10 mm radius as a parabola, E* of steel on steel, 500 N/mm: mm, MPa, N/mm.
//! let (radius, modulus, load) = (10.0, 115e3, 500.0);
//! let parabola = Curve::new([-1.0, 1.0], move |k: f64| {
//!     CurvePoint { x: k, y: k * k / (2.0 * radius), dx: 1.0, dy: k / radius }
//! });
//! let contact = Contact::new(&Flat, &parabola)?.contact_modulus(modulus);
//! let solution = contact.solve(Control::Load(load))?;
//! let hertz = (4.0 * load * radius / (PI * modulus)).sqrt(); // 0.235 mm
//! assert!((solution.a() / hertz - 1.0).abs() < 1e-14);
//! assert!((solution.b() / hertz - 1.0).abs() < 1e-14);
//!
//! let pressure = solution.pressure()?;
//! let exact = 2.0 * load / (PI * hertz) * (1.0 - (0.1 / hertz).powi(2)).sqrt(); // 1225 MPa
//! assert!((pressure.at(0.1)? / exact - 1.0).abs() < 1e-14);
//! # Ok::<(), linecontact::ContactError<f64>>(())
//! ```

#![cfg_attr(
    not(test),
    warn(
        unused_qualifications,
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        clippy::cast_sign_loss,
        clippy::print_stderr,
        clippy::print_stdout
    )
)]

#[cfg(feature = "autodiff")]
pub mod autodiff;
mod compiled;
pub mod contact;
mod edge;
mod ends;
mod error;
mod finite_roller;
pub mod gap;
mod interval;
pub mod kernel;
mod material;
mod numerics;
mod pair;
pub mod profile;
pub mod quadrature;
mod real;
pub mod reference;
mod rounded;
#[cfg(feature = "scene")]
pub mod scene;
pub mod search;
mod solution;
mod solve;
mod solver;
mod spring;
#[cfg(feature = "rayon")]
mod sweep;

pub use contact::{Contact, Control, EdgePressure};
pub use edge::Edge;
pub use ends::{Ends, Side};
pub(crate) use error::Fallible;
pub use error::{Body, ContactError, EvaluationError, InputError, SolveError};
pub use finite_roller::{FiniteRoller, RollerSlice, RollerState};
pub use gap::{Cost, Gap};
pub use interval::Interval;
pub use kernel::{RegularKernel, SurfaceCompliance};
pub use material::{Base, Foundation, Layer, Material, PlaneState, Reference, References, Stack};
pub use pair::{Pair, Pose, Wrench};
pub use profile::{Convexity, Piece, ProfileError, check_derivatives};
pub use profile::{Curve, CurvePoint, Flat, ParametricProfile, Piecewise, PiecewiseError};
pub use quadrature::{Estimate, Exponents, Midpoint, Panels};
pub use real::Real;
pub use solution::{Approach, ContactRegion, PartialSlip, Shear, SlipStress, Traction};
pub use solution::{Attempt, Outcome, Report, STEEPEST_HALF_PLANE, Solution, Start, Summary};
pub use solution::{
    Certificate, Conformity, Extremum, LoadRates, Peak, Pressure, Uncertainty, stress,
};
pub use solver::Solver;
pub use spring::{SpringPoint, SpringTable};
#[cfg(feature = "rayon")]
pub use sweep::sweep;

/// Compiles and runs the README's code.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

/// Compiles and runs the guide's code.
#[cfg(doctest)]
#[doc = include_str!("../docs/guide.md")]
struct Guide;
