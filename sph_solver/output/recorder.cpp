#include "output/recorder.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/pair_loop.hpp"
#include "output/run_log.hpp"
#include "output/signals.hpp"

namespace cupel::inline CUPEL_ENGINE
{

namespace
{

/// A run without a checkpoint begins anew, whatever was asked for; a folder's name never ends in a slash.
RecorderOptions with_resumable(RecorderOptions options)
{
    if (!options.folder.has_filename()) options.folder = options.folder.parent_path();
    const auto checkpoints = RunFolder{options.folder}.checkpoints();
    options.resume =
        options.resume && std::filesystem::is_directory(checkpoints) && newest_checkpoint(checkpoints).has_value();
    return options;
}

std::vector<std::string> history_columns(const Simulation& simulation)
{
    std::vector<std::string> columns{"time_s", "step", "time_step_s", "moving_particles"};
    if (simulation.flow())
        columns.insert(columns.end(), {"kinetic_energy_J", "greatest_speed_m/s", "mass_kg", "volume_m3",
                                       "escaped_mass_kg", "greatest_density_error"});
    if (simulation.heat())
        columns.insert(columns.end(),
                       {"stored_energy_J", "laser_absorbed_J", "lost_energy_J", "highest_temperature_K"});
    return columns;
}

} // namespace

Recorder::Recorder(Simulation& simulation, const RecorderOptions& options)
    : simulation_(simulation), options_(with_resumable(options)),
      folder_(open_run_folder(options_.folder, options_.resume)),
      log_(open_run_log(folder_.log(), options_.resume)), provenance_{code_identity(),
                                                                      simulation.scene().definition.name,
                                                                      simulation.scene().definition.hash,
                                                                      simulation.scene().definition.resolved.dump()}
{
    guards_.emplace(simulation_.particles(), guard_limits());
    if (simulation_.flow() && MomentumBooks::can_tell(simulation_.scene().definition)) momentum_.emplace();
    checkpoints_.emplace(folder_.checkpoints(), provenance_,
                         std::chrono::duration<double>(options_.seconds_between_checkpoints));
    const auto checkpoint = options_.resume ? newest_checkpoint(folder_.checkpoints()) : std::nullopt;
    if (checkpoint)
        resume(*checkpoint);
    else
        begin();
    announce();
}

void Recorder::begin()
{
    simulation_.start();
    fields_.emplace(folder_.fields(), provenance_);
    history_.emplace(folder_.history(), history_columns(simulation_));
    progress_.emplace(simulation_.scene().definition.time.end);
    cost_.emplace();
    const double mass = total_mass(), volume = primary_volume();
    mass_ = {mass, mass, 0.0, 0.0, mass};
    volume_ = {volume, volume, 0.0, 0.0, volume};
    if (momentum_) momentum_->begin(simulation_.particles());
    add_history_row();
    write_snapshot_now();
    // The first checkpoint waits until it is due: whatever is met before that, a run's start can be made again.
    settle();
}

/// Takes up a checkpoint's state, and returns it.
RunState Recorder::load(const std::filesystem::path& file)
{
    LoadedCheckpoint loaded = load_checkpoint(file, provenance_, simulation_.particles());
    const auto& numbers = loaded.state.numbers;
    simulation_.load(numbers);
    settle();
    mass_ = load_ledger("mass", numbers);
    volume_ = load_ledger("volume", numbers);
    if (momentum_) momentum_->load(numbers);
    greatest_volume_error_ = numbers.at("recorder.greatest_volume_error");
    next_output_ = static_cast<std::uint64_t>(numbers.at("recorder.next_output"));
    return std::move(loaded.state);
}

void Recorder::resume(const std::filesystem::path& file)
{
    const RunState state = load(file);
    const auto& numbers = state.numbers;
    const double wall = numbers.at("recorder.wall_s"), cpu = numbers.at("recorder.cpu_s");
    output_seconds_ = numbers.at("recorder.output_s");
    guard_seconds_ = numbers.at("recorder.guards_s");
    fields_.emplace(folder_.fields(), provenance_,
                    SnapshotList{state.arrays.at("snapshots.times"), state.arrays.at("snapshots.numbers")});
    history_.emplace(folder_.history(), history_columns(simulation_), simulation_.time());
    progress_.emplace(simulation_.scene().definition.time.end, wall);
    cost_.emplace(wall, cpu);
    log_->info("resumed from {} at t = {:.6g} s, step {}", file.filename().string(), simulation_.time(),
               simulation_.steps());
    if (simulation_.time() >= simulation_.scene().definition.time.end) ending_ = Ending::completed;
}

/// What was derived from the case, so that a reader of the log sees which numbers the run had.
void Recorder::announce() const
{
    const Scene& scene = simulation_.scene();
    log_->info("case {} at level {}: {} particles, spacing {:.4g} m, {} threads, engine {}", scene.definition.name,
               scene.definition.level, scene.particles->count(), scene.spacing, options_.threads, engine_name);
    if (simulation_.flow()) {
        const FlowParameters& parameters = simulation_.parameters();
        log_->info("greatest expected speed {:.4g} m/s (from {}), sound speed {:.4g} m/s", parameters.reference_speed,
                   parameters.reference_speed_from, parameters.equation_of_state.sound_speed);
    }
    for (const auto& [name, limit] : simulation_.limits())
        log_->info("time step limit {}: {:.4g} s", name, limit);
    if (simulation_.heat()) log_->info("time step limit thermal: {:.4g} s", simulation_.heat()->stable_time_step());
}

double Recorder::output_time(std::uint64_t number) const
{
    const TimeSpan& time = simulation_.scene().definition.time;
    const double due = static_cast<double>(number) * time.output_interval;
    // The last interval may be shorter; one that would end within a hair of the end ends with it.
    return due > time.end - 1e-9 * time.output_interval ? time.end : due;
}

/// The longest step that does not pass the next output, s.
double Recorder::longest_step() const
{
    return output_time(next_output_) - simulation_.time();
}

/// The places where a checkpoint can be, whatever the clock says.
void Recorder::settle()
{
    simulation_.settle();
    settled_step_ = simulation_.steps();
}

void Recorder::step()
{
    if (const auto problem = simulate()) return stop(*problem);
    fields_->check();
    if (output_is_due()) {
        write_snapshot_now();
        if (output_time(next_output_) >= simulation_.scene().definition.time.end) ending_ = Ending::completed;
        ++next_output_;
    }
    if (history_is_due()) add_history_row();
    if (simulation_.due_to_settle()) {
        settle();
        if (!ending_ && (stop_requested() || checkpoints_->due())) write_checkpoint();
        if (!ending_ && stop_requested()) ending_ = Ending::interrupted;
    }
    const TimedScope timed(output_seconds_);
    progress_->update(simulation_.time(), simulation_.steps());
}

/// Walls and solids carry the velocity that stands for their boundary condition; what is seen of them is at rest.
void Recorder::bring_standing_to_rest(Particles& particles)
{
    const ScalarField& mobility = particles.scalar("mobility");
    for (Index i = 0; i < particles.count(); ++i)
        if (mobility[i] == 0.0) particles.velocity.set(i, {});
}

void Recorder::write_snapshot_now()
{
    const TimedScope timed(output_seconds_);
    bring_standing_to_rest(simulation_.particles());
    fields_->write(simulation_.particles(), simulation_.time());
}

/// What a checkpoint keeps beside the particles.
RunState Recorder::state_of(const Simulation& simulation)
{
    RunState state;
    state.time = simulation.time();
    state.step = simulation.steps();
    simulation.save(state.numbers);
    save_ledger("mass", mass_, state.numbers);
    save_ledger("volume", volume_, state.numbers);
    if (momentum_) momentum_->save(state.numbers);
    state.numbers["recorder.greatest_volume_error"] = greatest_volume_error_;
    state.numbers["recorder.next_output"] = static_cast<double>(next_output_);
    state.numbers["recorder.wall_s"] = cost_->wall_seconds();
    state.numbers["recorder.cpu_s"] = cost_->cpu_seconds();
    state.numbers["recorder.output_s"] = output_seconds_;
    state.numbers["recorder.guards_s"] = guard_seconds_;
    const SnapshotList snapshots = fields_->until(state.time);
    state.arrays["snapshots.times"] = snapshots.times;
    state.arrays["snapshots.numbers"] = snapshots.numbers;
    return state;
}

/// Puts rows and snapshots on the disk, with one wait for it or, if that is left for later, none.
void Recorder::flush_output(Flush when)
{
    history_->flush(Flush::later);
    fields_->flush(history_->path(), when);
}

/// Whether a run that ends waits until what it wrote is on the disk. The wait (2 to 30 ms, a commit of the file
/// system's journal) guards against a loss of power within the next seconds; a short run is sooner made again.
Flush Recorder::flush_at_end() const
{
    constexpr double worth_the_wait = 0.5; // s: with the longest such wait, output takes about 5 % of a run
    return cost_->wall_seconds() < worth_the_wait ? Flush::later : Flush::now;
}

void Recorder::write_checkpoint()
{
    const TimedScope timed(output_seconds_);
    flush_output();
    const RunState state = state_of(simulation_);
    checkpoints_->write(simulation_.particles(), state);
}

/// A checkpoint of the run's start, which is placed once more: the same bits, since nothing in it depends on the clock.
std::filesystem::path Recorder::write_start()
{
    Simulation start(place_particles(simulation_.scene().definition));
    start.start();
    bring_standing_to_rest(start.particles()); // as before the first snapshot
    start.settle();
    mass_.end = mass_.start;
    volume_.end = volume_.start;
    if (momentum_) momentum_->begin(start.particles());
    greatest_volume_error_ = 0.0;
    next_output_ = 1;
    return checkpoints_->write(start.particles(), state_of(start));
}

double Recorder::total_mass() const
{
    const Particles& particles = simulation_.particles();
    return ordered_sum(particles.count(), [&](Index i) {
        return particles.kind[static_cast<std::size_t>(i)] == Kind::wall ? 0.0 : particles.mass[i];
    });
}

double Recorder::greatest_density_error_now() const
{
    const Particles& particles = simulation_.particles();
    double greatest = 0.0;
    for (const Index i : simulation_.neighbourhood().moving_particles()) {
        const Material& material = simulation_.scene().materials[particles.material[static_cast<std::size_t>(i)]];
        greatest = std::max(greatest, std::abs(particles.density[i] / material.density - 1.0));
    }
    return greatest;
}

double Recorder::primary_volume() const
{
    const Particles& particles = simulation_.particles();
    return ordered_sum(particles.count(), [&](Index i) {
        const auto k = static_cast<std::size_t>(i);
        const bool counts = particles.kind[k] != Kind::wall && particles.material[k] == 0;
        return counts ? particles.volume[i] : 0.0;
    });
}

void Recorder::update_books()
{
    if (!simulation_.flow()) return;
    mass_.end = total_mass();
    volume_.end = primary_volume();
    if (momentum_) {
        const Particles& particles = simulation_.particles();
        momentum_->update(particles,
                          simulation_.neighbourhood().meets_what_stands(particles, particles.scalar("mobility")));
    }
}

void Recorder::add_history_row()
{
    const TimedScope timed(output_seconds_);
    update_books();
    const Particles& particles = simulation_.particles();
    std::vector<double> row{simulation_.time(), static_cast<double>(simulation_.steps()), simulation_.last_time_step(),
                            static_cast<double>(simulation_.neighbourhood().moving_particles().size())};
    if (simulation_.flow()) {
        const auto& moving = simulation_.neighbourhood().moving_particles();
        double greatest = 0.0;
        for (const Index i : moving)
            greatest = std::max(greatest, dot(particles.velocity[i], particles.velocity[i]));
        const double kinetic = ordered_sum(static_cast<Index>(moving.size()), [&](Index m) {
            const Index i = moving[static_cast<std::size_t>(m)];
            const Vector v = particles.velocity[i];
            return 0.5 * particles.mass[i] * dot(v, v);
        });
        row.insert(row.end(), {kinetic, std::sqrt(greatest), mass_.end, volume_.end, simulation_.escaped_mass(),
                               greatest_density_error_now()});
    }
    if (const ThermalStep* heat = simulation_.heat()) {
        const HeatBooks& books = heat->books();
        row.insert(row.end(),
                   {heat->stored_energy(), books.laser_absorbed, books.evaporation + books.radiation + books.convection,
                    heat->temperature_range().highest});
    }
    history_->add(row);
}

RunCost Recorder::cost_so_far() const
{
    RunCost cost;
    cost.threads = options_.threads;
    cost.steps = simulation_.steps();
    cost.acoustic_steps = simulation_.sound_steps();
    cost.elements = static_cast<std::uint64_t>(simulation_.particles().count());
    cost.element_updates = static_cast<double>(simulation_.updates());
    cost.time_step_binding = simulation_.binding_limits();
    cost.output_seconds = output_seconds_;
    cost.guard_seconds = guard_seconds_;
    cost.measure(*cost_);
    return cost;
}

Ending Recorder::finish()
{
    // A step may already have its row; a stopped run ends with that of its last good state.
    if (*ending_ == Ending::completed && !history_is_due()) add_history_row();
    const Flush flush = flush_at_end(); // once: the record of a run is not on the disk for sure before the run's output
    {
        const TimedScope timed(output_seconds_);
        flush_output(flush);
    }
    progress_->write(simulation_.time(), simulation_.steps());
    if (*ending_ == Ending::interrupted) {
        log_->warn("interrupted at t = {:.6g} s; a checkpoint is kept, go on with --resume", simulation_.time());
        return *ending_;
    }
    RunRecord record;
    record.provenance = provenance_;
    record.settings = simulation_.scene().definition.resolved;
    record.variant = options_.folder.filename().string();
    record.status = *ending_ == Ending::completed ? RunStatus::completed : RunStatus::stopped;
    record.diagnosis = diagnosis_;
    record.ledgers["mass"] = mass_;
    record.ledgers["volume"] = volume_;
    if (const auto momentum = momentum_ ? momentum_->ledger() : std::nullopt) record.ledgers["momentum"] = *momentum;
    record.ledger_details["volume"]["greatest_error"] = greatest_volume_error_;
    if (simulation_.flow()) {
        record.ledgers["mechanical_energy"] = simulation_.mechanical_ledger();
        record.ledger_details["mechanical_energy"] = simulation_.flow()->books().details();
    }
    if (const ThermalStep* heat = simulation_.heat()) {
        record.ledgers["energy"] = heat->ledger();
        const HeatBooks& books = heat->books();
        record.ledger_details["energy"] = {
            {"laser_emitted", books.laser_emitted},   {"laser_hit", books.laser_hit},
            {"laser_absorbed", books.laser_absorbed}, {"absorbed_error", heat->laser_absorption_error()},
            {"evaporation", books.evaporation},       {"radiation", books.radiation},
            {"convection", books.convection}};
    }
    record.cost = *ending_ == Ending::stopped ? cost_when_stopped_ : cost_so_far();
    write_record(folder_.record(), record, flush);
    log_->info("{} after {} steps, {:.1f} CPU s", *ending_ == Ending::completed ? "completed" : "stopped",
               record.cost.steps, record.cost.cpu_seconds);
    return *ending_;
}

} // namespace cupel::inline CUPEL_ENGINE
