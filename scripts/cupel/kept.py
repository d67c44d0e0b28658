"""Kept results: what is too long to run each time, kept as data beside its case.

    validation_cases/CASE/kept/[VARIATION/]SOLVER/LEVEL[-FORMULATION]/result.json and series.csv

`./cupel keep` is the only way in; it refuses what could not be made again from the repository. What is kept stands in for a result that
has not been run, is judged like one, and is what a fresh one is compared with (the model-regression check).
"""

from __future__ import annotations

import functools
import math
import shutil
import subprocess
from pathlib import Path

from .cases import Member, find_members
from .comparison import Row
from .errors import CupelError, describe_system_error
from .formulations import DEFAULT, overrides_of, parts_of, variant_of
from .layout import ROOT, ResultPlace
from .results import check_result, read_kept, read_result, write_json

# What a result depends on, by solver: folders and files whose commits make a kept result older than the code.
DEPENDS_ON = {
    "sph": ("sph_solver", "CMakeLists.txt"),
    "openfoam": ("reference_openfoam", "CMakeLists.txt"),
}
# What the reference reads of `numerics`; all else there is SPH's, and none of what the reference has is.
READ_BY_REFERENCE = ("time_step_factor", "openfoam")
# What changes nothing but the order of sums: how long lists of neighbours hold.
OF_NO_EFFECT = ("skin",)
# A limit, which decides nothing for a run that does not come to it: how many steps of sound make one of all else at most.
STEPS_OF_SOUND = "acoustic_substeps"
MEASURED_BY = ("scripts/cupel/measures", "scripts/cupel/exact")
NOT_CODE = (":(exclude)*.md",)

# A measure has moved when it differs from the kept one by more than both its uncertainty and this share of its tolerance,
# or, where it has none, of its value.
SHARE_OF_TOLERANCE = 0.1
SHARE_OF_VALUE = 0.01


def keep(root: Path, members: list[Member], solvers: tuple[str, ...], level: str, formulation: str = DEFAULT) -> list[Path]:
    """Keeps the results of `members` at `level` in a formulation; returns their folders. All are checked before any is kept.

    Raises `CupelError`, one line, for a result that is missing, not completed, of changed sources, or not of the case as it is now.
    """
    chosen, variant = [], variant_of(level, formulation)
    for member in members:
        present = member.resolve(level, *_overrides(formulation))
        for solver in solvers:
            place = ResultPlace(root, member.name, solver, variant)
            chosen.append((place, _fit_to_keep(place, present), member.kept / solver / variant))
    for place, result, folder in chosen:
        _store(place, result, folder)
    return [folder for _, _, folder in chosen]


def _overrides(formulation: str) -> tuple[list[str], ...]:
    return () if formulation == DEFAULT else (overrides_of(formulation),)


def same_case(solver: str, one: dict, other: dict, cost: dict | None = None) -> bool:
    """Whether two resolved cases are the same to a solver: their hashes are equal, or only what the other solver reads differs.

    With the cost of a result of `one`, limits of `other` that its run would not have come to make no difference either.
    """
    if one.get("hash") == other.get("hash"):
        return True
    of_no_effect = OF_NO_EFFECT if _comes_to_limit(one, other, cost or {}) else (*OF_NO_EFFECT, STEPS_OF_SOUND)
    return _as_read_by(solver, one, of_no_effect) == _as_read_by(solver, other, of_no_effect)


def _comes_to_limit(one: dict, other: dict, cost: dict) -> bool:
    """Whether a run of `one` took, or would have taken, as many steps of sound at a time as either case allows.

    It does not where sound has never bound a step and `other` allows no fewer, or where a step had, on the average, fewer by one
    than either allows (the limit of a scene's forces, which alone changes from step to step, moves that by less).
    """
    allowed = [case.get("numerics", {}).get(STEPS_OF_SOUND) for case in (one, other)]
    if None in allowed or not {"steps", "acoustic_steps", "time_step_binding"} <= cost.keys():
        return True
    never_bound = not {"acoustic", "force"} & cost["time_step_binding"].keys()
    if never_bound and allowed[1] >= allowed[0]:
        return False
    return cost["acoustic_steps"] > (min(allowed) - 1) * cost["steps"]


def _as_read_by(solver: str, settings: dict, of_no_effect: tuple[str, ...] = OF_NO_EFFECT) -> dict:
    """A resolved case without what does not decide what is computed: where files lie, and numerics that the solver does not read."""
    rest = {key: value for key, value in settings.items() if key not in ("hash", "case_file", "numerics")}
    rest["bodies"] = [{key: value for key, value in body.items() if key != "file"} for body in settings.get("bodies") or []]
    numerics = settings.get("numerics") or {}
    read = [key for key in numerics if (key in READ_BY_REFERENCE if solver == "openfoam" else key not in ("openfoam", *of_no_effect))]
    # A result without a resolved case beside its hash is known by that alone.
    known = {} if "numerics" in settings else {"hash": settings.get("hash")}
    return rest | known | {"numerics": {key: numerics[key] for key in read}}


def _fit_to_keep(place: ResultPlace, present: dict) -> dict:
    """The result at `place` if it may be kept."""
    result = read_result(place)
    if result is None:
        raise CupelError(f"{place}: no result to keep; run it first: ./cupel run {place.case} --solver {place.solver} {_options_of(place.variant)}")
    if result["status"] != "completed":
        raise CupelError(f"{place}: {result['status']}, not completed: {result['diagnosis']}; only completed results are kept")
    commit = result["code"]["commit"]
    if not commit or commit == "unknown" or "+" in commit:
        raise CupelError(f"{place}: made by commit '{commit or 'unknown'}', a state that the repository does not have; "
                         "commit the changes, build and run it again")
    if not _git("cat-file", "-e", f"{commit}^{{commit}}").ok:
        raise CupelError(f"{place}: its commit {commit} is not in this repository; run it again")
    if not same_case(place.solver, result["settings"], present, result.get("cost")):
        raise CupelError(f"{place}: the case file resolves to something else now (its hash differs); run it again")
    return result


def _options_of(variant: str) -> str:
    level, formulation = parts_of(variant) or (variant, DEFAULT)
    return f"--level {level}" + ("" if formulation == DEFAULT else f" --formulation {formulation}")


def _store(place: ResultPlace, result: dict, folder: Path) -> None:
    """Writes a kept result whole: into a folder beside, then in the old one's place."""
    beside = folder.with_name(f".{folder.name}.new")
    try:
        shutil.rmtree(beside, ignore_errors=True)
        beside.mkdir(parents=True)
        write_json(beside / "result.json", check_result(result | {"settings": _without_places(result["settings"])}, beside))
        if (place.folder / "series.csv").exists():
            shutil.copyfile(place.folder / "series.csv", beside / "series.csv")
        shutil.rmtree(folder, ignore_errors=True)
        beside.rename(folder)
    except OSError as error:
        raise describe_system_error(error, folder) from None


def _without_places(settings: dict) -> dict:
    """A resolved case whose files are named as the repository sees them: the case file, and tables of particles."""
    named = {"case_file": _inside(settings["case_file"])} if "case_file" in settings else {}
    if settings.get("bodies"):
        named["bodies"] = [body | {"file": _inside(body["file"])} if body.get("file") else body for body in settings["bodies"]]
    return settings | named


def _inside(path: str) -> str:
    """A path as the repository sees it, without where the repository lies."""
    try:
        return str(Path(path).resolve().relative_to(ROOT))
    except ValueError:
        return Path(path).name


class _Answer:
    def __init__(self, ok: bool, text: str):
        self.ok, self.text = ok, text


@functools.cache
def _git(*arguments: str) -> _Answer:
    """What git says in the repository; not ok where there is no git or no repository."""
    try:
        done = subprocess.run(["git", "-C", str(ROOT), *arguments], capture_output=True, text=True)
    except OSError:
        return _Answer(False, "")
    return _Answer(done.returncode == 0, done.stdout.strip())


def age(result: dict) -> str:
    """What has changed since a kept result was made, in words; empty if nothing that it depends on has."""
    commit, parts = result["code"]["commit"], []
    present = present_case(result["case"], result["variant"])
    if present is not None and not same_case(result["solver"], result["settings"], present, result.get("cost")):
        parts.append("the case resolves to something else now")
    for what, paths in (("the solver", DEPENDS_ON.get(result["solver"], ())), ("the measures", MEASURED_BY)):
        if not paths:
            continue
        counted = _git("rev-list", "--count", f"{commit}..HEAD", "--", *paths, *NOT_CODE)
        if not counted.ok:
            return f"its commit {commit} is not known here: its age cannot be told"
        changed = _git("status", "--porcelain", "--untracked-files=no", "--", *paths, *NOT_CODE)
        if counted.text != "0":
            parts.append(f"{counted.text} commit{'s' if counted.text != '1' else ''} to {what} since")
        elif changed.text:
            parts.append(f"{what} has changes that are not committed")
    return ", ".join(parts)


def present_case(case: str, variant: str) -> dict | None:
    """The case as its file resolves now; None where that cannot be told (no such case or variant, no build)."""
    parts = parts_of(variant)
    if parts is None:
        return None
    level, formulation = parts
    try:
        return find_members(case)[0].resolve(level, *_overrides(formulation))
    except CupelError:
        return None


def regression_rows(fresh: dict) -> list[Row]:
    """A fresh completed result against the kept one of the same case, solver and level: a row a measure, and none without a kept one.

    Settings that differ are no regression of the model: one row says that nothing was compared.
    """
    try:
        kept = read_kept(fresh["case"], fresh["solver"], fresh["variant"])
    except CupelError as error:
        return [_row(fresh, "kept_result", verdict="fail", note=str(error))]
    if kept is None or fresh["status"] != "completed":
        return []
    name = f"kept result of {kept['code']['commit']}"
    if not same_case(fresh["solver"], kept["settings"], fresh["settings"], kept.get("cost")):
        return [_row(fresh, "kept_result", note=f"{name} is of other settings: not compared; keep the fresh one")]
    before = {measure["name"]: measure for measure in kept["measures"]}
    return [_moved(fresh, measure, before[measure["name"]], name) for measure in fresh["measures"] if measure["name"] in before]


def _moved(result: dict, measure: dict, kept: dict, name: str) -> Row:
    """The row of one measure: fails where it has moved by more than its uncertainty and the bound."""
    value, reference = measure["value"], kept["value"]
    quantity = f"{measure['name']}, against kept"
    if value is None or reference is None:
        same = value is None and reference is None
        return _row(result, quantity, value, measure["unit"], reference, name, verdict="none" if same else "fail",
                    note="could be measured in one of the two only" if not same else "could not be measured in either")
    tolerance = kept.get("tolerance")
    if tolerance is None:
        bound = SHARE_OF_VALUE * abs(reference)
    else:
        scale = abs(kept["reference"] or reference) if kept["metric"] == "relative" else 1.0
        bound = SHARE_OF_TOLERANCE * tolerance * scale
    limit = max(bound, math.hypot(measure.get("uncertainty") or 0.0, kept.get("uncertainty") or 0.0))
    moved = value - reference
    return _row(result, quantity, value, measure["unit"], reference, name, error=moved, tolerance=limit,
                verdict="pass" if abs(moved) <= limit else "fail")


def _row(result: dict, quantity: str, value=None, unit="", reference=None, source="", error=None, tolerance=None,
         verdict="none", note="") -> Row:
    return Row(result["case"], result["solver"], result["variant"], quantity, value, unit, reference,
               "kept" if reference is not None else None, source, error, "absolute" if error is not None else None, tolerance, verdict, note)
