#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include "kernels/pair_loop.hpp"
#include "ledgers/ledger.hpp"
#include "scene/case.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// The momentum of liquid that nothing outside acts on: no gravity, no recoil, no symmetry side, and no wall or solid
/// within its reach. All forces are then between particles, Σ m v stays what it was, and how far it moves is what
/// forces without a partner have done. From the first wall that is met on there is nothing to tell: momentum is the
/// wall's to give.
class MomentumBooks
{
public:
    static bool can_tell(const Case& definition)
    {
        const auto mirrors = [](const auto& side) { return side && side->kind == BoundaryKind::symmetry; };
        const auto acts_from_outside = [](const std::string& name) {
            return name == "gravity" || name == "recoil" || name == "melting";
        };
        return std::ranges::none_of(definition.domain.boundaries, mirrors) &&
               std::ranges::none_of(definition.physics, acts_from_outside);
    }

    void begin(const Particles& particles)
    {
        start_ = momentum(particles);
        moved_ = 0.0;
        greatest_ = size(particles);
        met_ = false;
    }
    /// meets: whether a wall or a solid is within reach of what moves.
    void update(const Particles& particles, bool meets)
    {
        met_ = met_ || meets;
        if (met_) return;
        moved_ = norm(momentum(particles) - start_);
        greatest_ = std::max(greatest_, size(particles));
    }
    /// In kg m/s: from zero to |Σ m v − (Σ m v)₀|, to be judged against the greatest Σ m |v| so far.
    std::optional<Ledger> ledger() const
    {
        if (met_) return std::nullopt;
        return Ledger{0.0, moved_, 0.0, 0.0, greatest_};
    }

    void save(std::map<std::string, double>& numbers) const
    {
        numbers["momentum.x"] = start_.x;
        numbers["momentum.y"] = start_.y;
        numbers["momentum.z"] = start_.z;
        numbers["momentum.moved"] = moved_;
        numbers["momentum.greatest"] = greatest_;
        numbers["momentum.met"] = met_ ? 1.0 : 0.0;
    }
    void load(const std::map<std::string, double>& numbers)
    {
        start_ = {numbers.at("momentum.x"), numbers.at("momentum.y"), numbers.at("momentum.z")};
        moved_ = numbers.at("momentum.moved");
        greatest_ = numbers.at("momentum.greatest");
        met_ = numbers.at("momentum.met") != 0.0;
    }

private:
    static Vector momentum(const Particles& particles)
    {
        const auto along = [&](const Array& velocity) {
            return ordered_sum(particles.count(),
                               [&](Index i) { return particles.mass[i] * velocity[static_cast<std::size_t>(i)]; });
        };
        return {along(particles.velocity.x), along(particles.velocity.y), along(particles.velocity.z)};
    }
    static double size(const Particles& particles)
    {
        return ordered_sum(particles.count(), [&](Index i) { return particles.mass[i] * norm(particles.velocity[i]); });
    }

    Vector start_{};
    double moved_ = 0.0, greatest_ = 0.0;
    bool met_ = false;
};

} // namespace cupel::inline CUPEL_ENGINE
