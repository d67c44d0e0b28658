#include "integrators/free_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cupel::inline CUPEL_ENGINE
{

namespace
{

/// Sets that are united two by two (union-find with path halving), each named by its least member. A member may belong
/// to the others as its image beyond a period: `offset` takes it there.
class DisjointSets
{
public:
    struct Member
    {
        Index name;
        Vector offset; ///< added to its place, puts it beside the set's least member, m
    };

    DisjointSets(std::size_t count, double reach) : parent_(count), offset_(count), endless_(count, 0), reach_(reach)
    {
        std::iota(parent_.begin(), parent_.end(), Index{0});
    }

    Member find(Index member)
    {
        Vector offset{};
        while (parent(member) != member) {
            offset_of(member) += offset_of(parent(member));
            parent(member) = parent(parent(member));
            offset += offset_of(member);
            member = parent(member);
        }
        return {member, offset};
    }
    /// Unites the sets of a and of b's image at b + shift.
    void unite(Index a, Index b, const Vector& shift)
    {
        const Member one = find(a), other = find(b);
        const Vector apart = one.offset + shift - other.offset;
        const auto least = static_cast<std::size_t>(std::min(one.name, other.name));
        if (one.name == other.name)
            endless_[least] |= is_period(apart);
        else {
            endless_[least] |= endless_[static_cast<std::size_t>(std::max(one.name, other.name))];
            const bool first = one.name < other.name;
            parent(first ? other.name : one.name) = std::min(one.name, other.name);
            offset_of(first ? other.name : one.name) = first ? apart : -1.0 * apart;
        }
    }
    /// Whether it is known already that a and b's image at b + shift belong together.
    bool are_together(Index a, Index b, const Vector& shift)
    {
        const Member one = find(a), other = find(b);
        return one.name == other.name && !is_period(one.offset + shift - other.offset);
    }
    /// Whether a set has a member and its image.
    bool is_endless(Index name) const { return endless_[static_cast<std::size_t>(name)] != 0; }

private:
    /// Sums of periods are none to round-off, or as long as a domain.
    bool is_period(const Vector& sum) const { return std::abs(sum.x) + std::abs(sum.y) + std::abs(sum.z) > reach_; }

    Index& parent(Index member) { return parent_[static_cast<std::size_t>(member)]; }
    Vector& offset_of(Index member) { return offset_[static_cast<std::size_t>(member)]; }

    std::vector<Index> parent_;
    std::vector<Vector> offset_; ///< to the parent
    std::vector<unsigned char> endless_;
    double reach_; ///< of lists, m: shorter than any period
};

double square(const Vector& v)
{
    return dot(v, v);
}

} // namespace

const std::vector<FreeBody>& FreeBodies::find(const Neighbourhood& neighbourhood, const Particles& particles,
                                              const ScalarField& mobility)
{
    if (found_for_ == neighbourhood.version()) return bodies_;
    found_for_ = neighbourhood.version();

    const NeighbourList& list = neighbourhood.list();
    const VectorField& position = particles.position;
    // What is nearer than this may come within the kernel's support before lists are next renewed.
    const double near = std::pow(list.support() + list.skin(), 2), touching = std::pow(list.support(), 2);
    const auto count = static_cast<std::size_t>(particles.count());
    DisjointSets bodies(count, list.support() + list.skin());
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
                bodies.unite(members[k], members[k - 1], {});
        const auto meet = [&](Index j, const Vector& place, bool is_liquid) {
            const Vector shift = place - position[j];
            for (const Index i : members) {
                if (is_liquid && bodies.are_together(i, j, shift)) continue;
                const double distance = square(position[i] - place);
                if (is_liquid && distance < near) bodies.unite(i, j, shift);
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
        body_touches[static_cast<std::size_t>(bodies.find(i).name)] |= touches[static_cast<std::size_t>(i)];

    bodies_.clear();
    std::vector<Index> number(count, -1);
    for (const Index i : neighbourhood.moving_particles()) {
        const auto [name, offset] = bodies.find(i);
        if (body_touches[static_cast<std::size_t>(name)]) continue;
        Index& body = number[static_cast<std::size_t>(name)];
        if (body < 0) {
            body = static_cast<Index>(bodies_.size());
            bodies_.push_back({{}, {}, bodies.is_endless(name)});
        }
        FreeBody& found = bodies_[static_cast<std::size_t>(body)];
        found.particles.push_back(i);
        found.periods.push_back(offset);
    }
    return bodies_;
}

} // namespace cupel::inline CUPEL_ENGINE
