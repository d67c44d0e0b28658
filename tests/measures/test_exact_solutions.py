"""Exact solutions give the numbers of the published or independently computed cases, and satisfy their equations."""

import numpy as np
import pytest
from cupel.exact import (
    capillary_wave, capillary_wave_finite_depth, channel_flow, oscillating_drop, recoil, return_flow, stefan, taylor_green,
    thermocapillary_drop, thermocapillary_start_up,
)
from cupel.exact.laplace import laplace_pressure
from cupel.exact.moving_gaussian_source import MovingGaussianSource
from cupel.exact.spherical_cap import Cap
from scipy.integrate import quad


def not_a_wave(time, value, frequency):
    """Greatest part of `value` that is not A cos + B sin of the frequency."""
    basis = np.stack([np.cos(frequency * time), np.sin(frequency * time)], axis=1)
    return np.abs(value - basis @ np.linalg.lstsq(basis, value, rcond=None)[0]).max()


def source(power):
    return MovingGaussianSource(0.35 * power, 0.15, 80e-6, 6900.0, 780.0, 25.0)


@pytest.mark.parametrize("power, width, depth", [(100, 169.0, 55.9), (150, 204.7, 79.5), (200, 233.4, 98.4)])
def test_moving_source_has_the_tabulated_pool(power, width, depth):
    found = source(power).pool(1723.0)
    assert found[0] * 1e6 == pytest.approx(width, abs=0.1)
    assert found[1] * 1e6 == pytest.approx(depth, abs=0.1)


def test_moving_source_agrees_with_adaptive_quadrature():
    made, alpha, s = source(150.0), 25.0 / (6900.0 * 780.0), 40e-6
    for x, y, z in ((0.0, 0.0, 0.0), (-80e-6, 30e-6, 0.0), (-200e-6, 0.0, 50e-6), (60e-6, -20e-6, 10e-6)):
        def integrand(w):
            t = w * w
            v = s**2 + 2 * alpha * t
            return 2 / np.sqrt(np.pi * alpha) * np.exp(-z**2 / (4 * alpha * t) - ((x + 0.15 * t)**2 + y**2) / (2 * v)) / (2 * np.pi * v)
        value = sum(quad(integrand, *ends, epsrel=1e-10)[0] for ends in ((1e-12, 0.01), (0.01, 0.1), (0.1, 2.0)))
        expected = 300.0 + 0.35 * 150.0 / (6900.0 * 780.0) * value
        assert float(made.temperature(x, y, z)) == pytest.approx(expected, rel=1e-6)


def test_moving_source_too_weak_to_melt_has_no_pool():
    assert source(10.0).pool(1723.0) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("superheat, beta", [(100.0, 0.37864), (300.0, 0.60693), (1000.0, 0.92830)])
def test_stefan_coefficients_of_304l(superheat, beta):
    assert stefan.front_coefficient(780.0 * superheat / 247000.0) == pytest.approx(beta, abs=1e-5)


def test_stefan_front_moves_by_the_heat_that_reaches_it():
    beta, alpha, t = stefan.front_coefficient(0.9), 3.4e-6, 2e-3
    front = stefan.front(t, beta, alpha)
    step = 1e-5 * front
    slope = (1723.0 - stefan.temperature(front - step, t, beta, alpha, 2023.0, 1723.0)) / step
    speed = stefan.front(t, beta, alpha) / (2.0 * t)
    # rho L d(front)/dt = -k dT/dx with St = c (T_wall - T_m)/L = 0.9
    assert speed == pytest.approx(-alpha * slope * 0.9 / 300.0, rel=1e-4)
    assert stefan.temperature(0.0, t, beta, alpha, 2023.0, 1723.0) == pytest.approx(2023.0)
    assert stefan.temperature(2.0 * front, t, beta, alpha, 2023.0, 1723.0) == 1723.0


def test_return_flow_has_no_net_flux_turns_at_two_thirds_and_carries_the_stress():
    eta = np.linspace(0.0, 1.0, 20001)
    u = return_flow.velocity(eta, -0.2, 1e-3, 0.05)
    assert np.trapz(u, eta) == pytest.approx(0.0, abs=1e-9)
    assert return_flow.velocity(2.0 / 3.0, -0.2, 1e-3, 0.05) == pytest.approx(0.0, abs=1e-15)
    assert u[-1] == pytest.approx(-0.2 * 1e-3 / (4 * 0.05)) == return_flow.surface_velocity(-0.2, 1e-3, 0.05)
    assert 0.05 * (u[-1] - u[-2]) / ((eta[1] - eta[0]) * 1e-3) == pytest.approx(-0.2, rel=1e-3)


def test_cap_of_45_degrees_has_the_tabulated_sizes():
    cap = Cap.of_content(4.0 / 3.0 * np.pi, np.pi / 4.0)
    assert (cap.base_radius, cap.height, cap.radius) == pytest.approx((1.8261, 0.7564, 2.5825), abs=5e-5)


@pytest.mark.parametrize("degrees", [5, 30, 60, 90, 135, 175])
def test_two_dimensional_cap_has_the_tabulated_radius(degrees):
    theta = np.radians(degrees)
    cap = Cap.of_content(np.pi * 0.3**2, theta, 2)
    assert cap.radius / 0.3 == pytest.approx((theta / np.pi - np.sin(theta) * np.cos(theta) / np.pi)**-0.5)
    assert cap.base_radius / cap.height == pytest.approx(1.0 / np.tan(theta / 2.0))


def test_cap_of_180_degrees_is_a_ball_and_other_angles_are_refused():
    assert Cap(2.0, np.pi, 3).content == pytest.approx(4.0 / 3.0 * np.pi * 8.0)
    assert Cap(2.0, np.pi, 2).content == pytest.approx(4.0 * np.pi)
    with pytest.raises(ValueError, match="no cap"):
        Cap(1.0, 0.0)


def test_laplace_pressure_of_the_304l_drop_is_24_kpa():
    assert laplace_pressure(1.2, 100e-6, 3) == pytest.approx(24e3)
    assert laplace_pressure(1.2, 100e-6, 2) == pytest.approx(12e3)


def test_drop_of_304l_oscillates_in_168_microseconds():
    omega = oscillating_drop.frequency(1.2, 6900.0, 100e-6)
    assert 2.0 * np.pi / omega * 1e6 == pytest.approx(168.4, abs=0.05)
    assert oscillating_drop.decay_rate(1e-6, 1e-4, 2, 3) == pytest.approx(5.0 * 1e-6 / 1e-8)


def test_viscous_drop_in_two_dimensions_has_the_tabulated_mode():
    omega, decay = oscillating_drop.viscous_mode(1.0, 1.0, 1.0, 0.05, 2, dimensions=2)
    assert omega == pytest.approx(2.42587, abs=1e-5)
    assert decay == pytest.approx(0.177334, abs=1e-6)


@pytest.mark.parametrize("dimensions", [2, 3])
@pytest.mark.parametrize("mode", [2, 3, 4])
def test_viscous_mode_tends_to_the_one_of_small_viscosity(mode, dimensions):
    omega, decay = oscillating_drop.viscous_mode(1.0, 1.0, 1.0, 1e-6, mode, dimensions)
    assert omega == pytest.approx(oscillating_drop.frequency(1.0, 1.0, 1.0, mode, dimensions), rel=1e-4)
    assert decay == pytest.approx(oscillating_drop.decay_rate(1e-6, 1.0, mode, dimensions), rel=0.01)


def test_viscous_modes_of_a_sphere_satisfy_the_equation_of_chandrasekhar():
    """alpha^4/q^4 + 1 = 2 (n - 1)/q^2 [n + (n + 1)(q - 2 n Q)/(q - 2 Q)], Q = j_(n + 3/2)(q)/j_(n + 1/2)(q), s = -q^2 nu/R^2
    (Hydrodynamic and Hydromagnetic Stability, 1961, section 98, equation 280, with Q as there)."""
    from scipy.special import jv

    for mode, viscosity in ((2, 0.05), (2, 0.2), (3, 0.02)):
        omega, decay = oscillating_drop.viscous_mode(1.0, 1.0, 1.0, viscosity, mode, 3)
        q = np.sqrt(complex(decay, omega) / viscosity)
        ratio = jv(mode + 1.5, q) / jv(mode + 0.5, q)
        left = oscillating_drop.frequency(1.0, 1.0, 1.0, mode)**2 / viscosity**2 / q**4 + 1.0
        right = 2.0 * (mode - 1) / q**2 * (mode + (mode + 1) * (q - 2.0 * mode * ratio) / (q - 2.0 * ratio))
        assert abs(left - right) < 1e-9 * abs(right), (left, right)


@pytest.mark.parametrize("dimensions", [2, 3])
def test_a_drop_in_almost_nothing_is_one_in_vacuum_and_in_a_fluid_of_little_viscosity_has_lambs_frequency(dimensions):
    vacuum = oscillating_drop.viscous_mode(1.0, 1.0, 1.0, 0.05, 2, dimensions)
    assert oscillating_drop.viscous_mode(1.0, 1.0, 1.0, 0.05, 2, dimensions, 1e-9, 1e-9) == pytest.approx(vacuum, rel=1e-5)
    omega, decay = oscillating_drop.viscous_mode(1.0, 1.0, 1.0, 1e-8, 3, dimensions, 0.7, 2e-8)
    assert omega == pytest.approx(oscillating_drop.frequency(1.0, 1.0, 1.0, 3, dimensions, 0.7), rel=1e-4) and 0.0 < decay < 1e-3


@pytest.mark.parametrize("dimensions", [2, 3])
def test_high_modes_of_a_drop_in_its_own_fluid_are_plane_capillary_waves(dimensions):
    """Prosperetti 1981: root of a quartic for two fluids of the same kinematic viscosity, b = rho_1 rho_2/(rho_1 + rho_2)^2 = 1/4."""
    mode, viscosity = 300, 2e-3
    k = mode if dimensions == 2 else mode + 0.5
    omega_0, nu_k2, b = np.sqrt(0.5 * k**3), viscosity * k**2, 0.25
    roots = np.roots([1.0, -4.0 * b * nu_k2**0.5, 2.0 * (1.0 - 6.0 * b) * nu_k2, 4.0 * (1.0 - 3.0 * b) * nu_k2**1.5,
                      (1.0 - 4.0 * b) * nu_k2**2 + omega_0**2])
    s = max((z**2 - nu_k2 for z in roots if z.real < 0.0), key=lambda rate: rate.imag)
    omega, decay = oscillating_drop.viscous_mode(1.0, 1.0, 1.0, viscosity, mode, dimensions, 1.0, viscosity)
    assert (omega, decay) == pytest.approx((s.imag, -s.real), rel=0.01)


def test_air_around_a_drop_of_water_slows_it_by_a_fifth_of_a_percent():
    vacuum, _ = oscillating_drop.viscous_mode(1.0, 1.0, 1.0, 0.05, 2, 2)
    air, _ = oscillating_drop.viscous_mode(1.0, 1.0, 1.0, 0.05, 2, 2, 1e-3, 0.05 / 55.0)
    assert air / vacuum - 1.0 == pytest.approx(-0.00226, abs=2e-5)


@pytest.mark.parametrize("dimensions, viscosity", [(2, 0.05), (3, 0.05), (2, 1e-3)])
def test_released_drop_starts_at_rest_and_ends_in_the_normal_mode(dimensions, viscosity):
    drop = (1.0, 1.0, 1.0, viscosity, 2, dimensions)
    omega_0 = oscillating_drop.frequency(1.0, 1.0, 1.0, 2, dimensions)
    assert 1.0 - oscillating_drop.amplitude([2e-3], *drop)[0] == pytest.approx(0.5 * (2e-3 * omega_0)**2, rel=0.02)
    omega, decay = oscillating_drop.viscous_mode(*drop)
    t = np.linspace(6.0, 12.0, 60)
    a = oscillating_drop.amplitude(t, *drop) * np.exp(decay * t)
    assert not_a_wave(t, a, omega) < 0.01


def test_viscous_mode_scales_with_units():
    omega, decay = oscillating_drop.viscous_mode(1.2, 6900.0, 1e-4, 0.05 * np.sqrt(1.2 * 6900.0 * 1e-4), 2, dimensions=2)
    unit = np.sqrt(1.2 / (6900.0 * 1e-12))
    assert (omega / unit, decay / unit) == pytest.approx((2.42587, 0.177334), rel=1e-5)


WAVE = (1.0, 1.0, 1.0, np.sqrt(1.0 / 3000.0))


def test_capillary_wave_has_the_tabulated_mode():
    omega, decay = capillary_wave.normal_mode(*WAVE)
    assert omega == pytest.approx(15.5366, abs=1e-4)
    assert decay == pytest.approx(1.2185, abs=1e-4)
    # and satisfies its relation
    s, nu, k = complex(-decay, omega), WAVE[3], 2.0 * np.pi
    left = (s + 2 * nu * k**2)**2 + capillary_wave.inviscid_frequency(*WAVE[:3])**2
    assert abs(left - 4 * nu**2 * k**3 * np.sqrt(k**2 + s / nu)) < 1e-9 * abs(left)


def test_released_wave_starts_at_rest_and_ends_in_the_normal_mode():
    assert capillary_wave.amplitude(np.array([0.0]), *WAVE)[0] == pytest.approx(1.0, abs=1e-12)
    t = np.array([1e-6, 1e-5])
    early = (1.0 - capillary_wave.amplitude(t, *WAVE)) * 2.0 / t**2
    assert early == pytest.approx((2.0 * np.pi)**3, rel=1e-3)
    omega, decay = capillary_wave.normal_mode(*WAVE)
    t = np.linspace(0.8, 2.5, 400)
    a = capillary_wave.amplitude(t, *WAVE) * np.exp(decay * t)
    assert not_a_wave(t, a, omega) < 0.02


def test_unbounded_thermocapillary_drop_of_ma_and_bothe():
    speed = thermocapillary_drop.migration_velocity(-0.002, 200.0, 1.44e-3, 1.2e-6, 2.4e-6, 0.012, 0.024)
    assert speed / 0.024 == pytest.approx(0.2286, abs=5e-5)   # toward the hot side


def test_thermocapillary_drop_in_two_dimensions_of_equal_fluids():
    # sigma' G R/(8 mu) for equal properties
    assert thermocapillary_drop.migration_velocity(-1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 2) == pytest.approx(1.0 / 8.0)
    speed = thermocapillary_drop.migration_velocity(-0.002, 200.0, 1.44e-3, 1.2e-6, 2.4e-6, 0.012, 0.024, 2)
    assert speed / 0.024 == pytest.approx(2.0 / 9.0)


BULK = thermocapillary_start_up.Fluid(500.0, 0.024, 2.4e-6, 1e-4)
DROP = thermocapillary_start_up.Fluid(250.0, 0.012, 1.2e-6, 0.5e-4)


def test_start_of_a_migration_tends_to_its_limit_as_one_over_time():
    limit = thermocapillary_drop.migration_velocity(-0.002, 50.0, 1.44e-3, 1.2e-6, 2.4e-6, 0.012, 0.024, 2)
    short, long, longest = 1.0 - thermocapillary_start_up.velocity(np.array([3.0, 30.0, 300.0]), -0.002, 50.0, 1.44e-3, DROP, BULK) / limit
    assert short / long == pytest.approx(10.0, rel=0.01) and long / longest == pytest.approx(10.0, rel=0.01)
    assert longest == pytest.approx(0.0, abs=1e-4)


def test_first_moment_of_a_migration_is_that_of_two_boundary_layers():
    """At first a stress tau sin(theta), tau = |sigma'| G, is taken up by thin layers of the same slip velocity, whose momenta tau t are as
    (mu rho)^(1/2); their fluxes q sin(theta) part a dipole A = U - q_b/a outside and a uniform flow C = U + q_d/a inside from the
    surface, whose pressures a (rho_b dA/dt + rho_d dC/dt) balance tau."""
    a, t = 1.44e-3, 1e-8
    momentum = 0.002 * 50.0 * t
    weights = np.sqrt([BULK.viscosity * BULK.density, DROP.viscosity * DROP.density])
    bulk, drop = momentum * weights / weights.sum()
    speed = (momentum + bulk - drop) / (a * (BULK.density + DROP.density))
    assert thermocapillary_start_up.velocity(np.array([t]), -0.002, 50.0, a, DROP, BULK)[0] == pytest.approx(speed, rel=1e-3)


def test_table_of_ma_and_bothe_is_met_at_its_times_and_ends_where_it_ends():
    assert thermocapillary_drop.ma_bothe(0.300) == pytest.approx(0.1141) and thermocapillary_drop.ma_bothe(1.5) == pytest.approx(0.141, abs=1e-4)
    assert np.isnan(thermocapillary_drop.ma_bothe([0.05, 2.0])).all()


def test_finite_depth_tends_to_prosperettis_deep_solution_by_another_way():
    """Two derivations, two methods: Laplace transform back in time by series, and four roots of a quartic."""
    t = np.linspace(0.01, 2.0, 40)
    deep = capillary_wave.amplitude(t, *WAVE)
    assert np.abs(capillary_wave_finite_depth.amplitude(t, *WAVE, 0.95) - deep).max() < 1e-4     # exp(-2 k h) = 7e-6
    assert np.abs(capillary_wave_finite_depth.amplitude(t, *WAVE, 0.5) - deep).max() > 1e-3


def test_shallow_wave_without_viscosity_has_the_dispersion_of_its_depth():
    t, k, h = np.linspace(0.01, 1.0, 30), 2.0 * np.pi, 0.1
    omega = np.sqrt(k**3 * np.tanh(k * h))
    a = capillary_wave_finite_depth.amplitude(t, 1.0, 1.0, 1.0, 1e-7, h, slip=True)
    assert np.abs(a - np.cos(omega * t)).max() < 1e-4


def test_taylor_green_vortex_solves_the_equation_of_vorticity():
    nu, wavelength, step = 0.01, 1.3, 1e-4
    random = np.random.default_rng(3)
    points = np.column_stack([random.uniform(0, 1, 20), np.zeros(20), random.uniform(0, 1, 20)])

    def flow(shift, time=0.7):
        return taylor_green.velocity(points + shift, time, 2.0, nu, wavelength)

    x, z = np.array([step, 0, 0]), np.array([0, 0, step])
    divergence = (flow(x) - flow(-x))[:, 0] + (flow(z) - flow(-z))[:, 2]
    assert np.abs(divergence).max() < 1e-7
    laplacian = (flow(x) + flow(-x) + flow(z) + flow(-z) - 4.0 * flow(0.0)) / step**2
    change = (flow(0.0, 0.7 + step) - flow(0.0, 0.7 - step)) / (2.0 * step)
    assert np.abs(change - nu * laplacian).max() < 1e-6
    assert taylor_green.energy_decay_rate(nu, wavelength) == pytest.approx(4.0 * nu * (2.0 * np.pi / wavelength)**2)


@pytest.mark.parametrize("drive", [{"acceleration": 0.3}, {"upper_speed": 1.0}, {"acceleration": 0.1, "lower_speed": 0.2, "upper_speed": -0.5}])
def test_channel_start_up_solves_its_equation(drive):
    depth, nu = 2.0, 0.4
    z = np.linspace(0.1, 1.9, 19)
    step, t = 1e-3, 0.5

    def flow(time, shift=0.0):
        return channel_flow.velocity(z + shift, time, depth, nu, **drive)

    change = (flow(t + step) - flow(t - step)) / (2.0 * step)
    second = (flow(t, step) + flow(t, -step) - 2.0 * flow(t)) / step**2
    assert change == pytest.approx(nu * second + drive.get("acceleration", 0.0), abs=1e-5)
    ends = channel_flow.velocity(np.array([0.0, depth]), t, depth, nu, **drive)
    assert ends == pytest.approx([drive.get("lower_speed", 0.0), drive.get("upper_speed", 0.0)], abs=1e-12)
    assert np.abs(channel_flow.velocity(z, 1e-9, depth, nu, **drive)).max() < 1e-3      # at rest at first
    assert channel_flow.velocity(z, 100.0, depth, nu, **drive) == pytest.approx(channel_flow.steady(z, depth, nu, **drive))


def test_recoil_is_054_of_an_atmosphere_at_boiling_and_rises_with_temperature():
    steel = (3050.0, 6.1e6, 0.0558, 101325.0)
    assert recoil.recoil_pressure(3050.0, *steel) == pytest.approx(0.54 * 101325.0)
    warm, hot = recoil.recoil_pressure(np.array([3000.0, 3100.0]), *steel)
    assert warm < hot
    # Clausius-Clapeyron: d ln p/d(1/T) = -L M/R
    assert np.log(hot / warm) == pytest.approx(6.1e6 * 0.0558 / 8.314462618 * (1 / 3000.0 - 1 / 3100.0), rel=1e-9)
