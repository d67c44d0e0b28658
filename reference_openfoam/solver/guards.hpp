/// Recognises a run that has gone astray, before it writes nonsense: not-a-number, Courant number, volume fraction,
/// temperature, collapse of the time step. A guard that trips throws with what happened, where, and what to change.
#pragma once

#include <stdexcept>

#include "time_step.hpp"

namespace cupel
{
struct Diverged : std::runtime_error
{
    using std::runtime_error::runtime_error;
};

/// Throws Diverged if the fields after a step of length `step` cannot be right.
void check_fields(const Scene& scene, const Fields& fields, const TimeStep& time_step, scalar step);
} // namespace cupel
