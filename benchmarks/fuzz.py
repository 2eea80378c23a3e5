"""Requests and files that nobody wrote on purpose, at every door: what comes back is counted and judged.

python benchmarks/fuzz.py [--commands 20000] [--strings 100000] [--files 2000] [--plugins 1000] [--processes 60]
    [--kernels 12] [--seed 0] [--case commands-17]

Command lines are made from a grammar and changed, and run in a process that is replaced every 500 of them; option
strings are read alone; files of points, images, banks, studies and compiled kernels are damaged; plugins misbehave. A
request of more than 8 s is interrupted as by its user, one that does not answer is a hang. Ends with status 1 if any
answer had a traceback, was no JSON, left half a file, or was wrong with exit status 0. ``--case`` repeats one.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

TESTS = Path(__file__).parent.parent / "tests" / "stability"
sys.path.insert(0, str(TESTS))

CHUNK = 500
MEMORY = 12 * 2**30
"""Bytes of address space: a request that takes more ends in one line, too."""


def main() -> None:
    parser = argparse.ArgumentParser()
    for name, number in (("commands", 20_000), ("strings", 100_000), ("files", 2000), ("plugins", 1000)):
        parser.add_argument(f"--{name}", type=int, default=number)
    parser.add_argument("--processes", type=int, default=60)
    parser.add_argument("--kernels", type=int, default=12)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--case", help="one case again, such as commands-17")
    parser.add_argument("--chunk", nargs=3, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.chunk:
        kind, first, last = arguments.chunk
        with tempfile.TemporaryDirectory() as folder:
            _work(kind, int(first), int(last), arguments.seed, Path(folder))
            os.chdir("/")
        return
    if arguments.case:
        kind, _, number = arguments.case.rpartition("-")
        arguments.chunk = kind, number, int(number) + 1
        with tempfile.TemporaryDirectory() as folder:
            _work(kind, int(number), int(number) + 1, arguments.seed, Path(folder), tell=True)
            os.chdir("/")
        return
    began = time.perf_counter()
    failures = 0
    for kind in ("commands", "strings", "files", "plugins", "processes", "kernels"):
        failures += _all_of(kind, getattr(arguments, kind), arguments.seed)
    print(f"{failures} failures, {time.perf_counter() - began:.0f} s")
    sys.exit(1 if failures else 0)


def _all_of(kind: str, number: int, seed: int) -> int:
    """Cases of one kind in processes of their own; counts by what was asked and exit status."""
    counts: Counter[tuple[str, int]] = Counter()
    failures, size, began = 0, CHUNK * (20 if kind == "strings" else 1), time.perf_counter()
    first = 0
    while first < number:
        last = min(first + size, number)
        program = [sys.executable, __file__, "--seed", str(seed), "--chunk", kind, str(first), str(last)]
        done = subprocess.run(program, stdout=subprocess.PIPE, text=True, check=False)
        cases = [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]
        for case in cases:
            if "what" not in case:
                continue
            counts[case["what"], case["status"]] += 1
            if case["wrong"]:
                failures += 1
                faults = "; ".join(case["wrong"])
                print(f"{kind}-{case['number']}: {case['words']}: {faults}: {case['err']}", flush=True)
        asked = [case["number"] for case in cases]
        if done.returncode:
            # The last that began is what ended it: go on behind it.
            failures += 1
            last = (max(asked) if asked else first) + 1
            print(f"{kind}-{last - 1}: the interpreter ended with {done.returncode}: {cases[-1:]}", flush=True)
        first = last
    print(f"{kind}: {sum(counts.values())} in {time.perf_counter() - began:.0f} s, {failures} failures", flush=True)
    for what in sorted({what for what, _ in counts}):
        own = {status: count for (name, status), count in sorted(counts.items()) if name == what}
        told = ", ".join(f"{count} with status {status}" for status, count in own.items())
        print(f"  {what:<20} {sum(own.values()):>7}: {told}", flush=True)
    return failures


def _work(kind: str, first: int, last: int, seed: int, folder: Path, *, tell: bool = False) -> None:
    """Cases of one kind in this process, a line each before and after."""
    from fuzzing.cases import CASES
    from fuzzing.doors import Doors

    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    said = sys.stdout
    doors = Doors(folder)
    for number in range(first, last):
        if kind != "strings":
            print(json.dumps({"number": number}), file=said, flush=True)
        case = CASES[kind](doors, f"{seed} {kind} {number}")
        print(json.dumps({"number": number, **case._asdict(), **({} if tell else {"out": ""})}), file=said)
    said.flush()


if __name__ == "__main__":
    main()
