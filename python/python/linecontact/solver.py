"""Solves in one call, solvers that continue from their last contact, and tables of springs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, cast

from . import _native
from ._numbers import FloatArray, Numbers, as_number, as_numbers, as_range, as_references, named, refuse_unknown
from .bodies import Body
from .contact import Contact, Prescribed, References, Settings, _wanted
from .slipping import PartialSlip, acting
from .solution import Solution

if TYPE_CHECKING:
    from typing_extensions import Unpack

__all__ = ["Solver", "SpringPoints", "SpringTable", "solve"]


class Given(Settings, Prescribed, total=False):
    """The keyword arguments of a contact and of its solve."""


@named
def solve(lower: Body, upper: Body, **given: Unpack[Given]) -> Solution:
    """Creates a contact and solves it, in one call.

    Parameters
    ----------
    lower, upper : Body
        Body 1, below, and body 2, above.
    **given
        Keyword arguments of `Contact` and of `Contact.solve`.

    Returns
    -------
    Solution

    Examples
    --------
    >>> import linecontact as lc
    >>> roller = lc.Parabola(10.0, (-1.0, 1.0))  # mm, MPa, N/mm
    >>> lc.solve(lc.Flat(), roller, load=500.0, contact_modulus=115e3)
    <Solution: contact [-0.235283, 0.235283], load 500, checked>
    """
    names = Prescribed.__annotations__
    refuse_unknown(given, [*names, *Settings.__annotations__], "solve")
    prescribed = {name: value for name, value in given.items() if name in names}
    settings = {name: value for name, value in given.items() if name not in names}
    return Contact(lower, upper, **cast("Any", settings)).solve(**cast("Any", prescribed))


class Solver:
    """A solver that starts from its last contact: for the next load or the next time step.

    The same contact under another load takes few evaluations or none. One solver serves one thread
    at a time.

    Examples
    --------
    >>> import linecontact as lc
    >>> contact = lc.Contact(lc.Flat(), lc.Ellipse.circle(10.0, (-1.0, 1.0)), contact_modulus=115e3)
    >>> solver = lc.Solver()
    >>> [round(solver.solve(contact, load=load).half_width, 4) for load in (100.0, 101.0)]
    [0.1052, 0.1057]
    """

    __slots__ = ("_solver",)

    def __init__(self) -> None:
        self._solver = _native.Solver()

    def __reduce__(self) -> tuple[Any, ...]:
        return Solver, ()

    @named
    def solve(self, contact: Contact, **prescribed: Unpack[Prescribed]) -> Solution:
        """Finds a contact as `Contact.solve` does, but starts from the last contact."""
        wanted = _wanted(prescribed)
        return Solution(self._solver.solve(contact._scene, wanted), contact, wanted)

    @named
    def partial_slip(
        self, contact: Contact, *, friction: float, force: float, tension: float = 0.0, **prescribed: Unpack[Prescribed]
    ) -> PartialSlip:
        """Finds a contact as `Contact.partial_slip` does, but starts from the last contact."""
        wanted = _wanted(prescribed)
        along = acting(friction, force, tension)
        found = self._solver.partial_slip(contact._scene, wanted, along)
        return PartialSlip(found, contact, wanted, along)


class SpringPoints(NamedTuple):
    """States of a spring, numbers or arrays.

    Attributes
    ----------
    approach : float or ndarray
        Approach δ: a length.
    load : float or ndarray
        Load per unit length F: force/length.
    stiffness : float or ndarray
        Stiffness dF/dδ: a pressure.
    half_contact : float or ndarray
        Half the length in contact: the half-width, or half the sum of all widths; a length.
    peak : float or ndarray
        Largest pressure; infinite at a corner.
    """

    approach: Any
    load: Any
    stiffness: Any
    half_contact: Any
    peak: Any


class SpringTable:
    """A table of load, stiffness, half-width and peak pressure against the approach.

    A simulation looks them up at each step.

    Parameters
    ----------
    contact : Contact
        Contact with materials.
    references : References
        References between which the approach is measured.
    loads : (float, float)
        Least and largest load: force/length.
    tolerance : float
        Largest error of load, half-width and peak between the points, as a share. What it cannot
        reach is a `ToleranceNotReachedError`, with the error that is left as `reached`: a tolerance
        that can be reached.

    Examples
    --------
    >>> import linecontact as lc
    >>> steel = lc.Material(210e3, 0.3)
    >>> roller = lc.Ellipse.circle(10.0, (-1.0, 1.0))
    >>> contact = lc.Contact(lc.Flat(), roller, materials=(steel, steel))
    >>> to = lc.References(0.0, lc.Reference.depth(30.0), lc.Reference.disc(10.0))
    >>> table = lc.SpringTable(contact, to, (1.0, 1000.0), 1e-6)
    >>> table.error < 1e-6, table.points.load.size < 20
    (True, True)
    >>> abs(table.at(contact.solve(load=500.0).approach(to).bodies).load / 500.0 - 1) < 1e-6
    True
    """

    def __init__(
        self, contact: Contact, references: References, loads: Sequence[float], tolerance: float = 1e-6
    ) -> None:
        self._made_of = (contact, references, as_range(loads, "loads"), as_number(tolerance, "tolerance"))
        self._table = _native.SpringTable(contact._scene, as_references(references), *self._made_of[2:])

    def __reduce__(self) -> tuple[Any, ...]:
        return SpringTable, self._made_of

    @property
    def error(self) -> float:
        """Largest error between the points, as a share: twice the observed error."""
        return self._table.error

    @property
    def stiffness_error(self) -> float:
        """Largest error of the stiffness between the points, as a share: twice the observed error.
        """
        return self._table.stiffness_error

    @property
    def touch_error(self) -> float:
        """Error near first touch, where the load is less than the least load F₁: a share of F₁.

        There the table has F₁ (δ/δ₁)ⁿ in place of the true load F, with the approach δ₁ and the
        exponent n of the first point. With a `touch_error` of 0.002 and a least load of 10 N/mm no
        load up to there is off by more than 0.02 N/mm. It is twice the largest error at three
        lighter loads; more than 1, so that nothing is known, where corners do not hold so light a
        load. A smaller least load makes it slowly smaller.
        """
        return self._table.touch_error

    @property
    def points(self) -> SpringPoints:
        """Solved points, by rising approach."""
        return SpringPoints(*self._table.points())

    def at(self, approach: float | Numbers) -> SpringPoints:
        """Returns the states at approaches up to the last point: lengths.

        At an approach of zero and below the bodies are apart, and bear nothing.
        """
        places = as_numbers(approach, "approach")

        def shaped(column: FloatArray) -> Any:
            return float(column[0]) if places.ndim == 0 else column.reshape(places.shape)

        return SpringPoints(*map(shaped, self._table.at(places.reshape(-1))))

    def __repr__(self) -> str:
        points = self.points.load.size
        return f"<SpringTable: {points} points, error {self.error:.2g}>"
