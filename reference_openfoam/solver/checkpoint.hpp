/// Leaving and finding restartable states: a folder of fields for each output time, marked complete once it is.
#pragma once

#include <string>

#include "ledgers.hpp"
#include "time_step.hpp"

namespace cupel
{
/// From here on SIGINT, SIGTERM and SIGUSR1 (which mpirun passes on) ask the run to stop after the present step.
void install_stop_signals();
bool stop_requested();

/// State of the run that no field holds.
struct RunState
{
    label steps = 0;
    scalar wall_seconds = 0, cpu_seconds = 0; ///< of earlier runs that this one goes on from
    scalar next_row = -GREAT;                 ///< when the history's next row is due [s]
};

/// Writes all fields and the run's state at the present time, then the mark `complete` that lists every file with its
/// size.
void write_checkpoint(Time& clock, const fvMesh& mesh, const Ledgers& ledgers, const TimeStep& time_step,
                      const RunState& state);

/// Takes the state back from the folder that the clock started from, and sets the clock to the exact time (the folder's
/// name is rounded). False if the run starts afresh.
bool restore_checkpoint(Time& clock, const fvMesh& mesh, Ledgers& ledgers, TimeStep& time_step, RunState& state);
} // namespace cupel
