/// What a VTK file shows of the particles at one moment.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "output/atomic_file.hpp"
#include "output/code_identity.hpp"
#include "particles/particles.hpp"

namespace cupel
{

/// A copy of all particles but those of walls, so that they can move on while it is written.
class Snapshot
{
public:
    struct Field
    {
        std::string name;
        int components;            ///< 1 or 3, side by side
        std::vector<float> values; ///< [components × count]
    };

    /// Takes the state at a time [s], in the memory of the one taken before.
    void take(const Particles& particles, double time);

    std::size_t count() const { return positions_.size() / 3; }
    double time() const { return time_; } ///< s
    /// [3 × count], m.
    const std::vector<double>& positions() const { return positions_; }
    /// Every field registered with Output::yes, scalars first, then `fraction`: 1 in the primary material, 0 in the
    /// surrounding.
    const std::vector<Field>& fields() const { return fields_; }

private:
    double time_ = 0.0;
    std::vector<Index> shown_;
    std::vector<double> positions_;
    std::vector<Field> fields_;
};

/// Writes vertices into a .vtp file (compressed, whole or not at all): positions in double [m], fields in float, and as
/// field data TimeValue [s], code version, commit, case, its hash and the resolved case. Throws OutputError. It uses
/// the VTK library, as only one thread may at a time.
void write_snapshot(const std::filesystem::path& file, const Snapshot& snapshot, const Provenance& provenance,
                    Flush flush = Flush::now);

/// The same of the particles as they are.
void write_snapshot(const std::filesystem::path& file, const Particles& particles, double time,
                    const Provenance& provenance, Flush flush = Flush::now);

} // namespace cupel
