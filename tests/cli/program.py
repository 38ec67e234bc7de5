"""program.py -- running osdtex in a folder of its own, for the tests here.

The program's path is the first argument of every test script; the working
directory is the root of the project."""

import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = str(Path(sys.argv[1]).resolve()) if len(sys.argv) > 1 else "osdtex"
ROOT = Path(__file__).resolve().parents[2]
CAGES = ROOT / "models" / "cages"
EXEMPLARS = ROOT / "models" / "exemplars"
SHARED = ROOT.parent / "shared" / "data"

# A sanitizer makes everything several times slower and larger, so times and
# memory are judged without.
SANITIZED = "__asan_init" in subprocess.run(
    ["nm", "-D", PROGRAM], capture_output=True, text=True).stdout

# Nothing of the caller's environment may change what a test sees.
ENVIRONMENT = {
    k: v for k, v in os.environ.items()
    if k not in ("OCIO", "OSDTEX_THREADS", "CUE_THREADS",
                 "SLURM_CPUS_PER_TASK")}


class ProgramTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="osdtex_")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_program(self, *arguments, environment=None, **more):
        return subprocess.run(
            [PROGRAM, *map(str, arguments)], capture_output=True, text=True,
            errors="replace", env={**ENVIRONMENT, **(environment or {})},
            **more)

    def run_map(self, cage, exemplar, *more, name="out.obj", **keywords):
        return self.run_program(
            "map", cage, exemplar, "-o", self.folder / name, *more, **keywords)

    def await_first_line(self, job):
        """Until the program has something to say; from then on it catches
        signals."""
        return job.stderr.readline()

    def need(self, *programs, modules=()):
        """Skips where a program or a Python module is missing."""
        for name in programs:
            if not shutil.which(name):
                self.skipTest(f"no {name} (tools/deps test medium)")
        for name in modules:
            if not importlib.util.find_spec(name):
                self.skipTest(f"no Python module {name} (tools/deps test)")

    def assert_exit(self, result, code):
        self.assertEqual(
            result.returncode, code,
            f"\n{result.args}\n{result.stdout}{result.stderr}")

    def assert_error(self, result, code, words):
        """One sentence on stderr that begins as all errors do."""
        self.assert_exit(result, code)
        errors = [l for l in result.stderr.splitlines()
                  if l.startswith("osdtex: error: ")]
        self.assertTrue(errors, result.stderr)
        self.assertIn(words, "\n".join(errors))

    def picture(self, name):
        """A texture but for its mark, which no two jobs have alike."""
        return re.sub(
            rb"osdtex job [0-9a-f]{32} of .*? seal [0-9a-f]{32}", b"",
            (self.folder / name).read_bytes())

    def assert_nothing_written(self):
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), [])


def main():
    # Verbose, so that it says why a test is skipped.
    unittest.main(argv=sys.argv[:1], verbosity=2)
