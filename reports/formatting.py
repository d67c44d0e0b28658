"""Numbers and names as a reader wants to see them."""

from __future__ import annotations

import math

from cupel.comparison import Row

SOLVER_NAMES = {"sph": "SPH", "openfoam": "OpenFOAM"}
QUANTITY_NAMES = {
    "contact_angle": "Contact angle", "base_radius": "Base radius", "apex_height": "Apex height",
    "profile_error": "Velocity profile, L2 error", "return_flow_profile_error": "Velocity profile, L2 error",
    "melt_pool_width": "Melt-pool width", "melt_pool_depth": "Melt-pool depth", "melt_pool_length": "Melt-pool length",
    "bead_height": "Bead height", "energy_closure": "Energy ledger, closure", "volume_closure": "Volume of each phase, change",
    "mechanical_energy_closure": "Mechanical energy ledger, closure",
    "mass_closure": "Mass ledger, closure",
    "laser_absorbed_error": "Laser power absorbed, error", "width_growth_with_power": "Width grows with power",
    "run": "Run", "kept_result": "Kept result",
    "decay_rate": "Decay rate of energy", "velocity_profile_error": "Velocity profile, L2 error",
    "front_position": "Position of the front", "laplace_pressure": "Pressure inside less outside",
    "spurious_capillary_number": "Spurious capillary number", "oscillation_frequency": "Frequency", "oscillation_decay": "Decay rate",
    "oscillation_period": "Period", "wave_error": "Amplitude of the wave, RMS error", "drop_velocity": "Velocity of the drop",
    "start_up_error": "Velocity of the drop, to its exact start",
    "migration_error": "Velocity of the drop, greatest error",
    "migration_error_sharp_interface": "Velocity of the drop, to sharp interface", "recoil_balance_error": "Balance of recoil, error",
}
KIND_NAMES = {"exact": "exact", "tabulated": "tabulated", "solver": "other solver", "experiment": "experiment",
              "paper": "paper", "kept": "kept", None: ""}


def solver_name(solver: str) -> str:
    """The solver's name in print."""
    return SOLVER_NAMES.get(solver, solver)


def quantity_name(quantity: str) -> str:
    """A measure's name in print; also with what follows a comma, as in `NAME, against kept`."""
    name, comma, rest = quantity.partition(", ")
    return QUANTITY_NAMES.get(name, name.replace("_", " ").capitalize()) + comma + rest


def scale_of(unit: str, size: float) -> tuple[float, str]:
    """Factor and printed unit for values of about `size` in SI unit `unit`: lengths in μm or mm, angles in degrees."""
    if unit == "rad":
        return 180 / math.pi, "°"
    if unit == "m":
        return (1e6, "μm") if abs(size) < 1e-3 else (1e3, "mm")
    if unit == "m2" or unit == "m^2":
        return 1e12, "μm²"
    if unit == "s":
        return (1e3, "ms") if abs(size) < 1 else (1.0, "s")
    return 1.0, "" if unit in ("1", "-") else unit.replace("^2", "²").replace("^3", "³").replace("^4", "⁴")


def number(value: float | None, digits: int = 4) -> str:
    """A number with `digits` significant digits; small and large ones with a power of ten; – for None."""
    if value is None:
        return "–"
    if value == 0:
        return "0"
    exponent = math.floor(math.log10(abs(value)))
    if -4 < exponent < 6:
        text = f"{value:.{max(0, digits - 1 - exponent)}f}"
    else:
        mantissa = f"{value / 10**exponent:.{min(digits, 3) - 1}f}"
        text = f"{mantissa}·10{superscript(exponent)}"
    return text.replace("-", "−")


def superscript(exponent: int) -> str:
    """An integer in superscript characters."""
    return str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def quantity(value: float | None, unit: str, like: float | None = None, digits: int = 4) -> str:
    """A value with its unit, in the scale that fits `like` (or itself)."""
    if value is None:
        return "–"
    factor, printed = scale_of(unit, like if like is not None else value)
    text = number(value * factor, digits)
    return text + ("" if printed == "" else printed if printed == "°" else f" {printed}")


def uncertain(value: float, uncertainty: float, unit: str) -> str:
    """A value ± its uncertainty, which has two digits, with as many decimals as that has."""
    factor, printed = scale_of(unit, value)
    value, uncertainty = value * factor, uncertainty * factor
    unit_text = "" if printed == "" else printed if printed == "°" else f" {printed}"
    if uncertainty <= 0.0 or not 1e-3 <= abs(value) < 1e6:
        return f"{number(value)} ± {number(uncertainty, 2)}{unit_text}"
    decimals = min(max(0, 1 - math.floor(math.log10(uncertainty))), 6)
    return f"{value:.{decimals}f} ± {number(uncertainty, 2)}{unit_text}".replace("-", "−")


def present(row: Row) -> dict:
    """A row of comparison in print: texts for value, reference, error and tolerance, with `verdict` in words."""
    like = row.reference if row.reference else row.value
    error = tolerance = "–"
    if row.error is not None:
        error = signed_percent(row.error) if row.metric == "relative" else signed(quantity(row.error, row.unit, like, 3))
    if row.tolerance is not None:
        tolerance = f"± {percent(row.tolerance)}" if row.metric == "relative" else f"± {limit(row.tolerance, row.unit, like)}"
    words = {"pass": "pass", "fail": "fail", "missing": "missing", "none": "not judged"}
    return {
        "case": row.case, "solver": solver_name(row.solver), "quantity": quantity_name(row.quantity),
        "value": quantity(row.value, row.unit, like), "reference": quantity(row.reference, row.unit, like),
        "kind": KIND_NAMES.get(row.reference_kind, row.reference_kind or ""), "source": SOLVER_NAMES.get(row.source, row.source), "error": error,
        "tolerance": tolerance, "verdict": row.verdict, "word": words[row.verdict], "note": row.note,
    }


def limit(value: float, unit: str, like: float | None) -> str:
    """A tolerance with its unit, without trailing zeros."""
    factor, printed = scale_of(unit, like if like is not None else value)
    text = f"{value * factor:.3g}" if value * factor >= 1e-3 else number(value * factor, 2).replace("1.0·", "")
    return text + ("" if printed == "" else printed if printed == "°" else f" {printed}")


def percent(share: float) -> str:
    """A share in percent with the digits that it needs."""
    return f"{100 * share:.3g} %".replace("-", "−")


def signed_percent(share: float) -> str:
    return ("+" if share >= 0 else "−") + f"{abs(100 * share):.2f} %"


def signed(text: str) -> str:
    """A printed number with its sign; none for 0."""
    return text if text.startswith("−") or not any(digit in text for digit in "123456789") else "+" + text


def memory(count: float | None) -> str:
    """Bytes in MB or GB (powers of ten)."""
    if count is None:
        return "–"
    return f"{count / 1e9:.2f} GB" if count >= 1e9 else f"{count / 1e6:.0f} MB"


def grouped(count: float | None) -> str:
    """A whole number with thin spaces between groups of three."""
    return "–" if count is None else f"{int(count):,}".replace(",", "\u2009")
