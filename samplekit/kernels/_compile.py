"""Kernels: numba functions with an explicit signature, compiled when they are first called, cached across processes.

A kernel is cached under a key of everything that it is compiled from: its own source, and the helpers and constants of
other files that it uses, found by walking through its global names. Where no cache can be written (a read-only
installation, a home that cannot be written) kernels compile afresh in every process instead of failing.
"""

import functools
import hashlib
import importlib
import inspect
import os
import threading
import types
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, TypeVar, cast

import numba
import numpy as np
from numba.core import config
from numba.core import types as numba_types
from numba.extending import intrinsic, overload

Function = TypeVar("Function", bound=Callable[..., Any])
_lock = threading.RLock()
"""Held while a kernel is compiled: numba compiles on one thread at a time in any case."""

if not Path(os.path.expanduser("~")).is_absolute() and not config.CACHE_DIR:  # noqa: PTH111 - pathlib's raises
    # A user without a home: numba would make a folder called "~" where the process happens to run.
    config.CACHE_LOCATOR_CLASSES = "InTreeCacheLocator"


def kernel(signature: str) -> Callable[[Function], Function]:
    """Compile a function for ``signature`` at its first call, without the interpreter's lock, cached where possible.

    Floating point is IEEE in program order (no fastmath): the same numbers in any tile, thread and vector width.

    Parameters
    ----------
    signature
        A numba signature such as ``"void(float64[:,:,::1], uint64[::1])"``.

    Examples
    --------
    >>> from samplekit.kernels import kernel
    >>> @kernel("float64(float64)")
    ... def double(x):
    ...     return 2.0 * x
    >>> double(4.0)
    8.0
    """

    def prepare(function: Function) -> Function:
        if config.DISABLE_JIT:
            return np.errstate(over="ignore")(function)
        dispatcher = numba.njit(nogil=True, error_model="numpy", no_cfunc_wrapper=True)(function)
        dispatcher.declared_signature = signature
        # Numba calls this where a dispatcher has no machine code for the arguments.
        dispatcher._compile_for_args = functools.partial(_compile_at_first_call, dispatcher)  # noqa: SLF001 - see above
        return cast("Function", dispatcher)

    return prepare


def helper(function: Function) -> Function:
    """Mark a function that kernels inline; callable from Python as well.

    Examples
    --------
    >>> from samplekit.kernels import helper
    >>> @helper
    ... def square(x):
    ...     return x * x
    >>> square(3)
    9
    """
    return function if config.DISABLE_JIT else cast("Function", _Helper(function))


class _Helper:
    """A function that LLVM inlines in kernels where that pays, and that numba compiles as it is for a call from Python.

    LLVM decides, because numba (with inline="always") infers the types of the body again at every call. The version for
    kernels has no entry for Python or C: they would take longer to compile than the function.
    """

    def __init__(self, function: Callable[..., Any]) -> None:
        functools.update_wrapper(self, function)
        self.py_func = function
        self._in_kernels = numba.njit(error_model="numpy", no_cpython_wrapper=True, no_cfunc_wrapper=True)(function)
        self._find_for_kinds = self._in_kernels.get_call_template
        self._in_kernels.get_call_template = self._find_template
        # Numba takes this for the helper where a kernel calls it.
        self._numba_type_ = self._in_kernels._numba_type_

    def __call__(self, *arguments: Any, **keywords: Any) -> Any:
        return self._callable(*arguments, **keywords)

    @functools.cached_property
    def _callable(self) -> Callable[..., Any]:
        return cast("Callable[..., Any]", numba.njit(error_model="numpy")(self.py_func))

    def _find_template(self, arguments: Iterable[Any], keywords: Mapping[str, Any]) -> Any:
        # One version serves all values of a literal argument.
        unliteral = cast("Any", numba_types).unliteral
        kinds = {name: unliteral(kind) for name, kind in keywords.items()}
        return self._find_for_kinds(tuple(map(unliteral, arguments)), kinds)


def _compile_at_first_call(dispatcher: Any, *arguments: Any, **_: Any) -> Any:
    """Compile a kernel and return its entry point, if it takes such arguments."""
    _ensure_compiled(dispatcher)
    ((expected, compiled),) = dispatcher.overloads.items()
    given = [dispatcher.typeof_pyval(argument) for argument in arguments]
    convertible = map(dispatcher.typingctx.can_convert, given, expected)
    if len(given) != len(expected) or any(conversion is None for conversion in convertible):
        raise TypeError(f"{dispatcher.py_func.__name__} takes {expected}, not {tuple(given)}")
    return compiled.entry_point


@functools.cache
def _load_registries() -> None:
    """Have numba load its part for arrays without its look for a BLAS, which imports scipy.linalg: a sixth of a start.

    Kernels use no linear algebra; a function that does asks for the BLAS itself when it is compiled.
    """
    from numba.np import linalg

    look = linalg.ensure_blas
    linalg.ensure_blas = lambda: None
    try:
        importlib.import_module("numba.np.arraymath")
    finally:
        linalg.ensure_blas = look


def _ensure_compiled(dispatcher: Any) -> None:
    """Compile a kernel for its signature, or load it from the cache."""
    with _lock:
        if dispatcher.signatures:
            return
        _load_registries()
        key = hashlib.sha256()
        for other in _used(dispatcher.py_func, {}):
            if hasattr(other, "declared_signature"):
                # Kernels that this one calls: compiled before it, for their own signatures.
                _ensure_compiled(other)
            key.update(_content(other))
        _compile(dispatcher, key.hexdigest())
        # From now on numba's own method refuses other arguments.
        del dispatcher._compile_for_args  # noqa: SLF001 - see above


def _compile(dispatcher: Any, key: str) -> None:
    # Numba makes what a function's closure holds part of the key of its cache.
    function = dispatcher.py_func
    code = function.__code__.replace(co_freevars=("key",))
    keyed = types.FunctionType(
        code, function.__globals__, function.__name__, function.__defaults__, (types.CellType(key),)
    )
    dispatcher.py_func = keyed
    signature = dispatcher.declared_signature
    try:
        dispatcher.enable_caching()
        try:
            dispatcher.compile(signature)
        except Exception:
            # A damaged index or entry would be met again by every process: emptied, the cache is written anew.
            dispatcher._cache.flush()  # noqa: SLF001 - numba has no other way
            dispatcher.compile(signature)
    except Exception:
        # No cache can be written; a fault of the kernel itself shows again on the next line.
        dispatcher._cache = numba.core.caching.NullCache()  # noqa: SLF001 - numba has no other way
        dispatcher.compile(signature)
    dispatcher.disable_compile()


def _used(function: types.FunctionType, seen: dict[int, object]) -> Iterator[object]:
    """Yield the functions and constants that a function reaches through global names, each once."""
    for name in _names(function.__code__):
        if name not in function.__globals__:
            continue
        value = function.__globals__[name]
        if id(value) in seen:
            continue
        seen[id(value)] = value
        yield value
        inner = getattr(value, "py_func", value)
        if isinstance(inner, types.FunctionType):
            yield from _used(inner, seen)


def _names(code: types.CodeType) -> Iterator[str]:
    """Yield the global names of a function's code, and of the functions within it."""
    yield from code.co_names
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            yield from _names(constant)


def _content(value: object) -> bytes:
    """Return what a kernel is compiled from where it uses the value."""
    inner = getattr(value, "py_func", value)
    if isinstance(inner, types.FunctionType):
        # The whole file: what numba puts in the place of a function stands beside it.
        return _source(inspect.getfile(inner))
    if isinstance(value, np.ndarray):
        return bytes(f"{value.dtype.str} {value.shape}", "ascii") + bytes(value.tobytes())
    return b"" if isinstance(value, types.ModuleType) else repr(value).encode()


@functools.cache
def _source(path: str) -> bytes:
    return Path(path).read_bytes()


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
