#include "integrators/surface_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "models/metal_surface.hpp"
#include "models/normal_of_depth.hpp"

namespace cupel::inline CUPEL_ENGINE
{

namespace
{

bool has_kind(const Particles& particles, Kind kind)
{
    return std::find(particles.kind.begin(), particles.kind.end(), kind) != particles.kind.end();
}

/// Normal of a surface that curves by `curvature`, 1/m, and depth below it, m, at a place from which its point with the
/// normal n̂ lies at `foot`:   v = −foot,   (n̂ + κ v)/|n̂ + κ v|,   (1 − |n̂ + κ v|)/κ = −(2 v·n̂ + κ v²)/(1 + |n̂ + κ v|)
std::pair<Vector, double> on_circle(const Vector& foot, const Vector& normal, double curvature)
{
    const Vector outward = normal - curvature * foot;
    const double length = norm(outward);
    const double depth = (2.0 * dot(foot, normal) - curvature * dot(foot, foot)) / (1.0 + length);
    return {(1.0 / std::max(length, 1e-9)) * outward, depth};
}

/// Whether a free surface overhangs its wall: the wall's particles then continue it as a circle, and nothing pulls at
/// the contact line (models/wetting.hpp says why).
bool overhangs(bool two_phase, double contact_angle)
{
    return !two_phase && std::cos(contact_angle) < -1e-6;
}

} // namespace

SurfaceTracker::SurfaceTracker(Scene& scene, const FlowParameters& parameters, const SmoothingKernel& kernel,
                               const ScalarField& mobility, bool sharpens)
    : particles_(*scene.particles), kernel_(kernel), mobility_{mobility},
      solid_share_(!scene.two_phase && scene.definition.requires_physics("melting")
                       ? &particles_.add_scalar({"metal_share", "1"})
                       : nullptr),
      bounded_{solid_share_ ? *solid_share_ : mobility},
      profile_(kernel, scene.dimensions, scene.two_phase ? 0.0 : scene.spacing),
      fields_(SurfaceFields::register_in(particles_)), dimensions_(scene.dimensions), two_phase_(scene.two_phase),
      needs_curvature_(scene.definition.requires_physics("surface_tension")), sharpens_(sharpens),
      spacing_(scene.spacing), h_(parameters.smoothing_length), full_companions_(lattice_companions(scene.dimensions))
{
    for (Index i = 0; i < particles_.count(); ++i)
        fields_.colour[i] = particles_.material[static_cast<std::size_t>(i)] == 0 ? 1.0 : 0.0;
    if (solid_share_) fields_.exposure = &particles_.add_scalar({"surface_exposure", "1"});
    if (two_phase_) smoothed_curvature_ = &particles_.add_scalar({"smoothed_curvature", "1/m"});
    if (has_kind(particles_, Kind::wall)) {
        const auto scalar = [&](const char* name) -> ScalarField& { return particles_.add_scalar({name, "1"}); };
        const auto vector = [&](const char* name) -> VectorField& { return particles_.add_vector({name, "1"}); };
        wall_depth_ = &particles_.scalar("wall_depth");
        if (particles_.has("wall_curvature")) wall_curvature_ = &particles_.scalar("wall_curvature");
        // A wall that the scene does not give an angle is neutral: the surface meets it at right angles.
        contact_angle_ = scene.definition.requires_physics("wetting") ? scene.materials.front().contact_angle.value()
                                                                      : 0.5 * std::numbers::pi;
        wall_interface_.emplace(WallInterface{
            mobility_, 2.0 * spacing_, (two_phase_ ? 0.11 : 0.22) / h_, 0.05 / h_, particles_,
            particles_.vector("wall_normal"), fields_, two_phase_ ? *smoothed_curvature_ : fields_.curvature,
            scalar("wall_weight_sum"), vector("wall_normal_sum"), vector("wall_place_sum"),
            scalar("wall_curvature_sum"), vector("wall_foot_sum"), vector("wall_lateral_sum"),
            scalar("wall_primary_sum"), scalar("wall_other_sum")});
        if (needs_curvature_ && scene.definition.numerics.contact_line_force && !overhangs(two_phase_, contact_angle_))
        {
            wall_pull_ = &particles_.add_vector({"wall_pull", "1"});
            contact_pull_ = &particles_.add_vector({"contact_pull", "1/m"});
        }
    }
}

void SurfaceTracker::start(const Neighbourhood& neighbourhood)
{
    if (wall_interface_) prescribe_wall_normals(neighbourhood, clusters_of_walls(neighbourhood));
}

void SurfaceTracker::find(const Neighbourhood& neighbourhood)
{
    if (solid_share_) find_solids(neighbourhood);
    for_each_bounded(neighbourhood, [&](Index i) { finish_gradient(i); });
    find_band(neighbourhood);
    if (wall_interface_) wet_walls(neighbourhood);
    find_normals(neighbourhood);
    if (needs_curvature_) fit_curvature(neighbourhood);
}

/// Solids beside liquid and their colour gradient. Those that were beside it have no surface any more.
void SurfaceTracker::find_solids(const Neighbourhood& neighbourhood)
{
    if (known_version_ != neighbourhood.version()) {
        known_version_ = neighbourhood.version();
        for (Index i = 0; i < particles_.count(); ++i) {
            (*solid_share_)[i] = mobility_.weight[i];
            if (particles_.kind[static_cast<std::size_t>(i)] != Kind::wall && mobility_.weight[i] == 0.0) reset(i);
        }
    }
    const NeighbourList& list = neighbourhood.list();
    const SolidBesideLiquid beside{mobility_, particles_.kind, h_, *solid_share_};
    for_each_pair(list, particles_, kernel_, neighbourhood.standing(), beside);
    solids_.clear();
    for (const Index c : neighbourhood.standing()) {
        const Cluster& cluster = list.cluster(c);
        for (Index i = cluster.first; i < cluster.first + cluster.count; ++i) {
            if (!beside.is_solid(i)) continue;
            if ((*solid_share_)[i] > 0.0)
                solids_.push_back(i);
            else
                reset(i);
        }
    }
    for_each_pair(list, particles_, kernel_, neighbourhood.standing(),
                  ColourGradientOfSolids{{bounded_, h_, fields_}, mobility_});
}

/// Near a free surface only what has a neighbour at the surface itself belongs to it.
void SurfaceTracker::find_band(const Neighbourhood& neighbourhood)
{
    if (two_phase_) return;
    for_each_pair(neighbourhood.list(), particles_, kernel_, clusters(neighbourhood),
                  SurfaceNeighbourhood{bounded_, (solid_share_ ? 2.9 : 4.0) * h_, fields_});
    for_each_bounded(neighbourhood, [&](Index i) {
        const bool near_surface = fields_.in_band[i] != 0.0 || fields_.raw_curvature[i] > 0.0;
        if (!near_surface || is_spray(i)) fields_.delta[i] = 0.0;
    });
}

std::vector<Index> SurfaceTracker::clusters_of_walls(const Neighbourhood& neighbourhood) const
{
    std::vector<Index> walls;
    for (const Index c : neighbourhood.standing())
        if (!none_in(neighbourhood.list().cluster(c),
                     [&](Index i) { return particles_.kind[static_cast<std::size_t>(i)] == Kind::wall; }))
            walls.push_back(c);
    return walls;
}

/// Walls take the colour and the normal that the contact angle asks for, and the liquid that touches them sees its
/// surface anew.
void SurfaceTracker::wet_walls(const Neighbourhood& neighbourhood)
{
    // What has left the walls is pulled no longer.
    if (contact_pull_) neighbourhood.for_each_moving([&](Index i) { contact_pull_->set(i, {}); });
    const NeighbourList& list = neighbourhood.list();
    const std::vector<Index> walls = clusters_of_walls(neighbourhood);
    if (walls.empty()) return;
    prescribe_wall_normals(neighbourhood, walls);

    const std::vector<Index> wetting = neighbourhood.moving_near(walls);
    const auto sum = [&](const auto& term) { for_each_pair(list, particles_, kernel_, wetting, term); };
    two_phase_ ? sum(colour_gradient<true>()) : sum(colour_gradient<false>());
    for (const Index c : wetting) {
        const Cluster& cluster = list.cluster(c);
        for (Index i = cluster.first; i < cluster.first + cluster.count; ++i)
            if (mobility_.weight[i] != 0.0) finish_gradient(i);
    }
    find_band(neighbourhood);
    if (contact_pull_)
        for_each_pair(list, particles_, kernel_, wetting,
                      ContactPull{mobility_, spacing_, wall_interface_->wall_normal, *wall_depth_,
                                  wall_interface_->weight_sum, *wall_pull_, *contact_pull_});
}

void SurfaceTracker::finish_gradient(Index i)
{
    const Vector gradient = fields_.colour_gradient[i];
    const double slope = norm(gradient);
    const double smallest = two_phase_ ? 0.01 : 1e-6;
    const bool defined = slope * h_ > smallest;
    fields_.delta[i] = defined ? (two_phase_ ? 1.0 : 2.0) * slope : 0.0;
    fields_.normal.set(i, defined ? (1.0 / slope) * gradient : Vector{});
    // A cluster without any surface is skipped by the curvature fit: what it found the last time must not be left.
    fields_.curvature_share[i] = 0.0;
    fields_.in_band[i] = slope * h_ > thresholds_.band ? 1.0 : 0.0;
    const double reach = 2.5 * h_;
    fields_.depth[i] = std::clamp(profile_.depth(fields_.smoothed_colour[i]), two_phase_ ? -reach : 0.0, reach);
}

/// Whether a wall particle sees enough of both liquids to be where their interface meets the wall: a fifth of what it
/// would see of each in the wedge of Young's angle. A continued interface is nothing that liquid has to bear out: a
/// wall that had the primary liquid's colour under the other one showed that a surface, went on continuing it, and a
/// drop of 30 degrees crept along its wall without end. The fifth is chosen: it leaves the place at which the continued
/// interface passes (all of the wedge), and one spacing further out.
bool SurfaceTracker::meets_surface(Index top) const
{
    if (!two_phase_) return true;
    constexpr double share = 0.2;
    const double primary = wall_interface_->primary_sum[top], other = wall_interface_->other_sum[top];
    const double wedge = contact_angle_ / std::numbers::pi, all = primary + other;
    return primary > share * wedge * all && other > share * (1.0 - wedge) * all;
}

Vector SurfaceTracker::ContactLine::normal_of(double angle_cosine) const
{
    const double c = std::clamp(angle_cosine, -1.0, 1.0);
    return std::sqrt(1.0 - c * c) * along + c * wall_normal;
}

/// What the sums of a particle of the wall's surface layer say of the contact line before it. Where the wall is round
/// its normal is that of the place to which the line from the interface's mean place leads, across the mean of its
/// normal and Young's.
SurfaceTracker::ContactLine SurfaceTracker::contact_line(Index top) const
{
    const WallInterface& wall = *wall_interface_;
    const double scale = 1.0 / wall.weight_sum[top];
    const Vector seen = scale * wall.normal_sum[top];
    ContactLine line{scale * wall.foot_sum[top], {}, wall.wall_normal[top], {}, 0.0, 0.0, 0.0};
    line.curvature = scale * wall.curvature_sum[top] / (dimensions_ == 2 ? 1.0 : 2.0);
    const Vector above = (*wall_depth_)[top] * wall.wall_normal[top]; // the wall's surface before the particle
    const double wall_curvature = wall_curvature_ ? (*wall_curvature_)[top] : 0.0;
    const auto look_from = [&](const Vector& place) {
        const auto [normal, depth] = on_circle(above - place, wall.wall_normal[top], wall_curvature);
        line.wall_normal = normal;
        line.place = place + depth * normal;
        const Vector lateral = wall.lateral_sum[top] - dot(wall.lateral_sum[top], normal) * normal;
        line.along = (1.0 / std::max(norm(lateral), 1e-30)) * lateral;
        line.cosine = dot(seen, normal);
        line.height = dot(scale * wall.place_sum[top] - line.place, normal);
        return -depth;
    };
    const double distance = look_from(line.foot);
    if (wall_curvature != 0.0) {
        const Vector continued = line.normal_of(std::cos(contact_angle_)) + line.normal_of(line.cosine);
        const double aside = distance * dot(line.wall_normal, continued) / std::max(dot(line.along, continued), 1e-9);
        look_from(line.place + std::clamp(aside, -2.0 * spacing_, 2.0 * spacing_) * line.along);
    }
    return line;
}

void SurfaceTracker::prescribe_wall_normals(const Neighbourhood& neighbourhood, const std::vector<Index>& walls)
{
    for_each_pair(neighbourhood.list(), particles_, kernel_, walls, *wall_interface_);
    const WallInterface& wall = *wall_interface_;
    const double young = std::cos(contact_angle_);
    const bool overhanging = overhangs(two_phase_, contact_angle_);
    const double kernel_at_zero = kernel_(1e-9 * h_).value;
    const double volume = dimensions_ == 2 ? spacing_ * spacing_ : spacing_ * spacing_ * spacing_;
    for (const Index c : walls) {
        const Cluster cluster = neighbourhood.list().cluster(c);
        for (Index i = cluster.first; i < cluster.first + cluster.count; ++i) {
            const auto k = static_cast<std::size_t>(i);
            if (particles_.kind[k] != Kind::wall) continue;
            fields_.delta[i] = 0.0;
            if (wall_pull_) wall_pull_->set(i, {});
            const Index parent = particles_.surface_parent[k];
            if (parent < 0) {
                fields_.colour[i] = two_phase_ ? 0.0 : 1.0;
                continue;
            }
            const Index top = particles_.place_of(parent);
            if (wall.weight_sum[top] > 1e-4 * kernel_at_zero / h_ && norm(wall.lateral_sum[top]) > 0.0 &&
                meets_surface(top)) {
                const ContactLine line = contact_line(top);
                const Vector to_top = particles_.position[top] - particles_.position[i];
                const Vector foot = line.foot + to_top;
                Vector normal = line.normal_of(young);
                double depth = 0.0;
                if (overhanging) {
                    const Vector at_foot = line.normal_of(young + line.curvature * line.height);
                    std::tie(normal, depth) = on_circle(foot, at_foot, line.curvature);
                }
                else {
                    const Vector continued = normal + line.normal_of(line.cosine);
                    if (two_phase_) {
                        const Vector at_plane = dot(line.place + to_top, line.wall_normal) * line.wall_normal;
                        const double distance =
                            dot(foot - at_plane, continued) / std::max(dot(line.along, continued), 1e-9);
                        std::tie(normal, depth) = on_circle(at_plane + distance * line.along, normal, line.curvature);
                    }
                    else
                        depth = dot(foot, continued) / std::max(norm(continued), 1e-9);
                }
                const double at_wall = std::clamp(line.cosine - line.curvature * line.height, -1.0, 1.0);
                if (wall_pull_ && i == top)
                    wall_pull_->set(i, (std::sqrt(1.0 - at_wall * at_wall) * (young - at_wall)) * line.along);
                const double colour = std::clamp(0.5 + depth / spacing_, 0.0, 1.0);
                fields_.colour[i] = colour;
                fields_.normal.set(i, normal);
                fields_.depth[i] = depth;
                fields_.delta[i] = (two_phase_ ? 1.0 : 2.0 * colour) * profile_.plane_weight(depth);
            }
            else if (two_phase_)
                fields_.colour[i] = wall.primary_sum[top] > wall.other_sum[top] ? 1.0 : 0.0;
            else
                fields_.colour[i] = wall.primary_sum[top] * volume > 0.02 ? 1.0 : 0.0;
        }
    }
}

void SurfaceTracker::find_normals(const Neighbourhood& neighbourhood)
{
    const auto sum = [&](const auto& term) {
        for_each_pair(neighbourhood.list(), particles_, kernel_, clusters(neighbourhood), term);
    };
    two_phase_ ? sum(NormalOfDepth{bounded_, dimensions_, fields_}) : sum(NormalSmoothing{bounded_, fields_});
    for_each_bounded(neighbourhood, [&](Index i) {
        if (!(fields_.delta[i] > 0.0)) return;
        const Vector normal = fields_.smoothed_normal[i];
        fields_.normal.set(i, normal);
        if (!two_phase_) fields_.delta[i] = std::max(1e-9 / h_, 2.0 * dot(fields_.colour_gradient[i], normal));
    });
}

void SurfaceTracker::fit_curvature(const Neighbourhood& neighbourhood)
{
    const double smallest = (two_phase_ ? thresholds_.curvature_two_phase : thresholds_.curvature_free_surface) / h_;
    // A drop of two spacings across is the smallest that curvature can mean anything for.
    const double greatest = (two_phase_ ? 1.0 : 0.4) / spacing_;
    const double flatness = two_phase_ ? 0.0 : 0.5 * profile_.tangential_variance();
    for_each_pair(
        neighbourhood.list(), particles_, kernel_, clusters(neighbourhood),
        TangentPlaneCurvature{bounded_, dimensions_, smallest, greatest, flatness, particles_.volume, fields_});
    if (fields_.exposure)
        for_each_pair(neighbourhood.list(), particles_, kernel_, clusters(neighbourhood),
                      Exposure{bounded_, smallest, kernel_(spacing_).value * std::pow(spacing_, dimensions_), fields_,
                               *fields_.exposure});
    if (!two_phase_)
        for_each_bounded(neighbourhood,
                         [&](Index i) { fields_.curvature_share[i] *= share_of_surface(fields_, i, h_); });
    for_each_pair(
        neighbourhood.list(), particles_, kernel_, clusters(neighbourhood),
        CurvatureSmoothing{bounded_, fields_, fields_.curvature_share, fields_.raw_curvature, fields_.curvature});
    if (two_phase_) for_each_bounded(neighbourhood, [&](Index i) { (*smoothed_curvature_)[i] = fields_.curvature[i]; });
    if (sharpens_) sharpen_curvature(neighbourhood, greatest);
}

/// Gives back what smoothing has taken from the curvature of a wave. On its way it passes four kernels of the same
/// width: the colour gradient and the smoothing of normals (between two phases depth, by a smoothed colour, and its
/// gradient), the fit, and the smoothing of the fit. Each leaves 1 − q of it, q = ½ k² ⟨x²⟩ (the fit too, where its
/// weights fall off as a Gaussian's do), so that with one more, which gives (1 − q) κ̄,   κ ← κ̄ + 4 (κ̄ − (1 − q) κ̄) = (1
/// − q)⁴ (1 + 4 q) κ = (1 − 10 q² + …) κ   is right to the second order in k h, and never more than κ. Between two
/// phases particles start on a lattice, and steps of a spacing's length are next to nothing after five kernels and five
/// times the rest after four: κ̄ is smoothed once more beforehand, and five differences are added, (1 − q)⁵ (1 + 5 q)
/// (static_drop at La 120, coarse: spurious capillary number 8.9e-5, and 1.4e-4 without that; with nothing given back
/// the second mode of oscillating_drop_2d has 0.9 of its stiffness).
void SurfaceTracker::sharpen_curvature(const Neighbourhood& neighbourhood, double greatest)
{
    const auto smooth = [&](const ScalarField& value, ScalarField& smoothed) {
        for_each_pair(neighbourhood.list(), particles_, kernel_, clusters(neighbourhood),
                      CurvatureSmoothing{bounded_, fields_, fields_.curvature_share, value, smoothed});
    };
    double kernels_passed = 4.0;
    if (two_phase_) {
        smooth(fields_.curvature, fields_.raw_curvature); // which has served
        std::swap(fields_.curvature.values, fields_.raw_curvature.values);
        ++kernels_passed;
    }
    smooth(fields_.curvature, fields_.raw_curvature);
    for_each_bounded(neighbourhood, [&](Index i) {
        const double once = fields_.curvature[i], twice = fields_.raw_curvature[i];
        if (once != 0.0) fields_.curvature[i] = std::clamp(once + kernels_passed * (once - twice), -greatest, greatest);
    });
}

} // namespace cupel::inline CUPEL_ENGINE
