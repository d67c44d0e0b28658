/// What happens does not depend on where north is, on which hand draws it, on how fast the laboratory moves, or on the
/// order in which particles stand in memory.
#include "integrators/simulation.hpp"

#include <algorithm>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "scene/free_drop.hpp"
#include "symmetry_scenes.hpp"

namespace cupel
{
namespace
{

using namespace properties;

/// Turns and mirrors: axis a becomes sign[a] times axis to[a].
struct Turn
{
    const char* name;
    std::array<std::size_t, 3> to;
    std::array<double, 3> sign;

    Vector3 operator()(const Vector3& v) const
    {
        Vector3 turned{};
        for (std::size_t a = 0; a < 3; ++a)
            turned[to[a]] = sign[a] * v[a];
        return turned;
    }
    Vector operator()(const Vector& v) const
    {
        const Vector3 turned = (*this)(Vector3{v.x, v.y, v.z});
        return {turned[0], turned[1], turned[2]};
    }
    Vector3 back(const Vector3& v) const
    {
        Vector3 turned{};
        for (std::size_t a = 0; a < 3; ++a)
            turned[a] = sign[a] * v[to[a]];
        return turned;
    }
    void box(Vector3& lower, Vector3& upper) const
    {
        const Vector3 one = (*this)(lower), other = (*this)(upper);
        for (std::size_t a = 0; a < 3; ++a) {
            lower[a] = std::min(one[a], other[a]);
            upper[a] = std::max(one[a], other[a]);
        }
    }
    Case operator()(Case definition) const
    {
        const Vector3 corner = definition.domain.lower;
        const auto sides = definition.domain.boundaries;
        box(definition.domain.lower, definition.domain.upper);
        for (std::size_t a = 0; a < 3; ++a)
            for (const std::size_t end : {0U, 1U})
                definition.domain.boundaries[2 * to[a] + (sign[a] > 0 ? end : 1 - end)] = sides[2 * a + end];
        definition.gravity = (*this)(definition.gravity);
        for (Body& body : definition.bodies) {
            box(body.lower, body.upper);
            body.center = (*this)(body.center);
            body.perturbation.reset(); // particles are put where those of the other scene are
        }
        // The field is told from the domain's lower corner, which is another one now.
        const Vector3 new_corner = back(definition.domain.lower);
        for (std::size_t a = 0; a < 3; ++a)
            definition.initial.temperature += definition.initial.temperature_gradient[a] * (new_corner[a] - corner[a]);
        definition.initial.temperature_gradient = (*this)(definition.initial.temperature_gradient);
        if (definition.laser)
            for (auto* end : {&definition.laser->from, &definition.laser->to}) {
                const Vector3 turned = (*this)(Vector3{(*end)[0], (*end)[1], 0});
                *end = {turned[0], turned[1]};
            }
        return definition;
    }
};

void advance(Simulation& simulation, int steps)
{
    simulation.start();
    for (int step = 0; step < steps; ++step)
        simulation.step(1.0);
}

/// Particles of the turned scene, by identity in the first: those whose lattice cell is the turned one. A drop in
/// nothing stands on rings or shells, not on the lattice; its particles are all alike, and the next will do.
std::vector<Index> partners(const Scene& scene, const Scene& turned, const Turn& turn)
{
    const auto cell = [](const Vector& p, double spacing) {
        return std::array<long, 3>{std::lround(2 * p.x / spacing), std::lround(2 * p.y / spacing),
                                   std::lround(2 * p.z / spacing)};
    };
    std::map<std::array<long, 3>, Index> found;
    for (Index i = 0; i < turned.particles->count(); ++i)
        found[cell(turned.particles->position[i], turned.spacing)] = i;
    std::vector<Index> result;
    Index next = 0;
    for (Index i = 0; i < scene.particles->count(); ++i) {
        const Body& body = scene.definition.bodies.front();
        const bool whole_ball = scene.definition.bodies.size() == 1 && body.shape == BodyShape::sphere &&
                                whole_in_domain(body, scene.definition.domain);
        const bool on_rings = !scene.two_phase && (scene.dimensions == 2 || whole_ball) &&
                              scene.particles->kind[std::size_t(i)] == Kind::fluid;
        result.push_back(on_rings ? next++ : found.at(cell(turn(scene.particles->position[i]), scene.spacing)));
    }
    return result;
}

/// How far the two runs are apart: positions in spacings, velocities and temperatures over the greatest.
struct Apart
{
    double position = 0, velocity = 0, temperature = 0;
    double speed = 0, moved = 0; ///< of the first run: greatest speed, and number of particles that move
};

template <class Turned>
Apart compare(const Simulation& one, const Simulation& other, const std::vector<Index>& partner, const Turned& turned)
{
    const Particles& a = one.particles();
    const Particles& b = other.particles();
    Apart apart;
    double hottest = 0, velocity = 0;
    for (Index identity = 0; identity < a.count(); ++identity) {
        const Index i = a.place_of(identity), j = b.place_of(partner[static_cast<std::size_t>(identity)]);
        if (a.kind[static_cast<std::size_t>(i)] == Kind::wall) continue;
        const auto [position, speed] = turned(a.position[i], a.velocity[i]);
        apart.position = std::max(apart.position, norm(position - b.position[j]) / one.scene().spacing);
        velocity = std::max(velocity, norm(speed - b.velocity[j]));
        if (a.kind[static_cast<std::size_t>(i)] == Kind::fluid) {
            apart.speed = std::max(apart.speed, norm(a.velocity[i]));
            apart.moved += 1;
        }
        if (!a.has("temperature")) continue;
        hottest = std::max(hottest, a.scalar("temperature")[i]);
        apart.temperature =
            std::max(apart.temperature, std::abs(a.scalar("temperature")[i] - b.scalar("temperature")[j]));
    }
    apart.velocity = velocity / apart.speed;
    if (hottest > 0) apart.temperature /= hottest;
    return apart;
}

/// Sums over neighbours in another order differ in their last digit, and a flow lets that grow: 2e-12 after the steps
/// that are taken here, each of up to four of sound, is the most that was seen. Melt that tears lets it grow beyond all
/// bounds, with one step of sound or four.
constexpr double grown_round_off = 1e-10;

void expect_together(const Apart& apart, const std::string& what)
{
    EXPECT_GT(apart.moved, 20) << what;
    EXPECT_GT(apart.speed, 0) << what;
    EXPECT_LT(apart.position, grown_round_off) << what;
    EXPECT_LT(apart.velocity, grown_round_off) << what;
    EXPECT_LT(apart.temperature, grown_round_off) << what;
}

void expect_indifferent_to(const Turn& turn, const Case& definition, int steps)
{
    Scene first = place_particles(definition), second = place_particles(turn(definition));
    Case undisturbed = definition;
    for (Body& body : undisturbed.bodies)
        body.perturbation.reset();
    const std::vector<Index> partner = partners(place_particles(undisturbed), second, turn);
    for (Index i = 0; i < first.particles->count(); ++i)
        second.particles->position.set(partner[static_cast<std::size_t>(i)], turn(first.particles->position[i]));
    Simulation one(std::move(first)), other(std::move(second));
    advance(one, steps);
    advance(other, steps);
    expect_together(compare(one, other, partner,
                            [&](const Vector& p, const Vector& v) {
                                return std::pair{turn(p), turn(v)};
                            }),
                    turn.name);
}

constexpr Turn about_y{"turned about y", {2, 1, 0}, {1, 1, -1}}; // x to z, z to −x
constexpr Turn about_z{"turned about z", {1, 0, 2}, {1, -1, 1}}; // x to y, y to −x
constexpr Turn about_x{"turned about x", {0, 2, 1}, {1, 1, -1}}; // y to z, z to −y
constexpr Turn mirror_x{"mirrored in x", {0, 1, 2}, {-1, 1, 1}};
constexpr Turn mirror_y{"mirrored in y", {0, 1, 2}, {1, -1, 1}};

TEST(Symmetry, DropsInTwoDimensionsDoNotKnowWhereNorthIs)
{
    for (const bool two_phase : {false, true})
        for (const Turn& turn : {about_y, mirror_x}) {
            SCOPED_TRACE(two_phase ? "two phases" : "free surface");
            expect_indifferent_to(turn, oscillating_drop(two_phase, BoundaryKind::wall), 100);
        }
}

TEST(Symmetry, ADropOnAWallDoesNotKnowWhereNorthIs)
{
    for (const Turn& turn : {about_z, mirror_x, mirror_y})
        expect_indifferent_to(turn, drop_on_a_wall(), 80);
}

TEST(Symmetry, ADropOfMeltDoesNotKnowWhereNorthIs)
{
    for (const Turn& turn : {about_x, about_y, about_z, mirror_x})
        expect_indifferent_to(turn, drop_of_melt(), 50);
}

TEST(Symmetry, AMeltPoolDoesNotKnowWhereNorthIs)
{
    for (const Turn& turn : {about_z, mirror_x, mirror_y})
        expect_indifferent_to(turn, melt_pool(), 75);
}

/// Everything moves with a velocity of the size of the flow's own, and over several spacings.
void expect_indifferent_to_motion(const Case& definition, double speed, int steps)
{
    const Vector motion = speed * Vector{0.8, definition.dimensions == 3 ? 0.48 : 0.0, -0.6};
    Simulation resting(place_particles(definition)), moving(place_particles(definition));
    Particles& particles = moving.particles();
    for (Index i = 0; i < particles.count(); ++i)
        particles.velocity.set(i, particles.velocity[i] + motion);
    advance(resting, steps);
    advance(moving, steps);
    // Accelerations, which may bound a step, are the same to round-off.
    EXPECT_NEAR(resting.time(), moving.time(), 1e-13 * resting.time());
    EXPECT_GT(norm(motion) * resting.time(), definition.spacing);
    std::vector<Index> same(static_cast<std::size_t>(particles.count()));
    std::iota(same.begin(), same.end(), Index{0});
    const double length = definition.domain.upper[0] - definition.domain.lower[0];
    const bool periodic = definition.domain.boundaries[0]->kind == BoundaryKind::periodic;
    const auto within = [&](double x, double lower) {
        return periodic ? x - length * std::floor((x - lower) / length) : x;
    };
    // Places beyond a periodic side count as those within, in both runs alike.
    const auto bring_inside = [&](Particles& all) {
        for (Index i = 0; i < all.count(); ++i) {
            const Vector p = all.position[i];
            all.position.set(i,
                             {within(p.x, definition.domain.lower[0]), p.y, within(p.z, definition.domain.lower[2])});
        }
    };
    const Vector carried = resting.time() * motion;
    for (Index i = 0; i < resting.particles().count(); ++i)
        resting.particles().position.set(i, resting.particles().position[i] + carried);
    bring_inside(resting.particles());
    bring_inside(particles);
    expect_together(compare(resting, moving, same,
                            [&](const Vector& p, const Vector& v) {
                                return std::pair{p, v + motion};
                            }),
                    "in motion");
}

TEST(Symmetry, AMovingDropOscillatesAsOneAtRest)
{
    expect_indifferent_to_motion(oscillating_drop(false, BoundaryKind::open), 2.0, 100);
    expect_indifferent_to_motion(oscillating_drop(true, BoundaryKind::periodic), 5.0, 100);
}

TEST(Symmetry, AMovingDropOfMeltIsAsOneAtRest)
{
    expect_indifferent_to_motion(drop_of_melt(), 5.0, 50);
}

/// The same scene with its particles in another order in memory.
void expect_indifferent_to_order(const Case& definition, int steps)
{
    Scene shuffled = place_particles(definition);
    std::vector<Index> order(static_cast<std::size_t>(shuffled.particles->count()));
    std::iota(order.begin(), order.end(), Index{0});
    std::shuffle(order.begin(), order.end(), std::mt19937{7});
    shuffled.particles->permute(order);
    Simulation one(place_particles(definition)), other(std::move(shuffled));
    advance(one, steps);
    advance(other, steps);
    // Particles are put into an order that places alone give: not a digit differs.
    EXPECT_EQ(one.particles().identity, other.particles().identity);
    EXPECT_EQ(one.particles().position.x, other.particles().position.x);
    EXPECT_EQ(one.particles().position.z, other.particles().position.z);
    EXPECT_EQ(one.particles().velocity.x, other.particles().velocity.x);
    if (one.particles().has("temperature")) {
        EXPECT_EQ(one.particles().scalar("temperature").values, other.particles().scalar("temperature").values);
    }
}

TEST(Symmetry, TheOrderOfParticlesDoesNotMatter)
{
    expect_indifferent_to_order(oscillating_drop(false, BoundaryKind::wall), 100);
    expect_indifferent_to_order(oscillating_drop(true, BoundaryKind::wall), 100);
    expect_indifferent_to_order(drop_on_a_wall(), 80);
    expect_indifferent_to_order(melt_pool(), 75);
}

} // namespace
} // namespace cupel
