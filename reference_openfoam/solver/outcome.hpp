/// What a run tells the outside: progress lines, the time history, and at its end the outcome as JSON.
#pragma once

#include <fstream>
#include <string>

#include "checkpoint.hpp"

namespace cupel
{
class Outcome
{
public:
    /// Files go to `folder`, which is there; the history is added to, by the first rank.
    Outcome(const Scene& scene, const Fields& fields, const fileName& folder);

    /// One row of the history about every thousandth of the run, and one line of progress a second.
    void record(scalar step, const Ledgers& ledgers, const EnergyRates& rates, RunState& state);

    /// Wall and processor seconds of this process so far.
    scalar wall_seconds() const;
    scalar cpu_seconds() const;

    /// Writes outcome.json beside its final name, then renames it.
    void finish(const std::string& status, const std::string& diagnosis, const Ledgers& ledgers,
                const TimeStep& time_step, const RunState& state);

    /// The same on one rank whose others may be waiting for it in vain: with the ledgers and the processor time that
    /// all ranks last added up, a second ago or so.
    void finish_alone(const std::string& status, const std::string& diagnosis, const TimeStep& time_step,
                      const RunState& state) const;

private:
    /// What only all ranks together know: collected on each of them.
    struct Sums
    {
        std::string ledgers;
        scalar cpu_seconds = 0;
        label cells = 0;
    };

    void collect(const Ledgers& ledgers, const RunState& state);
    void write(const std::string& status, const std::string& diagnosis, const TimeStep& time_step,
               const RunState& state) const;
    void write_row(scalar step, const Ledgers& ledgers, const EnergyRates& rates);

    const Scene& scene_;
    const Fields& fields_;
    const fileName folder_;
    std::ofstream history_;
    scalar last_progress_, start_seconds_;
    Sums sums_;
};
} // namespace cupel
