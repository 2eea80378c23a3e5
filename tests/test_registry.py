"""Plugins that fail, lie or quarrel: each is reported in one line, and harms nobody else."""

import re

import pytest

import samplekit
from samplekit._errors import SamplekitError, UsageError
from samplekit._registry import BUILTIN, Registry, registry

TOY = 'SamplerSpec("toy", "toy_points:Toy", "a toy")'
OFFERS_TOY = f"@hookimpl\ndef samplekit_samplers():\n    return [{TOY}]\n"
POINTS = """
from samplekit import Sampler

class Toy(Sampler):
    def draw(self, count, dims, rng):
        return rng.random((count, dims))
"""


def plugin(found, name):
    (only,) = [plugin for plugin in found.plugins if plugin.name == name]
    return only


def discovered():
    found = Registry()
    found.discover()
    return found


def the_problem(name):
    """The only problem of a plugin, found by a registry in which everything else is well."""
    found = discovered()
    (problem,) = plugin(found, name).problems
    assert "\n" not in problem
    assert len(problem) < 300
    assert found.find("sampler", "halton").plugin.name == BUILTIN
    return problem


def failure(kind, name):
    with pytest.raises(UsageError) as error:
        Registry().find(kind, name)
    message = str(error.value)
    assert "\n" not in message
    return message


# --- what comes with samplekit ---------------------------------------------------------------------------------------


def test_our_own_are_there_without_a_look_at_plugins(plugins):
    plugins.add("curious", "raise RuntimeError('imported')")
    found = Registry()
    for kind, name in (("sampler", "hammersley"), ("scene", "disk"), ("randomizer", "owen")):
        offer = found.find(kind, name)
        assert offer.spec.name == name
        assert offer.plugin.name == BUILTIN
        assert found.find(kind, f"{BUILTIN}/{name}") is offer
    assert [plugin.name for plugin in found.plugins] == [BUILTIN]
    assert found.plugins[0].version == samplekit.__version__


def test_our_own_declare_without_a_problem():
    assert Registry().plugins[0].problems == []


def test_every_one_of_our_own_can_be_loaded():
    found = Registry()
    for kind in ("sampler", "randomizer", "scene"):
        for name in found.plugins[0].offers[kind]:
            assert isinstance(found.find(kind, name).spec.load(), type)


# --- plugins that work -----------------------------------------------------------------------------------------------


def test_a_plugin_offers_by_the_same_hooks(plugins):
    plugins.add(
        "toys",
        f"""
        @hookimpl
        def samplekit_samplers():
            return [{TOY}]

        @hookimpl
        def samplekit_scenes():
            return (SceneSpec("toy", "toy_scene:Toy", "a toy") for _ in range(1))

        @hookimpl
        def samplekit_randomizers():
            return [RandomizerSpec("toy", "toy_randomizer:Toy", "a toy")]

        @hookimpl
        def samplekit_commands():
            return (CommandSpec("toy", "toy_command:toy", "a toy"),)
        """,
        distribution="Toy-Box",
        version="2.5",
    )
    found = discovered()
    toys = plugin(found, "toys")
    assert toys.problems == []
    assert toys.offers == {kind: ["toy"] for kind in ("sampler", "scene", "randomizer", "command")}
    assert str(toys) == "toys (Toy-Box 2.5)"
    for kind in toys.offers:
        assert found.find(kind, "toy").plugin is toys
        assert found.find(kind, "toys/toy").plugin is toys
        assert found.all(kind)["toy"].plugin is toys


def test_a_plugin_is_imported_when_a_name_is_not_ours_and_once(plugins):
    plugins.add(
        "toys", f"import builtins\nbuiltins.toys_imported = getattr(builtins, 'toys_imported', 0) + 1\n{'#' * 9}"
    )
    import builtins

    try:
        found = Registry()
        found.find("sampler", "sobol")
        assert not hasattr(builtins, "toys_imported")
        for _ in range(2):
            with pytest.raises(UsageError):
                found.find("sampler", "nothing-like-it")
        assert builtins.toys_imported == 1
    finally:
        if hasattr(builtins, "toys_imported"):
            del builtins.toys_imported


def test_a_plugin_may_be_an_object_of_its_module(plugins):
    plugins.add(
        "toys",
        f"""
        class Box:
            @hookimpl
            def samplekit_samplers(self):
                return [{TOY}]

        box = Box()
        """,
        entries=["box = toys:box"],
    )
    assert discovered().find("sampler", "toy").plugin.name == "box"


def test_everything_is_sorted_by_name(plugins):
    plugins.offer("toys", "sampler", TOY, 'SamplerSpec("aaa", "a:A", "")', 'SamplerSpec("zzz", "a:A", "")')
    names = list(discovered().all("sampler"))
    assert names == sorted(names)
    assert {"aaa", "toy", "zzz", "halton"} <= set(names)


def test_the_registry_of_the_process_is_one():
    assert registry() is registry()


def test_a_plugin_name_chooses_among_our_names_no_other(plugins):
    plugins.offer("toys", "sampler", TOY)
    assert "unknown sampler 'toys/halton': did you mean halton" in failure("sampler", "toys/halton")
    assert "unknown sampler 'samplekit/toy'" in failure("sampler", "samplekit/toy")
    assert "unknown sampler 'nobody/toy'" in failure("sampler", "nobody/toy")


# --- plugins that fail -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("code", "reason"),
    [
        ("import no_such_module_anywhere", "ModuleNotFoundError: No module named 'no_such_module_anywhere'"),
        ("raise SystemExit(3)", "SystemExit: 3"),
        ("1 / 0", "ZeroDivisionError"),
        ("def broken(:", "SyntaxError"),
        ("raise ValueError('two\\nlines')", "ValueError: two lines"),
        ("raise ValueError('long ' * 10000)", "ValueError: long long"),
        ("def again(): again()\nagain()", "RecursionError"),
        ("raise MemoryError", "MemoryError"),
        ("SamplerSpec('Bad Name', 'a:b', '')", "ValueError: Bad Name: name must be of the form"),
    ],
)
def test_one_that_cannot_be_imported_says_why(plugins, code, reason):
    plugins.add("toys", code)
    assert the_problem("toys").startswith(f"cannot be imported: {reason}")
    assert "plugins with problems: toys (toys-distribution 1.0): cannot be imported" in failure("sampler", "toy")


@pytest.mark.parametrize("entry", ["toys = toys:nothing", "toys = toys:a.b", "toys = not a reference!", "toys = toys:"])
def test_an_entry_point_that_names_nothing_is_a_problem(plugins, entry):
    plugins.add("toys", "", entries=[entry])
    (problem,) = [problem for one in discovered().plugins if one.name == "toys" for problem in one.problems]
    assert "\n" not in problem


@pytest.mark.parametrize(
    ("body", "reason"),
    [
        ("raise ValueError('two\\nlines')", "failed: ValueError: two lines"),
        ("return None", "failed: TypeError"),
        ("return 5", "failed: TypeError"),
        ("return 'a'", "gave 'a', not a SamplerSpec"),
        ("return [None]", "gave None, not a SamplerSpec"),
        ("return [SamplerSpec]", "gave <class"),
        ("return [SceneSpec('toy', 'a:b', '')]", "gave SceneSpec(name='toy'"),
        ("return [SamplerSpec('Toy', 'a:b', '')]", "failed: ValueError: Toy: name must be of the form [a-z]"),
        ("return [SamplerSpec('toy', 'a', '')]", "failed: ValueError: toy: target must be of the form"),
        ("return [SamplerSpec('toy')]", "failed: TypeError"),
        (
            "return [SamplerSpec('toy', 'a:b', '', counts='few')]",
            "failed: ValueError: toy: counts must be an object such as AnyCount() or PowersOf(2), not 'few'",
        ),
        ("return [SamplerSpec('toy', 'a:b', '', speed=3)]", "failed: TypeError"),
        ("return [SamplerSpec('toy', 'a:b', '', api_version='x')]", "failed: "),
        (
            "return [SamplerSpec('toy', 'a:b', '', api_version=99)]",
            "failed: ValueError: toy: made for plugin interface 99",
        ),
        ("yield SceneSpec('toy', 'a:b', '')\n    raise ValueError('later')", "failed: ValueError: later"),
    ],
)
def test_one_that_declares_nonsense_says_what(plugins, body, reason):
    plugins.add("toys", f"@hookimpl\ndef samplekit_samplers():\n    {body}\n")
    assert the_problem("toys").startswith(f"samplekit_samplers {reason}")


@pytest.mark.parametrize(
    ("hook", "reason"),
    [
        ("samplekit_samplers(count)", "cannot be registered: PluginValidationError"),
        (
            "samplekit_sampler()",
            "unknown hook samplekit_sampler: the hooks are samplekit_commands, samplekit_options",
        ),
        ("samplekit_init()", "unknown hook samplekit_init"),
    ],
)
def test_a_hook_that_is_none_is_named_with_those_there_are(plugins, hook, reason):
    plugins.add("toys", f"@hookimpl\ndef {hook}:\n    return []\n")
    assert the_problem("toys").startswith(reason)


def test_a_plugin_without_hooks_offers_nothing(plugins):
    plugins.add("toys", f"def samplekit_samplers():\n    return [{TOY}]\n")
    assert "no function is marked with samplekit.hookimpl" in the_problem("toys")


def test_one_bad_declaration_leaves_the_others(plugins):
    plugins.offer("toys", "sampler", TOY, "None", 'SamplerSpec("toy2", "toy_points:Toy", "")')
    found = discovered()
    assert plugin(found, "toys").offers == {"sampler": ["toy", "toy2"]}
    assert len(plugin(found, "toys").problems) == 1


def test_one_bad_hook_leaves_the_others(plugins):
    plugins.add(
        "toys",
        f"""
        @hookimpl
        def samplekit_scenes():
            raise ValueError("no scenes today")

        @hookimpl
        def samplekit_samplers():
            return [{TOY}]

        @hookimpl
        def samplekit_lamps():
            return []
        """,
    )
    found = discovered()
    assert plugin(found, "toys").offers == {"sampler": ["toy"]}
    assert len(plugin(found, "toys").problems) == 2


def test_a_plugin_that_fails_leaves_the_other_plugins(plugins):
    plugins.add("aaa-fails", "", entries=["aaa = nowhere"])
    plugins.offer("toys", "sampler", TOY)
    plugins.add("zzz_fails", "raise SystemExit")
    assert discovered().find("sampler", "toy").plugin.name == "toys"


# --- names that are taken --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("kind", "spec"),
    [
        ("sampler", 'SamplerSpec("halton", "toy_points:Toy", "mine")'),
        ("scene", 'SceneSpec("disk", "toy_points:Toy", "mine")'),
        ("randomizer", 'RandomizerSpec("owen", "toy_points:Toy", "mine")'),
    ],
)
def test_nobody_takes_a_name_of_ours(plugins, kind, spec):
    plugins.offer("toys", kind, spec)
    assert "the name belongs to samplekit's own" in the_problem("toys")
    found = discovered()
    name = re.search('"(.*?)"', spec)[1]
    assert found.find(kind, name).plugin.name == BUILTIN
    with pytest.raises(UsageError):
        found.find(kind, f"toys/{name}")


def test_two_plugins_with_one_name_are_both_named_and_one_is_chosen(plugins):
    plugins.offer("blocks", "sampler", TOY, distribution="Blocks", version="1.2")
    plugins.offer("cars", "sampler", TOY, distribution="Cars", version="3.4")
    message = failure("sampler", "toy")
    assert "blocks (Blocks 1.2) and cars (Cars 3.4)" in message
    assert "write blocks/toy or cars/toy" in message
    found = discovered()
    assert found.find("sampler", "blocks/toy").plugin.name == "blocks"
    assert found.find("sampler", "cars/toy").plugin.name == "cars"
    assert {"blocks/toy", "cars/toy"} <= set(found.all("sampler"))
    assert "toy" not in found.all("sampler")
    assert plugin(found, "blocks").problems == plugin(found, "cars").problems == []


def test_a_name_may_be_of_several_kinds(plugins):
    plugins.offer("blocks", "sampler", 'SamplerSpec("disk", "a:A", "")')
    plugins.offer("cars", "randomizer", 'RandomizerSpec("disk", "a:A", "")')
    found = discovered()
    assert {found.find(kind, "disk").plugin.name for kind in ("sampler", "scene", "randomizer")} == {
        "blocks",
        "cars",
        BUILTIN,
    }


def test_a_name_declared_twice_by_one_plugin_is_a_problem(plugins):
    plugins.offer("toys", "sampler", TOY, TOY)
    assert the_problem("toys") == "sampler 'toy' is declared twice"
    assert discovered().find("sampler", "toy").plugin.name == "toys"


def test_of_two_plugins_of_one_name_the_second_is_reported(plugins):
    plugins.offer("blocks", "sampler", TOY, entries=["same = blocks"], distribution="aaa")
    plugins.offer("cars", "sampler", 'SamplerSpec("car", "a:A", "")', entries=["same = cars"], distribution="bbb")
    found = discovered()
    first, second = [plugin for plugin in found.plugins if plugin.name == "same"]
    assert (first.distribution, first.problems) == ("aaa", [])
    assert second.distribution == "bbb"
    assert second.problems == ["another plugin has the name 'same' already"]
    assert found.find("sampler", "toy").plugin is first
    assert "same (bbb 1.0): another plugin has the name" in failure("sampler", "car")


def test_no_plugin_is_called_as_we_are(plugins):
    plugins.offer("toys", "sampler", TOY, entries=[f"{BUILTIN} = toys"])
    _, imposter = [plugin for plugin in discovered().plugins if plugin.name == BUILTIN]
    assert "another plugin has the name" in imposter.problems[0]


def test_one_module_behind_two_entry_points_is_offered_once(plugins):
    plugins.offer("toys", "sampler", TOY, entries=["one = toys", "two = toys"])
    found = discovered()
    assert found.find("sampler", "toy").plugin.name == "one"
    assert "\n" not in "".join(plugin(found, "two").problems)
    assert plugin(found, "two").problems


# --- switched off ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("variable", "value"),
    [
        ("SAMPLEKIT_BLOCK", "toys"),
        ("SAMPLEKIT_BLOCK", "other, toys ,"),
        ("SAMPLEKIT_PLUGINS", ""),
        ("SAMPLEKIT_PLUGINS", "other"),
    ],
)
def test_a_plugin_that_is_switched_off_is_not_even_imported(plugins, monkeypatch, tmp_path, variable, value):
    trace = tmp_path / "imported"
    plugins.add(
        "toys", f"open({str(trace)!r}, 'w').close()\n@hookimpl\ndef samplekit_samplers():\n    return [{TOY}]\n"
    )
    monkeypatch.setenv(variable, value)
    assert plugin(discovered(), "toys").blocked
    message = failure("sampler", "toy")
    assert "switched off by SAMPLEKIT_PLUGINS or SAMPLEKIT_BLOCK" in message
    assert "toys" in message
    assert not trace.exists()
    monkeypatch.delenv(variable)
    discovered().find("sampler", "toy")
    assert trace.exists()


def test_a_plugin_that_is_allowed_is_loaded_and_no_other(plugins, monkeypatch):
    plugins.offer("blocks", "sampler", TOY)
    plugins.offer("cars", "sampler", TOY)
    monkeypatch.setenv("SAMPLEKIT_PLUGINS", "cars, no-such-plugin")
    found = discovered()
    assert found.find("sampler", "toy").plugin.name == "cars"
    assert all(plugin.blocked for plugin in found.plugins if plugin.name not in (BUILTIN, "cars"))
    monkeypatch.setenv("SAMPLEKIT_BLOCK", "cars")
    assert "unknown sampler 'toy'" in failure("sampler", "toy")


def test_ours_cannot_be_switched_off(monkeypatch):
    monkeypatch.setenv("SAMPLEKIT_BLOCK", BUILTIN)
    monkeypatch.setenv("SAMPLEKIT_PLUGINS", "")
    assert Registry().find("scene", "disk").plugin.name == BUILTIN


# --- wrong names -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("kind", "name", "meant"),
    [
        ("sampler", "hammersly", "hammersley"),
        ("sampler", "Halton", "halton"),
        ("sampler", "toi", "toy"),
        ("scene", "zone-plate", "zoneplate"),
        ("scene", "gausian", "gaussian"),
        ("randomizer", "owens", "owen"),
    ],
)
def test_a_wrong_name_gets_the_nearest(plugins, kind, name, meant):
    plugins.offer("toys", "sampler", TOY)
    message = failure(kind, name)
    assert message.startswith(f"unknown {kind} {name!r}: did you mean ")
    assert meant in message


def test_a_name_like_no_other_gets_all(plugins):
    plugins.offer("toys", "sampler", TOY)
    message = failure("sampler", "xqxqxq")
    assert "there are " in message
    assert "halton" in message
    assert "toy" in message


# --- used ------------------------------------------------------------------------------------------------------------


def test_points_of_a_plugin_drawn_or_filled(plugins):
    plugins.offer("toys", "sampler", TOY, 'SamplerSpec("half", "toy_points:Half", "")')
    plugins.module("toy_points", POINTS + "class Half(Sampler):\n    def fill(self, out, *_):\n        out[:] = 0.5\n")
    assert (samplekit.points("half", 3, 4, realizations=2) == 0.5).all()
    drawn = samplekit.points("toy", 100, 3, realizations=2)
    assert drawn.shape == (2, 100, 3)
    assert (drawn == samplekit.points("toys/toy", 100, 3, realizations=2)).all()
    assert (drawn[0] != drawn[1]).all()
    assert (drawn != samplekit.points("toy", 100, 3, realizations=2, seed=1)).all()
    assert "toy" in [spec.name for spec in samplekit.samplers()]
    assert "toys" in [plugin.name for plugin in samplekit.plugins()]


@pytest.mark.parametrize(
    ("body", "reason"),
    [
        ("def fill(self, out, *_): raise ValueError('two\\nlines')", "failed: ValueError: two lines"),
        ("def fill(self, out, *_): out[:] = 1.0", r"gave .*1\.0.*: expected values in \[0, 1\)"),
        ("def fill(self, out, *_): out[:] = 0; out[-1, -1, -1] = 1.0", r"gave .*1\.0"),
        ("def fill(self, out, *_): out[:] = 0; out[0, 1, 2] = -5e-324", "gave .*-5e-324"),
        ("def fill(self, out, *_): out[:] = float('nan')", "gave NaN or values it did not write"),
        ("def fill(self, out, *_): out[:] = float('inf')", "gave .*inf"),
        ("def fill(self, out, *_): out[:, :, :-1] = 0.5", "gave NaN or values it did not write"),
        ("def fill(self, out, *_): pass", "gave NaN or values it did not write"),
        ("def fill(self, out): pass", "failed: TypeError"),
        ("def draw(self, count, dims, rng): return rng.random((dims, count + 1))", "shape"),
        ("def draw(self, count, dims, rng): return rng.random(count)", "shape"),
        ("def draw(self, count, dims, rng): return None", "shape"),
        ("def draw(self, count, dims, rng): return [['a'] * dims] * count", "failed: ValueError"),
        ("def draw(self, count, dims, rng): return rng.random((count, dims)) + 1.0", r"expected values in \[0, 1\)"),
        ("def prepare(self, *_): raise OSError('nothing there')", "failed: OSError: nothing there"),
        ("def check(self, *_): raise KeyError('x')", "failed: KeyError"),
        ("def __init__(self, k): pass", "cannot be set up: TypeError"),
        ("def __init__(self): raise RuntimeError('not today')", "cannot be set up: RuntimeError: not today"),
        ("pass", "failed: NotImplementedError: Toy defines neither fill nor draw"),
    ],
)
def test_a_sampler_that_breaks_its_promise_is_named(plugins, body, reason):
    plugins.offer("toys", "sampler", TOY)
    plugins.module("toy_points", f"from samplekit import Sampler\nclass Toy(Sampler):\n    {body}\n")
    with pytest.raises(SamplekitError, match=reason) as error:
        samplekit.points("toy", 8, 2, realizations=3)
    message = str(error.value)
    assert "plugin toys (toys-distribution 1.0)" in message
    assert "\n" not in message


def test_a_sampler_may_refuse_a_request_itself(plugins):
    plugins.offer("toys", "sampler", TOY)
    plugins.module(
        "toy_points",
        POINTS.replace("class Toy", "from samplekit import UsageError\nclass Toy")
        + "    def check(self, count, dims, blocks):\n        raise UsageError('toy: not so many')\n",
    )
    with pytest.raises(UsageError, match=r"^toy: not so many$"):
        samplekit.points("toy", 8)


def test_the_declaration_is_held_against_the_request(plugins):
    plugins.offer(
        "toys",
        "sampler",
        'SamplerSpec("toy", "toy_points:Toy", "", dimensions=(2, 3), counts=PowersOf(3), largest_index=80)',
    )
    plugins.module("toy_points", POINTS)
    assert samplekit.points("toy", 81, 3).shape == (1, 81, 3)
    for count, dims, message in [
        (9, 1, "2 to 3 dimensions, not 1"),
        (9, 4, "2 to 3 dimensions, not 4"),
        (10, 2, "powers of 3, not 10: the nearest are 9 and 27"),
        (243, 2, "at most 81 points, not 243"),
    ]:
        with pytest.raises(UsageError, match=message):
            samplekit.points("toy", count, dims)


@pytest.mark.parametrize(
    ("body", "reason"),
    [
        ("def refine(self, spec): return None", "cannot refine its declaration: expected a SamplerSpec, got None"),
        ("def refine(self, spec): raise ValueError('r')", "cannot refine its declaration: ValueError: r"),
        ("def notes(self, *_): raise ValueError('r')", "cannot tell its notes: ValueError: r"),
        ("def notes(self, *_): return [object()]", "cannot tell its notes: expected texts, got"),
        ("streams = property(lambda self: 1 / 0)", "cannot tell whether it makes parts of sets: ZeroDivisionError"),
        ("streams = None", "cannot tell whether it makes parts of sets: expected True or False, got None"),
        ("def fused(self, name): return 5", "cannot be randomised: expected a function or None, got 5"),
        ("def fused(self, name): return lambda out, *_: None", "gave NaN or values it did not write"),
        ("def bases(self, dims): return (2,)", "cannot tell the bases of its digits: expected 2 integers from 2 on"),
        ("def bases(self, dims): return 'ab'", "cannot tell the bases of its digits: TypeError"),
    ],
)
def test_a_sampler_that_answers_nonsense_is_named(plugins, body, reason):
    plugins.offer("toys", "sampler", TOY)
    draw = "def draw(self, count, dims, rng): return rng.random((count, dims))"
    plugins.module("toy_points", f"from samplekit import Sampler\nclass Toy(Sampler):\n    {body}\n    {draw}\n")

    def use_everything():
        sampler = samplekit.sampler("toy+owen" if "fused" in body or "bases" in body else "toy")
        return sampler.streams, sampler.points(8), sampler.notes(8, 2)

    with pytest.raises(SamplekitError) as error:
        use_everything()
    assert str(error.value).startswith("sampler toy of plugin toys (toys-distribution 1.0) ")
    assert reason in str(error.value)


def test_what_is_no_sampler_is_named(plugins):
    plugins.offer("toys", "sampler", TOY)
    plugins.module("toy_points", "Toy = dict")
    with pytest.raises(SamplekitError, match=r"plugin toys .* cannot be set up: expected a Sampler, got \{\}"):
        samplekit.sampler("toy")


def test_the_name_that_was_chosen_is_kept(plugins):
    for name in ("blocks", "cars"):
        plugins.offer(name, "sampler", TOY)
    plugins.module("toy_points", POINTS)
    chosen = samplekit.sampler("blocks/toy+shift")
    assert chosen.text == "blocks/toy+shift"
    assert samplekit.sampler(chosen.text).plugin.name == "blocks"
    for wrong in ("/halton", "halton+/owen", "blocks//toy"):
        with pytest.raises(UsageError, match="expected NAME"):
            samplekit.sampler(wrong)
    with pytest.raises(UsageError, match="unknown sampler '/halton'"):
        Registry().find("sampler", "/halton")


def test_what_a_plugin_prints_when_it_is_imported_is_no_result(plugins, capsys):
    hook = f"@hookimpl\ndef samplekit_samplers():\n    print('asked')\n    return [{TOY}]\n"
    plugins.add("toys", f"print('imported')\n{hook}")
    plugins.module("toy_points", f"print('used')\n{POINTS}")
    samplekit.points("toy", 2)
    printed = capsys.readouterr()
    assert (printed.out, printed.err.split()) == ("", ["imported", "asked", "used"])


@pytest.mark.parametrize("text", ["__repr__", "__str__"])
def test_values_that_cannot_be_shown_are_told_all_the_same(plugins, text):
    thing = f"class Thing(Exception):\n    def {text}(self): raise KeyError\n"
    fault = "return [Thing()]" if text == "__repr__" else "raise Thing"
    plugins.add("toys", f"{thing}@hookimpl\ndef samplekit_samplers():\n    {fault}\n")
    assert "Thing" in the_problem("toys")


def test_a_randomizer_of_a_plugin_is_held_to_the_same(plugins):
    plugins.offer("toys", "randomizer", 'RandomizerSpec("toy", "toy_randomizer:Toy", "")')
    plugins.module(
        "toy_randomizer",
        """
        class Toy:
            def apply(self, points, realizations, bases):
                points += 0.25
        """,
    )
    assert (samplekit.points("regular+toy", 1) == 0.75).all()
    # Ours is not to blame for what a stranger's randomizer does to it.
    blamed = r"^randomizer toy of plugin toys \(toys-distribution 1.0\) gave 1\.0: expected values in \[0, 1\)"
    with pytest.raises(SamplekitError, match=blamed):
        samplekit.points("regular+toy", 4)


def test_options_reach_the_sampler_by_keyword(plugins):
    plugins.offer(
        "toys",
        "sampler",
        'SamplerSpec("toy", "toy_points:Toy", "", options=(Option("max-value", 0.5), Option("flag", False)))',
    )
    plugins.module(
        "toy_points",
        """
        from samplekit import Sampler

        class Toy(Sampler):
            def __init__(self, max_value, flag):
                self.value = max_value if flag else 0.0

            def fill(self, out, *_):
                out[:] = self.value
        """,
    )
    assert (samplekit.points("toy:max-value=0.25,flag=true", 2) == 0.25).all()
    assert (samplekit.points(samplekit.sampler("toy", max_value=0.25, flag=True), 2) == 0.25).all()
    assert (samplekit.points("toy", 2) == 0.0).all()
    assert samplekit.sampler("toy:flag=true,max-value=0.25").text == "toy:max-value=0.25,flag=true"
