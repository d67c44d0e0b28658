"""Entry point: `python3 -m cupel`. Every foreseen trouble ends in one line on stderr and a non-zero exit status."""

from __future__ import annotations

import sys

import click

from .command_line import app
from .errors import CupelError


def main() -> int:
    try:
        return app(prog_name="cupel", standalone_mode=False) or 0
    except CupelError as error:
        print(f"cupel: {error}", file=sys.stderr)
        return error.status
    except click.exceptions.Abort:
        print("cupel: interrupted", file=sys.stderr)
        return 130
    except click.ClickException as error:
        print(f"cupel: {' '.join(error.format_message().split())} (./cupel --help shows what there is)", file=sys.stderr)
        return error.exit_code
    except KeyboardInterrupt:
        print("cupel: interrupted", file=sys.stderr)
        return 130
    except BrokenPipeError:
        sys.stderr.close()
        return 141


if __name__ == "__main__":
    sys.exit(main())
