#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kernels/smoothing_kernel.hpp"
#include "ledgers/ledger.hpp"
#include "models/artificial_heat.hpp"
#include "models/enthalpy.hpp"
#include "models/laser.hpp"
#include "models/surface_losses.hpp"
#include "models/thermal_walls.hpp"
#include "scene/place_particles.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Where all the heat went, J since the start, each amount as it was applied to particles.
struct HeatBooks
{
    double stored_at_start = 0; ///< Σ m h, with h = 0 at 0 K
    double laser_emitted = 0;   ///< by the beam
    double laser_hit = 0;       ///< of what was emitted, on metal
    double laser_absorbed = 0;  ///< by particles
    double walls_in = 0;        ///< from walls of prescribed temperature hotter than what touches them
    double walls_out = 0;       ///< to colder ones
    double evaporation = 0;
    double radiation = 0;  ///< out; negative where the surrounding is hotter
    double convection = 0; ///< the same
};

struct TemperatureRange
{
    double lowest = 0, highest = 0;   ///< K
    Index coldest = -1, hottest = -1; ///< places of these particles
    bool finite = true;               ///< no temperature is NaN or infinite; if not, `hottest` is the first such one
};

/// Heat on its own time step: conduction, walls of prescribed temperature, laser, losses from the surface, artificial
/// heat, melting and solidification through the enthalpy; of these, what the case names. Constructed only where the
/// case names 'heat'.
///
/// Registers temperature [K], peak_temperature [K] and, where the case melts, liquid_fraction, all of them written to
/// snapshots; enthalpy [J/kg], the state that is integrated; and what the step keeps between its passes. Sets
/// all of them from the case's initial temperature. Wall particles have the temperature of their wall (the initial one
/// where it is adiabatic) and take no part.
class ThermalStep
{
public:
    /// Throws CaseError where a material or the surrounding lacks what the case's physics needs.
    explicit ThermalStep(Scene& scene);

    /// Longest step: 0.075 h²/α of the fastest material and state, times numerics.thermal_time_step_factor, s. Stable
    /// is five times that (2/λ of the greatest eigenvalue on a disordered lattice, 0.4 h²/α). At the usual 0.15
    /// (Cleary, Monaghan 1999) the pool of a 20 μm track is 1.8 % wider than with heat at each of the flow's steps, at
    /// 0.075 as wide to 0.2 % (./cupel bench --savings).
    double stable_time_step() const { return stable_time_step_; }

    /// One step of all particles, from `time` to `time + time_step` (s): explicit, but for the surface's losses, each
    /// particle's being implicit. `list` is valid for the particles as they are; those that have moved since the last
    /// step have been marked.
    void advance(const NeighbourList& list, double time, double time_step);

    const HeatBooks& books() const { return books_; }
    /// To be told of each particle whose place or volume has changed: elsewhere, sums over places are kept.
    void mark_moved(Index i) { moved_[i] = 1.0; }

    /// Σ m h of all particles now, J.
    double stored_energy() const;
    /// Energy as a ledger, end = now: in = laser + walls, out = losses + walls. Where nothing comes or goes its
    /// reference is what was stored at the start.
    Ledger ledger() const;
    /// |absorbed − A hit|/(A hit) of all laser energy so far; 0 without a laser.
    double laser_absorption_error() const;

    /// Least and greatest temperature of particles that are not walls. O(N).
    TemperatureRange temperature_range() const;
    /// No temperature can fall below this one: the least of the initial ones, the walls' and the surrounding's, K.
    double lowest_possible_temperature() const { return lowest_possible_; }

    /// What a checkpoint must keep beside the fields, as named numbers "heat.NAME".
    void save(std::map<std::string, double>& numbers) const;
    /// Throws std::out_of_range where one is missing.
    void load(const std::map<std::string, double>& numbers);

private:
    struct ArtificialHeatFields
    {
        ArtificialConductivity conductivity;
        ScalarField& divergence;
        ScalarField& diffusivity;
    };

    void set_initial_state(const Scene& scene);
    void set_losses(const Scene& scene);
    void set_stable_time_step(const Scene& scene);
    void find_stale_clusters(const NeighbourList& list);
    void update_geometry(const NeighbourList& list);
    void conduct(const NeighbourList& list);
    void conduct_through_walls(double time_step);
    void apply(double time_step);
    void set_state(Index i, double enthalpy);

    const ThermalMaterial& material_of(Index i) const
    {
        return materials_[particles_.material[static_cast<std::size_t>(i)]];
    }
    bool is_wall(Index i) const { return particles_.kind[static_cast<std::size_t>(i)] == Kind::wall; }

    Particles& particles_;
    int dimensions_;
    double spacing_, smoothing_length_;
    SmoothingKernel kernel_;
    std::vector<ThermalMaterial> materials_;
    ThermalWalls walls_;
    SurfaceLosses losses_;
    std::optional<LaserBeam> laser_;
    double absorptivity_ = 0;
    ScalarField& temperature_;
    ScalarField& enthalpy_;
    ScalarField& peak_temperature_;
    ScalarField* liquid_fraction_ = nullptr; ///< only where the case melts
    ScalarField& conductivity_;              ///< 0 for walls, which take no part
    ScalarField& correction_;
    ScalarField& power_;
    ScalarField& moved_;                  ///< 1 where place or volume have changed since sums over places were taken
    ScalarField* metal_ = nullptr;        ///< only with a laser or losses
    ScalarField* exposed_area_ = nullptr; ///< only with losses
    std::optional<ArtificialHeatFields> artificial_heat_;
    std::vector<Index> all_clusters_, stale_clusters_;
    bool geometry_known_ = false, keeps_sums_ = true;
    double stable_time_step_ = 0, lowest_possible_ = 0;
    HeatBooks books_;
};

} // namespace cupel::inline CUPEL_ENGINE
