#include "scene/even_out.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticPointLocator.h>

#include "kernels/root_free.hpp"

namespace cupel
{

namespace
{

/// Neighbours of each of the first places within a distance: those that come after it.
std::vector<std::vector<std::size_t>> neighbours_of(const std::vector<Vector>& places, std::size_t count,
                                                    double distance)
{
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const Vector& place : places)
        points->InsertNextPoint(place.x, place.y, place.z);
    vtkNew<vtkPolyData> cloud;
    cloud->SetPoints(points);
    vtkNew<vtkStaticPointLocator> locator;
    locator->SetDataSet(cloud);
    locator->BuildLocator();
    std::vector<std::vector<std::size_t>> neighbours(count);
    vtkNew<vtkIdList> found;
    for (std::size_t i = 0; i < count; ++i) {
        const double place[3]{places[i].x, places[i].y, places[i].z};
        locator->FindPointsWithinRadius(distance, place, found);
        for (vtkIdType k = 0; k < found->GetNumberOfIds(); ++k)
            if (const auto j = static_cast<std::size_t>(found->GetId(k)); j > i) neighbours[i].push_back(j);
        std::sort(neighbours[i].begin(), neighbours[i].end()); // sums are the same whatever the search
    }
    return neighbours;
}

/// The places of a ball's particles, and after them the mirror images of those within `reach` of its surface.
class WithImages
{
public:
    WithImages(const std::vector<Vector>& places, double radius, double reach)
        : count_(places.size()), radius_(radius), places_(places)
    {
        const double ball = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
        volumes_.assign(count_, ball / static_cast<double>(count_));
        for (std::size_t i = 0; i < count_; ++i)
            if (const double r = norm(places[i]); r > radius - reach && r > 0.0) imaged_.push_back(i);
        places_.resize(count_ + imaged_.size());
        volumes_.resize(places_.size());
        mirror();
    }

    const std::vector<Vector>& places() const { return places_; }
    const std::vector<double>& volumes() const { return volumes_; }
    void move_to(const std::vector<Vector>& places)
    {
        std::copy(places.begin(), places.end(), places_.begin());
        mirror();
    }

private:
    void mirror()
    {
        for (std::size_t k = 0; k < imaged_.size(); ++k) {
            const std::size_t i = imaged_[k];
            const double stretch = 2.0 * radius_ / norm(places_[i]) - 1.0;
            places_[count_ + k] = stretch * places_[i];
            volumes_[count_ + k] = stretch * stretch * volumes_[i];
        }
    }

    std::size_t count_;
    double radius_;
    std::vector<Vector> places_;
    std::vector<double> volumes_;
    std::vector<std::size_t> imaged_;
};

} // namespace

void even_out(std::vector<Vector>& places, double radius, double spacing)
{
    constexpr int searches = 6, sweeps_between = 50;
    constexpr double rate = 0.1, greatest_move = 0.1;
    const std::size_t count = places.size();
    const RootFree kernel(spacing, 3);
    const auto formula = kernel.in<double>();
    const double near = std::pow(0.2, 0.25) / kernel(spacing).value;
    double outermost = 0.0;
    for (const Vector& place : places)
        outermost = std::max(outermost, norm(place));
    std::vector<std::size_t> on_surface;
    for (std::size_t i = 0; i < count; ++i)
        if (norm(places[i]) > outermost * (1.0 - 1e-9)) on_surface.push_back(i);

    std::vector<Vector> gradients(count); // Σ [1 + …] V ∇W, 1/m
    // Between two searches no place moves by more than a quarter of a spacing.
    const double reach = kernel.support() + 0.5 * spacing;
    for (int search = 0; search < searches; ++search) {
        WithImages liquid(places, radius, reach);
        const auto neighbours = neighbours_of(liquid.places(), count, reach);
        for (int sweep = 0; sweep < sweeps_between; ++sweep) {
            std::fill(gradients.begin(), gradients.end(), Vector{});
            for (std::size_t i = 0; i < count; ++i)
                for (const std::size_t j : neighbours[i]) {
                    const Vector offset = liquid.places()[i] - liquid.places()[j];
                    const auto [value, gradient_over_r] = formula(dot(offset, offset));
                    const double closeness = near * value, square = closeness * closeness;
                    const Vector of_pair = ((1.0 + square * square) * gradient_over_r) * offset;
                    gradients[i] += liquid.volumes()[j] * of_pair;
                    if (j < count) gradients[j] -= liquid.volumes()[i] * of_pair;
                }
            for (std::size_t i = 0; i < count; ++i) {
                const Vector move = (-rate * spacing * spacing) * gradients[i];
                const double length = norm(move), greatest = greatest_move * spacing;
                places[i] += length > greatest ? (greatest / length) * move : move;
            }
            for (const std::size_t i : on_surface)
                places[i] = (outermost / norm(places[i])) * places[i];
            liquid.move_to(places);
        }
    }
}

} // namespace cupel
