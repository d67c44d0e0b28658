/// What can be taken from a result, and what it is judged by.
#include "scene/declaration.hpp"

namespace cupel
{

namespace
{

std::vector<std::string> measure_names()
{
    std::vector<std::string> names;
    for (const auto& measure : measure_declarations())
        names.push_back(measure.name);
    return names;
}

} // namespace

Table measure_declaration()
{
    return {
        "measure",
        "a number to take from the result, and what it is judged by",
        Table::Occurrence::listed,
        false,
        false,
        {choice("name", measure_names(), "what is measured").must(),
         plain("between", Type::time_window, "times between which it is taken").must(),
         plain("tolerance", Type::by_level,
               "greatest error, in the measure's unit or as a share; one for all levels, or for instance "
               "{ coarse = \"1 %\", fine = \"0.5 %\" }, where a level that is not named has that of the next coarser "
               "one, and is not judged if there is none")
             .derived("not judged"),
         choice("metric", {"relative", "absolute"}, "whether the error is divided by the reference")
             .derived("absolute where the tolerance has the measure's unit or the measure is an error itself, else "
                      "relative; needed where both have no unit")},
        {{"reference",
          "what the measure is compared with; needed where there is a tolerance",
          Table::Occurrence::once,
          false,
          false,
          {choice("kind", {"exact", "tabulated", "solver", "experiment", "paper"}, "where the reference comes from")
               .derived("solver where reference.solver is given"),
           plain("value", Type::any_quantity, "the reference itself, in the measure's unit")
               .with("kind", {"exact", "tabulated", "experiment", "paper"})
               .derived("worked out of the case by the measure, exact or tabulated"),
           choice("solver", {"sph", "openfoam"}, "the solver whose result is the reference").with("kind", {"solver"}),
           plain("source", Type::text, "formula, publication or table").or_else("")}}}};
}

const std::vector<MeasureDeclaration>& measure_declarations()
{
    using enum MeasureDeclaration::OwnReference;
    static const std::vector<MeasureDeclaration> declarations{
        {"contact_angle", "rad", "angle of the sphere or circle fitted to the interface, at the wall", computed},
        {"base_radius", "m", "radius of the wetted base of a drop", computed},
        {"apex_height", "m", "height of a drop above the wall", computed},
        {"laplace_pressure", "Pa", "pressure inside a drop less that outside", computed},
        {"spurious_capillary_number", "1", "greatest speed of a drop at rest, times viscosity over surface tension",
         zero},
        {"oscillation_frequency", "rad/s", "angular frequency of a drop's oscillation", computed},
        {"oscillation_decay", "1/s", "decay rate of a drop's oscillation", computed},
        {"oscillation_period", "s", "period of a drop's oscillation; the exact one is without viscosity", computed},
        {"wave_error", "1", "root mean square of a capillary wave's amplitude less the exact one, over the first",
         zero},
        {"film_unevenness", "1", "root mean square of what a film's depth differs by from its mean, over the mean",
         zero},
        {"drop_velocity", "m/s", "velocity of a drop's centroid along the temperature gradient", computed},
        {"start_up_error", "1",
         "greatest difference of a drop's velocity to that of an unbounded start from rest, over its limit", zero},
        {"migration_error", "1", "greatest difference of a drop's velocity to the tabulated curve, over its plateau",
         zero},
        {"migration_error_sharp_interface", "1",
         "the same to the curve of a drop with a sharp interface, over its greatest value", zero},
        {"profile_error", "1", "L2 error of the velocity profile over the exact surface speed", zero},
        {"mean_profile_error", "1", "the same of the profile averaged over the snapshots", zero},
        {"surface_speed", "m/s", "speed along the liquid's surface at mid-length", computed},
        {"zero_crossing", "1", "relative height at which the velocity profile changes its sign", computed},
        {"decay_rate", "1/s", "decay rate of the kinetic energy", computed},
        {"velocity_profile_error", "1",
         "L2 error of the velocity across a channel that starts up, over the greatest speed; the worst snapshot", zero},
        {"front_position", "m", "distance of the melting front from the hot wall", computed},
        {"recoil_balance_error", "1",
         "pressure in a surface under a hot spot less recoil and capillary pressure, over the greatest recoil", zero},
        {"melt_pool_width", "m", "greatest width across the track of what is above the melting temperature", computed},
        {"melt_pool_depth", "m", "greatest depth below the plate of what is above the melting temperature", computed},
        {"melt_pool_length", "m", "greatest length along the track of what is above the melting temperature", computed},
        {"bead_height", "m", "height above the plate of what was molten"},
        {"fused_width", "m", "width of the cross-section that was ever above the melting temperature"},
        {"fused_depth", "m", "depth below the plate of that cross-section"},
        {"fused_height", "m", "height above the plate of that cross-section"},
        {"fused_area", "m^2", "area of that cross-section"},
        {"volume_change", "1", "change of the bodies' volume over their volume at the start", zero},
        {"enclosed_volume_change", "1", "change of the volume inside the interface over that at the start", zero},
        {"laser_absorbed_error", "1", "laser energy absorbed against absorptivity times what hits", zero},
        {"energy_closure", "1", "what the energy ledger misses over what went in", zero},
        {"mass_closure", "1", "what the mass ledger misses", zero},
        {"volume_closure", "1", "what the volume ledger misses", zero}};
    return declarations;
}

} // namespace cupel
