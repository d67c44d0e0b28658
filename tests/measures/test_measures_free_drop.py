"""A free drop: the moment of its shape, its oscillation, the pressure inside, the currents around it, its migration."""

from dataclasses import replace

import numpy as np
import pytest
from cupel.exact import oscillating_drop, thermocapillary_drop, thermocapillary_start_up
from cupel.measures import MeasureError, Snapshot, measure
from cupel.measures.drop import drop_state, shape_amplitude
from cupel.measures.history import damped_oscillation, straight_line, too_few
from cupel.measures.migration import gradient_of, ma_bothe_units
from cupel.measures.oscillation import normal_mode
from cupel.measures.registry import find_measure
from tests.measures.exact_elements import scene
from tests.measures.free_drops import drop_scene, shaped, with_pressure
from tests.measures.written_results import write_result


def amplitude(elements, case, mode=2):
    return shape_amplitude(drop_state(Snapshot(elements, case)), mode, case["dimensions"])


@pytest.mark.parametrize("dimensions", [2, 3])
@pytest.mark.parametrize("form", ["lattice", "jittered", "cells"])
def test_a_thousandth_of_the_radius_is_seen_at_20_spacings_a_diameter(form, dimensions):
    case = drop_scene(dimensions)
    rest = amplitude(shaped(form, dimensions), case)
    for a in (0.001, 0.01, -0.01):
        seen = amplitude(shaped(form, dimensions, amplitude=a), case) - rest
        # cells by 8 points an edge are known to 2e-4 of the radius themselves
        assert seen == pytest.approx(a, abs=2e-4 if form == "cells" else 2e-5, rel=0.02)
    assert abs(rest) < 0.01     # what a jittered lattice has by itself


def test_other_modes_do_not_enter():
    case = drop_scene()
    assert amplitude(shaped("cells", amplitude=0.05, mode=3), case, 2) == pytest.approx(amplitude(shaped("cells"), case, 2), abs=3e-4)
    assert amplitude(shaped("cells", amplitude=0.05, mode=3), case, 3) == pytest.approx(0.05, abs=1e-3)


def test_a_grain_far_away_does_not_move_the_drop():
    case, made = drop_scene(half=60.0), shaped("lattice", amplitude=0.01)
    stray = replace(made.take(np.array([0])), position=np.array([[55.0, 0.0, 0.0]]))
    both = type(made).joined([made, stray])
    assert amplitude(both, case) == pytest.approx(amplitude(made, case), abs=1e-12)


def test_a_quarter_with_symmetry_planes_is_the_whole_drop():
    case = drop_scene()
    whole = shaped("cells", amplitude=0.01, center=(0.0, 0.0, 0.0))
    quarter = whole.take((whole.position[:, 0] > 0.0) & (whole.position[:, 2] > 0.0))
    case["domain"]["lower"] = [0.0, 0.0, 0.0]
    case["domain"]["boundaries"] |= {"x_min": {"kind": "symmetry"}, "z_min": {"kind": "symmetry"}}
    assert amplitude(quarter, case) == pytest.approx(amplitude(whole, drop_scene()), abs=1e-12)


def oscillating(form, case, periods=4.0, snapshots=80, a=0.01):
    """Snapshots of a drop released from rest, exact in time."""
    drop, material = case["bodies"][0], case["materials"]["liquid"]
    omega, _ = normal_mode(case)
    times = np.linspace(0.0, periods * 2.0 * np.pi / omega, snapshots)
    exact = oscillating_drop.amplitude(times, material["surface_tension"], material["density"], drop["radius"], material["viscosity"],
                                       2, case["dimensions"])
    return [shaped(form, case["dimensions"], amplitude=a * value, time=time, seed=1) for time, value in zip(times, exact)]


def test_a_resolved_surrounding_takes_part_in_the_reference():
    free, heavy = drop_scene(), drop_scene(resolved=True)
    heavy["materials"]["gas"] = {"density": 0.5, "viscosity": 0.1}
    assert normal_mode(heavy)[0] < 0.85 * normal_mode(free)[0]
    assert find_measure("oscillation_period").exact(heavy) == pytest.approx(np.sqrt(1.5) * find_measure("oscillation_period").exact(free))


def requests(case, *names):
    end = case["time"]["end"]
    return [{"name": name, "unit": "", "between": [0.0, end], "tolerance": 0.005, "metric": "relative",
             "reference": {"kind": "exact", "value": None, "source": ""}} for name in names]


@pytest.mark.parametrize("form", ["lattice", "jittered", "cells"])
def test_frequency_and_decay_of_one_percent_of_mode_two(form, tmp_path):
    case = drop_scene(2)
    snapshots = oscillating(form, case, snapshots=48 if form == "cells" else 80)
    case["time"] = {"end": snapshots[-1].time, "output_interval": snapshots[1].time}
    case["measures"] = requests(case, "oscillation_frequency", "oscillation_decay", "oscillation_period")
    frequency, decay, period = measure(write_result(tmp_path, snapshots), case)
    assert frequency["error"] == pytest.approx(0.0, abs=0.002)      # 0.0003 of it from the start, which is no normal mode yet
    assert abs(decay["error"]) < (0.05 if form == "cells" else 0.01)
    assert period["value"] == pytest.approx(2.0 * np.pi / frequency["value"])
    assert 0.0 < frequency["uncertainty"] < 0.005 * frequency["value"]
    assert frequency["reference"] == pytest.approx(normal_mode(case)[0])


def test_three_dimensional_drop_has_the_period_of_rayleigh(tmp_path):
    case = drop_scene(3)
    case["materials"]["liquid"]["viscosity"] = 0.005
    snapshots = oscillating("jittered", case, periods=2.0, snapshots=24)
    case["time"] = {"end": snapshots[-1].time, "output_interval": snapshots[1].time}
    case["measures"] = requests(case, "oscillation_period")
    period, = measure(write_result(tmp_path, snapshots), case)
    assert period["pass"] and abs(period["error"]) < 0.002


def test_too_few_snapshots_a_period_are_said_and_not_fitted(tmp_path):
    case = drop_scene()
    snapshots = oscillating("lattice", case, periods=4.0, snapshots=20)
    case["time"] = {"end": snapshots[-1].time, "output_interval": snapshots[1].time}
    case["measures"] = requests(case, "oscillation_frequency")
    row, = measure(write_result(tmp_path, snapshots), case)
    assert row["value"] is None and row["pass"] is False
    assert "snapshots a period" in row["note"] and "8 are needed" in row["note"] and "output_interval" in row["note"]
    assert "periods" in too_few(np.linspace(0.0, 0.5, 20), 1.0)


def test_a_drop_that_only_creeps_is_no_oscillation(tmp_path):
    case = drop_scene()
    times = np.linspace(0.0, 4.0 * 2.0 * np.pi / normal_mode(case)[0], 60)
    random = np.random.default_rng(0)
    snapshots = [shaped("lattice", amplitude=float(random.normal(0.0, 0.002)), time=time) for time in times]
    case["time"] = {"end": times[-1], "output_interval": times[1]}
    case["measures"] = requests(case, "oscillation_frequency")
    row, = measure(write_result(tmp_path, snapshots), case)
    assert "not a damped oscillation" in row["note"]


def test_standard_errors_are_those_of_repeated_trials():
    t = np.linspace(0.0, 12.0, 120)
    clean = np.exp(-0.2 * t) * np.cos(2.4 * t) + 0.1
    found = [damped_oscillation(t, clean + np.random.default_rng(seed).normal(0.0, 0.02, len(t)), 2.4) for seed in range(40)]
    spread = np.std([fit.frequency for fit in found]), np.std([fit.decay for fit in found])
    stated = np.mean([fit.frequency_error for fit in found]), np.mean([fit.decay_error for fit in found])
    assert stated == pytest.approx(spread, rel=0.35)
    assert np.mean([fit.frequency for fit in found]) == pytest.approx(2.4, abs=3.0 * spread[0] / np.sqrt(40.0))


def test_slow_deviations_make_a_slope_less_sure_than_noise_does():
    t = np.linspace(0.0, 1.0, 200)
    noise = straight_line(t, t + 0.01 * np.random.default_rng(1).normal(size=200))
    slow = straight_line(t, t + 0.014 * np.sin(9.0 * t))
    assert slow.slope_error > 4.0 * noise.slope_error


@pytest.mark.parametrize("dimensions", [2, 3])
@pytest.mark.parametrize("form", ["jittered", "cells"])
def test_pressure_inside_less_pressure_outside(form, dimensions):
    case = drop_scene(dimensions)
    made = with_pressure(shaped(form, dimensions), inside=5.3, outside=1.1, noise=0.2)
    reading = find_measure("laplace_pressure").read(Snapshot(made, case))
    expected = 4.2 if form == "cells" else 5.3      # particles alone: a free surface, nothing outside
    assert reading.value == pytest.approx(expected, abs=0.06)
    assert find_measure("laplace_pressure").exact(case) == pytest.approx((dimensions - 1) * 10.0 / 10.0)


def test_pressure_near_the_surface_does_not_count():
    case, made = drop_scene(), shaped("lattice")
    r = np.linalg.norm(made.position - drop_state(Snapshot(made, case)).center, axis=1)
    made = replace(made, pressure=np.where(r < 7.0, 1.0, 99.0))
    assert find_measure("laplace_pressure").read(Snapshot(made, case)).value == pytest.approx(1.0)


@pytest.mark.parametrize("resolved, speed", [(False, 0.02), (True, 0.5)])
def test_spurious_capillary_number_is_of_the_worst_moment_and_of_what_the_case_resolves(resolved, speed):
    case, measured = drop_scene(resolved=resolved), find_measure("spurious_capillary_number")
    readings = []
    for factor in (0.3, 1.0):
        made = shaped("cells")
        velocity = np.zeros((made.count, 3))
        velocity[np.argmax(made.fraction), 2] = -0.02 * factor      # in the drop
        velocity[np.argmin(made.fraction), 0] = 0.5 * factor        # in the gas
        readings.append(measured.read(Snapshot(replace(made, velocity=velocity), case)))
    assert measured.combine(readings).value == pytest.approx(speed * 0.5 / 10.0)


def migrating(form="cells", speed=0.05):
    case = drop_scene(2)
    made = shaped(form)
    velocity = np.zeros((made.count, 3))
    velocity[:, 2] = np.where(made.fraction > 0.0, speed, -7.0)
    case["initial"] = {"temperature": 300.0, "temperature_gradient": [0.0, 0.0, 5.0]}
    return Snapshot(replace(made, velocity=velocity), case)


@pytest.mark.parametrize("form", ["cells", "jittered"])
def test_velocity_is_of_the_drop_alone_and_positive_toward_the_hot_side(form):
    assert find_measure("drop_velocity").read(migrating(form)).value == pytest.approx(0.05, rel=1e-6)
    assert find_measure("drop_velocity").read(migrating(form, -0.05)).value == pytest.approx(-0.05, rel=1e-6)


def test_gradient_between_walls_is_used_where_there_is_no_initial_one():
    case = drop_scene()
    case["domain"]["boundaries"]["z_min"]["temperature"], case["domain"]["boundaries"]["z_max"]["temperature"] = 290.0, 322.0
    assert gradient_of(case) == pytest.approx([0.0, 0.0, 1.0])
    with pytest.raises(MeasureError, match="no gradient"):
        gradient_of(drop_scene())


def ma_bothe_case(a=1.44e-3, spacing=1.44e-4):
    bulk = {"density": 500.0, "viscosity": 0.024, "conductivity": 2.4e-6, "specific_heat": 1e-4}
    drop = {name: 0.5 * value for name, value in bulk.items()} | {"surface_tension": 0.01, "surface_tension_slope": -0.002}
    body = {"shape": "sphere", "material": "drop", "state": "liquid", "center": [0.0, 0.0, 2 * a], "radius": a}
    return scene(spacing, 2, [-2 * a, 0.0, 0.0], [2 * a, 0.0, 4 * a], materials={"bulk": bulk, "drop": drop}, bodies=[body],
                 surrounding={"material": "bulk", "resolved": True},
                 initial={"temperature": 290.0, "temperature_gradient": [0.0, 0.0, 200.0]})


def test_the_drop_of_ma_and_bothe_has_their_units_and_no_other_drop_has():
    speed, time = ma_bothe_units(ma_bothe_case())
    assert (speed, time) == pytest.approx((0.024, 0.06))
    case = ma_bothe_case()
    case["materials"]["bulk"]["viscosity"] = 0.03
    with pytest.raises(MeasureError, match="number is|ratio is"):
        ma_bothe_units(case)


def test_migration_error_is_the_greatest_distance_to_the_table_over_the_plateau(tmp_path):
    case, snapshots = ma_bothe_case(), []
    spacing, a = 1.44e-4, 1.44e-3
    base = shaped("cells")
    for moment in np.linspace(0.0, 1.2, 25):
        value = thermocapillary_drop.ma_bothe(max(moment, 0.102)) + (0.0141 if abs(moment - 0.6) < 0.01 else 0.001)
        velocity = np.zeros((base.count, 3))
        velocity[:, 2] = 0.024 * value
        snapshots.append(replace(base, position=base.position * spacing + [0.0, 0.0, 2 * a], volume=base.volume * spacing**3,
                                 extent=base.extent * spacing, velocity=velocity, time=0.06 * moment))
    case["time"] = {"end": 0.072, "output_interval": 0.003}
    case["measures"] = [{"name": "migration_error", "unit": "1", "between": [0.0, 0.072], "tolerance": 0.04, "metric": "absolute",
                         "reference": {"kind": "tabulated", "value": None, "source": "Ma and Bothe 2011"}}]
    row, = measure(write_result(tmp_path, snapshots), case)
    assert row["value"] == pytest.approx(0.1, rel=1e-3) and row["pass"] is False and row["reference"] == 0.0
    case["measures"][0]["name"] = "migration_error_sharp_interface"
    row, = measure(write_result(tmp_path / "sharp", snapshots), case)
    moments = np.linspace(0.15, 1.2, 22)
    expected = np.abs(thermocapillary_drop.ma_bothe(moments) + 0.001 - thermocapillary_drop.fitted(moments)).max()
    assert row["value"] == pytest.approx(expected / 0.15113, rel=1e-3) and row["pass"] is False


def test_start_up_error_is_the_greatest_distance_to_the_exact_start_over_its_limit(tmp_path):
    case, spacing, a = ma_bothe_case(), 1.44e-4, 1.44e-3
    base, snapshots = shaped("cells"), []
    fluids = [thermocapillary_start_up.Fluid(*(case["materials"][name][key] for key in ("density", "viscosity", "conductivity", "specific_heat")))
              for name in ("drop", "bulk")]
    for moment in (0.0, 0.01, 0.02, 0.03):
        velocity = np.zeros((base.count, 3))
        velocity[:, 2] = thermocapillary_start_up.velocity(np.array([moment]), -0.002, 200.0, a, *fluids)[0] - (4e-4 if moment == 0.02 else 1e-4)
        snapshots.append(replace(base, position=base.position * spacing + [0.0, 0.0, 2 * a], volume=base.volume * spacing**3,
                                 extent=base.extent * spacing, velocity=velocity, time=moment))
    case["time"] = {"end": 0.03, "output_interval": 0.01}
    case["measures"] = [{"name": "start_up_error", "unit": "1", "between": [0.005, 0.03], "tolerance": 0.05, "metric": "absolute",
                         "reference": {"kind": "exact", "value": None, "source": "Laplace transform"}}]
    row, = measure(write_result(tmp_path, snapshots), case)
    limit = 0.024 * 2.0 / 9.0
    assert row["value"] == pytest.approx(4e-4 / limit, rel=1e-6) and row["pass"] is False and row["reference"] == 0.0
