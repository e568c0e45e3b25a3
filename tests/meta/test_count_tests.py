# SPDX-License-Identifier: BSD-3-Clause
"""tools/count-tests counts what ctest wrote, and calls a test that could not start a failure."""
import os
import subprocess
import tempfile

import source_tree

CASES = """<testsuite>
  <testcase name="a" status="run"/>
  <testcase name="b" status="run"/>
  <testcase name="c" status="fail"><failure message=""/></testcase>
  <testcase name="d" status="notrun"><skipped message="SKIP_RETURN_CODE=77"/></testcase>
  <testcase name="e" status="notrun"><skipped message="Unable to find executable: x"/></testcase>
  <testcase name="f" status="disabled"><skipped message="Disabled"/></testcase>
</testsuite>
"""


def run(content):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "results.xml")
        if content is not None:
            with open(path, "w", encoding="utf-8") as stream:
                stream.write(content)
        done = subprocess.run(
            ["/usr/bin/python3", os.path.join(source_tree.ROOT, "tools", "count-tests"), path],
            capture_output=True,
            text=True,
            check=False,
        )
        return done.returncode, done.stdout


assert run(CASES) == (1, "2 passed, 2 failed, 2 skipped\n"), run(CASES)
only_good = '<testsuite><testcase name="a" status="run"/></testsuite>'
assert run(only_good) == (0, "1 passed, 0 failed, 0 skipped\n"), run(only_good)
assert run(None) == (1, "0 passed, 1 failed, 0 skipped\n"), run(None)
assert run("<testsuite>") == (1, "0 passed, 1 failed, 0 skipped\n")
