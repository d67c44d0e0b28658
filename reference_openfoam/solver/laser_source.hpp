/// Gaussian beam shining along −z, absorbed where it first meets the primary material in each column of cells.
///
///   power on a column = A P ∫∫ 2/(π r₀²) exp(−2 r²/r₀²) dx dy over the column's footprint     [W], exact by error
///   functions
///
/// Down the column the light is spent on the cells in proportion to −∂(α²)/∂z, until it is spent: a grain that fills a
/// part of the column shadows that part of what lies below. The shares of a column that is hit add up to one, so the
/// absorbed power is A·P of what the beam hits on a surface of any shape. Columns without a surface let their light
/// through.
///
/// Where the case asks for it, rays with reflections take the place of this (ray_tracing.hpp).
#pragma once

#include "fields.hpp"
#include "ray_tracing.hpp"

namespace cupel
{
struct LaserPower
{
    scalar emitted = 0; ///< P while the beam is on [W]
    scalar expected =
        0; ///< A P times the share of the beam that falls on columns with a surface; of rays, what surfaces took [W]
    scalar absorbed = 0; ///< what the field holds, summed over cells [W]
};

class LaserSource
{
public:
    LaserSource(const Scene& scene, const fvMesh& mesh);

    /// Fills the absorbed power density [W/m³] for the beam as it stands at `time`.
    LaserPower update(scalar time, const volScalarField& fraction);

    const volScalarField& power_density() const { return power_density_; }

private:
    struct Column
    {
        scalar x_lower, x_upper, y_lower, y_upper;
        std::vector<label> cells; // from top to bottom
    };

    const Scene& scene_;
    const fvMesh& mesh_;
    autoPtr<RayTracing> rays_;
    std::vector<Column> columns_;
    volScalarField power_density_;
};
} // namespace cupel
