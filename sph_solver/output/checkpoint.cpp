#include "output/checkpoint.hpp"

#include <algorithm>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sstream>
#include <unistd.h>
#include <zlib.h>

#include "output/hdf5_file.hpp"

namespace cupel
{

namespace
{

namespace fs = std::filesystem;

constexpr std::size_t header_size = 512;
constexpr int format_version = 2;
constexpr const char* title_line = "Cupel checkpoint\n";
constexpr std::size_t checksum_digits = 8;

OutputError refused(const fs::path& file, std::string_view what)
{
    return OutputError(fmt::format("{}: {}; remove it to resume from an earlier checkpoint, or start the run anew",
                                   file.string(), what));
}

std::uint32_t checksum(std::uint32_t before, const char* bytes, std::size_t count)
{
    return static_cast<std::uint32_t>(crc32_z(before, reinterpret_cast<const Bytef*>(bytes), count));
}

/// Header text and the place of its checksum digits, which are zeros here.
std::string header_text(const Provenance& provenance, std::size_t size)
{
    return fmt::format("{}format {}\nversion {}\ncommit {}\ncase {}\nsize {}\nchecksum {}\n", title_line,
                       format_version, provenance.code.version, provenance.code.commit, provenance.case_hash, size,
                       std::string(checksum_digits, '0'));
}

std::size_t checksum_place(std::string_view header)
{
    constexpr std::string_view key = "\nchecksum ";
    const auto place = header.find(key);
    return place == std::string_view::npos ? place : place + key.size();
}

/// Names and values of the header's lines after the first.
std::map<std::string, std::string> header_entries(const std::string& header)
{
    std::map<std::string, std::string> entries;
    std::istringstream lines(header.substr(0, header.find('\0')));
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
        const auto blank = line.find(' ');
        if (blank != std::string::npos) entries[line.substr(0, blank)] = line.substr(blank + 1);
    }
    return entries;
}

/// Reads the file through and returns its header's entries. Throws OutputError where a bit of it is not as written.
std::map<std::string, std::string> verified_header(const fs::path& file)
{
    FileDescriptor input(file, O_RDONLY, "read");
    std::string block(1 << 20, '\0');
    std::uint32_t computed = checksum(0, nullptr, 0);
    std::size_t size = 0;
    std::string header;
    std::size_t digits = std::string::npos;
    while (true) {
        std::size_t filled = 0;
        while (filled < block.size()) {
            const auto count = ::read(input.number(), block.data() + filled, block.size() - filled);
            if (count == 0) break;
            if (count < 0 && errno != EINTR) throw system_output_error(errno, file, "read");
            if (count > 0) filled += static_cast<std::size_t>(count);
        }
        if (size == 0) {
            header = block.substr(0, std::min(filled, header_size));
            digits = checksum_place(header);
            if (filled == 0) throw refused(file, "is empty");
            if (!header.starts_with(title_line) || digits == std::string::npos)
                throw refused(file, "is not a Cupel checkpoint, or its beginning is damaged");
            std::memset(block.data() + digits, '0', checksum_digits);
        }
        computed = checksum(computed, block.data(), filled);
        size += filled;
        if (filled < block.size()) break;
    }
    const auto entries = header_entries(header);
    const auto entry = [&](const char* name) { return entries.contains(name) ? entries.at(name) : std::string(); };
    if (entry("format") != std::to_string(format_version))
        throw refused(
            file, fmt::format("has format '{}', but this program reads format {}", entry("format"), format_version));
    if (entry("size") != std::to_string(size))
        throw refused(file, fmt::format("is truncated or damaged: it has {} of '{}' bytes", size, entry("size")));
    if (entry("checksum") != fmt::format("{:08x}", computed))
        throw refused(file, fmt::format("is damaged: its checksum is {:08x}, not '{}'", computed, entry("checksum")));
    return entries;
}

std::vector<std::string> field_names(const auto& fields)
{
    std::vector<std::string> names;
    for (const auto& field : fields)
        names.push_back(field->info.name);
    std::sort(names.begin(), names.end());
    return names;
}

/// Refuses a file whose fields are not those of the scene.
void compare_fields(const fs::path& file, const std::vector<std::string>& kept, const std::vector<std::string>& needed)
{
    for (const auto& name : needed)
        if (!std::binary_search(kept.begin(), kept.end(), name))
            throw refused(file, "has no field '" + name + "', which this run needs");
    for (const auto& name : kept)
        if (!std::binary_search(needed.begin(), needed.end(), name))
            throw refused(file, "has a field '" + name + "', which this run does not know");
}

template <class T, class Values> std::span<T> first(Values& values, std::size_t count)
{
    return {reinterpret_cast<T*>(values.data()), count};
}

std::size_t step_of(const fs::path& file)
{
    std::size_t step = 0;
    const std::string name = file.filename().string();
    const int matched = std::sscanf(name.c_str(), "checkpoint_%zu.h5", &step);
    return matched == 1 && name == fmt::format("checkpoint_{:012}.h5", step) ? step : std::string::npos;
}

/// Checkpoints in a folder, the newest first.
std::vector<fs::path> list_checkpoints(const fs::path& folder)
{
    std::vector<fs::path> found;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
        if (step_of(entry->path()) != std::string::npos) found.push_back(entry->path());
    if (error) throw system_output_error(error.value(), folder, "read");
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return step_of(a) > step_of(b); });
    return found;
}

} // namespace

void save_checkpoint(const fs::path& file, const Provenance& provenance, const Particles& particles,
                     const RunState& state)
{
    const auto count = static_cast<std::size_t>(particles.count());
    HdfWriter writer(file, particles.bytes() + (1 << 20), header_size);
    for (const char* group : {"/particles", "/particles/scalars", "/particles/vectors", "/numbers", "/arrays"})
        writer.add_group(group);

    for (const auto& field : particles.scalars()) {
        const std::string path = "/particles/scalars/" + field->info.name;
        writer.add_array<double>(path, first<const double>(field->values, count));
        writer.add_text(path, "unit", field->info.unit);
    }
    for (const auto& field : particles.vectors()) {
        const std::string path = "/particles/vectors/" + field->info.name;
        const std::span<const double> rows[]{first<const double>(field->x, count), first<const double>(field->y, count),
                                             first<const double>(field->z, count)};
        writer.add_array<double>(path, rows);
        writer.add_text(path, "unit", field->info.unit);
    }
    writer.add_array<std::uint8_t>("/particles/kind", first<const std::uint8_t>(particles.kind, count));
    writer.add_array<std::uint8_t>("/particles/material", first<const std::uint8_t>(particles.material, count));
    writer.add_array<Index>("/particles/identity", first<const Index>(particles.identity, count));
    writer.add_array<Index>("/particles/surface_parent", first<const Index>(particles.surface_parent, count));

    writer.add_number("/", "time", state.time);
    writer.add_number("/", "step", static_cast<double>(state.step));
    for (const auto& [name, value] : state.numbers)
        writer.add_number("/numbers", name, value);
    for (const auto& [name, values] : state.arrays)
        writer.add_array<double>("/arrays/" + name, values);
    writer.add_text("/", "case", provenance.case_name);
    writer.add_text("/", "case_hash", provenance.case_hash);
    writer.add_text("/", "code_version", provenance.code.version);
    writer.add_text("/", "code_commit", provenance.code.commit);
    writer.add_document("/resolved_case", provenance.resolved_case);

    const std::span<char> bytes = writer.bytes();
    const std::string header = header_text(provenance, bytes.size());
    if (header.size() > header_size) throw std::logic_error("the header of a checkpoint is too long");
    std::fill_n(bytes.begin(), header_size, '\0');
    std::copy(header.begin(), header.end(), bytes.begin());
    const std::string digits = fmt::format("{:08x}", checksum(0, bytes.data(), bytes.size()));
    std::copy(digits.begin(), digits.end(), bytes.begin() + static_cast<std::ptrdiff_t>(checksum_place(header)));
    write_whole(file, {bytes.data(), bytes.size()});
}

LoadedCheckpoint load_checkpoint(const fs::path& file, const Provenance& provenance, Particles& particles)
{
    const auto header = verified_header(file);
    if (header.at("version") != provenance.code.version)
        throw refused(file, fmt::format("was written by version {} of the code, this is {}", header.at("version"),
                                        provenance.code.version));
    if (header.at("case") != provenance.case_hash)
        throw refused(file, "belongs to another case, or to this one with other settings (its hash is " +
                                header.at("case").substr(0, 12) + ", not " + provenance.case_hash.substr(0, 12) + ")");
    const HdfReader reader(file);
    const auto count = static_cast<std::size_t>(particles.count());
    if (const auto kept = reader.length("/particles/kind"); kept != count)
        throw refused(file, fmt::format("has {} particles, the scene has {}", kept, count));
    compare_fields(file, reader.names("/particles/scalars"), field_names(particles.scalars()));
    compare_fields(file, reader.names("/particles/vectors"), field_names(particles.vectors()));

    for (const auto& field : particles.scalars())
        reader.read_array<double>("/particles/scalars/" + field->info.name, first<double>(field->values, count));
    for (const auto& field : particles.vectors()) {
        const std::span<double> rows[]{first<double>(field->x, count), first<double>(field->y, count),
                                       first<double>(field->z, count)};
        reader.read_array<double>("/particles/vectors/" + field->info.name, rows);
    }
    reader.read_array<std::uint8_t>("/particles/kind", first<std::uint8_t>(particles.kind, count));
    reader.read_array<std::uint8_t>("/particles/material", first<std::uint8_t>(particles.material, count));
    reader.read_array<Index>("/particles/identity", first<Index>(particles.identity, count));
    reader.read_array<Index>("/particles/surface_parent", first<Index>(particles.surface_parent, count));
    particles.rebuild_places();

    LoadedCheckpoint loaded;
    loaded.commit = header.at("commit");
    loaded.state.time = reader.number("/", "time");
    loaded.state.step = static_cast<std::uint64_t>(reader.number("/", "step"));
    for (const auto& name : reader.attribute_names("/numbers"))
        loaded.state.numbers[name] = reader.number("/numbers", name);
    for (const auto& name : reader.names("/arrays")) {
        auto& values = loaded.state.arrays[name];
        values.resize(reader.length("/arrays/" + name));
        reader.read_array<double>("/arrays/" + name, std::span<double>(values));
    }
    return loaded;
}

std::optional<fs::path> newest_checkpoint(const fs::path& folder)
{
    if (!fs::exists(folder)) return {};
    const auto found = list_checkpoints(folder);
    return found.empty() ? std::optional<fs::path>() : found.front();
}

Checkpoints::Checkpoints(fs::path folder, Provenance provenance, std::chrono::duration<double> interval)
    : folder_(std::move(folder)), provenance_(std::move(provenance)), interval_(interval)
{}

bool Checkpoints::due() const
{
    return Clock::now() - last_ >= std::max(interval_, 100.0 * last_cost_);
}

fs::path Checkpoints::write(const Particles& particles, const RunState& state)
{
    constexpr std::size_t kept = 2;
    const auto start = Clock::now();
    const fs::path file = folder_ / fmt::format("checkpoint_{:012}.h5", state.step);
    save_checkpoint(file, provenance_, particles, state);
    const auto found = list_checkpoints(folder_);
    for (std::size_t k = kept; k < found.size(); ++k)
        remove_file(found[k]);
    last_ = Clock::now();
    last_cost_ = last_ - start;
    return file;
}

} // namespace cupel
