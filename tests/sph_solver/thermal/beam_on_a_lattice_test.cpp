/// Why a beam of rays is wider than the beam (laser.hpp): what a half space of particles answers to a flux cos(kx).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>

#include "kernels/root_free.hpp"

namespace cupel
{
namespace
{

/// Layers of a cubic lattice below a surface, spacing and conductivity 1, as heat_conduction.hpp sees them.
class HalfSpace
{
public:
    explicit HalfSpace(int dimensions) : dimensions_(dimensions), kernel_(1.0, dimensions)
    {
        for (int m = 0; m < layers; ++m) {
            double filling = 0.0;
            for (int n = std::max(0, m - reach); n <= m + reach; ++n)
                for_each_in_layer(n - m, [&](int, const KernelValue<double>& w) { filling += w.value; });
            completeness_[static_cast<std::size_t>(m)] = 1.0 / std::sqrt(filling);
        }
    }

    /// How much further down, in spacings, the answer to a flux cos(kx) seems to be than e^{kz}/k: the logarithm of
    /// their ratio over k, below the first layers.
    double shift(double k) const
    {
        Eigen::MatrixXd leaving = Eigen::MatrixXd::Zero(layers, layers);
        for (int m = 0; m < layers; ++m)
            for (int n = std::max(0, m - reach); n <= std::min(layers - 1, m + reach); ++n)
                for_each_in_layer(n - m, [&](int x, const KernelValue<double>& w) {
                    const double flow = -2.0 * completeness_[static_cast<std::size_t>(m)] *
                                        completeness_[static_cast<std::size_t>(n)] * w.gradient_over_r;
                    leaving(m, m) += flow;
                    leaving(m, n) -= flow * std::cos(k * x);
                });
        const Eigen::VectorXd temperature = leaving.partialPivLu().solve(Eigen::VectorXd::Unit(layers, 0));
        constexpr int below = 5;
        return std::log(temperature[below] * k * std::exp(k * (below + 0.5))) / k;
    }

private:
    static constexpr int layers = 120, reach = 3;

    template <class Visit> void for_each_in_layer(int height, const Visit& visit) const
    {
        const int across = dimensions_ == 2 ? 0 : reach;
        for (int x = -reach; x <= reach; ++x)
            for (int y = -across; y <= across; ++y)
                visit(x, kernel_(std::sqrt(double(x * x + y * y + height * height))));
    }

    int dimensions_;
    RootFree kernel_;
    std::array<double, layers> completeness_{};
};

TEST(BeamOnALattice, FluxesThatVaryLeaveTooMuchHeatBelow)
{
    for (const int dimensions : {2, 3}) {
        const HalfSpace half_space(dimensions);
        const double slow = half_space.shift(0.1), fast = half_space.shift(0.4);
        EXPECT_NEAR((fast - slow) / 0.3, 0.19, 0.008) << dimensions; // what laser.cpp makes up for
        EXPECT_NEAR(slow - 0.1 * 0.19, 0.011, 0.003) << dimensions;  // what it does not: the outermost layers' lack
    }
}

} // namespace
} // namespace cupel
