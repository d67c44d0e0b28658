"""The verification tiers on the page: their tables, and how far each error is from its tolerance in one figure."""

from __future__ import annotations

from collections import Counter

from matplotlib import pyplot
from matplotlib.lines import Line2D

from .colours import solver_colour
from .drawing import Picture, encode
from .formatting import present, quantity, quantity_name, solver_name
from .gather import Case
from .histories import history_picture

TIERS = {
    "v0": ("Exact solutions", "Cases with an exact solution, which the measures work out from the same case file."),
    "v1": ("Tabulated references", "Cases with a published table of numbers."),
}
LEAST, MOST = 1e-3, 1e2   # error over tolerance at the ends of the axis; beyond it points lie on its edge


def tier_blocks(cases: list[Case]) -> list[dict]:
    """Each tier that the page has cases of: title, what it is, rows in print, counts, figure."""
    blocks = []
    for tier, (title, what) in TIERS.items():
        own = [case for case in cases if case.tier == tier]
        if not own:
            continue
        rows = [row for case in own for run in case.runs for row in run.rows]
        verdicts = Counter(row.verdict for row in rows)
        blocks.append({
            "tier": tier, "title": title, "what": what, "cases": [_case_block(case) for case in own],
            "passed": verdicts["pass"], "failed": verdicts["fail"], "missing": verdicts["missing"],
            "judged": sum(verdicts.values()) - verdicts["none"], "figure": margin_picture(tier, title, own),
            "histories": history_picture(tier, title, own),
            "solvers": [_solver_line(own, solver) for solver in dict.fromkeys(run.solver for case in own for run in case.runs)],
        })
    return blocks


def _case_block(case: Case) -> dict:
    """A case of a tier in print; one that no solver has run is a single line."""
    if all(run.result is None and not (run.place.folder / "launch.json").exists() and run.rows[0].verdict == "missing" for run in case.runs):
        names = ", ".join(solver_name(run.solver) for run in case.runs)
        return {"name": case.name, "title": case.title, "spacing": "", "absent": f"not run yet in {names}"}
    runs = [{
        "solver": solver_name(run.solver), "colour": solver_colour(run.solver), "kept": run.kept,
        "rows": [present(row) | {"margin": margin_text(row)} for row in run.rows],
    } for run in case.runs]
    spacing = quantity(case.settings["spacing"], "m", digits=3) if case.settings else ""
    return {"name": case.name, "title": case.title, "absent": "", "runs": runs, "spacing": spacing, "count": sum(len(run["rows"]) for run in runs)}


def _solver_line(cases: list[Case], solver: str) -> dict:
    """One line of the summary: how a solver does in a tier."""
    runs = [run for case in cases for run in case.runs if run.solver == solver]
    verdicts = Counter(row.verdict for run in runs for row in run.rows)
    return {
        "solver": solver_name(solver), "colour": solver_colour(solver), "passed": verdicts["pass"], "failed": verdicts["fail"],
        "missing": verdicts["missing"], "judged": sum(verdicts.values()) - verdicts["none"], "runs": len(runs),
        "kept": sum(bool(run.kept) for run in runs), "there": sum(run.status == "completed" for run in runs),
    }


def margin(row) -> float | None:
    """|error| over tolerance; None where there is nothing to judge."""
    return abs(row.error) / row.tolerance if row.error is not None and row.tolerance else None


def margin_text(row) -> str:
    """The margin in print, two digits."""
    value = margin(row)
    if value is None:
        return "–"
    return f"{value:.2f}" if value < 10 else f"{value:.0f}" if value < 1000 else "> 1000"


def margin_picture(tier: str, title: str, cases: list[Case]) -> Picture:
    """Error over tolerance of every comparison: a line for each quantity of a case with all its variations, a point for each solver
    and variation."""
    picture = Picture(f"margins-{tier}", "", f"{title}: error over tolerance of every comparison, by case and solver")
    points = [(case.family, row.quantity, run.solver, row) for case in cases for run in case.runs for row in run.rows
              if row.tolerance and row.reference_kind != "kept"]
    if not any(margin(row) is not None for *_, row in points):
        picture.missing = "no comparison of this tier has an error yet"
        return picture
    families = list(dict.fromkeys(case.family for case in cases))
    lines = sorted(dict.fromkeys((family, name) for family, name, *_ in points), key=lambda line: families.index(line[0]))
    variations = {family: len({case.name for case in cases if case.family == family}) for family, _ in lines}
    solvers = list(dict.fromkeys(run.solver for case in cases for run in case.runs))
    canvas, axes = pyplot.subplots(figsize=(10, 1.1 + 0.27 * len(lines)))
    axes.axvspan(LEAST / 2, 1.0, color="#eaf6ef", linewidth=0)
    axes.axvline(1.0, color="#146c43", linewidth=1.1)
    for number, (family, _) in enumerate(lines):
        if number and lines[number - 1][0] != family:
            axes.axhline(number - 0.5, color="#cdd4db", linewidth=0.7)
    for family, name, solver, row in points:
        height = lines.index((family, name)) + 0.26 * (solvers.index(solver) - (len(solvers) - 1) / 2)
        _mark(axes, row, height, solver_colour(solver))
    axes.set(xscale="log", xlim=(LEAST / 1.4, MOST * 1.7), ylim=(len(lines) - 0.4, -0.6), xlabel="|error| / tolerance")
    labels = [f"{family}{f' ({variations[family]})' if variations[family] > 1 else ''} · {quantity_name(name)}" for family, name in lines]
    axes.set_yticks(range(len(lines)), labels, fontsize=7.5)
    axes.set_xticks([1e-3, 1e-2, 1e-1, 1, 10, 100], ["0.001", "0.01", "0.1", "1", "10", "100"])
    axes.tick_params(axis="y", length=0)
    axes.grid(axis="x")
    axes.set_axisbelow(True)
    handles = [Line2D([], [], marker="o", linestyle="none", color=solver_colour(solver), label=solver_name(solver)) for solver in solvers]
    handles += [Line2D([], [], marker="D", linestyle="none", markerfacecolor="white", markeredgecolor="#6b7280", label="fails"),
                Line2D([], [], marker="x", linestyle="none", color="#6b7280", label="could not be measured")]
    axes.legend(handles=handles, ncol=len(handles), loc="lower left", bbox_to_anchor=(0, 1.0), borderaxespad=0.2, handletextpad=0.3)
    picture.image = encode(canvas)
    picture.caption = ("Error over tolerance, a point for each solver and variation (their number in brackets). Left of the line (tinted) passes. "
                       "Filled points pass, open diamonds fail; arrows at the edges lie beyond the axis.")
    return picture


def _mark(axes, row, height: float, colour: str) -> None:
    """One comparison of the figure."""
    value = margin(row)
    if value is None:
        axes.plot(MOST * 1.25, height, marker="x", color=colour, markersize=4.5, linestyle="none")
        return
    marker = "<" if value < LEAST else ">" if value > MOST else "o" if row.verdict == "pass" else "D"
    axes.plot(min(max(value, LEAST), MOST), height, marker=marker, markersize=4.5, linestyle="none", markeredgecolor=colour,
              markerfacecolor=colour if row.verdict == "pass" else "white", markeredgewidth=1.3, alpha=0.9)
