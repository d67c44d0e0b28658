#include "scene/place_particles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "scene/even_out.hpp"
#include "scene/filling_grid.hpp"
#include "scene/free_drop.hpp"
#include "scene/round_walls.hpp"
#include "scene/shape.hpp"

namespace cupel
{

namespace
{

/// Layers of wall particles: enough to complete a kernel of support 3 spacings.
constexpr int wall_layers = 3;

/// Random numbers from -1 to 1, the same ones on every machine.
class Jitter
{
public:
    explicit Jitter(bool flat) : flat_(flat) {}

    Vector next()
    {
        const double x = one(), z = one();
        return {x, flat_ ? 0.0 : one(), z};
    }

private:
    double one() { return 2.0 * (static_cast<double>(generator_()) / 4294967295.0) - 1.0; }

    std::mt19937 generator_{1};
    bool flat_;
};

struct Placement
{
    Vector position;
    Kind kind;
    std::uint8_t material;
    Vector wall_normal;
    bool free_slip;
    std::optional<std::size_t> parent; ///< of a wall, the placement before it in the layer at its surface
    double depth = 0;                  ///< behind the surface of a wall, m
    Vector velocity{};                 ///< of a wall, m/s
    double curvature = 0;              ///< of a wall, 1/m
};

/// Moves the particles of the undisturbed bodies to where a perturbation or a wave has them, and by random amounts
/// where the case asks for it. Masses stay what they are.
void disturb(const Case& definition, std::vector<Placement>& placements)
{
    std::vector<const Body*> disturbed;
    for (const Body& body : definition.bodies)
        if (body.perturbation || body.surface_wave) disturbed.push_back(&body);
    const double scatter = definition.numerics.position_jitter * definition.spacing;
    Jitter jitter(definition.dimensions == 2);
    for (Placement& placement : placements) {
        if (placement.kind == Kind::wall) continue;
        Vector moved = placement.position;
        if (placement.kind == Kind::fluid)
            for (const Body* body : disturbed)
                moved += to_vector(
                    displacement(*body, definition.domain, to_array(placement.position), definition.dimensions));
        if (scatter > 0) moved += scatter * jitter.next();
        placement.position = moved;
    }
}

/// A ball that is cut from a lattice holds too much or too little: at 20 spacings a diameter 0.6 % too much, which
/// makes it oscillate 0.4 % too slowly. A drop with nothing around it is therefore swollen or shrunk about its centre
/// until its particles hold its volume; one that top and bottom leave whole is placed on rings or shells instead, so
/// that its surface has no steps. Returns the volume of each.
double place_free_drop(const Case& definition, bool two_phase, double lattice_volume,
                       std::vector<Placement>& placements)
{
    const Body& body = definition.bodies.front();
    if (two_phase || definition.bodies.size() != 1 || body.solid || body.shape != BodyShape::sphere)
        return lattice_volume;
    const auto volume = volume_in_domain(body, definition.domain, definition.dimensions);
    if (!volume) return lattice_volume;
    if (whole_in_domain(body, definition.domain)) {
        std::vector<Vector> places;
        for (const auto& place : definition.dimensions == 2 ? disc_on_rings(body, definition.spacing)
                                                            : ball_on_shells(body, definition.spacing))
            places.push_back(to_vector(place));
        if (definition.dimensions == 3) even_out(places, body.radius, definition.spacing);
        Placement placement = placements.front();
        placements.clear();
        for (const Vector& place : places) {
            placement.position = to_vector(body.center) + place;
            placements.push_back(placement);
        }
        return *volume / static_cast<double>(placements.size());
    }
    const double share = *volume / static_cast<double>(placements.size());
    const double scale = std::pow(share / lattice_volume, 1.0 / definition.dimensions);
    const Vector center = to_vector(body.center);
    for (Placement& placement : placements)
        placement.position = center + scale * (placement.position - center);
    return share;
}

/// Wall particles fill the shell of lattice points around the domain that lie behind walls only.
void place_walls(const Case& definition, const Lattice& lattice, std::vector<Placement>& placements)
{
    const std::array<int, 3> layers{wall_layers, definition.dimensions == 2 ? 0 : wall_layers, wall_layers};
    std::map<std::array<int, 3>, std::size_t> placement_of_cell;
    std::vector<std::pair<std::size_t, std::array<int, 3>>> parents;
    std::array<int, 3> cell{};
    for (cell[2] = -layers[2]; cell[2] < lattice.cells[2] + layers[2]; ++cell[2])
        for (cell[1] = -layers[1]; cell[1] < lattice.cells[1] + layers[1]; ++cell[1])
            for (cell[0] = -layers[0]; cell[0] < lattice.cells[0] + layers[0]; ++cell[0]) {
                int outside = 0;
                bool behind_walls = true, free_slip = true;
                Vector normal{};
                auto parent = cell;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const bool below = cell[axis] < 0, above = cell[axis] >= lattice.cells[axis];
                    if (!below && !above) continue;
                    ++outside;
                    const auto& boundary = definition.domain.boundaries[2 * axis + (above ? 1 : 0)];
                    if (!boundary || boundary->kind != BoundaryKind::wall)
                        behind_walls = false;
                    else
                        free_slip = free_slip && !boundary->no_slip;
                    (axis == 0 ? normal.x : axis == 1 ? normal.y : normal.z) = below ? 1.0 : -1.0;
                    parent[axis] = below ? -1 : lattice.cells[axis];
                }
                if (outside == 0 || !behind_walls) continue;
                const double length = norm(normal);
                Placement wall{lattice.point(cell), Kind::wall, 0, (1.0 / length) * normal, free_slip, std::nullopt};
                // Edges and corners have no surface of their own that a contact line could run on, or that moves.
                if (outside == 1) {
                    placement_of_cell[cell] = placements.size();
                    parents.emplace_back(placements.size(), parent);
                    int behind = 0;
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        if (cell[axis] == std::clamp(cell[axis], 0, lattice.cells[axis] - 1)) continue;
                        const bool above = cell[axis] > 0;
                        behind = above ? cell[axis] - lattice.cells[axis] : -1 - cell[axis];
                        wall.velocity = to_vector(definition.domain.boundaries[2 * axis + (above ? 1 : 0)]->velocity);
                    }
                    wall.depth = (behind + 0.5) * lattice.spacing;
                }
                placements.push_back(wall);
            }
    for (const auto& [number, parent] : parents)
        placements[number].parent = placement_of_cell.at(parent);
}

/// Liquid and walls where the walls are round; returns the volume of a particle of liquid.
double place_round(const Case& definition, std::vector<Placement>& placements)
{
    const RoundPlaces places = place_between_round_walls(definition, wall_layers);
    for (const Vector3& place : places.primary)
        placements.push_back({to_vector(place), Kind::fluid, 0, {}, false, {}});
    for (const Vector3& place : places.other)
        placements.push_back({to_vector(place), Kind::fluid, 1, {}, false, {}});
    const std::size_t first = placements.size();
    for (const RoundWallPlace& wall : places.walls)
        placements.push_back({to_vector(wall.position),
                              Kind::wall,
                              0,
                              to_vector(wall.normal),
                              false,
                              first + wall.parent,
                              wall.depth,
                              {},
                              wall.curvature});
    return places.volume;
}

/// Liquid and solids on a lattice, `background` where no body is, and the walls around them; returns the volume of a
/// particle of what is no wall.
template <class MaterialIndex>
double place_on_lattice(const Case& definition, std::optional<Filling> background, const MaterialIndex& material_index,
                        bool any_fluid, std::vector<Placement>& placements)
{
    const Lattice lattice = make_lattice(definition);
    FillingGrid grid(lattice, background);
    for (const Body& body : definition.bodies)
        fill_body(grid, body, {body.solid ? Kind::solid : Kind::fluid, material_index(body.material)},
                  definition.dimensions);
    std::array<int, 3> cell{};
    for (cell[2] = 0; cell[2] < lattice.cells[2]; ++cell[2])
        for (cell[1] = 0; cell[1] < lattice.cells[1]; ++cell[1])
            for (cell[0] = 0; cell[0] < lattice.cells[0]; ++cell[0])
                if (const auto& filling = grid.at(cell))
                    placements.push_back({lattice.point(cell), filling->kind, filling->material, {}, false, {}});
    if (placements.empty())
        throw CaseError("resolution: no particle fits into any body at a spacing of " +
                        std::to_string(definition.spacing) + " m; choose a finer one");
    const double lattice_volume = std::pow(definition.spacing, definition.dimensions);
    const double volume = place_free_drop(definition, background.has_value(), lattice_volume, placements);
    disturb(definition, placements);
    // A scene that is solid to its borders needs no walls: nothing molten reaches them.
    if (any_fluid) place_walls(definition, lattice, placements);
    return volume;
}

/// A perfect lattice is an equilibrium of shifting, if not a stable one: in a flow it is stretched and sheared, with
/// more and more pressure, until round-off has grown enough to break it (a Taylor-Green vortex loses a fifth of its
/// energy to that). Liquid therefore starts a thousandth of a spacing off it, each particle by its own number, the same
/// in every run.
void unsettle_lattice(Particles& particles, double spacing, bool flat)
{
    constexpr double greatest = 1e-3;
    for (Index i = 0; i < particles.count(); ++i) {
        if (particles.kind[static_cast<std::size_t>(i)] != Kind::fluid) continue;
        std::minstd_rand random(static_cast<std::uint32_t>(i) * 2654435761U + 1U);
        random.discard(3);
        const auto offset = [&] { return greatest * spacing * (2.0 * random() / random.max() - 1.0); };
        const double x = offset(), y = offset(), z = offset();
        particles.position.set(i, particles.position[i] + Vector{x, flat ? 0.0 : y, z});
    }
}

} // namespace

Scene place_particles(const Case& definition)
{
    if (definition.bodies.empty()) throw CaseError("body: the case has no body; add one [[body]]");

    Scene scene;
    scene.definition = definition;
    scene.spacing = definition.spacing;
    scene.dimensions = definition.dimensions;
    scene.two_phase = definition.surrounding && definition.surrounding->resolved;

    std::vector<std::string> names;
    const auto material_index = [&](const std::string& name) {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found != names.end()) return static_cast<std::uint8_t>(found - names.begin());
        names.push_back(name);
        scene.materials.push_back(definition.material(name));
        return static_cast<std::uint8_t>(names.size() - 1);
    };
    for (const Body& body : definition.bodies)
        material_index(body.material);
    std::optional<Filling> background;
    if (scene.two_phase) background = Filling{Kind::fluid, material_index(definition.surrounding->material)};
    if (names.size() > 2 || (names.size() == 2 && !scene.two_phase))
        throw CaseError("body: the SPH solver models one liquid in vacuum or one in a resolved surrounding, but the "
                        "bodies are made of more; use one material");

    const bool flat = definition.dimensions == 2;
    const bool any_fluid =
        scene.two_phase || std::ranges::any_of(definition.bodies, [](const Body& body) { return !body.solid; });
    std::vector<Placement> placements;
    const double lattice_volume = std::pow(scene.spacing, scene.dimensions);
    scene.particle_volume = definition.domain.round_walls
                                ? place_round(definition, placements)
                                : place_on_lattice(definition, background, material_index, any_fluid, placements);

    scene.particles = std::make_unique<Particles>(static_cast<Index>(placements.size()));
    Particles& particles = *scene.particles;
    VectorField* wall_normal = any_fluid ? &particles.add_vector({"wall_normal", "1"}) : nullptr;
    ScalarField* free_slip = any_fluid ? &particles.add_scalar({"wall_free_slip", "1"}) : nullptr;
    ScalarField* wall_depth = any_fluid ? &particles.add_scalar({"wall_depth", "m"}) : nullptr;
    const auto moves = [](const auto& boundary) { return boundary && boundary->velocity != Vector3{}; };
    VectorField* wall_velocity = any_fluid && std::ranges::any_of(definition.domain.boundaries, moves)
                                     ? &particles.add_vector({"wall_velocity", "m/s"})
                                     : nullptr;
    ScalarField* wall_curvature =
        definition.domain.round_walls ? &particles.add_scalar({"wall_curvature", "1/m"}) : nullptr;
    for (Index i = 0; i < particles.count(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Placement& placement = placements[k];
        particles.kind[k] = placement.kind;
        particles.material[k] = placement.material;
        particles.position.set(i, placement.position);
        if (definition.initial.velocity && placement.kind == Kind::fluid)
            particles.velocity.set(i, to_vector(definition.initial.velocity->velocity(to_array(placement.position))));
        const double density = scene.materials[placement.material].density;
        const double volume = placement.kind == Kind::wall ? lattice_volume : scene.particle_volume;
        particles.density[i] = density;
        particles.volume[i] = volume;
        particles.mass[i] = density * volume;
        if (placement.kind == Kind::wall) {
            wall_normal->set(i, placement.wall_normal);
            (*free_slip)[i] = placement.free_slip ? 1.0 : 0.0;
            (*wall_depth)[i] = placement.depth;
            if (wall_velocity) wall_velocity->set(i, placement.velocity);
            if (wall_curvature) (*wall_curvature)[i] = placement.curvature;
            if (placement.parent) particles.surface_parent[k] = static_cast<Index>(*placement.parent);
        }
    }
    if (definition.numerics.shifting > 0.0 && !scene.two_phase) unsettle_lattice(particles, scene.spacing, flat);
    return scene;
}

} // namespace cupel
