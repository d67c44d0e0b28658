"""Command line: `python3 -m reference_openfoam run RESOLVED.json --output DIR [--threads N] [--resume]`.

Exit status: 0 completed, 1 stopped (diagnosis in run.json), 2 refused (nothing written), 130 interrupted with a checkpoint.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from .errors import Refused


def main(arguments: list[str] | None = None) -> int:
    """Parse the command line and do what it says; returns the exit status."""
    parser = argparse.ArgumentParser(prog="reference_openfoam", description="OpenFOAM reference of Cupel")
    commands = parser.add_subparsers(dest="command", required=True)
    run = commands.add_parser("run", help="run a resolved case")
    run.add_argument("case", type=Path, help="resolved case, JSON as `cupel_case resolve` prints it")
    run.add_argument("--output", type=Path, required=True, help="folder for the result")
    run.add_argument("--threads", "-np", type=int, default=1, dest="threads", help="ranks to run side by side (MPI), at most")
    run.add_argument("--resume", action="store_true", help="go on from the newest checkpoint in the output folder")
    write = commands.add_parser("write", help="write the OpenFOAM case only")
    write.add_argument("case", type=Path, help="resolved case, JSON")
    write.add_argument("--output", type=Path, required=True, help="folder of the OpenFOAM case")
    options = parser.parse_args(arguments)
    try:
        from . import case_writer, resolved_case, run as runner
        case = resolved_case.read(options.case)
        if options.command == "write":
            case_writer.write_case(case, options.output)
            return 0
        return runner.run(case, options.output, threads=options.threads, resume=options.resume)
    except Refused as refusal:
        print(f"reference_openfoam: {refusal}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
