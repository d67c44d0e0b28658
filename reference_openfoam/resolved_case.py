"""The resolved case as this solver needs it: read, checked, and split into primary and surrounding material."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .errors import Refused

# What each model asks of the primary material, beyond density.
NEEDS = {
    "flow": ("viscosity",),
    "surface_tension": ("surface_tension",),
    "wetting": ("contact_angle",),
    "marangoni": ("surface_tension_slope",),
    "recoil": ("boiling_temperature", "vaporization_heat", "molar_mass"),
    "evaporation": ("boiling_temperature", "vaporization_heat", "molar_mass"),
    "radiation": ("emissivity",),
    "heat": ("specific_heat", "conductivity"),
    "melting": ("solidus", "liquidus", "latent_heat"),
    "laser": (),
    "gravity": (),
}
SURROUNDING_NEEDS = {"flow": ("viscosity",), "heat": ("specific_heat", "conductivity")}
NARROWEST_MUSHY_RANGE = 0.1         # K: a material with one melting point is given this range around it
SIDES = ("x_min", "x_max", "y_min", "y_max", "z_min", "z_max")
KINDS = ("wall", "symmetry", "open", "periodic")


@dataclass(frozen=True)
class ResolvedCase:
    """A checked case. `data` is the whole JSON object; the rest are the parts that are asked for often (SI units)."""

    data: dict[str, Any]
    path: Path

    @property
    def name(self) -> str:
        return self.data["name"]

    @property
    def physics(self) -> list[str]:
        return self.data["physics"]

    @property
    def spacing(self) -> float:
        return float(self.data["spacing"])

    @property
    def is_planar(self) -> bool:
        """True for a scene in the x-z plane, one cell thick."""
        return self.data["dimensions"] == 2

    @property
    def has_temperature(self) -> bool:
        """Whether there is a temperature field: solved for, or frozen where only Marangoni stress or recoil need it."""
        return bool({"heat", "marangoni", "recoil"} & set(self.physics))

    @property
    def melting_range(self) -> tuple[float, float]:
        """Solidus and liquidus of the primary material as this solver takes them [K]."""
        solidus, liquidus = float(self.primary["solidus"]), float(self.primary["liquidus"])
        if liquidus - solidus >= NARROWEST_MUSHY_RANGE:
            return solidus, liquidus
        middle = 0.5*(solidus + liquidus)
        return middle - 0.5*NARROWEST_MUSHY_RANGE, middle + 0.5*NARROWEST_MUSHY_RANGE

    @property
    def lower(self) -> list[float]:
        return self.data["domain"]["lower"]

    @property
    def upper(self) -> list[float]:
        return self.data["domain"]["upper"]

    @property
    def boundaries(self) -> dict[str, dict[str, Any]]:
        return self.data["domain"]["boundaries"]

    @property
    def surrounding_name(self) -> str | None:
        return (self.data.get("surrounding") or {}).get("material")

    @property
    def primary_name(self) -> str:
        """The one material of bodies that is not the surrounding one."""
        return next(body["material"] for body in self.data["bodies"] if body["material"] != self.surrounding_name)

    @property
    def primary(self) -> dict[str, float]:
        return self.data["materials"][self.primary_name]

    @property
    def surrounding(self) -> dict[str, float]:
        """Properties of what surrounds the bodies; where nothing does, those of the bodies, which fill the domain."""
        return self.data["materials"][self.surrounding_name] if self.surrounding_name else self.primary

    @property
    def end(self) -> float:
        return float(self.data["time"]["end"])

    @property
    def output_interval(self) -> float:
        return float(self.data["time"]["output_interval"])


def read(path: Path) -> ResolvedCase:
    """Read and check a resolved case.

    Errors: Refused, one line that names the file, the key and what is wrong.
    """
    try:
        data = json.loads(Path(path).read_text(encoding="utf-8"))
    except OSError as error:
        raise Refused(f"{path}: cannot be read: {error.strerror}") from None
    except (json.JSONDecodeError, UnicodeDecodeError) as error:
        raise Refused(f"{path}: is no JSON: {error}") from None
    case = ResolvedCase(data, Path(path))
    try:
        _check(case)
    except KeyError as error:
        raise Refused(f"{path}: {error.args[0]}: is missing; write the case with `cupel_case resolve`") from None
    except (TypeError, ValueError, StopIteration, AttributeError) as error:
        raise Refused(f"{path}: is no resolved case ({error or 'no body'}); write it with `cupel_case resolve`") from None
    return case


def _require(condition: bool, case: ResolvedCase, key: str, trouble: str) -> None:
    if not condition:
        raise Refused(f"{case.path}: {key}: {trouble}")


def _positive(case: ResolvedCase, key: str, value: Any) -> None:
    _require(isinstance(value, (int, float)) and math.isfinite(value) and value > 0, case, key,
             f"must be a number above 0, not {value}")


def _check(case: ResolvedCase) -> None:
    data = case.data
    _require(data["schema"] == 1, case, "schema", f"this solver reads schema 1, not {data['schema']}")
    _require(data["dimensions"] in (2, 3), case, "dimensions", "must be 2 or 3")
    unknown = sorted(set(case.physics) - set(NEEDS))
    _require(not unknown, case, "physics", f"this solver has no model '{', '.join(unknown)}'")
    _positive(case, "spacing", data["spacing"])
    _positive(case, "time.end", data["time"]["end"])
    _positive(case, "time.output_interval", data["time"]["output_interval"])
    _check_domain(case)
    _check_materials(case)
    _check_bodies(case)
    if "laser" in case.physics:
        _require(not case.is_planar, case, "dimensions", "a laser needs 3 dimensions in this solver")
        _require(data.get("laser") is not None, case, "laser", "is missing, though physics names it")
        _require("heat" in case.physics, case, "physics", "a laser needs 'heat'")
        _positive(case, "laser.spot_radius", data["laser"]["spot_radius"])
        if (data["numerics"].get("openfoam") or {}).get("ray_tracing"):
            # greatest absorptivity at normal incidence that Fresnel's law has in the form of Hagen and Rubens: 2 sqrt(2) - 2
            _require(0 < data["laser"]["absorptivity"] < 0.828, case, "laser.absorptivity",
                     "must be above 0 and below 0.828 for ray tracing: it is that of a flat metal surface")
    _require("flow" in case.physics or "heat" in case.physics, case, "physics", "names neither 'flow' nor 'heat'")


def _check_domain(case: ResolvedCase) -> None:
    _require(not case.data["domain"].get("round_walls"), case, "domain.round_walls",
             "is there, but this solver's walls are flat; run the case in SPH")
    for axis, name in enumerate("xyz"):
        if case.is_planar and name == "y":
            continue
        length = case.upper[axis] - case.lower[axis]
        _require(length >= 0.999*case.spacing, case, f"domain.upper[{axis}]", "leaves no room for one cell")
    for side in SIDES:
        if case.is_planar and side.startswith("y"):
            continue
        kind = case.boundaries[side]["kind"]
        _require(kind in KINDS, case, f"domain.boundaries.{side}.kind", f"must be one of {', '.join(KINDS)}, not '{kind}'")
        opposite = side[:2] + ("max" if side.endswith("min") else "min")
        _require((kind == "periodic") == (case.boundaries[opposite]["kind"] == "periodic"), case,
                 f"domain.boundaries.{side}.kind", f"is periodic on one side only; make {opposite} periodic too")


def _check_materials(case: ResolvedCase) -> None:
    names = {body["material"] for body in case.data["bodies"]} - {case.surrounding_name}
    _require(bool(names), case, "bodies", "there is no body of a material other than the surrounding")
    _require(len(names) == 1, case, "bodies", f"this solver models one material beside the surrounding, not {len(names)}")
    for name, material, needs in ((case.primary_name, case.primary, NEEDS),
                                  (case.surrounding_name, case.surrounding, SURROUNDING_NEEDS)):
        if name is None:
            continue
        wanted = ["density"] + [key for model in case.physics for key in needs.get(model, ())]
        if needs is NEEDS and {"flow", "melting"} <= set(case.physics):
            wanted.append("mushy_drag")
        for key in wanted:
            _require(key in material, case, f"materials.{name}.{key}", "is missing, though physics needs it")
        for key in ("density", "specific_heat", "specific_heat_solid"):
            if key in material:
                _positive(case, f"materials.{name}.{key}", material[key])
        for key in ("viscosity", "conductivity", "conductivity_solid", "latent_heat", "surface_tension"):
            _require(material.get(key, 0) >= 0, case, f"materials.{name}.{key}", "must not be negative")
    if "melting" in case.physics:
        _require(case.primary["liquidus"] >= case.primary["solidus"], case, f"materials.{case.primary_name}.liquidus",
                 "is below the solidus")


def _check_bodies(case: ResolvedCase) -> None:
    for index, body in enumerate(case.data["bodies"]):
        _require(body["shape"] in ("box", "sphere", "powder_bed"), case, f"bodies[{index}].shape",
                 f"this solver knows box, sphere and powder_bed, not '{body['shape']}'")
        if body["shape"] == "powder_bed":
            _require(Path(body["file"]).is_file(), case, f"bodies[{index}].file",
                     f"there is no bed {body['file']}; make it with: ./cupel bed {case.name}")
        moves = "flow" in case.physics and "melting" not in case.physics
        _require(not (moves and body["state"] == "solid" and body["material"] == case.primary_name), case,
                 f"bodies[{index}].state", "a solid body in a flow needs 'melting' in physics")
