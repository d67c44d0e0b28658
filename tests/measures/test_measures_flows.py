"""Flows with exact histories: vortex, channel, wave, melting front, and a surface held down by recoil."""

from dataclasses import replace

import numpy as np
import pytest
from cupel.exact import capillary_wave_finite_depth, channel_flow, recoil, stefan, taylor_green
from cupel.measures import Elements, MeasureError, Snapshot, measure
from cupel.measures.registry import find_measure
from tests.measures.exact_elements import cells, lattice, particles, scene
from tests.measures.written_results import write_result

FORMS = ["lattice", "jittered", "cells"]


def request(name, between, tolerance=0.01, metric="absolute", value=None):
    return {"name": name, "unit": "", "between": between, "tolerance": tolerance, "metric": metric,
            "reference": {"kind": "exact", "value": value, "source": ""}}


def filled(form, lower, upper, spacing, time=0.0, seed=0, inside=lambda points: np.ones(len(points), bool)):
    """A box of liquid in a form."""
    if form == "cells":
        return cells(inside, np.array(lower), np.array(upper), spacing, 2, time=time)
    points = lattice(lower, upper, spacing, 2)
    points = points[inside(points)]
    if form == "jittered":
        points = points + spacing * np.random.default_rng(seed).uniform(-0.2, 0.2, points.shape) * [1, 0, 1]
    return particles(points, spacing, 2, time=time)


# -- Taylor-Green -------------------------------------------------------------------------------------------------------------

def vortex_case(**more):
    case = scene(0.02, 2, [0, 0, 0], [1, 0, 1], materials={"liquid": {"density": 1.0, "viscosity": 0.01}},
                 bodies=[{"shape": "box", "material": "liquid", "lower": [0, 0, 0], "upper": [1, 0, 1]}])
    case["initial"]["velocity"] = {"field": "taylor_green", "speed": 1.0, "wavelength": 1.0}
    case["time"] = {"end": 1.0, "output_interval": 0.05}
    return case | more


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("factor", [1.0, 1.1])
def test_decay_of_a_vortex_is_read_from_its_energy(form, factor, tmp_path):
    """An error of 10 % in viscosity is seen as one of 10 %; particles are where the flow has them only by chance."""
    case, snapshots = vortex_case(), []
    for index, time in enumerate(np.linspace(0.0, 1.0, 21)):
        made = filled(form, [0, 0, 0], [1, 0, 1], 0.02, time, seed=index)
        snapshots.append(replace(made, velocity=taylor_green.velocity(made.position, time, 1.0, 0.01 * factor, 1.0)))
    case["measures"] = [request("decay_rate", [0.0, 1.0], metric="relative")]
    row, = measure(write_result(tmp_path, snapshots), case)
    assert row["reference"] == pytest.approx(4.0 * 0.01 * (2.0 * np.pi)**2)
    assert row["error"] == pytest.approx(factor - 1.0, abs=0.004)
    assert row["pass"] is (factor == 1.0)


def test_too_few_snapshots_for_a_decay_are_said(tmp_path):
    case = vortex_case()
    snapshots = [replace(filled("lattice", [0, 0, 0], [1, 0, 1], 0.02, time), velocity=np.ones((2500, 3))) for time in (0.0, 0.5)]
    case["measures"] = [request("decay_rate", [0.0, 1.0], metric="relative")]
    row, = measure(write_result(tmp_path, snapshots), case)
    assert row["value"] is None and "only 2 snapshots" in row["note"] and row["pass"] is False


# -- channel ------------------------------------------------------------------------------------------------------------------

DRIVES = {"poiseuille": {"acceleration": 0.8}, "couette": {"upper_speed": 0.3}}


def channel_case(drive, depth=1.0, spacing=0.05):
    case = scene(spacing, 2, [0, 0, 0], [0.4, 0, depth], physics=["flow", "gravity"], gravity=[drive.get("acceleration", 0.0), 0, 0],
                 materials={"liquid": {"density": 2.0, "viscosity": 0.2}},
                 bodies=[{"shape": "box", "material": "liquid", "lower": [0, 0, 0], "upper": [0.4, 0, depth]}])
    case["domain"]["boundaries"] |= {"x_min": {"kind": "periodic"}, "x_max": {"kind": "periodic"}}
    case["domain"]["boundaries"]["z_max"]["velocity"] = [drive.get("upper_speed", 0.0), 0.0, 0.0]
    return case


def channel_snapshot(form, drive, time, change=lambda u: u):
    case = channel_case(drive)
    made = filled(form, [0, 0, 0], [0.4, 0, 1.0], 0.05, time)
    velocity = np.zeros((made.count, 3))
    velocity[:, 0] = change(channel_flow.velocity(made.position[:, 2], time, 1.0, 0.1, **drive))
    return Snapshot(replace(made, velocity=velocity), case)


@pytest.mark.parametrize("drive", DRIVES)
@pytest.mark.parametrize("form", FORMS)
def test_exact_channel_flow_has_no_error_at_any_time(form, drive):
    for time in (0.1, 1.0, 20.0):
        assert find_measure("velocity_profile_error").read(channel_snapshot(form, DRIVES[drive], time)).value < 1e-12


def test_a_profile_that_is_too_fast_has_that_error_and_the_worst_snapshot_counts():
    chosen = find_measure("velocity_profile_error")
    readings = [chosen.read(channel_snapshot("lattice", DRIVES["couette"], 50.0, lambda u: factor * u)) for factor in (1.0, 1.02)]
    # rms of z/H over the depth is 1/sqrt(3)
    assert chosen.combine(readings).value == pytest.approx(0.02 / np.sqrt(3.0), rel=0.01)


def test_flow_across_the_channel_is_an_error_too():
    snapshot = channel_snapshot("lattice", DRIVES["couette"], 50.0)
    velocity = snapshot.elements.velocity + [0.0, 0.0, 0.03]
    reading = find_measure("velocity_profile_error").read(Snapshot(replace(snapshot.elements, velocity=velocity), snapshot.case))
    assert reading.value == pytest.approx(0.1) and reading.beside["across_share"] == pytest.approx(0.1)


def test_a_channel_that_nothing_drives_is_refused():
    with pytest.raises(MeasureError, match="drives"):
        find_measure("velocity_profile_error").read(Snapshot(channel_snapshot("lattice", DRIVES["couette"], 1.0).elements, channel_case({})))


# -- wave ---------------------------------------------------------------------------------------------------------------------

WAVE = (1.0, 1.0, 1.0, np.sqrt(1.0 / 3000.0))


def wave_case(spacing=1.0 / 16.0, depth=1.0):
    body = {"shape": "box", "material": "liquid", "lower": [0, 0, 0], "upper": [1, 0, depth],
            "surface_wave": {"amplitude": 0.0025, "wavelength": 1.0}}
    case = scene(spacing, 2, [0, 0, 0], [1, 0, 2 * depth], bodies=[body],
                 materials={"liquid": {"density": 1.0, "viscosity": WAVE[3], "surface_tension": 1.0}})
    case["domain"]["boundaries"] |= {"x_min": {"kind": "symmetry"}, "x_max": {"kind": "symmetry"}}
    return case


def waving(form, spacing, time, amplitude, depth=1.0, seed=0):
    """Liquid under z = depth + a cos(2 pi x): particles are a lattice raised in proportion to their height, cells have exact fractions."""
    if form == "cells":
        made = filled("cells", [0, 0, 0], [1, 0, 2 * depth], spacing, time)
        x, z, h = made.position[:, 0], made.position[:, 2], 0.5 * spacing
        mean = amplitude * (np.sin(2 * np.pi * (x + h)) - np.sin(2 * np.pi * (x - h))) / (2 * np.pi * spacing)
        return replace(made, fraction=np.clip((depth + mean - (z - h)) / spacing, 0.0, 1.0))
    points = lattice([0, 0, 0], [1, 0, depth], spacing, 2)
    if form == "jittered":
        points = points + spacing * np.random.default_rng(seed).uniform(-0.1, 0.1, points.shape) * [1, 0, 1]
    # sideways so that equal volumes fill the wave: d(shift)/dx = -a k cosh(...) of the potential flow, to first order
    k = 2.0 * np.pi
    phase, rise = k * points[:, 0], amplitude / np.sinh(k * depth)
    shift = np.column_stack([-rise * np.cosh(k * points[:, 2]) * np.sin(phase), 0 * phase, rise * np.sinh(k * points[:, 2]) * np.cos(phase)])
    return particles(points + shift, spacing, 2, time=time)


@pytest.mark.parametrize("form", ["lattice", "cells"])
@pytest.mark.parametrize("cells_a_wave", [8, 16, 32])
def test_exact_wave_of_a_fortieth_of_a_spacing_has_little_error(form, cells_a_wave, tmp_path):
    times = np.linspace(0.0, 1.6, 41)
    exact = capillary_wave_finite_depth.amplitude(times, *WAVE, 1.0)
    snapshots = [waving(form, 1.0 / cells_a_wave, time, 0.0025 * a) for time, a in zip(times, exact)]
    case = wave_case(1.0 / cells_a_wave)
    case["measures"] = [request("wave_error", [0.0, 1.6])]
    row, = measure(write_result(tmp_path, snapshots), case)
    # each particle stands for its layer by its middle: (k dx)^2/24 of the wave, whose rms is half its amplitude
    limit = 1e-6 if form == "cells" else 0.5 * (2.0 * np.pi / cells_a_wave)**2 / 24.0
    assert row["value"] < limit, row["value"]


@pytest.mark.parametrize("form", ["lattice", "cells"])
def test_solid_below_a_film_takes_no_part_in_its_wave(form):
    """The film's depth is that of the liquid body, and what stands below it cancels."""
    case, spacing, depth = wave_case(1.0 / 16.0, 0.25), 1.0 / 16.0, 0.25
    above = waving(form, spacing, 0.0, 0.0025, depth)
    solid = lattice([0, 0, -depth], [1, 0, 0], spacing, 2)
    below = particles(solid, spacing, 2) if form == "lattice" else filled("cells", [0, 0, -depth], [1, 0, 0], spacing, 0.0)
    both = replace(above, **{name: np.concatenate([getattr(below, name), getattr(above, name)])
                             for name in ("position", "fraction", "volume", "extent") if getattr(above, name, None) is not None})
    with_solid = {**case, "bodies": [{"shape": "box", "material": "liquid", "state": "solid", "lower": [0, 0, -depth], "upper": [1, 0, 0]},
                                     *case["bodies"]]}
    read = find_measure("wave_error").read
    alone, joined = read(Snapshot(above, case)), read(Snapshot(both, with_solid))
    assert joined.kept[1].depth == depth == alone.kept[1].depth
    assert joined.beside["amplitude_m"] == pytest.approx(alone.beside["amplitude_m"], rel=1e-9)


def test_a_wave_of_another_frequency_is_wrong_by_what_it_is_wrong(tmp_path):
    times = np.linspace(0.0, 1.6, 41)
    exact = capillary_wave_finite_depth.amplitude(times, *WAVE, 1.0)
    wrong = capillary_wave_finite_depth.amplitude(1.02 * times, *WAVE, 1.0)
    snapshots = [waving("lattice", 1.0 / 16.0, time, 0.0025 * a) for time, a in zip(times, wrong)]
    case = wave_case()
    case["measures"] = [request("wave_error", [0.0, 1.6])]
    row, = measure(write_result(tmp_path, snapshots), case)
    assert row["value"] == pytest.approx(np.sqrt(((wrong - exact)**2).mean()), rel=0.03)


def test_jitter_of_particles_at_rest_does_not_grow_into_a_wave():
    """The moment sees positions, not a contour: 10 % of a spacing at random is less than a tenth of the amplitude."""
    chosen, case = find_measure("wave_error"), wave_case()
    amplitudes = [chosen.read(Snapshot(waving("jittered", 1.0 / 16.0, 0.0, 0.0, seed=seed), case)).beside["amplitude_m"] for seed in range(20)]
    assert np.std(amplitudes) < 1.5 * 0.0025     # one snapshot of unrelated positions; a solver's follow the flow


def test_too_few_snapshots_of_a_wave_are_said(tmp_path):
    case = wave_case()
    case["measures"] = [request("wave_error", [0.0, 1.6])]
    row, = measure(write_result(tmp_path, [waving("lattice", 1.0 / 16.0, time, 0.0025) for time in (0.0, 0.4, 0.8, 1.2, 1.6)]), case)
    assert row["value"] is None and "snapshots a period" in row["note"]


def test_a_domain_of_three_quarters_of_a_wave_is_refused():
    case = wave_case()
    case["domain"]["upper"][0] = 0.75
    with pytest.raises(MeasureError, match="whole number of half"):
        find_measure("wave_error").read(Snapshot(waving("lattice", 1.0 / 16.0, 0.0, 0.0025), case))


# -- film ---------------------------------------------------------------------------------------------------------------------

def film(form, spacing, crest):
    """A film a quarter deep with the wave a = `crest` of half the domain's length on it, solid as deep below it."""
    above = waving(form, spacing, 0.0, 0.0, 0.25)
    if form == "lattice":
        points = above.position.copy()
        points[:, 0] -= crest / 0.25 / (4.0 * np.pi) * np.sin(4.0 * np.pi * points[:, 0])   # depth 0.25 + crest cos(4 pi x)
        above = replace(above, position=points)
    solid = lattice([0, 0, -0.25], [1, 0, 0], spacing, 2)
    below = particles(solid, spacing, 2) if form == "lattice" else filled("cells", [0, 0, -0.25], [1, 0, 0], spacing, 0.0)
    both = replace(above, **{name: np.concatenate([getattr(below, name), getattr(above, name)])
                             for name in ("position", "fraction", "volume", "extent") if getattr(above, name, None) is not None})
    return replace(both, liquid_fraction=np.repeat([0.0, 1.0], [below.count, above.count]))


@pytest.mark.parametrize("form", ["lattice", "cells"])
def test_an_even_film_on_its_solid_is_even(form):
    reading = find_measure("film_unevenness").read(Snapshot(film(form, 1.0 / 16.0, 0.0), wave_case(1.0 / 16.0, 0.25)))
    assert reading.value < 1e-12 and reading.beside["mean_depth_m"] == pytest.approx(0.25)


def test_a_film_with_a_wave_is_uneven_by_its_root_mean_square():
    reading = find_measure("film_unevenness").read(Snapshot(film("lattice", 1.0 / 64.0, 0.025), wave_case(1.0 / 64.0, 0.25)))
    assert reading.value == pytest.approx(0.1 / np.sqrt(2.0), rel=0.01)


def test_a_film_of_nothing_is_refused():
    frozen = replace(film("lattice", 1.0 / 16.0, 0.0), liquid_fraction=np.zeros(128))
    with pytest.raises(MeasureError, match="nothing is molten"):
        find_measure("film_unevenness").read(Snapshot(frozen, wave_case(1.0 / 16.0, 0.25)))


# -- melting front ------------------------------------------------------------------------------------------------------------

STEEL = {"density": 6900.0, "specific_heat": 780.0, "conductivity": 25.0, "latent_heat": 247000.0, "melting_temperature": 1723.0}


def stefan_case(axis="z", rise=300.0, length=1e-3, spacing=5e-5):
    upper = [length, 0.0, 16e-4] if axis == "x" else [16e-4, 0.0, length]
    case = scene(spacing, 2, [0, 0, 0], upper, materials={"liquid": dict(STEEL)}, time={"end": 0.02, "output_interval": 0.01},
                 bodies=[{"shape": "box", "material": "liquid", "lower": [0, 0, 0], "upper": upper}])
    case["domain"]["boundaries"][f"{axis}_min"]["temperature"] = 1723.0 + rise
    return case


@pytest.mark.parametrize("axis", ["x", "z"])
@pytest.mark.parametrize("form", FORMS)
def test_front_of_stefan_is_found_between_elements_and_judged_at_its_time(form, axis, tmp_path):
    case, spacing = stefan_case(axis), 5e-5
    beta = stefan.front_coefficient(780.0 * 300.0 / 247000.0)
    assert beta == pytest.approx(0.60693, abs=1e-5)
    snapshots = []
    for time in (0.0, 0.01, 0.02):
        made = filled(form, [0, 0, 0], case["domain"]["upper"], spacing, time)
        front = float(stefan.front(np.array(time), beta, 25.0 / (6900.0 * 780.0)))
        place = made.position[:, {"x": 0, "z": 2}[axis]]
        liquid = np.clip((front - place) / spacing + 0.5, 0.0, 1.0)
        snapshots.append(replace(made, liquid_fraction=liquid))
    for end in (0.01, 0.02):
        case["measures"] = [request("front_position", [0.0, end], 0.003, "relative")]
        row, = measure(write_result(tmp_path / f"{end}", snapshots), case)
        assert row["reference"] == pytest.approx(2.0 * beta * np.sqrt(25.0 / (6900.0 * 780.0) * end))
        assert abs(row["error"]) < (8e-3 if form == "jittered" else 1e-9), row     # three deviations of 32 columns moved by 0.2 spacings


def test_a_reference_in_the_case_file_that_is_not_the_exact_one_is_told(tmp_path):
    case = stefan_case()
    made = replace(filled("lattice", [0, 0, 0], case["domain"]["upper"], 5e-5, 0.02), liquid_fraction=np.zeros(640))
    case["measures"] = [request("front_position", [0.0, 0.02], 0.003, "relative", value=1e-4)]
    row, = measure(write_result(tmp_path, [made]), case)
    assert row["reference"] == 1e-4 and "computed from the case it is" in row["note"]


# -- recoil -------------------------------------------------------------------------------------------------------------------

HOT = {"density": 6900.0, "viscosity": 6e-3, "surface_tension": 1.2, "boiling_temperature": 3050.0, "vaporization_heat": 6.1e6,
       "molar_mass": 0.0558}
SPOT = {"center": [0.0, 0.0, 0.0], "radius": 8e-5, "rise": 1100.0}


def dented_surface(dimensions, tension_of, pulls_along, warm=1650.0, count=4001):
    """r (n), height (n) of a surface at rest under the spot's recoil, and the pressure of the liquid under it; axial in 3-D.

    sigma (d sin(phi)/dr [+ sin(phi)/r]) = p_r - p, or with sigma inside the derivative where Marangoni stress pulls along; phi(0) = 0;
    p chosen so that the surface is flat at r = 2.5 spot radii.
    """
    r = np.linspace(0.0, 2.5 * SPOT["radius"], count)
    temperature = warm + SPOT["rise"] * np.exp(-2.0 * r**2 / SPOT["radius"]**2)
    push, tension = recoil.recoil_pressure(temperature, 3050.0, 6.1e6, 0.0558, 101325.0), tension_of(temperature)
    weight = r if dimensions == 3 else np.ones(count)
    share = np.ones(count) if pulls_along else 1.0 / tension

    def gathered(values):
        return np.concatenate([[0.0], np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(r))])

    pressure = gathered(weight * push * share)[-1] / gathered(weight * share)[-1]
    sine = gathered(weight * (push - pressure) * share) / np.maximum(weight, 1e-300) / (tension if pulls_along else 1.0)
    sine[0] = 0.0
    height = gathered(sine / np.sqrt(1.0 - sine**2))
    return r, height - height[-1], pressure


def recoil_snapshot(form, dimensions, pressure_factor=1.0, tension_factor=1.0, slope=0.0, pulls_along=False, spacing=5e-6):
    half = 2.4e-4 if dimensions == 2 else 1.3e-4
    depth = 1.2e-4
    lower = np.array([-half, 0.0 if dimensions == 2 else -half, -depth])
    upper = np.array([half, 0.0 if dimensions == 2 else half, 6e-5])
    r, surface, pressure = dented_surface(dimensions, lambda T: 1.2 + slope * (T - 1723.0), pulls_along)
    assert surface.min() < -0.9 * spacing     # a dent that the elements can see

    def inside(points):
        return points[:, 2] <= np.interp(np.linalg.norm(points[:, :dimensions - 1], axis=1), r, surface)

    if form == "cells":
        made = cells(inside, lower, upper, spacing, dimensions, finer=6 if dimensions == 3 else 10)
    else:
        points = lattice(lower, [upper[0], upper[1], 0.0], spacing, dimensions)
        top = np.interp(np.linalg.norm(points[:, :dimensions - 1], axis=1), r, surface)
        points[:, 2] += top * (1.0 + points[:, 2] / depth)       # layers that follow the surface, as a solver's do
        made = particles(points, spacing, dimensions)
        made = replace(made, volume=made.volume * (1.0 + top / depth))
    away = np.linalg.norm(made.position[:, :dimensions - 1], axis=1)
    temperature = 1650.0 + SPOT["rise"] * np.exp(-2.0 * away**2 / SPOT["radius"]**2)
    material = HOT | {"surface_tension": 1.2 * tension_factor, "surface_tension_slope": slope, "surface_tension_reference_temperature": 1723.0}
    case = scene(spacing, dimensions, list(lower), list(upper), materials={"liquid": material},
                 physics=["flow", "surface_tension", "recoil"] + (["marangoni"] if pulls_along else []),
                 bodies=[{"shape": "box", "material": "liquid", "lower": list(lower), "upper": [upper[0], upper[1], 0.0]}],
                 surrounding={"material": "gas", "resolved": False, "pressure": 101325.0},
                 initial={"temperature": 1650.0, "temperature_gradient": [0, 0, 0], "hot_spot": SPOT})
    case["domain"]["boundaries"]["z_max"] = {"kind": "open"}
    return Snapshot(replace(made, temperature=temperature, pressure=np.where(made.fraction > 0.5, pressure_factor * pressure, 0.0)), case)


@pytest.mark.parametrize("dimensions", [2, 3])
@pytest.mark.parametrize("form", ["layers", "cells"])
def test_a_surface_in_balance_has_no_recoil_error(form, dimensions):
    reading = find_measure("recoil_balance_error").read(recoil_snapshot(form, dimensions))
    assert reading.value < 0.01, reading
    assert reading.beside["surface_tension_N"] > 0.1 * reading.beside["recoil_N"]


@pytest.mark.parametrize("pulls_along", [False, True])
def test_tension_that_falls_with_temperature_is_counted_as_the_physics_have_it(pulls_along):
    chosen = find_measure("recoil_balance_error")
    snapshot = recoil_snapshot("cells", 2, slope=-4.3e-4, pulls_along=pulls_along)
    assert chosen.read(snapshot).value < 0.01
    other = dict(snapshot.case, physics=["flow"] if pulls_along else ["flow", "marangoni"])
    assert chosen.read(Snapshot(snapshot.elements, other)).value > 0.03


def test_a_wrong_pressure_or_tension_is_an_error_of_its_share():
    chosen = find_measure("recoil_balance_error")
    right = chosen.read(recoil_snapshot("cells", 2)).beside
    off = chosen.read(recoil_snapshot("cells", 2, pressure_factor=1.3)).value
    assert off == pytest.approx(0.3 * right["liquid_pressure_N"] / right["recoil_N"], abs=0.012)
    weak = chosen.read(recoil_snapshot("cells", 2, tension_factor=0.75)).value
    assert weak == pytest.approx(0.25 * right["surface_tension_N"] / right["recoil_N"], abs=0.012)


def test_ringing_of_the_pressure_cancels_over_snapshots_and_a_lasting_imbalance_does_not():
    chosen = find_measure("recoil_balance_error")
    high, low, right = (chosen.read(recoil_snapshot("layers", 2, pressure_factor=factor)) for factor in (1.5, 0.5, 1.0))
    assert min(high.value, low.value) > 0.05
    assert chosen.combine(2000 * [high, low]).value == pytest.approx(right.value, abs=1e-3)
    assert chosen.combine([high, high, high]).value == pytest.approx(high.value)
    few = chosen.combine([high, low])      # two snapshots do not show that a balance holds
    assert few.value > 0.1 and "over 2 snapshots" in few.note


def test_elements_keep_pressure_through_files(tmp_path):
    made = Elements(np.zeros((2, 3)), np.ones(2), np.ones(2), pressure=np.array([1.5, -2.0]))
    from cupel.measures import read_series

    assert read_series(write_result(tmp_path, [made])).load(0).pressure == pytest.approx([1.5, -2.0])
