#include "output/history.hpp"

#include <charconv>
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <stdexcept>
#include <string_view>
#include <unistd.h>

#include "output/atomic_file.hpp"

namespace cupel
{

namespace
{

constexpr std::size_t most_pending = 1 << 16; // bytes

/// The rows of an earlier part of the run up to a time. A cut-off last row has no line break and is not among them.
std::string rows_until(double time, std::string_view content, std::string_view header, const std::string& where)
{
    if (content.substr(0, header.size()) != header)
        throw OutputError(where + ": has other columns than this run writes; resume with the program that wrote it, "
                                  "or start the run anew");
    std::string kept(header);
    content.remove_prefix(header.size());
    for (auto end = content.find('\n'); end != std::string_view::npos; end = content.find('\n')) {
        const std::string_view row = content.substr(0, end + 1);
        double row_time = 0.0;
        const auto result = std::from_chars(row.data(), row.data() + row.size(), row_time);
        if (result.ec != std::errc{} || (*result.ptr != ',' && *result.ptr != '\n'))
            throw OutputError(where + ": a row does not begin with a time; start the run anew");
        if (row_time <= time) kept += row;
        content.remove_prefix(end + 1);
    }
    return kept;
}

} // namespace

History::History(std::filesystem::path path, std::vector<std::string> columns, std::optional<double> resume_time)
    : path_(std::move(path)), columns_(std::move(columns))
{
    if (columns_.empty()) throw std::logic_error("a history needs a column");
    for (const auto& column : columns_)
        if (column.empty() || column.find_first_of(",\"\r\n") != std::string::npos)
            throw std::logic_error("'" + column + "' cannot name a column of a history");
    const std::string header = fmt::format("{}\n", fmt::join(columns_, ","));
    write_whole(path_, resume_time ? rows_until(*resume_time, read_whole(path_), header, path_.string()) : header);
}

void History::add(std::span<const double> values)
{
    if (values.size() != columns_.size())
        throw std::logic_error(
            fmt::format("a history of {} columns was given {} values", columns_.size(), values.size()));
    fmt::format_to(std::back_inserter(pending_), "{}\n", fmt::join(values, ","));
    if (pending_.size() > most_pending) flush();
}

void History::flush(Flush when)
{
    if (pending_.empty()) return;
    FileDescriptor file(path_, O_WRONLY | O_APPEND, "written"); // not O_CREAT: a file without a header is no history
    const auto size_before = ::lseek(file.number(), 0, SEEK_END);
    try {
        file.write(pending_);
        when == Flush::now ? file.flush() : file.start_flush();
    }
    catch (const OutputError&) {
        if (size_before < 0 || ::ftruncate(file.number(), size_before) != 0)
            pending_.clear(); // part of the rows is there and stays: no later flush may repeat them
        throw;
    }
    pending_.clear();
}

} // namespace cupel
