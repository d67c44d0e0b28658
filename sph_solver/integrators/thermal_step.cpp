#include "integrators/thermal_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "integrators/parameters.hpp"
#include "models/exposed_surface.hpp"
#include "models/heat_conduction.hpp"

namespace cupel::inline CUPEL_ENGINE
{

namespace
{

double smoothing_length_of(const Scene& scene)
{
    return scene.definition.numerics.smoothing_ratio * scene.spacing;
}

std::vector<ThermalMaterial> thermal_materials(const Scene& scene)
{
    const bool melting = scene.definition.requires_physics("melting");
    std::vector<ThermalMaterial> materials;
    for (const Material& material : scene.materials)
        materials.emplace_back(material, melting);
    return materials;
}

double needed(const std::optional<double>& value, const Material& material, const char* key, const char* physics)
{
    if (!value)
        throw CaseError("material." + material.name + "." + key + ": the physics '" + physics +
                        "' needs it; add it to the material");
    return *value;
}

const Surrounding& needed_surrounding(const Case& definition)
{
    if (!definition.surrounding)
        throw CaseError("surrounding: losses from the surface need its temperature and pressure; add [surrounding]");
    return *definition.surrounding;
}

} // namespace

ThermalStep::ThermalStep(Scene& scene)
    : particles_(*scene.particles), dimensions_(scene.dimensions), spacing_(scene.spacing),
      smoothing_length_(smoothing_length_of(scene)),
      kernel_(scene.definition.numerics.kernel, smoothing_length_, scene.dimensions),
      materials_(thermal_materials(scene)), walls_(scene.definition.domain, kernel_, scene.spacing, scene.dimensions),
      temperature_(particles_.add_scalar({"temperature", "K", Output::yes})),
      enthalpy_(particles_.add_scalar({"enthalpy", "J/kg"})),
      peak_temperature_(particles_.add_scalar({"peak_temperature", "K", Output::yes})),
      conductivity_(particles_.add_scalar({"thermal_conductivity", "W/(m K)"})),
      correction_(particles_.add_scalar({"conduction_correction", "1"}, 1.0)),
      power_(particles_.add_scalar({"heating_power", "W"})), moved_(particles_.add_scalar({"moved", "1"}))
{
    const Case& definition = scene.definition;
    keeps_sums_ = definition.numerics.without_saving != "kept_sums";
    if (definition.requires_physics("melting"))
        liquid_fraction_ = &particles_.add_scalar({"liquid_fraction", "1", Output::yes});
    if (definition.requires_physics("laser")) {
        if (!definition.laser) throw CaseError("laser: the physics 'laser' needs it; add [laser]");
        laser_.emplace(*definition.laser, scene.spacing, scene.dimensions);
        absorptivity_ = definition.laser->absorptivity;
    }
    set_losses(scene);
    if (laser_ || losses_.any()) metal_ = &particles_.add_scalar({"metal", "1"});
    if (losses_.any()) exposed_area_ = &particles_.add_scalar({"exposed_area", "m2"});
    if (const Numerics& numerics = definition.numerics; numerics.artificial_heat > 0.0) {
        const double beta = numerics.artificial_viscosity_beta;
        const double sound_speed = beta > 0.0 ? derive_flow_parameters(scene).equation_of_state.sound_speed : 0.0;
        artificial_heat_.emplace(ArtificialHeatFields{{numerics.artificial_heat, beta, smoothing_length_, sound_speed},
                                                      particles_.add_scalar({"velocity_divergence", "1/s"}),
                                                      particles_.add_scalar({"artificial_conductivity", "W/(m K)"})});
    }
    set_initial_state(scene);
    set_stable_time_step(scene);
}

void ThermalStep::set_losses(const Scene& scene)
{
    const Case& definition = scene.definition;
    const Material& metal = scene.materials.front();
    if (definition.requires_physics("evaporation"))
        losses_.evaporation =
            Evaporation{{needed_surrounding(definition).pressure,
                         needed(metal.boiling_temperature, metal, "boiling_temperature", "evaporation"),
                         needed(metal.vaporization_heat, metal, "vaporization_heat", "evaporation"),
                         needed(metal.molar_mass, metal, "molar_mass", "evaporation")}};
    if (definition.requires_physics("radiation")) {
        const Surrounding& surrounding = needed_surrounding(definition);
        losses_.radiation = Radiation{needed(metal.emissivity, metal, "emissivity", "radiation"),
                                      surrounding.convection_coefficient, surrounding.temperature};
    }
}

void ThermalStep::set_initial_state(const Scene& scene)
{
    const Case& definition = scene.definition;
    lowest_possible_ = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < particles_.count(); ++i) {
        const Vector p = particles_.position[i];
        const double temperature = definition.initial_temperature({p.x, p.y, p.z});
        if (is_wall(i)) {
            temperature_[i] = peak_temperature_[i] = walls_.nearest_temperature(p).value_or(temperature);
            if (liquid_fraction_) (*liquid_fraction_)[i] = 0.0;
            continue;
        }
        const ThermalMaterial& material = material_of(i);
        set_state(i, material.enthalpy(temperature));
        lowest_possible_ = std::min(lowest_possible_, temperature);
        if (metal_) (*metal_)[i] = particles_.material[static_cast<std::size_t>(i)] == 0 ? 1.0 : 0.0;
    }
    for (const auto& boundary : definition.domain.boundaries)
        if (boundary && boundary->temperature) lowest_possible_ = std::min(lowest_possible_, *boundary->temperature);
    if (losses_.radiation) lowest_possible_ = std::min(lowest_possible_, losses_.radiation->surrounding_temperature);
    books_.stored_at_start = stored_energy();
}

void ThermalStep::set_stable_time_step(const Scene& scene)
{
    double greatest_conductivity = 0.0;
    for (const ThermalMaterial& m : materials_)
        greatest_conductivity = std::max({greatest_conductivity, m.conductivity_solid, m.conductivity_liquid});
    // Beside a better conductor the harmonic mean is up to twice a material's own conductivity.
    double greatest_diffusivity = 0.0;
    const auto consider = [&](double conductivity, double density, double specific_heat) {
        if (conductivity > 0.0)
            greatest_diffusivity =
                std::max(greatest_diffusivity, 2.0 * conductivity * greatest_conductivity /
                                                   (conductivity + greatest_conductivity) / (density * specific_heat));
    };
    for (const ThermalMaterial& m : materials_) {
        consider(m.conductivity_solid, m.density, m.specific_heat_solid);
        consider(m.conductivity_liquid, m.density, m.specific_heat);
    }
    stable_time_step_ = greatest_diffusivity > 0.0
                            ? 0.075 * smoothing_length_ * smoothing_length_ / greatest_diffusivity *
                                  scene.definition.numerics.thermal_time_step_factor
                            : std::numeric_limits<double>::infinity();
}

void ThermalStep::set_state(Index i, double enthalpy)
{
    const ThermalMaterial& material = material_of(i);
    const double fraction = material.liquid_fraction(enthalpy);
    const double temperature = material.temperature(enthalpy, fraction);
    enthalpy_[i] = enthalpy;
    temperature_[i] = temperature;
    conductivity_[i] = material.conductivity(fraction);
    peak_temperature_[i] = std::max(peak_temperature_[i], temperature);
    if (liquid_fraction_) (*liquid_fraction_)[i] = fraction;
}

void ThermalStep::advance(const NeighbourList& list, double time, double time_step)
{
    update_geometry(list);
    conduct(list);
    if (walls_.any_temperature()) conduct_through_walls(time_step);
    if (laser_) {
        const LaserBeam::Power power = laser_->illuminate(particles_, *metal_, time, time_step, power_);
        books_.laser_emitted += power.emitted * time_step;
        books_.laser_hit += power.hit * time_step;
        books_.laser_absorbed += power.absorbed * time_step;
    }
    apply(time_step);
}

/// Clusters near which something has moved: elsewhere the sums that depend on places only are still true. What is
/// neighbour to a cluster that moves is in its list.
void ThermalStep::find_stale_clusters(const NeighbourList& list)
{
    all_clusters_.resize(static_cast<std::size_t>(list.cluster_count()));
    std::iota(all_clusters_.begin(), all_clusters_.end(), Index{0});
    stale_clusters_.clear();
    if (!geometry_known_ || !keeps_sums_) {
        stale_clusters_ = all_clusters_;
        geometry_known_ = true;
        return;
    }
    std::vector<unsigned char> stale(all_clusters_.size(), 0);
    for (const Index c : all_clusters_) {
        const Cluster& cluster = list.cluster(c);
        bool moved = false;
        for (Index i = cluster.first; i < cluster.first + cluster.count; ++i)
            moved = moved || moved_[i] != 0.0;
        if (!moved) continue;
        list.for_each_neighbour(c, [&](Index j) { stale[static_cast<std::size_t>(list.cluster_of(j))] = 1; });
    }
    for (const Index c : all_clusters_)
        if (stale[static_cast<std::size_t>(c)]) stale_clusters_.push_back(c);
    std::fill(moved_.values.begin(), moved_.values.end(), 0.0);
}

void ThermalStep::update_geometry(const NeighbourList& list)
{
    find_stale_clusters(list);
    const KernelCompleteness completeness{
        dimensions_, smoothing_length_, particles_.volume, conductivity_, particles_.position, walls_, correction_};
    if (!losses_.any()) {
        for_each_pair(list, particles_, kernel_, stale_clusters_, completeness);
        return;
    }
    for_each_pair(list, particles_, kernel_, stale_clusters_, completeness,
                  ExposedSurface{particles_.volume, *metal_, particles_.position, walls_, smoothing_length_,
                                 outermost_layer_share(walls_.layers(), spacing_), *exposed_area_});
}

void ThermalStep::conduct(const NeighbourList& list)
{
    const HeatConduction conduction{particles_.volume, temperature_, conductivity_, correction_, power_};
    if (!artificial_heat_) {
        for_each_pair(list, particles_, kernel_, all_clusters_, conduction);
        return;
    }
    const ArtificialHeatFields& fields = *artificial_heat_;
    for_each_pair(list, particles_, kernel_, all_clusters_,
                  VelocityDivergence{particles_.volume, conductivity_, particles_.velocity, fields.divergence});
    const Index count = particles_.count();
#pragma omp parallel for schedule(static)
    for (Index i = 0; i < count; ++i)
        fields.diffusivity[i] =
            is_wall(i) ? -1.0
                       : fields.conductivity(fields.divergence[i], particles_.density[i], material_of(i).specific_heat);
    for_each_pair(list, particles_, kernel_, all_clusters_, conduction,
                  ArtificialHeat{particles_.volume, temperature_, fields.diffusivity, power_});
}

void ThermalStep::conduct_through_walls(double time_step)
{
    const Index count = particles_.count();
    const auto power_from_walls = [&](Index i) {
        return is_wall(i) ? 0.0
                          : particles_.volume[i] * conductivity_[i] *
                                walls_.conduction(particles_.position[i], temperature_[i]);
    };
    books_.walls_in += time_step * ordered_sum(count, [&](Index i) { return std::max(0.0, power_from_walls(i)); });
    books_.walls_out += time_step * ordered_sum(count, [&](Index i) { return std::max(0.0, -power_from_walls(i)); });
#pragma omp parallel for schedule(static)
    for (Index i = 0; i < count; ++i)
        power_[i] += power_from_walls(i);
}

/// Enthalpies from powers, then each particle's losses, booked as applied in blocks of fixed size, so that the number
/// of threads does not matter.
void ThermalStep::apply(double time_step)
{
    constexpr Index block = 4096;
    const Index count = particles_.count(), blocks = (count + block - 1) / block;
    std::vector<LossShares> lost(static_cast<std::size_t>(blocks));
#pragma omp parallel for schedule(dynamic, 4)
    for (Index b = 0; b < blocks; ++b)
        for (Index i = b * block; i < std::min(count, (b + 1) * block); ++i) {
            if (is_wall(i)) continue;
            const double mass = particles_.mass[i];
            double enthalpy = enthalpy_[i] + time_step * power_[i] / mass;
            if (exposed_area_ && (*exposed_area_)[i] > 0.0) {
                LossShares shares =
                    implicit_losses(losses_, material_of(i), enthalpy, (*exposed_area_)[i] * time_step / mass);
                enthalpy -= shares.total();
                lost[static_cast<std::size_t>(b)] +=
                    {mass * shares.evaporation, mass * shares.radiation, mass * shares.convection};
            }
            set_state(i, enthalpy);
        }
    LossShares total;
    for (const LossShares& shares : lost)
        total += shares;
    books_.evaporation += total.evaporation;
    books_.radiation += total.radiation;
    books_.convection += total.convection;
}

double ThermalStep::stored_energy() const
{
    return ordered_sum(particles_.count(),
                       [&](Index i) { return is_wall(i) ? 0.0 : particles_.mass[i] * enthalpy_[i]; });
}

Ledger ThermalStep::ledger() const
{
    Ledger ledger;
    ledger.start = books_.stored_at_start;
    ledger.end = stored_energy();
    ledger.in = books_.laser_absorbed + books_.walls_in;
    ledger.out = books_.walls_out + books_.evaporation + books_.radiation + books_.convection;
    if (ledger.in == 0.0 && ledger.out == 0.0) ledger.reference = std::abs(ledger.start);
    return ledger;
}

double ThermalStep::laser_absorption_error() const
{
    const double expected = absorptivity_ * books_.laser_hit;
    return expected > 0.0 ? std::abs(books_.laser_absorbed - expected) / expected : 0.0;
}

TemperatureRange ThermalStep::temperature_range() const
{
    TemperatureRange range;
    for (Index i = 0; i < particles_.count(); ++i) {
        if (is_wall(i)) continue;
        const double temperature = temperature_[i];
        if (!std::isfinite(temperature)) return {temperature, temperature, i, i, false};
        if (range.coldest < 0 || temperature < range.lowest) {
            range.lowest = temperature;
            range.coldest = i;
        }
        if (range.hottest < 0 || temperature > range.highest) {
            range.highest = temperature;
            range.hottest = i;
        }
    }
    return range;
}

namespace
{

struct NamedAmount
{
    const char* name;
    double HeatBooks::*amount;
};
constexpr NamedAmount named_amounts[] = {{"stored_at_start", &HeatBooks::stored_at_start},
                                         {"laser_emitted", &HeatBooks::laser_emitted},
                                         {"laser_hit", &HeatBooks::laser_hit},
                                         {"laser_absorbed", &HeatBooks::laser_absorbed},
                                         {"walls_in", &HeatBooks::walls_in},
                                         {"walls_out", &HeatBooks::walls_out},
                                         {"evaporation", &HeatBooks::evaporation},
                                         {"radiation", &HeatBooks::radiation},
                                         {"convection", &HeatBooks::convection}};

} // namespace

void ThermalStep::save(std::map<std::string, double>& numbers) const
{
    for (const auto& [name, amount] : named_amounts)
        numbers[std::string("heat.") + name] = books_.*amount;
    numbers["heat.geometry_known"] = geometry_known_ ? 1.0 : 0.0;
}

void ThermalStep::load(const std::map<std::string, double>& numbers)
{
    HeatBooks books;
    for (const auto& [name, amount] : named_amounts)
        books.*amount = numbers.at(std::string("heat.") + name);
    geometry_known_ = numbers.at("heat.geometry_known") != 0.0;
    books_ = books;
}

} // namespace cupel::inline CUPEL_ENGINE
