/// The full step of molten metal, in each engine, and the same with one model more or less: a block of liquid 304L with
/// nothing around it, all of it moving, by the solver's own Simulation.
#include <cmath>
#include <stdexcept>

#include "integrators/simulation.hpp"
#include "step_benchmark.hpp"
#include "thermal/thermal_scene.hpp"

namespace cupel::inline CUPEL_ENGINE
{

namespace
{

Case molten_block(std::size_t particles, const MeltPoolScene& scene)
{
    const double spacing = 1e-5;
    const double side = spacing * std::round(std::cbrt(static_cast<double>(particles)));
    Case definition;
    definition.name = definition.hash = "molten_block";
    definition.level = "coarse";
    definition.spacing = spacing;
    definition.physics = scene.physics;
    Material metal = thermal_tests::steel();
    metal.viscosity = 6e-3;
    metal.melting_temperature = 1723.0;
    metal.surface_tension = 1.2;
    metal.surface_tension_slope = -4.3e-4;
    metal.surface_tension_reference_temperature = 1723.0;
    metal.surface_tension_minimum = 0.1;
    definition.materials.emplace(metal.name, metal);
    Material argon;
    argon.name = "argon";
    argon.density = 1.62;
    definition.materials.emplace(argon.name, argon);
    definition.surrounding = Surrounding{"argon", false, 300.0, 101325.0, 0.0};
    definition.domain.lower = {0.0, 0.0, 0.0};
    definition.domain.upper = {side + 10.0 * spacing, side, side}; // it moves that way
    for (auto& boundary : definition.domain.boundaries)
        boundary = Boundary{BoundaryKind::open, true, {}};
    definition.initial = {2000.0, {100.0 / side, 0.0, 0.0}};
    Body body;
    body.material = metal.name;
    body.lower = definition.domain.lower;
    body.upper = {side, side, side};
    definition.bodies.push_back(body);
    definition.numerics.precision = sizeof(Real) == 4 ? "float" : "double";
    definition.numerics.density_diffusion = scene.density_diffusion;
    definition.numerics.shifting = scene.shifting;
    definition.numerics.artificial_viscosity = scene.artificial_viscosity;
    definition.numerics.artificial_stress = scene.artificial_stress;
    definition.numerics.skin = 0.15;
    definition.numerics.acoustic_substeps = scene.acoustic_substeps;
    definition.numerics.reference_speed = 11.6; // of recoil at the boiling point, as in the tracks
    definition.time = {1.0, 1.0};
    return definition;
}

/// The block moves on as fast as melt pools flow, so that lists are made anew as often as there.
Scene moving_block(std::size_t particles, const MeltPoolScene& scene)
{
    constexpr double speed = 3.0; // m/s
    Scene placed = place_particles(molten_block(particles, scene));
    for (Index i = 0; i < placed.particles->count(); ++i)
        placed.particles->velocity.set(i, {speed, 0.0, 0.0});
    return placed;
}

class MeltPoolStep : public StepBenchmark
{
public:
    MeltPoolStep(std::size_t particles, const MeltPoolScene& scene)
        : simulation_(moving_block(particles, scene))
    {
        release_pass_memory();
        simulation_.start();
        if (simulation_.neighbourhood().moving_particles().size() != count())
            throw std::logic_error("the benchmark's metal does not all move");
    }
    void step() override { simulation_.step(1.0); }
    std::size_t count() const override { return static_cast<std::size_t>(simulation_.particles().count()); }
    double updates() const override
    {
        return static_cast<double>(simulation_.sound_steps()) * static_cast<double>(count());
    }
    std::size_t bytes() const override
    {
        return simulation_.particles().bytes() + simulation_.neighbourhood().list().bytes() + pass_memory_bytes();
    }
    double neighbours() const override { return 0.0; }
    std::size_t builds() const override { return simulation_.neighbourhood().list().builds(); }
    std::vector<double> accelerations() const override { return {}; }

private:
    Simulation simulation_;
};

} // namespace

std::unique_ptr<StepBenchmark> make_melt_pool_step(std::size_t particles, const MeltPoolScene& scene)
{
    return std::make_unique<MeltPoolStep>(particles, scene);
}

} // namespace cupel::inline CUPEL_ENGINE
