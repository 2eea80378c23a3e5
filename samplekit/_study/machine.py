"""The machine on which times are measured."""

from __future__ import annotations

import platform
from pathlib import Path

import psutil


def describe_machine() -> dict[str, str]:
    """Return the system, the processor, the number of processors and the memory, in words."""
    return {
        "system": f"{platform.system()} {platform.release()}",
        "processor": _processor(),
        "processors": f"{psutil.cpu_count(logical=False) or '?'} cores, {psutil.cpu_count()} threads",
        "memory": f"{psutil.virtual_memory().total / 2**30:.3g} GiB",
    }


def kind_of(machine: dict[str, str]) -> str:
    """Return the kind of a machine as one text. Times of different kinds cannot be compared."""
    return f"{machine['processor']} | {machine['processors']} | {platform.machine()}"


def _processor() -> str:
    """Return the processor's own name, if the system knows it."""
    information = Path("/proc/cpuinfo")
    if information.exists():
        for line in information.read_text(encoding="utf-8", errors="replace").splitlines():
            name, _, value = line.partition(":")
            if name.strip() in ("model name", "Hardware", "Processor"):
                return value.strip()
    return platform.processor() or platform.machine()
