#include "output/atomic_file.hpp"

#include <cerrno>
#include <fcntl.h>
#include <fstream>

#include "output_fixture.hpp"

namespace cupel::test
{

using AtomicFile = OutputTest;

TEST_F(AtomicFile, WritesAndReplacesTheWholeContent)
{
    const auto file = folder / "run.json";
    write_whole(file, "a longer first content");
    write_whole(file, "second");
    EXPECT_EQ(read_whole(file), "second");
    EXPECT_FALSE(std::filesystem::exists(beside(file)));
}

TEST_F(AtomicFile, KeepsEveryByte)
{
    std::string content(3'000'000, '\0'); // longer than a block of reading
    for (std::size_t k = 0; k < content.size(); ++k)
        content[k] = static_cast<char>(k * 31 + k / 256);
    write_whole(folder / "bytes", content);
    EXPECT_EQ(read_whole(folder / "bytes"), content);
}

TEST_F(AtomicFile, FlushedLaterIsWholeAllTheSame)
{
    const auto file = folder / "field.vtp";
    write_whole(file, "old");
    write_whole(file, "new", Flush::later);
    EXPECT_EQ(read_whole(file), "new");
    EXPECT_FALSE(std::filesystem::exists(beside(file)));
    flush_to_disk(file);
    flush_to_disk(folder);
    flush_to_disk(folder / "removed");
}

TEST_F(AtomicFile, FullDiskLeavesTheOldFileAndNothingBeside)
{
    const auto file = folder / "field.vtp";
    write_whole(file, "old");
    std::string message;
    {
        const FileSizeLimit limit(1024);
        message = message_of<OutputError>([&] { write_whole(file, std::string(100'000, 'x')); });
    }
    EXPECT_TRUE(one_line_with(message, {"field.vtp", "may write", "ulimit -f"}));
    EXPECT_EQ(read_whole(file), "old");
    EXPECT_FALSE(std::filesystem::exists(beside(file)));
}

TEST_F(AtomicFile, AWriteThatTheDiskRefusesIsReported)
{
    const std::string message =
        message_of<OutputError>([] { FileDescriptor("/dev/full", O_WRONLY, "written").write("does not fit"); });
    EXPECT_TRUE(one_line_with(message, {"/dev/full", "the disk is full", "--resume"}));
}

TEST_F(AtomicFile, VanishedFolderIsNamed)
{
    const auto run = folder / "results";
    create_folder(run);
    write_whole(run / "run.json", "{}");
    std::filesystem::remove_all(run);
    EXPECT_TRUE(one_line_with(message_of<OutputError>([&] { write_whole(run / "run.json", "{}"); }),
                              {"results/run.json", "not there", "--output"}));
}

TEST_F(AtomicFile, FolderThatCannotBeMadeIsNamed)
{
    std::ofstream(folder / "plain_file") << "no folder";
    EXPECT_TRUE(one_line_with(message_of<OutputError>([&] { create_folder(folder / "plain_file" / "results"); }),
                              {"plain_file/results", "cannot be made", "--output"}));
    EXPECT_TRUE(one_line_with(message_of<OutputError>([&] { create_folder("/proc/results"); }),
                              {"/proc/results", "cannot be made"}));
    EXPECT_TRUE(one_line_with(message_of<OutputError>([&] { create_folder(folder / "plain_file"); }),
                              {"plain_file", "a file, not a folder"}));
}

TEST_F(AtomicFile, EveryExpectedSystemErrorNamesItsRemedy)
{
    for (const int error : {ENOSPC, EDQUOT, EFBIG, EROFS, EACCES, EPERM, ENOENT, ENOTDIR, EIO, EMFILE})
        EXPECT_TRUE(one_line_with(system_output_error(error, "/results/history.csv", "written").what(),
                                  {"/results/history.csv: cannot be written: ", "; "}));
}

} // namespace cupel::test
