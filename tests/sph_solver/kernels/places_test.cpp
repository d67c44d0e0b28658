/// Positions as the pair loop sees them in float arithmetic.
#include "kernels/places.hpp"

#include <gtest/gtest.h>

#include "small_scenes.hpp"

namespace cupel
{
namespace
{

using small_scenes::jittered_lattice;

TEST(Places, KeepOffsetsWhereverTheyLie)
{
    Particles particles = jittered_lattice(60, 2, 0.3);
    NeighbourList list(3.0, 0.3, 1.0, 2);
    list.build(particles);
    const Places places(list, particles.position);
    // Relative to the offset: float's own digits, once for the offset and once for the length of a part; beside them
    // the parts themselves, 2^-31 of 66 spacings.
    const double digits = sizeof(Real) == 4 ? 1.2e-7 : 1e-15, part = sizeof(Real) == 4 ? 4e-8 : 1e-14;
    for (Index c = 0; c < list.cluster_count(); ++c)
        list.for_each_listed(c, [&](Index j) {
            const Index i = list.cluster(c).first;
            const Vector exact = particles.position[i] - particles.position[j];
            const VectorLanes offset = offset_between(places.of_cluster(i), places(j));
            EXPECT_NEAR(offset.x[0], exact.x, digits * std::abs(exact.x) + part);
            EXPECT_NEAR(offset.z[0], exact.z, digits * std::abs(exact.z) + part);
        });
}

} // namespace
} // namespace cupel
