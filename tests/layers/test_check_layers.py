#!/usr/bin/env python3
"""The checker finds what it is there to find, and the tree is clean.

    test_check_layers.py            and keeps to its layers
    test_check_layers.py headers    each header of the tree compiles alone
"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TOOL = ROOT / "tools" / "check-layers"

LAYERS = """
base     -
math     base
method   base math
api      *
cli      public
"""


def check(root, *more):
    return subprocess.run(
        [TOOL, root, *more], capture_output=True, text=True)


class Tree(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = Path(self.folder.name)
        (self.root / "include").mkdir()
        self.put("LAYERS", LAYERS)
        self.put("base/arena.h", "typedef int arena;\n")
        self.put("math/vec.h", '#include "base/arena.h"\nextern arena vec;\n')

    def tearDown(self):
        self.folder.cleanup()

    def put(self, path, text):
        file = self.root / "osdtex" / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)

    def refused(self, words):
        result = check(self.root)
        self.assertEqual(result.returncode, 1)
        self.assertIn(words, result.stdout)

    def test_clean(self):
        result = check(self.root)
        self.assertEqual((result.returncode, result.stdout), (0, ""))

    def test_crossed_arrow(self):
        self.put("base/pool.c", '#include "math/vec.h"\n')
        self.refused('base may not include "math/vec.h"')

    def test_cli_sees_the_public_header_only(self):
        self.put("cli/map.c", '#include "base/arena.h"\n')
        self.refused('cli may not include "base/arena.h"')

    def test_below_the_api_only_findings_are_public(self):
        public = self.root / "include" / "osdtex"
        public.mkdir()
        for name in ("context.h", "osdtex.h"):
            (public / name).write_text("typedef int osdtex_status;\n")
        self.put("base/run.h", "#include <osdtex/context.h>\n")
        self.put("api/call.h", "#include <osdtex/osdtex.h>\n")
        self.put("cli/flag.h", "#include <osdtex/osdtex.h>\n")
        self.assertEqual(check(self.root).stdout, "")
        self.put("math/fft.h", "#include <osdtex/osdtex.h>\n")
        self.refused("math may not include <osdtex/osdtex.h>")

    def test_public_header_that_cpp_refuses(self):
        (self.root / "include" / "image.h").write_text("extern int class;\n")
        self.refused("image.h: does not compile alone")

    def test_include_without_room(self):
        self.put("math/fft.c", '#include "vec.h"\n')
        self.refused("without its room")

    def test_method_includes_method(self):
        self.put("method/tile/tile.h", "typedef int tile;\n")
        self.put("method/lapped/lapped.c", '#include "method/tile/tile.h"\n')
        self.refused("a method includes another")

    def test_two_files_of_one_name(self):
        self.put("api/vec.c", "typedef int vec;\n")
        self.refused("the name is taken by")

    def test_two_types_of_one_name(self):
        self.put("math/edge.h", "typedef struct otx_edge\n{\n    int a;\n"
                                "} otx_edge;\n")
        self.put("api/rim.h", "typedef enum otx_edge\n{\n    OTX_RIM\n"
                              "} otx_edge;\n")
        self.refused("the type otx_edge is in api/rim.h, too")

    def test_unknown_room(self):
        self.put("attic/old.c", "typedef int old;\n")
        self.refused("not in LAYERS")

    def test_cpp_outside_bridge(self):
        self.put("math/solve.cpp", "\n")
        self.refused("C++ belongs in bridge/")

    def test_header_that_needs_another(self):
        self.put("math/frame.h", "extern arena frame;\n")
        self.refused("frame.h: does not compile alone")


class Project(unittest.TestCase):
    def test_tree_keeps_to_its_layers(self):
        result = check(ROOT, "--no-compile")
        self.assertEqual((result.returncode, result.stdout), (0, ""))


class Headers(unittest.TestCase):
    def test_headers_compile_alone(self):
        result = check(ROOT)
        self.assertEqual((result.returncode, result.stdout), (0, ""))


if __name__ == "__main__":
    cases = ["Headers"] if sys.argv[1:] == ["headers"] else ["Tree", "Project"]
    unittest.main(argv=[sys.argv[0]], defaultTest=cases)
