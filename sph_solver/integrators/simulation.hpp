#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "integrators/flow.hpp"
#include "integrators/neighbourhood.hpp"
#include "integrators/thermal_step.hpp"
#include "models/carman_kozeny.hpp"
#include "scene/place_particles.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// A scene in time. Only what the case's physics names is constructed; the rest costs nothing.
///
/// Flow goes by kick, drift, kick (velocity Verlet) on its own time step; heat follows on a longer one, and from what
/// melts and solidifies in it the flow learns which particles move.
class Simulation
{
public:
    explicit Simulation(Scene scene);

    /// Lists and forces of the initial state. Not after a checkpoint: that one has the forces.
    void start();

    /// One step, no longer than `longest` (s); returns the time that it took. Where `longest` binds, heat is brought up
    /// to the same time as the flow.
    double step(double longest);

    /// Puts the particles into the order that their positions alone give, and all lists with them, so that a run which
    /// goes on from here and one that starts from a checkpoint of this state are the same bit for bit. To be called
    /// when it is due, not by the clock on the wall.
    void settle();
    /// After 50 updates of as many particles as there are: what settling costs is a per cent or two, however many move.
    bool due_to_settle() const;

    /// Named numbers beside the particles' fields, for a checkpoint; after load() call settle().
    void save(std::map<std::string, double>& numbers) const;
    void load(const std::map<std::string, double>& numbers);

    const Scene& scene() const { return scene_; }
    Particles& particles() { return *scene_.particles; }
    const Particles& particles() const { return *scene_.particles; }
    const Neighbourhood& neighbourhood() const { return neighbourhood_; }
    /// Null where the case does not name 'flow' or 'heat'.
    const Flow* flow() const { return flow_.get(); }
    const ThermalStep* heat() const { return heat_.get(); }
    const FlowParameters& parameters() const { return parameters_; }
    const TimeStepLimits& limits() const { return limits_; }
    double time() const { return time_; }
    std::uint64_t steps() const { return steps_; }
    /// Of the flow, steps of sound: as many as steps, or a few times as many.
    std::uint64_t sound_steps() const { return sound_steps_; }
    double last_time_step() const { return last_time_step_; }
    const std::string& last_binding() const { return last_binding_; }
    /// Mass of the particles that have left the domain, kg.
    double escaped_mass() const;
    /// Particle updates so far, by flow and heat together.
    std::uint64_t updates() const { return updates_; }
    /// Of kinetic and elastic energy of the liquid; only where there is a flow.
    Ledger mechanical_ledger() const;
    /// Criterion → number of steps that it bound.
    const std::map<std::string, std::uint64_t>& binding_limits() const { return binding_; }

private:
    void set_bounds();
    void set_frozen_temperature();
    double choose_time_step(double longest);
    int most_steps_of_sound() const;
    int steps_of_sound(double fitting) const;
    /// Longest step that the accelerations of what moves allow, s.
    template <class Acceleration> double force_limit(const Acceleration& acceleration_of) const;
    void advance_flow(double time_step);
    /// `unanswered`, s: how long no compression answers what pressure does to a motion that a wall stops.
    void move(double time_step, double unanswered);
    void mark_what_moved();
    void advance_heat(double until);
    void melt_and_solidify();
    /// with_new_velocity: of the path that the kick's forces act along, the share that is gone with the velocity after
    /// it.
    void kick(const KickTimes& times, double with_new_velocity);
    double energy_of_what_stops(Index i) const;
    void retire_escaped();
    void hold_before_walls(double unanswered);
    bool outside(const Vector& position) const;
    template <class Value> auto sum_over_moving(const Value& value) const
    {
        const auto& moving = neighbourhood_.moving_particles();
        return ordered_sum(static_cast<Index>(moving.size()),
                           [&](Index m) { return value(moving[static_cast<std::size_t>(m)]); });
    }

    Scene scene_;
    ScalarField& mobility_;
    bool has_flow_, has_heat_, melts_, frozen_temperature_;
    bool heats_every_step_ = false, has_walls_ = false;
    FlowParameters parameters_;
    TimeStepLimits limits_;
    Neighbourhood neighbourhood_;
    std::unique_ptr<ThermalStep> heat_;
    std::unique_ptr<Flow> flow_;
    CarmanKozeny mushy_drag_;
    const ScalarField* liquid_fraction_ = nullptr;
    ScalarField* escaped_ = nullptr;     ///< only where a side of the domain is open to what flies
    Vector wall_lower_{}, wall_upper_{}; ///< liquid stays between these, m; infinite where neither wall nor mirror is
    Vector lower_{}, upper_{};           ///< beyond these a particle has left, m
    double time_ = 0.0, heat_time_ = 0.0, last_time_step_ = 0.0;
    double mechanical_energy_at_start_ = 0.0; ///< J
    std::string last_binding_;
    int substeps_ = 1; ///< of sound in this step
    std::uint64_t steps_ = 0, sound_steps_ = 0, updates_ = 0, updates_when_settled_ = 0;
    std::map<std::string, std::uint64_t> binding_;
};

} // namespace cupel::inline CUPEL_ENGINE
