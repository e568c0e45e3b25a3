# SPDX-License-Identifier: BSD-3-Clause
"""From a scene on disk to a measured and shown one: what ./run SCENE does."""
import os
import sys

from . import display, options as command_line
from .files import OutputFolder
from .progress import Progress, Stopped

BAD_INPUT = 2
STOPPED = 130


def _say(text):
    sys.stderr.write(text + "\n")
    sys.stderr.flush()


def main(arguments=None):
    """Runs the front end; returns the exit status."""
    options = command_line.parse(arguments)
    if options.version:
        from .versions import versions

        for name, version in versions().items():
            print(name, version)
        return 0
    progress = Progress(quiet=options.quiet)
    from .faults import InputFault  # imports VTK: after the options were found good

    try:
        with progress:
            summary, published = _run(options, progress)
    except InputFault as fault:
        _say(f"run: {fault}")
        return BAD_INPUT
    except Stopped:
        _say("stopped; nothing was written")
        return 128 + (progress.stop or 2)
    except (OSError, display.DisplayError) as error:
        what = f"{error.filename}: {error.strerror}" if getattr(error, "strerror", None) else error
        _say(f"run: {what}")
        return BAD_INPUT if isinstance(error, (NotADirectoryError, PermissionError)) else 1
    try:
        _announce(summary, published)
    except BrokenPipeError:  # whoever read it had enough; the files are there
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return 0


def _announce(summary, published):
    print(summary)
    print()
    width = max(len(os.path.relpath(path)) for path, _ in published)
    for path, description in published:
        print(f"{os.path.relpath(path).ljust(width)}  {description}")
    sys.stdout.flush()


def _run(options, progress):
    from . import scene as scenes
    from .compute import run
    from .vtkRadiometryFilters import vtkIrradianceFilter

    if options.study is not None:
        from . import study as studies

        reference = studies.read_reference(options.study_reference)
    path = scenes.find(options.scene)
    scene = scenes.read(path, options, progress)
    last = vtkIrradianceFilter()
    results = [run(last, "Irradiance", scene, options, progress)]
    if options.radiosity:
        from .vtkRadiometryFilters import vtkRadiosityFilter

        last = vtkRadiosityFilter()
        results.append(run(last, "Radiosity", scene, options, progress))
    study = None
    if options.study is not None:
        study = studies.run(last, results[-1].name, reference, options, progress)
    display.ensure()
    with OutputFolder(options.output) as output:
        progress.on_second_signal = output._clean
        from .outputs import write_all

        summary = write_all(output, scene, results, options, progress, study)
        progress.check()
        published = output.publish()
    return summary, published
