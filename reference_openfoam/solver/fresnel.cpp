#include "fresnel.hpp"

namespace cupel
{
scalar hagen_rubens_number(scalar normal_absorptivity)
{
    const scalar half = 2 - normal_absorptivity;
    return (half - Foam::sqrt(max(sqr(half) - 2 * sqr(normal_absorptivity), scalar(0)))) / normal_absorptivity;
}

scalar fresnel_absorptivity(scalar cosine, scalar hagen_rubens)
{
    const scalar product = hagen_rubens * cosine, squares = sqr(hagen_rubens) + 2 * sqr(cosine);
    return 1 -
           0.5 * ((1 + sqr(1 - product)) / (1 + sqr(1 + product)) + (squares - 2 * product) / (squares + 2 * product));
}
} // namespace cupel
