#include "integrators/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cupel
{

Simulation::Simulation(Scene scene)
    : scene_(std::move(scene)), mobility_(scene_.particles->add_scalar({"mobility", "1"})),
      parameters_(derive_flow_parameters(scene_)), limits_(derive_time_step_limits(scene_, parameters_)),
      neighbourhood_(QuinticSpline(parameters_.smoothing_length, scene_.dimensions).support(),
                     scene_.definition.numerics.skin * scene_.spacing, scene_.spacing, scene_.dimensions),
      frozen_temperature_(!scene_.definition.requires_physics("heat") &&
                          scene_.definition.requires_physics("marangoni"))
{
    Particles& particles = *scene_.particles;
    for (Index i = 0; i < particles.count(); ++i)
        mobility_[i] = particles.kind[static_cast<std::size_t>(i)] == Kind::fluid ? 1.0 : 0.0;
    if (frozen_temperature_)
        particles.add_scalar({"temperature", "K", Output::yes});
    flow_ = make_flow(scene_, parameters_, mobility_);
    prepare();
}

void Simulation::prepare()
{
    neighbourhood_.rebuild(*scene_.particles, mobility_);
    if (frozen_temperature_)
        set_frozen_temperature();
    flow_->evaluate(neighbourhood_, 0.0);
}

void Simulation::set_frozen_temperature()
{
    Particles& particles = *scene_.particles;
    ScalarField& temperature = particles.scalar("temperature");
    const Index count = particles.count();
#pragma omp parallel for schedule(static)
    for (Index i = 0; i < count; ++i)
    {
        const Vector p = particles.position[i];
        temperature[i] = scene_.definition.initial_temperature({p.x, p.y, p.z});
    }
}

/// The least of all limits; the force criterion √(h/|a|) (Monaghan 1992) is the only one that changes with the flow.
double Simulation::choose_time_step(double longest)
{
    double greatest = 0.0;
    const VectorField& acceleration = flow_->acceleration();
    for (const Index i : neighbourhood_.moving_particles())
        greatest = std::max(greatest, dot(acceleration[i], acceleration[i]));
    if (greatest > 0.0)
        limits_["force"] = 0.25 * scene_.definition.numerics.time_step_factor *
                           std::sqrt(parameters_.smoothing_length / std::sqrt(greatest));
    double time_step = longest;
    const char* binding = "output";
    for (const auto& [name, limit] : limits_)
        if (limit < time_step)
        {
            time_step = limit;
            binding = name.c_str();
        }
    ++binding_[binding];
    return time_step;
}

void Simulation::kick(double time_step)
{
    Particles& particles = *scene_.particles;
    const VectorField& acceleration = flow_->acceleration();
    const auto& moving = neighbourhood_.moving_particles();
    const auto count = moving.size();
#pragma omp parallel for schedule(static)
    for (std::size_t m = 0; m < count; ++m)
    {
        const Index i = moving[m];
        particles.velocity.set(i, particles.velocity[i] + time_step * acceleration[i]);
    }
}

double Simulation::step(double longest)
{
    const double time_step = choose_time_step(longest);
    kick(0.5 * time_step);
    flow_->drift(neighbourhood_, time_step);
    neighbourhood_.update(*scene_.particles, mobility_);
    if (frozen_temperature_)
        set_frozen_temperature();
    flow_->evaluate(neighbourhood_, time_step);
    kick(0.5 * time_step);
    time_ += time_step;
    ++steps_;
    updates_ += neighbourhood_.moving_particles().size();
    return time_step;
}

}  // namespace cupel
