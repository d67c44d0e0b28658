#pragma once

#include "integrators/flow.hpp"
#include "models/velocity_gradient.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// One liquid with nothing around it: continuity equation with density diffusion (δ-SPH), walls and solids by
/// extrapolation, arbitrary Lagrangian-Eulerian shifting where the case asks for it.
class FreeSurfaceFlow : public Flow
{
public:
    FreeSurfaceFlow(Scene& scene, const FlowParameters& parameters, const ScalarField& mobility);

    void drift(const Neighbourhood& neighbourhood, double time_step) override;
    void evaluate(const Neighbourhood& neighbourhood, double time_step) override;
    void reset(Index place) override;

private:
    void start_hydrostatic();
    void sum_over_places(const Neighbourhood& neighbourhood);
    void find_rates(const Neighbourhood& neighbourhood);
    void exchange_mass(const Neighbourhood& neighbourhood, double time_step);
    MechanicalWork compress(Index i, double time_step);
    void find_forces(const Neighbourhood& neighbourhood);
    void carry_load(const Neighbourhood& neighbourhood, bool at_start);
    template <class... Others> void extrapolate_to_walls(const Neighbourhood& neighbourhood, const Others&... others);

    CorrectionMatrix correction_;
    VelocityGradientFields velocity_gradient_;
    ScalarField& density_rate_;
    ScalarField& wall_power_; ///< W
    double rest_density_;
    // Only where a load is carried (surface_pressure.hpp):
    ScalarField* replaced_rate_ = nullptr; ///< what the surface's band has for the partner of the pressure force
    ScalarField* carried_load_ = nullptr;
    ScalarField* carried_mean_ = nullptr;
    VectorField* carried_gradient_ = nullptr;
    VectorField* density_gradient_ = nullptr; ///< only where density diffuses
    ScalarField* diffusion_rate_ = nullptr;
    // Only where the case shifts particles:
    VectorField* shift_ = nullptr;
    ScalarField* shifting_density_rate_ = nullptr;
    ScalarField* mass_rate_ = nullptr;
    ScalarField* balance_ = nullptr;
    ScalarField* enthalpy_ = nullptr;
    ScalarField* energy_rate_ = nullptr;
};

} // namespace cupel::inline CUPEL_ENGINE
