"""`./cupel bed`: a small bed made for real by LIGGGHTS, its packing and its grains against what they should be."""

import os
import shutil
from math import erf, log, sqrt

import numpy as np
import pytest

from cupel import bed as powder_bed
from cupel.errors import CupelError

TABLE = {
    "layer_thickness": 50e-6,
    "diameter": {"median": 30e-6, "minimum": 15e-6, "maximum": 45e-6, "spread": 0.25},
    "grain": {"density": 7800.0, "young_modulus": 2.06e9, "poisson_ratio": 0.3},
    "plate": {"density": 7200.0, "young_modulus": 1.98e9, "poisson_ratio": 0.3},
    "grain_contact": {"friction": 0.5, "rolling_friction": 0.04, "restitution": 0.5},
    "plate_contact": {"friction": 0.4, "rolling_friction": 0.03, "restitution": 0.4},
}
SIDE = 0.3e-3  # of the small plate, m: ten median diameters


def small_bed(seed: int = 1) -> powder_bed.Bed:
    return powder_bed.Bed((0.0, 0.0), (SIDE, SIDE), TABLE, seed)


@pytest.fixture(scope="module")
def settled() -> np.ndarray:
    return powder_bed.settle(small_bed())


def gaps(spheres: np.ndarray) -> np.ndarray:
    """Distance between the surfaces of each pair, over the periodic sides [m]."""
    apart = spheres[:, None, :3] - spheres[None, :, :3]
    apart[..., :2] -= SIDE * np.round(apart[..., :2] / SIDE)
    distance = np.sqrt((apart**2).sum(axis=-1)) - spheres[:, None, 3] - spheres[None, :, 3]
    return distance[np.triu_indices(len(spheres), 1)]


def test_diameters_follow_the_cut_log_normal_distribution():
    sizes = TABLE["diameter"]
    drawn = np.sort(powder_bed.draw_diameters(4000, sizes, np.random.Generator(np.random.PCG64(5))))

    def share_below(diameter):
        return 0.5 * (1 + erf(log(diameter / sizes["median"]) / sizes["spread"] / sqrt(2)))

    low, high = share_below(sizes["minimum"]), share_below(sizes["maximum"])
    expected = np.array([(share_below(diameter) - low) / (high - low) for diameter in drawn])
    found = (np.arange(4000) + 0.5) / 4000
    # Kolmogorov and Smirnov: 1.63/sqrt(n) is passed by one drawing in a hundred of the right distribution
    assert np.abs(found - expected).max() < 1.63 / sqrt(4000)
    assert sizes["minimum"] <= drawn[0] and drawn[-1] <= sizes["maximum"]


def test_rain_does_not_overlap():
    centers, diameters = powder_bed.rain(small_bed())
    assert gaps(np.column_stack([centers, diameters / 2])).min() > 0


def test_no_grain_is_lost_or_changed_while_it_settles(settled):
    _, diameters = powder_bed.rain(small_bed())
    assert np.allclose(settled[:, 3], diameters / 2, rtol=1e-9)
    assert (settled[:, :2] >= 0).all() and (settled[:, :2] <= SIDE).all()


def test_grains_rest_on_the_plate_and_on_each_other(settled):
    median = TABLE["diameter"]["median"]
    assert gaps(settled).min() > -1e-3 * median
    assert (settled[:, 2] - settled[:, 3]).min() > -1e-3 * median
    lowest = settled[:, 2] - settled[:, 3] < 1e-2 * median
    touching = (gaps(settled) < 1e-3 * median).sum()
    assert lowest.sum() > 20
    assert touching > 1.5 * (len(settled) - lowest.sum())  # a sphere at rest leans on about three others or the plate


def test_unraked_powder_packs_as_loose_spheres_do(settled):
    # Within half a grain of plate and top the packing is thinner; poured frictional spheres reach 0.55 to 0.63 inside.
    low, high = 22e-6, 62e-6
    z, radius = settled[:, 2], settled[:, 3]
    bottom, top = np.clip(low - z, -radius, radius), np.clip(high - z, -radius, radius)
    slices = np.pi * (radius**2 * (top - bottom) - (top**3 - bottom**3) / 3)
    assert 0.45 < slices.sum() / (SIDE**2 * (high - low)) < 0.66


def test_blade_leaves_nothing_above_the_layer_and_a_bed_of_usual_packing(settled):
    bed = small_bed()
    raked = powder_bed.rake(settled, bed.layer)
    assert (raked[:, 2] + raked[:, 3] <= bed.layer).all()
    # one to two grains deep: measured powder layers of this kind have 0.3 to 0.5
    assert 0.28 < powder_bed.packing_fraction(raked, bed) < 0.5
    assert 24e-6 < np.median(2 * raked[:, 3]) < 33e-6  # grains that stand out of the layer are the greater ones


def test_same_seed_gives_the_same_bed_and_another_seed_another(settled):
    assert np.array_equal(powder_bed.settle(small_bed()), settled)
    other, _ = powder_bed.rain(small_bed(seed=2))
    assert not np.allclose(other[:50], powder_bed.rain(small_bed())[0][:50])


def test_bed_file_reads_back(settled, tmp_path):
    path = tmp_path / "bed.csv"
    powder_bed.write_whole(path, powder_bed.bed_text(small_bed(), settled, "slm_track_150w"))
    assert np.allclose(powder_bed.read_bed(path), settled, rtol=1e-6, atol=1e-12)
    head = path.read_text().splitlines()
    assert head[0].endswith("--seed 1 (scripts/cupel/bed.py)")
    assert '"layer_thickness": 5e-05' in head[3] and "LIGGGHTS" in head[1]


def test_cut_bed_file_is_refused(tmp_path):
    path = tmp_path / "bed.csv"
    path.write_text("x_m,y_m,z_m,radius_m\n1,2,3\n1,2\n")
    with pytest.raises(CupelError, match="no powder bed"):
        powder_bed.read_bed(path)


def test_missing_liggghts_says_how_to_install_it(monkeypatch):
    monkeypatch.setattr(shutil, "which", lambda name: None)
    with pytest.raises(CupelError, match="apt-get install liggghts"):
        powder_bed.settle(small_bed())


def test_case_without_powder_is_refused():
    with pytest.raises(CupelError, match="has no powder bed"):
        powder_bed.bed_of_case({"name": "drop", "bodies": [], "powder": None}, None)


def test_folder_that_cannot_be_written_ends_in_one_line(tmp_path):
    missing = tmp_path / "no" / "bed.csv"
    with pytest.raises(CupelError, match="no such file or folder"):
        powder_bed.write_whole(missing, "text")
    assert os.listdir(tmp_path) == []
