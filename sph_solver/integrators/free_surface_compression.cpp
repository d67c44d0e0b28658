/// What rates do to the densities of a free-surface flow, and what shifting carries between its particles.
#include "integrators/free_surface_flow.hpp"

#include <array>
#include <iterator>
#include <type_traits>

#include "integrators/values_at.hpp"

namespace cupel::inline CUPEL_ENGINE
{

namespace
{

/// What compression has a part in,
constexpr double MechanicalWork::*causes[]{&MechanicalWork::compression, &MechanicalWork::imbalance,
                                           &MechanicalWork::density_diffusion, &MechanicalWork::shifting,
                                           &MechanicalWork::limiter};

/// and its work by these, J, on one particle or on a cluster.
template <class Scalar> struct WorkOfCompression
{
    std::array<Scalar, std::size(causes)> by{};

    WorkOfCompression& operator+=(const WorkOfCompression& other)
    {
        for (std::size_t k = 0; k < by.size(); ++k)
            by[k] += other.by[k];
        return *this;
    }
};

/// How densities change in a step, kg/m³: in all, and of that by diffusion and by shifting.
template <class Scalar> struct Changes
{
    Scalar all, diffused, shifted;
};

} // namespace

/// Mass goes from particle to particle with its momentum and its enthalpy.
void FreeSurfaceFlow::exchange(const Neighbourhood& neighbourhood, double time_step)
{
    const auto& moving = neighbourhood.moving_particles();
    books_.shifting += ordered_sum(static_cast<Index>(moving.size()), [&](Index m) {
        const Index i = moving[static_cast<std::size_t>(m)];
        const double gain = time_step * (*mass_rate_)[i], mass = particles_.mass[i] + gain;
        if (enthalpy_) (*enthalpy_)[i] = (particles_.mass[i] * (*enthalpy_)[i] + time_step * (*energy_rate_)[i]) / mass;
        const Vector before = particles_.velocity[i], velocity = before + (time_step / mass) * (*momentum_rate_)[i];
        const double kinetic = 0.5 * (mass * dot(velocity, velocity) - particles_.mass[i] * dot(before, before));
        particles_.mass[i] = mass;
        particles_.velocity.set(i, velocity);
        return kinetic + gain * elastic_energy(i);
    });
}

/// Densities from their rates, each for its time, and with them volumes and pressures. In double a cluster at a time,
/// where its particles are near their density at rest: what is summed up from step to step has that precision.
void FreeSurfaceFlow::compress(const Neighbourhood& neighbourhood, const CompressionTimes& times)
{
    // What is caught between solids that melt and freeze around it is cushioned: its pressure stays below 0.05 ρ c₀²,
    // above any that capillarity or recoil can raise, and does not throw off what is near. The history shows how far
    // densities went.
    constexpr double limit = 0.05;
    const EquationOfState law = parameters_.equation_of_state;
    const double rest = rest_density_, per_rest = 1.0 / rest, least = (1.0 - limit) * rest, most = (1.0 + limit) * rest;
    const bool meets_walls = !neighbourhood.standing().empty(), shifts = times.shifting > 0.0;
    const bool diffuses = diffusion_rate_ && times.diffusion > 0.0;
    const double fewest_companions = surface_ ? surface_->fewest_companions() : 0.0;

    const auto changes_of = [&](const auto& at) {
        using Scalar = typename std::decay_t<decltype(at)>::Scalar;
        Changes<Scalar> changes{Scalar(times.flow) * at(density_rate_), Scalar(0.0), Scalar(0.0)};
        if (diffuses) changes.diffused = Scalar(times.diffusion) * at(*diffusion_rate_);
        if (shifts) changes.shifted = Scalar(times.shifting) * (at(*shifting_density_rate_) + at(*packing_rate_));
        changes.all += changes.diffused + changes.shifted;
        return changes;
    };
    // pressure(ρ) and energy(y) of the equation of state, as this is or linear and near rest.
    const auto compress = [&](const auto& at, const auto& changes, const auto& pressure, const auto& energy) {
        using Scalar = typename std::decay_t<decltype(at)>::Scalar;
        const Scalar zero(0.0), mass = at(particles_.mass), before = at(particles_.density);
        const Scalar unlimited = before + changes.all;
        Scalar density = unlimited;
        // Spray flies freely: what two or three particles that collide make of the continuity equation is no density.
        if (surface_)
            density = select(at(surface_->fields().companions) < Scalar(fewest_companions), Scalar(rest), density);
        // What is no number stays so, for a guard to find.
        density = select(density < Scalar(least), Scalar(least), select(density > Scalar(most), Scalar(most), density));
        at.store(particles_.density, density);
        at.store(particles_.volume, mass / density);
        at.store(*excess_pressure_, pressure(density));

        const auto energy_at = [&](const Scalar& rho) { return energy((rho - Scalar(rest)) * Scalar(per_rest)); };
        const auto stiffness = [&](const Scalar& rho) { return pressure(rho) / (rho * rho); }; // de/dρ
        const Scalar energy_before = energy_at(before);
        // What a change of density is worth. Where it was limited, forces have never seen what is cut off: it is worth
        // what the pressures at both ends of the step say, and the limiter answers for the rest.
        const auto limited = (density < unlimited) | (density > unlimited);
        const Scalar worth_of_change =
            select(changes.all * changes.all > zero, mass * (energy_at(unlimited) - energy_before) / changes.all, zero);
        const Scalar worth =
            select(limited, Scalar(0.5) * mass * (stiffness(before) + stiffness(density)), worth_of_change);
        Scalar replaced = zero;
        if (replaced_rate_) replaced = select(at(surface_->fields().delta) > zero, at(*replaced_rate_), zero);
        const Scalar worth_of_flow = Scalar(times.flow) * worth;
        const Scalar imbalance = meets_walls ? replaced + at(density_rate_by_walls_) : replaced;
        return WorkOfCompression<Scalar>{
            {worth_of_flow * (at(density_rate_) - replaced), worth_of_flow * imbalance, worth * changes.diffused,
             worth * changes.shifted,
             select(limited, mass * (energy_at(density) - energy_before) - worth * changes.all, zero)}};
    };
    const auto compress_one = [&](Index i) {
        const OneParticle at{i};
        return compress(
            at, changes_of(at), [&](double density) { return law.pressure(density, rest); },
            [&](double y) { return law.elastic_energy(y); });
    };
    const auto compress_cluster = [&](const Cluster& cluster) {
        const SomeOfCluster at{cluster.first, mobility_.moving_in(cluster)};
        const auto changes = changes_of(at);
        const Lanes before = at(particles_.density) - rest, after = before + changes.all;
        const double near = law.series_up_to * rest;
        const LaneMask far = (before > near) | (before < -near) | (after > near) | (after < -near);
        WorkOfCompression<Lanes> work;
        if (law.exponent == 1.0 && (set_lanes(far) & at.which) == 0) {
            const double c2 = law.sound_speed * law.sound_speed;
            work = compress(
                at, changes, [&](const Lanes& density) { return c2 * (density - rest); },
                [&](const Lanes& y) { return law.elastic_energy_near_rest(y); });
            for (Lanes& some : work.by)
                some = at.chosen(some);
        }
        else
            for (int lane = 0; lane < cluster.count; ++lane)
                if (at.which >> lane & 1u) {
                    const auto one = compress_one(cluster.first + lane);
                    for (std::size_t k = 0; k < one.by.size(); ++k)
                        work.by[k].set(lane, one.by[k]);
                }
        return work;
    };
    const auto keep = [&](const auto& work) {
        for (std::size_t k = 0; k < work.by.size(); ++k)
            books_.*causes[k] += sum_of(work.by[k]);
    };
    if constexpr (sizeof(Real) == sizeof(double)) {
        const auto& clusters = neighbourhood.moving();
        keep(ordered_sum(static_cast<Index>(clusters.size()), [&](Index k) {
            return compress_cluster(neighbourhood.list().cluster(clusters[static_cast<std::size_t>(k)]));
        }));
    }
    else {
        const auto& moving = neighbourhood.moving_particles();
        keep(ordered_sum(static_cast<Index>(moving.size()),
                         [&](Index m) { return compress_one(moving[static_cast<std::size_t>(m)]); }));
    }
}

} // namespace cupel::inline CUPEL_ENGINE
