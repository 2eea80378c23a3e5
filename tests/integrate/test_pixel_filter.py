"""``pixel-filter=center``: the pixel's dimensions left out, in any scene."""

import numpy as np
import pytest

import samplekit
from samplekit import Scene, UsageError


class LensAlone(Scene):
    """What depth of field shows at the centres of 8 x 8 pixels, as a scene that never had a pixel."""

    def __init__(self, scene):
        self.scene = scene

    def sums(self, tile, boxes, out):
        whole = np.full((tile.shape[0], 4, tile.shape[2]), 0.5)
        whole[:, 2:] = tile
        self.scene.sums(whole, boxes, out)


@pytest.mark.parametrize("sampler", ["random", "sobol+owen", "jittered", "multi-jittered"])
def test_the_image_is_that_of_a_scene_that_never_had_a_pixel(sampler):
    centred = samplekit.scene("depth-of-field:pixel-filter=center")
    assert centred.needs == {"lens": 2}
    assert centred.blocks == (2,)
    image = samplekit.render(centred, sampler, 16, size=(8, 8), seed=4, full=True, error=False).image
    lens = samplekit.scene("disk")
    lens._scene = LensAlone(samplekit.scene("depth-of-field")._scene)
    never = samplekit.render(lens, sampler, 16, size=(8, 8), seed=4, full=True, error=False).image
    np.testing.assert_array_equal(image, never)


@pytest.mark.parametrize("scene", ["depth-of-field", "motion-blur", "motion-blur:aperture=0.1", "ambient-occlusion"])
def test_the_reference_is_the_value_at_the_centre(scene):
    joint = "," if ":" in scene else ":"
    chosen = f"{scene}{joint}pixel-filter=center"
    result = samplekit.render(chosen, "sobol+owen", 4096, size=(6, 5), seed=2)
    # Owen-scrambled Sobol points at 4096 in 1 to 3 dimensions: errors of pixels are below 1/4096^0.7.
    assert result.metrics["max_error"] < 3e-3
    assert result.metrics["dims"] == sum(n for purpose, n in samplekit.scene(scene).needs.items() if purpose != "pixel")
    # The centre is the limit of ever smaller pixels about it.
    plain = samplekit.scene(scene)._scene
    for column, row in ((0, 0), (3, 2), (5, 4)):
        x, y = (column + 0.5) / 6, (row + 0.5) / 5
        small = plain.exact(np.array([x - 1e-5, x + 1e-5]), np.array([y - 1e-5, y + 1e-5]))
        assert result.reference[row, column] == pytest.approx(small[0, 0], abs=1e-3)


def test_a_strangers_scene_takes_it_as_well():
    scene = samplekit.scene("motion-blur:pixel-filter=center")

    class Ramp(Scene):
        def dimensions(self):
            return {"pixel": 2, "time": 1}

        def value(self, points):
            return points[0] * 10 + points[1] + points[2]

    scene._scene = Ramp()
    result = samplekit.render(scene, "regular", 64, size=(4, 2), full=True)
    np.testing.assert_allclose(result.image[1], [2.5, 5.0, 7.5, 10.0], rtol=1e-12)
    np.testing.assert_allclose(result.reference, result.image, rtol=1e-12)


@pytest.mark.parametrize("scene", ["disk", "zoneplate:k=3", "depth-of-field:aperture=0", "motion-blur:shutter=0"])
def test_where_nothing_is_left_to_sample_it_is_refused_in_one_line(scene):
    joint = "," if ":" in scene else ":"
    with pytest.raises(UsageError, match="leaves no dimension to sample") as caught:
        samplekit.scene(f"{scene}{joint}pixel-filter=center")
    assert "\n" not in str(caught.value)


def test_box_is_the_default_and_another_filter_is_refused():
    assert samplekit.scene("disk:pixel-filter=box").needs == samplekit.scene("disk").needs == {"pixel": 2}
    with pytest.raises(UsageError, match="box or center"):
        samplekit.scene("disk:pixel-filter=gauss")
