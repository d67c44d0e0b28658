"""Pictures of a drop on a wall: start, evolution, sections with vortices, final shape against the cap (figures 1 to 3)."""

from __future__ import annotations

import numpy as np
from cupel.exact.spherical_cap import Cap
from matplotlib import pyplot

from .colours import solver_colour
from .drawing import Picture, arrows, encode, nearest_times, section, smooth
from .formatting import quantity, solver_name
from .gather import Case, Run

PAPER_TIMES = (0.01, 0.07)  # s, of the paper's figure 3


def extent(case: Case) -> float:
    """Half width of what is worth seeing [m]: somewhat more than the drop's radius at its widest."""
    sphere = next(body for body in case.settings["bodies"] if body["shape"] == "sphere")
    half = 0.5 * (case.settings["domain"]["upper"][0] - case.settings["domain"]["lower"][0])
    return min(half, 2.2 * sphere["radius"])


def centre(case: Case) -> np.ndarray:
    """Foot of the drop's axis on the wall (3) [m]."""
    sphere = next(body for body in case.settings["bodies"] if body["shape"] == "sphere")
    return np.array([*sphere["center"][:2], case.settings["domain"]["lower"][2]])


def instants(run: Run) -> list[int]:
    """Snapshots of the evolution: start, the paper's two instants, and the end."""
    times = run.series.times
    return nearest_times(times, [times[0], *[time for time in PAPER_TIMES if time < times[-1]], times[-1]])


def view_jobs(case: Case) -> list[dict]:
    """Three-dimensional views of the evolution, for each solver with snapshots."""
    if case.settings["dimensions"] != 3:
        return []
    half, foot = extent(case), centre(case)
    box = [list(foot - [half, half, 0]), list(foot + [half, half, 1.1 * half])]
    return [
        {"key": f"{case.name}.{run.solver}.{number}", "file": str(run.series.files[index][0]), "box": box,
         "spacing": case.settings["spacing"], "colour": "material", "floor": True, "azimuth": -30, "elevation": 24,
         "time": run.series.times[index]}
        for run in case.shown for number, index in enumerate(instants(run))
    ]


def exact_cap(case: Case) -> Cap | None:
    """The cap of the drop's volume at the prescribed angle; None if the case has no wetting."""
    sphere = next(body for body in case.settings["bodies"] if body["shape"] == "sphere")
    angle = case.settings["materials"][sphere["material"]].get("contact_angle")
    if angle is None:
        return None
    dimensions = case.settings["dimensions"]
    radius = sphere["radius"]
    above_wall = min(radius, sphere["center"][2] - case.settings["domain"]["lower"][2])
    cut_off = np.arccos(-above_wall / radius)  # the start's own angle on the wall: what is in the wall is no drop
    return Cap.of_content(Cap(radius, cut_off, dimensions).content, angle, dimensions)


def motion_picture(case: Case) -> Picture:
    """Sections through the axis at the paper's instants: outline and velocity (figure 3)."""
    picture = Picture(f"{case.name}-motion", "", "Velocity in the plane through the drop's axis at two instants", paper="figure 3")
    runs = case.shown
    if not runs:
        picture.missing = "no snapshots"
        return picture
    half, foot, spacing = extent(case), centre(case), case.settings["spacing"]
    window = ((foot[0] - half, foot[0] + half), (foot[2], foot[2] + 1.15 * half))
    chosen = {run.solver: nearest_times(run.series.times, list(PAPER_TIMES)) for run in runs}
    columns = max(map(len, chosen.values()))
    canvas, axes = pyplot.subplots(len(runs), columns, figsize=(5 * columns, 3.1 * len(runs)), squeeze=False, sharex=True, sharey=True)
    notes = []
    for row, run in zip(axes, runs):
        for axis, index in zip(row, chosen[run.solver]):
            cut = section(run.series.load(index), spacing, "y", foot[1], window)
            axis.imshow(np.where(cut.inside, 1.0, np.nan), origin="lower", extent=cut.extent_mm, cmap="YlOrBr", vmin=0, vmax=3)
            outline(axis, cut, "#92400e")
            greatest = arrows(axis, cut, cut.values["near"], count=38, colour="#334155") if "speed" in cut.values else 0.0
            moment = quantity(run.series.times[index], "s", digits=2)
            axis.set(title=f"{solver_name(run.solver)}, t = {moment}", aspect="equal")
            notes.append(f"{solver_name(run.solver)} at {moment}: {1e3 * greatest:.3g} mm/s")
        row[0].set_ylabel("z [mm]")
    for axis in axes[-1]:
        axis.set_xlabel("x [mm]")
    canvas.tight_layout()
    picture.image = encode(canvas)
    picture.caption = ("Plane through the drop's axis. Arrows: velocity in the plane, scaled in each panel to its greatest speed ("
                       + "; ".join(notes) + ").")
    return picture


def outline(axis, cut, colour: str, **style) -> None:
    """The drop's outline on a section."""
    drop = smooth(np.where(cut.values["near"], cut.values["fraction"], 0.0), 0.7 * cut.points_a_spacing)
    if drop.max() > 0.5:
        axis.contour(1e3 * cut.across, 1e3 * cut.up, drop, levels=[0.5], colors=colour, linewidths=1.5, **style)


def shape_picture(case: Case) -> Picture:
    """The last snapshot's outline in both solvers against the exact cap."""
    picture = Picture(f"{case.name}-shape", "", "Outline of the settled drop in each solver and the exact cap", wide=False)
    runs = [run for run in case.shown if run.status == "completed"]
    if not runs:
        picture.missing = "no completed run with snapshots"
        return picture
    half, foot, cap = extent(case), centre(case), exact_cap(case)
    window = ((foot[0] - half, foot[0] + half), (foot[2], foot[2] + 1.15 * half))
    canvas, axis = pyplot.subplots(figsize=(7, 3.4))
    top = cap.height if cap is not None else 0.0
    for run in runs:
        cut = section(run.series.load(len(run.series) - 1), case.settings["spacing"], "y", foot[1], window)
        top = max(top, cut.up[cut.inside.any(axis=1)].max(initial=foot[2]) - foot[2])
        outline(axis, cut, solver_colour(run.solver))
        axis.plot([], [], color=solver_colour(run.solver), label=f"{solver_name(run.solver)}, t = {quantity(run.series.times[-1], 's', digits=3)}")
    if cap is not None:
        angle = np.linspace(-cap.contact_angle, cap.contact_angle, 300)
        x, z = cap.radius * np.sin(angle), cap.height - cap.radius * (1 - np.cos(angle))
        axis.plot(1e3 * (foot[0] + x), 1e3 * (foot[2] + z), color="#111827", linestyle="--", linewidth=1.2,
                  label=f"exact cap, {np.degrees(cap.contact_angle):.3g}°")
    axis.axhline(1e3 * foot[2], color="#6b7280", linewidth=1)
    axis.set(xlabel="x [mm]", ylabel="z [mm]", aspect="equal", ylim=(1e3 * foot[2] - 0.05, 1e3 * (foot[2] + 1.6 * top)))
    axis.legend(loc="upper right", fontsize=8)
    picture.image = encode(canvas)
    picture.caption = ("Settled shape in the plane through the axis. The exact cap has the drop's volume and the prescribed angle; the "
                       "measures in the table are fits in three dimensions, not read from this picture.")
    return picture
