/// A case as plain typed values, all SI, angles in rad: what the solver reads.
///
/// The values come from the resolved case (JSON, see resolve.hpp), in which every unit is converted and every default
/// filled; a value that the case does not have is an empty optional.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace cupel
{

using Vector3 = std::array<double, 3>;

/// Something in a case that cannot be used; what() is one line that says where, what is wrong and what to do.
class CaseError : public std::runtime_error
{
public:
    using std::runtime_error::runtime_error;
};

/// One material. A value that no physics of the case needs and that the case file does not give is empty.
struct Material
{
    std::string name;
    double density = 0;                                          ///< liquid or gas [kg/m^3]
    std::optional<double> density_solid;                         ///< [kg/m^3]
    std::optional<double> viscosity;                             ///< dynamic [Pa s]
    std::optional<double> specific_heat;                         ///< liquid [J/(kg K)]
    std::optional<double> specific_heat_solid;                   ///< [J/(kg K)]
    std::optional<double> conductivity;                          ///< liquid [W/(m K)]
    std::optional<double> conductivity_solid;                    ///< [W/(m K)]
    std::optional<double> solidus;                               ///< [K]
    std::optional<double> liquidus;                              ///< [K]
    std::optional<double> melting_temperature;                   ///< isotherm that bounds the melt pool in measures [K]
    std::optional<double> latent_heat;                           ///< of melting [J/kg]
    std::optional<double> mushy_drag;                            ///< Carman and Kozeny's C [kg/(m^3 s)]
    std::optional<double> surface_tension;                       ///< at the reference temperature [N/m]
    std::optional<double> surface_tension_slope;                 ///< d(sigma)/dT [N/(m K)]
    std::optional<double> surface_tension_reference_temperature; ///< [K]
    std::optional<double> surface_tension_minimum;               ///< floor of sigma(T) [N/m]
    std::optional<double> contact_angle;                         ///< through this material, on walls and solids [rad]
    std::optional<double> boiling_temperature;                   ///< at the surrounding's pressure [K]
    std::optional<double> vaporization_heat;                     ///< [J/kg]
    std::optional<double> molar_mass;                            ///< [kg/mol]
    std::optional<double> emissivity;                            ///< [1]
    std::optional<double> absorptivity;                          ///< of the laser's light [1]
};

/// What is outside the bodies.
struct Surrounding
{
    std::string material;
    bool resolved = false;             ///< true: with particles of its own; false: nothing there for SPH
    double temperature = 300;          ///< far away [K]
    double pressure = 101325;          ///< far away [Pa]
    double convection_coefficient = 0; ///< [W/(m^2 K)]
};

enum class BoundaryKind { wall, symmetry, open, periodic };

/// One side of the domain.
struct Boundary
{
    BoundaryKind kind = BoundaryKind::wall;
    bool no_slip = true;                 ///< walls only
    std::optional<double> temperature{}; ///< [K]; empty = adiabatic
    Vector3 velocity{};                  ///< of a wall without slip, along itself [m/s]
};

/// Index of a side of the domain in Domain::boundaries.
enum class Side : std::size_t { x_min, x_max, y_min, y_max, z_min, z_max };

inline constexpr std::array<const char*, 6> side_names{"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};

/// Walls that are circles about one centre, in two dimensions: a cylinder that liquid lies on, a vessel that it lies
/// in, or both. The domain is then what lies between them, and the sides of the box are open.
struct RoundWalls
{
    Vector3 center{};                     ///< [m]
    std::optional<double> inner_radius{}; ///< of the cylinder [m]
    std::optional<double> outer_radius{}; ///< of the vessel [m]
};

struct Domain
{
    Vector3 lower{};                                   ///< [m]
    Vector3 upper{};                                   ///< [m]
    std::array<std::optional<Boundary>, 6> boundaries; ///< y_min and y_max are empty in two dimensions
    std::optional<RoundWalls> round_walls{};

    const std::optional<Boundary>& boundary(Side side) const { return boundaries[static_cast<std::size_t>(side)]; }
};

enum class BodyShape {
    box,
    sphere, ///< a disc in two dimensions
    powder_bed
};

/// A drop that is not quite round: R (1 + a cos(n theta)) in 2-D, R (1 + a P_n(cos theta)) in 3-D, theta from the
/// vertical.
struct Perturbation
{
    int mode = 2;         ///< n
    double amplitude = 0; ///< a [1]
};

/// A wave on the upper side of a box: upper z + amplitude cos(2 pi x / wavelength).
struct SurfaceWave
{
    double amplitude = 0;  ///< [m]
    double wavelength = 1; ///< [m]
};

/// A part of the domain filled with a material at the start. Later bodies lie over earlier ones.
struct Body
{
    BodyShape shape = BodyShape::box;
    std::string material;
    bool solid = false;                         ///< state at the start
    Vector3 lower{};                            ///< box, powder bed [m]
    Vector3 upper{};                            ///< box, powder bed [m]
    Vector3 center{};                           ///< sphere [m]
    double radius = 0;                          ///< sphere [m]
    std::string file;                           ///< powder bed: absolute path of its spheres (read_powder_bed)
    std::optional<double> temperature{};        ///< at the start, in place of Initial's field [K]
    std::optional<Perturbation> perturbation{}; ///< sphere
    std::optional<SurfaceWave> surface_wave{};  ///< box
};

/// Taylor-Green vortices at the start: u = U sin(kx) cos(kz), w = -U cos(kx) sin(kz), k = 2 pi / wavelength.
struct TaylorGreen
{
    double speed = 0;      ///< U [m/s]
    double wavelength = 1; ///< [m]

    Vector3 velocity(const Vector3& position) const;
};

/// What is added to the temperature: rise exp(-2 r^2 / radius^2), r the distance to the vertical through center.
struct HotSpot
{
    Vector3 center{};  ///< [m]
    double radius = 1; ///< [m]
    double rise = 0;   ///< on the axis [K]
};

struct Initial
{
    double temperature = 300;       ///< at domain.lower [K]
    Vector3 temperature_gradient{}; ///< [K/m]; the field is temperature + gradient . (x - domain.lower) + hot spot
    std::optional<HotSpot> hot_spot{};
    std::optional<TaylorGreen> velocity{}; ///< empty: everything is at rest
};

/// Gaussian beam straight down (-z) along a line on the plate; off before `start` and once `to` is reached.
struct Laser
{
    double power = 0;        ///< of the beam [W]
    double speed = 0;        ///< of scanning [m/s]
    double spot_radius = 0;  ///< 1/e^2 [m]
    double absorptivity = 0; ///< share that the surface hit absorbs [1]
    std::array<double, 2> from{};
    std::array<double, 2> to{};
    double start = 0; ///< [s]

    /// Time at which the beam goes off [s]; infinite for a beam at rest (from = to or speed = 0).
    double off_time() const;
    /// Centre of the beam on the plane z = 0 at a time [m].
    std::array<double, 2> position(double time) const;
};

struct TimeSpan
{
    double end = 0;             ///< [s]
    double output_interval = 0; ///< of field snapshots [s]
};

/// Numerical choices of the SPH solver; the meaning and default of each are in its declaration
/// (declarations_numerics.cpp).
struct Numerics
{
    std::string formulation = "default"; ///< "default" or "paper"
    std::string precision = "double";    ///< of pair arithmetic: "double" or "float"
    std::string kernel = "root_free";    ///< or "quintic_spline"
    double smoothing_ratio = 1.0;        ///< smoothing length / particle spacing
    double artificial_viscosity = 0;
    double artificial_viscosity_beta = 0;
    double artificial_stress = 0;
    double artificial_heat = 0;
    double density_diffusion = 0;
    double shifting = 0;                  ///< strength, 0 = off, 1 = full
    std::string surface_load = "carried"; ///< "carried" or "continuum_force"
    bool contact_line_force = true;
    std::optional<double> sound_speed;     ///< [m/s]
    double sound_speed_factor = 10;        ///< sound speed / greatest expected speed
    std::optional<double> reference_speed; ///< greatest expected speed [m/s]
    double time_step_factor = 1;
    int acoustic_substeps = 1; ///< most steps of sound in a step of all else
    double thermal_time_step_factor = 1;
    double skin = 0;                     ///< extra radius of the neighbour list / particle spacing
    double position_jitter = 0;          ///< greatest random displacement at the start / particle spacing
    std::string without_saving = "none"; ///< what is computed in full all the same; "none" of the savings
};

struct Case
{
    std::string name;      ///< CASE, or CASE_VARIATION
    std::string variation; ///< of the case's [sweep]; empty where it has none
    std::string tier;      ///< canonical, v0, v1 or v2; empty where it is in none
    std::string title;
    std::string hash;   ///< sha256 of the resolved content
    std::string level;  ///< coarse, medium, fine or paper
    double spacing = 0; ///< particle spacing or cell size [m]
    int dimensions = 3; ///< 2: the x-z plane
    std::vector<std::string> physics;
    std::map<std::string, Material> materials;
    std::optional<Surrounding> surrounding;
    Domain domain;
    Vector3 gravity{};
    Initial initial;
    std::vector<Body> bodies;
    std::optional<Laser> laser;
    TimeSpan time;
    Numerics numerics;
    nlohmann::json resolved; ///< the whole resolved case, as it goes into a result

    /// Whether the case names a physics, e.g. requires_physics("marangoni"). Throws CaseError for a name that no case
    /// can have.
    bool requires_physics(std::string_view physics_name) const;
    /// The material of a name; throws CaseError if there is none.
    const Material& material(const std::string& material_name) const;
    /// The frozen or initial temperature at a place [K]: that of the uppermost body there that has one of its own, else
    /// the field of `initial`.
    double initial_temperature(const Vector3& position) const;
};

/// Typed values of a resolved case. Throws CaseError where the JSON is not a resolved case of this schema version.
Case case_from_resolved(const nlohmann::json& resolved);

/// The same from a file. Throws CaseError when it cannot be read.
Case read_resolved_case(const std::string& path);

} // namespace cupel
