"""Colours of the report: one for each solver, one map for each field, the same in figures and three-dimensional views."""

from __future__ import annotations

from matplotlib.colors import Colormap, LinearSegmentedColormap

SOLVER_COLOURS = {"sph": "#1f5fa8", "openfoam": "#d1702a"}
OTHER_COLOURS = ("#3b8f5a", "#7b4fa3", "#8a6d3b")
TEMPERATURE_RANGE = (300.0, 3300.0)  # K, from the cold bed to somewhat above boiling
# Solid in greys, the mushy zone as a sharp step, melt from red to white (K, red, green, blue).
TEMPERATURE_STOPS = (
    (300, "#b9bec6"), (900, "#8f929c"), (1500, "#6d6270"), (1673, "#5b3048"), (1773, "#b3261e"), (2200, "#ee7014"),
    (2700, "#fdb833"), (3300, "#fff6c8"),
)


def solver_colour(solver: str) -> str:
    """The colour of a solver; solvers of other makers take one of the remaining colours by name."""
    return SOLVER_COLOURS.get(solver) or OTHER_COLOURS[sum(map(ord, solver)) % len(OTHER_COLOURS)]


def colour_map(name: str) -> Colormap:
    """The map `temperature` of this module, or matplotlib's map of that name."""
    if name == "temperature":
        low, high = TEMPERATURE_RANGE
        return LinearSegmentedColormap.from_list(
            "temperature", [((kelvin - low) / (high - low), colour) for kelvin, colour in TEMPERATURE_STOPS], N=512)
    from matplotlib import colormaps

    return colormaps[name]
