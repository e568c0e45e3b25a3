# SPDX-License-Identifier: BSD-3-Clause
"""Random pictures: what Auto and Off leave out changes no pixel by more than the bound of the effect plan.
Bounds in closed form are in tests/core/EffectBoundsTest.cxx."""
import math

import numpy as np

from drawing import Window, lights, polydata, run
from effects import AUTO, OFF, ROWS, differs, plan_of
from vtkmodules.vtkRenderingCore import vtkProperty


def sheet(rng):
    """A bent sheet that shows both its sides, and normals of its own."""
    n = 8
    ticks = np.linspace(-0.9, 0.9, n + 1)
    a, b = rng.uniform(1, 3, 2)
    height = [0.5 * math.sin(a * x) * math.cos(b * y) for y in ticks for x in ticks]
    normals = [(-0.5 * a * math.cos(a * x) * math.cos(b * y),
                0.5 * b * math.sin(a * x) * math.sin(b * y), 1) for y in ticks for x in ticks]
    points = [(x, y, height[j * (n + 1) + i]) for j, y in enumerate(ticks)
              for i, x in enumerate(ticks)]
    cells = []
    for j in range(n):
        for i in range(n):
            k = j * (n + 1) + i
            cells.append((k, k + 1, k + n + 2, k + n + 1) if (i + j) % 3 else
                         (k + n + 1, k + n + 2, k + 1, k))  # some look away
    return polydata(points, cells, normals)


def random_lights(rng, family):
    records = []
    for kind in family["lights"]:
        for _ in range(rng.integers(1, 4)):
            place = rng.normal(size=3)
            place *= rng.uniform(1.3, 6) / np.linalg.norm(place)
            place[2] = abs(place[2])
            record = {
                "LightType": kind, "Position": tuple(place),
                "Direction": tuple(-place + 0.3 * rng.normal(size=3)),
                "Intensity": tuple(rng.uniform(0, 3, 3) * 10.0 ** rng.uniform(-3, 0)),
                "SpotCutoff": rng.uniform(5, 90) if kind == 1 else 180.0,
                "SpotExponent": rng.uniform(0, 20) if kind == 1 and rng.random() < 0.5 else 0.0,
                "SpotInnerCutoff": rng.uniform(0, 5) if kind == 1 and rng.random() < 0.3 else -1.0,
            }
            if family.get("legacy"):
                record["Attenuation"] = tuple(rng.uniform(0.1, 1, 3))
            if family.get("ambient"):
                record["AmbientColor"] = tuple(rng.uniform(0, 0.1, 3))
            records.append(record)
    return lights(*records)


FAMILIES = [
    {"lights": (2,), "model": 2, "shading": 2, "back": True, "off": ("Specular", "LocalViewer", "DirectionalLights")},
    {"lights": (0, 2), "model": 0, "shading": 1, "off": ("LocalViewer", "PointLights", "TwoSided")},
    {"lights": (0,), "model": 1, "shading": 2, "legacy": True, "ambient": True,
     "off": ("Attenuation", "GlobalAmbient", "Emission")},
    {"lights": (1,), "model": 2, "shading": 2, "back": True, "off": ("SpotShape", "SpotLights", "LocalViewer")},
    {"lights": (0, 1), "model": 0, "shading": 1, "ambient": True,
     "off": ("SpotShape", "Specular", "GlobalAmbient")},
    {"lights": (1, 2), "model": 1, "shading": 1, "back": True, "parallel": True,
     "off": ("TwoSided", "SpotShape", "Specular")},
]


def scene(w, rng, family):
    mapper, p = w.mapper, w.actor.GetProperty()
    mapper.SetInputDataObject(sheet(rng))
    mapper.SetLightData(random_lights(rng, family))
    mapper.SetReflectionModel(family["model"])
    mapper.SetShading(family["shading"])
    mapper.SetLightScale(rng.uniform(0.3, 2))
    mapper.SetMetersPerUnit(rng.uniform(0.5, 2))
    p.SetDiffuseColor(*rng.random(3))
    p.SetSpecularColor(*rng.random(3))
    p.SetSpecular(rng.random() * 10.0 ** rng.uniform(-4, 0))
    p.SetSpecularPower(float(rng.choice([0, 0.5, 1, 3, 20, 100])))
    p.SetAmbient(rng.random() * 10.0 ** rng.uniform(-4, 0) if family.get("ambient") else 0.0)
    p.SetAmbientColor(*rng.random(3))
    mapper.SetGlobalAmbient(*rng.uniform(-0.2, 1, 3))
    glow = "Emission" in family["off"]
    mapper.SetEmission(*(rng.random(3) * 10.0 ** rng.uniform(-4, 0) if glow else (0, 0, 0)))
    back = None
    if family.get("back"):
        back = vtkProperty()
        back.SetDiffuseColor(*rng.random(3))
        back.SetSpecular(p.GetSpecular())
        back.SetSpecularPower(float(rng.choice([0, 2, 50])))
    w.actor.SetBackfaceProperty(back)
    camera = w.renderer.GetActiveCamera()
    camera.SetParallelProjection(bool(family.get("parallel")))
    distance = 10.0 ** rng.uniform(0.6, 2.5)
    camera.SetPosition(*(distance * np.array((rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5), 1.0))))
    camera.SetViewAngle(2 * math.degrees(math.atan(1.1 / distance)))
    w.renderer.ResetCameraClippingRange()


def reset(w):
    for effect in ROWS:
        if effect != "SpectralBands":
            w.mapper.SetEffectSwitch(effect, AUTO)
    w.mapper.SetEffectTolerance(0)
    w.mapper.SetEveryEffect(False)


def test_random_scenes_stay_within_their_bounds():
    rng = np.random.default_rng(20)
    w = Window(40)
    dropped, used, offs = {}, [], {}
    count = 0
    for family in FAMILIES:
        for k in range(20):
            scene(w, rng, family)
            reset(w)
            w.mapper.SetEveryEffect(True)
            every = w.draw()
            assert all(row["Decision"] in ("simulated", "not needed") for row in plan_of(w.mapper).values())
            reset(w)
            exact = w.draw()
            assert differs(every, exact)[1] <= 0, (k, differs(every, exact))
            assert np.isfinite(exact).all()

            tolerance = 10.0 ** rng.uniform(-4, -0.5)
            w.mapper.SetEffectTolerance(tolerance)
            auto = w.draw()
            rows = plan_of(w.mapper)
            left = {name: row["Bound"] for name, row in rows.items() if row["Decision"] == "dropped"}
            assert sum(left.values()) <= tolerance
            most, beyond = differs(every, auto)
            assert beyond <= sum(left.values()), (family, k, most, left)
            for name in left:
                dropped[name] = dropped.get(name, 0) + 1

            reset(w)
            effect = family["off"][k % len(family["off"])]
            w.mapper.SetEffectSwitch(effect, OFF)
            off = w.draw()
            row = plan_of(w.mapper)[effect]
            assert row["Switch"] == "Off" and row["Decision"] != "simulated"
            most, beyond = differs(every, off)
            bound = row["Bound"] if row["Decision"] == "left out" else 0.0
            assert beyond <= bound, (family, k, effect, most, row)
            if most > 1e-3:
                used.append(bound / most)
                offs[effect] = offs.get(effect, 0) + 1
            count += 1
    assert count >= 100
    # It was put to the test: effects were dropped and switched off that can be seen.
    assert len(dropped) >= 6 and sum(dropped.values()) > 60, dropped
    assert len(offs) >= 8 and len(used) > 50, offs
    print("dropped", dropped, "off", offs, "bound over change: median", np.median(used),
          "least", min(used))


run(globals())
