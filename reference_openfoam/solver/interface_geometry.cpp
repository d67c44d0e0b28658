#include "interface_geometry.hpp"
#include "contact_angle.hpp"

namespace cupel
{
tmp<volScalarField> smooth_step(const Fields& fields)
{
    return map_field(fields.fraction, "smooth_step", dimless, [](scalar share) {
        const scalar bounded = min(max(share, scalar(0)), scalar(1));
        return sqr(bounded) * (3 - 2 * bounded);
    });
}

InterfaceGeometry::InterfaceGeometry(const Scene& scene, Fields& fields)
    : scene_(scene), fields_(fields), smoothing_passes_(scene.numerics.get<label>("curvature_smoothing_passes")),
      averaging_passes_(scene.numerics.get<label>("curvature_averaging_passes")),
      use_heights_(scene.numerics.get<bool>("height_functions")),
      tiny_gradient_("tiny_gradient", dimless / dimLength, 1e-8 / scene.spacing),
      heights_(fields.fraction, scene.spacing, scene.primary.contact_angle)
{}

tmp<surfaceVectorField> InterfaceGeometry::face_normals(volScalarField& smooth, const volVectorField& gradient) const
{
    const surfaceVectorField face_gradient(fvc::interpolate(gradient));
    tmp<surfaceVectorField> normals(
        new surfaceVectorField("unit_normal", face_gradient / (mag(face_gradient) + tiny_gradient_)));
    if (scene_.physics.wetting) apply_contact_angle(normals.ref(), face_gradient, smooth, scene_, fields_);
    return normals;
}

void InterfaceGeometry::update()
{
    const fvMesh& mesh = fields_.mesh;
    gradient_.reset(new volVectorField("gradient_of_fraction", fvc::grad(fields_.fraction)));
    const surfaceScalarField normal_flux(face_normals(fields_.fraction, gradient_()) & mesh.Sf());
    if (!scene_.physics.surface_tension) return;

    tmp<volScalarField> curvature;
    if (smoothing_passes_ == 0) {
        curvature = -fvc::div(normal_flux);
    }
    else {
        volScalarField smooth("smooth_fraction", fields_.fraction);
        for (label pass = 0; pass < smoothing_passes_; ++pass) {
            smooth.primitiveFieldRef() = fvc::average(fvc::interpolate(smooth))().primitiveField();
            smooth.correctBoundaryConditions();
        }
        const surfaceScalarField smooth_flux(face_normals(smooth, fvc::grad(smooth)) & mesh.Sf());
        curvature = -fvc::div(smooth_flux);
    }
    weight_.reset(new volScalarField("interface_weight",
                                     map_field(fields_.fraction, "interface_weight", dimless, [](scalar share) {
                                         const scalar bounded = min(max(share, scalar(0)), scalar(1));
                                         return bounded * (1 - bounded) + 1e-6;
                                     })));
    const volScalarField& weight = *weight_;
    for (label pass = 0; pass < averaging_passes_; ++pass)
        curvature = fvc::average(fvc::interpolate(curvature * weight)) / fvc::average(fvc::interpolate(weight));
    if (use_heights_) {
        tmp<volScalarField> by_heights(new volScalarField("curvature", curvature));
        heights_.apply(by_heights.ref(), fields_.fraction, gradient_());
        curvature = by_heights;
    }
    curvature_.reset(new surfaceScalarField("face_curvature", at_faces(curvature())));
}

tmp<surfaceScalarField> InterfaceGeometry::at_faces(const volScalarField& values) const
{
    return fvc::interpolate(values * weight_()) / fvc::interpolate(weight_());
}
} // namespace cupel
