/// cupel_case: what a case file says.
///
///   cupel_case resolve CASE.toml [--level coarse] [--variation NAME] [--set key=value ...]   the resolved case as JSON
///   cupel_case summary CASE.toml       its tier, and its variations with their names and levels, as JSON
///   cupel_case schema                  JSON schema of case files
///   cupel_case list-parameters         every parameter, as Markdown
///
/// Bad input: one line on stderr, FILE:LINE:COLUMN: key: what; what to do; exit status 2, nothing on stdout.
#include "scene/resolve.hpp"
#include "scene/schema.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>

namespace
{

constexpr int exit_failed = 1;
constexpr int exit_refused = 2;

/// Writes a text to stdout; a closed pipe or a full disk is a failure.
int print(const std::string& text)
{
    std::cout << text << std::flush;
    if (std::cout) return 0;
    std::cerr << "cupel_case: the output cannot be written; check the pipe or the disk\n";
    return exit_failed;
}

} // namespace

int main(int argument_count, char** arguments)
{
    CLI::App program{"What a Cupel case file says."};
    program.require_subcommand(1);

    std::string case_file;
    cupel::ResolveOptions options;
    bool without_files = false;
    CLI::App* resolve = program.add_subcommand("resolve", "print the resolved case as JSON");
    resolve->add_option("case", case_file, "the case file")->required();
    resolve->add_option("--level", options.level, "rough, coarse, intermediate, medium, fine or paper")->capture_default_str();
    resolve->add_option("--variation", options.variation, "name of one of the case's variations, where it has some");
    resolve->add_option("--set", options.overrides, "override as KEY=VALUE, e.g. --set time.end=\"1 ms\"")
        ->allow_extra_args(false);
    resolve->add_flag("--without-files", without_files, "do not ask for the powder bed, which may still be missing");
    CLI::App* summary = program.add_subcommand("summary", "print what the case file holds as JSON");
    summary->add_option("case", case_file, "the case file")->required();
    CLI::App* schema = program.add_subcommand("schema", "print the JSON schema of case files");
    program.add_subcommand("list-parameters", "print every parameter as Markdown");

    try {
        program.parse(argument_count, arguments);
    }
    catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return program.exit(error);
        std::cerr << "cupel_case: " << error.what() << "; cupel_case --help lists what it takes\n";
        return exit_refused;
    }

    try {
        options.require_files = !without_files;
        if (resolve->parsed()) return print(cupel::resolve_case(case_file, options).dump(2) + "\n");
        if (summary->parsed()) return print(cupel::summarize_case(case_file).dump(2) + "\n");
        return print(schema->parsed() ? cupel::case_schema().dump(2) + "\n" : cupel::parameter_reference());
    }
    catch (const cupel::CaseError& error) {
        std::cerr << error.what() << '\n';
        return exit_refused;
    }
    catch (const std::exception& error) {
        std::cerr << "cupel_case: " << error.what() << '\n';
        return exit_failed;
    }
}
