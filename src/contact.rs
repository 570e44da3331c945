//! The scene: two bodies, how stiff they are, and how the contact is to be found.

mod approach;
mod capacity;
mod edge_pressure;
mod edges;
mod first_contact;
mod further;
mod goal;
mod limits;
mod newton;
mod peak;
mod pull;
mod sketch;
mod stretch;
mod stride;

pub use edge_pressure::EdgePressure;
pub use edges::Edge;
pub(crate) use peak::peak;

use crate::gap::{Cost, Gap};
use crate::quadrature::{Engine, Moments, Panels, Quadrature, Trend};
use crate::search::{Brent, LimitSearch, Newton};
use crate::solution::{Solution, Worker};
use crate::{ContactError, Interval, ParametricProfile, Real, Solver};
use edges::{Conditions, Control};
use goal::Goal;

/// Two bodies to be pressed together, and the way to find their contact.
///
/// What is not set has a default: κ = 1, limits sought so that the pressure ends at zero
/// ([`Edge::Free`]), [`Newton`] to invert the curves, Newton's method on both limits at once, and
/// [`Panels`] for the integrals. One scene serves any number of loads.
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
    edges: [Edge<T>; 2],
    edge_pressure: Option<EdgePressure<T>>,
    start: Option<Interval<T>>,
    search: Option<&'a dyn LimitSearch<T>>,
    quadrature: &'a dyn Quadrature<T>,
    certified: bool,
}

/// What presses the bodies together: a load, or as much as it takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Load<T> {
    /// F = ∫ P dx, force per unit length.
    PerLength(T),
    /// The paper's constant C = π F.
    Constant(T),
    /// As much as it takes to make the contact this wide: the half-width L = (a + b)/2.
    ToHalfWidth(T),
    /// As much as it takes for this largest pressure, between edges where the pressure is
    /// bounded.
    ToPeak(T),
}

/// A contact that was found.
#[derive(Clone, Copy)]
pub(crate) struct Found<T> {
    pub interval: Interval<T>,
    pub load: T,
    /// K_a and K_b.
    pub strengths: [T; 2],
    /// Whether they vanish at a and at -b, being what the limits were sought by.
    pub free: [bool; 2],
    /// Whether the bodies may pull at each other.
    pub adhesive: [bool; 2],
    /// Estimated error of the limits relative to the half-width, where they were sought.
    pub error: Option<T>,
    /// The load that such an error stands for, where it is known.
    pub force: Option<T>,
    /// How the edge integrals change with the limits, where that is known.
    pub trend: Option<Trend<T>>,
    /// Where the bodies end: at corners, or with their common range.
    pub ends: [T; 2],
}

impl<T: Real> Found<T> {
    fn new(
        conditions: &Conditions<T>,
        interval: Interval<T>,
        load: T,
        error: Option<T>,
        m: &Moments<T>,
    ) -> Self {
        let kappa = conditions.kappa;
        let [free_b, free_a] = conditions.edges.map(|edge| edge.is_free());
        let mean_pressure = load / interval.half_width();
        let strength = |sum: T| (mean_pressure - kappa * sum) / T::pi();
        let strengths = [strength(m.first + m.mean), strength(m.first - m.mean)];
        let [at_b, at_a] = conditions.edges.map(|edge| matches!(edge, Edge::Adhesive(_)));
        let (free, adhesive) = ([free_a, free_b], [at_a, at_b]);
        let ends = [interval.left, interval.right];
        let (force, trend) = (None, m.trend);
        Self { interval, load, strengths, free, adhesive, error, force, trend, ends }
    }
}

const NEWTON: Newton = Newton { tolerance: crate::search::Tolerance::FULL };
const BRENT: Brent = Brent { tolerance: crate::search::Tolerance::FULL };
const PANELS: Panels = Panels::FULL;

impl<'a, T: Real> Contact<'a, T> {
    /// The scene of two bodies, `lower` (body 1) and `upper` (body 2).
    ///
    /// Of each smooth body the two ends are looked at. [`Piece::checked`](crate::profile::Piece::checked)
    /// looks at all of it, for a profile just written.
    ///
    /// # Errors
    /// [`ContactError::Profile`], [`ContactError::Apart`].
    pub fn new(
        lower: &'a dyn ParametricProfile<T>,
        upper: &'a dyn ParametricProfile<T>,
    ) -> Result<Self, ContactError<T>> {
        Ok(Self {
            gap: Gap::new(lower, upper, &NEWTON)?,
            kappa: T::one(),
            edges: [Edge::Free; 2],
            edge_pressure: None,
            start: None,
            search: None,
            quadrature: &PANELS,
            certified: false,
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

    /// What becomes of the two edges, at `-b` and at `a`. Default: both are [`Edge::Free`].
    pub fn edges(self, left: Edge<T>, right: Edge<T>) -> Self {
        Self { edges: [left, right], edge_pressure: None, ..self }
    }

    /// Edges where the pressure has given values at given distances from the limits: the paper's
    /// Eq. (6), in place of [`edges`](Self::edges), under a given load.
    pub fn edge_pressure(self, wanted: EdgePressure<T>) -> Self {
        Self { edge_pressure: Some(wanted), ..self }
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

    /// A strategy that adjusts the limits, one at a time, in place of Newton's method on both.
    pub fn search(self, strategy: &'a dyn LimitSearch<T>) -> Self {
        Self { search: Some(strategy), ..self }
    }

    /// The quadrature. Default [`Panels`].
    pub fn quadrature(self, quadrature: &'a dyn Quadrature<T>) -> Self {
        Self { quadrature, ..self }
    }

    /// Whether a solution must be a contact in all of the bodies: then solving ends with
    /// [`Solution::certify`], and its errors. Default: no, since that samples all of the bodies, which
    /// takes far longer than the contact itself.
    pub fn certified(self, certified: bool) -> Self {
        Self { certified, ..self }
    }

    /// Finds the limits of the contact under a load. The pressure is left for
    /// [`Solution::pressure`].
    ///
    /// # Errors
    /// [`ContactError::Load`], [`ContactError::Scale`], [`ContactError::Limits`],
    /// [`ContactError::Adhesion`], [`ContactError::EdgePressure`],
    /// [`ContactError::EdgePressureLoad`], [`ContactError::Control`], [`ContactError::PeakEdge`],
    /// [`ContactError::Segments`], [`ContactError::Tolerance`] for what was set;
    /// [`ContactError::NoFirstContact`], [`ContactError::TooShort`],
    /// [`ContactError::TooWide`], [`ContactError::PeakTooHigh`], [`ContactError::NoBalance`],
    /// [`ContactError::OutsideBodies`], [`ContactError::PullOff`] for bodies and loads that do not go together; [`ContactError::Profile`],
    /// [`ContactError::Inversion`] from sampling the bodies; [`ContactError::LimitSearch`],
    /// [`ContactError::EdgePressureNotMet`], [`ContactError::Overflow`],
    /// [`ContactError::NoPeak`], [`ContactError::Evaluations`] from the search; where [`certified`](Self::certified), those of
    /// [`Solution::certify`].
    pub fn solve(&self, load: Load<T>) -> Result<Solution<'_, T>, ContactError<T>> {
        let mut engine = self.quadrature.engine()?;
        let (found, cost) = self.find(&mut *engine, None, load)?;
        self.approved(Solution::new(&self.gap, Worker::Own(engine), self.kappa, found, cost))
    }

    /// A solver that solves again and again without starting afresh, for this scene and for
    /// others like it.
    ///
    /// # Errors
    /// [`ContactError::Segments`], [`ContactError::Tolerance`].
    pub fn solver(&self) -> Result<Solver<T>, ContactError<T>> {
        Solver::with(self.quadrature)
    }

    /// The solution, if it need not be a contact or is one.
    pub(crate) fn approved<'s>(
        &self,
        solution: Solution<'s, T>,
    ) -> Result<Solution<'s, T>, ContactError<T>> {
        if self.certified {
            solution.certify()?;
        }
        Ok(solution)
    }

    pub(crate) fn gap(&self) -> &Gap<'a, T> {
        &self.gap
    }

    pub(crate) fn scale(&self) -> T {
        self.kappa
    }

    /// Finds the limits with an engine that has been reset, from a contact like this one.
    pub(crate) fn find(
        &self,
        engine: &mut dyn Engine<T>,
        warm: Option<Interval<T>>,
        load: Load<T>,
    ) -> Result<(Found<T>, Cost), ContactError<T>> {
        let kappa = self.kappa;
        if !(kappa.is_finite() && kappa > T::zero()) {
            return Err(ContactError::Scale { kappa });
        }
        if let Some(start) = self.start {
            check(start)?;
        }
        let by_load = matches!(load, Load::PerLength(_) | Load::Constant(_));
        if self.edge_pressure.is_some() && !by_load {
            return Err(ContactError::EdgePressureLoad);
        }
        let mut cost = Cost::default();
        let mut found = match load {
            Load::PerLength(load) => self.under(engine, warm, load, &mut cost)?,
            Load::Constant(c) => self.under(engine, warm, c / T::pi(), &mut cost)?,
            Load::ToHalfWidth(half_width) => {
                if !(half_width.is_finite() && half_width > T::zero()) {
                    return Err(ContactError::Load { load: half_width });
                }
                let control = Control::HalfWidth(half_width);
                let conditions = Conditions { kappa, edges: self.checked_edges()?, control };
                approach::find(self, conditions, engine, warm, &mut cost)?
            }
            Load::ToPeak(pressure) => {
                if !(pressure.is_finite() && pressure > T::zero()) {
                    return Err(ContactError::Load { load: pressure });
                }
                peak::find(self, pressure, engine, warm, &mut cost)?
            }
        };
        // A width may be less than the rounding of x, and its load less than any number.
        check(found.interval)?;
        if found.strengths.iter().any(|strength| !strength.is_finite()) {
            return Err(ContactError::Overflow { interval: found.interval });
        }
        let known = found.error.is_none_or(|error| error >= T::zero());
        if !known && found.adhesive == [false; 2] {
            return Err(ContactError::Overflow { interval: found.interval });
        }
        found.ends = self.ends();
        engine.prepare(&self.gap, found.interval)?;
        cost += engine.cost();
        Ok((found, cost))
    }

    /// The contact under a given load.
    fn under(
        &self,
        engine: &mut dyn Engine<T>,
        warm: Option<Interval<T>>,
        load: T,
        cost: &mut Cost,
    ) -> Result<Found<T>, ContactError<T>> {
        let kappa = self.kappa;
        if let Some(wanted) = self.edge_pressure {
            wanted.check()?;
            if !(load.is_finite() && load > T::zero()) {
                return Err(ContactError::Load { load });
            }
            let goal = Goal::Pressure { kappa, load, wanted };
            let nested = limits::find(self, load, goal, engine, self.start, cost)?;
            let m = engine.moments(&self.gap, nested.on)?;
            let control = Control::Load(load);
            let conditions = Conditions { kappa, edges: [Edge::Fixed(load); 2], control };
            return Ok(Found::new(&conditions, nested.on, load, Some(nested.error), &m));
        }
        let edges = self.checked_edges()?;
        let conditions = Conditions { kappa, edges, control: Control::Load(load) };
        let sought = edges.iter().any(|edge| edge.is_free());
        let adhesive = edges.iter().any(|edge| matches!(edge, Edge::Adhesive(_)));
        if !load.is_finite() || (sought && !adhesive && load <= T::zero()) {
            return Err(ContactError::Load { load });
        }
        approach::find(self, conditions, engine, warm, cost)
    }

    /// Where the bodies end. A corner ends them.
    fn ends(&self) -> [T; 2] {
        let [left, right] = self.gap.range();
        let corner = |edge: Edge<T>| match edge {
            Edge::Fixed(x) | Edge::UpTo(x) if self.edge_pressure.is_none() => Some(x),
            _ => None,
        };
        let [first, last] = self.edges.map(corner);
        [first.map_or(left, |x| x.max(left)), last.map_or(right, |x| x.min(right))]
    }

    fn checked_edges(&self) -> Result<[Edge<T>; 2], ContactError<T>> {
        for edge in self.edges {
            match edge {
                Edge::Adhesive(work) if !(work.is_finite() && work >= T::zero()) => {
                    return Err(ContactError::Adhesion { work });
                }
                Edge::Fixed(x) | Edge::UpTo(x) if !x.is_finite() => {
                    let [left, right] = [x, x];
                    return Err(ContactError::Limits { interval: Interval { left, right } });
                }
                _ => {}
            }
        }
        Ok(self.edges)
    }

    /// The strategy of the nested search.
    fn strategy(&self) -> &dyn LimitSearch<T> {
        self.search.unwrap_or(&BRENT)
    }
}

/// Whether an interval lies in a range, up to the rounding of its limits.
fn check_within<T: Real>(
    Interval { left, right }: Interval<T>,
    range: [T; 2],
    rounding: T,
) -> Result<(), ContactError<T>> {
    for (x, beyond) in [(left, range[0] - left), (right, right - range[1])] {
        if beyond > rounding {
            return Err(ContactError::OutsideBodies { x, range });
        }
    }
    Ok(())
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
        let Self { gap, kappa, edges, start, .. } = self;
        let mut debug = f.debug_struct("Contact");
        debug.field("gap", gap).field("kappa", kappa).field("edges", edges);
        debug.field("start", start).finish_non_exhaustive()
    }
}
