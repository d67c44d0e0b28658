#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "integrators/neighbourhood.hpp"
#include "integrators/parameters.hpp"
#include "models/colour_profile.hpp"
#include "models/surface_geometry.hpp"
#include "models/wetting.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Finds the liquid's surface each step: colour gradient, wall normals where it wets, smoothed normals, curvature.
/// Constructed only where a scene has a force that acts on the surface. Where metal melts, the surface is that of the
/// metal: solids beside liquid take part (models/metal_surface.hpp).
class SurfaceTracker
{
public:
    SurfaceTracker(Scene& scene, const FlowParameters& parameters, const SmoothingKernel& kernel,
                   const ScalarField& mobility, bool sharpens);

    /// Before the first step walls take the colour of what they see most of. With one that is not there they show the
    /// liquid in a corner a surface, which they then continue, and which so stays for ever.
    void start(const Neighbourhood& neighbourhood);
    /// What has to be summed first, with whatever else a pass sums; then find() does the rest.
    template <bool two_phase, bool with_walls = true> ColourGradient<two_phase, with_walls> colour_gradient() const
    {
        return {mobility_, h_, fields_};
    }
    void find(const Neighbourhood& neighbourhood);

    const SurfaceFields& fields() const { return fields_; }
    /// Places of the solids that take part in the surface; none where nothing melts.
    const std::vector<Index>& solids() const { return solids_; }
    /// What times σ δ is the force of Young's equation on liquid at a contact line; null where there is none.
    const VectorField* contact_pull() const { return contact_pull_; }
    /// A particle that has just melted or frozen is at no surface until the next update finds it there.
    void reset(Index place)
    {
        fields_.delta[place] = 0.0;
        fields_.curvature_share[place] = 0.0;
        fields_.curvature[place] = 0.0;
        if (fields_.exposure) (*fields_.exposure)[place] = 0.0;
    }
    /// Whether a particle has too few companions to be part of a body of liquid. As of the last update.
    bool is_spray(Index i) const { return fields_.companions[i] < fewest_companions(); }
    double fewest_companions() const { return thresholds_.fewest_companions * full_companions_; }

private:
    /// The line at which the surface meets a wall, as a particle of the wall sees it; places relative to that.
    struct ContactLine
    {
        Vector foot;        ///< mean place of the interface near the wall, m
        Vector place;       ///< where it meets the wall, m
        Vector wall_normal; ///< there
        Vector along;       ///< out of the liquid, along the wall
        double cosine;      ///< ⟨n̂⟩·N
        double height;      ///< mean height of what the sums are made of above the wall's plane there, m
        double curvature;   ///< of the interface along the meridian, 1/m

        /// sin θ t̂ + cos θ N
        Vector normal_of(double angle_cosine) const;
    };

    void find_solids(const Neighbourhood& neighbourhood);
    /// Clusters with particles that the surface bounds.
    const std::vector<Index>& clusters(const Neighbourhood& neighbourhood) const
    {
        return solid_share_ ? neighbourhood.working() : neighbourhood.moving();
    }
    /// apply(place) for each particle that the surface bounds.
    template <class Apply> void for_each_bounded(const Neighbourhood& neighbourhood, const Apply& apply) const
    {
        neighbourhood.for_each_moving(apply);
        for (const Index i : solids_)
            apply(i);
    }
    void finish_gradient(Index i);
    void find_band(const Neighbourhood& neighbourhood);
    std::vector<Index> clusters_of_walls(const Neighbourhood& neighbourhood) const;
    void wet_walls(const Neighbourhood& neighbourhood);
    bool meets_surface(Index top) const;
    ContactLine contact_line(Index top) const;
    void prescribe_wall_normals(const Neighbourhood& neighbourhood, const std::vector<Index>& walls);
    void find_normals(const Neighbourhood& neighbourhood);
    void fit_curvature(const Neighbourhood& neighbourhood);
    void sharpen_curvature(const Neighbourhood& neighbourhood, double greatest);

    Particles& particles_;
    SmoothingKernel kernel_;
    Mobility mobility_;
    ScalarField* solid_share_; ///< m of metal_surface.hpp; null where nothing melts
    Mobility bounded_;         ///< what the surface bounds: m, or what moves
    std::vector<Index> solids_;
    std::uint64_t known_version_ = 0; ///< of the neighbourhood for which solids that it has left behind were put out
    ColourProfile profile_;
    SurfaceFields fields_;
    SurfaceThresholds thresholds_;
    int dimensions_;
    bool two_phase_, needs_curvature_;
    /// Between two phases: before what smoothing has taken is given back. Walls continue that one, since what is given
    /// back is noise beside a contact line, where there is liquid on one side alone.
    ScalarField* smoothed_curvature_ = nullptr;
    /// Only where the load is carried into the liquid: a band that bears it does not stand the noise. Nor does melt
    /// that runs over its solid, whose particles have no order to lose.
    bool sharpens_;
    double spacing_, h_, full_companions_;
    std::optional<WallInterface> wall_interface_;
    const ScalarField* wall_depth_ = nullptr;
    const ScalarField* wall_curvature_ = nullptr; ///< null where walls are flat
    double contact_angle_ = 0.0;                  ///< through the primary liquid, rad
    VectorField* wall_pull_ = nullptr;
    VectorField* contact_pull_ = nullptr;
};

} // namespace cupel::inline CUPEL_ENGINE
