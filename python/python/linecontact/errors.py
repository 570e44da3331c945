"""What can go wrong with a scene, and how to mend it.

Every error of the solver is an exception of its own, with the place and the values as attributes. All are
`LineContactError`; below it are `InputError` (a body, an edge, a load or a setting is not what it must be: the
same call fails again), `SolveError` (no contact was found, or what was found is none: another load, domain or
start may help) and `EvaluationError` (the contact is known, but not what was asked of it there).

Names are those of the Rust library: the variant `DomainTooShort` of `ContactError` is `DomainTooShortError`; those
of `ProfileError`, `PiecewiseError`, `SplineError` and `SearchError` have `Profile`, `Piecewise`, `Spline` and
`Search` before.

Examples
--------
>>> import linecontact as lc
>>> roller = lc.Parabola(10.0, (-0.1, 0.1))
>>> contact = lc.Contact(lc.Flat(), roller, contact_modulus=115e3)
>>> try:
...     contact.solve(load=500.0)
... except lc.errors.DomainTooShortError as error:
...     print(f"{error.carried:.0f} of {error.load:.0f} N/mm")
90 of 500 N/mm
"""

from __future__ import annotations


class LineContactError(Exception):
    """Whatever the solver refuses; all of its exceptions are below this one."""


class InputError(LineContactError, ValueError):
    """A body, an edge, a load or a setting is not what it must be."""


class SolveError(LineContactError):
    """No contact was found, or what was found is none."""


class EvaluationError(LineContactError):
    """The contact is known, but not what was asked of it there."""


class SearchError(SolveError):
    """A search for a root of a function of one variable has found none."""


class MissingDerivativesError(InputError, TypeError):
    """The function of a `Curve` has not returned four arrays.

    Attributes
    ----------
    count : int
        How many it has returned; 1 of one array or number alone.
    """

    count: int

    def __init__(self, count: int) -> None:
        super().__init__(count)
        self.count = count

    def __str__(self) -> str:
        returned = {0: "nothing", 1: "one array"}.get(self.count, f"{self.count} arrays")
        return (
            f"the function of a Curve has returned {returned}: it must return four, X, Y and their "
            "derivatives by k, of as many numbers as k has. For a circle of radius R by its angle:\n"
            "    def circle(k):\n"
            "        x, y = R * np.sin(k), R * (1 - np.cos(k))\n"
            "        dx, dy = R * np.cos(k), R * np.sin(k)\n"
            "        return x, y, dx, dy"
        )


class CancelledError(SolveError):
    """The solve was ended from outside. (Ctrl-C comes out as `KeyboardInterrupt`.)

    Attributes
    ----------
    evaluations : int
        Evaluations of the curves by then.
    last : tuple[float, float]
        The span of `x` sampled last.
    """

    evaluations: int
    last: tuple[float, float]


class ProfileError(InputError):
    """A profile is at fault.

    Attributes
    ----------
    body : str
        Whose profile.
    source : LineContactError
        What is wrong.
    """

    body: str
    source: LineContactError


class NoCommonRangeError(InputError):
    """The two bodies have no `x` in common.

    Attributes
    ----------
    lower : tuple[float, float]
        Range of `x` of the lower body.
    upper : tuple[float, float]
        Range of `x` of the upper body.
    """

    lower: tuple[float, float]
    upper: tuple[float, float]


class OutsideBodiesError(SolveError):
    """`x` is beyond one of the bodies, or NaN.

    Attributes
    ----------
    x : float
        Where.
    range : tuple[float, float]
        The range of `x` that both bodies cover.
    """

    x: float
    range: tuple[float, float]


class InversionError(SolveError):
    """`X(k) = x` could not be inverted.

    Attributes
    ----------
    body : str
        Whose profile.
    x : float
        The abscissa.
    source : SearchError
        What the search says, in terms of `k`.
    """

    body: str
    x: float
    source: SearchError


class InvalidLoadError(InputError):
    """The load, half-width, peak pressure or approach asked for is not finite; or it is not positive, which a load
    needs to be only where limits are sought without adhesion; or so small that it has lost digits.

    Attributes
    ----------
    quantity : str
        What was asked for: `load`, `half-width`, `peak pressure` or `approach`.
    value : float
        Its value.
    """

    quantity: str
    value: float


class InvalidKappaError(InputError):
    """κ is not a positive finite number.

    Attributes
    ----------
    kappa : float
        κ as given.
    """

    kappa: float


class InvalidModulusError(InputError):
    """The contact modulus E* is not a positive finite number, or κ = π E*/2 is none.

    Attributes
    ----------
    modulus : float
        E* as given.
    """

    modulus: float


class InvalidLimitsError(InputError):
    """Given or starting limits are not in order, or a half-width is lost in the rounding of `x`.

    Attributes
    ----------
    interval : tuple[float, float]
        The interval as given.
    """

    interval: tuple[float, float]


class InvalidEdgePressureError(InputError):
    """One of A, B, ε_a, ε_b, ε₁, ε₂ of Eq. (6) is unusable.

    Attributes
    ----------
    name : str
        Which of them.
    value : float
        Its value.
    """

    name: str
    value: float


class NoFirstContactError(SolveError):
    """The slope difference of the bodies nowhere goes from negative to positive, so that they do not open on both
    sides of a point of first contact.

    Attributes
    ----------
    x : tuple[float, float]
        Two abscissae.
    slope : tuple[float, float]
        The slope difference there.
    """

    x: tuple[float, float]
    slope: tuple[float, float]


class DomainTooShortError(SolveError):
    """The contact that carries the load reaches beyond a body; of several, the first or the last. Or the bodies touch
    at an end before any limit comes there.

    Attributes
    ----------
    end : float
        The end that the contact reaches first.
    carried : float
        The load carried by the largest contact that stays on the bodies, or by several as wide as they can be:
        the same whatever load is asked for. Zero where the bodies touch at this end first.
    load : float
        The load asked for.
    half_width : float
        The half-width of that contact; half of what lies between the first limit of several and the last.
    peak : float
        Its largest pressure; infinite where it is held at a corner, or where the slope jumps.
    kappa_is_default : bool
        Whether κ was left at its default of 1: then the stiffness may be what is missing.
    """

    end: float
    carried: float
    load: float
    half_width: float
    peak: float
    kappa_is_default: bool


class HalfWidthTooLargeError(SolveError):
    """A contact of this half-width reaches beyond a body.

    Attributes
    ----------
    wanted : float
        The half-width asked for.
    half_width : float
        The half-width of the largest contact that stays on the bodies.
    end : float
        The end that it reaches.
    load : float
        The load that it carries.
    peak : float
        Its largest pressure; infinite where it is held at a corner, or where the slope jumps.
    kappa_is_default : bool
        Whether κ was left at its default of 1: then the stiffness may be what is missing.
    """

    wanted: float
    half_width: float
    end: float
    load: float
    peak: float
    kappa_is_default: bool


class NoEquilibriumError(SolveError):
    """No position of a contact of some width balances the pressures at its two edges.

    Attributes
    ----------
    half_width : float
        Half-width tried.
    near : float
        Point of first contact.
    """

    half_width: float
    near: float


class OverflowError(SolveError):
    """The forces on a contact are beyond the range of the number type.

    Attributes
    ----------
    interval : tuple[float, float]
        The contact.
    """

    interval: tuple[float, float]


class BudgetSpentError(SolveError):
    """The search has spent its budget of evaluations.

    Attributes
    ----------
    evaluations : int
        Evaluations of the curves, or values of the slope of the gap, by then.
    budget : int
        How many may be made: 2²⁰ and 1024 for each piece of the bodies; by Midpoint, which keeps no samples,
        sixteen times as many, and besides what 4096 pressures take.
    last : tuple[float, float]
        The span of `x` sampled last.
    """

    evaluations: int
    budget: int
    last: tuple[float, float]


class LimitSearchError(SolveError):
    """The search for the limits gave up.

    Attributes
    ----------
    best : tuple[float, float]
        The best limits so far.
    source : SearchError
        What the search says, in terms of the half-width or the distance from the point of first contact.
    """

    best: tuple[float, float]
    source: SearchError


class EdgePressureNotMetError(SolveError):
    """The limits are as good as the numbers allow, but Eq. (6) is not met.

    Attributes
    ----------
    best : tuple[float, float]
        The best limits.
    at_a : float
        What is left at `a`.
    at_b : float
        What is left at `-b`.
    """

    best: tuple[float, float]
    at_a: float
    at_b: float


class InvalidSegmentsError(InputError):
    """Zero segments, or more points than can be counted.

    Attributes
    ----------
    segments : int
        N.
    extrapolations : int
        ET.
    """

    segments: int
    extrapolations: int


class SingularError(EvaluationError):
    """The pressure where it is infinite: at a fixed or adhesive edge, at one where Eq.

    (6) has left a singularity, or where the slope of a body jumps.

    Attributes
    ----------
    x : float
        Where.
    """

    x: float


class InconsistentHeightsError(InputError):
    """A body's Y does not go with its Y', so that heights and slopes of the gap contradict each other: a step in
    Y, or a wrong derivative, of which check_derivatives tells which body it is.

    Attributes
    ----------
    between : tuple[float, float]
        Two places.
    by_heights : float
        `Y₂ - Y₁` at the second, less that at the first.
    by_slopes : float
        `∫ (Y₂'/X₂' - Y₁'/X₁') dx` from the first to the second.
    """

    between: tuple[float, float]
    by_heights: float
    by_slopes: float


class NotConvexError(InputError):
    """The bodies declare that they bulge towards each other, but the slope of the gap falls.

    Attributes
    ----------
    between : tuple[float, float]
        Two places, the left one first; the same one twice where the slope jumps.
    slopes : tuple[float, float]
        The slopes of the gap there, before the bodies turn: ratios of lengths.
    """

    between: tuple[float, float]
    slopes: tuple[float, float]


class TensionError(SolveError):
    """The bodies would have to pull at each other inside the contact: they part there.

    Attributes
    ----------
    x : float
        Where the pressure is negative.
    pressure : float
        What it would be there; minus infinity where the slope of the gap jumps down.
    interval : tuple[float, float]
        What solves the equations with it: the first and the last limit, and the load.
    load : float
        The load per unit length of that.
    """

    x: float
    pressure: float
    interval: tuple[float, float]
    load: float


class LiftsOffError(SolveError):
    """A fixed edge at which the body lifts off: the singularity of the pressure there is negative, or none.

    Attributes
    ----------
    x : float
        The corner.
    strength : float
        K, see `Solution.edge_singularities`.
    interval : tuple[float, float]
        What solves the equations with it.
    load : float
        The load per unit length of that.
    """

    x: float
    strength: float
    interval: tuple[float, float]
    load: float


class OverlapError(SolveError):
    """The bodies would overlap outside the contact: they touch there as well.

    Attributes
    ----------
    x : float
        Where.
    gap : float
        The gap there, negative.
    interval : tuple[float, float]
        What solves the equations with it: the first and the last limit.
    load : float
        The load per unit length of that.
    """

    x: float
    gap: float
    interval: tuple[float, float]
    load: float


class FeatureMissedError(SolveError):
    """The slope of the gap inside the contact is not what the samples say from which the contact was found:
    something lies between two of them.

    Attributes
    ----------
    x : float
        Where.
    slope : float
        The slope of the gap.
    assumed : float
        What it was taken for.
    """

    x: float
    slope: float
    assumed: float


class UnbalancedError(SolveError):
    """The samples of the certificate leave a pressure at a free edge that is not that of the contact: what the
    limits were found from was not the whole of the curves.

    Attributes
    ----------
    x : float
        The limit.
    strength : float
        The strength K of the inverse-square-root singularity there, a pressure.
    allowed : float
        How large it may be by the estimated error of the limits, and by that of the samples.
    """

    x: float
    strength: float
    allowed: float


class UndecidedError(SolveError):
    """The certificate has spent its budget.

    Attributes
    ----------
    x : float
        Where it has stopped.
    evaluations : int
        Evaluations of the curves by then.
    samples : int
        Values of the slope of the gap by then.
    """

    x: float
    evaluations: int
    samples: int


class InvalidToleranceError(InputError):
    """The tolerance of the panels is negative, one or more, or NaN.

    Attributes
    ----------
    tolerance : float
        The tolerance as given.
    """

    tolerance: float


class InvalidResolutionError(InputError):
    """The resolution is not a length, or lost in the rounding of x.

    Attributes
    ----------
    resolution : float
        The resolution as given: a length.
    least : float
        The least length that the rounding of x in the contact allows; zero where none was found yet.
    """

    resolution: float
    least: float


class InvalidAdhesionError(InputError):
    """A work of adhesion is negative or not finite.

    Attributes
    ----------
    work : float
        The work of adhesion as given.
    """

    work: float


class BothLimitsGivenError(InputError):
    """Limits that are both given leave nothing to be sought: only a load can be asked of them.

    Attributes
    ----------
    interval : tuple[float, float]
        The limits.
    """

    interval: tuple[float, float]


class InvalidMomentError(InputError):
    """A moment, or the place where a load acts, is not finite.

    Attributes
    ----------
    value : float
        The value.
    """

    value: float


class TiltNotSupportedError(InputError):
    """A moment, or the place where the load acts, was asked for where the bodies cannot be turned.

    Attributes
    ----------
    why : str
        What stands in the way.
    """

    why: str


class TiltNotFoundError(SolveError):
    """No tilt is found under which the load acts at the place asked for: the contact would leave the bodies.

    Attributes
    ----------
    load : float
        Load per unit length asked for.
    at : float
        Where it was to act: `x₀ + M/F`.
    reached : float
        The nearest place at which a contact was found that bears it.
    tilt : float
        The tilt of that contact.
    ends : tuple[float, float]
        Where the bodies end.
    """

    load: float
    at: float
    reached: float
    tilt: float
    ends: tuple[float, float]


class PullOffError(SolveError):
    """The bodies come apart: the pull is more than adhesion can bear.

    Attributes
    ----------
    load : float
        Load per unit length asked for.
    least : float
        The least load under which a contact was found.
    """

    load: float
    least: float


class PeakEdgeError(InputError):
    """An edge was asked for at which the pressure is not bounded, and a peak pressure with it.

    Attributes
    ----------
    edge : tuple[str, float | None]
        The edge asked for.
    """

    edge: tuple[str, float | None]


class PeakTooHighError(SolveError):
    """The contact with this peak pressure reaches beyond a body, or beyond a corner.

    Attributes
    ----------
    wanted : float
        The peak pressure asked for.
    half_width : float
        The largest half-width that there is room for.
    found : float
        The peak pressure there.
    end : float
        The end of the bodies, or the corner, that this contact reaches.
    load : float
        The load that it carries.
    kappa_is_default : bool
        Whether κ was left at its default of 1: then the stiffness may be what is missing.
    """

    wanted: float
    half_width: float
    found: float
    end: float
    load: float
    kappa_is_default: bool


class NoPeakError(SolveError):
    """The pressure has no largest value to be set.

    Attributes
    ----------
    wanted : float
        The peak pressure asked for.
    half_width : float
        The half-width tried last.
    found : float
        The peak pressure there; infinite where the slope of a body jumps.
    """

    wanted: float
    half_width: float
    found: float


class InJumpError(SolveError):
    """A half-width, peak pressure or approach that no load has: it jumps where a contact is born or a corner reached.

    Attributes
    ----------
    wanted : float
        The value asked for.
    load : float
        The load at which it jumps.
    below : float
        The value under less; 0 where there is none.
    above : float
        The value under more; infinite where the pressure is.
    """

    wanted: float
    load: float
    below: float
    above: float


class AboveSurfaceError(EvaluationError):
    """A point is above the surface, or not finite.

    Attributes
    ----------
    x : float
        Abscissa.
    depth : float
        Depth below the surface.
    """

    x: float
    depth: float


class InvalidPoissonRatioError(InputError):
    """Poisson's ratio is not one of an isotropic body that contracts when pulled.

    Attributes
    ----------
    ratio : float
        As given.
    """

    ratio: float


class InvalidYoungsModulusError(InputError):
    """Young's modulus is not a positive finite number.

    Attributes
    ----------
    body : str
        Whose.
    modulus : float
        As given.
    """

    body: str
    modulus: float


class BothRigidError(InputError):
    """Both bodies are rigid: there is no pressure then."""


class NoMaterialsError(InputError):
    """An approach was asked for, but not what the bodies are made of: E* alone does not tell how much of it each
    of them gives."""


class InvalidReferenceError(InputError):
    """The depth, radius or length of a reference is not a positive finite number, or a disc is smaller than the
    contact.

    Attributes
    ----------
    length : float
        As given.
    """

    length: float


class ApproachTooLargeError(SolveError):
    """No contact that stays on the bodies has this approach.

    Attributes
    ----------
    wanted : float
        The approach asked for.
    approach : float
        About the largest approach of a contact that stays on the bodies.
    load : float
        The load of that.
    """

    wanted: float
    approach: float
    load: float


class OutsideTableError(EvaluationError):
    """An approach that a table of a spring does not cover.

    Attributes
    ----------
    approach : float
        As given.
    range : tuple[float, float]
        From the least to the largest in the table.
    """

    approach: float
    range: tuple[float, float]


class ApproachFallsError(SolveError):
    """The approach to these references does not grow with the load: no load goes with it alone.

    Attributes
    ----------
    load : float
        Where it was seen.
    rate : float
        dδ/dF there, negative or zero.
    """

    load: float
    rate: float


class InvalidFrictionError(InputError):
    """The coefficient of friction is not finite.

    Attributes
    ----------
    coefficient : float
        As given.
    """

    coefficient: float


class InvalidSlipFrictionError(InputError):
    """The coefficient of friction of partial slip is not a positive finite number.

    Attributes
    ----------
    friction : float
        μ as given.
    """

    friction: float


class InvalidShearError(InputError):
    """The force or the tension of partial slip is not finite.

    Attributes
    ----------
    quantity : str
        `force` or `tension`.
    value : float
        As given.
    """

    quantity: str
    value: float


class SlipsEverywhereError(SolveError):
    """Friction does not carry the force: the bodies slip everywhere.

    Attributes
    ----------
    force : float
        Q.
    limit : float
        μF.
    """

    force: float
    limit: float


class SticksEverywhereError(SolveError):
    """The force is so small beside what friction carries that the slip zones, and the traction with them, are lost in
    rounding. Without slip the traction is the force times the rate of the pressure with the load.

    Attributes
    ----------
    force : float
        Q.
    limit : float
        μF.
    """

    force: float
    limit: float


class ReversedSlipError(SolveError):
    """The bodies would stick beside the contact: with so large a tension, or so small a force, slip reverses while
    the force grows, and the history counts.

    Attributes
    ----------
    zone : tuple[float, float]
        Where they would stick.
    contact : tuple[float, float]
        The contact nearest to it.
    """

    zone: tuple[float, float]
    contact: tuple[float, float]


class UnlikeBodiesError(InputError):
    """Friction on bodies of different elasticity changes the pressure.

    Attributes
    ----------
    beta : float
        β in plane strain, from -1/2 to 1/2.
    """

    beta: float


class SlipNotSupportedError(InputError):
    """Partial slip is not known with these conditions.

    Attributes
    ----------
    why : str
        What stands in the way.
    """

    why: str


class InvalidPositionError(EvaluationError):
    """A point is not inside the contact, or not outside it, as it has to be.

    Attributes
    ----------
    x : float
        Where.
    inside : bool
        Whether it had to be strictly inside.
    interval : tuple[float, float]
        The contact.
    """

    x: float
    inside: bool
    interval: tuple[float, float]


class NoLoadDerivativeError(EvaluationError):
    """The load does not change the contact in a way that is known.

    Attributes
    ----------
    why : str
        What stands in the way.
    """

    why: str


class EdgePressureLoadError(InputError):
    """Conditions at the edges by the paper's Eq. (6) leave nothing else to be asked for than a load."""


class LengthMismatchError(EvaluationError):
    """There is not one place for each pressure.

    Attributes
    ----------
    x : int
        Number of abscissae.
    pressures : int
        Number of places for pressures.
    """

    x: int
    pressures: int


class IntegralError(EvaluationError):
    """An integral over the pressure has not converged.

    Attributes
    ----------
    x : float
        The abscissa that it was for.
    panels : int
        Panels tried.
    """

    x: float
    panels: int


class UnresolvedError(EvaluationError):
    """The quadrature has no correct digit of the pressure: `x` is too close to an edge for its segments.

    Attributes
    ----------
    x : float
        Where.
    pressure : float
        What the rule gives.
    error : float
        Its estimated error.
    """

    x: float
    pressure: float
    error: float


class ProfileParameterError(InputError):
    """A parameter has a value for which there is no such shape.

    Attributes
    ----------
    name : str
        Which parameter.
    value : float
        Its value.
    must : str
        What it must be.
    """

    name: str
    value: float
    must: str


class ProfileJoinedError(InputError):
    """A profile of several pieces where a smooth one is wanted.

    Attributes
    ----------
    pieces : int
        How many it has.
    """

    pieces: int


class ProfileDomainError(InputError):
    """The range of `k` is empty, reversed, or not finite.

    Attributes
    ----------
    from_ : float
        Start of the range.
    to : float
        End of the range.
    """

    from_: float
    to: float


class ProfileNotFiniteError(InputError):
    """The curve returned NaN or an infinity.

    Attributes
    ----------
    quantity : str
        `X`, `Y`, `X'` or the slope `Y'/X'`.
    k : float
        Where.
    value : float
        What it is there.
    """

    quantity: str
    k: float
    value: float


class ProfileDerivativeError(InputError):
    """A derivative is not that of its function.

    Attributes
    ----------
    quantity : str
        `X'` or `Y'`.
    k : float
        Where.
    given : float
        What the profile says.
    difference : float
        The central difference.
    """

    quantity: str
    k: float
    given: float
    difference: float


class ProfileTurnsBackError(InputError):
    """`X` does not rise, or fall, all the way.

    Attributes
    ----------
    k : float
        Parameter of the turning point, as near as it was found.
    x : float
        `X` there.
    domain : tuple[float, float]
        The range of `k` of the curve.
    """

    k: float
    x: float
    domain: tuple[float, float]


class ProfilePiecesError(InputError):
    """A compound profile does not have the pieces that it says it has.

    Attributes
    ----------
    count : int
        How many pieces it says it has.
    index : int
        A piece at fault.
    """

    count: int
    index: int


class PiecewiseInPieceError(InputError):
    """A piece is at fault by itself.

    Attributes
    ----------
    piece : int
        Index of the piece.
    source : LineContactError
        What is wrong with it.
    """

    piece: int
    source: LineContactError


class PiecewiseToleranceError(InputError):
    """The tolerance is negative, NaN or infinite.

    Attributes
    ----------
    tolerance : float
        The tolerance as given.
    """

    tolerance: float


class PiecewiseNoPiecesError(InputError):
    """There are no pieces."""


class PiecewiseGapError(InputError):
    """Two neighbours do not meet: `x` between them belongs to neither.

    Attributes
    ----------
    breakpoint : int
        Index of the breakpoint, 0 between the first two pieces.
    left : float
        Where the left piece ends.
    right : float
        Where the right piece starts.
    """

    breakpoint: int
    left: float
    right: float


class PiecewiseOverlapError(InputError):
    """Two neighbours overlap: `x` between them belongs to both. Also what pieces in the wrong order look like.

    Attributes
    ----------
    breakpoint : int
        Index of the breakpoint, 0 between the first two pieces.
    left : float
        Where the left piece ends.
    right : float
        Where the right piece starts.
    """

    breakpoint: int
    left: float
    right: float


class PiecewiseJumpError(InputError):
    """Two neighbours meet at different heights.

    Attributes
    ----------
    breakpoint : int
        Index of the breakpoint, 0 between the first two pieces.
    x : float
        Where.
    left : float
        `Y` at the end of the left piece.
    right : float
        `Y` at the start of the right piece.
    """

    breakpoint: int
    x: float
    left: float
    right: float


class SplineTooFewError(InputError):
    """There are not enough of them.

    Attributes
    ----------
    points : int
        How many there are.
    """

    points: int


class SplineNotFiniteError(InputError):
    """A coordinate is NaN or infinite.

    Attributes
    ----------
    row : int
        Row of the point.
    x : float
        Its x.
    y : float
        Its y.
    """

    row: int
    x: float
    y: float


class SplineDuplicateError(InputError):
    """Two neighbours have one x, or x so near that their distance is lost.

    Attributes
    ----------
    row : int
        Row of the second.
    x : float
        Their x.
    """

    row: int
    x: float


class SplineUnsortedError(InputError):
    """x falls from one point to the next.

    Attributes
    ----------
    row : int
        Row of the second.
    x : float
        Its x.
    before : float
        x of the row before.
    """

    row: int
    x: float
    before: float


class SplineOutlierError(InputError):
    """A point is off the curve through its neighbours.

    Attributes
    ----------
    row : int
        Row of the point, the one that is furthest off.
    x : float
        Its x.
    y : float
        Its y.
    expected : float
        `Y` there of the cubic through its four neighbours.
    deviations : float
        How far off it is.
    """

    row: int
    x: float
    y: float
    expected: float
    deviations: float


class SplineNoiseError(InputError):
    """The noise is negative, NaN or infinite.

    Attributes
    ----------
    noise : float
        The noise as given.
    """

    noise: float


class SplineLimitError(InputError):
    """The limit for outliers is not positive.

    Attributes
    ----------
    deviations : float
        The limit as given.
    """

    deviations: float


class SplineNothingLeftError(InputError):
    """A straight line is as close to the points as the noise allows.

    Attributes
    ----------
    noise : float
        The noise as given.
    line : float
        Root mean square distance of the points from the line.
    """

    noise: float
    line: float


class SplineOverflowError(InputError):
    """The curve up to a point is beyond the range of the number type.

    Attributes
    ----------
    row : int
        Row of the point.
    x : float
        Its x.
    before : float
        x of the row before.
    """

    row: int
    x: float
    before: float


class SplineSmoothingError(InputError):
    """The smoothing that the noise asks for was not found: the squares of the numbers overflow.

    Attributes
    ----------
    source : SearchError
        Where the search for it stood.
    """

    source: SearchError


class SearchBracketError(SearchError):
    """The bracket has a NaN or infinite end, or its ends are the wrong way round.

    Attributes
    ----------
    lo : float
        Lower end as given.
    hi : float
        Upper end as given.
    """

    lo: float
    hi: float


class SearchNoSignChangeError(SearchError):
    """The function has the same sign at both ends.

    Attributes
    ----------
    lo : float
        Lower end.
    hi : float
        Upper end.
    f_lo : float
        Value at the lower end.
    f_hi : float
        Value at the upper end.
    """

    lo: float
    hi: float
    f_lo: float
    f_hi: float


class SearchNotFiniteError(SearchError):
    """The function returned NaN or an infinity.

    Attributes
    ----------
    x : float
        Where.
    value : float
        What it returned.
    """

    x: float
    value: float


class SearchBudgetError(SearchError):
    """The evaluations ran out.

    Attributes
    ----------
    best : tuple of float and int
        The best point so far: where, the residual there, the evaluations.
    """

    best: tuple[float, float, int]


class SearchLeftBracketError(SearchError):
    """A strategy has looked at, or returned, a point that is not in the bracket it was given.

    Attributes
    ----------
    x : float
        Where it went.
    lo : float
        Lower end of the bracket.
    hi : float
        Upper end of the bracket.
    """

    x: float
    lo: float
    hi: float


class SearchNotConvergedError(SearchError):
    """A strategy has stopped where the function is still far from zero.

    Attributes
    ----------
    x : float
        What it returned.
    residual : float
        The function there.
    """

    x: float
    residual: float


class SearchToleranceError(SearchError):
    """A tolerance is negative, NaN or infinite.

    Attributes
    ----------
    value : float
        The tolerance as given.
    """

    value: float
