#include <gtest/gtest.h>

#include "block_of_liquid.hpp"
#include "kernels/lattice_sum.hpp"
#include "models/colour_profile.hpp"
#include "models/continuity.hpp"
#include "models/density_diffusion.hpp"
#include "models/density_summation.hpp"
#include "models/equation_of_state.hpp"
#include "models/metal_surface.hpp"
#include "models/momentum.hpp"
#include "models/normal_of_depth.hpp"
#include "models/packing.hpp"
#include "models/shifting.hpp"
#include "models/shifting_exchange.hpp"
#include "models/surface_forces.hpp"
#include "models/surface_geometry.hpp"
#include "models/surface_pressure.hpp"
#include "models/surface_stress.hpp"
#include "models/transport_velocity.hpp"
#include "models/viscosity_jump.hpp"
#include "models/viscous_traction.hpp"

namespace cupel
{
namespace
{

class FlowModels : public testing::TestWithParam<int>
{};
INSTANTIATE_TEST_SUITE_P(Dimensions, FlowModels, testing::Values(2, 3));

TEST_P(FlowModels, CorrectedGradientOfALinearFieldIsExact)
{
    Block block(GetParam());
    ScalarField& value = block.particles.add_scalar({"value", "1"});
    VectorField& gradient = block.particles.add_vector({"gradient", "1/m"});
    const Vector exact{1.5, GetParam() == 2 ? 0.0 : -2.0, 0.5};
    for (Index i = 0; i < block.particles.count(); ++i)
        value[i] = 3.0 + dot(exact, block.particles.position[i]);
    block.run(ScalarGradient{{block.mobility}, value, gradient});
    for (Index i = 0; i < block.particles.count(); ++i)
        EXPECT_NEAR(norm(block.correction[i] * gradient[i] - exact), 0.0, 1e-10);
}

TEST_P(FlowModels, DensityFollowsThePacking)
{
    Block block(GetParam());
    Particles& particles = block.particles;
    ScalarField& rate = particles.add_scalar({"density_rate", "kg/(m3 s)"});
    const auto velocity = [](const Vector& p) { return Vector{std::sin(p.z), 0.0, std::cos(0.5 * p.x)}; };
    for (Index i = 0; i < particles.count(); ++i)
        particles.velocity.set(i, velocity(particles.position[i]));
    block.run(Continuity{{block.mobility}, particles.density, particles.velocity, rate});
    // Σ_j m_j W_ij a moment earlier and later.
    const double moment = 1e-5;
    const auto packing = [&](Index i, double time) {
        double sum = 0.0;
        for (Index j = 0; j < particles.count(); ++j) {
            const Vector offset = (particles.position[i] - particles.position[j]) +
                                  time * (particles.velocity[i] - particles.velocity[j]);
            sum += particles.mass[j] * block.kernel(norm(offset)).value;
        }
        return sum;
    };
    for (Index i = 0; i < particles.count(); ++i)
        EXPECT_NEAR(rate[i], (packing(i, moment) - packing(i, -moment)) / (2.0 * moment), 1e-7);
    // The sums of the gradient of velocity hold the same.
    ScalarField& trace = particles.add_scalar({"trace", "kg/(m3 s)"});
    block.run(VelocityGradient{{block.mobility},
                               particles.velocity,
                               block.correction,
                               VelocityGradientFields::register_in(particles),
                               &trace,
                               &particles.density});
    for (Index i = 0; i < particles.count(); ++i)
        EXPECT_NEAR(trace[i], rate[i], 1e-13);
}

TEST_P(FlowModels, AtTheSurfaceThatBearsACarriedLoadStrainWithoutDivergenceLeavesDensityAlone)
{
    Block block(GetParam(), 12, 0.25);
    Particles& particles = block.particles;
    ScalarField& rate = particles.add_scalar({"density_rate", "kg/(m3 s)"});
    ScalarField& delta = particles.add_scalar({"delta", "1/m"});
    ScalarField& replaced = particles.add_scalar({"replaced", "kg/(m3 s)"});
    const auto greatest_rate = [&](double expansion, const ScalarField* surface_delta) {
        for (Index i = 0; i < particles.count(); ++i) {
            const Vector p = particles.position[i];
            particles.velocity.set(i, {(1.0 + expansion) * p.x, 0.0, -p.z});
            delta[i] = 1.0;
        }
        block.run(Continuity{{block.mobility}, particles.density, particles.velocity, rate});
        block.run(ContinuityOfBand{
            {block.mobility}, particles.density, particles.velocity, block.correction, surface_delta, rate, &replaced});
        double greatest = 0.0;
        for (Index i = 0; i < particles.count(); ++i)
            greatest = std::max(greatest, std::abs(rate[i] + expansion * particles.density[i]));
        return greatest;
    };
    EXPECT_LT(greatest_rate(0.0, &delta), 1e-10);
    EXPECT_LT(greatest_rate(0.3, &delta), 1e-10);
    EXPECT_GT(greatest_rate(0.0, nullptr), 0.05); // the block's faces see a divergence that is not there
}

TEST_P(FlowModels, ALoadThatIsLinearIsCarriedAsItIsAndAUniformOneDrivesNothing)
{
    Block block(GetParam(), 12, 0.25);
    Particles& particles = block.particles;
    ScalarField& load = particles.add_scalar({"load", "Pa"});
    ScalarField& mean = particles.add_scalar({"mean", "Pa"});
    VectorField& gradient = particles.add_vector({"load_gradient", "Pa/m"});
    const Vector slope{1.5, GetParam() == 2 ? 0.0 : -2.0, 0.5};
    const auto carry = [&](const Vector& by) {
        for (Index i = 0; i < particles.count(); ++i)
            load[i] = 7.0 + dot(by, particles.position[i]);
        block.run(SurfacePressure{{block.mobility}, block.correction, load, mean, gradient});
    };
    carry({});
    for (Index i = 0; i < particles.count(); ++i) {
        EXPECT_EQ(norm(gradient[i]), 0.0);
        EXPECT_EQ(mean[i], 7.0);
    }
    carry(slope);
    for (Index i = 0; i < particles.count(); ++i) {
        EXPECT_NEAR(norm(gradient[i] - slope), 0.0, 1e-10);
        // Of neighbours that lie within the kernel's support, by positive weights.
        EXPECT_LT(std::abs(mean[i] - load[i]), norm(slope) * block.kernel.support());
    }
}

TEST_P(FlowModels, DensityDiffusionConservesAndLeavesALinearDensityAlone)
{
    Block block(GetParam());
    Particles& particles = block.particles;
    VectorField& gradient = particles.add_vector({"density_gradient", "kg/m4"});
    ScalarField& rate = particles.add_scalar({"density_rate", "kg/(m3 s)"});
    const Vector slope{0.3, 0.0, -0.2};
    const auto diffuse = [&](const auto& density) {
        for (Index i = 0; i < particles.count(); ++i) {
            particles.density[i] = density(particles.position[i]);
            gradient.set(i, slope);
            rate[i] = 0.0;
        }
        block.run(DensityDiffusion{{block.mobility}, particles.density, gradient, 0.7, rate});
    };
    diffuse([&](const Vector& p) { return 1.0 + dot(slope, p); });
    for (Index i = 0; i < particles.count(); ++i)
        EXPECT_NEAR(rate[i], 0.0, 1e-13);
    diffuse([&](const Vector& p) { return 1.0 + std::sin(p.x) * p.z; });
    double total = 0.0, size = 0.0;
    for (Index i = 0; i < particles.count(); ++i) {
        total += particles.volume[i] * rate[i];
        size += particles.volume[i] * std::abs(rate[i]);
    }
    EXPECT_GT(size, 1.0);
    EXPECT_LT(std::abs(total), 1e-12 * size);
}

TEST_P(FlowModels, PressureAndViscosityConserveMomentum)
{
    Block block(GetParam());
    VectorField& pressure_force = block.particles.add_vector({"pressure_force", "N"});
    VectorField& viscous_force = block.particles.add_vector({"viscous_force", "N"});
    VectorField& wall_force = block.particles.add_vector({"wall_force", "N"});
    for (Index i = 0; i < block.particles.count(); ++i) {
        const Vector p = block.particles.position[i];
        block.particles.pressure[i] = std::sin(p.x) * std::cos(2.0 * p.z);
        block.particles.velocity.set(i, {std::cos(p.z), 0.0, std::sin(p.x * p.z)});
    }
    block.run(FreeSurfaceMomentum{{block.mobility},
                                  block.particles.volume,
                                  block.particles.pressure,
                                  block.particles.velocity,
                                  0.1,
                                  pressure_force,
                                  viscous_force,
                                  wall_force});
    for (const VectorField* force : {&pressure_force, &viscous_force}) {
        Vector total{};
        double size = 0.0;
        for (Index i = 0; i < block.particles.count(); ++i) {
            total += (*force)[i];
            size += norm((*force)[i]);
        }
        EXPECT_GT(size, 1.0);
        EXPECT_LT(norm(total), 1e-12 * size);
    }
}

TEST_P(FlowModels, PressureGivesWhatCompressionTakesBesideThePowerOfWalls)
{
    Block block(GetParam());
    Particles& particles = block.particles;
    VectorField& pressure_force = particles.add_vector({"pressure_force", "N"});
    VectorField& viscous_force = particles.add_vector({"viscous_force", "N"});
    VectorField& wall_force = particles.add_vector({"wall_force", "N"});
    ScalarField& density_rate = particles.add_scalar({"density_rate", "kg/(m3 s)"});
    ScalarField& by_walls = particles.add_scalar({"density_rate_by_walls", "kg/(m3 s)"});
    for (Index i = 0; i < particles.count(); ++i) {
        const Vector p = particles.position[i];
        particles.pressure[i] = std::sin(p.x) * std::cos(2.0 * p.z);
        particles.velocity.set(i, {std::cos(p.z), 0.0, std::sin(p.x * p.z)});
    }
    const auto unanswered = [&] {
        block.run(FreeSurfaceMomentum{{block.mobility},
                                      particles.volume,
                                      particles.pressure,
                                      particles.velocity,
                                      0.1,
                                      pressure_force,
                                      viscous_force,
                                      wall_force});
        block.run(Continuity{{block.mobility}, particles.density, particles.velocity, density_rate});
        block.run(ContinuityByWalls{{block.mobility}, particles.density, particles.velocity, by_walls});
        double sum = 0.0, walls = 0.0;
        for (Index i = 0; i < particles.count(); ++i) {
            if (block.mobility[i] == 0.0) continue;
            // Elastic energy rises by p V for each unit of ln ρ.
            sum += dot(pressure_force[i], particles.velocity[i]) +
                   particles.pressure[i] * particles.volume[i] * density_rate[i] / particles.density[i];
            walls += dot(wall_force[i], particles.velocity[i]) +
                     particles.pressure[i] * particles.volume[i] * by_walls[i] / particles.density[i];
        }
        return std::pair{sum, walls};
    };
    const auto [free, no_walls] = unanswered();
    EXPECT_NEAR(free, 0.0, 1e-12);
    EXPECT_EQ(no_walls, 0.0);
    for (Index i = 0; i < particles.count(); ++i)
        if (particles.position[i].z < 4.0) block.mobility[i] = 0.0;
    const auto [between, walls] = unanswered();
    EXPECT_GT(std::abs(walls), 1e-3);
    EXPECT_NEAR(between, walls, 1e-12);
}

TEST(EquationOfState, PressureIsTheDerivativeOfElasticEnergy)
{
    for (const double exponent : {1.0, 7.0})
        for (const double x : {0.93, 0.975, 0.985, 0.99999, 1.00005, 1.003, 1.015, 1.05}) {
            const EquationOfState law{20.0, exponent};
            const double step = 1e-6 * std::max(1e-2, std::abs(x - 1.0)), rest = 3.0;
            const double slope =
                (law.elastic_energy(rest * (x + step), rest) - law.elastic_energy(rest * (x - step), rest)) /
                (2.0 * step * rest);
            // p = ρ² de/dρ; round-off in e, a part in 10¹⁶ of c², weighs more where p is small.
            EXPECT_NEAR(slope * rest * rest * x * x / law.pressure(rest * x, rest), 1.0,
                        2e-5 + 1e-9 / std::abs(x - 1.0))
                << exponent << " " << x;
        }
}

/// Power of viscous forces on a block free on all sides that is strained, u = x, w = −z, over −μ ∇v:∇v V: by Morris's
/// sum and with the traction; the total force beside it, over the latter.
struct ViscousPower
{
    double laplacian, whole;
    Vector total_force;
};
ViscousPower viscous_power(int dimensions, double jitter)
{
    Block block(dimensions, 12, jitter);
    Particles& particles = block.particles;
    VectorField& pressure_force = particles.add_vector({"pressure_force", "N"});
    VectorField& force = particles.add_vector({"force", "N"});
    VectorField& wall_force = particles.add_vector({"wall_force", "N"});
    ScalarField& no_pressure = particles.add_scalar({"no_pressure", "Pa"});
    const VelocityGradientFields gradient = VelocityGradientFields::register_in(particles);
    for (Index i = 0; i < particles.count(); ++i)
        particles.velocity.set(i, {particles.position[i].x, 0.0, -particles.position[i].z});
    const auto power = [&] {
        double sum = 0.0;
        for (Index i = 0; i < particles.count(); ++i)
            sum += dot(force[i], particles.velocity[i]);
        return sum;
    };
    block.run(VelocityGradient{{block.mobility}, particles.velocity, block.correction, gradient});
    block.run(FreeSurfaceMomentum{
        {block.mobility}, particles.volume, no_pressure, particles.velocity, 0.3, pressure_force, force, wall_force});
    ViscousPower result{power(), 0.0, {}};
    block.run(ViscousTraction{{block.mobility}, particles.volume, gradient, 0.3, block.correction, force});
    result.whole = power();
    double strained = 0.0;
    for (Index i = 0; i < particles.count(); ++i) {
        result.total_force += (1.0 / result.whole) * force[i];
        strained -= 0.3 * 2.0 * particles.volume[i];
    }
    result.laplacian /= strained;
    result.whole /= strained;
    return result;
}

TEST_P(FlowModels, StrainedLiquidDissipatesTwiceViscosityTimesStrainSquared)
{
    // ∇v:∇v = 2 and 2 S:S = 4 for u = x, w = −z: potential flow, in which the traction doubles what is dissipated. A
    // kernel that is cut off by a surface loses nothing of it; corners, which see too little for that, do.
    for (const double jitter : {0.0, 0.25}) {
        const ViscousPower power = viscous_power(GetParam(), jitter);
        EXPECT_LT(power.laplacian, GetParam() == 2 ? 0.93 : 0.9) << jitter;
        EXPECT_NEAR(power.whole, 2.0, GetParam() == 2 ? 0.02 : 0.07) << jitter; // more edges
        EXPECT_LT(norm(power.total_force), 1e-11) << jitter;
    }
}

TEST_P(FlowModels, ViscosityThatJumpsLeavesTheTractionOfTheOtherGradient)
{
    // u = x + 2 z, w = −z: (∇v)ᵀ n with n = x̂ is (1, 0, 2), and the traction on the interface [μ] times that. What the
    // two viscosities have in common adds nothing.
    Block block(GetParam(), 12, 0.0);
    Particles& particles = block.particles;
    VectorField& force = particles.add_vector({"force", "N"});
    const VelocityGradientFields gradient = VelocityGradientFields::register_in(particles);
    ScalarField& viscosity = particles.add_scalar({"viscosity", "Pa s"});
    const Vector middle = block.middle();
    for (Index i = 0; i < particles.count(); ++i) {
        const Vector p = particles.position[i];
        particles.velocity.set(i, {p.x + 2.0 * p.z, 0.0, -p.z});
        force.set(i, {});
    }
    block.run(VelocityGradient{{block.mobility}, particles.velocity, block.correction, gradient});
    for (Index i = 0; i < particles.count(); ++i)
        viscosity[i] = particles.position[i].x > middle.x ? 0.4 : 0.1;
    block.run(ViscosityJump{{block.mobility}, particles.volume, gradient, viscosity, 0.1, force});
    Vector traction{}, on_more_viscous{};
    double area = 0.0;
    for (Index i = 0; i < particles.count(); ++i) {
        const Vector offset = particles.position[i] - middle;
        const bool inside =
            std::abs(offset.x) < 3.0 && std::abs(offset.z) < 3.0 && (GetParam() == 2 || std::abs(offset.y) < 3.0);
        if (!inside) continue;
        traction += force[i];
        if (offset.x > 0.0) on_more_viscous += force[i];
        area += 1.0 / 6.0;
    }
    EXPECT_NEAR(traction.x / area, 0.3, 0.003);
    EXPECT_NEAR(traction.z / area, 0.6, 0.006);
    // Each side bears the share that its viscosity has of both.
    EXPECT_NEAR(on_more_viscous.z / traction.z, 0.8, 1e-6);
    Vector total{};
    for (Index i = 0; i < particles.count(); ++i)
        total += force[i];
    EXPECT_LT(norm(total), 1e-12 * norm(traction));
}

TEST_P(FlowModels, TransportBetweenPhasesFollowsTheMeanStrain)
{
    Block block(GetParam(), 12, 0.2);
    Particles& particles = block.particles;
    const VelocityGradientFields gradient = VelocityGradientFields::register_in(particles);
    VectorField& transport = particles.add_vector({"transport_velocity", "m/s"});
    ScalarField& potential = particles.add_scalar({"volume_potential", "1/s"});
    const double h = 1.0, strength = 0.05;
    const auto mean_speed = [&](const auto& velocity_of) {
        for (Index i = 0; i < particles.count(); ++i)
            particles.velocity.set(i, velocity_of(i));
        block.run(VelocityGradient{{block.mobility}, particles.velocity, block.correction, gradient});
        block.run(
            TransportVelocity{{block.mobility}, strength, h, 1e9, particles.volume, gradient, potential, transport});
        double sum = 0.0;
        for (Index i = 0; i < particles.count(); ++i)
            sum += norm(transport[i]) / static_cast<double>(particles.count());
        return sum;
    };
    EXPECT_EQ(mean_speed([](Index) { return Vector{3.0, 0.0, -2.0}; }), 0.0);
    // Shear of the rate 0.4: nowhere more than ½ U, U = 20 s h γ̇.
    const auto shear = [&](double rate) {
        return mean_speed([&](Index i) { return Vector{rate * particles.position[i].z, 0.0, 0.0}; });
    };
    const double sheared = shear(0.4);
    EXPECT_GT(sheared, 1e-3);
    for (Index i = 0; i < particles.count(); ++i)
        EXPECT_LE(norm(transport[i]), 0.5 * 20.0 * strength * h * 0.4 * (1.0 + 1e-6));
    EXPECT_NEAR(shear(0.8), 2.0 * sheared, 1e-6 * sheared);
    // Velocities that differ at random from one particle to the next have less of a mean strain than of a local one.
    std::mt19937 random(3);
    std::uniform_real_distribution<double> noise(-0.5, 0.5);
    double local = 0.0;
    const double stirred = mean_speed([&](Index) { return Vector{noise(random), 0.0, noise(random)}; });
    for (Index i = 0; i < particles.count(); ++i)
        local += gradient.strain_rate(i) / static_cast<double>(particles.count());
    EXPECT_LT(stirred / local, 0.75 * sheared / 0.4);
}

TEST_P(FlowModels, TransportBetweenPhasesKeepsTheFirstRowAtItsDistanceFromAWall)
{
    Block block(GetParam(), 12, 0.2);
    Particles& particles = block.particles;
    for (Index i = 0; i < particles.count(); ++i)
        block.mobility[i] = particles.position[i].z < 4.0 ? 0.0 : 1.0;
    block.neighbourhood.rebuild(particles, block.mobility);
    for (Index i = 0; i < particles.count(); ++i)
        particles.velocity.set(i, {0.4 * particles.position[i].z, 0.0, 0.0});
    const VelocityGradientFields gradient = VelocityGradientFields::register_in(particles);
    VectorField& transport = particles.add_vector({"transport_velocity", "m/s"});
    ScalarField& potential = particles.add_scalar({"volume_potential", "1/s"});
    block.run(VelocityGradient{{block.mobility}, particles.velocity, block.correction, gradient});
    block.run(TransportVelocity{{block.mobility}, 0.05, 1.0, 1e9, particles.volume, gradient, potential, transport});
    int first = 0, further = 0;
    for (Index i = 0; i < particles.count(); ++i) {
        if (block.mobility[i] == 0.0) continue;
        Vector wall{};
        for (Index j = 0; j < particles.count(); ++j)
            if (block.mobility[j] == 0.0) {
                const Vector offset = particles.position[i] - particles.position[j];
                wall += block.kernel(norm(offset)).gradient_over_r * offset;
            }
        const Vector u = transport[i];
        const double normal = std::abs(dot(u, wall)), size = norm(wall);
        if (2.5 * size > 1.0) { // all of the normal part is left out, and the rest is not
            EXPECT_LT(normal, 1e-4 * size * norm(u)) << particles.position[i].z;
            ++first;
        }
        else if (size > 0.0) {
            further += normal > 0.1 * size * norm(u) ? 1 : 0;
        }
    }
    EXPECT_GE(first, GetParam() == 2 ? 6 : 72);
    EXPECT_GE(further, first);
}

/// The relaxation of q takes from a transport velocity what would change volumes. The greatest speed is left out of
/// play: a velocity that is cut off is no longer the gradient of anything.
TEST_P(FlowModels, TransportBetweenPhasesComesToChangeNoVolumes)
{
    Block block(GetParam(), 12, 0.2);
    Particles& particles = block.particles;
    for (Index i = 0; i < particles.count(); ++i)
        particles.velocity.set(i, {0.4 * particles.position[i].z, 0.0, 0.0});
    const VelocityGradientFields gradient = VelocityGradientFields::register_in(particles);
    VectorField& transport = particles.add_vector({"transport_velocity", "m/s"});
    ScalarField& potential = particles.add_scalar({"volume_potential", "1/s"});
    ScalarField& rate = particles.add_scalar({"transport_rate", "m3/s"});
    block.run(VelocityGradient{{block.mobility}, particles.velocity, block.correction, gradient});
    const auto step = [&] {
        block.run(
            TransportVelocity{{block.mobility}, 0.05, 1.0, 1e9, particles.volume, gradient, potential, transport});
        block.run(
            DensitySummation{{block.mobility}, particles.mass, transport, particles.volume, particles.density, rate});
        double sum = 0.0;
        for (Index i = 0; i < particles.count(); ++i) {
            sum += std::pow(rate[i] / particles.volume[i], 2);
            potential[i] -= rate[i] / particles.volume[i];
        }
        return std::sqrt(sum / static_cast<double>(particles.count()));
    };
    step(); // which finds the volumes
    for (Index i = 0; i < particles.count(); ++i)
        potential[i] = 0.0;
    const double at_first = step();
    double now = at_first;
    for (int k = 0; k < 100; ++k)
        now = step();
    EXPECT_GT(at_first, 1e-3);
    EXPECT_LT(now, 0.3 * at_first);
}

TEST_P(FlowModels, ShiftingConservesMassAndMovesNothingAtRest)
{
    Block block(GetParam());
    Particles& particles = block.particles;
    const VelocityGradientFields velocity_gradient = VelocityGradientFields::register_in(particles);
    VectorField& gradient = particles.add_vector({"colour_gradient", "1/m"});
    VectorField& shift = particles.add_vector({"shift", "m/s"});
    ScalarField& companions = particles.add_scalar({"companions", "1"}, 10.0);
    ScalarField& balance = particles.add_scalar({"balance", "1"}, 1.0);
    ScalarField& surface_delta = particles.add_scalar({"surface_delta", "1/m"});
    ScalarField& speed = particles.add_scalar({"shifting_speed", "m/s"});
    ScalarField& density_rate = particles.add_scalar({"density_rate", "kg/(m3 s)"});
    ScalarField& mass_rate = particles.add_scalar({"mass_rate", "kg/s"});
    VectorField& momentum_rate = particles.add_vector({"momentum_rate", "N"});
    ScalarField& enthalpy = particles.add_scalar({"enthalpy", "J/kg"});
    ScalarField& energy_rate = particles.add_scalar({"energy_rate", "W"});
    const auto shifting = [&] {
        block.run(VelocityGradient{{block.mobility}, particles.velocity, block.correction, velocity_gradient});
        block.run(ShiftingVelocity{{block.mobility},
                                   1.0,
                                   1.0,
                                   100.0,
                                   block.kernel(1.0).value,
                                   1e9,
                                   velocity_gradient,
                                   particles.mass,
                                   1.0,
                                   companions,
                                   4.0,
                                   &gradient,
                                   surface_delta,
                                   shift,
                                   speed,
                                   nullptr});
    };
    shifting();
    for (Index i = 0; i < particles.count(); ++i)
        EXPECT_EQ(norm(shift[i]), 0.0);
    for (Index i = 0; i < particles.count(); ++i)
        particles.velocity.set(i, {3.0 * particles.position[i].z, 0.0, 0.0});
    shifting();
    // Simple shear u = 3 z has γ̇ = 3.
    EXPECT_NEAR(velocity_gradient.strain_rate(0), 3.0, 1e-9);
    for (Index i = 0; i < particles.count(); ++i) {
        enthalpy[i] = 1.0 + 0.1 * particles.position[i].x;
        balance[i] = i % 3 == 0 ? 0.3 : 0.9;
        particles.mass[i] *= i % 3 == 0 ? 1.14 : 0.98;
    }
    block.run(ShiftingExchange<true>{{block.mobility},
                                     particles.volume,
                                     particles.density,
                                     particles.velocity,
                                     shift,
                                     particles.mass,
                                     speed,
                                     0.5,
                                     balance,
                                     &enthalpy,
                                     density_rate,
                                     mass_rate,
                                     momentum_rate,
                                     &energy_rate});
    for (const ScalarField* rate : {&mass_rate, &energy_rate}) {
        double total = 0.0, size = 0.0;
        for (Index i = 0; i < particles.count(); ++i) {
            total += (*rate)[i];
            size += std::abs((*rate)[i]);
        }
        EXPECT_GT(size, 0.0);
        EXPECT_LT(std::abs(total), 1e-12 * size);
    }
    // d(½ m v²) = v·(m dv) + ½ v² dm, and d(m v) = m dv + v dm: a pair keeps both.
    Vector momentum{};
    double kinetic = 0.0, moved = 0.0, spread = 0.0;
    for (Index i = 0; i < particles.count(); ++i) {
        const Vector v = particles.velocity[i];
        kinetic += dot(v, momentum_rate[i]) + 0.5 * dot(v, v) * mass_rate[i];
        momentum += momentum_rate[i] + mass_rate[i] * v;
        moved += std::abs(0.5 * dot(v, v) * mass_rate[i]);
        spread += (particles.mass[i] / particles.volume[i] - 1.0) * mass_rate[i];
    }
    EXPECT_LT(std::abs(kinetic), 1e-12 * moved);
    EXPECT_LT(norm(momentum), 1e-12 * moved);
    EXPECT_LT(spread, 0.0); // masses are evened out
}

TEST_P(FlowModels, PackingRaisesDensityWhereVolumesOverlap)
{
    Block block(GetParam(), 12, 0.0);
    Particles& particles = block.particles;
    ScalarField& speed = particles.add_scalar({"shifting_speed", "m/s"}, 0.5);
    ScalarField& rate = particles.add_scalar({"packing_rate", "kg/(m3 s)"});
    const Vector middle = block.middle();
    Index inner = 0;
    for (Index i = 0; i < particles.count(); ++i)
        if (norm(particles.position[i] - middle) < norm(particles.position[inner] - middle)) inner = i;
    const double lattice = sum_over_lattice(block.kernel, 1.0, GetParam());
    EXPECT_NEAR(lattice, 1.0, 1e-3);
    const Packing packing{{block.mobility}, 2.0, lattice, speed, nullptr, particles.density, rate};
    for (const double overlap : {-0.03, 0.0, 0.02}) {
        for (Index i = 0; i < particles.count(); ++i)
            particles.volume[i] = (1.0 + overlap) * 1.0;
        block.run(packing);
        // C = (1 + overlap) C₀ on a lattice of unit spacing; U/h = 1/4 a second.
        EXPECT_NEAR(rate[inner], 0.25 * particles.density[inner] * overlap * lattice, 1e-12 * particles.density[inner]);
    }
    speed[inner] = 0.0;
    block.run(packing);
    EXPECT_EQ(rate[inner], 0.0);
}

TEST_P(FlowModels, AStressOnTheSurfaceIsSharedOutAsViscosityAnswersIt)
{
    // A block whose upper faces are free: u = z is what a stress μ x̂ on the top drives. Each column of it takes the
    // whole stress, and viscous force and stress cancel on every particle far from the other faces, whatever a colour
    // gradient says inside, where it is noise.
    Block block(GetParam(), 14, 0.0);
    Particles& particles = block.particles;
    VectorField& pressure_force = particles.add_vector({"pressure_force", "N"});
    VectorField& force = particles.add_vector({"force", "N"});
    VectorField& wall_force = particles.add_vector({"wall_force", "N"});
    VectorField& direction = particles.add_vector({"direction", "1"});
    ScalarField& share = particles.add_scalar({"share", "1/m"});
    const SurfaceFields surface = SurfaceFields::register_in(particles);
    ScalarField& no_pressure = particles.add_scalar({"no_pressure", "Pa"});
    const VelocityGradientFields gradient = VelocityGradientFields::register_in(particles);
    double top = -1e9;
    const Vector middle = block.middle();
    for (Index i = 0; i < particles.count(); ++i) {
        top = std::max(top, particles.position[i].z);
        particles.velocity.set(i, {particles.position[i].z, 0.0, 0.0});
    }
    for (Index i = 0; i < particles.count(); ++i) {
        const double depth = top - particles.position[i].z;
        const double slope = depth < 0.5 ? 0.468 : 0.1; // |∇c| of a lattice's first two layers
        surface.delta[i] = depth < 3.5 ? 2.0 * slope : 0.0;
        surface.normal.set(i, depth < 0.5 ? Vector{0.0, 0.0, 1.0} : Vector{0.6, 0.0, -0.8});
        surface.colour_gradient.set(i, slope * surface.normal[i]);
    }
    block.run(VelocityGradient{{block.mobility}, particles.velocity, block.correction, gradient});
    block.run(FreeSurfaceMomentum{
        {block.mobility}, particles.volume, no_pressure, particles.velocity, 1.0, pressure_force, force, wall_force});
    VectorField& own_sum = particles.add_vector({"own_sum", "1/m"});
    block.run(ViscousTraction{{block.mobility}, particles.volume, gradient, 1.0, block.correction, force, &own_sum});
    std::fill(share.values.begin(), share.values.end(), SurfaceStressShare::wanted);
    block.run(SurfaceStressShare{
        {block.mobility}, block.correction, own_sum, surface, block.kernel.smoothing_length(), share, direction});
    double column = 0.0;
    for (Index i = 0; i < particles.count(); ++i) {
        const Vector offset = particles.position[i] - middle;
        const double depth = top - particles.position[i].z;
        if (std::abs(offset.x) > 0.6 || std::abs(offset.y) > 0.6 || depth > 3.5) continue;
        EXPECT_NEAR(force[i].x + particles.volume[i] * share[i], 0.0, 1e-3) << depth;
        EXPECT_NEAR(direction[i].z, 1.0, 1e-12);
        if (std::abs(offset.x) <= 0.5 + 1e-9 && offset.x > -0.5 + 1e-9 && std::abs(offset.y) <= 0.5 + 1e-9 &&
            (GetParam() == 2 || offset.y > -0.5 + 1e-9))
            column += particles.volume[i] * share[i];
    }
    EXPECT_NEAR(column, 1.0, 1e-3);
}

TEST(EquationOfState, DensityAndPressureAreInverse)
{
    for (const double exponent : {1.0, 7.0}) {
        const EquationOfState state{20.0, exponent};
        EXPECT_NEAR(state.density(state.pressure(1010.0, 1000.0), 1000.0), 1010.0, 1e-9);
        EXPECT_EQ(state.pressure(1000.0, 1000.0), 0.0);
    }
}

TEST(ColourProfile, IsOneHalfOnTheSurfaceAndInverseToItself)
{
    const RootFree kernel(1.0, 3);
    const ColourProfile profile(kernel, 3);
    EXPECT_NEAR(profile.depth(0.5), 0.0, 1e-12);
    // w integrates to one: what lies above s and what lies below add up.
    double integral = 0.0;
    for (int k = -3000; k < 3000; ++k)
        integral += 1e-3 * profile.plane_weight((k + 0.5) * 1e-3);
    EXPECT_NEAR(integral, 1.0, 1e-4);
    EXPECT_NEAR(profile.depth(0.8), -profile.depth(0.2), 1e-12);
}

TEST(ColourProfile, OutermostRowOfALatticeLiesHalfASpacingDeep)
{
    for (const int dimensions : {2, 3}) {
        const RootFree kernel(1.0, dimensions);
        // The smoothed colour of a particle in the k-th row of a half space of lattice points.
        const auto colour = [&](int row) {
            double sum = 0.0;
            for (int z = -3; z <= row; ++z)
                for (int x = -3; x <= 3; ++x)
                    for (int y = dimensions == 2 ? 0 : -3; y <= (dimensions == 2 ? 0 : 3); ++y)
                        sum += kernel(std::sqrt(double(x * x + y * y + z * z))).value;
            return sum;
        };
        const ColourProfile flat(kernel, dimensions), rows(kernel, dimensions, 1.0);
        EXPECT_NEAR(flat.depth(colour(0)), 0.545, 0.005);
        EXPECT_NEAR(rows.depth(colour(0)), 0.5, 1e-3);
        // Second moment of the kernel along a row, by a sum.
        double weight = 0.0, moment = 0.0;
        for (double x = -3.0; x <= 3.0; x += 0.05)
            for (double y = dimensions == 2 ? 0.0 : -3.0; y <= (dimensions == 2 ? 0.0 : 3.0); y += 0.05) {
                const double value = kernel(std::sqrt(x * x + y * y + 0.25)).value;
                weight += value;
                moment += value * x * x;
            }
        EXPECT_NEAR(rows.tangential_variance(), moment / weight, 1e-3);
    }
}

TEST(TangentPlaneCurvature, IsThatOfTheSurfaceAboveTheParticle)
{
    // Spheres, cylinders and a saddle through a particle at depth s: principal curvatures k become k/(1 + k s).
    const auto at_surface = [](double k1, double k2, double s) {
        return TangentPlaneCurvature::of_parallel_surface(k1 + k2, k1 * k2, s);
    };
    EXPECT_NEAR(at_surface(1.0 / 9.0, 1.0 / 9.0, 1.0), 2.0 / 10.0, 1e-15);
    EXPECT_NEAR(at_surface(1.0 / 9.0, 0.0, 1.0), 1.0 / 10.0, 1e-15);
    EXPECT_NEAR(at_surface(-1.0 / 11.0, 0.0, 1.0), -1.0 / 10.0, 1e-15);
    EXPECT_NEAR(at_surface(0.1, -0.1, 1.0), 0.1 / 1.1 - 0.1 / 0.9, 1e-15);
}

TEST_P(FlowModels, NormalOfALinearDepthIsExactHoweverParticlesLie)
{
    Block block(GetParam(), 12, 0.3);
    const Particles& particles = block.particles;
    SurfaceFields surface = SurfaceFields::register_in(block.particles);
    const Vector outward = GetParam() == 2 ? Vector{0.6, 0.0, 0.8} : Vector{0.48, -0.6, 0.64};
    const Vector by_colour{1.0, 0.0, 0.0};
    // A band four spacings wide, and beside it particles whose depth nobody knows.
    for (Index i = 0; i < particles.count(); ++i) {
        const double depth = dot(Vector{6.0, GetParam() == 2 ? 0.0 : 6.0, 6.0} - particles.position[i], outward);
        const bool known = std::abs(depth) < 2.0;
        surface.delta[i] = known ? 2.1 - std::abs(depth) : 0.0;
        surface.depth[i] = known ? depth : 99.0;
        surface.normal.set(i, by_colour);
    }
    block.run(NormalOfDepth{{block.mobility}, GetParam(), surface});
    int seen = 0;
    for (Index i = 0; i < particles.count(); ++i)
        if (surface.delta[i] > 0.0) {
            EXPECT_NEAR(norm(surface.smoothed_normal[i] - outward), 0.0, 1e-9);
            ++seen;
        }
    EXPECT_GT(seen, 40);
    // In a film both of whose sides are as far, depth does not say which way is out.
    for (Index i = 0; i < particles.count(); ++i)
        surface.depth[i] = 1.0;
    block.run(NormalOfDepth{{block.mobility}, GetParam(), surface});
    for (Index i = 0; i < particles.count(); ++i)
        EXPECT_TRUE(surface.delta[i] == 0.0 || norm(surface.smoothed_normal[i] - by_colour) < 1e-12);
}

TEST_P(FlowModels, SolidsWithLiquidWithinReachTakePartInTheSurface)
{
    Block block(GetParam(), 12, 0.0);
    Particles& particles = block.particles;
    ScalarField& metal = particles.add_scalar({"metal", "1"});
    // Liquid above z = 6 on solid; walls at the sides. Within 2.9 spacings: rows at 5.5 and 4.5.
    for (Index i = 0; i < particles.count(); ++i) {
        const Vector p = particles.position[i];
        const bool liquid = p.z > 6.0, wall = !liquid && p.x < 1.0;
        block.mobility[i] = liquid ? 1.0 : 0.0;
        particles.kind[static_cast<std::size_t>(i)] = liquid ? Kind::fluid : wall ? Kind::wall : Kind::solid;
        metal[i] = -1.0;
    }
    for_each_pair(block.neighbourhood.list(), particles, block.kernel, block.neighbourhood.all(),
                  SolidBesideLiquid{{block.mobility}, particles.kind, 1.0, metal});
    for (Index i = 0; i < particles.count(); ++i) {
        const bool solid = particles.kind[static_cast<std::size_t>(i)] == Kind::solid;
        EXPECT_EQ(metal[i], !solid ? -1.0 : particles.position[i].z > 4.4 ? 1.0 : 0.0) << particles.position[i].z;
    }
}

TEST_P(FlowModels, WhatLiesBelowAnotherIsNotExposed)
{
    Block block(GetParam(), 12, 0.0);
    Particles& particles = block.particles;
    const SurfaceFields surface = SurfaceFields::register_in(particles);
    ScalarField& exposure = particles.add_scalar({"exposure", "1"});
    // A valley whose sides fall at 40 degrees to x = 6, and a flat top beside it: what lies above them is taken away.
    const auto height = [](double x) { return 8.0 + std::tan(0.7) * std::min(std::abs(x - 6.0), 3.0); };
    for (Index i = 0; i < particles.count(); ++i) {
        const Vector p = particles.position[i];
        surface.delta[i] = p.z < height(p.x) ? 1.0 : 0.0;
        surface.normal.set(i, {0.0, 0.0, 1.0});
    }
    block.run(Exposure{{block.mobility}, 0.5, block.kernel(1.0).value, surface, exposure});
    int top = 0, below = 0;
    for (Index i = 0; i < particles.count(); ++i) {
        const Vector p = particles.position[i];
        const double depth = height(p.x) - p.z;
        EXPECT_EQ(exposure[i], depth >= 0.0 && depth < 1.0 ? 1.0 : 0.0) << p.x << " " << p.z;
        (depth < 1.0 ? top : below) += depth >= 0.0 ? 1 : 0;
    }
    EXPECT_EQ(top, GetParam() == 2 ? 12 : 144);
    EXPECT_GT(below, 5 * top);
}

TEST_P(FlowModels, InTheBandVolumesThatOverlapMakeDensityGrowAndGapsDoNot)
{
    Block block(GetParam(), 12, 0.0);
    Particles& particles = block.particles;
    ScalarField& speed = particles.add_scalar({"speed", "m/s"});
    ScalarField& of_band = particles.add_scalar({"of_band", "m/s"}, 2.0);
    ScalarField& rate = particles.add_scalar({"rate", "kg/(m3 s)"});
    for (Index i = 0; i < particles.count(); ++i) {
        of_band[i] = 2.0;
        particles.position.set(i, 0.99 * particles.position[i]);
    }
    block.neighbourhood.rebuild(particles, block.mobility);
    block.run(Packing{{block.mobility}, 1.0, 1.0, speed, &of_band, particles.density, rate});
    double greatest = 0.0;
    for (Index i = 0; i < particles.count(); ++i) {
        EXPECT_GE(rate[i], 0.0); // at the block's faces kernels are not full
        greatest = std::max(greatest, rate[i]);
    }
    // Inside, C = 0.99⁻ᵈ.
    EXPECT_NEAR(greatest, 2.0 * (std::pow(0.99, -GetParam()) - 1.0), 2e-4);
    block.run(Packing{{block.mobility}, 1.0, 1.0, speed, nullptr, particles.density, rate});
    for (Index i = 0; i < particles.count(); ++i)
        EXPECT_EQ(rate[i], 0.0);
}

TEST(SurfaceForces, PointWhereTheyShould)
{
    const Vector up{0, 0, 1};
    // A drop (κ > 0 with n̂ out of it) is pressed together, and metal is drawn to the cold side.
    EXPECT_DOUBLE_EQ(surface_load_force(2.0, up, 3.0).z, -6.0);
    const Vector f = marangoni_force(-4e-4, {1000.0, 0.0, 500.0}, up, 2.0);
    EXPECT_DOUBLE_EQ(f.x, -0.8);
    EXPECT_DOUBLE_EQ(f.z, 0.0);
}

TEST(SurfaceTensionLaw, FallsLinearlyToItsFloor)
{
    const SurfaceTensionLaw steel{1.2, -4.3e-4, 1723.0, 0.1};
    EXPECT_NEAR(steel(2723.0), 0.77, 1e-12);
    EXPECT_EQ(steel(9000.0), 0.1);
}

} // namespace
} // namespace cupel
