#pragma once

#include <string>
#include <vector>

#include "output/recorder_options.hpp"
#include "scene/case.hpp"

namespace cupel
{

/// The solver compiled for one instruction set, in one precision of pair arithmetic (math/lanes.hpp). All of them are
/// in the program; their results agree to round-off.
struct Engine
{
    std::string instructions; ///< "avx512", "avx2" or "portable"
    std::string precision;    ///< "double" or "float"
    Ending (*run)(const Case&, const RecorderOptions&);
};

/// The instruction sets of this program that this machine has, the fastest first.
std::vector<std::string> available_instructions();

/// The engine for a precision and an instruction set; an empty one stands for the fastest. Throws CaseError where this
/// machine does not have it.
Engine choose_engine(const std::string& precision, const std::string& instructions);

} // namespace cupel
