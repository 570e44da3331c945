"""Partial slip: a contact under a tangential force that friction carries."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, overload

import numpy as np

from . import _native
from ._numbers import FloatArray, Numbers, as_number, as_side, each
from .solution import Extremum, Interval, Prescribed, Solution, Stress, StressPeak, _stress

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from .contact import Contact, References

__all__ = ["PartialSlip"]

Side: TypeAlias = Literal["lower", "upper"]
"""One of the two bodies."""


def acting(friction: float, force: float, tension: float) -> tuple[float, float, float]:
    """Returns friction and loads along the contact in the library's form."""
    return as_number(friction, "friction"), as_number(force, "force"), as_number(tension, "tension")


class PartialSlip:
    """A contact that sticks in part and slips in part, from `Contact.partial_slip`.

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
        return slipped_again, (self._contact, self._prescribed, self._acting)

    def __repr__(self) -> str:
        zones = ", ".join(f"[{on.left:.6g}, {on.right:.6g}]" for on in self.stick_zones)
        return f"<PartialSlip: force {self.force:.6g}, sticks in {zones}>"

    @property
    def normal(self) -> Solution:
        """The contact under its normal load alone."""
        return Solution(self._found.normal, self._contact, self._prescribed)

    @property
    def friction(self) -> float:
        """Coefficient of friction."""
        return self._acting[0]

    @property
    def force(self) -> float:
        """Tangential force on the lower body, in the direction of x: force/length."""
        return self._acting[1]

    @property
    def tension(self) -> float:
        """Tension that stretches the lower body, less the tension in the upper one: a pressure."""
        return self._acting[2]

    @property
    def stick_zones(self) -> tuple[Interval, ...]:
        """Intervals in which the bodies stick, from left to right: lengths.

        In the rest of the contacts they slip.
        """
        return tuple(Interval(*on) for on in self._found.stick_zones)

    @overload
    def traction(self, x: float) -> float: ...
    @overload
    def traction(self, x: Numbers) -> FloatArray: ...
    def traction(self, x: float | Numbers) -> float | FloatArray:
        """Returns the traction on the lower body along x: a pressure, zero outside the contacts.

        Examples
        --------
        >>> import linecontact as lc
        >>> contact = lc.Contact(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), contact_modulus=1.0)
        >>> slip = contact.partial_slip(friction=0.4, force=0.03, load=0.1)
        >>> edge = 0.9 * slip.normal.a  # slips: μP
        >>> round(slip.traction(edge) / slip.normal.pressure(edge), 12)
        0.4
        """
        return each(self._found.traction, x)

    def sample(self, count: int = 257) -> tuple[FloatArray, FloatArray]:
        """Returns places and tractions for drawing by straight lines.

        They are `count` in each contact, and nearly as many in each stick zone, at whose limits the
        traction turns sharply.

        Examples
        --------
        >>> import linecontact as lc
        >>> contact = lc.Contact(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), contact_modulus=1.0)
        >>> slip = contact.partial_slip(friction=0.4, force=0.03, load=0.1)
        >>> x, tractions = slip.sample(65)
        >>> bool(slip.stick_zones[0].right in x), tractions.size
        (True, 129)
        """
        x, _ = self.normal.sample(count)
        # Angles of an even number, so that the middle, where a tip may be, is left out.
        shares = np.cos(np.linspace(0.0, np.pi, 2 * (count // 2)))[1:-1]
        for zone in self.stick_zones:
            within = np.array([*zone, *(zone.centre + zone.half_width * shares)])
            on = next(on for on in self.normal.intervals if on.left < zone.centre < on.right)
            x = np.union1d(x, within[(within > on.left) & (within < on.right)])
        return x, self.traction(x)

    # Stress below each body, without a tension that stretches it.

    def stress(self, x: float | Numbers, depth: float | Numbers, *, body: Side) -> Stress:
        """Returns the stress below the surface of one body, from pressure and traction.

        At depth 0 it is the stress of the surface. A tension that stretches the body has to be
        added to `sigma_x`.
        """
        return _stress(lambda x, depth: self._found.stress(as_side(body, True), x, depth), x, depth)

    def max_shear(self, *, body: Side) -> StressPeak:
        """Returns the largest shear stress in the plane in one body, and its place."""
        return StressPeak(*self._found.max_shear(as_side(body, True)))

    def max_von_mises(self, poisson_ratio: float | None = None, *, body: Side) -> StressPeak:
        """Returns the largest von Mises equivalent stress in one body, and its place.

        Poisson's ratio is by default that of its material.
        """
        from .below import ratio_below

        if poisson_ratio is None:
            poisson_ratio = ratio_below(self._contact, body, None)
        return StressPeak(*self._found.max_von_mises(as_side(body, True), poisson_ratio))

    def max_tension(self, *, body: Side) -> Extremum:
        """Returns the largest tension along the surface of one body, and its x.

        Cracks of fretting start there: mostly at the edge that the traction pulls away from. A
        tension that stretches the body has to be added.

        Examples
        --------
        >>> import linecontact as lc
        >>> contact = lc.Contact(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), contact_modulus=1.0)
        >>> slip = contact.partial_slip(friction=0.4, force=0.03, load=0.1)
        >>> x, tension = slip.max_tension(body="lower")
        >>> x == -slip.normal.b
        True
        >>> round(tension / slip.normal.peak().pressure, 12)  # 2 μ sqrt(Q/(μF))
        0.692820323028
        """
        return Extremum(*self._found.max_tension(as_side(body, True)))

    def plot(self, units: Sequence[str] = ("", ""), figure: Figure | None = None) -> Figure:
        """Draws both bodies before loading, pressure and traction, and the shear in the lower body.

        It is the picture of `Solution.plot`, which describes the arguments. The shear in the upper body
        is that of the opposite force and tension.

        Examples
        --------
        >>> import linecontact as lc
        >>> contact = lc.Contact(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), contact_modulus=1.0)
        >>> slip = contact.partial_slip(friction=0.4, force=0.03, load=0.1)
        >>> [line.get_label() for line in slip.plot().axes[1].lines]
        ['pressure', 'limit of friction', 'traction on lower body']
        """
        from .drawing import plot

        return plot(self.normal, units, figure, self)


def slipped_again(contact: Contact, prescribed: Prescribed, acting: tuple[float, float, float]) -> PartialSlip:
    """Restores a pickled contact that slips in part."""
    found = contact._scene.partial_slip(prescribed, acting)
    return PartialSlip(found, contact, prescribed, acting)
