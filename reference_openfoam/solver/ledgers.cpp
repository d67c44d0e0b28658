#include <cmath>
#include <cstdio>
#include <string>

#include "ledgers.hpp"

namespace cupel
{
namespace
{
std::string entry(const char* name, scalar value)
{
    if (!std::isfinite(value)) return '"' + std::string(name) + "\": null"; // of a run that has gone astray
    char text[96];
    std::snprintf(text, sizeof text, "\"%s\": %.12g", name, value);
    return text;
}

scalar closure(scalar start, scalar end, scalar in, scalar out, scalar smallest)
{
    return mag(end - start - (in - out)) / max(max(in, mag(end - start)), smallest);
}

/// Adds a signed inflow to the side that it belongs to.
void book(scalar inflow, scalar& in, scalar& out)
{
    (inflow > 0 ? in : out) += mag(inflow);
}
} // namespace

Ledgers::Ledgers(const Scene& scene, const Fields& fields, const EnergyEquation* energy)
    : scene_(scene), fields_(fields), energy_(energy), volume_start_(primary_volume())
{
    if (energy_) energy_start_ = energy_->stored_energy();
}

scalar Ledgers::primary_volume() const
{
    return volume_integral(fields_.fraction.primitiveField(), fields_.mesh);
}

void Ledgers::book_flow(scalar step)
{
    scalar outflow = 0;
    forAll (fields_.mesh.boundary(), patch)
        if (!fields_.mesh.boundary()[patch].coupled())
            outflow += sum(fields_.flow->fraction_flux.boundaryField()[patch]);
    reduce(outflow, sumOp<scalar>());
    book(-outflow * step, volume_in_, volume_out_);
}

void Ledgers::book_energy(const EnergyRates& rates, scalar step)
{
    laser_emitted_ += rates.laser.emitted * step;
    laser_expected_ += rates.laser.expected * step;
    laser_absorbed_ += rates.laser.absorbed * step;
    surface_losses_ += rates.surface_losses * step;
    conducted_in_ += rates.conducted_in * step;
    convected_out_ += rates.convected_out * step;
    book(rates.laser.absorbed * step, energy_in_, energy_out_);
    book(-rates.surface_losses * step, energy_in_, energy_out_);
    book(rates.conducted_in * step, energy_in_, energy_out_);
    book(-rates.convected_out * step, energy_in_, energy_out_);
}

std::string Ledgers::summary() const
{
    char text[160];
    std::snprintf(text, sizeof text, ", primary volume %.9g m3", primary_volume());
    std::string result = text;
    if (energy_) {
        std::snprintf(text, sizeof text, ", energy in %.6g J, out %.6g J (%d iterations)", energy_in_, energy_out_,
                      int(energy_->iterations()));
        result += text;
    }
    return result;
}

std::string Ledgers::json() const
{
    const scalar volume = primary_volume(), density = scene_.primary.density;
    // a closed box has no inflow: its closure is relative to what it holds
    const scalar volume_closure = closure(volume_start_, volume, volume_in_, volume_out_, volume_start_);
    std::string text = "{\"volume\": {" + entry("start", volume_start_) + ", " + entry("end", volume) + ", " +
                       entry("in", volume_in_) + ", " + entry("out", volume_out_) + ", " +
                       entry("closure", volume_closure) + "}";
    text += ", \"mass\": {" + entry("start", volume_start_ * density) + ", " + entry("end", volume * density) + ", " +
            entry("in", volume_in_ * density) + ", " + entry("out", volume_out_ * density) + ", " +
            entry("closure", volume_closure) + "}";
    if (energy_) {
        const scalar stored = energy_->stored_energy();
        // what is stored is a sum rounded to 1e-15 of itself: of less than a thousand millionth of it, exchanged with
        // the outside, a closure would tell the round-off
        const scalar smallest = 1e-9 * mag(energy_start_);
        text += ", \"energy\": {" + entry("start", energy_start_) + ", " + entry("end", stored) + ", " +
                entry("in", energy_in_) + ", " + entry("out", energy_out_) + ", " +
                entry("closure", closure(energy_start_, stored, energy_in_, energy_out_, smallest));
        if (scene_.physics.laser) {
            text += ", " + entry("laser_emitted", laser_emitted_) + ", " + entry("laser_expected", laser_expected_) +
                    ", " + entry("laser_absorbed", laser_absorbed_) + ", " +
                    entry("absorbed_error", mag(laser_absorbed_ - laser_expected_) / max(laser_expected_, VSMALL));
        }
        text += ", " + entry("surface_losses", surface_losses_) + ", " + entry("conducted_in", conducted_in_) + ", " +
                entry("convected_out", convected_out_) + "}";
    }
    return text + "}";
}

void Ledgers::save(dictionary& entries) const
{
    entries.set("volume", FixedList<scalar, 3>({volume_start_, volume_in_, volume_out_}));
    entries.set("energy", FixedList<scalar, 3>({energy_start_, energy_in_, energy_out_}));
    entries.set("laser", FixedList<scalar, 3>({laser_emitted_, laser_expected_, laser_absorbed_}));
    entries.set("exchange", FixedList<scalar, 3>({surface_losses_, conducted_in_, convected_out_}));
}

void Ledgers::restore(const dictionary& entries)
{
    const auto read = [&entries](const word& name, scalar& one, scalar& two, scalar& three) {
        const auto values = entries.get<FixedList<scalar, 3>>(name);
        one = values[0];
        two = values[1];
        three = values[2];
    };
    read("volume", volume_start_, volume_in_, volume_out_);
    read("energy", energy_start_, energy_in_, energy_out_);
    read("laser", laser_emitted_, laser_expected_, laser_absorbed_);
    read("exchange", surface_losses_, conducted_in_, convected_out_);
}
} // namespace cupel
