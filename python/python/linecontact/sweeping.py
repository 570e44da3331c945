"""Many contacts in one call: over loads, over scenes, on all cores."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _native
from ._numbers import as_numbers, named
from .contact import Contact, References, _control

if TYPE_CHECKING:
    from pandas import DataFrame

    from .slipping import Side

__all__ = ["Columns", "sweep"]

# Largest number of threads, more than machines have cores: starting more would take longer than any
# sweep.
_MOST_THREADS = 512

# Types of the columns of counts and booleans.
_KINDS: dict[str, type[Any]] = {"contacts": np.int64, "evaluations": np.int64, "is_checked": np.bool_}


class Columns(dict[str, npt.NDArray[Any]]):
    """The results of a sweep: an array for each quantity, with one number for each row.

    Attributes
    ----------
    errors : dict of int to Exception
        Exceptions of the failed rows, by row number.

    Examples
    --------
    >>> import linecontact as lc
    >>> contact = lc.Contact(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), kappa=1.0)
    >>> found = lc.sweep(contact, load=[0.02, -1.0])
    >>> found["error"]
    array(['', 'InvalidLoadError'], dtype=object)
    >>> print(found.errors[1])
    the load is -1: it must be finite, and positive where limits are sought
    """

    errors: dict[int, Exception]

    def __init__(self, columns: dict[str, npt.NDArray[Any]], errors: dict[int, Exception]) -> None:
        super().__init__(columns)
        self.errors = errors

    def __reduce__(self) -> tuple[Any, ...]:
        return Columns, (dict(self), self.errors)

    def __repr__(self) -> str:
        rows = len(self["error"])
        failed = f", {len(self.errors)} failed" if self.errors else ""
        return f"<Columns: {rows} rows of {', '.join(self)}{failed}>"

    def to_pandas(self, **parameters: npt.ArrayLike) -> DataFrame:
        """Returns the columns as a data frame of pandas, if pandas is installed.

        Parameters
        ----------
        **parameters : array_like
            Further columns, before those of the sweep: parameters of the scenes, say, as numbers or
            as arrays with one entry for each row.

        Examples
        --------
        >>> import linecontact as lc
        >>> radii = [10.0, 20.0]
        >>> rollers = [lc.Contact(lc.Flat(), lc.Parabola(r, (-1.0, 1.0)), kappa=1.0) for r in radii]
        >>> frame = lc.sweep(rollers, load=[2e-3, -1.0]).to_pandas(radius=radii)
        >>> frame[["radius", "load", "error"]].to_dict("list")
        {'radius': [10.0, 20.0], 'load': [0.002, -1.0], 'error': ['', 'InvalidLoadError']}
        """
        try:
            from pandas import DataFrame
        except ImportError as missing:
            raise ImportError("to_pandas() needs pandas: pip install pandas") from missing
        rows = len(self["error"])
        columns = {name: np.broadcast_to(np.asarray(values), (rows,)) for name, values in parameters.items()}
        return DataFrame({**columns, **self})


@named
def sweep(
    contacts: Contact | Sequence[Contact],
    *,
    quantities: Sequence[str] | str = ("load", "a", "b", "peak_pressure"),
    references: References | None = None,
    body: Side | None = None,
    progress: bool | Callable[[int, int], object] = False,
    threads: int | None = None,
    **prescribed: npt.ArrayLike,
) -> Columns:
    """Solves many contacts on all cores, and returns the quantities as columns.

    For each row a contact is solved under the prescribed quantities of this row. A single contact
    or number serves all rows. A row that fails does not affect the others.

    Parameters
    ----------
    contacts : Contact or sequence of Contact
        One contact for all rows, or one for each row.
    quantities : sequence of str, or str
        Quantities of each solution; no others are computed. Lengths: "a", "b", "half_width" and
        "centre" (of the interval between the outermost limits), "peak_x", "centre_of_pressure",
        "max_shear_x", "max_shear_depth", "approach", "separation", "half_width_deviation".
        Pressures: "peak_pressure" (infinite at a corner), "peak_error", its estimated error, "mean_pressure", "max_shear",
        "stiffness", "peak_pressure_deviation". The deviations are those of `Solution.uncertainty`. "load" is a
        force/length, "moment" a force, "tilt" is in radians. "limits_error" is a share of the
        half-width, NaN where both limits were given. "contacts" (their number), "evaluations" (of
        the curves) and "is_checked" are not floats, and 0 where the row has failed.
    references : References, optional
        References of the approach and the stiffness, as quantities or prescribed.
    body : {"lower", "upper"}, optional
        Body of the shear, as for `Solution.max_shear`.
    progress : bool or callable
        True shows a bar if tqdm is installed. A function is called now and then, with the number of
        rows done and the number of all rows.
    threads : int, optional
        Largest number of threads. Default: the number of cores that this process may use.
    **prescribed : array_like
        Prescribed quantities, as for `Contact.solve`: numbers, or arrays with one number for each
        row.

    Returns
    -------
    Columns
        A dict of arrays: the quantities, and "error" with the name of the error of each row, "" if
        it has not failed. A row that has failed keeps the quantities that were prescribed; its
        other numbers are NaN.

    Notes
    -----
    Rows are solved in runs of up to 32. The first of a run is solved from nothing, each other from
    the contact of the row before: put similar rows next to each other, with the load innermost. The
    results do not depend on the number of threads. The functions of a `Curve` are called from all
    threads. An exception raised in them is the error of the row, but KeyboardInterrupt and
    SystemExit end the sweep, as Ctrl-C does.

    Examples
    --------
    >>> import linecontact as lc
    >>> contact = lc.Contact(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), kappa=1.0)
    >>> lc.sweep(contact, load=[0.02, 0.08])["a"].round(12)
    array([0.2, 0.4])

    Two rollers under three loads each:

    >>> rollers = [lc.Contact(lc.Flat(), lc.Parabola(r, (-9.0, 9.0)), contact_modulus=115e3) for r in (10.0, 20.0)]
    >>> found = lc.sweep([roller for roller in rollers for _ in range(3)], load=[100.0, 200.0, 300.0] * 2)
    >>> found["peak_pressure"].reshape(2, 3).round(1)
    array([[ 605. ,  855.6, 1047.9],
           [ 427.8,  605. ,  741. ]])
    """
    quantities = [quantities] if isinstance(quantities, str) else list(quantities)
    numbers = {name: as_numbers(values, name) for name, values in prescribed.items()}
    kind, given = _control(numbers, references, quantities)
    lengths = {len(contacts)} if not isinstance(contacts, Contact) else set()
    for name, values in numbers.items():
        if values.ndim > 1:
            raise ValueError(f"{name} has the shape {values.shape}: give a number, or one for each row")
        lengths |= {values.size} if values.ndim else set()
    if len(lengths) > 1:
        raise ValueError(f"contacts and numbers are of {sorted(lengths)} rows: give as many of each, or one")
    rows = lengths.pop() if lengths else 1

    if threads is not None and threads < 1:
        raise ValueError(f"{threads} threads: give one or more")

    several = [contacts] if isinstance(contacts, Contact) else contacts
    for contact in several:
        if not isinstance(contact, Contact):
            raise TypeError(f"{contact!r} is no Contact")
    scenes = [contact._scene for contact in several]
    # One contact serves all rows.
    which = np.arange(rows, dtype=np.uintp) % max(len(scenes), 1)
    told, close = _bar(progress, rows)
    try:
        columns, failures = _native.sweep(
            scenes,
            which,
            kind,
            [np.broadcast_to(values, (rows,)).astype(np.float64) for values in given],
            references,
            body,
            quantities,
            min(_cores() if threads is None else threads, max(rows, 1), _MOST_THREADS),
            told,
        )
    finally:
        close()
    found: dict[str, npt.NDArray[Any]] = {
        name: np.nan_to_num(column).astype(_KINDS[name]) if name in _KINDS else column
        for name, column in zip(quantities, columns, strict=True)
    }
    errors = dict(failures)
    found["error"] = np.full(rows, "", dtype=object)
    for row, error in errors.items():
        found["error"][row] = type(error).__name__
        for name in found.keys() & numbers.keys():
            found[name][row] = np.broadcast_to(numbers[name], (rows,))[row]
    return Columns(found, errors)


def _cores() -> int:
    """Returns the number of cores that this process may use."""
    allowed = getattr(os, "sched_getaffinity", None)
    return len(allowed(0)) if allowed else os.cpu_count() or 1


def _bar(
    progress: bool | Callable[[int, int], object], rows: int
) -> tuple[Callable[[int], object] | None, Callable[[], object]]:
    """Returns a function that reports the number of rows done, and one to be called at the end."""
    if callable(progress):
        of = progress
        return lambda done: of(done, rows), lambda: None
    if progress:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            return None, lambda: None
        bar = tqdm(total=rows, unit="contact")
        return lambda done: bar.update(done - bar.n), bar.close
    return None, lambda: None
