#pragma once

#include <algorithm>

namespace cupel
{

/// Drag of the mushy zone on the melt (Voller and Prakash 1987): dv/dt = −(C/ρ) (1 − f)²/(f³ + ε) v, f the liquid
/// fraction. It is too stiff for an explicit step, so the velocity is multiplied by the implicit factor
///
///   1 / (1 + Δt (C/ρ) (1 − f)²/(f³ + ε))      [1]
///
/// C is a property of the material's mush (Kozeny: 180 μ/d², d the spacing of its dendrites). With C = 10¹³ solid (f =
/// 0) keeps 7·10⁻⁶ of its velocity over 0.1 μs at ρ = 6900.
struct CarmanKozeny
{
    double constant = 0;          ///< C, kg/(m³·s)
    double regularisation = 1e-3; ///< ε

    /// Below this liquid fraction steel's drag stops the mush within a tenth of any time step that the flow takes (drag
    /// rate C (1 − f)²/(f³ ρ) above 5·10⁷ 1/s): it stands, and the flow treats it as a wall.
    static constexpr double coherent_below = 0.85;

    double damping_factor(double liquid_fraction, double density, double time_step) const
    {
        const double f = std::clamp(liquid_fraction, 0.0, 1.0);
        const double drag = constant * (1.0 - f) * (1.0 - f) / (f * f * f + regularisation);
        return 1.0 / (1.0 + time_step * drag / density);
    }
};

} // namespace cupel
