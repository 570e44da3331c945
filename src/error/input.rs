//! Errors of the input.

use super::ReferenceError;
use super::advice::{along, lost_digits, of_body};
use crate::profile::SplineError;
use crate::rounded::{apart, six, span};
use crate::{Body, ContactError, Edge, Interval, PiecewiseError, ProfileError, Real};
use thiserror::Error;

/// Reason why the input is invalid: a body, an edge, a load or a setting. The same call fails
/// again. Every variant names the place and the values.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum InputError<T: Real> {
    /// A body could not be made.
    #[error(transparent)]
    Shape(#[from] ProfileError<T>),
    /// A body could not be joined from its pieces.
    #[error(transparent)]
    Pieces(#[from] PiecewiseError<T>),
    /// A spline could not be made from its points.
    #[error(transparent)]
    Points(#[from] SplineError<T>),
    /// A closed form does not exist.
    #[error(transparent)]
    ClosedForm(#[from] ReferenceError<T>),
    /// The profile of a body is faulty.
    #[error("{body} body: {source}")]
    Profile {
        /// Body with this profile.
        body: Body,
        /// Fault of the profile.
        source: ProfileError<T>,
    },
    /// The force of a [`Pair`](crate::Pair) is not known where its bodies stand: body 2 turns back
    /// or is upside down, its place is not finite, or the contact is not found.
    #[error("seen from body 1, body 2 is at x = {}, y = {}, turned by {}: {}", six(*x), six(*y), six(*angle),
        source.to_string())]
    Pose {
        /// Place of the origin of body 2 along body 1: a length.
        x: T,
        /// Its height above body 1: a length.
        y: T,
        /// Angle from body 1 to body 2, counter-clockwise: radians.
        angle: T,
        /// Fault of body 2 as it stands, or of the contact.
        // Raw: as a source, it would ask for the trait that it helps to define.
        r#source: Box<ContactError<T>>,
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
    /// The load, half-width, peak pressure or approach asked for is not finite, or so small that it
    /// has lost digits, or not positive. With adhesion, and in an interval that is not checked, a
    /// load may have any sign; of bodies that may lift off, a load of zero and an approach of zero
    /// or less leave them apart.
    #[error("the {quantity} is {}: it must be finite, and {must}{}", six(*value), lost_digits(*value))]
    InvalidLoad {
        /// Quantity asked for: `load`, `half-width`, `peak pressure` or `approach`; of a table of
        /// springs `least load` or `largest load`.
        quantity: &'static str,
        /// Its value.
        value: T,
        /// Condition on the value, besides that it is finite.
        must: &'static str,
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
    /// The thickness of a layer is not a positive finite number.
    #[error("the layer of the {body} body is {} thick: its thickness must be positive and finite", six(*thickness))]
    InvalidThickness {
        /// Body with this layer.
        body: Body,
        /// Thickness as given.
        thickness: T,
    },
    /// The period of the bodies is not a positive finite number.
    #[error("the period {} must be positive and finite", six(*period))]
    InvalidPeriod {
        /// Period as given.
        period: T,
    },
    /// A body is not the same at both ends of the period over which it is described.
    #[error(
        "the {body} body does not repeat with the period: {what} is {} at its left end and {} at its right end; \
         describe it over exactly one period, with the same height and slope at both ends, so from a place that is no \
         corner; of points set Fit::period",
        apart(ends[0], &[ends[1]]), apart(ends[1], &[ends[0]])
    )]
    NotPeriodic {
        /// Body.
        body: Body,
        /// Quantity that differs, for the message.
        what: &'static str,
        /// Its values at the left and at the right end; of x, less the period at the right end.
        ends: [T; 2],
    },
    /// A kernel, or a compliance by wavenumber, cannot be used.
    #[error("a kernel cannot be used: {what} = {}", six(*at))]
    Kernel {
        /// Fault, for the message.
        what: &'static str,
        /// Length at fault; of a value that is, its place or wavenumber.
        at: T,
    },
    /// A contact is too wide for the layer below it, or another kernel as short.
    #[error("the half-width of the contact is about {} times the thickness of its layer, and at most {} times are solved: \
         take the layer for a foundation of springs, or its base for the body", six(*ratio), six(*limit))]
    LayerTooThin {
        /// Half-width by thickness, to about a tenth; by half the distance of the nearest
        /// singularity of a kernel.
        ratio: T,
        /// Largest ratio that is solved.
        limit: T,
    },
    /// Layers, periods and other kernels cannot be combined with another setting.
    #[error("bodies with a layer, a period or another kernel are not solved so: {why}")]
    KernelNotSupported {
        /// Reason, for the message.
        why: &'static str,
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
    /// A body's Y does not match its Y', so that heights and slopes of the gap contradict each
    /// other. Y has a step, or a derivative is wrong:
    /// [`check_derivatives`](crate::check_derivatives) tells for which body.
    #[error(
        "{} the gap rises by {by_heights} by the heights Y of the bodies, but by {by_slopes} by their slopes Y'/X': one \
         has a Y that does not go with its Y' (check_derivatives tells which), or a step, as at a joint within its tolerance",
        along(*between), by_heights = apart(*by_heights, &[*by_slopes]), by_slopes = apart(*by_slopes, &[*by_heights])
    )]
    InconsistentHeights {
        /// Two abscissae, equal at a joint of pieces that do not meet.
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
    /// The tolerance of the panels is negative, one or more, or NaN.
    #[error("tolerance {} is out of range: use 0 <= tolerance < 1 (tables: > 0)", six(*tolerance))]
    InvalidTolerance {
        /// The tolerance as given.
        tolerance: T,
    },
    /// The [resolution](crate::Contact::resolution) is not a length, is lost in the rounding of x,
    /// or takes too many points on bodies as long as these.
    #[error(
        "the resolution is {resolution}: the narrowest feature to be seen is a length along x, finite and more than {least}",
        resolution = six(*resolution), least = six(*least)
    )]
    InvalidResolution {
        /// The resolution as given: a length.
        resolution: T,
        /// Least length that the bodies, and the rounding of x in a contact that was found, allow.
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
    /// A moment, the place where a load acts, or the misalignment of a roller is not finite.
    #[error("the {quantity} is {}: it must be finite", six(*value))]
    InvalidMoment {
        /// Quantity: `moment`, `place that the moment is about`, `centre of pressure` or
        /// `misalignment`.
        quantity: &'static str,
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
    /// A peak pressure was asked for together with an edge at which the pressure is not bounded.
    #[error(
        "with {edge:?} the pressure is infinite at the edge, or may be: a peak pressure can be given \
         between free edges only; give the load or the half-width"
    )]
    PeakEdge {
        /// The edge asked for.
        edge: Edge<T>,
    },
    /// Poisson's ratio is not one of an isotropic body that contracts when pulled.
    #[error("{}Poisson's ratio is {}: it must be from 0 to 1/2, as 0.3 of steel", of_body(*body), six(*ratio))]
    InvalidPoissonRatio {
        /// Body with this ratio; `None` of one that was given for a stress.
        body: Option<Body>,
        /// Poisson's ratio as given.
        ratio: T,
    },
    /// Young's modulus is not a positive finite number.
    #[error("{body} body: Young's modulus is {}: it must be positive and finite (or Material::Rigid)",
        six(*modulus))]
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
    /// The length of a roller is not a positive finite number, or it has no slices, or too many.
    #[error(
        "a roller of length {length} in {slices} slices: the length must be positive and finite, the slices from 1 to \
         {most}", length = six(*length)
    )]
    InvalidRoller {
        /// Length of the roller as given.
        length: T,
        /// Number of slices as given.
        slices: usize,
        /// Largest number of slices.
        most: usize,
    },
    /// The relief of a roller is nowhere positive: it has the wrong sign.
    #[error(
        "the relief is {} at z = {} and nowhere positive: it is the distance that the roller recedes from the raceway, \
         as by Crowning; flip the body",
        six(*height), six(*z)
    )]
    InvalidRelief {
        /// First place along the axis at which it is negative.
        z: T,
        /// Relief there, a length.
        height: T,
    },
    /// The relief of a roller is no profile, or does not reach the middles of the outermost slices.
    #[error("the relief of the roller: {}", source.to_string())]
    Relief {
        /// Fault of the relief.
        r#source: Box<ContactError<T>>,
    },
    /// The coefficient of friction is not finite.
    #[error("the coefficient of friction is {}: it must be finite", six(*coefficient))]
    InvalidFriction {
        /// Coefficient as given.
        coefficient: T,
    },
    /// The coefficient of friction of partial slip is not a positive finite number.
    #[error("the coefficient of friction is {}: for partial slip it must be positive and finite", six(*friction))]
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
    /// Bodies of different elasticity, whose pressure with friction, or as a pin in a hole, is not
    /// known.
    #[error(
        "the bodies are unlike: Dundurs' constant β = {beta} changes the pressure with friction, or of a pin in a \
         hole, which is not modelled; like bodies, or incompressible ones, have β = 0", beta = six(*beta)
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
    /// Edge pressures by the paper's Eq. (6) are given: then only a load can be prescribed.
    #[error(
        "with edge pressures by Eq. (6) the load must be given, not the half-width, the peak or a moment: give \
         it, or use edges()"
    )]
    EdgePressureLoad,
}
