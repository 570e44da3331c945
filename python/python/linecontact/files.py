"""Scenes in files, TOML or JSON: the same files that the Rust library reads and writes.

A file holds the two bodies by their parameters, their stiffness, the edges, the quantities to
prescribe, and labels of the units. The schema is `docs/scene.schema.json` in the repository.
Functions cannot be written: a `Curve` is refused, and so are settings of the numerical method.
"""

from __future__ import annotations

import json
import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeAlias, cast

import numpy as np

from . import _native
from .bodies import Body, Piecewise, Placed, Spline, _Shape
from .contact import (
    Contact,
    Edge,
    Foundation,
    Layer,
    Material,
    Prescribed,
    Reference,
    References,
    _both,
    _layers,
    _material,
    _wanted,
)
from .errors import SceneFileError

Fields: TypeAlias = dict[str, Any]
Named: TypeAlias = "str | Fields"

__all__ = ["Scene"]


@dataclass(frozen=True)
class Scene:
    """The contents of a file: a contact, and the quantities to prescribe.

    Parameters
    ----------
    contact : Contact
        Bodies, stiffness and edges.
    controls : sequence of dict
        Keyword arguments of `Contact.solve`, one dict for each solve.
    units : dict
        Labels of the units of "length", "pressure" and "load": they convert nothing. Files whose units
        are not known, or do not go together, such as GPa or kN with mm and N/mm, are refused.
    title : str
        Name of the scene.
    references : References, optional
        Points between which result sheets give the approach and the stiffness; they need materials.

    Examples
    --------
    >>> import linecontact as lc
    >>> contact = lc.Contact(lc.Flat(), lc.Ellipse.circle(10.0, (-1.5, 1.5)), contact_modulus=115e3)
    >>> units = {"length": "mm", "pressure": "MPa", "load": "N/mm"}
    >>> lc.Scene(contact, [{"load": 500.0}], units).to_file("roller.toml")
    >>> scene = lc.Scene.from_file("roller.toml")
    >>> scene.contact == contact, scene.controls
    (True, ({'load': 500.0},))
    """

    contact: Contact
    controls: Sequence[Prescribed] = ()
    units: Mapping[str, str] = field(default_factory=dict)
    title: str = ""
    references: References | None = None

    def __post_init__(self) -> None:
        """Refuses a scene that cannot be solved; a list of controls becomes a tuple."""
        if not isinstance(self.contact, Contact):
            raise TypeError(f"contact is {self.contact!r}: give a Contact")
        if isinstance(self.controls, Mapping):
            raise TypeError(f"controls is {self.controls!r}: give a list of dicts, one for each solve")
        object.__setattr__(self, "controls", tuple(dict(control) for control in self.controls))
        for control in self.controls:
            _wanted(control)
        for name, label in (*self.units.items(), ("title", self.title)):
            if name not in ("length", "pressure", "load", "title") or not isinstance(label, str):
                raise TypeError(f"{name} is {label!r}: units have labels of length, pressure and load, as text")

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Scene:
        """Reads a scene from a file, whose name ends in `.toml` or `.json`.

        Raises
        ------
        linecontact.errors.SceneFileError
            For a bad file, with line and field.
        """
        form = _form(path)
        text = Path(path).read_bytes()
        try:
            fields = json.loads(_native.scene_text(text.decode("utf-8-sig"), form, "json"))
        except UnicodeDecodeError as error:
            line = text[: error.start].count(b"\n") + 1
            raise SceneFileError(os.fspath(path), line, "", "the text is not UTF-8") from None
        except SceneFileError as error:
            raise SceneFileError(os.fspath(path), error.line, error.field, error.reason) from None
        controls = tuple(map(_read_control, fields.get("controls", ())))
        to = _read_references(fields["references"]) if "references" in fields else None
        return cls(_read_contact(fields), controls, fields.get("units", {}), fields.get("title", ""), to)

    def to_file(self, path: str | os.PathLike[str]) -> None:
        """Writes the scene to a file, whose name ends in `.toml` or `.json`.

        Numbers are written with all their digits.

        Raises
        ------
        linecontact.errors.SceneFileError
            For a body or a setting that a file cannot hold.
        """
        form = _form(path)
        try:
            fields = _contact_fields(self.contact)
            fields |= {"controls": list(map(_control_fields, self.controls))}
            fields |= {"units": dict(self.units), "title": self.title}
            if self.references is not None:
                fields["references"] = _references_fields(self.references)
            text = _native.scene_text(_json(fields), "json", form)
        except SceneFileError as error:
            raise SceneFileError(os.fspath(path), None, error.field, error.reason) from None
        Path(path).write_text(text, encoding="utf-8", newline="\n")


def _form(path: str | os.PathLike[str]) -> str:
    form = Path(path).suffix.lower().removeprefix(".")
    if form not in ("toml", "json"):
        raise SceneFileError(os.fspath(path), None, "", "the name of the file must end in .toml or .json")
    return form


def _json(fields: Fields) -> str:
    try:
        return json.dumps(fields, default=_plain, allow_nan=False)
    except SceneFileError:
        raise
    except ValueError:
        raise SceneFileError("", None, "", "a number is not finite: a file cannot hold it") from None


def _plain(value: Any) -> Any:
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    raise SceneFileError("", None, "", f"{value!r} is no number, text, list or dict: a file cannot hold it")


def _named(value: Named) -> tuple[str, Any]:
    """Splits a variant into its name and its contents."""
    return (value, ()) if isinstance(value, str) else next(iter(value.items()))


def _read_body(fields: Fields) -> Body:
    kind, shape = _named(fields["shape"])
    body: Body
    if kind == "spline":
        fit = shape["fit"]
        body = Spline(shape["points"], smooth=fit["smooth"], outliers=fit["outliers"] or None, period=fit.get("period"))
    elif kind == "piecewise":
        body = Piecewise([_read_body(part) for part in shape["parts"]], shape.get("tolerance"))
    else:
        body = _Shape.KINDS[kind](**dict(shape))
    steps = [_named(step) for step in fields.get("steps", ())]
    if not steps:
        return body
    return Placed(body, [(name, tuple(np.atleast_1d(numbers))) for name, numbers in steps])


def _body_fields(body: Body, place: str) -> Fields:
    if isinstance(body, Placed):
        steps = [{name: numbers if numbers[1:] else numbers[0]} if numbers else name for name, numbers in body.steps]
        return _body_fields(body.body, place) | {"steps": steps}
    if isinstance(body, _Shape) and type(body) is body.KINDS[body._kind]:
        numbers = body._numbers()
        return {"shape": {body._kind: numbers} if numbers else body._kind}
    if type(body) is Spline:
        fit = {"smooth": body.smooth, "outliers": body.outliers or 0.0} | ({} if body.period is None else {"period": body.period})
        return {"shape": {"spline": {"points": body.points, "fit": fit}}}
    if type(body) is Piecewise:
        parts = [_body_fields(part, f"{place}.parts[{i}]") for i, part in enumerate(body.parts)]
        return {"shape": {"piecewise": {"parts": parts, "tolerance": body.tolerance}}}
    reason = "a function cannot be written: take one of the shapes, or a Spline through points of the curve"
    raise SceneFileError("", None, place, f"{type(body).__name__}: {reason}")


def _read_material(value: Named) -> Material:
    return Material.rigid() if value == "rigid" else Material(**cast("Fields", value)["elastic"])


def _read_foundation(value: Named) -> Foundation:
    kind, given = _named(value)
    if kind not in ("layer", "stack"):
        return _read_material(value)
    base = given["base"]
    below: Any = base if isinstance(base, str) else _read_material(base["half_plane"])
    layers = given["layers"] if kind == "stack" else [(given["material"], given["thickness"])]
    for material, thickness in reversed(layers):
        below = Layer(_read_material(material), thickness, below)
    return cast("Foundation", Material.rigid() if isinstance(below, str) else below)


def _material_fields(given: Sequence[float]) -> Named:
    material = _material(given)
    return "rigid" if material.youngs_modulus == math.inf else {"elastic": material._asdict()}


def _foundation_fields(given: Foundation) -> Named:
    layers, below = _layers(given)
    if not layers:
        return _material_fields(cast("Sequence[float]", given))
    base = below if isinstance(below, str) else {"half_plane": _material_fields(below)}
    sheets = [(_material_fields(layer.material), layer.thickness) for layer in layers]
    if len(sheets) > 1:
        return {"stack": {"layers": sheets, "base": base}}
    [(material, thickness)] = sheets
    return {"layer": {"material": material, "thickness": thickness, "base": base}}


def _read_edge(value: Named) -> Edge:
    kind, x = _named(value)
    return Edge(kind) if kind == "free" else Edge(kind, x)  # type: ignore[arg-type]


def _read_contact(fields: Fields) -> Contact:
    settings: Fields = {name: fields[name] for name in ("resolution", "period", "certified") if name in fields}
    if "stiffness" in fields:
        kind, value = _named(fields["stiffness"])
        if kind == "materials":
            settings["plane"] = value["plane"]
            value = _read_foundation(value["lower"]), _read_foundation(value["upper"])
        settings[kind] = value
    if "edges" in fields:
        settings["edges"] = tuple(_read_edge(fields["edges"][side]) for side in ("left", "right"))
    return Contact(_read_body(fields["lower"]), _read_body(fields["upper"]), **settings)


def _contact_fields(contact: Contact) -> Fields:
    fields = {side: _body_fields(getattr(contact, side), side) for side in ("lower", "upper")}
    settings = contact.settings
    if materials := settings.pop("materials", None):
        lower, upper = map(_foundation_fields, _both(materials))
        fields["stiffness"] = {
            "materials": {"lower": lower, "upper": upper, "plane": settings.pop("plane", "strain")}
        }
    for kind in ("contact_modulus", "kappa"):
        if kind in settings:
            fields["stiffness"] = {kind: settings.pop(kind)}
    if edges := settings.pop("edges", None):
        left, right = (kind if kind == "free" else {kind: x} for kind, x in edges)
        fields["edges"] = {"left": left, "right": right}
    fields |= {name: settings.pop(name) for name in ("resolution", "period", "certified") if name in settings}
    for name in settings:
        raise SceneFileError("", None, name, "a file holds no settings of the numerical method, such as a tolerance: leave it out")
    return fields


def _read_references(fields: Fields) -> References:
    lower, upper = (Reference(*_named(fields[side])) for side in ("lower", "upper"))  # type: ignore[arg-type]
    return References(fields["x"], lower, upper)


def _references_fields(given: References) -> Fields:
    x, lower, upper = given
    return {"x": x, "lower": {lower.kind: lower.value}, "upper": {upper.kind: upper.value}}


def _read_control(value: Fields) -> Prescribed:
    kind, given = _named(value)
    if kind == "centre_of_pressure":
        return {"load": given["load"], "centre_of_pressure": given["at"]}
    if kind == "approach":
        return {"approach": given["approach"], "references": _read_references(given["references"])}
    return cast("Prescribed", given if kind == "moment" else {kind: given})


def _control_fields(given: Prescribed) -> Fields:
    fields: Fields = dict(given)
    if "centre_of_pressure" in fields:
        fields["at"] = fields.pop("centre_of_pressure")
        return {"centre_of_pressure": fields}
    if "moment" in fields:
        return {"moment": {"about": 0.0} | fields}
    if references := fields.pop("references", None):
        return {"approach": fields | {"references": _references_fields(references)}}
    return fields
