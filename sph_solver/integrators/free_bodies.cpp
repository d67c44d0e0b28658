#include "integrators/free_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cupel::inline CUPEL_ENGINE
{

namespace
{

/// Sets that are united two by two (union-find with path halving). A set is named by its least member.
class DisjointSets
{
public:
    explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), Index{0}); }

    Index name(Index member)
    {
        while (parent(member) != member)
            member = parent(member) = parent(parent(member));
        return member;
    }
    void unite(Index a, Index b)
    {
        a = name(a);
        b = name(b);
        parent(std::max(a, b)) = std::min(a, b);
    }

private:
    Index& parent(Index member) { return parent_[static_cast<std::size_t>(member)]; }

    std::vector<Index> parent_;
};

double square(const Vector& v)
{
    return dot(v, v);
}

} // namespace

const std::vector<std::vector<Index>>& FreeBodies::find(const Neighbourhood& neighbourhood, const Particles& particles,
                                                        const ScalarField& mobility)
{
    if (found_for_ == neighbourhood.version()) return bodies_;
    found_for_ = neighbourhood.version();

    const NeighbourList& list = neighbourhood.list();
    const VectorField& position = particles.position;
    // What is nearer than this may come within the kernel's support before lists are next renewed.
    const double near = std::pow(list.support() + list.skin(), 2), touching = std::pow(list.support(), 2);
    const auto count = static_cast<std::size_t>(particles.count());
    DisjointSets bodies(count);
    std::vector<unsigned char> touches(count, 0);

    std::vector<Index> members;
    for (const Index c : neighbourhood.moving()) {
        const Cluster& cluster = list.cluster(c);
        members.clear();
        for (Index i = cluster.first; i < cluster.first + cluster.count; ++i)
            if (mobility[i] != 0.0) members.push_back(i);
        // A cluster may hold parts of several bodies, one above the other.
        for (std::size_t k = 1; k < members.size(); ++k)
            if (square(position[members[k]] - position[members[k - 1]]) < near)
                bodies.unite(members[k], members[k - 1]);
        const auto meet = [&](Index j, const Vector& place, bool is_liquid) {
            for (const Index i : members) {
                if (is_liquid && bodies.name(i) == bodies.name(j)) continue;
                const double distance = square(position[i] - place);
                if (is_liquid && distance < near) bodies.unite(i, j);
                if (!is_liquid && distance < touching) touches[static_cast<std::size_t>(i)] = 1;
            }
        };
        list.for_each_listed(c, [&](Index j) { meet(j, position[j], mobility[j] != 0.0); });
        for (const ImageRun& run : list.image_runs(c)) {
            const Image& image = list.images()[static_cast<std::size_t>(run.image)];
            for (Index j = run.first; j < run.first + run.count; ++j)
                meet(j, image.place(position[j]), mobility[j] != 0.0 && !image.mirrors());
        }
    }
    std::vector<unsigned char> body_touches(count, 0);
    for (const Index i : neighbourhood.moving_particles())
        body_touches[static_cast<std::size_t>(bodies.name(i))] |= touches[static_cast<std::size_t>(i)];

    bodies_.clear();
    std::vector<Index> number(count, -1);
    for (const Index i : neighbourhood.moving_particles()) {
        const auto name = static_cast<std::size_t>(bodies.name(i));
        if (body_touches[name]) continue;
        if (number[name] < 0) {
            number[name] = static_cast<Index>(bodies_.size());
            bodies_.emplace_back();
        }
        bodies_[static_cast<std::size_t>(number[name])].push_back(i);
    }
    return bodies_;
}

} // namespace cupel::inline CUPEL_ENGINE
