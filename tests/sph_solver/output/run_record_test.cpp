#include "output/run_record.hpp"

#include <cmath>
#include <ctime>
#include <limits>
#include <thread>

#include "output/progress.hpp"
#include "output/run_folder.hpp"
#include "output/run_log.hpp"
#include "output_fixture.hpp"

namespace cupel::test
{

namespace
{

RunRecord some_record()
{
    RunRecord record;
    record.provenance = some_provenance();
    record.settings = {{"name", "droplet"}, {"hash", "d1ce0000d1ce0000"}};
    record.variant = "coarse";
    record.ledgers["energy"] = {10.0, 12.0, 3.0, 1.5, 0.0};
    record.ledger_details["energy"] = {{"laser_absorbed", 3.0}};
    record.cost.threads = 2;
    record.cost.steps = 100;
    record.cost.acoustic_steps = 400;
    record.cost.elements = 50;
    record.cost.element_updates = 5000;
    record.cost.wall_seconds = 5.0;
    record.cost.output_seconds = 0.25;
    record.cost.guard_seconds = 0.05;
    record.cost.time_step_binding = {{"acoustic", 90}, {"viscous", 10}};
    return record;
}

} // namespace

using RunRecordFile = OutputTest;

TEST_F(RunRecordFile, HoldsWhatTheResultNeeds)
{
    write_record(folder / "run.json", some_record());
    const auto read = nlohmann::json::parse(read_whole(folder / "run.json"));
    EXPECT_EQ(read["schema"], 1);
    EXPECT_EQ(read["case"], "droplet");
    EXPECT_EQ(read["solver"], "sph");
    EXPECT_EQ(read["variant"], "coarse");
    EXPECT_EQ(read["status"], "completed");
    EXPECT_EQ(read["diagnosis"], "");
    EXPECT_EQ(read["code"]["commit"], "0123456789ab");
    EXPECT_EQ(read["settings"]["hash"], "d1ce0000d1ce0000");
    EXPECT_EQ(read["ledgers"]["energy"]["laser_absorbed"], 3.0);
    EXPECT_DOUBLE_EQ(read["ledgers"]["energy"]["closure"], 0.5 / 3.0);
    EXPECT_DOUBLE_EQ(read["cost"]["updates_per_core_s"], 500.0);
    EXPECT_EQ(read["cost"]["time_step_binding"]["viscous"], 10);
    EXPECT_EQ(read["cost"]["steps"], 100);
    EXPECT_EQ(read["cost"]["acoustic_steps"], 400);
    EXPECT_EQ(read["cost"]["output_s"], 0.25);
    EXPECT_EQ(read["cost"]["guards_s"], 0.05);
    EXPECT_FALSE(read["host"]["name"].get<std::string>().empty());
    EXPECT_GE(read["host"]["cores"], 1);
}

TEST_F(RunRecordFile, TextIsEscapedAndNoNumberIsNaN)
{
    RunRecord record = some_record();
    record.status = RunStatus::stopped;
    record.diagnosis = "heat: \"temperature\" of C:\\x\n\xff";
    record.ledgers["energy"].end = std::nan("");
    record.cost.wall_seconds = std::numeric_limits<double>::infinity();
    write_record(folder / "run.json", record);
    const std::string text = read_whole(folder / "run.json");
    EXPECT_EQ(text.find("nan"), std::string::npos);
    EXPECT_EQ(text.find("inf"), std::string::npos);
    const auto read = nlohmann::json::parse(text);
    EXPECT_EQ(read["status"], "stopped");
    EXPECT_EQ(read["diagnosis"], "heat: \"temperature\" of C:\\x\n\xEF\xBF\xBD");
    EXPECT_TRUE(read["ledgers"]["energy"]["closure"].is_null());
    EXPECT_TRUE(read["cost"]["wall_s"].is_null());
}

TEST_F(RunRecordFile, CostOfThePartsOfARunAddsUp)
{
    const CostMeter meter(1000.0, 2000.0);
    const std::clock_t start = std::clock();
    while (std::clock() - start < CLOCKS_PER_SEC / 50)
        ; // 20 ms of processor time
    RunCost cost;
    cost.measure(meter);
    EXPECT_GE(cost.wall_seconds, 1000.019);
    EXPECT_GE(cost.cpu_seconds, 2000.019);
    EXPECT_LT(cost.cpu_seconds, 2010.0);
    EXPECT_GT(cost.peak_bytes, 1e6);
}

TEST(TimedScopes, AddUpTheTimeSpentInThem)
{
    double seconds = 10.0;
    for (int k = 0; k < 2; ++k) {
        const TimedScope timed(seconds);
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_GE(seconds, 10.02);
    EXPECT_LT(seconds, 15.0);
}

TEST(LedgerBooks, ClosureIsWhatTheyDoNotExplain)
{
    EXPECT_EQ((Ledger{5.0, 5.0, 0.0, 0.0, 0.0}.closure()), 0.0);
    EXPECT_DOUBLE_EQ((Ledger{0.0, 8.0, 10.0, 1.0, 0.0}.closure()), 0.1);
    EXPECT_DOUBLE_EQ((Ledger{0.0, -8.0, 0.0, 8.5, 0.0}.closure()), 0.0625);
    EXPECT_DOUBLE_EQ((Ledger{100.0, 101.0, 0.0, 0.0, 100.0}.closure()), 0.01);
    EXPECT_DOUBLE_EQ((Ledger{5.0, 5.0, 0.0, 2.0, 0.0}.closure()), 1.0);
    EXPECT_TRUE(std::isnan(Ledger{std::nan(""), 1.0, 0.0, 0.0, 0.0}.closure()));
}

using RunFolderOnDisk = OutputTest;

TEST_F(RunFolderOnDisk, NewRunRemovesTheEarlierOnesOutputs)
{
    const RunFolder run = open_run_folder(folder / "a" / "b", false);
    for (const auto& file : {run.record(), run.history(), run.log(), run.fields() / "fields_000000.vtp",
                             run.checkpoints() / "checkpoint_000000000001.h5", run.folder / "notes.txt"})
        write_whole(file, "x");
    open_run_folder(run.folder, true);
    EXPECT_FALSE(std::filesystem::exists(run.record()));
    EXPECT_TRUE(std::filesystem::exists(run.history()));
    EXPECT_TRUE(std::filesystem::exists(run.checkpoints() / "checkpoint_000000000001.h5"));
    open_run_folder(run.folder, false);
    EXPECT_FALSE(std::filesystem::exists(run.history()));
    EXPECT_FALSE(std::filesystem::exists(run.log()));
    EXPECT_TRUE(std::filesystem::is_empty(run.fields()));
    EXPECT_TRUE(std::filesystem::is_empty(run.checkpoints()));
    EXPECT_TRUE(std::filesystem::exists(run.folder / "notes.txt"));
}

TEST_F(RunFolderOnDisk, ThatCannotBeWrittenIsRefused)
{
    EXPECT_TRUE(one_line_with(message_of<OutputError>([] { open_run_folder("/proc/results", false); }),
                              {"/proc/results", "--output"}));
}

using RunLogFile = OutputTest;

TEST_F(RunLogFile, HoldsEveryLineAndStderrTheWarnings)
{
    ::testing::internal::CaptureStderr();
    {
        const auto log = open_run_log(folder / "log.txt", false);
        log->info("time step bound by {}", "acoustic");
        log->warn("the commit differs");
        EXPECT_NE(read_whole(folder / "log.txt").find("acoustic"), std::string::npos) << "a line waits in memory";
    }
    open_run_log(folder / "log.txt", true)->info("resumed");
    const std::string text = read_whole(folder / "log.txt");
    EXPECT_NE(text.find("info: time step bound by acoustic\n"), std::string::npos) << text;
    EXPECT_NE(text.find("info: resumed\n"), std::string::npos) << text;
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "warning: the commit differs\n");
}

TEST_F(RunLogFile, ThatCannotBeOpenedOrFilledIsSaidInOneLine)
{
    EXPECT_TRUE(one_line_with(message_of<OutputError>([&] { open_run_log(folder / "gone" / "log.txt", false); }),
                              {"gone/log.txt", "not there"}));
    ::testing::internal::CaptureStderr();
    const auto log = open_run_log("/dev/full", true);
    log->info("first");
    log->info("second");
    const std::string said = ::testing::internal::GetCapturedStderr();
    EXPECT_NE(said.find("/dev/full: the log is not complete"), std::string::npos) << said;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
}

using ProgressLines = OutputTest;

TEST_F(ProgressLines, AreJsonAndNotMoreThanAsked)
{
    const auto file = folder / "stdout";
    std::FILE* stream = std::fopen(file.c_str(), "w");
    ASSERT_NE(stream, nullptr);
    Progress rare(6.7e-3, 100.0, stream, std::chrono::hours(1));
    EXPECT_FALSE(rare.update(0.0, 1));
    Progress progress(6.7e-3, 100.0, stream, std::chrono::milliseconds(0));
    EXPECT_TRUE(progress.update(1.2e-3, 1234));
    progress.write(6.7e-3, 5000);
    std::fclose(stream);
    const std::string text = read_whole(file);
    ASSERT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
    const auto line = nlohmann::json::parse(text.substr(0, text.find('\n')))["progress"];
    EXPECT_EQ(line["time"], 1.2e-3);
    EXPECT_EQ(line["end"], 6.7e-3);
    EXPECT_EQ(line["step"], 1234);
    EXPECT_GE(line["wall_s"], 100.0);
}

TEST(StopSignals, SetTheFlagAndEndTheProgramTheThirdTime)
{
    EXPECT_EXIT(
        {
            catch_stop_signals();
            std::raise(SIGINT);
            std::raise(SIGTERM);
            std::_Exit(stop_requested() && stop_signal == SIGTERM ? 42 : 1);
        },
        ::testing::ExitedWithCode(42), "");
    EXPECT_EXIT(
        {
            catch_stop_signals();
            for (int k = 0; k < 3; ++k)
                std::raise(SIGINT);
            std::_Exit(1);
        },
        ::testing::KilledBySignal(SIGINT), "");
}

} // namespace cupel::test
