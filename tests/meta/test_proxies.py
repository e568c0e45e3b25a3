# SPDX-License-Identifier: BSD-3-Clause
"""Classes and ParaView proxies carry the same words.

Every public class that has a ParaView name has paraview-xml/<class>.xml with a proxy of that
class and that label; every XML file defines the class it is named after; every class it names is
the project's own or starts with vtk; a property has the same name in ParaView's Python, which takes
it from the label, as in VTK's.
"""
import os
import re
import xml.etree.ElementTree as ElementTree

import source_tree

# Public class -> ParaView name. A class that is not built yet is not asked for its XML.
NAMES = {
    "vtkIrradianceFilter": "Irradiance",
    "vtkRadiosityFilter": "Radiosity",
    "vtkVertexNormalsFilter": "Vertex Normals",
    "vtkViewFactorFilter": "View Factors",
    "vtkRadianceFilter": "Radiance",
    "vtkPointLightSource": "Point Light",
    "vtkSpotLightSource": "Spot Light",
    "vtkDirectionalLightSource": "Directional Light",
    "vtkAreaLightSource": "Area Light",
    "vtkEnvironmentLightSource": "Environment Light",
    "vtkSurfaceMaterialFilter": "Surface Material",
    "vtkReflectanceLobeSource": "Reflectance Lobe",
    "vtkPhotometricFileReader": "Luminaire Reader",
    "vtkRadiometricSceneReader": "Radiometric Scene Reader",
    "vtkRadiometricStatistics": "Radiometric Statistics",
    "vtkAccuracyStudy": "Accuracy Study",
    "vtkWorkPlaneSource": "Work Plane",
    "vtkRadiometricSurfaceRepresentation": None,  # label free: a representation
    "vtkRadiometricLightRepresentation": None,
    "vtkRadiometricView": "Radiometric View",
    "vtkSpectrumToRGBFilter": "Spectrum to RGB",
    "vtkExposureFilter": "Exposure",
    "vtkFalseColorImageFilter": "False Color Image",
    "vtkImageComparisonFilter": "Image Comparison",
    "vtkOpenColorIOPass": None,  # reached through the view
    "vtkOpenColorIOImageFilter": "OpenColorIO Transform",
    "vtkOpenEXRWriter": None,  # a writer has no label of its own
    "vtkOpenEXRReader": "OpenEXR",
}
NEED_XML = {name for name in NAMES if name != "vtkOpenColorIOPass"}


def headers(tree):
    return {
        os.path.basename(path)[:-2]
        for path in tree
        if re.match(r"(filters|rendering)/.*vtk\w+\.h$", path)
    }


def check(classes, xml_texts):
    """`classes`: names with a header; `xml_texts`: {file name: text}."""
    problems = []
    for name in sorted(classes & NEED_XML):
        if name + ".xml" not in xml_texts:
            problems.append(f"{name}: no paraview-xml/{name}.xml")
    for file_name, content in sorted(xml_texts.items()):
        expected = file_name[: -len(".xml")]
        try:
            root = ElementTree.fromstring(content)
        except ElementTree.ParseError as error:
            problems.append(f"{file_name}: {error}")
            continue
        proxies = [(group.get("name"), e) for group in root.iter("ProxyGroup") for e in group
                   if e.get("class")]
        named = [(group, e) for group, e in proxies if e.get("class") == expected]
        if not named:
            problems.append(f"{file_name}: defines no proxy with class=\"{expected}\"")
            continue
        if expected not in classes:
            problems.append(f"{file_name}: there is no header {expected}.h")
        label = NAMES.get(expected)
        for group, proxy in named:
            if group.endswith("_internal"):
                continue  # what other proxies are based on; ParaView never shows it
            if label and proxy.get("label") != label:
                problems.append(
                    f"{file_name}: label \"{proxy.get('label')}\" should be \"{label}\""
                )
            if proxy.find("Documentation") is None:
                problems.append(f"{file_name}: proxy {proxy.get('name')} has no Documentation")
            if group in ("sources", "filters"):
                problems += [
                    f"{file_name}: label \"{p.get('label')}\" makes another name than {p.get('name')}"
                    for p in proxy
                    if p.tag.endswith("Property") and p.get("label")
                    and re.sub(r"\W", "", p.get("label")) != p.get("name")
                ]
    return problems


def self_check():
    good = ('<ServerManagerConfiguration><ProxyGroup name="filters"><SourceProxy name="I" '
            'class="vtkIrradianceFilter" label="Irradiance"><Documentation>x</Documentation>'
            "</SourceProxy></ProxyGroup></ServerManagerConfiguration>")
    name = "vtkIrradianceFilter"
    assert check({name}, {name + ".xml": good}) == []
    assert len(check({name}, {})) == 1
    assert len(check(set(), {name + ".xml": good})) == 1
    assert len(check({name}, {name + ".xml": good.replace('"Irradiance"', '"Light"')})) == 1
    assert len(check({name}, {name + ".xml": good.replace("<Documentation>x</Documentation>", "")})) == 1
    assert len(check({name}, {name + ".xml": good.replace(name, "vtkOther")})) == 1
    assert len(check({name}, {name + ".xml": good + "<"})) == 1
    end = "</SourceProxy>"
    alike = '<DoubleVectorProperty name="TimeBudget" label="Time Budget"/>' + end
    assert check({name}, {name + ".xml": good.replace(end, alike)}) == []
    other = '<DoubleVectorProperty name="TimeBudget" label="Seconds"/>' + end
    assert len(check({name}, {name + ".xml": good.replace(end, other)})) == 1


if __name__ == "__main__":
    self_check()
    files = source_tree.files()
    xml = {
        os.path.basename(path): source_tree.text(path)
        for path in files
        if path.startswith("paraview-xml/") and path.endswith(".xml")
    }
    assert xml, "no XML found"
    source_tree.finish(check(headers(files), xml))
