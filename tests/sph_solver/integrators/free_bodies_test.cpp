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
    /// How many particles each free body has.
    std::vector<std::size_t> free_bodies(Images images = {})
    {
        Neighbourhood neighbourhood(support, skin, 1.0, 2, std::move(images));
        neighbourhood.rebuild(particles, mobility);
        FreeBodies bodies;
        std::vector<std::size_t> sizes;
        for (const auto& body : bodies.find(neighbourhood, particles, mobility))
            sizes.push_back(body.size());
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

TEST(FreeBodies, HangTogetherAcrossAPeriodAndAreHeldByAMirror)
{
    Domain domain;
    domain.lower = {0, 0, 0};
    domain.upper = {20, 0, 200};
    const auto with_sides = [&](BoundaryKind kind) {
        domain.boundaries[0] = domain.boundaries[1] = Boundary{kind, true, {}};
        return Images(domain, 2, 1.0, support + skin, skin);
    };
    // At the two sides, seen across them, and one in the middle.
    const std::vector<Vector> corners{{0.5, 0, 0}, {16.5, 0, 0}, {8.5, 0, 0}, {8.5, 0, 100}};
    EXPECT_EQ(Squares(corners).free_bodies(with_sides(BoundaryKind::periodic)), (Sizes{32, 16}));
    EXPECT_EQ(Squares(corners).free_bodies(with_sides(BoundaryKind::symmetry)), (Sizes{16}));
}

TEST(ClosedSurfaceTension, TakesItsResultantFromAllInProportionToTheirMass)
{
    Particles particles(3);
    VectorField& gradient = particles.add_vector({"gradient", "Pa/m"});
    VectorField& force = particles.add_vector({"force", "N"});
    const double mass[] = {1, 2, 1}, volume[] = {0.5, 1, 0.5}, slope[] = {4, 1, -2};
    for (Index i = 0; i < 3; ++i) {
        particles.mass[i] = mass[i];
        particles.volume[i] = volume[i];
        gradient.set(i, {slope[i], 0, 0});
        force.set(i, {10.0 - volume[i] * slope[i], 7.0, 0});
    }
    const std::vector<Index> body{0, 1}; // the third is not of it
    ClosedSurfaceTension{particles.mass, particles.volume, gradient, force}.balance(body);
    // Of the load, −2 − 1 = −3 N on 3 kg.
    EXPECT_DOUBLE_EQ(force[0].x, 10.0 - 2.0 + 1.0);
    EXPECT_DOUBLE_EQ(force[1].x, 10.0 - 1.0 + 2.0);
    EXPECT_DOUBLE_EQ(force[2].x, 10.0 + 1.0);
    EXPECT_DOUBLE_EQ(force[1].y, 7.0);
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

} // namespace
} // namespace cupel
