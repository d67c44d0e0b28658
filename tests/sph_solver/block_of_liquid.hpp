#pragma once

#include "models/gradient_correction.hpp"
#include "small_scenes.hpp"

namespace cupel
{

/// A jittered block of liquid with its list, for one term at a time.
struct Block
{
    explicit Block(int dimensions_, int n = 12, double jitter = 0.25)
        : dimensions(dimensions_), particles(small_scenes::jittered_lattice(n, dimensions_, jitter)),
          mobility(particles.add_scalar({"mobility", "1"}, 1.0)), neighbourhood(3.0, 0.3, 1.0, dimensions_),
          kernel(1.0, dimensions_), correction(CorrectionMatrix::register_in(particles))
    {
        for (Index i = 0; i < particles.count(); ++i)
            mobility[i] = 1.0;
        neighbourhood.rebuild(particles, mobility);
        run(GradientCorrection{{mobility}, dimensions, correction});
    }
    template <class Term> void run(const Term& term)
    {
        for_each_pair(neighbourhood.list(), particles, kernel, neighbourhood.moving(), term);
    }

    /// Mean of the particles' places, m.
    Vector middle() const
    {
        Vector mean{};
        for (Index i = 0; i < particles.count(); ++i)
            mean += (1.0 / static_cast<double>(particles.count())) * particles.position[i];
        return mean;
    }

    int dimensions;
    Particles particles;
    ScalarField& mobility;
    Neighbourhood neighbourhood;
    RootFree kernel;
    CorrectionMatrix correction;
};

} // namespace cupel
