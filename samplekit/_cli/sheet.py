"""One sampler, scene, randomizer or plugin in full, line by line: what ``samplekit list KIND NAME`` prints."""

from __future__ import annotations

from samplekit._cli import declaration_words as words
from samplekit._registry import Plugin, registry
from samplekit._specs import RandomizerSpec, SamplerSpec, SceneSpec

Rows = dict[str, list[str]]


def choose(kind: str, text: str) -> tuple[str, SamplerSpec | SceneSpec | RandomizerSpec, Plugin]:
    """Find a sampler, scene or randomizer by its text: its name, declaration and plugin.

    A plain name imports no implementation.

    Raises
    ------
    UsageError
        There is none; a sampler's option that it does not take.
    """
    if kind == "samplers" and (":" in text or "+" in text):
        # Options and randomizers change a declaration, and only the implementation knows how.
        from samplekit._configured.sampler import sampler as configured_sampler

        sampler = configured_sampler(text)
        return sampler.text, sampler.spec, sampler.plugin
    offer = registry().find(kind[:-1], text)  # type: ignore[arg-type]
    return text, offer.spec, offer.plugin


def describe(spec: SamplerSpec | SceneSpec | RandomizerSpec, plugin: Plugin) -> Rows:
    """Return all that a declaration says in words: lines of text by their heading, some without lines."""
    rows: Rows = {"what it is": [spec.summary], "reference": [spec.reference], "plugin": [str(plugin)]}
    if isinstance(spec, SamplerSpec):
        rows |= _sampler(spec)
    elif isinstance(spec, SceneSpec):
        rows["dimensions"] = [", ".join(f"{purpose} {number}" for purpose, number in spec.purposes)]
    else:
        rows["keeps"] = [", ".join(spec.keeps) or "no promise"]
    width = max((len(f"{option.name}={option.default}") for option in spec.options), default=0)
    rows["options"] = [
        f"{f'{option.name}={option.default}':<{width}}  {option.describe()}".rstrip() for option in spec.options
    ]
    return rows


def _sampler(spec: SamplerSpec) -> Rows:
    random = "yes: another seed, and another realisation, gives other points" if spec.randomized else "no"
    rows: Rows = {
        "dimensions": [words.dimensions(spec)],
        "points": [words.counts(spec)],
        "progressive": [words.progressive(spec)],
        "extensible": [words.extensible(spec)],
        "random": [random],
        "unbiased": ["yes" if spec.unbiased else "no"],
        "largest index": [str(spec.largest_index)],
        "promises": [promise.describe() for promise in spec.promises],
        "known to fail": [f"{check}: {reason}" for check, reason in spec.expected_failures.items()],
    }
    if spec.randomized:
        rows["period"] = ["none" if spec.period is None else f"{spec.period} pixels"]
    if spec.screen_block is not None:
        block = f"{spec.screen_block} x {spec.screen_block} pixels"
        together = "its sets together keep every promise, and errors cancel when seen together"
        rows["screen"] = [f"each aligned block of {block} shares one sequence: {together}"]
    if spec.fresh_options:
        given = ",".join(f"{name}={value}" for name, value in spec.fresh_options.items())
        rows["fresh sets"] = [f"{given}: every realisation is made afresh, none is used twice"]
    return rows


def describe_plugin(plugin: Plugin) -> Rows:
    """Return where a plugin comes from, what it offers and what is wrong with it: lines of text by their heading."""
    rows: Rows = {
        "distribution": [f"{plugin.distribution} {plugin.version}"],
        "status": ["switched off" if plugin.blocked else "problem" if plugin.problems else "loaded"],
        "problems": plugin.problems,
    }
    return rows | {f"{kind}s": [", ".join(names)] for kind, names in plugin.offers.items()}


def lines(title: str, rows: Rows) -> list[str]:
    """Return the lines that show the rows under a title: headings on the left, their text on the right."""
    width = max(len(heading) for heading in rows)
    written = [title]
    for heading, texts in rows.items():
        for index, text in enumerate(texts):
            written.append(f"  {heading if index == 0 else '':<{width}}  {text}".rstrip())
    return written
