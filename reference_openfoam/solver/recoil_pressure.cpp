#include "recoil_pressure.hpp"

namespace cupel
{
void add_recoil_pressure(surfaceScalarField& force, const surfaceScalarField& interface_gradient, const Scene& scene,
                         const Fields& fields)
{
    const PrimaryMaterial& primary = scene.primary;
    const scalar ambient = scene.ambient_pressure;
    const volScalarField share("share", fields.bounded_fraction() + scalar(1e-6));
    const volScalarField recoil(
        "recoil_pressure",
        map_field(fields.heat->temperature, "recoil_pressure", dimPressure, [&primary, ambient](scalar temperature) {
            // nothing evaporates that counts below two thirds of the boiling temperature (p_sat < 1e-5 p₀)
            return 3 * temperature < 2 * primary.boiling_temperature
                       ? 0
                       : 0.54 * primary.saturation_pressure(temperature, ambient);
        }));
    force += fvc::interpolate(recoil * share) / fvc::interpolate(share) * interface_gradient;
}
} // namespace cupel
