/// What meets the ends of the domain: liquid is held before walls and mirrors, and what leaves through a side that is
/// open takes no further part.
#include "integrators/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cupel::inline CUPEL_ENGINE
{

void Simulation::set_bounds()
{
    constexpr double no_limit = std::numeric_limits<double>::infinity();
    Particles& particles = *scene_.particles;
    const bool walled = particles.has("wall_normal");
    bool open = false;
    const auto reach = [&](std::size_t side) {
        const auto& boundary = scene_.definition.domain.boundaries[side];
        const bool stops = !boundary || boundary->kind == BoundaryKind::periodic ||
                           boundary->kind == BoundaryKind::symmetry || (walled && boundary->kind == BoundaryKind::wall);
        open = open || !stops;
        return stops ? no_limit : scene_.spacing;
    };
    const auto& lower = scene_.definition.domain.lower;
    const auto& upper = scene_.definition.domain.upper;
    lower_ = {lower[0] - reach(0), lower[1] - reach(2), lower[2] - reach(4)};
    upper_ = {upper[0] + reach(1), upper[1] + reach(3), upper[2] + reach(5)};
    const auto wall = [&](std::size_t side) {
        const auto& boundary = scene_.definition.domain.boundaries[side];
        const bool holds =
            boundary && ((walled && boundary->kind == BoundaryKind::wall) || boundary->kind == BoundaryKind::symmetry);
        return holds ? 0.1 * scene_.spacing : -no_limit;
    };
    wall_lower_ = {lower[0] + wall(0), lower[1] + wall(2), lower[2] + wall(4)};
    wall_upper_ = {upper[0] - wall(1), upper[1] - wall(3), upper[2] - wall(5)};
    for (const double x : {wall_lower_.x, wall_lower_.y, wall_lower_.z, wall_upper_.x, wall_upper_.y, wall_upper_.z})
        has_walls_ = has_walls_ || std::isfinite(x);
    has_walls_ = has_walls_ || scene_.definition.domain.round_walls.has_value();
    if (open) escaped_ = &particles.add_scalar({"escaped", "1"});
}

bool Simulation::outside(const Vector& p) const
{
    return p.x < lower_.x || p.x > upper_.x || p.y < lower_.y || p.y > upper_.y || p.z < lower_.z || p.z > upper_.z;
}

/// A wall's extrapolated pressure (or a mirror's image) repels liquid, but not a single particle that creeps along it
/// at no pressure at all: such a one is stopped a tenth of a spacing before the wall. What pressure has done to that
/// motion since the middle of the last kick, ½ Δt F v, no compression answers where densities are still to be found,
/// since the motion is gone; where they are found already, compression has answered for the first half of the kick to
/// come.
void Simulation::hold_before_walls(double unanswered)
{
    struct Held
    {
        double stops = 0.0, by_pressure = 0.0; // J
        Held& operator+=(const Held& other)
        {
            stops += other.stops;
            by_pressure += other.by_pressure;
            return *this;
        }
    };
    Particles& particles = *scene_.particles;
    const Held held = sum_over_moving([&](Index i) {
        Held sum;
        const auto k = static_cast<std::size_t>(i);
        const auto hold = [&](double& x, double& v, double least, double most, double Vector::*along) {
            const double before = v;
            if (x < least) {
                x = least;
                v = std::max(v, 0.0);
            }
            if (x > most) {
                x = most;
                v = std::min(v, 0.0);
            }
            if (v == before) return;
            sum.stops -= 0.5 * particles.mass[i] * before * before;
            sum.by_pressure += unanswered * flow_->pressure_force(i).*along * before;
        };
        VectorField &position = particles.position, &velocity = particles.velocity;
        hold(position.x[k], velocity.x[k], wall_lower_.x, wall_upper_.x, &Vector::x);
        hold(position.y[k], velocity.y[k], wall_lower_.y, wall_upper_.y, &Vector::y);
        hold(position.z[k], velocity.z[k], wall_lower_.z, wall_upper_.z, &Vector::z);
        if (const auto& round = scene_.definition.domain.round_walls) {
            const Vector center{round->center[0], 0.0, round->center[2]}, arm = position[i] - center;
            const double distance = norm(arm), margin = 0.1 * scene_.spacing;
            const double least = round->inner_radius ? *round->inner_radius + margin : 0.0;
            const double most = round->outer_radius ? *round->outer_radius - margin : distance;
            const double held = std::clamp(distance, least, most);
            if (held == distance) return sum;
            const Vector outward = (1.0 / distance) * arm;
            position.set(i, center + held * outward);
            const double speed = dot(velocity[i], outward);
            if (speed * (distance - held) <= 0.0) return sum;
            velocity.set(i, velocity[i] - speed * outward);
            sum.stops -= 0.5 * particles.mass[i] * speed * speed;
            sum.by_pressure += unanswered * dot(flow_->pressure_force(i), outward) * speed;
        }
        return sum;
    });
    flow_->books().stops += held.stops;
    flow_->books().imbalance += held.by_pressure;
}

/// What has flown out through a side without a wall stops there: it takes no further part in the flow. Its mass and
/// energy stay in the books.
void Simulation::retire_escaped()
{
    if (!escaped_) return;
    Particles& particles = *scene_.particles;
    bool changed = false;
    for (const Index i : neighbourhood_.moving_particles())
        if (outside(particles.position[i])) {
            (*escaped_)[i] = 1.0;
            flow_->books().stops -= energy_of_what_stops(i);
            mobility_[i] = 0.0;
            particles.kind[static_cast<std::size_t>(i)] = Kind::solid;
            particles.velocity.set(i, {});
            flow_->reset(i);
            changed = true;
        }
    if (changed) neighbourhood_.classify(particles, mobility_);
}

double Simulation::escaped_mass() const
{
    if (!escaped_) return 0.0;
    const Particles& particles = *scene_.particles;
    return ordered_sum(particles.count(), [&](Index i) { return (*escaped_)[i] * particles.mass[i]; });
}

} // namespace cupel::inline CUPEL_ENGINE
