#include "volume_fraction.hpp"

namespace cupel
{
void advance_volume_fraction(const Scene& scene, Fields& fields, InterfaceTransport& transport,
                             InterfaceGeometry& geometry, label step)
{
    FlowFields& flow = fields.flow();
    transport.advance(fields, step % 3);
    flow.mass_flux =
        flow.fraction_flux * dimensionedScalar("jump", dimDensity, scene.primary.density - scene.surrounding.density) +
        flow.flux * dimensionedScalar("surrounding", dimDensity, scene.surrounding.density);
    fields.update_density(scene);
    geometry.update();
}
} // namespace cupel
