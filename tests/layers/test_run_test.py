#!/usr/bin/env python3
"""tests/run_test.py and tools/test-summary: what is skipped is not passed, is
said with its reason, and what failed stays failed."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CMOCKA = """echo '[==========] Running 2 test(s).'
{said}
echo '[  SKIPPED ] one_case'
echo '[  PASSED  ] 1 test(s).'
echo '[  SKIPPED ] 1 test(s), listed below:'
echo '[  SKIPPED ] one_case'
exit {code}
"""
LOG = """
      Start   1: good
  1/3 Test  #1: good .......................   Passed    0.02 sec
  2/3 Test #12: without ....................***Skipped   0.10 sec
  3/3 Test #13: {name} ......................{how}   0.10 sec
"""


class RunTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="osdtex_")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_test(self, script):
        """The exit status, and the sentences that were kept."""
        kept = self.folder / "skipped" / "name"
        done = subprocess.run(
            [sys.executable, ROOT / "tests/run_test.py", kept, "sh", "-c",
             script], capture_output=True, text=True)
        return done.returncode, kept.read_text()

    def test_what_passed(self):
        self.assertEqual(self.run_test("echo fine"), (0, ""))

    def test_a_case_of_cmocka(self):
        said = "echo 'skipped: no ../shared/data'"
        self.assertEqual(
            self.run_test(CMOCKA.format(said=said, code=0)),
            (77, "no ../shared/data\n"))
        self.assertEqual(
            self.run_test(CMOCKA.format(said="", code=0)),
            (77, "it does not say why\n"))

    def test_a_failure_beside_what_was_skipped(self):
        said = "echo 'skipped: no ../shared/data'"
        self.assertEqual(
            self.run_test(CMOCKA.format(said=said, code=3))[0], 3)

    def test_unittest(self):
        line = "test_it (__main__.It.test_it) ... skipped 'no make'"
        self.assertEqual(
            self.run_test(f'echo "{line}"'), (77, "no make\n"))

    def test_a_script(self):
        self.assertEqual(
            self.run_test("echo 'skipped: no npm'; exit 77"), (77, "no npm\n"))

    def test_a_crash(self):
        self.assertEqual(self.run_test("kill -SEGV $$")[0], 139)

    def test_c_says_why(self):
        """No case is skipped without a sentence a few lines above."""
        for path in (ROOT / "tests").rglob("*.c"):
            lines = path.read_text().split("\n")
            for i, line in enumerate(lines):
                if line.strip() == "skip();":
                    above = "\n".join(lines[max(0, i - 8):i])
                    self.assertRegex(
                        above, "skipped: |has_what_it_needs",
                        f"{path}:{i + 1}: use test_skip()")

    def summary(self, **words):
        log = self.folder / "log"
        log.write_text(LOG.format(**words))
        kept = self.folder / "skipped"
        kept.mkdir(exist_ok=True)
        (kept / "without").write_text("no npm\n")
        (kept / "good").write_text("")
        done = subprocess.run(
            [ROOT / "tools/test-summary", log, kept], capture_output=True,
            text=True)
        return done.returncode, done.stdout.splitlines()

    def test_summary(self):
        self.assertEqual(
            self.summary(name="bad", how="***Failed"),
            (1, ["skipped in without: no npm",
                 "1 passed, 1 skipped in whole or in part, 1 failed"]))
        self.assertEqual(
            self.summary(name="good2", how="   Passed")[1][-1],
            "2 passed, 1 skipped in whole or in part, 0 failed")


if __name__ == "__main__":
    unittest.main(verbosity=2)
