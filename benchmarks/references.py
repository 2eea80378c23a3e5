"""References under attack: the worst ratio of error to stated bound that a targeted search finds, against 60 digits.

python benchmarks/references.py [--boxes 10000] [--seed 0] [--only NAME ...]
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "tests" / "stability"))

from attack import ATTACKS, attack


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--boxes", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", nargs="*", default=list(ATTACKS))
    arguments = parser.parse_args()
    total = 0
    for name in arguments.only:
        began = time.perf_counter()
        worst = attack(name, arguments.boxes, arguments.seed, stop=False)
        total += worst.boxes
        seconds = time.perf_counter() - began
        print(f"{name:<22} {worst.boxes:>7} boxes, {seconds:6.0f} s, worst {worst.ratio:.3g} of the bound,", end=" ")
        print(f"{worst.beyond} beyond it: {worst.case}", flush=True)
    print(f"{total} boxes")


if __name__ == "__main__":
    main()
