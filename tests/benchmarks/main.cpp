/// Benchmarks of the engine; `./cupel bench` runs them and reads what they print. A name is
/// kind/precision/particles/threads.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include <omp.h>

#include "programs/engines.hpp"
#include "step_benchmark.hpp"

namespace cupel
{

#define CUPEL_DECLARE_BENCHMARKS(instructions, precision, name)                                                        \
    namespace name                                                                                                     \
    {                                                                                                                  \
    std::unique_ptr<StepBenchmark> make_plain_step(std::size_t);                                                       \
    std::unique_ptr<StepBenchmark> make_melt_pool_step(std::size_t, const MeltPoolScene&);                             \
    }
CUPEL_FOR_EACH_ENGINE(CUPEL_DECLARE_BENCHMARKS)

namespace
{

struct Makers
{
    std::string instructions, precision;
    MakePlainStep plain;
    MakeMeltPoolStep melt_pool;
};

Makers makers(const std::string& instructions, const std::string& precision)
{
#define CUPEL_MAKERS_ENTRY(instructions, precision, name)                                                              \
    {#instructions, #precision, name::make_plain_step, name::make_melt_pool_step},
    static const std::vector<Makers> all{CUPEL_FOR_EACH_ENGINE(CUPEL_MAKERS_ENTRY)};
    return *std::find_if(all.begin(), all.end(), [&](const Makers& one) {
        return one.instructions == instructions && one.precision == precision;
    });
}

/// Steps enough for several rebuilds of the list, so that the rate includes them.
int steps_for(std::size_t particles)
{
    return particles >= 3'000'000 ? 8 : particles >= 500'000 ? 16 : 48;
}

void measure(benchmark::State& state, const std::function<std::unique_ptr<StepBenchmark>()>& make, int threads)
{
    omp_set_num_threads(threads);
    const auto scene = make();
    scene->step();
    const int steps = steps_for(scene->count());
    const double before = scene->updates();
    for (auto _ : state)
        for (int step = 0; step < steps; ++step)
            scene->step();
    const double updates = scene->updates() - before;
    // CPU seconds of the whole process, by all threads: a core's rate.
    state.counters["updates_per_core_s"] = benchmark::Counter(updates, benchmark::Counter::kIsRate);
    state.counters["bytes_per_particle"] = static_cast<double>(scene->bytes()) / static_cast<double>(scene->count());
    state.counters["particles"] = static_cast<double>(scene->count());
    state.counters["threads"] = threads;
}

void add(const std::string& name, std::size_t particles, int threads,
         const std::function<std::unique_ptr<StepBenchmark>()>& make)
{
    const std::string full = name + "/" + std::to_string(particles) + "/" + std::to_string(threads);
    benchmark::RegisterBenchmark(full.c_str(),
                                 [make, threads](benchmark::State& state) { measure(state, make, threads); })
        ->Iterations(1) // of many steps; a scene that went on and on would not be the same scene
        ->MeasureProcessCPUTime()
        ->Unit(benchmark::kMillisecond);
}

/// Root mean square difference of accelerations in float and in double over that in double.
void float_error(benchmark::State& state, std::size_t particles, const std::string& instructions)
{
    double difference = 0.0, size = 0.0;
    for (auto _ : state) {
        const auto a = makers(instructions, "double").plain(particles)->accelerations();
        const auto b = makers(instructions, "float").plain(particles)->accelerations();
        difference = size = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            difference += (a[i] - b[i]) * (a[i] - b[i]);
            size += a[i] * a[i];
        }
    }
    state.counters["relative_error"] = std::sqrt(difference / size);
}

/// Scenes that differ by one model: what each adds to the one before is its cost.
std::vector<std::pair<std::string, MeltPoolScene>> model_scenes()
{
    MeltPoolScene scene{{"flow"}, 0.0};
    std::vector<std::pair<std::string, MeltPoolScene>> scenes{{"flow", scene}};
    const auto next = [&](const std::string& name) { scenes.emplace_back(name, scene); };
    scene.density_diffusion = 0.1;
    next("density_diffusion");
    scene.physics.push_back("surface_tension");
    next("surface_tension");
    scene.shifting = 1.0;
    next("shifting");
    scene.physics.push_back("heat");
    next("heat");
    scene.physics.push_back("marangoni");
    next("marangoni");
    scene.physics.push_back("melting");
    next("melting");
    scene.physics.push_back("recoil");
    next("recoil");
    scene.physics.push_back("evaporation");
    next("evaporation");
    scene.physics.push_back("radiation");
    next("radiation");
    scene.artificial_viscosity = 0.1;
    next("artificial_viscosity");
    scene.artificial_stress = 0.2;
    next("artificial_stress");
    return scenes;
}

/// As case files have it by default; sound at one rate with all else where that is asked for.
MeltPoolScene full_scene(int acoustic_substeps = 6)
{
    MeltPoolScene scene{{"flow", "surface_tension", "marangoni", "heat", "melting"}};
    scene.shifting = 1.0;
    scene.acoustic_substeps = acoustic_substeps;
    return scene;
}

void add_all(const std::string& instructions)
{
    const int cores = omp_get_max_threads();
    for (const std::string precision : {"double", "float"}) {
        const Makers make = makers(instructions, precision);
        for (const std::size_t n : {10'000, 100'000, 1'000'000, 10'000'000}) {
            add("plain_" + precision, n, 1, [=] { return make.plain(n); });
            if (cores > 1 && n >= 100'000) add("plain_" + precision, n, 2, [=] { return make.plain(n); });
            if (n > 1'000'000) continue;
            add("full_" + precision, n, 1, [=] { return make.melt_pool(n, full_scene()); });
            add("one_rate_" + precision, n, 1, [=] { return make.melt_pool(n, full_scene(1)); });
        }
        for (const auto& [name, scene] : model_scenes())
            for (const std::size_t n : {10'000, 100'000})
                add("model_" + precision + "/" + name, n, 1, [=, scene = scene] { return make.melt_pool(n, scene); });
    }
    for (const std::size_t n : {10'000, 100'000, 1'000'000})
        add("naive_double", n, 1, [=] { return make_naive_step(n); });
    for (const std::size_t n : {10'000, 100'000})
        benchmark::RegisterBenchmark(("float_error/" + std::to_string(n)).c_str(), [=](benchmark::State& state) {
            float_error(state, n, instructions);
        })->Iterations(1);
}

} // namespace

} // namespace cupel

int main(int argument_count, char** arguments)
{
    const char* wanted = std::getenv("CUPEL_INSTRUCTIONS");
    try {
        const std::string instructions = cupel::choose_engine("double", wanted ? wanted : "").instructions;
        benchmark::AddCustomContext("instructions", instructions);
        cupel::add_all(instructions);
    }
    catch (const std::exception& error) {
        std::fprintf(stderr, "cupel_benchmarks: %s\n", error.what());
        return 2;
    }
    benchmark::Initialize(&argument_count, arguments);
    if (benchmark::ReportUnrecognizedArguments(argument_count, arguments)) return 2;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
