"""Derivatives of the numbers of a solution by the numbers of its scene, exact to rounding."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias, cast, overload

import numpy as np

from . import _native
from ._numbers import FloatArray, as_number
from .contact import Contact, References, _control

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .contact import Prescribed
    from .slipping import Side

Parameter: TypeAlias = str | Mapping[str, float]
"""Name of a number of a scene, or several names with the rates at which these numbers change."""

__all__ = ["gradient", "parameters"]


# A string is a sequence too: the first overload that fits counts.
@overload
def gradient(  # type: ignore[overload-overlap]
    contact: Contact, of: str, by: Parameter, *, body: Side | None = None, **prescribed: Unpack[Prescribed]
) -> tuple[float, float]: ...
@overload
def gradient(  # type: ignore[overload-overlap]
    contact: Contact, of: str, by: Sequence[Parameter], *, body: Side | None = None, **prescribed: Unpack[Prescribed]
) -> tuple[float, FloatArray]: ...
@overload
def gradient(
    contact: Contact,
    of: Sequence[str],
    by: Parameter | Sequence[Parameter],
    *,
    body: Side | None = None,
    **prescribed: Unpack[Prescribed],
) -> tuple[FloatArray, FloatArray]: ...
def gradient(
    contact: Contact,
    of: str | Sequence[str],
    by: Parameter | Sequence[Parameter],
    *,
    body: Side | None = None,
    **prescribed: Unpack[Prescribed],
) -> tuple[float | FloatArray, float | FloatArray]:
    """Returns numbers of a solution, and their derivatives by numbers of the scene.

    The solver works on dual numbers, which carry their derivatives along: there is no step to
    choose, and only rounding errors remain. It takes one solve, and one more for each parameter.

    Parameters
    ----------
    contact : Contact
        Contact of any bodies except a `Curve`, whose second derivatives are unknown.
    of : str or sequence of str
        Quantities to be differentiated: "load", "a", "b", "half_width", "centre", "tilt",
        "mean_pressure", "peak_pressure", "moment", "centre_of_pressure", "max_shear", and with
        references "approach" and "stiffness".
    by : str or mapping or sequence of them
        Parameters. They are numbers of the bodies, named as in the constructors ("upper.depth",
        "lower.angles.0", "upper.parts.1.radius"), of the placement steps ("upper.rotated.angle",
        "lower.shifted.along"; of two steps of the same name "upper.rotated.0.angle" and
        "upper.rotated.1.angle"), of the contact ("contact_modulus", "materials.0.youngs_modulus",
        "edges.1.value", of a layer "materials.1.thickness" and "materials.1.base.youngs_modulus"),
        and prescribed numbers ("load", "references.x"). `parameters` lists them.
        A mapping changes several numbers at once, each at its rate: the radius of a circle is
        `{"upper.along": 1.0, "upper.across": 1.0}`.
    body : {"lower", "upper"}, optional
        Body of the shear, as for `Solution.max_shear`.
    **prescribed : float
        Prescribed quantities, as for `Contact.solve`. References may be given with any of them.

    Returns
    -------
    values : float or ndarray
        Values of the quantities `of`, in their units.
    derivatives : float or ndarray
        Derivative of each quantity by each parameter: one number, a row or column, or the Jacobian
        matrix of shape `(len(of), len(by))`, in the unit of the quantity per unit of the parameter.

    Raises
    ------
    ValueError
        For a parameter that the scene does not have, a quantity without a derivative, and a
        `Curve`.
    linecontact.errors.LineContactError
        As for `Contact.solve`, and the errors of the quantities: at a corner the peak pressure is
        infinite.

    Notes
    -----
    There is no derivative where contacts appear or merge, or where an edge reaches its corner: the
    result is then a one-sided derivative, or not finite. The derivative of the peak pressure jumps
    where the peak moves from one maximum to another. Where two maxima are equal, as in a symmetric
    scene, it is the derivative of one of them, and not necessarily of the same one for each
    parameter.

    Derivatives by a placement of a smoothed `Spline` are for unchanged smoothing.

    A derivative by the place where two parts of a body meet moves the end of one part only: change
    both ends by a mapping, or a gap opens between the parts.

    Examples
    --------
    Hertz: the half-width is proportional to the root of the radius, the peak pressure to its
    reciprocal.

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
    values, columns = _native.gradient(contact._scene, *_given(prescribed, quantities), body, quantities, rates)
    derivatives = np.array(columns, dtype=np.float64).reshape(len(rates), len(quantities)).T
    if alone:
        derivatives = derivatives[:, 0]
    if isinstance(of, str):
        return values[0], float(derivatives[0]) if alone else derivatives[0]
    return np.array(values), derivatives


def parameters(contact: Contact, **prescribed: Unpack[Prescribed]) -> dict[str, float]:
    """Returns all numbers of a scene by which `gradient` differentiates, by name.

    Parameters
    ----------
    contact : Contact
        Contact of any bodies except a `Curve`.
    **prescribed : float
        Prescribed quantities, as for `gradient`. Without them only the numbers of the contact are
        returned.

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
    """Returns the prescribed quantities, and the references of an approach."""
    numbers: dict[str, Any] = {**cast("Any", prescribed)}
    references: References | None = numbers.pop("references", None)
    kind, values = _control({name: as_number(value, name) for name, value in numbers.items()}, references, quantities)
    return (kind, values, references if kind == "approach" else None), references
