#include "kernels/smoothing_kernel.hpp"
#include "kernels/wendland_c2.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace cupel
{
namespace
{

constexpr double pi = std::numbers::pi;

class KernelIn : public testing::TestWithParam<int>
{
protected:
    int dimensions() const { return GetParam(); }
    double measure(double r) const { return dimensions() == 2 ? 2.0 * pi * r : 4.0 * pi * r * r; }

    /// ∫ f(r) W(r) over space, by the midpoint rule.
    template <class Kernel, class Function> double integral(const Kernel& kernel, const Function& f) const
    {
        constexpr int intervals = 20000;
        const double step = kernel.support() / intervals;
        double sum = 0.0;
        for (int k = 0; k < intervals; ++k) {
            const double r = (k + 0.5) * step;
            sum += step * measure(r) * f(r) * kernel(r).value;
        }
        return sum;
    }
    template <class Kernel> double fourier_transform(const Kernel& kernel, double k) const
    {
        return integral(kernel, [&](double r) {
            return dimensions() == 2 ? std::cyl_bessel_j(0.0, k * r) : std::sin(k * r) / (k * r);
        });
    }

    /// Root mean square errors of ΣW = 1 and −Σ∇W ⊗ r = 1 over lattices of spacing 1 that are stretched by exp(s) along
    /// one axis, in all directions alike, and compressed across it, so that their volume stays.
    template <class Kernel> std::array<double, 2> errors_on_stretched_lattice(const Kernel& kernel, double s) const
    {
        std::array<double, 2> sum{};
        const int directions = s == 0.0 ? 1 : 16;
        for (int d = 0; d < directions; ++d) {
            const double turn = pi * d / directions, tilt = dimensions() == 2 ? 0.0 : 0.9 * d;
            const std::array<double, 3> axis{std::cos(turn) * std::cos(tilt), std::sin(tilt),
                                             std::sin(turn) * std::cos(tilt)};
            const double along = std::exp(s), across = std::exp(-s / (dimensions() - 1));
            double filling = 0.0;
            std::array<double, 9> moment{};
            constexpr int reach = 5;
            const int flat = dimensions() == 2 ? 0 : reach;
            for (int a = -reach; a <= reach; ++a)
                for (int b = -flat; b <= flat; ++b)
                    for (int c = -reach; c <= reach; ++c) {
                        const double on_axis = axis[0] * a + axis[1] * b + axis[2] * c;
                        std::array<double, 3> x{across * a, across * b, across * c};
                        for (std::size_t k = 0; k < 3; ++k)
                            x[k] += (along - across) * on_axis * axis[k];
                        const auto w = kernel(std::hypot(x[0], x[1], x[2]));
                        filling += w.value;
                        for (std::size_t k = 0; k < 9; ++k)
                            moment[k] -= w.gradient_over_r * x[k / 3] * x[k % 3];
                    }
            sum[0] += (filling - 1.0) * (filling - 1.0) / directions;
            for (std::size_t k = 0; k < 9; ++k) {
                const bool diagonal = k % 4 == 0 && !(dimensions() == 2 && k == 4);
                const double error = moment[k] - (diagonal ? 1.0 : 0.0);
                sum[1] += error * error / dimensions() / directions;
            }
        }
        return {std::sqrt(sum[0]), std::sqrt(sum[1])};
    }
};

template <class Kernel> void expect_gradient_of_value(const Kernel& kernel)
{
    const double h = kernel.smoothing_length(), step = 1e-5 * h;
    for (double r = 0.05 * h; r < kernel.support(); r += 0.1 * h) {
        const double slope = (kernel(r + step).value - kernel(r - step).value) / (2.0 * step);
        EXPECT_NEAR(r * kernel(r).gradient_over_r, slope, 1e-8 * kernel(step).value / h) << "at " << r / h << " h";
    }
    EXPECT_EQ(kernel(1.0001 * kernel.support()).value, 0.0);
    EXPECT_EQ(kernel(1.0001 * kernel.support()).gradient_over_r, 0.0);
}

TEST_P(KernelIn, IsNormalisedAndItsGradientIsTheDerivative)
{
    const auto one = [](double) { return 1.0; };
    for (const char* name : {"root_free", "quintic_spline"}) {
        const SmoothingKernel kernel(name, 0.02, dimensions());
        EXPECT_DOUBLE_EQ(kernel.support(), 0.06);
        EXPECT_NEAR(integral(kernel, one), 1.0, 1e-7) << name;
        expect_gradient_of_value(kernel);
    }
    const WendlandC2 wendland(0.02, dimensions());
    EXPECT_NEAR(integral(wendland, one), 1.0, 1e-7);
    expect_gradient_of_value(wendland);
}

TEST_P(KernelIn, WithoutRootsIsAsWideAsTheQuinticSpline)
{
    const RootFree kernel(1.0, dimensions());
    const QuinticSpline spline(1.0, dimensions());
    const auto variance = [&](const auto& w) { return integral(w, [&](double r) { return r * r / dimensions(); }); };
    EXPECT_NEAR(variance(kernel), variance(spline), 0.003);
    EXPECT_NEAR(kernel(0.0).value / kernel(1.0).value, spline(0.0).value / spline(1.0).value, 0.08);
}

TEST_P(KernelIn, SumsHoldOnLatticesThatAreDeformed)
{
    const RootFree kernel(1.0, dimensions());
    const QuinticSpline spline(1.0, dimensions());
    for (const double strain : {0.0, 0.05, 0.1, 0.15}) {
        const auto error = errors_on_stretched_lattice(kernel, strain);
        const auto of_spline = errors_on_stretched_lattice(spline, strain);
        EXPECT_LT(error[0], 2.5e-4) << strain;
        EXPECT_LT(error[1], 2e-3) << strain;
        // Gradients are as good as the spline's on the whole; a single power of 1 − r²/R² has three times its error.
        EXPECT_LT(error[1], 2.0 * of_spline[1]) << strain;
    }
}

/// Particles that a kernel does not resist draw together in pairs (Dehnen & Aly 2012).
TEST_P(KernelIn, ResistsEveryWaveThatALatticeCanShowAlongItsAxes)
{
    const RootFree kernel(1.0, dimensions());
    for (double k = 0.1; k <= 4.6; k += 0.1) // the shortest such wave has k = π
        EXPECT_GT(fourier_transform(kernel, k), 0.0) << k;
}

INSTANTIATE_TEST_SUITE_P(Dimensions, KernelIn, testing::Values(2, 3));

} // namespace
} // namespace cupel
