#include "mushy_drag.hpp"

namespace cupel
{
tmp<volScalarField> mushy_drag(const Scene& scene, const Fields& fields)
{
    const PrimaryMaterial& primary = scene.primary;
    const scalar constant = primary.mushy_drag;
    const volScalarField drag("drag", map_field(fields.heat->temperature, "drag", dimDensity / dimTime,
                                                [&primary, constant](scalar temperature) {
                                                    const scalar liquid = primary.liquid_fraction(temperature);
                                                    return constant * sqr(1 - liquid) / (pow3(liquid) + 1e-3);
                                                }));
    return drag * fields.bounded_fraction();
}
} // namespace cupel
