#pragma once

#include <map>
#include <memory>
#include <string>

#include "integrators/neighbourhood.hpp"
#include "integrators/parameters.hpp"
#include "integrators/surface_tracker.hpp"
#include "models/artificial_stress.hpp"
#include "models/artificial_viscosity.hpp"
#include "models/gradient_correction.hpp"
#include "models/surface_forces.hpp"
#include "models/surface_temperature.hpp"
#include "models/vapour_pressure.hpp"
#include "models/wall_extrapolation.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Momentum and mass of the liquid: what a step needs to know of either formulation.
class Flow
{
public:
    virtual ~Flow() = default;

    /// Positions, by the kicked velocities: x ← x + Δt v and whatever the formulation adds.
    virtual void drift(const Neighbourhood& neighbourhood, double time_step) = 0;

    /// Densities, pressures and accelerations at the new positions. time_step is that of the drift (0 at the start).
    virtual void evaluate(const Neighbourhood& neighbourhood, double time_step) = 0;

    /// A particle that has just melted or solidified starts from rest.
    virtual void reset(Index place)
    {
        acceleration_.set(place, {});
        if (surface_) surface_->reset(place);
    }

    const VectorField& acceleration() const { return acceleration_; }
    /// Null where the scene has no force on the surface.
    const SurfaceTracker* surface() const { return surface_.get(); }
    const FlowParameters& parameters() const { return parameters_; }

protected:
    Flow(Scene& scene, const FlowParameters& parameters, const ScalarField& mobility);

    /// Pressure and velocity of walls and solids from the liquid before them; two phases fill space, so walls may pull.
    WallPressure wall_pressure(bool walls_may_pull);
    WallVelocity wall_velocity();
    /// Whether the case switches on an artificial pair force; both are added to what a term before them has stored.
    bool has_remedies() const;
    ArtificialViscosity artificial_viscosity();
    ArtificialStress artificial_stress();
    /// The corrected gradient of temperature, where surface tension varies with it.
    void find_temperature_gradient(const Neighbourhood& neighbourhood, const CorrectionMatrix& correction);
    /// Adds to force_ what holds liquid together that is too thin to have a surface of its own.
    void add_cohesion(const Neighbourhood& neighbourhood);
    /// The temperature that surface forces are evaluated at, as a term of some pass or in one of its own.
    SurfaceTemperature surface_temperature();
    void find_surface_temperature(const Neighbourhood& neighbourhood);
    /// acceleration ← force/m + g + surface forces/ρ; needs the gradient of temperature and the surface temperature.
    void accelerate(const Neighbourhood& neighbourhood);

    Scene& scene_;
    Particles& particles_;
    FlowParameters parameters_;
    QuinticSpline kernel_;
    Mobility mobility_;
    Vector gravity_;
    VectorField& force_;
    VectorField& acceleration_;
    std::unique_ptr<SurfaceTracker> surface_;

    ScalarField* temperature_ = nullptr;
    /// ½(ρ₁ + ρ₂) of two phases, kg/m³; 0 with one. Surface forces there have the weight 2ρ_i/(ρ₁ + ρ₂) (Brackbill,
    /// Kothe, Zemach 1992, eq. 31), whose mean over the band is one: both phases are driven alike, and what is uneven
    /// in them does not stir a light phase that has no inertia.
    double mean_density_ = 0.0;
    VectorField* temperature_gradient_ = nullptr; ///< only where it drives Marangoni flow

private:
    /// What presses on the surface, and how it changes along it.
    void find_load(const Neighbourhood& neighbourhood);

    SurfaceTensionLaw tension_;
    VapourPressure vapour_pressure_;
    bool with_tension_, with_marangoni_, with_recoil_;
    ScalarField* load_ = nullptr;      ///< only where tension or recoil presses on a surface
    ScalarField* mean_load_ = nullptr; ///< only where that surface is free
    VectorField* load_gradient_ = nullptr;
    ScalarField* unresolved_ = nullptr; ///< only where a free surface has tension
    double bonds_ = 0.0;
    ScalarField* mean_temperature_ = nullptr; ///< only where a surface force depends on it
};

/// Two phases that fill the domain: volume by summation, transport velocity. One phase with a free surface: δ-SPH.
std::unique_ptr<Flow> make_flow(Scene& scene, const FlowParameters& parameters, const ScalarField& mobility);

} // namespace cupel::inline CUPEL_ENGINE
