#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace cupel
{

/// A scene that a benchmark steps through time. Outside the engines: it names no vector register.
class StepBenchmark
{
public:
    virtual ~StepBenchmark() = default;
    virtual void step() = 0;
    virtual std::size_t count() const = 0;
    virtual double updates() const = 0;     ///< of particles so far: one each time that sound moves one on
    virtual std::size_t bytes() const = 0;  ///< memory of particles, lists and passes together
    virtual double neighbours() const = 0;  ///< mean number within the support; 0 where it is not counted
    virtual std::size_t builds() const = 0; ///< of the neighbour list, so far
    virtual std::vector<double> accelerations() const = 0; ///< by a particle's number, x y z in turn
};

/// What a block of molten metal is computed with.
struct MeltPoolScene
{
    std::vector<std::string> physics;
    double density_diffusion = 0.1;
    double shifting = 0.0;
    double artificial_viscosity = 0.0;
    double artificial_stress = 0.0;
    int acoustic_substeps = 1;
};

using MakePlainStep = std::unique_ptr<StepBenchmark> (*)(std::size_t particles);
using MakeMeltPoolStep = std::unique_ptr<StepBenchmark> (*)(std::size_t particles, const MeltPoolScene&);

/// The same plain step as a loop over the particles of 27 cells, `omp simd` within: what a reader might write at first.
std::unique_ptr<StepBenchmark> make_naive_step(std::size_t particles);

} // namespace cupel
