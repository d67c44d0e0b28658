#include "integrators/neighbourhood.hpp"

#include <algorithm>
#include <numeric>

namespace cupel::inline CUPEL_ENGINE
{

Neighbourhood::Neighbourhood(double support, double skin, double spacing, int dimensions)
    : list_(support, skin, spacing, dimensions)
{}

bool Neighbourhood::update(Particles& particles, const ScalarField& mobility)
{
    if (!list_.outdated(particles, moving_particles_)) return false;
    rebuild(particles, mobility);
    return true;
}

void Neighbourhood::rebuild(Particles& particles, const ScalarField& mobility)
{
    list_.build(particles);
    all_.resize(static_cast<std::size_t>(list_.cluster_count()));
    std::iota(all_.begin(), all_.end(), Index{0});
    classify(particles, mobility);
}

void Neighbourhood::classify(const Particles& particles, const ScalarField& mobility)
{
    moving_particles_.clear();
    for (Index i = 0; i < particles.count(); ++i)
        if (mobility[i] != 0.0) moving_particles_.push_back(i);

    std::vector<unsigned char> moves(all_.size()), stands(all_.size());
    const auto count = static_cast<Index>(all_.size());
#pragma omp parallel for schedule(dynamic, 256)
    for (Index c = 0; c < count; ++c) {
        const Cluster cluster = list_.cluster(c);
        bool some_moves = false, some_stands = false;
        for (Index i = cluster.first; i < cluster.first + cluster.count; ++i)
            (mobility[i] != 0.0 ? some_moves : some_stands) = true;
        const auto near = list_.neighbours(c);
        const bool touched = some_stands && (some_moves || std::any_of(near.begin(), near.end(),
                                                                       [&](Index j) { return mobility[j] != 0.0; }));
        moves[static_cast<std::size_t>(c)] = some_moves;
        stands[static_cast<std::size_t>(c)] = touched;
    }
    moving_.clear();
    standing_.clear();
    for (Index c = 0; c < count; ++c) {
        if (moves[static_cast<std::size_t>(c)]) moving_.push_back(c);
        if (stands[static_cast<std::size_t>(c)]) standing_.push_back(c);
    }
}

} // namespace cupel::inline CUPEL_ENGINE
