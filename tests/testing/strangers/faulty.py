"""A plugin whose samplers hang, crash the interpreter, eat memory, print, or break what they promise."""

from samplekit import LatinStrata, SamplerSpec, SceneSpec, hookimpl


def spec(name, target, **declared):
    return SamplerSpec(name, f"faulty_samplers:{target}", f"{name}: for tests", **declared)


@hookimpl
def samplekit_samplers():
    return [
        spec("hangs", "Hangs"),
        spec("crashes", "Crashes"),
        spec("exits", "Exits"),
        spec("eats-memory", "EatsMemory"),
        spec("prints", "Prints"),
        spec("not-latin", "Plain", promises=(LatinStrata(),)),
        spec("known", "Plain", promises=(LatinStrata(),), expected_failures={"strata": "a first try"}),
        spec("pessimist", "Plain", expected_failures={"range": "might reach 1"}),
        spec("misspelt", "Plain", expected_failures={"rnage": "might reach 1"}),
        spec("twofold", "Plain"),
    ]


@hookimpl
def samplekit_scenes():
    return [SceneSpec("twofold", "broken_scenes:Ramp", "twofold: for tests")]
