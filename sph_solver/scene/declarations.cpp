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

Table resolution_declaration()
{
    Table table{"resolution", "particle spacing and cell size of each level", Table::Occurrence::once, true};
    for (const std::string& level : level_names())
        table.parameters.push_back(quantity(level, "m", "spacing at level " + level).above(0));
    return table;
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

Table root_declaration()
{
    return {"",
            "a case",
            Table::Occurrence::once,
            true,
            false,
            {plain("title", Type::text, "one line that says what the case is").must(),
             choice("tier", tier_names(), "what the case is for: ./cupel run --tier TIER runs all of one")
                 .derived("in no tier"),
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
    static const std::vector<std::string> names{"rough", "coarse", "intermediate", "medium", "fine", "paper"};
    return names;
}

const std::vector<std::string>& tier_names()
{
    static const std::vector<std::string> names{"canonical", "v0", "v1", "v2", "long"};
    return names;
}

} // namespace cupel
