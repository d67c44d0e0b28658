#pragma once

#include <cmath>
#include <cstdint>

namespace cupel
{

/// Number of a particle, a cluster or a place.
using Index = std::int32_t;

/// Three components of one scalar type: double, or Lanes where a cluster of particles is treated at once.
/// Two-dimensional scenes live in the x-z plane and keep y at zero.
template <class Scalar> struct VectorOf
{
    Scalar x{}, y{}, z{};

    VectorOf& operator+=(const VectorOf& other)
    {
        x += other.x;
        y += other.y;
        z += other.z;
        return *this;
    }
    VectorOf& operator-=(const VectorOf& other)
    {
        x -= other.x;
        y -= other.y;
        z -= other.z;
        return *this;
    }
};

template <class Scalar> VectorOf<Scalar> operator+(VectorOf<Scalar> a, const VectorOf<Scalar>& b)
{
    return a += b;
}
template <class Scalar> VectorOf<Scalar> operator-(VectorOf<Scalar> a, const VectorOf<Scalar>& b)
{
    return a -= b;
}
template <class Scalar> VectorOf<Scalar> operator*(const Scalar& factor, const VectorOf<Scalar>& a)
{
    return {factor * a.x, factor * a.y, factor * a.z};
}
template <class Scalar> Scalar dot(const VectorOf<Scalar>& a, const VectorOf<Scalar>& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Scalar> VectorOf<Scalar> cross(const VectorOf<Scalar>& a, const VectorOf<Scalar>& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double maximum(double a, double b)
{
    return a > b ? a : b;
}
inline double minimum(double a, double b)
{
    return a < b ? a : b;
}
inline double root_of_positive(double a)
{
    return std::sqrt(a);
}
inline double reciprocal_root_of_positive(double a)
{
    return 1.0 / std::sqrt(a);
}
inline double norm(const VectorOf<double>& a)
{
    return std::sqrt(dot(a, a));
}

/// Symmetric second-order tensor.
template <class Scalar> struct Symmetric3
{
    Scalar xx{}, xy{}, xz{}, yy{}, yz{}, zz{};

    /// Subtracts a ⊗ b, a and b parallel.
    void subtract_product(const VectorOf<Scalar>& a, const VectorOf<Scalar>& b)
    {
        xx -= a.x * b.x;
        xy -= a.x * b.y;
        xz -= a.x * b.z;
        yy -= a.y * b.y;
        yz -= a.y * b.z;
        zz -= a.z * b.z;
    }
};

template <class Scalar> VectorOf<Scalar> operator*(const Symmetric3<Scalar>& m, const VectorOf<Scalar>& a)
{
    return {m.xx * a.x + m.xy * a.y + m.xz * a.z, m.xy * a.x + m.yy * a.y + m.yz * a.z,
            m.xz * a.x + m.yz * a.y + m.zz * a.z};
}

using Vector = VectorOf<double>;

} // namespace cupel
