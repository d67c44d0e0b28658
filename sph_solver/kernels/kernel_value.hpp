#pragma once

namespace cupel
{

/// Value and radial derivative of a smoothing kernel at one distance.
template <class Scalar> struct KernelValue
{
    Scalar value;           ///< W(r), 1/m³ (1/m² in two dimensions)
    Scalar gradient_over_r; ///< (1/r) dW/dr: ∇W = gradient_over_r · (x_i − x_j)
};

} // namespace cupel
