"""`./cupel run --solver external --from DIR`: takes in results of any other solver that keep the schema."""

from __future__ import annotations

import shutil
from pathlib import Path

from .comparison import fill_solver_references, judge
from .errors import CupelError, describe_system_error
from .layout import SOLVERS, ResultPlace
from .results import check_result, move_aside, read_json, write_result


def take_in(source: Path | None, root: Path) -> int:
    """Copies every result.json below `source`, with what lies beside it, into `root`; returns how many.

    All are checked before any is copied. Errors and verdicts are worked out anew from values, references and tolerances;
    a result that bears the name of one of Cupel's own solvers is refused. Raises `CupelError`.
    """
    if source is None or not source.is_dir():
        raise CupelError("--solver external needs --from with a folder of results", status=2)
    found = sorted(source.rglob("result.json"))
    if not found:
        raise CupelError(f"no result.json below {source}", status=2)
    results = [(path, check_result(read_json(path), path)) for path in found]
    for path, result in results:
        if result["solver"] in SOLVERS:
            raise CupelError(f"{path}: solver '{result['solver']}' is one of Cupel's own; give it another name", status=2)
        for key in ("case", "solver", "variant"):
            if "/" in result[key] or result[key].startswith("."):
                raise CupelError(f"{path}: {key} '{result[key]}' cannot be the name of a folder", status=2)
    for path, result in results:
        place = ResultPlace(root, result["case"], result["solver"], result["variant"])
        move_aside(place)
        try:
            shutil.copytree(path.parent, place.folder, ignore=shutil.ignore_patterns("result.json"))
        except (OSError, shutil.Error) as error:
            raise (describe_system_error(error, place.folder) if isinstance(error, OSError) and error.errno
                   else CupelError(f"cannot copy {path.parent} to {place.folder}")) from None
        measures = [judge(measure) for measure in result["measures"]]
        write_result(place.folder, result | {"measures": measures})
        fill_solver_references(root, place.case, place.variant)
    return len(results)
