"""Pictures of an SLM track: powder bed, evolution, sections along and across, final shape (the paper's figures 4 to 8)."""

from __future__ import annotations

import numpy as np
from matplotlib import pyplot

from .colours import TEMPERATURE_RANGE, colour_map, solver_colour
from .drawing import Picture, arrows, encode, section, smooth
from .formatting import solver_name
from .gather import Case, Run

GRAIN_RANGE = (15.0, 45.0)  # μm, of the colours of grains
SHARES_OF_SCAN = (0.25, 0.5, 0.75, 1.0)  # instants of the evolution, as the paper's four


def scan_end(case: Case) -> float:
    """Time at which the laser reaches the end of its path, or the run ends [s]."""
    laser, end = case.settings["laser"], case.settings["time"]["end"]
    path = laser["path"]
    length = np.hypot(*(np.subtract(path["to"], path["from"])))
    return min(end, (laser.get("start") or 0.0) + length / laser["speed"]) if laser["speed"] else end


def snapshot_at(run: Run, time: float) -> int:
    """Index of the last snapshot not after `time` (to a millionth)."""
    times = np.asarray(run.series.times)
    return int(max(0, np.searchsorted(times, time * (1 + 1e-6) + 1e-12, side="right") - 1))


def view_jobs(case: Case) -> list[dict]:
    """Three-dimensional views: the bed at the start, the evolution, and the final shape, for each solver with snapshots."""
    domain = case.settings["domain"]
    top = min(domain["upper"][2], 1.2e-4) if domain["upper"][2] > 0 else domain["upper"][2]
    box = [domain["lower"], [*domain["upper"][:2], top]]
    common = {"spacing": case.settings["spacing"], "box": box, "colour_map": "temperature", "range": TEMPERATURE_RANGE,
              "azimuth": -28, "elevation": 38}
    jobs = bed_jobs(case, common)
    for run in case.shown:
        instants = [("start", 0, "temperature")]
        for share in SHARES_OF_SCAN:
            instants.append((f"scan{share * 100:.0f}", snapshot_at(run, share * scan_end(case)), "temperature"))
        instants.append(("final", len(run.series) - 1, "peak_temperature"))
        for label, index, colour in instants:
            jobs.append(common | {"key": f"{case.name}.{run.solver}.{label}", "file": str(run.series.files[index][0]),
                                  "colour": colour, "time": run.series.times[index]}
                        | ({"azimuth": -18, "elevation": 55} if label == "final" else {}))
    return jobs


def bed_jobs(case: Case, common: dict) -> list[dict]:
    """One view of the powder bed's spheres, which both solvers read; none if the case has no bed."""
    beds = [body for body in case.settings["bodies"] if body["shape"] == "powder_bed"]
    domain = case.settings["domain"]
    return [
        common | {"key": f"{case.name}.bed.spheres", "file": body["file"], "colour": "diameter", "colour_map": "cividis",
                  "range": GRAIN_RANGE, "time": 0.0, "floor": True, "zoom": 1.3, "elevation": 48,
                  "box": [[*domain["lower"][:2], body["lower"][2]], [*domain["upper"][:2], body["upper"][2]]]}
        for body in beds[:1]
    ]


def melt_contours(axes, cut, melting: float, colour: str = "#0b0b0b") -> None:
    """The melting isotherm on a section, inside the material."""
    if "temperature" in cut.values:
        shown = np.where(cut.inside, smooth(cut.values["temperature"], 0.5 * cut.points_a_spacing), np.nan)
        if np.nanmax(shown, initial=0) > melting:
            axes.contour(1e3 * cut.across, 1e3 * cut.up, shown, levels=[melting], colors=colour, linewidths=1.1)


def along_picture(case: Case) -> Picture:
    """Sections along the track near the end of the scan: temperature and velocity (figure 6)."""
    picture = Picture(f"{case.name}-along", "", "Temperature and velocity in the plane along the track", paper="figure 6")
    runs = [run for run in case.shown if run.status == "completed"]
    if not runs:
        picture.missing = "no completed run with snapshots"
        return picture
    laser, spacing, melting = case.settings["laser"], case.settings["spacing"], melting_temperature(case)
    canvas, axes = pyplot.subplots(2 * len(runs), 1, figsize=(10, 2.75 * 2 * len(runs)), squeeze=False)
    notes = []
    for number, run in enumerate(runs):
        index = snapshot_at(run, 0.9 * scan_end(case))
        elements, time = run.series.load(index), run.series.times[index]
        spot = laser["path"]["from"][0] + laser["speed"] * (time - (laser.get("start") or 0.0))
        window = ((max(case.settings["domain"]["lower"][0], spot - 9e-4), min(case.settings["domain"]["upper"][0], spot + 3e-4)),
                  (-2.2e-4, 1.2e-4))
        cut = section(elements, spacing, "y", laser["path"]["from"][1], window)
        liquid = cut.inside & (cut.values["temperature"] > melting)
        for axis, field in zip(axes[2 * number:2 * number + 2, 0], ("temperature", "speed")):
            mapping = dict(cmap=colour_map("temperature"), vmin=TEMPERATURE_RANGE[0], vmax=TEMPERATURE_RANGE[1])
            values = np.where(cut.inside, cut.values[field], np.nan)
            if field == "speed":
                axis.imshow(np.where(cut.inside, 0.82, np.nan), origin="lower", extent=cut.extent_mm, cmap="gray", vmin=0, vmax=1)
                values = np.where(liquid, values, np.nan)
                mapping = dict(cmap="viridis", vmin=0)
            image = axis.imshow(values, origin="lower", extent=cut.extent_mm, interpolation="nearest", **mapping)
            canvas.colorbar(image, ax=axis, pad=0.015, aspect=14, label="Temperature [K]" if field == "temperature" else "Speed [m/s]")
            melt_contours(axis, cut, melting)
            axis.axvline(1e3 * spot, color="#2563eb", linewidth=0.8, linestyle=":")
            axis.set(title=f"{solver_name(run.solver)}, t = {1e3 * time:.2f} ms", ylabel="z [mm]", aspect="equal")
        greatest = arrows(axes[2 * number + 1, 0], cut, liquid, count=60, colour="white")
        notes.append(f"{solver_name(run.solver)} up to {greatest:.2g} m/s")
        axes[2 * number + 1, 0].set_xlabel("x [mm]")
    canvas.tight_layout(h_pad=0.6)
    picture.image = encode(canvas)
    picture.caption = (f"Plane along the track at {case.power:g} W. Black line: melting temperature, {melting:g} K; dotted: the beam's "
                       f"axis. Arrows: velocity of the melt in the plane ({', '.join(notes)}).")
    return picture


def melting_temperature(case: Case) -> float:
    """The isotherm that bounds the melt pool [K], of the material of the first body."""
    material = case.settings["materials"][case.settings["bodies"][0]["material"]]
    return material.get("melting_temperature") or material["liquidus"]


def across_picture(case: Case) -> Picture:
    """Fused cross-sections in the middle of the quasi-steady part, both solvers over each other."""
    picture = Picture(f"{case.name}-across", "", "Outline of the fused zone across the track in each solver")
    runs = [run for run in case.shown if run.status == "completed"]
    if not runs:
        picture.missing = "no completed run with snapshots"
        return picture
    laser, spacing, melting = case.settings["laser"], case.settings["spacing"], melting_temperature(case)
    place = laser["path"]["from"][0] + 0.6 * laser["speed"] * scan_end(case)
    canvas, axes = pyplot.subplots(1, len(runs) + 1, figsize=(10, 3.0), sharey=True)
    window = ((-2.4e-4, 2.4e-4), (-2.2e-4, 1.2e-4))
    drawn = False
    for axis, run in zip(axes, runs):
        elements = run.series.load(len(run.series) - 1)
        cut = section(elements, spacing, "x", place, window)
        field = "peak_temperature" if "peak_temperature" in cut.values else "temperature"
        shown = np.where(cut.inside, cut.values[field], np.nan)
        axis.imshow(shown, origin="lower", extent=cut.extent_mm, cmap=colour_map("temperature"), vmin=TEMPERATURE_RANGE[0],
                    vmax=TEMPERATURE_RANGE[1], interpolation="nearest")
        for target, colour in ((axis, "#0b0b0b"), (axes[-1], solver_colour(run.solver))):
            fused = smooth(np.where(cut.inside, cut.values[field], 300.0), 0.5 * cut.points_a_spacing)
            if fused.max() > melting:
                target.contour(1e3 * cut.across, 1e3 * cut.up, fused, levels=[melting], colors=colour, linewidths=1.6)
                drawn = True
        axis.set(title=solver_name(run.solver), xlabel="y [mm]", aspect="equal")
        axes[-1].plot([], [], color=solver_colour(run.solver), label=solver_name(run.solver))
    axes[-1].axhline(0, color="#6b7280", linewidth=0.8, linestyle="--")
    axes[-1].set(title="Fused zones compared", xlabel="y [mm]", aspect="equal", xlim=(-0.24, 0.24), ylim=(-0.22, 0.12))
    axes[-1].legend(loc="lower right", fontsize=8)
    axes[0].set_ylabel("z [mm]")
    canvas.tight_layout()
    picture.image = encode(canvas)
    picture.caption = (f"Across the track at x = {1e3 * place:.2f} mm and {case.power:g} W: greatest temperature that each place ever had; "
                       f"line: what was ever above {melting:g} K (the fused zone). Dashed: original surface of the plate."
                       + ("" if drawn else " Nothing was melted there."))
    return picture
