/// Files that are whole or absent: content is written beside its place, flushed to the disk and renamed.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace cupel
{

/// Output that cannot be written or read back; what() is one line: where, what is wrong, what to do.
class OutputError : public std::runtime_error
{
public:
    using std::runtime_error::runtime_error;
};

/// The error of a system call (errno) on a path, e.g. a full disk, a read-only or vanished folder.
/// `action` completes "cannot be ...", e.g. "written".
OutputError system_output_error(int error_number, const std::filesystem::path& path, std::string_view action);

/// Whether what is written is on the disk on return, or when somebody flushes it later: waiting for the disk takes
/// longer than all else, and only a loss of power makes a difference.
enum class Flush { now, later };

/// Replaces the file at `path` by `content`: a reader sees the old file or the new one, and a kill at any moment leaves
/// one of them. Throws OutputError; the old file is then untouched.
void write_whole(const std::filesystem::path& path, std::string_view content, Flush flush = Flush::now);

/// Waits until a file or folder is on the disk as it is now; one that has been removed is no error. Throws OutputError.
void flush_to_disk(const std::filesystem::path& path);
/// The same for many, a few at a time: file systems put on the disk together what is asked for together. Eighty small
/// files one after the other took 250 ms of a busy machine, four at a time 5 ms.
void flush_to_disk(const std::vector<std::filesystem::path>& paths);

/// Name under which write_whole prepares a file before the renaming; it starts with a dot and is overwritten freely.
std::filesystem::path beside(const std::filesystem::path& path);

/// The whole content of a file. Throws OutputError.
std::string read_whole(const std::filesystem::path& path);

/// Creates a folder and those above it where missing. Throws OutputError.
void create_folder(const std::filesystem::path& path);

/// Removes a file; one that does not exist is no error. Throws OutputError.
void remove_file(const std::filesystem::path& path);

/// An open file descriptor, closed at the end of its scope.
class FileDescriptor
{
public:
    /// Opens with the flags of open(2); throws OutputError with `action` as in system_output_error.
    FileDescriptor(const std::filesystem::path& path, int flags, std::string_view action)
        : FileDescriptor(path, flags, action, path)
    {}
    /// The same, with another name in errors: that of the file which this one prepares.
    FileDescriptor(const std::filesystem::path& path, int flags, std::string_view action,
                   std::filesystem::path shown_path);
    ~FileDescriptor();
    FileDescriptor(const FileDescriptor&) = delete;
    FileDescriptor& operator=(const FileDescriptor&) = delete;

    int number() const { return number_; }
    /// Writes everything, however many calls it takes. Throws OutputError.
    void write(std::string_view content);
    /// Waits until everything written is on the disk. Throws OutputError.
    void flush();
    /// Has the system begin with that, and does not wait: a later flush finds most of it done.
    void start_flush();

private:
    std::filesystem::path shown_path_;
    int number_;
};

} // namespace cupel
