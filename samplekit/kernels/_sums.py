"""Sums in a fixed order: the same bits in any tile and on any number of threads.

Inside a block of at most 1024 values eight lanes are summed side by side, in runs of eight values each that are then
added up; blocks are combined pairwise (Higham 2002, "Accuracy and Stability of Numerical Algorithms", 4.2; blocked
summation). The error is at most 27 roundings of the sum of magnitudes and one for each doubling of the number of
blocks. In one long run roundings of like values all go the same way: 1024 equal values would lose 30 of them.
"""

from typing import Self

import numpy as np
from llvmlite import ir
from numba.core import cgutils
from numba.core import types as numba_types
from numba.extending import intrinsic, overload
from numpy.typing import NDArray

from samplekit.kernels._compile import kernel

BLOCK = 1024
"""Number of samples whose sum a scene gives at once."""


LANES = 8
RUN = 8 * LANES
"""Values that are summed before their sum is added to those before."""


def lane_sum(values: NDArray[np.float64], count: int) -> float:
    """The sum of the first ``count`` values: lane l sums values l, l + 8, ...; then lanes in pairs; then the rest.

    A lane adds up the sums of its runs: of values 0 to 63, 64 to 127, ...
    """
    whole = count - count % LANES
    lanes = [0.0] * LANES
    for start in range(0, whole, RUN):
        run = [0.0] * LANES
        for i in range(start, min(start + RUN, whole)):
            run[i % LANES] += values[i]
        lanes = [total + part for total, part in zip(lanes, run, strict=True)]
    rest = 0.0
    for i in range(whole, count):
        rest += values[i]
    a, b, c, d, e, f, g, h = lanes
    return float((((a + b) + (c + d)) + ((e + f) + (g + h))) + rest)


@intrinsic
def _sum_of_lanes(context, values, whole):  # type: ignore[no-untyped-def]
    """Eight lanes as one LLVM vector: left to itself the compiler adds them one by one, at a third of the speed."""
    lanes = ir.VectorType(ir.DoubleType(), LANES)

    def generate(context, builder, signature, arguments):  # type: ignore[no-untyped-def]
        array = context.make_array(signature.args[0])(context, builder, arguments[0])
        zero, lane_step, run_step = (context.get_constant(numba_types.int64, n) for n in (0, LANES, RUN))
        zeros = ir.Constant(lanes, [0.0] * LANES)
        total, run = cgutils.alloca_once_value(builder, zeros), cgutils.alloca_once_value(builder, zeros)
        with cgutils.for_range_slice(builder, zero, arguments[1], run_step, inc=True) as (start, _):
            builder.store(zeros, run)
            beyond = builder.add(start, run_step)
            end = builder.select(builder.icmp_signed("<", beyond, arguments[1]), beyond, arguments[1])
            with cgutils.for_range_slice(builder, start, end, lane_step, inc=True) as (i, _):
                place = builder.bitcast(builder.gep(array.data, [i]), lanes.as_pointer())
                builder.store(builder.fadd(builder.load(run), builder.load(place, align=8)), run)
            builder.store(builder.fadd(builder.load(total), builder.load(run)), total)
        vector = builder.load(total)
        sums = [builder.extract_element(vector, ir.Constant(ir.IntType(32), lane)) for lane in range(LANES)]
        while len(sums) > 1:
            sums = [builder.fadd(sums[i], sums[i + 1]) for i in range(0, len(sums), 2)]
        return sums[0]

    return numba_types.float64(values, numba_types.int64), generate


@overload(lane_sum, inline="always")
def _lane_sum_in_kernels(values, count):  # type: ignore[no-untyped-def]
    def lane_sum_in_kernels(values, count):  # type: ignore[no-untyped-def]
        whole = count - count % LANES
        rest = 0.0
        for i in range(whole, count):
            rest += values[i]
        return _sum_of_lanes(values, whole) + rest

    return lane_sum_in_kernels


@kernel("void(float64[:,::1], float64[::1])")
def row_sums(values: NDArray[np.float64], out: NDArray[np.float64]) -> None:
    """Write the sum of each row of ``values`` float64[P, n], n <= 1024, into ``out`` float64[P]."""
    for row in range(values.shape[0]):
        out[row] = lane_sum(values[row], values.shape[1])


class PairwiseSum:
    """Sums of many rows at once, block after block, combined pairwise.

    Keeps one partial sum per level of the binary tree: memory grows with the logarithm of the number of blocks.
    """

    def __init__(self) -> None:
        self._levels: list[NDArray[np.float64] | None] = []

    @classmethod
    def of_equal(cls, block_sums: NDArray[np.float64], number: int) -> Self:
        """Add ``number`` blocks of the same sums float64[P], in the time of log2(number) additions."""
        made, power = cls(), block_sums.copy()
        for level in range(number.bit_length()):
            power = power + power if level else power
            made._levels.append(power if number >> level & 1 else None)
        return made

    def add(self, block_sums: NDArray[np.float64]) -> None:
        """Add the sums float64[P] of the next block; the array must not change afterwards."""
        carry = block_sums
        for level, partial in enumerate(self._levels):
            if partial is None:
                self._levels[level] = carry
                return
            carry = partial + carry
            self._levels[level] = None
        self._levels.append(carry)

    def total(self) -> NDArray[np.float64]:
        """Return the sums float64[P] of all blocks so far; the array must not be changed."""
        partials = [partial for partial in self._levels if partial is not None]
        result = partials[0]
        for partial in partials[1:]:
            result = partial + result
        return result
