"""Two bodies that move."""

import pickle
from typing import Any

import linecontact as lc
import numpy as np
import pytest
from scenes import Array

STEEL = lc.Material(210e3, 0.3)
TO = lc.References(0.0, lc.Reference.depth(30.0), lc.Reference.disc(10.0))
ROLLER = lc.Ellipse.circle(10.0, (-1.2, 1.2))


def pair(**settings: Any) -> lc.Pair:
    given: dict[str, Any] = {"upper": ROLLER, "materials": (STEEL, STEEL), "references": TO}
    return lc.Pair(lc.Flat(), **(given | settings))


def test_pose_in_wrench_out() -> None:
    both, contact = pair(), lc.Contact(lc.Flat(), ROLLER.shifted(0.5), materials=(STEEL, STEEL))
    found = both.at(lc.Pose(), (0.5, -0.01, 0.0))
    to = TO._replace(x=0.5)
    load = contact.solve(approach=0.01, references=to).load
    np.testing.assert_allclose(found.force, [0.0, load], rtol=1e-12)
    np.testing.assert_allclose(found.at, [0.5, 0.0], atol=1e-9)
    np.testing.assert_allclose(found.torque, [-0.5 * load, 0.0], atol=1e-6 * load)
    assert found.penetration == pytest.approx(0.01, abs=1e-15) and found.contacts == 1 and not found.is_steep
    turned = both.at(lc.Pose(angle=np.pi / 2), lc.Pose(0.01, 0.5, np.pi / 2))
    np.testing.assert_allclose(turned.force, [-load, 0.0], atol=1e-9 * load)
    stiffness = both.stiffness(lc.Pose(), lc.Pose(0.5, -0.01))
    exact = contact.solve(approach=0.01, references=to).stiffness(to)
    np.testing.assert_allclose(stiffness[1, 1], exact, rtol=1e-6)
    np.testing.assert_allclose(stiffness[2, 2], 10.0 * load, rtol=1e-5)
    again = pickle.loads(pickle.dumps(both))
    np.testing.assert_allclose(again.at(lc.Pose(), lc.Pose(0.5, -0.01)).force, found.force, rtol=1e-12)


def test_a_resolution_shows_a_burr() -> None:
    def burred(x: Array) -> tuple[Array, Array, Array, Array]:
        s = (x - 0.6303) / 0.0005
        rest = np.maximum(1.0 - s * s, 0.0)
        return x, 0.05 * x * x - 0.04 * rest**3, np.ones_like(x), 0.1 * x + 0.24 * s * rest**2 / 0.0005

    burr = lc.Curve((-1.0, 1.0), burred)
    pairs = [lc.Pair(lc.Flat(), burr, materials=(STEEL, STEEL), references=TO, resolution=of) for of in (None, 1e-3)]
    found = [one.at(lc.Pose(), lc.Pose(0.0, 0.01)) for one in pairs]
    assert [one.contacts for one in found] == [0, 1]
    assert found[1].at[0] == pytest.approx(0.6303, abs=1e-4)
    again = pickle.loads(pickle.dumps(pair(resolution=-1.0)))
    for one in (again, pair(resolution=-1.0)):
        with pytest.raises(lc.errors.PoseError, match="the resolution is -1") as raised:
            one.at(lc.Pose(), lc.Pose())
        assert isinstance(raised.value.source, lc.errors.InvalidResolutionError)
    with pytest.raises(TypeError, match="resolution"):
        pair(resolution="fine")


def test_apart_and_mistakes() -> None:
    both = pair()
    lifted = both.at(lc.Pose(), lc.Pose(0.0, 0.2))
    assert not lifted.force.any() and not lifted.torque.any() and lifted.contacts == 0
    assert lifted.penetration == pytest.approx(-0.2, abs=1e-15)
    assert not both.stiffness(lc.Pose(), lc.Pose(0.0, 0.2)).any()
    with pytest.raises(lc.errors.PoseError, match="seen from body 1") as raised:
        both.at(lc.Pose(), lc.Pose(0.0, -0.1, 1.5))
    assert raised.value.angle == 1.5 and isinstance(raised.value.source, lc.LineContactError)
    with pytest.raises(lc.errors.PoseError, match="the y of a pose is inf: it must be finite"):
        both.at(lc.Pose(), lc.Pose(0.0, np.inf))
    with pytest.raises(lc.errors.PoseError, match="body 2 is at x = 2, y = -15, turned by 0: an approach") as raised:
        both.at(lc.Pose(1.0, 1.0), lc.Pose(3.0, -14.0))
    assert raised.value.y == -15.0 and isinstance(raised.value.source, lc.errors.ApproachTooLargeError)
    assert raised.value.__cause__ is raised.value.source
    cam = pair(upper=lc.Ellipse(10.0, 8.0, (-1.2, 1.2)).shifted(0.0, -8.0))
    assert cam.at(lc.Pose(), lc.Pose(0.0, 7.99)).contacts == 1
    for angle in (2.8, np.pi, 3.5):
        with pytest.raises(lc.errors.PoseError, match="not upside down"):
            cam.at(lc.Pose(), lc.Pose(0.0, 7.99, angle))
    with pytest.raises(TypeError, match="a pose is 3"):
        both.at(3, lc.Pose())  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="lower body"):
        lc.Pair(1.0, ROLLER, materials=(STEEL, STEEL), references=TO)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="plane"):
        pair(plane="both")
    layer = lc.Layer(lc.Material(5.0, 0.4), 1.0, "bonded")
    coated = pair(materials=(layer, STEEL)).at(lc.Pose(), lc.Pose(0.0, -0.01))
    assert 0.0 < coated.force[1] < both.at(lc.Pose(), lc.Pose(0.0, -0.01)).force[1]
