"""The machine that times are taken on, and the versions that numbers are made with: what must be equal to compare."""

from __future__ import annotations

import platform
from functools import cache
from pathlib import Path

import psutil

from samplekit._provenance import versions


@cache
def known_versions() -> dict[str, str]:
    """The versions of samplekit, Python and libraries, looked up once."""
    return versions()


def describe_machine() -> dict[str, str]:
    """System, processor, number of processors and memory."""
    return {
        "system": f"{platform.system()} {platform.release()}",
        "processor": _processor(),
        "processors": f"{psutil.cpu_count(logical=False) or '?'} cores, {psutil.cpu_count()} threads",
        "memory": f"{psutil.virtual_memory().total / 2**30:.3g} GiB",
    }


def kind(machine: dict[str, str]) -> str:
    """The kind of machine, as one word: times of other kinds are not those of this one."""
    return f"{machine['processor']} | {machine['processors']} | {platform.machine()}"


def _processor() -> str:
    """The processor's own name, where the system tells it."""
    information = Path("/proc/cpuinfo")
    if information.exists():
        for line in information.read_text(encoding="utf-8", errors="replace").splitlines():
            name, _, value = line.partition(":")
            if name.strip() in ("model name", "Hardware", "Processor"):
                return value.strip()
    return platform.processor() or platform.machine()
