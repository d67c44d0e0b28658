#include "scene/declaration.hpp"

namespace cupel
{

namespace
{

Table elastic(const std::string& key, const std::string& help)
{
    return {key,
            help,
            Table::Occurrence::once,
            true,
            false,
            {quantity("density", "kg/m^3", "density").above(0).must(),
             quantity("young_modulus", "Pa", "modulus of elasticity").above(0).must(),
             quantity("poisson_ratio", "1", "Poisson's ratio").above(-1).below(0.5).must()}};
}

Table contact(const std::string& key, const std::string& help)
{
    return {key,
            help,
            Table::Occurrence::once,
            true,
            false,
            {quantity("friction", "1", "coefficient of sliding friction").at_least(0).at_most(2).must(),
             quantity("rolling_friction", "1", "coefficient of rolling friction").at_least(0).at_most(1).must(),
             quantity("restitution", "1", "coefficient of restitution").above(0).at_most(1).must()}};
}

} // namespace

Table powder_declaration()
{
    return {"powder",
            "how ./cupel bed makes the powder bed (discrete element method)",
            Table::Occurrence::once,
            false,
            false,
            {plain("seed", Type::integer, "seed of the random bed").at_least(1).at_most(1000000).must(),
             quantity("layer_thickness", "m", "height of the blade above the plate").above(0).must()},
            {{"diameter",
              "grain diameters: log-normal, cut at both ends",
              Table::Occurrence::once,
              true,
              false,
              {quantity("median", "m", "median diameter before the cut").above(0).must(),
               quantity("minimum", "m", "smallest diameter").above(0).must(),
               quantity("maximum", "m", "greatest diameter").above(0).must(),
               quantity("spread", "1", "standard deviation of the diameter's natural logarithm")
                   .above(0)
                   .at_most(2)
                   .must()}},
             elastic("grain", "a grain's material in the discrete element method"),
             elastic("plate", "the plate's material in the discrete element method"),
             contact("grain_contact", "contact of two grains"),
             contact("plate_contact", "contact of a grain and the plate")}};
}

} // namespace cupel
