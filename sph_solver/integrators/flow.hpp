#pragma once

#include <map>
#include <memory>
#include <string>

#include "integrators/neighbourhood.hpp"
#include "integrators/parameters.hpp"
#include "integrators/surface_tracker.hpp"
#include "integrators/values_at.hpp"
#include "ledgers/mechanical_work.hpp"
#include "models/artificial_stress.hpp"
#include "models/artificial_viscosity.hpp"
#include "models/gradient_correction.hpp"
#include "models/surface_forces.hpp"
#include "models/surface_temperature.hpp"
#include "models/vapour_pressure.hpp"
#include "models/wall_extrapolation.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// One of the shorter steps in which sound is followed within a step.
struct SoundStep
{
    double time_step; ///< s
    double whole;     ///< the step of which it is a part, s
    bool halfway;     ///< whether it ends in the middle of that
    bool last;        ///< whether the next ends where that does

    /// The k-th (from 1) of count steps of sound in a whole one, the last of which evaluates everything.
    static SoundStep of(int k, int count, double whole)
    {
        return {whole / count, whole, k == (count + 1) / 2, k + 1 == count};
    }
};

/// How much of its drift the k-th (from 1) of count steps of sound has behind it where densities are found; the last,
/// which evaluates everything, has all. Pressure does the work p_n·D_n v_n at the places of step n, and compression
/// takes p_(n+½)·D v_(n+½). With D of the end of the drift the second exceeds the first by ½ Δt Σ p Ḋ v, with D of its
/// start it falls short by as much. So the places advance from start to end: half way on the average, and the same
/// whether time runs forwards or backwards. One step alone cannot have that.
inline double drift_before_densities(int k, int count)
{
    return (k - 1.0) / (count - 1.0);
}

/// For how long each kind of force acts in a kick, s.
struct KickTimes
{
    double sound;            ///< pressure and gravity
    double slow;             ///< viscosity, Marangoni stress and what else does not pull against pressure
    double surface;          ///< tension, recoil, cohesion, as of this step
    double surface_before{}; ///< and as of the step before
};

/// Momentum and mass of the liquid: what a step needs to know of either formulation.
class Flow
{
public:
    virtual ~Flow() = default;

    /// Positions, by the kicked velocities: x ← x + Δt v and whatever the formulation adds.
    virtual void drift(const Neighbourhood& neighbourhood, double time_step) = 0;

    /// Densities, pressures and accelerations at the new positions. time_step is that of the drift (0 at the start).
    virtual void evaluate(const Neighbourhood& neighbourhood, double time_step) = 0;

    /// Whether sound may be followed in shorter steps within one step of all else.
    virtual bool follows_sound() const { return false; }
    /// One of those, all but the last: densities by continuity, somewhere on the way, ...
    virtual void find_densities(const Neighbourhood&, const SoundStep&) {}
    /// ... and the force of pressure where the drift ends; all else is held. evaluate() then does what sound still
    /// lacks of the step.
    virtual void evaluate_sound(const Neighbourhood&, const SoundStep&) {}

    /// A particle that has just melted or solidified starts from rest.
    virtual void reset(Index place)
    {
        acceleration_.set(place, {});
        pressure_force_.set(place, {});
        if (by_surface_) by_surface_->set(place, {});
        if (surface_) surface_->reset(place);
    }

    const VectorField& acceleration() const { return acceleration_; }
    Vector pressure_force(Index i) const { return pressure_force_[i]; } ///< N
    /// Of it, what sound is made of: pressure, and gravity, which pressure bears.
    Vector acceleration_by_sound(Index i) const { return (1.0 / particles_.mass[i]) * pressure_force_[i] + gravity_; }
    /// Of it, what acts as an impulse at the ends of a step within which sound is followed: viscosity, Marangoni
    /// stress, what is artificial. The surface's load is held.
    Vector impulsive_acceleration(Index i) const
    {
        const Vector impulsive = acceleration_[i] - acceleration_by_sound(i);
        return by_surface_ ? impulsive - (1.0 / particles_.mass[i]) * (*by_surface_)[i] : impulsive;
    }
    /// What a kick adds to the velocity of a particle, or of a cluster (values_at.hpp), m/s, all of it and by the
    /// surface's forces as far as these share the time of sound and not of all else: nothing where both are the same.
    /// It is the force that is held, not the acceleration, since shifting exchanges mass meanwhile.
    template <class Scalar> struct Kick
    {
        VectorOf<Scalar> change, by_surface;
        VectorOf<Scalar> more_than_next; ///< before an evaluation's second half: by how much the surface gives more
    };
    template <class At> Kick<typename At::Scalar> kick(const At& at, const KickTimes& times) const;
    /// Its work, where the velocity is `mean_velocity` on the average of it, and `mean_for_pressure` on that of what
    /// compression answers.
    template <class At>
    WorkOnMotion<typename At::Scalar>
    work(const At& at, const Kick<typename At::Scalar>& kick, const VectorOf<typename At::Scalar>& mean_velocity,
         const VectorOf<typename At::Scalar>& mean_for_pressure, const KickTimes& times) const;
    /// e of a particle, J/kg.
    virtual double elastic_energy(Index i) const;
    /// ½ m v² + m e of all that moves, J.
    double mechanical_energy(const Neighbourhood& neighbourhood) const;
    MechanicalWork& books() { return books_; }
    const MechanicalWork& books() const { return books_; }
    /// Null where the scene has no force on the surface.
    const SurfaceTracker* surface() const { return surface_.get(); }
    const FlowParameters& parameters() const { return parameters_; }

protected:
    Flow(Scene& scene, const FlowParameters& parameters, const ScalarField& mobility);

    /// Pressure and velocity of walls and solids from the liquid before them.
    WallPressure wall_pressure(ScalarField& pressure, ScalarField* carried_load);
    WallVelocity wall_velocity();
    /// The artificial pair forces of a case that switches one on, as terms that add to artificial_force_.
    void start_artificial_force(const Neighbourhood& neighbourhood);
    ArtificialViscosity artificial_viscosity();
    ArtificialStress artificial_stress();
    /// The temperature that surface forces are evaluated at, as a term.
    SurfaceTemperature surface_temperature();
    /// Gradient of temperature where Marangoni stress asks for it, as a term; then times the matrices that correct it.
    SurfaceTemperatureGradient surface_temperature_gradient();
    void correct_temperature_gradient(const Neighbourhood& neighbourhood, const CorrectionMatrix& correction);
    /// Registers what is held of the surface's forces while sound is followed.
    void hold_surface_forces();
    /// Pressure and viscosity, and the artificial forces, N.
    Vector sum_of_pair_forces(Index i) const;
    /// force_ ← that.
    void add_up_forces(const Neighbourhood& neighbourhood);
    /// Adds to force_ what holds liquid together that is too thin to have a surface of its own.
    void add_cohesion(const Neighbourhood& neighbourhood);
    /// What presses on the surface.
    void find_load(const Neighbourhood& neighbourhood, bool temperature_is_known = false);
    /// acceleration ← force/m + g + surface forces/ρ; needs the gradient of temperature.
    void accelerate(const Neighbourhood& neighbourhood);

    Scene& scene_;
    Particles& particles_;
    FlowParameters parameters_;
    SmoothingKernel kernel_;
    Mobility mobility_;
    Vector gravity_;
    VectorField& force_; ///< of all pairs
    VectorField& pressure_force_;
    VectorField& viscous_force_;
    VectorField* wall_force_ = nullptr;       ///< of pressure_force_, what walls and solids press: for the books
    VectorField* artificial_force_ = nullptr; ///< only where a case switches such forces on
    VectorField& acceleration_;
    VectorField* by_surface_ = nullptr;        ///< force of load, cohesion, N: only where it is held
    VectorField* by_surface_before_ = nullptr; ///< a step ago
    MechanicalWork books_;
    std::unique_ptr<SurfaceTracker> surface_;

    /// What the equation of state says of the density, which acts between particles. It is the pressure but where the
    /// load on the surface is carried into the liquid: there pressure is the sum of both.
    ScalarField* excess_pressure_;
    ScalarField* temperature_ = nullptr;
    /// ½(ρ₁ + ρ₂) of two phases, kg/m³; 0 with one. Surface forces there have the weight 2ρ_i/(ρ₁ + ρ₂) (Brackbill,
    /// Kothe, Zemach 1992, eq. 31), whose mean over the band is one: both phases are driven alike, and what is uneven
    /// in them does not stir a light phase that has no inertia.
    double mean_density_ = 0.0;
    VectorField* temperature_gradient_ = nullptr; ///< only where it drives Marangoni flow
    /// What of a stress on the surface each particle takes (surface_stress.hpp); between two phases, which have none,
    /// δ.
    ScalarField* stress_share_ = nullptr;
    VectorField* stress_direction_ = nullptr; ///< n̂ of those

    ScalarField* load_ = nullptr; ///< L, Pa; only where tension or recoil presses on a surface
    /// Whether the surface's band bears the load as a continuum surface force. Else it is carried into the liquid.
    bool band_bears_load_ = false;

private:
    double tension(Index i) const;          ///< σ at a particle of the liquid's surface, N/m
    double tension_of_solid(Index i) const; ///< the same for one of its solid

    SurfaceTensionLaw tension_;
    VapourPressure vapour_pressure_;
    bool with_tension_, with_marangoni_, with_recoil_;
    ScalarField* unresolved_ = nullptr; ///< only where a free surface has tension
    double bonds_ = 0.0;
    ScalarField* mean_temperature_ = nullptr; ///< only where a surface force depends on it
};

template <class At> Flow::Kick<typename At::Scalar> Flow::kick(const At& at, const KickTimes& times) const
{
    using Scalar = typename At::Scalar;
    const Scalar per_mass = Scalar(1.0) / at(particles_.mass);
    Kick<Scalar> kick{
        Scalar(times.sound - times.slow) * (per_mass * at(pressure_force_) + vector<Scalar>(gravity_)), {}, {}};
    if (times.slow > 0.0) kick.change += Scalar(times.slow) * at(acceleration_);
    if (!by_surface_) return kick;
    VectorOf<Scalar> impulse = Scalar(times.surface - times.slow) * at(*by_surface_);
    if (times.surface_before != 0.0) impulse += Scalar(times.surface_before) * at(*by_surface_before_);
    kick.by_surface = per_mass * impulse;
    kick.change += kick.by_surface;
    if (times.surface_before != 0.0)
        kick.more_than_next = (Scalar(-times.surface_before) * per_mass) * (at(*by_surface_) - at(*by_surface_before_));
    return kick;
}

template <class At>
WorkOnMotion<typename At::Scalar>
Flow::work(const At& at, const Kick<typename At::Scalar>& kick, const VectorOf<typename At::Scalar>& mean_velocity,
           const VectorOf<typename At::Scalar>& mean_for_pressure, const KickTimes& times) const
{
    using Scalar = typename At::Scalar;
    const Scalar mass = at(particles_.mass);
    const VectorOf<Scalar> path_of_pressure = Scalar(times.sound) * mean_for_pressure,
                           path_of_sound = Scalar(times.sound) * mean_velocity, gravity = vector<Scalar>(gravity_),
                           pressure_force = at(pressure_force_);
    WorkOnMotion<Scalar> work;
    work.pressure = dot(pressure_force, path_of_pressure);
    if (wall_force_) work.imbalance = dot(at(*wall_force_), path_of_pressure);
    work.gravity = mass * dot(gravity, path_of_sound);
    if (by_surface_)
        work.surface =
            mass * dot(kick.by_surface, mean_velocity) + dot(pressure_force, path_of_sound - path_of_pressure);
    if (times.slow == 0.0) return work;
    const VectorOf<Scalar> path = Scalar(times.slow) * mean_velocity;
    work.viscosity = dot(at(viscous_force_), path);
    if (artificial_force_) work.artificial = dot(at(*artificial_force_), path);
    const VectorOf<Scalar> force_of_sound = pressure_force + mass * gravity;
    work.surface += dot(mass * at(acceleration_) - force_of_sound, path) - work.viscosity - work.artificial;
    return work;
}

/// Two phases that fill the domain: volume by summation, transport velocity. One phase with a free surface: δ-SPH.
std::unique_ptr<Flow> make_flow(Scene& scene, const FlowParameters& parameters, const ScalarField& mobility);

} // namespace cupel::inline CUPEL_ENGINE
