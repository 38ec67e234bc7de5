#!/usr/bin/env python3
"""Each command in the `sh` blocks of these pages of docs/ runs.

    test_commands.py OSDTEX
"""

import re
import shlex
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))

from program import ROOT, ProgramTest, main  # noqa: E402

PAGES = ("troubleshooting.md", "tutorials/painter.md")
BLOCK = re.compile(r"^```sh\n(.*?)^```$", re.M | re.S)


class Commands(ProgramTest):
    def test_they_run(self):
        count = 0
        for page in PAGES:
            for block in BLOCK.findall((ROOT / "docs" / page).read_text()):
                for line in block.replace("\\\n", " ").splitlines():
                    words = shlex.split(line, comments=True)
                    with self.subTest(f"{page}: {line}"):
                        self.assertEqual(words[0], "osdtex")
                        self.assert_exit(self.run_line(words[1:]), 0)
                    count += 1
        self.assertGreater(count, 10)

    def run_line(self, words):
        """With what goes to out/ in a folder of the test's own."""
        for folder in ("trouble", "painter"):
            (self.folder / folder).mkdir(exist_ok=True)
        return self.run_program(*(
            w.replace("out/", f"{self.folder}/", 1)
            if w.startswith("out/") else w for w in words), cwd=ROOT)


if __name__ == "__main__":
    main()
