#include "scene/resolve.hpp"

#include "scene/convert.hpp"
#include "scene/declaration.hpp"
#include "scene/digest.hpp"
#include "scene/nearest.hpp"
#include "scene/physics.hpp"
#include "scene/powder_bed.hpp"
#include "scene/reader.hpp"
#include "scene/rules.hpp"

#include <algorithm>
#include <filesystem>

namespace cupel
{

namespace
{

using nlohmann::json;
namespace fs = std::filesystem;

std::string case_name(const std::string& path)
{
    const fs::path file = fs::absolute(path).lexically_normal();
    return file.filename() == "case.toml" ? file.parent_path().filename().string() : file.stem().string();
}

std::string member_name(const std::string& path, const std::string& variation)
{
    return variation.empty() ? case_name(path) : case_name(path) + "_" + variation;
}

/// The declared order, so that the order in which a file names them does not matter.
json ordered_physics(const json& values)
{
    json ordered = json::array();
    for (const PhysicsDeclaration& physics : physics_declarations())
        if (names_physics(values, physics.name)) ordered.push_back(physics.name);
    return ordered;
}

json member_or_null(const json& table, const char* key)
{
    const auto found = table.find(key);
    return found == table.end() ? json(nullptr) : *found;
}

void check_level(const std::string& path, const json& values, const Node& document, const std::string& level)
{
    const std::vector<std::string>& known = level_names();
    if (std::find(known.begin(), known.end(), level) == known.end())
        throw CaseError(path + ":1:1: --level: there is no level '" + level + "'; take one of: " + joined(known) +
                        suggestion(level, known));
    std::vector<std::string> present;
    for (const std::string& name : known)
        if (values.at("resolution").contains(name)) present.push_back(name);
    if (!values.at("resolution").contains(level))
        refuse(node_at(document, "resolution").position, "resolution", "the case has no level '" + level + "'",
               present.empty() ? "add " + level + " = \"...\"" : "take one of: " + joined(present));
}

json resolved_materials(const json& values)
{
    json materials = values.at("material");
    for (auto& [name, material] : materials.items()) {
        const auto copy_default = [&material = material](const char* key, const char* source) {
            if (!material.contains(key) && material.contains(source)) material[key] = material[source];
        };
        if (material.contains("solidus")) {
            copy_default("density_solid", "density");
            copy_default("specific_heat_solid", "specific_heat");
            copy_default("conductivity_solid", "conductivity");
        }
        if (material.contains("solidus") && material.contains("liquidus") && !material.contains("melting_temperature"))
            material["melting_temperature"] =
                0.5 * (material["solidus"].get<double>() + material["liquidus"].get<double>());
        if (material.contains("surface_tension") && !material.contains("surface_tension_minimum"))
            material["surface_tension_minimum"] = 0.0;
    }
    return materials;
}

json resolved_surrounding(const json& values)
{
    if (!values.contains("surrounding")) return nullptr;
    json surrounding = values.at("surrounding");
    if (!surrounding.contains("temperature")) surrounding["temperature"] = values.at("initial").at("temperature");
    return surrounding;
}

json resolved_domain(const json& values)
{
    json domain = values.at("domain");
    for (auto& [side, boundary] : domain.at("boundaries").items()) {
        boundary["temperature"] = member_or_null(boundary, "temperature");
        if (!boundary.contains("velocity")) boundary["velocity"] = json::array({0.0, 0.0, 0.0});
    }
    return domain;
}

json resolved_initial(const json& values)
{
    json initial = values.at("initial");
    for (const char* key : {"velocity", "hot_spot"})
        initial[key] = member_or_null(initial, key);
    return initial;
}

json resolved_bodies(const json& values, const Node& document, bool require_files, const std::string& case_path)
{
    json bodies = values.at("body");
    for (std::size_t index = 0; index < bodies.size(); ++index) {
        json& body = bodies[index];
        for (const char* key : {"temperature", "perturbation", "surface_wave"})
            body[key] = member_or_null(body, key);
        if (!body.contains("file")) continue;
        const std::string file = body.at("file");
        const bool there = fs::is_regular_file(file);
        if (!there && require_files) {
            const std::string key = "body." + std::to_string(index) + ".file";
            refuse(node_at(document, key).position, key, "there is no bed " + file,
                   "make it with: ./cupel bed " + case_name(case_path));
        }
        body["file_hash"] = nullptr;
        if (there) {
            if (require_files)
                static_cast<void>(read_powder_bed(file)); // refuses a broken file now rather than in the solver
            body["file_hash"] = sha256_of_file(file);
        }
    }
    return bodies;
}

json resolved_laser(const json& values)
{
    if (!names_physics(values, "laser")) return nullptr;
    json laser = values.at("laser");
    laser["spot_radius"] = 0.5 * laser.at("spot_diameter").get<double>();
    laser.erase("spot_diameter");
    if (!laser.contains("absorptivity"))
        laser["absorptivity"] = values.at("material").at(body_materials(values).front()).at("absorptivity");
    return laser;
}

const MeasureDeclaration& measure_of(const std::string& name)
{
    const auto& all = measure_declarations();
    return *std::find_if(all.begin(), all.end(), [&](const auto& measure) { return measure.name == name; });
}

/// Windows are cut at the end of the run, so that a run shortened by an override measures its last moment.
json resolved_window(const json& between, double end, const Node& document, const std::string& key)
{
    const double start = between[0] == "end" ? end : between[0].get<double>();
    const double stop = between[1] == "end" ? std::max(start, end) : between[1].get<double>();
    if (stop < start)
        refuse(node_at(document, key).position, key, "ends before it begins", "write the earlier time first");
    return {std::min(start, end), std::min(stop, end)};
}

json resolved_reference(const json& measure, const MeasureDeclaration& declared, const Node& document,
                        const std::string& key)
{
    if (!measure.contains("reference")) return nullptr;
    json reference = measure.at("reference");
    const Node& place = node_at(document, key);
    if (!reference.contains("kind")) {
        if (!reference.contains("solver"))
            refuse(place.position, key + ".kind", "is missing",
                   "say whether it is exact, tabulated, experiment or paper");
        reference["kind"] = "solver";
    }
    const std::string kind = reference.at("kind");
    const bool own =
        (kind == "exact" || kind == "tabulated") && declared.own_reference != MeasureDeclaration::OwnReference::none;
    const bool has_solver = reference.contains("solver"), has_value = reference.contains("value");
    if (has_solver != (kind == "solver") || has_solver + has_value > 1)
        refuse(place.position, key, "a reference is either a value with its kind or a solver",
               "write { kind = \"exact\", value = ..., source = ... } or { solver = \"openfoam\" }");
    if (!has_solver && !has_value && !own)
        refuse(place.position, key + ".value", "is missing, '" + declared.name + "' cannot work one out of the case",
               "give the value in " + declared.unit);
    reference["solver"] = member_or_null(reference, "solver");
    reference["value"] = has_value ? json(value_in_unit(reference.at("value"), declared.unit,
                                                        node_at(document, key + ".value"), key + ".value"))
                                   : json(nullptr);
    return reference;
}

/// Metric and tolerance of a measure at a level; those of the other levels are checked as well.
void resolve_tolerance(json& resolved, const json& tolerances, const MeasureDeclaration& declared,
                       const std::string& level, const Node& document, const std::string& key)
{
    const std::string tolerance_key = key + ".tolerance";
    const json& reference = resolved.at("reference");
    if (reference.is_null())
        refuse(node_at(document, tolerance_key).position, tolerance_key, "there is no reference to judge by",
               "add a reference or take it out");
    const bool of_zero =
        reference.at("value") == 0.0 ||
        (reference.at("value").is_null() && declared.own_reference == MeasureDeclaration::OwnReference::zero);
    bool reached = false;
    for (const std::string& each : level_names()) {
        if (tolerances.contains(each)) {
            const Node& place = node_at(document, tolerance_key + "." + each);
            const json& tolerance = tolerances.at(each);
            const bool plain = tolerance.at("dimension") == json(std::array<int, 6>{});
            if (resolved.at("metric").is_null()) {
                const bool own_zero = of_zero && reference.at("value").is_null();
                if (plain && declared.unit == "1" && !own_zero)
                    refuse(place.position, key + ".metric", "is missing, and the tolerance does not tell it",
                           "add metric = \"absolute\" or \"relative\"");
                resolved["metric"] = plain && !own_zero ? "relative" : "absolute";
            }
            const std::string unit = resolved.at("metric") == "relative" ? "1" : declared.unit;
            const double value = value_in_unit(tolerance, unit, place, tolerance_key);
            if (!(value > 0))
                refuse(place.position, tolerance_key, "is not above zero", "give the greatest error that passes");
            if (resolved.at("metric") == "relative" && of_zero)
                refuse(place.position, tolerance_key, "a share of a reference that is zero says nothing",
                       "add metric = \"absolute\"");
            if (!reached) resolved["tolerance"] = value;
        }
        reached = reached || each == level;
    }
}

json resolved_measure(const json& measure, const std::string& level, double end, const Node& document,
                      const std::string& key)
{
    const MeasureDeclaration& declared = measure_of(measure.at("name"));
    json resolved{{"name", declared.name},
                  {"unit", declared.unit},
                  {"between", resolved_window(measure.at("between"), end, document, key + ".between")},
                  {"reference", resolved_reference(measure, declared, document, key + ".reference")},
                  {"tolerance", nullptr},
                  {"metric", member_or_null(measure, "metric")}};
    if (measure.contains("tolerance"))
        resolve_tolerance(resolved, measure.at("tolerance"), declared, level, document, key);
    return resolved;
}

json resolved_measures(const json& values, const std::string& level, const Node& document)
{
    json measures = json::array();
    if (!values.contains("measure")) return measures;
    const double end = values.at("time").at("end");
    for (std::size_t index = 0; index < values.at("measure").size(); ++index)
        measures.push_back(
            resolved_measure(values.at("measure")[index], level, end, document, "measure." + std::to_string(index)));
    return measures;
}

json resolved_numerics(const json& values)
{
    json numerics = values.at("numerics");
    numerics["sound_speed"] = member_or_null(numerics, "sound_speed");
    numerics["reference_speed"] = member_or_null(numerics, "reference_speed");
    return numerics;
}

/// Over all that decides what is computed, and nothing that depends on where the files lie.
std::string content_hash(json resolved)
{
    resolved.erase("case_file");
    for (json& body : resolved.at("bodies"))
        body.erase("file");
    return sha256(resolved.dump());
}

} // namespace

json resolve_case(const std::string& path, const ResolveOptions& options)
{
    const Node document = read_document(path, options.variation, options.overrides);
    const Reading reading = read_declared(case_declaration(), document);
    const json& values = reading.values;
    check_level(path, values, document, options.level);
    check_rules(values, document);
    check_resolution(values, document, options.level);

    const json no_gravity = json::array({0.0, 0.0, 0.0});
    json resolved{{"schema", resolved_schema_version},
                  {"name", member_name(path, options.variation)},
                  {"variation", options.variation.empty() ? json(nullptr) : json(options.variation)},
                  {"tier", member_or_null(values, "tier")},
                  {"title", values.at("title")},
                  {"paper", values.at("paper")},
                  {"case_file", path},
                  {"level", options.level},
                  {"spacing", values.at("resolution").at(options.level)},
                  {"dimensions", values.at("dimensions")},
                  {"physics", ordered_physics(values)},
                  {"materials", resolved_materials(values)},
                  {"surrounding", resolved_surrounding(values)},
                  {"domain", resolved_domain(values)},
                  {"gravity", names_physics(values, "gravity") ? values.at("gravity") : no_gravity},
                  {"initial", resolved_initial(values)},
                  {"bodies", resolved_bodies(values, document, options.require_files, path)},
                  {"laser", resolved_laser(values)},
                  {"time", values.at("time")},
                  {"measures", resolved_measures(values, options.level, document)},
                  {"numerics", resolved_numerics(values)},
                  {"powder", member_or_null(values, "powder")},
                  {"assumed", reading.assumed},
                  {"sources", reading.sources}};
    resolved["hash"] = content_hash(resolved);
    return resolved;
}

Case read_case(const std::string& path, const std::string& level, const std::vector<std::string>& overrides,
               const std::string& variation)
{
    return case_from_resolved(resolve_case(path, {level, overrides, true, variation}));
}

json summarize_case(const std::string& path)
{
    std::vector<std::string> variations = variation_names(path);
    if (variations.empty()) variations.emplace_back();
    json tier, members = json::array();
    for (const std::string& variation : variations) {
        const json values = read_declared(case_declaration(), read_document(path, variation, {})).values;
        json levels = json::array();
        for (const std::string& level : level_names())
            if (values.at("resolution").contains(level)) levels.push_back(level);
        tier = member_or_null(values, "tier");
        members.push_back({{"name", member_name(path, variation)},
                           {"variation", variation.empty() ? json(nullptr) : json(variation)},
                           {"title", values.at("title")},
                           {"levels", levels}});
    }
    return {{"tier", tier}, {"members", members}};
}

} // namespace cupel
