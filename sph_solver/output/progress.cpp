#include "output/progress.hpp"

#include <nlohmann/json.hpp>
#include <string>

namespace cupel
{

Progress::Progress(double end, double wall_before, std::FILE* stream, std::chrono::milliseconds interval)
    : end_(end), wall_before_(wall_before), stream_(stream), interval_(interval), start_(Clock::now()), last_(start_)
{}

bool Progress::update(double time, std::uint64_t step)
{
    if (Clock::now() - last_ < interval_) return false;
    write(time, step);
    return true;
}

void Progress::write(double time, std::uint64_t step)
{
    last_ = Clock::now();
    const double wall = wall_before_ + std::chrono::duration<double>(last_ - start_).count();
    const nlohmann::ordered_json line{{"progress", {{"time", time}, {"end", end_}, {"step", step}, {"wall_s", wall}}}};
    const std::string text = line.dump() + "\n";
    std::fwrite(text.data(), 1, text.size(), stream_);
    std::fflush(stream_);
}

} // namespace cupel
