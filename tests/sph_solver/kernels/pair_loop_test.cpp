#include "kernels/pair_loop.hpp"

#include <omp.h>

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "small_scenes.hpp"

namespace cupel
{
namespace
{

using small_scenes::jittered_lattice;

constexpr double support = 3.0;

/// Σ V_j W_ij and Σ V_j ∇W_ij: enough to see every pair and its direction.
struct Probe
{
    const ScalarField& volume;
    ScalarField& filling;
    VectorField& gradient;

    struct Near
    {};
    struct Sum
    {
        Lanes filling{};
        VectorLanes gradient{};
    };

    bool idle(const Cluster&) const { return false; }
    Near near(Index) const { return {}; }
    void add(const Near&, Index j, const Pair& pair, Sum& sum) const
    {
        sum.filling += volume[j] * pair.kernel;
        sum.gradient += (volume[j] * pair.gradient_over_r) * pair.offset;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        store_lanes(filling, cluster.first, cluster.lanes(), sum.filling);
        store_lanes(gradient, cluster.first, cluster.lanes(), sum.gradient);
    }
};

/// The same, which asks for nothing but what lies above a height.
struct LocalProbe : Probe
{
    const VectorField& position;
    double height;

    static constexpr bool local = true;

    bool idle(const Cluster& cluster) const
    {
        return none_in(cluster, [&](Index i) { return position[i].z > height; });
    }
};

struct Probed
{
    Particles particles;
    std::vector<double> filling_by_identity;
};

Probed probe(Particles particles, double skin, int dimensions, const char* kernel_name = "root_free")
{
    NeighbourList list(support, skin, 1.0, dimensions);
    list.build(particles);
    std::vector<Index> all(static_cast<std::size_t>(list.cluster_count()));
    for (std::size_t c = 0; c < all.size(); ++c)
        all[c] = static_cast<Index>(c);
    const SmoothingKernel kernel(kernel_name, 1.0, dimensions);
    for_each_pair(list, particles, kernel, all,
                  Probe{particles.volume, particles.add_scalar({"filling", "1"}),
                        particles.add_vector({"filling_gradient", "1/m"})});
    Probed result{std::move(particles), {}};
    result.filling_by_identity.resize(static_cast<std::size_t>(result.particles.count()));
    for (Index i = 0; i < result.particles.count(); ++i)
        result.filling_by_identity[static_cast<std::size_t>(result.particles.identity[static_cast<std::size_t>(i)])] =
            result.particles.scalar("filling")[i];
    return result;
}

TEST(PairLoop, LeavesATermOutWhereItIsIdleAndLocal)
{
    Particles particles = jittered_lattice(14, 2, 0.2);
    NeighbourList list(support, 0.1, 1.0, 2);
    list.build(particles);
    std::vector<Index> clusters(static_cast<std::size_t>(list.cluster_count()));
    std::iota(clusters.begin(), clusters.end(), Index{0});
    const auto probe_into = [&](const char* name) -> Probe {
        return {particles.volume, particles.add_scalar({name, "1"}, -1.0),
                particles.add_vector({std::string(name) + "_gradient", "1/m"})};
    };
    const Probe everywhere = probe_into("everywhere");
    const LocalProbe above{probe_into("above"), particles.position, 9.0};
    for_each_pair(list, particles, SmoothingKernel("root_free", 1.0, 2), clusters, above, everywhere);
    int left_out = 0;
    for (const Index c : clusters) {
        const Cluster cluster = list.cluster(c);
        const bool idle = above.idle(cluster);
        left_out += idle;
        for (Index i = cluster.first; i < cluster.first + cluster.count; ++i)
            EXPECT_EQ(above.filling[i], idle ? -1.0 : everywhere.filling[i]);
    }
    EXPECT_GT(left_out, 3);
    EXPECT_LT(left_out, list.cluster_count() - 3);
}

class EveryDimension : public testing::TestWithParam<int>
{};

TEST_P(EveryDimension, EqualsTheSumOverAllPairs)
{
    const int dimensions = GetParam();
    for (const char* name : {"root_free", "quintic_spline"}) {
        const Probed probed = probe(jittered_lattice(9, dimensions, 0.4), 0.3, dimensions, name);
        const Particles& particles = probed.particles;
        const SmoothingKernel kernel(name, 1.0, dimensions);
        for (Index i = 0; i < particles.count(); ++i) {
            double filling = 0.0;
            Vector gradient{};
            for (Index j = 0; j < particles.count(); ++j) {
                const Vector offset = particles.position[i] - particles.position[j];
                const double r = std::sqrt(dot(offset, offset)) + 1e-12;
                filling += kernel(r).value;
                gradient += kernel(r).gradient_over_r * offset;
            }
            EXPECT_NEAR(particles.scalar("filling")[i], filling, 1e-11) << name;
            EXPECT_NEAR(norm(particles.vector("filling_gradient")[i] - gradient), 0.0, 1e-10) << name;
        }
    }
}

TEST_P(EveryDimension, KernelOnALatticeSumsToOne)
{
    const int dimensions = GetParam();
    const Probed probed = probe(jittered_lattice(9, dimensions, 0.0), 0.3, dimensions);
    const Index middle = probed.particles.place_of(probed.particles.count() / 2);
    // With h = Δx: 1 within 0.1 % (sum over the lattice, no free parameter).
    EXPECT_NEAR(probed.particles.scalar("filling")[middle], 1.0, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, EveryDimension, testing::Values(2, 3));

TEST(PairLoop, NumberOfThreadsDoesNotChangeABit)
{
    omp_set_num_threads(1);
    const Probed one = probe(jittered_lattice(14, 3, 0.4), 0.3, 3);
    omp_set_num_threads(3);
    const Probed three = probe(jittered_lattice(14, 3, 0.4), 0.3, 3);
    EXPECT_EQ(one.filling_by_identity, three.filling_by_identity);
}

TEST(NeighbourList, StaysCompleteUntilAParticleHasMovedHalfTheSkin)
{
    const double skin = 0.4;
    Particles particles = jittered_lattice(8, 3, 0.3);
    NeighbourList list(support, skin, 1.0, 3);
    list.build(particles);
    std::vector<Index> moving(static_cast<std::size_t>(particles.count()));
    for (std::size_t k = 0; k < moving.size(); ++k)
        moving[k] = static_cast<Index>(k);
    // Every second particle goes one way and the others the other way: the worst that the rule allows.
    for (Index i = 0; i < particles.count(); ++i)
        particles.position.x[static_cast<std::size_t>(i)] += (i % 2 ? 0.499 : -0.499) * skin;
    EXPECT_FALSE(list.outdated(particles, moving));
    for (Index c = 0; c < list.cluster_count(); ++c) {
        std::vector<Index> near;
        list.for_each_neighbour(c, [&](Index j) { near.push_back(j); });
        for (Index i = list.cluster(c).first; i < list.cluster(c).first + list.cluster(c).count; ++i)
            for (Index j = 0; j < particles.count(); ++j) {
                const bool listed = std::find(near.begin(), near.end(), j) != near.end();
                EXPECT_TRUE(listed || norm(particles.position[i] - particles.position[j]) >= support);
            }
    }
    particles.position.x[0] += 0.01 * skin * (0 % 2 ? 1.0 : -1.0);
    EXPECT_TRUE(list.outdated(particles, moving));
}

/// Every pair within support and skin is listed, from either side, and nothing twice.
void expect_complete(const NeighbourList& list, const Particles& particles, double skin)
{
    std::size_t missing = 0, twice = 0;
    for (Index c = 0; c < list.cluster_count(); ++c) {
        std::vector<int> listed(static_cast<std::size_t>(particles.count()), 0);
        list.for_each_neighbour(c, [&](Index j) { twice += ++listed[static_cast<std::size_t>(j)] > 1 ? 1 : 0; });
        for (Index i = list.cluster(c).first; i < list.cluster(c).first + list.cluster(c).count; ++i)
            for (Index j = 0; j < particles.count(); ++j)
                missing += !listed[static_cast<std::size_t>(j)] &&
                                   norm(particles.position[i] - particles.position[j]) < support + skin
                               ? 1
                               : 0;
    }
    EXPECT_EQ(missing, 0U);
    EXPECT_EQ(twice, 0U);
}

/// Moves the particles around `middle` step by step and returns how many of the steps a refresh was enough for.
int refreshes_along(const Vector& middle, std::initializer_list<Vector> steps)
{
    const double skin = 0.4;
    Particles particles = jittered_lattice(16, 3, 0.3);
    NeighbourList list(support, skin, 1.0, 3);
    list.build(particles);
    std::vector<Index> flying, moved;
    for (Index i = 0; i < particles.count(); ++i)
        if (norm(particles.position[i] - middle) < 1.5) flying.push_back(i);
    for (const Index i : flying)
        if (std::find(moved.begin(), moved.end(), list.cluster_of(i)) == moved.end())
            moved.push_back(list.cluster_of(i));
    int refreshed = 0;
    for (const Vector& step : steps) {
        for (const Index i : flying)
            particles.position.set(i, particles.position[i] + step);
        EXPECT_TRUE(list.outdated(particles, flying));
        if (!list.refresh(particles, moved)) continue;
        ++refreshed;
        EXPECT_FALSE(list.outdated(particles, flying));
        expect_complete(list, particles, skin);
    }
    EXPECT_EQ(list.builds(), 1U);
    return refreshed;
}

TEST(NeighbourList, IsCompleteInColumnsOfAnyHeight)
{
    // Clusters are looked at sixteen at a time: less than that in a column, and so many that they are first searched.
    for (const double height : {20.0, 700.0}) {
        Particles particles = jittered_lattice(14, 3, 0.3);
        for (Index i = 0; i < particles.count(); ++i)
            particles.position.set(i, {particles.position[i].x * 4.0 / 14.0, particles.position[i].y * 4.0 / 14.0,
                                       particles.position[i].z * height / 14.0});
        NeighbourList list(support, 0.3, 1.0, 3);
        list.build(particles);
        expect_complete(list, particles, 0.3);
    }
}

TEST(NeighbourList, RefreshFindsWhatComesNear)
{
    EXPECT_EQ(refreshes_along({8, 8, 8}, {{0.5, 0.3, 0.1}, {0.8, -0.5, 0}, {-0.5, -1, 0.5}, {0, 0, -2}}), 4);
}

TEST(NeighbourList, RefreshFollowsWhatLeavesTheBlockAndItsColumns)
{
    EXPECT_GE(refreshes_along({15, 15, 15}, {{0.5, 0, 0}, {0, 0.5, 2}, {4, 0, 2}, {-30, 0, 0}}), 3);
}

TEST(NeighbourList, RefreshLeavesToABuildWhatMovesAsAWhole)
{
    Particles particles = jittered_lattice(8, 3, 0.3);
    NeighbourList list(support, 0.4, 1.0, 3);
    list.build(particles);
    std::vector<Index> all(static_cast<std::size_t>(list.cluster_count()));
    std::iota(all.begin(), all.end(), Index{0});
    EXPECT_FALSE(list.refresh(particles, all));
}

TEST(NeighbourList, OrderDependsOnPositionsAndIdentitiesAlone)
{
    Particles once = jittered_lattice(8, 3, 0.3);
    NeighbourList list(support, 0.3, 1.0, 3);
    list.build(once);
    const std::vector<Index> first = once.identity;
    std::vector<Index> shuffled(first.size());
    for (std::size_t k = 0; k < shuffled.size(); ++k)
        shuffled[k] = static_cast<Index>((k * 37 + 5) % shuffled.size());
    once.permute(shuffled);
    list.build(once);
    EXPECT_EQ(once.identity, first);
}

TEST(NeighbourList, OrderDoesNotDependOnTheNumberOfThreads)
{
    // Enough of them for each thread to sort a share.
    const auto listed = [](int threads) {
        omp_set_num_threads(threads);
        Particles particles = jittered_lattice(22, 3, 0.2);
        NeighbourList list(support, 0.3, 1.0, 3);
        list.build(particles);
        std::vector<Index> clusters;
        for (Index c = 0; c < list.cluster_count(); ++c)
            clusters.insert(clusters.end(), {list.cluster(c).first, list.cluster(c).count});
        for (Index i = 0; i < particles.count(); ++i)
            EXPECT_LT(i - list.cluster(list.cluster_of(i)).first, list.cluster(list.cluster_of(i)).count);
        return std::pair{particles.identity, clusters};
    };
    const auto one = listed(1), three = listed(3);
    EXPECT_EQ(one.first, three.first);
    EXPECT_EQ(one.second, three.second);
}

TEST(NeighbourList, SpreadParticlesAreAnErrorNotAnAllocation)
{
    Particles particles = jittered_lattice(3, 3, 0.0);
    particles.position.x[0] = 1e12;
    particles.position.y[1] = 1e12;
    NeighbourList list(support, 0.3, 1.0, 3);
    EXPECT_THROW(list.build(particles), std::runtime_error);
}

} // namespace
} // namespace cupel
