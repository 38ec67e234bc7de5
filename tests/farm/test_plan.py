#!/usr/bin/env python3
"""osdtex plan and osdtex run: what the engines are told, tasks that are done
once, and make as the smallest of farms."""

import json
import shlex
import subprocess
import xml.etree.ElementTree

from jobs import ENVIRONMENT, PROGRAM, QUICK, JobTest, main

TASKS = [("first", f"plane.obj {QUICK}"), ("second", f"plane.obj {QUICK} --seed 2")]


class Plan(JobTest):
    def plan(self, job, engine, *more):
        result = self.run_program(
            "plan", job, "--engine", engine, "-o", self.folder / engine, *more)
        self.assert_exit(result, 0)
        self.assertIn("2 tasks: ", result.stdout)
        return {p.name: p.read_text() for p in (self.folder / engine).iterdir()}

    def test_what_engines_are_told(self):
        job = self.write_job("job", TASKS)
        script = self.plan(job, "slurm")["job.sbatch"]
        self.assertIn("#SBATCH --array=0-1\n", script)
        self.assertIn(f"exec '{PROGRAM}' run '{job}' --task ", script)
        self.assertEqual(subprocess.run(
            ["sh", "-n"], input=script, text=True).returncode, 0)
        files = self.plan(job, "opencue", "--program", "/net/a&b/osdtex")
        spec = xml.etree.ElementTree.fromstring(files["job.xml"])
        self.assertEqual(spec.find(".//range").text, "0-1")
        # Cue's hosts hand the command to a shell.
        self.assertEqual(
            shlex.split(spec.find(".//cmd").text.replace("#IFRAME#", "1")),
            ["/net/a&b/osdtex", "run", str(job), "--task", "1"])
        files = self.plan(job, "deadline", "--program", "osdtex")
        self.assertIn("Frames=0-1\n", files["job_info.job"])
        self.assertIn("Executable=osdtex\n", files["plugin_info.job"])

    def test_make_gives_the_bytes_of_one_process(self):
        self.need("make")
        alone, farm = (self.write_job(n, TASKS) for n in ("alone", "fa rm$'s"))
        self.run_all(alone, 2)
        self.plan(farm, "make")
        makefile = self.folder / "make" / "Makefile"
        for _ in range(2):
            made = subprocess.run(
                ["make", "-k", "-j", "2", "-f", makefile], env=ENVIRONMENT,
                capture_output=True, text=True)
            self.assertEqual(made.returncode, 0, made.stderr)
        # The second time there was nothing to do.
        self.assertEqual(made.stderr.count("is up to date"), 2)
        self.assertTrue(self.outputs(alone) == self.outputs(farm))
        self.assertGreaterEqual(len(self.outputs(farm)), 10)

    def test_tiles_are_tasks(self):
        whole = (f"plane.obj {QUICK} --uvs atlas --texels-per-unit 20 "
                 "-o out/a.obj")
        alone = self.write_job("alone", [("all", whole)])
        self.run_all(alone, 1)
        numbers = sorted(
            n.split(".")[1] for n in self.outputs(alone) if n.endswith("exr"))
        self.assertGreater(len(numbers), 2)
        farm = self.write_job(
            "farm", [(n, f"{whole} --udim {n}") for n in numbers])
        self.run_all(farm, len(numbers))
        for number in numbers:
            name = f"a.{number}.exr"
            self.assertTrue(
                self.outputs(farm)[name] == self.outputs(alone)[name], name)
        # A done tile is not baked again; the whole is not taken for done.
        again = self.run_program("run", farm, "--task", "0")
        self.assertIn("is up to date", again.stderr)
        again = self.run_program(
            "bake", "-u", *whole.split(), cwd=farm.parent)
        self.assert_exit(again, 0)
        self.assertNotIn("is up to date", again.stderr)
        self.assertTrue(self.outputs(farm) == self.outputs(alone))
        self.assert_error(
            self.run_program(
                "bake", *whole.split(), "--udim", "5000", cwd=farm.parent), 1,
            "no tile 5000")

    def test_mistakes(self):
        job = self.write_job("job", TASKS)
        self.assert_error(
            self.run_program("run", job, "--task", "2"), 1, "from 0 to 1")
        self.assert_error(
            self.run_program("run", job), 1, "say which task to run")
        self.assert_error(
            self.run_program("plan", job, "--engine", "tractor", "-o", "x"), 1,
            "there is no engine 'tractor'")
        self.assert_error(self.run_program("plan", job), 1, "-o FOLDER")
        self.assert_error(
            self.run_program("run", job.parent / "no.json", "--task", "0"), 3,
            "the file cannot be read")
        task = {"name": "a", "command": "map", "arguments": "a b"}
        for wrong, words in (
                ({"tasks": []}, "no \"tasks\""), ({"name": "a b"}, "\"name\""),
                ({"tasks": [dict(task, command="render")]}, "\"command\""),
                ({"tasks": [dict(task, arguments=[1])]}, "\"arguments\""),
                ({"tasks": [dict(task, name="a/b")]}, "\"name\""),
                ({"threads": -1}, "\"threads\"")):
            job.write_text(json.dumps({"name": "j", "tasks": [task], **wrong}))
            self.assert_error(
                self.run_program("run", job, "--task", "0"), 2, words)
        job.write_text(json.dumps({"name": "j", "tasks": [
            dict(task, arguments=["one"])]}))
        self.assert_error(
            self.run_program("run", job, "--task", "0"), 1,
            "osdtex map takes CAGE.obj EXEMPLAR")


if __name__ == "__main__":
    main()
