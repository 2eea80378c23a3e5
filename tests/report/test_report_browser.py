"""The page in a real browser: what its controls do, and that it complains of nothing."""

from __future__ import annotations

import math
import shutil
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from samplekit._report import wording
from samplekit._report.page import page as page_of
from samplekit._study.results import Interval
from samplekit.files._images.exr import read_parts

playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
EXECUTABLE = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(EXECUTABLE is None, reason="no chromium is installed: apt-get install chromium"),
]
HOSTILE = "disk:note=\"'></script><script>window.intruder=1</script><img src=x onerror=window.intruder=1>"


@pytest.fixture(scope="module")
def browser():
    with playwright.sync_playwright() as started:
        browser = started.chromium.launch(executable_path=EXECUTABLE)
        yield browser
        browser.close()


def write_report(results, folder):
    path = folder / "report.html"
    path.write_text(page_of(results, folder), encoding="utf-8")
    return path


class Opened:
    """A page from a file, with what it complained of and what it asked for."""

    def __init__(self, browser, path, **how):
        self.complaints = []
        self.requests = []
        self.context = browser.new_context(viewport=how.pop("viewport", {"width": 1280, "height": 900}), **how)
        self.page = self.context.new_page()
        self.page.set_default_timeout(20_000)
        self.page.on("console", lambda message: self.complaints.append(message.text))
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.goto(path.as_uri())
        if how.get("java_script_enabled", True):
            self.page.wait_for_selector("html[data-ready]")

    def close(self):
        self.context.close()
        assert self.complaints == []
        assert len(self.requests) == 1, self.requests


@pytest.fixture(scope="module")
def path(study, tmp_path_factory):
    folder = tmp_path_factory.mktemp("report")
    results = study(size=(24, 16), folder=folder)
    rows = list(results.rows)
    rows[2] = replace(rows[2], mse=Interval(0.0), rmse=Interval(0.0), fitted=False, left_out="exact zero")
    rows[4] = replace(rows[4], replaced="jittered makes products", asked=[17])
    return write_report(replace(results, rows=rows), folder)


@pytest.fixture
def opened(browser, path):
    opened = Opened(browser, path)
    yield opened
    opened.close()


@pytest.fixture
def page(opened):
    return opened.page


def series(page, chart=0):
    """Samplers that are drawn in a chart."""
    return page.locator(".chart").nth(chart).locator("g.series").count()


def place(page, sampler, row, chart=0):
    """Where the marker of a sampler's row is in the window."""
    marker = page.locator(".chart").nth(chart).locator(f"g.series[data-series='{sampler}'] .point").nth(row)
    marker.scroll_into_view_if_needed()
    box = marker.bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def slide(page, selector, value):
    page.locator(selector).evaluate(
        "(slider, value) => { slider.value = value; slider.dispatchEvent(new Event('input', {bubbles: true})); }", value
    )


def choose(page, name, value):
    page.locator(f"[name={name}][value={value}]").check(force=True)


def shown(page, *rows):
    """Wait until the images of these rows are on the screen."""
    page.wait_for_selector(f"#compare[data-shown='{' '.join(map(str, rows))}']")


def test_all_charts_are_drawn_and_the_images_shown(page):
    assert page.locator(".chart svg").count() == 4
    assert [series(page, chart) for chart in range(4)] == [4] * 4
    shown(page, 1, 4)
    assert page.locator(".chart .guide").count() >= 8
    assert page.locator(".chart").first.locator(".whisker").count() == 11
    assert page.locator(".chart").first.locator(".band").count() == 4


def test_a_series_is_switched_off_in_all_charts_and_on_again(page):
    button = page.locator("#legend button", has_text="jittered")
    button.click()
    assert [series(page, chart) for chart in range(4)] == [3] * 4
    assert button.get_attribute("aria-pressed") == "false"
    assert page.locator(".chart g.series[data-series='1']").count() == 0
    button.press("Enter")
    assert [series(page, chart) for chart in range(4)] == [4] * 4
    button.dblclick()
    assert [series(page, chart) for chart in range(4)] == [1] * 4
    button.dblclick()
    assert [series(page, chart) for chart in range(4)] == [4] * 4
    for sampler in ("random", "jittered", "sobol+owen", "poisson-disk"):
        page.locator(f"#legend button[data-sampler='{sampler}']").click()
    assert page.locator(".chart").first.inner_text() == "no sampler is switched on"


def test_a_point_under_the_pointer_tells_its_values(page):
    tooltip = page.locator("#tooltip")
    assert tooltip.is_hidden()
    page.mouse.move(*place(page, 1, 1))
    text = tooltip.inner_text()
    assert "jittered" in text
    assert "16 (for 17)" in text
    assert "6.25·10⁻⁴" in text
    assert "6.12·10⁻⁴ … 6.38·10⁻⁴" in text
    assert "30.7 µs" in text
    assert "jittered makes products" in text
    assert page.locator(".chart").first.locator(".focus-ring").is_visible()
    assert page.locator(".chart").nth(1).locator(".focus-ring").is_visible()
    assert page.locator(".chart").first.locator(".dimmed").count() > 0
    page.mouse.move(2, 2)
    assert tooltip.is_hidden()
    assert page.locator(".chart .dimmed").count() == 0


def test_points_are_reached_with_the_keyboard(page):
    chart = page.locator(".chart svg").first
    chart.focus()
    page.keyboard.press("ArrowRight")
    assert page.locator("#tooltip strong").inner_text() == "random"
    page.keyboard.press("ArrowDown")
    page.keyboard.press("ArrowRight")
    assert page.locator("#tooltip strong").inner_text() == "jittered"
    assert "16 (for 17)" in page.locator("#tooltip").inner_text()
    page.keyboard.press("Escape")
    assert page.locator("#tooltip").is_hidden()


def test_an_exact_zero_lies_on_a_rail_of_its_own_and_is_hollow(page):
    chart = page.locator(".chart").first
    assert chart.locator(".zero-rail").count() == 1
    assert chart.locator(".point.hollow").count() == 1
    page.mouse.move(*place(page, 0, 2))
    text = page.locator("#tooltip").inner_text()
    assert "not in the fit: exact zero" in text
    assert "no interval" in text


def test_another_error_is_drawn(page):
    def title():
        return page.locator(".chart").first.locator("text").all_text_contents()

    assert "mean squared error" in title()
    choose(page, "blur", "blurred")
    assert "mean squared error, blurred by 2 pixels" in title()
    page.mouse.move(*place(page, 1, 0))
    assert "2.50·10⁻⁴" in page.locator("#tooltip").inner_text()
    choose(page, "metric", "bias")
    assert "|bias|" in title()
    assert page.locator("[name=blur][value=blurred]").is_disabled()
    page.mouse.move(*place(page, 1, 0))
    text = page.locator("#tooltip").inner_text()
    assert "5.00·10⁻⁵" in text
    assert "0 … 2.50·10⁻⁴" in text
    choose(page, "metric", "variance")
    assert "variance" in title()


def segments(page):
    """Winners of the first strip, and the cost in seconds where each begins."""
    strip = page.locator(".strip").nth(1)
    width = strip.bounding_box()["width"]
    found = []
    for group in strip.locator("g[data-sampler]").all():
        left = float(group.locator("rect").get_attribute("x"))
        position = -1 + 7 * (left - 1) / (width - 2)
        found.append((group.get_attribute("data-sampler"), 10 ** (position - 9)))
    return found


def test_the_strip_shows_where_the_ranking_flips(page):
    # Samples that each law needs for an error of 0.001, and its seconds for one of 384 pixels.
    needs = {"jittered": 40 ** (2 / 3), "sobol+owen": 40**0.5, "poisson-disk": 10 ** (1 / 1.3)}
    own = {"jittered": 5e-9, "sobol+owen": 2e-8, "poisson-disk": 1e-6}
    found = segments(page)
    alone = [name for name, _ in found if " or " not in name]
    assert alone == ["jittered", "sobol+owen", "poisson-disk"]
    for low, high in pairwise(alone):
        flip = (needs[high] * own[high] - needs[low] * own[low]) / (needs[low] - needs[high])
        # Between the two stands a range that the intervals leave open; it has the flip inside.
        place = [name for name, _ in found].index(f"{low} or {high}")
        assert found[place][1] < flip < found[place + 1][1] < 3.0 * found[place][1]
    sentence = page.locator(".flips .sentence").nth(1).inner_text()
    assert "the fastest is jittered" in sentence
    assert "a sample on jittered or sobol+owen; from" in sentence
    assert sentence.endswith("the intervals do not tell.")


def test_the_target_moves_the_line_and_the_strip(page):
    line = page.locator(".chart").nth(2).locator(".target")
    before = float(line.get_attribute("y1"))
    slide(page, "#target-1", math.log10(2e-4))
    assert float(page.locator(".chart").nth(2).locator(".target").get_attribute("y1")) > before
    # No row of random reaches the target; its next one might, in time.
    names = [name for name, _ in segments(page)]
    assert (names[0], names[-1]) == ("random or jittered", "sobol+owen")
    assert "2.00·10⁻⁴" in page.locator(".flips .sentence").nth(1).inner_text()


def test_what_a_sample_costs_moves_the_time_chart_alone(page):
    counts, times = place(page, 3, 0, 0), place(page, 3, 0, 1)
    slide(page, "#cost", 4)
    assert page.locator("#cost-value").inner_text() == "10 µs"
    assert place(page, 3, 0, 0)[0] == pytest.approx(counts[0], abs=0.6)
    page.mouse.move(*place(page, 3, 0, 1))
    # 4 samples of 384 pixels, each of 1 µs as measured and 10 µs more.
    assert "16.9 ms" in page.locator("#tooltip").inner_text()
    assert times != place(page, 3, 0, 1)
    page.locator(".strip svg").first.click(position={"x": 5, "y": 20})
    assert page.locator("#cost-value").inner_text() != "10 µs"


def colours(page, pane, left, top, width, height):
    """Distinct colours within a rectangle of a canvas, in its own pixels."""
    return (
        page.locator(".view canvas")
        .nth(pane)
        .evaluate(
            """(canvas, [left, top, width, height]) => {
          const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", {willReadFrequently: true});
          copy.drawImage(canvas, 0, 0);
          const {data} = copy.getImageData(left, top, width, height);
          const found = new Set();
          for (let i = 0; i < data.length; i += 4) found.add(data.slice(i, i + 4).join());
          return [...found];
        }""",
            [left, top, width, height],
        )
    )


def test_both_images_zoom_together_to_single_pixels(page):
    shown(page, 1, 4)
    views = page.locator(".view")
    page.locator("[data-zoom-to='32']").click()
    zooms = [views.nth(pane).get_attribute("data-zoom") for pane in (0, 1)]
    assert zooms[0] == zooms[1]
    assert float(zooms[0]) > 1
    transform = page.locator(".view canvas").first.evaluate(
        "canvas => [canvas.__zoom.k, canvas.__zoom.x, canvas.__zoom.y]"
    )
    unit = page.locator(".view canvas").first.evaluate("canvas => canvas.clientWidth") / 24 * transform[0]
    assert unit == pytest.approx(32.0)
    column, row = (math.ceil(-offset / unit) + 2 for offset in transform[1:])
    left, top = transform[1] + column * unit, transform[2] + row * unit
    inside = [math.ceil(left) + 1, math.ceil(top) + 1, 29, 29]
    for pane in (0, 1):
        assert len(colours(page, pane, *inside)) == 1
        assert len(colours(page, pane, inside[0], inside[1], 64, 29)) >= 2


def test_wheel_drag_and_keys_move_both_images(page):
    shown(page, 1, 4)
    views, second = page.locator(".view"), page.locator(".view canvas").nth(1)
    second.scroll_into_view_if_needed()
    box = second.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def transforms():
        return page.locator(".view canvas").evaluate_all("all => all.map((one) => String(one.__zoom))")

    page.mouse.move(x, y)
    page.keyboard.down("Control")
    page.mouse.wheel(0, -400)
    page.keyboard.up("Control")
    page.wait_for_function("document.querySelector('.view').dataset.zoom > 1.2")
    assert views.first.get_attribute("data-zoom") == views.nth(1).get_attribute("data-zoom")
    before = transforms()
    page.mouse.down()
    page.mouse.move(x - 60, y - 20, steps=4)
    page.mouse.up()
    after = transforms()
    assert before != after
    assert after[0] == after[1]
    second.focus()
    page.keyboard.press("ArrowRight")
    assert transforms() != after
    page.keyboard.press("0")
    assert views.first.get_attribute("data-zoom") == "1.000"


def test_the_pixel_under_the_pointer_is_told_in_numbers(page, path, study):
    shown(page, 1, 4)
    canvas = page.locator(".view canvas").first
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    page.mouse.move(box["x"] + 7.5 / 24 * box["width"], box["y"] + 3.5 / 16 * box["height"])
    readout = page.locator(".readout").inner_text()
    assert readout.startswith("Pixel 7, 3: ")
    parts = read_parts(path.parent / "0-0-16.exr").parts
    reference, error = parts["reference"][3, 7], parts["error"][3, 7]
    assert f"reference {wording.number(reference, 5)}" in readout
    stated = float(readout.split("random ")[1].split(" ")[0])
    assert stated == pytest.approx(reference + error, abs=np.sqrt(np.mean(np.square(parts["error"]))) / 64)


def test_the_error_has_false_colours_whose_scale_follows_the_exposure(page):
    shown(page, 1, 4)
    scale = page.locator(".scale")
    assert scale.is_hidden()
    grey = colours(page, 0, 0, 0, 200, 200)
    assert all(len(set(colour.split(",")[:3])) == 1 for colour in grey)
    choose(page, "show", "error")
    page.wait_for_function("!document.querySelector('.scale').hidden")
    tinted = [list(map(int, colour.split(",")[:3])) for colour in colours(page, 0, 0, 0, 200, 200)]
    assert any(red > blue for red, _, blue in tinted)
    assert any(red < blue for red, _, blue in tinted)
    high = float(scale.locator(".high").inner_text())
    slide(page, "#exposure", 1)
    page.wait_for_function("document.getElementById('exposure-value').textContent === '+1 stops'")
    assert float(scale.locator(".high").inner_text()) == pytest.approx(high / 2, rel=0.05)


def test_one_image_is_wiped_over_the_other(page):
    shown(page, 1, 4)
    left = [colours(page, pane, 40, 40, 1, 1) for pane in (0, 1)]
    assert left[0] != left[1]
    choose(page, "layout", "wipe")
    page.wait_for_selector("#compare.wiping")
    assert page.locator(".view").nth(1).is_hidden()
    slide(page, "[name=wipe]", 100)
    everything_of_a = colours(page, 0, 40, 40, 1, 1)
    slide(page, "[name=wipe]", 0)
    assert colours(page, 0, 40, 40, 1, 1) != everything_of_a
    slide(page, "[name=wipe]", 50)
    assert colours(page, 0, 40, 40, 1, 1) == everything_of_a
    box = page.locator(".view canvas").first.bounding_box()
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + 30)
    page.mouse.down()
    page.mouse.move(box["x"] + 10, box["y"] + 30, steps=3)
    page.mouse.up()
    assert float(page.locator("[name=wipe]").input_value()) < 5
    assert colours(page, 0, 40, 40, 1, 1) != everything_of_a


def test_the_other_image_is_of_equal_count_or_equal_time(page):
    shown(page, 1, 4)
    choose(page, "equal", "time")
    shown(page, 1, 3)  # 16 random samples take 32 ns, 4 jittered ones 20
    assert "jittered · 4 samples" in page.locator(".tagline[data-side='1']").last.inner_text()
    slide(page, "#cost", 3)
    shown(page, 1, 4)
    page.locator("#pictured-scene").select_option("1")
    shown(page, 13, 16)
    page.locator("#b").select_option("poisson-disk")
    shown(page, 13, 22)


def test_the_table_is_sorted_and_narrowed(page):
    def column(number):
        return page.locator(f"#rows tbody tr:not([hidden]) td:nth-child({number})").all_inner_texts()

    header = page.locator("#rows th", has_text="Samples")
    header.locator("button").click()
    assert header.get_attribute("aria-sort") == "ascending"
    assert [text.split()[0] for text in column(3)] == ["4"] * 8 + ["16"] * 8 + ["64"] * 8
    header.locator("button").click()
    assert header.get_attribute("aria-sort") == "descending"
    assert [text.split()[0] for text in column(3)][:8] == ["64"] * 8
    page.locator("#search").fill("gaussian owen")
    assert column(2) == ["sobol+owen"] * 3


def test_numbers_read_alike_in_tables_and_charts(page):
    values = [0.0, 1.0, -0.25, 0.00123456, 1.23e-4, 12345.6, 99999.0, 5e-324, -1.7e308, 123.456]
    assert page.evaluate("values => values.map((value) => formatNumber(value))", values) == list(
        map(wording.number, values)
    )
    times = [0.0, 2.5, 0.99999, 1.5e-3, 4.2e-8, 3e-11]
    assert page.evaluate("values => values.map((value) => formatSeconds(value))", times) == list(
        map(wording.seconds, times)
    )


def test_light_and_dark(browser, path):
    opened = Opened(browser, path, color_scheme="dark")
    background = "getComputedStyle(document.body).backgroundColor"
    dark = opened.page.evaluate(background)
    opened.page.locator("#theme").click()
    assert opened.page.evaluate(background) == "rgb(255, 255, 255)"
    assert dark != "rgb(255, 255, 255)"
    opened.close()


def test_on_a_phone_there_is_one_column_and_a_touch_reads_a_point(browser, path):
    opened = Opened(browser, path, viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True)
    page = opened.page
    shown(page, 1, 4)
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    first, second = (page.locator(".chart").nth(number).bounding_box() for number in (0, 1))
    assert second["y"] > first["y"] + first["height"]
    page.touchscreen.tap(*place(page, 2, 1))
    assert page.locator("#tooltip strong").inner_text() == "sobol+owen"
    box = page.locator("#tooltip").bounding_box()
    assert box["x"] >= 0
    assert box["x"] + box["width"] <= 390
    opened.close()


def test_on_paper_there_are_charts_and_tables_and_no_controls(browser, path):
    opened = Opened(browser, path, color_scheme="dark")
    page = opened.page
    page.emulate_media(media="print")
    for part in ("nav", "#cost", "#search", "#exposure"):
        assert page.locator(part).is_hidden(), part
    for part in (".chart svg", "#rows", "#fits", ".view canvas"):
        assert page.locator(part).first.is_visible(), part
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
    assert page.pdf(format="A4").startswith(b"%PDF")
    opened.close()


def test_without_scripts_there_are_answers_and_tables(browser, path):
    opened = Opened(browser, path, java_script_enabled=False)
    assert opened.page.locator("#rows").is_visible()
    assert opened.page.locator("#fits").is_visible()
    assert "Without JavaScript" in opened.page.locator("noscript").first.inner_text()
    assert opened.page.locator("#charts").is_hidden()
    opened.close()


@pytest.mark.parametrize("size", [(1, 1), (4, 4)])
def test_hostile_names_are_names(browser, study, tmp_path, size):
    folder = tmp_path if size == (4, 4) else None
    names = ("<b onclick='window.intruder=1'>\"x\"</b>", "__proto__")
    results = study(scenes=(HOSTILE, "constructor"), samplers=names, size=size, folder=folder)
    opened = Opened(browser, write_report(replace(results, notes=[HOSTILE], command=HOSTILE), tmp_path))
    page = opened.page
    assert page.locator("#legend button").all_inner_texts() == list(names)
    assert page.locator(".scene h3").first.inner_text() == HOSTILE
    page.mouse.move(*place(page, 0, 1))
    assert page.locator("#tooltip strong").inner_text() == names[0]
    if folder:
        shown(page, 1, 4)
        assert page.locator("#a option").first.inner_text() == names[0]
    assert page.evaluate("window.intruder") is None
    assert page.locator("img, b").count() == 0
    opened.close()


def test_samplers_that_repeat_colours_differ_in_marker_or_dash(browser, study, tmp_path):
    results = study(scenes=("disk",), samplers=[f"sampler-{number:02d}" for number in range(18)])
    opened = Opened(browser, write_report(results, tmp_path))
    assert series(opened.page) == 18
    looks = opened.page.evaluate(
        "STUDY.samplers.map((_, i) => [seriesColour(i), seriesMarker(i), seriesDash(i)].join())"
    )
    assert len(set(looks)) == 18
    opened.close()
