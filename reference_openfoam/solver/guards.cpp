#include <cmath>
#include <sstream>

#include "guards.hpp"

namespace cupel
{
namespace
{
std::string place(const Fields& fields, label cell)
{
    std::ostringstream text;
    const point& centre = fields.mesh.C()[cell];
    text << "at t = " << fields.mesh.time().value() << " s, x = (" << centre.x() << ' ' << centre.y() << ' '
         << centre.z() << ") m";
    return text.str();
}
} // namespace

void check_fields(const Scene& scene, const Fields& fields, const TimeStep& time_step, scalar step)
{
    std::string trouble;
    const auto report = [&trouble](const std::string& message) {
        if (trouble.empty()) trouble = message;
    };
    // causes before what follows from them: the report is the first found
    const scalar courant = time_step.courant(step);
    if (std::isfinite(courant) && courant >= 5) {
        report("the Courant number has risen to " + std::to_string(courant) +
               " at t = " + std::to_string(fields.mesh.time().value()) + " s; lower numerics.time_step_factor");
    }
    forAll (fields.fraction, cell) {
        const scalar share = fields.fraction[cell];
        if (!std::isfinite(share))
            report("the volume fraction is not a number " + place(fields, cell));
        else if (share < -0.01 || share > 1.01) {
            report("the volume fraction has left 0 … 1 (" + std::to_string(share) + ") " + place(fields, cell) +
                   "; lower numerics.time_step_factor");
        }
        if (scene.physics.heat) {
            const scalar temperature = fields.heat->temperature[cell];
            const scalar boiling = scene.physics.evaporation ? scene.primary.boiling_temperature : GREAT;
            if (!std::isfinite(temperature))
                report("the temperature is not a number " + place(fields, cell));
            else if (temperature <= 0)
                report("the temperature is not above 0 K " + place(fields, cell));
            else if (temperature > 3 * boiling) {
                report("the temperature is above three times the boiling temperature (" + std::to_string(temperature) +
                       " K) " + place(fields, cell) +
                       "; the beam is too intense for this mesh: refine it or lower the power");
            }
        }
        if (fields.flow.valid() && !std::isfinite(mag(fields.flow->velocity[cell])))
            report("the velocity is not a number " + place(fields, cell) + "; lower numerics.time_step_factor");
    }
    if (step < 1e-7 * scene.output_interval)
        report("the time step has collapsed to " + std::to_string(step / scene.output_interval) +
               " of the output interval");
    label troubled = trouble.empty() ? 0 : 1;
    reduce(troubled, sumOp<label>());
    if (!troubled) return;
    List<string> troubles(Pstream::nProcs());
    troubles[Pstream::myProcNo()] = trouble;
    Pstream::gatherList(troubles);
    Pstream::scatterList(troubles);
    for (const string& text : troubles)
        if (!text.empty()) throw Diverged(text);
}
} // namespace cupel
