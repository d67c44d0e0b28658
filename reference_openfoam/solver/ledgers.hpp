/// What the scene holds and what crossed its borders: volume and mass of the primary material, and energy.
///
///   closure = |stored_end − stored_start − (in − out)| / max(in, |stored_end − stored_start|, smallest meaningful
///   amount)
///
/// The stored amounts are summed from the fields; in and out are added up step by step from fluxes through the borders.
#pragma once

#include "energy_equation.hpp"

namespace cupel
{
class Ledgers
{
public:
    /// `energy` is null when the scene has no energy equation.
    Ledgers(const Scene& scene, const Fields& fields, const EnergyEquation* energy);

    /// Books a step of length `step` [s].
    void book_flow(scalar step);
    void book_energy(const EnergyRates& rates, scalar step);

    /// The ledgers as one JSON object.
    std::string json() const;
    /// The state of the ledgers in a few words, for the log.
    std::string summary() const;
    scalar primary_volume() const;

    void save(dictionary& entries) const;
    void restore(const dictionary& entries);

private:
    const Scene& scene_;
    const Fields& fields_;
    const EnergyEquation* energy_;
    scalar volume_start_, volume_in_ = 0, volume_out_ = 0;
    scalar energy_start_ = 0, energy_in_ = 0, energy_out_ = 0;
    scalar laser_emitted_ = 0, laser_expected_ = 0, laser_absorbed_ = 0, surface_losses_ = 0, conducted_in_ = 0,
           convected_out_ = 0;
};
} // namespace cupel
