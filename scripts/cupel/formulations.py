"""Sets of numerics that a case can be run with beside the default one, so that a reader sees what each remedy does.

A formulation is a list of overrides of `[numerics]`. Its results stand beside the default ones, in the variant LEVEL-FORMULATION, and are
kept and reported like them; the verdict on the suite is that on the default.
"""

from __future__ import annotations

from .layout import LEVELS

DEFAULT = "default"

# Name: what it changes, in words; overrides.
FORMULATIONS = {
    DEFAULT: ("Cupel's own numerics", ()),
    "paper": ("the paper's: artificial viscosity, stress and heat, a continuum surface force, no shifting, no density diffusion",
              ("numerics.formulation=paper",)),
    "continuum_force": ("the default with Brackbill's continuum surface force in place of the load that is carried into the liquid",
                        ("numerics.surface_load=continuum_force",)),
    "no_contact_line_force": ("the default without Young's force at contact lines, normals on walls alone",
                              ("numerics.contact_line_force=false",)),
    "no_shifting": ("the default without particle shifting (two phases: without their transport velocity)", ("numerics.shifting=0",)),
    "no_density_diffusion": ("the default without density diffusion", ("numerics.density_diffusion=0",)),
    "artificial_viscosity": ("the default with the paper's artificial viscosity", ("numerics.artificial_viscosity=0.1",)),
    "artificial_stress": ("the default with the paper's artificial stress", ("numerics.artificial_stress=0.2",)),
    "artificial_heat": ("the default with the paper's artificial heat", ("numerics.artificial_heat=0.1",)),
}


def variant_of(level: str, formulation: str) -> str:
    """Name of the variant of a level in a formulation."""
    return level if formulation == DEFAULT else f"{level}-{formulation}"


def parts_of(variant: str) -> tuple[str, str] | None:
    """(level, formulation) of a variant; None where it is neither a level nor one in a formulation."""
    level, _, formulation = variant.partition("-")
    formulation = formulation or DEFAULT
    return (level, formulation) if level in LEVELS and formulation in FORMULATIONS and variant_of(level, formulation) == variant else None


def overrides_of(formulation: str) -> list[str]:
    """What a formulation changes, as `key=value` texts."""
    return list(FORMULATIONS[formulation][1])
