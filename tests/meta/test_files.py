# SPDX-License-Identifier: BSD-3-Clause
"""Every committed text file: no path of one machine, no leftover marks, a licence line in sources,
no tabs or trailing blanks in C++, and a newline at the end."""
import re

import source_tree

# Written with [.] and split words so that this file passes its own check.
MACHINE_PATH = re.compile(r"(?<![\w.}])/(?:home|root|Users|work)/[\w.-]+|[A-Z]:\\Users\\")
LEFTOVER = re.compile(r"\b(?:TO" r"DO|FIX" r"ME|X" r"XX|HA" r"CK)\b")
CONFLICT = re.compile(r"^(?:<{7}|>{7}) ", re.MULTILINE)
SPDX = "SPDX-License-Identifier: BSD-3-Clause"
SOURCE = (".h", ".hpp", ".cxx", ".cpp", ".txx", ".py", ".glsl")


def is_script(content):
    return content.startswith("#!")


def check(path, content):
    """Problems of one text file."""
    problems = []
    for pattern, what in (
        (MACHINE_PATH, "a path of one machine"),
        (LEFTOVER, "a leftover mark"),
        (CONFLICT, "a merge conflict"),
    ):
        for match in pattern.finditer(content):
            line = content.count("\n", 0, match.start()) + 1
            problems.append(f"{path}:{line}: {what}: {match.group(0).strip()}")
    if path.endswith(SOURCE) or is_script(content):
        if SPDX not in "\n".join(content.split("\n")[:5]):
            problems.append(f"{path}:1: no line \"{SPDX}\"")
    if path.endswith((".h", ".cxx", ".cpp", ".glsl")):
        for number, line in enumerate(content.split("\n"), 1):
            if "\t" in line or line != line.rstrip():
                problems.append(f"{path}:{number}: a tab or a trailing blank")
    if content and not content.endswith("\n") and not path.endswith((".gltf", ".json", ".svg")):
        problems.append(f"{path}: no newline at the end")
    return problems


def self_check():
    header = f"// {SPDX}\n"
    assert check("a.h", header + "int a;\n") == []
    assert check("b.md", "see /usr/bin/python3 and /tmp\n") == []
    for path, content in (
        ("a.h", "int a;\n"),
        ("a.h", header + "int a; \n"),
        ("a.h", header + "int a;"),
        ("b.md", "in /ho" "me/someone/x\n"),
        ("b.md", "TO" "DO: later\n"),
        ("b.md", "<" * 7 + " HEAD\n"),
        ("run", "#!/bin/bash\n"),
    ):
        assert len(check(path, content)) == 1, (path, content, check(path, content))


if __name__ == "__main__":
    self_check()
    found = []
    checked = 0
    for name in source_tree.files():
        body = source_tree.text(name)
        if body is not None:
            checked += 1
            found += check(name, body)
    assert checked > 20, "no sources found"
    source_tree.finish(found)
