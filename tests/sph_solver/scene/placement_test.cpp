/// Where the particles of a case start: displaced by perturbations and waves, jittered, moving.
#include "scene/place_particles.hpp"

#include "kernels/root_free.hpp"
#include "scene/free_drop.hpp"
#include "small_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <ranges>
#include <vector>

namespace cupel
{
namespace
{

/// A disc or ball of R = 1 in the middle of a box, `n` spacings a diameter.
Case drop(int dimensions, int n, std::optional<Perturbation> perturbation)
{
    Case definition = small_scenes::pool(dimensions, 2.0 / n);
    definition.numerics.shifting = 0.0; // or particles would start off their lattice
    definition.domain.lower = {-2, dimensions == 2 ? 0.0 : -2, -2};
    definition.domain.upper = {2, dimensions == 2 ? 0.0 : 2, 2};
    for (auto& boundary : definition.domain.boundaries)
        if (boundary) boundary->kind = BoundaryKind::open;
    Body body;
    body.shape = BodyShape::sphere;
    body.material = "liquid";
    body.radius = 1;
    body.perturbation = perturbation;
    definition.bodies = {body};
    return definition;
}

/// Mean over the particles of the moment of a shape: Re(z + i x)^2 in 2-D, 3 z^2 - r^2 in 3-D.
double second_moment(const Particles& particles, int dimensions)
{
    double sum = 0;
    for (Index i = 0; i < particles.count(); ++i) {
        const Vector p = particles.position[i];
        sum += dimensions == 2 ? p.z * p.z - p.x * p.x : 2 * p.z * p.z - p.x * p.x - p.y * p.y;
    }
    return sum / particles.count();
}

TEST(Placement, PerturbedDropHasTheMomentOfItsMode)
{
    const double a = 0.01;
    for (const int dimensions : {2, 3}) {
        const Scene round = place_particles(drop(dimensions, 20, std::nullopt));
        const Scene wavy = place_particles(drop(dimensions, 20, Perturbation{2, a}));
        ASSERT_EQ(round.particles->count(), wavy.particles->count());
        // xi = a grad(r^2 f/2), so the moment grows by 2 a <r^2> in 2-D, and by a <4 z^2 + x^2 + y^2> = 6 a <r^2>/3 in
        // 3-D
        double square = 0;
        for (Index i = 0; i < round.particles->count(); ++i)
            square += dot(round.particles->position[i], round.particles->position[i]) / round.particles->count();
        EXPECT_NEAR(second_moment(*round.particles, dimensions), 0, 1e-12);
        EXPECT_NEAR(second_moment(*wavy.particles, dimensions), 2 * a * square, 5 * a * a);
        for (Index i = 0; i < wavy.particles->count(); ++i)
            ASSERT_EQ(wavy.particles->mass[i], round.particles->mass[i]);
    }
}

TEST(Placement, DropHoldsItsVolume)
{
    const auto volume_of = [](const Scene& scene) {
        double sum = 0.0;
        for (Index i = 0; i < scene.particles->count(); ++i)
            if (scene.particles->kind[static_cast<std::size_t>(i)] == Kind::fluid) sum += scene.particles->volume[i];
        return sum;
    };
    for (const int dimensions : {2, 3}) {
        const double whole = dimensions == 2 ? std::numbers::pi : 4.0 / 3.0 * std::numbers::pi;
        Case definition = drop(dimensions, 20, std::nullopt);
        const Scene ball = place_particles(definition);
        EXPECT_NEAR(volume_of(ball), whole, 1e-12 * whole);
        // Its particles are as far apart as their volume says: the second moment is that of a ball.
        double square = 0.0;
        for (Index i = 0; i < ball.particles->count(); ++i)
            square += dot(ball.particles->position[i], ball.particles->position[i]) / ball.particles->count();
        // On n rings half a spacing from each other's middle it is less by 1/(8 n²), and by what rounds their numbers;
        // on n shells by 1/(12 n²).
        EXPECT_NEAR(square, dimensions / (dimensions + 2.0) - (dimensions == 2 ? 1.0 / 800.0 : 1.0 / 1200.0), 2e-3);
        // Half of it, on the floor of its domain.
        definition.domain.lower[2] = 0.0;
        EXPECT_NEAR(volume_of(place_particles(definition)), 0.5 * whole, 1e-12 * whole);
    }
}

TEST(Placement, DiscInNothingStandsOnRingsASpacingApart)
{
    const int n = 20;
    const Scene scene = place_particles(drop(2, n, std::nullopt));
    const double spacing = 2.0 / n;
    std::vector<int> count(n / 2);
    for (Index i = 0; i < scene.particles->count(); ++i) {
        const double ring = norm(scene.particles->position[i]) / spacing - 0.5;
        EXPECT_NEAR(ring, std::round(ring), 1e-9);
        ++count[static_cast<std::size_t>(std::lround(ring))];
    }
    for (std::size_t k = 0; k < count.size(); ++k) // as many as are a spacing apart
        EXPECT_NEAR(count[k], 2.0 * std::numbers::pi * (static_cast<double>(k) + 0.5), 0.5);
    // Part of one, and one with a wall through it, keep the lattice that walls are placed on.
    Case definition = drop(2, n, std::nullopt);
    definition.domain.lower[2] = 0.0;
    const Scene half = place_particles(definition);
    const double first = half.particles->position[0].z;
    EXPECT_GT(std::ranges::count_if(std::views::iota(Index{0}, half.particles->count()),
                                    [&](Index i) { return std::abs(half.particles->position[i].z - first) < 1e-9; }),
              n / 2);
}

TEST(Placement, BallInNothingStandsOnShellsASpacingApart)
{
    const Scene scene = place_particles(drop(3, 20, std::nullopt));
    // 6 m² on each of ten shells; the outermost lies in the middle of its volume.
    const double all = 1 + 4 + 16 + 25 + 49 + 64 + 81 + 121 + 144 + 196, outermost = 14 * 14;
    ASSERT_EQ(scene.particles->count(), 6 * all);
    const double spacing = std::cbrt(scene.particle_volume), radius = 0.5 * (1.0 + std::cbrt(1.0 - outermost / all));
    int on_outermost = 0;
    double closest = 1.0, loneliest = 0.0;
    Symmetric3<double> moment{};
    for (Index i = 0; i < scene.particles->count(); ++i) {
        const Vector p = scene.particles->position[i];
        moment.subtract_product(p, p);
        EXPECT_LT(norm(p), radius + 1e-9); // none lies further out
        if (norm(p) > radius - 1e-9) ++on_outermost;
        double nearest = 1.0;
        for (Index j = 0; j < scene.particles->count(); ++j)
            if (j != i) nearest = std::min(nearest, norm(p - scene.particles->position[j]));
        closest = std::min(closest, nearest);
        loneliest = std::max(loneliest, nearest);
    }
    EXPECT_EQ(on_outermost, 6 * outermost);
    EXPECT_GT(closest, 0.75 * spacing);
    EXPECT_LT(loneliest, 1.1 * spacing);
    // The cube's axes are alike.
    EXPECT_NEAR(moment.xy, 0.0, 1e-9);
    EXPECT_NEAR(moment.xx, moment.zz, 1e-9);
    // Half a drop, on the floor of its domain, keeps the lattice.
    Case definition = drop(3, 20, std::nullopt);
    definition.domain.lower[2] = 0.0;
    EXPECT_NE(place_particles(definition).particles->count(), 3 * all);
}

TEST(Placement, ShiftingWouldMoveABallInNothingByLittle)
{
    for (const int n : {15, 20}) {
        const Case definition = drop(3, n, std::nullopt);
        const double spacing = definition.spacing;
        const RootFree kernel(spacing, 3);
        // Root mean square of what shifting moves particles by, where all they see is liquid.
        const auto unevenness = [&](const std::vector<Vector>& places) {
            const double volume = 4.0 / 3.0 * std::numbers::pi / static_cast<double>(places.size());
            double square = 0.0;
            int inside = 0;
            for (const Vector& p : places) {
                if (norm(p) > 1.0 - kernel.support()) continue;
                Vector sum{};
                for (const Vector& q : places) {
                    const auto [value, gradient_over_r] = kernel(norm(p - q));
                    const double closeness = value / kernel(spacing).value;
                    sum += (volume * (1.0 + 0.2 * std::pow(closeness, 4)) * gradient_over_r) * (p - q);
                }
                square += dot(sum, sum);
                ++inside;
            }
            return spacing * std::sqrt(square / inside);
        };
        std::vector<Vector> shells, evened;
        for (const auto& place : ball_on_shells(definition.bodies.front(), spacing))
            shells.push_back({place[0], place[1], place[2]});
        const Scene scene = place_particles(definition);
        for (Index i = 0; i < scene.particles->count(); ++i)
            evened.push_back(scene.particles->position[i]);
        EXPECT_LT(unevenness(evened), 0.3 * unevenness(shells)) << unevenness(shells);
    }
}

TEST(Placement, BallOnShellsKeepsVolumes)
{
    // A cap of height h holds π h² (R − h/3), however it lies: on a face, on an edge and on a corner of the cube.
    const Case definition = drop(3, 60, std::nullopt);
    const auto places = ball_on_shells(definition.bodies.front(), definition.spacing);
    const double volume_of_each = 4.0 / 3.0 * std::numbers::pi / static_cast<double>(places.size());
    for (const Vector direction :
         {Vector{0, 0, 1}, Vector{0.8, 0, 0.6}, Vector{1 / std::sqrt(3), 1 / std::sqrt(3), 1 / std::sqrt(3)}})
        for (const double height : {0.4, 0.7, 1.0}) {
            double volume = 0.0;
            for (const auto& [x, y, z] : places)
                if (dot(Vector{x, y, z}, direction) > 1.0 - height) volume += volume_of_each;
            EXPECT_NEAR(volume, std::numbers::pi * height * height * (1.0 - height / 3.0), 0.03 * volume);
        }
}

/// A drop of R = 1 on a cylinder of radius 2 and, with a vessel of radius 4 around, in another liquid.
Case drop_on_a_cylinder(bool two_phase)
{
    Case definition = drop(2, 20, {});
    definition.bodies.front().center = {0, 0, 2};
    definition.domain.lower = {-5, 0, -5};
    definition.domain.upper = {5, 0, 5};
    definition.domain.round_walls = RoundWalls{{}, 2.0, {}};
    if (!two_phase) return definition;
    definition.domain.round_walls->outer_radius = 4.0;
    definition.materials["outside"] = definition.materials.at("liquid");
    definition.surrounding.emplace();
    definition.surrounding->material = "outside";
    definition.surrounding->resolved = true;
    return definition;
}

TEST(Placement, RoundWallsHaveLayersBehindTheirSurface)
{
    const Scene scene = place_particles(drop_on_a_cylinder(true));
    const Particles& particles = *scene.particles;
    int of_cylinder = 0, of_vessel = 0;
    for (Index i = 0; i < particles.count(); ++i) {
        const double r = norm(particles.position[i]);
        if (particles.kind[static_cast<std::size_t>(i)] != Kind::wall) {
            EXPECT_GT(r, 2.0);
            EXPECT_LT(r, 4.0);
            continue;
        }
        const bool inner = r < 3.0;
        ++(inner ? of_cylinder : of_vessel);
        const double depth = particles.scalar("wall_depth")[i], radius = inner ? 2.0 : 4.0, side = inner ? 1.0 : -1.0;
        EXPECT_NEAR(r, radius - side * depth, 1e-12);
        EXPECT_NEAR(norm(particles.vector("wall_normal")[i] - (side / r) * particles.position[i]), 0.0, 1e-12);
        EXPECT_DOUBLE_EQ(particles.scalar("wall_curvature")[i], side / radius);
        // Its parent is the particle of the outermost layer that is nearest, and its own parent.
        const Index parent = particles.surface_parent[static_cast<std::size_t>(i)];
        EXPECT_EQ(particles.surface_parent[static_cast<std::size_t>(parent)], parent);
        EXPECT_NEAR(particles.scalar("wall_depth")[parent], 0.05, 1e-12);
        const Vector a = (1.0 / r) * particles.position[i];
        const Vector b = (1.0 / norm(particles.position[parent])) * particles.position[parent];
        EXPECT_LT(norm(a - b) * norm(particles.position[parent]), 0.051);
    }
    EXPECT_NEAR(of_cylinder, 2.0 * std::numbers::pi * (1.95 + 1.85 + 1.75) / 0.1, 2.0);
    EXPECT_NEAR(of_vessel, 2.0 * std::numbers::pi * (4.05 + 4.15 + 4.25) / 0.1, 2.0);
}

TEST(Placement, DropOnARoundWallHoldsItsArea)
{
    // Both circles meet where cos β = 1 − R²/(2 R_w²): the drop is its disc less the lens that they share.
    const double wall = 2.0, radius = 1.0, at_wall = std::acos(1.0 - 0.5 * radius * radius / (wall * wall));
    const double at_drop = std::acos(0.5 * radius / wall);
    const double lens = wall * wall * (at_wall - std::sin(at_wall) * std::cos(at_wall)) +
                        radius * radius * (at_drop - std::sin(at_drop) * std::cos(at_drop));
    for (const bool two_phase : {false, true}) {
        const Scene scene = place_particles(drop_on_a_cylinder(two_phase));
        const Particles& particles = *scene.particles;
        double area = 0.0;
        for (Index i = 0; i < particles.count(); ++i) {
            const auto k = static_cast<std::size_t>(i);
            if (particles.kind[k] == Kind::fluid && particles.material[k] == 0) area += particles.volume[i];
        }
        EXPECT_NEAR(area, std::numbers::pi * radius * radius - lens, two_phase ? 6e-3 : 1e-12);
    }
}

TEST(Placement, VolumesBetweenRoundWallsAreEqual)
{
    // What differs would be set free as elastic energy: as they stand on their rings volumes differ by 2 %.
    const Scene scene = place_particles(drop_on_a_cylinder(true));
    const Particles& particles = *scene.particles;
    const RootFree kernel(0.1, 2);
    double mean = 0.0, square = 0.0;
    int count = 0;
    for (Index i = 0; i < particles.count(); ++i) {
        if (particles.kind[static_cast<std::size_t>(i)] != Kind::fluid) continue;
        double sum = 0.0;
        for (Index j = 0; j < particles.count(); ++j) {
            const double r = norm(particles.position[i] - particles.position[j]);
            if (r < kernel.support()) sum += kernel(std::max(r, 1e-9)).value;
        }
        const double volume = 1.0 / sum / scene.particle_volume;
        mean += volume;
        square += volume * volume;
        ++count;
    }
    mean /= count;
    EXPECT_NEAR(mean, 1.0, 1e-3);
    EXPECT_LT(std::sqrt(square / count - mean * mean), 3e-3);
}

TEST(Placement, CylinderTooThinForItsLayersIsRefused)
{
    Case definition = drop_on_a_cylinder(false);
    definition.domain.round_walls->inner_radius = 0.35;
    EXPECT_THROW(place_particles(definition), CaseError);
}

TEST(Placement, WaveHasItsAmplitudeAtTheSurfaceAndNoneAtTheBottom)
{
    Case definition = small_scenes::pool(2, 0.05);
    definition.numerics.shifting = 0.0; // or particles would start off their lattice
    definition.domain.upper = {1, 0, 0.8};
    definition.domain.boundaries[std::size_t(Side::z_max)]->kind = BoundaryKind::open;
    Body layer;
    layer.material = "liquid";
    layer.upper = {1, 0, 0.5};
    definition.bodies = {layer};
    const Scene flat = place_particles(definition);
    definition.bodies[0].surface_wave = SurfaceWave{0.01, 1.0};
    const Scene wavy = place_particles(definition);
    ASSERT_EQ(flat.particles->count(), wavy.particles->count());
    const double k = 2 * std::numbers::pi;
    for (Index i = 0; i < flat.particles->count(); ++i) {
        const Vector before = flat.particles->position[i], after = wavy.particles->position[i];
        if (flat.particles->kind[std::size_t(i)] == Kind::wall)
            EXPECT_EQ(norm(after - before), 0);
        else
            EXPECT_NEAR(after.z - before.z, 0.01 * std::cos(k * before.x) * std::sinh(k * before.z) / std::sinh(k / 2),
                        1e-12);
    }
}

TEST(Placement, JitterIsBoundedAndTheSameEachTime)
{
    Case definition = drop(2, 20, std::nullopt);
    const Scene regular = place_particles(definition);
    definition.numerics.position_jitter = 0.2;
    const Scene one = place_particles(definition), other = place_particles(definition);
    double square = 0;
    for (Index i = 0; i < one.particles->count(); ++i) {
        const Vector moved = one.particles->position[i] - regular.particles->position[i];
        EXPECT_LE(std::abs(moved.x), 0.2 * definition.spacing * (1 + 1e-12));
        EXPECT_LE(std::abs(moved.z), 0.2 * definition.spacing * (1 + 1e-12));
        EXPECT_EQ(moved.y, 0);
        EXPECT_EQ(norm(one.particles->position[i] - other.particles->position[i]), 0);
        square += dot(moved, moved) / one.particles->count();
    }
    EXPECT_NEAR(std::sqrt(square) / definition.spacing, 0.2 * std::sqrt(2.0 / 3.0), 0.02); // uniform in a square
}

TEST(Placement, FluidStartsWithTheFieldsVelocity)
{
    Case definition = drop(2, 20, std::nullopt);
    definition.initial.velocity = TaylorGreen{3.0, 2.0};
    const Scene scene = place_particles(definition);
    for (Index i = 0; i < scene.particles->count(); ++i) {
        const Vector p = scene.particles->position[i], v = scene.particles->velocity[i];
        EXPECT_DOUBLE_EQ(v.x, 3 * std::sin(std::numbers::pi * p.x) * std::cos(std::numbers::pi * p.z));
        EXPECT_DOUBLE_EQ(v.z, -3 * std::cos(std::numbers::pi * p.x) * std::sin(std::numbers::pi * p.z));
    }
}

} // namespace
} // namespace cupel
