/// cupel_sph: the SPH solver.
///
///   cupel_sph run RESOLVED.json --output FOLDER [--threads N] [--instructions SET] [--checkpoint-every SECONDS]
///                 [--resume]
///
/// RESOLVED.json is what `cupel_case resolve` prints. Exit status: 0 completed, 1 stopped by a guard or an output that
/// cannot be written, 2 refused, 130 interrupted after a checkpoint was left.
#include <cstdio>
#include <cstdlib>

#include <CLI/CLI.hpp>
#include <omp.h>

#include "output/atomic_file.hpp"
#include "output/signals.hpp"
#include "programs/engines.hpp"

namespace
{

constexpr int exit_stopped = 1;
constexpr int exit_refused = 2;

int run(const std::string& resolved_case, const std::string& instructions, const cupel::RecorderOptions& options)
{
    const cupel::Case definition = cupel::read_resolved_case(resolved_case);
    return static_cast<int>(cupel::choose_engine(definition.numerics.precision, instructions).run(definition, options));
}

} // namespace

int main(int argument_count, char** arguments)
{
    CLI::App program{"The SPH solver of Cupel."};
    program.require_subcommand(1);
    std::string resolved_case, folder, instructions;
    cupel::RecorderOptions options;
    options.threads = omp_get_max_threads();
    CLI::App* command = program.add_subcommand("run", "run a resolved case");
    command->add_option("case", resolved_case, "the resolved case (JSON)")->required();
    command->add_option("--output", folder, "folder of the result")->required();
    command->add_option("--threads", options.threads, "number of threads")->check(CLI::Range(1, 1024));
    command->add_option("--checkpoint-every", options.seconds_between_checkpoints, "seconds between checkpoints")
        ->check(CLI::NonNegativeNumber);
    command->add_option("--instructions", instructions, "avx512, avx2 or portable; default: the best of this machine")
        ->envname("CUPEL_INSTRUCTIONS");
    command->add_flag("--resume", options.resume, "go on from the newest checkpoint in the folder");
    try {
        program.parse(argument_count, arguments);
    }
    catch (const CLI::ParseError& error) {
        return program.exit(error) == 0 ? 0 : exit_refused;
    }
    options.folder = folder;
    omp_set_num_threads(options.threads);
    // VTK would look for the least and the greatest of each array with a thread for each processor, which would take
    // from the run's and cost more than they find.
    ::setenv("VTK_SMP_BACKEND_IN_USE", "Sequential", 0);
    cupel::catch_stop_signals();
    try {
        return run(resolved_case, instructions, options);
    }
    catch (const cupel::CaseError& error) {
        std::fprintf(stderr, "cupel_sph: %s\n", error.what());
        return exit_refused;
    }
    catch (const std::exception& error) {
        std::fprintf(stderr, "cupel_sph: %s\n", error.what());
        return exit_stopped;
    }
}
