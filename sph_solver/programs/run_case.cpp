#include "output/recorder.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// A case from its particles to its record; one such function in each engine (engines.hpp).
Ending run_case(const Case& definition, const RecorderOptions& options)
{
    Simulation simulation(place_particles(definition));
    Recorder recorder(simulation, options);
    while (!recorder.finished())
        recorder.step();
    return recorder.finish();
}

} // namespace cupel::inline CUPEL_ENGINE
