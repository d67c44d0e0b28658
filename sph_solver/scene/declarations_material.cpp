#include "scene/declaration.hpp"

#include <numbers>

namespace cupel
{

Table material_declaration()
{
    return {
        "material",
        "a material of a body or of the surrounding; `use = \"304L\"` takes materials/304L.toml, keys beside it "
        "override it",
        Table::Occurrence::named,
        true,
        false,
        {quantity("density", "kg/m^3", "density of the liquid or gas").above(0).must(),
         quantity("density_solid", "kg/m^3", "density of the solid").above(0).derived("density"),
         quantity("viscosity", "Pa s", "dynamic viscosity").at_least(0),
         quantity("specific_heat", "J/(kg K)", "specific heat of the liquid or gas").above(0),
         quantity("specific_heat_solid", "J/(kg K)", "specific heat of the solid").above(0).derived("specific_heat"),
         quantity("conductivity", "W/(m K)", "thermal conductivity of the liquid or gas").at_least(0),
         quantity("conductivity_solid", "W/(m K)", "thermal conductivity of the solid")
             .at_least(0)
             .derived("conductivity"),
         quantity("solidus", "K", "temperature at which melting begins").above(0),
         quantity("liquidus", "K", "temperature at which melting is complete").above(0),
         quantity("melting_temperature", "K", "isotherm that bounds the melt pool in the measures")
             .above(0)
             .derived("midway between solidus and liquidus"),
         quantity("latent_heat", "J/kg", "latent heat of melting").at_least(0),
         quantity("mushy_drag", "kg/(m^3 s)", "constant C of the mushy zone's drag C (1 - f)^2/f^3 on the melt")
             .above(0),
         quantity("surface_tension", "N/m", "surface tension at surface_tension_reference_temperature").at_least(0),
         quantity("surface_tension_slope", "N/(m K)", "change of surface tension with temperature"),
         quantity("surface_tension_reference_temperature", "K", "temperature at which surface_tension holds").above(0),
         quantity("surface_tension_minimum", "N/m", "floor of the surface tension at high temperature")
             .at_least(0)
             .derived("0 where surface_tension is given"),
         quantity("contact_angle", "rad", "equilibrium angle through this material, on walls and on solid")
             .above(0)
             .below(std::numbers::pi),
         quantity("boiling_temperature", "K", "boiling temperature at the surrounding's pressure").above(0),
         quantity("vaporization_heat", "J/kg", "latent heat of vaporization").above(0),
         quantity("molar_mass", "kg/mol", "molar mass of the vapour").above(0),
         quantity("emissivity", "1", "share of black-body radiation that the surface emits").at_least(0).at_most(1),
         quantity("absorptivity", "1", "share of the laser's light that the surface absorbs").at_least(0).at_most(1)}};
}

} // namespace cupel
