"""Numbers in print."""

from __future__ import annotations

import pytest
from cupel.comparison import Row
from reports import formatting
from reports.formatting import number, present, quantity, scale_of


@pytest.mark.parametrize("value, text", [
    (None, "–"), (0, "0"), (1.8261, "1.826"), (-0.25, "−0.2500"), (2e-6, "2.00·10⁻⁶"), (123456.7, "123457"), (3.1e9, "3.10·10⁹")])
def test_numbers(value, text):
    assert number(value) == text


def test_lengths_below_a_millimetre_are_in_micrometres_and_angles_in_degrees():
    assert quantity(1.69e-4, "m") == "169.0 μm"
    assert quantity(1.8261e-3, "m") == "1.826 mm"
    assert quantity(0.7853981634, "rad") == "45.00°"
    assert scale_of("1", 3.0) == (1.0, "")


def test_value_reference_error_and_tolerance_share_a_scale():
    row = Row("c", "sph", "coarse", "apex_height", 1.01e-3, "m", 0.99e-3, "exact", "cap", 2e-5, "absolute", 5e-5, "pass")
    shown = present(row)
    assert (shown["value"], shown["reference"]) == ("1010 μm", "990.0 μm")
    assert (shown["error"], shown["tolerance"], shown["word"]) == ("+20.0 μm", "± 50 μm", "pass")


def test_relative_errors_are_in_percent():
    row = Row("c", "sph", "coarse", "base_radius", 1.0, "m", 1.02, "exact", "cap", -0.0196, "relative", 0.06, "pass")
    assert (present(row)["error"], present(row)["tolerance"]) == ("−1.96 %", "± 6 %")


def test_a_value_has_the_decimals_of_its_uncertainty():
    assert formatting.uncertain(2.42612345, 0.0028, "rad/s") == "2.4261 ± 0.0028 rad/s"
    assert formatting.uncertain(24158.2, 201.0, "Pa") == "24158 ± 201 Pa"
    assert formatting.uncertain(1.07e-4, 1.3e-4, "1") == "1.07·10⁻⁴ ± 1.3·10⁻⁴"
    assert formatting.uncertain(-0.5236, 0.006, "rad") == "−30.00 ± 0.34°"


def test_positive_errors_have_a_sign_and_zero_has_none():
    assert (formatting.signed("0.298°"), formatting.signed("−0.2"), formatting.signed("0")) == ("+0.298°", "−0.2", "0")
