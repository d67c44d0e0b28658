"""Which cases a command line means: names, variations, tiers."""

from __future__ import annotations

import pytest

from cupel import cases
from cupel.errors import CupelError
from cupel.layout import CANONICAL_CASES
from cupel.listing import tolerance_text


def names(*arguments, tier=None, level="coarse"):
    return [member.name for member in cases.select_members(list(arguments), tier, level)]


def test_nothing_named_means_the_canonical_cases():
    assert names() == list(CANONICAL_CASES)
    assert sorted(names(tier="canonical")) == sorted(CANONICAL_CASES)


def test_a_swept_case_means_all_its_variations_and_a_variation_itself():
    assert names("stefan") == ["stefan_dt100", "stefan_dt300", "stefan_dt1000", "stefan_dt300_jitter"]
    assert names("stefan_dt300") == ["stefan_dt300"]
    assert names("stefan_dt300", "stefan") == ["stefan_dt300", "stefan_dt100", "stefan_dt1000", "stefan_dt300_jitter"]
    assert names("static_drop_3d_free_la12") == ["static_drop_3d_free_la12"]       # of static_drop_3d, not of static_drop


def test_a_variation_resolves_to_a_case_of_its_own():
    resolved = cases.find_members("stefan_dt1000")[0].resolve("coarse", ["time.output_interval=0.1 ms"])
    assert resolved["name"] == "stefan_dt1000" and resolved["variation"] == "dt1000"
    assert resolved["domain"]["boundaries"]["z_min"]["temperature"] == 2723.0
    assert resolved["time"]["output_interval"] == 1e-4


def test_a_tier_means_its_cases_that_have_the_level():
    v0 = names(tier="v0")
    assert {"taylor_green", "sessile_drop_free_45deg", "recoil_balance"} <= set(v0)
    assert not set(v0) & set(CANONICAL_CASES)
    assert names(tier="v1") == ["thermocapillary_drop"]
    assert names(tier="v0", level="paper") == ["droplet_wetting_free_surface"]


@pytest.mark.parametrize(("arguments", "tier", "level", "said"), [
    (["stefan_dt30"], None, "coarse", "did you mean 'stefan_dt300'?"),
    (["stefen"], None, "coarse", "did you mean 'stefan'?"),
    (["stefan"], "v0", "coarse", "not both"),
    ([], "v2", "coarse", "no case of tier 'v2' has a level 'coarse'"),
])
def test_what_cannot_be_meant_is_refused_in_one_line(arguments, tier, level, said):
    with pytest.raises(CupelError, match=said.replace("?", r"\?")) as refusal:
        cases.select_members(arguments, tier, level)
    assert refusal.value.status == 2 and "\n" not in str(refusal.value)


def measure(tolerance, metric="relative"):
    return {"unit": "m", "metric": metric, "tolerance": tolerance, "reference": {"kind": "exact"}}


def test_tolerances_that_differ_by_level_are_told_with_their_levels():
    same = {"coarse": measure(0.01), "medium": measure(0.01)}
    assert tolerance_text(same) == "within 1 % of the exact reference"
    finer = {"coarse": measure(0.01), "medium": measure(0.005), "fine": measure(0.005)}
    assert tolerance_text(finer) == "within 1 % from coarse on, 0.5 % from medium on of the exact reference"
    later = {"coarse": measure(None), "medium": measure(0.02)}
    assert tolerance_text(later) == "within 2 % from medium on of the exact reference"
    assert tolerance_text({"coarse": measure(None)}) == "recorded, not judged"


def test_the_listing_has_every_case_under_its_tier(cupel):
    done = cupel("cases")
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert [line for line in lines if line.startswith("Tier")] == ["Tier canonical", "Tier v0", "Tier v1", "Tier long"]
    assert [line.strip() for line in lines if line.startswith("  ") and not line.startswith("   ")] == [
        name for tier in ("canonical", "v0", "v1", "long") for name in cases.case_names()
        if cases.members(cases.find_case(name))[0].tier == tier]
    assert "      variations: dt100, dt300, dt1000, dt300_jitter" in lines
    only = cupel("cases", "--tier", "v1")
    assert "thermocapillary_drop" in only.stdout and "stefan" not in only.stdout
