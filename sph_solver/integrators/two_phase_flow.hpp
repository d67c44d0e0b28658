#pragma once

#include <optional>

#include "integrators/flow.hpp"
#include "models/velocity_gradient.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Two liquids that fill the domain (Hu & Adams 2006, Adami, Hu, Adams 2010 and 2013): volume by summation, pressure
/// weighted with the neighbour's density, positions moved by a transport velocity.
class TwoPhaseFlow : public Flow
{
public:
    TwoPhaseFlow(Scene& scene, const FlowParameters& parameters, const ScalarField& mobility);

    void drift(const Neighbourhood& neighbourhood, double time_step) override;
    void evaluate(const Neighbourhood& neighbourhood, double time_step) override;
    double elastic_energy(Index i) const override;

private:
    void find_forces(const Neighbourhood& neighbourhood);

    ScalarField& viscosity_;
    ScalarField& transport_rate_; ///< rate of a volume by the transport velocity, m³/s
    ScalarField& imbalance_;      ///< W
    VectorField& transport_velocity_;
    std::optional<CorrectionMatrix> correction_;            ///< for Marangoni flow and the traction
    std::optional<VelocityGradientFields> stress_gradient_; ///< (μ − least μ) ∇v, Pa; only where viscosities differ
    double least_viscosity_;                                ///< Pa·s
    double stiffness_; ///< ρ c₀² of the heavier phase, Pa: one pressure scale for both
};

} // namespace cupel::inline CUPEL_ENGINE
