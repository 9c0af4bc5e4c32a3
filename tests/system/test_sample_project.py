#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A project outside the tree finds the installed package, builds against its headers and libraries, and measures.

    test_sample_project.py SOURCE_DIR BUILD_DIR
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE, BUILD = (Path(argument).resolve() for argument in sys.argv[1:3])
SAMPLE = SOURCE / "tests/system/sample_project"


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          check=False, **options)
    if done.returncode:
        raise AssertionError(f"{' '.join(map(str, command))} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


class InstalledPackage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.prefix = cls.folder / "prefix"
        run("cmake", "--install", BUILD, "--component", "Development", "--prefix", cls.prefix)

    def test_a_project_outside_the_tree_builds_measures_and_compensates(self):
        # In the words of the project itself: without our flags, far from our tree.
        sample = self.folder / "sample"
        shutil.copytree(SAMPLE, sample)
        run("cmake", "-G", "Ninja", "-S", sample, "-B", sample / "build", f"-DCMAKE_PREFIX_PATH={self.prefix}",
            "-DCMAKE_BUILD_TYPE=Release")
        run("cmake", "--build", sample / "build")
        work = self.folder / "work"
        work.mkdir()
        said = run(sample / "build/compensate-corner", SOURCE / "resources/pictures/demo.png", work)
        self.assertRegex(said, r"\d+ patterns photographed, \d+ leaves of T")
        # The command line's evaluation has 20 dB and more for this venue at every size; one picture varies.
        self.assertGreater(float(re.search(r"refined: ([\d.]+) dB", said).group(1)), 20.0)
        self.assertTrue((work / "shown/pattern.png").is_file())

    def test_the_package_names_nothing_of_the_tree_it_was_built_in(self):
        for path in self.prefix.rglob("*.cmake"):
            text = path.read_text()
            for place in (SOURCE, BUILD):
                self.assertNotIn(f"{place}{os.sep}", text, path)

    def test_every_header_is_included_by_its_installed_name(self):
        headers = sorted(path.relative_to(self.prefix / "include") for path in self.prefix.rglob("*.h"))
        self.assertGreater(len(headers), 100)
        for path in headers:
            for name in re.findall(r'^\s*#\s*include\s*"([^"]+)"', (self.prefix / "include" / path).read_text(), re.M):
                self.assertIn(Path(name), headers, f"{path} includes {name}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
