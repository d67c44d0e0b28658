/// Energy of the mixture as enthalpy, solved for temperature (Swaminathan and Voller 1992).
///
///   ∂H/∂t + ∇·(ρ₁ φ₁ h₁ + ρ₂ φ₂ c₂ T) = ∇·(k ∇T) + Q_laser − Q_losses,     H = α ρ₁ h₁(T) + (1 − α) ρ₂ c₂ T     [J/m³]
///
/// Each iteration linearises h about the last T, solves for T, takes the enthalpy that the solution means and inverts
/// it for the mixture. The step conserves energy exactly (to the linear solver's residual) however many iterations it
/// takes. Convection is implicit upwind, with what a limited linear scheme has over it added for the primary material
/// from the old T; explicit convection throughout makes hot gas pockets.
#pragma once

#include "interface_geometry.hpp"
#include "laser_source.hpp"
#include "surface_losses.hpp"

namespace cupel
{
/// What crossed the borders of the scene in the last step [W].
struct EnergyRates
{
    LaserPower laser;
    scalar surface_losses = 0; ///< evaporation, radiation, convection
    scalar conducted_in = 0;   ///< through boundaries, positive inward
    scalar convected_out = 0;  ///< through open boundaries, positive outward
};

class EnergyEquation
{
public:
    EnergyEquation(const Scene& scene, Fields& fields);

    /// Advances T by one step of the clock. α, its fluxes and old value are those of this step.
    EnergyRates advance(const volVectorField& fraction_gradient);

    /// ∫ H dV [J].
    scalar stored_energy() const;
    /// h of the primary material at T in cells, to be written beside a checkpoint that goes on to another mesh.
    tmp<volScalarField> primary_enthalpy() const;
    /// Takes T from the field `volumetric_enthalpy` that another mesh has left beside the start, if there is one.
    void restore_from_enthalpy();
    label iterations() const { return iterations_; }

private:
    /// H in cells for the given α and the present T [J/m³].
    tmp<volScalarField> volumetric_enthalpy(const volScalarField& fraction) const;
    /// Capacity dH/dT at the present T [J/(m³·K)].
    tmp<volScalarField> capacity() const;
    tmp<surfaceScalarField> conductivity() const;
    /// T of the mixture in a cell whose volumetric enthalpy is H [J/m³].
    scalar inverted(label cell, scalar enthalpy) const;

    const Scene& scene_;
    Fields& fields_;
    autoPtr<LaserSource> laser_;
    SurfaceLosses losses_;
    const bool has_losses_;
    label iterations_;
};
} // namespace cupel
