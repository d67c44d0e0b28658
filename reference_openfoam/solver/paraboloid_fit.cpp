#include "paraboloid_fit.hpp"

#include <cmath>

namespace cupel
{
ParaboloidFit::ParaboloidFit(const vector& origin, const vector& outward, int flat_axis)
    : origin_(origin), z_(outward), planar_(flat_axis >= 0), y_(Zero)
{
    // any direction that is not the normal's leads to a pair across it; in a plane the one that is not there
    int least = flat_axis;
    if (!planar_) {
        least = 0;
        for (int axis = 1; axis < 3; ++axis)
            if (mag(z_[axis]) < mag(z_[least])) least = axis;
    }
    y_[least] = 1;
    y_ -= (y_ & z_) * z_;
    y_ /= mag(y_);
    x_ = y_ ^ z_;
}

bool ParaboloidFit::fit(const std::vector<vector>& points, const std::vector<scalar>& weights)
{
    const int n = terms();
    if (int(points.size()) < n) return false;
    scalar matrix[6][7] = {};
    for (std::size_t i = 0; i < points.size(); ++i) {
        const vector from = points[i] - origin_;
        const scalar x = from & x_, y = from & y_, z = from & z_;
        const scalar in_space[6] = {1, x, y, x * x, x * y, y * y}, in_plane[3] = {1, x, x * x};
        const scalar* const basis = planar_ ? in_plane : in_space;
        for (int row = 0; row < n; ++row) {
            for (int column = 0; column < n; ++column)
                matrix[row][column] += weights[i] * basis[row] * basis[column];
            matrix[row][n] += weights[i] * basis[row] * z;
        }
    }
    // Gauss-Jordan; a pivot far below its diagonal says that the points lie on a curve
    for (int k = 0; k < n; ++k) {
        int pivot = k;
        for (int row = k + 1; row < n; ++row)
            if (mag(matrix[row][k]) > mag(matrix[pivot][k])) pivot = row;
        if (mag(matrix[pivot][k]) < 1e-6 * matrix[0][0]) return false;
        for (int column = 0; column <= n; ++column)
            std::swap(matrix[k][column], matrix[pivot][column]);
        for (int row = 0; row < n; ++row) {
            if (row == k) continue;
            const scalar factor = matrix[row][k] / matrix[k][k];
            for (int column = k; column <= n; ++column)
                matrix[row][column] -= factor * matrix[k][column];
        }
    }
    scalar solution[6] = {};
    for (int k = 0; k < n; ++k)
        solution[k] = matrix[k][n] / matrix[k][k];
    const int place_in_plane[3] = {0, 1, 3};
    for (int k = 0; k < 6; ++k)
        c_[k] = planar_ ? 0 : solution[k];
    for (int k = 0; k < 3 && planar_; ++k)
        c_[place_in_plane[k]] = solution[k];
    return true;
}

scalar ParaboloidFit::curvature() const
{
    const scalar numerator = c_[3] * (1 + sqr(c_[2])) + c_[5] * (1 + sqr(c_[1])) - c_[4] * c_[1] * c_[2];
    return -2 * numerator / std::pow(1 + sqr(c_[1]) + sqr(c_[2]), 1.5);
}

scalar ParaboloidFit::bend_beyond(const vector& point) const
{
    const scalar x = (point - origin_) & x_, y = (point - origin_) & y_;
    const scalar square = c_[3] * x * x + c_[4] * x * y + c_[5] * y * y;
    const scalar slope = sqr(2 * c_[3] * x + c_[4] * y) + sqr(c_[4] * x + 2 * c_[5] * y);
    return 0.25 * square * min(slope, scalar(1));
}

vector ParaboloidFit::normal(const vector& point) const
{
    const scalar x = (point - origin_) & x_, y = (point - origin_) & y_;
    const vector along = z_ - (c_[1] + 2 * c_[3] * x + c_[4] * y) * x_ - (c_[2] + c_[4] * x + 2 * c_[5] * y) * y_;
    return along / mag(along);
}
} // namespace cupel
