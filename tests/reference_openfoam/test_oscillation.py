"""A drop that oscillates, at 25 cells a diameter: frequency against the normal mode of the viscous drop."""

from __future__ import annotations

import numpy as np
import pytest

from tests.reference_openfoam import small_cases


def test_a_drop_of_25_cells_a_diameter_has_the_frequency_of_its_normal_mode(tmp_path):
    # rho = sigma = R = 1, La = 400, mode 2 in the plane: angular frequency 2.42587 (validation_cases/oscillating_drop_2d); its motion comes
    # to rest twice a period
    sides = {side: {"kind": "wall", "slip": "free_slip"} for side in ("x_min", "x_max", "z_min", "z_max")}
    data = small_cases.case(
        spacing=0.08, dimensions=2, physics=["flow", "surface_tension"],
        materials={"liquid": {"density": 1.0, "viscosity": 0.05, "surface_tension": 1.0}, "gas": {"density": 1e-3, "viscosity": 5e-5}},
        surrounding={"material": "gas", "resolved": False, "temperature": 300.0, "pressure": 101325.0, "convection_coefficient": 0.0},
        domain={"lower": [-2.0, 0.0, -2.0], "upper": [2.0, 0.0, 2.0], "boundaries": sides},
        bodies=[{"shape": "sphere", "material": "liquid", "state": "liquid", "center": [0.0, 0.0, 0.0], "radius": 1.0,
                 "perturbation": {"mode": 2, "amplitude": 0.01}}],
        time={"end": 5.6, "output_interval": 0.02})
    record = small_cases.completed(data, tmp_path)
    history = small_cases.history(tmp_path)
    time, energy = history["time_s"], history["kinetic_energy_J"]
    rest = np.flatnonzero((energy[1:-1] < energy[:-2]) & (energy[1:-1] < energy[2:]) & (energy[1:-1] < 0.05*energy.max())) + 1
    rest = rest[time[rest] > 1.0]                                       # the released drop takes half a period to its normal mode
    assert len(rest) == 4
    moments = []
    for i in rest:                                                      # the lowest point of a parabola through the three
        bend = np.polyfit(time[i - 1:i + 2] - time[i], energy[i - 1:i + 2]/energy.max(), 2)
        moments.append(time[i] - 0.5*bend[1]/bend[0])
    assert np.pi*3/(moments[-1] - moments[0]) == pytest.approx(2.42587, rel=0.01)
    assert record["ledgers"]["volume"]["closure"] < 1e-9
