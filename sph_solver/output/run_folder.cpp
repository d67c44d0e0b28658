#include "output/run_folder.hpp"

#include <string_view>

#include "output/atomic_file.hpp"

namespace cupel
{

namespace
{

namespace fs = std::filesystem;

/// Removes files with one of the given endings.
void remove_outputs(const fs::path& folder, std::initializer_list<std::string_view> endings)
{
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
        for (const auto ending : endings)
            if (entry->path().filename().string().ends_with(ending)) remove_file(entry->path());
    if (error) throw system_output_error(error.value(), folder, "read");
}

} // namespace

RunFolder open_run_folder(const fs::path& folder, bool resume)
{
    const RunFolder run{folder};
    create_folder(run.folder);
    remove_file(run.record());
    create_folder(run.fields());
    create_folder(run.checkpoints());
    remove_file(run.stopped_fields());
    remove_file(run.last_good_fields());
    if (resume) return run;
    remove_outputs(run.fields(), {".vtp", ".pvd", ".beside"});
    remove_outputs(run.checkpoints(), {".h5", ".beside"});
    remove_file(run.history());
    remove_file(run.log());
    return run;
}

} // namespace cupel
