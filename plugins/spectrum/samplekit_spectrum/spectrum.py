"""The expected power spectrum of a sampler, which ``power`` computes."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

import samplekit
from samplekit import ConfiguredSampler, UsageError, check_seed
from samplekit_spectrum.bias import Bias, find_bias
from samplekit_spectrum.expectation import Projection, expectations
from samplekit_spectrum.frequencies import Cube, Frequencies
from samplekit_spectrum.homogenized import homogenized
from samplekit_spectrum.point_sets import Source
from samplekit_spectrum.radial import Radial, radial
from samplekit_spectrum.request import axes_of, check_integer, frequencies_of

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from matplotlib.axes import Axes
    from numpy.typing import ArrayLike, NDArray

    from samplekit_spectrum.map_display import MapDisplay
    from samplekit_spectrum.moments import Moments
    from samplekit_spectrum.radial_display import RadialDisplay

REALIZATIONS = 100


@dataclass(frozen=True, eq=False)
class Spectrum:
    """The expected power spectrum E|S(m)|^2 of a sampler, S(m) = (1/N) sum_k exp(-2 pi i m . x_k).

    Attributes
    ----------
    sampler, count, dims, project
        The text that chooses the sampler, N, the number of dimensions of the sets, and the dimensions on which the sets
        are projected.
    realizations, requested
        Number of realisations in the mean, and the number that was requested, which is larger after an interrupt. Both
        are 1 for a sampler that is not random.
    seed
        The seed.
    frequencies
        A ``Cube`` of frequencies, or a ``FrequencyList``.
    randomized
        Whether the sampler is random.

    Examples
    --------
    >>> from samplekit_spectrum import power
    >>> spectrum = power("jittered", 16, realizations=10, max_frequency=4)
    >>> spectrum.mean.shape
    (9, 9)
    """

    sampler: str
    count: int
    dims: int
    project: tuple[int, ...]
    realizations: int
    requested: int
    seed: int
    frequencies: Frequencies
    randomized: bool
    _moments: Moments = field(repr=False)

    @property
    def interrupted(self) -> bool:
        """True if fewer realisations were made than requested."""
        return self.realizations < self.requested

    @property
    def mean(self) -> NDArray[np.float64]:
        """E|S|^2: float64[..., 2F + 1, 2F + 1], axes (..., y, x), DC (which is 1) in the middle; or float64[K]."""
        return self.frequencies.full(self._moments.mean)

    @property
    def standard_error(self) -> NDArray[np.float64]:
        """Standard error of ``mean``: 0 for a deterministic sampler, NaN for one realisation of a random one."""
        return self.frequencies.full(
            self._moments.standard_error if self.randomized else np.zeros(self.frequencies.half)
        )

    @property
    def normalized(self) -> NDArray[np.float64]:
        """N E|S|^2, which is 1 for white noise."""
        return self.count * self.mean

    @cached_property
    def bias(self) -> Bias:
        """The frequency at which |E S(m)| is most significant, and whether it is significant there."""
        return find_bias(self.frequencies, self._moments, randomized=self.randomized)

    @cached_property
    def radial(self) -> Radial:
        """The mean over rings (shells in 3D, pairs in 1D).

        Raises
        ------
        UsageError
            Listed frequencies lie on no rings.
        """
        if not isinstance(self.frequencies, Cube):
            raise UsageError("listed frequencies have no radial mean")
        found = radial(self.frequencies, self._moments)
        return found if self.randomized else replace(found, standard_error=np.zeros(found.power.size))

    def plot(
        self, ax: Axes | None = None, *, axes: Any = None, scale: float | None = None
    ) -> MapDisplay | RadialDisplay:
        """Draw N times the power: a map in two dimensions, slices in three, a curve in one.

        Parameters
        ----------
        ax
            The axes of matplotlib to draw on, in one dimension or two.
        axes
            Several of them: one for each slice, or for power and anisotropy. None: a new figure.
        scale
            N times the power that is drawn white; None: 2.

        Returns
        -------
        MapDisplay or RadialDisplay
            See ``samplekit_spectrum.map_display`` and ``samplekit_spectrum.radial_display``.

        Raises
        ------
        UsageError
            Listed frequencies have no picture; another number of axes.
        """
        if not isinstance(self.frequencies, Cube):
            raise UsageError("listed frequencies have no picture")
        if self.frequencies.dims == 1:
            return self.plot_radial(ax, axes=axes)
        from samplekit_spectrum.map_display import MapDisplay

        return MapDisplay.from_spectra([self], scale).plot(ax, axes=axes)

    def plot_radial(self, ax: Axes | None = None, *, axes: Any = None) -> RadialDisplay:
        """Draw the radial mean with its 99 % interval, and the anisotropy.

        Parameters
        ----------
        ax
            The axes of matplotlib to draw the power on, without the anisotropy.
        axes
            Two of them, for both. None: a new figure.

        Returns
        -------
        RadialDisplay
            See ``samplekit_spectrum.radial_display``.

        Raises
        ------
        UsageError
            Listed frequencies lie on no rings; another number of axes.
        """
        from samplekit_spectrum.radial_display import RadialDisplay

        return RadialDisplay.from_spectrum(self).plot(ax, axes=axes)

    def _repr_png_(self) -> bytes | None:
        return self.plot()._repr_png_() if isinstance(self.frequencies, Cube) else None

    def _repr_html_(self) -> str | None:
        if isinstance(self.frequencies, Cube):
            return None
        from samplekit_spectrum.tables import listed_html

        return listed_html(self)


def power(
    sampler: str | ConfiguredSampler,
    count: int,
    *,
    realizations: int = REALIZATIONS,
    max_frequency: int | None = None,
    step: float = 1.0,
    frequencies: ArrayLike | None = None,
    dims: int | None = None,
    project: Sequence[int] | None = None,
    homogenize: bool = False,
    seed: int = 0,
    threads: int | None = None,
    progress: Callable[[int, int], None] = lambda _, __: None,
) -> Spectrum:
    """Compute the expected power spectrum of a sampler.

    Parameters
    ----------
    sampler
        ``NAME[:option=value,...][+RANDOMIZER]``, or what :func:`samplekit.sampler` returned. A sampler that reuses sets
        makes a fresh one for each realisation.
    count
        N, the number of points of a set.
    realizations
        Number of sets in the mean; 1 is enough, and used, if the sampler is not random.
    max_frequency
        F: all integer frequencies with |m|_inf <= F. By default about 4 sqrt(N).
    step
        Distance of neighbouring frequencies, 1 for the integers: F is in multiples of it.
    frequencies
        float[K, dims]: these frequencies instead, of magnitude up to 2^40.
    dims
        Number of dimensions of the sets; by default 2, or as many as ``project`` needs.
    project
        Up to 3 dimensions, counted from 0, on which the sets are projected; by default all.
    homogenize
        Follow the sampler with a random shift.
    seed
        From 0 to 2^64 - 1.
    threads
        Number of threads; None: one for each processor.
    progress
        Called with the numbers of realisations done and to do.

    Returns
    -------
    Spectrum
        The mean power at each frequency with its standard error, the radial mean, and the test for bias.

    Raises
    ------
    UsageError
        The request cannot be carried out.
    SamplekitError
        The sampler failed, or memory is short.

    Examples
    --------
    >>> from samplekit_spectrum import power
    >>> spectrum = power("jittered", 64, realizations=10, max_frequency=16)
    >>> spectrum.mean.shape, float(spectrum.mean[16, 16])
    ((33, 33), 1.0)
    """
    (spectrum,) = powers(
        sampler,
        count,
        [project],
        realizations=realizations,
        max_frequency=max_frequency,
        step=step,
        frequencies=frequencies,
        dims=dims,
        homogenize=homogenize,
        seed=seed,
        threads=threads,
        progress=progress,
    )
    return spectrum


def powers(
    sampler: str | ConfiguredSampler,
    count: int,
    projects: Sequence[Sequence[int] | None],
    *,
    realizations: int = REALIZATIONS,
    max_frequency: int | None = None,
    step: float = 1.0,
    frequencies: ArrayLike | None = None,
    dims: int | None = None,
    homogenize: bool = False,
    seed: int = 0,
    threads: int | None = None,
    progress: Callable[[int, int], None] = lambda _, __: None,
    keep_interrupted: bool = False,
) -> list[Spectrum]:
    """Return the spectra of several projections of the same sets; the parameters are those of :func:`power`.

    With ``keep_interrupted``, an interrupt ends the work, and the spectra are those of the realisations that are done.
    """
    chosen = samplekit.sampler(sampler)
    chosen = (homogenized(chosen) if homogenize else chosen).fresh()
    axes, dims = axes_of(projects, dims)
    chosen.check(count, dims)
    seed = check_seed(seed)
    check_integer(realizations, "realizations", 2**40)
    where = frequencies_of(count, len(axes[0]), max_frequency, step, frequencies)
    requested = realizations if chosen.spec.randomized else 1
    found = expectations(
        Source(chosen, int(count), dims, seed),
        [Projection(project, where) for project in axes],
        requested,
        threads=threads,
        progress=progress,
        keep_interrupted=keep_interrupted,
    )
    return [
        Spectrum(
            chosen.text, int(count), dims, project, moments.realizations, requested, seed, where,
            chosen.spec.randomized, moments,
        )
        for project, moments in zip(axes, found, strict=True)
    ]  # fmt: skip
