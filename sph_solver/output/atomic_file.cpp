#include "output/atomic_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <future>
#include <sys/stat.h>
#include <unistd.h>

namespace cupel
{

namespace fs = std::filesystem;

OutputError system_output_error(int error_number, const fs::path& path, std::string_view action)
{
    const auto line = [&](std::string_view reason, std::string_view remedy) {
        return OutputError(fmt::format("{}: cannot be {}: {}; {}", path.string(), action, reason, remedy));
    };
    switch (error_number) {
    case ENOSPC:
    case EDQUOT:
        return line("the disk is full", "free some space, then go on with --resume");
    case EFBIG:
        return line("the file would be larger than this process may write", "raise the limit (ulimit -f)");
    case EROFS:
    case EACCES:
    case EPERM:
        return line("writing there is not permitted", "make the folder writable or choose another --output folder");
    case ENOENT:
        return line("the folder or file is not there (removed or never made)",
                    "restore it or choose another --output folder");
    case ENOTDIR:
        return line("a part of its path is a file, not a folder", "choose another --output folder");
    case EIO:
        return line("the device reports an error", "check the disk or choose another --output folder");
    default:
        return line(std::strerror(error_number), "choose another --output folder");
    }
}

FileDescriptor::FileDescriptor(const fs::path& path, int flags, std::string_view action, fs::path shown_path)
    : shown_path_(std::move(shown_path)), number_(::open(path.c_str(), flags | O_CLOEXEC, 0666))
{
    if (number_ < 0) throw system_output_error(errno, shown_path_, action);
}

FileDescriptor::~FileDescriptor()
{
    ::close(number_);
}

void FileDescriptor::write(std::string_view content)
{
    while (!content.empty()) {
        const auto written = ::write(number_, content.data(), content.size());
        if (written > 0)
            content.remove_prefix(static_cast<std::size_t>(written));
        else if (written < 0 && errno != EINTR)
            throw system_output_error(errno, shown_path_, "written");
    }
}

void FileDescriptor::flush()
{
    while (::fsync(number_) != 0) {
        if (errno == EINTR) continue;
        if (errno == EINVAL) return; // a pipe or a special file, which has no disk to flush to
        throw system_output_error(errno, shown_path_, "flushed to the disk");
    }
}

fs::path beside(const fs::path& path)
{
    return path.parent_path() / fmt::format(".{}.beside", path.filename().string());
}

void FileDescriptor::start_flush()
{
    // Where the system cannot, the flush that follows does all of it.
    static_cast<void>(::sync_file_range(number_, 0, 0, SYNC_FILE_RANGE_WRITE));
}

void flush_to_disk(const fs::path& path)
{
    std::error_code error;
    if (fs::exists(path, error)) FileDescriptor(path, O_RDONLY, "flushed to the disk").flush();
}

void flush_to_disk(const std::vector<fs::path>& paths)
{
    constexpr std::size_t at_a_time = 4;
    std::vector<std::future<void>> flushing;
    for (std::size_t first = 0; first < std::min(at_a_time, paths.size()); ++first)
        flushing.push_back(std::async(std::launch::async | std::launch::deferred, [&paths, first] {
            for (std::size_t k = first; k < paths.size(); k += at_a_time)
                flush_to_disk(paths[k]);
        }));
    for (auto& some : flushing)
        some.get();
}

void write_whole(const fs::path& path, std::string_view content, Flush flush)
{
    const fs::path prepared = beside(path);
    try {
        {
            FileDescriptor file(prepared, O_WRONLY | O_CREAT | O_TRUNC, "written", path);
            file.write(content);
            if (flush == Flush::now)
                file.flush();
            else
                file.start_flush();
        }
        if (::rename(prepared.c_str(), path.c_str()) != 0) throw system_output_error(errno, path, "replaced");
    }
    catch (const OutputError&) {
        ::unlink(prepared.c_str());
        throw;
    }
    if (flush == Flush::now) flush_to_disk(path.has_parent_path() ? path.parent_path() : "."); // the new name itself
}

std::string read_whole(const fs::path& path)
{
    FileDescriptor file(path, O_RDONLY, "read");
    struct stat status
    {};
    if (::fstat(file.number(), &status) != 0) throw system_output_error(errno, path, "read");
    std::string content;
    content.reserve(static_cast<std::size_t>(status.st_size));
    std::string block(1 << 20, '\0');
    while (true) {
        const auto count = ::read(file.number(), block.data(), block.size());
        if (count == 0) return content;
        if (count > 0)
            content.append(block.data(), static_cast<std::size_t>(count));
        else if (errno != EINTR)
            throw system_output_error(errno, path, "read");
    }
}

void create_folder(const fs::path& path)
{
    std::error_code error;
    fs::create_directories(path, error);
    if (error) throw system_output_error(error.value(), path, "made");
    if (!fs::is_directory(path, error)) throw system_output_error(ENOTDIR, path, "made");
}

void remove_file(const fs::path& path)
{
    std::error_code error;
    fs::remove(path, error);
    if (error) throw system_output_error(error.value(), path, "removed");
}

} // namespace cupel
