#include "output/snapshot.hpp"

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

void add_text(vtkFieldData* data, const char* name, const std::string& value)
{
    vtkNew<vtkStringArray> array;
    array->SetName(name);
    array->InsertNextValue(value);
    data->AddArray(array);
}

/// Lends values to a VTK array, which neither changes nor frees them.
template <class VtkArray, class Value> void lend(VtkArray* array, int components, const std::vector<Value>& values)
{
    constexpr int not_its_own = 1;
    array->SetNumberOfComponents(components);
    array->SetArray(const_cast<Value*>(values.data()), static_cast<vtkIdType>(values.size()), not_its_own);
}

void add_points(vtkPolyData* output, const Snapshot& snapshot)
{
    const auto count = static_cast<vtkIdType>(snapshot.count());
    vtkNew<vtkDoubleArray> positions;
    lend(positions.Get(), 3, snapshot.positions());
    vtkNew<vtkPoints> points;
    points->SetData(positions);
    vtkNew<vtkCellArray> vertices;
    vertices->AllocateExact(count, count);
    for (vtkIdType point = 0; point < count; ++point)
        vertices->InsertNextCell(1, &point);
    output->SetPoints(points);
    output->SetVerts(vertices);
}

void add_fields(vtkPointData* data, const Snapshot& snapshot)
{
    for (const Snapshot::Field& field : snapshot.fields()) {
        vtkNew<vtkFloatArray> array;
        array->SetName(field.name.c_str());
        lend(array.Get(), field.components, field.values);
        data->AddArray(array);
    }
}

} // namespace

void Snapshot::take(const Particles& particles, double time)
{
    time_ = time;
    shown_.clear();
    for (Index i = 0; i < particles.count(); ++i)
        if (particles.kind[static_cast<std::size_t>(i)] != Kind::wall) shown_.push_back(i);

    std::size_t taken = 0;
    const auto next_field = [&](const std::string& name, int components) {
        if (taken == fields_.size()) fields_.emplace_back();
        Field& field = fields_[taken++];
        field.name = name;
        field.components = components;
        field.values.resize(static_cast<std::size_t>(components) * shown_.size());
        return field.values.data();
    };
    const auto copy_vectors = [&](const VectorField& field, auto* values) {
        using Value = std::remove_pointer_t<decltype(values)>;
        for (const Index i : shown_) {
            const Vector value = field[i];
            *values++ = static_cast<Value>(value.x);
            *values++ = static_cast<Value>(value.y);
            *values++ = static_cast<Value>(value.z);
        }
    };
    positions_.resize(3 * shown_.size());
    copy_vectors(particles.position, positions_.data());
    for (const auto& field : particles.scalars()) {
        if (field->info.output != Output::yes) continue;
        float* value = next_field(field->info.name, 1);
        for (const Index i : shown_)
            *value++ = static_cast<float>((*field)[i]);
    }
    for (const auto& field : particles.vectors())
        if (field->info.output == Output::yes) copy_vectors(*field, next_field(field->info.name, 3));
    float* fraction = next_field("fraction", 1);
    for (const Index i : shown_)
        *fraction++ = particles.material[static_cast<std::size_t>(i)] == 0 ? 1.0F : 0.0F;
    fields_.resize(taken);
}

void write_snapshot(const fs::path& file, const Snapshot& snapshot, const Provenance& provenance, Flush flush)
{
    vtkNew<vtkPolyData> output;
    add_points(output, snapshot);
    add_fields(output->GetPointData(), snapshot);
    vtkNew<vtkDoubleArray> time_value;
    time_value->SetName("TimeValue");
    time_value->InsertNextValue(snapshot.time());
    output->GetFieldData()->AddArray(time_value);
    add_text(output->GetFieldData(), "code_version", provenance.code.version);
    add_text(output->GetFieldData(), "code_commit", provenance.code.commit);
    add_text(output->GetFieldData(), "case", provenance.case_name);
    add_text(output->GetFieldData(), "case_hash", provenance.case_hash);
    add_text(output->GetFieldData(), "resolved_case", provenance.resolved_case);

    // Into memory first, so that a full disk is met in one place only. LZ4 takes an eighth of zlib's time at its
    // fastest level, and one and a quarter (a drop) to two times (a powder bed) its space.
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

void write_snapshot(const fs::path& file, const Particles& particles, double time, const Provenance& provenance,
                    Flush flush)
{
    Snapshot snapshot;
    snapshot.take(particles, time);
    write_snapshot(file, snapshot, provenance, flush);
}

} // namespace cupel
