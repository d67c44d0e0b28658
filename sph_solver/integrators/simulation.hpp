#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "integrators/flow.hpp"
#include "integrators/neighbourhood.hpp"
#include "scene/place_particles.hpp"

namespace cupel
{

/// A scene in time. Only what the case's physics names is constructed; the rest costs nothing.
class Simulation
{
public:
    explicit Simulation(Scene scene);

    /// One step, no longer than `longest` (s); returns the time that it took.
    double step(double longest);

    /// Brings forces and lists up to date with the particles' state: at the start, and after a checkpoint was loaded.
    void prepare();

    const Scene& scene() const { return scene_; }
    Particles& particles() { return *scene_.particles; }
    const Particles& particles() const { return *scene_.particles; }
    const Neighbourhood& neighbourhood() const { return neighbourhood_; }
    const Flow* flow() const { return flow_.get(); }
    double time() const { return time_; }
    std::uint64_t steps() const { return steps_; }
    /// Particle updates by the flow so far, and how often each time-step limit was the binding one.
    std::uint64_t updates() const { return updates_; }
    const std::map<std::string, std::uint64_t>& binding_limits() const { return binding_; }

private:
    void set_frozen_temperature();
    double choose_time_step(double longest);
    void kick(double time_step);

    Scene scene_;
    ScalarField& mobility_;
    FlowParameters parameters_;
    TimeStepLimits limits_;
    Neighbourhood neighbourhood_;
    bool frozen_temperature_;
    std::unique_ptr<Flow> flow_;
    double time_ = 0.0;
    std::uint64_t steps_ = 0, updates_ = 0;
    std::map<std::string, std::uint64_t> binding_;
};

}  // namespace cupel
