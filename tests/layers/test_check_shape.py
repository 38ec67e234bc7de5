#!/usr/bin/env python3
"""The checker finds what it is there to find. With `tree` as its argument: in
the tree it finds nothing."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TOOL = ROOT / "tools" / "check-shape"

FUNCTION = "static int\n{name}({parameters})\n{{\n{body}}}\n\n"


def function(name, lines, parameters="void"):
    """Of so many lines, from its name to its last brace."""
    return FUNCTION.format(
        name=name, parameters=parameters, body="    x();\n" * (lines - 3))


def struct(name, count):
    members = "".join(f"    int a{i}, b{i}; /* [n], one; two */\n"
                      for i in range(count // 2))
    return f"typedef struct {name}\n{{\n{members}}} {name};\n"


class Tree(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = Path(self.folder.name)
        self.put("osdtex/base/small.c", function("small", 5) * 20)

    def tearDown(self):
        self.folder.cleanup()

    def put(self, path, text):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)

    def check(self):
        result = subprocess.run(
            [TOOL, self.root], capture_output=True, text=True)
        self.assertEqual(result.returncode, 1 if result.stdout else 0)
        return result.stdout

    def test_clean(self):
        self.assertEqual(self.check(), "")

    def test_long_file(self):
        self.put("tests/unit/base/test_a.c", "\n" * 700)
        self.assertEqual(self.check(), "")
        self.put("tests/unit/base/test_a.c", "\n" * 701)
        self.assertEqual(self.check(), "tests/unit/base/test_a.c: 701 lines\n")

    def test_long_function(self):
        self.put("osdtex/base/a.c", function("long_one", 60))
        self.assertEqual(self.check(), "")
        self.put("osdtex/base/a.c", function("long_one", 61))
        self.assertIn("a.c: long_one has 61 lines", self.check())

    def test_long_function_of_a_test(self):
        self.put("tests/api/test_a.c", function("long_one", 61))
        self.assertIn("test_a.c: long_one has 61 lines", self.check())

    def test_functions_that_are_long_on_the_whole(self):
        self.put("osdtex/cli/a.c", function("a", 16) * 20)
        self.assertEqual(self.check(), "")
        self.put("osdtex/cli/a.c", function("a", 16) * 21)
        self.assertIn("half of all functions", self.check())

    def test_struct_that_many_change(self):
        self.put("osdtex/base/state.h", struct("state", 14))
        for name in "abc":
            self.put(f"osdtex/base/{name}.c", function(name, 5, "state *s"))
        self.put("osdtex/base/d.c", function("d", 5, "const state *s"))
        self.put("osdtex/base/e.c", function("e", 5, "state *out"))
        self.assertEqual(self.check(), "")
        self.put("osdtex/base/d.c", function("d", 5, "int n,\n    state *s"))
        self.assertIn(
            "state has 14 fields and may be changed in 4 files", self.check())
        self.put("osdtex/base/state.h", struct("state", 12))
        self.assertEqual(self.check(), "")

    def test_parts_that_call_each_other(self):
        for i in range(2):
            for a, b in ((f"a{i}", f"b{i}"), (f"b{i}", f"a{i}")):
                self.put(f"osdtex/base/{a}.h",
                         f"typedef int otx_{a};\nint otx_{a}_do(void);\n")
                self.put(f"osdtex/base/{a}.c",
                         f"int\notx_{a}_do(void)\n{{\n"
                         f"    return otx_{b}_do();\n}}\n")
        self.assertIn("a circle: base/a0, base/b0", self.check())
        # To know what a type is like is no call.
        self.put("osdtex/base/b0.c",
                 "int\notx_b0_do(void)\n{\n    otx_a0 a = 0;\n"
                 "    return a;\n}\n")
        self.assertEqual(self.check(), "")

    def test_source_without_its_test(self):
        self.put("osdtex/base/a.c", "\n" * 201)
        self.put("osdtex/cli/b.c", "\n" * 201)
        self.assertIn("no tests/unit/base/test_a.c", self.check())
        self.assertNotIn("b.c", self.check())
        self.put("tests/unit/base/test_a.c", "\n")
        self.assertEqual(self.check(), "")


class Project(unittest.TestCase):
    def test_tree_is_in_shape(self):
        result = subprocess.run([TOOL], capture_output=True, text=True)
        self.assertEqual(result.stdout, "")
        self.assertEqual(result.returncode, 0)


if __name__ == "__main__":
    case = "Project" if sys.argv[1:] == ["tree"] else "Tree"
    unittest.main(argv=[sys.argv[0]], defaultTest=case)
