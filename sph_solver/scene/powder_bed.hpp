/// The spheres of a powder bed, as ./cupel bed leaves them.
#pragma once

#include "scene/case.hpp"

#include <string>
#include <vector>

namespace cupel
{

struct Grain
{
    Vector3 center{};  ///< [m], the plate's surface at z = 0
    double radius = 0; ///< [m]
};

/// Reads lines "x,y,z,radius" in metres; lines that begin with '#' and the line of column names are skipped.
/// Throws CaseError "FILE:LINE:COLUMN: ..." where the file is missing or a line is no sphere.
std::vector<Grain> read_powder_bed(const std::string& path);

} // namespace cupel
