//! The scene: two bodies, how stiff they are, and how the contact is to be found.

mod edges;
mod first_contact;
mod limits;
mod stride;

pub use edges::EdgePressure;
pub(crate) use limits::Found;

use crate::gap::{Cost, Gap};
use crate::quadrature::{Midpoint, Quadrature};
use crate::search::{Brent, LimitSearch, Newton};
use crate::solution::Solution;
use crate::{ContactError, Interval, ParametricProfile, Real};
use edges::Edges;

/// Two bodies to be pressed together, and the way to find their contact.
///
/// What is not set has a default: κ = 1, limits sought so that the pressure ends at zero
/// ([`Limits::Free`]), [`Newton`] to invert the curves, [`Brent`] to adjust the limits, and the
/// default [`Midpoint`] rule for the pressure. One scene serves any number of loads.
///
/// ```
/// use linecontact::{Contact, Curve, CurvePoint, Flat, Load};
///
/// // A steel roller of 10 mm radius on a steel flat: lengths in m, E* in Pa, load in N/m.
/// let (r, modulus, load) = (0.01, 115e9, 50e3);
/// let roller = Curve::new([-1.0, 1.0], move |k: f64| {
///     let (sin, cos) = k.sin_cos();
///     CurvePoint { x: r * sin, y: r * (1.0 - cos), dx: r * cos, dy: r * sin }
/// });
/// let contact = Contact::new(&Flat, &roller)?.contact_modulus(modulus);
/// let solution = contact.solve(Load::PerLength(load))?;
///
/// // Hertz takes the circle for a parabola, which this roller is to about (a/r)².
/// let hertz = (4.0 * load * r / (std::f64::consts::PI * modulus)).sqrt();
/// assert!((solution.a() / hertz - 1.0).abs() < 1e-3);
/// let peak = solution.pressure()?.at(0.0)?;
/// assert!((peak / (2.0 * load / (std::f64::consts::PI * hertz)) - 1.0).abs() < 1e-3);
/// # Ok::<(), linecontact::ContactError<f64>>(())
/// ```
#[derive(Clone)]
pub struct Contact<'a, T: Real> {
    gap: Gap<'a, T>,
    kappa: T,
    limits: Limits<T>,
    start: Option<Interval<T>>,
    search: &'a dyn LimitSearch<T>,
    quadrature: &'a dyn Quadrature<T>,
}

/// How the limits `-b` and `a` of the contact come about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limits<T> {
    /// They are sought so that the singular parts of the pressure vanish at both edges,
    /// `K_a = K_b = 0`: smooth bodies, and the exact form of the next.
    Free,
    /// They are sought so that the pressure has given values near both edges (Eq. (6)).
    EdgePressure(EdgePressure<T>),
    /// They are known: `[-b, a]` is an interval with fixed edges, such as a punch with sharp
    /// corners. The pressure may be infinite there, and the load any finite number.
    Fixed(Interval<T>),
}

/// The load that presses the bodies together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Load<T> {
    /// F = ∫ P dx, force per unit length.
    PerLength(T),
    /// The paper's constant C = π F.
    Constant(T),
}

impl<T: Real> Load<T> {
    fn per_length(self) -> T {
        match self {
            Self::PerLength(force) => force,
            Self::Constant(c) => c / T::pi(),
        }
    }
}

const NEWTON: Newton = Newton { tolerance: crate::search::Tolerance::FULL };
const BRENT: Brent = Brent { tolerance: crate::search::Tolerance::FULL };
const MIDPOINT: Midpoint = Midpoint::DEFAULT;

impl<'a, T: Real> Contact<'a, T> {
    /// The scene of two bodies, `lower` (body 1) and `upper` (body 2).
    ///
    /// Each smooth body is checked once, with the 39 evaluations of
    /// [`Piece::new`](crate::profile::Piece::new).
    ///
    /// # Errors
    /// [`ContactError::Profile`] for a body that fails the check; [`ContactError::Apart`].
    pub fn new(
        lower: &'a dyn ParametricProfile<T>,
        upper: &'a dyn ParametricProfile<T>,
    ) -> Result<Self, ContactError<T>> {
        Ok(Self {
            gap: Gap::new(lower, upper, &NEWTON)?,
            kappa: T::one(),
            limits: Limits::Free,
            start: None,
            search: &BRENT,
            quadrature: &MIDPOINT,
        })
    }

    /// The scale κ in `PV∫ P(s)/(x - s) ds = κ (f₂' - f₁')`, a pressure. Default 1, the paper's
    /// Eq. (3).
    pub fn kappa(self, kappa: T) -> Self {
        Self { kappa, ..self }
    }

    /// The scale by the contact modulus E* of plane strain, `1/E* = (1 - ν₁²)/E₁ +
    /// (1 - ν₂²)/E₂`: κ = π E*/2 (Johnson, *Contact Mechanics*, 1985, §4.2).
    pub fn contact_modulus(self, modulus: T) -> Self {
        self.kappa(T::frac_pi_2() * modulus)
    }

    /// How the limits come about. Default [`Limits::Free`].
    pub fn limits(self, limits: Limits<T>) -> Self {
        Self { limits, ..self }
    }

    /// Where the search for the limits starts. Without it, or where it is not on the bodies, in
    /// the middle of their common range.
    pub fn start(self, interval: Interval<T>) -> Self {
        Self { start: Some(interval), ..self }
    }

    /// The strategy that inverts `X(k) = x`. Default [`Newton`].
    pub fn inversion(self, strategy: &'a dyn LimitSearch<T>) -> Self {
        Self { gap: self.gap.with_inversion(strategy), ..self }
    }

    /// The strategy that adjusts the limits. Default [`Brent`].
    pub fn search(self, strategy: &'a dyn LimitSearch<T>) -> Self {
        Self { search: strategy, ..self }
    }

    /// The quadrature. Default [`Midpoint::default`].
    pub fn quadrature(self, quadrature: &'a dyn Quadrature<T>) -> Self {
        Self { quadrature, ..self }
    }

    /// Finds the limits of the contact under a load. The pressure is left for
    /// [`Solution::pressure`].
    ///
    /// # Errors
    /// [`ContactError::Load`], [`ContactError::Scale`], [`ContactError::Limits`],
    /// [`ContactError::EdgePressure`], [`ContactError::Segments`] for what was set;
    /// [`ContactError::NoFirstContact`], [`ContactError::TooShort`],
    /// [`ContactError::NoBalance`], [`ContactError::OutsideBodies`] for bodies and loads that
    /// do not go together; [`ContactError::Profile`], [`ContactError::Inversion`] from sampling
    /// the bodies; [`ContactError::LimitSearch`], [`ContactError::EdgePressureNotMet`],
    /// [`ContactError::Overflow`] from the search.
    pub fn solve(&self, load: Load<T>) -> Result<Solution<'_, T>, ContactError<T>> {
        let load = load.per_length();
        let kappa = self.kappa;
        if !(kappa.is_finite() && kappa > T::zero()) {
            return Err(ContactError::Scale { kappa });
        }
        if let Some(start) = self.start {
            check(start)?;
        }
        let mut engine = self.quadrature.prepare(&self.gap)?;
        let mut cost = Cost::default();
        let limits = match self.limits {
            Limits::Fixed(interval) => {
                check(interval)?;
                if !load.is_finite() {
                    return Err(ContactError::Load { load });
                }
                self.check_on_bodies(interval)?;
                limits::Found { interval, strengths: None, error: None }
            }
            Limits::Free => {
                let edges = Edges::Strength { kappa, load };
                limits::find(self, load, edges, &mut *engine, &mut cost)?
            }
            Limits::EdgePressure(wanted) => {
                wanted.check()?;
                let edges = Edges::Pressure { kappa, load, wanted };
                limits::find(self, load, edges, &mut *engine, &mut cost)?
            }
        };
        cost += engine.cost();
        Ok(Solution::new(&self.gap, engine, self.quadrature, kappa, load, limits, cost))
    }

    fn check_on_bodies(&self, interval: Interval<T>) -> Result<(), ContactError<T>> {
        let range = self.gap.range();
        for x in [interval.left, interval.right] {
            if x < range[0] || x > range[1] {
                return Err(ContactError::OutsideBodies { x, range });
            }
        }
        Ok(())
    }
}

fn check<T: Real>(interval: Interval<T>) -> Result<(), ContactError<T>> {
    let Interval { left, right } = interval;
    if left.is_finite() && right.is_finite() && left < right {
        Ok(())
    } else {
        Err(ContactError::Limits { interval })
    }
}

impl<T: Real> std::fmt::Debug for Contact<'_, T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { gap, kappa, limits, start, .. } = self;
        let mut debug = f.debug_struct("Contact");
        debug.field("gap", gap).field("kappa", kappa).field("limits", limits);
        debug.field("start", start).finish_non_exhaustive()
    }
}
