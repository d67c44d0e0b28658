#pragma once

/// The engine is compiled once for each instruction set and precision, each time into a namespace of its own, so that
/// one program carries them all and takes the best one that the machine has (programs/engines.hpp). What depends on
/// Lanes is written in `namespace cupel::inline CUPEL_ENGINE`; everything else is compiled once.
#if !defined(CUPEL_ENGINE)
#define CUPEL_ENGINE native_double
#endif
#if !defined(CUPEL_REAL)
#define CUPEL_REAL double
#endif

namespace cupel::inline CUPEL_ENGINE
{

#define CUPEL_QUOTE_NAME(name) #name
#define CUPEL_QUOTE(macro) CUPEL_QUOTE_NAME(macro)
inline constexpr const char* engine_name = CUPEL_QUOTE(CUPEL_ENGINE);

/// Pair arithmetic is done in Real. Fields, positions and everything outside the pair loops are double.
using Real = CUPEL_REAL;

} // namespace cupel::inline CUPEL_ENGINE
