/// The steps in which a free-surface flow follows sound while all else is held.
#include "integrators/free_surface_flow.hpp"
#include "models/sound.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Shifting moves particles for the whole of a step. What that carries between them is found in the middle of it, where
/// their places are the mean of those on the way.
void FreeSurfaceFlow::find_densities(const Neighbourhood& neighbourhood, const SoundStep& step)
{
    const bool exchanges = shift_ && step.halfway;
    const Continuity continuity{mobility_, particles_.density, particles_.velocity, density_rate_};
    const ContinuityOfBand of_band{mobility_,
                                   particles_.density,
                                   particles_.velocity,
                                   correction_,
                                   carried_load_ ? &surface_->fields().delta : nullptr,
                                   density_rate_,
                                   replaced_rate_};
    const auto sum_all = [&](const auto&... others) {
        for_each_pair(neighbourhood.list(), particles_, kernel_, neighbourhood.moving(), continuity, others...,
                      of_band);
    };
    const auto sum = [&](auto with_walls) {
        const auto sum_with_walls = [&](const auto&... others) {
            if constexpr (with_walls())
                sum_all(continuity_by_walls(), others...);
            else
                sum_all(others...);
        };
        exchanges ? sum_with_exchange<with_walls()>(neighbourhood, sum_with_walls) : sum_with_walls();
    };
    extrapolate_velocity(neighbourhood, exchanges);
    neighbourhood.standing().empty() ? sum(std::false_type{}) : sum(std::true_type{});
    if (exchanges) {
        exchange(neighbourhood, step.whole);
        exchanged_ = true;
    }
    compress(neighbourhood, {step.time_step, 0.0, exchanges ? step.whole : 0.0});
}

void FreeSurfaceFlow::evaluate_sound(const Neighbourhood& neighbourhood, const SoundStep& step)
{
    extrapolate_pressure(neighbourhood);
    find_pressure_force(neighbourhood, step.last);
    sound_ahead_ += step.time_step;
}

/// The force of pressure, and before the step ends the gradient of density by which it then diffuses.
void FreeSurfaceFlow::find_pressure_force(const Neighbourhood& neighbourhood, bool with_density_gradient)
{
    const bool finds_gradient = density_gradient_ && with_density_gradient;
    const auto sum = [&](auto with_walls) {
        const PressureForce<with_walls()> force{mobility_, particles_.volume, *excess_pressure_, pressure_force_,
                                                *wall_force_};
        const auto sum_all = [&](const auto&... others) {
            for_each_pair(neighbourhood.list(), particles_, kernel_, neighbourhood.moving(), force, others...);
        };
        finds_gradient ? sum_all(ScalarGradient{mobility_, particles_.density, *density_gradient_}) : sum_all();
    };
    neighbourhood.standing().empty() ? sum(std::false_type{}) : sum(std::true_type{});
    if (finds_gradient) correct_density_gradient(neighbourhood);
}

} // namespace cupel::inline CUPEL_ENGINE
