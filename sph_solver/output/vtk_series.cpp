#include "output/vtk_series.hpp"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <stdexcept>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

namespace cupel
{

namespace
{

namespace fs = std::filesystem;

vtkNew<vtkFloatArray> float_array(const std::string& name, int components, std::size_t count)
{
    vtkNew<vtkFloatArray> array;
    array->SetName(name.c_str());
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(static_cast<vtkIdType>(count));
    return array;
}

void add_text(vtkFieldData* data, const char* name, const std::string& value)
{
    vtkNew<vtkStringArray> array;
    array->SetName(name);
    array->InsertNextValue(value);
    data->AddArray(array);
}

void add_points(vtkPolyData* output, const Particles& particles, const std::vector<Index>& written)
{
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(static_cast<vtkIdType>(written.size()));
    vtkNew<vtkCellArray> vertices;
    vertices->AllocateExact(static_cast<vtkIdType>(written.size()), static_cast<vtkIdType>(written.size()));
    for (std::size_t k = 0; k < written.size(); ++k) {
        const Vector place = particles.position[written[k]];
        const auto point = static_cast<vtkIdType>(k);
        points->SetPoint(point, place.x, place.y, place.z);
        vertices->InsertNextCell(1, &point);
    }
    output->SetPoints(points);
    output->SetVerts(vertices);
}

void add_fields(vtkPointData* data, const Particles& particles, const std::vector<Index>& written)
{
    for (const auto& field : particles.scalars()) {
        if (field->info.output != Output::yes) continue;
        const auto array = float_array(field->info.name, 1, written.size());
        float* values = array->GetPointer(0);
        for (std::size_t k = 0; k < written.size(); ++k)
            values[k] = static_cast<float>((*field)[written[k]]);
        data->AddArray(array);
    }
    for (const auto& field : particles.vectors()) {
        if (field->info.output != Output::yes) continue;
        const auto array = float_array(field->info.name, 3, written.size());
        float* values = array->GetPointer(0);
        for (std::size_t k = 0; k < written.size(); ++k) {
            const Vector value = (*field)[written[k]];
            values[3 * k] = static_cast<float>(value.x);
            values[3 * k + 1] = static_cast<float>(value.y);
            values[3 * k + 2] = static_cast<float>(value.z);
        }
        data->AddArray(array);
    }
    const auto fraction = float_array("fraction", 1, written.size());
    for (std::size_t k = 0; k < written.size(); ++k)
        fraction->GetPointer(0)[k] = particles.material[static_cast<std::size_t>(written[k])] == 0 ? 1.0F : 0.0F;
    data->AddArray(fraction);
}

constexpr const char* list_name = "fields.pvd";

std::string file_name(int number)
{
    return fmt::format("fields_{:06}.vtp", number);
}

/// −1 where the name is not that of a snapshot.
int number_of(const std::string& name)
{
    int number = -1;
    const bool matched = std::sscanf(name.c_str(), "fields_%d.vtp", &number) == 1;
    return matched && name == file_name(number) ? number : -1;
}

} // namespace

void write_snapshot(const fs::path& file, const Particles& particles, double time, const Provenance& provenance,
                    Flush flush)
{
    std::vector<Index> written;
    written.reserve(static_cast<std::size_t>(particles.count()));
    for (Index i = 0; i < particles.count(); ++i)
        if (particles.kind[static_cast<std::size_t>(i)] != Kind::wall) written.push_back(i);

    vtkNew<vtkPolyData> output;
    add_points(output, particles, written);
    add_fields(output->GetPointData(), particles, written);
    vtkNew<vtkDoubleArray> time_value;
    time_value->SetName("TimeValue");
    time_value->InsertNextValue(time);
    output->GetFieldData()->AddArray(time_value);
    add_text(output->GetFieldData(), "code_version", provenance.code.version);
    add_text(output->GetFieldData(), "code_commit", provenance.code.commit);
    add_text(output->GetFieldData(), "case", provenance.case_name);
    add_text(output->GetFieldData(), "case_hash", provenance.case_hash);
    add_text(output->GetFieldData(), "resolved_case", provenance.resolved_case);

    // Into memory first, so that a full disk is met in one place only. LZ4 takes an eighth of zlib's time at its
    // fastest level, and one and a quarter (a drop) to two times (a powder bed) its space: a run waits for the one, not
    // the other.
    vtkNew<vtkLZ4DataCompressor> compressor;
    compressor->SetCompressionLevel(1);
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(output);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressor(compressor);
    writer->SetIdTypeToInt32();
    writer->WriteToOutputStringOn();
    if (writer->Write() != 1)
        throw OutputError(file.string() + ": the VTK library cannot write the snapshot; free some memory");
    write_whole(file, writer->GetOutputString(), flush);
}

VtkSeries::VtkSeries(fs::path folder, Provenance provenance, const SnapshotList& earlier)
    : folder_(std::move(folder)), provenance_(std::move(provenance))
{
    for (std::size_t k = 0; k < earlier.times.size(); ++k) {
        const int number = static_cast<int>(earlier.numbers[k]);
        const std::string name = file_name(number);
        next_number_ = number + 1;
        if (fs::exists(folder_ / name)) entries_.emplace_back(earlier.times[k], name);
    }
    remove_unlisted();
    write_list();
}

void VtkSeries::remove_unlisted() const
{
    std::error_code error;
    for (fs::directory_iterator file(folder_, error), end; !error && file != end; file.increment(error)) {
        const std::string name = file->path().filename().string();
        const auto listed = [&](const auto& entry) { return entry.second == name; };
        const bool snapshot = number_of(name) >= 0 && std::none_of(entries_.begin(), entries_.end(), listed);
        if (snapshot || name.ends_with(".beside")) remove_file(file->path());
    }
    if (error) throw system_output_error(error.value(), folder_, "read");
}

void VtkSeries::write(const Particles& particles, double time)
{
    if (!entries_.empty() && !(entries_.back().first < time))
        throw std::logic_error("the times of snapshots have to rise");
    const std::string name = file_name(next_number_);
    write_snapshot(folder_ / name, particles, time, provenance_, Flush::later);
    entries_.emplace_back(time, name);
    unflushed_.push_back(name);
    ++next_number_;
    write_list();
}

void VtkSeries::flush()
{
    for (const auto& name : unflushed_)
        flush_to_disk(folder_ / name);
    flush_to_disk(folder_ / list_name);
    flush_to_disk(folder_);
    unflushed_.clear();
}

SnapshotList VtkSeries::until(double time) const
{
    SnapshotList list;
    for (const auto& [when, name] : entries_)
        if (when <= time) {
            list.times.push_back(when);
            list.numbers.push_back(number_of(name));
        }
    return list;
}

void VtkSeries::write_list() const
{
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
    for (const auto& [time, name] : entries_)
        text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time, name);
    text += "</Collection>\n</VTKFile>\n";
    write_whole(folder_ / list_name, text, Flush::later);
}

} // namespace cupel
