"""Solutions, and the quantities that follow from them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, overload

import numpy as np

from . import _native
from ._numbers import (
    FloatArray,
    Numbers,
    as_count,
    as_number,
    as_numbers,
    as_range,
    as_references,
    as_side,
    each,
    refusal,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from .contact import Contact, References
    from .slipping import PartialSlip, Side

__all__ = [
    "Approach",
    "Attempt",
    "Certificate",
    "Conformity",
    "ContactRegion",
    "Cost",
    "Extremum",
    "Interval",
    "LoadRates",
    "Peak",
    "Solution",
    "Stress",
    "StressPeak",
    "Summary",
    "Uncertainty",
]

# Largest x that counts as 0, in half-widths: places of largest values have half of the digits.
ROUNDING = 1e-7

Prescribed = tuple[str, list[float], "References | None"]


class Interval(NamedTuple):
    """An interval of x: lengths.

    Examples
    --------
    >>> import linecontact as lc
    >>> lc.Interval(-0.25, 0.75).centre
    0.25
    """

    left: float
    right: float

    @property
    def half_width(self) -> float:
        """Half-width: a length."""
        return 0.5 * (self.right - self.left)

    @property
    def centre(self) -> float:
        """Centre: a length."""
        return 0.5 * self.left + 0.5 * self.right


class Peak(NamedTuple):
    """A largest pressure and its x, a pressure and a length, with the estimated error of the pressure.

    The error is above rounding next to a corner that is no breakpoint, or of a coarse quadrature.
    """

    x: float
    pressure: float
    error: float


class Extremum(NamedTuple):
    """An extreme value and its x."""

    x: float
    value: float


class StressPeak(NamedTuple):
    """A largest stress, a pressure, with its x and depth, lengths."""

    x: float
    depth: float
    value: float


class Uncertainty(NamedTuple):
    """Standard deviations that the noise of measured points leaves in a contact under its load.

    Attributes
    ----------
    a, b : float
        Standard deviations of the limits: lengths.
    half_width : float
        Standard deviation of the half-width: a length.
    peak_pressure : float
        Standard deviation of the largest pressure: a pressure.
    """

    a: float
    b: float
    half_width: float
    peak_pressure: float


class Conformity(NamedTuple):
    """What half-planes cost in place of a pin and its hole: estimates for like materials.

    The pressure in the middle is compared with that of a pin in a hole under the same load, which
    is the largest there.

    Attributes
    ----------
    angle : float
        Angle that the surfaces have at the limits, the mean of both bodies: radians.
    too_low : float
        Share by which the pressure in the middle is too low.
    parabolas_too_low : float
        Share by which it is too low if parabolas stand for circles, as in Hertz's formulas.
    """

    angle: float
    too_low: float
    parabolas_too_low: float


class Approach(NamedTuple):
    """The distances by which two bodies come together: lengths.

    Attributes
    ----------
    bodies : float
        Decrease in distance of the two references since the bodies just touched.
    lower, upper : float
        Approach of the surface of each body to its own reference.
    """

    bodies: float
    lower: float
    upper: float


class Cost(NamedTuple):
    """The cost of finding the limits: counts.

    Attributes
    ----------
    samples : int
        Number of values of the slope of the gap.
    evaluations : int
        Number of points of the curves.
    heights : int
        Number of further points, for the heights of the bodies as a whole.
    searches : int
        Number of searches for the parameter of an abscissa or for the limits, besides those for
        heights.
    search_values : int
        Number of values of a function taken in these searches.
    """

    samples: int
    evaluations: int
    heights: int
    searches: int
    search_values: int


class Attempt(NamedTuple):
    """A start of the search, and its outcome."""

    start: str
    outcome: str


class Certificate(NamedTuple):
    """A proof that a solution is a contact.

    There is no tension inside, and no overlap up to the ends of the bodies.

    Attributes
    ----------
    pressure : Extremum or None
        Smallest ratio of the pressure to the pressure of a smooth body, and its x. None where the
        slope of the gap rises throughout, so that there is pressure everywhere, and between
        adhesive edges, which may pull.
    gap : Extremum or None
        Smallest gap where the bodies approach each other again, a length, and its x. None where
        they do not.
    spacing : float
        Length of the longest cell: a feature at least a quarter as wide cannot have been missed. It
        is a 400th of the bodies, or four times the resolution of the contact if that is shorter.
    cost : Cost
        Cost of the certificate.
    is_proved : bool
        True if no sign hangs on rounding: `pressure` and `gap` are positive, or None. Else the
        pressure touches zero, or the bodies touch once more, to within rounding or the estimated
        error of the limits.
    """

    pressure: Extremum | None
    gap: Extremum | None
    spacing: float
    cost: Cost
    is_proved: bool


class ContactRegion(NamedTuple):
    """One of the contacts of a solution.

    Attributes
    ----------
    interval : Interval
        Limits: lengths.
    load : float
        Load per unit length: force/length.
    edge_singularities : (float, float)
        Strengths of the singularities at the left and the right limit: pressures.
    peak : Peak
        Largest pressure: `inf`, with the x of the corner, where it is infinite.
    moment : float
        Moment about x = 0: a force.
    centre_of_pressure : float or None
        A length; None without a load.
    held : (bool, bool)
        Whether a corner holds the left and the right limit: an end of the bodies, or a breakpoint
        where the gap opens steeply.
    """

    interval: Interval
    load: float
    edge_singularities: tuple[float, float]
    peak: Peak
    moment: float
    centre_of_pressure: float | None
    held: tuple[bool, bool]


class Summary(NamedTuple):
    """A solution as a row of numbers, without the bodies.

    Attributes
    ----------
    intervals : tuple of Interval
        Intervals in which the bodies touch: lengths.
    load : float
        Load per unit length, of all contacts: force/length.
    loads : tuple of float
        Load per unit length of each contact: force/length.
    kappa : float
        Scale κ = π E*/2: a pressure.
    tilt : float
        Tilt of the upper body, counter-clockwise: radians.
    mean_pressure : float
        Load over the widths of all contacts: a pressure.
    peak : Peak
        Largest pressure: `inf`, with the x of the corner, where it is infinite.
    centre_of_pressure : float or None
        A length; None without a load.
    edge_singularities : (float, float)
        Strengths of the singularities at the first and the last limit: pressures.
    limits_error : float or None
        Estimated error of the limits, as a share of the half-width; None if both were given.
    checked : bool
        True if the solution was checked to be the contact of the bodies.
    cost : Cost
        Cost of finding the limits.
    attempts : tuple of Attempt
        Starts that were tried.
    """

    intervals: tuple[Interval, ...]
    load: float
    loads: tuple[float, ...]
    kappa: float
    tilt: float
    mean_pressure: float
    peak: Peak
    centre_of_pressure: float | None
    edge_singularities: tuple[float, float]
    limits_error: float | None
    checked: bool
    cost: Cost
    attempts: tuple[Attempt, ...]


class Stress(NamedTuple):
    """Stress below the surface in plane strain, tension positive: pressures, numbers or arrays.

    Attributes
    ----------
    sigma_x, sigma_y : float or ndarray
        Normal stresses along the surface and across it.
    tau_xy : float or ndarray
        Shear stress, with y into the body.

    Examples
    --------
    >>> import linecontact as lc
    >>> lc.Stress(0.0, 0.0, 2.0).max_shear()
    2.0
    """

    sigma_x: Any
    sigma_y: Any
    tau_xy: Any

    def principal(self) -> tuple[Any, Any]:
        """Returns the principal stresses in the plane, the larger one first: pressures."""
        mean, radius = 0.5 * (self.sigma_x + self.sigma_y), self.max_shear()
        return mean + radius, mean - radius

    def max_shear(self) -> Any:
        """Returns the largest shear stress in the plane: a pressure."""
        return _plain(np.hypot(0.5 * (self.sigma_x - self.sigma_y), self.tau_xy))

    def sigma_z(self, poisson_ratio: float) -> Any:
        """Returns ν (σ_x + σ_y), the stress that keeps the strain plane: a pressure."""
        return _ratio(poisson_ratio) * (self.sigma_x + self.sigma_y)

    def von_mises(self, poisson_ratio: float) -> Any:
        """Returns the von Mises equivalent stress in plane strain: a pressure."""
        share = 0.5 - _ratio(poisson_ratio)
        sum_ = self.sigma_x + self.sigma_y
        return _plain(np.hypot(share * sum_, 3.0**0.5 * self.max_shear()))


def _plain(value: Any) -> Any:
    return float(value) if np.ndim(value) == 0 else value


def placed(contacts: Sequence[Interval], x: float, *values: float) -> tuple[Any, ...]:
    """Returns the place of a largest value, 0 if it is 0 to rounding beside the narrowest contact, and the values."""
    width = min((on.half_width for on in contacts), default=0.0)
    return x if abs(x) >= ROUNDING * width else 0.0, *values


def _ratio(given: float) -> float:
    """Returns Poisson's ratio; refuses an impossible one."""
    ratio = as_number(given, "poisson_ratio")
    if not 0.0 <= ratio <= 0.5:
        says = f"Poisson's ratio is {ratio}: it must be from 0 to 1/2, as 0.3 of steel"
        raise refusal("InvalidPoissonRatioError", says, body=None, ratio=ratio)
    return ratio


def _stress(of: Callable[[FloatArray, FloatArray], tuple[FloatArray, FloatArray, FloatArray]],
            x: Any, depth: Any) -> Stress:  # fmt: skip
    places, depths = as_numbers(x, "x"), as_numbers(depth, "depth")
    try:
        places, depths = np.broadcast_arrays(places, depths)
    except ValueError:
        shapes = f"x has the shape {places.shape}, depth {depths.shape}"
        raise ValueError(f"{shapes}: give as many of each, or one number for all") from None
    parts = of(places.ravel(), depths.ravel())
    return Stress(*(_plain(part.reshape(places.shape)) for part in parts))


class LoadRates:
    """The derivatives of limits and pressure by the load, from `Solution.load_rates`.

    Examples
    --------
    >>> import linecontact as lc
    >>> solution = lc.solve(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), kappa=1.0, load=0.02)
    >>> round(solution.load_rates().a, 12)  # R/(κ L)
    5.0
    """

    __slots__ = ("_rates",)

    def __init__(self, rates: _native.LoadRates) -> None:
        self._rates = rates

    @property
    def a(self) -> float:
        """da/dF: length² per force."""
        return self._rates.a

    @property
    def b(self) -> float:
        """db/dF: length² per force."""
        return self._rates.b

    @property
    def limits(self) -> list[tuple[float, float]]:
        """dx/dF of the left and the right limit of each contact: length² per force."""
        return self._rates.limits

    @overload
    def pressure(self, x: float) -> float: ...
    @overload
    def pressure(self, x: Numbers) -> FloatArray: ...
    def pressure(self, x: float | Numbers) -> float | FloatArray:
        """Returns ∂P/∂F at fixed x, one over a length; zero outside the contacts."""
        return each(self._rates.pressure, x)

    def __repr__(self) -> str:
        return f"LoadRates(a={self.a!r}, b={self.b!r})"


class Solution:
    """A solved contact: its limits, and on request its pressure and derived quantities.

    `Contact.solve` and `Solver.solve` create it. Wherever an `x` is an argument, it may be an array
    of any shape, and the result has this shape. A pickled solution holds its contact and the
    prescribed quantities, and is solved again when it is loaded. A cold solve is then reproduced to
    the last bit, a solve by a `Solver` to rounding.

    Attributes
    ----------
    contact : Contact
        The scene.

    Examples
    --------
    >>> import numpy as np
    >>> import linecontact as lc
    >>> body = lc.Parabola(1.0, (-1.0, 1.0))
    >>> solution = lc.Contact(lc.Flat(), body, kappa=1.0).solve(load=0.02)
    >>> solution
    <Solution: contact [-0.2, 0.2], load 0.02, checked>
    >>> solution.pressure(np.array([-0.3, 0.0, 0.1])).round(12)
    array([0.        , 0.06366198, 0.05513289])
    """

    __slots__ = ("_contact", "_found", "_prescribed")

    def __init__(
        self, found: _native.Solution, contact: Contact, prescribed: Prescribed
    ) -> None:
        self._found, self._contact, self._prescribed = found, contact, prescribed

    @property
    def contact(self) -> Contact:
        """The scene."""
        return self._contact

    def __reduce__(self) -> tuple[Any, ...]:
        return _solved_again, (self._contact, self._prescribed)

    # Limits, intervals and load.

    @property
    def a(self) -> float:
        """Limit a, a length: the contact ends at x = a."""
        return self._found.a

    @property
    def b(self) -> float:
        """Limit b, a length: the contact starts at x = -b."""
        return self._found.b

    @property
    def half_width(self) -> float:
        """Half-width (a + b)/2, of several contacts from the first limit to the last: a length."""
        return self._found.half_width

    @property
    def centre(self) -> float:
        """Centre (a - b)/2: a length."""
        return self._found.centre

    @property
    def hull(self) -> Interval:
        """Interval from the first limit to the last: lengths."""
        return Interval(-self._found.b, self._found.a)

    @property
    def intervals(self) -> tuple[Interval, ...]:
        """Intervals in which the bodies touch, from left to right: lengths."""
        return tuple(Interval(*on) for on in self._found.intervals)

    @property
    def is_apart(self) -> bool:
        """True if no load presses the bodies together: they touch in a point, or are apart.

        Then there are no intervals and no pressure, and both limits are the place where the bodies
        touch first.
        """
        return self._found.is_apart

    @property
    def separation(self) -> float:
        """Least distance of the bodies, a length: 0 unless they are apart."""
        return self._found.separation

    @property
    def load(self) -> float:
        """Load per unit length, of all contacts: force/length."""
        return self._found.load

    @property
    def tilt(self) -> float:
        """Tilt of the upper body, counter-clockwise, if a moment was given: radians."""
        return self._found.tilt

    # Accuracy, checks and cost.

    @property
    def limits_error(self) -> float | None:
        """Estimated error of the limits, as a share of the half-width; None if both were given."""
        return self._found.limits_error

    @property
    def edge_singularities(self) -> tuple[float, float]:
        """Strengths `(K_b, K_a)` of the singularities at the limits: pressures, zero at free edges.

        The singularities are inverse square roots.
        """
        left, right = self._found.edge_singularities
        return left, right

    @property
    def attempts(self) -> tuple[Attempt, ...]:
        """Starts that the search has tried; the last one has led to the solution."""
        return tuple(Attempt(*attempt) for attempt in self._found.attempts)

    @property
    def is_checked(self) -> bool:
        """True if this was checked to be the contact of the bodies, as far as the samples show.

        The solve trusts the declared convexity of a `Curve`; `certify` does not. The solution is
        not checked if a limit is uncertain by more than a 1600th of the half-width
        (`limits_error`).
        """
        return self._found.is_checked

    @property
    def is_steep(self) -> bool:
        """True if a slope exceeds 0.3, too much for half-planes: check the units.

        It is that of the gap at the limits of the contacts, or the steepest of either surface, but
        for a thousandth of each contact at either limit, where bodies may bear on the edge of a wall.
        """
        return self._found.is_steep

    @property
    def conformity(self) -> Conformity | None:
        """How far the bodies conform like a pin and its hole; None if they do not.

        They do if, at both limits of one contact, both surfaces rise from it, or both fall, and
        each body turns by 9.1 degrees or more to either side. None with layers too, and between
        edges that are not free.

        Examples
        --------
        >>> import math
        >>> import linecontact as lc
        >>> hole, pin = (lc.Ellipse.circle(radius, (-1.5, 1.5)) for radius in (10.02, 10.0))
        >>> solution = lc.solve(hole, pin, contact_modulus=115e3, load=240.0)
        >>> round(math.degrees(solution.conformity.angle)), round(solution.conformity.too_low, 3)
        (20, 0.026)
        """
        found = self._found.conformity
        return None if found is None else Conformity(*found)

    @property
    def cost(self) -> Cost:
        """Cost of finding the limits."""
        return Cost(*self._found.cost)

    def uncertainty(self) -> Uncertainty:
        """Returns the standard deviations that the noise of measured points leaves in the contact.

        They are for bodies by `Spline` with `smooth=True`, and 0 for exact bodies. They hold under
        the load of the solution, whatever was prescribed. Compare `limits_error`, the numerical
        error for the bodies as given. They are too small where the curvature of a body jumps:
        docs/accuracy.md says by how much.

        Returns
        -------
        Uncertainty
            Standard deviations of limits and half-width, lengths, and of the largest pressure.

        Raises
        ------
        linecontact.errors.NoUncertaintyError
            For several contacts. Other errors are those of `load_rates` and `peak`.

        Examples
        --------
        >>> import numpy as np
        >>> import linecontact as lc
        >>> x = np.linspace(-1, 1, 401)
        >>> heights = x**2 / 2 + 1e-5 * np.random.RandomState(1).normal(size=x.size)
        >>> body = lc.Spline(np.column_stack([x, heights]), smooth=True)
        >>> solution = lc.solve(lc.Flat(), body, kappa=1.0, load=0.02)
        >>> off = solution.half_width - 0.2  # sqrt(2 F R/κ) of the parabola
        >>> abs(off) < 3 * solution.uncertainty().half_width < 1e-3
        True
        """
        return Uncertainty(*self._found.uncertainty())

    def steepest_slope(self) -> float:
        """Returns the largest slope of either surface in the contacts before loading: no unit."""
        return self._found.steepest_slope()

    def certify(self) -> Certificate:
        """Proves that this is a contact, from samples of both bodies over their whole length.

        It takes far longer than a solve.

        Raises
        ------
        linecontact.errors.TensionError, linecontact.errors.OverlapError
            If it is not a contact; other errors if this cannot be decided.

        Examples
        --------
        >>> import linecontact as lc
        >>> solution = lc.solve(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), kappa=1.0, load=0.02)
        >>> certificate = solution.certify()
        >>> certificate.is_proved, certificate.gap  # the gap grows on both sides up to the ends
        (True, None)
        """
        pressure, gap, spacing, cost, is_proved = self._found.certify()
        return Certificate(
            None if pressure is None else Extremum(*pressure),
            None if gap is None else Extremum(*gap),
            spacing,
            Cost(*cost),
            is_proved,
        )

    @overload
    def residual(self, x: float) -> float: ...
    @overload
    def residual(self, x: Numbers) -> FloatArray: ...
    def residual(self, x: float | Numbers) -> float | FloatArray:
        """Returns the residual of the integral equation at places inside: a pressure.

        Its quadrature is independent of the solve.
        """
        return each(self._found.residual, x)

    # Pressure.

    @overload
    def pressure(self, x: float) -> float: ...
    @overload
    def pressure(self, x: Numbers) -> FloatArray: ...
    def pressure(self, x: float | Numbers) -> float | FloatArray:
        """Returns the pressure at any number of places, in one call.

        Parameters
        ----------
        x : float or array_like
            Lengths, within both bodies.

        Returns
        -------
        float or ndarray
            Pressures: zero outside the contacts, `inf` at a corner that is pressed and where the
            slope of the gap jumps up, `-inf` at an end that pulls.

        Raises
        ------
        linecontact.errors.OutsideBodiesError
            Beyond the bodies, and for NaN.

        Examples
        --------
        >>> import linecontact as lc
        >>> solution = lc.solve(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), kappa=1.0, load=0.02)
        >>> solution.pressure([[0.0, 0.1], [0.2, 0.3]]).shape
        (2, 2)
        """
        return each(self._found.pressure, x)

    def pressure_estimate(self, x: float | Numbers) -> tuple[Any, Any]:
        """Returns pressures and their estimated errors: two pressures, or two arrays."""
        places = as_numbers(x, "x")
        values, errors = self._found.pressure_estimate(places.reshape(-1))
        return _plain(values.reshape(places.shape)), _plain(errors.reshape(places.shape))

    def sample(self, count: int = 257) -> tuple[FloatArray, FloatArray]:
        """Returns places and pressures for drawing by straight lines, `count` in each contact: 2 to 2**20.

        Examples
        --------
        >>> import linecontact as lc
        >>> solution = lc.solve(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), kappa=1.0, load=0.02)
        >>> x, pressures = solution.sample(65)
        >>> x.size, bool(x[0] == -solution.b)
        (65, True)
        """
        return self._found.sample(as_count(count, "count", 2, 2**20))

    def peak(self) -> Peak:
        """Returns the largest pressure and its x: `inf`, with the x of the corner, where it is infinite.

        Examples
        --------
        >>> import linecontact as lc
        >>> solution = lc.solve(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), kappa=1.0, load=0.02)
        >>> round(solution.peak().pressure, 12)  # 2 F/(π L)
        0.063661977237
        """
        return Peak(*placed(self.intervals, *self._found.peak()))

    @property
    def mean_pressure(self) -> float:
        """Mean pressure: the load over the widths of all contacts."""
        return self._found.mean_pressure

    @property
    def moment(self) -> float:
        """Moment of the pressures about x = 0: a force."""
        return self._found.moment

    @property
    def centre_of_pressure(self) -> float:
        """The x at which the load acts: a length. Without load it raises `InvalidLoadError`."""
        return self._found.centre_of_pressure

    def contacts(self) -> tuple[ContactRegion, ...]:
        """Returns the data of each contact, from left to right.

        Examples
        --------
        >>> import linecontact as lc
        >>> def bumps(k):
        ...     return k, k**4 - 2 * k**2, 1.0, 4 * k**3 - 4 * k
        >>> body = lc.Curve((-2.0, 2.0), bumps)
        >>> left, right = lc.solve(lc.Flat(), body, contact_modulus=1.0, load=1.0).contacts()
        >>> round(right.load, 12)
        0.5
        """

        def region(on: Any, load: float, strengths: Any, peak: Any, *rest: Any) -> ContactRegion:
            interval = Interval(*on)
            return ContactRegion(interval, load, strengths, Peak(*placed([interval], *peak)), *rest)

        return tuple(region(*found) for found in self._found.contacts())

    def load_rates(self) -> LoadRates:
        """Returns the derivatives of limits and pressure by the load."""
        return LoadRates(self._found.load_rates())

    # Gap outside the contacts, and stress below them.

    @overload
    def gap(self, x: float) -> float: ...
    @overload
    def gap(self, x: Numbers) -> FloatArray: ...
    def gap(self, x: float | Numbers) -> float | FloatArray:
        """Returns the gap between the loaded bodies along y: a length, zero in the contacts.

        Each place takes an integral of the pressure: about 0.1 ms, up to some tens of milliseconds
        for bodies with corners.

        Examples
        --------
        >>> import linecontact as lc
        >>> solution = lc.solve(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), kappa=1.0, load=0.02)
        >>> solution.gap([0.1, 0.4]).round(6)
        array([0.      , 0.042943])
        """
        return each(self._found.gap, x)

    @overload
    def gap_slope(self, x: float) -> float: ...
    @overload
    def gap_slope(self, x: Numbers) -> FloatArray: ...
    def gap_slope(self, x: float | Numbers) -> float | FloatArray:
        """Returns the derivative of this gap by x: no unit, zero in the contacts."""
        return each(self._found.gap_slope, x)

    def stress(
        self, x: float | Numbers, depth: float | Numbers, *, body: Side | None = None, friction: float = 0.0
    ) -> Stress:
        """Returns the stress below the surface of a body.

        Parameters
        ----------
        x, depth : float or array_like
            Lengths, broadcast against each other. The depth must not be negative. At the interface
            of a layer the stress is that of the layer, just below it that of the base.
        body : {"lower", "upper"}, optional
            Body meant. Without friction half-planes have the same stress; of bodies with a layer
            one must be named.
        friction : float
            Coefficient of friction μ, of either sign: adds a traction μP on the surface of this
            body in the direction of x. It must be 0 if a body has a layer.

        Returns
        -------
        Stress
            Pressures, tension positive.

        Examples
        --------
        >>> import linecontact as lc
        >>> solution = lc.solve(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), kappa=1.0, load=0.02)
        >>> stress = solution.stress(0.0, [0.0, 0.2])
        >>> (stress.sigma_y / solution.peak().pressure).round(6)  # -1/sqrt(1 + (y/L)²)
        array([-1.      , -0.707107])
        """
        return _stress(lambda x, depth: self._found.stress(as_side(body), x, depth, as_number(friction, "friction")), x, depth)

    def max_shear(
        self,
        *,
        body: Side | None = None,
        depths: tuple[float, float] | None = None,
        friction: float = 0.0,
    ) -> StressPeak:
        """Returns the largest shear stress in the plane, and its place.

        Parameters
        ----------
        body : {"lower", "upper"}, optional
            Body meant, as for `stress`.
        depths : (float, float), optional
            Depths from and to which it is looked for: a layer has those from 0 to its thickness, its
            base those from there to infinity.
        friction : float
            Coefficient of friction, as for `stress`.

        Examples
        --------
        >>> import linecontact as lc
        >>> solution = lc.solve(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), kappa=1.0, half_width=0.1)
        >>> largest = solution.max_shear()
        >>> round(largest.value / solution.peak().pressure, 6), round(largest.depth / 0.1, 4)
        (0.300283, 0.7862)
        """
        below = None if depths is None else as_range(depths, "depths")
        return StressPeak(*placed(self.intervals, *self._found.max_shear(as_side(body), below, as_number(friction, "friction"))))

    def max_von_mises(
        self,
        poisson_ratio: float | None = None,
        *,
        body: Side | None = None,
        depths: tuple[float, float] | None = None,
        friction: float = 0.0,
    ) -> StressPeak:
        """Returns the largest von Mises equivalent stress, and its place.

        Poisson's ratio is by default that of the material, of two half-planes the smaller one, the
        worst. Body and depths are as for `max_shear`. Ask a layer and its base one by one if their
        ratios differ.

        Examples
        --------
        >>> import linecontact as lc
        >>> steel = lc.Material(210e3, 0.3)  # MPa; lengths in mm
        >>> coated = lc.Layer(lc.Material(400e3, 0.25), 3e-3, steel)
        >>> solution = lc.solve(lc.Flat(), lc.Parabola(1.0, (-0.1, 0.1)), materials=(coated, steel), half_width=9e-3)
        >>> layer = solution.max_von_mises(body="lower", depths=(0.0, 3e-3))
        >>> base = solution.max_von_mises(body="lower", depths=(3e-3, float("inf")))
        >>> layer.depth <= 3e-3 < base.depth
        True
        """
        from .below import ratio_below

        side, below = as_side(body), None if depths is None else as_range(depths, "depths")
        ratio = ratio_below(self.contact, side, below) if poisson_ratio is None else as_number(poisson_ratio, "poisson_ratio")
        return StressPeak(*placed(self.intervals, *self._found.max_von_mises(side, below, ratio, as_number(friction, "friction"))))

    def max_tension(self, *, body: Side | None = None, friction: float = 0.0) -> Extremum:
        """Returns the largest tension along the surface, the largest σ_x at depth 0, and its x.

        Body and friction are as for `stress`. A coating is stretched where it bends.

        Examples
        --------
        >>> import linecontact as lc
        >>> solution = lc.solve(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), kappa=1.0, half_width=0.1)
        >>> tension = solution.max_tension(friction=0.3)
        >>> round(tension.value / solution.peak().pressure, 12), tension.x == -solution.b  # 2 μ p₀
        (0.6, True)
        """
        return Extremum(*self._found.max_tension(as_side(body), as_number(friction, "friction")))

    # Approach, stiffness and partial slip.

    def approach(self, references: References) -> Approach:
        """Returns the approach of the bodies: lengths. The contact must have materials."""
        return Approach(*self._found.approach(as_references(references)))

    @overload
    def displacement(self, x: float, references: References, *, body: Side) -> float: ...
    @overload
    def displacement(self, x: Numbers, references: References, *, body: Side) -> FloatArray: ...
    def displacement(self, x: float | Numbers, references: References, *, body: Side) -> float | FloatArray:
        """Returns the displacement of the surface of a body by the pressure, into the body: a length.

        It is that along y, against the reference of the body: zero there. The contact must have
        materials.

        Parameters
        ----------
        x : float or array_like
            Lengths: in the contacts, beside them, and beyond the ends of the bodies.
        references : References
            As for `approach`.
        body : {"lower", "upper"}
            Body meant.

        Examples
        --------
        >>> import linecontact as lc
        >>> steel = lc.Material(210e3, 0.3)  # MPa; lengths in mm
        >>> roller = lc.Ellipse.circle(10.0, (-1.0, 1.0))
        >>> solution = lc.solve(lc.Flat(), roller, materials=(steel, steel), load=500.0)
        >>> to = lc.References(0.0, lc.Reference.depth(30.0), lc.Reference.disc(10.0))
        >>> (1e3 * solution.displacement([0.0, 0.5, 2.0], to, body="lower")).round(3)
        array([7.35 , 4.703, 2.752])
        """
        to, side = as_references(references), as_side(body, True)
        return each(lambda x: self._found.displacement(x, to, side), x)

    def stiffness(self, references: References) -> float:
        """Returns the stiffness dF/dδ, the derivative of the load by the approach: a pressure."""
        return self._found.stiffness(as_references(references))

    def partial_slip(self, *, friction: float, force: float, tension: float = 0.0) -> PartialSlip:
        """Solves the contact again, under a tangential force: see `Contact.partial_slip`."""
        from .slipping import acting, slipped_again

        return slipped_again(self._contact, self._prescribed, acting(friction, force, tension))

    # Summary and pictures.

    def summary(self) -> Summary:
        """Returns the numbers of the solution, to be kept without the bodies.

        Examples
        --------
        >>> import linecontact as lc
        >>> solution = lc.solve(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), kappa=1.0, load=0.02)
        >>> solution.summary().checked
        True
        """
        intervals, load, loads, kappa, tilt, mean, peak, centre = self._found.summary()
        return Summary(
            tuple(Interval(*on) for on in intervals),
            load,
            tuple(loads),
            kappa,
            tilt,
            mean,
            Peak(*placed(self.intervals, *peak)),
            centre,
            self.edge_singularities,
            self.limits_error,
            self.is_checked,
            self.cost,
            self.attempts,
        )

    def __str__(self) -> str:
        return str(self._found)

    def __repr__(self) -> str:
        first, *rest = str(self).splitlines()
        if self.is_apart:
            return f"<Solution: {first}>"
        words = [first, f"load {self.load:.6g}", "checked" if self.is_checked else "not checked"]
        if self.limits_error is not None and not self.limits_error < 1e-3:
            words.append(f"limits to {self.limits_error:.1g} of the half-width")
        if rest[2:]:
            words.append("with warnings: print it")
        return f"<Solution: {', '.join(words)}>"

    def _repr_svg_(self) -> str:
        """Draws the pressure, for notebooks."""
        from .drawing import svg

        return svg(self)

    def plot(self, units: Sequence[str] = ("", ""), figure: Figure | None = None) -> Figure:
        """Draws both bodies before loading, the pressure, and the shear below it.

        It needs matplotlib.

        Parameters
        ----------
        units : (str, str), optional
            Names of the units of lengths and pressures, and of loads if there is a third, such as
            ("mm", "MPa", "N/mm"): shown at the axes, and in the title.
        figure : matplotlib.figure.Figure, optional
            Figure to draw in. Default: the current one of pyplot if it is empty, or else a new one,
            which is then current, for `plt.savefig` and `plt.show`.

        Returns
        -------
        matplotlib.figure.Figure

        Examples
        --------
        >>> import linecontact as lc
        >>> solution = lc.solve(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), kappa=1.0, load=0.02)
        >>> len(solution.plot().axes)
        4
        """
        from .drawing import plot

        return plot(self, units, figure)


def _solved_again(contact: Contact, prescribed: Prescribed) -> Solution:
    """Restores a pickled solution."""
    return Solution(contact._scene.solve(prescribed), contact, prescribed)
