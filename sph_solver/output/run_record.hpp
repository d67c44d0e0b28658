/// run.json: what a run was, how it ended, its ledgers and what it cost.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "ledgers/ledger.hpp"
#include "output/atomic_file.hpp"
#include "output/code_identity.hpp"

namespace cupel
{

/// Wall and processor time since its construction, with what earlier parts of a resumed run took.
class CostMeter
{
public:
    explicit CostMeter(double wall_before = 0.0, double cpu_before = 0.0);

    double wall_seconds() const;
    /// User and system time of all threads of this process.
    double cpu_seconds() const;
    /// Greatest resident memory of this process so far.
    static double peak_bytes();

private:
    using Clock = std::chrono::steady_clock;

    double wall_before_, cpu_before_;
    Clock::time_point start_ = Clock::now();
};

/// Adds the wall time from its construction to the end of its scope to a sum, s. It costs two looks at the clock.
class TimedScope
{
public:
    explicit TimedScope(double& seconds) : seconds_(seconds) {}
    ~TimedScope() { seconds_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
    TimedScope(const TimedScope&) = delete;
    TimedScope& operator=(const TimedScope&) = delete;

private:
    using Clock = std::chrono::steady_clock;

    double& seconds_;
    Clock::time_point start_ = Clock::now();
};

struct RunCost
{
    double wall_seconds = 0;
    double cpu_seconds = 0;
    double output_seconds = 0; ///< of the wall time: for how long output held the run up
    double guard_seconds = 0;  ///< of the wall time: the guards
    int threads = 1;
    std::uint64_t steps = 0;
    std::uint64_t acoustic_steps = 0; ///< of sound: as many as steps of the flow, or a few times as many
    std::uint64_t elements = 0;       ///< particles
    double element_updates = 0;       ///< sum of the particles updated in each step of sound or of heat
    double peak_bytes = 0;
    std::map<std::string, std::uint64_t> time_step_binding; ///< criterion → number of steps that it bound

    /// Times of the meter and the peak of memory.
    void measure(const CostMeter& meter);
};

enum class RunStatus { completed, stopped };

struct RunRecord
{
    Provenance provenance;
    nlohmann::json settings; ///< the resolved case
    std::string variant;     ///< e.g. the level "coarse"
    RunStatus status = RunStatus::completed;
    std::string diagnosis;                 ///< one line; empty where the run completed
    std::map<std::string, Ledger> ledgers; ///< those that the scene has: mass, momentum, energy, volume
    std::map<std::string, std::map<std::string, double>>
        ledger_details; ///< more of a ledger, e.g. energy → laser_absorbed
    RunCost cost;
};

/// The content of run.json. A number that is not finite becomes null.
nlohmann::ordered_json record_as_json(const RunRecord& record);

/// Writes the record, whole or not at all: the last file that a run writes. Throws OutputError.
void write_record(const std::filesystem::path& file, const RunRecord& record, Flush flush = Flush::now);

} // namespace cupel
