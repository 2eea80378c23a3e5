import base64
import hashlib
import json
import re
from dataclasses import replace
from html.parser import HTMLParser
from importlib.resources import files
from pathlib import Path

import pytest

from samplekit._errors import SamplekitError
from samplekit._report.page import page
from samplekit._report.pixels import BUDGET

ASSETS = files("samplekit._report") / "assets"
HOSTILE = "disk:note=\"'><script>alert(1)</script><img src=x onerror=alert(2)>&amp;"


class Elements(HTMLParser):
    """All elements with their attributes, and the text of each script and style."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.elements = []
        self.texts = []
        self.open = None
        self.shown = ""
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))
        self.open = len(self.elements) - 1 if tag in ("script", "style") else None

    def handle_endtag(self, tag):
        self.open = None

    def handle_data(self, data):
        if self.open is None:
            self.shown += data
        else:
            self.texts.append((*self.elements[self.open], data))

    def data(self):
        (text,) = (text for _, attributes, text in self.texts if attributes.get("id") == "data")
        return json.loads(text)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("study")


@pytest.fixture
def parsed(study, folder):
    return Elements(page(study(size=(8, 6), folder=folder), folder))


def test_nothing_is_fetched_and_nothing_but_the_page_s_own_texts_may_run(parsed):
    for tag, attributes in parsed.elements:
        assert not {"src", "srcset", "style", "action"} & set(attributes), (tag, attributes)
        assert not [name for name in attributes if name.startswith("on")], (tag, attributes)
        assert tag not in ("link", "iframe", "object", "embed", "img", "base")
        if "href" in attributes:
            assert attributes["href"].startswith("#") or attributes["href"] in ("results.json", "results.csv")
    (policy,) = (a["content"] for tag, a in parsed.elements if a.get("http-equiv") == "Content-Security-Policy")
    rules = dict(rule.split(" ", 1) for rule in policy.split("; "))
    assert rules["default-src"] == "'none'"
    for tag, name in (("script", "script-src"), ("style", "style-src")):
        texts = [text for kind, attributes, text in parsed.texts if kind == tag and "type" not in attributes]
        hashes = {f"'sha256-{base64.b64encode(hashlib.sha256(t.encode()).digest()).decode()}'" for t in texts}
        assert texts
        assert set(rules[name].split()) == hashes


def test_the_results_are_in_the_page_as_they_are(study, folder):
    results = study(size=(8, 6), folder=folder)
    data = Elements(page(results, folder)).data()
    assert data["study"]["seed"] == str(2**64 - 1)
    assert [row["mse"]["estimate"] for row in data["study"]["rows"]] == [row.mse.estimate for row in results.rows]
    assert len(data["error_colours"]) == 6 * 511


def test_the_tables_are_there_without_any_script(study, folder):
    results = study(size=(8, 6), folder=folder)
    row = replace(
        results.rows[0], replaced="only squares", asked=[5, 6], fitted=False, left_out="exact zero", invalid_pixels=2
    )
    shown = Elements(page(replace(results, rows=[row, *results.rows[1:]]), folder)).shown
    for text in ("for 5, 6: only squares", "not in the fit: exact zero", "2 invalid pixels", "0.0100", "theory −1"):
        assert text in shown
    for text in (results.command, "a processor", "a note on the method", "it has 1 dimension, not 2"):
        assert text in shown
    assert "Without JavaScript" in shown


def test_names_and_options_are_texts_whatever_is_in_them(study, folder):
    results = study(scenes=(HOSTILE,), samplers=("</style><b>bold</b>", 'a"b'), size=(4, 4), folder=folder)
    hostile = replace(results, command=HOSTILE, notes=[HOSTILE], sentences=[f"{HOSTILE}: {HOSTILE}"], plots=[HOSTILE])
    before = Elements(page(study(scenes=("s",), samplers=("a", "b"), size=(4, 4), folder=folder), folder))
    after = Elements(page(hostile, folder))
    extra = {tag for tag, _ in after.elements} - {tag for tag, _ in before.elements}
    assert extra <= {"noscript"}
    kinds = [tag for tag, _ in after.elements].count
    assert kinds("script") == [tag for tag, _ in before.elements].count("script")
    assert HOSTILE in after.shown
    assert after.data()["study"]["scenes"] == [HOSTILE]


def test_files_beside_the_page_are_linked_as_files(study, folder):
    parsed = Elements(page(replace(study(), plots=["javascript:alert(1).svg"]), folder))
    links = [a["href"] for _, a in parsed.elements if "href" in a and not a["href"].startswith("#")]
    assert links == ["results.json", "results.csv", "javascript%3Aalert%281%29.svg"]


def test_an_interrupted_study_says_so(study, folder):
    assert "was interrupted" in page(replace(study(), complete=False), folder)
    assert "was interrupted" not in page(study(), folder)


@pytest.mark.parametrize("timed", [True, False])
def test_without_images_or_times_their_parts_are_left_out(study, folder, timed):
    parsed = Elements(page(study(timed=timed), folder))
    identifiers = {attributes.get("id") for _, attributes in parsed.elements}
    assert "compare" not in identifiers
    assert ("cost" in identifiers) == timed
    assert ("No times were taken" in parsed.shown) == (not timed)


def test_a_study_without_rows_makes_a_page(study, folder):
    empty = replace(study(), rows=[], fits=[], front=[], sentences=[], target={})
    assert Elements(page(empty, folder)).data()["study"]["rows"] == []


def test_a_missing_image_is_an_error_that_names_it(study, tmp_path):
    results = study(size=(4, 4), folder=tmp_path)
    gone = tmp_path / results.rows[0].pictures.exr
    gone.unlink()
    with pytest.raises(SamplekitError, match=re.escape(gone.name)):
        page(results, tmp_path)


def test_the_same_study_makes_the_same_bytes(study, folder):
    results = study(size=(8, 6), folder=folder)
    assert page(results, folder) == page(results, folder)


def test_scripts_could_not_end_the_element_they_lie_in():
    for text in [(ASSETS / "vendor" / "d3.min.js").read_text(), *map(Path.read_text, (ASSETS / "scripts").iterdir())]:
        assert "</script" not in text.lower()
        assert "<!--" not in text


def test_the_licence_of_the_charts_library_is_in_the_page(parsed):
    assert "Permission to use, copy, modify, and/or distribute this software" in parsed.shown


def test_a_large_study_leaves_its_images_the_room_that_they_may_take(study, folder):
    results = study(
        scenes=("disk", "gaussian", "zoneplate"),
        samplers=[f"sampler-{number}" for number in range(8)],
        counts=[4**power for power in range(7)],
    )
    assert len(results.rows) == 8 * 3 * 7
    assert len(page(results, folder).encode()) + BUDGET < 20_000_000
