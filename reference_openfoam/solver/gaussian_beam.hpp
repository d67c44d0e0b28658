/// The beam's cross-section: I(r) = 2P/(π r₀²) exp(−2 r²/r₀²), a product of one Gaussian in x and one in y.
#pragma once

#include <cmath>

#include "foam.hpp"

namespace cupel
{
/// Share of a Gaussian of 1/e² radius r₀ that lies between lower and upper, both from its axis.
inline scalar gaussian_share(scalar lower, scalar upper, scalar radius)
{
    const scalar scale = std::sqrt(2.0) / radius;
    return 0.5 * (std::erf(upper * scale) - std::erf(lower * scale));
}
} // namespace cupel
