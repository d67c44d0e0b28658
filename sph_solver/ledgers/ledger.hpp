/// The books of a conserved quantity: what was there, what came, what went, what is there.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace cupel
{

/// All five in the unit of the quantity: kg, kg m/s, J or m3.
struct Ledger
{
    double start = 0;
    double end = 0;
    double in = 0;        ///< entered since the start, ≥ 0
    double out = 0;       ///< left since the start; negative where a loss turned into a gain
    double reference = 0; ///< smallest amount against which an error is judged, e.g. the mass at the start

    /// What the books do not explain.
    double error() const { return (end - start) - (in - out); }

    ///  closure = |(end − start) − (in − out)| / max(in, |end − start|, reference);  0 where nothing was or happened.
    /// With reference = 0 the scale is what came in or stayed, as for energy; a quantity that neither comes nor goes
    /// (mass, volume) takes its start as reference. Where all three are 0 the scale is |out|.
    double closure() const
    {
        const double scale = std::max({in, std::abs(end - start), reference});
        if (error() == 0.0) return 0.0;
        return std::abs(error()) / (scale > 0.0 ? scale : std::abs(out));
    }
};

/// Puts a ledger among the named numbers of a checkpoint, as "ledger.NAME.start" and so on.
inline void save_ledger(const std::string& name, const Ledger& ledger, std::map<std::string, double>& numbers)
{
    const std::string prefix = "ledger." + name + ".";
    numbers[prefix + "start"] = ledger.start;
    numbers[prefix + "end"] = ledger.end;
    numbers[prefix + "in"] = ledger.in;
    numbers[prefix + "out"] = ledger.out;
    numbers[prefix + "reference"] = ledger.reference;
}

/// The ledger that save_ledger put there. Throws std::out_of_range where it is not there.
inline Ledger load_ledger(const std::string& name, const std::map<std::string, double>& numbers)
{
    const std::string prefix = "ledger." + name + ".";
    return {numbers.at(prefix + "start"), numbers.at(prefix + "end"), numbers.at(prefix + "in"),
            numbers.at(prefix + "out"), numbers.at(prefix + "reference")};
}

} // namespace cupel
