# SPDX-License-Identifier: BSD-3-Clause
"""pvpython loads the plugin; every proxy of paraview-xml/ is created and executed.

What to do with a proxy follows from its definition: its group, its input properties and their
domains, its file name property. A proxy without a way to be executed here is an error.
"""
import glob
import os
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

import tiny_scene
from paraview import servermanager, simple
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow

SOURCE = os.environ["RADIOMETRY_SOURCE_DIR"]
window = vtkStringOutputWindow()
vtkOutputWindow.SetInstance(window)


def say(*words):
    """pvpython sends print() to VTK's output window, which this test listens to."""
    os.write(1, (" ".join(map(str, words)) + "\n").encode())


def definitions():
    """{(group, name): proxy element} of every proxy that our XML defines with a class."""
    found = {}
    for path in sorted(glob.glob(os.path.join(SOURCE, "paraview-xml", "*.xml"))):
        for group in ElementTree.parse(path).getroot().iter("ProxyGroup"):
            for element in group:
                if element.tag.endswith("Proxy") and element.get("class"):
                    found[group.get("name"), element.get("name")] = element
    return found


def input_properties(element, known):
    """The proxy's input properties, those of the proxy that it is based on first."""
    base = known.get((element.get("base_proxygroup"), element.get("base_proxyname")))
    inherited = input_properties(base, known) if base is not None else []
    return inherited + list(element.iter("InputProperty"))


def input_type(prop):
    """The first data type that an input property accepts."""
    types = [d.get("value") for domain in prop.iter("DataTypeDomain") for d in domain]
    return types[0] if types else "vtkPolyData"


def provide(prop, scene, owner=None):
    """A producer that suits this input property of class `owner`, or None to leave it empty."""
    name, kind = prop.get("name"), input_type(prop)
    if owner == "vtkRadiometricStatistics" or (owner == "vtkAccuracyStudy" and name == "Input"):
        # They want results.
        return simple.Irradiance(
            Input=scene, Lights=simple.PointLight(Position=[0.1, 0.2, 1.5], Intensity=10.0))
    if name == "Lights":
        return simple.PointLight(Position=[0.1, 0.2, 1.5], Intensity=10.0)
    if prop.find("Hints/Optional") is not None and name != "Input":
        return None
    if kind in ("vtkImageData", "vtkUniformGrid"):
        image = simple.Wavelet(WholeExtent=[-4, 4, -4, 4, 0, 0])
        calculator = simple.Calculator(Input=image, ResultArrayName="RGB")
        calculator.Function = "RTData/300*iHat + 0.5*jHat + 0.25*kHat"
        return calculator
    if kind == "vtkTable":
        return simple.ProgrammableSource(
            OutputDataSetType="vtkTable",
            Script="import numpy; output.RowData.append(numpy.arange(4.0), 'x')")
    return scene


def rows_or_cells(data):
    if data is None:
        return 0
    if data.IsA("vtkTable"):
        return data.GetNumberOfRows()
    return data.GetNumberOfElements(0) + data.GetNumberOfElements(1)  # points, cells


def check(condition, words):
    said = (window.GetOutput() or "").strip()
    if not condition or "error" in said.lower():
        say("FAILED:", words, said)
        sys.exit(1)


with tempfile.TemporaryDirectory() as folder:
    simple.LoadDistributedPlugin("Radiometry", ns=globals())
    gltf = tiny_scene.write(os.path.join(folder, "tiny.gltf"))
    ies = tiny_scene.write_luminaire(os.path.join(folder, "tiny.ies"))
    plane = simple.Plane(XResolution=6, YResolution=6)
    simple.UpdatePipeline()
    view = simple.CreateView("RenderView")
    view.ViewSize = [200, 150]
    seen = {"sources": 0, "filters": 0, "representations": 0}
    files = {".gltf": gltf}
    known = definitions()
    # Groups that end in _internal hold what other proxies are based on, never created itself.
    everything = [(group, element) for (group, _), element in known.items()
                  if not group.endswith("_internal")]
    everything.sort(key=lambda d: d[0] not in ("sources", "writers"))
    everything.sort(key=lambda d: d[1].get("class") == "vtkOpenEXRReader")  # after the writer
    for group, element in everything:
        name = element.get("name")
        label = f"{group}/{name}"
        say(label)
        seen[group] = seen.get(group, 0) + 1
        if group in ("sources", "filters"):
            proxy = servermanager._getPyProxy(
                servermanager.ProxyManager().NewProxy(group, name))
            check(proxy is not None, f"{label} cannot be created")
            if element.get("class") == "vtkOpenEXRReader":
                proxy.FileName = files[".exr"]
            elif element.get("class") == "vtkPhotometricFileReader":
                proxy.FileName = ies
            elif element.get("class") == "vtkSpectrumToRGBFilter":
                proxy.Wavelengths = [450.0, 550.0, 650.0]  # of the normals, for want of a spectrum
            elif proxy.GetProperty("FileName") is not None:
                proxy.FileName = gltf
            for prop in input_properties(element, known):
                producer = provide(prop, plane, element.get("class"))
                if producer is not None:
                    setattr(proxy, prop.get("name"), producer)
            proxy.UpdatePipeline()
            count = max(rows_or_cells(servermanager.Fetch(simple.OutputPort(proxy, port)))
                        for port in range(proxy.SMProxy.GetNumberOfOutputPorts()))
            check(count > 0, f"{label} has an empty output")
        elif group == "writers":
            extension = ".exr" if "EXR" in name else ".out"
            files[extension] = os.path.join(folder, "written" + extension)
            proxy = servermanager._getPyProxy(
                servermanager.ProxyManager().NewProxy(group, name))
            proxy.FileName = files[extension]
            prop = input_properties(element, known)[0]
            proxy.Input = provide(prop, plane)
            proxy.UpdatePipeline()
            check(os.path.getsize(files[extension]) > 100, f"{label} wrote nothing")
        elif group == "representations":
            shown = plane
            if "Light" in name:
                shown = simple.PointLight(Position=[0.1, 0.2, 1.5], Intensity=10.0)
            proxy = servermanager.ProxyManager().NewProxy(group, name)
            check(proxy is not None, f"{label} cannot be created")
            texts = [t.get("text") for t in ElementTree.parse(os.path.join(
                SOURCE, "paraview-xml", element.get("class") + ".xml")).getroot().iter(
                    "RepresentationType") if t.get("subproxy")]
            display = simple.Show(shown, view)
            for text in set(texts):
                display.SetRepresentationType(text)
            simple.Render(view)
            check(True, f"{label} does not draw")
            simple.Hide(shown, view)
        elif group == "views":
            own = simple.CreateView(name)
            own.ViewSize = [200, 150]
            simple.Show(plane, own)
            simple.Render(own)
            check(True, f"{label} does not draw")
            simple.SetActiveView(view)
        elif group in ("misc", "animation", "internal", "settings"):
            check(servermanager.ProxyManager().NewProxy(group, name) is not None,
                  f"{label} cannot be created")
        else:
            check(False, f"no way to execute a proxy of group {group}: extend this test")
    check(seen["sources"] and seen["filters"], f"proxies are missing: {seen}")
    say(seen)
