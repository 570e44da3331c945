//! Errors of a scene, with remedies.

mod advice;

pub(crate) use advice::is_subnormal;

use crate::profile::SplineError;
use crate::rounded::{apart, six, span};
use crate::search::SearchError;
use crate::{Edge, Ends, Interval, PiecewiseError, ProfileError, Real};
use advice::{
    SEVERAL, along, borne, hint, how_to_peak, how_to_press, how_to_touch, lost_digits, place,
};
use std::fmt;
use thiserror::Error;

/// One of the two bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Body {
    /// Body 1, below.
    Lower,
    /// Body 2, above.
    Upper,
}

impl fmt::Display for Body {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Lower => "lower",
            Self::Upper => "upper",
        })
    }
}

/// Reason why a contact could not be solved, or a question to its solution not be answered. Every
/// variant names the place and the values; [`kind`](Self::kind) tells apart faulty input, a failed
/// solve and an unanswered question.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ContactError<T: Real> {
    /// A body could not be made.
    #[error(transparent)]
    Shape(#[from] ProfileError<T>),
    /// A body could not be joined from its pieces.
    #[error(transparent)]
    Pieces(#[from] PiecewiseError<T>),
    /// A spline could not be made from its points.
    #[error(transparent)]
    Points(#[from] SplineError<T>),
    /// The solve was ended by the function given to [`Contact::watch`](crate::Contact::watch).
    #[error(
        "cancelled after {evaluations} evaluations of the curves, the last from x = {}",
        span(last.left, last.right)
    )]
    Cancelled {
        /// Evaluations of the curves by then.
        evaluations: usize,
        /// The span of `x` sampled last.
        last: Interval<T>,
    },
    /// The profile of a body is faulty.
    #[error("{body} body: {source}")]
    Profile {
        /// Body with this profile.
        body: Body,
        /// Fault of the profile.
        source: ProfileError<T>,
    },
    /// The two bodies have no `x` in common.
    #[error(
        "the bodies lie beside each other: the lower covers x = {}, the upper {}; move one of them over the other",
        span(lower[0], lower[1]), span(upper[0], upper[1])
    )]
    NoCommonRange {
        /// Range of `x` of the lower body.
        lower: [T; 2],
        /// Range of `x` of the upper body.
        upper: [T; 2],
    },
    /// `x` is beyond one of the bodies, or NaN.
    #[error(
        "x = {} is beyond the bodies, which both cover only {}; ask within, or extend their domains",
        apart(*x, range), span(range[0], range[1])
    )]
    OutsideBodies {
        /// Abscissa asked for.
        x: T,
        /// The range of `x` that both bodies cover.
        range: [T; 2],
    },
    /// `X(k) = x` could not be inverted.
    #[error("{body} body: X(k) = {x} cannot be inverted: {source}", x = six(*x))]
    Inversion {
        /// Body with this profile.
        body: Body,
        /// Abscissa.
        x: T,
        /// Error of the search, in terms of `k`.
        source: SearchError<T>,
    },
    /// The load, half-width, peak pressure or approach asked for is not finite, or so small that it
    /// has lost digits, or not positive. A load needs to be positive only where limits are sought
    /// without adhesion.
    #[error(
        "the {quantity} is {value}: it must be finite, and positive where limits are sought{}",
        lost_digits(*value), value = six(*value)
    )]
    InvalidLoad {
        /// Quantity asked for: `load`, `half-width`, `peak pressure` or `approach`.
        quantity: &'static str,
        /// Its value.
        value: T,
    },
    /// κ is not a positive finite number.
    #[error("κ = {kappa}: the scale must be positive and finite (κ = π E*/2)", kappa = six(*kappa))]
    InvalidKappa {
        /// κ as given.
        kappa: T,
    },
    /// The contact modulus E* is not a positive finite number, or κ = π E*/2 is not.
    #[error("E* = {}: the contact modulus must be positive, and π E*/2 finite", six(*modulus))]
    InvalidModulus {
        /// E* as given.
        modulus: T,
    },
    /// Given or starting limits are not in order, or a half-width is lost in the rounding of `x`.
    #[error(
        "the interval from -b = {left} to a = {right} is empty, reversed, not finite, or narrower than the rounding \
         of x; give finite limits, the left one first",
        left = apart(interval.left, &[interval.right]), right = apart(interval.right, &[interval.left])
    )]
    InvalidLimits {
        /// The interval as given.
        interval: Interval<T>,
    },
    /// One of A, B, ε_a, ε_b, ε₁, ε₂ of Eq. (6) is out of range.
    #[error(
        "{name} = {}: distances and tolerances of Eq. (6) must be positive and finite, A and B \
         finite, distances shorter than the bodies and longer than the rounding of x", six(*value)
    )]
    InvalidEdgePressure {
        /// Name of the quantity.
        name: &'static str,
        /// Its value.
        value: T,
    },
    /// The slope difference of the bodies nowhere goes from negative to positive, so that
    /// they do not open on both sides of a point of first contact.
    #[error(
        "no point of first contact: the slope f₂' - f₁' is {} at x = {} and {} at x = {}, but a \
         gap falls on its left and rises on its right; {}",
        six(slope[0]), place(x[0]), six(slope[1]), place(x[1]), how_to_touch(*slope)
    )]
    NoFirstContact {
        /// Two abscissae.
        x: [T; 2],
        /// Slope differences at these abscissae.
        slope: [T; 2],
    },
    /// The contact that carries the load reaches beyond a body; of several contacts, the first or
    /// the last does. Or the bodies touch at an end before any limit gets there.
    #[error(
        "{}, or give Edge::FreeUntil({end:?}) if the bodies have a sharp \
         corner there{}",
        borne(*end, [*carried, *load], *half_width, *peak), hint(*kappa_is_default)
    )]
    DomainTooShort {
        /// End of the bodies that the contact reaches first.
        end: T,
        /// Load carried by the largest contact that stays on the bodies, or by several contacts of
        /// the largest possible width. It does not depend on the load asked for. Zero where the
        /// bodies touch at this end first.
        carried: T,
        /// The load asked for.
        load: T,
        /// Half-width of this largest contact; of several contacts, half the distance from the
        /// first limit to the last.
        half_width: T,
        /// Peak pressure of this contact; infinite where it is held at a corner, or where the slope
        /// jumps.
        peak: T,
        /// True if κ was left at its default of 1: then the stiffness may be missing.
        kappa_is_default: bool,
    },
    /// A contact of the half-width asked for reaches beyond a body.
    #[error(
        "a contact of half-width {wanted} would leave the bodies at x = {end}: there is room for \
         {half_width}, which carries {load} with peak pressure {peak}; extend the domain or lower \
         the half-width{}",
        hint(*kappa_is_default), wanted = apart(*wanted, &[*half_width]), end = six(*end),
        half_width = apart(*half_width, &[*wanted]), load = six(*load), peak = six(*peak)
    )]
    HalfWidthTooLarge {
        /// The half-width asked for.
        wanted: T,
        /// The half-width of the largest contact that stays on the bodies.
        half_width: T,
        /// End of the bodies that this largest contact reaches.
        end: T,
        /// Load that it carries.
        load: T,
        /// Its peak pressure; infinite where it is held at a corner, or where the slope jumps.
        peak: T,
        /// True if κ was left at its default of 1: then the stiffness may be missing.
        kappa_is_default: bool,
    },
    /// No position of a contact balances the pressures at its two edges, for some half-width.
    #[error(
        "no contact is found near x = {near}: none of half-width {half_width}, the width asked for or else the \
         last that was tried, is in balance there; {SEVERAL}, or give a start",
        near = six(*near), half_width = six(*half_width)
    )]
    NoEquilibrium {
        /// Half-width asked for, or else the half-width tried last.
        half_width: T,
        /// Point of first contact.
        near: T,
    },
    /// The forces on a contact are beyond the range of the number type.
    #[error(
        "the forces on a contact from {} overflow: choose units in which they are \
         nearer to 1, or give a start nearer to the contact", span(interval.left, interval.right)
    )]
    Overflow {
        /// The contact.
        interval: Interval<T>,
    },
    /// The search has spent its budget of evaluations.
    #[error(
        "{evaluations} evaluations of the curves, the last from x = {}, and not done: the budget is \
         {budget}; give a start nearer to the contact, declare breakpoints, or set a looser tolerance or a coarser \
         resolution", span(last.left, last.right)
    )]
    BudgetSpent {
        /// Evaluations of the curves, or values of the slope of the gap, by then.
        evaluations: usize,
        /// Largest number allowed: 2²⁰ and 1024 for each piece of the bodies.
        /// [`Midpoint`](crate::Midpoint) keeps no samples: sixteen times this number, plus the
        /// evaluations of 4096 pressures.
        budget: usize,
        /// The span of `x` sampled last.
        last: Interval<T>,
    },
    /// The search for the limits gave up.
    #[error(
        "limits not found: {source}; best so far -b = {}, a = {}",
        apart(best.left, &[best.right]), apart(best.right, &[best.left])
    )]
    LimitSearch {
        /// The best limits so far.
        best: Interval<T>,
        /// Error of the search, in terms of the half-width or the distance from the point of first
        /// contact.
        source: SearchError<T>,
    },
    /// The limits are as accurate as the numbers allow, but Eq. (6) is not met.
    #[error(
        "the best limits, -b = {} and a = {}, leave P(a - ε_a) - A = {at_a} and \
         P(ε_b - b) - B = {at_b}: more than ε₁, ε₂; take more segments or larger tolerances",
        apart(best.left, &[best.right]), apart(best.right, &[best.left]), at_a = six(*at_a), at_b = six(*at_b)
    )]
    EdgePressureNotMet {
        /// The best limits.
        best: Interval<T>,
        /// Residual of Eq. (6) at `a`: `P(a - ε_a) - A`.
        at_a: T,
        /// Residual of Eq. (6) at `-b`: `P(ε_b - b) - B`.
        at_b: T,
    },
    /// The number of segments is zero, or there are more points than can be counted.
    #[error(
        "{segments} segments with {extrapolations} extrapolations: give at least one segment, and \
         fewer than 2^24 points at the finest level"
    )]
    InvalidSegments {
        /// Number of segments, N.
        segments: usize,
        /// Number of extrapolations, ET.
        extrapolations: u32,
    },
    /// The pressure was asked for where it is infinite: at a fixed or adhesive edge, at an edge
    /// where Eq. (6) has left a singularity, or where the slope of a body jumps.
    #[error(
        "the pressure at x = {} is infinite; ask beside it, or for edge_singularities()", six(*x)
    )]
    Singular {
        /// Abscissa asked for.
        x: T,
    },
    /// A body's Y does not match its Y', so that heights and slopes of the gap contradict each
    /// other. Y has a step, or a derivative is wrong:
    /// [`check_derivatives`](crate::check_derivatives) tells for which body.
    #[error(
        "from x = {} the gap rises by {by_heights} by the heights Y of the bodies, but by {by_slopes} by their \
         slopes Y'/X': one of them has a Y that does not go with its Y', or a step in Y; check_derivatives tells which",
        span(between[0], between[1]), by_heights = apart(*by_heights, &[*by_slopes]),
        by_slopes = apart(*by_slopes, &[*by_heights])
    )]
    InconsistentHeights {
        /// Two abscissae.
        between: [T; 2],
        /// Rise of `Y₂ - Y₁` from the first abscissa to the second.
        by_heights: T,
        /// `∫ (Y₂'/X₂' - Y₁'/X₁') dx` from the first abscissa to the second.
        by_slopes: T,
    },
    /// The bodies [declare](crate::Convexity) that they bulge towards each other, but the slope of
    /// the gap falls.
    #[error(
        "the slope of the gap falls from {} {}, but the bodies declare that they bulge towards each other: declare \
         Convexity::Unknown, or correct the curve", span(slopes[0], slopes[1]), along(*between)
    )]
    NotConvex {
        /// Two abscissae, the left one first; equal where the slope jumps.
        between: [T; 2],
        /// Slopes of the gap at these abscissae, before the bodies turn: ratios of lengths.
        slopes: [T; 2],
    },
    /// The bodies would have to pull at each other inside the contact: they part there.
    #[error(
        "the pressure at x = {x} would be {pressure} in the contact found under the load {load}, from {}: the bodies \
         part there; {}", span(interval.left, interval.right), how_to_press(*pressure), x = six(*x),
        pressure = six(*pressure), load = six(*load)
    )]
    Tension {
        /// Abscissa at which the pressure is negative.
        x: T,
        /// Pressure there; minus infinity where the slope of the gap jumps down.
        pressure: T,
        /// Solution of the equations with this pressure: the interval from the first limit to the
        /// last.
        interval: Interval<T>,
        /// Load per unit length of this solution.
        load: T,
    },
    /// The body lifts off at a fixed edge: the singularity of the pressure there is negative, or
    /// the contact ends before the corner.
    #[error(
        "the edge Fixed({x}) would be in tension under the load {load} (K = {strength}): the contact does not reach this \
         corner; use Edge::FreeUntil({x}), for a corner that is free until it is reached",
        x = six(*x), strength = six(*strength), load = six(*load)
    )]
    LiftsOff {
        /// Abscissa of the corner.
        x: T,
        /// Strength K of the singularity, see
        /// [`Solution::edge_singularities`](crate::Solution::edge_singularities): zero to rounding
        /// where the contact ends before the corner.
        strength: T,
        /// Contact that solves the equations with this strength.
        interval: Interval<T>,
        /// Load per unit length of this contact.
        load: T,
    },
    /// The bodies would overlap outside the contact: they touch there as well.
    #[error(
        "the bodies would overlap by {} at x = {x}, outside the contact found under the load {load}, from {}: they \
         touch there as well; {SEVERAL}", six(-*gap), span(interval.left, interval.right), x = six(*x),
        load = six(*load)
    )]
    Overlap {
        /// Abscissa of the overlap.
        x: T,
        /// Gap there, negative.
        gap: T,
        /// Solution of the equations with this overlap: the interval from the first limit to the
        /// last.
        interval: Interval<T>,
        /// Load per unit length of this solution.
        load: T,
    },
    /// The slope of the gap inside the contact differs from the panels by which the contact was
    /// found: a feature lies between two of their samples.
    #[error(
        "the slope of the gap at x = {x} is {slope}, where the panels say {assumed}: something \
         narrow has been missed there; declare breakpoints at its ends, or correct the curve",
        x = six(*x), slope = apart(*slope, &[*assumed]), assumed = apart(*assumed, &[*slope])
    )]
    FeatureMissed {
        /// Abscissa of the difference.
        x: T,
        /// Slope of the gap.
        slope: T,
        /// Slope according to the panels.
        assumed: T,
    },
    /// The samples of the certificate give the pressure a singularity at a free edge that the found
    /// contact does not have: the limits were found from a part of the curves only.
    #[error(
        "the limits do not balance the bodies: at the free edge x = {x} the pressure would have a \
         singularity of strength {strength}, where the limits were found to within {allowed}; declare \
         breakpoints, give a start nearer to the contact, or correct the curves, which must be the same at \
         each call", x = six(*x), strength = six(*strength), allowed = six(*allowed)
    )]
    Unbalanced {
        /// Abscissa of the limit.
        x: T,
        /// Strength K of the inverse-square-root singularity there, a pressure.
        strength: T,
        /// Largest strength that the estimated errors of the limits and of the samples allow.
        allowed: T,
    },
    /// The certificate has spent its budget.
    #[error(
        "whether the bodies touch in one place is not decided after {evaluations} evaluations and \
         {samples} samples: at x = {x} it would take more; narrow the domains, or declare breakpoints",
        x = six(*x)
    )]
    Undecided {
        /// Abscissa at which the certificate has stopped.
        x: T,
        /// Evaluations of the curves by then.
        evaluations: usize,
        /// Values of the slope of the gap by then.
        samples: usize,
    },
    /// The tolerance of the panels is negative, one or more, or NaN.
    #[error(
        "tolerance {tolerance} is out of range: use 0 <= tolerance < 1 (SpringTable: > 0)",
        tolerance = six(*tolerance)
    )]
    InvalidTolerance {
        /// The tolerance as given.
        tolerance: T,
    },
    /// The [resolution](crate::Contact::resolution) is not a length, or is lost in the rounding of
    /// x.
    #[error(
        "the resolution is {resolution}: the narrowest feature to be seen is a length along x, finite and more than {least}",
        resolution = six(*resolution), least = six(*least)
    )]
    InvalidResolution {
        /// The resolution as given: a length.
        resolution: T,
        /// Least length that the rounding of x in the contact allows; zero where no contact was
        /// found yet.
        least: T,
    },
    /// A work of adhesion is negative or not finite.
    #[error("the work of adhesion is {}: it must be finite and not negative", six(*work))]
    InvalidAdhesion {
        /// The work of adhesion as given.
        work: T,
    },
    /// Both limits are given: then only a load can be asked for.
    #[error(
        "both limits are given, -b = {} and a = {}: then the load must be given too, not the \
         half-width or the peak", apart(interval.left, &[interval.right]), apart(interval.right, &[interval.left])
    )]
    BothLimitsGiven {
        /// The limits.
        interval: Interval<T>,
    },
    /// A moment, or the place where a load acts, is not finite.
    #[error(
        "the moment, the place it is about, or the place where the load acts is {value}: it must be finite",
        value = six(*value)
    )]
    InvalidMoment {
        /// The value.
        value: T,
    },
    /// A moment, or the place where the load acts, was given for bodies that cannot be turned.
    #[error(
        "a moment, or the place where the load acts, can be given with the default quadrature Panels and \
         search, between edges that are Free, Fixed or FreeUntil: {why}"
    )]
    TiltNotSupported {
        /// Reason, for the message.
        why: &'static str,
    },
    /// No tilt makes the load act at the place asked for: the contact would leave the bodies.
    #[error(
        "no tilt makes the load {load} act at x = {at}: the nearest is x = {reached}, with the tilt \
         {tilt}, and beyond that the contact leaves the bodies, from x = {}; move the load \
         inward, lower it, or extend the domain",
        span(ends.left, ends.right), load = six(*load), at = apart(*at, &[*reached]),
        reached = apart(*reached, &[*at]), tilt = six(*tilt)
    )]
    TiltNotFound {
        /// Load per unit length asked for.
        load: T,
        /// Place where the load was to act: `x₀ + M/F`.
        at: T,
        /// Nearest place at which a contact was found that carries the load.
        reached: T,
        /// The tilt of that contact.
        tilt: T,
        /// Ends of the bodies.
        ends: Ends<T>,
    },
    /// The bodies come apart: the tensile load exceeds the adhesion.
    #[error(
        "no contact under the load {load}: the pull is more than the adhesion can bear; the \
         contact was followed down to {least}; pull less",
        load = apart(*load, &[*least]), least = apart(*least, &[*load])
    )]
    PullOff {
        /// Load per unit length asked for.
        load: T,
        /// The least load under which a contact was found.
        least: T,
    },
    /// A peak pressure was asked for together with an edge at which the pressure is not bounded.
    #[error(
        "with {edge:?} the pressure is infinite at the edge, or may be: a peak pressure can be given \
         between free edges only; give the load or the half-width"
    )]
    PeakEdge {
        /// The edge asked for.
        edge: Edge<T>,
    },
    /// The contact with this peak pressure reaches beyond a body or a corner.
    #[error(
        "the peak pressure {wanted} takes a wider contact than there is room for: with half-width \
         {half_width}, up to x = {end}, it is {found} under the load {load}; extend the domains \
         or lower the peak{}",
        hint(*kappa_is_default), wanted = apart(*wanted, &[*found]), found = apart(*found, &[*wanted]),
        half_width = six(*half_width), end = six(*end), load = six(*load)
    )]
    PeakTooHigh {
        /// The peak pressure asked for.
        wanted: T,
        /// Largest half-width that there is room for.
        half_width: T,
        /// Peak pressure of the contact with this half-width.
        found: T,
        /// End of the bodies, or the corner, that this contact reaches.
        end: T,
        /// The load that it carries.
        load: T,
        /// True if κ was left at its default of 1: then the stiffness may be missing.
        kappa_is_default: bool,
    },
    /// No contact is found with this peak pressure.
    #[error(
        "no contact is found with the peak pressure {wanted}: with half-width {half_width} it is {found}; {}",
        how_to_peak(*found),
        wanted = apart(*wanted, &[*found]), found = apart(*found, &[*wanted]), half_width = six(*half_width)
    )]
    NoPeak {
        /// The peak pressure asked for.
        wanted: T,
        /// The half-width tried last.
        half_width: T,
        /// Peak pressure there; infinite where the slope of a body jumps, NaN where no contact was
        /// found.
        found: T,
    },
    /// The value asked for lies in a jump: a contact arises outside the others, a corner is
    /// reached, or even the lightest load gives more.
    #[error(
        "nothing between {below} and {above} can be had, so not {wanted}: under the load {load} it jumps, where a \
         contact is born or a corner reached; ask for one of both sides",
        below = six(*below), above = six(*above), wanted = apart(*wanted, &[*below, *above]), load = six(*load)
    )]
    InJump {
        /// The half-width, peak pressure or approach asked for.
        wanted: T,
        /// Load at which the quantity jumps.
        load: T,
        /// Value under smaller loads; 0 where there is none.
        below: T,
        /// Value under larger loads; infinite where the pressure is.
        above: T,
    },
    /// A point is above the surface, or not finite.
    #[error(
        "no stress at x = {x}, depth {depth}: both must be finite, the depth not negative",
        x = six(*x), depth = six(*depth)
    )]
    AboveSurface {
        /// Abscissa.
        x: T,
        /// Depth below the surface.
        depth: T,
    },
    /// Poisson's ratio is not one of an isotropic body that contracts when pulled.
    #[error("Poisson's ratio is {}: it must be from 0 to 1/2, as 0.3 of steel", six(*ratio))]
    InvalidPoissonRatio {
        /// Poisson's ratio as given.
        ratio: T,
    },
    /// Young's modulus is not a positive finite number.
    #[error(
        "{body} body: Young's modulus is {modulus}: it must be positive and finite (or Material::Rigid)",
        modulus = six(*modulus)
    )]
    InvalidYoungsModulus {
        /// Body with this modulus.
        body: Body,
        /// Young's modulus as given.
        modulus: T,
    },
    /// Both bodies are rigid: then there is no pressure.
    #[error("both bodies are Material::Rigid: at least one must be elastic")]
    BothRigid,
    /// An approach was asked for without the materials of the bodies: it depends on the deformation
    /// of each body, which E* alone does not give.
    #[error("the approach depends on E and ν of both bodies: give them by Contact::materials")]
    NoMaterials,
    /// The depth, radius or length of a reference is not a positive finite number, or a disc is
    /// smaller than the contact.
    #[error(
        "a reference at {length}: its depth, radius or length must be positive and finite, and a disc larger \
         than the contact", length = six(*length)
    )]
    InvalidReference {
        /// Length as given.
        length: T,
    },
    /// No contact that stays on the bodies has this approach.
    #[error(
        "an approach of {wanted} is more than the bodies bear: they carry {load}, with an approach of \
         {approach}; extend the domain or lower the approach",
        wanted = apart(*wanted, &[*approach]), approach = apart(*approach, &[*wanted]), load = six(*load)
    )]
    ApproachTooLarge {
        /// The approach asked for.
        wanted: T,
        /// Approximate largest approach of a contact that stays on the bodies.
        approach: T,
        /// Load at this approach.
        load: T,
    },
    /// The table of a spring does not cover this approach.
    #[error(
        "the table covers approaches from {}, not {}: make it for a wider range of loads (apart, the bodies bear none)",
        span(range[0], range[1]), apart(*approach, range)
    )]
    OutsideTable {
        /// Approach as given.
        approach: T,
        /// Least and largest approach in the table.
        range: [T; 2],
    },
    /// The approach to these references does not grow with the load, so that it does not determine
    /// the load.
    #[error(
        "under the load {load} the approach falls by {rate} with each unit of it: the references are \
         too close to the surface; put them deeper, take larger lengths, or an x inside the contact",
        load = six(*load), rate = six(*rate)
    )]
    ApproachFalls {
        /// Load at which the approach falls.
        load: T,
        /// dδ/dF there, negative or zero.
        rate: T,
    },
    /// The coefficient of friction is not finite.
    #[error("the coefficient of friction is {}: it must be finite", six(*coefficient))]
    InvalidFriction {
        /// Coefficient as given.
        coefficient: T,
    },
    /// The coefficient of friction of partial slip is not a positive finite number.
    #[error(
        "the coefficient of friction is {friction}: for partial slip it must be positive and finite",
        friction = six(*friction)
    )]
    InvalidSlipFriction {
        /// μ as given.
        friction: T,
    },
    /// The force or the tension of partial slip is not finite.
    #[error("{quantity} = {}: what acts along the contact must be finite", six(*value))]
    InvalidShear {
        /// Name of the quantity: `force` or `tension`.
        quantity: &'static str,
        /// Value as given.
        value: T,
    },
    /// The force exceeds friction: the bodies slip everywhere.
    #[error(
        "the tangential force {} is no less than friction carries, μF = {}: the bodies slip everywhere; lower it, or \
         raise the load", apart(*force, &[*limit]), apart(*limit, &[*force])
    )]
    SlipsEverywhere {
        /// Tangential force Q.
        force: T,
        /// Largest force that friction carries, μF.
        limit: T,
    },
    /// The force is so small, relative to friction, that the slip zones and their traction are lost
    /// in rounding. Without slip the traction is Q ∂P/∂F, see
    /// [`Solution::load_rates`](crate::Solution::load_rates).
    #[error(
        "the tangential force {} is so much less than friction carries, μF = {}, that nothing is seen to \
         slip: take Q times the rate of the pressure in load_rates", six(*force), six(*limit)
    )]
    SticksEverywhere {
        /// Tangential force Q.
        force: T,
        /// Largest force that friction carries, μF.
        limit: T,
    },
    /// The bodies would stick outside the contact. With such a large tension, or such a small
    /// force, slip reverses while the force grows, and the history counts.
    #[error(
        "the bodies would stick from {}, beyond the contact from {}: slip reverses; lower \
         the tension, or raise the force",
        span(zone.left, zone.right), span(contact.left, contact.right)
    )]
    ReversedSlip {
        /// Zone in which the bodies would stick.
        zone: Interval<T>,
        /// Contact nearest to this zone.
        contact: Interval<T>,
    },
    /// Friction on bodies of different elasticity changes the pressure.
    #[error(
        "the bodies are unlike: by Dundurs' constant β = {beta} friction changes the pressure, which is not \
         modelled; like bodies, or incompressible ones, have β = 0", beta = six(*beta)
    )]
    UnlikeBodies {
        /// Dundurs' constant β in plane strain, from -1/2 to 1/2.
        beta: T,
    },
    /// Partial slip is not known with these conditions.
    #[error("partial slip is not known where {why}")]
    SlipNotSupported {
        /// Reason, for the message.
        why: &'static str,
    },
    /// A point is not inside the contact, or not outside it, as required.
    #[error(
        "x = {} must lie {}side the contact from {}",
        apart(*x, &[interval.left, interval.right]), if *inside { "in" } else { "out" },
        span(interval.left, interval.right)
    )]
    InvalidPosition {
        /// Abscissa of the point.
        x: T,
        /// True if the point must be strictly inside.
        inside: bool,
        /// Contact.
        interval: Interval<T>,
    },
    /// The derivatives of the contact by the load are not known.
    #[error("the derivatives by the load are not known: {why}")]
    NoLoadDerivative {
        /// Reason, for the message.
        why: &'static str,
    },
    /// Edge pressures by the paper's Eq. (6) are given: then only a load can be prescribed.
    #[error(
        "with edge pressures by Eq. (6) the load must be given, not the half-width, the peak or a moment: give \
         it, or use edges()"
    )]
    EdgePressureLoad,
    /// The number of places for pressures is not the number of abscissae.
    #[error(
        "{x} abscissae, but {pressures} places for pressures: give as many of the one as of the other"
    )]
    LengthMismatch {
        /// Number of abscissae.
        x: usize,
        /// Number of places for pressures.
        pressures: usize,
    },
    /// An integral over the pressure has not converged.
    #[error(
        "an integral over the pressure for x = {x} has not converged in {panels} panels: the \
         pressure is too rough; set a looser tolerance or a finer quadrature", x = six(*x)
    )]
    Integral {
        /// Abscissa for which the integral was taken.
        x: T,
        /// Number of panels tried.
        panels: usize,
    },
    /// The quadrature has no correct digit of the pressure: `x` is too close to an edge for its
    /// segments.
    #[error(
        "the pressure at x = {x} is not resolved: {pressure} with an error of about \
         {error}; take more segments, or stay further away from the edge",
        x = six(*x), pressure = six(*pressure), error = six(*error)
    )]
    Unresolved {
        /// Abscissa asked for.
        x: T,
        /// Pressure by the quadrature.
        pressure: T,
        /// Estimated error of this pressure.
        error: T,
    },
}

/// Subject of a [`ContactError`]: the input, the solve, or a question to its solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ErrorKind {
    /// A body, edge, load or setting is invalid. The same call fails again.
    Input,
    /// No contact was found, or the result is not a contact. Another load, domain or start may
    /// help.
    Solve,
    /// The contact is known, but the quantity asked for is not available there.
    Evaluation,
}

/// Assigns a kind to each error.
macro_rules! kinds {
    ($($kind:ident: $($error:ident)*;)*) => {
        impl<T: Real> ContactError<T> {
            /// Returns the kind of this error.
            #[must_use]
            pub fn kind(&self) -> ErrorKind {
                match self {
                    $($(Self::$error { .. })|* => ErrorKind::$kind,)*
                }
            }
        }
    };
}
kinds! {
    Input: Shape Pieces Points Profile NoCommonRange InvalidLoad InvalidKappa InvalidModulus
        InvalidLimits InvalidEdgePressure InvalidSegments InconsistentHeights NotConvex
        InvalidTolerance InvalidResolution InvalidAdhesion BothLimitsGiven InvalidMoment
        TiltNotSupported PeakEdge InvalidPoissonRatio InvalidYoungsModulus BothRigid NoMaterials
        InvalidReference InvalidFriction InvalidSlipFriction InvalidShear UnlikeBodies
        SlipNotSupported EdgePressureLoad;
    Solve: Cancelled OutsideBodies Inversion NoFirstContact DomainTooShort HalfWidthTooLarge
        NoEquilibrium Overflow BudgetSpent LimitSearch EdgePressureNotMet Tension
        LiftsOff Overlap FeatureMissed Unbalanced Undecided TiltNotFound PullOff PeakTooHigh NoPeak
        InJump ApproachTooLarge ApproachFalls SlipsEverywhere SticksEverywhere ReversedSlip;
    Evaluation: Singular AboveSurface OutsideTable InvalidPosition NoLoadDerivative LengthMismatch
        Integral Unresolved;
}

impl<T: Real> ContactError<T> {
    /// Returns this error, marked with whether κ is the default.
    pub(crate) fn with_stiffness(mut self, is_default: bool) -> Self {
        if let Self::DomainTooShort { kappa_is_default, .. }
        | Self::HalfWidthTooLarge { kappa_is_default, .. }
        | Self::PeakTooHigh { kappa_is_default, .. } = &mut self
        {
            *kappa_is_default = is_default;
        }
        self
    }

    /// Tells whether a search for one contact may end with this error because the bodies touch in
    /// several places.
    pub(crate) fn may_be_several(&self) -> bool {
        matches!(
            self,
            Self::NoFirstContact { .. }
                | Self::DomainTooShort { .. }
                | Self::NoEquilibrium { .. }
                | Self::OutsideBodies { .. }
                | Self::Overflow { .. }
                | Self::LiftsOff { .. }
        )
    }
}
