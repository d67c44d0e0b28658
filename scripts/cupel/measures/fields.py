"""Fields on a regular grid: the one resampling routine of all measures.

Elements are spread on a grid of half the spacing, g = dx/2, by the hat function (cloud in cell) and smoothed along
each axis with the binomial weights (1, 6, 15, 20, 15, 6, 1)/64. Together that is a kernel K of reach 2 dx with

  - sum over nodes 1 and first moment 0 (nothing is lost and nothing is moved),
  - sum over a lattice of spacing dx exactly 1 at every node, for any offset of the lattice,
  - variance (3/2 + 1/6) g^2 along each axis.

Fraction volume density  c(x) = sum_j V_j f_j K(x - x_j);  the surface of the primary material is c = 1/2. For a flat
face of lattice particles that is half a spacing beyond the last particle; for volume fractions it is where they put it.
Where the surrounding has elements too, c is divided by sum_j V_j K.

Values  T(x) = mean + gradient . (x - centroid), a first-order fit with weights V_j f_j K, so that a linear field is
exact up to the surface; two passes over the residuals (Barnes 1964, successive corrections) take out what K's variance
makes of second derivatives. Only primary material counts: gas temperature does not enter.
"""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np
from scipy.ndimage import convolve1d
from scipy.sparse import csc_matrix

from .elements import Elements
from .round_walls import mirrored_in_round_walls

BINOMIAL = np.array([1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0]) / 64.0
REACH = 2.0             # of the kernel, in spacings
KERNEL_VARIANCE = (1.5 + 1.0 / 6.0) / 4.0   # per axis, in spacings squared
CELL_VARIANCE = 1.0 / 12.0                  # that a cell average adds
GRADIENT_REGULARISATION = 0.003              # in spacings squared; the full neighbourhood has KERNEL_VARIANCE
SHARPENING_PASSES = 2
DENSITY_OF_NOTHING = 0.02                   # below it a node has no values


def active_axes(dimensions: int) -> tuple[int, ...]:
    """Axes of space that a scene has: x, z in 2-D, x, y, z in 3-D; z is always the last."""
    return (0, 2) if dimensions == 2 else (0, 1, 2)


def mirrored(elements: Elements, case: dict) -> Elements:
    """Elements with images beyond the walls and symmetry planes of the domain, as deep as the kernel reaches.

    Without them the density would fall to one half at a wall that the material touches.
    """
    reach = (REACH + 0.5) * case["spacing"]
    elements = mirrored_in_round_walls(elements, case, reach)
    names = ("x", "y", "z")
    for axis in active_axes(case["dimensions"]):
        for side, corner in (("min", "lower"), ("max", "upper")):
            boundary = case["domain"]["boundaries"].get(f"{names[axis]}_{side}") or {}
            if boundary.get("kind") not in ("wall", "symmetry"):
                continue
            plane = case["domain"][corner][axis]
            near = np.abs(elements.position[:, axis] - plane) < reach
            if not near.any():
                continue
            image = elements.take(near)
            position = image.position.copy()
            position[:, axis] = 2.0 * plane - position[:, axis]
            elements = Elements.joined([elements, replace(image, position=position)])
    return elements


def subdivided(elements: Elements, spacing: float, dimensions: int) -> Elements:
    """Elements with every cell that is wider than 1.25 spacings cut into equal parts (refined meshes, stretched cells)."""
    if elements.extent is None:
        return elements
    pieces = np.ones((elements.count, 3), dtype=int)
    for axis in active_axes(dimensions):
        pieces[:, axis] = np.ceil(elements.extent[:, axis] / (1.25 * spacing) - 1e-9)
    if (pieces <= 1).all():
        return elements
    parts = []
    for counts in np.unique(pieces, axis=0):
        group = elements.take((pieces == counts).all(axis=1))
        for place in itertools.product(*(range(count) for count in counts)):
            shift = (np.array(place) + 0.5) / counts - 0.5
            parts.append(replace(group, position=group.position + shift * group.extent,
                                 volume=group.volume / counts.prod(), extent=group.extent / counts))
    return Elements.joined(parts)


class Resampled:
    """Elements on a regular grid of half the spacing over the box lower .. upper (m, one number an active axis).

    `origin` (d) and `grid_spacing` (m) place the nodes; `density` is c, of the grid's shape (d axes, z last).
    `anchor` (d) is a point that the planes of nodes go through. Elements must be mirrored and subdivided already.
    """

    def __init__(self, elements: Elements, case: dict, lower, upper, anchor=None):
        self.spacing, self.dimensions = float(case["spacing"]), int(case["dimensions"])
        self.axes = active_axes(self.dimensions)
        self.grid_spacing = self.spacing / 2.0
        self._margin = int(2 * REACH) + 2   # nodes around the box, so that its own nodes see all elements
        anchor = np.array([case["domain"]["lower"][axis] for axis in self.axes] if anchor is None else anchor, float)
        first = np.floor((np.asarray(lower, float) - anchor) / self.grid_spacing + 1e-6).astype(int)
        last = np.ceil((np.asarray(upper, float) - anchor) / self.grid_spacing - 1e-6).astype(int)
        self.origin = anchor + first * self.grid_spacing
        self.shape = tuple(int(count) for count in last - first + 1)

        place = elements.position[:, self.axes] - (self.origin - self._margin * self.grid_spacing)
        place /= self.grid_spacing
        full = np.array(self.shape) + 2 * self._margin
        inside = ((place >= 0.0) & (place < full - 1)).all(axis=1)
        self._elements, place = elements.take(inside), place[inside]
        self._chosen, self._full_shape = inside, tuple(full)
        self._spread = self._spreading_matrix(place)

        content = self._elements.content(self.dimensions, self.spacing) if inside.any() else np.zeros(0)
        self._weight = content * self._elements.fraction
        unit = self.grid_spacing**self.dimensions
        self._primary = self._smooth(self._weight) / unit
        density = self._primary
        if (elements.fraction < 0.5).any():
            density = density / np.maximum(self._smooth(content) / unit, 0.5)
        self.density = self._crop(density)
        variance = KERNEL_VARIANCE + (CELL_VARIANCE if elements.are_cells else 0.0)
        self.surface_variance = variance * self.spacing**2
        self._moments = None

    def coordinates(self, axis: int) -> np.ndarray:
        """Node coordinates (m) along grid axis `axis`."""
        return self.origin[axis] + self.grid_spacing * np.arange(self.shape[axis])

    def values(self, data: np.ndarray) -> np.ndarray:
        """A field of the primary material, given per element, on the nodes; nan where there is no material.

        data: (n,) for the elements that this object was made of. Linear fields are exact.
        """
        data = np.asarray(data, float)[self._chosen]
        if self._moments is None:
            self._moments = self._prepare_fit()
        valid = self._moments[0]
        surrounded = self._spread.T @ valid.ravel().astype(float) > 1.0 - 1e-9
        result = self._fit(data)
        for _ in range(SHARPENING_PASSES):
            known = self._spread.T @ np.where(valid, result, 0.0).ravel()
            result = result + self._fit(np.where(surrounded, data - known, 0.0))
        return self._crop(np.where(valid, result, np.nan))

    def _spreading_matrix(self, place: np.ndarray) -> csc_matrix:
        """Cloud-in-cell weights, nodes by elements; its transpose interpolates linearly from nodes to elements."""
        count, dimensions = place.shape
        base = np.floor(place).astype(np.int64)
        remainder = place - base
        strides = np.ones(dimensions, dtype=np.int64)
        for axis in range(dimensions - 2, -1, -1):
            strides[axis] = strides[axis + 1] * self._full_shape[axis + 1]
        corners = 2**dimensions
        nodes, weights = np.empty((count, corners), dtype=np.int64), np.empty((count, corners))
        for corner, steps in enumerate(itertools.product((0, 1), repeat=dimensions)):
            nodes[:, corner] = (base + steps) @ strides
            weights[:, corner] = np.prod(np.where(steps, remainder, 1.0 - remainder), axis=1)
        pointers = np.arange(0, count * corners + 1, corners)
        return csc_matrix((weights.ravel(), nodes.ravel(), pointers), shape=(int(np.prod(self._full_shape)), count))

    def _smooth(self, amount: np.ndarray) -> np.ndarray:
        field = (self._spread @ amount).reshape(self._full_shape)
        for axis in range(self.dimensions):
            field = convolve1d(field, BINOMIAL, axis=axis, mode="constant")
        return field

    def _crop(self, field: np.ndarray) -> np.ndarray:
        return field[tuple(slice(self._margin, self._margin + count) for count in self.shape)]

    def _prepare_fit(self):
        """Which nodes have material, total weight, and centroid and inverse covariance of their neighbourhood."""
        unit = self.grid_spacing**self.dimensions
        valid = self._primary > DENSITY_OF_NOTHING
        total = np.where(valid, self._primary * unit, 1.0)
        self._place = (self._elements.position[:, self.axes] - self.origin) / self.spacing
        d = self.dimensions
        centroid = np.stack([self._smooth(self._weight * self._place[:, k]) / total for k in range(d)], axis=-1)
        covariance = np.empty(self._full_shape + (d, d))
        for k, l in itertools.combinations_with_replacement(range(d), 2):
            moment = self._smooth(self._weight * self._place[:, k] * self._place[:, l]) / total
            covariance[..., k, l] = covariance[..., l, k] = moment - centroid[..., k] * centroid[..., l]
        covariance[~valid] = np.eye(d)
        inverse = np.linalg.inv(covariance + GRADIENT_REGULARISATION * np.eye(d))
        nodes = np.stack(np.meshgrid(*((np.arange(count) - self._margin) * 0.5 for count in self._full_shape),
                                     indexing="ij"), axis=-1)
        arm = np.einsum("...kl,...l->...k", inverse, nodes - centroid)
        return valid, total, centroid, arm

    def _fit(self, data: np.ndarray) -> np.ndarray:
        valid, total, centroid, arm = self._moments
        mean = self._smooth(self._weight * data) / total
        result = mean.copy()
        for k in range(self.dimensions):
            slope = self._smooth(self._weight * data * self._place[:, k]) / total - mean * centroid[..., k]
            result += arm[..., k] * slope
        return result
