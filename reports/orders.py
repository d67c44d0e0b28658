"""Order and uncertainty on the page: errors against spacing by case, and the tables of orders and of agreement."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from cupel.convergence import Study, converge, write_convergence
from matplotlib import pyplot
from matplotlib.lines import Line2D

from .colours import solver_colour
from .drawing import Picture, encode
from .formatting import quantity, quantity_name, scale_of, solver_name, uncertain
from .gather import Case

COLUMNS = 4
MARKERS = "os^Dv*"


def orders_block(root: Path, cases: list[Case]) -> dict:
    """Pictures, rows and agreements of all cases that have three levels; also writes results/CASE/convergence.json."""
    found = [converge(root, case.name) for case in cases]
    families = {case.name: case.family for case in cases}
    for each in found:
        write_convergence(root, each)
    studies = [study for each in found for study in each.studies]
    return {
        "picture": order_picture(studies, families), "rows": [order_row(study) for study in studies],
        "agreements": [agreement_row(one) for each in found for one in each.agreements],
        "short": sorted({each.case for each in found if not each.studies}),
    }


def order_row(study: Study) -> dict:
    """A study in print."""
    finest = study.points[0]
    like = finest.value
    return {
        "case": study.case, "solver": solver_name(study.solver), "quantity": quantity_name(study.measure), "kind": study.kind,
        "order": "–" if study.order is None else f"{study.order:.2f}",
        "error_order": "–" if study.order_of_error is None else f"{study.order_of_error:.2f}",
        "levels": spacings(study),
        "value": uncertain(finest.value, study.uncertainty, study.unit),
        "richardson": quantity(study.richardson, study.unit, like),
        "reference": quantity(study.reference, study.unit, like), "note": study.note,
    }


def spacings(study: Study) -> str:
    """The spacings of a study's levels in one unit, finest first, kept ones with a star."""
    factor, unit = scale_of("m", study.points[0].spacing)
    return " / ".join(f"{factor * point.spacing:.3g}" + ("*" if point.kept else "") for point in study.points) + f" {unit}"


def agreement_row(one) -> dict:
    """An agreement in print."""
    like = max(map(abs, one.values))
    return {
        "case": one.case, "quantity": quantity_name(one.measure), "pair": " and ".join(map(solver_name, one.solvers)),
        "first": quantity(one.values[0], one.unit, like), "second": quantity(one.values[1], one.unit, like),
        "difference": quantity(one.difference, one.unit, like, 3), "uncertainty": quantity(one.uncertainty, one.unit, like, 2),
        "word": "agree" if one.agree else "differ", "verdict": "pass" if one.agree else "fail",
    }


def drawn(study: Study) -> list[tuple[float, float]]:
    """Spacing [m] and |error| of a study's levels, for errors against an exact or tabulated reference."""
    if study.reference is None or study.order_of_error is None:
        return []
    return [(point.spacing, abs(point.error)) for point in study.points if point.error]


def order_picture(studies: list[Study], families: dict[str, str]) -> Picture:
    """A panel for each case with its variations: |error| against spacing, both logarithmic, colour by solver, marker by quantity;
    slopes 1 and 2 in grey."""
    picture = Picture("orders", "", "Errors against spacing for every case with at least three levels")
    shown = [study for study in studies if drawn(study)]
    panels = [(family, [study for study in shown if families[study.case] == family])
              for family in dict.fromkeys(families[study.case] for study in shown)]
    if not panels:
        picture.missing = "no case has an exact error at three levels yet"
        return picture
    columns = min(COLUMNS, len(panels))
    rows = math.ceil(len(panels) / columns)
    canvas, grid = pyplot.subplots(rows, columns, figsize=(max(3.1 * columns, 5.0), 2.9 * rows), squeeze=False)
    for axes, panel in zip(grid.flat, panels):
        _panel(axes, *panel)
    for axes in grid.flat[len(panels):]:
        axes.axis("off")
    solvers = list(dict.fromkeys(study.solver for study in shown))
    handles = [Line2D([], [], color=solver_colour(solver), linewidth=1.6, label=solver_name(solver)) for solver in solvers]
    handles += [Line2D([], [], color="#9aa3ad", linestyle=":", label="order 1"), Line2D([], [], color="#9aa3ad", linestyle="--", label="order 2")]
    canvas.tight_layout(w_pad=1.5, h_pad=1.6)
    canvas.legend(handles=handles, ncol=len(handles), loc="lower left", bbox_to_anchor=(0.01, 1.0), borderaxespad=0.0)
    picture.image = encode(canvas)
    picture.caption = ("Magnitude of the error, relative or in the quantity's own unit as its tolerance is, against the spacing of elements. "
                       "Colour: solver. Marker: quantity. A line for each variation. Grey: first and second order.")
    return picture


def _panel(axes, title: str, studies: list[Study]) -> None:
    names = list(dict.fromkeys(study.measure for study in studies))
    points = [point for study in studies for point in drawn(study)]
    factor, unit = scale_of("m", max(spacing for spacing, _ in points))
    for study in studies:
        spacing, error = np.array(drawn(study)).T
        axes.plot(factor * spacing, error, color=solver_colour(study.solver), marker=MARKERS[names.index(study.measure) % len(MARKERS)],
                  markersize=4.5, linewidth=1.2, alpha=0.85)
    low, high = (factor * pick(spacing for spacing, _ in points) for pick in (min, max))
    top = max(error for _, error in points)
    for order, style in ((1, ":"), (2, "--")):
        axes.plot([low, high], [top * (low / high)**order, top], color="#9aa3ad", linestyle=style, linewidth=1.0, zorder=0)
    ticks = sorted({float(f"{factor * spacing:.3g}") for spacing, _ in points})
    axes.set(xscale="log", yscale="log", xlabel=f"spacing [{unit}]", title=title)
    axes.set_xlim(low / 1.25, high * 1.25)
    least = min(error for _, error in points)
    decades = max(np.log10(top / least), 0.5)
    axes.set_ylim(least / 10**((0.14 + 0.075 * len(names)) * decades), top * 10**(0.08 * decades))   # room for the legend below
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.minorticks_off()
    axes.title.set_fontsize(8)
    handles = [Line2D([], [], color="#374151", marker=MARKERS[n % len(MARKERS)], markersize=4, linestyle="none", label=quantity_name(name))
               for n, name in enumerate(names)]
    axes.legend(handles=handles, fontsize=6.3, loc="lower right", handletextpad=0.2, borderaxespad=0.1, labelspacing=0.25,
                frameon=True, framealpha=0.85, edgecolor="none")
    axes.grid(which="major", linewidth=0.5)
