#include "scene/declaration.hpp"

namespace cupel
{

namespace
{

Table openfoam_declaration()
{
    return {
        "openfoam",
        "choices of the OpenFOAM reference; what is absent is the reference's own default",
        Table::Occurrence::once,
        false,
        false,
        {quantity("max_courant", "1", "greatest Courant number").above(0).at_most(1),
         quantity("max_alpha_courant", "1", "greatest Courant number at the interface").above(0).at_most(1),
         plain("curvature_smoothing", Type::integer, "passes that smooth the fraction before its curvature is taken")
             .at_least(0)
             .at_most(20),
         choice("mesh", {"following", "static"},
                "in scenes with beam, flow and melting: fine cells that follow the beam, or along all of its path"),
         plain("ray_tracing", Type::boolean,
               "light by rays that are reflected and absorbed by Fresnel's law; absent: first hit only")}};
}

} // namespace

Table numerics_declaration()
{
    return {
        "numerics",
        "overrides of what follows from physics, for studies; canonical cases leave it out",
        Table::Occurrence::once,
        false,
        true,
        {choice("formulation", {"default", "paper"}, "set of SPH remedies: Cupel's own, or the paper's")
             .or_else("default"),
         choice("precision", {"double", "float"}, "of pair arithmetic; positions and sums over time are double")
             .or_else("double"),
         choice("kernel", {"root_free", "quintic_spline"}, "smoothing kernel; both reach three smoothing lengths")
             .or_else("root_free"),
         quantity("smoothing_ratio", "1", "smoothing length over particle spacing")
             .at_least(0.8)
             .at_most(3)
             .or_else(1.0),
         quantity("artificial_viscosity", "1", "alpha of Monaghan's artificial viscosity; 0 = off")
             .at_least(0)
             .at_most(2)
             .or_else(0.0)
             .in_paper(0.1),
         quantity("artificial_viscosity_beta", "1", "beta of Monaghan's artificial viscosity")
             .at_least(0)
             .at_most(4)
             .or_else(0.0),
         quantity("artificial_stress", "1", "epsilon of the artificial stress against clumping; 0 = off")
             .at_least(0)
             .at_most(1)
             .or_else(0.0)
             .in_paper(0.2),
         quantity("artificial_heat", "1", "alpha of the artificial heat of Noh and Monaghan; 0 = off")
             .at_least(0)
             .at_most(2)
             .or_else(0.0)
             .in_paper(0.1),
         quantity("density_diffusion", "1", "delta of the density diffusion; 0 = off")
             .at_least(0)
             .at_most(1)
             .or_else(0.1)
             .in_paper(0.0),
         plain("shifting", Type::strength, "strength of particle shifting; true = 1, false = off")
             .at_least(0)
             .at_most(2)
             .or_else(1.0)
             .in_paper(0.0),
         choice("surface_load", {"carried", "continuum_force"},
                "what presses on a surface: a pressure carried into the liquid, or Brackbill's force in its band")
             .or_else("carried")
             .in_paper("continuum_force"),
         plain("contact_line_force", Type::boolean, "whether Young's force pulls at contact lines").or_else(true),
         quantity("sound_speed", "m/s", "artificial sound speed")
             .above(0)
             .derived("sound_speed_factor times the greatest expected speed"),
         quantity("sound_speed_factor", "1", "artificial sound speed over the greatest expected speed")
             .at_least(1)
             .at_most(1000)
             .or_else(10.0),
         quantity("reference_speed", "m/s", "greatest expected speed").above(0).derived("from the physics of the case"),
         quantity("time_step_factor", "1", "all mechanical time-step limits are multiplied by it")
             .above(0)
             .at_most(10)
             .or_else(1.0),
         plain("acoustic_substeps", Type::integer,
               "most steps by which sound is followed within one step of all else; 1 = as all else")
             .at_least(1)
             .at_most(8)
             .or_else(6)
             .in_paper(1),
         quantity("thermal_time_step_factor", "1", "the thermal time-step limit is multiplied by it")
             .above(0)
             .at_most(10)
             .or_else(1.0),
         quantity("skin", "1", "extra radius of the neighbour lists over particle spacing")
             .at_least(0)
             .at_most(2)
             .or_else(0.15),
         quantity("position_jitter", "1",
                  "greatest random displacement of a particle at the start, along each axis, over spacing")
             .at_least(0)
             .at_most(0.5)
             .or_else(0.0),
         choice("without_saving", {"none", "moving_momentum", "thermal_clock", "local_lists", "kept_sums"},
                "computes in full what this saving leaves out, so that it can be measured (./cupel bench --savings)")
             .or_else("none")},
        {openfoam_declaration()}};
}

} // namespace cupel
