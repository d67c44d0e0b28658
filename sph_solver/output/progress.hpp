/// Progress of a run for whoever started it: one JSON object a line, about once a second.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>

namespace cupel
{

/// Writes lines such as {"progress":{"time":0.0012,"end":0.0067,"step":1234,"wall_s":12.3}}.
class Progress
{
public:
    /// `end` is the simulated time at which the run is complete [s]; `wall_before` the wall time that earlier parts of
    /// a resumed run took [s].
    explicit Progress(double end, double wall_before = 0.0, std::FILE* stream = stdout,
                      std::chrono::milliseconds interval = std::chrono::milliseconds(1000));

    /// Writes a line if the last one is at least the interval ago; true if it did. A reader that has gone is no error.
    bool update(double time, std::uint64_t step);
    /// Writes a line in any case: the last one of a run.
    void write(double time, std::uint64_t step);

private:
    using Clock = std::chrono::steady_clock;

    double end_, wall_before_;
    std::FILE* stream_;
    std::chrono::milliseconds interval_;
    Clock::time_point start_, last_;
};

} // namespace cupel
