#pragma once

#include <map>
#include <string>

#include "models/equation_of_state.hpp"
#include "scene/place_particles.hpp"

namespace cupel
{

/// What a scene's physics sets for the numerics; derived, printed, and overridable under [numerics] of a case.
struct FlowParameters
{
    double smoothing_length = 0;      ///< h, m
    double reference_speed = 0;       ///< greatest speed that the scene's forces can be expected to drive, m/s
    std::string reference_speed_from; ///< the force that sets it
    EquationOfState equation_of_state{};
};

FlowParameters derive_flow_parameters(const Scene& scene);

/// Greatest stable time step of each criterion, s (Adami, Hu, Adams 2012 for the first two, Brackbill 1992 for the
/// third).
///
///   acoustic   0.4 Δx / c₀ (0.35 with a free surface)      viscous   0.125 ρ h²/μ
///   capillary  0.4 √(ρ Δx³ / 2πσ)
using TimeStepLimits = std::map<std::string, double>;
TimeStepLimits derive_time_step_limits(const Scene& scene, const FlowParameters& parameters);

} // namespace cupel
