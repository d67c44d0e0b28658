/// Bodies of liquid that touch nothing, and what their surfaces' tension may not do to them.
#include "integrators/free_bodies.hpp"

#include <gtest/gtest.h>

#include "models/closed_surface_tension.hpp"
#include "simulated.hpp"

namespace cupel
{
namespace
{

using namespace small_scenes;

constexpr double support = 3.0, skin = 0.3;

/// Squares of 4 by 4 particles, their lower left ones at the places given; the last of them stands.
struct Squares
{
    explicit Squares(const std::vector<Vector>& corners)
        : particles(static_cast<Index>(16 * corners.size())), mobility(particles.add_scalar({"mobility", "1"}, 1.0))
    {
        Index i = 0;
        for (const Vector& corner : corners)
            for (int k = 0; k < 16; ++k, ++i) {
                particles.position.set(i, corner + Vector{double(k % 4), 0.0, double(k / 4)});
                if (&corner == &corners.back()) mobility[i] = 0.0;
            }
    }
    std::vector<FreeBody> find(Images images = {})
    {
        Neighbourhood neighbourhood(support, skin, 1.0, 2, std::move(images));
        neighbourhood.rebuild(particles, mobility);
        FreeBodies bodies;
        return bodies.find(neighbourhood, particles, mobility);
    }
    /// How many particles each free body has.
    std::vector<std::size_t> free_bodies(Images images = {})
    {
        std::vector<std::size_t> sizes;
        for (const FreeBody& body : find(std::move(images)))
            sizes.push_back(body.particles.size());
        return sizes;
    }

    Particles particles;
    ScalarField& mobility;
};

using Sizes = std::vector<std::size_t>;

TEST(FreeBodies, HangTogetherWithinTheReachOfListsAndTouchNothingWithinTheKernels)
{
    // One above the other, so that clusters hold parts of both: 3 between them and 1 spacing of their own.
    EXPECT_EQ(Squares({{0, 0, 0}, {0, 0, 6.2}, {50, 0, 50}}).free_bodies(), (Sizes{32}));
    EXPECT_EQ(Squares({{0, 0, 0}, {0, 0, 6.4}, {50, 0, 50}}).free_bodies(), (Sizes{16, 16}));
    // What stands is within the lists' reach, then within the kernel's.
    EXPECT_EQ(Squares({{0, 0, 0}, {0, 0, 6.4}, {6.1, 0, 0}}).free_bodies(), (Sizes{16, 16}));
    EXPECT_EQ(Squares({{0, 0, 0}, {0, 0, 6.4}, {5.9, 0, 0}}).free_bodies(), (Sizes{16}));
    // All of a body is held where a part of it is.
    EXPECT_EQ(Squares({{0, 0, 0}, {0, 0, 6.2}, {5.9, 0, 0}}).free_bodies(), (Sizes{}));
}

/// A strip between two sides, 20 spacings apart.
Images between_sides(BoundaryKind kind)
{
    Domain domain;
    domain.lower = {0, 0, 0};
    domain.upper = {20, 0, 200};
    domain.boundaries[0] = domain.boundaries[1] = Boundary{kind, true, {}};
    return {domain, 2, 1.0, support + skin, skin};
}

TEST(FreeBodies, HangTogetherAcrossAPeriodAndAreHeldByAMirror)
{
    // At the two sides, seen across them, and one in the middle.
    const std::vector<Vector> corners{{0.5, 0, 0}, {16.5, 0, 0}, {8.5, 0, 0}, {8.5, 0, 100}};
    EXPECT_EQ(Squares(corners).free_bodies(between_sides(BoundaryKind::periodic)), (Sizes{32, 16}));
    EXPECT_EQ(Squares(corners).free_bodies(between_sides(BoundaryKind::symmetry)), (Sizes{16}));
}

TEST(FreeBodies, ArePutTogetherAcrossAPeriod)
{
    Squares squares({{0.5, 0, 0}, {16.5, 0, 0}, {8.5, 0, 100}});
    const std::vector<FreeBody> bodies = squares.find(between_sides(BoundaryKind::periodic));
    ASSERT_EQ(bodies.size(), 1u);
    EXPECT_FALSE(bodies.front().endless);
    double least = 1e9, greatest = -1e9;
    for (std::size_t k = 0; k < 32; ++k) {
        const double x = squares.particles.position[bodies.front().particles[k]].x + bodies.front().periods[k].x;
        least = std::min(least, x);
        greatest = std::max(greatest, x);
    }
    EXPECT_DOUBLE_EQ(greatest - least, 7.0); // eight in a row
}

TEST(FreeBodies, HaveNoEndWhereTheyMeetTheirOwnImage)
{
    const std::vector<Vector> row{{0.5, 0, 0}, {4.5, 0, 0}, {8.5, 0, 0}, {12.5, 0, 0}, {16.5, 0, 0}, {8.5, 0, 100}};
    const std::vector<FreeBody> bodies = Squares(row).find(between_sides(BoundaryKind::periodic));
    ASSERT_EQ(bodies.size(), 1u);
    EXPECT_EQ(bodies.front().particles.size(), 80u);
    EXPECT_TRUE(bodies.front().endless);
}

/// Three particles, of which two are a body: of 1 and 2 kg, 3 m apart along x, the nearer one a period away.
struct Pair
{
    Pair()
        : particles(3), gradient(particles.add_vector({"gradient", "Pa/m"})),
          force(particles.add_vector({"force", "N"}))
    {
        const double mass[] = {1, 2, 1}, volume[] = {0.5, 1, 0.5}, slope_x[] = {4, 1, -2}, slope_z[] = {-4, 2, 0};
        const double x[] = {-20, 3, 7};
        for (Index i = 0; i < 3; ++i) {
            particles.mass[i] = mass[i];
            particles.volume[i] = volume[i];
            particles.position.set(i, {x[i], 0, 0});
            gradient.set(i, {slope_x[i], 0, slope_z[i]});
            force.set(i, {10.0 - volume[i] * slope_x[i], 7.0, -volume[i] * slope_z[i]});
        }
    }
    void balance(bool turns)
    {
        const std::vector<Index> body{0, 1};
        const std::vector<Vector> periods{{20, 0, 0}, {}};
        ClosedSurfaceTension{particles.position, particles.mass, particles.volume, gradient, force}.balance(
            body, periods, turns);
    }

    Particles particles;
    VectorField &gradient, &force;
};

TEST(ClosedSurfaceTension, TakesItsResultantFromAllInProportionToTheirMass)
{
    Pair pair;
    pair.balance(false);
    // Of the load, −2 − 1 = −3 N on 3 kg along x, 2 − 2 = 0 N along z.
    EXPECT_DOUBLE_EQ(pair.force[0].x, 10.0 - 2.0 + 1.0);
    EXPECT_DOUBLE_EQ(pair.force[1].x, 10.0 - 1.0 + 2.0);
    EXPECT_DOUBLE_EQ(pair.force[2].x, 10.0 + 1.0);
    EXPECT_DOUBLE_EQ(pair.force[1].y, 7.0);
    EXPECT_DOUBLE_EQ(pair.force[0].z, 2.0);
    EXPECT_DOUBLE_EQ(pair.force[1].z, -2.0);
}

TEST(ClosedSurfaceTension, TakesItsTorqueAsIfTheBodyTurnedRigidly)
{
    Pair pair;
    pair.balance(true);
    // Centre at x = 2. About it the couple of ±2 N 3 m apart, which a pair's rotation takes whole.
    EXPECT_NEAR(pair.force[0].z, 0.0, 1e-14);
    EXPECT_NEAR(pair.force[1].z, 0.0, 1e-14);
    EXPECT_NEAR(pair.force[0].x, 10.0 - 2.0 + 1.0, 1e-14);
    EXPECT_DOUBLE_EQ(pair.force[2].z, 0.0);
}

class FreeDrop : public testing::TestWithParam<int>
{};
INSTANTIATE_TEST_SUITE_P(StepsOfSound, FreeDrop, testing::Values(1, 4));

TEST_P(FreeDrop, KeepsItsMomentum)
{
    Case definition = drop_in_nothing();
    definition.bodies.front().perturbation = Perturbation{2, 0.1};
    definition.numerics.shifting = 1.0;
    definition.numerics.acoustic_substeps = GetParam();
    const Simulation simulation = simulate(definition, 60);
    const Particles& particles = simulation.particles();
    const Vector momentum =
        ordered_sum(particles.count(), [&](Index i) { return particles.mass[i] * particles.velocity[i]; });
    const double sizes =
        ordered_sum(particles.count(), [&](Index i) { return particles.mass[i] * norm(particles.velocity[i]); });
    EXPECT_GT(sizes, 1e-3);
    EXPECT_LT(norm(momentum), 1e-12 * sizes);
}

/// A surface whose particles lie in no order errs in its curvature by several per cent from one to the next. A disc was
/// set spinning by that, for good, since nothing brakes a rigid rotation.
TEST_P(FreeDrop, DoesNotBeginToSpin)
{
    Case definition = drop_in_nothing();
    definition.numerics.position_jitter = 0.2;
    definition.numerics.shifting = 1.0;
    definition.numerics.acoustic_substeps = GetParam();
    const Simulation simulation = simulate(definition, 200);
    const Particles& particles = simulation.particles();
    const Vector centre =
        definition.bodies.front().center[0] * Vector{1, 0, 0} + definition.bodies.front().center[2] * Vector{0, 0, 1};
    const auto lever = [&](Index i) { return particles.position[i] - centre; };
    const Vector spin = ordered_sum(
        particles.count(), [&](Index i) { return particles.mass[i] * cross(lever(i), particles.velocity[i]); });
    const double sizes = ordered_sum(
        particles.count(), [&](Index i) { return particles.mass[i] * norm(lever(i)) * norm(particles.velocity[i]); });
    EXPECT_GT(sizes, 1e-3);
    EXPECT_LT(norm(spin), 1e-3 * sizes);
}

} // namespace
} // namespace cupel
