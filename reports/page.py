"""The page: gathers results, makes figures, fills the template, writes one self-contained file."""

from __future__ import annotations

import datetime
import os
import platform
from collections import Counter
from pathlib import Path

import jinja2
import markupsafe
from cupel import __version__
from cupel.comparison import Row
from cupel.display import duration
from cupel.results import kept_folder, write_whole

from . import formatting
from .colours import solver_colour
from .formatting import grouped, memory, number, present, solver_name
from .formulations import formulations_block
from .gather import Case, Run, gather
from .orders import orders_block
from .pictures import group_views, kind_of, pictures_of, power_views
from .power import power_picture, power_table
from .tiers import TIERS, tier_blocks

HERE = Path(__file__).parent


def write_page(root: Path, names: list[str] | None, variant: str) -> Path:
    """Writes the report of one variant from the results below `root`; returns the page's path.

    `names` None: the canonical cases and whatever else has results. Missing results are shown as missing.
    Raises `CupelError` if the page cannot be written.
    """
    cases, trends = gather(root, names, variant)
    rows = [row for case in cases for run in case.runs for row in run.rows] + trends
    verified = tier_blocks(cases)
    shown = [case for case in cases if case.tier not in TIERS]   # those with a page of their own; the others are in their tier's table
    pictures = pictures_of(shown)
    content = {
        "variant": variant, "made": datetime.datetime.now().astimezone().strftime("%Y-%m-%d %H:%M %Z"), "version": __version__,
        "host": platform.node(), "style": (HERE / "style.css").read_text(),
        "cases": [case_block(case, pictures[case.name], root) for case in shown], "tiers": verified,
        "orders": orders_block(root, cases), "formulations": formulations_block(root, cases, variant),
        "tally": Counter(row.verdict for row in rows), "judged": sum(row.verdict != "none" for row in rows),
        "power": power_picture(shown), "power_rows": power_table(shown), "power_views": power_views(shown, pictures),
        "trends": [present(row) for row in trends],
        "ledgers": [line for case in cases for run in case.runs for line in ledger_lines(run)],
        "costs": [cost_line(run) for case in cases for run in case.runs if run.result],
        "assumed": assumed_table(cases), "commits": commits(cases), "missing": missing_runs(shown),
    }
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    environment.filters |= {"chip": chip, "solver_name": solver_name, "breakable": breakable}
    path = root / "report.html" if variant == "coarse" else root / f"report_{variant}.html"
    write_whole(path, environment.get_template("page.html.j2").render(content))
    return path


def breakable(name: str) -> markupsafe.Markup:
    """A name that may be broken after each underscore."""
    return markupsafe.Markup("_<wbr>").join(name.split("_"))


def chip(verdict: str) -> str:
    """The style class of a verdict."""
    return {"pass": "good", "completed": "good", "fail": "bad", "stopped": "bad", "refused": "bad", "failed": "bad",
            "missing": "absent"}.get(verdict, "plain")


def case_block(case: Case, pictures: list, root: Path) -> dict:
    """Everything about one case that the template prints."""
    return {
        "name": case.name, "title": case.title, "kind": kind_of(case), "paper": case.settings.get("paper", []),
        "runs": [run_block(run, root) for run in case.runs], "views": group_views(pictures),
        "figures": [picture for picture in pictures if not picture.view_of],
        "assumed": assumed_lines(case), "setting": setting_line(case),
        "rows": [present(row) for run in case.runs for row in run.rows],
    }


def run_block(run: Run, root: Path) -> dict:
    """One line of the summary: status, how many comparisons pass, time, links."""
    verdicts = Counter(row.verdict for row in run.rows)
    judged = sum(verdicts.values()) - verdicts["none"]
    folder = kept_folder(run.place.case) / run.solver / run.place.variant if run.kept else run.place.folder
    links = [(name, os.path.relpath(folder / name, root))
             for name in ("result.json", "series.csv", "measures.csv", "log.txt", "fields/fields.pvd") if (folder / name).exists()]
    return {
        "solver": solver_name(run.solver), "colour": solver_colour(run.solver), "status": run.status,
        "kept": run.kept, "diagnosis": run.result["diagnosis"] if run.result else run.rows[0].note, "passed": verdicts["pass"], "judged": judged,
        "failed": verdicts["fail"], "wall": duration(run.result["cost"].get("wall_s")) if run.result else "–", "links": links,
    }


def setting_line(case: Case) -> str:
    """The case in a line: dimensions, spacing, end, physics."""
    if not case.settings:
        return "no result yet, so nothing is known of it here"
    settings = case.settings
    end = formatting.quantity(settings["time"]["end"], "s", digits=3)
    return (f"{settings['dimensions']}-D, spacing {formatting.quantity(settings['spacing'], 'm', digits=3)}, to {end}; "
            f"physics: {', '.join(word.replace('_', ' ') for word in settings['physics'])}")


def assumed_lines(case: Case) -> list[dict]:
    """The case's assumed values in print."""
    return [{"key": entry["key"], "value": assumed_value(entry), "reason": entry.get("reason", "")} for entry in case.assumed]


def assumed_value(entry: dict) -> str:
    """An assumed value with its unit; lists and words as they stand."""
    value, unit = entry.get("value"), entry.get("unit") or "1"
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return formatting.quantity(value, unit, digits=3)
    return str(value)


def assumed_table(cases: list[Case]) -> list[dict]:
    """Every assumed value of the page once, with the cases that depend on it."""
    table: dict[tuple, dict] = {}
    for case in cases:
        for line in assumed_lines(case):
            table.setdefault((line["key"], line["value"], line["reason"]), line | {"cases": []})["cases"].append(case.name)
    return list(table.values())


def ledger_lines(run: Run) -> list[dict]:
    """The ledgers of a run, a line each."""
    if run.result is None:
        return []
    lines = []
    for name, ledger in run.result["ledgers"].items():
        more = ""
        if ledger.get("laser_absorbed") is not None:
            more = (f"laser emitted {number(ledger.get('laser_emitted'))} J, absorbed {number(ledger['laser_absorbed'])} J, "
                    f"error of the absorbed power {number(ledger.get('absorbed_error'), 2)}")
        lines.append({
            "case": run.place.case, "solver": solver_name(run.solver), "ledger": name, "more": more,
            "closure": number(ledger["closure"], 2) if isinstance(ledger.get("closure"), (int, float)) else "–",
        } | {key: printed(ledger.get(key)) for key in ("start", "end", "in", "out")})
    return lines


def printed(value) -> str:
    """A ledger's entry: a number, or the components of a vector."""
    if isinstance(value, list):
        return "(" + ", ".join(number(part, 3) for part in value) + ")"
    return number(value, 5) if isinstance(value, (int, float)) else "–"


def cost_line(run: Run) -> dict:
    """The cost of a run in print."""
    cost = run.result["cost"]
    binding = cost.get("time_step_binding") or {}
    total = sum(binding.values())
    shares = [f"{name.replace('_', ' ')} {100 * count / total:.0f} %" for name, count in
              sorted(binding.items(), key=lambda item: -item[1]) if total and count / total >= 0.005]
    rate = cost.get("updates_per_core_s")
    return {
        "case": run.place.case, "solver": solver_name(run.solver), "wall": duration(cost.get("wall_s")),
        "cpu": duration(cost.get("cpu_s")), "threads": cost.get("threads", "–"), "steps": grouped(cost.get("steps")),
        "elements": grouped(cost.get("elements")), "rate": f"{rate / 1e6:.3g}" if rate else "–",
        "memory": memory(cost.get("peak_bytes")), "binding": ", ".join(shares) or "–", "host": run.result["host"]["name"],
    }


def commits(cases: list[Case]) -> list[str]:
    """Versions of the code that made the results, each once."""
    return sorted({
        f"{solver_name(run.solver)} {run.result['code']['version']}, commit {run.result['code']['commit'] or 'unknown'}"
        + (f", {run.result['code']['reference_version']}" if run.result["code"].get("reference_version") else "")
        for case in cases for run in case.runs if run.result
    })


def missing_runs(cases: list[Case]) -> list[Row]:
    """Runs of which there is no good result."""
    return [row for case in cases for run in case.runs for row in run.rows if row.quantity == "run"]
