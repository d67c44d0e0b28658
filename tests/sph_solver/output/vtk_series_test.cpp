#include "output/vtk_series.hpp"

#include <cmath>
#include <fcntl.h>
#include <future>
#include <optional>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include "output_fixture.hpp"

namespace cupel::test
{

namespace
{

constexpr Index count = 1000;

vtkSmartPointer<vtkPolyData> read(const std::filesystem::path& file)
{
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    return reader->GetOutput();
}

/// A pipe in the place of a file: who opens that to write waits until it is removed.
class Obstacle
{
public:
    explicit Obstacle(std::filesystem::path place) : place_(std::move(place))
    {
        EXPECT_EQ(::mkfifo(place_.c_str(), 0600), 0);
    }

    /// Lets the writer go on; returns what it has written, which has to be less than a pipe holds (64 KiB).
    std::string remove()
    {
        pipe_.emplace(place_, O_RDWR, "read"); // stays open, so that whoever flushes the file need not wait
        std::string content(1 << 16, '\0');
        std::size_t size = 0;
        for (bool written = false; !written;) {
            written = !std::filesystem::exists(place_); // the writer renames it when it is done
            pollfd readable{pipe_->number(), POLLIN, 0};
            while (::poll(&readable, 1, 10) == 1)
                size += static_cast<std::size_t>(
                    std::max<ssize_t>(0, ::read(pipe_->number(), content.data() + size, content.size() - size)));
        }
        content.resize(size);
        return content;
    }

private:
    std::filesystem::path place_;
    std::optional<FileDescriptor> pipe_;
};

} // namespace

class VtkFiles : public OutputTest
{
protected:
    void SetUp() override
    {
        OutputTest::SetUp();
        register_fields(particles);
        fill_particles(particles, 2);
    }

    Particles particles{count};
};

TEST_F(VtkFiles, AllButTheWallsAreReadBackByVtk)
{
    write_snapshot(folder / "a.vtp", particles, 0.25, some_provenance());
    const auto data = read(folder / "a.vtp");
    const vtkIdType written = 3 * count / 4; // the last quarter are walls
    ASSERT_EQ(data->GetNumberOfPoints(), written);
    EXPECT_EQ(data->GetNumberOfVerts(), written);
    EXPECT_EQ(data->GetPoints()->GetDataType(), VTK_DOUBLE);
    auto* velocity = data->GetPointData()->GetArray("velocity");
    auto* temperature = data->GetPointData()->GetArray("temperature");
    auto* fraction = data->GetPointData()->GetArray("fraction");
    ASSERT_TRUE(velocity && temperature && fraction);
    EXPECT_EQ(velocity->GetNumberOfComponents(), 3);
    EXPECT_EQ(temperature->GetDataType(), VTK_FLOAT);
    for (vtkIdType k = 0; k < written; ++k) {
        const auto i = static_cast<Index>(k);
        double point[3];
        data->GetPoint(k, point);
        EXPECT_EQ(point[0], particles.position[i].x);
        EXPECT_EQ(point[2], particles.position[i].z);
        EXPECT_EQ(velocity->GetComponent(k, 1), static_cast<float>(particles.velocity[i].y));
        EXPECT_EQ(temperature->GetComponent(k, 0), static_cast<float>(particles.scalar("temperature")[i]));
        EXPECT_EQ(fraction->GetComponent(k, 0), i < count / 2 ? 1.0 : 0.0); // the second half is of material 1
    }
}

TEST_F(VtkFiles, HoldTheFieldsMarkedForOutputAndNoOther)
{
    write_snapshot(folder / "a.vtp", particles, 0.25, some_provenance());
    const auto data = read(folder / "a.vtp");
    auto* point_data = data->GetPointData();
    for (const char* name : {"density", "pressure", "volume", "velocity", "temperature", "surface_normal", "fraction"})
        EXPECT_TRUE(point_data->HasArray(name)) << name;
    EXPECT_EQ(point_data->GetNumberOfArrays(), 7);
}

TEST_F(VtkFiles, BearTimeCodeAndCase)
{
    write_snapshot(folder / "a.vtp", particles, 0.25, some_provenance());
    const auto data = read(folder / "a.vtp");
    auto* fields = data->GetFieldData();
    ASSERT_TRUE(fields->GetArray("TimeValue"));
    EXPECT_EQ(fields->GetArray("TimeValue")->GetComponent(0, 0), 0.25);
    const auto text = [&](const char* name) {
        auto* array = vtkStringArray::SafeDownCast(fields->GetAbstractArray(name));
        return array ? std::string(array->GetValue(0)) : std::string();
    };
    EXPECT_EQ(text("code_commit"), "0123456789ab");
    EXPECT_EQ(text("case_hash"), "d1ce0000d1ce0000");
    EXPECT_EQ(text("resolved_case"), "{\"name\": \"droplet\"}");
}

TEST_F(VtkFiles, AreCompressed)
{
    for (const auto& field : particles.scalars())
        std::fill(field->values.begin(), field->values.end(), 1.0);
    write_snapshot(folder / "a.vtp", particles, 0.0, some_provenance());
    // 750 particles of 3 doubles, 11 floats and 2 indices of 8 bytes are 63 kB and would need a file of 66 kB; the
    // random positions and vectors, 36 kB, do not shrink.
    EXPECT_LT(std::filesystem::file_size(folder / "a.vtp"), 50'000U);
    EXPECT_NE(read_whole(folder / "a.vtp").find("compressor=\"vtkLZ4DataCompressor\""), std::string::npos);
}

TEST_F(VtkFiles, SeriesListsEverySnapshotWithItsTime)
{
    VtkSeries series(folder, some_provenance());
    series.write(particles, 0.0);
    series.write(particles, 1e-4);
    series.flush();
    const std::string list = read_whole(folder / "fields.pvd");
    EXPECT_NE(list.find("timestep=\"0\" part=\"0\" file=\"fields_000000.vtp\""), std::string::npos) << list;
    EXPECT_NE(list.find("timestep=\"0.0001\" part=\"0\" file=\"fields_000001.vtp\""), std::string::npos) << list;
    EXPECT_EQ(read(folder / "fields_000001.vtp")->GetNumberOfPoints(), 3 * count / 4);
    EXPECT_THROW(series.write(particles, 0.5e-4), std::logic_error);
}

TEST_F(VtkFiles, SeriesListsAllWhetherOrNotTheDiskIsWaitedFor)
{
    VtkSeries series(folder, some_provenance());
    series.write(particles, 0.0);
    series.write(particles, 0.1);
    series.flush({}, Flush::later);
    EXPECT_NE(read_whole(folder / "fields.pvd").find("file=\"fields_000001.vtp\""), std::string::npos);
}

TEST_F(VtkFiles, ResumedSeriesDropsWhatCameLaterAndGoesOn)
{
    SnapshotList earlier;
    {
        VtkSeries series(folder, some_provenance());
        for (const double time : {0.0, 0.1, 0.2, 0.3})
            series.write(particles, time);
        earlier = series.until(0.2);
    }
    write_whole(folder / "fields.pvd", ""); // as a loss of power may leave what nobody has flushed
    write_whole(folder / ".fields_000004.vtp.beside", "half");
    write_whole(folder / "fields_000003.vtp.bak", "not ours");
    VtkSeries series(folder, some_provenance(), earlier);
    EXPECT_EQ(series.size(), 3U);
    EXPECT_FALSE(std::filesystem::exists(folder / "fields_000003.vtp"));
    EXPECT_FALSE(std::filesystem::exists(folder / ".fields_000004.vtp.beside"));
    EXPECT_TRUE(std::filesystem::exists(folder / "fields_000003.vtp.bak"));
    series.write(particles, 0.35);
    series.flush();
    const std::string list = read_whole(folder / "fields.pvd");
    EXPECT_NE(list.find("timestep=\"0.35\" part=\"0\" file=\"fields_000003.vtp\""), std::string::npos) << list;
    EXPECT_EQ(list.find("timestep=\"0.3\""), std::string::npos) << list;
}

TEST_F(VtkFiles, ResumedSeriesIsWithoutSnapshotsThatSomebodyRemoved)
{
    SnapshotList earlier;
    {
        VtkSeries series(folder, some_provenance());
        for (const double time : {0.0, 0.1, 0.2})
            series.write(particles, time);
        earlier = series.until(0.2);
        std::filesystem::remove(folder / "fields_000001.vtp");
        series.flush(); // to make space in the middle of a run is no error
    }
    std::filesystem::remove(folder / "fields_000002.vtp");
    VtkSeries series(folder, some_provenance(), earlier);
    series.write(particles, 0.3);
    series.flush();
    EXPECT_EQ(series.size(), 2U);
    const std::string list = read_whole(folder / "fields.pvd");
    EXPECT_NE(list.find("timestep=\"0.3\" part=\"0\" file=\"fields_000003.vtp\""), std::string::npos) << list;
    EXPECT_EQ(list.find("fields_000001"), std::string::npos) << list;
}

TEST_F(VtkFiles, RunGoesOnWhileASnapshotIsWrittenThatShowsWhatWasTaken)
{
    const Vector before = particles.position[7];
    VtkSeries series(folder, some_provenance());
    Obstacle obstacle(beside(folder / "fields_000000.vtp"));
    series.write(particles, 0.0);
    particles.position.set(7, {1.0, 2.0, 3.0});
    series.write(particles, 0.1);
    series.check();
    EXPECT_FALSE(std::filesystem::exists(folder / "fields_000000.vtp"));
    write_whole(folder / "first.vtp", obstacle.remove());
    series.wait();
    double point[3];
    read(folder / "first.vtp")->GetPoint(7, point);
    EXPECT_EQ(point[0], before.x);
    read(folder / "fields_000001.vtp")->GetPoint(7, point);
    EXPECT_EQ(point[0], 1.0);
}

TEST_F(VtkFiles, RunWaitsForTheFirstOfTooManySnapshots)
{
    VtkSeries series(folder, some_provenance());
    Obstacle obstacle(beside(folder / "fields_000000.vtp"));
    constexpr int most_under_way = 8;
    for (int k = 0; k < most_under_way; ++k)
        series.write(particles, k);
    auto next = std::async(std::launch::async, [&] { series.write(particles, most_under_way); });
    EXPECT_EQ(next.wait_for(std::chrono::milliseconds(100)), std::future_status::timeout);
    obstacle.remove();
    next.get();
    EXPECT_EQ(series.size(), most_under_way + 1U);
}

TEST_F(VtkFiles, SeriesThatEndsByAnErrorListsWhatIsThere)
{
    {
        VtkSeries series(folder, some_provenance());
        for (const double time : {0.0, 0.1, 0.2})
            series.write(particles, time);
    }
    EXPECT_NE(read_whole(folder / "fields.pvd").find("fields_000002.vtp"), std::string::npos);
}

TEST_F(VtkFiles, FullDiskLeavesTheSeriesReadable)
{
    VtkSeries series(folder, some_provenance());
    series.write(particles, 0.0);
    series.flush();
    std::string message;
    {
        const FileSizeLimit limit(2048);
        message = message_of<OutputError>([&] {
            series.write(particles, 0.1);
            series.wait();
        });
    }
    EXPECT_TRUE(one_line_with(message, {"fields_000001.vtp", "ulimit -f"}));
    // Whatever is asked of it from now on says the same: a run does not miss it, and does not go on without a snapshot.
    EXPECT_EQ(message_of<OutputError>([&] { series.check(); }), message);
    EXPECT_EQ(message_of<OutputError>([&] { series.write(particles, 0.2); }), message);
    EXPECT_EQ(message_of<OutputError>([&] { series.flush(); }), message);
    EXPECT_EQ(message_of<OutputError>([&] { series.until(0.1); }), message);
    EXPECT_FALSE(std::filesystem::exists(folder / "fields_000001.vtp"));
    EXPECT_EQ(read_whole(folder / "fields.pvd").find("fields_000001"), std::string::npos);
}

} // namespace cupel::test
