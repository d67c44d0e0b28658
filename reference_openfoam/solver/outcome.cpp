#include <chrono>
#include <cstdio>
#include <iostream>

#include <sys/resource.h>

#include "outcome.hpp"

namespace cupel
{
namespace
{
scalar seconds_now()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Greatest memory that this process has held [bytes]. (getrusage would count the parent's before exec.)
double peak_bytes()
{
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.compare(0, 6, "VmHWM:") == 0) return 1024 * std::stod(line.substr(6));
    return 0;
}

std::string escaped(const std::string& text)
{
    std::string result;
    for (const char character : text) {
        if (character == '"' || character == '\\') result += '\\';
        result += static_cast<unsigned char>(character) < ' ' ? ' ' : character;
    }
    return result;
}
} // namespace

Outcome::Outcome(const Scene& scene, const Fields& fields, const fileName& folder)
    : scene_(scene), fields_(fields), folder_(folder), last_progress_(-GREAT), start_seconds_(seconds_now())
{
    if (!Pstream::master()) return;
    history_.open(folder / "history.csv", std::ios::app);
    if (history_.tellp() > 0) return;
    history_ << "time_s,time_step_s,primary_volume_m3";
    if (scene.physics.flow) history_ << ",kinetic_energy_J,maximum_speed_m_per_s";
    if (scene.physics.heat) history_ << ",maximum_temperature_K,surface_losses_W";
    if (scene.physics.laser) history_ << ",absorbed_power_W";
    history_ << '\n';
}

scalar Outcome::wall_seconds() const
{
    return seconds_now() - start_seconds_;
}

scalar Outcome::cpu_seconds() const
{
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    scalar seconds =
        usage.ru_utime.tv_sec + usage.ru_stime.tv_sec + 1e-6 * (usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
    reduce(seconds, sumOp<scalar>());
    return seconds;
}

void Outcome::write_row(scalar step, const Ledgers& ledgers, const EnergyRates& rates)
{
    history_.precision(10);
    history_ << fields_.mesh.time().value() << ',' << step << ',' << ledgers.primary_volume();
    if (fields_.flow.valid()) {
        // the primary material's kinetic energy and speed: the surrounding's are not compared with anything
        const scalarField share(fields_.bounded_fraction()().primitiveField());
        const scalarField speed(mag(fields_.flow->velocity.primitiveField()));
        history_ << ',' << volume_integral(0.5 * scene_.primary.density * share * sqr(speed), fields_.mesh) << ','
                 << gMax(scalarField(pos(share - 0.5) * speed));
    }
    if (scene_.physics.heat)
        history_ << ','
                 << gMax(scalarField(pos(fields_.fraction.primitiveField() - 0.5) *
                                     fields_.heat->temperature.primitiveField()))
                 << ',' << rates.surface_losses;
    if (scene_.physics.laser) history_ << ',' << rates.laser.absorbed;
    history_ << '\n' << std::flush; // not open, and so silent, but on the first rank
}

void Outcome::record(scalar step, const Ledgers& ledgers, const EnergyRates& rates, RunState& state)
{
    const scalar time = fields_.mesh.time().value();
    if (time >= state.next_row - 1e-12 * scene_.end_time) {
        write_row(step, ledgers, rates);
        state.next_row = time + 1e-3 * scene_.end_time;
    }
    const scalar now = seconds_now();
    label due = now - last_progress_ < 1 ? 0 : 1;
    Pstream::scatter(due); // the first rank's clock decides, for the sums below need all ranks
    if (!due) return;
    last_progress_ = now;
    collect(ledgers, state);
    const std::string summary = ledgers.summary();
    if (!Pstream::master()) return;
    char text[200];
    std::snprintf(text, sizeof text, "{\"progress\":{\"time\":%.9g,\"end\":%.9g,\"step\":%d,\"wall_s\":%.1f}}", time,
                  scene_.end_time, int(state.steps), state.wall_seconds + wall_seconds());
    std::cout << text << '\n'
              << "t = " << time << " s, step " << state.steps << " of " << step << " s" << summary << std::endl;
}

void Outcome::collect(const Ledgers& ledgers, const RunState& state)
{
    sums_.ledgers = ledgers.json();
    sums_.cells = returnReduce(fields_.mesh.nCells(), sumOp<label>());
    sums_.cpu_seconds = state.cpu_seconds + cpu_seconds();
}

void Outcome::finish(const std::string& status, const std::string& diagnosis, const Ledgers& ledgers,
                     const TimeStep& time_step, const RunState& state)
{
    collect(ledgers, state);
    if (Pstream::master()) write(status, diagnosis, time_step, state);
}

void Outcome::finish_alone(const std::string& status, const std::string& diagnosis, const TimeStep& time_step,
                           const RunState& state) const
{
    write(status, diagnosis, time_step, state);
}

void Outcome::write(const std::string& status, const std::string& diagnosis, const TimeStep& time_step,
                    const RunState& state) const
{
    // ranks that fail at once write one each; the last to be renamed stays
    const fileName part(folder_ / "outcome.json.part" + std::to_string(Pstream::myProcNo()));
    const scalar cpu = sums_.cpu_seconds;
    std::ofstream file(part);
    file << "{\"status\": \"" << status << "\", \"diagnosis\": \"" << escaped(diagnosis)
         << "\",\n \"time\": " << fields_.mesh.time().value() << ",\n \"ledgers\": " << sums_.ledgers
         << ",\n \"cost\": {\"wall_s\": " << state.wall_seconds + wall_seconds() << ", \"cpu_s\": " << cpu
         << ", \"threads\": " << Pstream::nProcs() << ", \"steps\": " << state.steps
         << ", \"elements\": " << sums_.cells
         << ", \"updates_per_core_s\": " << scalar(sums_.cells) * state.steps / max(cpu, SMALL)
         << ", \"peak_bytes\": " << static_cast<long>(peak_bytes()) << ", \"time_step_binding\": {";
    const char* separator = "";
    for (const auto& entry : time_step.binding()) {
        file << separator << '"' << entry.first << "\": " << entry.second;
        separator = ", ";
    }
    file << "}},\n \"reference_version\": \"OpenFOAM " << OPENFOAM << "\"}\n";
    file.close();
    mv(part, folder_ / "outcome.json");
}
} // namespace cupel
