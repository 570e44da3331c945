"""Bodies: shapes, measured points and user-defined curves, which can be joined and placed.

Lengths are in any unit, the same for both bodies of a contact; angles are in radians. Each vertex
is at the origin. Convex shapes open upwards, which makes them upper bodies; `Body.flipped` turns
them into lower ones.
"""

from __future__ import annotations

import inspect
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, ClassVar, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _native
from ._numbers import FloatArray, Numbers, Range, Unchanging, as_number, as_numbers, as_range, named
from .reading import MeasuredProfile

Bulge: TypeAlias = Literal["unknown", "straight", "convex", "concave"]
Step: TypeAlias = tuple[str, tuple[float, ...]]
CurveFunction: TypeAlias = Callable[[FloatArray], Sequence[Any]]

__all__ = [
    "Body",
    "Crowning",
    "Curve",
    "Ellipse",
    "Flat",
    "Involute",
    "Line",
    "Parabola",
    "Piecewise",
    "Placed",
    "RoundedPunch",
    "Spline",
    "Wedge",
]


class Body(Unchanging, ABC):
    """A surface: a curve `[X(k), Y(k)]` along which `X` rises or falls strictly with `k`.

    Bodies are immutable: `shifted` and the other placements return a new body. Bodies are equal if
    they are of the same class and were created with equal arguments.

    Examples
    --------
    >>> import linecontact as lc
    >>> lc.Ellipse.circle(10.0, (-1.4, 1.4)).shifted(3.0).flipped()
    Ellipse(10.0, 10.0, (-1.4, 1.4)).shifted(3.0, 0.0).flipped()
    """

    _SEAL = "_profile"
    _profile: _native.Profile

    @abstractmethod
    def _arguments(self) -> tuple[Any, ...]:
        """Returns the arguments of the constructor."""

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(map(repr, self._arguments()))})"

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), self._arguments()

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Body):
            return NotImplemented
        return type(self) is type(other) and self._arguments() == other._arguments()

    def __hash__(self) -> int:
        return hash((type(self), self._arguments()))

    @property
    def domain(self) -> Range:
        """Range of `k`: without unit, in radians or a length, depending on the body."""
        first, last = self._profile.domain
        return first, last

    @property
    def pieces(self) -> int:
        """Number of smooth pieces."""
        return self._profile.pieces

    @property
    def convexity(self) -> Bulge:
        """Declared convexity: `"convex"` for an upper body that bulges towards the contact."""
        return self._profile.convexity

    def at(self, k: float | Numbers) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Returns points of the curve, with their derivatives by `k`.

        Parameters
        ----------
        k : array_like
            Parameters within the `domain`. For a body of several pieces the parameter is `i + s` on
            piece `i`, with `s` from 0 at its left end to 1 at its right.

        Returns
        -------
        x, y, dx, dy : ndarray
            `X(k)` and `Y(k)`, lengths, and their derivatives.

        Examples
        --------
        >>> import linecontact as lc
        >>> x, y, dx, dy = lc.Parabola(2.0, (-1.0, 1.0)).at([0.0, 1.0])
        >>> y
        array([0.  , 0.25])
        """
        places = as_numbers(k, "k")
        x, y, dx, dy = (part.reshape(places.shape) for part in self._profile.at(places.reshape(-1)))
        return x, y, dx, dy

    def heights(self, x: float | Numbers) -> FloatArray:
        """Returns the heights `Y` at given `x`, for drawings: lengths; NaN beyond the ends.

        It inverts `X(k) = x` for all `x` at once, to about twelve digits.

        Examples
        --------
        >>> import linecontact as lc
        >>> lc.Parabola(2.0, (-1.0, 1.0)).heights([0.5, 3.0])
        array([0.0625,    nan])
        """
        wanted = as_numbers(x, "x")
        low, high = (np.full(wanted.shape, end) for end in self.domain)
        ends, *_ = self.at(self.domain)
        rises = ends[1] > ends[0]
        k = np.clip(np.zeros(wanted.shape), low, high)
        size = np.abs(wanted) + 1e-3 * (np.max(np.abs(wanted), initial=0.0))
        for _ in range(100):
            here, height, dx, _ = self.at(k)
            missed = here - wanted
            met = np.abs(missed) <= 1e-12 * size
            if np.all(met):
                break
            beyond = (missed > 0) == rises
            low, high = np.where(beyond, low, k), np.where(beyond, k, high)
            with np.errstate(divide="ignore", invalid="ignore"):
                newton = k - missed / dx
            inside = (newton > low) & (newton < high)
            k = np.where(met, k, np.where(inside, newton, 0.5 * low + 0.5 * high))
        within = (wanted >= np.min(ends)) & (wanted <= np.max(ends))
        return np.where(within, height, np.nan)

    def check_derivatives(self) -> None:
        """Checks the derivatives against differences, over the whole domain.

        It takes about 600 evaluations of each smooth piece, one by one: meant for a curve just
        written.

        Raises
        ------
        linecontact.errors.ProfileDerivativeError
            For the largest fault, with its place.

        Examples
        --------
        >>> import linecontact as lc
        >>> lc.Parabola(2.0, (-1.0, 1.0)).check_derivatives()
        """
        self._profile.check_derivatives()

    def _placed(self, name: str, *numbers: float) -> Placed:
        return Placed(self, [(name, numbers)])

    def shifted(self, along: float = 0.0, across: float = 0.0) -> Placed:
        """Moves the body by the lengths `along` in X and `across` in Y.

        Examples
        --------
        >>> import linecontact as lc
        >>> x, y, _, _ = lc.Parabola(1.0, (-1.0, 1.0)).shifted(5.0, 0.5).at(1.0)
        >>> float(x), float(y)
        (6.0, 1.0)
        """
        return self._placed("shifted", as_number(along, "along"), as_number(across, "across"))

    def mirrored(self) -> Placed:
        """Exchanges left and right: `X` becomes `-X`, without any rounding."""
        return self._placed("mirrored")

    def flipped(self) -> Placed:
        """Turns the body upside down: `Y` becomes `-Y`, without any rounding.

        This turns an upper body into a lower one.
        """
        return self._placed("flipped")

    def rotated(self, angle: float) -> Placed:
        """Turns the body about the origin by an angle in radians, from the X to the Y axis.
        """
        return self._placed("rotated", as_number(angle, "angle"))

    def scaled(self, factor: float) -> Placed:
        """Multiplies all lengths by a factor; a negative one adds half a turn."""
        return self._placed("scaled", as_number(factor, "factor"))


class Placed(Body):
    """A body that is shifted, rotated, mirrored, flipped or scaled, step by step.

    Each step acts about the origin. The methods `shifted`, `mirrored`, `flipped`, `rotated` and
    `scaled` of a body create it.

    Parameters
    ----------
    body : Body
        Body to be placed.
    steps : sequence of (str, tuple of float)
        Names of these methods with their arguments, lengths and radians, in the order of the steps.

    Examples
    --------
    >>> import linecontact as lc
    >>> lc.Placed(lc.Flat(), [("rotated", (0.1,)), ("shifted", (0.0, 2.0))])
    Flat().rotated(0.1).shifted(0.0, 2.0)
    """

    body: Body
    steps: tuple[Step, ...]

    def __init__(self, body: Body, steps: Sequence[Step]) -> None:
        if isinstance(body, Placed):
            steps = [*body.steps, *steps]
            body = body.body
        self.body = body
        self.steps = tuple((name, tuple(map(float, numbers))) for name, numbers in steps)
        self._profile = body._profile.placed([(name, list(numbers)) for name, numbers in self.steps])

    def _arguments(self) -> tuple[Any, ...]:
        return self.body, self.steps

    def __repr__(self) -> str:
        steps = (f".{name}({', '.join(map(repr, numbers))})" for name, numbers in self.steps)
        return repr(self.body) + "".join(steps)


class _Shape(Body):
    """A body that its numbers describe: the arguments of the constructor, by the same names in files."""

    KINDS: ClassVar[dict[str, type[_Shape]]] = {}
    _kind: ClassVar[str]
    _names: ClassVar[tuple[str, ...]]

    def __init_subclass__(cls, kind: str = "") -> None:
        # A class without a kind is derived from a shape, and is that shape.
        if kind:
            cls._kind, cls._names = kind, tuple(inspect.signature(cls).parameters)
            cls.KINDS[kind] = cls

    def _numbers(self) -> dict[str, float | Range]:
        return dict(zip(self._names, self._arguments(), strict=True))

    def _made(self) -> _native.Profile:
        numbers: dict[str, float] = {}
        for name, value in zip(self._names, self._arguments(), strict=True):
            if isinstance(value, tuple):
                numbers[f"{name}.0"], numbers[f"{name}.1"] = value
            else:
                numbers[name] = value
        return _native.Profile.shape(self._kind, numbers)


class Flat(_Shape, kind="flat"):
    """The level line `Y = 0`, without ends.

    Examples
    --------
    >>> import linecontact as lc
    >>> lc.Flat().convexity
    'straight'
    """

    def __init__(self) -> None:
        self._profile = self._made()

    def _arguments(self) -> tuple[Any, ...]:
        return ()


class Line(_Shape, kind="line"):
    """The straight line `Y = m X` through the origin, with ends.

    Parameters
    ----------
    slope : float
        Slope m, no unit.
    domain : (float, float)
        First and last `X`: lengths.

    Examples
    --------
    >>> import linecontact as lc
    >>> lc.Line(0.25, (0.0, 2.0)).heights(2.0)
    array(0.5)
    """

    def __init__(self, slope: float, domain: Sequence[float]) -> None:
        self.slope, self._domain = as_number(slope, "slope"), as_range(domain, "domain")
        self._profile = self._made()

    def _arguments(self) -> tuple[Any, ...]:
        return self.slope, self._domain


class Parabola(_Shape, kind="parabola"):
    """The parabola `Y = X²/(2 R)`.

    Parameters
    ----------
    radius : float
        Radius R at the vertex: a length, negative where the parabola bulges upwards.
    domain : (float, float)
        First and last `X`: lengths.

    Examples
    --------
    >>> import linecontact as lc
    >>> round(lc.solve(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), load=0.02, kappa=1.0).a, 12)  # sqrt(2 F R/κ)
    0.2
    """

    def __init__(self, radius: float, domain: Sequence[float]) -> None:
        self.radius, self._domain = as_number(radius, "radius"), as_range(domain, "domain")
        self._profile = self._made()

    def _arguments(self) -> tuple[Any, ...]:
        return self.radius, self._domain


class Ellipse(_Shape, kind="ellipse"):
    """An arc of an ellipse, `X = A sin k`, `Y = B (1 - cos k)`, with its lowest point at k = 0.

    Parameters
    ----------
    along, across : float
        Semi-axes A along the contact, positive, and B across it, negative where the ellipse bulges
        upwards: lengths.
    angles : (float, float)
        First and last angle k, within ±π/2: radians.

    Examples
    --------
    >>> import linecontact as lc
    >>> lc.Ellipse(2.0, 1.0, (-1.0, 1.0)).convexity
    'convex'
    """

    def __init__(self, along: float, across: float, angles: Sequence[float]) -> None:
        self.along, self.across, self.angles = as_number(along, "along"), as_number(across, "across"), as_range(angles, "angles")
        self._profile = self._made()

    @classmethod
    def circle(cls, radius: float, angles: Sequence[float]) -> Ellipse:
        """Creates an arc of a circle.

        Parameters
        ----------
        radius : float
            Radius: a length, negative where the circle bulges upwards.
        angles : (float, float)
            First and last angle from the lowest point, within ±π/2: radians.

        Examples
        --------
        >>> import linecontact as lc
        >>> roller = lc.Ellipse.circle(10.0, (-1.4, 1.4))
        >>> round(lc.solve(lc.Flat(), roller, contact_modulus=115e3, load=500.0).half_width, 4)
        0.2353
        """
        radius = as_number(radius, "radius")
        return cls(abs(radius), radius, angles)

    def _arguments(self) -> tuple[Any, ...]:
        return self.along, self.across, self.angles


class Involute(_Shape, kind="involute"):
    """The flank of a gear tooth: the involute of a circle, with the origin at one of its points.

    Parameters
    ----------
    base_radius : float
        Radius r of the base circle: a length.
    origin : float
        Angle t₀ rolled off at the origin: radians. The radius of curvature there is r t₀.
    angles : (float, float)
        Angles rolled off at the ends, not negative and within π/2 of t₀: radians.

    Examples
    --------
    >>> import linecontact as lc
    >>> wheel = lc.Involute(50.0, 0.4, (0.0, 0.8))
    >>> pinion = lc.Involute(25.0, 0.4, (0.0, 0.8)).mirrored().flipped()
    >>> solution = lc.solve(pinion, wheel, contact_modulus=115e3, load=300.0)
    >>> hertz = (4 * 300.0 / (1 / 20.0 + 1 / 10.0) / 3.14159 / 115e3) ** 0.5
    >>> abs(solution.half_width / hertz - 1) < 1e-3
    True
    """

    def __init__(self, base_radius: float, origin: float, angles: Sequence[float]) -> None:
        self.base_radius, self.origin = as_number(base_radius, "base_radius"), as_number(origin, "origin")
        self.angles = as_range(angles, "angles")
        self._profile = self._made()

    def _arguments(self) -> tuple[Any, ...]:
        return self.base_radius, self.origin, self.angles


class Crowning(_Shape, kind="crowning"):
    """Logarithmic (Lundberg) crowning, `Y = -C ln(1 - (X/l)²)`.

    In the plane it describes a body that is long across, such as a slide shoe. Along the axis of a
    roller the contact is three-dimensional: for it a plane solution is only a guide.

    Parameters
    ----------
    depth : float
        Depth C: a length, positive for an upper body, negative for a lower one.
    half_length : float
        Half-length l: a length.
    domain : (float, float)
        First and last `X`, at most from -l to l: lengths.

    Examples
    --------
    >>> import linecontact as lc
    >>> roller = lc.Crowning(0.01, 5.0, (-5.0, 5.0))
    >>> round(lc.solve(lc.Flat(), roller, kappa=1.0, half_width=4.0).load, 12)  # 2 κ C (5/3 - 1)
    0.013333333333
    """

    def __init__(self, depth: float, half_length: float, domain: Sequence[float]) -> None:
        self.depth, self.half_length = as_number(depth, "depth"), as_number(half_length, "half_length")
        self._domain = as_range(domain, "domain")
        self._profile = self._made()

    def _arguments(self) -> tuple[Any, ...]:
        return self.depth, self.half_length, self._domain


class Wedge(_Shape, kind="wedge"):
    """Two straight flanks that meet at the origin.

    Parameters
    ----------
    slopes : (float, float)
        Slopes of the left and the right flank, no unit: the left one is negative for a wedge that
        points down.
    reach : float
        Reach of the flanks, from -reach to reach: a length.

    Examples
    --------
    >>> import linecontact as lc
    >>> wedge = lc.Wedge((-0.1, 0.1), 1.0)
    >>> round(lc.solve(lc.Flat(), wedge, kappa=1.0, load=0.02).a, 12)  # π F/(2 κ m)
    0.314159265359
    """

    def __init__(self, slopes: Sequence[float], reach: float) -> None:
        self.slopes, self.reach = as_range(slopes, "slopes"), as_number(reach, "reach")
        self._profile = self._made()

    def _arguments(self) -> tuple[Any, ...]:
        return self.slopes, self.reach


class RoundedPunch(_Shape, kind="rounded_punch"):
    """A punch with a flat middle that continues as a parabola on either side.

    Parameters
    ----------
    flat : float
        Half-width of the flat, from -flat to flat: a length.
    radius : float
        Radius R of the edges: a length.
    reach : float
        Reach of the punch, from -reach to reach: a length.

    Examples
    --------
    >>> import linecontact as lc
    >>> lc.RoundedPunch(1.0, 0.5, 3.0).pieces
    3
    """

    def __init__(self, flat: float, radius: float, reach: float) -> None:
        self.flat, self.radius, self.reach = as_number(flat, "flat"), as_number(radius, "radius"), as_number(reach, "reach")
        self._profile = self._made()

    def _arguments(self) -> tuple[Any, ...]:
        return self.flat, self.radius, self.reach


class Spline(Body):
    """A cubic spline through measured points, or near them.

    Parameters
    ----------
    points : array_like, shape (n, 2), or MeasuredProfile
        Rows of x and y, lengths, in order of rising x.
    smooth : bool
        True to smooth the points; by default the curve goes through them. The noise of the
        measurement and the smoothing that it requires are estimated from the points. Noise means
        heights that are off independently of each other: roughness that neighbouring points share
        is part of the body, and is kept.
    outliers : float or None
        Distance from the cubic through its neighbours at which a point is refused, in standard
        deviations; None disables the check.
    period : float, optional
        Length after which the body repeats, for the period of a `Contact`: the first point ends
        the period, too, with the same slope and curvature. The points are those of one period,
        level, without that at its end. By default the ends are free.

    Raises
    ------
    linecontact.errors.LineContactError
        One of `SplineTooFewError`, `SplineOutlierError` and so on, with the row of the faulty
        point, counted from 1.

    Notes
    -----
    `Solution.uncertainty` returns what the noise leaves open in a contact. A smoothed spline that
    is placed is fitted again to the placed points, which must be in order of x there, too.

    Some dozens of points may not tell noise from body: the curve then goes through the points, and
    the noise is found to be next to nothing.

    Examples
    --------
    >>> import numpy as np
    >>> import linecontact as lc
    >>> x = np.linspace(-1, 1, 401)
    >>> heights = x**2 / 2 + 1e-5 * np.random.RandomState(1).normal(size=x.size)
    >>> body = lc.Spline(np.column_stack([x, heights]), smooth=True)
    >>> abs(body.noise / 1e-5 - 1) < 0.1
    True
    >>> abs(lc.solve(lc.Flat(), body, kappa=1.0, load=0.02).half_width / 0.2 - 1) < 1e-3
    True
    """

    @named
    def __init__(
        self,
        points: npt.ArrayLike | MeasuredProfile,
        *,
        smooth: bool = False,
        outliers: float | None = 10.0,
        period: float | None = None,
    ) -> None:
        given = points.points if isinstance(points, MeasuredProfile) else points
        rows = as_numbers(given, "points").copy()
        if rows.ndim != 2 or rows.shape[1] != 2:
            raise ValueError(f"points of shape {rows.shape}: give rows of x and y, of shape (n, 2)")
        if not isinstance(smooth, bool | np.bool_):
            raise TypeError(f"smooth is {smooth!r}: give True or False, the noise is estimated from the points")
        rows.setflags(write=False)
        self.points, self.smooth = rows, bool(smooth)
        self.outliers = None if outliers is None else as_number(outliers, "outliers")
        self.period = None if period is None else as_number(period, "period")
        self._profile = _native.Profile.spline(rows, *self._fit)

    @property
    def noise(self) -> float:
        """Standard deviation of the heights, as estimated by the fit: a length.

        It is 0 for a curve through its points.
        """
        return self._profile.noise

    @property
    def _fit(self) -> tuple[bool, float | None, float | None]:
        return self.smooth, self.outliers, self.period

    def _arguments(self) -> tuple[Any, ...]:
        return self.points, *self._fit

    def __reduce__(self) -> tuple[Any, ...]:
        return partial(type(self), smooth=self.smooth, outliers=self.outliers, period=self.period), (self.points,)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Spline):
            return False if isinstance(other, Body) else NotImplemented
        return np.array_equal(self.points, other.points) and self._fit == other._fit

    def __hash__(self) -> int:
        return hash((self.points.tobytes(), self._fit))

    def __repr__(self) -> str:
        x = self.points[:, 0]
        return (
            f"Spline(<{len(x)} points from x = {x[0]:g} to {x[-1]:g}>, smooth={self.smooth}, "
            f"outliers={self.outliers}{'' if self.period is None else f', period={self.period}'})"
        )


class Curve(Body):
    """A user-defined curve, given by a function of arrays.

    Parameters
    ----------
    domain : (float, float)
        Range of the parameter k, over which X rises or falls strictly. End it where X turns back.
    function : callable
        `k -> (x, y, dx, dy)`: maps an array of k to the arrays of X and Y, lengths, and of their
        derivatives by k. A single number stands for an array of equal numbers. The function must
        return the same values for the same k. It is called with many k at a time, and once with
        both ends. Its exceptions reach the caller unchanged.
    convexity : {"unknown", "straight", "convex", "concave"}
        Convexity, if it is known: "convex" if the slope dY/dX never falls with X. Two bodies that
        bulge towards each other take fewer evaluations. A NotConvexError is raised if the slopes
        sampled by a solve contradict the declaration; the curve between the samples is not checked.

    Notes
    -----
    The curve can be pickled if `pickle` can find its function by name, which excludes lambdas.

    Examples
    --------
    >>> import numpy as np
    >>> import linecontact as lc
    >>> def roller(k):
    ...     x, y = 10.0 * np.sin(k), 10.0 * (1 - np.cos(k))
    ...     dx, dy = 10.0 * np.cos(k), 10.0 * np.sin(k)
    ...     return x, y, dx, dy
    >>> body = lc.Curve((-1.0, 1.0), roller)
    >>> round(lc.solve(lc.Flat(), body, contact_modulus=115e3, load=500.0).half_width, 4)
    0.2353
    """

    def __init__(
        self, domain: Sequence[float], function: CurveFunction, convexity: Bulge = "unknown"
    ) -> None:
        self._domain, self.function, self._bulge = as_range(domain, "domain"), function, convexity
        self._profile = _native.Profile.curve(self._domain, function, convexity)

    def _arguments(self) -> tuple[Any, ...]:
        return self._domain, self.function, self._bulge

    def __reduce__(self) -> tuple[Any, ...]:
        name = getattr(self.function, "__qualname__", "")
        if "<lambda>" in name or "<locals>" in name:
            raise TypeError(
                f"a Curve of {name!r} cannot be pickled: pickle keeps a function by its name, and finds those only "
                "that are defined at the top of a module. Move it there; parameters go into a functools.partial of "
                "it, or into an object with a method __call__"
            )
        return super().__reduce__()


class Piecewise(Body):
    """Bodies joined end to end, from left to right.

    Each part has its own parameter and range. The slope may jump where two parts meet; X and Y may
    not.

    Parameters
    ----------
    parts : sequence of Body
        Bodies, from left to right.
    tolerance : float or None
        Largest mismatch of two ends, as a share of the larger of their extent and their distance
        from 0. None: rounding. A step that is let pass is refused by `certify`, and where it
        matters by a solve.

    Examples
    --------
    >>> import linecontact as lc
    >>> blunt = lc.Piecewise([lc.Line(-0.1, (-1.0, 0.0)), lc.Line(0.4, (0.0, 1.0))])
    >>> round(lc.solve(lc.Flat(), blunt, kappa=1.0, load=0.02).half_width, 12)
    0.213791866423
    """

    def __init__(self, parts: Sequence[Body], tolerance: float | None = None) -> None:
        self.parts = tuple(parts)
        self.tolerance = None if tolerance is None else as_number(tolerance, "tolerance")
        self._profile = _native.Profile.piecewise([part._profile for part in self.parts], self.tolerance)

    def _arguments(self) -> tuple[Any, ...]:
        return self.parts, self.tolerance

    def __repr__(self) -> str:
        tolerance = "" if self.tolerance is None else f", tolerance={self.tolerance}"
        return f"Piecewise([{', '.join(map(repr, self.parts))}]{tolerance})"
