#include "ledgers/guards.hpp"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

namespace cupel::test
{

namespace
{

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double time_now = 1.5e-3;
constexpr Index faulty = 37;
constexpr Index count = 64;

/// Steel at rest inside a box of 1 mm; particle 3 is a wall.
struct SoundScene
{
    Particles particles{count};
    ScalarField* temperature = &particles.add_scalar({"temperature", "K", Output::yes});
    GuardLimits limits;

    SoundScene()
    {
        for (Index i = 0; i < count; ++i) {
            particles.position.set(i, {1e-4, 0.0, 5e-4});
            particles.density[i] = 6900.0;
            (*temperature)[i] = 1800.0;
        }
        particles.kind[3] = Kind::wall;
        limits.density = {{0.9 * 6900.0, 1.1 * 6900.0}};
        limits.sound_speed = 10.0;
        limits.lowest_temperature = 200.0;
        limits.highest_temperature = 6000.0;
        limits.lower = {0.0, 0.0, 0.0};
        limits.upper = {1e-3, 0.0, 1e-3};
        limits.smallest_time_step = 1e-12;
    }
    std::optional<Diagnosis> check() const { return Guards(particles, limits).check(time_now); }
};

struct Fault
{
    const char* name;
    const char* model;
    std::function<void(SoundScene&)> make;
};

void PrintTo(const Fault& fault, std::ostream* stream)
{
    *stream << fault.name;
}

class GuardFault : public ::testing::TestWithParam<Fault>
{};

} // namespace

TEST(Guard, SoundStatePasses)
{
    SoundScene scene;
    EXPECT_FALSE(scene.check().has_value());
    scene.particles.velocity.set(faulty, {0.0, 0.0, 10.0}); // bounds are inclusive
    scene.particles.density[faulty] = 1.1 * 6900.0;
    EXPECT_FALSE(scene.check().has_value());
}

TEST_P(GuardFault, IsFoundWithModelParticlePlaceAndTime)
{
    SoundScene scene;
    GetParam().make(scene);
    const auto diagnosis = scene.check();
    ASSERT_TRUE(diagnosis.has_value());
    EXPECT_EQ(diagnosis->model, GetParam().model);
    EXPECT_EQ(diagnosis->identity, faulty);
    EXPECT_EQ(diagnosis->time, time_now);
    const std::string line = diagnosis->line();
    EXPECT_EQ(line.find('\n'), std::string::npos);
    for (const std::string part : {GetParam().model, "particle 37", "0.0015 s"})
        EXPECT_NE(line.find(part), std::string::npos) << line;
    EXPECT_FALSE(diagnosis->remedy.empty());
}

INSTANTIATE_TEST_SUITE_P(
    Each, GuardFault,
    ::testing::Values(
        Fault{"density_nan", "continuity", [](SoundScene& s) { s.particles.density[faulty] = not_a_number; }},
        Fault{"density_infinite", "continuity", [](SoundScene& s) { s.particles.density[faulty] = infinite; }},
        Fault{"velocity_nan", "momentum", [](SoundScene& s) { s.particles.velocity.y[faulty] = not_a_number; }},
        Fault{"velocity_infinite", "momentum", [](SoundScene& s) { s.particles.velocity.z[faulty] = -infinite; }},
        Fault{"position_nan", "motion", [](SoundScene& s) { s.particles.position.x[faulty] = not_a_number; }},
        Fault{"temperature_nan", "heat", [](SoundScene& s) { (*s.temperature)[faulty] = not_a_number; }},
        Fault{"temperature_low", "heat", [](SoundScene& s) { (*s.temperature)[faulty] = 199.0; }},
        Fault{"temperature_high", "heat", [](SoundScene& s) { (*s.temperature)[faulty] = 6001.0; }},
        Fault{"density_low", "equation of state", [](SoundScene& s) { s.particles.density[faulty] = 6200.0; }},
        Fault{"density_high", "equation of state", [](SoundScene& s) { s.particles.density[faulty] = 7600.0; }},
        Fault{"supersonic", "momentum", [](SoundScene& s) { s.particles.velocity.x[faulty] = 10.001; }},
        Fault{"left_below", "walls", [](SoundScene& s) { s.particles.position.z[faulty] = -1e-6; }},
        Fault{"left_in_y", "walls", [](SoundScene& s) { s.particles.position.y[faulty] = 1e-9; }},
        Fault{"left_sideways", "walls", [](SoundScene& s) { s.particles.position.x[faulty] = 1.001e-3; }}),
    [](const auto& instance) { return std::string(instance.param.name); });

TEST(Guard, FirstParticleByIdentityIsNamed)
{
    SoundScene scene;
    for (Index i = 0; i < count; ++i)
        scene.particles.identity[static_cast<std::size_t>(i)] = count - 1 - i;
    scene.particles.rebuild_places();
    scene.particles.density[10] = 1.0;
    scene.particles.density[20] = 2.0;
    const auto diagnosis = scene.check();
    ASSERT_TRUE(diagnosis.has_value());
    EXPECT_EQ(diagnosis->identity, count - 1 - 20);
    EXPECT_EQ(diagnosis->value, 2.0);
}

TEST(Guard, WallParticlesOnlyNeedNumbers)
{
    SoundScene scene;
    scene.particles.position.set(3, {0.0, 0.0, -1e-4});
    scene.particles.density[3] = 20000.0;
    scene.particles.velocity.set(3, {100.0, 0.0, 0.0});
    EXPECT_FALSE(scene.check().has_value());
    scene.particles.density[3] = not_a_number;
    EXPECT_TRUE(scene.check().has_value());
}

TEST(Guard, SolidParticlesNeedATemperatureAsWell)
{
    // Metal has the kind of a solid until it flows, however hot it is.
    SoundScene scene;
    scene.particles.kind[faulty] = Kind::solid;
    scene.particles.position.set(faulty, {0.0, 0.0, -1e-4});
    scene.particles.density[faulty] = 20000.0;
    scene.particles.velocity.set(faulty, {100.0, 0.0, 0.0});
    EXPECT_FALSE(scene.check().has_value());
    (*scene.temperature)[faulty] = 6001.0;
    const auto diagnosis = scene.check();
    ASSERT_TRUE(diagnosis.has_value());
    EXPECT_EQ(diagnosis->model, "heat");
    EXPECT_EQ(diagnosis->identity, faulty);
}

TEST(Guard, WhereEverythingStandsNoFaultIsOverlooked)
{
    const std::vector<std::function<void(SoundScene&)>> faults{
        [](SoundScene& s) { s.particles.position.x[faulty] = not_a_number; },
        [](SoundScene& s) { s.particles.velocity.z[faulty] = infinite; },
        [](SoundScene& s) { s.particles.density[faulty] = -infinite; },
        [](SoundScene& s) { (*s.temperature)[faulty] = not_a_number; },
        [](SoundScene& s) { (*s.temperature)[faulty] = 6001.0; },
        [](SoundScene& s) { (*s.temperature)[faulty] = 199.0; }};
    for (std::size_t k = 0; k < faults.size(); ++k) {
        SoundScene scene;
        for (Index i = 0; i < count; ++i)
            if (i != 3) scene.particles.kind[static_cast<std::size_t>(i)] = Kind::solid;
        EXPECT_FALSE(scene.check().has_value());
        faults[k](scene);
        const auto diagnosis = scene.check();
        ASSERT_TRUE(diagnosis.has_value()) << "fault " << k;
        EXPECT_EQ(diagnosis->identity, faulty);
    }
}

TEST(Guard, SomeParticlesAreCheckedAlone)
{
    SoundScene scene;
    const Guards guards(scene.particles, scene.limits);
    const std::vector<Index> some{5, faulty, 40}, others{4, 5, 6};
    scene.particles.velocity.x[faulty] = 10.001;
    EXPECT_FALSE(guards.check(others, time_now).has_value());
    ASSERT_TRUE(guards.check(some, time_now).has_value());
    EXPECT_EQ(guards.check(some, time_now)->identity, faulty);
}

TEST(Guard, SceneWithoutTemperatureIsChecked)
{
    Particles particles(4);
    const Guards guards(particles, {});
    EXPECT_FALSE(guards.check(0.0).has_value());
    particles.velocity.x[2] = not_a_number;
    EXPECT_TRUE(guards.check(0.0).has_value());
}

TEST(Guard, CollapsedTimeStepIsNamedWithItsCriterion)
{
    const SoundScene scene;
    const Guards guards(scene.particles, scene.limits);
    EXPECT_FALSE(guards.check_time_step(1e-7, "acoustic", time_now).has_value());
    for (const double step : {1e-13, 0.0, -1e-7, not_a_number, infinite}) {
        const auto diagnosis = guards.check_time_step(step, "capillary", time_now);
        ASSERT_TRUE(diagnosis.has_value()) << step;
        EXPECT_NE(diagnosis->line().find("capillary"), std::string::npos);
        EXPECT_EQ(diagnosis->line().find("particle"), std::string::npos);
    }
}

} // namespace cupel::test
