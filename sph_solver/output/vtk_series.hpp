/// Snapshots of the particles for ParaView and for the measures: VTK XML poly data, collected in a PVD series.
#pragma once

#include <filesystem>
#include <optional>
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
                    const Provenance& provenance);

/// FOLDER/fields_000000.vtp and so on, and FOLDER/fields.pvd, which lists the whole ones with their times.
class VtkSeries
{
public:
    /// The folder has to exist. Without `resume_time` an empty series; with it [s] the snapshots up to that time that
    /// are still there stay in the series, and later ones are removed. Throws OutputError.
    VtkSeries(std::filesystem::path folder, Provenance provenance, std::optional<double> resume_time = {});

    /// Adds a snapshot; one of the same time, which a resumed run may meet again, is replaced. Times have to rise
    /// (std::logic_error). Throws OutputError.
    void write(const Particles& particles, double time);

    /// Number of snapshots.
    std::size_t size() const { return entries_.size(); }

private:
    void write_list() const;

    std::filesystem::path folder_;
    Provenance provenance_;
    std::vector<std::pair<double, std::string>> entries_; ///< time [s] and file name
    int next_number_ = 0;
};

} // namespace cupel
