#include "scene/physics.hpp"

#include <algorithm>

namespace cupel
{

const std::vector<PhysicsDeclaration>& physics_declarations()
{
    static const std::vector<PhysicsDeclaration> declarations{
        {"flow", {}, "mass and momentum of what is liquid or gas"},
        {"gravity", {"flow"}, "the uniform acceleration `gravity`"},
        {"surface_tension", {"flow"}, "capillary force sigma kappa on the surface or interface"},
        {"wetting", {"surface_tension"}, "contact angle where the surface meets a wall or a solid"},
        {"marangoni", {"flow"}, "tangential force from the surface tension's dependence on temperature"},
        {"heat", {}, "conduction and transport of heat; without it temperature is the frozen initial field"},
        {"melting", {"heat"}, "enthalpy with latent heat, solid that stands still and a mushy zone between"},
        {"laser", {"heat"}, "absorbed flux of a Gaussian beam on the surface that it sees"},
        {"radiation", {"heat"}, "radiative and convective loss from the surface"},
        {"evaporation", {"heat"}, "evaporative heat loss from the surface"},
        {"recoil", {"flow"}, "recoil pressure of evaporation on the surface"}};
    return declarations;
}

bool is_physics(std::string_view name)
{
    const auto& all = physics_declarations();
    return std::any_of(all.begin(), all.end(), [name](const auto& physics) { return physics.name == name; });
}

} // namespace cupel
