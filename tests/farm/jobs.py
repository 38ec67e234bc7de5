"""jobs.py -- a small job for a farm, in a folder of its own."""

import json
import shutil
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))

from program import (  # noqa: E402
    CAGES, ENVIRONMENT, EXEMPLARS, PROGRAM, SHARED, ProgramTest, main)

QUICK = "gravel.png --level 1 --scale 2 --resolution 64"


class JobTest(ProgramTest):
    def write_job(self, name, tasks):
        """A folder with inputs, an empty folder out/ and the job."""
        folder = self.folder / name
        (folder / "out").mkdir(parents=True)
        shutil.copy(EXEMPLARS / "gravel_tile.png", folder / "gravel.png")
        for cage in ("plane", "creased"):
            shutil.copy(CAGES / f"{cage}.obj", folder)
        (folder / "job.json").write_text(json.dumps(
            {"name": "assets", "threads": 1, "tasks": [
                {"name": n, "command": "bake",
                 "arguments": a if " -o " in a else f"{a} -o out/{n}.obj"}
                for n, a in tasks]}))
        return folder / "job.json"

    def outputs(self, job):
        return {p.name: p.read_bytes()
                for p in sorted((job.parent / "out").iterdir())}

    def run_all(self, job, count):
        for task in range(count):
            self.assert_exit(
                self.run_program("run", job, "--task", task), 0)
