/// Where an output comes from: every file that a run writes bears it.
#pragma once

#include <string>

namespace cupel
{

/// The code that this program was built from.
struct CodeIdentity
{
    std::string version; ///< e.g. "0.1.0"
    std::string commit;  ///< abbreviated, with "+changes" where the sources differed from it
};

/// Of this build.
CodeIdentity code_identity();

/// The code and the case of a run.
struct Provenance
{
    CodeIdentity code;
    std::string case_name;
    std::string case_hash;     ///< of the resolved case
    std::string resolved_case; ///< the resolved case as JSON text
};

} // namespace cupel
