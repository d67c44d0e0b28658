/// The plain weakly compressible step in 3-D, in each engine: continuity, pressure, viscosity, with the Wendland kernel
/// at h = 1.3 Δx (75 neighbours), at a Mach number of 0.1, search and sorting included.
#include <cmath>
#include <numbers>

#include "integrators/neighbourhood.hpp"
#include "kernels/wendland_c2.hpp"
#include "models/plain_flow.hpp"
#include "small_scenes.hpp"
#include "step_benchmark.hpp"

namespace cupel::inline CUPEL_ENGINE
{

namespace
{

constexpr double sound_speed = 10.0, greatest_speed = 1.0, smoothing_length = 1.3, viscosity = 0.05, skin = 0.3;
/// The acoustic limit.
constexpr double time_step = 0.25 * smoothing_length / (sound_speed + greatest_speed);

class PlainStep : public StepBenchmark
{
public:
    explicit PlainStep(std::size_t particles)
        : cells_(static_cast<int>(std::lround(std::cbrt(static_cast<double>(particles))))),
          particles_(small_scenes::jittered_lattice(cells_, 3, 0.1)),
          mobility_(particles_.add_scalar({"mobility", "1"}, 1.0)),
          density_rate_(particles_.add_scalar({"density_rate", "kg/(m3 s)"})),
          acceleration_(particles_.add_vector({"acceleration", "m/s2"})), kernel_(smoothing_length, 3),
          neighbourhood_(kernel_.support(), skin, 1.0, 3)
    {
        release_pass_memory();
        const double wave = 2.0 * std::numbers::pi / cells_;
        for (Index i = 0; i < particles_.count(); ++i) {
            const Vector p = particles_.position[i];
            particles_.velocity.set(i, {std::sin(wave * p.x) * std::cos(wave * p.y) * greatest_speed,
                                        -std::cos(wave * p.x) * std::sin(wave * p.y) * greatest_speed, 0.0});
            particles_.density[i] = 1.0 + 0.001 * std::sin(wave * p.x);
            equation_of_state(i);
        }
        neighbourhood_.rebuild(particles_, mobility_);
        sum_up();
    }

    void step() override
    {
        const Index count = particles_.count();
        VectorField &x = particles_.position, &v = particles_.velocity;
#pragma omp parallel for schedule(static)
        for (Index i = 0; i < count; ++i) {
            const Vector velocity = v[i] + time_step * acceleration_[i];
            v.set(i, velocity);
            x.set(i, x[i] + time_step * velocity);
            particles_.density[i] += time_step * density_rate_[i];
            equation_of_state(i);
        }
        neighbourhood_.update(particles_, mobility_);
        sum_up();
        ++steps_;
    }

    std::size_t count() const override
    {
        return static_cast<std::size_t>(particles_.count());
    }
    double updates() const override
    {
        return static_cast<double>(steps_) * static_cast<double>(count());
    }
    std::size_t bytes() const override
    {
        return particles_.bytes() + neighbourhood_.list().bytes() + pass_memory_bytes();
    }
    std::size_t builds() const override
    {
        return neighbourhood_.list().builds();
    }

    double neighbours() const override
    {
        double pairs = 0.0;
        const double reach = kernel_.support() * kernel_.support();
        for (const Index c : neighbourhood_.all())
            for (Index i = neighbourhood_.list().cluster(c).first;
                 i < neighbourhood_.list().cluster(c).first + neighbourhood_.list().cluster(c).count; ++i)
                neighbourhood_.list().for_each_neighbour(c, [&](Index j) {
                    const Vector offset = particles_.position[i] - particles_.position[j];
                    pairs += i != j && dot(offset, offset) < reach ? 1.0 : 0.0;
                });
        return pairs / static_cast<double>(particles_.count());
    }

    std::vector<double> accelerations() const override
    {
        std::vector<double> all(3 * count());
        for (Index i = 0; i < particles_.count(); ++i) {
            const auto k = 3 * static_cast<std::size_t>(particles_.identity[static_cast<std::size_t>(i)]);
            const Vector a = acceleration_[i];
            all[k] = a.x;
            all[k + 1] = a.y;
            all[k + 2] = a.z;
        }
        return all;
    }

private:
    /// The pressure that the density will have a step later: with it a single pass a step, both rates from the same
    /// state, neither damps nor feeds sound waves.
    void equation_of_state(Index i)
    {
        particles_.volume[i] = particles_.mass[i] / particles_.density[i];
        particles_.pressure[i] =
            sound_speed * sound_speed * (particles_.density[i] + time_step * density_rate_[i] - 1.0);
    }
    void sum_up()
    {
        for_each_pair(neighbourhood_.list(), particles_, kernel_, neighbourhood_.all(),
                      PlainFlow{particles_.density, particles_.pressure, particles_.velocity, viscosity, density_rate_,
                                acceleration_});
    }

    int cells_;
    Particles particles_;
    ScalarField& mobility_;
    ScalarField& density_rate_;
    VectorField& acceleration_;
    WendlandC2 kernel_;
    Neighbourhood neighbourhood_;
    std::size_t steps_ = 0;
};

} // namespace

std::unique_ptr<StepBenchmark> make_plain_step(std::size_t particles)
{
    return std::make_unique<PlainStep>(particles);
}

} // namespace cupel::inline CUPEL_ENGINE
