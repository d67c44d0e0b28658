#include "output/vtk_series.hpp"

#include <charconv>
#include <cstdio>
#include <fmt/format.h>
#include <stdexcept>
#include <string_view>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkZLibDataCompressor.h>

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

/// The value of an attribute in a line of XML; empty where it is not there.
std::string_view attribute(std::string_view line, std::string_view name)
{
    const std::string key = fmt::format(" {}=\"", name);
    const auto begin = line.find(key);
    if (begin == std::string_view::npos) return {};
    line.remove_prefix(begin + key.size());
    return line.substr(0, line.find('"'));
}

/// Entries of a series that write_list wrote, which has each of them on its own line.
std::vector<std::pair<double, std::string>> read_list(const fs::path& file)
{
    std::vector<std::pair<double, std::string>> entries;
    const std::string content = read_whole(file);
    for (std::size_t begin = 0; begin < content.size();) {
        const auto end = std::min(content.find('\n', begin), content.size());
        const std::string_view line = std::string_view(content).substr(begin, end - begin);
        begin = end + 1;
        if (line.find("<DataSet ") == std::string_view::npos) continue;
        const auto time = attribute(line, "timestep");
        double value = 0.0;
        const auto result = std::from_chars(time.data(), time.data() + time.size(), value);
        if (time.empty() || result.ec != std::errc{})
            throw OutputError(file.string() + ": an entry has no time; start the run anew");
        entries.emplace_back(value, attribute(line, "file"));
    }
    return entries;
}

std::string file_name(int number)
{
    return fmt::format("fields_{:06}.vtp", number);
}

int number_of(const std::string& name)
{
    int number = -1;
    return std::sscanf(name.c_str(), "fields_%d.vtp", &number) == 1 ? number : -1;
}

} // namespace

void write_snapshot(const fs::path& file, const Particles& particles, double time, const Provenance& provenance)
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

    // Into memory first, so that a full disk is met in one place only. At level 1 a million particles take two thirds
    // of the default level's time and 2 % more space.
    vtkNew<vtkZLibDataCompressor> compressor;
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
    write_whole(file, writer->GetOutputString());
}

VtkSeries::VtkSeries(fs::path folder, Provenance provenance, std::optional<double> resume_time)
    : folder_(std::move(folder)), provenance_(std::move(provenance))
{
    if (resume_time && fs::exists(folder_ / "fields.pvd"))
        for (auto& entry : read_list(folder_ / "fields.pvd")) {
            if (entry.first > *resume_time) {
                remove_file(folder_ / entry.second);
                continue;
            }
            next_number_ = number_of(entry.second) + 1;
            if (fs::exists(folder_ / entry.second)) entries_.push_back(std::move(entry));
        }
    write_list();
}

void VtkSeries::write(const Particles& particles, double time)
{
    const bool replaced = !entries_.empty() && entries_.back().first == time;
    if (!replaced && !entries_.empty() && !(entries_.back().first < time))
        throw std::logic_error("the times of snapshots have to rise");
    const std::string name = replaced ? entries_.back().second : file_name(next_number_);
    write_snapshot(folder_ / name, particles, time, provenance_);
    if (replaced) return;
    entries_.emplace_back(time, name);
    ++next_number_;
    write_list();
}

void VtkSeries::write_list() const
{
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
    for (const auto& [time, name] : entries_)
        text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time, name);
    text += "</Collection>\n</VTKFile>\n";
    write_whole(folder_ / "fields.pvd", text);
}

} // namespace cupel
