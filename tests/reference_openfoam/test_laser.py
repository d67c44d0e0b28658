"""Where light goes: first hit and shadow, rays with reflections; each against what geometry and Fresnel's law say."""

from __future__ import annotations

import numpy as np
import pytest

from tests.reference_openfoam import small_cases

RAYS = {"openfoam": {"ray_tracing": True}}


def fresnel(angle, number):
    """Absorptivity at an angle of incidence, Hagen-Rubens form (Schulz et al. 1987), written down anew."""
    c = np.cos(angle)
    return 1 - 0.5*((1 + (1 - number*c)**2)/(1 + (1 + number*c)**2)
                    + (number**2 - 2*number*c + 2*c**2)/(number**2 + 2*number*c + 2*c**2))


def plate(*bodies, spacing=2e-5, spot_radius=6e-5, **changes):
    """A plate of 400 um under 200 um of gas, heated for an instant by a beam at its middle; then `bodies` on or in it."""
    box = {"shape": "box", "material": "steel", "state": "solid", "lower": [-2e-4, -2e-4, -2e-4], "upper": [2e-4, 2e-4, 0.0]}
    parts = dict(spacing=spacing, physics=["heat", "laser"],
                 domain={"lower": [-2e-4, -2e-4, -2e-4], "upper": [2e-4, 2e-4, 2e-4], "boundaries": small_cases.boundaries(z_max=small_cases.OPEN)},
                 bodies=[box, *bodies], time={"end": 1e-8, "output_interval": 1e-8},
                 laser={"power": 100.0, "speed": 0.0, "spot_radius": spot_radius, "absorptivity": 0.35, "start": 0.0,
                        "path": {"from": [0.0, 0.0], "to": [0.0, 0.0]}})
    return small_cases.grain_on_plate(**(parts | changes))


def heat_of(data, folder):
    """Absorbed share of the emitted light, and heat taken by each cell over all heat (n,), with cell centres (n, 3)."""
    record = small_cases.completed(data, folder)
    energy = record["ledgers"]["energy"]
    assert energy["absorbed_error"] < 1e-9
    fields, centres = small_cases.last_fields(data, folder)
    heat = fields["volume"]*fields["density"]*(fields["temperature"] - 300)
    return energy["laser_absorbed"]/energy["laser_emitted"], heat/heat.sum(), centres


def test_a_grain_above_the_plate_takes_the_light_and_leaves_a_shadow_of_its_width(tmp_path):
    # a sphere that nowhere touches the plate: from above the light meets its upper half, and the plate outside its outline
    radius, spacing = 6e-5, 2e-5
    grain = {"shape": "sphere", "material": "steel", "state": "solid", "center": [0.0, 0.0, 1e-4], "radius": radius}
    absorbed, heat, centres = heat_of(plate(grain), tmp_path)
    assert absorbed == pytest.approx(0.35, rel=1e-4)
    on_grain = centres[:, 2] > 2e-5
    upper = on_grain & (centres[:, 2] > 1e-4 - spacing)
    def within(r):
        return 1 - np.exp(-2*(r/radius)**2)     # share of the beam within r of its axis; the spot radius is the grain's
    # the outline to half a cell: in a column that the rim cuts, the grain takes less than its part of the light (alpha squared)
    assert within(radius - 0.5*spacing) < heat[on_grain].sum() < within(radius + 0.5*spacing)
    assert heat[upper].sum() > 0.98*heat[on_grain].sum()
    in_shadow = ~on_grain & (np.hypot(centres[:, 0], centres[:, 1]) < radius - 1.5*spacing)
    assert heat[in_shadow].sum() < 1e-3


def test_rays_leave_a_flat_plate_the_absorptivity_of_the_case(tmp_path):
    absorbed, _, _ = heat_of(plate(numerics=RAYS), tmp_path)
    assert absorbed == pytest.approx(0.35, rel=2e-3)          # one reflection, straight up; 0.1 % of the beam passes the plate's edge


def test_rays_in_a_round_pit_are_absorbed_as_often_as_they_meet_its_wall(tmp_path):
    # in a half sphere a ray that enters at the radius r meets the wall at asin(r/R) from the normal, time and again, each time
    # pi - 2 asin(r/R) further around, until that would be above the rim
    radius, spot = 1.2e-4, 8e-5
    pit = {"shape": "sphere", "material": "argon", "state": "liquid", "center": [0.0, 0.0, 0.0], "radius": radius}
    number = (1.65 - np.sqrt(1.65**2 - 2*0.35**2))/0.35
    r = (np.arange(4000) + 0.5)/4000*radius
    weight = 4*r/spot**2*np.exp(-2*r**2/spot**2)*radius/4000
    angle, exact = np.arcsin(r/radius), 0.0
    hits, place = np.zeros_like(r), np.arcsin(r/radius)
    while np.any(np.abs(place) < np.pi/2):
        hits += np.abs(place) < np.pi/2
        place = np.where(np.abs(place) < np.pi/2, place - (np.pi - 2*angle), place)
    exact = (weight*(1 - (1 - fresnel(angle, number))**hits)).sum() + 0.35*np.exp(-2*radius**2/spot**2)
    assert exact > 0.37                                         # more than a flat plate absorbs
    absorbed, _, centres = heat_of(plate(pit, spacing=1e-5, spot_radius=spot, numerics=RAYS), tmp_path)
    assert absorbed == pytest.approx(exact, rel=0.03)           # twelve cells a radius: normals are some degrees off


def test_rays_give_the_same_on_two_ranks(tmp_path):
    grain = {"shape": "sphere", "material": "steel", "state": "solid", "center": [1e-5, 0.0, 5e-5], "radius": 5e-5}
    data = plate(grain, numerics=RAYS)
    records = []
    for threads in ("1", "2"):
        (tmp_path/threads).mkdir()
        records.append(small_cases.completed(data, tmp_path/threads, "--threads", threads))
    ours, theirs = (record["ledgers"]["energy"]["laser_absorbed"] for record in records)
    assert records[1]["cost"]["threads"] == 2
    assert ours == pytest.approx(theirs, rel=1e-12)
    fields = [small_cases.last_fields(data, tmp_path/threads)[0]["temperature"] for threads in ("1", "2")]
    assert np.abs(fields[0] - fields[1]).max() < 1e-3


def test_an_absorptivity_that_no_metal_has_is_refused_with_rays(tmp_path):
    data = plate(numerics=RAYS)
    data["laser"]["absorptivity"] = 0.9
    result = small_cases.solve(data, tmp_path)
    assert result.returncode == 2 and "laser.absorptivity" in result.stderr and len(result.stderr.splitlines()) == 1
