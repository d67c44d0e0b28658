/// history.csv: a run's time series, one row a call, with a fixed set of columns.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "output/atomic_file.hpp"

namespace cupel
{

/// Rows are kept in memory and appended to the file by flush(); numbers are written so that they read back exactly.
class History
{
public:
    /// `columns` name quantity and unit; the first one is the time, e.g. {"time_s", "absorbed_power_W"}.
    /// Without `resume_time` a new file is begun; with it [s] the rows up to that time are kept, later ones and a row
    /// that a kill cut off are dropped. Throws OutputError where the file cannot be written, or is to be resumed and
    /// is missing or has other columns; std::logic_error where `columns` is empty or a name has a comma, quote or line
    /// break.
    History(std::filesystem::path path, std::vector<std::string> columns, std::optional<double> resume_time = {});

    /// One value a column, the time first. Throws std::logic_error where their number differs. Rows that wait take
    /// little memory, however rare the checkpoints are: beyond 64 KiB they are flushed (OutputError).
    void add(std::span<const double> values);

    /// Appends the rows added since the last flush and puts them on the disk: before every checkpoint, so that a
    /// resumed run finds the rows that came before it, and at the end; with Flush::later somebody else sees to that.
    /// Throws OutputError.
    void flush(Flush when = Flush::now);
    const std::filesystem::path& path() const { return path_; }

    const std::vector<std::string>& columns() const { return columns_; }

private:
    std::filesystem::path path_;
    std::vector<std::string> columns_;
    std::string pending_;
};

} // namespace cupel
