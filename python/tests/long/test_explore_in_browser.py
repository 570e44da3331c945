"""The page that `explore` writes, in Chromium: what keys, mouse and fingers do, and what is shown then."""

from __future__ import annotations

import math
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scenes import SCENES, Pair, reference

import linecontact as lc

playwright = pytest.importorskip("playwright.sync_api", reason="no playwright: pip install playwright")
CHROMIUM = shutil.which("chromium")
pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no chromium on the PATH")

STEEL = lc.Material(210e3, 0.3)
UNITS = ("mm", "MPa", "N/mm")
ROLLER = lc.Contact(lc.Flat(), lc.Ellipse.circle(10.0, (-1.0, 1.0)), materials=(STEEL, STEEL))
LOADS = np.linspace(100.0, 900.0, 9)
DESKTOP = {"viewport": {"width": 1200, "height": 900}}
PHONE = {"viewport": {"width": 360, "height": 740}, "has_touch": True, "is_mobile": True, "device_scale_factor": 2}
RAISED = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹−", "-0123456789-")


def bumps(x: Any) -> tuple[Any, ...]:
    return x, 1e-2 * (x**4 - 2 * x**2), 1.0, 4e-2 * (x**3 - x)


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with playwright.sync_playwright() as started:
        running = started.chromium.launch(executable_path=CHROMIUM)
        yield running
        running.close()


@contextmanager
def opened(browser: Any, file: Path, **settings: Any) -> Iterator[Any]:
    """A page, which must neither complain nor ask for anything but itself."""
    context = browser.new_context(**settings)
    page = context.new_page()
    said: list[str] = []
    asked: list[str] = []
    page.on("console", lambda message: said.append(message.text))
    page.on("pageerror", lambda error: said.append(str(error)))
    page.on("request", lambda request: asked.append(request.url))
    page.goto(file.as_uri())
    yield page
    context.close()
    assert said == []
    assert [url for url in asked if not url.startswith("data:")] == [file.as_uri()]


def value(page: Any, name: str) -> float:
    """What a number of the page is, as it is kept and as it is shown."""
    kept = float(page.locator(f"#{name}").get_attribute("value"))
    words = page.locator(f"#{name}").inner_text().translate(RAISED)
    if words in ("infinite", "-infinite"):
        assert math.isinf(kept)
        return kept
    mantissa, _, power = words.partition("·10")
    shown = float(mantissa) * 10.0 ** int(power or 0)
    size = float(page.locator("#half-width").get_attribute("value"))
    assert math.isclose(shown, kept, rel_tol=1e-4, abs_tol=1e-4 * size), name
    return kept


def check_numbers(page: Any, contact: lc.Contact, load: float) -> None:
    """That the page shows the solution under this load."""
    solution = contact.solve(load=load)
    peak, shear = solution.peak(), solution.max_shear()
    want = {
        "the-load": load,
        "left": solution.hull.left,
        "right": solution.hull.right,
        "half-width": solution.half_width,
        "peak": peak.pressure,
        "peak-x": peak.x,
        "mean": solution.mean_pressure,
        "shear": shear.value,
        "shear-x": shear.x,
        "shear-depth": shear.depth,
        "centre": solution.centre_of_pressure,
    }
    assert {name: value(page, name) for name in want} == want
    assert f"{load:g} N/mm" in page.locator("#load-shown").inner_text()
    assert f"Load {load:g} N/mm: contact from " in page.locator("#heard").inner_text()
    assert page.locator("#load").get_attribute("aria-valuetext") == f"{load:g} N/mm"
    check_place(page, solution)


def check_place(page: Any, solution: lc.Solution) -> None:
    x = value(page, "at-x")
    assert value(page, "at-pressure") == solution.pressure(x)
    assert value(page, "at-gap") == solution.gap(x)


def keep(page: Any, name: str) -> None:
    """A picture of the whole page, to be looked at."""
    page.screenshot(path=name, full_page=True)


def painted(page: Any) -> Any:
    """How many colours the shear has."""
    return page.evaluate(
        """() => {
            const { width, height } = document.getElementById("field");
            const copy = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
            copy.drawImage(document.getElementById("field"), 0, 0);
            const { data } = copy.getImageData(0, 0, width, height);
            return new Set(new Uint32Array(data.buffer)).size;
        }"""
    )


@pytest.fixture(scope="module")
def roller(tmp_path_factory: pytest.TempPathFactory) -> Path:
    page = tmp_path_factory.mktemp("roller") / "page.html"
    return lc.explore(ROLLER, LOADS, page, title="A roller on a flat", units=UNITS)


def test_keys_move_the_load(browser: Any, roller: Path, tmp_path: Path) -> None:
    with opened(browser, roller, **DESKTOP) as page:
        assert page.title() == page.locator("h1").inner_text() == "A roller on a flat"
        check_numbers(page, ROLLER, 500.0)
        page.locator("#load").focus()
        for key, load in [
            ("ArrowRight", 600.0),
            ("ArrowLeft", 500.0),
            ("Home", 100.0),
            ("ArrowUp", 200.0),
            ("End", 900.0),
            ("ArrowDown", 800.0),
        ]:
            page.keyboard.press(key)
            check_numbers(page, ROLLER, load)
        keep(page, str(tmp_path / "desktop.png"))


def test_keys_move_the_cursor(browser: Any, roller: Path) -> None:
    solution = ROLLER.solve(load=500.0)
    with opened(browser, roller, **DESKTOP) as page:
        page.locator("#load").focus()
        page.keyboard.press("Tab")
        assert page.evaluate("document.activeElement.id") == "place"
        assert value(page, "at-x") == solution.peak().x
        page.keyboard.press("ArrowRight")
        assert 0.0 < value(page, "at-x") < 0.1 * solution.a
        check_place(page, solution)
        page.keyboard.press("End")
        assert value(page, "at-x") > 2.0 * solution.a
        assert value(page, "at-pressure") == 0.0 < value(page, "at-gap")
        check_place(page, solution)


def drag(page: Any, name: str, share: float) -> None:
    """The knob of the load slider with the mouse, to a share of its way."""
    box = page.locator(name).bounding_box()
    middle, knob = box["y"] + 0.5 * box["height"], 26
    page.mouse.move(box["x"] + 0.5 * box["width"], middle)
    page.mouse.down()
    page.mouse.move(box["x"] + 0.5 * knob + share * (box["width"] - knob), middle, steps=5)
    page.mouse.up()


def test_the_mouse_moves_load_and_cursor(browser: Any, roller: Path) -> None:
    with opened(browser, roller, **DESKTOP) as page:
        drag(page, "#load", 0.75)
        check_numbers(page, ROLLER, 700.0)
        # Over the pictures: the middle of the axis is x = 0.
        axis = page.locator("#picture rect.frame").first.bounding_box()
        page.mouse.move(axis["x"] + 0.5 * axis["width"], axis["y"] + 30)
        page.mouse.down()
        page.mouse.move(axis["x"] + 0.625 * axis["width"], axis["y"] + 300, steps=4)
        page.mouse.up()
        largest = ROLLER.solve(load=900.0).half_width
        assert math.isclose(value(page, "at-x"), 0.5 * largest, abs_tol=0.03 * largest)
        check_place(page, ROLLER.solve(load=700.0))
        # The cursor stays there under another load.
        drag(page, "#load", 0.25)
        assert math.isclose(value(page, "at-x"), 0.5 * largest, abs_tol=0.06 * largest)
        check_numbers(page, ROLLER, 300.0)
        page.mouse.move(axis["x"] + 0.2 * axis["width"], axis["y"] + 300)
        assert value(page, "at-x") > 0.0


def touch(page: Any, points: list[tuple[float, float]]) -> None:
    """A finger put down, moved along and taken away."""
    session = page.context.new_cdp_session(page)

    def send(kind: str, at: list[tuple[float, float]]) -> None:
        fingers = [{"x": x, "y": y} for x, y in at]
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": fingers})

    send("touchStart", points[:1])
    for point in points[1:]:
        send("touchMove", [point])
    send("touchEnd", [])


def test_fingers_move_load_and_cursor(browser: Any, roller: Path, tmp_path: Path) -> None:
    with opened(browser, roller, **PHONE) as page:
        box = page.locator("#load").bounding_box()
        middle = box["y"] + 0.5 * box["height"]
        page.touchscreen.tap(box["x"] + box["width"] - 14, middle)
        check_numbers(page, ROLLER, 900.0)
        way = [(box["x"] + box["width"] - 13 - 10 * i, middle) for i in range(40)]
        touch(page, [point for point in way if point[0] > box["x"] + 5])
        check_numbers(page, ROLLER, 100.0)
        axis = page.locator("#picture rect.frame").first.bounding_box()
        at = axis["y"] + 0.5 * axis["height"]
        touch(page, [(axis["x"] + share * axis["width"], at) for share in np.linspace(0.5, 0.75, 12)])
        assert value(page, "at-x") > 0.0
        check_place(page, ROLLER.solve(load=100.0))
        # Nothing is wider than the screen.
        assert page.evaluate("document.documentElement.scrollWidth") <= 360
        keep(page, str(tmp_path / "phone.png"))


def test_axes_of_one_load(browser: Any, roller: Path, tmp_path: Path) -> None:
    with opened(browser, roller, **DESKTOP) as page:
        page.locator("#load").focus()
        page.keyboard.press("Home")
        few = painted(page)
        page.locator("#fit").check()
        assert painted(page) > few
        page.locator("#place").focus()
        page.keyboard.press("End")
        solution = ROLLER.solve(load=100.0)
        assert value(page, "at-x") <= 2.0 * solution.a * (1 + 1e-12)
        check_numbers(page, ROLLER, 100.0)
        keep(page, str(tmp_path / "fitted.png"))


def test_the_page_fits_where_it_is_shown(browser: Any, roller: Path) -> None:
    with opened(browser, roller, **DESKTOP) as page:
        for width in (1200, 800, 360, 1000):
            page.set_viewport_size({"width": width, "height": 800})
            settled = "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
            page.evaluate(settled)
            drawn = "Math.abs(picture.viewBox.baseVal.width - picture.clientWidth)"
            assert page.evaluate(drawn) < 2
            assert page.evaluate("document.documentElement.scrollWidth") <= width
            # The shear is where its frame is.
            field = page.locator("#field").bounding_box()
            frames = page.locator("#picture rect.frame").all()
            frame = next(one for one in map(lambda f: f.bounding_box(), frames) if one["y"] > field["y"] - 5)
            for key in ("x", "y", "width", "height"):
                assert math.isclose(field[key], frame[key], abs_tol=1.5), (width, key)


def test_printed(browser: Any, roller: Path, tmp_path: Path) -> None:
    with opened(browser, roller, **DESKTOP) as page:
        page.locator("#load").focus()
        page.keyboard.press("End")
        page.emulate_media(media="print")
        for name in ("#load", "#marks", "#place", "#fit"):
            assert not page.locator(name).is_visible()
        for name in ("#picture", "#numbers", "#load-shown"):
            assert page.locator(name).is_visible()
        check_numbers(page, ROLLER, 900.0)
        white = "getComputedStyle(document.body).backgroundColor"
        assert page.evaluate(white) == "rgb(255, 255, 255)"
        keep(page, str(tmp_path / "print.png"))
        pdf = page.pdf(path=str(tmp_path / "page.pdf"), format="A4")
        # One page.
        assert pdf.count(b"/Type /Page\n") == 1


def test_a_load_that_fails(browser: Any, tmp_path: Path) -> None:
    contact = lc.Contact(lc.Flat(), lc.Parabola(10.0, (-0.25, 0.25)), contact_modulus=115e3)
    file = lc.explore(contact, [100.0, 200.0, 900.0], tmp_path / "page.html", units=UNITS)
    with opened(browser, file, **DESKTOP) as page:
        mark = page.locator("#marks .wrong")
        assert mark.count() == 1
        assert "DomainTooShortError" in mark.get_attribute("title")
        assert not page.locator("#failure").is_visible()
        page.locator("#load").focus()
        page.keyboard.press("End")
        assert "DomainTooShortError" in page.locator("#failure").inner_text()
        assert "no contact" in page.locator("#heard").inner_text()
        assert "no contact" in page.locator("#load").get_attribute("aria-valuetext")
        assert not page.locator("#numbers").is_visible()
        assert painted(page) == 1
        keep(page, str(tmp_path / "failed.png"))
        page.keyboard.press("Home")
        assert not page.locator("#failure").is_visible()
        check_numbers(page, contact, 100.0)


def test_several_contacts(browser: Any, tmp_path: Path) -> None:
    contact = lc.Contact(lc.Flat(), lc.Curve((-2.0, 2.0), bumps), contact_modulus=115e3)
    file = lc.explore(contact, [300.0, 600.0, 3000.0], tmp_path / "page.html", units=UNITS)
    with opened(browser, file, **DESKTOP) as page:
        check_numbers(page, contact, 600.0)
        rows = page.locator("#contacts tr").all_inner_texts()
        assert len(rows) == 3
        for row, one in zip(rows[1:], contact.solve(load=600.0).contacts(), strict=True):
            shown = [float(cell.translate(RAISED)) for cell in row.split()]
            assert one.peak is not None
            want = [*one.interval, one.load, one.peak.pressure]
            np.testing.assert_allclose(shown, want, rtol=1e-4)
        keep(page, str(tmp_path / "several.png"))
        page.locator("#load").focus()
        page.keyboard.press("End")
        check_numbers(page, contact, 3000.0)
        assert page.locator("#contacts").is_visible() == (len(contact.solve(load=3000.0).intervals) > 1)


def test_what_is_infinite_is_called_so(browser: Any, tmp_path: Path) -> None:
    edges = (lc.Edge.fixed(-1.0), lc.Edge.fixed(1.0))
    contact = lc.Contact(lc.Flat(), lc.Flat(), kappa=1.0, edges=edges)
    file = lc.explore(contact, 0.02, tmp_path / "page.html")
    with opened(browser, file, **PHONE) as page:
        assert value(page, "peak") == value(page, "shear") == math.inf
        assert value(page, "at-pressure") == math.inf
        assert page.locator("#load").is_disabled()
        assert painted(page) > 5
        keep(page, str(tmp_path / "punch.png"))


ODD = {name: pair for name, pair, _ in SCENES}


@pytest.mark.parametrize(("name", "pair"), ODD.items(), ids=ODD)
def test_any_size_and_shape(name: str, pair: Callable[[], Pair], browser: Any, tmp_path: Path) -> None:
    want = reference(name)
    contact = lc.Contact(*pair(), kappa=want.kappa)
    file = lc.explore(contact, [0.5 * want.load, want.load], tmp_path / "page.html", units=("m", "Pa", "N/m"))
    with opened(browser, file, **PHONE) as page:
        for fit in (False, True):
            page.locator("#fit").set_checked(fit)
            drawn, words = page.locator("#picture").inner_html(), page.locator("body").inner_text()
            for wrong in ("NaN", "undefined", "null", "Infinity"):
                assert wrong not in drawn and wrong not in words
            assert page.locator("#picture .grid").count() > 5
            # Of corners that are touched for a millionth of the width the shear is nowhere to be seen.
            assert painted(page) >= (1 if name == "rounded_punch_1e-6" else 2)
        peak = page.locator("#peak").get_attribute("value")
        solution = contact.solve(load=want.load)
        assert float(peak) == solution.peak().pressure
        assert page.evaluate("document.documentElement.scrollWidth") <= 360
        keep(page, str(tmp_path / "page.png"))


def test_a_hostile_title_does_nothing(browser: Any, tmp_path: Path) -> None:
    title = "</title></script><img src=x onerror=console.log(1)><script>console.log(2)</script>"
    file = lc.explore(ROLLER, 500.0, tmp_path / "page.html", title=title, units=("<b>", "</script>", "&amp;"))
    with opened(browser, file, **DESKTOP) as page:
        assert page.locator("h1").inner_text() == page.title() == title
        assert page.locator("img").count() == 0
        assert page.locator("#load-shown").inner_text() == "500 &amp;"


def test_without_javascript(browser: Any, roller: Path) -> None:
    with opened(browser, roller, java_script_enabled=False) as page:
        assert "JavaScript" in page.locator("noscript").inner_text()
