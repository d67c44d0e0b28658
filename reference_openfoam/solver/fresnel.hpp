/// Absorption of a metal surface against the angle of incidence φ (Fresnel's law in the form of Hagen and Rubens;
/// Schulz, Simon, Urbassek and Decker 1987; Ki, Mohanty and Mazumder 2002, eq. 5), mean of both polarisations.
///
///   A(φ) = 1 − ½ { [1 + (1 − ε cosφ)²]/[1 + (1 + ε cosφ)²] + [ε² − 2ε cosφ + 2cos²φ]/[ε² + 2ε cosφ + 2cos²φ] }
///
/// ε is a number of the metal and the wavelength. It is taken from the absorptivity at normal incidence that the case
/// gives: A(0) = 4ε/(2 + 2ε + ε²), so that a flat surface absorbs what the case says. A(0) is at most 0.828.
#pragma once

#include "foam.hpp"

namespace cupel
{
/// ε for the absorptivity A(0) at normal incidence.
scalar hagen_rubens_number(scalar normal_absorptivity);

/// A(φ) from cosφ.
scalar fresnel_absorptivity(scalar cosine, scalar hagen_rubens);
} // namespace cupel
