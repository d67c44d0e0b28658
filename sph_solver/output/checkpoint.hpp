/// Checkpoints: all that a run needs to go on as if it had never stopped, bit for bit.
///
/// An HDF5 file (h5dump and h5py open it) whose user block, the first 512 bytes, is a text that is checked before the
/// HDF5 library sees the rest:
///
///     Cupel checkpoint
///     format 2
///     version 0.1.0
///     commit 0123456789ab
///     case <hash of the resolved case>
///     size <bytes of the whole file>
///     checksum <CRC-32 of the whole file with these eight digits taken as zeros>
///
/// Then /particles/scalars/NAME [count], /particles/vectors/NAME [3 × count], /particles/{kind,material,identity,
/// surface_parent} [count], /arrays/NAME, the attributes of /numbers, and /resolved_case. SI units throughout.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "output/atomic_file.hpp"
#include "output/code_identity.hpp"
#include "particles/particles.hpp"

namespace cupel
{

/// What a run's state has beside its particles.
struct RunState
{
    double time = 0;                                   ///< simulated [s]
    std::uint64_t step = 0;                            ///< number of the step that led to `time`
    std::map<std::string, double> numbers;             ///< clocks and ledgers; names without '/'
    std::map<std::string, std::vector<double>> arrays; ///< what is longer than a number; names without '/'
};

struct LoadedCheckpoint
{
    RunState state;
    std::string commit; ///< that wrote it; where it is not this program's, bits may differ from an unbroken run
};

/// Writes every registered field of the particles, their kinds, materials and identities, and the state, whole or not
/// at all. Throws OutputError.
void save_checkpoint(const std::filesystem::path& file, const Provenance& provenance, const Particles& particles,
                     const RunState& state);

/// Puts a checkpoint's particles into `particles`, in which the same fields have to be registered and which is not
/// touched where the checkpoint is refused. Throws OutputError where the file is missing, truncated or damaged, where
/// another version of the code or another case wrote it, or where its particles or fields are not those of the scene.
LoadedCheckpoint load_checkpoint(const std::filesystem::path& file, const Provenance& provenance, Particles& particles);

/// The checkpoint of the highest step in a folder, if there is one. Throws OutputError where it cannot be read.
std::optional<std::filesystem::path> newest_checkpoint(const std::filesystem::path& folder);

/// A run's folder of checkpoints: the last two are kept, so that there is one whatever happens to the other.
class Checkpoints
{
public:
    /// The folder has to exist. A checkpoint is due after `interval` of wall time, or later where writing one takes
    /// more than one in a hundred parts of that.
    Checkpoints(std::filesystem::path folder, Provenance provenance,
                std::chrono::duration<double> interval = std::chrono::seconds(60));

    /// Whether the next checkpoint is due.
    bool due() const;

    /// Writes FOLDER/checkpoint_<step>.h5, then removes all but the last two; returns its path. Throws OutputError,
    /// with the earlier checkpoints as they were.
    std::filesystem::path write(const Particles& particles, const RunState& state);

private:
    using Clock = std::chrono::steady_clock;

    std::filesystem::path folder_;
    Provenance provenance_;
    std::chrono::duration<double> interval_;
    std::chrono::duration<double> last_cost_{0};
    Clock::time_point last_ = Clock::now();
};

} // namespace cupel
