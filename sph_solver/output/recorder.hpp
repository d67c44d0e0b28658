/// Everything that a run leaves behind, at the steps where it is due.
#pragma once

#include <memory>
#include <optional>

#include <spdlog/logger.h>

#include "integrators/simulation.hpp"
#include "ledgers/guards.hpp"
#include "ledgers/momentum_books.hpp"
#include "output/checkpoint.hpp"
#include "output/history.hpp"
#include "output/progress.hpp"
#include "output/recorder_options.hpp"
#include "output/run_folder.hpp"
#include "output/run_record.hpp"
#include "output/vtk_series.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Opens a run's folder, takes up its newest checkpoint where it is to be resumed, and writes snapshots at multiples of
/// the output interval, rows of history, checkpoints, progress, and at the end the record.
class Recorder
{
public:
    /// Throws OutputError or CaseError; a run that is refused so has computed nothing.
    Recorder(Simulation& simulation, const RecorderOptions& options);

    /// Whether the case's end is reached, a guard stopped the run, or a signal asked for its end and a checkpoint of
    /// that is written.
    bool finished() const { return ending_.has_value(); }

    /// A step of the simulation, then guards, output and checkpoints where they are due. Throws OutputError.
    void step();

    /// Writes the record where the run completed or stopped; says how it ended. Throws OutputError.
    Ending finish();

private:
    static constexpr std::uint64_t steps_between_history_rows = 50;

    GuardLimits guard_limits() const;
    void begin();
    void resume(const std::filesystem::path& checkpoint);
    RunState load(const std::filesystem::path& checkpoint);
    void announce() const;
    std::optional<Diagnosis> simulate();
    std::optional<Diagnosis> problem_after_step(bool round_complete);
    bool output_is_due() const { return simulation_.last_binding() == "output"; }
    bool history_is_due() const { return simulation_.steps() % steps_between_history_rows == 0; }
    void settle();
    static void bring_standing_to_rest(Particles& particles);
    void write_snapshot_now();
    RunState state_of(const Simulation& simulation);
    void flush_output(Flush when = Flush::now);
    Flush flush_at_end() const;
    void write_checkpoint();
    std::filesystem::path write_start();
    void update_books();
    void add_history_row();
    void stop(const Diagnosis& diagnosis);
    void return_to_last_good_state();
    RunCost cost_so_far() const;
    double longest_step() const;
    double output_time(std::uint64_t number) const;
    double primary_volume() const;
    double total_mass() const;
    double greatest_density_error_now() const;

    Simulation& simulation_;
    RecorderOptions options_;
    RunFolder folder_;
    std::shared_ptr<spdlog::logger> log_;
    Provenance provenance_;
    std::optional<VtkSeries> fields_;
    std::optional<History> history_;
    std::optional<Checkpoints> checkpoints_;
    std::optional<Progress> progress_;
    std::optional<CostMeter> cost_;
    std::optional<Guards> guards_;
    Ledger mass_, volume_;
    std::optional<MomentumBooks> momentum_; ///< where nothing outside acts on the scene
    double greatest_volume_error_ = 0.0;
    double output_seconds_ = 0.0, guard_seconds_ = 0.0; ///< of wall time
    std::uint64_t next_output_ = 1;
    std::uint64_t step_ = 0;         ///< number of the step under way or just made
    std::uint64_t settled_step_ = 0; ///< of the last one after which the run settled
    std::optional<Ending> ending_;
    std::string diagnosis_;
    RunCost cost_when_stopped_;
};

} // namespace cupel::inline CUPEL_ENGINE
