# SPDX-License-Identifier: BSD-3-Clause
"""examples/cornell-box/spectral.py on a coarse mesh: 76 bands and three make nearly the same picture."""
import os
import sys
import tempfile

import display

display.ensure()
sys.path.insert(0, os.path.join(os.environ["RADIOMETRY_SOURCE_DIR"], "examples", "cornell-box"))
import spectral  # noqa: E402

with tempfile.TemporaryDirectory() as folder:
    table = spectral.main(folder, edge=0.3, tolerance=0.1, size=96)
    for name in ("spectral.exr", "rgb.exr", "comparison.png", "luminance.png"):
        assert os.path.getsize(os.path.join(folder, name)) > 1000, name
columns = {name: [table.GetColumnByName(name).GetValue(row) for row in range(4)]
           for name in ("Channel", "MeanA", "MeanB", "RelativeRMSE", "NonFiniteA", "NonFiniteB")}
assert columns["Channel"] == ["R", "G", "B", "All"]
assert columns["NonFiniteA"][3] == columns["NonFiniteB"][3] == 0
for a, b, rmse in zip(columns["MeanA"], columns["MeanB"], columns["RelativeRMSE"]):
    assert a > 0 and abs(b / a - 1) < 0.03, columns
    assert 0 < rmse < 0.03, columns  # 0.6 % on a fine mesh; 0 would be no second simulation
print(columns)
