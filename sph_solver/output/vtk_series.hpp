/// Snapshots of the particles for ParaView and for the measures: VTK XML poly data, collected in a PVD series.
#pragma once

#include <chrono>
#include <filesystem>
#include <utility>
#include <vector>

#include "output/background_thread.hpp"
#include "output/snapshot.hpp"

namespace cupel
{

/// What a checkpoint keeps of a series: time [s] and number of each snapshot.
struct SnapshotList
{
    std::vector<double> times, numbers;
};

/// FOLDER/fields_000000.vtp and so on, and FOLDER/fields.pvd, which lists the whole ones with their times (those of the
/// last tenth of a second may be missing while the run is under way).
///
/// A thread of its own writes snapshots while the run goes on, one at a time. The run waits for no more than a copy,
/// and where too many are still to be written for the first of them. What cannot be written is an OutputError of
/// whatever is asked of the series from then on.
///
/// Snapshots are not on the disk for sure until flush(). A checkpoint keeps the list, and flush() comes before it: so
/// whatever a loss of power does to later ones, a resumed run has those that came before its checkpoint and writes the
/// rest again.
class VtkSeries
{
public:
    /// The folder has to exist. Those of `earlier` that are still there begin the series, and all others are removed.
    /// Throws OutputError.
    VtkSeries(std::filesystem::path folder, Provenance provenance, const SnapshotList& earlier = {});
    ~VtkSeries();
    VtkSeries(const VtkSeries&) = delete;
    VtkSeries& operator=(const VtkSeries&) = delete;

    /// Adds a snapshot of the particles as they are now. Times have to rise (std::logic_error). Throws OutputError.
    void write(const Particles& particles, double time);

    /// Throws the OutputError of a snapshot that could not be written, and waits for none.
    void check() { writer_.check(); }

    /// Waits until nothing is under way: from then on until the next write() the VTK library is the caller's. Throws
    /// OutputError.
    void wait() { writer_.wait(); }

    /// Waits until all snapshots and the list of them are written and, unless that is left for later, until they and
    /// another file, if one is given, are on the disk. Throws OutputError.
    void flush(const std::filesystem::path& other = {}, Flush when = Flush::now);

    /// The snapshots up to a time [s]. Throws OutputError.
    SnapshotList until(double time);
    /// Number of snapshots. Throws OutputError.
    std::size_t size();

private:
    void write_taken(const Snapshot& snapshot);
    void write_list();
    void remove_unlisted() const;

    std::filesystem::path folder_;
    Provenance provenance_;
    double last_time_;            ///< of a snapshot, s
    std::vector<Snapshot> taken_; ///< written in turn
    std::size_t written_ = 0;     ///< number of snapshots given to the writer

    // The writer's own while it is at work.
    std::vector<std::pair<double, std::string>> entries_; ///< time [s] and file name
    std::vector<std::filesystem::path> unflushed_;
    int next_number_ = 0;
    std::size_t listed_ = 0; ///< of the entries, in the list as it was last written
    std::chrono::steady_clock::time_point list_written_;

    BackgroundThread writer_; ///< the last member: the first to end
};

} // namespace cupel
