//! The scene: two bodies, their stiffness, and the settings of the solve.

mod beside;
mod control;
mod edge_pressure;
pub(crate) mod edges;

pub use crate::edge::Edge;
pub use control::Control;
pub use edge_pressure::EdgePressure;

use crate::error::is_subnormal;
use crate::gap::{Cost, Gap, GapId, Shape};
use crate::kernel::{Formula, Kernel, Layers, RegularKernel, SurfaceCompliance};
use crate::material::{Elasticity, Foundation, PlaneState};
use crate::quadrature::{Panels, Quadrature};
use crate::search::{Brent, LimitSearch, Newton};
use crate::{
    ContactError, Ends, Fallible, InputError, Interval, ParametricProfile, Real, References,
    SolveError,
};
use beside::Beside;
use edges::{Conditions, Given};
use std::ops::ControlFlow;
use std::sync::{Arc, OnceLock};

/// Conditions on a load: where limits are sought, and between two corners.
const POSITIVE: &str = "positive where limits are sought";
const HELD: &str = "positive between two corners; single_interval(true) allows any sign, and gives \
    the pressure unchecked";

/// Two bodies to be pressed together, and the settings by which their contact is found.
///
/// Every setting has a default: κ = 1, limits at which the pressure ends at zero ([`Edge::Free`]),
/// [`Newton`] to invert the curves, Newton's method on both limits at once, and [`Panels`] for the
/// integrals. One scene serves any number of loads.
///
/// ```
/// use linecontact::{Contact, Control, Curve, CurvePoint, Flat};
///
/// // A steel roller of 10 mm radius on a steel flat: lengths in m, E* in Pa, load in N/m.
/// let (r, modulus, load) = (0.01, 115e9, 50e3);
/// let roller = Curve::new([-1.0, 1.0], move |k: f64| {
///     let (sin, cos) = k.sin_cos();
///     CurvePoint { x: r * sin, y: r * (1.0 - cos), dx: r * cos, dy: r * sin }
/// });
/// let contact = Contact::new(&Flat, &roller)?.contact_modulus(modulus);
/// let solution = contact.solve(Control::Load(load))?;
///
/// // Hertz takes the circle for a parabola, which this roller is to about (a/r)².
/// let hertz = (4.0 * load * r / (std::f64::consts::PI * modulus)).sqrt();
/// assert!((solution.a() / hertz - 1.0).abs() < 1e-3);
/// let peak = solution.pressure()?.at(0.0)?;
/// assert!((peak / (2.0 * load / (std::f64::consts::PI * hertz)) - 1.0).abs() < 1e-3);
/// # Ok::<(), linecontact::ContactError<f64>>(())
/// ```
#[derive(Clone)]
pub struct Contact<'b, T: Real> {
    pub(crate) gap: Gap<'b, T>,
    pub(crate) kappa: T,
    stiffness: Stiffness<T>,
    pub(crate) edges: Ends<Edge<T>>,
    pub(crate) edge_pressure: Option<EdgePressure<T>>,
    pub(crate) start: Option<Interval<T>>,
    pub(crate) search: Option<&'b dyn LimitSearch<T>>,
    pub(crate) quadrature: &'b dyn Quadrature<T>,
    pub(crate) certified: bool,
    pub(crate) single_interval: bool,
    /// Flag: no narrow features are looked for, on the way to a bend.
    pub(crate) is_trial: bool,
    /// What the bodies have beside half-planes.
    pub(crate) beside: Beside<'b, T>,
}

/// Source of κ.
#[derive(Clone)]
enum Stiffness<T> {
    Default,
    Kappa,
    /// E* as given.
    Modulus(T),
    /// Materials of the bodies, as given.
    Materials([Foundation<T>; 2], PlaneState),
}

impl<'b, T: Real> Contact<'b, T> {
    /// Creates the scene of two bodies, `lower` (body 1) and `upper` (body 2).
    ///
    /// Only the two ends of each smooth body are checked.
    /// [`Piece::checked`](crate::profile::Piece::checked) checks all of it, for a profile just
    /// written.
    ///
    /// # Errors
    /// [`InputError::Profile`], [`InputError::NoCommonRange`].
    pub fn new(
        lower: &'b dyn ParametricProfile<T>,
        upper: &'b dyn ParametricProfile<T>,
    ) -> Result<Self, ContactError<T>> {
        Self::of(Shape::Lent(lower), Shape::Lent(upper))
    }

    /// Creates the scene with bodies that it owns, and its solutions with it: a function that makes
    /// the bodies can return a `Solution<'static, T>`.
    ///
    /// ```
    /// use linecontact::{Contact, ContactError, Control, Curve, CurvePoint, Flat, Solution};
    /// use std::sync::Arc;
    ///
    /// fn roller(radius: f64, load: f64) -> Result<Solution<'static, f64>, ContactError<f64>> {
    ///     let arc = Curve::new([-1.0, 1.0], move |k: f64| {
    ///         let (sin, cos) = k.sin_cos();
    ///         CurvePoint {
    ///             x: radius * sin,
    ///             y: radius * (1.0 - cos),
    ///             dx: radius * cos,
    ///             dy: radius * sin,
    ///         }
    ///     });
    ///     Contact::owned(Arc::new(Flat), Arc::new(arc))?.solve(Control::Load(load))
    /// }
    /// let pressure = roller(1.0, 0.02)?.pressure()?.at(0.0)?;
    /// assert!(pressure > 0.0);
    /// # Ok::<(), ContactError<f64>>(())
    /// ```
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn owned(
        lower: Arc<dyn ParametricProfile<T>>,
        upper: Arc<dyn ParametricProfile<T>>,
    ) -> Result<Self, ContactError<T>> {
        Self::of(Shape::Owned(lower), Shape::Owned(upper))
    }

    fn of(lower: Shape<'b, T>, upper: Shape<'b, T>) -> Fallible<T, Self> {
        Ok(Self {
            gap: Gap::new(lower, upper, &Newton::DEFAULT)?,
            kappa: T::one(),
            stiffness: Stiffness::Default,
            edges: Ends::both(Edge::Free),
            edge_pressure: None,
            start: None,
            search: None,
            quadrature: &Panels::FULL,
            certified: false,
            single_interval: false,
            is_trial: false,
            beside: Beside::default(),
        })
    }

    /// Sets the scale κ in `PV∫ P(s)/(x - s) ds = κ (f₂' - f₁')`, a pressure. Default 1, the
    /// paper's Eq. (3).
    #[must_use]
    pub fn kappa(self, kappa: T) -> Self {
        self.stiff(kappa, Stiffness::Kappa)
    }

    /// Sets κ = π E*/2 from the contact modulus E* of plane strain,
    /// `1/E* = (1 - ν₁²)/E₁ + (1 - ν₂²)/E₂` (Johnson, *Contact Mechanics*, 1985, §4.2).
    #[must_use]
    pub fn contact_modulus(self, modulus: T) -> Self {
        self.stiff(T::frac_pi_2() * modulus, Stiffness::Modulus(modulus))
    }

    /// Sets κ from the materials of body 1 and body 2. They give E*, and the
    /// [approach](crate::Solution::approach) depends on them too.
    ///
    /// ```
    /// use linecontact::profile::Parabola;
    /// use linecontact::{Contact, Control, Flat, Material, PlaneState};
    ///
    /// // A steel roller on aluminium: mm, MPa, N/mm.
    /// let roller = Parabola::new(10.0, [-1.0, 1.0])?;
    /// let (aluminium, steel) = (Material::elastic(70e3, 0.33), Material::elastic(210e3, 0.3));
    /// let contact = Contact::new(&Flat, &roller)?.materials(aluminium, steel, PlaneState::Strain);
    /// let modulus: f64 = 1.0 / ((1.0 - 0.33 * 0.33) / 70e3 + (1.0 - 0.09) / 210e3);
    /// let hertz = (4.0 * 500.0 * 10.0 / (std::f64::consts::PI * modulus)).sqrt();
    /// assert!((contact.solve(Control::Load(500.0))?.a() / hertz - 1.0).abs() < 1e-14);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn materials(
        self,
        lower: impl Into<Foundation<T>>,
        upper: impl Into<Foundation<T>>,
        state: PlaneState,
    ) -> Self {
        let materials = [lower.into(), upper.into()];
        // The solve reports what is wrong with the materials.
        let modulus = Elasticity::of_bodies(&materials, state).map(|(_, modulus)| modulus);
        let kappa = T::frac_pi_2() * modulus.unwrap_or(T::one());
        self.stiff(kappa, Stiffness::Materials(materials, state))
    }

    fn stiff(self, kappa: T, stiffness: Stiffness<T>) -> Self {
        let beside = Beside { table: OnceLock::new(), ..self.beside };
        Self { kappa, stiffness, beside, ..self }
    }

    /// Adds a regular kernel K(x, s) to the equation of the contact, the paper's Eq. (1):
    ///
    /// ```text
    /// PV∫ P(s)/(x - s) ds + ∫ K(x, s) P(s) ds = κ (f₂' - f₁')
    /// ```
    ///
    /// Layers of the [materials](Self::materials) add to it.
    #[must_use]
    pub fn kernel(mut self, kernel: &'b dyn RegularKernel<T>) -> Self {
        self.beside.formula = Some(Formula::Lent(kernel));
        self
    }

    /// Adds a regular kernel that the scene owns: see [`kernel`](Self::kernel).
    #[must_use]
    pub fn owned_kernel(mut self, kernel: Arc<dyn RegularKernel<T>>) -> Self {
        self.beside.formula = Some(Formula::Owned(kernel));
        self
    }

    /// Adds a compliance by wavenumber to that of half-planes and layers.
    #[must_use]
    pub fn compliance(mut self, compliance: Arc<dyn SurfaceCompliance<T>>) -> Self {
        self.beside =
            Beside { compliance: Some(compliance), table: OnceLock::new(), ..self.beside };
        self
    }

    /// Makes both bodies repeat with this period along x. Each is described over one period, with
    /// the same height and slope at both ends, or is a [`Flat`](crate::Flat); two such periods must
    /// overlap. The load, its derivatives and the moment are those of one period.
    ///
    /// Results are those of one period from a place that the solve chooses between two contacts, so
    /// a contact may go on beyond the end of the description. Pressures and gaps may be asked for
    /// at any x. The [approach](crate::Solution::approach) is that of the mean planes of both
    /// surfaces since first touch, without references. The edges must be free.
    ///
    /// ```
    /// use linecontact::{Contact, Control, Curve, CurvePoint, Flat};
    /// use std::f64::consts::{PI, TAU};
    ///
    /// // Waves of height 0.04 and length 1: Westergaard's contact.
    /// let waves = Curve::new([-0.5, 0.5], |x: f64| {
    ///     let (sin, cos) = (TAU * x).sin_cos();
    ///     CurvePoint { x, y: 0.02 * (1.0 - cos), dx: 1.0, dy: 0.02 * TAU * sin }
    /// });
    /// let contact = Contact::new(&Flat, &waves)?.contact_modulus(1.0).period(1.0);
    /// let solution = contact.solve(Control::Load(0.01))?;
    /// let a = (0.01f64 / (0.02 * PI)).sqrt().asin() / PI;
    /// assert!((solution.a() - a).abs() < 1e-14);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn period(mut self, period: T) -> Self {
        self.beside = Beside { period: Some(period), table: OnceLock::new(), ..self.beside };
        self
    }

    /// Returns the identity of the bodies, and their period.
    pub(crate) fn bodies(&self) -> (GapId<T>, Option<T>) {
        (self.gap.id(), self.beside.period)
    }

    /// Returns the scene with its bodies repeated, if they have a period.
    pub(crate) fn repeated(&self, cost: &mut Cost) -> Fallible<T, Option<Box<Self>>> {
        let Some(period) = self.beside.period else { return Ok(None) };
        Ok(Some(Box::new(Self { gap: self.gap.repeated(period, cost)?, ..self.clone() })))
    }

    /// Sets the conditions at the left edge, -b, and at the right edge, a. Default: [`Edge::Free`].
    /// A place beyond an end of the bodies by a few roundings is that end.
    #[must_use]
    pub fn edges(self, left: Edge<T>, right: Edge<T>) -> Self {
        let ends = Ends::from(self.gap.range());
        let edges = Ends { left, right }.zip(ends).map(|(edge, end)| edge.moved_to(end));
        Self { edges, edge_pressure: None, ..self }
    }

    /// Prescribes the pressure at given distances from the limits: the paper's Eq. (6), in place of
    /// [`edges`](Self::edges), under a given load.
    #[must_use]
    pub fn edge_pressure(self, wanted: EdgePressure<T>) -> Self {
        Self { edge_pressure: Some(wanted), ..self }
    }

    /// Sets the interval from which the search for the limits starts. Without it, or if it is not
    /// on the bodies, the search starts at their lowest gap; if the bodies declare that they
    /// [bulge](crate::Convexity) towards each other, in the middle of their common range.
    #[must_use]
    pub fn start(self, interval: Interval<T>) -> Self {
        Self { start: Some(interval), ..self }
    }

    /// Sets the strategy that inverts `X(k) = x`: `&Bisection::DEFAULT`, say. Default [`Newton`].
    /// With [`Panels`] it is hardly called for the slope, which is not needed at a prescribed x;
    /// its calls for heights count as [`Cost::heights`].
    #[must_use]
    pub fn inversion(self, strategy: &'b dyn LimitSearch<T>) -> Self {
        Self { gap: self.gap.with_inversion(strategy), ..self }
    }

    /// Sets a strategy that adjusts the limits, one at a time, in place of Newton's method on both:
    /// `&Brent::DEFAULT`, say.
    #[must_use]
    pub fn limit_search(self, strategy: &'b dyn LimitSearch<T>) -> Self {
        Self { search: Some(strategy), ..self }
    }

    /// Sets the quadrature: `&Midpoint::DEFAULT`, say. Default [`Panels::FULL`]. A
    /// [`Solver`](crate::Solver) that has solved with another quadrature changes to this one.
    #[must_use]
    pub fn quadrature(self, quadrature: &'b dyn Quadrature<T>) -> Self {
        Self { quadrature, ..self }
    }

    /// Sets a function that watches a solve, and may end it. It is called with the cost so far and
    /// the span of `x` last sampled, each time that the bodies are sampled and before each new set
    /// of contacts is tried. If it returns `ControlFlow::Break`, the solve ends with
    /// [`SolveError::Cancelled`]; so does the search for the [largest
    /// stress](crate::stress::Subsurface::max_shear) below a solution.
    ///
    /// ```
    /// use linecontact::profile::Parabola;
    /// use linecontact::{Contact, ContactError, Control, Flat, SolveError};
    /// use std::ops::ControlFlow;
    ///
    /// let parabola = Parabola::new(1.0, [-1.0, 1.0])?;
    /// let stop = |_, _| ControlFlow::Break(());
    /// let contact = Contact::new(&Flat, &parabola)?.watch(&stop);
    /// let error = contact.solve(Control::Load(0.02)).map(|_| ()).unwrap_err();
    /// assert!(matches!(error, ContactError::Solve(SolveError::Cancelled { .. })));
    /// # Ok::<(), ContactError<f64>>(())
    /// ```
    #[must_use]
    pub fn watch(self, watch: &'b (dyn Fn(Cost, Interval<T>) -> ControlFlow<()> + Sync)) -> Self {
        Self { gap: self.gap.with_watch(watch), ..self }
    }

    /// Makes `solve` also run [`Solution::certify`](crate::Solution::certify), and fail with its
    /// errors. Default: false, since the certificate samples all of the bodies, which takes far
    /// longer than the contact itself.
    #[must_use]
    pub fn certified(self, certified: bool) -> Self {
        Self { certified, ..self }
    }

    /// Sets the narrowest feature of the bodies to be seen, a length along x: a bump or a dent of
    /// this length from end to end, or of this width at half its height.
    ///
    /// By default the solve sees Gaussian bumps and dents whose width at half their height is at
    /// least 2 % of the contact, in it or up to a half-width beside, provided that they change the
    /// peak pressure by 1 %; outside the contacts it samples at most 1024 points for one load. With
    /// a resolution, samples are less than half the resolution apart all over the bodies, and no
    /// further apart than by default in the contacts and as far as the load reaches. So at least
    /// two of them lie in a feature of that length. In a contact a feature is seen if it changes
    /// the slope at one of them by more than the uncertainty of the samples, or the height from
    /// one to the next; outside, if it changes the height by 1e-7 F/κ or more.
    ///
    /// The number of evaluations is proportional to the length of the bodies over the resolution
    /// ([`Cost::heights`]). Of bodies that would take more than a million,
    /// [`InputError::InvalidResolution`] says the length that they can have. The sampling does
    /// not depend on the declared [convexity](crate::Convexity), except on pieces that are
    /// [`Straight`](crate::Convexity::Straight). The resolution does not apply with
    /// [`single_interval`](Self::single_interval), which checks nothing, nor in contacts with other
    /// quadratures than [`Panels`].
    ///
    /// ```
    /// use linecontact::{Contact, Control, Curve, CurvePoint, Flat};
    ///
    /// // A parabola with a burr of 0.001 from end to end beside the contact.
    /// let body = Curve::new([-1.0, 1.0], |k: f64| {
    ///     let s = (k - 0.2303) / 0.0005;
    ///     let rest = (1.0 - s * s).max(0.0);
    ///     let (burr, slope) = (0.01 * rest.powi(3), -0.06 * s * rest.powi(2) / 0.0005);
    ///     CurvePoint { x: k, y: 0.5 * k * k - burr, dx: 1.0, dy: k - slope }
    /// });
    /// let contact = Contact::new(&Flat, &body)?;
    /// let load = Control::Load(0.02);
    /// assert_eq!(contact.solve(load)?.intervals().len(), 1);
    /// assert_eq!(contact.resolution(0.001).solve(load)?.intervals().len(), 2);
    /// # Ok::<(), linecontact::ContactError<f64>>(())
    /// ```
    #[must_use]
    pub fn resolution(self, length: T) -> Self {
        self.with_resolution(Some(length))
    }

    /// Sets the narrowest feature to be seen; `None` for the default.
    pub(crate) fn with_resolution(self, length: Option<T>) -> Self {
        Self { gap: self.gap.with_resolution(length), ..self }
    }

    /// Makes `solve` treat the contact as one interval, and return it unchecked, as the paper does.
    /// The solution may have tension inside or at a [corner](Edge::Fixed), or overlap outside; its
    /// outcome is [`Outcome::Unchecked`](crate::Outcome::Unchecked). Between two corners any load
    /// is allowed, a tensile one too. Default: false; then the contact of the bodies is found, in
    /// one interval or several.
    #[must_use]
    pub fn single_interval(self, single_interval: bool) -> Self {
        Self { single_interval, ..self }
    }

    /// Returns the elasticity of both bodies, if it is known.
    pub(crate) fn elasticity(&self) -> Fallible<T, Option<[Elasticity<T>; 2]>> {
        let Stiffness::Materials(materials, state) = &self.stiffness else { return Ok(None) };
        Ok(Some(Elasticity::of_bodies(materials, *state)?.0))
    }

    /// Returns what the bodies have beside half-planes, if anything.
    pub(crate) fn kernel_of_bodies(&self) -> Fallible<T, Option<Box<Kernel<'b, T>>>> {
        let is_layer = |of: &Foundation<T>| !matches!(of, Foundation::HalfPlane(_));
        let has_layer =
            matches!(&self.stiffness, Stiffness::Materials(of, _) if of.iter().any(is_layer));
        if !has_layer && self.beside.is_empty() {
            return Ok(None);
        }
        self.beside.kernel(self.elasticity()?.and_then(|bodies| Layers::of(&bodies)))
    }

    /// Checks the settings of the scene.
    pub(crate) fn check(&self, control: Control<T>) -> Fallible<T, ()> {
        self.elasticity()?;
        let kappa = self.kappa;
        if !(kappa.is_finite() && kappa > T::zero()) {
            let fault = match self.stiffness {
                Stiffness::Modulus(modulus) => InputError::InvalidModulus { modulus },
                _ => InputError::InvalidKappa { kappa },
            };
            return Err(fault.into());
        }
        if let Some(start) = self.start {
            check(start)?;
        }
        self.gap.check_resolution(T::zero())?;
        if let Some(period) = self.beside.period
            && !(period.is_finite() && period > T::zero())
        {
            return Err(InputError::InvalidPeriod { period }.into());
        }
        if self.edge_pressure.is_some() && !matches!(control, Control::Load(_)) {
            return Err(InputError::EdgePressureLoad.into());
        }
        Ok(())
    }

    /// Tells whether κ is the default, set by nobody.
    pub(crate) fn has_default_stiffness(&self) -> bool {
        matches!(self.stiffness, Stiffness::Default)
    }

    /// Returns the conditions under a given load.
    pub(crate) fn under(&self, load: T) -> Fallible<T, Conditions<T>> {
        let edges = self.checked_edges()?;
        // Adhesion can bear a tensile load, and so can an interval that is not checked.
        let may_pull = edges.are_adhesive() || self.single_interval && !edges.are_sought();
        let must = if edges.are_sought() { POSITIVE } else { HELD };
        check_given("load", load, may_pull || is_positive(load), must)?;
        Ok(Conditions { kappa: self.kappa, edges, given: Given::Load(load) })
    }

    /// Returns the ends of the bodies. A corner counts as an end.
    pub(crate) fn ends(&self) -> Ends<T> {
        self.ends_of(&self.gap)
    }

    /// Returns the ends of the bodies as they are in a gap.
    pub(crate) fn ends_of(&self, gap: &Gap<'_, T>) -> Ends<T> {
        let range = gap.range();
        let Ends { left, right } = self.corners(range);
        Ends { left: left.max(range[0]), right: right.min(range[1]) }
    }

    /// Returns the corners, in place of the ends of the bodies.
    fn corners(&self, ends: [T; 2]) -> Ends<T> {
        self.edges.zip(ends.into()).map(|(edge, end)| match edge {
            Edge::Fixed(x) | Edge::FreeUntil(x) if self.edge_pressure.is_none() => x,
            _ => end,
        })
    }

    pub(crate) fn checked_edges(&self) -> Fallible<T, Ends<Edge<T>>> {
        let range = self.gap.range();
        let Ends { left, right } = self.corners(range);
        for edge in self.edges {
            match edge {
                Edge::Adhesive(work) if !(work.is_finite() && work >= T::zero()) => {
                    return Err(InputError::InvalidAdhesion { work }.into());
                }
                Edge::Fixed(x) | Edge::FreeUntil(x) if !x.is_finite() => {
                    let interval = Interval { left, right };
                    return Err(InputError::InvalidLimits { interval }.into());
                }
                _ => {}
            }
        }
        if let Ends { left: Edge::Fixed(left), right: Edge::Fixed(right) } = self.edges {
            check(Interval { left, right })?;
        }
        for edge in self.edges {
            if let Edge::Fixed(x) | Edge::FreeUntil(x) = edge
                && !(x >= range[0] && x <= range[1])
            {
                return Err(SolveError::OutsideBodies { x, range }.into());
            }
        }
        Ok(self.edges)
    }

    /// Returns the strategy of the nested search.
    pub(crate) fn strategy(&self) -> &dyn LimitSearch<T> {
        self.search.unwrap_or(&Brent::DEFAULT)
    }
}

/// Checks that a number can be prescribed where limits are sought.
pub(crate) fn check_positive<T: Real>(quantity: &'static str, value: T) -> Fallible<T, ()> {
    check_given(quantity, value, is_positive(value), POSITIVE)
}

/// Checks that a number is finite, and what else it must be.
pub(crate) fn check_given<T: Real>(
    quantity: &'static str,
    value: T,
    is_right: bool,
    must: &'static str,
) -> Fallible<T, ()> {
    if is_right && value.is_finite() {
        Ok(())
    } else {
        Err(InputError::InvalidLoad { quantity, value, must }.into())
    }
}

/// Refuses a place, moment or misalignment that is not finite.
pub(crate) fn check_finite<T: Real>(quantity: &'static str, value: T) -> Fallible<T, ()> {
    let fault = || InputError::InvalidMoment { quantity, value }.into();
    value.is_finite().then_some(()).ok_or_else(fault)
}

fn is_positive<T: Real>(value: T) -> bool {
    value > T::zero() && !is_subnormal(value)
}

/// Checks that an interval lies in a range, up to the rounding of its limits.
pub(crate) fn check_within<T: Real>(
    Interval { left, right }: Interval<T>,
    ends: Ends<T>,
    rounding: T,
) -> Fallible<T, ()> {
    for (x, beyond) in [(left, ends.left - left), (right, right - ends.right)] {
        if beyond > rounding {
            let range = [ends.left, ends.right];
            return Err(SolveError::OutsideBodies { x, range }.into());
        }
    }
    Ok(())
}

pub(crate) fn check<T: Real>(interval: Interval<T>) -> Fallible<T, ()> {
    let Interval { left, right } = interval;
    if left.is_finite() && right.is_finite() && left < right {
        Ok(())
    } else {
        Err(InputError::InvalidLimits { interval }.into())
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
