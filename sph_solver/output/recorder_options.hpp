#pragma once

#include <filesystem>

namespace cupel
{

struct RecorderOptions
{
    std::filesystem::path folder;
    bool resume = false;
    int threads = 1;
    double seconds_between_checkpoints = 60.0; ///< by the clock on the wall; a checkpoint waits for a step that settles
};

/// How a run ended; the value is the program's exit status.
enum class Ending { completed = 0, stopped = 1, interrupted = 130 };

} // namespace cupel
