"""OpenFOAM's file format: headers, dictionaries and fields, written and read."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np

from .errors import Refused


def header(kind: str, name: str, note: str = "") -> str:
    """The FoamFile block of an ASCII file."""
    extra = f'    note "{note}";\n' if note else ""
    return f"FoamFile\n{{\n    version 2.0;\n    format ascii;\n    class {kind};\n{extra}    object {name};\n}}\n\n"


def entry(value: Any) -> str:
    """A Python value as OpenFOAM writes it: words and numbers, (lists), yes/no; strings are taken as they are."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, (list, tuple)):
        return "(" + " ".join(entry(item) for item in value) + ")"
    return str(value)


def dictionary(entries: dict[str, Any], indent: int = 0) -> str:
    """Nested dict as text; a key that is a pattern brings its own quotes."""
    text, space = "", " "*indent
    for key, value in entries.items():
        if isinstance(value, dict):
            text += f"{space}{key}\n{space}{{\n{dictionary(value, indent + 4)}{space}}}\n"
        else:
            text += f"{space}{key} {entry(value)};\n"
    return text


def write_dictionary(path: Path, entries: dict[str, Any]) -> None:
    """Write a dictionary file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(header("dictionary", path.name) + dictionary(entries))


def scalar_list(values: np.ndarray) -> str:
    """(n,) as `nonuniform List<scalar> n(...)`."""
    return f"nonuniform List<scalar> {len(values)}\n(\n" + "\n".join(map(repr, values.tolist())) + "\n)"


def vector_list(values: np.ndarray) -> str:
    """(n, 3) as `nonuniform List<vector> n(...)`."""
    rows = "\n".join(f"({x!r} {y!r} {z!r})" for x, y, z in values.tolist())
    return f"nonuniform List<vector> {len(values)}\n(\n{rows}\n)"


def write_field(path: Path, kind: str, dimensions: str, internal: str, boundary: dict[str, dict[str, Any]]) -> None:
    """Write a field file. kind: volScalarField or volVectorField; dimensions: e.g. `[0 1 -1 0 0 0 0]`."""
    write_field_with(path, kind, dimensions, internal, dictionary({"boundaryField": boundary}))


def write_field_with(path: Path, kind: str, dimensions: str, internal: str, boundary_section: str) -> None:
    """Write a field file whose boundaryField is there as text."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(header(kind, path.name) + f"dimensions {dimensions};\n\ninternalField {internal};\n\n{boundary_section}")


def boundary_section(path: Path) -> str:
    """The text of boundaryField of a field file in ASCII form."""
    text = path.read_text()
    return text[text.index("boundaryField"):]


def read_field(path: Path, cells: int) -> np.ndarray:
    """Internal values of a field in binary or ASCII form: (cells,) or (cells, 3).

    Errors: Refused if the file is cut short or no field.
    """
    raw = path.read_bytes()
    place = raw.find(b"internalField")
    found = re.compile(rb"internalField\s+(uniform|nonuniform)\s+").match(raw, place) if place >= 0 else None
    if not found:
        raise Refused(f"{path}: is no OpenFOAM field, or cut short")
    binary = re.search(rb"format\s+binary\s*;", raw[:place]) is not None
    if found.group(1) == b"uniform":
        text = raw[found.end():raw.index(b";", found.end())].decode().strip()
        values = np.array(text.strip("()").split(), dtype=float)
        return np.full(cells, values[0]) if len(values) == 1 else np.tile(values, (cells, 1))
    start = re.compile(rb"List<(scalar|vector)>\s+(\d+)\s*\(").match(raw, found.end())
    if not start or int(start.group(2)) != cells:
        raise Refused(f"{path}: does not hold {cells} values")
    width = 3 if start.group(1) == b"vector" else 1
    if binary:
        if len(raw) < start.end() + 8*width*cells:
            raise Refused(f"{path}: is cut short")
        values = np.frombuffer(raw, dtype="<f8", count=width*cells, offset=start.end())
    else:
        end = raw.find(b";", start.end())
        values = np.array(raw[start.end():end].translate(None, b"()").split(), dtype=float)
        if len(values) != width*cells:
            raise Refused(f"{path}: is cut short")
    return values.copy() if width == 1 else values.reshape(cells, 3).copy()
