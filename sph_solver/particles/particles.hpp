#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "math/vector.hpp"

namespace cupel
{

/// Allocates on cache lines, so that a cluster's load touches as few of them as possible.
template <class T> struct CacheLineAllocator
{
    using value_type = T;
    static constexpr std::align_val_t alignment{64};

    CacheLineAllocator() = default;
    template <class U> CacheLineAllocator(const CacheLineAllocator<U>&) {}
    T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), alignment)); }
    void deallocate(T* pointer, std::size_t) { ::operator delete(pointer, alignment); }
    bool operator==(const CacheLineAllocator&) const = default;
};

using Array = std::vector<double, CacheLineAllocator<double>>;

/// What a particle is. A solid particle is metal that may melt; a wall particle never moves and never melts.
enum class Kind : std::uint8_t { fluid = 0, solid = 1, wall = 2 };

/// Whether a field goes into the VTK snapshots. Every field is sorted and checkpointed, whatever it is.
enum class Output : bool { no, yes };

struct FieldInfo
{
    std::string name;
    std::string unit;
    Output output = Output::no;
};

struct ScalarField
{
    FieldInfo info;
    Array values;

    double operator[](Index i) const { return values[static_cast<std::size_t>(i)]; }
    double& operator[](Index i) { return values[static_cast<std::size_t>(i)]; }
};

struct VectorField
{
    FieldInfo info;
    Array x, y, z;

    Vector operator[](Index i) const
    {
        const auto k = static_cast<std::size_t>(i);
        return {x[k], y[k], z[k]};
    }
    void set(Index i, const Vector& a)
    {
        const auto k = static_cast<std::size_t>(i);
        x[k] = a.x;
        y[k] = a.y;
        z[k] = a.z;
    }
};

/// Values that stay readable beyond the end of a field, so that the last cluster can be loaded whole.
inline constexpr int readable_beyond_end = 16;

/// All particles of a scene as a structure of arrays. Models register the fields that they need; a registered field
/// is sorted, checkpointed and (on request) written without further code, and references to it stay valid.
class Particles
{
    Index count_;
    std::vector<std::unique_ptr<ScalarField>> scalars_;
    std::vector<std::unique_ptr<VectorField>> vectors_;
    std::vector<Index> place_of_identity_;
    Array scratch_;

public:
    explicit Particles(Index count);

    Index count() const { return count_; }

    /// Registers a field, or returns the one already registered under this name (SI units; throws
    /// std::logic_error where the name is taken by a field of the other rank).
    ScalarField& add_scalar(const FieldInfo& info, double initial = 0.0);
    VectorField& add_vector(const FieldInfo& info);

    bool has(std::string_view name) const;
    /// Throws std::logic_error where no such field is registered.
    ScalarField& scalar(std::string_view name);
    const ScalarField& scalar(std::string_view name) const;
    VectorField& vector(std::string_view name);
    const VectorField& vector(std::string_view name) const;

    const std::vector<std::unique_ptr<ScalarField>>& scalars() const { return scalars_; }
    const std::vector<std::unique_ptr<VectorField>>& vectors() const { return vectors_; }

    /// Puts particle order[k] in place k, in every field.
    void permute(std::span<const Index> order);

    /// The place that the particle with this identity has now.
    Index place_of(Index identity) const { return place_of_identity_[static_cast<std::size_t>(identity)]; }
    /// After identity[] was set from outside (a checkpoint).
    void rebuild_places();

    std::size_t bytes() const;

    std::vector<Kind> kind;
    /// Index into the scene's list of materials.
    std::vector<std::uint8_t> material;
    /// A particle's number at the start, the same through all sorting.
    std::vector<Index> identity;
    /// Identity of the particle of the wall's surface layer that stands for this wall particle; −1 elsewhere.
    std::vector<Index> surface_parent;

    ScalarField& mass;
    ScalarField& volume;
    ScalarField& density;
    ScalarField& pressure;
    VectorField& position;
    VectorField& velocity;
};

} // namespace cupel
