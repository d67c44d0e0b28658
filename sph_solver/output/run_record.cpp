#include "output/run_record.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <sys/resource.h>
#include <unistd.h>

namespace cupel
{

namespace
{

constexpr int record_schema_version = 1;
constexpr double bytes_per_kibibyte = 1024.0;

double cpu_seconds_of_process()
{
    struct rusage usage
    {};
    ::getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::string host_name()
{
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

std::string cpu_model()
{
    std::ifstream information("/proc/cpuinfo");
    for (std::string line; std::getline(information, line);)
        if (line.starts_with("model name") && line.find(": ") != std::string::npos)
            return line.substr(line.find(": ") + 2);
    return "unknown";
}

nlohmann::ordered_json number(double value)
{
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

nlohmann::ordered_json ledgers_as_json(const RunRecord& record)
{
    auto ledgers = nlohmann::ordered_json::object();
    for (const auto& [name, ledger] : record.ledgers) {
        ledgers[name] = {{"start", number(ledger.start)},
                         {"end", number(ledger.end)},
                         {"in", number(ledger.in)},
                         {"out", number(ledger.out)},
                         {"closure", number(ledger.closure())}};
        if (const auto details = record.ledger_details.find(name); details != record.ledger_details.end())
            for (const auto& [key, value] : details->second)
                ledgers[name][key] = number(value);
    }
    return ledgers;
}

nlohmann::ordered_json cost_as_json(const RunCost& cost)
{
    const double core_seconds = cost.wall_seconds * cost.threads;
    return {{"wall_s", number(cost.wall_seconds)},
            {"cpu_s", number(cost.cpu_seconds)},
            {"output_s", number(cost.output_seconds)},
            {"guards_s", number(cost.guard_seconds)},
            {"threads", cost.threads},
            {"steps", cost.steps},
            {"acoustic_steps", cost.acoustic_steps},
            {"elements", cost.elements},
            {"updates_per_core_s", core_seconds > 0.0 ? number(cost.element_updates / core_seconds) : number(0.0)},
            {"peak_bytes", number(cost.peak_bytes)},
            {"time_step_binding", cost.time_step_binding}};
}

} // namespace

CostMeter::CostMeter(double wall_before, double cpu_before)
    : wall_before_(wall_before), cpu_before_(cpu_before - cpu_seconds_of_process())
{}

double CostMeter::wall_seconds() const
{
    return wall_before_ + std::chrono::duration<double>(Clock::now() - start_).count();
}

double CostMeter::cpu_seconds() const
{
    return cpu_before_ + cpu_seconds_of_process();
}

double CostMeter::peak_bytes()
{
    struct rusage usage
    {};
    ::getrusage(RUSAGE_SELF, &usage);
    return bytes_per_kibibyte * static_cast<double>(usage.ru_maxrss);
}

void RunCost::measure(const CostMeter& meter)
{
    wall_seconds = meter.wall_seconds();
    cpu_seconds = meter.cpu_seconds();
    peak_bytes = std::max(peak_bytes, CostMeter::peak_bytes());
}

nlohmann::ordered_json record_as_json(const RunRecord& record)
{
    const auto& code = record.provenance.code;
    return {{"schema", record_schema_version},
            {"case", record.provenance.case_name},
            {"solver", "sph"},
            {"variant", record.variant},
            {"status", record.status == RunStatus::completed ? "completed" : "stopped"},
            {"diagnosis", record.diagnosis},
            {"code", {{"version", code.version}, {"commit", code.commit}, {"reference_version", nullptr}}},
            {"host", {{"name", host_name()}, {"cpu", cpu_model()}, {"cores", ::sysconf(_SC_NPROCESSORS_ONLN)}}},
            {"settings", record.settings},
            {"ledgers", ledgers_as_json(record)},
            {"cost", cost_as_json(record.cost)}};
}

void write_record(const std::filesystem::path& file, const RunRecord& record, Flush flush)
{
    // Text from outside (a path, a title) may not be valid UTF-8: such bytes are replaced, not a reason to lose a run.
    constexpr auto replace = nlohmann::ordered_json::error_handler_t::replace;
    write_whole(file, record_as_json(record).dump(1, ' ', false, replace) + "\n", flush);
}

} // namespace cupel
