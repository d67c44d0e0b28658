# Writes cupel_version.hpp with the project's version and the commit of the sources; touches it only on change.
# Run as: cmake -DSOURCE=... -DVERSION=... -DOUTPUT=... -P write_version.cmake
execute_process(COMMAND git -C ${SOURCE} rev-parse --short=12 HEAD
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  set(commit "unknown")
else()
  execute_process(COMMAND git -C ${SOURCE} status --porcelain --untracked-files=no
    OUTPUT_VARIABLE changes OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT changes STREQUAL "")
    string(APPEND commit "+changes")
  endif()
endif()

set(text "#pragma once

/// Version and commit of the sources that this build was made from; written by the build.
namespace cupel
{
inline constexpr const char* code_version = \"${VERSION}\";
inline constexpr const char* code_commit = \"${commit}\";
} // namespace cupel
")
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "${text}" @ONLY)
