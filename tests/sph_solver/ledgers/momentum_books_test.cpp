/// Momentum of liquid that nothing outside acts on: who is asked, and what the books say.
#include "ledgers/momentum_books.hpp"

#include <gtest/gtest.h>

#include "integrators/simulation.hpp"
#include "small_scenes.hpp"

namespace cupel
{
namespace
{

TEST(MomentumBooks, JudgeWhatMovedAgainstTheGreatestSumOfSizes)
{
    Particles particles(2);
    particles.mass[0] = 2.0;
    particles.mass[1] = 1.0;
    particles.velocity.set(0, {1.0, 0.0, 0.0});
    particles.velocity.set(1, {-2.0, 0.0, 0.0});
    MomentumBooks books;
    books.begin(particles);
    EXPECT_EQ(books.ledger()->closure(), 0.0);
    // A push between the two, then one that has no partner: 0.3 kg m/s.
    particles.velocity.set(0, {1.0, 0.5, 0.0});
    particles.velocity.set(1, {-2.0, -1.0, 0.0});
    books.update(particles, false);
    EXPECT_EQ(books.ledger()->closure(), 0.0);
    particles.velocity.set(1, {-2.0, -1.0, 0.3});
    books.update(particles, false);
    EXPECT_NEAR(books.ledger()->error(), 0.3, 1e-15);
    const double size = 2.0 * std::sqrt(1.25) + std::sqrt(5.09);
    EXPECT_NEAR(books.ledger()->closure(), 0.3 / size, 1e-15);
    // A wall is met: from here on there is nothing to tell, and that is remembered by a checkpoint.
    books.update(particles, true);
    EXPECT_FALSE(books.ledger());
    std::map<std::string, double> numbers;
    books.save(numbers);
    MomentumBooks loaded;
    loaded.load(numbers);
    EXPECT_FALSE(loaded.ledger());
}

TEST(MomentumBooks, AreKeptWhereNothingOutsideActs)
{
    Case definition;
    definition.physics = {"flow", "surface_tension"};
    EXPECT_TRUE(MomentumBooks::can_tell(definition));
    definition.domain.boundaries[0] = Boundary{BoundaryKind::symmetry, true, {}};
    EXPECT_FALSE(MomentumBooks::can_tell(definition));
    definition.domain.boundaries[0] = Boundary{BoundaryKind::wall, true, {}};
    EXPECT_TRUE(MomentumBooks::can_tell(definition));
    definition.physics.push_back("gravity");
    EXPECT_FALSE(MomentumBooks::can_tell(definition));
}

} // namespace
} // namespace cupel
