#include "kernels/images.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include <gtest/gtest.h>

#include "kernels/pair_loop.hpp"
#include "small_scenes.hpp"

/// Compiled once in double and once in float pair arithmetic (CMakeLists.txt).
namespace cupel
{
namespace
{

using small_scenes::jittered_lattice;

constexpr double support = 3.0, skin = 0.3;
constexpr int n = 9;
const double round_off = sizeof(Real) == 8 ? 1e-11 : 2e-5;

/// Σ V_j W_ij, Σ V_j ∇W_ij and Σ V_j u_j W_ij: every pair, its direction, and a vector that a mirror turns.
struct Probe
{
    const ScalarField& volume;
    const VectorField& velocity;
    ScalarField& filling;
    VectorField& gradient;
    VectorField& mean_velocity;

    struct Near
    {};
    struct Far
    {
        Real volume;
        VectorOf<Real> velocity;
    };
    struct Sum
    {
        Lanes filling{};
        VectorLanes gradient{}, velocity{};
    };

    bool idle(const Cluster&) const { return false; }
    Near near(Index) const { return {}; }
    Far far(Index j) const { return {real(volume[j]), real(velocity[j])}; }
    void add(const Near&, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.filling += j.volume * pair.kernel;
        sum.gradient += (j.volume * pair.gradient_over_r) * pair.offset;
        sum.velocity += (j.volume * pair.kernel) * broadcast(j.velocity);
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        store_lanes(filling, cluster.first, cluster.lanes(), sum.filling);
        store_lanes(gradient, cluster.first, cluster.lanes(), sum.gradient);
        store_lanes(mean_velocity, cluster.first, cluster.lanes(), sum.velocity);
    }
};

struct Sums
{
    double filling = 0.0;
    Vector gradient{}, velocity{};
};

/// The sums by identity.
std::vector<Sums> probe(Particles& particles, NeighbourList& list, int dimensions, bool build = true)
{
    if (build) list.build(particles);
    std::vector<Index> all(static_cast<std::size_t>(list.cluster_count()));
    std::iota(all.begin(), all.end(), Index{0});
    ScalarField& filling = particles.add_scalar({"filling", "1"});
    VectorField& gradient = particles.add_vector({"filling_gradient", "1/m"});
    VectorField& velocity = particles.add_vector({"mean_velocity", "m/s"});
    for_each_pair(list, particles, RootFree(1.0, dimensions), all,
                  Probe{particles.volume, particles.velocity, filling, gradient, velocity});
    std::vector<Sums> sums(static_cast<std::size_t>(particles.count()));
    for (Index i = 0; i < particles.count(); ++i)
        sums[static_cast<std::size_t>(particles.identity[static_cast<std::size_t>(i)])] = {filling[i], gradient[i],
                                                                                           velocity[i]};
    return sums;
}

double difference(const Sums& a, const Sums& b)
{
    return std::abs(a.filling - b.filling) + norm(a.gradient - b.gradient) + norm(a.velocity - b.velocity);
}
double difference(const std::vector<Sums>& a, const std::vector<Sums>& b)
{
    double greatest = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k)
        greatest = std::max(greatest, difference(a[k], b[k]));
    return greatest;
}

Domain box(int dimensions, const std::array<BoundaryKind, 6>& sides, double length = n)
{
    Domain domain;
    domain.upper = {length, dimensions == 2 ? 0.0 : length, length};
    std::size_t side = 0;
    for (const BoundaryKind kind : sides) {
        if (dimensions == 3 || (side != 2 && side != 3)) {
            domain.boundaries[side] = Boundary{};
            domain.boundaries[side]->kind = kind;
        }
        ++side;
    }
    return domain;
}
constexpr auto P = BoundaryKind::periodic, S = BoundaryKind::symmetry, O = BoundaryKind::open;

Particles moving_lattice(int dimensions, int length = n)
{
    Particles particles = jittered_lattice(length, dimensions, 0.3);
    for (Index i = 0; i < particles.count(); ++i) {
        const Vector p = particles.position[i];
        particles.velocity.set(i, {std::sin(p.z), dimensions == 2 ? 0.0 : std::cos(2.0 * p.x), p.x * 0.3});
    }
    return particles;
}

class ImageSides : public testing::TestWithParam<std::tuple<int, std::array<BoundaryKind, 6>>>
{
protected:
    int dimensions() const { return std::get<0>(GetParam()); }
    Domain domain(double length = n) const { return box(dimensions(), std::get<1>(GetParam()), length); }
    NeighbourList list(double length = n) const
    {
        return {support, skin, 1.0, dimensions(), Images(domain(length), dimensions(), 1.0, support + skin, skin)};
    }
};

INSTANTIATE_TEST_SUITE_P(All, ImageSides,
                         testing::Combine(testing::Values(2, 3),
                                          testing::Values(std::array{P, P, P, P, P, P}, std::array{P, P, O, O, O, O},
                                                          std::array{S, S, S, S, S, S}, std::array{S, O, P, P, O, S},
                                                          std::array{P, P, S, O, S, S})));

TEST_P(ImageSides, SumsEqualThoseOfAllPairsWithTheirImages)
{
    Particles particles = moving_lattice(dimensions());
    NeighbourList neighbours = list();
    const auto sums = probe(particles, neighbours, dimensions());
    const Images& images = neighbours.images();
    ASSERT_TRUE(images.any());
    const RootFree kernel(1.0, dimensions());
    for (Index i = 0; i < particles.count(); ++i) {
        Sums exact;
        const auto meet = [&](const Vector& place, const Vector& velocity) {
            const Vector offset = particles.position[i] - place;
            const auto w = kernel(norm(offset) + 1e-12);
            exact.filling += w.value;
            exact.gradient += w.gradient_over_r * offset;
            exact.velocity += w.value * velocity;
        };
        for (Index j = 0; j < particles.count(); ++j) {
            const Vector u = particles.velocity[j];
            meet(particles.position[j], u);
            for (std::size_t k = 0; k < images.count(); ++k) {
                const Vector sign = images[k].sign;
                meet(images[k].place(particles.position[j]), {sign.x * u.x, sign.y * u.y, sign.z * u.z});
            }
        }
        EXPECT_LT(difference(sums[static_cast<std::size_t>(particles.identity[static_cast<std::size_t>(i)])], exact),
                  4.0 * round_off);
    }
}

TEST_P(ImageSides, ALatticeIsFullUpToItsPeriodicAndMirrorSides)
{
    Particles particles = jittered_lattice(n, dimensions(), 0.0);
    NeighbourList neighbours = list();
    const auto sums = probe(particles, neighbours, dimensions());
    bool closed = true;
    for (const auto& boundary : domain().boundaries)
        closed = closed && (!boundary || boundary->kind != BoundaryKind::open);
    if (!closed) return;
    for (const Sums& s : sums)
        EXPECT_LT(difference(s, sums.front()), round_off);
}

TEST_P(ImageSides, RefreshSeesWhatComesNearAsAnImage)
{
    // Long enough for a corner to be less than the two fifths of all clusters that a refresh takes.
    const int length = dimensions() == 2 ? 40 : 18;
    Particles particles = moving_lattice(dimensions(), length);
    NeighbourList neighbours = list(length);
    neighbours.build(particles);
    // What is in a corner moves along a side, further than the skin, and stays within the domain.
    std::vector<Index> moved;
    for (Index i = 0; i < particles.count(); ++i) {
        const Vector p = particles.position[i];
        if (p.x < 1.0 && p.z < 1.0 && p.y < 1.0) {
            particles.position.set(i, p + Vector{0.0, 0.0, 1.1});
            if (std::find(moved.begin(), moved.end(), neighbours.cluster_of(i)) == moved.end())
                moved.push_back(neighbours.cluster_of(i));
        }
    }
    ASSERT_TRUE(neighbours.refresh(particles, moved));
    const auto refreshed = probe(particles, neighbours, dimensions(), false);
    NeighbourList anew = list(length);
    EXPECT_LT(difference(refreshed, probe(particles, anew, dimensions())), round_off);
}

TEST(PeriodicSides, NothingChangesWhereAllIsMoved)
{
    for (const int dimensions : {2, 3}) {
        const Images images(box(dimensions, {P, P, P, P, P, P}), dimensions, 1.0, support + skin, skin);
        Particles particles = moving_lattice(dimensions);
        NeighbourList before(support, skin, 1.0, dimensions, images);
        const auto sums = probe(particles, before, dimensions);
        for (Index i = 0; i < particles.count(); ++i)
            particles.position.set(i,
                                   particles.position[i] + Vector{4.7, dimensions == 2 ? 0.0 : -13.3, 2.0 * n + 0.4});
        NeighbourList after(support, skin, 1.0, dimensions, images);
        EXPECT_LT(difference(probe(particles, after, dimensions), sums), 4.0 * round_off);
        for (Index i = 0; i < particles.count(); ++i) {
            const Vector p = particles.position[i];
            EXPECT_TRUE(p.x >= 0 && p.x < n && p.z >= 0 && p.z < n);
        }
    }
}

TEST(PeriodicSides, AShortOrUnevenDomainIsRefusedInOneLine)
{
    Domain domain = box(2, {P, P, P, P, O, O});
    const auto refusal = [&]() -> std::string {
        try {
            Images(domain, 2, 1.0, support + skin, skin);
        }
        catch (const CaseError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(refusal(), "");
    domain.upper[0] = 3.0;
    EXPECT_NE(refusal().find("domain.boundaries.x_min"), std::string::npos);
    EXPECT_NE(refusal().find("longer"), std::string::npos);
    domain.upper[0] = 9.5;
    EXPECT_NE(refusal().find("whole multiple"), std::string::npos);
    EXPECT_EQ(refusal().find('\n'), std::string::npos);
}

} // namespace
} // namespace cupel
