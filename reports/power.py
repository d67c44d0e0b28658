"""Melt-pool width and depth against laser power, in both solvers: the paper's figure 9."""

from __future__ import annotations

from matplotlib import pyplot

from .colours import solver_colour
from .drawing import Picture, encode
from .formatting import quantity, solver_name
from .gather import Case

QUANTITIES = (("melt_pool_width", "Melt-pool width [μm]"), ("melt_pool_depth", "Melt-pool depth [μm]"))


def power_points(cases: list[Case]) -> dict[str, dict[str, dict[float, tuple[float, float]]]]:
    """quantity → solver → power [W] → (value, uncertainty) [m], of completed results."""
    points: dict = {name: {} for name, _ in QUANTITIES}
    for case in cases:
        for run in case.runs:
            if case.power is None or run.status != "completed":
                continue
            for measure in run.result["measures"]:
                if measure["name"] in points and measure["value"] is not None:
                    of_solver = points[measure["name"]].setdefault(run.solver, {})
                    of_solver[case.power] = (measure["value"], measure.get("uncertainty") or 0.0)
    return points


def power_picture(cases: list[Case]) -> Picture | None:
    """The figure; None if no case of the page has a laser."""
    powers = sorted({case.power for case in cases if case.power is not None})
    if not powers:
        return None
    picture = Picture("width-against-power", "", "Melt-pool width and depth against laser power, a line for each solver", paper="figure 9")
    points = power_points(cases)
    if not any(points.values()):
        picture.missing = "no completed track has a measured melt pool yet"
        return picture
    canvas, axes = pyplot.subplots(1, 2, figsize=(10, 3.9))
    for axis, (name, label) in zip(axes, QUANTITIES):
        for number, (solver, values) in enumerate(sorted(points[name].items(), reverse=True)):
            known = sorted(values)
            axis.errorbar([power + 0.8 * number for power in known], [1e6 * values[power][0] for power in known],
                          yerr=[1e6 * values[power][1] for power in known], color=solver_colour(solver), linewidth=1.6,
                          marker="os^D"[number % 4], markersize=5.5, capsize=3, label=solver_name(solver))
        greatest = max((value for of_solver in points[name].values() for value, _ in of_solver.values()), default=1e-4)
        axis.set(xlabel="Laser power [W]", title=label, xticks=powers, ylim=(0, 1.15e6 * greatest),
                 xlim=(powers[0] - 15, powers[-1] + 15))
        axis.grid(axis="y")
        axis.legend(loc="lower right")
    canvas.tight_layout(w_pad=3)
    picture.image = encode(canvas)
    picture.caption = ("Width and depth of the melt pool in the quasi-steady part of the track. Bars: the spread over the "
                       "snapshots of that part. The paper gives no numbers in any source found: its finding, that "
                       "width rises about linearly with power and that SPH and the grid code follow each other, is what can be compared.")
    return picture


def power_table(cases: list[Case]) -> list[dict]:
    """Rows power, quantity, a text for each of SPH and OpenFOAM, and their difference."""
    points, rows = power_points(cases), []
    for name, label in QUANTITIES:
        values = points[name]
        for power in sorted({power for of_solver in values.values() for power in of_solver}):
            sph, foam = (values.get(solver, {}).get(power, (None, 0))[0] for solver in ("sph", "openfoam"))
            difference = f"{100 * (sph - foam) / foam:+.1f} %".replace("-", "−") if sph is not None and foam else "missing"
            rows.append({"power": f"{power:g} W", "quantity": label.split(" [")[0], "sph": quantity(sph, "m"),
                         "openfoam": quantity(foam, "m"), "difference": difference})
    return rows
