#!/usr/bin/env python3
"""The checker finds what it is there to find, and the tree is clean."""

import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TOOL = ROOT / "tools" / "check-docs"


def check(root):
    return subprocess.run([TOOL, root], capture_output=True, text=True)


class Tree(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = Path(self.folder.name)
        self.put("docs/bibliography.md", "- [Soler02] Pattern mapping.\n")
        self.put("osdtex/base/arena.c", "/* [Soler02, eq. 2] */ otx_arena();\n")
        self.put("docs/a.md", "# A heading\n\n`otx_arena` in `osdtex/base/arena`"
                 ", see [here](#a-heading) and [there](b.md#other)\n")
        self.put("docs/b.md", "# Other\n")

    def tearDown(self):
        self.folder.cleanup()

    def put(self, path, text):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)

    def expect(self, words):
        result = check(self.root)
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertIn(words, result.stdout)
        self.assertEqual(len(result.stdout.splitlines()), 1, result.stdout)

    def test_what_is_right_passes(self):
        result = check(self.root)
        self.assertEqual((result.returncode, result.stdout), (0, ""))

    def test_a_work_that_is_not_listed(self):
        self.put("osdtex/base/pool.h", "/* [Soler02; Ray09, sec. 2] */\n")
        self.expect("[Ray09] is not in docs/bibliography.md")

    def test_a_work_that_nothing_cites(self):
        self.put("docs/bibliography.md", "- [Soler02] A.\n- [Ray09] B.\n")
        self.expect("nothing cites [Ray09]")

    def test_links_that_lead_nowhere(self):
        self.put("docs/b.md", "# Other\n\n[x](c.md)\n")
        self.expect("docs/b.md: no file c.md")
        self.put("docs/b.md", "# Other\n\n[x](a.md#none)\n")
        self.expect("docs/b.md: no heading a.md#none")

    def test_names_that_are_gone(self):
        self.put("docs/b.md", "# Other\n\n`otx_heap_gone()`\n")
        self.expect("no source has otx_heap_gone")
        self.put("docs/b.md", "# Other\n\n`osdtex/base/gone.c`\n")
        self.expect("there is no osdtex/base/gone.c")

    def test_long_prose_but_not_tables(self):
        self.put("docs/b.md", "# Other\n\n| " + "x " * 80 + "|\n")
        self.assertEqual(check(self.root).returncode, 0)
        self.put("docs/b.md", "# Other\n\n" + "x " * 80 + "\n")
        self.expect("docs/b.md:3: 160 columns of prose")

    def test_this_tree(self):
        result = check(ROOT)
        self.assertEqual(result.stdout, "")


if __name__ == "__main__":
    unittest.main()
