/// How far one step may go. The smallest of the limits that the scene's physics set [s]:
///
///   capillary     √((ρ₁ + ρ₂) Δx³/(4πσ))        (Brackbill 1992): the shortest capillary wave is followed
///   Courant       C Δx/|u| over all cells, and a smaller C over cells at the interface
///   viscous       Δx²/4ν of the primary material (accuracy: the implicit term is of first order in time), Δx²/ν of the
///                 other
///   gravity       C Δx/√(g H), H the scene's height: gravity waves are followed
///   laser         a quarter of the spot radius of travel
///   diffusion     Δx²/(4a) of the liquid: only when nothing moves (accuracy; the scheme itself is implicit)
///
/// Steps land on the output times. Which limit bound how often is counted.
#pragma once

#include <map>
#include <string>

#include "fields.hpp"

namespace cupel
{
class TimeStep
{
public:
    TimeStep(const Scene& scene, const Fields& fields);

    /// The next step [s] from `time`, shortened so that an integer number of steps reaches `target`.
    scalar next(scalar time, scalar target);

    /// By how much that step is longer than the one before it [s]; 0 for the first.
    scalar longer_than_last() const { return longer_; }

    /// Greatest Courant number that the present velocity has with the step `step`.
    scalar courant(scalar step) const;
    const std::map<std::string, label>& binding() const { return binding_; }

    void save(dictionary& entries) const;
    void restore(const dictionary& entries);

private:
    /// Greatest Σ|φ|/2V of cells whose share is inside (low, high) [1/s].
    scalar flux_rate(scalar low, scalar high) const;

    const Scene& scene_;
    const Fields& fields_;
    scalar smallest_cell_, gravity_speed_, last_, taken_, longer_;
    std::map<std::string, label> binding_;
};
} // namespace cupel
