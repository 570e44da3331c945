//! Errors of a solve.

use super::advice::{
    SEVERAL, at_peak, borne, hint, how_to_balance, how_to_peak, how_to_press, how_to_touch, place,
    widest,
};
use crate::rounded::{apart, six, span};
use crate::search::SearchError;
use crate::{Body, Ends, Interval, Real};
use thiserror::Error;

/// Reason why no contact was found, or why the result is not a contact. Another load, domain or
/// start may help. Every variant names the place and the values.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SolveError<T: Real> {
    /// The bend of the bodies by a period, a layer or another regular kernel has not converged.
    #[error(
        "the bend of the bodies by their period, layer or kernel has not converged in {solves} solves: Eq. (1) is met to \
         {}; change the load a little, lower it near complete contact of a period, or extend bodies that are narrower than \
         the contact",
        six(*residual)
    )]
    Bending {
        /// Residual of Eq. (1), as a share of its largest part.
        residual: T,
        /// Number of solves.
        solves: usize,
    },
    /// The bodies of a row touch all over a period, or so nearly that the gap left is not solved.
    #[error(
        "the bodies touch all over the period, or their widest gap is below 2 % of a contact: {}complete contact begins \
         at about {}; lower the load, or move one of two like bodies",
        if load == complete { String::new() } else { format!("the load is {}, and ", six(*load)) }, six(*complete)
    )]
    CompleteContact {
        /// Load as given; that of complete contact, if none was given.
        load: T,
        /// Load of one period at which they touch everywhere, from the slopes at 1024 places.
        complete: T,
    },
    /// The solve was ended by the function given to [`Contact::watch`](crate::Contact::watch).
    #[error("cancelled after {evaluations} evaluations, the last from x = {}", span(last.left, last.right))]
    Cancelled {
        /// Evaluations of the curves by then.
        evaluations: usize,
        /// The span of `x` sampled last.
        last: Interval<T>,
    },
    /// `x` is beyond one of the bodies, or NaN.
    #[error("x = {} is beyond the bodies, which both cover only {}; ask within, or extend their domains",
        apart(*x, range), span(range[0], range[1]))]
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
    /// The slope difference of the bodies nowhere goes from negative to positive, so that
    /// they do not open on both sides of a point of first contact.
    #[error(
        "no point of first contact, where a gap begins to rise: its slope is {} at x = {} and {} at x = {}; {}",
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
        "{}, or give Edge::FreeUntil({end:?}) if the bodies have a sharp corner there{}",
        borne(*end, [*carried, *load], *half_width, *peak), hint(*kappa_is_default)
    )]
    DomainTooShort {
        /// End of the bodies that the contact reaches first.
        end: T,
        /// Load carried by the largest contact that stays on the bodies, or by several contacts of
        /// the largest possible width. It does not depend on the load asked for. Zero where the
        /// bodies touch at this end first; NaN, like half-width and peak, where it is not known, as
        /// of bodies with a layer or another kernel.
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
        "no contact of half-width {wanted} fits: {}; extend the domain or lower the half-width{}",
        widest(*half_width, *end, || format!(
            "it would leave the bodies at x = {}: there is room for {}, which carries {}{}",
            six(*end), apart(*half_width, &[*wanted]), six(*load), at_peak(*peak)
        )),
        hint(*kappa_is_default), wanted = apart(*wanted, &[*half_width])
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
        /// Its peak pressure; infinite where it is held at a corner, or where the slope jumps; NaN
        /// of bodies with a layer or another kernel, whose contact is about the largest.
        peak: T,
        /// True if κ was left at its default of 1: then the stiffness may be missing.
        kappa_is_default: bool,
    },
    /// No position of a contact balances the pressures at its two edges, for some half-width.
    #[error(
        "no contact is found near x = {near}: the last that was tried, of half-width {half_width}, is not in balance; {}",
        how_to_balance(*near, *half_width), near = six(*near), half_width = six(*half_width)
    )]
    NoEquilibrium {
        /// Half-width tried last: the one asked for, if one is.
        half_width: T,
        /// Point of first contact.
        near: T,
    },
    /// The forces on a contact are beyond the range of the number type.
    #[error(
        "the forces on a contact from {} are too large or too small for these numbers: choose units in which they \
         are nearer to 1, or give a start nearer to the contact", span(interval.left, interval.right)
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
    #[error("limits not found: {source}; best so far -b = {}, a = {}",
        apart(best.left, &[best.right]), apart(best.right, &[best.left]))]
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
        "the slope of the gap at x = {x} is {slope}, where the panels say {assumed}: something narrow has been missed \
         there; declare breakpoints at its ends, or correct the curve", x = six(*x), slope = apart(*slope, &[*assumed]), assumed = apart(*assumed, &[*slope])
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
        "the limits do not balance the bodies: at the free edge x = {x} the pressure would have a singularity of \
         strength {strength}, where the limits were found to within {allowed}; declare breakpoints, give a start nearer \
         to the contact, or correct the curves, which must be the same at each call",
        x = six(*x), strength = six(*strength), allowed = six(*allowed)
    )]
    Unbalanced {
        /// Abscissa of the limit.
        x: T,
        /// Strength K of the inverse-square-root singularity there, a pressure.
        strength: T,
        /// Largest strength that the estimated errors of the limits and of the samples allow.
        allowed: T,
    },
    /// The certificate has spent its budget, or the limits are too doubtful for one.
    #[error(
        "whether the solution is the contact is not decided at x = {x}, {}; narrow the domains, declare breakpoints, \
         solve with a smaller tolerance, or move the origin to the contact if it is far away",
        if *samples > 0 { format!("after {evaluations} evaluations and {samples} samples") } else { "as the limits have too large errors".into() },
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
    /// No tilt makes the load act at the place asked for: the contact would leave the bodies.
    #[error(
        "no tilt makes the load {load} act at x = {at}: the nearest is x = {reached}, with the tilt {tilt}, and beyond \
         that the contact leaves the bodies, from x = {}; move the load inward, lower it, or extend the domain",
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
    #[error("no contact under the load {}: the adhesion gives way to a larger pull than {}, the pull-off force to about a \
         thousandth; pull less", apart(*load, &[*least]), apart(*least, &[*load]))]
    PullOff {
        /// Load per unit length asked for.
        load: T,
        /// The least load under which a contact was found: less than about a thousandth more, and
        /// the bodies come apart.
        least: T,
    },
    /// The contact with this peak pressure reaches beyond a body or a corner.
    #[error(
        "the peak pressure {wanted} takes a wider contact than there is room for: {}; extend the domains or lower the \
         peak{}",
        widest(*half_width, *end, || format!(
            "with half-width {}, up to x = {}, it is {} under the load {}",
            six(*half_width), six(*end), apart(*found, &[*wanted]), six(*load)
        )),
        hint(*kappa_is_default), wanted = apart(*wanted, &[*found])
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
    /// Corners hold the limits, or nearly: x is too coarse to tell the load from the half-width.
    #[error(
        "a half-width of {} does not tell the load: corners hold the contact there, to the rounding of x, as under \
         the load {}; give the load, or ask for a larger half-width", six(*half_width), six(*load)
    )]
    LoadUnknown {
        /// The half-width asked for.
        half_width: T,
        /// One of the loads under which the contact has this half-width.
        load: T,
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
    /// The quantity falls while the load grows, before it has the value asked for, so that it does
    /// not determine the load.
    #[error(
        "under the load {} the {quantity} no longer grows, its rate is {}: ask for less, or give the load; for an \
         approach put the references deeper, take larger lengths, or an x inside the contact", six(*load), six(*rate)
    )]
    Falls {
        /// The quantity that is given: an approach.
        quantity: &'static str,
        /// Least load known under which it falls.
        load: T,
        /// Its derivative by the load there, negative or zero.
        rate: T,
    },
    /// A table of springs with as many points as it may have is less exact than its tolerance.
    #[error("the tolerance {} is not reached: with all points that a table may have the error is {}; ask for that, or for \
         a narrower range of loads", six(*tolerance), six(*reached))]
    ToleranceNotReached {
        /// Tolerance as given, a share.
        tolerance: T,
        /// Error that is left, a share: a tolerance that can be reached.
        reached: T,
    },
    /// The load of a roller acts beyond its slices: no pressure between them has this moment.
    #[error("the load {} acts at z = {}, beyond the middles of the outermost slices, from {}: move it inward, that is, \
         lower the moment", six(*load), apart(*at, ends), span(ends[0], ends[1]))]
    LoadBeyondSlices {
        /// Load on the roller, a force.
        load: T,
        /// Place along the axis at which it acts, moment over load: a length.
        at: T,
        /// Middles of the first and the last slice.
        ends: [T; 2],
    },
    /// The load acts beyond the bodies: no pressure between them has this moment.
    #[error(
        "the load {} acts at x = {}, where the moment or the centre of pressure puts it, beyond the bodies, which both \
         cover only {}: lower the moment, move the load inward, or extend their domains",
        six(*load), apart(*at, &[ends.left, ends.right]), span(ends.left, ends.right)
    )]
    LoadBeyondBodies {
        /// Load per unit length.
        load: T,
        /// Place at which it acts: `x₀ + M/F`.
        at: T,
        /// Ends of the bodies.
        ends: Ends<T>,
    },
    /// A single slice of a roller bears the load: then the moment does not determine the
    /// misalignment.
    #[error("the slice at z = {} alone bears the load at any misalignment: give that, or take more slices", six(*z))]
    OneSlice {
        /// Place of this slice along the axis: a length.
        z: T,
    },
    /// The approach or the misalignment of a roller under its load was not found.
    #[error(
        "approach and misalignment of the roller not found: {source}; choose units in which its sizes are nearer to 1"
    )]
    RollerNotFound {
        /// Error of the search, in terms of the approach of the slice that is pressed most, or of
        /// the misalignment.
        source: SearchError<T>,
    },
    /// The force exceeds friction: the bodies slip everywhere.
    #[error("the tangential force {} is no less than friction carries, μF = {}: the bodies slip everywhere; lower it, or \
         raise the load", apart(*force, &[*limit]), apart(*limit, &[*force]))]
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
}
