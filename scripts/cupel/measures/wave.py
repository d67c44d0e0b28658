"""Standing capillary wave: amplitude of the surface in each snapshot against the exact initial-value solution.

    a = (2/L) integral of cos(k (x - x_0)) over the liquid = (2/L) sum V f cos(k (x - x_0)) (in 3-D over L times the width)

L the length of the domain along x, a whole number of half waves; x_0 the lower end of the body, where its crest is. Elements inside the
liquid, and those of its solid below it, cancel, so a sees waves far below the spacing. Cells are averages over their width, which their weight puts right.

    wave_error   root mean square over the snapshots of `between` of (a - a_exact)/a_0; reference 0
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..exact import capillary_wave, capillary_wave_finite_depth as exact
from .history import SNAPSHOTS_A_PERIOD, Sample, arrays
from .registry import MeasureError, Reading, measure_of_snapshot
from .snapshot import Snapshot, look_up, primary_bodies, primary_material


@dataclass(frozen=True)
class Wave:
    """The wave of a case: amplitude and wavelength m, crest x m, length of the domain and its breadth m, mean depth m."""

    amplitude: float
    wavelength: float
    crest: float
    length: float
    breadth: float
    depth: float
    slip: bool
    material: dict

    @property
    def period(self) -> float:
        """Period (s) without viscosity on deep liquid."""
        return 2.0 * np.pi / capillary_wave.inviscid_frequency(
            self.material["surface_tension"], self.material["density"], self.wavelength)

    def exact(self, time: np.ndarray) -> np.ndarray:
        """Exact amplitude over the first one at times (n) s."""
        return exact.amplitude(time, self.material["surface_tension"], self.material["density"], self.wavelength,
                               self.material["viscosity"], self.depth, self.slip)


def wave_of(case: dict) -> Wave:
    """The wave of a resolved case.

    Errors: MeasureError unless one box of primary liquid has a surface wave of which the domain holds whole half waves.
    """
    bodies = [body for body in primary_bodies(case) if body.get("state", "liquid") == "liquid"]
    shape = bodies[0].get("surface_wave") if len(bodies) == 1 and bodies[0].get("shape") == "box" else None
    if not shape:
        raise MeasureError("resolved case: the wave is known for one box of liquid with a surface_wave")
    box, domain = bodies[0], case["domain"]
    crest, wavelength = float(box["lower"][0]), float(look_up(shape, "wavelength"))
    length = float(domain["upper"][0] - domain["lower"][0])
    halves = 2.0 * length / wavelength
    if abs(halves - round(halves)) > 1e-6 * halves or round(halves) < 1:
        raise MeasureError(f"resolved case: the domain is {halves / 2.0:.6g} wavelengths long; it must be a whole number of half ones")
    bottom = max(float(box["lower"][2]), float(domain["lower"][2]))
    floor = domain["boundaries"].get("z_min") or {}
    slip = floor.get("kind") == "symmetry" or floor.get("slip") in ("slip", "free_slip")
    breadth = float(domain["upper"][1] - domain["lower"][1]) if case["dimensions"] == 3 else 1.0
    return Wave(float(look_up(shape, "amplitude")), wavelength, crest, length, breadth, float(box["upper"][2]) - bottom, slip,
                primary_material(case, "surface_tension", "density", "viscosity"))


def _against_exact(readings: list[Reading]) -> Reading:
    wave: Wave = readings[0].kept[1]
    time, amplitude = arrays([reading.kept[0] for reading in readings])
    error = amplitude / wave.amplitude - wave.exact(time)
    notes = []
    rate = wave.period * (len(time) - 1) / (time[-1] - time[0]) if len(time) > 1 else 0.0
    if rate < SNAPSHOTS_A_PERIOD:
        notes.append(f"only {rate:.1f} snapshots a period of {wave.period:.4g} s, {SNAPSHOTS_A_PERIOD:g} are needed: "
                     "make time.output_interval smaller")
        return Reading(None, note="; ".join(notes))
    return Reading(float(np.sqrt((error**2).mean())))


@measure_of_snapshot("wave_error", unit="1", exact=lambda case: 0.0, combine=_against_exact)
def wave_error(snapshot: Snapshot) -> Reading:
    case, elements = snapshot.case, snapshot.elements
    wave = wave_of(case)
    weight = elements.content(case["dimensions"], case["spacing"]) * elements.fraction
    phase = 2.0 * np.pi / wave.wavelength * (elements.position[:, 0] - wave.crest)
    if elements.extent is not None:   # a cell's mean of cos(kx) is less than its middle's
        weight = weight / np.sinc(elements.extent[:, 0] / wave.wavelength)
    amplitude = 2.0 / (wave.length * wave.breadth) * float((weight * np.cos(phase)).sum())
    expected = float(wave.exact(np.array([elements.time]))[0])
    return Reading(amplitude / wave.amplitude - expected, kept=(Sample(elements.time, amplitude), wave),
                   beside={"amplitude_m": amplitude, "exact_amplitude_m": expected * wave.amplitude})
