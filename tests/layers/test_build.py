#!/usr/bin/env python3
"""What tools/cmake/BuildIdentity.cmake calls a build: another source, another
way of compiling or another commit is another build, a page of the docs is not,
and the file is not touched where it says the same."""

import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "tools" / "cmake" / "BuildIdentity.cmake"


class Build(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="osdtex_")
        self.addCleanup(folder.cleanup)
        self.tree = Path(folder.name) / "tree"
        self.output = Path(folder.name) / "build.c"
        for name in ("osdtex/cli", "include/osdtex", "docs"):
            (self.tree / name).mkdir(parents=True)
        (self.tree / "CMakeLists.txt").write_text("project(osdtex)\n")
        (self.tree / "osdtex/cli/main.c").write_text("int main(void);\n")

    def build(self, how="C GNU 12", git=""):
        subprocess.run(
            ["cmake", f"-DSOURCE={self.tree}", "-DVERSION=0.1.0",
             f"-DHOW={how}", f"-DGIT={git}", f"-DOUTPUT={self.output}", "-P",
             SCRIPT], check=True)
        return re.search(r'"(.*)";', self.output.read_text())[1]

    def git(self, *words):
        subprocess.run(
            ["git", "-C", self.tree, "-c", "user.name=a", "-c",
             "user.email=a@b", *words], check=True, capture_output=True)

    def test_a_release(self):
        first = self.build()
        self.assertRegex(first, r"^0\.1\.0\+[0-9a-f]{12}$")
        stamp = os.stat(self.output).st_mtime_ns
        (self.tree / "docs/page.md").write_text("words\n")
        self.assertEqual(self.build(), first)
        self.assertEqual(os.stat(self.output).st_mtime_ns, stamp)
        builds = {first, self.build(how="C Clang 14")}
        (self.tree / "osdtex/cli/main.c").write_text("int main(int);\n")
        builds.add(self.build())
        (self.tree / "include/osdtex/new.h").write_text("")
        builds.add(self.build())
        self.assertEqual(len(builds), 4)

    @unittest.skipUnless(shutil.which("git"), "no git (tools/deps build)")
    def test_a_checkout(self):
        self.git("init", "-q")
        self.git("add", ".")
        self.git("commit", "-q", "-m", "first")
        first = self.build(git="git")
        self.assertRegex(first, r"^[0-9a-f]{7,}\+[0-9a-f]{12}$")
        self.git("tag", "v0.1.0")
        self.assertEqual(
            self.build(git="git"), "v0.1.0+" + first.split("+")[1])
        dirty = set()
        for text in ("int main(int);\n", "int main(long);\n"):
            (self.tree / "osdtex/cli/main.c").write_text(text)
            dirty.add(self.build(git="git"))
        self.assertEqual(len(dirty), 2)
        for name in dirty:
            self.assertTrue(name.startswith("v0.1.0-dirty+"), name)


if __name__ == "__main__":
    unittest.main(verbosity=2)
