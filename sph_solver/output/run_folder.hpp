/// The places of a run's outputs below its folder, made ready before the run.
#pragma once

#include <filesystem>

namespace cupel
{

struct RunFolder
{
    std::filesystem::path folder;

    std::filesystem::path fields() const { return folder / "fields"; }
    std::filesystem::path checkpoints() const { return folder / "checkpoints"; }
    std::filesystem::path history() const { return folder / "history.csv"; }
    std::filesystem::path log() const { return folder / "log.txt"; }
    std::filesystem::path record() const { return folder / "run.json"; }
    /// The particles as they were when a guard stopped the run, and the last state that all guards had passed.
    std::filesystem::path stopped_fields() const { return fields() / "stopped.vtp"; }
    std::filesystem::path last_good_fields() const { return fields() / "last_good.vtp"; }
};

/// Makes the folders, and removes the record of an earlier run first of all, so that nothing of it can be taken for
/// this one's. A new run (not `resume`) also removes the earlier one's fields, checkpoints, history and log; files of
/// other names stay. Throws OutputError where the folder cannot be made or written.
RunFolder open_run_folder(const std::filesystem::path& folder, bool resume);

} // namespace cupel
