/// What the scene is made of: the domain and its sides, the bodies, the state at the start.
#include "scene/declaration.hpp"

namespace cupel
{

namespace
{

const nlohmann::json no_vector = nlohmann::json::array({0.0, 0.0, 0.0});

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
         vector("velocity", 3, "m/s", "velocity of a wall without slip along itself")
             .with("kind", {"wall"})
             .or_else(no_vector),
         quantity("temperature", "K", "temperature of the wall").above(0).with("kind", {"wall"}).derived("adiabatic")}};
}

Table perturbation_declaration()
{
    Table table{"perturbation",
                "shape of a drop that is not quite round, theta from the vertical: R (1 + a cos(n theta)) in two "
                "dimensions, R (1 + a P_n(cos theta)) in three; SPH displaces the particles of the round drop",
                Table::Occurrence::once,
                false,
                false,
                {plain("mode", Type::integer, "n").at_least(2).at_most(12).must(),
                 quantity("amplitude", "1", "a").at_least(-0.3).at_most(0.3).must()}};
    return table.with("shape", {"sphere"});
}

Table surface_wave_declaration()
{
    Table table{"surface_wave",
                "wave on the upper side of a box: upper z + amplitude cos(2 pi x / wavelength); SPH displaces the "
                "particles of the flat layer",
                Table::Occurrence::once,
                false,
                false,
                {quantity("amplitude", "m", "height of a crest above the flat surface").must(),
                 quantity("wavelength", "m", "from crest to crest").above(0).must()}};
    return table.with("shape", {"box"});
}

Table round_walls_declaration()
{
    return {"round_walls",
            "walls that are circles about one centre, in two dimensions, for SPH: the domain is what lies between "
            "them, on rings of particles; the sides of the box are open",
            Table::Occurrence::once,
            false,
            false,
            {vector("center", 3, "m", "centre of the circles").must(),
             quantity("inner_radius", "m", "of a cylinder that liquid lies on; absent: there is none").above(0),
             quantity("outer_radius", "m", "of a vessel that liquid lies in; absent: there is none").above(0)}};
}

} // namespace

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
            {boundaries, round_walls_declaration()}};
}

Table body_declaration()
{
    return {"body",
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
             plain("file", Type::file, "spheres of the bed, made by ./cupel bed").with("shape", {"powder_bed"}).must(),
             quantity("temperature", "K", "temperature at the start, where `heat` is among the physics")
                 .above(0)
                 .with("shape", {"box", "sphere"})
                 .derived("the field of [initial]")},
            {perturbation_declaration(), surface_wave_declaration()}};
}

Table initial_declaration()
{
    return {"initial",
            "state at the start; of temperature for ever where `heat` is not among the physics",
            Table::Occurrence::once,
            false,
            true,
            {quantity("temperature", "K", "temperature at domain.lower").above(0).or_else(300.0),
             vector("temperature_gradient", 3, "K/m", "uniform gradient of temperature").or_else(no_vector)},
            {{"velocity",
              "velocity at the start, else everything is at rest; taylor_green: u = U sin(kx) cos(kz), "
              "w = -U cos(kx) sin(kz), k = 2 pi / wavelength",
              Table::Occurrence::once,
              false,
              false,
              {choice("field", {"taylor_green"}, "which field").must(), quantity("speed", "m/s", "U").above(0).must(),
               quantity("wavelength", "m", "period of the field in x and z").above(0).must()}},
             {"hot_spot",
              "what is added to the temperature: rise exp(-2 r^2 / radius^2), r the distance to the vertical through "
              "center",
              Table::Occurrence::once,
              false,
              false,
              {vector("center", 3, "m", "a point of the axis").must(),
               quantity("radius", "m", "where the rise is 1/e^2 of the greatest").above(0).must(),
               quantity("rise", "K", "on the axis").must()}}}};
}

} // namespace cupel
