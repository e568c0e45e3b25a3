# SPDX-License-Identifier: BSD-3-Clause
"""A light of the scenes on which accuracy is measured: plain numbers, so that each program is given the
same."""
from dataclasses import dataclass

import numpy as np

POINT, SUN, PANEL, SKY = 0, 2, 3, 4  # LightType of docs/arrays.md


@dataclass
class Lamp:
    kind: int
    intensity: np.ndarray          # a value a band: W/sr; W/m^2; W/m^2; W/(m^2 sr)
    position: np.ndarray = None    # m, of a point light
    direction: np.ndarray = None   # where a sun's light travels to, unit
    corners: np.ndarray = None     # m, of a panel: four corners of a rectangle, front as in docs/arrays.md

    def places(self):
        """Where its vertices are, n x 3."""
        if self.kind == PANEL:
            return self.corners
        return (np.zeros(3) if self.position is None else self.position)[None]


def three(values):
    """One value or three as three, for programs that know RGB alone."""
    return np.broadcast_to(np.asarray(values, float), 3)
