"""Bodies: shapes, measured points, curves of one's own, joined and put in place.

Lengths are in any unit, the same for both bodies of a contact; angles are in radians. Each vertex is at the
origin, and convex shapes open upwards: as they are they are upper bodies. `Body.flipped` makes lower ones of them.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from typing import Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _native
from ._numbers import FloatArray, Numbers, Range, Unchanging, as_number, as_numbers, as_range

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
    """A surface as a curve `[X(k), Y(k)]` of a parameter `k`, over which `X` rises or falls strictly.

    A body does not change: `shifted` and the like return another one. Bodies that are equal have the same numbers.

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
        """What the constructor was called with."""

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
        """The range of `k`: no unit, or radians, or a length, as the body has it."""
        first, last = self._profile.domain
        return first, last

    @property
    def pieces(self) -> int:
        """How many smooth pieces the body has."""
        return self._profile.pieces

    @property
    def convexity(self) -> Bulge:
        """Which way the body bulges, as far as it says: `"convex"` is an upper body that bulges towards the contact."""
        return self._profile.convexity

    def at(self, k: float | Numbers) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """The points at many parameters, with the derivatives by `k`.

        Parameters
        ----------
        k : array_like
            Parameters within the `domain`. Of a body of several pieces it is `i + s` on piece `i`, with `s`
            from 0 at its left end to 1 at its right one.

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
        places = np.asarray(k, dtype=np.float64)
        x, y, dx, dy = (part.reshape(places.shape) for part in self._profile.at(places.reshape(-1)))
        return x, y, dx, dy

    def heights(self, x: float | Numbers) -> FloatArray:
        """`Y` at given `x`, for drawings: a length. NaN beyond the ends of the body.

        `X(k) = x` is solved for each of them, all at once, to about twelve digits.

        Examples
        --------
        >>> import linecontact as lc
        >>> lc.Parabola(2.0, (-1.0, 1.0)).heights([0.5, 3.0])
        array([0.0625,    nan])
        """
        wanted = np.asarray(x, dtype=np.float64)
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
        """Whether the derivatives are those of their functions, all over the domain.

        About 600 evaluations for each smooth piece, one by one: for a curve just written.

        Raises
        ------
        linecontact.errors.ProfileDerivativeError
            With the place of the largest fault.

        Examples
        --------
        >>> import linecontact as lc
        >>> lc.Parabola(2.0, (-1.0, 1.0)).check_derivatives()
        """
        self._profile.check_derivatives()

    def _placed(self, name: str, *numbers: float) -> Placed:
        return Placed(self, [(name, numbers)])

    def shifted(self, along: float = 0.0, across: float = 0.0) -> Placed:
        """Moved by lengths along `X` and across it.

        Examples
        --------
        >>> import linecontact as lc
        >>> x, y, _, _ = lc.Parabola(1.0, (-1.0, 1.0)).shifted(5.0, 0.5).at(1.0)
        >>> float(x), float(y)
        (6.0, 1.0)
        """
        return self._placed("shifted", as_number(along, "along"), as_number(across, "across"))

    def mirrored(self) -> Placed:
        """Left and right exchanged: `X` becomes `-X`, without any rounding."""
        return self._placed("mirrored")

    def flipped(self) -> Placed:
        """Turned upside down: `Y` becomes `-Y`, without any rounding. Of an upper body it makes a lower one."""
        return self._placed("flipped")

    def rotated(self, angle: float) -> Placed:
        """Turned about the origin by an angle in radians, from the X axis towards the Y axis."""
        return self._placed("rotated", as_number(angle, "angle"))

    def scaled(self, factor: float) -> Placed:
        """All lengths multiplied by a factor; a negative one adds half a turn."""
        return self._placed("scaled", as_number(factor, "factor"))


class Placed(Body):
    """A body moved, turned, mirrored, flipped or scaled, step by step, each about the origin.

    The methods `shifted`, `mirrored`, `flipped`, `rotated` and `scaled` of a body make it.

    Parameters
    ----------
    body : Body
        What is placed.
    steps : sequence of (str, tuple of float)
        Names of those methods and their numbers, lengths and radians, in the order in which they are done.

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


class Flat(Body):
    """The level `Y = 0`, without ends.

    Examples
    --------
    >>> import linecontact as lc
    >>> lc.Flat().convexity
    'straight'
    """

    def __init__(self) -> None:
        self._profile = _native.Profile.flat()

    def _arguments(self) -> tuple[Any, ...]:
        return ()


class Line(Body):
    """The straight line `Y = m X` through the origin, with ends.

    Parameters
    ----------
    slope : float
        m, no unit.
    domain : (float, float)
        From one `X` to another: lengths.

    Examples
    --------
    >>> import linecontact as lc
    >>> lc.Line(0.25, (0.0, 2.0)).heights(2.0)
    array(0.5)
    """

    def __init__(self, slope: float, domain: Sequence[float]) -> None:
        self.slope, self._domain = as_number(slope, "slope"), as_range(domain, "domain")
        self._profile = _native.Profile.line(self.slope, self._domain)

    def _arguments(self) -> tuple[Any, ...]:
        return self.slope, self._domain


class Parabola(Body):
    """The parabola `Y = X²/(2 R)`.

    Parameters
    ----------
    radius : float
        R, the radius at the vertex: a length, negative where it bulges upwards.
    domain : (float, float)
        From one `X` to another: lengths.

    Examples
    --------
    >>> import linecontact as lc
    >>> round(lc.solve(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), load=0.02, kappa=1.0).a, 12)  # sqrt(2 F R/κ)
    0.2
    """

    def __init__(self, radius: float, domain: Sequence[float]) -> None:
        self.radius, self._domain = as_number(radius, "radius"), as_range(domain, "domain")
        self._profile = _native.Profile.parabola(self.radius, self._domain)

    def _arguments(self) -> tuple[Any, ...]:
        return self.radius, self._domain


class Ellipse(Body):
    """An arc of an ellipse, `X = A sin k`, `Y = B (1 - cos k)`, by the angle k from its lowest point.

    Parameters
    ----------
    along, across : float
        The semi-axes A along the contact, positive, and B across it, negative where it bulges upwards: lengths.
    angles : (float, float)
        From one k to another, within ±π/2: radians.

    Examples
    --------
    >>> import linecontact as lc
    >>> lc.Ellipse(2.0, 1.0, (-1.0, 1.0)).convexity
    'convex'
    """

    def __init__(self, along: float, across: float, angles: Sequence[float]) -> None:
        self.along, self.across, self.angles = as_number(along, "along"), as_number(across, "across"), as_range(angles, "angles")
        self._profile = _native.Profile.ellipse(self.along, self.across, self.angles)

    @classmethod
    def circle(cls, radius: float, angles: Sequence[float]) -> Ellipse:
        """An arc of a circle.

        Parameters
        ----------
        radius : float
            A length, negative where the circle bulges upwards.
        angles : (float, float)
            From the lowest point, within ±π/2: radians.

        Examples
        --------
        >>> import linecontact as lc
        >>> roller = lc.Ellipse.circle(10.0, (-1.4, 1.4))
        >>> round(lc.solve(lc.Flat(), roller, contact_modulus=115e3, load=500.0).half_width, 4)
        0.2353
        """
        return cls(abs(radius), radius, angles)

    def _arguments(self) -> tuple[Any, ...]:
        return self.along, self.across, self.angles


class Involute(Body):
    """The flank of a gear tooth: the involute of a circle, seen from one of its points.

    Parameters
    ----------
    base_radius : float
        Radius r of the base circle: a length.
    origin : float
        The angle t₀ rolled off where the origin is put: radians. The radius of curvature there is r t₀.
    angles : (float, float)
        The angles rolled off at the ends, not negative and within π/2 of t₀: radians.

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
        self._profile = _native.Profile.involute(self.base_radius, self.origin, self.angles)

    def _arguments(self) -> tuple[Any, ...]:
        return self.base_radius, self.origin, self.angles


class Crowning(Body):
    """Logarithmic (Lundberg) crowning, `Y = -C ln(1 - (X/l)²)`, of a body that is long across the plane.

    Along the axis of a roller the contact is one in space: for it a plane solution is a guide only.

    Parameters
    ----------
    depth : float
        C, a length: positive for an upper body, negative for a lower one.
    half_length : float
        l, a length.
    domain : (float, float)
        From one `X` to another, at most from -l to l: lengths.

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
        self._profile = _native.Profile.crowning(self.depth, self.half_length, self._domain)

    def _arguments(self) -> tuple[Any, ...]:
        return self.depth, self.half_length, self._domain


class Wedge(Body):
    """Two straight flanks that meet at the origin.

    Parameters
    ----------
    slopes : (float, float)
        Of the left and the right flank, no unit: of a wedge that points down the left one is negative.
    reach : float
        The flanks go from -reach to reach: a length.

    Examples
    --------
    >>> import linecontact as lc
    >>> wedge = lc.Wedge((-0.1, 0.1), 1.0)
    >>> round(lc.solve(lc.Flat(), wedge, kappa=1.0, load=0.02).a, 12)  # π F/(2 κ m)
    0.314159265359
    """

    def __init__(self, slopes: Sequence[float], reach: float) -> None:
        self.slopes, self.reach = as_range(slopes, "slopes"), as_number(reach, "reach")
        self._profile = _native.Profile.wedge(self.slopes, self.reach)

    def _arguments(self) -> tuple[Any, ...]:
        return self.slopes, self.reach


class RoundedPunch(Body):
    """A punch that is flat in the middle and goes on as a parabola on either side.

    Parameters
    ----------
    flat : float
        It is flat from -flat to flat: a length.
    radius : float
        R, the radius of the edges: a length.
    reach : float
        It ends at -reach and reach: a length.

    Examples
    --------
    >>> import linecontact as lc
    >>> lc.RoundedPunch(1.0, 0.5, 3.0).pieces
    3
    """

    def __init__(self, flat: float, radius: float, reach: float) -> None:
        self.flat, self.radius, self.reach = as_number(flat, "flat"), as_number(radius, "radius"), as_number(reach, "reach")
        self._profile = _native.Profile.rounded_punch(self.flat, self.radius, self.reach)

    def _arguments(self) -> tuple[Any, ...]:
        return self.flat, self.radius, self.reach


class Spline(Body):
    """A cubic spline through measured points, or near them.

    Parameters
    ----------
    points : array_like, shape (n, 2)
        Rows of x and y, lengths, by rising x.
    noise : float
        Standard deviation of the heights: a length. Of all curves that are off the points by so much the
        smoothest is taken. With 0 the curve goes through the points. Rather a tenth too much than too little: with
        much less than half of the true noise the curve follows it, and touches in many places.
    outliers : float or None
        How far off its neighbours a point may be before it is refused, in standard deviations. None: any.

    Raises
    ------
    linecontact.errors.LineContactError
        One of `SplineTooFewError` and the like, with the row of the point at fault, from 1.

    Examples
    --------
    >>> import numpy as np
    >>> import linecontact as lc
    >>> x = np.linspace(-1, 1, 81)
    >>> body = lc.Spline(np.column_stack([x, x**2 / 2]), noise=1e-7)
    >>> abs(lc.solve(lc.Flat(), body, kappa=1.0, load=0.02).a / 0.2 - 1) < 1e-4
    True
    """

    def __init__(
        self, points: npt.ArrayLike, noise: float = 0.0, outliers: float | None = 10.0
    ) -> None:
        rows = as_numbers(points, "points").copy()
        if rows.ndim != 2 or rows.shape[1] != 2:
            raise ValueError(f"points of shape {rows.shape}: give rows of x and y, of shape (n, 2)")
        rows.setflags(write=False)
        self.points, self.noise = rows, as_number(noise, "noise")
        self.outliers = None if outliers is None else as_number(outliers, "outliers")
        self._profile = _native.Profile.spline(rows, self.noise, self.outliers)

    def _arguments(self) -> tuple[Any, ...]:
        return self.points, self.noise, self.outliers

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Spline):
            return False if isinstance(other, Body) else NotImplemented
        same = np.array_equal(self.points, other.points)
        return same and (self.noise, self.outliers) == (other.noise, other.outliers)

    def __hash__(self) -> int:
        return hash((self.points.tobytes(), self.noise, self.outliers))

    def __repr__(self) -> str:
        x = self.points[:, 0]
        return (
            f"Spline(<{len(x)} points from x = {x[0]:g} to {x[-1]:g}>, noise={self.noise}, "
            f"outliers={self.outliers})"
        )


class Curve(Body):
    """A curve of one's own, by a function of arrays.

    Parameters
    ----------
    domain : (float, float)
        The range of the parameter k, over which X rises or falls strictly. End it where X turns back.
    function : callable
        `k -> (x, y, dx, dy)`: of an array of k the arrays of X and Y, lengths, and of their derivatives by k.
        Each may also be one number, for all k. It must return the same for the same k. It is called with many k
        at a time, at the ends once; an exception in it comes out of what was called, as it is.
    convexity : {"unknown", "straight", "convex", "concave"}
        Which way the curve bulges, if it is known: "convex" if the slope dY/dX never falls with X. Two bodies that
        bulge towards each other take fewer evaluations. Where the slopes that a solve samples contradict it there is a
        NotConvexError; what lies between them is not checked.

    Notes
    -----
    A function that `pickle` can find by its name can be pickled, a lambda cannot.

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

    Each has a parameter and a range of its own. Where two meet the slope may jump; X and Y may not.

    Parameters
    ----------
    parts : sequence of Body
        From left to right.
    tolerance : float or None
        By how much two ends may miss each other, as a share of the larger of their extent and their distance
        from 0. None: by rounding.

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
