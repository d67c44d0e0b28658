#include "scene.hpp"

namespace cupel
{
Physics::Physics(const wordList& names)
    : flow(names.found("flow")), surface_tension(names.found("surface_tension")), wetting(names.found("wetting")),
      marangoni(names.found("marangoni")), recoil(names.found("recoil")), evaporation(names.found("evaporation")),
      radiation(names.found("radiation")), laser(names.found("laser")), heat(names.found("heat")),
      melting(names.found("melting")), gravity(names.found("gravity"))
{}

LaserPath::LaserPath(const dictionary& entries)
    : power(entries.get<scalar>("power")), speed(entries.get<scalar>("speed")),
      spot_radius(entries.get<scalar>("spot_radius")), absorptivity(entries.get<scalar>("absorptivity")),
      start_time(entries.get<scalar>("start")), from(entries.get<point>("from")), to(entries.get<point>("to"))
{}

bool LaserPath::is_on(scalar time) const
{
    if (time < start_time) return false;
    return speed <= 0 || speed * (time - start_time) <= mag(to - from);
}

point LaserPath::axis(scalar time) const
{
    const scalar length = mag(to - from);
    if (length <= 0) return from;
    return from + (to - from) * (speed * (time - start_time) / length);
}

Scene::Scene(const IOdictionary& entries)
    : physics(entries.get<wordList>("physics")), primary(entries.subDict("primary")),
      surrounding(entries.subDict("surrounding")), ambient_temperature(entries.get<scalar>("ambient_temperature")),
      ambient_pressure(entries.get<scalar>("ambient_pressure")),
      convection_coefficient(entries.get<scalar>("convection_coefficient")), end_time(entries.get<scalar>("end_time")),
      output_interval(entries.get<scalar>("output_interval")), spacing(entries.get<scalar>("spacing")),
      numerics(entries.subDict("numerics"))
{
    if (physics.laser) laser.reset(new LaserPath(entries.subDict("laser")));
}
} // namespace cupel
