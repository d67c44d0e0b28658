#include <csignal>
#include <fstream>

#include "OSspecific.H"
#include "checkpoint.hpp"

namespace cupel
{
namespace
{
volatile std::sig_atomic_t stop_flag = 0;

extern "C" void remember_stop(int)
{
    stop_flag = 1;
}

IOobject state_file(const fvMesh& mesh, IOobject::readOption reading)
{
    return IOobject("cupelState", mesh.time().timeName(), "uniform", mesh, reading, IOobject::NO_WRITE, false);
}

void list_files(const fileName& root, const fileName& below, std::ostream& list)
{
    for (const fileName& name : readDir(root / below, fileName::FILE))
        if (name != "complete.part")
            list << fileSize(root / below / name) << ' ' << (below.empty() ? name : below / name) << '\n';
    for (const fileName& name : readDir(root / below, fileName::DIRECTORY))
        list_files(root, below.empty() ? name : below / name, list);
}
} // namespace

void install_stop_signals()
{
    std::signal(SIGINT, remember_stop);
    std::signal(SIGTERM, remember_stop);
    std::signal(SIGUSR1, remember_stop);
    std::signal(SIGPIPE, SIG_IGN); // whoever read the progress is gone; SIGTERM comes too
}

bool stop_requested()
{
    label stop = stop_flag;
    reduce(stop, maxOp<label>());
    return stop != 0;
}

void write_checkpoint(Time& clock, const fvMesh& mesh, const Ledgers& ledgers, const TimeStep& time_step,
                      const RunState& state)
{
    clock.writeNow();
    IOdictionary entries(state_file(mesh, IOobject::NO_READ));
    entries.set("steps", state.steps);
    entries.set("wall_seconds", state.wall_seconds);
    entries.set("cpu_seconds", state.cpu_seconds);
    entries.set("next_row", state.next_row);
    entries.set("time", clock.value());
    dictionary ledger_entries, step_entries;
    ledgers.save(ledger_entries);
    time_step.save(step_entries);
    entries.set("ledgers", ledger_entries);
    entries.set("time_step", step_entries);
    entries.regIOobject::writeObject(IOstream::ASCII, IOstream::currentVersion, IOstream::UNCOMPRESSED, true);

    const fileName folder(clock.path() / clock.timeName());
    {
        std::ofstream list(folder / "complete.part");
        list_files(folder, fileName(), list);
    }
    mv(folder / "complete.part", folder / "complete");
}

bool restore_checkpoint(Time& clock, const fvMesh& mesh, Ledgers& ledgers, TimeStep& time_step, RunState& state)
{
    IOobject file(state_file(mesh, IOobject::READ_IF_PRESENT));
    if (!isFile(mesh.time().path() / mesh.time().timeName() / "uniform" / "cupelState")) return false;
    const IOdictionary entries(file);
    entries.readEntry("steps", state.steps);
    entries.readEntry("wall_seconds", state.wall_seconds);
    entries.readEntry("cpu_seconds", state.cpu_seconds);
    entries.readEntry("next_row", state.next_row);
    clock.setTime(instant(entries.get<scalar>("time"), clock.timeName()), clock.timeIndex());
    ledgers.restore(entries.subDict("ledgers"));
    time_step.restore(entries.subDict("time_step"));
    return true;
}
} // namespace cupel
