"""Which pictures each kind of case gets, and the making of them; a picture that cannot be made says why on the page."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path

from cupel.measures.registry import MeasureError

from . import drops, layers, tracks
from .drawing import Picture, crop
from .formatting import quantity, solver_name
from .gather import Case
from .views import draw


def kind_of(case: Case) -> str:
    """What a case shows: `track`, `drop`, `layer`, or `other`; from its physics and bodies, not from its name."""
    settings = case.settings
    if settings.get("laser"):
        return "track"
    shapes = {body["shape"] for body in settings.get("bodies", [])}
    if "sphere" in shapes and "wetting" in settings.get("physics", []):
        return "drop"
    if "marangoni" in settings.get("physics", []) and "box" in shapes and settings.get("dimensions") == 2:
        return "layer"
    return "other"


MAKERS: dict[str, list[Callable[[Case], Picture]]] = {
    "track": [tracks.along_picture, tracks.across_picture],
    "drop": [drops.motion_picture, drops.shape_picture],
    "layer": [layers.profile_picture, layers.flow_picture],
    "other": [],
}


def attempt(make: Callable[[Case], Picture], case: Case) -> Picture:
    """The picture, or an empty one that says what kept it from being made."""
    try:
        return make(case)
    except (MeasureError, ValueError, KeyError, StopIteration) as error:
        name = make.__name__.removesuffix("_picture")
        reason = f"no '{error.args[0]}' in the snapshots" if isinstance(error, KeyError) else str(error)
        return Picture(f"{case.name}-{name}", "", f"{name} of {case.name}", missing=reason or "nothing to draw")


def pictures_of(cases: list[Case]) -> dict[str, list[Picture]]:
    """All pictures by case name: three-dimensional views first, drawn in one go, then sections."""
    jobs = {case.name: {"track": tracks.view_jobs, "drop": drops.view_jobs}.get(kind_of(case), lambda case: [])(case)
            for case in cases}
    beds: set[str] = set()
    for name, of_case in jobs.items():  # a bed that several tracks share is shown once
        jobs[name] = [job for job in of_case if not (job["file"].endswith(".csv") and job["file"] in beds)]
        beds.update(job["file"] for job in of_case)
    with tempfile.TemporaryDirectory() as folder:
        for job in (job for of_case in jobs.values() for job in of_case):
            job["output"] = str(Path(folder) / f"{job['key']}.png")
        trouble = draw([job for of_case in jobs.values() for job in of_case])
        views = {case.name: views_of(case, jobs[case.name], trouble) for case in cases}
    return {case.name: views[case.name] + [attempt(make, case) for make in MAKERS[kind_of(case)]] for case in cases}


def views_of(case: Case, jobs: list[dict], trouble: str) -> list[Picture]:
    """The drawn views of a case as pictures, a picture a view."""
    kind = kind_of(case)
    ended = {"bed": ""} | {run.solver: "" if run.status == "completed" else f" (run {run.status})" for run in case.runs}
    pictures = []
    for job in jobs:
        _, solver, label = job["key"].rsplit(".", 2)
        what, paper = describe_view(kind, solver, label, case)
        moment = f"t = {quantity(job['time'], 's', digits=3) if job['time'] else '0'}"
        caption = what if solver == "bed" else f"{what}, {moment}{ended[solver]}"
        picture = Picture(job["key"].replace(".", "-"), caption,
                          f"{case.name}, {solver_name(solver)}: {what}", paper=paper, wide=False,
                          view_of="Powder bed" if solver == "bed" else solver_name(solver), of_power=label == "final")
        path = Path(job["output"])
        if path.exists():
            picture.image = crop(path)
        else:
            picture.missing = trouble or "could not be drawn"
        pictures.append(picture)
    return pictures


def describe_view(kind: str, solver: str, label: str, case: Case) -> tuple[str, str]:
    """What a view shows, and the figure of the paper that it answers to ('' if none)."""
    if kind == "drop":
        return ("start", "figure 1") if label == "0" else ("evolution", "figure 2")
    if label == "spheres":
        return "spheres of the powder bed that both solvers read, dark 15 μm to light 45 μm in diameter", "figure 4"
    if label == "start":
        return "start", ""
    if label == "final":
        return f"{case.power:g} W", "figure 7" if solver == "sph" else "figure 8"
    return f"{label.removeprefix('scan')} % of the scan", "figure 5" if "figure 5" in case.settings.get("paper", []) else ""


def group_views(pictures: list[Picture]) -> list[tuple[str, list[Picture]]]:
    """Views of a case by solver, in order; charts and sections are left out."""
    groups: dict[str, list[Picture]] = {}
    for picture in pictures:
        if picture.view_of and not picture.of_power:
            groups.setdefault(picture.view_of, []).append(picture)
    return list(groups.items())


def power_views(cases: list[Case], pictures: dict[str, list[Picture]]) -> list[tuple[str, list[Picture]]]:
    """The final shapes of all tracks by solver, in order of power: the paper's figures 7 and 8."""
    groups: dict[str, list[Picture]] = {}
    for case in sorted((case for case in cases if case.power is not None), key=lambda case: case.power):
        for picture in pictures[case.name]:
            if picture.of_power:
                groups.setdefault(picture.view_of, []).append(picture)
    return list(groups.items())
