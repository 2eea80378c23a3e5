"""One case of each kind from its seed: what was asked, what came back, what is wrong with it."""

from __future__ import annotations

import os
import subprocess
import sys
from random import Random
from typing import TYPE_CHECKING, NamedTuple

from fuzzing import grammar, strangers
from fuzzing.files import DOORS
from fuzzing.judge import Answer, judge, tree

if TYPE_CHECKING:
    from collections.abc import Callable

    from fuzzing.doors import Doors, Verdict


class Case(NamedTuple):
    """What was asked (for the count, and in full), exit status, faults, and what was said."""

    what: str
    status: int
    wrong: list[str]
    words: list[str]
    err: str
    out: str
    seconds: float


def _case(what: str, words: list[str], verdict: Verdict) -> Case:
    answer = verdict.answer
    return Case(what, answer.status, verdict.wrong, words, answer.err[-500:], answer.out, verdict.seconds)


def command(doors: Doors, seed: str) -> Case:
    """A command line in this process."""
    words = grammar.command_line(Random(seed))
    return _case(_name(words), words, doors.ask(words))


def string(doors: Doors, seed: str) -> Case:
    """A sampler, scene or list as text, read alone, and completed."""
    from samplekit import sampler as configured_sampler
    from samplekit import scene as configured_scene
    from samplekit._errors import UsageError
    from samplekit.commands import parse_counts, parse_size
    from samplekit.commands._completion import complete_sampler, complete_scene

    random = Random(seed)
    kinds: dict[str, tuple[Callable[[Random], str], list[Callable[[str], object]]]] = {
        "sampler": (grammar.sampler, [configured_sampler, complete_sampler]),
        "scene": (grammar.scene, [configured_scene, complete_scene]),
        "list": (
            lambda random: random.choice(["1,4,16", "2^0..2^4", "16"]),
            [lambda text: parse_counts(text, "n")],
        ),
        "size": (lambda random: random.choice(["8", "8x3"]), [parse_size]),
    }
    kind = random.choice(list(kinds))
    make, doors_of_it = kinds[kind]
    text = make(random)
    for _ in range(random.choice([0, 1, 2, 4])):
        (text,) = (grammar.mutated([text], random) or [""])[:1]
    status, wrong = 0, []
    for door in doors_of_it:
        try:
            door(text)
        except UsageError as error:
            status = 2
            # What a library was given it may say again; the command line folds it.
            if "\n" in str(error) and "\n" not in text:
                wrong.append("more than one line")
        except Exception as error:
            status = 1
            wrong.append(f"{type(error).__name__}: {error}")
    return Case(kind, status, wrong, [text], "", "", 0.0)


def file(doors: Doors, seed: str) -> Case:
    """A damaged file."""
    random = Random(seed)
    kind = random.choice(list(DOORS))
    what, verdict = DOORS[kind](doors, random)
    return _case(f"{kind} {what}", [kind, what], verdict)


def plugin(doors: Doors, seed: str) -> Case:
    """A plugin that misbehaves."""
    random = Random(seed)
    with strangers.stranger(doors.folder.parent / "strangers" / seed.rpartition(" ")[2], random) as kind:
        words = strangers.request(kind, random)
        verdict = doors.ask(words)
        if kind == "command":
            # It may end as it likes, with any status.
            kept = [
                fault for fault in verdict.wrong if not (fault.startswith("exit status") and verdict.answer.status > 0)
            ]
            verdict = verdict._replace(wrong=[fault for fault in kept if "without a line" not in fault])
    return _case(kind, words, verdict)


def process(doors: Doors, seed: str) -> Case:
    """A command line in a process of its own, which answers as one in this process."""
    # No word that a system cannot hand over.
    tries = (grammar.command_line(Random(f"{seed} {k}")) for k in range(1000))
    words = next(each for each in tries if not any("\0" in word for word in each))
    before = tree(doors.folder)
    environment = {**os.environ, "PYTHONUTF8": "1"}
    done = subprocess.run(
        [sys.executable, "-m", "samplekit", *words], env=environment, capture_output=True, timeout=120, check=False
    )
    answer = Answer(done.returncode, *(said.decode("utf-8", "replace") for said in (done.stdout, done.stderr)))
    wrong = judge(words, answer, before, doors.folder)
    doors.anew()
    here = doors.ask(words)
    if here.answer.status != answer.status:
        wrong.append(f"status {answer.status} as a process, {here.answer.status} within one")
    return Case(_name(words), answer.status, wrong, words, answer.err[-500:], answer.out, 0.0)


def kernels(doors: Doors, seed: str) -> Case:
    """Damaged compiled kernels: the same points as from whole ones."""
    from fuzzing.damage import damaged

    random = Random(seed)
    cache = doors.folder.parent / "kernels"
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(cache)}
    words = ["points", "-s", "random", "-n", "4", "--json"]

    def ask() -> Answer:
        program = [sys.executable, "-m", "samplekit", *words]
        done = subprocess.run(program, env=environment, capture_output=True, text=True, timeout=120, check=False)
        lines = [line for line in done.stderr.splitlines() if "compiling kernels" not in line]
        return Answer(done.returncode, done.stdout, "\n".join(lines))

    whole = ask()
    kept = {path: path.read_bytes() for path in cache.rglob("*.nb[ci]")}
    what = random.choice([".nbi", ".nbc", ".nbc"])
    for path, data in kept.items():
        if path.suffix == what:
            path.write_bytes(damaged(data, random))
    answer = ask()
    wrong = [] if answer == whole and whole.status == 0 else ["others than from whole kernels"]
    again = ask()
    if again != whole:
        wrong.append("others than from whole kernels, twice")
    for path, data in kept.items():
        path.write_bytes(data)
    return Case(what, answer.status, wrong, words, answer.err[-500:], answer.out, 0.0)


def _name(words: list[str]) -> str:
    known = {make.__name__ for make in grammar.COMMANDS} | {"list", "new-plugin"}
    return words[0] if words and words[0] in known else "others"


CASES = {
    "commands": command,
    "strings": string,
    "files": file,
    "plugins": plugin,
    "processes": process,
    "kernels": kernels,
}
"""By kind."""
