#include "output/checkpoint.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "ledgers/ledger.hpp"
#include "output_fixture.hpp"

namespace cupel::test
{

namespace
{

constexpr Index count = 1003; // not a multiple of the lanes

RunState some_state()
{
    RunState state;
    state.time = 0.1 + 0.2;
    state.step = (std::uint64_t{1} << 52U) + 1;
    state.numbers = {{"next_output", 1.0 / 3.0}, {"thermal_time", 5e-324}};
    save_ledger("energy", {1.0 / 7.0, 2.0, 3.0, 4.0, 5.0}, state.numbers);
    state.arrays = {{"binding", {1.0, 2.0, 1e300}}, {"none", {}}};
    return state;
}

} // namespace

class CheckpointFile : public OutputTest
{
protected:
    void SetUp() override
    {
        OutputTest::SetUp();
        register_fields(particles);
        fill_particles(particles, 1);
        file = folder / "checkpoint_000000000007.h5";
    }

    /// What loading the file says, "" where it is accepted.
    std::string refusal(const Provenance& provenance = some_provenance())
    {
        Particles loaded(count);
        register_fields(loaded);
        Particles untouched(count);
        register_fields(untouched);
        std::string message = message_of<OutputError>([&] { load_checkpoint(file, provenance, loaded); });
        if (!message.empty()) {
            EXPECT_TRUE(same_particles(loaded, untouched)) << "a refused checkpoint has changed the particles";
        }
        return message;
    }

    /// Changes the saved file's bytes.
    void tamper(const std::function<void(std::string&)>& change)
    {
        save_checkpoint(file, some_provenance(), particles, some_state());
        std::string bytes = read_whole(file);
        change(bytes);
        std::ofstream(file, std::ios::binary) << bytes;
    }

    Particles particles{count};
    std::filesystem::path file;
};

TEST_F(CheckpointFile, BringsBackEveryBit)
{
    particles.scalar("enthalpy")[3] = -0.0;
    particles.scalar("enthalpy")[4] = std::nextafter(1.0, 2.0);
    particles.scalar("enthalpy")[5] = std::numeric_limits<double>::denorm_min();
    const RunState state = some_state();
    save_checkpoint(file, some_provenance(), particles, state);

    Particles loaded(count);
    register_fields(loaded);
    const LoadedCheckpoint checkpoint = load_checkpoint(file, some_provenance(), loaded);
    EXPECT_TRUE(same_particles(loaded, particles));
    EXPECT_EQ(checkpoint.commit, "0123456789ab");
    EXPECT_EQ(checkpoint.state.time, state.time);
    EXPECT_EQ(checkpoint.state.step, state.step);
    EXPECT_EQ(checkpoint.state.numbers, state.numbers);
    EXPECT_EQ(checkpoint.state.arrays, state.arrays);
    EXPECT_EQ(load_ledger("energy", checkpoint.state.numbers).reference, 5.0);
}

TEST_F(CheckpointFile, SameStateGivesTheSameFileAtAnyTime)
{
    save_checkpoint(file, some_provenance(), particles, some_state());
    const std::string once = read_whole(file);
    std::this_thread::sleep_for(std::chrono::milliseconds(1010)); // the library's times count seconds
    save_checkpoint(file, some_provenance(), particles, some_state());
    EXPECT_TRUE(once == read_whole(file));
}

TEST_F(CheckpointFile, TruncatedOneIsRefused)
{
    for (const double share : {0.999, 0.5, 0.02}) {
        tamper([&](std::string& bytes) {
            bytes.resize(static_cast<std::size_t>(share * static_cast<double>(bytes.size())));
        });
        EXPECT_TRUE(one_line_with(refusal(), {file.string(), "truncated", "start the run anew"}));
    }
    tamper([](std::string& bytes) { bytes.resize(20); });
    EXPECT_TRUE(one_line_with(refusal(), {file.string(), "beginning is damaged"}));
    tamper([](std::string& bytes) { bytes.clear(); });
    EXPECT_TRUE(one_line_with(refusal(), {file.string(), "is empty"}));
}

TEST_F(CheckpointFile, OneFlippedBitAnywhereIsRefused)
{
    save_checkpoint(file, some_provenance(), particles, some_state());
    const std::string good = read_whole(file);
    const std::size_t size = good.size();
    for (std::size_t k = 0; k < 60; ++k) {
        // The header densely, the rest in even steps.
        const std::size_t place = k < 40 ? 13 * k : 520 + (k - 40) * (size - 521) / 19;
        std::string bytes = good;
        bytes[place] = static_cast<char>(bytes[place] ^ (1 << (k % 8)));
        std::ofstream(file, std::ios::binary) << bytes;
        EXPECT_TRUE(one_line_with(refusal(), {file.string()})) << "byte " << place;
    }
}

TEST_F(CheckpointFile, OtherCaseIsRefused)
{
    save_checkpoint(file, some_provenance(), particles, some_state());
    Provenance other = some_provenance();
    other.case_hash = "facade000000";
    EXPECT_TRUE(one_line_with(refusal(other), {file.string(), "another case", "d1ce0000d1ce", "facade000000"}));
}

TEST_F(CheckpointFile, OtherVersionIsRefused)
{
    Provenance other = some_provenance();
    other.code.version = "0.0.9";
    save_checkpoint(file, other, particles, some_state());
    EXPECT_TRUE(one_line_with(refusal(), {file.string(), "version 0.0.9", "this is 0.1.0"}));
}

TEST_F(CheckpointFile, OtherFormatIsRefused)
{
    tamper([](std::string& bytes) { bytes[bytes.find("format 2") + 7] = '1'; });
    EXPECT_TRUE(one_line_with(refusal(), {file.string(), "format '1'", "format 2"}));
}

TEST_F(CheckpointFile, MissingAndUnknownFieldsAreRefused)
{
    Particles fewer(count);
    register_fields(fewer);
    save_checkpoint(file, some_provenance(), fewer, some_state());
    Particles more(count);
    register_fields(more);
    more.add_scalar({"liquid_fraction", "1", Output::yes});
    EXPECT_TRUE(one_line_with(message_of<OutputError>([&] { load_checkpoint(file, some_provenance(), more); }),
                              {file.string(), "no field 'liquid_fraction'"}));
    more.add_vector({"stress", "Pa"});
    save_checkpoint(file, some_provenance(), more, some_state());
    EXPECT_TRUE(one_line_with(refusal(), {file.string(), "a field 'liquid_fraction'", "does not know"}));
}

TEST_F(CheckpointFile, OtherNumberOfParticlesIsRefused)
{
    Particles fewer(count - 1);
    register_fields(fewer);
    save_checkpoint(file, some_provenance(), fewer, some_state());
    EXPECT_TRUE(one_line_with(refusal(), {file.string(), "1002 particles", "1003"}));
}

TEST_F(CheckpointFile, WhatIsNoCheckpointIsRefused)
{
    EXPECT_TRUE(one_line_with(refusal(), {file.string(), "not there"}));
    write_whole(file, std::string(5000, 'x'));
    EXPECT_TRUE(one_line_with(refusal(), {file.string(), "not a Cupel checkpoint"}));
}

TEST_F(CheckpointFile, TheLastTwoAreKeptAndTheNewestIsFound)
{
    EXPECT_FALSE(newest_checkpoint(folder).has_value());
    EXPECT_FALSE(newest_checkpoint(folder / "none").has_value());
    Checkpoints checkpoints(folder, some_provenance());
    write_whole(folder / "notes.h5", "not ours");
    RunState state = some_state();
    for (state.step = 8; state.step <= 11; ++state.step)
        checkpoints.write(particles, state);
    EXPECT_EQ(newest_checkpoint(folder), folder / "checkpoint_000000000011.h5");
    EXPECT_TRUE(std::filesystem::exists(folder / "checkpoint_000000000010.h5"));
    EXPECT_FALSE(std::filesystem::exists(folder / "checkpoint_000000000009.h5"));
    EXPECT_TRUE(std::filesystem::exists(folder / "notes.h5"));
}

TEST_F(CheckpointFile, IsDueAfterTheInterval)
{
    const Checkpoints soon(folder, some_provenance(), std::chrono::seconds(0));
    const Checkpoints late(folder, some_provenance(), std::chrono::hours(1));
    EXPECT_TRUE(soon.due());
    EXPECT_FALSE(late.due());
}

TEST_F(CheckpointFile, FullDiskLeavesTheLastOneIntact)
{
    Checkpoints checkpoints(folder, some_provenance());
    RunState state = some_state();
    state.step = 1;
    checkpoints.write(particles, state);
    state.step = 2;
    std::string message;
    {
        const FileSizeLimit limit(4096);
        message = message_of<OutputError>([&] { checkpoints.write(particles, state); });
    }
    EXPECT_TRUE(one_line_with(message, {"checkpoint_000000000002.h5", "ulimit -f"}));
    file = *newest_checkpoint(folder);
    EXPECT_EQ(file, folder / "checkpoint_000000000001.h5");
    EXPECT_EQ(refusal(), "");
}

TEST_F(CheckpointFile, VanishedFolderIsReported)
{
    Checkpoints checkpoints(folder / "gone", some_provenance());
    EXPECT_TRUE(one_line_with(message_of<OutputError>([&] { checkpoints.write(particles, some_state()); }),
                              {"gone/checkpoint_", "not there"}));
}

TEST_F(CheckpointFile, AKillAtAnyByteLeavesTheLastOneIntact)
{
    // The system kills a process that writes beyond the limit it was given: a kill after exactly so many bytes, both of
    // a checkpoint with a new name and of one that replaces an earlier one.
    Checkpoints checkpoints(folder, some_provenance());
    RunState state = some_state();
    state.step = 1;
    file = checkpoints.write(particles, state);
    const std::string good = read_whole(file);
    for (std::size_t k = 0; k < 20; ++k) {
        const rlim_t bytes = k * good.size() / 20;
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            const rlimit no_core{0, 0};
            ::setrlimit(RLIMIT_CORE, &no_core);
            const FileSizeLimit limit(bytes);
            std::signal(SIGXFSZ, SIG_DFL);
            state.step = 1 + k % 2;
            particles.scalar("enthalpy")[0] = 1.0;
            checkpoints.write(particles, state);
            std::_Exit(0);
        }
        int status = 0;
        ASSERT_EQ(::waitpid(child, &status, 0), child);
        ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGXFSZ) << "not killed at byte " << bytes;
        EXPECT_EQ(newest_checkpoint(folder), file) << "killed at byte " << bytes;
        EXPECT_TRUE(read_whole(file) == good) << "killed at byte " << bytes;
    }
    EXPECT_EQ(refusal(), "");
}

TEST_F(CheckpointFile, AKillAtAnyMomentLeavesAGoodOne)
{
    // A process that writes checkpoints as fast as it can, each with its step in every number, is killed at 20 moments.
    std::mt19937 generator(20);
    Checkpoints checkpoints(folder, some_provenance());
    RunState state;
    const auto first = checkpoints.write(particles, state);
    std::uint64_t greatest = 0;
    for (int kill_number = 0; kill_number < 20; ++kill_number) {
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            for (state.step = greatest + 1;; ++state.step) {
                std::fill_n(particles.scalar("enthalpy").values.begin(), count, static_cast<double>(state.step));
                state.time = static_cast<double>(state.step);
                checkpoints.write(particles, state);
            }
        }
        // The first one is given the time to write something, on however busy a machine.
        for (int wait = 0; greatest == 0 && wait < 30'000 && newest_checkpoint(folder) == first; ++wait)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        std::this_thread::sleep_for(std::chrono::microseconds(generator() % 18000));
        ::kill(child, SIGKILL);
        int status = 0;
        ASSERT_EQ(::waitpid(child, &status, 0), child);
        ASSERT_TRUE(WIFSIGNALED(status)) << "the writing process ended by itself";

        Particles loaded(count);
        register_fields(loaded);
        const auto newest = newest_checkpoint(folder);
        ASSERT_TRUE(newest.has_value());
        const LoadedCheckpoint checkpoint = load_checkpoint(*newest, some_provenance(), loaded);
        EXPECT_GE(checkpoint.state.step, greatest);
        EXPECT_EQ(checkpoint.state.time, static_cast<double>(checkpoint.state.step));
        if (checkpoint.state.step > 0) {
            EXPECT_EQ(loaded.scalar("enthalpy")[count - 1], static_cast<double>(checkpoint.state.step));
        }
        greatest = checkpoint.state.step;
    }
    EXPECT_GT(greatest, 0U) << "no checkpoint was written between the kills";
}

} // namespace cupel::test
