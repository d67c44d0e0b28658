#include "programs/engines.hpp"

#include <algorithm>

namespace cupel
{

#define CUPEL_DECLARE_ENGINE(instructions, precision, name)                                                            \
    namespace name                                                                                                     \
    {                                                                                                                  \
    Ending run_case(const Case&, const RecorderOptions&);                                                              \
    }
CUPEL_FOR_EACH_ENGINE(CUPEL_DECLARE_ENGINE)

namespace
{

const std::vector<Engine>& engines()
{
#define CUPEL_ENGINE_ENTRY(instructions, precision, name) {#instructions, #precision, name::run_case},
    static const std::vector<Engine> all{CUPEL_FOR_EACH_ENGINE(CUPEL_ENGINE_ENTRY)};
    return all;
}

bool machine_has(const std::string& instructions)
{
#if defined(__x86_64__)
    if (instructions == "avx512")
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
               __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512vl");
    if (instructions == "avx2")
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
               __builtin_cpu_supports("bmi2");
#endif
    return instructions == "portable";
}

} // namespace

std::vector<std::string> available_instructions()
{
    std::vector<std::string> found;
    for (const Engine& engine : engines())
        if (machine_has(engine.instructions) &&
            std::find(found.begin(), found.end(), engine.instructions) == found.end())
            found.push_back(engine.instructions);
    return found;
}

Engine choose_engine(const std::string& precision, const std::string& instructions)
{
    for (const Engine& engine : engines())
        if (engine.precision == precision && machine_has(engine.instructions) &&
            (instructions.empty() || engine.instructions == instructions))
            return engine;
    std::string known;
    for (const std::string& one : available_instructions())
        known += (known.empty() ? "" : ", ") + one;
    throw CaseError("instructions '" + instructions + "': this machine or this program has none such; it has " + known);
}

} // namespace cupel
