/// Momentum and incompressibility of the mixture, by PISO with a balanced treatment of the forces on faces (Weller
/// 2008).
///
///   ∂(ρu)/∂t + ∇·(ρuu) = −∇p_rgh − (g·x)∇ρ + ∇·[μ(∇u + ∇uᵀ)] + F_faces + F_cells − K u,      ∇·u = 0
///
/// F_faces: capillary force, recoil. F_cells: Marangoni, and ρg along periodic axes, where g·x cannot be periodic. K:
/// mushy drag, implicit. Each is there only if the scene names it.
///
/// A face has the mass and the momentum of half of each of its cells: 1/A on faces is one over the mean of A, A ≈ ρ/Δt
/// + K being the diagonal of the equation, and the predicted velocity there is the mean of A u over the mean of A. A
/// face between liquid and gas has then half the liquid's inertia, as the half cell of liquid below it has, where the
/// mean of 1/ρ would have the surface's pressure act at the centre of that cell, half a cell too deep (Popinet 2009 has
/// densities on faces so). Cells are accelerated by the mean of their faces' accelerations, not of their forces: the
/// force on a face beside the liquid, shared out to the gas, would throw the gas about by the ratio of the densities.
/// Fluxes keep their own inertia from step to step, as on a staggered mesh, and cells take on what their faces have
/// beyond them: else viscosity, which acts between cells, would not know of it. Its share of A acts on a flux's change
/// alone (viscous_stress.hpp).
///
/// With surface tension the faces at a surface have the inertia of the liquid below it to one order more
/// (surface_inertia.hpp): less of their own acceleration, on the left, and that of the faces across, as a force.
///
/// A surface with tension, moved by the last step's fluxes, gives the forces of the next: a leapfrog, of second order
/// if fluxes are those of the middle of the step that they move it by. Steps that are alike keep them there; where one
/// is longer by d than the last, they are brought on by ½ d. A run begins with short steps and would else be half a
/// long one late for good: a capillary wave of 16 cells 2 ms, a fifth of its error.
#pragma once

#include "surface_temperature.hpp"

namespace cupel
{
/// With surface tension, brings the fluxes on to the middle of the step that is about to begin, which is `longer` [s]
/// than the last.
void center_fluxes(FlowFields& flow, scalar longer);

/// Advances velocity and pressure by one step of the clock, at the present α and T.
void advance_momentum(const Scene& scene, Fields& fields, const InterfaceGeometry& geometry);
} // namespace cupel
