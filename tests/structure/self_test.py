#!/usr/bin/env python3
"""The checks find what they are for: each test builds a small tree with one fault."""

import pathlib
import tempfile
import unittest

from includes import check_includes, may_include
from sizes import check_sizes
from texts import REQUIRED, check_links, check_top_level, check_words

GOOD = {
    "engine/base/CMakeLists.txt": "lightwell_library(base SOURCES a.cpp HIDES TBB::tbb)",
    "engine/base/a.h": "#pragma once\n#include <vector>\n",
    "engine/base/a.cpp": '#include "engine/base/a.h"\n#include <tbb/parallel_for.h>\n',
    "engine/scene/CMakeLists.txt": "lightwell_library(scene SOURCES s.cpp USES base)",
    "engine/scene/s.h": '#include "engine/base/a.h"\n',
    "engine/accel/CMakeLists.txt": "lightwell_library(accel USES scene) # base through scene",
    "engine/accel/q.h": '#include "engine/base/a.h"\n#include "engine/scene/s.h"\n',
    "importers/CMakeLists.txt": "lightwell_library(importers USES scene)",
    "importers/i.h": '#include "engine/scene/s.h"\n',
    "tests/unit/base/CMakeLists.txt": "lightwell_test(base SOURCES t.cpp USES base)",
    "tests/unit/base/t.cpp": '#include <gtest/gtest.h>\n#include "engine/base/a.h"\n',
    "README.md": "# Map\n[base](engine/base/a.h) [above](#map) [web](https://example.org)\n",
}


class Tree:
    """A source tree in a temporary folder: GOOD with some files changed."""

    def __init__(self, **changed):
        self._folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self._folder.name)
        for name, text in {**GOOD, **changed.pop("files", {})}.items():
            file = self.root / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)

    def __enter__(self):
        return self.root

    def __exit__(self, *_):
        self._folder.cleanup()


def findings(check, **files):
    with Tree(files={name.replace("__", "/"): text for name, text in files.pop("files", {}).items()}) as root:
        return list(check(root))


class Includes(unittest.TestCase):
    def only(self, files, part):
        found = findings(check_includes, files=files)
        self.assertEqual(len(found), 1, found)
        self.assertIn(part, found[0])

    def test_a_good_tree_passes(self):
        self.assertEqual(findings(check_includes), [])

    def test_an_include_that_points_up_is_found(self):
        found = findings(check_includes, files={"engine/base/a.h": '#include "engine/scene/s.h"\n'})
        self.assertIn("engine/base/a.h:1: engine/base may not include engine/scene", found[0])

    def test_an_include_that_uses_does_not_cover_is_found(self):
        self.only({"engine/scene/CMakeLists.txt": "lightwell_library(scene SOURCES s.cpp)",
                   "engine/accel/CMakeLists.txt": "lightwell_library(accel USES scene base)"},
                  "needs base in USES of scene")

    def test_importers_and_light_do_not_see_each_other(self):
        self.only({"importers/CMakeLists.txt": "lightwell_library(importers USES scene accel)",
                   "importers/i.h": '#include "engine/accel/q.h"\n'}, "importers may not include engine/accel")
        self.assertFalse(may_include("engine/simulate", "importers"))
        self.assertTrue(may_include("plugins/cli", "importers/dxf"))

    def test_a_folder_without_a_target_belongs_to_the_one_above(self):
        self.assertEqual(findings(check_includes, files={
            "materials/CMakeLists.txt": "lightwell_library(materials SOURCES m.cpp library/l.cpp USES base)",
            "materials/library/l.h": '#include "engine/base/a.h"\n', "materials/m.cpp": '#include "materials/library/l.h"\n',
            "materials/library/l.cpp": '#include "materials/library/l.h"\n'}), [])

    def test_peers_do_not_see_each_other(self):
        self.assertFalse(may_include("engine/sky", "engine/pictures"))
        self.assertFalse(may_include("importers/dxf", "importers/obj"))

    def test_an_outside_header_in_a_header_is_found(self):
        self.only({"engine/base/a.h": "#include <tbb/parallel_for.h>\n"}, "outside packages stay in .cpp files")

    def test_an_outside_header_that_is_not_hidden_is_found(self):
        self.only({"engine/scene/s.cpp": "#include <toml++/toml.h>\n"}, "needs tomlplusplus in HIDES of scene")

    def test_an_unknown_outside_header_is_found(self):
        self.only({"engine/scene/s.cpp": "#include <boost/any.hpp>\n"}, "neither a standard header")


class Sizes(unittest.TestCase):
    def test_a_file_beyond_the_bound_is_found_and_one_at_it_is_not(self):
        self.assertEqual(len(findings(check_sizes, files={"engine/base/b.cpp": "int a;\n" * 601})), 1)
        self.assertEqual(findings(check_sizes, files={"engine/base/b.cpp": "int a;\n" * 600}), [])

    def test_a_function_beyond_the_bound_is_found_and_one_at_it_is_not(self):
        def body(lines):
            return "void f()\n{\n" + "    g();\n" * lines + "}\n"
        self.assertIn("engine/base/b.cpp:2", findings(check_sizes, files={"engine/base/b.cpp": body(99)})[0])
        self.assertEqual(findings(check_sizes, files={"engine/base/b.cpp": body(98)}), [])
        member = "struct S {\n    void f()\n    {\n" + "        g();\n" * 99 + "    }\n};\n"
        self.assertEqual(len(findings(check_sizes, files={"engine/base/b.h": member})), 1)
        script = "def f():\n" + "    g()\n" * 100
        self.assertEqual(len(findings(check_sizes, files={"tests/b.py": script})), 1)


class Texts(unittest.TestCase):
    def test_dead_links_are_found_and_good_ones_are_not(self):
        self.assertEqual(findings(check_links), [])
        self.assertIn("dead link to nowhere.md", findings(check_links, files={"README.md": "[a](nowhere.md)"})[0])
        self.assertIn("#gone", findings(check_links, files={"README.md": "# Map\n[a](#gone)"})[0])
        self.assertEqual(len(findings(check_links, files={"README.md": '<img src="none.png">'})), 1)
        self.assertEqual(findings(check_links, files={"README.md": "```\n[a](nowhere.md)\n```\n"}), [])

    def test_words_that_must_not_stay_are_found(self):
        for word in ("TO" "DO", "FIX" "ME", "for n" "ow", "see /wo" "rk/notes"):
            self.assertEqual(len(findings(check_words, files={"engine/base/b.cpp": f"// {word}\n"})), 1, word)
        self.assertEqual(findings(check_words, files={"engine/base/b.cpp": "// for nowhere; homework/x; ../work/x\n"}), [])

    def test_the_top_level_is_exactly_the_map(self):
        with Tree() as root:
            for name in REQUIRED:
                if not (root / name).exists():
                    (root / name).mkdir()
            (root / "build").mkdir()
            (root / ".ci").mkdir()
            self.assertEqual(list(check_top_level(root)), [])
            (root / "utils").mkdir()
            (root / "README.md").unlink()
            self.assertEqual(len(list(check_top_level(root))), 2)


if __name__ == "__main__":
    unittest.main()
