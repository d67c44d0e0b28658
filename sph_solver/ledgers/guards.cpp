#include "ledgers/guards.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cupel
{

namespace
{

bool finite(const Vector& a)
{
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

bool within(const Vector& a, const Vector& lower, const Vector& upper)
{
    return a.x >= lower.x && a.x <= upper.x && a.y >= lower.y && a.y <= upper.y && a.z >= lower.z && a.z <= upper.z;
}

/// 0, or not a number where `a` is none or infinite.
double zero_times(double a)
{
    return a - a;
}

/// The component that is no number, or the norm where all are.
double telling_value(const Vector& a)
{
    for (const double component : {a.x, a.y, a.z})
        if (!std::isfinite(component)) return component;
    return norm(a);
}

} // namespace

std::string Diagnosis::line() const
{
    const std::string where = identity < 0 ? std::string()
                                           : fmt::format(" of particle {} at ({:.6g}, {:.6g}, {:.6g}) m", identity,
                                                         place.x, place.y, place.z);
    return fmt::format("{}: {}: {} = {:.6g}{}, time {:.9g} s; {}", model, problem, quantity, value, where, time,
                       remedy);
}

Guards::Guards(const Particles& particles, GuardLimits limits)
    : particles_(&particles), limits_(std::move(limits)), bounds_(limits_.density)
{
    bounds_.push_back({-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()});
    if (particles.has("temperature")) temperature_ = &particles.scalar("temperature");
}

const DensityBounds& Guards::density_bounds(Index i) const
{
    return bounds_[std::min<std::size_t>(particles_->material[static_cast<std::size_t>(i)], bounds_.size() - 1)];
}

bool Guards::sound(Index i) const
{
    // Without branches, as this is asked of every particle: comparisons with a value that is not a number are false.
    const auto k = static_cast<std::size_t>(i);
    const Vector x = particles_->position[i];
    const Vector v = particles_->velocity[i];
    const double density = particles_->density[i];
    const double temperature = temperature_ ? (*temperature_)[i] : limits_.lowest_temperature;
    const DensityBounds& bounds = density_bounds(i);
    const bool numbers = zero_times(x.x + x.y + x.z + v.x + v.y + v.z + density + temperature) == 0.0;
    const bool flows_within_limits = (x.x >= limits_.lower.x) & (x.x <= limits_.upper.x) & (x.y >= limits_.lower.y) &
                                     (x.y <= limits_.upper.y) & (x.z >= limits_.lower.z) & (x.z <= limits_.upper.z) &
                                     (dot(v, v) <= limits_.sound_speed * limits_.sound_speed) &
                                     (density >= bounds.lower) & (density <= bounds.upper);
    const bool warm_within_limits =
        (temperature >= limits_.lowest_temperature) & (temperature <= limits_.highest_temperature);
    const Kind kind = particles_->kind[k];
    return numbers & (flows_within_limits | (kind != Kind::fluid)) & (warm_within_limits | (kind == Kind::wall));
}

/// Whether a block of particles stands (most of a powder bed and its plate does) and is sound, seen in one sweep of
/// vector registers. Where it says no, each particle has to be asked.
bool Guards::stands_and_is_sound(std::size_t first, std::size_t end) const
{
    for (std::size_t k = first; k < end; ++k)
        if (particles_->kind[k] == Kind::fluid) return false;
    const double *x = particles_->position.x.data(), *y = particles_->position.y.data();
    const double *z = particles_->position.z.data(), *density = particles_->density.values.data();
    const double *u = particles_->velocity.x.data(), *v = particles_->velocity.y.data();
    const double* w = particles_->velocity.z.data();
    const double* temperature = temperature_ ? temperature_->values.data() : density;
    double sum = 0.0;
    double coldest = temperature[first], warmest = coldest;
#pragma omp simd reduction(+ : sum) reduction(min : coldest) reduction(max : warmest)
    for (std::size_t k = first; k < end; ++k) {
        sum += zero_times(x[k] + y[k] + z[k] + u[k] + v[k] + w[k] + density[k] + temperature[k]);
        coldest = temperature[k] < coldest ? temperature[k] : coldest;
        warmest = temperature[k] > warmest ? temperature[k] : warmest;
    }
    return sum == 0.0 &&
           (!temperature_ || (coldest >= limits_.lowest_temperature && warmest <= limits_.highest_temperature));
}

std::optional<Diagnosis> Guards::check(double time) const
{
    constexpr Index none = std::numeric_limits<Index>::max();
    constexpr std::size_t block = 128;
    const auto count = static_cast<std::size_t>(particles_->count());
    const std::size_t blocks = (count + block - 1) / block;
    Index found = none;
#pragma omp parallel for schedule(static) reduction(min : found)
    for (std::size_t b = 0; b < blocks; ++b) {
        const std::size_t first = b * block, end = std::min(count, first + block);
        if (stands_and_is_sound(first, end)) continue;
        for (std::size_t k = first; k < end; ++k)
            if (!sound(static_cast<Index>(k))) found = std::min(found, particles_->identity[k]);
    }
    if (found == none) return {};
    return diagnose(particles_->place_of(found), time);
}

std::optional<Diagnosis> Guards::check(std::span<const Index> places, double time) const
{
    constexpr Index none = std::numeric_limits<Index>::max();
    const std::size_t count = places.size();
    Index found = none;
#pragma omp parallel for schedule(static) reduction(min : found)
    for (std::size_t k = 0; k < count; ++k)
        if (!sound(places[k])) found = std::min(found, particles_->identity[static_cast<std::size_t>(places[k])]);
    if (found == none) return {};
    return diagnose(particles_->place_of(found), time);
}

Diagnosis Guards::diagnose(Index i, double time) const
{
    const Vector position = particles_->position[i];
    const Vector velocity = particles_->velocity[i];
    const double density = particles_->density[i];
    const double temperature = temperature_ ? (*temperature_)[i] : limits_.lowest_temperature;
    Diagnosis diagnosis;
    diagnosis.time = time;
    diagnosis.identity = particles_->identity[static_cast<std::size_t>(i)];
    diagnosis.place = position;
    const auto say = [&](std::string model, std::string problem, std::string quantity, double value,
                         std::string remedy) {
        diagnosis.model = std::move(model);
        diagnosis.problem = std::move(problem);
        diagnosis.quantity = std::move(quantity);
        diagnosis.value = value;
        diagnosis.remedy = std::move(remedy);
        return diagnosis;
    };
    const bool flows = particles_->kind[static_cast<std::size_t>(i)] == Kind::fluid;
    const std::string smaller_step = "reduce numerics.time_step_factor, or take a finer level";
    if (!std::isfinite(density)) return say("continuity", "not a number", "density [kg/m3]", density, smaller_step);
    if (!finite(velocity))
        return say("momentum", "not a number", "velocity [m/s]", telling_value(velocity), smaller_step);
    if (!finite(position)) return say("motion", "not a number", "position [m]", telling_value(position), smaller_step);
    if (!std::isfinite(temperature))
        return say("heat", "not a number", "temperature [K]", temperature, "reduce numerics.thermal_time_step_factor");
    if (flows && !within(position, limits_.lower, limits_.upper))
        return say("walls", "a particle has left the domain", "speed [m/s]", norm(velocity),
                   "enlarge the domain where it is open, else reduce numerics.time_step_factor");
    if (flows && !(dot(velocity, velocity) <= limits_.sound_speed * limits_.sound_speed))
        return say("momentum",
                   fmt::format("faster than the artificial speed of sound, {:.6g} m/s", limits_.sound_speed),
                   "speed [m/s]", norm(velocity), "raise numerics.reference_speed or numerics.sound_speed");
    if (!(temperature >= limits_.lowest_temperature && temperature <= limits_.highest_temperature))
        return say("heat",
                   fmt::format("outside {:.6g} to {:.6g} K", limits_.lowest_temperature, limits_.highest_temperature),
                   "temperature [K]", temperature,
                   "reduce numerics.thermal_time_step_factor, or check laser power and absorptivity");
    const DensityBounds& bounds = density_bounds(i);
    return say("equation of state", fmt::format("outside {:.6g} to {:.6g} kg/m3", bounds.lower, bounds.upper),
               "density [kg/m3]", density, "raise numerics.sound_speed_factor, or reduce numerics.time_step_factor");
}

std::optional<Diagnosis> Guards::check_time_step(double time_step, std::string_view binding, double time) const
{
    if (std::isfinite(time_step) && time_step > 0.0 && time_step >= limits_.smallest_time_step) return {};
    Diagnosis diagnosis;
    diagnosis.model = "time step (" + std::string(binding) + ")";
    diagnosis.problem = fmt::format("collapsed below {:.6g} s", limits_.smallest_time_step);
    diagnosis.quantity = "time step [s]";
    diagnosis.value = time_step;
    diagnosis.time = time;
    diagnosis.remedy = "check the values that its criterion depends on, or take a coarser level";
    return diagnosis;
}

} // namespace cupel
