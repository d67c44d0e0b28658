#pragma once

#include "models/surface_geometry.hpp"

namespace cupel
{

/// Colour of the solid as a liquid particle near the surface sees it, and its gradient:
///
///   c_s = Σ_{solid} V_j W_ij      [1],      −∇c_s = −Σ_{solid} V_j ∇W_ij      [1/m], out of the solid
///
/// What wetted_normal (wetting.hpp) turns the surface normal with.
struct SolidContact
{
    Mobility mobility;
    const Particles& particles;
    SurfaceFields surface;
    ScalarField& solid_colour;
    VectorField& solid_gradient;

    struct Near
    {
    };
    struct Sum
    {
        Lanes colour{};
        VectorLanes gradient{};
    };

    bool idle(const Cluster& cluster) const
    {
        for (Index i = cluster.first; i < cluster.first + cluster.count; ++i)
            if (mobility.weight[i] != 0.0 && surface.delta[i] > 0.0)
                return false;
        return true;
    }
    Near near(Index) const { return {}; }
    void add(const Near&, Index j, const Pair& pair, Sum& sum) const
    {
        if (mobility.weight[j] != 0.0)
            return;
        const double volume_j = particles.volume[j];
        sum.colour += volume_j * pair.kernel;
        sum.gradient -= (volume_j * pair.gradient_over_r) * pair.offset;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        const auto liquid = [&](Index i) { return mobility.weight[i] != 0.0; };
        store_if(solid_colour, cluster, sum.colour, liquid);
        store_if(solid_gradient, cluster, sum.gradient, liquid);
    }
};

}  // namespace cupel
