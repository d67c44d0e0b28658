/// Every field of the run. What the scene does not need is never allocated.
#pragma once

#include "foam.hpp"
#include "scene.hpp"

namespace cupel
{
/// Motion: only with `flow`.
struct FlowFields
{
    FlowFields(const fvMesh& mesh, const Scene& scene, const volScalarField& fraction);

    volVectorField velocity;                  ///< U [m/s]
    volScalarField reduced_pressure;          ///< p_rgh = p − ρ g·x [Pa]
    surfaceScalarField flux;                  ///< volume through each face [m³/s]
    surfaceScalarField fraction_flux;         ///< the primary material's share of it [m³/s], as it was moved
    volScalarField density;                   ///< ρ [kg/m³]
    surfaceScalarField mass_flux;             ///< [kg/s]
    autoPtr<surfaceScalarField> acceleration; ///< of the flux in the last step [m³/s²]; only with surface_tension
    volScalarField gravity_potential;         ///< g·x [m²/s²], g without its part along periodic axes
    surfaceScalarField gravity_potential_faces;
    vector periodic_gravity; ///< that part [m/s²]: a body force, for g·x is not periodic
    label reference_cell;    ///< where the pressure is pinned if no boundary sets it
    scalar reference_pressure;
};

/// Temperature: with `heat` (solved) or `marangoni` (frozen as written at the start).
struct HeatFields
{
    explicit HeatFields(const fvMesh& mesh, bool solved);

    volScalarField temperature;   ///< T [K]
    autoPtr<volScalarField> peak; ///< greatest T that a cell had while the primary material filled half of it [K]
};

struct Fields
{
    Fields(const fvMesh& mesh, const Scene& scene);

    const fvMesh& mesh;
    volScalarField fraction; ///< α: share of the primary material, 0 … 1
    autoPtr<FlowFields> flow;
    autoPtr<HeatFields> heat;

    /// α limited to 0 … 1 (transport keeps it there to about 1e-9).
    tmp<volScalarField> bounded_fraction() const;
    /// ρ = α ρ₁ + (1 − α) ρ₂ after α has moved.
    void update_density(const Scene& scene);
    /// Keeps the greatest temperature of cells that the primary material fills by half or more.
    void update_peak();
};
} // namespace cupel
