"""``samplekit list``: tables on a pipe, one JSON object, and plugins as they are."""

import pytest

from samplekit._registry import BUILTIN, Registry

KINDS = ("samplers", "scenes", "randomizers", "plugins")


def rows(text):
    header, *lines = [line.split("\t") for line in text.splitlines()]
    assert {len(line) for line in lines} == {len(header)}
    return [dict(zip(header, line, strict=True)) for line in lines]


def test_everything_is_listed_in_tables_of_tabs(command):
    done = command("list")
    assert (done.status, done.err) == (0, "")
    headers = [line.split("\t")[0] for line in done.out.splitlines()]
    for kind in KINDS:
        assert kind.removesuffix("s") in headers
    assert "\x1b" not in done.out


@pytest.mark.parametrize("kind", ["samplers", "scenes", "randomizers"])
def test_a_kind_is_listed_sorted_and_whole(command, kind):
    done = command("list", kind)
    assert (done.status, done.err) == (0, "")
    listed = [row[kind.removesuffix("s")] for row in rows(done.out)]
    assert listed == sorted(listed)
    assert set(Registry().plugins[0].offers[kind.removesuffix("s")]) <= set(listed)


def test_what_a_sampler_declares_is_in_its_row(command):
    by_name = {row["sampler"]: row for row in rows(command("list", "samplers").out)}
    assert by_name["halton"]["dimensions"] == "1 to 1024"
    assert by_name["n-rooks"]["dimensions"] == "2"
    assert by_name["random"]["dimensions"] == "1 and more"
    assert by_name["random"]["random"] == "yes"
    assert by_name["hammersley"]["random"] == "no"
    assert by_name["sobol"]["progressive"] == "powers of 2"
    assert "grid" in by_name["jittered"]["promises"]
    assert all(row["what it is"] for row in by_name.values())


def test_options_of_scenes_have_their_defaults(command):
    by_name = {row["scene"]: row for row in rows(command("list", "scenes").out)}
    assert "radius=0.3" in by_name["disk"]["options"]


def test_json_is_one_object(command):
    report = command("list", "--json").report
    assert report["schema"] == "samplekit.list/1"
    assert set(report) == {"schema", *KINDS}
    samplers = {record["name"]: record for record in report["samplers"]}
    assert samplers["sobol"]["plugin"] == BUILTIN
    assert samplers["sobol"]["dimensions"] == [1, 4096]
    assert samplers["sobol"]["promises"][0]["promise"] == "net"
    # JSON readers round integers beyond 2^53.
    assert samplers["random"]["largest_index"] == str(2**63 - 1)
    scenes = {record["name"]: record for record in report["scenes"]}
    assert {option["name"]: option["default"] for option in scenes["disk"]["options"]}["radius"] == 0.3
    assert report["plugins"][0]["name"] == BUILTIN


@pytest.mark.parametrize("kind", KINDS)
def test_json_of_one_kind_has_that_kind_alone(command, kind):
    assert set(command("list", kind, "--json").report) == {"schema", kind}


@pytest.mark.parametrize("kind", ["sampler", "Samplers", "commands", "x"])
def test_another_kind_is_refused(command, kind):
    done = command("list", kind)
    assert (done.status, done.out) == (2, "")
    assert done.error == f"list {kind}: expected samplers, scenes, randomizers or plugins"


def test_plugins_are_listed_with_what_became_of_them(command, plugins, monkeypatch):
    plugins.offer(
        "good", "sampler", 'SamplerSpec("toy", "no_such_module:X", "a toy")', distribution="Good", version="1.5"
    )
    plugins.add("broken", "raise ValueError('two\\nlines')")
    plugins.add("sleeping", "raise RuntimeError('imported')")
    monkeypatch.setenv("SAMPLEKIT_BLOCK", "sleeping")
    done = command("list", "plugins")
    assert (done.status, done.err) == (0, "")
    by_name = {row["plugin"]: row for row in rows(done.out)}
    assert by_name["good"] == {
        "plugin": "good",
        "distribution": "Good",
        "version": "1.5",
        "status": "samplers: toy",
    }
    assert by_name["broken"]["status"] == "problem: cannot be imported: ValueError: two lines"
    assert by_name["sleeping"]["status"] == "switched off"
    report = {record["name"]: record for record in command("list", "plugins", "--json").report["plugins"]}
    assert report["good"]["offers"] == {"sampler": ["toy"]}
    assert report["broken"]["problems"] == ["cannot be imported: ValueError: two lines"]
    assert report["sleeping"]["blocked"] is True
    assert "toy" in {row["sampler"] for row in rows(command("list", "samplers").out)}


def test_names_offered_twice_are_listed_as_they_are_chosen(command, plugins):
    for name in ("blocks", "cars"):
        plugins.offer(name, "scene", 'SceneSpec("toy", "no_such_module:X", "a toy")')
    listed = {row["scene"] for row in rows(command("list", "scenes").out)}
    assert {"blocks/toy", "cars/toy"} <= listed
    assert {record["name"] for record in command("list", "scenes", "--json").report["scenes"]} == listed


def test_a_process_lists_without_assertions_and_docstrings(process):
    done = process("list", "--json", environment={"PYTHONOPTIMIZE": "2", "PYTHONWARNINGS": "error"})
    assert (done.status, done.err) == (0, "")
    assert "hammersley" in {record["name"] for record in done.report["samplers"]}
