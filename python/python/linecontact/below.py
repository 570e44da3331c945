"""Materials below a contact: in which of them a stress is looked for, listed and drawn."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from .contact import Contact, Layer, Material

if TYPE_CHECKING:
    from .slipping import Side


class Below(NamedTuple):
    """A material: its words, its body and depths, and Poisson's ratio, 0 in plane stress.

    Half-planes have the same stress, so that no body is named, and the ratio is the smaller one of
    both, the worst for von Mises and Tresca; None without materials.
    """

    words: str
    body: Side | None
    depths: tuple[float, float] | None
    ratio: float | None


def materials(contact: Contact) -> list[Below]:
    """Returns the elastic materials below a contact: one for both bodies, if none has a layer."""
    given, is_strain = contact._settings["materials"] or (), contact._settings["plane"] == "strain"
    found = list[Below]()
    sides: tuple[Side, Side] = ("lower", "upper")
    for body, one in zip(sides, given, strict=False):
        parts = [("body", one, (0.0, math.inf))]
        if isinstance(one, Layer) and isinstance(one.base, Layer):
            # Not known of several layers.
            parts = []
        elif isinstance(one, Layer):
            # A rigid layer is a rigid body.
            base = one.base if math.isfinite(one.material.youngs_modulus) else "bonded"
            # The interface itself belongs to the layer.
            below = (float(np.nextafter(one.thickness, math.inf)), math.inf)
            parts = [("layer", one.material, (0.0, one.thickness)), ("base", base, below)]
        elastic = [(name, Material(*of), depths) for name, of, depths in parts if not isinstance(of, str)]
        found += [
            Below(f"{body} {name}", body, depths, of.poisson_ratio * is_strain)
            for name, of, depths in elastic
            if math.isfinite(of.youngs_modulus)
        ]
    if any(isinstance(one, Layer) for one in given):
        return found
    return [Below("", None, None, min((one.ratio for one in found if one.ratio is not None), default=None))]


def ratio_below(contact: Contact, body: Side | None, depths: tuple[float, float] | None) -> float:
    """Returns Poisson's ratio of the materials below a surface, which must have one in common."""
    top, bottom = depths or (0.0, math.inf)
    found = materials(contact)
    meant = [
        one.ratio
        for one in found
        if one.ratio is not None
        and (body is None or one.body in (None, body))
        and (one.depths is None or (one.depths[0] < bottom and float(np.nextafter(top, math.inf)) < one.depths[1]))
    ]
    if body is not None and found and found[0].body is None and contact._settings["materials"]:
        # Of two half-planes one is named: its own ratio.
        own = Material(*contact._settings["materials"][body == "upper"])
        meant = [own.poisson_ratio * (contact._settings["plane"] == "strain")]
    if not meant:
        raise ValueError("the contact has no materials: give poisson_ratio")
    if len(set(meant)) > 1:
        raise ValueError(f"Poisson's ratios are {', '.join(map(repr, meant))}: name body and depths, or give poisson_ratio")
    return meant[0]


def bodies(contact: Contact) -> list[tuple[Side | None, float]]:
    """Returns the bodies that have a stress of their own, each with its largest depth."""
    depths = {one.body: one.depths[1] if one.depths else math.inf for one in materials(contact)}
    return list(depths.items())
