"""How even a film of melt is: what its depth along x differs by from its mean, by the first Fourier modes of the domain's length L.

    a_n = (2/L) |integral of exp(i k_n x) over the metal| = (2/L) |sum V f exp(i k_n x)|,   k_n = 2 pi n / L   (in 3-D over L times the width)

Like `wave_error` it asks where metal is along the film and not for a contour, so that it is far finer than a spacing; solid that fills the domain's
bottom cancels.

    film_unevenness   sqrt(sum of a_n^2 / 2, n = 1 ... 4) over the melt's mean depth; reference 0
"""

from __future__ import annotations

import numpy as np

from .registry import MeasureError, Reading, measure_of_snapshot
from .snapshot import Snapshot

MODES = np.arange(1, 5)   # shorter ones are as long as the front of a film of a few spacings


@measure_of_snapshot("film_unevenness", unit="1", needs=("liquid_fraction",), exact=lambda case: 0.0)
def film_unevenness(snapshot: Snapshot) -> Reading:
    case, elements = snapshot.case, snapshot.elements
    domain = case["domain"]
    length = float(domain["upper"][0] - domain["lower"][0])
    breadth = float(domain["upper"][1] - domain["lower"][1]) if case["dimensions"] == 3 else 1.0
    weight = elements.content(case["dimensions"], case["spacing"]) * elements.fraction
    depth = float(weight[elements.liquid_fraction >= 0.5].sum()) / (length * breadth)
    if depth <= 0.0:
        raise MeasureError(f"{elements.source}: nothing is molten; there is no film to measure")
    phase = np.exp(2j * np.pi / length * np.outer(MODES, elements.position[:, 0] - domain["lower"][0]))
    amplitude = 2.0 / (length * breadth) * np.abs(phase @ weight)
    if elements.extent is not None:   # a cell's mean of the wave is less than its middle's
        amplitude /= np.sinc(float(np.median(elements.extent[:, 0])) / length * MODES)
    return Reading(float(np.sqrt((amplitude**2).sum() / 2.0)) / depth, beside={"mean_depth_m": depth})
