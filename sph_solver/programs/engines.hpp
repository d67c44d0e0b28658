#pragma once

#include <string>
#include <vector>

#include "output/recorder_options.hpp"
#include "scene/case.hpp"

/// Calls use(instructions, precision, namespace) for each engine that is compiled, the fastest first.
#define CUPEL_FOR_EACH_ENGINE(use) CUPEL_AVX512_ENGINES(use) CUPEL_AVX2_ENGINES(use) CUPEL_PORTABLE_ENGINES(use)
#if defined(CUPEL_HAS_AVX512_ENGINES)
#define CUPEL_AVX512_ENGINES(use) use(avx512, double, avx512_double) use(avx512, float, avx512_float)
#else
#define CUPEL_AVX512_ENGINES(use)
#endif
#if defined(CUPEL_HAS_AVX2_ENGINES)
#define CUPEL_AVX2_ENGINES(use) use(avx2, double, avx2_double) use(avx2, float, avx2_float)
#else
#define CUPEL_AVX2_ENGINES(use)
#endif
#if defined(CUPEL_HAS_PORTABLE_ENGINES)
#define CUPEL_PORTABLE_ENGINES(use) use(portable, double, portable_double) use(portable, float, portable_float)
#else
#define CUPEL_PORTABLE_ENGINES(use)
#endif

namespace cupel
{

/// The solver compiled for one instruction set, in one precision of pair arithmetic (math/lanes.hpp). All of them are
/// in the program; their results agree to round-off.
struct Engine
{
    std::string instructions; ///< "avx512", "avx2" or "portable"
    std::string precision;    ///< "double" or "float"
    Ending (*run)(const Case&, const RecorderOptions&);
};

/// The instruction sets of this program that this machine has, the fastest first.
std::vector<std::string> available_instructions();

/// The engine for a precision and an instruction set; an empty one stands for the fastest. Throws CaseError where this
/// machine does not have it.
Engine choose_engine(const std::string& precision, const std::string& instructions);

} // namespace cupel
