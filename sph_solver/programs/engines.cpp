#include "programs/engines.hpp"

#include <algorithm>

namespace cupel
{

#define CUPEL_DECLARE_ENGINE(name)                                                                                     \
    namespace name                                                                                                     \
    {                                                                                                                  \
    Ending run_case(const Case&, const RecorderOptions&);                                                              \
    }
CUPEL_DECLARE_ENGINE(portable_double)
CUPEL_DECLARE_ENGINE(portable_float)
#if defined(CUPEL_HAS_X86_ENGINES)
CUPEL_DECLARE_ENGINE(avx2_double)
CUPEL_DECLARE_ENGINE(avx2_float)
CUPEL_DECLARE_ENGINE(avx512_double)
CUPEL_DECLARE_ENGINE(avx512_float)
#endif

namespace
{

/// The fastest first.
const std::vector<Engine>& engines()
{
    static const std::vector<Engine> all
    {
#if defined(CUPEL_HAS_X86_ENGINES)
        {"avx512", "double", avx512_double::run_case}, {"avx512", "float", avx512_float::run_case},
            {"avx2", "double", avx2_double::run_case}, {"avx2", "float", avx2_float::run_case},
#endif
            {"portable", "double", portable_double::run_case},
        {
            "portable", "float", portable_float::run_case
        }
    };
    return all;
}

bool machine_has(const std::string& instructions)
{
#if defined(CUPEL_HAS_X86_ENGINES)
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
