#include <gtest/gtest.h>

#include "block_of_liquid.hpp"
#include "models/interface_pressure.hpp"
#include "models/wetting.hpp"

namespace cupel
{
namespace
{

class Interface : public testing::TestWithParam<int>
{};
INSTANTIATE_TEST_SUITE_P(Dimensions, Interface, testing::Values(2, 3));

/// Two phases side by side along x, the left one the primary.
struct TwoPhases : Block
{
    TwoPhases(int dimensions_, double jitter, double density_1, double density_2)
        : Block(dimensions_, 12, jitter), colour(scalar("colour")), delta(scalar("delta")), load(scalar("load")),
          value(scalar("value")), other(scalar("other")), mean(scalar("mean")),
          acceleration(particles.add_vector({"carried_acceleration", "m/s2"}))
    {
        for (Index i = 0; i < particles.count(); ++i) {
            colour[i] = particles.position[i].x < 6.0 ? 1.0 : 0.0;
            particles.density[i] = colour[i] != 0.0 ? density_1 : density_2;
            delta[i] = 1.0;
            load[i] = 5.0;
        }
    }
    ScalarField& scalar(const char* name) { return particles.add_scalar({name, "1"}); }
    void carry()
    {
        run(InterfacePressure{{mobility},
                              particles.volume,
                              particles.density,
                              colour,
                              delta,
                              load,
                              value,
                              other,
                              correction,
                              mean,
                              acceleration});
    }

    ScalarField &colour, &delta, &load, &value, &other, &mean;
    VectorField& acceleration;
};

TEST_P(Interface, AnEvenLoadDrivesNothingHoweverParticlesLie)
{
    TwoPhases block(GetParam(), 0.25, 1000.0, 1.0);
    for (Index i = 0; i < block.particles.count(); ++i)
        block.value[i] = 2.0 + 5.0 * block.colour[i];
    block.carry();
    for (Index i = 0; i < block.particles.count(); ++i) {
        EXPECT_NEAR(block.mean[i], block.value[i], 1e-12);
        EXPECT_LT(norm(block.acceleration[i]), 1e-12);
    }
}

TEST_P(Interface, PhasesOfUnequalDensityAreDrivenAlike)
{
    // λ falls by ρ g along x in each phase: a jump of 5 at x = 6 and the acceleration g on both sides.
    const double g = 0.5;
    TwoPhases block(GetParam(), 0.0, 3.0, 1.0);
    for (Index i = 0; i < block.particles.count(); ++i)
        block.value[i] = 5.0 * block.colour[i] - block.particles.density[i] * g * (block.particles.position[i].x - 6.0);
    block.carry();
    double greatest = 0.0, least = 1e9;
    for (Index i = 0; i < block.particles.count(); ++i) {
        const Vector p = block.particles.position[i], a = block.acceleration[i];
        if (std::abs(p.x - 6.0) > 3.5) {
            EXPECT_NEAR(norm(a - Vector{g, 0.0, 0.0}), 0.0, 1e-10);
        }
        greatest = std::max(greatest, a.x);
        least = std::min(least, a.x);
    }
    // Where particles see both, pairs do not all cross at their middle.
    EXPECT_LT(greatest, 1.3 * g);
    EXPECT_GT(least, 0.7 * g);
}

TEST_P(Interface, PullAtAContactLineHasTheIntegralOfYoungsForce)
{
    Block block(GetParam(), 12, 0.0);
    Particles& particles = block.particles;
    ScalarField& depth = particles.add_scalar({"depth", "m"});
    ScalarField& weight = particles.add_scalar({"weight", "1"});
    VectorField& normal = particles.add_vector({"normal", "1"});
    VectorField& wall_pull = particles.add_vector({"at_wall", "1"});
    VectorField& pull = particles.add_vector({"pull", "1/m"});
    const double plane = 4.0; // between two rows of the lattice
    for (Index i = 0; i < particles.count(); ++i) {
        const double height = particles.position[i].z - plane;
        normal.set(i, {0.0, 0.0, 1.0});
        if (height > 0.0) continue;
        block.mobility[i] = 0.0;
        depth[i] = -height;
        if (height < -1.0) continue;
        weight[i] = 2.0;
        wall_pull.set(i, {0.3, 0.0, 0.0});
    }
    block.run(ContactPull{{block.mobility}, 1.0, normal, depth, weight, wall_pull, pull});
    double column = 0.0;
    for (Index i = 0; i < particles.count(); ++i) {
        if (std::abs(particles.position[i].x - 6.5) > 1e-9 || particles.position[i].z < plane) continue;
        if (GetParam() == 3 && std::abs(particles.position[i].y - 6.5) > 1e-9) continue;
        column += pull[i].x; // times a volume over an area of one
        EXPECT_EQ(pull[i].z, 0.0);
    }
    EXPECT_NEAR(column, 0.3, 1e-12);
}

} // namespace
} // namespace cupel
