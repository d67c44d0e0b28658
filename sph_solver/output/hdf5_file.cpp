#include "output/hdf5_file.hpp"

#include <algorithm>

#include "output/atomic_file.hpp"

namespace cupel
{

namespace
{

/// The library prints a page for each error; what an error means here is said by OutputError.
void silence_library()
{
    static const herr_t silenced = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    static_cast<void>(silenced);
}

HdfHandle new_memory_file(const std::filesystem::path& place, std::size_t size_estimate, std::size_t user_block)
{
    silence_library();
    const HdfHandle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    const HdfHandle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    H5Pset_fapl_core(access, std::max<std::size_t>(size_estimate, 1 << 16), false);
    H5Pset_userblock(creation, user_block);
    return {H5Fcreate(place.c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose};
}

HdfHandle open_file(const std::filesystem::path& path)
{
    silence_library();
    const HdfHandle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_file_locking(access, false, true); // some network file systems have no locks, and nobody writes to it
    return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose};
}

std::size_t count_of(hid_t space)
{
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    return count < 0 ? 0 : static_cast<std::size_t>(count);
}

/// The part of a dataset's space that one of its rows takes.
HdfHandle row_of(hid_t space, int rank, hsize_t row, hsize_t length)
{
    HdfHandle selected(H5Scopy(space), H5Sclose);
    const hsize_t start[]{row, 0}, count[]{1, length};
    if (rank == 2) H5Sselect_hyperslab(selected, H5S_SELECT_SET, start, nullptr, count, nullptr);
    return selected;
}

} // namespace

template <> hid_t hdf_type<double>()
{
    return H5T_NATIVE_DOUBLE;
}
template <> hid_t hdf_type<std::int32_t>()
{
    return H5T_NATIVE_INT32;
}
template <> hid_t hdf_type<std::uint8_t>()
{
    return H5T_NATIVE_UINT8;
}

HdfWriter::HdfWriter(std::filesystem::path place, std::size_t size_estimate, std::size_t user_block)
    : place_(std::move(place)), user_block_(user_block), file_(new_memory_file(place_, size_estimate, user_block))
{
    checked(file_, "the file");
}

hid_t HdfWriter::checked(hid_t result, std::string_view what) const
{
    if (result >= 0) return result;
    throw OutputError(place_.string() + ": " + std::string(what) +
                      " cannot be prepared in memory; free some memory or run at a coarser level");
}

void HdfWriter::add_group(const std::string& path)
{
    const HdfHandle group(checked(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), path),
                          H5Gclose);
}

void HdfWriter::add_text(const std::string& object, const std::string& name, const std::string& value)
{
    const HdfHandle space(checked(H5Screate(H5S_SCALAR), name), H5Sclose);
    const HdfHandle type(checked(H5Tcopy(H5T_C_S1), name), H5Tclose);
    checked(H5Tset_size(type, value.size() + 1), name);
    H5Tset_cset(type, H5T_CSET_UTF8);
    const HdfHandle attribute(checked(H5Acreate_by_name(file_, object.c_str(), name.c_str(), type, space, H5P_DEFAULT,
                                                        H5P_DEFAULT, H5P_DEFAULT),
                                      name),
                              H5Aclose);
    checked(H5Awrite(attribute, type, value.c_str()), name);
}

void HdfWriter::add_document(const std::string& path, const std::string& value)
{
    const HdfHandle space(checked(H5Screate(H5S_SCALAR), path), H5Sclose);
    const HdfHandle type(checked(H5Tcopy(H5T_C_S1), path), H5Tclose);
    checked(H5Tset_size(type, value.size() + 1), path);
    H5Tset_cset(type, H5T_CSET_UTF8);
    const HdfHandle creation(checked(H5Pcreate(H5P_DATASET_CREATE), path), H5Pclose);
    H5Pset_obj_track_times(creation, false);
    const HdfHandle dataset(
        checked(H5Dcreate2(file_, path.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT), path), H5Dclose);
    checked(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.c_str()), path);
}

void HdfWriter::add_number(const std::string& object, const std::string& name, double value)
{
    const HdfHandle space(checked(H5Screate(H5S_SCALAR), name), H5Sclose);
    const HdfHandle attribute(checked(H5Acreate_by_name(file_, object.c_str(), name.c_str(), H5T_NATIVE_DOUBLE, space,
                                                        H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                                      name),
                              H5Aclose);
    checked(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value), name);
}

template <class T> void HdfWriter::add_array(const std::string& path, std::span<const std::span<const T>> rows)
{
    const hsize_t length = rows.empty() ? 0 : rows[0].size();
    const int rank = rows.size() == 1 ? 1 : 2;
    const hsize_t shape[]{rows.size(), length};
    const HdfHandle space(checked(H5Screate_simple(rank, rank == 1 ? &length : shape, nullptr), path), H5Sclose);
    const HdfHandle creation(checked(H5Pcreate(H5P_DATASET_CREATE), path), H5Pclose);
    H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER);
    H5Pset_obj_track_times(creation, false); // the same state gives the same bytes at any time of day
    const HdfHandle dataset(
        checked(H5Dcreate2(file_, path.c_str(), hdf_type<T>(), space, H5P_DEFAULT, creation, H5P_DEFAULT), path),
        H5Dclose);
    const HdfHandle memory(checked(H5Screate_simple(1, &length, nullptr), path), H5Sclose);
    for (std::size_t row = 0; row < rows.size() && length > 0; ++row)
        checked(
            H5Dwrite(dataset, hdf_type<T>(), memory, row_of(space, rank, row, length), H5P_DEFAULT, rows[row].data()),
            path);
}

std::span<char> HdfWriter::bytes()
{
    checked(H5Fflush(file_, H5F_SCOPE_LOCAL), "the file");
    // The size that the file would have when closed, less the user block; the buffer itself is longer.
    const auto size = H5Fget_file_image(file_, nullptr, 0);
    void* handle = nullptr;
    if (size <= 0 || H5Fget_vfd_handle(file_, H5P_DEFAULT, &handle) < 0) checked(-1, "the file");
    return {*static_cast<char**>(handle), static_cast<std::size_t>(size) + user_block_};
}

HdfReader::HdfReader(std::filesystem::path path) : path_(std::move(path)), file_(open_file(path_))
{
    checked(file_, "HDF5 content");
}

hid_t HdfReader::checked(hid_t result, std::string_view what) const
{
    if (result >= 0) return result;
    throw OutputError(path_.string() + ": has no readable " + std::string(what) +
                      "; remove the file to resume from an earlier one, or start the run anew");
}

std::vector<std::string> HdfReader::names(const std::string& group) const
{
    const HdfHandle opened(checked(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), group), H5Gclose);
    std::vector<std::string> found;
    const auto visit = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
        static_cast<std::vector<std::string>*>(list)->emplace_back(name);
        return 0;
    };
    checked(H5Literate(opened, H5_INDEX_NAME, H5_ITER_INC, nullptr, visit, &found), group);
    return found;
}

std::vector<std::string> HdfReader::attribute_names(const std::string& object) const
{
    const HdfHandle opened(checked(H5Oopen(file_, object.c_str(), H5P_DEFAULT), object), H5Oclose);
    std::vector<std::string> found;
    const auto visit = [](hid_t, const char* name, const H5A_info_t*, void* list) -> herr_t {
        static_cast<std::vector<std::string>*>(list)->emplace_back(name);
        return 0;
    };
    checked(H5Aiterate2(opened, H5_INDEX_NAME, H5_ITER_INC, nullptr, visit, &found), object);
    std::sort(found.begin(), found.end());
    return found;
}

std::string HdfReader::text(const std::string& object, const std::string& name) const
{
    const HdfHandle attribute(
        checked(H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), name), H5Aclose);
    const HdfHandle type(checked(H5Aget_type(attribute), name), H5Tclose);
    std::string value(H5Tget_size(type), '\0');
    checked(H5Aread(attribute, type, value.data()), name);
    return value.substr(0, value.find('\0'));
}

double HdfReader::number(const std::string& object, const std::string& name) const
{
    const HdfHandle attribute(
        checked(H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), name), H5Aclose);
    double value = 0.0;
    checked(H5Aread(attribute, H5T_NATIVE_DOUBLE, &value), name);
    return value;
}

std::size_t HdfReader::length(const std::string& path) const
{
    const HdfHandle dataset(checked(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), path), H5Dclose);
    const HdfHandle space(checked(H5Dget_space(dataset), path), H5Sclose);
    return count_of(space);
}

template <class T> void HdfReader::read_array(const std::string& path, std::span<const std::span<T>> rows) const
{
    const HdfHandle dataset(checked(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), path), H5Dclose);
    const HdfHandle space(checked(H5Dget_space(dataset), path), H5Sclose);
    const hsize_t length = rows[0].size();
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank != (rows.size() == 1 ? 1 : 2) || count_of(space) != rows.size() * length)
        checked(-1, path + " of the expected size");
    const HdfHandle memory(checked(H5Screate_simple(1, &length, nullptr), path), H5Sclose);
    for (std::size_t row = 0; row < rows.size() && length > 0; ++row)
        checked(
            H5Dread(dataset, hdf_type<T>(), memory, row_of(space, rank, row, length), H5P_DEFAULT, rows[row].data()),
            path);
}

template void HdfWriter::add_array<double>(const std::string&, std::span<const std::span<const double>>);
template void HdfWriter::add_array<std::int32_t>(const std::string&, std::span<const std::span<const std::int32_t>>);
template void HdfWriter::add_array<std::uint8_t>(const std::string&, std::span<const std::span<const std::uint8_t>>);
template void HdfReader::read_array<double>(const std::string&, std::span<const std::span<double>>) const;
template void HdfReader::read_array<std::int32_t>(const std::string&, std::span<const std::span<std::int32_t>>) const;
template void HdfReader::read_array<std::uint8_t>(const std::string&, std::span<const std::span<std::uint8_t>>) const;

} // namespace cupel
