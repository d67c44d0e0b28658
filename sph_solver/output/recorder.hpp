/// Everything that a run leaves behind, at the steps where it is due.
#pragma once

#include <memory>
#include <optional>

#include <spdlog/logger.h>

#include "integrators/simulation.hpp"
#include "ledgers/guards.hpp"
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

    /// The longest step that does not pass the next output, s.
    double longest_step() const;

    /// After each step: guards, output, checkpoints. Throws OutputError.
    void after_step();

    /// Writes the record where the run completed or stopped; says how it ended. Throws OutputError.
    Ending finish();

private:
    void begin();
    void resume(const std::filesystem::path& checkpoint);
    void announce() const;
    void write_snapshot_now();
    void write_checkpoint();
    void add_history_row();
    void stop(const Diagnosis& diagnosis);
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
    double greatest_volume_error_ = 0.0;
    std::uint64_t next_output_ = 1;
    std::optional<Ending> ending_;
    std::string diagnosis_;
};

} // namespace cupel::inline CUPEL_ENGINE
