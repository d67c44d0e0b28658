#include "integrators/neighbourhood.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace cupel::inline CUPEL_ENGINE
{

Neighbourhood::Neighbourhood(double support, double skin, double spacing, int dimensions, Images images)
    : list_(support, skin, spacing, dimensions, std::move(images))
{}

void Neighbourhood::compute_everywhere()
{
    computes_everywhere_ = true;
    list_.skip_nothing();
}

void Neighbourhood::update(Particles& particles, const ScalarField& mobility)
{
    if (!list_.outdated(particles, moving_particles_)) return;
    if (lists_everywhere_ || !list_.refresh(particles, wandered_)) {
        rebuild(particles, mobility);
        return;
    }
    forget_wanderers();
    classify(particles, mobility);
}

void Neighbourhood::rebuild(Particles& particles, const ScalarField& mobility)
{
    list_.build(particles);
    all_.resize(static_cast<std::size_t>(list_.cluster_count()));
    std::iota(all_.begin(), all_.end(), Index{0});
    forget_wanderers();
    classify(particles, mobility);
}

std::vector<Index> Neighbourhood::moving_near(std::span<const Index> clusters) const
{
    std::vector<Index> found;
    if (clusters.empty()) return found;
    const std::vector<unsigned char> near = list_.seen_from(clusters);
    for (const Index c : moving_)
        if (near[static_cast<std::size_t>(c)]) found.push_back(c);
    return found;
}

void Neighbourhood::forget_wanderers()
{
    wandered_.clear();
    has_wandered_.assign(all_.size(), 0);
}

bool Neighbourhood::meets_what_stands(const Particles& particles, const ScalarField& mobility) const
{
    if (standing_.empty()) return false;
    const double reach = list_.support() * list_.support();
    for (const Index c : moving_) {
        const Cluster& cluster = list_.cluster(c);
        bool meets = false;
        list_.for_each_listed(c, [&](Index j) {
            if (mobility[j] != 0.0) return;
            for (Index i = cluster.first; i < cluster.first + cluster.count; ++i) {
                const Vector offset = particles.position[i] - particles.position[j];
                meets = meets || (mobility[i] != 0.0 && dot(offset, offset) < reach);
            }
        });
        if (meets) return true;
    }
    return false;
}

void Neighbourhood::classify(const Particles& particles, const ScalarField& mobility)
{
    ++version_;
    moving_particles_.clear();
    std::vector<unsigned char> moves(all_.size(), 0), touched(all_.size(), 0);
    for (Index i = 0; i < particles.count(); ++i)
        if (mobility[i] != 0.0) {
            moving_particles_.push_back(i);
            moves[static_cast<std::size_t>(list_.cluster_of(i))] = 1;
        }
    moving_.clear();
    for (const Index c : all_)
        if (moves[static_cast<std::size_t>(c)]) moving_.push_back(c);

    // What is near is near from either side: what stands beside something that moves is in its list.
    const bool something_stands = moving_particles_.size() < static_cast<std::size_t>(particles.count());
    for (const Index c : moving_) {
        if (something_stands)
            list_.for_each_neighbour(c, [&](Index j) {
                if (mobility[j] == 0.0) touched[static_cast<std::size_t>(list_.cluster_of(j))] = 1;
            });
        auto& wandered = has_wandered_[static_cast<std::size_t>(c)];
        if (!wandered) wandered_.push_back(c);
        wandered = 1;
    }
    standing_.clear();
    for (const Index c : all_)
        if (touched[static_cast<std::size_t>(c)]) standing_.push_back(c);
    if (computes_everywhere_) moving_ = standing_ = all_;
    working_.clear();
    std::set_union(moving_.begin(), moving_.end(), standing_.begin(), standing_.end(), std::back_inserter(working_));
}

} // namespace cupel::inline CUPEL_ENGINE
