#pragma once

#include <cmath>

namespace cupel
{

/// Σ W over a lattice, 1/m³ (1/m² in two dimensions): near one over a particle's volume, and not quite. `kernel` has
/// support() in m and kernel(r).value.
template <class Kernel> double sum_over_lattice(const Kernel& kernel, double spacing, int dimensions)
{
    const int reach = static_cast<int>(std::ceil(kernel.support() / spacing)), across = dimensions == 2 ? 0 : reach;
    double sum = 0.0;
    for (int x = -reach; x <= reach; ++x)
        for (int y = -across; y <= across; ++y)
            for (int z = -reach; z <= reach; ++z)
                if (const double r = spacing * std::sqrt(x * x + y * y + z * z); r < kernel.support())
                    sum += kernel(r).value;
    return sum;
}

} // namespace cupel
