#include "scene/case.hpp"

#include "scene/physics.hpp"
#include "scene/shape.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>

namespace cupel
{

namespace
{

using nlohmann::json;

bool present(const json& table, const char* key)
{
    const auto found = table.find(key);
    return found != table.end() && !found->is_null();
}

std::optional<double> optional_number(const json& table, const char* key)
{
    const auto found = table.find(key);
    return found == table.end() || found->is_null() ? std::nullopt : std::optional<double>(found->get<double>());
}

Material material_from(const std::string& name, const json& table)
{
    Material material;
    material.name = name;
    material.density = table.at("density");
    material.density_solid = optional_number(table, "density_solid");
    material.viscosity = optional_number(table, "viscosity");
    material.specific_heat = optional_number(table, "specific_heat");
    material.specific_heat_solid = optional_number(table, "specific_heat_solid");
    material.conductivity = optional_number(table, "conductivity");
    material.conductivity_solid = optional_number(table, "conductivity_solid");
    material.solidus = optional_number(table, "solidus");
    material.liquidus = optional_number(table, "liquidus");
    material.melting_temperature = optional_number(table, "melting_temperature");
    material.latent_heat = optional_number(table, "latent_heat");
    material.mushy_drag = optional_number(table, "mushy_drag");
    material.surface_tension = optional_number(table, "surface_tension");
    material.surface_tension_slope = optional_number(table, "surface_tension_slope");
    material.surface_tension_reference_temperature = optional_number(table, "surface_tension_reference_temperature");
    material.surface_tension_minimum = optional_number(table, "surface_tension_minimum");
    material.contact_angle = optional_number(table, "contact_angle");
    material.boiling_temperature = optional_number(table, "boiling_temperature");
    material.vaporization_heat = optional_number(table, "vaporization_heat");
    material.molar_mass = optional_number(table, "molar_mass");
    material.emissivity = optional_number(table, "emissivity");
    material.absorptivity = optional_number(table, "absorptivity");
    return material;
}

BoundaryKind boundary_kind(const std::string& text)
{
    if (text == "wall") return BoundaryKind::wall;
    if (text == "symmetry") return BoundaryKind::symmetry;
    if (text == "open") return BoundaryKind::open;
    if (text == "periodic") return BoundaryKind::periodic;
    throw CaseError("resolved case: domain.boundaries: unknown kind '" + text + "'; resolve the case again");
}

Domain domain_from(const json& table)
{
    Domain domain;
    domain.lower = table.at("lower").get<Vector3>();
    domain.upper = table.at("upper").get<Vector3>();
    for (std::size_t side = 0; side < side_names.size(); ++side) {
        const auto found = table.at("boundaries").find(side_names[side]);
        if (found == table.at("boundaries").end()) continue;
        Boundary boundary;
        boundary.kind = boundary_kind(found->at("kind"));
        boundary.no_slip = found->value("slip", "no_slip") == "no_slip";
        if (present(*found, "velocity")) boundary.velocity = found->at("velocity").get<Vector3>();
        boundary.temperature = optional_number(*found, "temperature");
        domain.boundaries[side] = boundary;
    }
    if (present(table, "round_walls")) {
        const json& walls = table.at("round_walls");
        domain.round_walls = {walls.at("center").get<Vector3>(), optional_number(walls, "inner_radius"),
                              optional_number(walls, "outer_radius")};
    }
    return domain;
}

Body body_from(const json& table)
{
    Body body;
    const std::string shape = table.at("shape");
    body.material = table.at("material");
    body.solid = table.at("state") == "solid";
    body.temperature = optional_number(table, "temperature");
    if (shape == "sphere") {
        body.shape = BodyShape::sphere;
        body.center = table.at("center").get<Vector3>();
        body.radius = table.at("radius");
        if (present(table, "perturbation"))
            body.perturbation = {table.at("perturbation").at("mode"), table.at("perturbation").at("amplitude")};
        return body;
    }
    if (shape != "box" && shape != "powder_bed")
        throw CaseError("resolved case: bodies: unknown shape '" + shape + "'; resolve the case again");
    body.lower = table.at("lower").get<Vector3>();
    body.upper = table.at("upper").get<Vector3>();
    if (present(table, "surface_wave"))
        body.surface_wave = {table.at("surface_wave").at("amplitude"), table.at("surface_wave").at("wavelength")};
    if (shape == "powder_bed") {
        body.shape = BodyShape::powder_bed;
        body.file = table.at("file");
    }
    return body;
}

Initial initial_from(const json& table)
{
    Initial initial;
    initial.temperature = table.at("temperature");
    initial.temperature_gradient = table.at("temperature_gradient").get<Vector3>();
    if (present(table, "velocity")) {
        const json& velocity = table.at("velocity");
        if (velocity.at("field") != "taylor_green")
            throw CaseError("resolved case: initial.velocity: unknown field; resolve the case again");
        initial.velocity = {velocity.at("speed"), velocity.at("wavelength")};
    }
    if (present(table, "hot_spot")) {
        const json& spot = table.at("hot_spot");
        initial.hot_spot = {spot.at("center").get<Vector3>(), spot.at("radius"), spot.at("rise")};
    }
    return initial;
}

Laser laser_from(const json& table)
{
    Laser laser;
    laser.power = table.at("power");
    laser.speed = table.at("speed");
    laser.spot_radius = table.at("spot_radius");
    laser.absorptivity = table.at("absorptivity");
    laser.from = table.at("path").at("from").get<std::array<double, 2>>();
    laser.to = table.at("path").at("to").get<std::array<double, 2>>();
    laser.start = table.at("start");
    return laser;
}

Numerics numerics_from(const json& table)
{
    Numerics numerics;
    numerics.formulation = table.at("formulation");
    numerics.precision = table.at("precision");
    numerics.kernel = table.at("kernel");
    numerics.smoothing_ratio = table.at("smoothing_ratio");
    numerics.artificial_viscosity = table.at("artificial_viscosity");
    numerics.artificial_viscosity_beta = table.at("artificial_viscosity_beta");
    numerics.artificial_stress = table.at("artificial_stress");
    numerics.artificial_heat = table.at("artificial_heat");
    numerics.density_diffusion = table.at("density_diffusion");
    numerics.shifting = table.at("shifting");
    numerics.surface_load = table.at("surface_load");
    numerics.contact_line_force = table.at("contact_line_force");
    numerics.sound_speed = optional_number(table, "sound_speed");
    numerics.sound_speed_factor = table.at("sound_speed_factor");
    numerics.reference_speed = optional_number(table, "reference_speed");
    numerics.time_step_factor = table.at("time_step_factor");
    numerics.acoustic_substeps = table.at("acoustic_substeps");
    numerics.thermal_time_step_factor = table.at("thermal_time_step_factor");
    numerics.skin = table.at("skin");
    numerics.position_jitter = table.value("position_jitter", 0.0);
    numerics.without_saving = table.at("without_saving");
    return numerics;
}

Surrounding surrounding_from(const json& table)
{
    return {table.at("material"), table.at("resolved"), table.at("temperature"), table.at("pressure"),
            table.at("convection_coefficient")};
}

} // namespace

double Laser::off_time() const
{
    const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
    return length > 0 && speed > 0 ? start + length / speed : std::numeric_limits<double>::infinity();
}

std::array<double, 2> Laser::position(double time) const
{
    const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
    if (length == 0 || speed == 0) return from;
    const double share = std::clamp((time - start) * speed / length, 0.0, 1.0);
    return {from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])};
}

bool Case::requires_physics(std::string_view physics_name) const
{
    if (!is_physics(physics_name))
        throw CaseError("physics: there is none of the name '" + std::string(physics_name) + "'");
    return std::find(physics.begin(), physics.end(), physics_name) != physics.end();
}

const Material& Case::material(const std::string& material_name) const
{
    const auto found = materials.find(material_name);
    if (found == materials.end()) throw CaseError("material: the case has none of the name '" + material_name + "'");
    return found->second;
}

double Case::initial_temperature(const Vector3& position) const
{
    for (auto body = bodies.rbegin(); body != bodies.rend(); ++body)
        if (contains(*body, position, dimensions)) {
            if (body->temperature) return *body->temperature;
            break;
        }
    double temperature = initial.temperature;
    for (std::size_t axis = 0; axis < 3; ++axis)
        temperature += initial.temperature_gradient[axis] * (position[axis] - domain.lower[axis]);
    if (initial.hot_spot) {
        const HotSpot& spot = *initial.hot_spot;
        const double distance = std::hypot(position[0] - spot.center[0], position[1] - spot.center[1]) / spot.radius;
        temperature += spot.rise * std::exp(-2.0 * distance * distance);
    }
    return temperature;
}

Vector3 TaylorGreen::velocity(const Vector3& position) const
{
    const double k = 2.0 * std::numbers::pi / wavelength;
    return {speed * std::sin(k * position[0]) * std::cos(k * position[2]), 0.0,
            -speed * std::cos(k * position[0]) * std::sin(k * position[2])};
}

Case case_from_resolved(const json& resolved)
{
    try {
        if (const int schema = resolved.at("schema"); schema != resolved_schema_version)
            throw CaseError("resolved case: schema " + std::to_string(schema) + " is not the " +
                            std::to_string(resolved_schema_version) + " of this program; resolve the case again");
        Case result;
        result.resolved = resolved;
        result.name = resolved.at("name");
        if (present(resolved, "variation")) result.variation = resolved.at("variation");
        if (present(resolved, "tier")) result.tier = resolved.at("tier");
        result.title = resolved.at("title");
        result.hash = resolved.at("hash");
        result.level = resolved.at("level");
        result.spacing = resolved.at("spacing");
        result.dimensions = resolved.at("dimensions");
        result.physics = resolved.at("physics").get<std::vector<std::string>>();
        for (const auto& [name, table] : resolved.at("materials").items())
            result.materials.emplace(name, material_from(name, table));
        if (present(resolved, "surrounding")) result.surrounding = surrounding_from(resolved.at("surrounding"));
        result.domain = domain_from(resolved.at("domain"));
        if (present(resolved, "gravity")) result.gravity = resolved.at("gravity").get<Vector3>();
        if (present(resolved, "initial")) result.initial = initial_from(resolved.at("initial"));
        for (const json& body : resolved.at("bodies"))
            result.bodies.push_back(body_from(body));
        if (present(resolved, "laser")) result.laser = laser_from(resolved.at("laser"));
        result.time = {resolved.at("time").at("end"), resolved.at("time").at("output_interval")};
        result.numerics = numerics_from(resolved.at("numerics"));
        return result;
    }
    catch (const json::exception& error) {
        throw CaseError(std::string("resolved case: ") + error.what() +
                        "; make it again with cupel_case resolve CASE.toml");
    }
}

Case read_resolved_case(const std::string& path)
{
    std::ifstream stream(path);
    if (!stream) throw CaseError(path + ": cannot be opened; make it with cupel_case resolve CASE.toml > " + path);
    json resolved;
    try {
        resolved = json::parse(stream);
    }
    catch (const json::exception& error) {
        throw CaseError(path + ": is not JSON (" + error.what() + "); make it again with cupel_case resolve");
    }
    return case_from_resolved(resolved);
}

} // namespace cupel
