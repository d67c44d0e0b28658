/// cupel_foam: a volume-of-fluid melting solver on OpenFOAM, the grid-based reference of Cupel's SPH solver.
///
/// Usage: cupel_foam [-parallel] -case FOLDER, where FOLDER is a case as reference_openfoam/case_writer.py writes it.
/// Starts from the newest time in FOLDER; history and outcome go to the folder around it. Exit status: 0 completed,
/// 1 stopped, 2 refused, 3 the fine part of the mesh must move on (a checkpoint is there), 130 interrupted with a
/// checkpoint. Side by side (-parallel) the status of the process is 0 whatever the end; the last line on standard
/// output says {"ended":STATUS} in any case.
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <sstream>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "checkpoint.hpp"
#include "energy_equation.hpp"
#include "guards.hpp"
#include "mesh_window.hpp"
#include "momentum_equation.hpp"
#include "outcome.hpp"
#include "scene.hpp"
#include "time_step.hpp"
#include "volume_fraction.hpp"

namespace
{
using namespace cupel;

/// Speeds in a solid decay until they are denormal numbers, on which processors are slow: take those as zero.
void flush_denormals()
{
#if defined(__SSE2__)
    _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
}

/// The whole run: everything that the scene needs, and the loop over steps.
int run_scene(Time& clock, const fvMesh& mesh)
{
    const IOdictionary properties(
        IOobject("cupelProperties", clock.constant(), mesh, IOobject::MUST_READ, IOobject::NO_WRITE));
    const Scene scene(properties);
    const MeshWindow window(scene, properties);
    Fields fields(mesh, scene);
    autoPtr<InterfaceGeometry> geometry;
    autoPtr<InterfaceTransport> transport;
    if (scene.physics.flow) {
        geometry.reset(new InterfaceGeometry(scene, fields));
        transport.reset(new InterfaceTransport(fields, geometry->heights()));
    }
    autoPtr<volVectorField> still_gradient; // without flow the interface stays: ∇α once
    if (!scene.physics.flow)
        still_gradient.reset(new volVectorField("gradient_of_fraction", fvc::grad(fields.fraction)));
    autoPtr<EnergyEquation> energy;
    if (scene.physics.heat) energy.reset(new EnergyEquation(scene, fields));

    if (energy.valid()) energy->restore_from_enthalpy();
    Ledgers ledgers(scene, fields, energy.valid() ? energy.operator->() : nullptr);
    TimeStep time_step(scene, fields);
    RunState state;
    const bool resumed = restore_checkpoint(clock, mesh, ledgers, time_step, state);
    Outcome outcome(scene, fields, clock.globalPath().path());
    const auto checkpoint = [&](bool mesh_must_follow) {
        tmp<volScalarField> enthalpy; // registered while it is there, so written with the others
        if (mesh_must_follow) enthalpy = energy->primary_enthalpy();
        RunState now = state;
        now.wall_seconds += outcome.wall_seconds();
        now.cpu_seconds += outcome.cpu_seconds();
        write_checkpoint(clock, mesh, ledgers, time_step, now);
    };
    EnergyRates rates;
    if (!resumed) checkpoint(false);
    outcome.record(0, ledgers, rates, state);

    const scalar almost = 1e-9 * scene.end_time;
    while (clock.value() < scene.end_time - almost) {
        const scalar next_output =
            scene.output_interval * (std::floor((clock.value() + almost) / scene.output_interval) + 1);
        const scalar target = min(next_output, scene.end_time);
        const scalar step = time_step.next(clock.value(), target);
        if (scene.physics.flow) center_fluxes(fields.flow(), time_step.longer_than_last());
        clock.setDeltaT(step, false);
        ++clock;
        ++state.steps;
        try {
            if (scene.physics.flow) advance_volume_fraction(scene, fields, transport(), geometry(), state.steps);
            if (scene.physics.heat) {
                rates = energy->advance(scene.physics.flow ? geometry->gradient() : still_gradient());
                fields.update_peak();
                ledgers.book_energy(rates, step);
            }
            if (scene.physics.flow) {
                ledgers.book_flow(step);
                advance_momentum(scene, fields, geometry());
            }
            check_fields(scene, fields, time_step, step);
            outcome.record(step, ledgers, rates, state);
            const bool interrupted = stop_requested();
            const bool window_is_left =
                clock.value() < scene.end_time - almost && window.is_left(fields, clock.value());
            if (interrupted || window_is_left || clock.value() >= target - almost) checkpoint(window_is_left);
            if (interrupted) return 130;
            if (window_is_left) return 3;
        }
        catch (const Diverged& trouble) {
            outcome.finish("stopped", trouble.what(), ledgers, time_step, state);
            return 1;
        }
        catch (const Foam::error& trouble) {
            std::ostringstream diagnosis;
            diagnosis << "OpenFOAM reports at t = " << clock.value() << " s: " << trouble.message();
            if (!Pstream::parRun()) {
                outcome.finish("stopped", diagnosis.str(), ledgers, time_step, state);
                return 1;
            }
            // perhaps on this rank only: the others wait in vain, and MPI has to end them
            diagnosis << " (rank " << Pstream::myProcNo() << ')';
            outcome.finish_alone("stopped", diagnosis.str(), time_step, state);
            UPstream::abort();
        }
    }
    outcome.finish("completed", "", ledgers, time_step, state);
    return 0;
}

/// Opens clock and mesh of the case, runs it, and turns what OpenFOAM refuses into one line.
int run_case(const argList& arguments)
{
    FatalError.throwExceptions();
    FatalIOError.throwExceptions();
    messageStream::level = 0; // no line for each linear solve; the run's own lines come from Outcome
    flush_denormals();
    try {
        Time clock(Time::controlDictName, arguments);
        install_stop_signals(); // after the clock, which sets handlers of OpenFOAM's own
        const fvMesh mesh(IOobject(fvMesh::defaultRegion, clock.timeName(), clock, IOobject::MUST_READ));
        return run_scene(clock, mesh);
    }
    catch (const Foam::error& trouble) {
        std::cerr << "cupel_foam: " << trouble.message() << std::endl;
        if (Pstream::parRun()) UPstream::abort();
        return 2;
    }
}
} // namespace

int main(int argc, char** argv)
{
    argList::noFunctionObjects();
    argList arguments(argc, argv);
    int status = 2;
    if (arguments.checkRootCase())
        status = run_case(arguments);
    else
        std::cerr << "cupel_foam: " << arguments.path() << " is no case folder" << std::endl;
    if (Pstream::master()) std::cout << "{\"ended\":" << status << '}' << std::endl;
    if (Pstream::parRun()) UPstream::exit(0); // any other status would have the ranks killed
    std::exit(status);                        // argList's destructor would end the process with status 0
}
