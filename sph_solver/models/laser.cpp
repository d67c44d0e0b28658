#include "models/laser.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cupel
{

namespace
{

constexpr double footprint_in_spacings = 0.75;
constexpr double same_layer_in_spacings = 0.5;
constexpr double reach_in_radii = 2.5; // 4·10⁻⁶ of the power is further out
constexpr double excess_in_square_spacings = 0.19, by_rays_in_square_spacings = 1.0 / 32.0;

/// r₀ of the beam whose heat spreads below a surface of particles as that of the beam does below a plane, m.
double widened(double radius, double spacing)
{
    const double variance = 2.0 * (excess_in_square_spacings - by_rays_in_square_spacings) * spacing * spacing;
    return std::sqrt(radius * radius + 4.0 * variance);
}

} // namespace

LaserBeam::LaserBeam(const Laser& laser, double spacing, int dimensions)
    : laser_(laser), dimensions_(dimensions), spacing_(spacing),
      ray_spacing_(std::min(0.5 * spacing, 0.125 * laser.spot_radius)), footprint_(footprint_in_spacings * spacing),
      reach_(reach_in_radii * widened(laser.spot_radius, spacing))
{
    rays_across_ = 2 * static_cast<int>(std::ceil(reach_ / ray_spacing_));
    rays_deep_ = dimensions == 2 ? 1 : rays_across_;
    full_power_ =
        dimensions == 2 ? 2.0 * laser.power / (std::sqrt(2.0 * std::numbers::pi) * laser.spot_radius) : laser.power;
    const double radius = widened(laser.spot_radius, spacing);
    double sum = 0.0;
    for (int b = 0; b < rays_deep_; ++b)
        for (int a = 0; a < rays_across_; ++a) {
            const double x = (a + 0.5 - 0.5 * rays_across_) * ray_spacing_;
            const double y = (b + 0.5 - 0.5 * rays_deep_) * ray_spacing_;
            ray_power_.push_back(std::exp(-2.0 * (x * x + y * y) / (radius * radius)));
            sum += ray_power_.back();
        }
    for (double& power : ray_power_)
        power *= full_power_ / sum;
    rays_.resize(ray_power_.size());
}

/// visit(ray, squared distance in the plane) for each ray that passes through the candidate's disc.
template <class Visit> void LaserBeam::for_each_ray_within(const Candidate& candidate, const Visit& visit)
{
    const auto first = [&](double x, int rays) {
        return std::max(0, static_cast<int>(std::ceil((x - footprint_) / ray_spacing_ + 0.5 * rays - 0.5)));
    };
    const auto last = [&](double x, int rays) {
        return std::min(rays - 1, static_cast<int>(std::floor((x + footprint_) / ray_spacing_ + 0.5 * rays - 0.5)));
    };
    const double y_of_particle = dimensions_ == 2 ? 0.0 : candidate.y;
    for (int b = first(y_of_particle, rays_deep_); b <= last(y_of_particle, rays_deep_); ++b)
        for (int a = first(candidate.x, rays_across_); a <= last(candidate.x, rays_across_); ++a) {
            const double x = (a + 0.5 - 0.5 * rays_across_) * ray_spacing_ - candidate.x;
            const double y = (b + 0.5 - 0.5 * rays_deep_) * ray_spacing_ - y_of_particle;
            const double squared = x * x + y * y;
            if (squared <= footprint_ * footprint_)
                visit(rays_[static_cast<std::size_t>(b) * static_cast<std::size_t>(rays_across_) +
                            static_cast<std::size_t>(a)],
                      squared);
        }
}

LaserBeam::Power LaserBeam::illuminate(const Particles& particles, const ScalarField& metal, double time,
                                       double time_step, ScalarField& heating_power)
{
    const double on = std::max(time, laser_.start), off = std::min(time + time_step, laser_.off_time());
    if (!(off > on)) return {};
    const double share_of_step = (off - on) / time_step;
    const auto centre = laser_.position(0.5 * (on + off));

    candidates_.clear();
    const double reach = reach_ + footprint_;
    const auto& position = particles.position;
    for (Index i = 0; i < particles.count(); ++i) {
        const Vector p = position[i];
        const double x = p.x - centre[0], y = dimensions_ == 2 ? 0.0 : p.y - centre[1];
        if (std::abs(x) < reach && std::abs(y) < reach && metal[i] != 0.0) candidates_.push_back({i, x, y, p.z});
    }

    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::fill(rays_.begin(), rays_.end(), Ray{-infinity, infinity, -1});
    for (const Candidate& candidate : candidates_)
        for_each_ray_within(candidate, [&](Ray& ray, double) { ray.top = std::max(ray.top, candidate.z); });
    const double same_layer = same_layer_in_spacings * spacing_;
    for (const Candidate& candidate : candidates_)
        for_each_ray_within(candidate, [&](Ray& ray, double squared) {
            if (candidate.z < ray.top - same_layer) return;
            // Ties are settled by identity, so that the order of particles does not matter.
            const auto identity = [&](Index i) { return particles.identity[static_cast<std::size_t>(i)]; };
            if (squared < ray.nearest ||
                (squared == ray.nearest && identity(candidate.particle) < identity(ray.particle))) {
                ray.nearest = squared;
                ray.particle = candidate.particle;
            }
        });

    Power power{share_of_step * full_power_, 0.0, 0.0};
    for (std::size_t k = 0; k < rays_.size(); ++k)
        if (const Index i = rays_[k].particle; i >= 0) {
            const double hit = share_of_step * ray_power_[k];
            const double absorbed = laser_.absorptivity * hit;
            heating_power[i] += absorbed;
            power.hit += hit;
            power.absorbed += absorbed;
        }
    return power;
}

} // namespace cupel
