#pragma once

#include "integrators/flow.hpp"
#include "integrators/free_bodies.hpp"
#include "models/continuity.hpp"
#include "models/shifting_exchange.hpp"
#include "models/surface_stress.hpp"
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
    /// Not where liquid wets a wall: the load at a contact line is noise of the size of 1/Δx, and held for several
    /// steps of sound it feeds that noise.
    bool follows_sound() const override
    {
        return !(scene_.definition.requires_physics("wetting") && particles_.has("wall_normal"));
    }
    void find_densities(const Neighbourhood& neighbourhood, const SoundStep& step) override;
    void evaluate_sound(const Neighbourhood& neighbourhood, const SoundStep& step) override;
    void reset(Index place) override;

private:
    void start_hydrostatic();
    void find_rates(const Neighbourhood& neighbourhood);
    void take_trace_in_band(const Neighbourhood& neighbourhood);
    ContinuityByWalls continuity_by_walls() const
    {
        return {mobility_, particles_.density, particles_.velocity, density_rate_by_walls_};
    }
    template <bool with_walls, class SumWith>
    void sum_with_exchange(const Neighbourhood& neighbourhood, const SumWith& sum_with);
    void exchange(const Neighbourhood& neighbourhood, double time_step);
    struct CompressionTimes
    {
        double flow, diffusion, shifting; ///< s
    };
    void compress(const Neighbourhood& neighbourhood, const CompressionTimes& times);
    void find_pressure_force(const Neighbourhood& neighbourhood, bool with_density_gradient);
    void find_forces(const Neighbourhood& neighbourhood, bool with_density_gradient);
    void correct_density_gradient(const Neighbourhood& neighbourhood);
    std::vector<Index> mark_reach_of_surface_stress(const Neighbourhood& neighbourhood);
    SurfaceStressShare surface_stress_share();
    void carry_load(const Neighbourhood& neighbourhood, bool at_start);
    void extrapolate_velocity(const Neighbourhood& neighbourhood, bool with_shift);
    void extrapolate_pressure(const Neighbourhood& neighbourhood);

    CorrectionMatrix correction_;
    VelocityGradientFields velocity_gradient_;
    ScalarField& density_rate_;
    ScalarField& density_rate_by_walls_; ///< only set where there are any near
    double rest_density_;
    double lattice_packing_;   ///< C of a lattice (packing.hpp)
    double sound_ahead_ = 0.0; ///< time for which sound has been followed since all else was evaluated, s
    bool exchanged_ = false;   ///< whether what shifting carries has been exchanged since then
    VectorField* kernel_gradient_sum_ = nullptr; ///< only where a stress on the surface is shared out
    // Only where a load is carried (surface_pressure.hpp):
    ScalarField* replaced_rate_ = nullptr; ///< what the surface's band has for the partner of the pressure force
    ScalarField* carried_load_ = nullptr;
    ScalarField* carried_mean_ = nullptr;
    VectorField* carried_gradient_ = nullptr;
    bool tension_alone_ = false; ///< whether the load is the same tension everywhere, and nothing else
    FreeBodies free_bodies_;
    VectorField* density_gradient_ = nullptr; ///< only where density diffuses
    ScalarField* diffusion_rate_ = nullptr;
    // Only where the case shifts particles:
    VectorField* shift_ = nullptr;
    ScalarField* shifting_density_rate_ = nullptr;
    ScalarField* mass_rate_ = nullptr;
    VectorField* momentum_rate_ = nullptr;
    ScalarField* shifting_speed_ = nullptr;
    ScalarField* shifting_speed_of_band_ = nullptr; ///< only where metal melts
    ScalarField* packing_rate_ = nullptr;           ///< of density, kg/(m³ s)
    ScalarField* balance_ = nullptr;
    ScalarField* enthalpy_ = nullptr;
    ScalarField* energy_rate_ = nullptr;
};

/// Sums what shifting carries between particles together with other terms.
template <bool with_walls, class SumWith>
void FreeSurfaceFlow::sum_with_exchange(const Neighbourhood& neighbourhood, const SumWith& sum_with)
{
    const double lattice_mass = rest_density_ * scene_.particle_volume;
    neighbourhood.for_each_moving(
        [&](Index i) { (*balance_)[i] = exchange_balance(particles_.mass[i], lattice_mass); });
    const auto exchange = [&](auto with_enthalpy) {
        return ShiftingExchange<with_enthalpy(), with_walls>{mobility_,
                                                             particles_.volume,
                                                             particles_.density,
                                                             particles_.velocity,
                                                             *shift_,
                                                             particles_.mass,
                                                             *shifting_speed_,
                                                             0.5 * parameters_.smoothing_length /
                                                                 scene_.particle_volume,
                                                             *balance_,
                                                             enthalpy_,
                                                             *shifting_density_rate_,
                                                             *mass_rate_,
                                                             *momentum_rate_,
                                                             energy_rate_};
    };
    enthalpy_ ? sum_with(exchange(std::true_type{})) : sum_with(exchange(std::false_type{}));
}

} // namespace cupel::inline CUPEL_ENGINE
