/// What the tests of output share: a folder of their own, and particles with every kind of content.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <sys/resource.h>

#include "output/code_identity.hpp"
#include "output/signals.hpp"
#include "particles/particles.hpp"

namespace cupel::test
{

/// A new empty folder for each test, removed after it.
class OutputTest : public ::testing::Test
{
protected:
    void SetUp() override
    {
        std::string pattern = (std::filesystem::temp_directory_path() / "cupel_output_XXXXXX").string();
        ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
        folder = pattern;
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::filesystem::path folder;
};

inline Provenance some_provenance()
{
    return {{"0.1.0", "0123456789ab"}, "droplet", "d1ce0000d1ce0000", "{\"name\": \"droplet\"}"};
}

/// Registers what a scene with heat has, with all values zero.
inline void register_fields(Particles& particles)
{
    particles.add_scalar({"temperature", "K", Output::yes});
    particles.add_scalar({"enthalpy", "J/kg"});
    particles.add_vector({"surface_normal", "1", Output::yes});
}

/// Random doubles of all magnitudes, among them numbers that a decimal text would not bring back; the last quarter
/// are walls, the quarter before them of the second material; order and identity differ.
inline void fill_particles(Particles& particles, unsigned seed)
{
    std::mt19937_64 generator(seed);
    const auto value = [&] {
        return std::ldexp(static_cast<double>(generator() >> 11U), static_cast<int>(generator() % 80) - 90);
    };
    const auto count = static_cast<std::size_t>(particles.count());
    const auto fill = [&](Array& values) {
        for (std::size_t k = 0; k < count; ++k)
            values[k] = value();
    };
    for (const auto& field : particles.scalars())
        fill(field->values);
    for (const auto& field : particles.vectors())
        for (Array* component : {&field->x, &field->y, &field->z})
            fill(*component);
    for (std::size_t k = 0; k < count; ++k) {
        particles.kind[k] = k >= 3 * count / 4 ? Kind::wall : (k % 3 == 0 ? Kind::solid : Kind::fluid);
        particles.material[k] = k >= count / 2 && k < 3 * count / 4 ? 1 : 0;
        particles.identity[k] = static_cast<Index>(count - 1 - k);
        particles.surface_parent[k] = particles.kind[k] == Kind::wall ? static_cast<Index>(k % 7) : -1;
    }
    particles.rebuild_places();
}

inline bool same_bits(const Array& one, const Array& other)
{
    return one.size() == other.size() && std::memcmp(one.data(), other.data(), one.size() * sizeof(double)) == 0;
}

/// Whether two sets of particles have the same fields with the same bits.
inline bool same_particles(const Particles& one, const Particles& other)
{
    bool same = one.kind == other.kind && one.material == other.material && one.identity == other.identity &&
                one.surface_parent == other.surface_parent && one.scalars().size() == other.scalars().size() &&
                one.vectors().size() == other.vectors().size();
    for (const auto& field : one.scalars())
        same = same && same_bits(field->values, other.scalar(field->info.name).values);
    for (const auto& field : one.vectors()) {
        const VectorField& counterpart = other.vector(field->info.name);
        same = same && same_bits(field->x, counterpart.x) && same_bits(field->y, counterpart.y) &&
               same_bits(field->z, counterpart.z);
    }
    for (Index identity = 0; identity < one.count(); ++identity)
        same = same && one.place_of(identity) == other.place_of(identity);
    return same;
}

/// Until the end of its scope this process may write no file beyond `bytes`: a disk that is full.
class FileSizeLimit
{
public:
    explicit FileSizeLimit(rlim_t bytes)
    {
        std::signal(SIGXFSZ, SIG_IGN);
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit lower{bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &lower);
    }
    ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

private:
    rlimit before_{};
};

/// The text of the exception that a call throws; empty where it throws none of this type.
template <class Error, class Call> std::string message_of(Call&& call)
{
    try {
        call();
    }
    catch (const Error& error) {
        return error.what();
    }
    return {};
}

/// Whether a text is one line that has all the parts.
inline ::testing::AssertionResult one_line_with(const std::string& text, std::initializer_list<std::string> parts)
{
    if (text.empty()) return ::testing::AssertionFailure() << "nothing was said";
    if (text.find('\n') != std::string::npos) return ::testing::AssertionFailure() << "more than a line: " << text;
    for (const auto& part : parts)
        if (text.find(part) == std::string::npos)
            return ::testing::AssertionFailure() << "'" << part << "' is not in: " << text;
    return ::testing::AssertionSuccess();
}

} // namespace cupel::test
