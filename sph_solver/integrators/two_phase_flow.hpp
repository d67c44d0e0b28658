#pragma once

#include "integrators/flow.hpp"

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

private:
    ScalarField& viscosity_;
    VectorField& transport_force_;
    std::unique_ptr<CorrectionMatrix> correction_; ///< only for Marangoni flow
    double stiffness_;                             ///< ρ c₀² of the heavier phase, Pa: one pressure scale for both
};

} // namespace cupel::inline CUPEL_ENGINE
