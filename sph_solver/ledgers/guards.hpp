/// Guards: a state that physics or the method cannot have ends the run with a diagnosis instead of a wrong result.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "particles/particles.hpp"

namespace cupel
{

/// What a guard found, where, and what to do about it.
struct Diagnosis
{
    std::string model;   ///< whose result it is, e.g. "equation of state"
    std::string problem; ///< e.g. "density error beyond its bound"
    std::string remedy;
    std::string quantity; ///< what `value` is, with unit
    double value = 0;
    double time = 0;     ///< simulated [s]
    Index identity = -1; ///< of the particle; −1 where the problem has no place
    Vector place{};      ///< [m]

    /// All of it in one line.
    std::string line() const;
};

/// Bounds of density in one material [kg/m3].
struct DensityBounds
{
    double lower = 0;
    double upper = std::numeric_limits<double>::infinity();
};

/// What a scene allows. Bounds are inclusive; what is infinite is not checked beyond being a number.
struct GuardLimits
{
    std::vector<DensityBounds> density; ///< a material each, in the order of Particles::material; may be empty
    double sound_speed = std::numeric_limits<double>::infinity();         ///< artificial [m/s]
    double lowest_temperature = 0;                                        ///< [K]
    double highest_temperature = std::numeric_limits<double>::infinity(); ///< [K]
    Vector lower{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                 -std::numeric_limits<double>::infinity()}; ///< of the domain, with the margin that the walls have [m]
    Vector upper{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                 std::numeric_limits<double>::infinity()};
    double smallest_time_step = 0; ///< below it a run does not get on [s]
};

/// Checks a scene's particles. The field "temperature" is checked where it is registered, in solids as in liquids. What
/// else wall and solid particles have only carries boundary conditions: it has to be a number, no more.
class Guards
{
public:
    /// The particles have to outlive the guards, and all fields have to be registered before.
    Guards(const Particles& particles, GuardLimits limits);

    /// The first problem by particle identity (the same for any number of threads), if there is one. One pass over
    /// position, velocity, density and temperature.
    std::optional<Diagnosis> check(double time) const;

    /// The same for some of the particles, given by their places.
    std::optional<Diagnosis> check(std::span<const Index> places, double time) const;

    /// A time step [s] that is no positive number or below the smallest one; `binding` names its criterion.
    std::optional<Diagnosis> check_time_step(double time_step, std::string_view binding, double time) const;

private:
    const DensityBounds& density_bounds(Index i) const;
    bool stands_and_is_sound(std::size_t first, std::size_t end) const;
    bool sound(Index i) const;
    Diagnosis diagnose(Index i, double time) const;

    const Particles* particles_;
    const ScalarField* temperature_ = nullptr;
    GuardLimits limits_;
    std::vector<DensityBounds> bounds_; ///< a material each, and last those of materials without any
};

} // namespace cupel
