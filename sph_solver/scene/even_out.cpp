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

/// Places that are moved, and after them some that are not.
class WithFixed
{
public:
    WithFixed(const std::vector<Vector>& places, const std::vector<Vector>& fixed, double volume) : places_(places)
    {
        places_.insert(places_.end(), fixed.begin(), fixed.end());
        volumes_.assign(places_.size(), volume);
    }

    const std::vector<Vector>& places() const { return places_; }
    const std::vector<double>& volumes() const { return volumes_; }
    void move_to(const std::vector<Vector>& places) { std::copy(places.begin(), places.end(), places_.begin()); }

private:
    std::vector<Vector> places_;
    std::vector<double> volumes_;
};

/// What a sweep moves places by: what shifting would, or what makes volumes equal, for which it needs their excess.
enum class Aim { even_places, equal_volumes };

/// The sweeps. `surround(reach)` is the places with what surrounds them within `reach`, made anew for each search for
/// neighbours; `hold` takes places back to where they must stay after each sweep. Returns the mean of 1/Σ W over the
/// places as they were before the last sweep (in two dimensions an area), where volumes are made equal.
template <class Surround, class Hold>
double sweep(std::vector<Vector>& places, double spacing, int dimensions, Aim aim, const Surround& surround,
             const Hold& hold)
{
    constexpr int searches = 6, sweeps_between = 50;
    constexpr double greatest_move = 0.1;
    const bool volumes_count = aim == Aim::equal_volumes;
    const double rate = volumes_count ? 1.0 : 0.1;
    const std::size_t count = places.size();
    const RootFree kernel(spacing, dimensions);
    const auto formula = kernel.in<double>();
    const double near = std::pow(0.2, 0.25) / kernel(spacing).value, at_zero = kernel(1e-9 * spacing).value;
    std::vector<Vector> gradients(count); // Σ [1 + …] V ∇W, 1/m
    std::vector<double> excess;           // Σ V W less its mean; 0 for what is not moved
    double mean_volume = 0.0;
    // Between two searches no place moves by more than a quarter of a spacing.
    const double reach = kernel.support() + 0.5 * spacing;
    for (int search = 0; search < searches; ++search) {
        auto all = surround(reach);
        const auto neighbours = neighbours_of(all.places(), count, reach);
        const auto for_pairs = [&](const auto& visit) {
            for (std::size_t i = 0; i < count; ++i)
                for (const std::size_t j : neighbours[i]) {
                    const Vector offset = all.places()[i] - all.places()[j];
                    visit(i, j, offset, formula(dot(offset, offset)));
                }
        };
        for (int step = 0; step < sweeps_between; ++step) {
            if (volumes_count) {
                excess.assign(all.places().size(), 0.0);
                for (std::size_t i = 0; i < count; ++i)
                    excess[i] = all.volumes()[i] * at_zero;
                for_pairs([&](std::size_t i, std::size_t j, const Vector&, const auto& w) {
                    excess[i] += all.volumes()[j] * w.value;
                    if (j < count) excess[j] += all.volumes()[i] * w.value;
                });
                double sum = 0.0;
                mean_volume = 0.0;
                for (std::size_t i = 0; i < count; ++i) {
                    sum += excess[i];
                    mean_volume += all.volumes()[i] / excess[i] / static_cast<double>(count);
                }
                for (std::size_t i = 0; i < count; ++i)
                    excess[i] -= sum / static_cast<double>(count);
            }
            std::fill(gradients.begin(), gradients.end(), Vector{});
            for_pairs([&](std::size_t i, std::size_t j, const Vector& offset, const auto& w) {
                const double closeness = near * w.value, square = closeness * closeness;
                const double weight = volumes_count ? excess[i] + excess[j] : 1.0 + square * square;
                const Vector of_pair = (weight * w.gradient_over_r) * offset;
                gradients[i] += all.volumes()[j] * of_pair;
                if (j < count) gradients[j] -= all.volumes()[i] * of_pair;
            });
            for (std::size_t i = 0; i < count; ++i) {
                const Vector move = (-rate * spacing * spacing) * gradients[i];
                const double length = norm(move), greatest = greatest_move * spacing;
                places[i] += length > greatest ? (greatest / length) * move : move;
            }
            hold();
            all.move_to(places);
        }
    }
    return mean_volume;
}

} // namespace

void even_out(std::vector<Vector>& places, double radius, double spacing)
{
    double outermost = 0.0;
    for (const Vector& place : places)
        outermost = std::max(outermost, norm(place));
    std::vector<std::size_t> on_surface;
    for (std::size_t i = 0; i < places.size(); ++i)
        if (norm(places[i]) > outermost * (1.0 - 1e-9)) on_surface.push_back(i);
    sweep(
        places, spacing, 3, Aim::even_places, [&](double reach) { return WithImages(places, radius, reach); },
        [&] {
            for (const std::size_t i : on_surface)
                places[i] = (outermost / norm(places[i])) * places[i];
        });
}

double even_out_between(std::vector<Vector>& places, const std::vector<Vector>& fixed, double spacing)
{
    const auto surround = [&](double) { return WithFixed(places, fixed, spacing * spacing); };
    sweep(places, spacing, 2, Aim::even_places, surround, [] {});
    return sweep(places, spacing, 2, Aim::equal_volumes, surround, [] {});
}

} // namespace cupel
