#pragma once

#include <cstddef>
#include <vector>

#include "particles/particles.hpp"
#include "scene/case.hpp"

namespace cupel
{

/// A Gaussian beam straight down, absorbed by the first metal that each of its rays meets:
///
///   q(r) = A · 2P/(π r₀²) · exp(−2 r²/r₀²)      [W/m²]
///
/// The beam is a square grid of rays, half a particle spacing apart (an eighth of r₀ where that is finer) and out to
/// 2.5 r₀, whose powers are normalised to P. A ray meets a particle whose disc of 0.75 spacings in radius it passes
/// through: that covers the corners of a square cell (0.71), so a surface has no false holes, disordered or not. Of the
/// particles that it passes through no deeper than half a spacing below the highest, the nearest in the plane takes it,
/// which gives each particle of a surface layer its own cell; all others are in the shadow. A ray that meets nothing is
/// lost. So what is absorbed is A times the power of the rays that hit, to round-off.
///
/// **A beam as wide as particles need it.** A layer of particles answers a flux cos(kx) with more heat below than a
/// half space has: T = e^{kz}/(λk) · (1 + 0.19 k²Δx²), since the flux enters half a spacing below the surface (1/8 of
/// it) and what a kernel conducts too little along a wave is made up for by what it conducts too much across it
/// everywhere but there. The coefficient is that of the discrete operator (heat_conduction.hpp) on a lattice's half
/// space, solved for kΔx from 0.1 to 0.4 (beam_on_a_lattice_test.cpp); it is the same in two dimensions. Rays half a
/// spacing apart take off 1/32 of the 0.19. A Gaussian of variance s² for each axis takes off ½ k² s²: that of the rays
/// is wider than the beam by s² = 0.32 Δx²,
///
///   r₀'² = r₀² + 4 s²      [m²]
///
/// and its power is the same. Own derivation; moving_gaussian_source, which is exact, had its isotherm 2 % too deep and
/// 1 % too narrow at four spacings a spot radius without it.
///
/// In two dimensions the beam is its section y = 0 over a depth of 1 m: 2P/(π r₀²) · √(π/2) r₀ · 1 m in all.
class LaserBeam
{
public:
    /// Mean power over a step, W.
    struct Power
    {
        double emitted = 0;  ///< by the beam
        double hit = 0;      ///< of the rays that meet metal
        double absorbed = 0; ///< by the particles, summed where it was given to them
    };

    LaserBeam(const Laser& laser, double spacing, int dimensions);

    /// Adds the power that each particle absorbs, averaged from `time` to `time + time_step` (s), to `heating_power`
    /// (W). The beam stands where it is in the middle of the part of the step in which it is on. Particles with
    /// metal = 0 are transparent.
    Power illuminate(const Particles& particles, const ScalarField& metal, double time, double time_step,
                     ScalarField& heating_power);

    /// Power of the rays together while the beam is on, W: P in three dimensions.
    double full_power() const { return full_power_; }

private:
    struct Ray
    {
        double top;     ///< height of the highest particle met so far, m
        double nearest; ///< squared distance in the plane, m²
        Index particle; ///< that takes the ray, −1 for none
    };
    struct Candidate
    {
        Index particle;
        double x, y, z; ///< relative to the beam's axis in the plane, m
    };

    template <class Visit> void for_each_ray_within(const Candidate& candidate, const Visit& visit);

    Laser laser_;
    int dimensions_;
    double spacing_, ray_spacing_, footprint_, reach_, full_power_;
    int rays_across_, rays_deep_;   ///< along x and y
    std::vector<double> ray_power_; ///< W
    std::vector<Ray> rays_;
    std::vector<Candidate> candidates_;
};

} // namespace cupel
