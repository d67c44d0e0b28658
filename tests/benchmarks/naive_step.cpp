/// The measure beside the engine: the plain step (plain_step.cpp: the same scene, kernel, equations and time step) in
/// double as loops over cells as wide as the support, particles sorted by cell, the innermost loop over a row of cells
/// with `omp simd`. Compiled for the instructions of the machine that builds.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "step_benchmark.hpp"

namespace cupel
{

namespace
{

constexpr double sound_speed = 10.0, greatest_speed = 1.0, h = 1.3, viscosity = 0.05, support = 2.0 * h;
constexpr double dt = 0.25 * h / (sound_speed + greatest_speed);

struct State
{
    std::vector<double> x, y, z, u, v, w, density, pressure, volume;
    auto all() { return std::vector{&x, &y, &z, &u, &v, &w, &density, &pressure, &volume}; }
};

class NaiveStep : public StepBenchmark
{
public:
    explicit NaiveStep(std::size_t particles) : side_(static_cast<int>(std::lround(std::cbrt(double(particles)))))
    {
        std::mt19937 random(1);
        std::uniform_real_distribution<double> noise(-0.1, 0.1);
        const double wave = 2.0 * std::numbers::pi / side_;
        for (int k = 0; k < side_; ++k)
            for (int j = 0; j < side_; ++j)
                for (int i = 0; i < side_; ++i) {
                    const double x = i + 0.5 + noise(random), y = j + 0.5 + noise(random), z = k + 0.5 + noise(random);
                    const double density = 1.0 + 0.001 * std::sin(wave * x);
                    const double values[] = {x,
                                             y,
                                             z,
                                             std::sin(wave * x) * std::cos(wave * y) * greatest_speed,
                                             -std::cos(wave * x) * std::sin(wave * y) * greatest_speed,
                                             0.0,
                                             density,
                                             sound_speed * sound_speed * (density - 1.0),
                                             1.0 / density};
                    std::size_t n = 0;
                    for (auto* field : state_.all())
                        field->push_back(values[n++]);
                }
        for (auto* field : {&du_, &dv_, &dw_, &rate_})
            field->resize(count());
        sort();
        sum_up();
    }

    void step() override
    {
        State& s = state_;
#pragma omp parallel for simd
        for (std::size_t i = 0; i < count(); ++i) {
            s.u[i] += dt * du_[i];
            s.v[i] += dt * dv_[i];
            s.w[i] += dt * dw_[i];
            s.x[i] += dt * s.u[i];
            s.y[i] += dt * s.v[i];
            s.z[i] += dt * s.w[i];
            s.density[i] += dt * rate_[i];
            s.volume[i] = 1.0 / s.density[i];
            s.pressure[i] = sound_speed * sound_speed * (s.density[i] + dt * rate_[i] - 1.0);
        }
        sort();
        sum_up();
        ++steps_;
    }
    std::size_t count() const override
    {
        return state_.x.size();
    }
    double updates() const override
    {
        return static_cast<double>(steps_) * static_cast<double>(count());
    }
    std::size_t bytes() const override
    {
        return 0;
    }
    double neighbours() const override
    {
        return 0.0;
    }
    std::size_t builds() const override
    {
        return 0;
    }
    std::vector<double> accelerations() const override
    {
        return {};
    }

private:
    int cell(double x) const
    {
        return std::clamp(static_cast<int>((x + support) / support), 0, cells_ - 1);
    }

    void sort()
    {
        cells_ = static_cast<int>((side_ + 2.0 * support) / support) + 1;
        const std::size_t total = static_cast<std::size_t>(cells_) * cells_ * cells_;
        std::vector<std::size_t> of(count());
        begin_.assign(total + 1, 0);
        for (std::size_t i = 0; i < count(); ++i) {
            of[i] =
                (static_cast<std::size_t>(cell(state_.z[i])) * cells_ + cell(state_.y[i])) * cells_ + cell(state_.x[i]);
            ++begin_[of[i] + 1];
        }
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1), to(count());
        for (std::size_t i = 0; i < count(); ++i)
            to[i] = next[of[i]]++;
        std::vector<double> old(count());
        for (auto* field : state_.all()) {
            old = *field;
            for (std::size_t i = 0; i < count(); ++i)
                (*field)[to[i]] = old[i];
        }
    }

    void sum_up()
    {
        const State& s = state_;
        const double slope = -20.0 * 21.0 / (16.0 * std::numbers::pi * h * h * h) * 0.25 / (h * h);
#pragma omp parallel for schedule(dynamic, 64)
        for (std::size_t i = 0; i < count(); ++i) {
            double ax = 0, ay = 0, az = 0, bx = 0, by = 0, bz = 0, divergence = 0;
            const double x = s.x[i], y = s.y[i], z = s.z[i], u = s.u[i], v = s.v[i], w = s.w[i], p = s.pressure[i];
            const int cx = cell(x), cy = cell(y), cz = cell(z);
            for (int kz = std::max(cz - 1, 0); kz <= std::min(cz + 1, cells_ - 1); ++kz)
                for (int ky = std::max(cy - 1, 0); ky <= std::min(cy + 1, cells_ - 1); ++ky) {
                    const std::size_t row = (static_cast<std::size_t>(kz) * cells_ + ky) * cells_;
                    const std::size_t first = begin_[row + std::max(cx - 1, 0)];
                    const std::size_t last = begin_[row + std::min(cx + 1, cells_ - 1) + 1];
#pragma omp simd reduction(+ : ax, ay, az, bx, by, bz, divergence)
                    for (std::size_t j = first; j < last; ++j) {
                        const double dx = x - s.x[j], dy = y - s.y[j], dz = z - s.z[j];
                        const double r = std::sqrt(dx * dx + dy * dy + dz * dz);
                        const double t = std::max(0.0, 1.0 - r * (0.5 / h));
                        const double weight = s.volume[j] * slope * t * t * t;
                        const double du = u - s.u[j], dv = v - s.v[j], dw = w - s.w[j];
                        const double push = weight * (p + s.pressure[j]);
                        ax -= push * dx;
                        ay -= push * dy;
                        az -= push * dz;
                        bx += weight * du;
                        by += weight * dv;
                        bz += weight * dw;
                        divergence += weight * (dx * du + dy * dv + dz * dw);
                    }
                }
            const double volume = 1.0 / s.density[i];
            du_[i] = volume * (ax + 2.0 * viscosity * bx);
            dv_[i] = volume * (ay + 2.0 * viscosity * by);
            dw_[i] = volume * (az + 2.0 * viscosity * bz);
            rate_[i] = s.density[i] * divergence;
        }
    }

    int side_, cells_ = 0;
    State state_;
    std::vector<double> du_, dv_, dw_, rate_;
    std::vector<std::size_t> begin_;
    std::size_t steps_ = 0;
};

} // namespace

std::unique_ptr<StepBenchmark> make_naive_step(std::size_t particles)
{
    return std::make_unique<NaiveStep>(particles);
}

} // namespace cupel
