#include "scene/rules.hpp"

#include "scene/nearest.hpp"
#include "scene/physics.hpp"
#include "scene/reader.hpp"

#include <algorithm>
#include <cmath>

namespace cupel
{

namespace
{

using nlohmann::json;

/// Refuses at the place of a key (or of the nearest table above it that exists).
[[noreturn]] void refuse_at(const Node& document, const std::string& path, const std::string& what,
                            const std::string& remedy)
{
    refuse(node_at(document, path).position, path, what, remedy);
}

std::string in_metres(double value)
{
    return json(value).dump() + " m";
}

void check_physics(const json& values, const Node& document)
{
    if (values.at("physics").empty())
        refuse_at(document, "physics", "names no physics", "name at least `flow` or `heat`");
    for (const PhysicsDeclaration& physics : physics_declarations()) {
        if (!names_physics(values, physics.name)) continue;
        for (const std::string& needed : physics.needs)
            if (!names_physics(values, needed))
                refuse_at(document, "physics", "'" + physics.name + "' needs '" + needed + "', which is not there",
                          "add '" + needed + "' or take '" + physics.name + "' out");
    }
    if (names_physics(values, "gravity") && !values.contains("gravity"))
        refuse_at(document, "gravity", "is missing, the physics name gravity",
                  "add for example gravity = [\"0 m/s^2\", \"0 m/s^2\", \"-9.81 m/s^2\"]");
    if (names_physics(values, "laser") && !values.contains("laser"))
        refuse_at(document, "laser", "is missing, the physics name a laser",
                  "add [laser] or take 'laser' out of physics");
    for (const char* physics : {"recoil", "evaporation", "radiation"})
        if (names_physics(values, physics) && !values.contains("surrounding"))
            refuse_at(document, "surrounding",
                      std::string("is missing, physics '") + physics + "' needs its pressure or temperature",
                      "add [surrounding]");
    const json& gradient = values.at("initial").at("temperature_gradient");
    const bool uniform = std::all_of(gradient.begin(), gradient.end(), [](const json& part) { return part == 0.0; });
    if (names_physics(values, "marangoni") && !names_physics(values, "heat") && uniform &&
        !values.at("initial").contains("hot_spot"))
        refuse_at(document, "initial.temperature_gradient", "is zero, so that 'marangoni' without 'heat' does nothing",
                  "give a gradient or a hot spot, or add 'heat' to the physics");
    if (values.at("initial").contains("velocity") && !names_physics(values, "flow"))
        refuse_at(document, "initial.velocity", "is there, but 'flow' is not among the physics",
                  "add 'flow' or take it out");
}

void check_material_names(const json& values, const Node& document)
{
    std::vector<std::string> known;
    for (const auto& [name, material] : values.at("material").items())
        known.push_back(name);
    const auto check = [&](const std::string& name, const std::string& path) {
        if (!values.at("material").contains(name))
            refuse_at(document, path, "there is no [material." + name + "]",
                      "name one of: " + joined(known) + suggestion(name, known));
    };
    for (std::size_t index = 0; index < values.at("body").size(); ++index)
        check(values.at("body")[index].at("material"), "body." + std::to_string(index) + ".material");
    if (values.contains("surrounding")) {
        const std::string name = values.at("surrounding").at("material");
        check(name, "surrounding.material");
        for (const std::string& body_material : body_materials(values))
            if (body_material == name)
                refuse_at(document, "surrounding.material", "'" + name + "' is the material of a body as well",
                          "give the surrounding a material of its own");
    }
}

struct Need
{
    const char* physics;
    std::vector<const char*> keys;
    bool of_surrounding_too;
};

const std::vector<Need>& needs()
{
    static const std::vector<Need> list{
        {"flow", {"viscosity"}, true},
        {"heat", {"specific_heat", "conductivity"}, true},
        {"melting", {"solidus", "liquidus", "latent_heat"}, false},
        {"surface_tension", {"surface_tension"}, false},
        {"wetting", {"contact_angle"}, false},
        {"marangoni", {"surface_tension_slope"}, false},
        {"radiation", {"emissivity"}, false},
        {"evaporation", {"boiling_temperature", "vaporization_heat", "molar_mass"}, false},
        {"recoil", {"boiling_temperature", "vaporization_heat", "molar_mass"}, false}};
    return list;
}

void require_datum(const json& values, const Node& document, const std::string& material, const std::string& key,
                   const std::string& reason)
{
    const std::string path = "material." + material + "." + key;
    if (!values.at("material").at(material).contains(key))
        refuse_at(document, path, "is missing, " + reason + " needs it", "add it to [material." + material + "]");
}

void check_material_data(const json& values, const Node& document)
{
    const std::vector<std::string> bodies = body_materials(values);
    std::vector<std::string> all = bodies;
    if (values.contains("surrounding")) all.push_back(values.at("surrounding").at("material"));
    for (const Need& need : needs()) {
        if (!names_physics(values, need.physics)) continue;
        for (const std::string& material : need.of_surrounding_too ? all : bodies)
            for (const char* key : need.keys)
                require_datum(values, document, material, key, std::string("physics '") + need.physics + "'");
    }
    for (const std::string& material : bodies) {
        const json& data = values.at("material").at(material);
        const bool varies = names_physics(values, "surface_tension") && data.contains("surface_tension_slope") &&
                            (names_physics(values, "heat") || names_physics(values, "marangoni"));
        if (varies)
            require_datum(values, document, material, "surface_tension_reference_temperature", "surface_tension_slope");
        if (names_physics(values, "melting") && names_physics(values, "flow"))
            require_datum(values, document, material, "mushy_drag", "physics 'melting' with 'flow'");
        if (names_physics(values, "laser") && !values.at("laser").contains("absorptivity"))
            require_datum(values, document, material, "absorptivity", "physics 'laser'");
        if (data.contains("solidus") && data.contains("liquidus") && data.at("solidus") > data.at("liquidus"))
            refuse_at(document, "material." + material + ".solidus", "is above the liquidus",
                      "give a solidus at or below the liquidus");
    }
}

void check_box(const json& lower, const json& upper, int dimensions, const Node& document, const std::string& path)
{
    static constexpr const char* axes[] = {"x", "y", "z"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (dimensions == 2 && axis == 1) {
            if (lower[1] != 0.0 || upper[1] != 0.0)
                refuse_at(document, path, "has an extent in y, but the case has 2 dimensions",
                          "write \"0 m\" for y or set dimensions = 3");
        }
        else if (!(lower[axis].get<double>() < upper[axis].get<double>()))
            refuse_at(document, path, std::string("has no extent in ") + axes[axis],
                      "upper must be greater than lower, but they are " + in_metres(upper[axis]) + " and " +
                          in_metres(lower[axis]));
    }
}

/// A wall moves along itself only, and takes the liquid with it only where that does not slip.
void check_wall_velocity(const json& values, const Node& document, const std::string& side, std::size_t axis)
{
    const json& boundary = values.at("domain").at("boundaries").at(side);
    if (!boundary.contains("velocity")) return;
    const json& velocity = boundary.at("velocity");
    if (std::all_of(velocity.begin(), velocity.end(), [](const json& part) { return part == 0.0; })) return;
    const std::string path = "domain.boundaries." + side + ".velocity";
    if (!names_physics(values, "flow"))
        refuse_at(document, path, "is not zero, but 'flow' is not among the physics", "add 'flow' or take it out");
    if (velocity[axis] != 0.0)
        refuse_at(document, path, "moves the wall out of its plane", std::string("write \"0 m/s\" for ") + "xyz"[axis]);
    if (values.at("dimensions") == 2 && velocity[1] != 0.0)
        refuse_at(document, path, "leads out of the plane y = 0", "write \"0 m/s\" for y");
    if (boundary.at("slip") == "free_slip")
        refuse_at(document, path, "has no meaning with slip = \"free_slip\"", "take it out or the slip");
}

/// Refuses a wave that does not fit into a periodic domain a whole number of times.
void check_periods(const json& values, const Node& document, double wavelength, std::vector<std::size_t> axes,
                   const std::string& path)
{
    for (const std::size_t axis : axes) {
        const std::string side = std::string(1, "xyz"[axis]) + "_min";
        const json& domain = values.at("domain");
        if (domain.at("boundaries").at(side).at("kind") != "periodic") continue;
        const double count =
            (domain.at("upper")[axis].get<double>() - domain.at("lower")[axis].get<double>()) / wavelength;
        if (std::abs(count - std::round(count)) > 1e-6 || count < 0.5)
            refuse_at(document, path,
                      "does not fit a whole number of times into the domain, which is periodic in " +
                          std::string(1, "xyz"[axis]),
                      "make the domain as long as one or more waves");
    }
}

void check_domain(const json& values, const Node& document)
{
    const json& domain = values.at("domain");
    const int dimensions = values.at("dimensions");
    check_box(domain.at("lower"), domain.at("upper"), dimensions, document, "domain.upper");
    const json& boundaries = domain.at("boundaries");
    for (std::size_t number = 0; number < 3; ++number) {
        const std::string axis(1, "xyz"[number]);
        const std::string sides[] = {axis + "_min", axis + "_max"};
        const bool wanted = dimensions == 3 || axis != "y";
        int periodic = 0;
        for (const std::string& side : sides) {
            const std::string path = "domain.boundaries." + side;
            if (boundaries.contains(side) != wanted)
                refuse_at(document, path, wanted ? "is missing" : "has no meaning in 2 dimensions",
                          wanted ? "add for example " + side + " = { kind = \"wall\" }" : "take it out");
            if (wanted) check_wall_velocity(values, document, side, number);
            periodic += wanted && boundaries.at(side).at("kind") == "periodic" ? 1 : 0;
        }
        if (periodic == 1)
            refuse_at(document, "domain.boundaries." + sides[boundaries.at(sides[0]).at("kind") == "periodic" ? 1 : 0],
                      "is not periodic, but the opposite side is", "make both sides periodic or neither");
    }
    if (values.at("initial").contains("velocity"))
        check_periods(values, document, values.at("initial").at("velocity").at("wavelength"), {0, 2},
                      "initial.velocity.wavelength");
}

/// Round walls are for a drop of liquid in two dimensions, without heat, whose walls are the sides of the box.
void check_round_walls(const json& values, const Node& document)
{
    if (!values.at("domain").contains("round_walls")) return;
    const std::string path = "domain.round_walls";
    const json& domain = values.at("domain");
    const json& walls = domain.at("round_walls");
    const bool inner = walls.contains("inner_radius"), outer = walls.contains("outer_radius");
    if (values.at("dimensions") != 2)
        refuse_at(document, path, "has a meaning in 2 dimensions only", "set dimensions = 2 or take it out");
    if (walls.at("center")[1] != 0.0)
        refuse_at(document, path + ".center", "lies outside the plane y = 0", "write \"0 m\" for y");
    if (!inner && !outer) refuse_at(document, path, "names no wall", "give an inner_radius, an outer_radius or both");
    if (inner && outer && walls.at("inner_radius") >= walls.at("outer_radius"))
        refuse_at(document, path + ".outer_radius", "leaves nothing between the walls", "make it the greater one");
    if (!outer && values.contains("surrounding") && values.at("surrounding").at("resolved") == true)
        refuse_at(document, path, "has no vessel for the resolved surrounding", "add an outer_radius");
    if (names_physics(values, "heat"))
        refuse_at(document, path, "is there, but heat knows the sides of the box only", "take 'heat' out of physics");
    for (const auto& [side, boundary] : domain.at("boundaries").items())
        if (boundary.at("kind") != "open")
            refuse_at(document, "domain.boundaries." + side + ".kind", "is a side of its own beside round walls",
                      "make it \"open\"");
    const json& body = values.at("body").at(0);
    if (values.at("body").size() != 1 || body.at("shape") != "sphere" || body.at("state") != "liquid")
        refuse_at(document, "body", "is not one sphere of liquid, as round walls need it",
                  "take one or no round walls");
}

/// What is special about the start of a body.
void check_start_of_body(const json& values, const Node& document, const json& body, const std::string& path)
{
    if (body.contains("temperature") && !names_physics(values, "heat"))
        refuse_at(document, path + ".temperature", "has no meaning without 'heat' in the physics",
                  "add 'heat' or take it out");
    if (!body.contains("surface_wave")) return;
    const json& wave = body.at("surface_wave");
    const double amplitude = std::abs(wave.at("amplitude").get<double>());
    if (amplitude >= body.at("upper")[2].get<double>() - body.at("lower")[2].get<double>())
        refuse_at(document, path + ".surface_wave.amplitude", "reaches below the box", "make it smaller");
    check_periods(values, document, wave.at("wavelength"), {0}, path + ".surface_wave.wavelength");
}

void check_bodies(const json& values, const Node& document)
{
    const int dimensions = values.at("dimensions");
    const json& domain = values.at("domain");
    if (values.at("body").empty())
        refuse_at(document, "body", "there is none", "add [[body]] with a shape and a material");
    for (std::size_t index = 0; index < values.at("body").size(); ++index) {
        const json& body = values.at("body")[index];
        const std::string path = "body." + std::to_string(index);
        const std::string shape = body.at("shape");
        check_start_of_body(values, document, body, path);
        if (shape == "powder_bed" && dimensions == 2)
            refuse_at(document, path + ".shape", "a powder bed has no meaning in 2 dimensions", "set dimensions = 3");
        if (shape == "sphere" && dimensions == 2 && body.at("center")[1] != 0.0)
            refuse_at(document, path + ".center", "lies outside the plane y = 0", "write \"0 m\" for y");
        if (shape != "sphere") check_box(body.at("lower"), body.at("upper"), dimensions, document, path + ".upper");
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (dimensions == 2 && axis == 1) continue;
            const double radius = shape == "sphere" ? body.at("radius").get<double>() : 0;
            const double lower = shape == "sphere" ? body.at("center")[axis].get<double>() - radius
                                                   : body.at("lower")[axis].get<double>();
            const double upper = shape == "sphere" ? body.at("center")[axis].get<double>() + radius
                                                   : body.at("upper")[axis].get<double>();
            if (upper <= domain.at("lower")[axis].get<double>() || lower >= domain.at("upper")[axis].get<double>())
                refuse_at(document, path, "lies outside the domain", "move it or make the domain larger");
        }
    }
}

void check_temperatures(const json& values, const Node& document)
{
    const json& initial = values.at("initial");
    double coldest = initial.at("temperature");
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double extent =
            values.at("domain").at("upper")[axis].get<double>() - values.at("domain").at("lower")[axis].get<double>();
        coldest += std::min(0.0, initial.at("temperature_gradient")[axis].get<double>() * extent);
    }
    if (initial.contains("hot_spot")) {
        const double rise = initial.at("hot_spot").at("rise");
        if (coldest > 0 && coldest + rise <= 0)
            refuse_at(document, "initial.hot_spot.rise",
                      "makes its middle as cold as " + json(coldest + rise).dump() + " K", "make it greater");
    }
    if (coldest <= 0)
        refuse_at(document, "initial.temperature_gradient",
                  "makes the domain's coldest corner " + json(coldest).dump() + " K",
                  "lower the gradient or raise initial.temperature");
}

void check_powder(const json& values, const Node& document)
{
    if (!values.contains("powder")) return;
    const json& diameter = values.at("powder").at("diameter");
    if (!(diameter.at("minimum") < diameter.at("median") && diameter.at("median") < diameter.at("maximum")))
        refuse_at(document, "powder.diameter", "minimum, median and maximum do not follow each other",
                  "order them from small to great");
}

} // namespace

std::vector<std::string> body_materials(const json& values)
{
    std::vector<std::string> names;
    for (const json& body : values.at("body")) {
        const std::string name = body.at("material");
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    return names;
}

bool names_physics(const json& values, const std::string& physics)
{
    const json& named = values.at("physics");
    return std::find(named.begin(), named.end(), json(physics)) != named.end();
}

void check_rules(const json& values, const Node& document)
{
    check_physics(values, document);
    check_material_names(values, document);
    check_material_data(values, document);
    check_domain(values, document);
    check_bodies(values, document);
    check_round_walls(values, document);
    check_temperatures(values, document);
    check_powder(values, document);
}

void check_resolution(const json& values, const Node& document, const std::string& level)
{
    constexpr double fewest_spacings = 4;
    constexpr double most_elements = 2e9;
    const double spacing = values.at("resolution").at(level);
    const json& domain = values.at("domain");
    double elements = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (values.at("dimensions") == 2 && axis == 1) continue;
        const double count =
            (domain.at("upper")[axis].get<double>() - domain.at("lower")[axis].get<double>()) / spacing;
        elements *= count;
        if (count < fewest_spacings)
            refuse_at(document, "resolution." + level,
                      in_metres(spacing) + " leaves fewer than 4 spacings across the domain", "take a smaller spacing");
    }
    if (elements > most_elements)
        refuse_at(document, "resolution." + level, in_metres(spacing) + " would give more than 2e9 elements",
                  "take a greater spacing");
}

} // namespace cupel
