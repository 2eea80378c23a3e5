"""Kernels: numba functions with an explicit signature, compiled once and cached across processes.

The cache of a kernel is keyed by its own source; helpers that it inlines from other files are not part of that key, so
the source of the folders that hold them is folded in here. Where no cache can be written (read-only installation,
unwritable home) kernels compile afresh in every process instead of failing.
"""

from __future__ import annotations

import functools
import hashlib
import importlib
import os
import sys
import types
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, cast

import numba
import numpy as np
from numba.core import config
from numba.core import types as numba_types
from numba.extending import intrinsic, overload

Function = TypeVar("Function", bound=Callable[..., Any])

if not Path(os.path.expanduser("~")).is_absolute() and not config.CACHE_DIR:  # noqa: PTH111 - pathlib's raises
    # A user without a home: numba would make a folder called "~" where the process happens to run.
    config.CACHE_LOCATOR_CLASSES = "InTreeCacheLocator"

_PACKAGE = Path(__file__).parent.parent
_FOLDERS_WITH_HELPERS = ("kernels",)


@functools.cache
def _helpers_digest() -> str:
    digest = hashlib.sha256()
    for folder in _FOLDERS_WITH_HELPERS:
        for source in sorted((_PACKAGE / folder).glob("*.py")):
            digest.update(source.read_bytes())
    return digest.hexdigest()


def _keyed_by_helpers(function: types.FunctionType) -> types.FunctionType:
    """The same function with the helpers' digest in its closure, which numba makes part of the cache key."""
    code = function.__code__.replace(co_freevars=("helpers_digest",))
    closure = (types.CellType(_helpers_digest()),)
    return types.FunctionType(code, function.__globals__, function.__name__, function.__defaults__, closure)


def _cached(function: types.FunctionType, signature: str) -> Any:
    compiled = numba.njit(nogil=True, cache=True, error_model="numpy")(_keyed_by_helpers(function))
    try:
        compiled.compile(signature)
    except Exception:
        # A damaged index or entry would be met again by every process: emptied, the cache is written anew.
        compiled._cache.flush()  # noqa: SLF001 - numba has no other way
        compiled.compile(signature)
    compiled.disable_compile()
    return compiled


def _import_without_scipy(module: str) -> None:
    """Import a part of numba that imports scipy.linalg just to see if there is a BLAS: a quarter of the start-up."""
    probe = "scipy.linalg.cython_blas"
    if module in sys.modules or probe in sys.modules:
        return
    sys.modules[probe] = types.ModuleType(probe)
    try:
        importlib.import_module(module)
    finally:
        del sys.modules[probe]


def kernel(signature: str) -> Callable[[Function], Function]:
    """Compile a function for ``signature``, without the interpreter's lock, cached where a cache can be written.

    Floating point is IEEE in program order (no fastmath): the same numbers in any tile, thread and vector width.

    Parameters
    ----------
    signature
        A numba signature such as ``"void(float64[:,:,::1], uint64[::1])"``.
    """

    def compile_kernel(function: Function) -> Function:
        if config.DISABLE_JIT:
            return np.errstate(over="ignore")(function)
        _import_without_scipy("numba.np.arraymath")
        try:
            compiled = _cached(cast("types.FunctionType", function), signature)
        except Exception:
            # No cache can be written; a fault of the kernel itself shows again on the next line.
            compiled = numba.njit(signature, nogil=True, error_model="numpy")(function)
        return cast("Function", compiled)

    return compile_kernel


def helper(function: Function) -> Function:
    """Mark a function that kernels inline; callable from Python as well."""
    return cast("Function", numba.njit(inline="always", error_model="numpy")(function))


def fma(a: float, b: float, c: float) -> float:
    """a*b + c with one rounding, in Python exactly as in kernels (fusedMultiplyAdd, IEEE 754-2019, 5.4.1)."""
    from fractions import Fraction

    return float(Fraction(float(a)) * Fraction(float(b)) + Fraction(float(c)))


def reverse_bits32(x: np.uint32) -> np.uint32:
    """The 32 bits of ``x`` in reverse order."""
    return np.uint32(int(f"{int(x):032b}"[::-1], 2))


@intrinsic  # type: ignore[untyped-decorator]
def _fma(context: Any, a: Any, b: Any, c: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.fma(*arguments)

    return numba_types.float64(numba_types.float64, numba_types.float64, numba_types.float64), generate


@intrinsic  # type: ignore[untyped-decorator]
def _reverse_bits32(context: Any, x: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.bitreverse(arguments[0])

    return numba_types.uint32(numba_types.uint32), generate


@overload(fma, inline="always")
def _fma_in_kernels(a, b, c):  # type: ignore[no-untyped-def]
    return lambda a, b, c: _fma(a, b, c)


@overload(reverse_bits32, inline="always")
def _reverse_bits32_in_kernels(x):  # type: ignore[no-untyped-def]
    return lambda x: _reverse_bits32(x)
