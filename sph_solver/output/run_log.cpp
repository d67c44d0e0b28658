#include "output/run_log.hpp"

#include <cstdio>
#include <fcntl.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>

#include "output/atomic_file.hpp"

namespace cupel
{

std::shared_ptr<spdlog::logger> open_run_log(const std::filesystem::path& file, bool append)
{
    // Opened first by hand: the error then says what is wrong and what to do.
    FileDescriptor(file, O_WRONLY | O_CREAT | (append ? O_APPEND : O_TRUNC), "written");
    auto to_file = std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string(), false);
    to_file->set_pattern("%Y-%m-%d %H:%M:%S.%e %l: %v");
    auto to_terminal = std::make_shared<spdlog::sinks::stderr_sink_mt>();
    to_terminal->set_pattern("%l: %v");
    to_terminal->set_level(spdlog::level::warn);

    auto log = std::make_shared<spdlog::logger>("cupel", spdlog::sinks_init_list{to_file, to_terminal});
    log->flush_on(spdlog::level::trace);
    log->set_error_handler([file, said = false](const std::string& reason) mutable {
        if (!said) std::fprintf(stderr, "%s: the log is not complete: %s\n", file.c_str(), reason.c_str());
        said = true;
    });
    return log;
}

} // namespace cupel
