/// Who has given mechanical energy to the liquid, and who has taken it.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "ledgers/ledger.hpp"
#include "math/vector.hpp"

namespace cupel
{

/// What is done to motion in a kick, by cause, J, of a particle or of a cluster of them.
template <class Scalar> struct WorkOnMotion
{
    Scalar pressure = 0.0, viscosity = 0.0, gravity = 0.0, surface = 0.0, artificial = 0.0, imbalance = 0.0, mush = 0.0;

    static constexpr Scalar WorkOnMotion::*causes[]{
        &WorkOnMotion::pressure,   &WorkOnMotion::viscosity, &WorkOnMotion::gravity, &WorkOnMotion::surface,
        &WorkOnMotion::artificial, &WorkOnMotion::imbalance, &WorkOnMotion::mush};

    WorkOnMotion& operator+=(const WorkOnMotion& other)
    {
        for (const auto cause : causes)
            this->*cause += other.*cause;
        return *this;
    }
    /// By forces other than drag.
    Scalar by_forces() const { return pressure + viscosity + gravity + surface + artificial; }
};

/// Work on the liquid that moves since the start, J, each of one cause. Mechanical energy is ½ m v² + m e, e(ρ) the
/// elastic energy of the equation of state. A kick's work on a particle is its force times the mean of the velocities
/// before and after, so that kinetic energy changes by the sum of all works to round-off; elastic energy changes with
/// density, whose change is the sum of its causes as well. What pressure gives to motion it takes from compression:
/// only what the two leave, by steps of finite length and by walls that give pressure and do not yield, is unexplained,
/// and is the closure.
struct MechanicalWork
{
    // On motion
    double pressure = 0;
    double viscosity = 0;
    double gravity = 0;
    double surface = 0;    ///< tension, Marangoni stress, recoil, cohesion
    double artificial = 0; ///< artificial viscosity and stress
    double shifting = 0;   ///< what particles exchange when they are shifted: mass, momentum, density
    double imbalance = 0;  ///< pressure that no compression of liquid answers: of walls and solids
    double mush = 0;       ///< drag of the mushy zone
    double stops = 0;      ///< what is held before a wall, freezes or escapes
    // On compression
    double compression = 0;       ///< by the flow: takes what pressure gives
    double density_diffusion = 0; ///< or, in two phases, their transport velocity
    double limiter = 0;           ///< densities that were cut off, spray at its rest density

    static constexpr double MechanicalWork::*causes[]{&MechanicalWork::viscosity,         &MechanicalWork::gravity,
                                                      &MechanicalWork::surface,           &MechanicalWork::artificial,
                                                      &MechanicalWork::shifting,          &MechanicalWork::mush,
                                                      &MechanicalWork::imbalance,         &MechanicalWork::stops,
                                                      &MechanicalWork::density_diffusion, &MechanicalWork::limiter};
    static constexpr const char* names[]{"viscosity", "gravity",   "surface", "artificial",        "shifting",
                                         "mush",      "imbalance", "stops",   "density_diffusion", "limiter"};
    static constexpr double MechanicalWork::*between[]{&MechanicalWork::pressure, &MechanicalWork::compression};
    static constexpr const char* names_between[]{"pressure", "compression"};

    MechanicalWork& operator+=(const MechanicalWork& other)
    {
        for (const auto cause : causes)
            this->*cause += other.*cause;
        for (const auto cause : between)
            this->*cause += other.*cause;
        return *this;
    }

    MechanicalWork& operator+=(const WorkOnMotion<double>& work)
    {
        pressure += work.pressure;
        viscosity += work.viscosity;
        gravity += work.gravity;
        surface += work.surface;
        artificial += work.artificial;
        imbalance += work.imbalance;
        mush += work.mush;
        return *this;
    }

    /// The books from what was there at the start and is there now, J.
    Ledger ledger(double start, double end) const
    {
        Ledger ledger;
        ledger.start = start;
        ledger.end = end;
        for (const auto cause : causes) {
            ledger.in += std::max(0.0, this->*cause);
            ledger.out += std::max(0.0, -(this->*cause));
        }
        ledger.reference = start;
        return ledger;
    }

    std::map<std::string, double> details() const
    {
        std::map<std::string, double> result;
        for (std::size_t k = 0; k < std::size(causes); ++k)
            result[std::string("by_") + names[k]] = this->*causes[k];
        for (std::size_t k = 0; k < std::size(between); ++k)
            result[std::string("by_") + names_between[k]] = this->*between[k];
        return result;
    }

    void save(std::map<std::string, double>& numbers) const
    {
        for (const auto& [name, value] : details())
            numbers["work." + name] = value;
    }
    void load(const std::map<std::string, double>& numbers)
    {
        for (std::size_t k = 0; k < std::size(causes); ++k)
            this->*causes[k] = numbers.at(std::string("work.by_") + names[k]);
        for (std::size_t k = 0; k < std::size(between); ++k)
            this->*between[k] = numbers.at(std::string("work.by_") + names_between[k]);
    }
};

} // namespace cupel
