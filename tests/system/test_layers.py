#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The folders are the architecture: what includes what, and whose every file is.

    test_layers.py SOURCE_DIR

The layers are read from where they are decided: the order from core/CMakeLists.txt and gui/CMakeLists.txt, the
permissions from the USES of each folder's relucent_core_library() or relucent_wizard_library(). The linker cannot
see a wrong include of a header that needs no symbols; this can.
"""
import os
import re
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else Path(__file__).resolve().parents[2]

OWN_FOLDERS = ["core", "gui", "tests", "packaging", ".ci", "resources", "translations"]
# Folders with circles of includes that are still to be broken; no other may have one.
STILL_CIRCULAR = {
    "core/calibration", "core/cli", "core/clustering", "core/compensation", "core/engine/bench", "core/engine/opengl", "core/linearization",
    "core/pipeline", "core/venue", "gui/output", "gui/wizard/output", "gui/wizard/session",
}
SOURCE_SUFFIXES = {".cpp", ".h", ".py", ".sh", ".cmake", ".comp", ".vert", ".frag"}


def order_of_layers(source, part="core"):
    """The folders of core or gui in the order of its CMakeLists.txt."""
    text = (source / part / "CMakeLists.txt").read_text()
    return re.search(r"foreach\(folder\s+([^)]*)\)", text).group(1).split()


def declared_uses(source, part="core", function="relucent_core_library"):
    """Per folder that is built: the folders that its library USES, as written."""
    uses = {}
    for lists in sorted((source / part).glob("*/CMakeLists.txt")):
        call = re.search(function + r"\((.*?)\)", lists.read_text(), re.S)
        if call:
            words = call.group(1).split()
            begin = words.index("USES") + 1 if "USES" in words else len(words)
            end = next((i for i in range(begin, len(words)) if words[i].isupper()), len(words))
            uses[lists.parent.name] = words[begin:end]
    return uses


def closure(uses, folder):
    """The folder and everything that it uses, directly or through another."""
    reached, waiting = set(), [folder]
    while waiting:
        name = waiting.pop()
        if name not in reached:
            reached.add(name)
            waiting += uses.get(name, [])
    return reached


def includes(path):
    for number, line in enumerate(path.read_text(errors="replace").splitlines(), 1):
        found = re.match(r'\s*#\s*include\s*([<"])([^>"]+)', line)
        if found:
            yield number, found.group(2).removeprefix("relucent/")


def name_breaches(source):
    """A sentence for each header of core that is included without the prefix under which it is installed, and for
    each namespace of core that is not its folder's."""
    found = []
    folders = {path.parent.name for path in (source / "core").glob("*/CMakeLists.txt")}
    for path in sorted(path for part in ("core", "gui", "tests") for path in (source / part).rglob("*.[ch]*")):
        if path.suffix not in {".h", ".cpp"}:
            continue
        where, text = path.relative_to(source), path.read_text(errors="replace")
        for number, line in enumerate(text.splitlines(), 1):
            include = re.match(r'\s*#\s*include\s*"([^"/]+)/', line)
            if include and include.group(1) in folders:
                found.append(f'{where}:{number}: includes a header of core without "relucent/"')
            opened = re.match(r"namespace relucent((?:::\w+)*) \{", line)
            folder = where.parts[1]
            if where.parts[0] == "core" and folder not in {"base", "cmake"} and opened:
                space = opened.group(1).split("::")[1:2]
                # Friends of a type of base, and declarations of what other folders define, stand where the type does.
                if not space and where.as_posix() not in IN_THE_TYPES_NAMESPACE or space and space[0] not in folders:
                    found.append(f"{where}:{number}: opens {line.strip(' {')} in the folder {folder}")
    return found


def layer_breaches(source):
    """A sentence for each USES and each include that goes against the order of light, and for each Qt in core."""
    order, uses = order_of_layers(source), declared_uses(source)
    found = []
    for folder, used in uses.items():
        if folder not in order:
            found.append(f"core/{folder} is not in the list of core/CMakeLists.txt")
            continue
        for name in used:
            if name not in order[:order.index(folder)]:
                found.append(f"core/{folder} USES {name}, which is not above it in core/CMakeLists.txt")
    for folder in uses:
        allowed = closure(uses, folder)
        for path in sorted((source / "core" / folder).rglob("*.[ch]*")):
            if path.suffix not in {".h", ".cpp"}:
                continue
            where = path.relative_to(source)
            for number, name in includes(path):
                target = name.split("/")[0]
                if "/" in name and (source / "core" / target).is_dir() and target not in allowed:
                    found.append(f"{where}:{number}: includes {name}, but {folder} does not use {target}")
                if re.match(r"Q[A-Z]|Qt", name):
                    found.append(f"{where}:{number}: includes {name}, but core knows no Qt")
    return found


def gui_breaches(source):
    """A sentence for each include of gui that goes up, and for each of the wizard that its folder does not USE."""
    order, found = order_of_layers(source, "gui"), []
    uses = declared_uses(source, "gui/wizard", "relucent_wizard_library")
    for path in sorted((source / "gui").rglob("*.[ch]*")):
        if path.suffix not in {".h", ".cpp"}:
            continue
        where = path.relative_to(source)
        folder, inner = where.parts[1], where.parts[2]
        for number, name in includes(path):
            target = name.split("/")
            if len(target) > 1 and target[0] in order and order.index(target[0]) > order.index(folder):
                found.append(f"{where}:{number}: includes {name}, but {target[0]} is below {folder} in gui/CMakeLists.txt")
            if folder == "wizard" and inner in uses and target[0] == "wizard" and (
                    len(target) < 3 or target[1] not in closure(uses, inner)):
                found.append(f"{where}:{number}: includes {name}, but wizard/{inner} does not use it")
    return found


# What the JSON library looks for beside a type, where the type is one of base.
IN_THE_TYPES_NAMESPACE = {"core/calibration/message_json.h", "core/calibration/message_json.cpp",
                          "core/pipeline/settings_json.cpp"}

# Headers of one operating system or one desktop, and the only folder that may include them.
SYSTEM_HEADERS = re.compile(
    r"(sys/|linux/|xcb/|X11/|EGL/|GL/glx|epoxy/(egl|glx)\.h|QDBus|QtDBus|"
    r"(unistd|fcntl|signal|spawn|poll|dlfcn|pthread|termios|pwd|windows|io|process)\.h$|csignal$)")
SYSTEM_FOLDERS = {"core": "platform", "gui": "desktop"}


def system_breaches(source):
    """A sentence for each include of a system's header outside the folder that is there for it."""
    found = []
    for top, folder in SYSTEM_FOLDERS.items():
        for path in sorted((source / top).rglob("*.[ch]*")):
            where = path.relative_to(source)
            if path.suffix not in {".h", ".cpp"} or where.parts[1] == folder:
                continue
            for number, name in includes(path):
                if SYSTEM_HEADERS.match(name):
                    found.append(f"{where}:{number}: includes {name}, which only {top}/{folder} may")
    return found


# The headers that let somebody build or read JSON, and those who read and write files or documents.
JSON_HEADERS = {"calibration/json.h", "calibration/enum_json.h", "calibration/results_json.h", "nlohmann/json.hpp"}
JSON_FILES = re.compile(
    r"core/calibration/|core/devices/recording/recording_files\.cpp|core/pipeline/(settings_json|stored_settings|network_projectors|kept_photographs|masks_file|sets|measured_again|acquisition_record|drift_record|night_record|perfected|picture_error_json|proof_record|stills|surprises_file|plan|json|versions)\.|"
    r"core/rehearsal/(show_health|venue_folder)\.|core/cli/(commands|day_document|devices_document|projectors_document)\.")


def json_breaches(source):
    """A sentence for each file that includes JSON and neither reads nor writes files or documents."""
    found = []
    for part in ("core", "gui"):
        for path in sorted((source / part).rglob("*.[ch]*")):
            where = path.relative_to(source).as_posix()
            if path.suffix in {".h", ".cpp"} and not JSON_FILES.match(where):
                found += [f"{where}:{number}: includes {name}, but results are types (calibration/stage_results.h)"
                          for number, name in includes(path) if name in JSON_HEADERS]
    return found


def pairs_included(source, part):
    """Per header with its source, named without suffix: the other pairs of the same part that they include."""
    graph = {}
    for path in sorted((source / part).rglob("*.[ch]*")):
        if path.suffix not in {".h", ".cpp"}:
            continue
        pair = path.relative_to(source / part).with_suffix("")
        targets = [Path(name) for _, name in includes(path) if (source / part / name).is_file()]
        graph.setdefault(pair, set()).update(target.with_suffix("") for target in targets)
        graph[pair].discard(pair)
    return graph


def reached_from(graph, pair):
    """What a pair includes, directly or through others."""
    reached, waiting = set(), [pair]
    while waiting:
        for name in graph.get(waiting.pop(), set()) - reached:
            reached.add(name)
            waiting.append(name)
    return reached


def include_circles(source, part):
    """Pairs that include each other, directly or through others: none of them can be understood alone."""
    graph = pairs_included(source, part)
    reached = {pair: reached_from(graph, pair) for pair in graph}
    circles = {tuple(sorted(f"{part}/{other}" for other in reached[pair] if pair in reached[other]))
               for pair in graph if pair in reached[pair]}
    return sorted(circles)


def own_sources(source):
    for folder in OWN_FOLDERS:
        for directory, folders, names in os.walk(source / folder):
            folders[:] = [name for name in folders if name not in {"build", "__pycache__"}]
            for name in names:
                path = Path(directory) / name
                script = path.suffix == "" and path.read_bytes()[:2] == b"#!"
                if path.suffix in SOURCE_SUFFIXES or name == "CMakeLists.txt" or script:
                    yield path
    yield source / "CMakeLists.txt"


def files_without_licence(source):
    """Files whose first line, or second after an interpreter's, is not the SPDX line."""
    return [
        str(path.relative_to(source)) for path in own_sources(source)
        if not any("SPDX-License-Identifier: MIT" in line for line in path.read_text().splitlines()[:2])
    ]


class ThisRepository(unittest.TestCase):
    def test_there_is_something_to_check(self):
        self.assertGreaterEqual(set(declared_uses(SOURCE)), {"base", "image", "rig", "transport"})

    def test_includes_follow_the_layers(self):
        self.assertEqual(layer_breaches(SOURCE), [])
        self.assertEqual(gui_breaches(SOURCE), [])

    def test_core_is_named_by_its_folders(self):
        self.assertEqual(name_breaches(SOURCE), [])

    def test_only_the_folders_for_it_know_the_system(self):
        self.assertEqual(system_breaches(SOURCE), [])

    def test_json_stays_with_files_and_documents(self):
        self.assertEqual(json_breaches(SOURCE), [])

    def test_files_do_not_include_each_other_in_circles(self):
        circles = include_circles(SOURCE, "core") + include_circles(SOURCE, "gui")
        self.assertEqual([circle for circle in circles if str(Path(circle[0]).parent) not in STILL_CIRCULAR], [])

    def test_every_source_names_its_licence(self):
        self.assertEqual(files_without_licence(SOURCE), [])


class TheCheckItself(unittest.TestCase):
    """A small tree with one breach of each kind."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.source = Path(self.folder.name)
        self.write("CMakeLists.txt", "# SPDX-License-Identifier: MIT\n")
        self.write("core/CMakeLists.txt", "# SPDX-License-Identifier: MIT\nforeach(folder\n    base image rig)\n")
        self.library("base", "")
        self.library("image", "USES base PRIVATE opencv_core")
        self.library("rig", "USES image\n  PUBLIC fmt::fmt")

    def tearDown(self):
        self.folder.cleanup()

    def write(self, name, text):
        path = self.source / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def library(self, folder, uses):
        self.write(f"core/{folder}/CMakeLists.txt",
                   f"# SPDX-License-Identifier: MIT\nrelucent_core_library({folder}\n  SOURCES a.cpp\n  {uses})\n")

    def include(self, place, line):
        self.write(place, f"// SPDX-License-Identifier: MIT\n{line}\n")

    def test_includes_from_the_closure_are_fine(self):
        self.include("core/rig/a.cpp", '#include "relucent/base/a.h"\n#include "relucent/image/a.h"\n#include <vector>')
        self.assertEqual(layer_breaches(self.source), [])
        self.assertEqual(system_breaches(self.source), [])

    def test_an_include_from_below_is_found(self):
        self.include("core/base/a.h", '#include "relucent/image/a.h"')
        self.assertEqual(len(layer_breaches(self.source)), 1)

    def test_a_use_from_below_is_found(self):
        self.library("base", "USES rig")
        self.assertEqual(len(layer_breaches(self.source)), 1)

    def test_a_header_without_its_prefix_is_found(self):
        self.include("core/image/a.cpp", '#include "relucent/base/a.h"\n#include "theme/a.h"')
        self.assertEqual(name_breaches(self.source), [])
        self.include("gui/theme/a.cpp", '#include "base/a.h"')
        self.assertEqual(len(name_breaches(self.source)), 1)

    def test_a_namespace_that_is_no_folder_is_found(self):
        self.include("core/image/a.cpp", "namespace relucent::rig {\nclass A;\n}\nnamespace relucent::image {\n}")
        self.include("core/base/a.cpp", "namespace relucent {\n}")
        self.assertEqual(name_breaches(self.source), [])
        self.include("core/rig/a.cpp", "namespace relucent {\n}\nnamespace relucent::rigs {\n}")
        self.assertEqual(len(name_breaches(self.source)), 2)

    def test_qt_in_core_is_found(self):
        self.include("core/image/a.cpp", "#include <QImage>")
        self.assertEqual(len(layer_breaches(self.source)), 1)

    def wizard(self):
        self.write("gui/CMakeLists.txt", "# SPDX-License-Identifier: MIT\nforeach(folder theme wizard app)\n")
        for folder, uses in {"frame": "", "venue": "USES frame", "camera": "USES frame"}.items():
            self.write(f"gui/wizard/{folder}/CMakeLists.txt",
                       f"# SPDX-License-Identifier: MIT\nrelucent_wizard_library({folder} SOURCES a.cpp {uses})\n")

    def test_includes_of_a_page_that_it_uses_are_fine(self):
        self.wizard()
        self.include("gui/wizard/venue/a.cpp", '#include "wizard/venue/a.h"\n#include "wizard/frame/a.h"\n#include "theme/a.h"')
        self.assertEqual(gui_breaches(self.source), [])

    def test_a_page_that_includes_another_is_found(self):
        self.wizard()
        self.include("gui/wizard/venue/a.cpp", '#include "wizard/camera/a.h"')
        self.assertEqual(len(gui_breaches(self.source)), 1)

    def test_gui_that_includes_from_below_is_found(self):
        self.wizard()
        self.include("gui/theme/a.cpp", '#include "wizard/frame/a.h"')
        self.assertEqual(len(gui_breaches(self.source)), 1)

    def test_a_system_header_outside_its_folder_is_found(self):
        for name in ["sys/stat.h", "unistd.h", "epoxy/egl.h", "csignal"]:
            self.include("core/rig/a.cpp", f"#include <{name}>")
            self.assertEqual(len(system_breaches(self.source)), 1, name)
        self.include("core/rig/a.cpp", "#include <epoxy/gl.h>\n#include <ImfIO.h>")
        self.include("core/platform/a.cpp", "#include <unistd.h>")
        self.include("gui/desktop/a.cpp", "#include <xcb/xcb.h>\n#include <QDBusReply>")
        self.assertEqual(system_breaches(self.source), [])
        self.include("gui/content/a.cpp", "#include <QDBusReply>")
        self.assertEqual(len(system_breaches(self.source)), 1)

    def test_json_outside_of_files_and_documents_is_found(self):
        self.include("core/calibration/a.cpp", '#include "relucent/calibration/json.h"')
        self.include("core/base/a.cpp", '#include "relucent/calibration/json_fwd.h"')
        self.assertEqual(json_breaches(self.source), [])
        self.include("gui/wizard/venue/a.cpp", '#include "relucent/calibration/json.h"')
        self.assertEqual(len(json_breaches(self.source)), 1)

    def test_a_circle_through_headers_and_sources_is_found(self):
        self.include("core/rig/a.h", '#include "relucent/rig/b.h"')
        self.include("core/rig/b.h", '#include "relucent/image/a.h"')
        self.include("core/rig/c.cpp", '#include "relucent/rig/c.h"\n#include "relucent/rig/a.h"')
        self.assertEqual(include_circles(self.source, "core"), [])
        self.include("core/rig/b.cpp", '#include "relucent/rig/c.h"')
        self.include("core/rig/c.h", "")
        self.assertEqual(include_circles(self.source, "core"), [("core/rig/a", "core/rig/b", "core/rig/c")])

    def test_a_missing_licence_is_found(self):
        self.write("core/image/a.cpp", "int a;\n")
        self.assertEqual(files_without_licence(self.source), ["core/image/a.cpp"])


if __name__ == "__main__":
    unittest.main(verbosity=1)
