"""Scenes: two bodies, their stiffness, the conditions at the edges and the settings of the solve.
"""

from __future__ import annotations

import math
import os
from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias, TypedDict, cast, overload

import numpy as np

from . import _native
from ._numbers import FloatArray, Numbers, Range, Unchanging, as_number, as_range, as_references, each, named, one_of, refusal
from .bodies import Body
from .slipping import PartialSlip, acting
from .solution import Solution, _ratio

if TYPE_CHECKING:
    from typing_extensions import Unpack

Plane: TypeAlias = Literal["strain", "stress"]
Rigid: TypeAlias = Literal["bonded", "frictionless"]

__all__ = [
    "Contact",
    "Edge",
    "EdgePressure",
    "Layer",
    "Material",
    "Midpoint",
    "Panels",
    "PinInHole",
    "Reference",
    "References",
    "Search",
    "contact_modulus",
]


class _Material(NamedTuple):
    youngs_modulus: float
    poisson_ratio: float


class Material(_Material):
    """An isotropic elastic material.

    Parameters
    ----------
    youngs_modulus : float
        E: a pressure, infinite for a rigid body.
    poisson_ratio : float
        ν, from 0 to 1/2.

    Examples
    --------
    >>> import linecontact as lc
    >>> steel = lc.Material(210e3, 0.3)  # MPa
    >>> round(lc.contact_modulus(steel, steel), 2)
    115384.62
    """

    __slots__ = ()

    def __new__(cls, youngs_modulus: float, poisson_ratio: float) -> Material:
        """Creates the material; refuses impossible numbers here, before any solve."""
        modulus = as_number(youngs_modulus, "youngs_modulus")
        if not modulus > 0.0:
            says = f"Young's modulus is {modulus:g}: it must be positive, and infinite for a rigid body"
            raise refusal("InvalidYoungsModulusError", says, body="", modulus=modulus)
        return super().__new__(cls, modulus, _ratio(poisson_ratio))

    @classmethod
    def rigid(cls) -> Material:
        """Creates the material of a rigid body.

        Examples
        --------
        >>> import linecontact as lc
        >>> round(lc.contact_modulus(lc.Material.rigid(), lc.Material(210e3, 0.3)), 2)
        230769.23
        """
        return cls(math.inf, 0.0)


class _Layer(NamedTuple):
    material: Material
    thickness: float
    base: Material | Layer | Rigid


class Layer(_Layer):
    """A layer of even thickness at the surface of a body: a cover, a coating, a liner.

    Parameters
    ----------
    material : Material
        Material of the layer.
    thickness : float
        Thickness of the layer: a length.
    base : Material, Layer, "bonded" or "frictionless"
        Material of the body below, or another layer, to which the layer is bonded; or a rigid
        base: the layer is bonded to it, or slides on it without friction and without lifting off.
        Below several layers no stress is known, and no approach to a depth.

    Examples
    --------
    A printing nip: a rubber cover of 10 mm on a steel core of 90 mm, against steel. mm, MPa, N/mm.

    >>> import linecontact as lc
    >>> rubber, steel = lc.Material(5.0, 0.48), lc.Material(210e3, 0.3)
    >>> cylinder, cover = lc.Parabola(100.0, (-30.0, 30.0)), lc.Layer(rubber, 10.0, steel)
    >>> nip = lc.solve(lc.Flat(), cylinder, materials=(steel, cover), load=20.0)
    >>> round(nip.half_width, 3), round(nip.peak().pressure, 4)
    (13.011, 1.0555)

    Carbon of 2 µm on nitride of 3 µm on steel:

    >>> carbon, nitride = lc.Material(180e3, 0.25), lc.Material(280e3, 0.25)
    >>> coated = lc.Layer(carbon, 2e-3, lc.Layer(nitride, 3e-3, steel))
    >>> contact = lc.solve(lc.Flat(), lc.Parabola(10.0, (-1.0, 1.0)), materials=(coated, steel), load=10.0)
    >>> round(1e3 * contact.half_width, 3)
    33.323
    """

    __slots__ = ()

    def __new__(cls, material: Sequence[float], thickness: float, base: Sequence[float] | Layer | Rigid) -> Layer:
        """Creates the layer; refuses what is no material here, before any solve."""
        if isinstance(base, str):
            if base not in ("bonded", "frictionless"):
                raise ValueError(f"base is {base!r}: give 'bonded', 'frictionless', a Material or another Layer")
            below: Material | Layer | Rigid = base
        else:
            below = base if isinstance(base, Layer) else _material(base)
        length = as_number(thickness, "thickness")
        if not 0.0 < length < math.inf:
            says = f"the layer is {length:g} thick: its thickness must be positive and finite"
            raise refusal("InvalidThicknessError", says, body="", thickness=length)
        return super().__new__(cls, _material(material), length, below)


Foundation: TypeAlias = Layer | Sequence[float]


def _material(given: Sequence[float]) -> Material:
    try:
        modulus, ratio = given
    except (TypeError, ValueError):
        raise TypeError(f"{given!r} is no Material: give E and ν, as Material(210e3, 0.3)") from None
    return Material(modulus, ratio)


def _elastic(material: Sequence[float]) -> tuple[float, float] | None:
    """Returns E and ν, or None for a rigid material."""
    modulus, ratio = _material(material)
    return None if modulus == math.inf else (modulus, ratio)


def _layers(given: Foundation) -> tuple[list[Layer], Sequence[float] | Rigid]:
    """Returns the layers of a body from the surface down, and what is below them."""
    layers, base = list[Layer](), cast("Any", given)
    while isinstance(base, Layer):
        layers.append(base)
        base = base.base
    return layers, base


def _foundation(given: Foundation) -> tuple[Any, Any]:
    """Returns material and thickness of the layers of a body, and their base."""
    layers, base = _layers(given)
    sheets = [(_elastic(layer.material), layer.thickness) for layer in layers]
    return sheets, base if sheets and isinstance(base, str) else _elastic(cast("Sequence[float]", base))


def _both(materials: Sequence[Any]) -> Sequence[Any]:
    """Returns what was given for the two bodies; refuses what is for one, or for more."""
    one = isinstance(materials, (Material, Layer))
    if one or not isinstance(materials, Sequence) or len(materials) != 2:
        raise TypeError(
            f"materials are {materials!r}: give one for the lower and one for the upper body, such as (steel, steel)"
        )
    return materials


def contact_modulus(lower: Sequence[float], upper: Sequence[float], plane: Plane = "strain") -> float:
    """Returns the contact modulus: `1/E* = (1 - ν₁²)/E₁ + (1 - ν₂²)/E₂` in plane strain.

    Parameters
    ----------
    lower, upper : Material
        Materials of the two bodies.
    plane : {"strain", "stress"}
        "strain" for bodies much longer than the contact is wide, "stress" for bodies much shorter.

    Returns
    -------
    float
        E*: a pressure.

    Examples
    --------
    >>> import linecontact as lc
    >>> steel, aluminium = lc.Material(210e3, 0.3), lc.Material(70e3, 0.33)
    >>> round(lc.contact_modulus(aluminium, steel), 1)
    58605.2
    """
    return _native.contact_modulus(_elastic(lower), _elastic(upper), plane)


class PinInHole:
    """A pin in a hole of nearly the same radius, pressed into it by a load: Persson's closed form.

    It is for a contact over a wide angle, on which bodies are no half-planes: of a `Solution` the
    property `conformity` says how far they are. The materials must be alike, or both incompressible.

    Parameters
    ----------
    radius : float
        Radius of the hole: a length.
    clearance : float
        Radius of the hole less that of the pin, small beside it: a length.
    load : float
        Load per unit length: force/length.
    materials : (Material, Material)
        Materials of the pin and of the hole.
    plane : {"strain", "stress"}
        As of `contact_modulus`.

    Attributes
    ----------
    half_angle : float
        Half-angle of the contact: radians.

    Raises
    ------
    linecontact.errors.UnlikeBodiesError
        For materials for which there is no closed form.

    Examples
    --------
    >>> import linecontact as lc
    >>> steel = lc.Material(210e3, 0.3)
    >>> import math
    >>> bush = lc.PinInHole(10.0, 0.02, 2000.0, (steel, steel))
    >>> round(math.degrees(bush.half_angle), 2), round(bush.pressure(0.0), 1)
    (48.17, 167.0)
    """

    def __init__(
        self, radius: float, clearance: float, load: float, materials: Sequence[Any], plane: Plane = "strain"
    ) -> None:
        sizes = as_number(radius, "radius"), as_number(clearance, "clearance"), as_number(load, "load")
        pin, hole = _both(materials)
        self._given = sizes, (_elastic(pin), _elastic(hole)), plane
        self.half_angle = self._at(np.zeros(0))[0]

    def _at(self, angles: FloatArray) -> tuple[float, FloatArray]:
        return _native.pin_in_hole(*self._given, angles)

    @overload
    def pressure(self, angle: float) -> float: ...
    @overload
    def pressure(self, angle: Numbers) -> FloatArray: ...
    def pressure(self, angle: float | Numbers) -> float | FloatArray:
        """Returns the pressure at an angle from the middle, in radians: zero outside the contact."""
        return each(lambda angles: self._at(angles)[1], angle)


class Edge(NamedTuple):
    """The condition at one edge of the contact, created by `free`, `fixed` and so on.

    Examples
    --------
    >>> import linecontact as lc
    >>> punch = lc.Contact(lc.Flat(), lc.Flat(), kappa=1.0, edges=(lc.Edge.fixed(-1.0), lc.Edge.fixed(1.0)))
    >>> round(punch.solve(load=0.3).pressure(0.6), 12)  # F/(π sqrt(1 - x²))
    0.119366207319
    """

    kind: Literal["free", "fixed", "free_until", "adhesive"]
    value: float = 0.0

    @classmethod
    def free(cls) -> Edge:
        """Creates the edge of a smooth body: the limit is where the pressure ends at zero."""
        return cls("free")

    @classmethod
    def fixed(cls, x: float) -> Edge:
        """Creates an edge at a sharp corner at this x, a length, where the limit stays.

        The body must press there, and ends there: nothing beyond it is checked.
        """
        return cls("fixed", as_number(x, "x"))

    @classmethod
    def free_until(cls, x: float) -> Edge:
        """Creates an edge that is free until the contact reaches a corner at this x: a length."""
        return cls("free_until", as_number(x, "x"))

    @classmethod
    def adhesive(cls, work: float) -> Edge:
        """Creates an edge with adhesion (JKR) of this work: energy per unit area."""
        return cls("adhesive", as_number(work, "work"))


class EdgePressure(NamedTuple):
    """Prescribed pressures at given distances from the limits: the paper's Eq. (6).

    Parameters
    ----------
    at_a, at_b : float
        Pressures prescribed at `a - distance_a` and `distance_b - b`.
    distance_a, distance_b : float
        Lengths, positive.
    tolerance_a, tolerance_b : float
        Tolerances of these pressures, positive.

    Examples
    --------
    >>> import linecontact as lc
    >>> edges = lc.EdgePressure.zero(1e-3, 1e-9)
    >>> body = lc.Parabola(1.0, (-1.0, 1.0))
    >>> a = lc.Contact(lc.Flat(), body, kappa=1.0, edge_pressure=edges).solve(load=0.02).a
    >>> round(a, 6)  # wider than 0.2, by about twice the distance
    0.202005
    """

    at_a: float
    at_b: float
    distance_a: float
    distance_b: float
    tolerance_a: float
    tolerance_b: float

    @classmethod
    def zero(cls, distance: float, tolerance: float) -> EdgePressure:
        """Creates the condition of zero pressure, with equal settings on both sides.

        The distance is a length, the tolerance a pressure.
        """
        return cls(0.0, 0.0, distance, distance, tolerance, tolerance)


class _Reference(NamedTuple):
    kind: Literal["depth", "disc", "length"]
    value: float


class Reference(_Reference):
    """The reference point for the approach of a body, created by `depth`, `disc` or `length`.

    Examples
    --------
    >>> import linecontact as lc
    >>> lc.References(0.0, lower=lc.Reference.depth(30.0), upper=lc.Reference.disc(10.0)).upper
    Reference(kind='disc', value=10.0)
    """

    __slots__ = ()

    def __new__(cls, kind: Literal["depth", "disc", "length"], value: float) -> Reference:
        names = {"depth": "depth", "disc": "radius", "length": "length"}
        length = as_number(value, names[one_of(kind, "the kind of a reference", tuple(names))])
        if not 0.0 < length < math.inf:
            says = f"a reference at {length:g}: its depth, radius or length must be positive and finite"
            raise refusal("InvalidReferenceError", says, length=length)
        return super().__new__(cls, kind, length)

    @classmethod
    def depth(cls, depth: float) -> Reference:
        """Creates a reference at this depth below the surface: a length."""
        return cls("depth", depth)

    @classmethod
    def disc(cls, radius: float) -> Reference:
        """Creates a reference at the centre of a disc of this radius: a length.

        The disc is loaded at the point opposite to the contact.
        """
        return cls("disc", radius)

    @classmethod
    def length(cls, length: float) -> Reference:
        """Creates a reference by ℓ in `2 ln(ℓ/|x - s|)`, a length: for any other constant."""
        return cls("length", length)


class References(NamedTuple):
    """The references of both bodies, between which an approach is measured.

    Parameters
    ----------
    x : float
        The x of both references: a length.
    lower, upper : Reference
        References of body 1 and of body 2.

    Examples
    --------
    >>> import linecontact as lc
    >>> steel = lc.Material(210e3, 0.3)
    >>> roller = lc.Ellipse.circle(10.0, (-1.0, 1.0))
    >>> contact = lc.Contact(lc.Flat(), roller, materials=(steel, steel))
    >>> to = lc.References(0.0, lc.Reference.depth(30.0), lc.Reference.disc(10.0))
    >>> round(contact.solve(load=500.0).approach(to).bodies, 5)  # mm
    0.01375
    """

    x: float
    lower: Reference
    upper: Reference


class Search(NamedTuple):
    """A root finder, for the limits or for `X(k) = x`.

    Parameters
    ----------
    method : str
        Name of the strategy: "bisection", "newton" or another; an unknown one is refused with the
        list of all.
    absolute, relative : float
        Errors of the unknown at which the search may stop: absolute, and as a share of the unknown.
    residual : float
        Residual at which the search may stop.
    max_evaluations : int
        Number of evaluations after which the search gives up.

    Examples
    --------
    >>> import linecontact as lc
    >>> body = lc.Parabola(1.0, (-1.0, 1.0))
    >>> brent = lc.Contact(lc.Flat(), body, kappa=1.0, limit_search=lc.Search("brent"))
    >>> round(brent.solve(load=0.02).a, 12)
    0.2
    """

    method: str
    absolute: float = 0.0
    relative: float = 0.0
    residual: float = 0.0
    max_evaluations: int = 2200


class Panels(NamedTuple):
    """The default quadrature: Chebyshev series of the slope of the gap, on panels.

    Parameters
    ----------
    tolerance : float
        Largest error of the slopes, relative; 0 for all digits.

    Examples
    --------
    >>> import linecontact as lc
    >>> body = lc.Parabola(1.0, (-1.0, 1.0))
    >>> contact = lc.Contact(lc.Flat(), body, kappa=1.0, quadrature=lc.Panels(1e-6))
    >>> round(contact.solve(load=0.02).a, 6)
    0.2
    """

    tolerance: float = 0.0


class Midpoint(NamedTuple):
    """The paper's quadrature: the midpoint rule with Richardson extrapolation.

    Parameters
    ----------
    segments : int
        Number of segments N of the coarsest level.
    extrapolations : int
        Number of extrapolations ET: 0 for the trapezoidal sum, 1 for the midpoint rule, and one
        more for each power eliminated.
    exponents : {"half_integer", "even"}
        Powers that are eliminated: "even" as in the paper.

    Examples
    --------
    >>> import linecontact as lc
    >>> body = lc.Parabola(1.0, (-1.0, 1.0))
    >>> contact = lc.Contact(lc.Flat(), body, kappa=1.0, quadrature=lc.Midpoint())
    >>> round(contact.solve(load=0.02).a, 12)
    0.2
    """

    segments: int = 64
    extrapolations: int = 4
    exponents: Literal["half_integer", "even"] = "half_integer"


def _search(given: Search | str | None, name: str) -> tuple[str, list[float]] | None:
    if given is None:
        return None
    method, *numbers = given if isinstance(given, tuple) else (given, *Search("newton")[1:])
    one_of(method, name, _native.searches())
    return method, [*map(as_number, numbers, Search._fields[1:])]


def _quadrature(given: Panels | Midpoint | None) -> tuple[str, list[float]] | None:
    if given is None:
        return None
    if isinstance(given, Panels):
        return "panels", [as_number(given.tolerance, "tolerance")]
    if not isinstance(given, Midpoint):
        raise TypeError(f"quadrature is {given!r}: give Panels() or Midpoint()")
    even = one_of(given.exponents, "exponents", ("half_integer", "even")) == "even"
    return "midpoint", [*map(as_number, given[:2], given._fields), float(even)]


class Prescribed(TypedDict, total=False):
    """Prescribed quantities: the keyword arguments of `Contact.solve`."""

    load: float
    half_width: float
    peak_pressure: float
    approach: float
    references: References
    moment: float
    about: float
    centre_of_pressure: float


class Settings(TypedDict, total=False):
    """The keyword arguments of `Contact`."""

    contact_modulus: float | None
    materials: tuple[Foundation, Foundation] | None
    kappa: float | None
    plane: Plane
    edges: tuple[Edge, Edge] | None
    edge_pressure: EdgePressure | None
    start: Sequence[float] | None
    limit_search: Search | str | None
    inversion: Search | str | None
    quadrature: Panels | Midpoint | None
    tolerance: float | None
    resolution: float | None
    period: float | None
    certified: bool
    single_interval: bool


# Numbers that are prescribed together, with the name of the control.
_CONTROLS: dict[frozenset[str], tuple[str, tuple[str, ...]]] = {
    frozenset({"load"}): ("load", ("load",)),
    frozenset({"half_width"}): ("half_width", ("half_width",)),
    frozenset({"peak_pressure"}): ("peak_pressure", ("peak_pressure",)),
    frozenset({"approach"}): ("approach", ("approach",)),
    frozenset({"load", "moment"}): ("moment", ("load", "moment", "about")),
    frozenset({"load", "moment", "about"}): ("moment", ("load", "moment", "about")),
    frozenset({"load", "centre_of_pressure"}): ("centre_of_pressure", ("load", "centre_of_pressure")),
}


def _control(
    given: Mapping[str, Any], references: References | None, quantities: Sequence[str] = ()
) -> tuple[str, list[Any]]:
    """Returns the name of the control, and its numbers (or arrays) in the library's order.

    References are required for an approach, and for the quantities that depend on them.
    """
    if references is None and {"approach", "stiffness"} & set(quantities):
        raise TypeError("approach and stiffness are between references: give them")
    found = _CONTROLS.get(frozenset(given))
    if found is None or (found[0] == "approach" and references is None):
        raise TypeError(_refusal(given))
    kind, names = found
    return kind, [given.get(name, 0.0) for name in names]


def _refusal(given: Collection[str]) -> str:
    if set(given) == {"approach"}:
        return "prescribed are approach, which is between references: give references=References(x, lower, upper), too"
    if given and {"moment", "about", "centre_of_pressure"}.issuperset(given):
        return f"prescribed are {', '.join(given)}, which is where the load acts: give load=, too"
    return (
        f"prescribed are {', '.join(given) or 'no numbers'}: give load, half_width, peak_pressure, approach with "
        "references, load with moment (and about), or load with centre_of_pressure"
    )


def _prescribed(
    *, references: References | None, **numbers: float | None
) -> tuple[str, list[float], References | None]:
    """Returns the prescribed quantities in the library's form."""
    asked = {name: value for name, value in numbers.items() if value is not None}
    many = [name for name, value in asked.items() if np.size(value) > 1]
    if many:
        raise TypeError(f"{many[0]} is {asked[many[0]]!r}: give one number, or all to sweep(contact, {many[0]}=...)")
    given = {name: as_number(value, name) for name, value in asked.items()}
    kind, values = _control(given, references)
    if references is not None and kind != "approach":
        raise TypeError("references belong to an approach: give them where one is asked for")
    return kind, values, None if references is None else as_references(references)


def _positive(given: float | None, name: str, error: str, attribute: str, **others: float) -> float | None:
    """Returns E*, κ or a length, if it is given; refuses an impossible one."""
    if given is None:
        return None
    number = as_number(given, name)
    if not 0.0 < number < math.inf:
        raise refusal(error, f"{name} is {number:g}: it must be positive and finite", **{attribute: number}, **others)
    return number


class Contact(Unchanging):
    """Two bodies to be pressed together, and the settings by which their contact is found.

    One contact serves any number of loads.

    Parameters
    ----------
    lower, upper : Body
        Body 1, below, and body 2, above.
    contact_modulus : float, optional
        E* of plane strain: a pressure. (The function `contact_modulus` returns it for two
        materials.)
    materials : (Material or Layer, Material or Layer), optional
        Materials of the lower and the upper body, in place of the modulus. An approach needs them.
    kappa : float, optional
        κ = π E*/2 in place of both: a pressure. The default is κ = 1 if none of the three is given.
    plane : {"strain", "stress"}
        Plane state, with materials: "strain" for bodies much longer than the contact is wide.
    edges : (Edge, Edge), optional
        Conditions at the left and the right edge. Default: both free.
    edge_pressure : EdgePressure, optional
        Prescribed pressures near the edges, the paper's Eq. (6), in place of `edges`.
    start : (float, float), optional
        Interval from -b to a from which the search for the limits starts: lengths.
    limit_search : Search or str, optional
        Strategy that adjusts the limits, one at a time, in place of Newton's method on both.
    inversion : Search or str, optional
        Strategy that inverts `X(k) = x`. Default: Newton's method.
    quadrature : Panels or Midpoint, optional
        Quadrature. Default: `Panels()`.
    tolerance : float, optional
        Short form of `quadrature=Panels(tolerance)`.
    resolution : float, optional
        Narrowest feature of the bodies to be seen: the length along x of a bump or a dent from end
        to end. Samples are then less than half of it apart all over the bodies, whatever convexity
        they declare; bodies too long for that are refused. It does not apply with
        `single_interval`. By default Gaussian bumps are seen whose width at half their height is at
        least 2 % of the contact, in it or up to a half-width beside. (What ends abruptly between
        two samples shows in their heights alone: ask for it with half of its length.)
    period : float, optional
        Length along x after which both bodies repeat; each is flat or described over one period.
        The load, and all results, are those of one period; the approach is that of the mean planes.
    certified : bool
        If true, each solve also runs `Solution.certify`, which proves that the result is a contact.
    single_interval : bool
        If true, the contact is treated as one interval and not checked, as in the paper. Between
        two fixed edges any load is allowed, a tensile one too.

    Examples
    --------
    A steel roller of 10 mm radius on a steel flat: mm, MPa, N/mm.

    >>> import linecontact as lc
    >>> contact = lc.Contact(lc.Flat(), lc.Parabola(10.0, (-1.0, 1.0)), contact_modulus=115e3)
    >>> solution = contact.solve(load=500.0)
    >>> print(solution)  # doctest: +ELLIPSIS
    contact [-0.235283, 0.235283]
    load 500, largest pressure 1352.88 at x = ...
    limits to ... of the half-width, checked
    """

    _SEAL = "_scene"

    @named
    def __init__(
        self,
        lower: Body,
        upper: Body,
        *,
        contact_modulus: float | None = None,
        materials: tuple[Foundation, Foundation] | None = None,
        kappa: float | None = None,
        plane: Plane = "strain",
        edges: tuple[Edge, Edge] | None = None,
        edge_pressure: EdgePressure | None = None,
        start: Sequence[float] | None = None,
        limit_search: Search | str | None = None,
        inversion: Search | str | None = None,
        quadrature: Panels | Midpoint | None = None,
        tolerance: float | None = None,
        resolution: float | None = None,
        period: float | None = None,
        certified: bool = False,
        single_interval: bool = False,
    ) -> None:
        for body in (lower, upper):
            if not isinstance(body, Body):
                how = "take its body()" if hasattr(body, "body") else "make one, such as Flat() or a Curve"
                raise TypeError(f"{body!r:.60} is no Body: {how}")
        one_of(plane, "plane", ("strain", "stress"))
        if plane != "strain" and materials is None:
            raise TypeError("the plane goes with materials: a contact_modulus or kappa has it already")
        if sum(given is not None for given in (contact_modulus, materials, kappa)) > 1:
            raise TypeError("contact_modulus, materials and kappa say the same: give one of them")
        if edges is not None and edge_pressure is not None:
            raise TypeError("edges and edge_pressure exclude each other: give one of them")
        if edges is not None and not (isinstance(edges, Sequence) and [*map(type, edges)] == [Edge, Edge]):
            kinds = "Edge.free(), .fixed(x), .free_until(x) or .adhesive(work)"
            raise TypeError(f"edges are {edges!r}: give the left and the right one, each {kinds}")
        if tolerance is not None:
            if quadrature is not None:
                raise TypeError("the tolerance is that of Panels: give it there, or no quadrature")
            quadrature = Panels(as_number(tolerance, "tolerance"))
        self.lower, self.upper = lower, upper
        contact_modulus = _positive(contact_modulus, "contact_modulus", "InvalidModulusError", "modulus")
        kappa = _positive(kappa, "kappa", "InvalidKappaError", "kappa")
        self._settings: dict[str, Any] = {
            "contact_modulus": contact_modulus,
            "materials": materials,
            "kappa": kappa,
            "plane": plane,
            "edges": edges,
            "edge_pressure": edge_pressure,
            "start": None if start is None else as_range(start, "start"),
            "limit_search": limit_search,
            "inversion": inversion,
            "quadrature": quadrature,
            "resolution": _positive(resolution, "resolution", "InvalidResolutionError", "resolution", least=0.0),
            "period": _positive(period, "period", "InvalidPeriodError", "period"),
            "certified": certified,
            "single_interval": single_interval,
        }
        given = self._settings | {
            "materials": None if materials is None else (*map(_foundation, _both(materials)), plane),
            "edge_pressure": edge_pressure and [*map(as_number, edge_pressure, EdgePressure._fields)],
            "inversion": _search(inversion, "inversion"),
            "limit_search": _search(limit_search, "limit_search"),
            "quadrature": _quadrature(quadrature),
        }
        # It goes with the materials.
        del given["plane"]
        self._scene = _native.Scene(lower=lower._profile, upper=upper._profile, **given)

    @property
    def has_modulus(self) -> bool:
        """True if a modulus, materials or κ were given; otherwise pressures are those of κ = 1."""
        return any(self._settings[name] is not None for name in ("contact_modulus", "materials", "kappa"))

    def _surfaces(self) -> list[Material]:
        """Returns the materials at the surfaces of the bodies, if they are given."""
        given = self._settings["materials"] or ()
        return [one.material if isinstance(one, Layer) else _material(one) for one in given]

    @property
    def settings(self) -> dict[str, Any]:
        """Settings that differ from their defaults, by the names of the parameters: materials, period, edges and so on."""
        usual = {"plane": "strain", "certified": False, "single_interval": False}
        return {
            name: value
            for name, value in self._settings.items()
            if value is not None and value != usual.get(name)
        }

    def __repr__(self) -> str:
        settings = (f", {name}={value!r}" for name, value in self.settings.items())
        return f"Contact({self.lower!r}, {self.upper!r}{''.join(settings)})"

    def __reduce__(self) -> tuple[Any, ...]:
        return _again, (self.lower, self.upper, self.settings)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Contact):
            return NotImplemented
        bodies = (self.lower, self.upper) == (other.lower, other.upper)
        return bodies and self._settings == other._settings

    def __hash__(self) -> int:
        return hash((self.lower, self.upper, repr(self._settings)))

    @staticmethod
    def from_file(path: str | os.PathLike[str]) -> Contact:
        """Reads the contact of a scene file, as `Scene.from_file` does."""
        from .files import Scene

        return Scene.from_file(path).contact

    def to_file(self, path: str | os.PathLike[str]) -> None:
        """Writes the contact to a scene file, as `Scene.to_file` does."""
        from .files import Scene

        Scene(self).to_file(path)

    @named
    def solve(
        self,
        *,
        load: float | None = None,
        half_width: float | None = None,
        peak_pressure: float | None = None,
        approach: float | None = None,
        references: References | None = None,
        moment: float | None = None,
        about: float | None = None,
        centre_of_pressure: float | None = None,
    ) -> Solution:
        """Finds the contact under the prescribed quantities.

        The interpreter is released during the solve, and Ctrl-C ends the search.

        Parameters
        ----------
        load : float
            Load per unit length F: force/length.
        half_width : float
            Half-width L, in place of a load: a length; of several contacts, from the first limit to
            the last. With a `period` several loads may give the same one.
        peak_pressure : float
            Peak pressure, in place of a load: a pressure.
        approach : float
            Approach of the bodies, in place of a load: a length, measured between the `references`.
        references : References
            References of an approach.
        moment : float
            Moment of the pressures about `about`, together with a load: a force. The bodies are
            tilted so that the pressures have this moment.
        about : float
            The x about which the moment acts: a length, 0 by default.
        centre_of_pressure : float
            The x at which the load acts, together with a load, in place of a moment: a length.

        Returns
        -------
        Solution

        Raises
        ------
        linecontact.errors.LineContactError
            One of its subclasses, with the numbers as attributes.

        Examples
        --------
        >>> import linecontact as lc
        >>> contact = lc.Contact(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), kappa=1.0)
        >>> round(contact.solve(half_width=0.2).load, 12)
        0.02
        """
        prescribed = _prescribed(
            load=load,
            half_width=half_width,
            peak_pressure=peak_pressure,
            approach=approach,
            references=references,
            moment=moment,
            about=about,
            centre_of_pressure=centre_of_pressure,
        )
        return Solution(self._scene.solve(prescribed), self, prescribed)

    @named
    def partial_slip(
        self, *, friction: float, force: float, tension: float = 0.0, **prescribed: Unpack[Prescribed]
    ) -> PartialSlip:
        """Finds the contact under a tangential force that friction carries, and its stick zones.

        Parameters
        ----------
        friction : float
            Coefficient of friction μ, no unit.
        force : float
            Tangential force Q on the lower body, in the direction of x: force/length, less than μF.
        tension : float
            Tension that stretches the lower body along x, less the tension in the upper one: a
            pressure.
        **prescribed : float
            Prescribed quantities, as for `solve`.

        Returns
        -------
        PartialSlip

        Examples
        --------
        >>> import linecontact as lc
        >>> contact = lc.Contact(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), contact_modulus=1.0)
        >>> slip = contact.partial_slip(friction=0.4, force=0.03, load=0.1)
        >>> round(slip.stick_zones[0].half_width / slip.normal.a, 12)  # sqrt(1 - Q/(μF))
        0.5
        """
        wanted = _wanted(prescribed)
        along = acting(friction, force, tension)
        return PartialSlip(self._scene.partial_slip(wanted, along), self, wanted, along)


def _wanted(given: Prescribed) -> tuple[str, list[float], References | None]:
    """Returns the prescribed quantities, given keyword arguments some of which may be missing."""
    return _prescribed(**cast("Any", {"references": None, **given}))


def _again(lower: Body, upper: Body, settings: dict[str, Any]) -> Contact:
    """Restores a pickled contact."""
    return Contact(lower, upper, **settings)

