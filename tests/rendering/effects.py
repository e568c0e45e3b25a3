# SPDX-License-Identifier: BSD-3-Clause
"""What tests of the picture's effect plan share: its rows, and how far two pictures are apart."""
import numpy as np

AUTO, ON, OFF = 0, 1, 2
SUN = {"LightType": 2}
POINT = {"LightType": 0, "Position": (0, 0, 3)}
SPOT = {"LightType": 1, "Position": (0, 0, 3), "SpotCutoff": 30}
ROWS = ["Occlusion", "Emission", "Environment", "SpotShape", "Attenuation", "PointLights",
        "SpotLights", "DirectionalLights", "AreaLights", "CandelaWebs", "GlobalAmbient",
        "SpectralBands", "Specular", "TwoSided", "LocalViewer", "Translucency"]


def plan_of(mapper):
    """{effect: {column: value}}"""
    table = mapper.GetEffectPlan()
    names = [table.GetColumnName(c) for c in range(table.GetNumberOfColumns())]
    assert names == ["Effect", "Switch", "Decision", "Bound", "Unit", "Seconds", "Why"], names
    rows = [{n: table.GetValueByName(r, n) for n in names} for r in range(table.GetNumberOfRows())]
    values = {str(row["Effect"].ToString()): {
        n: row[n].ToDouble() if n in ("Bound", "Seconds") else row[n].ToString() for n in names}
        for row in rows}
    assert sorted(values) == sorted(ROWS), sorted(values)
    return values


def rounding(*pictures):
    """Of float32, where the same light is computed by other text; relative where it is above 1."""
    return 1e-5 * np.maximum(1.0, np.max([np.abs(p) for p in pictures], axis=0))


def differs(a, b):
    """Greatest difference of colours, and of what is left of it after rounding."""
    difference = np.abs(a - b)[:, :, :3]
    return difference.max(), (difference - rounding(a, b)[:, :, :3]).max()
