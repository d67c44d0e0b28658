#pragma once

#include <optional>

#include "integrators/flow.hpp"
#include "models/velocity_gradient.hpp"
#include "models/wall_compression.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Two liquids that fill the domain (Hu & Adams 2006, Adami, Hu, Adams 2010 and 2013): volume by summation, pressure as
/// the derivative of an elastic energy, the load of the interface as a pressure that jumps there, positions moved by a
/// transport velocity.
class TwoPhaseFlow : public Flow
{
public:
    TwoPhaseFlow(Scene& scene, const FlowParameters& parameters, const ScalarField& mobility);

    void drift(const Neighbourhood& neighbourhood, double time_step) override;
    void evaluate(const Neighbourhood& neighbourhood, double time_step) override;
    bool follows_sound() const override { return true; }
    void evaluate_sound(const Neighbourhood& neighbourhood, const SoundStep& step) override;
    double elastic_energy(Index i) const override;

private:
    void compress(const Neighbourhood& neighbourhood, double time_step);
    WallCompression wall_compression() const
    {
        return {mobility_, transport_velocity_, liquid_number_, transport_number_};
    }
    void compress_walls(const Neighbourhood& neighbourhood, bool at_start, double time_step);
    void find_gradients(const Neighbourhood& neighbourhood);
    void find_forces(const Neighbourhood& neighbourhood);
    void carry_load(const Neighbourhood& neighbourhood, bool at_start);

    ScalarField& viscosity_;
    ScalarField& liquid_number_;          ///< that walls feel, 1/m³
    ScalarField& liquid_number_at_start_; ///< 1/m³
    ScalarField& transport_number_;       ///< rate of that number by the transport velocity, 1/(m³ s)
    ScalarField& wall_energy_;            ///< J
    ScalarField& transport_rate_;         ///< rate of a volume by the transport velocity, m³/s
    ScalarField& volume_potential_;       ///< that keeps the transport velocity from changing volumes, 1/s
    VectorField& transport_velocity_;
    std::optional<CorrectionMatrix> correction_; ///< for Marangoni flow, the traction and the carried load
    std::optional<VelocityGradientFields> velocity_gradient_;
    double least_viscosity_ = 0.0; ///< of the phases, Pa·s
    bool viscosity_jumps_ = false;
    bool transports_ = false; ///< whether the case shifts particles
    // Only where a load is carried (interface_pressure.hpp):
    ScalarField* carried_load_ = nullptr;
    ScalarField* carried_load_of_other_ = nullptr; ///< on walls
    ScalarField* carried_mean_ = nullptr;
    VectorField* carried_acceleration_ = nullptr;
    double sound_ahead_ = 0.0; ///< time for which sound has been followed since all else was evaluated, s
    double lattice_number_;    ///< of particles in a volume, 1/m³
    double lattice_crowding_;  ///< that times a particle's volume: 1 but for what the kernel's sum misses
    double stiffness_;         ///< ρ c₀² of the heavier phase, Pa: one pressure scale for both
};

} // namespace cupel::inline CUPEL_ENGINE
