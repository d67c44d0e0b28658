"""Formulations: sets of numerics beside the default one, their variants, and what is kept of them."""

from __future__ import annotations

import pytest
from cupel import cases
from cupel.formulations import DEFAULT, FORMULATIONS, overrides_of, parts_of, variant_of


@pytest.mark.parametrize("formulation", FORMULATIONS)
def test_a_variant_tells_its_level_and_formulation(formulation):
    assert parts_of(variant_of("medium", formulation)) == ("medium", formulation)


@pytest.mark.parametrize("variant", ["coarse-3fa9c1", "tiny", "coarse-default", "coarse-unknown", "-paper", ""])
def test_other_variants_are_none(variant):
    assert parts_of(variant) is None


def test_the_default_has_the_level_alone_and_changes_nothing():
    assert variant_of("coarse", DEFAULT) == "coarse" and overrides_of(DEFAULT) == []


@pytest.mark.parametrize("formulation", [name for name in FORMULATIONS if name != DEFAULT])
def test_each_changes_the_numerics_and_nothing_else(formulation):
    member = cases.find_members("static_drop_two_phase_la120")[0]
    plain, changed = member.resolve("coarse"), member.resolve("coarse", overrides_of(formulation))
    assert changed["numerics"] != plain["numerics"]
    different = {key for key in plain if plain[key] != changed[key]}
    assert different == {"numerics", "hash"}


def test_a_formulation_without_sph_is_refused(cupel, tmp_path):
    done = cupel("run", "taylor_green", "--formulation", "paper", "--results", tmp_path, "--no-report")
    assert done.returncode == 2 and "--solver sph" in done.stderr
