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
      normal_flux_(IOobject("normal_flux", fields.mesh.time().timeName(), fields.mesh, IOobject::READ_IF_PRESENT,
                            IOobject::AUTO_WRITE),
                   fields.mesh, dimensionedScalar(dimArea, Zero))
{
    if (scene.physics.surface_tension && use_heights_)
        heights_.reset(new HeightFunction(fields.fraction, scene.spacing, scene.primary.contact_angle));
    // The wall gradient of α that a step leaves is the start of the next one's normals: geometry computed once more
    // after a checkpoint would not be that of the unbroken run.
    if (!normal_flux_.headerOk()) update();
}

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
    const tmp<surfaceVectorField> normals = face_normals(fields_.fraction, gradient_());
    normal_flux_ = normals() & mesh.Sf();
    if (!scene_.physics.surface_tension) return;

    tmp<volScalarField> curvature;
    if (smoothing_passes_ == 0) {
        curvature = -fvc::div(normal_flux_);
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
    const volScalarField weight("interface_weight",
                                map_field(fields_.fraction, "interface_weight", dimless, [](scalar share) {
                                    const scalar bounded = min(max(share, scalar(0)), scalar(1));
                                    return bounded * (1 - bounded) + 1e-6;
                                }));
    for (label pass = 0; pass < averaging_passes_; ++pass)
        curvature = fvc::average(fvc::interpolate(curvature * weight)) / fvc::average(fvc::interpolate(weight));
    if (heights_.valid()) {
        tmp<volScalarField> by_heights(new volScalarField("curvature", curvature));
        heights_->apply(by_heights.ref(), fields_.fraction, gradient_());
        curvature = by_heights;
    }
    curvature_.reset(
        new surfaceScalarField("face_curvature", fvc::interpolate(curvature * weight) / fvc::interpolate(weight)));
}

tmp<volVectorField> InterfaceGeometry::unit_normal() const
{
    const volVectorField& gradient = gradient_();
    // below a thousandth of the gradient of a sharp interface there is no interface to have a normal
    const dimensionedScalar floor("floor", dimless / dimLength, 1e-3 / scene_.spacing);
    return tmp<volVectorField>(new volVectorField("interface_normal", gradient / (mag(gradient) + floor)));
}
} // namespace cupel
