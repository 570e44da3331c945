"""Two bodies that move: poses in, force and torque out."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from . import _native
from ._numbers import FloatArray, as_number, as_references, one_of
from .bodies import Body
from .contact import Foundation, Plane, References, _both, _foundation

__all__ = ["Pair", "Pose", "Wrench"]


class _Pose(NamedTuple):
    x: float
    y: float
    angle: float


class Pose(_Pose):
    """Place of a body in the plane.

    Parameters
    ----------
    x, y : float
        The body's origin: lengths.
    angle : float
        Angle by which the body is turned counter-clockwise: radians.

    Examples
    --------
    >>> import linecontact as lc
    >>> lc.Pose(3.0, angle=0.1)
    Pose(x=3.0, y=0.0, angle=0.1)
    """

    __slots__ = ()

    def __new__(cls, x: float = 0.0, y: float = 0.0, angle: float = 0.0) -> Pose:
        """Creates the pose; refuses arguments that are no numbers, before any step."""
        return super().__new__(cls, as_number(x, "x"), as_number(y, "y"), as_number(angle, "angle"))


class Wrench(NamedTuple):
    """Force of two bodies on each other, per unit length; all of it zero if they are apart.

    Attributes
    ----------
    penetration : float
        Largest overlap of the undeformed bodies along the y axis of the lower body, a length; the
        gap, negative, if they are apart, and minus infinity if they lie beside each other.
    force : ndarray
        Force on the upper body, that on the lower one with the other sign: force/length.
    at : ndarray
        Place in the plane where it acts; if the bodies are apart, where they would touch first.
    torque : ndarray
        Torques on the lower and on the upper body, each about its origin, counter-clockwise.
    contacts : int
        Number of places where the bodies touch.
    is_steep : bool
        True if the surfaces slope by more than 0.3 in the frame of the lower body where they touch:
        turn the frame, so that its y axis is about normal to the contact.

    Examples
    --------
    >>> import linecontact as lc
    >>> steel = lc.Material(210e3, 0.3)  # MPa; lengths in mm
    >>> to = lc.References(0.0, lc.Reference.depth(30.0), lc.Reference.disc(10.0))
    >>> pair = lc.Pair(lc.Flat(), lc.Parabola(10.0, (-1.0, 1.0)), materials=(steel, steel), references=to)
    >>> wrench = pair.at(lc.Pose(), lc.Pose(3.0, -0.01))
    >>> round(wrench.penetration, 12), wrench.torque.round(1)  # about x = 0, and about x = 3
    (0.01, array([-1053.8,     0. ]))
    """

    penetration: float
    force: FloatArray
    at: FloatArray
    torque: FloatArray
    contacts: int
    is_steep: bool


class Pair:
    """Two bodies that move, each in its own frame.

    The load acts along the y axis of the lower body: of a cam and its follower, the lower body is
    the follower. Where the surfaces slope by s in its frame, the real force is normal to them: its
    part along x, some s times the load, is left out, and so is its torque.

    Each surface is a curve without a turn in the frame of the lower body, with the material of the
    upper body above it. A body that is turned until its curve runs back, or further, upside down, is
    refused: of a cam that goes round, give the side that faces the follower. A round body that rolls
    keeps its angle, with its origin in the middle. A contact that reaches an end of the bodies is an
    error. One pair serves one thread at a time; it starts from the contact found last.

    Parameters
    ----------
    lower, upper : Body
        Bodies, the lower one below the upper one in the frame of the lower one.
    materials : (Material or Layer, Material or Layer)
        Materials of both.
    references : References
        References of the approach; their x is counted from the origin of the upper body, and kept
        within the bodies.
    plane : {"strain", "stress"}
        Plane state.
    resolution : float, optional
        Narrowest feature of the bodies to be seen, a length, as of `Contact`. Each step then samples
        all of the bodies.

    Examples
    --------
    >>> import linecontact as lc
    >>> steel = lc.Material(210e3, 0.3)  # MPa; lengths in mm
    >>> to = lc.References(0.0, lc.Reference.depth(30.0), lc.Reference.disc(10.0))
    >>> pair = lc.Pair(lc.Flat(), lc.Parabola(10.0, (-1.0, 1.0)), materials=(steel, steel), references=to)
    >>> pressed = pair.at(lc.Pose(), lc.Pose(3.0, -0.01))
    >>> pressed.force.round(1), pressed.contacts
    (array([  0. , 351.3]), 1)
    >>> pair.at(lc.Pose(), lc.Pose(3.0, 0.01)).force
    array([0., 0.])
    """

    __slots__ = ("_again", "_pair")

    def __init__(
        self,
        lower: Body,
        upper: Body,
        *,
        materials: Sequence[Foundation],
        references: References,
        plane: Plane = "strain",
        resolution: float | None = None,
    ) -> None:
        for name, body in (("lower", lower), ("upper", upper)):
            if not isinstance(body, Body):
                raise TypeError(f"the {name} body is {body!r}: give a body, such as Flat()")
        one_of(plane, "plane", ("strain", "stress"))
        given: dict[str, Any] = {"materials": materials, "references": references}
        self._again = partial(Pair, lower, upper, plane=plane, resolution=resolution, **given)
        surfaces = (*map(_foundation, _both(materials)), plane)
        to = as_references(references)
        self._pair = _native.Pair(lower._profile, upper._profile, surfaces, to, resolution)

    def __reduce__(self) -> tuple[Any, ...]:
        return self._again, ()

    def at(self, lower: Sequence[float], upper: Sequence[float]) -> Wrench:
        """Returns the force of the bodies on each other where they stand.

        It is continuous where bodies touch, and where contacts appear or merge.

        Raises
        ------
        linecontact.errors.PoseError
            With the place of the upper body in the frame of the lower one, and what is wrong there as
            `source`: it turns back or is upside down, or no contact is found.
        """
        penetration, *vectors, contacts, is_steep = self._pair.at(_pose(lower), _pose(upper))
        force, at, torque = map(np.array, vectors)
        return Wrench(penetration, force, at, torque, contacts, is_steep)

    def stiffness(self, lower: Sequence[float], upper: Sequence[float]) -> FloatArray:
        """Returns the derivatives of force and torque on the upper body by its pose, negative.

        In the rows are the force along x and y and the torque, in the columns x, y and angle. It
        takes six times as long as `at`.
        """
        return np.array(self._pair.stiffness(_pose(lower), _pose(upper)))


def _pose(given: Sequence[float]) -> tuple[float, float, float]:
    try:
        x, y, angle = given
    except (TypeError, ValueError):
        raise TypeError(f"a pose is {given!r}: give x, y and an angle, as Pose(1.0, 2.0, 0.1)") from None
    return as_number(x, "x"), as_number(y, "y"), as_number(angle, "angle")
