"""The laser's track: where the beam is, and the frame (along, across, up) that pools are measured in."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .elements import Elements


@dataclass(frozen=True)
class Track:
    """begin (2) m in the plane of the plate, direction (2) of length 1, length m, speed m/s, start s, spot_radius m.

    Without a laser: along x from the domain's corner, speed 0, spot_radius 0.
    """

    begin: np.ndarray
    direction: np.ndarray
    length: float
    speed: float
    start: float
    spot_radius: float

    @staticmethod
    def of_case(case: dict) -> Track:
        laser = case.get("laser")
        if not laser:
            return Track(np.zeros(2), np.array([1.0, 0.0]), 0.0, 0.0, 0.0, 0.0)
        begin, end = (np.array([laser["path"][key][0], (list(laser["path"][key]) + [0.0])[1]], float)
                      for key in ("from", "to"))
        length = float(np.linalg.norm(end - begin))
        direction = (end - begin) / length if length > 0.0 else np.array([1.0, 0.0])
        return Track(begin, direction, length, float(laser["speed"]), float(laser.get("start") or 0.0),
                     float(laser["spot_radius"]))

    def along(self, time: float) -> float:
        """Distance (m) from the begin of the track at which the beam is at `time` (s), held at its ends."""
        return float(np.clip(self.speed * (time - self.start), 0.0, self.length))

    def frame(self, elements: Elements) -> Elements:
        """The elements with positions (along the track from its begin, across it, height)."""
        offset = elements.position[:, :2] - self.begin
        along = offset @ self.direction
        across = offset @ np.array([-self.direction[1], self.direction[0]])
        extent = elements.extent
        if extent is not None:   # the box around the turned box
            turn = np.abs(np.array([self.direction, [-self.direction[1], self.direction[0]]]))
            extent = np.column_stack([extent[:, :2] @ turn.T, extent[:, 2]])
        return replace(elements, position=np.column_stack([along, across, elements.position[:, 2]]), extent=extent)

    def limits(self, case: dict) -> tuple[np.ndarray, np.ndarray]:
        """Lower and upper corner (3) m of the domain in the frame of the track; none aside unless the track is along x."""
        corners = np.array([case["domain"]["lower"], case["domain"]["upper"]], float)
        if abs(self.direction[1]) > 1e-9:
            return np.array([-np.inf, -np.inf, corners[0, 2]]), np.array([np.inf, np.inf, corners[1, 2]])
        corners[:, :2] = (corners[:, :2] - self.begin) * self.direction[0]
        return corners.min(axis=0), corners.max(axis=0)

    def across_of(self, y: float) -> float | None:
        """Where the plane of constant y lies across the track; None unless the track is along x."""
        return float((y - self.begin[1]) * self.direction[0]) if abs(self.direction[1]) < 1e-9 else None
