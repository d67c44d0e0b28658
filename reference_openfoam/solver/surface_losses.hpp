/// Heat that leaves the surface by evaporation, radiation and convection (Anisimov 1968; Stefan-Boltzmann; Newton).
///
///   q(T) = 0.82 L_v p_sat(T) √(M/(2πRT)) + ε σ_SB (T⁴ − T₀⁴) + h_c (T − T₀)     [W/m²]
///   Q = q(T) 2α |∇α|                                                            [W/m³]
///
/// The weight 2α takes the heat from the metal side of the interface; ∫ 2α |∇α| dn = 1 across it.
#pragma once

#include "interface_geometry.hpp"

namespace cupel
{
class SurfaceLosses
{
public:
    explicit SurfaceLosses(const Scene& scene);

    /// q(T) [W/m²].
    scalar flux(scalar temperature) const;

    /// Fills Q [W/m³] and dQ/dT [W/(m³·K)] (never negative) at temperature T.
    void update(const Fields& fields, const volVectorField& fraction_gradient);

    const scalarField& loss() const { return loss_; }
    const scalarField& slope() const { return slope_; }

private:
    const Scene& scene_;
    scalarField loss_, slope_;
};
} // namespace cupel
