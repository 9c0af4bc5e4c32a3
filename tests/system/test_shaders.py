#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What some graphics drivers refuse although the language allows it, and those of this machine do not show.

    test_shaders.py SOURCE_DIR

Drivers' compilers differ: NVIDIA's (580) takes `a[i] = a[j] = x` for reading a[j], which it refuses where a is
writeonly. Mesa and the reference compiler accept it, so that only a machine with such a card would tell.
"""
import re
import sys
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else Path(__file__).resolve().parents[2]

SHADER_SUFFIXES = {".comp", ".vert", ".frag", ".glsl"}
ASSIGNMENT = re.compile(r"(?<![=!<>+\-*/|&^])=(?!=)")


def statements(text):
    """Without comments; a declaration of several names is several of them."""
    text = re.sub(r"//[^\n]*|#[^\n]*", "", text)
    depth, begin, found = 0, 0, []
    for at, c in enumerate(text):
        depth += (c in "([") - (c in ")]")
        if c in ";{}" or (c == "," and depth == 0):
            found.append(text[begin:at].strip())
            begin = at + 1
    return found


def chained(text):
    """The statements that assign a value to several places."""
    return [s for s in statements(text) if len(ASSIGNMENT.findall(re.sub(r"\([^()]*\)", "", s))) > 1]


class Shaders(unittest.TestCase):
    def test_values_are_assigned_to_one_place_at_a_time(self):
        shaders = [path for part in ("core", "gui") for path in (SOURCE / part).rglob("*")
                   if path.suffix in SHADER_SUFFIXES]
        self.assertGreater(len(shaders), 10)
        for path in sorted(shaders):
            self.assertEqual(chained(path.read_text()), [], path)

    def test_what_is_found(self):
        self.assertEqual(chained("back[to] = back[to + 1u] = uvec4(0u);"),
                         ["back[to] = back[to + 1u] = uvec4(0u)"])
        self.assertEqual(chained("a = b = c;"), ["a = b = c"])
        for fine in ("uint a = f(0u, 1u), b = 2u;", "if (a == b) c = d >= e ? 1u : 0u;", "sum += a;",
                     "for (uint i = 0u; i < 3u; ++i, at += 3u) mixing[i] = row[at];", "// a = b = c\nd = e;",
                     "layout(std430, binding = 0) readonly buffer Leaves { uvec2 leaf[]; };",
                     "layout(location = 3) uniform uint columns;"):
            self.assertEqual(chained(fine), [], fine)


if __name__ == "__main__":
    unittest.main()
