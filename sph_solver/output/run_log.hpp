/// The log of a run: everything to log.txt, warnings and errors to stderr as well.
#pragma once

#include <filesystem>
#include <memory>
#include <spdlog/logger.h>

namespace cupel
{

/// Opens FILE anew, or goes on in it where `append`. Lines reach the file at once. A log that cannot be written later
/// (a full disk) is said once on stderr and does not end the run. Throws OutputError where FILE cannot be opened.
std::shared_ptr<spdlog::logger> open_run_log(const std::filesystem::path& file, bool append);

} // namespace cupel
