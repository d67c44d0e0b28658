#include "output/vtk_series.hpp"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>

namespace cupel
{

namespace
{

namespace fs = std::filesystem;

/// So many snapshots may be taken and not yet written, and if there is more than one, particles of so many bytes: a few
/// small ones may come at a time when the machine has no processor left for another thread.
constexpr std::size_t most_under_way = 8, bytes_under_way = 16 << 20;

constexpr const char* list_name = "fields.pvd";

std::string file_name(int number)
{
    return fmt::format("fields_{:06}.vtp", number);
}

/// −1 where the name is not that of a snapshot.
int number_of(const std::string& name)
{
    int number = -1;
    const bool matched = std::sscanf(name.c_str(), "fields_%d.vtp", &number) == 1;
    return matched && name == file_name(number) ? number : -1;
}

} // namespace

VtkSeries::VtkSeries(fs::path folder, Provenance provenance, const SnapshotList& earlier)
    : folder_(std::move(folder)), provenance_(std::move(provenance)),
      last_time_(-std::numeric_limits<double>::infinity())
{
    for (std::size_t k = 0; k < earlier.times.size(); ++k) {
        const int number = static_cast<int>(earlier.numbers[k]);
        const std::string name = file_name(number);
        next_number_ = number + 1;
        if (!fs::exists(folder_ / name)) continue;
        entries_.emplace_back(earlier.times[k], name);
        last_time_ = earlier.times[k];
    }
    remove_unlisted();
    write_list();
}

VtkSeries::~VtkSeries()
{
    // A run that ends by an error leaves a list of all that is there.
    try {
        writer_.wait();
    }
    catch (const std::exception&) { // that error, or another that came first
    }
    try {
        if (listed_ != entries_.size()) write_list();
    }
    catch (const OutputError&) {
    }
}

void VtkSeries::remove_unlisted() const
{
    std::error_code error;
    for (fs::directory_iterator file(folder_, error), end; !error && file != end; file.increment(error)) {
        const std::string name = file->path().filename().string();
        const auto listed = [&](const auto& entry) { return entry.second == name; };
        const bool snapshot = number_of(name) >= 0 && std::none_of(entries_.begin(), entries_.end(), listed);
        if (snapshot || name.ends_with(".beside")) remove_file(file->path());
    }
    if (error) throw system_output_error(error.value(), folder_, "read");
}

void VtkSeries::write(const Particles& particles, double time)
{
    if (!(last_time_ < time)) throw std::logic_error("the times of snapshots have to rise");
    if (taken_.empty())
        taken_.resize(std::clamp<std::size_t>(bytes_under_way / (particles.bytes() + 1), 1, most_under_way));
    writer_.wait_for_fewer_than(taken_.size());
    // They are written in the order in which they are taken: the one that was in this place is written.
    Snapshot& snapshot = taken_[written_++ % taken_.size()];
    snapshot.take(particles, time);
    last_time_ = time;
    writer_.add([this, &snapshot] { write_taken(snapshot); });
}

/// The thread's work. The list, which replaces another and so waits for the disk more than a snapshot does, is written
/// now and then, and before anything depends on it.
void VtkSeries::write_taken(const Snapshot& snapshot)
{
    constexpr std::chrono::milliseconds between_lists{100};
    const std::string name = file_name(next_number_);
    write_snapshot(folder_ / name, snapshot, provenance_, Flush::later);
    entries_.emplace_back(snapshot.time(), name);
    unflushed_.push_back(folder_ / name);
    ++next_number_;
    if (std::chrono::steady_clock::now() - list_written_ >= between_lists) write_list();
}

void VtkSeries::flush(const fs::path& other, Flush when)
{
    writer_.wait();
    if (listed_ != entries_.size()) write_list();
    if (when == Flush::later) return;
    // All at once: disks, and the journals of file systems, take as long for one as for several.
    unflushed_.insert(unflushed_.begin(), {folder_ / list_name, other});
    flush_to_disk(unflushed_);
    flush_to_disk(folder_);
    unflushed_.clear();
}

SnapshotList VtkSeries::until(double time)
{
    writer_.wait();
    SnapshotList list;
    for (const auto& [when, name] : entries_)
        if (when <= time) {
            list.times.push_back(when);
            list.numbers.push_back(number_of(name));
        }
    return list;
}

std::size_t VtkSeries::size()
{
    writer_.wait();
    return entries_.size();
}

void VtkSeries::write_list()
{
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
    for (const auto& [time, name] : entries_)
        text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time, name);
    text += "</Collection>\n</VTKFile>\n";
    write_whole(folder_ / list_name, text, Flush::later);
    listed_ = entries_.size();
    list_written_ = std::chrono::steady_clock::now();
}

} // namespace cupel
