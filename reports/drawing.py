"""Shared by all figures: style, sections through elements, and pictures as text for the page."""

from __future__ import annotations

import base64
import io
from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import numpy as np
from cupel.measures.elements import Elements
from matplotlib import pyplot
from matplotlib.figure import Figure as Canvas
from scipy.spatial import cKDTree

pyplot.rcParams.update({
    "font.family": "DejaVu Sans", "font.size": 9, "axes.spines.top": False, "axes.spines.right": False,
    "axes.edgecolor": "#6b7280", "axes.labelcolor": "#1f2933", "xtick.color": "#4b5563", "ytick.color": "#4b5563",
    "axes.titlesize": 9.5, "axes.titleweight": "bold", "axes.titlelocation": "left", "axes.grid": False,
    "grid.color": "#e5e7eb", "legend.frameon": False, "figure.dpi": 100, "savefig.dpi": 150,
})

AXIS = {"x": 0, "y": 1, "z": 2}


@dataclass
class Picture:
    """A figure of the page: image as data URI ('' if it could not be made), caption, and words for those who cannot see.

    Three-dimensional views name the solver in `view_of`; those that belong beside other powers are `of_power`.
    """

    identity: str
    caption: str
    alternative: str
    image: str = ""
    missing: str = ""
    paper: str = ""
    wide: bool = True
    view_of: str = ""
    of_power: bool = False


def encode(canvas: Canvas) -> str:
    """The figure as a PNG data URI; the figure is closed."""
    buffer = io.BytesIO()
    canvas.savefig(buffer, format="png", bbox_inches="tight", facecolor="white")
    pyplot.close(canvas)
    return data_uri(buffer.getvalue())


def data_uri(png: bytes) -> str:
    """PNG bytes as a data URI."""
    return "data:image/png;base64," + base64.b64encode(png).decode()


def crop(path: Path, margin: int = 12) -> str:
    """A drawn view without the white around it, as a data URI."""
    from PIL import Image, ImageChops

    picture = Image.open(path).convert("RGB")
    box = ImageChops.difference(picture, Image.new("RGB", picture.size, (255, 255, 255))).getbbox()
    if box is not None:
        left, top, right, bottom = box
        picture = picture.crop((max(0, left - margin), max(0, top - margin),
                                min(picture.width, right + margin), min(picture.height, bottom + margin)))
    buffer = io.BytesIO()
    picture.quantize(192, dither=Image.Dither.NONE).save(buffer, format="png", optimize=True)
    return data_uri(buffer.getvalue())


@dataclass
class Section:
    """Fields on a fine grid in the plane through `offset` along `normal`: rows along `up`, columns along `across` [m]."""

    across: np.ndarray
    up: np.ndarray
    inside: np.ndarray
    values: dict[str, np.ndarray]
    points_a_spacing: float

    @property
    def extent_mm(self) -> list[float]:
        return [1e3 * self.across[0], 1e3 * self.across[-1], 1e3 * self.up[0], 1e3 * self.up[-1]]


def section(elements: Elements, spacing: float, normal: str = "y", offset: float = 0.0, window=None) -> Section:
    """Cuts elements with a plane: each point of the plane takes the values of the nearest element.

    `window` ((low, high), (low, high)) [m] in the plane's axes; None: the elements' own box. Points farther than 0.9
    spacings from any element, or nearest to one of the surrounding, are not `inside`.
    """
    first, second = [axis for axis in "xyz" if axis != normal]
    near = np.abs(elements.position[:, AXIS[normal]] - offset) <= 1.01 * spacing
    slab = elements.take(np.flatnonzero(near))
    if slab.count == 0:
        raise ValueError(f"no elements at {normal} = {offset:g} m")
    plane = slab.position[:, [AXIS[first], AXIS[second]]]
    if window is None:
        window = tuple(zip(plane.min(axis=0) - 0.5 * spacing, plane.max(axis=0) + 0.5 * spacing))
    step = max(spacing / 4, max(high - low for low, high in window) / 900)
    across, up = (np.arange(low + 0.5 * step, high, step) for low, high in window)
    grid = np.stack(np.meshgrid(across, up), axis=-1).reshape(-1, 2)
    points = np.insert(grid, AXIS[normal], offset, axis=1)
    distance, index = cKDTree(slab.position).query(points)
    shape = (len(up), len(across))
    inside = (distance < 0.9 * spacing) & (slab.fraction[index] > 0.5)
    values = {"fraction": slab.fraction[index].reshape(shape), "near": (distance < 0.9 * spacing).reshape(shape)}
    for name in ("temperature", "liquid_fraction", "peak_temperature"):
        field = getattr(slab, name)
        if field is not None:
            values[name] = field[index].reshape(shape)
    if slab.velocity is not None:
        for name, axis in (("across", first), ("up", second)):
            values[f"velocity_{name}"] = slab.velocity[index, AXIS[axis]].reshape(shape)
        values["speed"] = np.linalg.norm(slab.velocity[index], axis=1).reshape(shape)
    return Section(across, up, inside.reshape(shape), values, spacing / step)


def arrows(axes, cut: Section, where: np.ndarray, count: int = 34, colour: str = "#111827") -> float:
    """Draws velocity arrows on about `count` columns of a section where `where` holds; returns the greatest speed shown [m/s]."""
    step = max(1, len(cut.across) // count)
    rows, columns = slice(step // 2, None, step), slice(step // 2, None, step)
    shown = where[rows, columns]
    if not shown.any():
        return 0.0
    x, z = np.meshgrid(1e3 * cut.across[columns], 1e3 * cut.up[rows])
    u, w = (cut.values[f"velocity_{name}"][rows, columns][shown] for name in ("across", "up"))
    greatest = float(np.hypot(u, w).max())
    if greatest > 0:
        width = 1e3 * step * (cut.across[1] - cut.across[0])
        axes.quiver(x[shown], z[shown], u, w, color=colour, angles="xy", scale_units="xy", scale=greatest / (1.6 * width),
                    width=0.0016, headwidth=4, headlength=4.5)
    return greatest


def smooth(values: np.ndarray, width: float) -> np.ndarray:
    """Values smoothed over `width` grid points, for contour lines only: the lines then do not follow the edges of elements."""
    from scipy.ndimage import gaussian_filter

    return gaussian_filter(values.astype(float), width)


def nearest_times(times: tuple[float, ...], wanted: list[float]) -> list[int]:
    """Indices of the snapshots nearest to the wanted times, each once, in order."""
    return sorted({int(np.argmin(np.abs(np.asarray(times) - time))) for time in wanted})
