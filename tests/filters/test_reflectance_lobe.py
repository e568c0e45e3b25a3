# SPDX-License-Identifier: BSD-3-Clause
"""BRDFs as shapes through the source: values, field data, lines, refusals."""
import math

import numpy as np
from checks import Errors, array, close, points, run_all
from vtkradiometry import vtkReflectanceLobeSource


def lobe(**properties):
    source = vtkReflectanceLobeSource()
    for name, value in properties.items():
        getattr(source, "Set" + name)(value)
    source.Update()
    return source.GetOutput()


def field(data, name):
    return array(data.GetFieldData(), name)[0]


def test_lambert():
    data = lobe(ReflectionModel=0, DiffuseReflectance=0.5, Radius=0.0, ShowRays=False)
    close(array(data.GetPointData(), "BRDF"), np.full(data.GetNumberOfPoints(), 0.5 / math.pi))
    close(np.linalg.norm(points(data), axis=1), np.full(data.GetNumberOfPoints(), 0.5 / math.pi))
    for name in ("DirectionalHemisphericalReflectance", "Albedo",
                 "DirectionalHemisphericalReflectanceIntegrated"):
        close(field(data, name), 0.5, relative=1e-6)


def test_physical_phong():
    """Closed form and integral agree within the stated error; the peak is (n + 2)/(2 pi) rho_s + rho_d/pi."""
    for n in (1.0, 20.0, 1000.0):
        for angle in (0.0, 45.0, 80.0):
            data = lobe(Shininess=n, IncidentAngle=angle)
            closed = field(data, "DirectionalHemisphericalReflectance")
            integral = field(data, "DirectionalHemisphericalReflectanceIntegrated")
            error = field(data, "DirectionalHemisphericalReflectanceIntegratedError")
            assert abs(closed - integral) <= error + 1e-9, (n, angle, closed, integral, error)
            assert 0.3 < closed <= 0.6 + 1e-12
            close(field(data, "MaximumBRDF"), 0.3 / math.pi + 0.3 * (n + 2) / (2 * math.pi),
                  relative=1e-6)
            close(field(data, "IncidentAngle"), angle, relative=1e-6, absolute=1e-5)
            close(np.linalg.norm(points(data)[:data.GetNumberOfPoints() - 4], axis=1).max(), 1.0)
    close(field(lobe(IncidentAngle=0.0), "DirectionalHemisphericalReflectance"), 0.6)


def test_reciprocity_of_the_physical_lobe():
    """f(a, b) = f(b, a): the value that the lobe for light from a has toward b."""
    def toward(light_angle, eye_angle):
        data = lobe(IncidentAngle=light_angle, Resolution=400)
        w = array(data.GetPointData(), "OutgoingDirection")
        wanted = np.array([-math.sin(math.radians(eye_angle)), 0, math.cos(math.radians(eye_angle))])
        return array(data.GetPointData(), "BRDF")[np.argmax(w @ wanted)]

    close(toward(20.0, 60.0), toward(60.0, 20.0), relative=0.02)


def test_legacy_models_reflect_more_than_arrives():
    for model in (2, 3):
        data = lobe(ReflectionModel=model, DiffuseReflectance=0.5, SpecularReflectance=1.0,
                    Shininess=2.0, IncidentAngle=85.0)
        assert field(data, "DirectionalHemisphericalReflectance") > 1.0


def test_lines_and_parts():
    data = lobe(Center=(1, 2, 3), Normal=(0, 1, 0), IncidentDirection=(0, -2, 2), Resolution=8)
    assert array(data.GetCellData(), "Part")[:2].tolist() == [1, 2]
    assert data.GetNumberOfLines() == 2 and data.GetNumberOfPolys() == 8 * 16
    p = points(data)[-4:] - (1, 2, 3)
    close(p[0], 1.2 * np.array([0, 1, -1]) / math.sqrt(2), absolute=1e-12)
    close(p[2], [0, 1.2, 0], absolute=1e-12)
    close(field(data, "IncidentAngle"), 45.0, relative=1e-9)
    assert lobe(ShowRays=False).GetNumberOfLines() == 0


def test_log_scale():
    linear, log = lobe(Shininess=1000.0), lobe(Shininess=1000.0, LogScale=True)
    values = array(log.GetPointData(), "BRDF")[:-4]
    r = np.linalg.norm(points(log)[:-4], axis=1)
    close(r, np.maximum(0, 1 + np.log10(values / values.max()) / 3), absolute=1e-9)
    assert np.median(r) > 10 * np.median(np.linalg.norm(points(linear)[:-4], axis=1))


def test_refusals():
    nan = float("nan")
    for properties, word in (
            ({"DiffuseReflectance": 0.9, "SpecularReflectance": 0.5}, "SpecularReflectance"),
            ({"DiffuseReflectance": nan}, "DiffuseReflectance"),
            ({"SpecularReflectance": -0.1}, "SpecularReflectance"),
            ({"Shininess": 1e6}, "Shininess"), ({"Shininess": nan}, "Shininess"),
            ({"IncidentAngle": 90.0}, "IncidentAngle"), ({"IncidentAngle": nan}, "IncidentAngle"),
            ({"IncidentDirection": (0, 0, 1)}, "IncidentDirection"),
            ({"IncidentDirection": (0, nan, 1)}, "IncidentDirection"),
            ({"Normal": (0, 0, 0)}, "Normal"), ({"Center": (nan, 0, 0)}, "Center"),
            ({"Radius": -1.0}, "Radius"), ({"LogScale": True, "Decades": 0.0}, "Decades")):
        source = vtkReflectanceLobeSource()
        for name, value in properties.items():
            getattr(source, "Set" + name)(value)
        errors = Errors(source)
        source.Update()
        assert len(errors.messages) == 1 and word in errors.messages[0], (properties, errors.messages)
        assert source.GetOutput().GetNumberOfPoints() == 0


if __name__ == "__main__":
    run_all(globals())
