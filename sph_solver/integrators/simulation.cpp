#include "integrators/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <type_traits>

namespace cupel::inline CUPEL_ENGINE
{

namespace
{

constexpr double no_limit = std::numeric_limits<double>::infinity();

FlowParameters parameters_of(const Scene& scene, bool has_flow)
{
    if (has_flow) return derive_flow_parameters(scene);
    FlowParameters parameters;
    parameters.smoothing_length = scene.definition.numerics.smoothing_ratio * scene.spacing;
    return parameters;
}

double support_of(const Scene& scene, const FlowParameters& parameters)
{
    return SmoothingKernel(scene.definition.numerics.kernel, parameters.smoothing_length, scene.dimensions).support();
}

Images images_of(const Scene& scene, const FlowParameters& parameters)
{
    const double skin = scene.definition.numerics.skin * scene.spacing;
    return {scene.definition.domain, scene.dimensions, scene.spacing, support_of(scene, parameters) + skin, skin};
}

} // namespace

Simulation::Simulation(Scene scene)
    : scene_(std::move(scene)), mobility_(scene_.particles->add_scalar({"mobility", "1"})),
      has_flow_(scene_.definition.requires_physics("flow")), has_heat_(scene_.definition.requires_physics("heat")),
      melts_(has_heat_ && scene_.definition.requires_physics("melting")),
      frozen_temperature_(!has_heat_ && (scene_.definition.requires_physics("marangoni") ||
                                         scene_.definition.requires_physics("recoil"))),
      parameters_(parameters_of(scene_, has_flow_)),
      limits_(has_flow_ ? derive_time_step_limits(scene_, parameters_) : TimeStepLimits{}),
      neighbourhood_(support_of(scene_, parameters_), scene_.definition.numerics.skin * scene_.spacing, scene_.spacing,
                     scene_.dimensions, images_of(scene_, parameters_))
{
    const std::string& saving = scene_.definition.numerics.without_saving;
    if (saving == "moving_momentum") neighbourhood_.compute_everywhere();
    if (saving == "local_lists") neighbourhood_.list_everywhere();
    heats_every_step_ = saving == "thermal_clock";
    Particles& particles = *scene_.particles;
    if (frozen_temperature_) {
        particles.add_scalar({"temperature", "K", Output::yes});
        set_frozen_temperature();
    }
    if (has_heat_) heat_ = std::make_unique<ThermalStep>(scene_);
    if (melts_) {
        liquid_fraction_ = &particles.scalar("liquid_fraction");
        mushy_drag_.constant = scene_.materials.front().mushy_drag.value_or(0.0); // needed where the melt flows
    }
    for (Index i = 0; i < particles.count(); ++i)
        mobility_[i] = has_flow_ && particles.kind[static_cast<std::size_t>(i)] == Kind::fluid ? 1.0 : 0.0;
    if (!has_flow_) return;
    flow_ = make_flow(scene_, parameters_, mobility_);
    set_bounds();
}

void Simulation::start()
{
    neighbourhood_.rebuild(*scene_.particles, mobility_);
    if (!flow_) return;
    flow_->evaluate(neighbourhood_, 0.0);
    // Two phases find their densities only now: the books begin with them.
    flow_->books() = {};
    mechanical_energy_at_start_ = flow_->mechanical_energy(neighbourhood_);
}

Ledger Simulation::mechanical_ledger() const
{
    return flow_->books().ledger(mechanical_energy_at_start_, flow_->mechanical_energy(neighbourhood_));
}

void Simulation::settle()
{
    neighbourhood_.rebuild(*scene_.particles, mobility_);
    updates_when_settled_ = updates_;
}

bool Simulation::due_to_settle() const
{
    constexpr std::uint64_t updates_between = 50;
    return updates_ - updates_when_settled_ >= updates_between * static_cast<std::uint64_t>(scene_.particles->count());
}

void Simulation::set_frozen_temperature()
{
    Particles& particles = *scene_.particles;
    ScalarField& temperature = particles.scalar("temperature");
    const Index count = particles.count();
#pragma omp parallel for schedule(static)
    for (Index i = 0; i < count; ++i) {
        const Vector p = particles.position[i];
        temperature[i] = scene_.definition.initial_temperature({p.x, p.y, p.z});
    }
}

/// The least of all limits. Those of the flow hold while anything moves; the force criterion ¼ √(h/|a|) (Monaghan 1992)
/// is the only one that changes with it: all of a particle's acceleration has to keep to it in a step of sound, and in
/// a whole step what acts as an impulse at its ends. While nothing moves, heat sets the pace.
double Simulation::choose_time_step(double longest)
{
    double time_step = longest;
    last_binding_ = "output";
    const auto consider = [&](const std::string& name, double limit) {
        if (limit < time_step) {
            time_step = limit;
            last_binding_ = name;
        }
    };
    if (neighbourhood_.moving_particles().empty()) {
        if (heat_) consider("thermal", heat_->stable_time_step());
    }
    else {
        for (const auto& [name, limit] : limits_)
            if (name != "acoustic" && name != "force") consider(name, limit);
        if (heat_) consider("thermal", heat_->stable_time_step());
        if (most_steps_of_sound() > 1)
            consider("force", force_limit([&](Index i) { return flow_->impulsive_acceleration(i); }));
        limits_["force"] = force_limit([&](Index i) { return flow_->acceleration()[i]; });
        const double sound = std::min(limits_.at("acoustic"), limits_.at("force"));
        substeps_ = steps_of_sound(time_step / sound);
        consider("acoustic", substeps_ * limits_.at("acoustic"));
        consider("force", substeps_ * limits_.at("force"));
    }
    ++binding_[last_binding_];
    return time_step;
}

template <class Acceleration> double Simulation::force_limit(const Acceleration& acceleration_of) const
{
    double greatest = 0.0;
    for (const Index i : neighbourhood_.moving_particles()) {
        const Vector acceleration = acceleration_of(i);
        greatest = std::max(greatest, dot(acceleration, acceleration));
    }
    if (!(greatest > 0.0)) return no_limit;
    return 0.25 * scene_.definition.numerics.time_step_factor *
           std::sqrt(parameters_.smoothing_length / std::sqrt(greatest));
}

int Simulation::most_steps_of_sound() const
{
    return flow_->follows_sound() ? scene_.definition.numerics.acoustic_substeps : 1;
}

/// How many steps of sound make one of all else, `fitting` of which would just fit: the nearest whole number. One more
/// for a small rest would cost what it gains.
int Simulation::steps_of_sound(double fitting) const
{
    return static_cast<int>(std::clamp(std::round(fitting), 1.0, static_cast<double>(most_steps_of_sound())));
}

/// In double a cluster at a time, but for what is mushy: what is summed up from step to step has that precision.
///
/// Pressure works at an evaluation on the mean of the velocities with which particles drift before and after it, and
/// compression takes that from these two drifts. The two halves of the kick make ¼ v₋ + ½ v + ¼ v₊ of it, which is that
/// mean where they are equal. What the surface gives is not: its force is held, and the first half corrects that
/// (KickTimes). With half of the difference left out of the velocity that pressure works on, the two are the mean
/// again; the surface answers for the rest. Without, work is missed of the size of the square of what the surface's
/// force changes by in a step: slm_track_150w at coarse closed to 8e-4 with four steps of sound and 2e-3 with eight,
/// for 1e-4 and 8e-5.
void Simulation::kick(const KickTimes& times, double with_new_velocity)
{
    Particles& particles = *scene_.particles;
    const auto kick_liquid = [&](const auto& at) {
        using Scalar = typename std::decay_t<decltype(at)>::Scalar;
        const auto kick = flow_->kick(at, times);
        const auto before = at(particles.velocity);
        at.store(particles.velocity, before + kick.change);
        const auto mean = before + Scalar(0.5) * kick.change;
        return flow_->work(at, kick, mean, mean - Scalar(0.5) * kick.more_than_next, times);
    };
    const auto kick_mush = [&](Index i) {
        const OneParticle at{i};
        const auto kick = flow_->kick(at, times);
        const Vector before = particles.velocity[i];
        // Its drag is stiffer than any explicit step could follow: implicitly.
        const double kept = mushy_drag_.damping_factor((*liquid_fraction_)[i], particles.density[i], times.sound);
        const Vector velocity = kept * (before + kick.change);
        particles.velocity.set(i, velocity);
        // Within a kick drag may stop what forces move. They do their work on the path that is left, and drag takes the
        // rest of what kinetic energy loses.
        const Vector mean = before + with_new_velocity * (velocity - before);
        auto work = flow_->work(at, kick, mean, mean, times);
        work.mush = 0.5 * particles.mass[i] * (dot(velocity, velocity) - dot(before, before)) - work.by_forces();
        return work;
    };
    const auto kick_one = [&](Index i) {
        return melts_ && (*liquid_fraction_)[i] < 1.0 ? kick_mush(i) : kick_liquid(OneParticle{i});
    };
    if constexpr (sizeof(Real) < sizeof(double))
        flow_->books() += sum_over_moving(kick_one);
    else {
        const auto& clusters = neighbourhood_.moving();
        const auto sum = ordered_sum(static_cast<Index>(clusters.size()), [&](Index k) {
            const Cluster cluster = neighbourhood_.list().cluster(clusters[static_cast<std::size_t>(k)]);
            const SomeOfCluster at{cluster.first, Mobility{mobility_}.moving_in(cluster)};
            WorkOnMotion<Lanes> work;
            if (!melts_ || (set_lanes(at(*liquid_fraction_) < Lanes(1.0)) & at.which) == 0) {
                work = kick_liquid(at);
                if (!at.all())
                    for (const auto cause : work.causes)
                        work.*cause = at.chosen(work.*cause);
                return work;
            }
            for (int lane = 0; lane < cluster.count; ++lane)
                if (at.which >> lane & 1u) {
                    const auto one = kick_one(cluster.first + lane);
                    for (std::size_t c = 0; c < std::size(work.causes); ++c)
                        (work.*work.causes[c]).set(lane, one.*one.causes[c]);
                }
            return work;
        });
        WorkOnMotion<double> total;
        for (std::size_t c = 0; c < std::size(sum.causes); ++c)
            total.*total.causes[c] = sum_of(sum.*sum.causes[c]);
        flow_->books() += total;
    }
}

/// What stops takes its mechanical energy out of the flow, J.
double Simulation::energy_of_what_stops(Index i) const
{
    const Particles& particles = *scene_.particles;
    const Vector v = particles.velocity[i];
    return particles.mass[i] * (0.5 * dot(v, v) + flow_->elastic_energy(i));
}

void Simulation::advance_flow(double time_step)
{
    const double whole = time_step, sound = time_step / substeps_;
    kick({0.5 * sound, 0.5 * whole, 0.5 * sound}, 1.0);
    for (int k = 1; k < substeps_; ++k) {
        const SoundStep step = SoundStep::of(k, substeps_, whole);
        const double before = sound * drift_before_densities(k, substeps_);
        move(before, 0.5 * sound);
        flow_->find_densities(neighbourhood_, step);
        move(sound - before, -0.5 * sound);
        flow_->evaluate_sound(neighbourhood_, step);
        kick({sound, 0.0, sound}, 0.5);
    }
    move(sound, 0.5 * sound);
    if (frozen_temperature_) set_frozen_temperature();
    flow_->evaluate(neighbourhood_, whole);
    kick({0.5 * sound, 0.5 * whole, 0.5 * whole, 0.5 * (sound - whole)}, 0.0);
    if (heat_) mark_what_moved();
    retire_escaped();
    sound_steps_ += static_cast<std::uint64_t>(substeps_);
    updates_ += static_cast<std::uint64_t>(substeps_) * neighbourhood_.moving_particles().size();
}

void Simulation::move(double time_step, double unanswered)
{
    if (time_step == 0.0) return;
    flow_->drift(neighbourhood_, time_step);
    if (has_walls_) hold_before_walls(unanswered);
    neighbourhood_.update(*scene_.particles, mobility_);
}

/// What heat has to sum anew: around what moves, and around solids whose volume follows the pressure of what moves.
void Simulation::mark_what_moved()
{
    for (const Index i : neighbourhood_.moving_particles())
        heat_->mark_moved(i);
    for (const Index c : neighbourhood_.standing()) {
        const Cluster& cluster = neighbourhood_.list().cluster(c);
        for (Index i = cluster.first; i < cluster.first + cluster.count; ++i)
            heat_->mark_moved(i);
    }
}

void Simulation::advance_heat(double until)
{
    if (!(until > heat_time_)) return;
    heat_->advance(neighbourhood_.list(), heat_time_, until - heat_time_);
    heat_time_ = until;
    updates_ += static_cast<std::uint64_t>(scene_.particles->count());
    if (melts_ && has_flow_) melt_and_solidify();
}

/// Metal that is liquid enough to flow moves (its mush damped); mush that holds together and solid stand where they
/// are. Were coherent mush left to move, its density would follow the pressure around it while its place could not.
void Simulation::melt_and_solidify()
{
    Particles& particles = *scene_.particles;
    const double rest_density = scene_.materials.front().density;
    bool changed = false;
    for (Index i = 0; i < particles.count(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (particles.kind[k] == Kind::wall || (escaped_ && (*escaped_)[i] != 0.0)) continue;
        const bool liquid = (*liquid_fraction_)[i] >= CarmanKozeny::coherent_below;
        if (liquid == (mobility_[i] != 0.0)) continue;
        changed = true;
        if (!liquid) flow_->books().stops -= energy_of_what_stops(i);
        mobility_[i] = liquid ? 1.0 : 0.0;
        particles.kind[k] = liquid ? Kind::fluid : Kind::solid;
        particles.velocity.set(i, {});
        particles.density[i] = rest_density;
        particles.pressure[i] = 0.0;
        particles.volume[i] = particles.mass[i] / rest_density;
        flow_->reset(i);
        heat_->mark_moved(i);
    }
    if (changed) neighbourhood_.classify(particles, mobility_);
}

double Simulation::step(double longest)
{
    const double time_step = choose_time_step(longest);
    if (flow_ && !neighbourhood_.moving_particles().empty()) advance_flow(time_step);
    time_ += time_step;
    // The thermal clock: as late as its stability allows, but never later than an output.
    if (heat_ &&
        (heats_every_step_ || last_binding_ == "output" || time_ - heat_time_ + time_step > heat_->stable_time_step()))
        advance_heat(time_);
    ++steps_;
    last_time_step_ = time_step;
    return time_step;
}

void Simulation::save(std::map<std::string, double>& numbers) const
{
    numbers["clock.time"] = time_;
    numbers["clock.heat_time"] = heat_time_;
    numbers["clock.steps"] = static_cast<double>(steps_);
    numbers["clock.sound_steps"] = static_cast<double>(sound_steps_);
    numbers["clock.updates"] = static_cast<double>(updates_);
    numbers["clock.last_time_step"] = last_time_step_;
    for (const auto& [name, count] : binding_)
        numbers["binding." + name] = static_cast<double>(count);
    if (heat_) heat_->save(numbers);
    if (!flow_) return;
    numbers["work.energy_at_start"] = mechanical_energy_at_start_;
    flow_->books().save(numbers);
}

void Simulation::load(const std::map<std::string, double>& numbers)
{
    time_ = numbers.at("clock.time");
    heat_time_ = numbers.at("clock.heat_time");
    steps_ = static_cast<std::uint64_t>(numbers.at("clock.steps"));
    sound_steps_ = static_cast<std::uint64_t>(numbers.at("clock.sound_steps"));
    updates_ = static_cast<std::uint64_t>(numbers.at("clock.updates"));
    last_time_step_ = numbers.at("clock.last_time_step");
    binding_.clear();
    const std::string prefix = "binding.";
    for (const auto& [name, value] : numbers)
        if (name.starts_with(prefix)) binding_[name.substr(prefix.size())] = static_cast<std::uint64_t>(value);
    if (heat_) heat_->load(numbers);
    if (!flow_) return;
    mechanical_energy_at_start_ = numbers.at("work.energy_at_start");
    flow_->books().load(numbers);
}

} // namespace cupel::inline CUPEL_ENGINE
