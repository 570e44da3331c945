"""Derivatives of numbers of a solution by numbers of its scene, exact to rounding."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias, cast, overload

import numpy as np

from . import _native
from ._numbers import FloatArray
from .contact import Contact, References, _control

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .contact import Prescribed

Parameter: TypeAlias = str | Mapping[str, float]
"""A number of a scene by its name, or several and how fast each changes with the parameter."""

__all__ = ["gradient", "parameters"]


# A name is a sequence of its letters: the first that fits counts.
@overload
def gradient(  # type: ignore[overload-overlap]
    contact: Contact, of: str, by: Parameter, **prescribed: Unpack[Prescribed]
) -> tuple[float, float]: ...
@overload
def gradient(  # type: ignore[overload-overlap]
    contact: Contact, of: str, by: Sequence[Parameter], **prescribed: Unpack[Prescribed]
) -> tuple[float, FloatArray]: ...
@overload
def gradient(
    contact: Contact,
    of: Sequence[str],
    by: Parameter | Sequence[Parameter],
    **prescribed: Unpack[Prescribed],
) -> tuple[FloatArray, FloatArray]: ...
def gradient(
    contact: Contact,
    of: str | Sequence[str],
    by: Parameter | Sequence[Parameter],
    **prescribed: Unpack[Prescribed],
) -> tuple[float | FloatArray, float | FloatArray]:
    """Numbers of a solution, and their derivatives by numbers of the scene.

    The solver works on dual numbers, which carry their derivatives along: there is no step to choose, and no error
    but that of rounding. There is one solve, and one more for each parameter.

    Parameters
    ----------
    contact : Contact
        Of any bodies but a `Curve`, whose second derivatives are not known.
    of : str or sequence of str
        What is differentiated: "load", "a", "b", "half_width", "centre", "tilt", "mean_pressure", "peak_pressure",
        "moment", "centre_of_pressure", "max_shear", and with references "approach" and "stiffness".
    by : str or mapping or sequence of them
        By what: numbers of the bodies as their constructors call them ("upper.depth", "lower.angles.0",
        "upper.parts.1.radius"), of the steps that have placed them ("upper.rotated.angle", "lower.shifted.along"; of
        two steps of the same name "upper.rotated.0.angle" and "upper.rotated.1.angle"), of the contact
        ("contact_modulus", "materials.0.youngs_modulus", "edges.1.value"), and what is prescribed ("load",
        "references.x"). `parameters` lists them. A mapping moves several at once, each at its rate:
        `{"upper.along": 1.0, "upper.across": 1.0}` is the radius of a circle.
    **prescribed : float
        As for `Contact.solve`. References may be given with any of it.

    Returns
    -------
    values : float or ndarray
        As `of`, in the units of the quantities.
    derivatives : float or ndarray
        Each quantity by each parameter: one number, a row or column, or the Jacobian matrix of shape
        `(len(of), len(by))`. In the unit of the quantity per unit of the parameter.

    Raises
    ------
    ValueError
        For a parameter that the scene has not, a quantity without a derivative, and a `Curve`.
    linecontact.errors.LineContactError
        As for `Contact.solve`, and what the quantities raise: at a corner the peak pressure is infinite.

    Notes
    -----
    Where contacts are born or merge, and where an edge reaches its corner, there is no derivative: what comes out is
    that of one side, or not finite. Where the largest pressure moves from one maximum to another its derivative jumps;
    where two maxima are equal, as in a symmetric scene, it is that of one, and by another parameter maybe of the other.

    The derivative of a body by the place where two of its parts meet is that of the parts: move both by a mapping, or
    a gap opens between them.

    Examples
    --------
    Hertz: the half-width goes with the root of the radius, the largest pressure with its reciprocal.

    >>> import linecontact as lc
    >>> roller = lc.Contact(lc.Flat(), lc.Parabola(10.0, (-1.0, 1.0)), contact_modulus=115e3)
    >>> values, derivatives = lc.gradient(
    ...     roller, ["half_width", "peak_pressure"], ["upper.radius", "load"], load=500.0
    ... )
    >>> values.round(4)
    array([2.3530000e-01, 1.3528791e+03])
    >>> (derivatives * [10.0, 500.0] / values[:, None]).round(12)  # powers of R and F
    array([[ 0.5,  0.5],
           [-0.5,  0.5]])

    For `scipy.optimize.minimize(..., jac=True)`:

    >>> def peak(depth):
    ...     body = lc.Crowning(depth[0], 5.0, (-4.9, 4.9))
    ...     contact = lc.Contact(lc.Flat(), body, contact_modulus=115e3)
    ...     return lc.gradient(contact, "peak_pressure", ["upper.depth"], load=500.0)
    >>> value, derivative = peak([0.1])
    >>> round(value, 1), derivative.round(1)
    (384.0, array([1906.7]))
    """
    quantities = [of] if isinstance(of, str) else list(of)
    alone = isinstance(by, str | Mapping)
    each = [by] if isinstance(by, str | Mapping) else by
    rates = [[(one, 1.0)] if isinstance(one, str) else list(one.items()) for one in each]
    values, columns = _native.gradient(contact._scene, *_given(prescribed, quantities), quantities, rates)
    derivatives = np.array(columns, dtype=np.float64).reshape(len(rates), len(quantities)).T
    if alone:
        derivatives = derivatives[:, 0]
    if isinstance(of, str):
        return values[0], float(derivatives[0]) if alone else derivatives[0]
    return np.array(values), derivatives


def parameters(contact: Contact, **prescribed: Unpack[Prescribed]) -> dict[str, float]:
    """All numbers of a scene by which `gradient` has derivatives, by their names.

    Parameters
    ----------
    contact : Contact
        Of any bodies but a `Curve`.
    **prescribed : float
        As for `gradient`, or nothing: then the numbers of the contact alone.

    Returns
    -------
    dict of str to float

    Examples
    --------
    >>> import linecontact as lc
    >>> contact = lc.Contact(lc.Flat(), lc.Parabola(10.0, (-1.0, 1.0)).rotated(0.01), kappa=1.0)
    >>> lc.parameters(contact, load=0.02)
    {'upper.radius': 10.0, 'upper.domain.0': -1.0, 'upper.domain.1': 1.0, 'upper.rotated.angle': 0.01, \
'kappa': 1.0, 'load': 0.02}
    """
    return dict(_native.parameters(contact._scene, *(_given(prescribed, []) if prescribed else (None, None))))


def _given(
    prescribed: Prescribed, quantities: list[str]
) -> tuple[tuple[str, list[float], References | None], References | None]:
    """What is prescribed, and between what an approach is measured."""
    numbers: dict[str, Any] = {**cast("Any", prescribed)}
    references: References | None = numbers.pop("references", None)
    kind, values = _control(numbers, references, quantities)
    wanted = kind, [float(value) for value in values], references if kind == "approach" else None
    return wanted, references
