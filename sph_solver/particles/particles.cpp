#include "particles/particles.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace cupel
{

namespace
{

template <class Field> Field* find(const std::vector<std::unique_ptr<Field>>& fields, std::string_view name)
{
    for (const auto& field : fields)
        if (field->info.name == name) return field.get();
    return nullptr;
}

template <class Field> Field& get(const std::vector<std::unique_ptr<Field>>& fields, std::string_view name)
{
    if (Field* field = find(fields, name)) return *field;
    throw std::logic_error("no particle field '" + std::string(name) + "' is registered in this scene");
}

void permute_array(Array& values, Array& scratch, std::span<const Index> order)
{
    const std::size_t count = order.size();
    scratch.resize(values.size());
#pragma omp parallel for schedule(static) if (count > 8192)
    for (std::size_t k = 0; k < count; ++k)
        scratch[k] = values[static_cast<std::size_t>(order[k])];
    std::copy(values.begin() + static_cast<std::ptrdiff_t>(count), values.end(),
              scratch.begin() + static_cast<std::ptrdiff_t>(count));
    values.swap(scratch);
}

/// `scratch` has to have room for as many doubles.
template <class T> void permute_vector(std::vector<T>& values, Array& scratch, std::span<const Index> order)
{
    const std::size_t count = order.size();
    T* const sorted = reinterpret_cast<T*>(scratch.data());
#pragma omp parallel if (count > 8192)
    {
#pragma omp for schedule(static)
        for (std::size_t k = 0; k < count; ++k)
            new (sorted + k) T(values[static_cast<std::size_t>(order[k])]);
#pragma omp for schedule(static)
        for (std::size_t k = 0; k < count; ++k)
            values[k] = sorted[k];
    }
}

std::size_t padded(Index count)
{
    return static_cast<std::size_t>(count) + readable_beyond_end;
}

} // namespace

Particles::Particles(Index count)
    : count_(count), kind(static_cast<std::size_t>(count), Kind::fluid), material(static_cast<std::size_t>(count), 0),
      identity(static_cast<std::size_t>(count)), surface_parent(static_cast<std::size_t>(count), -1),
      mass(add_scalar({"mass", "kg"})), volume(add_scalar({"volume", "m3", Output::yes})),
      density(add_scalar({"density", "kg/m3", Output::yes})), pressure(add_scalar({"pressure", "Pa", Output::yes})),
      position(add_vector({"position", "m"})), velocity(add_vector({"velocity", "m/s", Output::yes}))
{
    std::iota(identity.begin(), identity.end(), Index{0});
    rebuild_places();
}

ScalarField& Particles::add_scalar(const FieldInfo& info, double initial)
{
    if (ScalarField* field = find(scalars_, info.name)) return *field;
    if (find(vectors_, info.name)) throw std::logic_error("particle field '" + info.name + "' is a vector");
    scalars_.push_back(std::make_unique<ScalarField>(ScalarField{info, Array(padded(count_), initial)}));
    return *scalars_.back();
}

VectorField& Particles::add_vector(const FieldInfo& info)
{
    if (VectorField* field = find(vectors_, info.name)) return *field;
    if (find(scalars_, info.name)) throw std::logic_error("particle field '" + info.name + "' is a scalar");
    const Array zero(padded(count_), 0.0);
    vectors_.push_back(std::make_unique<VectorField>(VectorField{info, zero, zero, zero}));
    return *vectors_.back();
}

bool Particles::has(std::string_view name) const
{
    return find(scalars_, name) || find(vectors_, name);
}

ScalarField& Particles::scalar(std::string_view name)
{
    return get(scalars_, name);
}
const ScalarField& Particles::scalar(std::string_view name) const
{
    return get(scalars_, name);
}
VectorField& Particles::vector(std::string_view name)
{
    return get(vectors_, name);
}
const VectorField& Particles::vector(std::string_view name) const
{
    return get(vectors_, name);
}

void Particles::permute(std::span<const Index> order)
{
    for (const auto& field : scalars_)
        permute_array(field->values, scratch_, order);
    for (const auto& field : vectors_)
        for (Array* component : {&field->x, &field->y, &field->z})
            permute_array(*component, scratch_, order);
    permute_vector(kind, scratch_, order);
    permute_vector(material, scratch_, order);
    permute_vector(identity, scratch_, order);
    permute_vector(surface_parent, scratch_, order);
    rebuild_places();
}

void Particles::rebuild_places()
{
    place_of_identity_.resize(identity.size());
#pragma omp parallel for schedule(static) if (identity.size() > 8192)
    for (std::size_t k = 0; k < identity.size(); ++k)
        place_of_identity_[static_cast<std::size_t>(identity[k])] = static_cast<Index>(k);
}

std::size_t Particles::bytes() const
{
    const std::size_t doubles = scalars_.size() + 3 * vectors_.size();
    return padded(count_) * doubles * sizeof(double) +
           static_cast<std::size_t>(count_) * (sizeof(Kind) + 1 + 3 * sizeof(Index));
}

} // namespace cupel
