#include "output/history.hpp"

#include <fstream>

#include "output/atomic_file.hpp"
#include "output_fixture.hpp"

namespace cupel::test
{

class HistoryFile : public OutputTest
{
protected:
    void add(History& history, double time, double energy)
    {
        const double row[]{time, energy};
        history.add(row);
    }
    std::string text() const { return read_whole(folder / "history.csv"); }

    const std::vector<std::string> columns{"time_s", "kinetic_energy_J"};
};

TEST_F(HistoryFile, RowsReachTheFileByFlushing)
{
    History history(folder / "history.csv", columns);
    EXPECT_EQ(text(), "time_s,kinetic_energy_J\n");
    add(history, 0.0, 1e-9);
    EXPECT_EQ(text(), "time_s,kinetic_energy_J\n");
    history.flush();
    add(history, 0.1 + 0.2, 2.5);
    history.flush();
    history.flush();
    EXPECT_EQ(text(), "time_s,kinetic_energy_J\n0,1e-09\n0.30000000000000004,2.5\n");
}

TEST_F(HistoryFile, ResumedOneDropsRowsAfterTheCheckpoint)
{
    const double checkpoint_time = 0.1 + 0.2;
    {
        History history(folder / "history.csv", columns);
        for (const double time : {0.1, checkpoint_time, 0.4, 0.5})
            add(history, time, 1.0);
        history.flush();
    }
    std::ofstream(folder / "history.csv", std::ios::app) << "0.2,1"; // a row that a kill cut off
    History history(folder / "history.csv", columns, checkpoint_time);
    EXPECT_EQ(text(), "time_s,kinetic_energy_J\n0.1,1\n0.30000000000000004,1\n");
    add(history, 0.4, 2.0);
    history.flush();
    EXPECT_EQ(text(), "time_s,kinetic_energy_J\n0.1,1\n0.30000000000000004,1\n0.4,2\n");
}

TEST_F(HistoryFile, ResumedOneWithOtherColumnsOrNoneIsRefused)
{
    EXPECT_TRUE(one_line_with(message_of<OutputError>([&] { History(folder / "history.csv", columns, 0.0); }),
                              {"history.csv", "not there"}));
    {
        const History history(folder / "history.csv", {"time_s", "mass_kg"});
    }
    EXPECT_TRUE(one_line_with(message_of<OutputError>([&] { History(folder / "history.csv", columns, 0.0); }),
                              {"history.csv", "other columns"}));
}

TEST_F(HistoryFile, WrongUseIsRefused)
{
    EXPECT_THROW(History(folder / "history.csv", {}), std::logic_error);
    EXPECT_THROW(History(folder / "history.csv", {"time, s"}), std::logic_error);
    History history(folder / "history.csv", columns);
    const double row[]{1.0};
    EXPECT_THROW(history.add(row), std::logic_error);
}

TEST_F(HistoryFile, FullDiskLeavesWholeRowsAndLosesNone)
{
    History history(folder / "history.csv", columns);
    add(history, 0.0, 1.0);
    history.flush();
    const std::string before = text();
    for (int k = 1; k <= 1000; ++k)
        add(history, 0.001 * k, 1.0 / 3.0);
    std::string message;
    {
        const FileSizeLimit limit(4096);
        message = message_of<OutputError>([&] { history.flush(); });
    }
    EXPECT_TRUE(one_line_with(message, {"history.csv", "ulimit -f"}));
    EXPECT_EQ(text(), before);
    history.flush();
    const std::string after = text();
    EXPECT_EQ(std::count(after.begin(), after.end(), '\n'), 1002);
}

TEST_F(HistoryFile, RowsThatNobodyFlushesDoNotFillTheMemory)
{
    History history(folder / "history.csv", columns);
    constexpr int rows = 20'000; // a megabyte
    for (int k = 0; k < rows; ++k)
        add(history, 0.001 * k, 1.0 / 3.0);
    const auto written = std::filesystem::file_size(folder / "history.csv");
    history.flush();
    EXPECT_LE(std::filesystem::file_size(folder / "history.csv") - written, 1U << 16);
    const std::string after = text();
    EXPECT_EQ(std::count(after.begin(), after.end(), '\n'), rows + 1);
}

TEST_F(HistoryFile, VanishedFolderIsReported)
{
    History history(folder / "history.csv", columns);
    add(history, 0.0, 1.0);
    std::filesystem::remove(folder / "history.csv");
    EXPECT_TRUE(one_line_with(message_of<OutputError>([&] { history.flush(); }), {"history.csv", "not there"}));
}

} // namespace cupel::test
