/// Where the interface is and how it bends, from the volume fraction α (Brackbill 1992; Popinet 2018 reviews the
/// choices).
///
///   n̂ = ∇α/|∇α|,   δ = |∇α|,   κ = −∇·n̂
///
/// The curvature is taken from height functions where columns of cells cross the interface cleanly
/// (height_function.hpp). Elsewhere, at walls and on grains of few cells, it is taken from a volume fraction smoothed
/// by a few passes of face averages, then averaged over the interface with the weight α(1 − α).
#pragma once

#include "fields.hpp"
#include "height_function.hpp"

namespace cupel
{
/// S(α) = 3α² − 2α³: a step like α, from 0 to 1, in fewer cells. Surface forces act where it rises.
tmp<volScalarField> smooth_step(const Fields& fields);

class InterfaceGeometry
{
public:
    InterfaceGeometry(const Scene& scene, Fields& fields);

    /// Recomputes what the scene needs from the present α; wall angles first.
    void update();

    const volVectorField& gradient() const { return *gradient_; } ///< ∇α [1/m]
    const HeightFunction& heights() const { return heights_; }
    const surfaceScalarField& curvature() const { return *curvature_; } ///< κ on faces [1/m]; only with surface_tension
    /// Values on faces of what cells at the interface have: means weighted with α(1 − α); only with surface_tension.
    tmp<surfaceScalarField> at_faces(const volScalarField& values) const;

private:
    /// n̂ on faces from the gradient of `smooth`, with the contact angle at walls if the scene has wetting.
    tmp<surfaceVectorField> face_normals(volScalarField& smooth, const volVectorField& gradient) const;

    const Scene& scene_;
    Fields& fields_;
    const label smoothing_passes_, averaging_passes_;
    const bool use_heights_;
    const dimensionedScalar tiny_gradient_;
    const HeightFunction heights_;
    autoPtr<volVectorField> gradient_;
    autoPtr<volScalarField> weight_;
    autoPtr<surfaceScalarField> curvature_;
};
} // namespace cupel
