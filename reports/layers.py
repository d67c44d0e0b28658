"""Pictures of the thermocapillary layer: velocity profile against the exact one, and the section with the flow."""

from __future__ import annotations

import numpy as np
from cupel.exact.return_flow import velocity
from matplotlib import pyplot

from .colours import solver_colour
from .drawing import Picture, arrows, encode, section
from .formatting import number, quantity, solver_name
from .gather import Case


def layer(case: Case) -> tuple[dict, float, float]:
    """The liquid's box, its depth [m] and the surface stress dσ/dT dT/dx [N/m²]."""
    body = next(body for body in case.settings["bodies"] if body["shape"] == "box")
    material = case.settings["materials"][body["material"]]
    gradient = case.settings["initial"]["temperature_gradient"][0]
    return body, body["upper"][2] - body["lower"][2], material["surface_tension_slope"] * gradient


def profile_picture(case: Case) -> Picture:
    """Horizontal velocity over height in the middle of the layer, each solver and the exact profile."""
    picture = Picture(f"{case.name}-profile", "", "Velocity over height in each solver and the exact profile", wide=False)
    runs = [run for run in case.shown if run.status == "completed"]
    if not runs:
        picture.missing = "no completed run with snapshots"
        return picture
    body, depth, stress = layer(case)
    viscosity = case.settings["materials"][body["material"]]["viscosity"]
    spacing, middle = case.settings["spacing"], 0.5 * (body["lower"][0] + body["upper"][0])
    canvas, axis = pyplot.subplots(figsize=(6.2, 3.9))
    eta = np.linspace(0, 1, 200)
    axis.plot(1e3 * velocity(eta, stress, depth, viscosity), eta, color="#111827", linestyle="--", linewidth=1.2, label="exact")
    for position, run in enumerate(runs):
        elements = run.series.load(len(run.series) - 1)
        band = (np.abs(elements.position[:, 0] - middle) < 2 * spacing) & (elements.fraction > 0.5)
        height = (elements.position[band, 2] - body["lower"][2]) / depth
        axis.plot(1e3 * elements.velocity[band, 0], height, linestyle="none", marker="os"[position % 2], markersize=3.5, alpha=0.7,
                  color=solver_colour(run.solver), label=f"{solver_name(run.solver)}, t = {quantity(run.series.times[-1], 's', digits=3)}")
    axis.axvline(0, color="#9ca3af", linewidth=0.8)
    axis.set(xlabel="Velocity along the layer [mm/s]", ylabel="Height over depth, η")
    axis.grid(True)
    axis.legend(fontsize=8)
    picture.image = encode(canvas)
    picture.caption = ("Velocity of every element within two spacings of the middle. Exact: u = (τH/4μ)(3η² − 2η), with "
                       f"τ = {number(stress, 3)} N/m² and H = {1e3 * depth:.3g} mm; it crosses zero at η = 2/3.")
    return picture


def flow_picture(case: Case) -> Picture:
    """The whole layer with speed and direction of the flow."""
    picture = Picture(f"{case.name}-flow", "", "Speed and direction of the flow in the layer")
    runs = [run for run in case.shown if run.status == "completed"]
    if not runs:
        picture.missing = "no completed run with snapshots"
        return picture
    body, depth, stress = layer(case)
    window = ((body["lower"][0], body["upper"][0]), (body["lower"][2], body["upper"][2] + 0.05 * depth))
    canvas, axes = pyplot.subplots(len(runs), 1, figsize=(10, 1.9 * len(runs)), squeeze=False, sharex=True)
    for axis, run in zip(axes[:, 0], runs):
        elements = run.series.load(len(run.series) - 1)
        cut = section(elements, case.settings["spacing"], "y", float(np.median(elements.position[:, 1])), window)
        image = axis.imshow(1e3 * np.where(cut.inside, cut.values["speed"], np.nan), origin="lower", extent=cut.extent_mm,
                            cmap="viridis", vmin=0, interpolation="nearest", aspect="auto")
        canvas.colorbar(image, ax=axis, pad=0.015, aspect=9, label="Speed [mm/s]")
        arrows(axis, cut, cut.inside, count=40, colour="white")
        axis.set(title=f"{solver_name(run.solver)}, t = {quantity(run.series.times[-1], 's', digits=3)}", ylabel="z [mm]")
    axes[-1, 0].set_xlabel("x [mm]")
    canvas.tight_layout()
    picture.image = encode(canvas)
    picture.caption = (f"The temperature gradient pulls the surface to the {'left' if stress < 0 else 'right'}; the closed ends send the "
                       "liquid back below.")
    return picture
