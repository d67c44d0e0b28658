"""A drop between a cold and a hot plate (the case of Ma and Bothe 2011) by finite elements that fit the drop: a solution with a
sharp interface, which shares nothing with the solvers of the suite.

In units of radius R, U_r = |d(sigma)/dT| grad(T) R/mu_b, R/U_r and grad(T) R, with w the velocity in the laboratory, theta = T - z,
and nodes that move with v = U(t) inside the drop, 0 at the plates:

    rho (dw/dt + (w - v).grad w)            = -grad p + div[mu (grad w + grad w^T)]          div w = 0
    rho c (dtheta/dt + (w - v).grad theta)  = div(k grad(theta + z)) - rho c w_z
    on the circle: [stress].t = dT/ds,   w.n = U n_z,   and no force on the drop as a whole, which gives U

The drop stays a circle: the limit of a small capillary number (0.0576 here, times U/U_r = 0.15). Taylor-Hood triangles on rings around
the drop's centre, whose pressure is double on the circle; half the plane; BDF2, the convecting velocity extrapolated.

`python3 -m cupel.exact.drop_between_plates` prints the table that thermocapillary_drop.py keeps. In large boxes and creeping flow it
reaches the unbounded drop's 2/9: 0.2176, 0.2210, 0.2219 in boxes of 16, 32 and 64 radii.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import spsolve

# degree 5 on a triangle, seven points (Radon), barycentric
_A, _B = (6.0 - np.sqrt(15.0)) / 21.0, (6.0 + np.sqrt(15.0)) / 21.0
POINTS = np.array([(1/3, 1/3, 1/3)] + [tuple(np.roll((1 - 2*a, a, a), k)) for a in (_A, _B) for k in range(3)])
WEIGHTS = np.array([9/40] + 3*[(155 - np.sqrt(15.0))/1200] + 3*[(155 + np.sqrt(15.0))/1200]) / 2.0
GAUSS, GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(3)


@dataclass(frozen=True)
class Groups:
    """Reynolds and Marangoni number of the outer liquid, drop over bulk for every property, half the box over the radius."""

    reynolds: float = 0.72
    marangoni: float = 0.72
    density: float = 0.5
    viscosity: float = 0.5
    conductivity: float = 0.5
    heat_capacity: float = 0.5
    half_box: float = 2.0


@dataclass(frozen=True)
class Resolution:
    """Triangles' edges along half the circle, along the radius, from the circle to the box; how much finer at the circle (0 … 1)."""

    around: int = 32
    inside: int = 10
    outside: int = 14
    grading: float = 0.6


class Mesh:
    """Triangles of six nodes; nodes of share s move with the box, those with s = 0 with the drop."""

    def __init__(self, resolution: Resolution, half_box: float):
        angle = np.linspace(0.0, np.pi, resolution.around + 1)
        for corner in (0.25*np.pi, 0.75*np.pi):
            angle[np.argmin(np.abs(angle - corner))] = corner
        ray = np.column_stack([np.sin(angle), np.cos(angle)])
        box = ray * half_box / np.abs(ray).max(axis=1)[:, None]
        steps = np.linspace(0.0, 1.0, resolution.outside + 1)[1:]
        steps = steps*(1.0 - resolution.grading + resolution.grading*steps)
        inner = np.linspace(0.0, 1.0, resolution.inside + 1)[1:]
        vertices = [np.zeros((1, 2))] + [r*ray for r in inner] + [(1.0 - s)*ray + s*box for s in steps]
        share = [np.zeros(1)] + [np.zeros(len(ray))]*len(inner) + [np.full(len(ray), s) for s in steps]
        count = len(ray)
        ring = 1 + count*np.arange(len(inner) + len(steps))[:, None] + np.arange(count)
        triangles, outside = [(0, ring[0, i + 1], ring[0, i]) for i in range(count - 1)], [False]*(count - 1)
        for k in range(len(ring) - 1):
            for i in range(count - 1):
                a, b, c, d = ring[k, i], ring[k, i + 1], ring[k + 1, i + 1], ring[k + 1, i]
                triangles += [(a, b, c), (a, c, d)] if 2*i < count - 1 else [(a, b, d), (b, c, d)]
                outside += [k >= len(inner) - 1]*2
        self._finish(np.concatenate(vertices), np.concatenate(share), np.array(triangles), np.array(outside), ring[len(inner) - 1], half_box)

    def _finish(self, vertices, share, triangles, outside, circle, half_box) -> None:
        one, two = vertices[triangles[:, 1]] - vertices[triangles[:, 0]], vertices[triangles[:, 2]] - vertices[triangles[:, 0]]
        turned = one[:, 0]*two[:, 1] < one[:, 1]*two[:, 0]
        triangles[turned] = triangles[turned][:, [0, 2, 1]]
        pairs = np.sort(triangles[:, [[1, 2], [2, 0], [0, 1]]].reshape(-1, 2), axis=1)
        edges, number = np.unique(pairs, axis=0, return_inverse=True)
        self.nodes = np.concatenate([vertices, vertices[edges].mean(axis=1)])
        self.share = np.concatenate([share, share[edges].mean(axis=1)])
        self.six = np.column_stack([triangles, len(vertices) + number.reshape(-1, 3)])
        self.outside = outside
        middles = [len(vertices) + int(np.flatnonzero((edges == sorted(pair)).all(axis=1))[0]) for pair in zip(circle, circle[1:])]
        self.nodes[middles] /= np.linalg.norm(self.nodes[middles], axis=1)[:, None]
        self.circle = np.append(np.column_stack([circle[:-1], middles]).ravel(), circle[-1])
        twin = np.arange(len(vertices))
        twin[circle] = len(vertices) + np.arange(len(circle))
        self.pressure = np.where(outside[:, None], twin[triangles], triangles)
        self.pressures = len(vertices) + len(circle)
        x, z = self.nodes.T
        self.plates = np.abs(np.abs(z) - half_box) < 1e-9
        self.mirrors = (np.abs(x) < 1e-12) | (np.abs(x - half_box) < 1e-9)


def _shape(point: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The six quadratic shape functions at a point, and their derivatives (2, 6)."""
    a, b, c = point
    values = np.array([a*(2*a - 1), b*(2*b - 1), c*(2*c - 1), 4*b*c, 4*c*a, 4*a*b])
    rates = np.array([[1 - 4*a, 4*b - 1, 0, 4*c, -4*c, 4*(a - b)], [1 - 4*a, 0, 4*c - 1, 4*b, 4*(a - c), -4*b]])
    return values, rates


class Elements:
    """Integrals over the mesh with its nodes where they are now."""

    def __init__(self, mesh: Mesh, place: np.ndarray):
        self.mesh, self.place = mesh, place
        self.values, self.gradients, self.measure = [], [], []
        for point, weight in zip(POINTS, WEIGHTS):
            values, rates = _shape(point)
            jacobian = np.einsum("ai,eid->ead", rates, place[mesh.six])
            self.values.append(values)
            self.gradients.append(np.einsum("eda,ai->eid", np.linalg.inv(jacobian), rates))
            self.measure.append(weight*np.linalg.det(jacobian))

    def _assembled(self, local, rows, columns, shape):
        across = np.broadcast_to(rows[:, :, None], local.shape)
        along = np.broadcast_to(columns[:, None, :], local.shape)
        return sparse.coo_matrix((local.ravel(), (across.ravel(), along.ravel())), shape=shape).tocsr()

    def _sum(self, form):
        n, six = len(self.place), self.mesh.six
        local = sum(form(v, g, w) for v, g, w in zip(self.values, self.gradients, self.measure))
        return self._assembled(local, six, six, (n, n))

    def mass(self, c):
        return self._sum(lambda v, g, w: np.einsum("e,i,j->eij", w*c, v, v))

    def stiffness(self, c, row=None, column=None):
        """Of the whole gradient, or of its part `row` of the test and `column` of the trial function."""
        if row is None:
            return self._sum(lambda v, g, w: np.einsum("e,eid,ejd->eij", w*c, g, g))
        return self._sum(lambda v, g, w: np.einsum("e,ei,ej->eij", w*c, g[:, :, row], g[:, :, column]))

    def convection(self, c, velocity):
        six = self.mesh.six

        def form(v, g, w):
            along = np.einsum("ed,ejd->ej", np.einsum("i,eid->ed", v, velocity[six]), g)
            return np.einsum("e,i,ej->eij", w*c, v, along)
        return self._sum(form)

    def divergence(self):
        mesh, n = self.mesh, len(self.place)
        parts = []
        for axis in range(2):
            local = sum(np.einsum("e,p,ei->epi", -w, point, g[:, :, axis]) for point, g, w in zip(POINTS, self.gradients, self.measure))
            parts.append(self._assembled(local, mesh.pressure, mesh.six, (mesh.pressures, n)))
        return sparse.hstack(parts).tocsr()

    def pull_along_circle(self, temperature):
        """Nodal forces (2 n) of the stress -dT/ds, which pulls to the cold side."""
        n, force = len(self.place), np.zeros(2*len(self.place))
        for start in range(0, len(self.mesh.circle) - 2, 2):
            nodes = self.mesh.circle[start:start + 3]
            for s, weight in zip(GAUSS, GAUSS_WEIGHTS):
                values, rates = np.array([s*(s - 1)/2, 1 - s*s, s*(s + 1)/2]), np.array([s - 0.5, -2*s, s + 0.5])
                tangent = rates @ self.place[nodes]
                pull = -(rates @ temperature[nodes])*weight*tangent/np.linalg.norm(tangent)
                force[nodes] += pull[0]*values
                force[n + nodes] += pull[1]*values
        return force


def velocity_curve(groups: Groups = Groups(), resolution: Resolution = Resolution(), step: float = 0.02, end: float = 1.9,
                   moves: bool = True) -> tuple[np.ndarray, np.ndarray]:
    """Times (m) and velocities U (m) of a drop released at rest in the middle of the box; moves=False keeps it there."""
    mesh = Mesh(resolution, groups.half_box)
    n = len(mesh.nodes)

    def of(bulk, ratio):
        return np.where(mesh.outside, bulk, bulk*ratio)
    density, viscosity = of(groups.reynolds, groups.density), of(1.0, groups.viscosity)
    conductivity, capacity = of(1.0, groups.conductivity), of(groups.marangoni, groups.density*groups.heat_capacity)
    w, w_old, theta, theta_old = np.zeros(2*n), np.zeros(2*n), np.zeros(n), np.zeros(n)
    speed = speed_old = way = 0.0
    times, speeds = [], []
    circle, m = mesh.circle, len(mesh.circle)
    normal = mesh.nodes[circle]
    across = sparse.coo_matrix((normal.T.ravel(), (np.tile(np.arange(m), 2), np.concatenate([circle, n + circle]))), shape=(m, 2*n)).tocsr()
    fixed = np.zeros(2*n + mesh.pressures + m + 1, dtype=bool)
    fixed[:n], fixed[n:2*n] = mesh.mirrors | mesh.plates, mesh.plates
    fixed[[2*n, 2*n + mesh.pressure[-1, 0]]] = True                       # one pressure on each side of the circle
    elements = None
    for count in range(1, round(end/step) + 1):
        a, b, c = (1.0, -1.0, 0.0) if count == 1 else (1.5, -2.0, 0.5)
        expected, expected_speed = (w, speed) if count == 1 else (2*w - w_old, 2*speed - speed_old)
        if elements is None or moves:
            way += expected_speed*step if moves else 0.0
            elements = Elements(mesh, mesh.nodes - way*np.column_stack([np.zeros(n), mesh.share]))
            stiffness, heat, mass = elements.stiffness(conductivity), elements.mass(capacity), elements.mass(density)
            mixed = elements.stiffness(viscosity, 1, 0)
            xx, zz = elements.stiffness(viscosity, 0, 0), elements.stiffness(viscosity, 1, 1)
            friction = sparse.bmat([[2*xx + zz, mixed], [mixed.T, xx + 2*zz]]).tocsr()
            divergence = elements.divergence()
        height = elements.place[:, 1] + way
        carried = np.column_stack([expected[:n], expected[n:] - expected_speed*(1.0 - mesh.share if moves else 1.0)])
        inside = ~mesh.plates
        matrix = stiffness + elements.convection(capacity, carried) + heat*(a/step)
        right = -stiffness @ height - heat @ (expected[n:] + (b*theta + c*theta_old)/step)
        theta_old, theta = theta, np.zeros(n)
        theta[inside] = spsolve(matrix[inside][:, inside].tocsc(), right[inside])
        pull = elements.pull_along_circle(theta + height)
        inertia = elements.convection(density, carried) + mass*(a/step)
        flow = friction + sparse.block_diag([inertia, inertia])
        history = sparse.block_diag([mass, mass]) @ (b*w + c*w_old)/step
        rigid = np.concatenate([np.zeros(2*n + mesh.pressures), -normal[:, 1]])[:, None]
        matrix = sparse.bmat([[flow, divergence.T, across.T], [divergence, None, None], [across, None, None]])
        matrix = sparse.bmat([[matrix, rigid], [rigid.T, None]]).tocsr()
        right = np.concatenate([pull - history, np.zeros(mesh.pressures + m), [-pull[n:].sum()]])
        solution = np.zeros(len(right))
        solution[~fixed] = spsolve(matrix[~fixed][:, ~fixed].tocsc(), right[~fixed])
        w_old, w, speed_old, speed = w, solution[:2*n], speed, float(solution[-1])
        times.append(count*step)
        speeds.append(speed)
    return np.array(times), np.array(speeds)


if __name__ == "__main__":
    for moment, value in zip(*velocity_curve()):
        print(f"{moment:.2f} {value:.5f}")
