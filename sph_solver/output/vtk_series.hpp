/// Snapshots of the particles for ParaView and for the measures: VTK XML poly data, collected in a PVD series.
#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "output/atomic_file.hpp"
#include "output/code_identity.hpp"
#include "particles/particles.hpp"

namespace cupel
{

/// Writes all particles but those of walls as vertices of a .vtp file (compressed, whole or not at all): positions in
/// double [m]; in float every field registered with Output::yes, under its name, and `fraction` (1 in the primary
/// material, 0 in the surrounding); as field data TimeValue [s], code version, commit, case, its hash and the resolved
/// case. Throws OutputError.
void write_snapshot(const std::filesystem::path& file, const Particles& particles, double time,
                    const Provenance& provenance, Flush flush = Flush::now);

/// What a checkpoint keeps of a series: time [s] and number of each snapshot.
struct SnapshotList
{
    std::vector<double> times, numbers;
};

/// FOLDER/fields_000000.vtp and so on, and FOLDER/fields.pvd, which lists the whole ones with their times.
///
/// Snapshots are not waited for until flush(). A checkpoint keeps the list, and flush() comes before it: so whatever a
/// loss of power does to later ones, a resumed run has those that came before its checkpoint and writes the rest again.
class VtkSeries
{
public:
    /// The folder has to exist. Those of `earlier` that are still there begin the series, and all others are removed.
    /// Throws OutputError.
    VtkSeries(std::filesystem::path folder, Provenance provenance, const SnapshotList& earlier = {});

    /// Adds a snapshot. Times have to rise (std::logic_error). Throws OutputError.
    void write(const Particles& particles, double time);

    /// Waits until all snapshots and the list of them are on the disk. Throws OutputError.
    void flush();

    /// The snapshots up to a time [s].
    SnapshotList until(double time) const;
    /// Number of snapshots.
    std::size_t size() const { return entries_.size(); }

private:
    void write_list() const;
    void remove_unlisted() const;

    std::filesystem::path folder_;
    Provenance provenance_;
    std::vector<std::pair<double, std::string>> entries_; ///< time [s] and file name
    std::vector<std::string> unflushed_;                  ///< file names
    int next_number_ = 0;
};

} // namespace cupel
