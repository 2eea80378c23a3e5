"""The closed forms, by the name of the scene."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from samplekit_spectrum.integrands.disk import disk
from samplekit_spectrum.integrands.integrand import Integrand
from samplekit_spectrum.integrands.products import bilinear, checker, gaussian
from samplekit_spectrum.integrands.step import step
from samplekit_spectrum.integrands.zoneplate import zoneplate

if TYPE_CHECKING:
    from samplekit import ConfiguredScene

Form = Callable[[str, "Mapping[str, Any]"], Integrand | None]

FORMS: dict[str, Form] = {
    "disk": disk,
    "gaussian": gaussian,
    "step": step,
    "checker": checker,
    "bilinear": bilinear,
    "zoneplate": zoneplate,
}


def closed_form(scene: ConfiguredScene) -> Integrand | None:
    """The closed form of one of samplekit's own scenes; None where there is none for these options."""
    form = FORMS.get(scene.spec.name)
    if form is None:
        return None
    return form(scene.text, scene.options)
