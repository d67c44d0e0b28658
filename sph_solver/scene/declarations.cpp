#include "scene/declaration.hpp"
#include "scene/physics.hpp"

namespace cupel
{

namespace
{

std::vector<std::string> physics_names()
{
    std::vector<std::string> names;
    for (const auto& physics : physics_declarations())
        names.push_back(physics.name);
    return names;
}

std::vector<std::string> measure_names()
{
    std::vector<std::string> names;
    for (const auto& measure : measure_declarations())
        names.push_back(measure.name);
    return names;
}

Table resolution_declaration()
{
    Table table{"resolution", "particle spacing and cell size of each level", Table::Occurrence::once, true};
    for (const std::string& level : level_names())
        table.parameters.push_back(quantity(level, "m", "spacing at level " + level).above(0));
    return table;
}

Table boundary_declaration(const std::string& side)
{
    return {
        side,
        "the side " + side + " of the domain",
        Table::Occurrence::once,
        false,
        false,
        {choice("kind", {"wall", "symmetry", "open", "periodic"}, "what the side is").must(),
         choice("slip", {"no_slip", "free_slip"}, "motion along the wall").with("kind", {"wall"}).or_else("no_slip"),
         quantity("temperature", "K", "temperature of the wall").above(0).with("kind", {"wall"}).derived("adiabatic")}};
}

Table domain_declaration()
{
    Table boundaries{"boundaries", "the sides of the domain", Table::Occurrence::once, true};
    for (const char* side : {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"})
        boundaries.tables.push_back(boundary_declaration(side));
    return {"domain",
            "the box in which everything happens; z is up, two dimensions lie in the plane y = 0",
            Table::Occurrence::once,
            true,
            false,
            {vector("lower", 3, "m", "least x, y, z").must(), vector("upper", 3, "m", "greatest x, y, z").must()},
            {boundaries}};
}

Table body_declaration()
{
    return {
        "body",
        "a part of the domain filled with a material at the start; later bodies lie over earlier ones",
        Table::Occurrence::listed,
        true,
        false,
        {choice("shape", {"box", "sphere", "powder_bed"}, "shape; a sphere is a disc in two dimensions").must(),
         plain("material", Type::text, "name of a [material.NAME]").must(),
         choice("state", {"solid", "liquid"}, "state at the start").must(),
         vector("lower", 3, "m", "least x, y, z").with("shape", {"box", "powder_bed"}).must(),
         vector("upper", 3, "m", "greatest x, y, z").with("shape", {"box", "powder_bed"}).must(),
         vector("center", 3, "m", "centre").with("shape", {"sphere"}).must(),
         quantity("radius", "m", "radius").above(0).with("shape", {"sphere"}).must(),
         plain("file", Type::file, "spheres of the bed, made by ./cupel bed").with("shape", {"powder_bed"}).must()}};
}

Table surrounding_declaration()
{
    return {
        "surrounding",
        "what is outside the bodies; left out where the bodies fill the domain",
        Table::Occurrence::once,
        false,
        false,
        {plain("material", Type::text, "name of a [material.NAME]").must(),
         plain("resolved", Type::boolean, "true: SPH gives it particles; false: it is nothing to SPH").must(),
         quantity("temperature", "K", "temperature far away").above(0).derived("initial.temperature"),
         quantity("pressure", "Pa", "pressure far away").above(0).or_else(101325.0),
         quantity("convection_coefficient", "W/(m^2 K)", "coefficient of convective loss, part of physics radiation")
             .at_least(0)
             .or_else(0.0)}};
}

Table laser_declaration()
{
    return {"laser",
            "Gaussian beam straight down, scanning a line on the plate; off once the line's end is reached",
            Table::Occurrence::once,
            false,
            false,
            {quantity("power", "W", "power of the beam").at_least(0).must(),
             quantity("speed", "m/s", "speed of scanning").at_least(0).must(),
             quantity("spot_diameter", "m", "diameter at 1/e^2 of the greatest intensity").above(0).must(),
             quantity("absorptivity", "1", "share that the surface absorbs")
                 .at_least(0)
                 .at_most(1)
                 .derived("absorptivity of the bodies' material"),
             quantity("start", "s", "time at which the beam goes on").at_least(0).or_else(0.0)},
            {{"path",
              "line on the plate",
              Table::Occurrence::once,
              true,
              false,
              {vector("from", 2, "m", "x, y at the start").must(), vector("to", 2, "m", "x, y at the end").must()}}}};
}

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
         plain("tolerance", Type::any_quantity, "greatest error, in the measure's unit or as a share")
             .derived("not judged"),
         choice("metric", {"relative", "absolute"}, "whether the error is divided by the reference")
             .derived(
                 "absolute where the tolerance has the measure's unit, else relative; needed where both have none")},
        {{"reference",
          "what the measure is compared with; needed where there is a tolerance",
          Table::Occurrence::once,
          false,
          false,
          {choice("kind", {"exact", "tabulated", "solver", "experiment", "paper"}, "where the reference comes from")
               .derived("solver where reference.solver is given"),
           plain("value", Type::any_quantity, "the reference itself, in the measure's unit")
               .with("kind", {"exact", "tabulated", "experiment", "paper"}),
           choice("solver", {"sph", "openfoam"}, "the solver whose result is the reference").with("kind", {"solver"}),
           plain("source", Type::text, "formula, publication or table").or_else("")}}}};
}

Table time_declaration()
{
    return {"time",
            "duration and output",
            Table::Occurrence::once,
            true,
            false,
            {quantity("end", "s", "time at which the run ends").above(0).must(),
             quantity("output_interval", "s", "time between snapshots of the fields").above(0).must()}};
}

Table initial_declaration()
{
    return {"initial",
            "state at the start, and for ever where `heat` is not among the physics",
            Table::Occurrence::once,
            false,
            true,
            {quantity("temperature", "K", "temperature at domain.lower").above(0).or_else(300.0),
             vector("temperature_gradient", 3, "K/m", "uniform gradient of temperature")
                 .or_else(nlohmann::json::array({0.0, 0.0, 0.0}))}};
}

Table root_declaration()
{
    return {"",
            "a case",
            Table::Occurrence::once,
            true,
            false,
            {plain("title", Type::text, "one line that says what the case is").must(),
             plain("paper", Type::text_list, "figures and tables of the paper that the case belongs to")
                 .or_else(nlohmann::json::array()),
             plain("dimensions", Type::integer, "3, or 2 for the x-z plane").at_least(2).at_most(3).or_else(3),
             choice_list("physics", physics_names(), "the models that the scene requires, and nothing else").must(),
             vector("gravity", 3, "m/s^2", "acceleration of gravity, used where `gravity` is among the physics")},
            {resolution_declaration(), material_declaration(), surrounding_declaration(), domain_declaration(),
             initial_declaration(), body_declaration(), laser_declaration(), time_declaration(), measure_declaration(),
             powder_declaration(), numerics_declaration()}};
}

} // namespace

Parameter quantity(std::string key, std::string unit, std::string help)
{
    Parameter parameter;
    parameter.key = std::move(key);
    parameter.unit = std::move(unit);
    parameter.help = std::move(help);
    return parameter;
}

Parameter vector(std::string key, std::size_t components, std::string unit, std::string help)
{
    Parameter parameter = quantity(std::move(key), std::move(unit), std::move(help));
    parameter.type = Type::vector;
    parameter.components = components;
    return parameter;
}

Parameter choice(std::string key, std::vector<std::string> choices, std::string help)
{
    Parameter parameter = quantity(std::move(key), "1", std::move(help));
    parameter.type = Type::choice;
    parameter.choices = std::move(choices);
    return parameter;
}

Parameter choice_list(std::string key, std::vector<std::string> choices, std::string help)
{
    Parameter parameter = choice(std::move(key), std::move(choices), std::move(help));
    parameter.type = Type::choice_list;
    return parameter;
}

Parameter plain(std::string key, Type type, std::string help)
{
    Parameter parameter = quantity(std::move(key), "1", std::move(help));
    parameter.type = type;
    return parameter;
}

const Table& case_declaration()
{
    static const Table declaration = root_declaration();
    return declaration;
}

const std::vector<std::string>& level_names()
{
    static const std::vector<std::string> names{"coarse", "medium", "fine", "paper"};
    return names;
}

const std::vector<MeasureDeclaration>& measure_declarations()
{
    static const std::vector<MeasureDeclaration> declarations{
        {"contact_angle", "rad", "angle of the sphere or circle fitted to the interface, at the wall"},
        {"base_radius", "m", "radius of the wetted base of a drop"},
        {"apex_height", "m", "height of a drop above the wall"},
        {"profile_error", "1", "L2 error of the velocity profile over the exact surface speed"},
        {"mean_profile_error", "1", "the same of the profile averaged over the snapshots"},
        {"surface_speed", "m/s", "speed along the liquid's surface at mid-length"},
        {"zero_crossing", "1", "relative height at which the velocity profile changes its sign"},
        {"melt_pool_width", "m", "greatest width across the track of what is above the melting temperature"},
        {"melt_pool_depth", "m", "greatest depth below the plate of what is above the melting temperature"},
        {"melt_pool_length", "m", "greatest length along the track of what is above the melting temperature"},
        {"bead_height", "m", "height above the plate of what was molten"},
        {"fused_width", "m", "width of the cross-section that was ever above the melting temperature"},
        {"fused_depth", "m", "depth below the plate of that cross-section"},
        {"fused_height", "m", "height above the plate of that cross-section"},
        {"fused_area", "m^2", "area of that cross-section"},
        {"volume_change", "1", "change of the bodies' volume over their volume at the start"},
        {"enclosed_volume_change", "1", "change of the volume inside the interface over that at the start"},
        {"laser_absorbed_error", "1", "laser energy absorbed against absorptivity times what hits"},
        {"energy_closure", "1", "what the energy ledger misses over what went in"},
        {"mass_closure", "1", "what the mass ledger misses"},
        {"volume_closure", "1", "what the volume ledger misses"}};
    return declarations;
}

} // namespace cupel
