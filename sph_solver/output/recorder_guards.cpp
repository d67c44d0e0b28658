/// What a run's guards allow, when they are asked, and what they leave where they stop it.
#include <algorithm>

#include "output/recorder.hpp"
#include "output/signals.hpp"

namespace cupel::inline CUPEL_ENGINE
{

namespace
{

/// Every so many steps the guards look at what moves, and after as many updates of every particle at all: so they cost
/// the same share of a run in which a few dozen particles move as of one in which all do.
constexpr std::uint64_t steps_between_guards = 10;

/// Density may err by this before the run is called broken. A weakly compressible flow stays near 1 %; what is thrown
/// against a wall at a tenth of the artificial speed of sound is compressed by a fifth for an instant (water hammer).
constexpr double greatest_density_error = 0.5;

} // namespace

GuardLimits Recorder::guard_limits() const
{
    const Case& definition = simulation_.scene().definition;
    GuardLimits limits;
    for (const Material& material : simulation_.scene().materials)
        limits.density.push_back(
            {(1.0 - greatest_density_error) * material.density, (1.0 + greatest_density_error) * material.density});
    if (simulation_.flow()) {
        limits.sound_speed = simulation_.parameters().equation_of_state.sound_speed;
        double smallest = simulation_.limits().at("acoustic");
        for (const auto& [name, limit] : simulation_.limits())
            smallest = std::min(smallest, limit);
        limits.smallest_time_step = 1e-4 * smallest;
    }
    if (simulation_.heat()) {
        limits.lowest_temperature = simulation_.heat()->lowest_possible_temperature() - 1.0;
        limits.highest_temperature = 20000.0;
    }
    // A particle beyond a wall or a mirror has gone through it; beyond a periodic side it is on its way back in, beyond
    // an open one it has flown out and is retired.
    const bool walled = simulation_.particles().has("wall_normal");
    const auto margin = [&](std::size_t side) {
        const auto& boundary = definition.domain.boundaries[side];
        const bool stops =
            !boundary || boundary->kind == BoundaryKind::symmetry || (walled && boundary->kind == BoundaryKind::wall);
        return stops ? definition.spacing : std::numeric_limits<double>::infinity();
    };
    const auto& lower = definition.domain.lower;
    const auto& upper = definition.domain.upper;
    limits.lower = {lower[0] - margin(0), lower[1] - margin(2), lower[2] - margin(4)};
    limits.upper = {upper[0] + margin(1), upper[1] + margin(3), upper[2] + margin(5)};
    return limits;
}

/// A step and what the guards say of it, where they are due.
std::optional<Diagnosis> Recorder::simulate()
{
    step_ = simulation_.steps() + 1;
    const auto rounds = [&] {
        return simulation_.updates() /
               (steps_between_guards * static_cast<std::uint64_t>(simulation_.particles().count()));
    };
    const std::uint64_t rounds_before = rounds();
    try {
        simulation_.step(longest_step());
    }
    catch (const std::exception&) {
        // A state so bad that not even neighbours can be listed; what the guards find in it says more.
        if (const auto problem = guards_->check(simulation_.time())) return problem;
        throw;
    }
    const TimedScope timed(guard_seconds_);
    return problem_after_step(rounds() != rounds_before);
}

std::optional<Diagnosis> Recorder::problem_after_step(bool round_complete)
{
    if (!output_is_due())
        if (const auto problem =
                guards_->check_time_step(simulation_.last_time_step(), simulation_.last_binding(), simulation_.time()))
            return problem;
    // What the run settles with has passed the guards: it is a state to go back to.
    if (round_complete || output_is_due() || simulation_.due_to_settle()) return guards_->check(simulation_.time());
    if (step_ % steps_between_guards != 0) return {};
    return guards_->check(simulation_.neighbourhood().moving_particles(), simulation_.time());
}

void Recorder::stop(const Diagnosis& diagnosis)
{
    diagnosis_ = diagnosis.line();
    ending_ = Ending::stopped;
    cost_when_stopped_ = cost_so_far();
    log_->error("{}", diagnosis_);
    try {
        fields_->wait();
        write_snapshot(folder_.stopped_fields(), simulation_.particles(), simulation_.time(), provenance_);
        return_to_last_good_state();
    }
    catch (const OutputError& error) {
        log_->warn("the last good state is not kept: {}", error.what());
    }
}

/// The last good state is that of the last step after which the run settled, having passed all guards: from the newest
/// checkpoint, or from the start where none was due yet, the same steps lead there again, bit for bit, without a copy
/// of the particles held through all the run.
void Recorder::return_to_last_good_state()
{
    const std::uint64_t good = settled_step_;
    const auto newest = newest_checkpoint(folder_.checkpoints());
    const std::filesystem::path checkpoint = newest ? *newest : write_start();
    load(checkpoint);
    log_->info("going back to step {} by way of {}", good, checkpoint.filename().string());
    const std::uint64_t start = simulation_.steps();
    while (simulation_.steps() < good && !stop_requested()) {
        simulation_.step(longest_step());
        if (output_is_due()) {
            bring_standing_to_rest(simulation_.particles());
            ++next_output_;
        }
        if (history_is_due()) update_books();
        if (simulation_.due_to_settle()) settle();
    }
    if (simulation_.steps() != good) throw OutputError("interrupted on the way to it");
    if (good != start) write_checkpoint();
    bring_standing_to_rest(simulation_.particles());
    write_snapshot(folder_.last_good_fields(), simulation_.particles(), simulation_.time(), provenance_);
    log_->info("the last good state, t = {:.6g} s, is in {} and the newest checkpoint", simulation_.time(),
               folder_.last_good_fields().filename().string());
}

} // namespace cupel::inline CUPEL_ENGINE
