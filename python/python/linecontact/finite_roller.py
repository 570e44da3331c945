"""Rollers of finite length, by slices."""

from __future__ import annotations

import operator
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from . import _native
from ._numbers import FloatArray, as_number, refusal
from .bodies import Body, Flat
from .errors import InvalidRollerError
from .solver import SpringTable

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["FiniteRoller", "RollerState"]


class RollerState(NamedTuple):
    """State of a roller of finite length; one number for each slice in the arrays.

    Attributes
    ----------
    approach : float
        Approach δ at the middle of the roller, from where the axis is parallel and the generatrix
        without relief touches: a length.
    misalignment : float
        Slope of the axis towards the raceway, in radians: positive brings the end at positive z
        nearer.
    load : float
        Load F: a force.
    moment : float
        Tilting moment about the middle, force × length: positive if the load acts at positive z.
    stiffness : ndarray
        Derivatives of load and moment, in this order in the rows, by approach and misalignment.
    error : float
        Bound of the relative error of the load that the table leaves, by its `error` and
        `touch_error`. Neither the number of slices nor the model is in it.
    z : ndarray
        Middles of the slices along the axis, from the middle of the roller: lengths.
    approaches : ndarray
        Approaches of the slices, lengths; negative where a slice does not touch.
    loads : ndarray
        Loads per unit length: force/length.
    half_contacts : ndarray
        Half the lengths in contact: lengths.
    pressures : ndarray
        Largest pressures; infinite at a corner.

    Examples
    --------
    >>> import linecontact as lc
    >>> steel = lc.Material(206e3, 0.3)
    >>> contact = lc.Contact(lc.Flat(), lc.Parabola(5.0, (-1.0, 1.0)), materials=(steel, steel))
    >>> to = lc.References(0.0, lc.Reference.length(10.0), lc.Reference.disc(5.0))
    >>> roller = lc.FiniteRoller(lc.SpringTable(contact, to, (1.0, 1000.0)), 10.0)
    >>> state = roller.under_load(5000.0)
    >>> print(state.loads[[0, 20, 40]].round(6), state.moment)
    [500. 500. 500.] 0.0
    """

    approach: float
    misalignment: float
    load: float
    moment: float
    stiffness: FloatArray
    error: float
    z: FloatArray
    approaches: FloatArray
    loads: FloatArray
    half_contacts: FloatArray
    pressures: FloatArray

    def __repr__(self) -> str:
        """Returns the numbers of the roller without those of its slices."""
        whole = f"load={self.load:.6g}, moment={self.moment:.6g}, misalignment={self.misalignment:.6g}"
        return f"<RollerState {whole}, largest_pressure={self.largest_pressure:.6g}, {self.z.size} slices>"

    @property
    def largest_pressure(self) -> float:
        """Largest pressure of all slices; infinite at a corner."""
        return float(np.max(self.pressures))

    def plot(self, units: Sequence[str] = ("", "", ""), figure: Figure | None = None) -> Figure:
        """Draws the load per unit length and the largest pressure along the axis.

        It needs matplotlib.

        Parameters
        ----------
        units : (str, str, str), optional
            Names of the units of lengths, pressures and loads per unit length, to be shown at the
            axes, such as ("mm", "MPa", "N/mm").
        figure : matplotlib.figure.Figure, optional
            Figure to draw in, as for `Solution.plot`.

        Returns
        -------
        matplotlib.figure.Figure
        """
        from .drawing import plot_roller

        return plot_roller(self, units, figure)


class FiniteRoller:
    """A roller of finite length on a raceway, by slices that do not know of each other.

    Each slice is a plane contact with the load per unit length of a `SpringTable`, at the approach
    `approach + misalignment * z - relief(z)`: the lamina model of ISO/TS 16281. What it leaves out
    is in `docs/python.md`.

    Parameters
    ----------
    table : SpringTable
        Load per unit length against approach. For a raceway that is large beside the roller take
        `Reference.length(length)` as its reference, and `Reference.disc(radius)` for the roller.
    length : float
        Length of the roller.
    slices : int
        Number of slices: ISO/TS 16281 asks for at least 30.
    relief : Body
        Profile along the axis: x from the middle of the roller, y the distance by which it recedes
        from the raceway. `Flat` is a cylinder, `Parabola` a crown, `Crowning` the logarithm of
        Lundberg, a `Piecewise` of lines a chamfer, and a `Spline` is a measured profile.

    Examples
    --------
    A steel roller of 10 mm diameter and length, with the relief of ISO/TS 16281: mm, MPa, N.

    >>> import linecontact as lc
    >>> steel = lc.Material(206e3, 0.3)
    >>> circle = lc.Ellipse.circle(5.0, (-1.0, 1.0))
    >>> contact = lc.Contact(lc.Flat(), circle, materials=(steel, steel))
    >>> to = lc.References(0.0, lc.Reference.length(10.0), lc.Reference.disc(5.0))
    >>> table = lc.SpringTable(contact, to, (0.01, 2000.0))
    >>> roller = lc.FiniteRoller(table, 10.0, 41, lc.Crowning(0.0035, 5.0, (-5.0, 5.0)))
    >>> tilted = roller.under_load(5000.0, 1e-3)
    >>> round(tilted.moment), round(tilted.largest_pressure)
    (3342, 2160)
    >>> round(roller.under_moment(5000.0, tilted.moment).misalignment, 12)
    0.001
    """

    def __init__(self, table: SpringTable, length: float, slices: int = 41, relief: Body | None = None) -> None:
        if not isinstance(table, SpringTable):
            raise TypeError(f"{table!r} is no SpringTable: make one of the contact of the roller with its raceway")
        relief = Flat() if relief is None else relief
        if not isinstance(relief, Body):
            raise TypeError(f"relief is {relief!r}: give a body, as Crowning, Curve or Spline")
        try:
            count = operator.index(slices)
        except TypeError:
            raise TypeError(f"slices is {slices!r}: give a whole number") from None
        self._made_of = (table, as_number(length, "length"), count, relief)
        whole = min(max(count, 0), sys.maxsize)
        try:
            self._roller = _native.FiniteRoller(table._table, self._made_of[1], whole, relief._profile)
        except InvalidRollerError as error:
            if whole == count:
                raise
            says = f"a roller of length {error.length:.6g} in {count} slices: they must be from 1 to {error.most}"
            raise refusal("InvalidRollerError", says, length=error.length, slices=count, most=error.most) from None

    def __reduce__(self) -> tuple[Any, ...]:
        return FiniteRoller, self._made_of

    def at(self, approach: float, misalignment: float = 0.0) -> RollerState:
        """Returns the state at an approach at the middle, a length, and a misalignment, in radians.
        """
        given = as_number(approach, "approach"), as_number(misalignment, "misalignment")
        return _state(self._roller.at(*given))

    def under_load(self, load: float, misalignment: float = 0.0) -> RollerState:
        """Returns the state under a load, a force, at a misalignment, in radians."""
        given = as_number(load, "load"), as_number(misalignment, "misalignment")
        return _state(self._roller.under_load(*given))

    def under_moment(self, load: float, moment: float) -> RollerState:
        """Returns the state under a load, a force, and a moment about the middle, force × length."""
        given = as_number(load, "load"), as_number(moment, "moment")
        return _state(self._roller.under_moment(*given))

    def __repr__(self) -> str:
        _, length, slices, relief = self._made_of
        return f"<FiniteRoller: length {length:.6g}, {slices} slices, relief {relief!r}>"


def _state(row: _native._RollerRow) -> RollerState:
    (approach, misalignment, load, moment), stiffness, error, slices = row
    return RollerState(approach, misalignment, load, moment, np.array(stiffness), error, *slices)
