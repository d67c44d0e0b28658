"""What was measured in each snapshot against time, beside the exact history or value: a panel for each case of a tier."""

from __future__ import annotations

import csv
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from cupel.errors import CupelError
from cupel.exact import oscillating_drop, taylor_green
from cupel.measures.oscillation import inviscid_frequency, normal_mode
from matplotlib import pyplot
from matplotlib.lines import Line2D

from .colours import solver_colour
from .drawing import Picture, encode
from .formatting import scale_of, solver_name
from .gather import Case, Run

COLUMNS = 4
EXACT = {"color": "#1f2933", "linestyle": (0, (4, 2)), "linewidth": 1.0, "zorder": 3}


@dataclass(frozen=True)
class History:
    """A column of measures.csv worth a panel: its title, the measure that it belongs to, its unit, whether it spans decades, and
    where its exact history is: a column, or a function of (settings, times, first value)."""

    column: str
    title: str
    measure: str
    unit: str = "1"
    decades: bool = False
    exact_column: str = ""
    exact: object = None


def _oscillation(settings: dict, time: np.ndarray, first: float) -> np.ndarray:
    """Amplitude of the drop as released, in vacuum; as its normal mode where the surrounding takes part."""
    if not (settings.get("surrounding") or {}).get("resolved"):
        body = next(body for body in settings["bodies"] if body["shape"] == "sphere")
        material = settings["materials"][body["material"]]
        mode = (body.get("perturbation") or {}).get("mode", 2)
        return first * oscillating_drop.amplitude(time, material["surface_tension"], material["density"], body["radius"],
                                                  material["viscosity"], mode, settings["dimensions"])
    omega, decay = normal_mode(settings)
    return first * np.exp(-decay * time) * np.cos(omega * time)


def _energy(settings: dict, time: np.ndarray, first: float) -> np.ndarray:
    field = settings["initial"]["velocity"]
    material = next(iter(settings["materials"].values()))
    rate = taylor_green.energy_decay_rate(material["viscosity"] / material["density"], field["wavelength"])
    return 0.25 * field["speed"]**2 * np.exp(-rate * time)


HISTORIES = (
    History("oscillation_frequency_amplitude", "amplitude / radius", "oscillation_frequency", exact=_oscillation),
    History("oscillation_period_amplitude", "amplitude / radius", "oscillation_period", exact=_oscillation),
    History("wave_error_amplitude_m", "amplitude", "wave_error", "m", exact_column="wave_error_exact_amplitude_m"),
    History("start_up_error_velocity_m_per_s", "velocity of the drop [m/s]", "start_up_error", "m/s",
            exact_column="start_up_error_exact_velocity_m_per_s"),
    History("migration_error_velocity_over_U_r", "velocity / U_r", "migration_error", exact_column="migration_error_curve"),
    History("migration_error_sharp_interface_velocity_over_U_r", "velocity / U_r", "migration_error_sharp_interface",
            exact_column="migration_error_sharp_interface_curve"),
    History("decay_rate_kinetic_energy_J_per_kg", "kinetic energy [J/kg]", "decay_rate", decades=True, exact=_energy),
    History("velocity_profile_error", "profile error", "velocity_profile_error", decades=True),
    History("mean_profile_error", "profile error", "mean_profile_error", decades=True),
    History("profile_error", "profile error", "profile_error", decades=True),
    History("contact_angle_rad", "contact angle", "contact_angle", "rad"),
    History("laplace_pressure_Pa", "pressure inside [Pa]", "laplace_pressure", "Pa"),
    History("drop_velocity_m_per_s", "velocity of the drop [m/s]", "drop_velocity", "m/s"),
    History("recoil_balance_error", "balance of recoil, error", "recoil_balance_error", decades=True),
    History("melt_pool_width_m", "melt-pool width", "melt_pool_width", "m"),
)


def history_picture(tier: str, title: str, cases: list[Case]) -> Picture:
    """A panel for each case file with histories of all its variations; exact ones dashed."""
    picture = Picture(f"histories-{tier}", "", f"{title}: histories of what is measured in each snapshot, beside the exact ones")
    panels: dict[tuple[str, History], list[tuple[Case, Run, dict]]] = {}
    for case in cases:
        for run in case.runs:
            table = read_table(run.place.folder / "measures.csv") if run.status == "completed" and not run.kept else {}
            chosen = next((history for history in HISTORIES if np.isfinite(table.get(history.column, np.array([np.nan]))).sum() > 2), None)
            if chosen:
                panels.setdefault((case.family, chosen), []).append((case, run, table))
    if not panels:
        picture.missing = "no result of this tier with several snapshots"
        return picture
    columns = min(COLUMNS, len(panels))
    rows = math.ceil(len(panels) / columns)
    canvas, grid = pyplot.subplots(rows, columns, figsize=(max(3.1 * columns, 5.0), 2.5 * rows), squeeze=False)
    for axes, ((family, history), lines) in zip(grid.flat, panels.items()):
        _panel(axes, family, history, lines)
    for axes in grid.flat[len(panels):]:
        axes.axis("off")
    solvers = list(dict.fromkeys(run.solver for lines in panels.values() for _, run, _ in lines))
    handles = [Line2D([], [], color=solver_colour(solver), linewidth=1.6, label=solver_name(solver)) for solver in solvers]
    handles.append(Line2D([], [], **EXACT, label="exact or tabulated"))
    canvas.tight_layout(w_pad=1.5, h_pad=1.4)
    canvas.legend(handles=handles, ncol=len(handles), loc="lower left", bbox_to_anchor=(0.01, 1.0), borderaxespad=0.0)
    picture.image = encode(canvas)
    picture.caption = "One quantity of each case against time, a line for each solver and variation, with the exact history or value dashed."
    return picture


def read_table(path: Path) -> dict[str, np.ndarray]:
    """The columns of measures.csv, nan where a snapshot has no value; empty if there is no such file."""
    try:
        with open(path, newline="") as file:
            rows = list(csv.DictReader(file))
    except OSError:
        return {}
    return {name: np.array([float(row[name]) if row[name] else np.nan for row in rows]) for name in (rows[0] if rows else {})}


def _panel(axes, family: str, history: History, lines: list[tuple[Case, Run, dict]]) -> None:
    last = max(float(table["time_s"][-1]) for *_, table in lines)
    time_factor, time_unit = scale_of("s", last)
    sizes = np.concatenate([table[history.column] for *_, table in lines])
    factor, unit = scale_of(history.unit, float(np.nanmax(np.abs(sizes)))) if history.unit in ("m", "rad") else (1.0, "")
    for case, run, table in lines:
        time, value = table["time_s"], table[history.column]
        axes.plot(time_factor * time, factor * value, color=solver_colour(run.solver), linewidth=1.1, alpha=0.85)
        for moments, exact in _exact(history, run, table):
            axes.plot(time_factor * moments, factor * exact, **EXACT)
    variations = len({case.name for case, *_ in lines})
    axes.set_title(f"{family} ({variations})" if variations > 1 else family, fontsize=8)
    axes.set(xlabel=f"time [{time_unit}]", ylabel=history.title + (f" [{unit}]" if unit else ""))
    if history.decades:
        axes.set_yscale("log")
    axes.grid(linewidth=0.5)


def _exact(history: History, run: Run, table: dict) -> list[tuple[np.ndarray, np.ndarray]]:
    """Times and values of the exact history of a run: a column of its table, a formula, or the reference of its measure."""
    time = table["time_s"]
    if history.exact_column:
        return [(time, table[history.exact_column])] if history.exact_column in table else []
    settings = run.result["settings"]
    if history.exact is not None:
        try:
            period = 2.0 * np.pi / inviscid_frequency(settings) if history.exact is _oscillation else (time[-1] - time[0]) / 10.0
            fine = np.linspace(time[0], time[-1], int(np.clip(24.0 * (time[-1] - time[0]) / period, 60, 400)))
            return [(fine, history.exact(settings, fine, float(table[history.column][0])))]
        except (CupelError, KeyError, ValueError):
            return []
    reference = next((measure["reference"] for measure in run.result["measures"]
                      if measure["name"] == history.measure and measure["reference_kind"] in ("exact", "tabulated")), None)
    return [(time[[0, -1]], np.full(2, reference))] if reference else []
