"""What comes back of a solve, and what can be asked of it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, overload

import numpy as np

from . import _native
from ._numbers import FloatArray, Numbers, as_number, as_numbers, each

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from .contact import Contact, References

__all__ = [
    "Approach",
    "Attempt",
    "Certificate",
    "ContactRegion",
    "Cost",
    "Extremum",
    "Interval",
    "LoadRates",
    "PartialSlip",
    "Peak",
    "Solution",
    "Stress",
    "StressPeak",
    "Summary",
]

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
        """Half its width: a length."""
        return 0.5 * (self.right - self.left)

    @property
    def centre(self) -> float:
        """Its middle: a length."""
        return 0.5 * self.left + 0.5 * self.right


class Peak(NamedTuple):
    """A largest pressure, and the x where it is: a length and a pressure."""

    x: float
    pressure: float


class Extremum(NamedTuple):
    """A value, and the x where it is."""

    x: float
    value: float


class StressPeak(NamedTuple):
    """A largest stress: x and depth, lengths, and the stress, a pressure."""

    x: float
    depth: float
    value: float


class Approach(NamedTuple):
    """How far two bodies come together: lengths.

    Attributes
    ----------
    bodies : float
        How much nearer the two references are than when the bodies just touched.
    lower, upper : float
        How much nearer the surface of each body is to its own reference.
    """

    bodies: float
    lower: float
    upper: float


class Cost(NamedTuple):
    """What finding the limits has taken: counts.

    Attributes
    ----------
    samples : int
        Values of the slope of the gap.
    evaluations : int
        Points of the curves.
    heights : int
        Besides those, points for the heights of the bodies as a whole.
    """

    samples: int
    evaluations: int
    heights: int


class Attempt(NamedTuple):
    """A start of the search, and what became of it."""

    start: str
    outcome: str


class Certificate(NamedTuple):
    """A proof that a solution is a contact: no tension inside, no overlap up to the ends of the bodies.

    Attributes
    ----------
    pressure : Extremum or None
        Where the pressure is nearest to zero beside that of a smooth body, as a ratio. None where there is no doubt.
    gap : Extremum or None
        The least gap where the bodies approach each other again: a length. None where they do not.
    spacing : float
        The longest cell, a length: a feature at least a quarter as wide cannot have passed unseen. A 400th of the
        bodies, or four times the resolution of the contact if that is shorter.
    cost : Cost
        What it has taken.
    """

    pressure: Extremum | None
    gap: Extremum | None
    spacing: float
    cost: Cost


class ContactRegion(NamedTuple):
    """One of the contacts.

    Attributes
    ----------
    interval : Interval
        Where it is: lengths.
    load : float
        What it bears: force/length.
    edge_singularities : (float, float)
        Strengths at its left and its right limit: pressures.
    peak : Peak or None
        Its largest pressure; None where that is infinite.
    moment : float
        About x = 0: a force.
    centre_of_pressure : float or None
        A length; None without a load.
    """

    interval: Interval
    load: float
    edge_singularities: tuple[float, float]
    peak: Peak | None
    moment: float
    centre_of_pressure: float | None


class Summary(NamedTuple):
    """A solution as a row of numbers, without the bodies.

    Attributes
    ----------
    intervals : tuple of Interval
        Where the bodies touch: lengths.
    load : float
        Of all contacts: force/length.
    loads : tuple of float
        Of each contact: force/length.
    kappa : float
        The scale κ = π E*/2: a pressure.
    tilt : float
        Of the upper body, counter-clockwise: radians.
    mean_pressure : float
        The load over the widths of all contacts: a pressure.
    peak : Peak or None
        The largest pressure and its x; None where it is infinite.
    centre_of_pressure : float or None
        A length; None without a load.
    edge_singularities : (float, float)
        Strengths at the first and the last limit: pressures.
    limits_error : float or None
        As a share of the half-width; None where both limits were given.
    checked : bool
        Whether it was checked to be the contact of the bodies.
    cost : Cost
        What finding the limits has taken.
    attempts : tuple of Attempt
        The starts that were tried.
    """

    intervals: tuple[Interval, ...]
    load: float
    loads: tuple[float, ...]
    kappa: float
    tilt: float
    mean_pressure: float
    peak: Peak | None
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
        Along the surface, and across it.
    tau_xy : float or ndarray
        With y into the body.

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
        """The principal stresses in the plane, the larger one first: pressures."""
        mean, radius = 0.5 * (self.sigma_x + self.sigma_y), self.max_shear()
        return mean + radius, mean - radius

    def max_shear(self) -> Any:
        """The largest shear stress in the plane: a pressure."""
        return _plain(np.hypot(0.5 * (self.sigma_x - self.sigma_y), self.tau_xy))

    def sigma_z(self, poisson_ratio: float) -> Any:
        """ν (σ_x + σ_y), the stress that keeps the strain plane: a pressure."""
        return _ratio(poisson_ratio) * (self.sigma_x + self.sigma_y)

    def von_mises(self, poisson_ratio: float) -> Any:
        """The equivalent stress of von Mises in plane strain: a pressure."""
        share = 0.5 - _ratio(poisson_ratio)
        sum_ = self.sigma_x + self.sigma_y
        return _plain(np.hypot(share * sum_, 3.0**0.5 * self.max_shear()))


def _plain(value: Any) -> Any:
    return float(value) if np.ndim(value) == 0 else value


def _ratio(given: float) -> float:
    """Poisson's ratio, if a material can have it."""
    ratio = as_number(given, "poisson_ratio")
    if not 0.0 <= ratio <= 0.5:
        from .errors import InvalidPoissonRatioError

        error = InvalidPoissonRatioError(f"Poisson's ratio is {ratio}: it must be from 0 to 1/2, as 0.3 of steel")
        error.ratio = ratio
        raise error
    return ratio


def _acting(friction: float, force: float, tension: float) -> tuple[float, float, float]:
    """What acts along the contact, as the library takes it."""
    return as_number(friction, "friction"), as_number(force, "force"), as_number(tension, "tension")


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
    """The derivatives of limits and pressure by the load. `Solution.load_rates` makes it.

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
        """How fast the left and the right limit of each contact move in x: length² per force."""
        return self._rates.limits

    @overload
    def pressure(self, x: float) -> float: ...
    @overload
    def pressure(self, x: Numbers) -> FloatArray: ...
    def pressure(self, x: float | Numbers) -> float | FloatArray:
        """∂P/∂F at fixed x, one over a length; zero outside the contacts."""
        found: float | FloatArray = each(self._rates.pressure, x)
        return found

    def __repr__(self) -> str:
        return f"LoadRates(a={self.a!r}, b={self.b!r})"


class Solution:
    """A solved contact: its limits, and on request its pressure and what follows from it.

    `Contact.solve` and `Solver.solve` make it. Arrays of any shape are taken wherever an `x` is asked for, and what
    comes back has that shape. A solution is pickled as its contact and what was prescribed, and is solved again
    where it is read: a cold solve to the last bit, one by a `Solver` to rounding.

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

    # Where the bodies touch.

    @property
    def a(self) -> float:
        """The last limit: a length."""
        return self._found.a

    @property
    def b(self) -> float:
        """The first limit is at x = -b: a length."""
        return self._found.b

    @property
    def half_width(self) -> float:
        """(a + b)/2, of several contacts that from the first limit to the last: a length."""
        return self._found.half_width

    @property
    def centre(self) -> float:
        """(a - b)/2: a length."""
        return self._found.centre

    @property
    def hull(self) -> Interval:
        """From the first limit to the last: lengths."""
        return Interval(-self._found.b, self._found.a)

    @property
    def intervals(self) -> tuple[Interval, ...]:
        """Where the bodies touch, from left to right: lengths."""
        return tuple(Interval(*on) for on in self._found.intervals)

    @property
    def load(self) -> float:
        """Per unit length, of all contacts: force/length."""
        return self._found.load

    @property
    def tilt(self) -> float:
        """By how much the upper body has been turned counter-clockwise, where a moment was given: radians."""
        return self._found.tilt

    # How far it can be trusted.

    @property
    def limits_error(self) -> float | None:
        """Estimated error of the limits, as a share of the half-width; None where both were given."""
        return self._found.limits_error

    @property
    def edge_singularities(self) -> tuple[float, float]:
        """`(K_b, K_a)`, strengths of the inverse square roots at the limits: pressures, zero at free edges."""
        left, right = self._found.edge_singularities
        return left, right

    @property
    def attempts(self) -> tuple[Attempt, ...]:
        """The starts that the search has tried, the last of which has led here."""
        return tuple(Attempt(*attempt) for attempt in self._found.attempts)

    @property
    def is_checked(self) -> bool:
        """Whether this was checked to be the contact of the bodies, as far as the samples of the solve show.

        A `Curve` that is said to be convex is taken at its word: `certify` does not. Where a limit is in doubt by more
        than a 1600th of the half-width (`limits_error`), nothing was.
        """
        return self._found.is_checked

    @property
    def is_steep(self) -> bool:
        """Whether the slope of the gap is more than 0.3, too much for half-planes: is a unit wrong?"""
        return self._found.is_steep

    @property
    def cost(self) -> Cost:
        """What finding the limits has taken."""
        return Cost(*self._found.cost)

    def steepest_slope(self) -> float:
        """The largest slope of either surface within the contacts, before loading: no unit."""
        return self._found.steepest_slope()

    def certify(self) -> Certificate:
        """Proves that this is a contact, from the whole of both bodies. It takes far longer than a solve.

        Raises
        ------
        linecontact.errors.TensionError, linecontact.errors.OverlapError
            Where it is none; others where it cannot be told.

        Examples
        --------
        >>> import linecontact as lc
        >>> solution = lc.solve(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), kappa=1.0, load=0.02)
        >>> solution.certify().gap is None  # the gap grows on both sides up to the ends
        True
        """
        pressure, gap, spacing, cost = self._found.certify()
        return Certificate(
            None if pressure is None else Extremum(*pressure),
            None if gap is None else Extremum(*gap),
            spacing,
            Cost(*cost),
        )

    @overload
    def residual(self, x: float) -> float: ...
    @overload
    def residual(self, x: Numbers) -> FloatArray: ...
    def residual(self, x: float | Numbers) -> float | FloatArray:
        """By how much the pressure fails the integral equation at places inside: a pressure.

        By a quadrature that has nothing in common with that of the solve.
        """
        found: float | FloatArray = each(self._found.residual, x)
        return found

    # Pressure.

    @overload
    def pressure(self, x: float) -> float: ...
    @overload
    def pressure(self, x: Numbers) -> FloatArray: ...
    def pressure(self, x: float | Numbers) -> float | FloatArray:
        """The pressure at any number of places, all in one call.

        Parameters
        ----------
        x : float or array_like
            Lengths, within both bodies.

        Returns
        -------
        float or ndarray
            Pressures, zero outside the contacts.

        Raises
        ------
        linecontact.errors.SingularError
            Where it is infinite: at a corner that is pressed, or where a slope jumps.
        linecontact.errors.OutsideBodiesError
            Beyond the bodies, and for NaN.

        Examples
        --------
        >>> import linecontact as lc
        >>> solution = lc.solve(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), kappa=1.0, load=0.02)
        >>> solution.pressure([[0.0, 0.1], [0.2, 0.3]]).shape
        (2, 2)
        """
        found: float | FloatArray = each(self._found.pressure, x)
        return found

    def pressure_estimate(self, x: float | Numbers) -> tuple[Any, Any]:
        """Pressures with their estimated errors: two pressures, or arrays of them."""
        places = np.asarray(x, dtype=np.float64)
        values, errors = self._found.pressure_estimate(places.reshape(-1))
        return _plain(values.reshape(places.shape)), _plain(errors.reshape(places.shape))

    def sample(self, count: int = 257) -> tuple[FloatArray, FloatArray]:
        """Places and pressures between which lines draw the pressure, `count` of each contact.

        Examples
        --------
        >>> import linecontact as lc
        >>> solution = lc.solve(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), kappa=1.0, load=0.02)
        >>> x, pressures = solution.sample(65)
        >>> x.size, bool(x[0] == -solution.b)
        (65, True)
        """
        return self._found.sample(count)

    def peak(self) -> Peak:
        """The largest pressure, and where it is.

        Examples
        --------
        >>> import linecontact as lc
        >>> solution = lc.solve(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), kappa=1.0, load=0.02)
        >>> round(solution.peak().pressure, 12)  # 2 F/(π L)
        0.063661977237
        """
        return Peak(*self._found.peak())

    @property
    def mean_pressure(self) -> float:
        """The load over the widths of all contacts: a pressure."""
        return self._found.mean_pressure

    def moment(self) -> float:
        """Of the pressures about x = 0: a force."""
        return self._found.moment()

    def centre_of_pressure(self) -> float:
        """Where the load acts: a length."""
        return self._found.centre_of_pressure()

    def contacts(self) -> tuple[ContactRegion, ...]:
        """What each contact bears, and how, from left to right.

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
            peak = None if peak is None else Peak(*peak)
            return ContactRegion(Interval(*on), load, strengths, peak, *rest)

        return tuple(region(*found) for found in self._found.contacts())

    def load_rates(self) -> LoadRates:
        """The derivatives of limits and pressure by the load."""
        return LoadRates(self._found.load_rates())

    # Beside and below the contact.

    @overload
    def gap(self, x: float) -> float: ...
    @overload
    def gap(self, x: Numbers) -> FloatArray: ...
    def gap(self, x: float | Numbers) -> float | FloatArray:
        """The distance between the loaded bodies along y: a length, zero in the contacts.

        Examples
        --------
        >>> import linecontact as lc
        >>> solution = lc.solve(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), kappa=1.0, load=0.02)
        >>> solution.gap([0.1, 0.4]).round(6)
        array([0.      , 0.042943])
        """
        found: float | FloatArray = each(self._found.gap, x)
        return found

    @overload
    def gap_slope(self, x: float) -> float: ...
    @overload
    def gap_slope(self, x: Numbers) -> FloatArray: ...
    def gap_slope(self, x: float | Numbers) -> float | FloatArray:
        """How fast that gap opens towards larger x: no unit, zero in the contacts."""
        found: float | FloatArray = each(self._found.gap_slope, x)
        return found

    def stress(self, x: float | Numbers, depth: float | Numbers, *, friction: float = 0.0) -> Stress:
        """The stress below the surface of either body.

        Parameters
        ----------
        x, depth : float or array_like
            Lengths; they are broadcast against each other. The depth is not negative.
        friction : float
            μ, with a traction μP on the surface of this body in the direction of x; of either sign.

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
        return _stress(lambda x, depth: self._found.stress(x, depth, friction), x, depth)

    def max_shear(self, *, friction: float = 0.0) -> StressPeak:
        """The largest shear stress in the plane, and where it is.

        Examples
        --------
        >>> import linecontact as lc
        >>> solution = lc.solve(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), kappa=1.0, half_width=0.1)
        >>> largest = solution.max_shear()
        >>> round(largest.value / solution.peak().pressure, 6), round(largest.depth / 0.1, 4)
        (0.300283, 0.7862)
        """
        return StressPeak(*self._found.max_shear(friction))

    def max_von_mises(self, poisson_ratio: float, *, friction: float = 0.0) -> StressPeak:
        """The largest equivalent stress of von Mises, and where it is."""
        return StressPeak(*self._found.max_von_mises(poisson_ratio, friction))

    # How far the bodies come together.

    def approach(self, references: References) -> Approach:
        """How far the bodies have come together: lengths. The contact must know the materials."""
        return Approach(*self._found.approach(references))

    def stiffness(self, references: References) -> float:
        """dF/dδ, by how much the load grows with the approach of the bodies: a pressure."""
        return self._found.stiffness(references)

    def partial_slip(self, *, friction: float, force: float, tension: float = 0.0) -> PartialSlip:
        """The same contact, found anew, with a tangential force that friction carries: see `Contact.partial_slip`."""
        acting = _acting(friction, force, tension)
        return _slipped_again(self._contact, self._prescribed, acting)

    # The whole.

    def summary(self) -> Summary:
        """The numbers of the solution, to be kept without the bodies.

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
            None if peak is None else Peak(*peak),
            centre,
            self.edge_singularities,
            self.limits_error,
            self.is_checked,
            self.cost,
            self.attempts,
        )

    def __str__(self) -> str:
        if self.contact.has_modulus:
            return str(self._found)
        return f"{self._found}\nκ is 1, as no modulus and no materials were given"

    def __repr__(self) -> str:
        contacts = ", ".join(f"[{on.left:.6g}, {on.right:.6g}]" for on in self.intervals)
        count = len(self.intervals)
        which = "contact" if count == 1 else f"{count} contacts"
        checked = "checked" if self.is_checked else "not checked"
        return f"<Solution: {which} {contacts}, load {self.load:.6g}, {checked}>"

    def _repr_svg_(self) -> str:
        """The pressure, for notebooks."""
        from .drawing import svg

        return svg(self)

    def plot(self) -> Figure:
        """Draws both bodies before loading, the pressure, and the shear below it. It needs matplotlib.

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

        return plot(self)


class PartialSlip:
    """A contact that sticks in part, and slips in part. `Contact.partial_slip` makes it.

    Attributes
    ----------
    contact : Contact
        The scene.

    Examples
    --------
    >>> import linecontact as lc
    >>> contact = lc.Contact(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), contact_modulus=1.0)
    >>> contact.partial_slip(friction=0.4, force=0.03, load=0.1)
    <PartialSlip: force 0.03, sticks in [-0.178412, 0.178412]>
    """

    __slots__ = ("_acting", "_contact", "_found", "_prescribed")

    def __init__(
        self,
        found: _native.PartialSlip,
        contact: Contact,
        prescribed: Prescribed,
        acting: tuple[float, float, float],
    ) -> None:
        self._found, self._contact = found, contact
        self._prescribed, self._acting = prescribed, acting

    @property
    def contact(self) -> Contact:
        """The scene."""
        return self._contact

    def __reduce__(self) -> tuple[Any, ...]:
        return _slipped_again, (self._contact, self._prescribed, self._acting)

    def __repr__(self) -> str:
        zones = ", ".join(f"[{on.left:.6g}, {on.right:.6g}]" for on in self.stick_zones)
        return f"<PartialSlip: force {self.force:.6g}, sticks in {zones}>"

    @property
    def normal(self) -> Solution:
        """The contact under its load, without what acts along it."""
        return Solution(self._found.normal, self._contact, self._prescribed)

    @property
    def friction(self) -> float:
        """The coefficient of friction."""
        return self._acting[0]

    @property
    def force(self) -> float:
        """On the lower body, in the direction of x: force/length."""
        return self._acting[1]

    @property
    def tension(self) -> float:
        """By which the lower body is stretched: a pressure."""
        return self._acting[2]

    @property
    def stick_zones(self) -> tuple[Interval, ...]:
        """Where the bodies stick, from left to right: lengths. In the rest of the contacts they slip."""
        return tuple(Interval(*on) for on in self._found.stick_zones)

    @overload
    def traction(self, x: float) -> float: ...
    @overload
    def traction(self, x: Numbers) -> FloatArray: ...
    def traction(self, x: float | Numbers) -> float | FloatArray:
        """The traction on the lower body in the direction of x: a pressure, zero outside the contacts.

        Examples
        --------
        >>> import linecontact as lc
        >>> contact = lc.Contact(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), contact_modulus=1.0)
        >>> slip = contact.partial_slip(friction=0.4, force=0.03, load=0.1)
        >>> edge = 0.9 * slip.normal.a  # slips: μP
        >>> round(slip.traction(edge) / slip.normal.pressure(edge), 12)
        0.4
        """
        found: float | FloatArray = each(self._found.traction, x)
        return found

    def stress(
        self, body: Literal["lower", "upper"], x: float | Numbers, depth: float | Numbers
    ) -> Stress:
        """The stress below the surface of one of the bodies, from pressure and traction: pressures."""
        return _stress(lambda x, depth: self._found.stress(body, x, depth), x, depth)


def _solved_again(contact: Contact, prescribed: Prescribed) -> Solution:
    """A solution that was pickled."""
    return Solution(contact._scene.solve(prescribed), contact, prescribed)


def _slipped_again(
    contact: Contact, prescribed: Prescribed, acting: tuple[float, float, float]
) -> PartialSlip:
    found = contact._scene.partial_slip(prescribed, acting)
    return PartialSlip(found, contact, prescribed, acting)
