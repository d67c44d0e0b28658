/// HDF5 files that are made in memory and read from the disk, with the library's errors turned into OutputError.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <hdf5.h>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cupel
{

/// An identifier of the HDF5 library, closed at the end of its scope.
class HdfHandle
{
public:
    using Close = herr_t (*)(hid_t);

    HdfHandle(hid_t identifier, Close close) : identifier_(identifier), close_(close) {}
    HdfHandle(HdfHandle&& other) noexcept : identifier_(other.identifier_), close_(other.close_)
    {
        other.identifier_ = H5I_INVALID_HID;
    }
    HdfHandle(const HdfHandle&) = delete;
    HdfHandle& operator=(const HdfHandle&) = delete;
    HdfHandle& operator=(HdfHandle&&) = delete;
    ~HdfHandle()
    {
        if (identifier_ >= 0) close_(identifier_);
    }
    operator hid_t() const { return identifier_; }

private:
    hid_t identifier_;
    Close close_;
};

/// The HDF5 type of a C++ type in memory.
template <class T> hid_t hdf_type();
template <> hid_t hdf_type<double>();
template <> hid_t hdf_type<std::int32_t>();
template <> hid_t hdf_type<std::uint8_t>();

/// An HDF5 file under construction in memory. The library never writes to a disk: it does not survive a full one.
/// Throws OutputError naming `place` where the library refuses.
class HdfWriter
{
public:
    /// `size_estimate` in bytes spares copying while the file grows; `user_block` bytes (a power of two from 512, or
    /// 0) are left free at its start.
    HdfWriter(std::filesystem::path place, std::size_t size_estimate, std::size_t user_block);

    void add_group(const std::string& path);
    void add_text(const std::string& object, const std::string& name, const std::string& value);
    /// A text of any length as a dataset of its own (an attribute holds 64 kB at most).
    void add_document(const std::string& path, const std::string& value);
    void add_number(const std::string& object, const std::string& name, double value);
    /// Rows of equal length as one dataset of shape rows × length, or of shape length where there is one row.
    template <class T> void add_array(const std::string& path, std::span<const std::span<const T>> rows);
    template <class T> void add_array(const std::string& path, std::span<const T> values)
    {
        const std::span<const T> rows[]{values};
        add_array<T>(path, rows);
    }

    /// The file's bytes; valid until the writer changes or ends.
    std::span<char> bytes();

private:
    hid_t checked(hid_t result, std::string_view what) const;

    std::filesystem::path place_;
    std::size_t user_block_;
    HdfHandle file_;
};

/// An HDF5 file on the disk. Throws OutputError naming the file where it does not hold what is asked for.
class HdfReader
{
public:
    explicit HdfReader(std::filesystem::path path);

    /// Names of the datasets or groups in a group, sorted.
    std::vector<std::string> names(const std::string& group) const;
    std::string text(const std::string& object, const std::string& name) const;
    /// Names of an object's attributes, sorted.
    std::vector<std::string> attribute_names(const std::string& object) const;
    double number(const std::string& object, const std::string& name) const;
    /// Number of values in a dataset; its number of rows is 1 where it has one dimension.
    std::size_t length(const std::string& path) const;
    /// Reads a dataset into rows of equal length; their sizes have to be the dataset's shape.
    template <class T> void read_array(const std::string& path, std::span<const std::span<T>> rows) const;
    template <class T> void read_array(const std::string& path, std::span<T> values) const
    {
        const std::span<T> rows[]{values};
        read_array<T>(path, rows);
    }

private:
    hid_t checked(hid_t result, std::string_view what) const;

    std::filesystem::path path_;
    HdfHandle file_;
};

} // namespace cupel
