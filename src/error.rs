//! What can go wrong with a scene, and how to mend it.

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

/// Why a contact could not be solved, or a question to its solution not be answered. Every variant says where,
/// and with what values; [`kind`](Self::kind) says which of the two it is, or whether the input is at fault.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ContactError<T: Real> {
    /// A body could not be made.
    #[error(transparent)]
    Shape(#[from] ProfileError<T>),
    /// A body could not be joined from its pieces.
    #[error(transparent)]
    Pieces(#[from] PiecewiseError<T>),
    /// A body could not be made of its points.
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
    /// A profile is at fault.
    #[error("{body} body: {source}")]
    Profile {
        /// Whose profile.
        body: Body,
        /// What is wrong.
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
        /// Where.
        x: T,
        /// The range of `x` that both bodies cover.
        range: [T; 2],
    },
    /// `X(k) = x` could not be inverted.
    #[error("{body} body: X(k) = {x} cannot be inverted: {source}", x = six(*x))]
    Inversion {
        /// Whose profile.
        body: Body,
        /// The abscissa.
        x: T,
        /// What the search says, in terms of `k`.
        source: SearchError<T>,
    },
    /// The load, half-width, peak pressure or approach asked for is not finite; or it is not positive, which a
    /// load needs to be only where limits are sought without adhesion; or so small that it has lost digits.
    #[error(
        "the {quantity} is {value}: it must be finite, and positive where limits are sought{}",
        lost_digits(*value), value = six(*value)
    )]
    InvalidLoad {
        /// What was asked for: `load`, `half-width`, `peak pressure` or `approach`.
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
    /// The contact modulus E* is not a positive finite number, or κ = π E*/2 is none.
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
    /// One of A, B, ε_a, ε_b, ε₁, ε₂ of Eq. (6) is unusable.
    #[error(
        "{name} = {}: distances and tolerances of Eq. (6) must be positive and finite, A and B \
         finite, distances shorter than the bodies and longer than the rounding of x", six(*value)
    )]
    InvalidEdgePressure {
        /// Which of them.
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
        /// The slope difference there.
        slope: [T; 2],
    },
    /// The contact that carries the load reaches beyond a body; of several, the first or the last. Or the bodies touch
    /// at an end before any limit comes there.
    #[error(
        "{}, or give Edge::FreeUntil({end:?}) if the bodies have a sharp \
         corner there{}",
        borne(*end, [*carried, *load], *half_width, *peak), hint(*kappa_is_default)
    )]
    DomainTooShort {
        /// The end that the contact reaches first.
        end: T,
        /// The load carried by the largest contact that stays on the bodies, or by several as wide as they
        /// can be: the same whatever load is asked for. Zero where the bodies touch at this end first.
        carried: T,
        /// The load asked for.
        load: T,
        /// The half-width of that contact; half of what lies between the first limit of several and the last.
        half_width: T,
        /// Its largest pressure; infinite where it is held at a corner, or where the slope jumps.
        peak: T,
        /// Whether κ was left at its default of 1: then the stiffness may be what is missing.
        kappa_is_default: bool,
    },
    /// A contact of this half-width reaches beyond a body.
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
        /// The end that it reaches.
        end: T,
        /// The load that it carries.
        load: T,
        /// Its largest pressure; infinite where it is held at a corner, or where the slope jumps.
        peak: T,
        /// Whether κ was left at its default of 1: then the stiffness may be what is missing.
        kappa_is_default: bool,
    },
    /// No position of a contact of some width balances the pressures at its two edges.
    #[error(
        "no contact is found near x = {near}: none of half-width {half_width}, the width asked for or else the \
         last that was tried, is in balance there; {SEVERAL}, or give a start",
        near = six(*near), half_width = six(*half_width)
    )]
    NoEquilibrium {
        /// Half-width tried: the one asked for, if one was.
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
        /// How many may be made: 2²⁰ and 1024 for each piece of the bodies; by [`Midpoint`](crate::Midpoint),
        /// which keeps no samples, sixteen times as many, and besides what 4096 pressures take.
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
        /// What the search says, in terms of the half-width or the distance from the point
        /// of first contact.
        source: SearchError<T>,
    },
    /// The limits are as good as the numbers allow, but Eq. (6) is not met.
    #[error(
        "the best limits, -b = {} and a = {}, leave P(a - ε_a) - A = {at_a} and \
         P(ε_b - b) - B = {at_b}: more than ε₁, ε₂; take more segments or larger tolerances",
        apart(best.left, &[best.right]), apart(best.right, &[best.left]), at_a = six(*at_a), at_b = six(*at_b)
    )]
    EdgePressureNotMet {
        /// The best limits.
        best: Interval<T>,
        /// What is left at `a`.
        at_a: T,
        /// What is left at `-b`.
        at_b: T,
    },
    /// Zero segments, or more points than can be counted.
    #[error(
        "{segments} segments with {extrapolations} extrapolations: give at least one segment, and \
         fewer than 2^24 points at the finest level"
    )]
    InvalidSegments {
        /// N.
        segments: usize,
        /// ET.
        extrapolations: u32,
    },
    /// The pressure where it is infinite: at a fixed or adhesive edge, at one where Eq. (6) has
    /// left a singularity, or where the slope of a body jumps.
    #[error(
        "the pressure at x = {} is infinite; ask beside it, or for edge_singularities()", six(*x)
    )]
    Singular {
        /// Where.
        x: T,
    },
    /// A body's Y does not go with its Y', so that heights and slopes of the gap contradict each other: a step in
    /// Y, or a wrong derivative, of which [`check_derivatives`](crate::check_derivatives) tells which body it is.
    #[error(
        "from x = {} the gap rises by {by_heights} by the heights Y of the bodies, but by {by_slopes} by their \
         slopes Y'/X': one of them has a Y that does not go with its Y', or a step in Y; check_derivatives tells which",
        span(between[0], between[1]), by_heights = apart(*by_heights, &[*by_slopes]),
        by_slopes = apart(*by_slopes, &[*by_heights])
    )]
    InconsistentHeights {
        /// Two places.
        between: [T; 2],
        /// `Y₂ - Y₁` at the second, less that at the first.
        by_heights: T,
        /// `∫ (Y₂'/X₂' - Y₁'/X₁') dx` from the first to the second.
        by_slopes: T,
    },
    /// The bodies [declare](crate::Convexity) that they bulge towards each other, but the slope of the gap falls.
    #[error(
        "the slope of the gap falls from {} {}, but the bodies declare that they bulge towards each other: declare \
         Convexity::Unknown, or correct the curve", span(slopes[0], slopes[1]), along(*between)
    )]
    NotConvex {
        /// Two places, the left one first; the same one twice where the slope jumps.
        between: [T; 2],
        /// The slopes of the gap there, before the bodies turn: ratios of lengths.
        slopes: [T; 2],
    },
    /// The bodies would have to pull at each other inside the contact: they part there.
    #[error(
        "the pressure at x = {x} would be {pressure} in the contact found under the load {load}, from {}: the bodies \
         part there; {}", span(interval.left, interval.right), how_to_press(*pressure), x = six(*x),
        pressure = six(*pressure), load = six(*load)
    )]
    Tension {
        /// Where the pressure is negative.
        x: T,
        /// What it would be there; minus infinity where the slope of the gap jumps down.
        pressure: T,
        /// What solves the equations with it: the first and the last limit, and the load.
        interval: Interval<T>,
        /// The load per unit length of that.
        load: T,
    },
    /// A fixed edge at which the body lifts off: the singularity of the pressure there is negative,
    /// or the contact ends before the corner.
    #[error(
        "the contact is said to end at the corner x = {x}, but under the load {load} the body lifts off there (the \
         strength of the singularity is {strength}): use Edge::FreeUntil, for a corner that is free until it is reached",
        x = six(*x), strength = six(*strength), load = six(*load)
    )]
    LiftsOff {
        /// The corner.
        x: T,
        /// K, see [`Solution::edge_singularities`](crate::Solution::edge_singularities): zero to
        /// rounding where the contact ends before the corner.
        strength: T,
        /// What solves the equations with it.
        interval: Interval<T>,
        /// The load per unit length of that.
        load: T,
    },
    /// The bodies would overlap outside the contact: they touch there as well.
    #[error(
        "the bodies would overlap by {} at x = {x}, outside the contact found under the load {load}, from {}: they \
         touch there as well; {SEVERAL}", six(-*gap), span(interval.left, interval.right), x = six(*x),
        load = six(*load)
    )]
    Overlap {
        /// Where.
        x: T,
        /// The gap there, negative.
        gap: T,
        /// What solves the equations with it: the first and the last limit.
        interval: Interval<T>,
        /// The load per unit length of that.
        load: T,
    },
    /// The slope of the gap inside the contact is not what the samples say from which the contact was
    /// found: something lies between two of them.
    #[error(
        "the slope of the gap at x = {x} is {slope}, where the panels say {assumed}: something \
         narrow has been missed there; declare breakpoints at its ends, or correct the curve",
        x = six(*x), slope = apart(*slope, &[*assumed]), assumed = apart(*assumed, &[*slope])
    )]
    FeatureMissed {
        /// Where.
        x: T,
        /// The slope of the gap.
        slope: T,
        /// What it was taken for.
        assumed: T,
    },
    /// The samples of the certificate leave a pressure at a free edge that is not that of the contact:
    /// what the limits were found from was not the whole of the curves.
    #[error(
        "the limits do not balance the bodies: at the free edge x = {x} the pressure would have a \
         singularity of strength {strength}, where the limits were found to within {allowed}; declare \
         breakpoints, give a start nearer to the contact, or correct the curves, which must be the same at \
         each call", x = six(*x), strength = six(*strength), allowed = six(*allowed)
    )]
    Unbalanced {
        /// The limit.
        x: T,
        /// The strength K of the inverse-square-root singularity there, a pressure.
        strength: T,
        /// How large it may be by the estimated error of the limits, and by that of the samples.
        allowed: T,
    },
    /// The certificate has spent its budget.
    #[error(
        "whether the bodies touch in one place is not decided after {evaluations} evaluations and \
         {samples} samples: at x = {x} it would take more; narrow the domains, or declare breakpoints",
        x = six(*x)
    )]
    Undecided {
        /// Where it has stopped.
        x: T,
        /// Evaluations of the curves by then.
        evaluations: usize,
        /// Values of the slope of the gap by then.
        samples: usize,
    },
    /// The tolerance of the panels is negative, one or more, or NaN.
    #[error(
        "{tolerance} is no tolerance: give a number below 1, and not negative; a table needs one above 0",
        tolerance = six(*tolerance)
    )]
    InvalidTolerance {
        /// The tolerance as given.
        tolerance: T,
    },
    /// The [resolution](crate::Contact::resolution) is not a length, or lost in the rounding of x.
    #[error(
        "the resolution is {resolution}: the narrowest feature to be seen is a length along x, finite and more than {least}",
        resolution = six(*resolution), least = six(*least)
    )]
    InvalidResolution {
        /// The resolution as given: a length.
        resolution: T,
        /// The least length that the rounding of x in the contact allows; zero where none was found yet.
        least: T,
    },
    /// A work of adhesion is negative or not finite.
    #[error("the work of adhesion is {}: it must be finite and not negative", six(*work))]
    InvalidAdhesion {
        /// The work of adhesion as given.
        work: T,
    },
    /// Limits that are both given leave nothing to be sought: only a load can be asked of them.
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
    /// A moment, or the place where the load acts, was asked for where the bodies cannot be turned.
    #[error(
        "a moment, or the place where the load acts, can be given with the default quadrature Panels and \
         search, between edges that are Free, Fixed or FreeUntil: {why}"
    )]
    TiltNotSupported {
        /// What stands in the way.
        why: &'static str,
    },
    /// No tilt is found under which the load acts at the place asked for: the contact would leave the bodies.
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
        /// Where it was to act: `x₀ + M/F`.
        at: T,
        /// The nearest place at which a contact was found that bears it.
        reached: T,
        /// The tilt of that contact.
        tilt: T,
        /// Where the bodies end.
        ends: Ends<T>,
    },
    /// The bodies come apart: the pull is more than adhesion can bear.
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
    /// An edge was asked for at which the pressure is not bounded, and a peak pressure with it.
    #[error(
        "with {edge:?} the pressure is infinite at the edge, or may be: a peak pressure can be given \
         between free edges only; give the load or the half-width"
    )]
    PeakEdge {
        /// The edge asked for.
        edge: Edge<T>,
    },
    /// The contact with this peak pressure reaches beyond a body, or beyond a corner.
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
        /// The largest half-width that there is room for.
        half_width: T,
        /// The peak pressure there.
        found: T,
        /// The end of the bodies, or the corner, that this contact reaches.
        end: T,
        /// The load that it carries.
        load: T,
        /// Whether κ was left at its default of 1: then the stiffness may be what is missing.
        kappa_is_default: bool,
    },
    /// The pressure has no largest value to be set.
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
        /// The peak pressure there; infinite where the slope of a body jumps, NaN where no contact was found.
        found: T,
    },
    /// The wanted value lies in a jump: a contact is born outside the others, a corner is reached, or even the lightest
    /// load gives more.
    #[error(
        "nothing between {below} and {above} can be had, so not {wanted}: under the load {load} it jumps, where a \
         contact is born or a corner reached; ask for one of both sides",
        below = six(*below), above = six(*above), wanted = apart(*wanted, &[*below, *above]), load = six(*load)
    )]
    InJump {
        /// The half-width, peak pressure or approach asked for.
        wanted: T,
        /// The load at which it jumps.
        load: T,
        /// The value under less; 0 where there is none.
        below: T,
        /// The value under more; infinite where the pressure is.
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
        /// As given.
        ratio: T,
    },
    /// Young's modulus is not a positive finite number.
    #[error(
        "{body} body: Young's modulus is {modulus}: it must be positive and finite (or Material::Rigid)",
        modulus = six(*modulus)
    )]
    InvalidYoungsModulus {
        /// Whose.
        body: Body,
        /// As given.
        modulus: T,
    },
    /// Both bodies are rigid: there is no pressure then.
    #[error("both bodies are Material::Rigid: at least one must be elastic")]
    BothRigid,
    /// An approach was asked for, but not what the bodies are made of: E* alone does not tell how much of it
    /// each of them gives.
    #[error("the approach depends on E and ν of both bodies: give them by Contact::materials")]
    NoMaterials,
    /// The depth, radius or length of a reference is not a positive finite number, or a disc is smaller than the contact.
    #[error(
        "a reference at {length}: its depth, radius or length must be positive and finite, and a disc larger \
         than the contact", length = six(*length)
    )]
    InvalidReference {
        /// As given.
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
        /// About the largest approach of a contact that stays on the bodies.
        approach: T,
        /// The load of that.
        load: T,
    },
    /// An approach that a table of a spring does not cover.
    #[error(
        "the table covers approaches from {}, not {}: make it for a wider range of loads (apart, the bodies bear none)",
        span(range[0], range[1]), apart(*approach, range)
    )]
    OutsideTable {
        /// As given.
        approach: T,
        /// From the least to the largest in the table.
        range: [T; 2],
    },
    /// The approach to these references does not grow with the load: no load goes with it alone.
    #[error(
        "under the load {load} the approach falls by {rate} with each unit of it: the references are \
         too close to the surface; put them deeper, take larger lengths, or an x inside the contact",
        load = six(*load), rate = six(*rate)
    )]
    ApproachFalls {
        /// Where it was seen.
        load: T,
        /// dδ/dF there, negative or zero.
        rate: T,
    },
    /// The coefficient of friction is not finite.
    #[error("the coefficient of friction is {}: it must be finite", six(*coefficient))]
    InvalidFriction {
        /// As given.
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
        /// `force` or `tension`.
        quantity: &'static str,
        /// As given.
        value: T,
    },
    /// Friction does not carry the force: the bodies slip everywhere.
    #[error(
        "the tangential force {} is no less than friction carries, μF = {}: the bodies slip everywhere; lower it, or \
         raise the load", apart(*force, &[*limit]), apart(*limit, &[*force])
    )]
    SlipsEverywhere {
        /// Q.
        force: T,
        /// μF.
        limit: T,
    },
    /// The force is so small beside what friction carries that the slip zones, and the traction with them, are lost in
    /// rounding. Without slip the traction is Q ∂P/∂F, of [`Solution::load_rates`](crate::Solution::load_rates).
    #[error(
        "the tangential force {} is so much less than friction carries, μF = {}, that nothing is seen to \
         slip: take Q times the rate of the pressure in load_rates", six(*force), six(*limit)
    )]
    SticksEverywhere {
        /// Q.
        force: T,
        /// μF.
        limit: T,
    },
    /// The bodies would stick beside the contact: with so large a tension, or so small a force, slip reverses
    /// while the force grows, and the history counts.
    #[error(
        "the bodies would stick from {}, beyond the contact from {}: slip reverses; lower \
         the tension, or raise the force",
        span(zone.left, zone.right), span(contact.left, contact.right)
    )]
    ReversedSlip {
        /// Where they would stick.
        zone: Interval<T>,
        /// The contact nearest to it.
        contact: Interval<T>,
    },
    /// Friction on bodies of different elasticity changes the pressure.
    #[error(
        "the bodies are unlike: by Dundurs' constant β = {beta} friction changes the pressure, which is not \
         modelled; like bodies, or incompressible ones, have β = 0", beta = six(*beta)
    )]
    UnlikeBodies {
        /// β in plane strain, from -1/2 to 1/2.
        beta: T,
    },
    /// Partial slip is not known with these conditions.
    #[error("partial slip is not known where {why}")]
    SlipNotSupported {
        /// What stands in the way.
        why: &'static str,
    },
    /// A point is not inside the contact, or not outside it, as it has to be.
    #[error(
        "x = {} must lie {}side the contact from {}",
        apart(*x, &[interval.left, interval.right]), if *inside { "in" } else { "out" },
        span(interval.left, interval.right)
    )]
    InvalidPosition {
        /// Where.
        x: T,
        /// Whether it had to be strictly inside.
        inside: bool,
        /// The contact.
        interval: Interval<T>,
    },
    /// The load does not change the contact in a way that is known.
    #[error("the derivatives by the load are not known: {why}")]
    NoLoadDerivative {
        /// What stands in the way.
        why: &'static str,
    },
    /// Conditions at the edges by the paper's Eq. (6) leave nothing else to be asked for than a load.
    #[error(
        "with edge pressures by Eq. (6) the load must be given, not the half-width, the peak or a moment: give \
         it, or use edges()"
    )]
    EdgePressureLoad,
    /// There is not one place for each pressure.
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
        /// The abscissa that it was for.
        x: T,
        /// Panels tried.
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
        /// Where.
        x: T,
        /// What the rule gives.
        pressure: T,
        /// Its estimated error.
        error: T,
    },
}

/// What a [`ContactError`] is about: what was given, the solve, or a question to its solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ErrorKind {
    /// A body, an edge, a load or a setting is not what it must be. The same call fails again.
    Input,
    /// No contact was found, or what was found is none. Another load, domain or start may help.
    Solve,
    /// The contact is known, but not what was asked of it there.
    Evaluation,
}

/// Says of each error what it is about.
macro_rules! kinds {
    ($($kind:ident: $($error:ident)*;)*) => {
        impl<T: Real> ContactError<T> {
            /// What this error is about.
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
    /// The same error, with what is known of the stiffness.
    pub(crate) fn with_stiffness(mut self, is_default: bool) -> Self {
        if let Self::DomainTooShort { kappa_is_default, .. }
        | Self::HalfWidthTooLarge { kappa_is_default, .. }
        | Self::PeakTooHigh { kappa_is_default, .. } = &mut self
        {
            *kappa_is_default = is_default;
        }
        self
    }

    /// Whether a search for one contact may fail like this because the bodies touch in several places.
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
