#pragma once

#include <string_view>

#include "kernels/quintic_spline.hpp"
#include "kernels/root_free.hpp"

namespace cupel
{

/// The solver's kernel: the one that a case names. Both reach 3 h.
class SmoothingKernel
{
public:
    /// name: "root_free" or "quintic_spline"; smoothing_length in m.
    SmoothingKernel(std::string_view name, double smoothing_length, int dimensions)
        : root_free_(smoothing_length, dimensions), spline_(smoothing_length, dimensions),
          is_spline_(name == "quintic_spline")
    {}

    double smoothing_length() const { return root_free_.smoothing_length(); }
    double support() const { return root_free_.support(); }

    /// Of r² in m², above zero; zero beyond the support.
    template <class Number> struct Formula
    {
        RootFree::Formula<Number> root_free;
        QuinticSpline::Formula<Number> spline;
        bool is_spline;

        template <class Scalar> KernelValue<Scalar> operator()(const Scalar& square) const
        {
            return is_spline ? spline(square) : root_free(square);
        }
        /// The kernel without roots where it is that one, else null.
        const RootFree::Formula<Number>* without_roots() const { return is_spline ? nullptr : &root_free; }
    };
    /// In the precision that pairs are summed in: constants that a loop had to convert would hold it up.
    template <class Number> Formula<Number> in() const
    {
        return {root_free_.in<Number>(), spline_.in<Number>(), is_spline_};
    }
    KernelValue<double> operator()(double r) const { return is_spline_ ? spline_(r) : root_free_(r); }

private:
    RootFree root_free_;
    QuinticSpline spline_;
    bool is_spline_;
};

} // namespace cupel
