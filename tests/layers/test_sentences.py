#!/usr/bin/env python3
"""The library's sentences know no flags: hosts show them to artists who have
never seen the program. Options stand in braces (osdtex/base/run.h)."""

import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = {"cli", "bench", "regress", "farm", "studio"}
LITERAL = re.compile(r'"(?:[^"\\\n]|\\.)*"')


def sentences():
    for path in sorted((ROOT / "osdtex").rglob("*.c*")):
        if path.relative_to(ROOT / "osdtex").parts[0] in PROGRAM:
            continue
        for number, line in enumerate(path.read_text().splitlines(), 1):
            if line.lstrip().startswith("#"):
                continue
            for literal in LITERAL.findall(line):
                yield f"{path.relative_to(ROOT)}:{number}", literal


class Sentences(unittest.TestCase):
    def test_no_flags(self):
        # What other programs are told to do is theirs.
        found = [f"{place}: {text}" for place, text in sentences()
                 if re.search(r"--[a-z]", text) and "oiiotool" not in text]
        self.assertEqual(found, [], "write {level}, not --level")


if __name__ == "__main__":
    unittest.main()
