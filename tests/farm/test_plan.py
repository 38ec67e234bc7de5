#!/usr/bin/env python3
"""osdtex plan and osdtex run: what the engines are told, tasks that are done
once, and make as the smallest of farms."""

import json
import os
import shlex
import shutil
import subprocess
import xml.etree.ElementTree

from jobs import ENVIRONMENT, PROGRAM, QUICK, SHARED, JobTest, main

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

    def test_tasks_that_write_one_file(self):
        """However the file is named, the refusal names both."""
        q = f"plane.obj {QUICK}"
        for one, two, what in (
                (f"{q} -o out/a.obj", f"{q} --seed 2 -o out/a.obj", "a_cage"),
                (f"{q} -o out/a.obj", f"{q} -o ./out/../out/a.obj", "a_cage"),
                (f"{q} -o out/a.obj", f"{q} -o here/out/a.obj", "a_cage"),
                (f"{q} -o out/a.obj", f"{q} -o out/A.obj", "_cage"),
                (f"{q} -o new/a.obj", f"{q} -o new/./a.obj", "a_cage"),
                (f"{q} -o out/a.obj --json-report out/r.json",
                 f"{q} -o out/b.obj --json-report out/r.json", "r.json"),
                (f"{q} -o out/a.obj", f"{q} -o out/a.obj --udim 1001", "a_c"),
                (f"{q} -o out/a.obj",
                 f"{q} -o out/b.obj --preview out/a.mtlx.png", None)):
            with self.subTest(two):
                job = self.write_job("job", [("first", one), ("second", two)])
                (job.parent / "here").symlink_to(".")
                result = self.run_program("plan", job, "-o", self.folder / "f")
                if what is None:
                    self.assert_exit(result, 0)
                else:
                    self.assert_error(
                        result, 2, "tasks 0 ('first') and 1 ('second') would "
                        "both write ")
                    self.assertIn(what, result.stderr)
                    self.assertFalse((self.folder / "f").exists())
                shutil.rmtree(job.parent)

    def test_tasks_that_read_what_others_write(self):
        """Maps of materials and saved mappings are files like others."""
        q = f"plane.obj {QUICK}"
        save = f"{q} --save out/m.osdtex -o out/a.obj"
        normal = "--map normal=out/b_normal.exr"
        for one, two, words in (
                (save, "--from out/m.osdtex --resolution 64 -o out/b.obj",
                 "task 1 ('second') reads 'out/m.osdtex', which task 0 "
                 "('first') writes"),
                ("--from ./out/m.osdtex -o out/b.obj", save,
                 "task 0 ('first') reads './out/m.osdtex', which task 1 "),
                (f"{q} -o out/a.obj", f"out/a_cage.obj {QUICK} -o out/b.obj",
                 "reads 'out/a_cage.obj', which task 0 "),
                (save, f"{q} --save out/m.osdtex -o out/b.obj",
                 "would both write 'out/m.osdtex'"),
                (f"{q} {normal} -o out/c.obj",
                 f"{q} --preview out/b_normal.exr -o out/b.obj",
                 "task 0 ('first') reads 'out/b_normal.exr', which task 1"),
                (f"{q} -o out/a.obj", f"{q} -o out/b.obj", None)):
            with self.subTest(two):
                job = self.write_job("job", [("first", one), ("second", two)])
                result = self.run_program("plan", job, "-o", self.folder / "f")
                if words is None:
                    self.assert_exit(result, 0)
                else:
                    self.assert_error(result, 2, words)
                shutil.rmtree(job.parent)

    def test_maps_that_two_tasks_write(self):
        job = self.write_job("job", TASKS)
        tasks = [
            {"name": "one", "command": "map", "arguments":
             f"plane.obj {QUICK} --map normal=n.png -o out/a.obj"},
            {"name": "two", "command": "map", "arguments":
             f"plane.obj {QUICK} -o out/a_normal.obj"}]
        job.write_text(json.dumps({"name": "j", "tasks": tasks}))
        self.assert_error(
            self.run_program("plan", job, "-o", self.folder / "f"), 2,
            "would both write 'out/a_normal.exr'")

    def test_a_saved_mapping_is_a_task(self):
        """And a material, whose colour no operand names."""
        job = self.write_job("job", TASKS)
        here = {"cwd": job.parent}
        self.assert_exit(self.run_program(
            "map", "plane.obj", *QUICK.split()[:-2], "-o", "out/m.obj",
            "--save", "m.osdtex", **here), 0)
        (job.parent / "set").mkdir()
        shutil.copy(job.parent / "gravel.png", job.parent / "set/g_color.png")
        job.write_text(json.dumps({"name": "j", "tasks": [
            {"name": "one", "command": "bake", "arguments":
             "--from m.osdtex --resolution 64 -o out/a.obj"},
            {"name": "two", "command": "map", "arguments":
             "plane.obj --material set --level 1 --scale 2 -o out/b.obj"}]}))
        self.plan(job, "make")
        self.run_all(job, 2)
        self.assertTrue((job.parent / "out/a.1001.exr").exists())
        self.assertTrue((job.parent / "out/b.exr").exists())
        for task in range(2):
            again = self.run_program("run", job, "--task", task)
            self.assertIn("is up to date", again.stderr)

    def test_shared_report(self):
        job = SHARED / "reports" / "same_outputs_job.json"
        if not job.exists():
            self.skipTest("../shared/data/reports is not there")
        self.assert_error(
            self.run_program("plan", job, "-o", self.folder / "f"), 2,
            "tasks 0 ('t1') and 1 ('t2') would both write 'out/j1.obj'")

    def test_files_of_others_are_kept(self):
        job = self.write_job("job", TASKS)
        for engine, name in (("make", "Makefile"), ("slurm", "job.sbatch"),
                             ("opencue", "job.xml"),
                             ("deadline", "plugin_info.job")):
            files = self.folder / engine
            files.mkdir()
            (files / name).write_text("all:\n\techo mine\n")
            result = self.run_program(
                "plan", job, "--engine", engine, "-o", files)
            self.assert_error(result, 3, "was not written by osdtex plan")
            self.assertEqual([p.name for p in files.iterdir()], [name])
            self.assertIn("mine", (files / name).read_text())
            # An empty one is nobody's, and our own is replaced.
            (files / name).write_text("")
            for _ in range(2):
                self.plan(job, engine)
            self.assertGreater((files / name).stat().st_size, 0)
            (files / name).chmod(0o444)
            self.assert_error(
                self.run_program("plan", job, "--engine", engine, "-o", files),
                3, "write-protected")
        for path in (self.folder / "make").iterdir():
            path.unlink()
        (self.folder / "make" / "Makefile").symlink_to("elsewhere")
        self.assert_error(
            self.run_program("plan", job, "-o", self.folder / "make"), 3,
            "link")

    HOSTILE = ["a b", "$(touch pwned)", "it's", 'say "x"', "a%b%i", "a#b",
               "#IFRAME#", "a&b<c>]]>", "back\\", "-x", "ü", "*?[a]", "!x",
               "x" * 200]

    def words_of(self, engine, files):
        """The program and its arguments as the engine would run task 1."""
        if engine == "make":
            made = subprocess.run(
                ["make", "-n", "-f", files / "Makefile", "task-1"],
                capture_output=True, text=True, check=True, cwd=self.folder)
            return shlex.split(made.stdout)
        if engine == "slurm":
            script = (files / "job.sbatch").read_text().replace(
                "\nexec ", "\nprintf '%s\\n' ")
            return subprocess.run(
                ["sh"], input=script, env={"SLURM_ARRAY_TASK_ID": "1"},
                capture_output=True, text=True, check=True,
                cwd=self.folder).stdout.splitlines()
        if engine == "opencue":
            spec = xml.etree.ElementTree.parse(files / "job.xml")
            return shlex.split(
                spec.find(".//cmd").text.replace("#IFRAME#", "1"))
        info = dict(line.split("=", 1) for line in
                    (files / "plugin_info.job").read_text().splitlines())
        arguments = info["Arguments"].replace("<STARTFRAME>", "1")
        self.assertEqual(arguments.count("<QUOTE>"), 2)
        before, path, after = arguments.split("<QUOTE>")
        return [info["Executable"], *before.split(), path, *after.split()]

    def test_hostile_names(self):
        """Words come out as they went in, or one sentence says why not."""
        self.need("make")
        planned = set()
        for name in self.HOSTILE:
            job = self.write_job(name, TASKS)
            for engine in "make", "slurm", "opencue", "deadline":
                files = self.folder / "files"
                program = f"/opt/{name}/osdtex"
                result = self.run_program(
                    "plan", job, "--engine", engine, "-o", files, "--program",
                    program)
                with self.subTest(name=name, engine=engine):
                    if result.returncode == 0:
                        planned.add((name, engine))
                        self.assertEqual(
                            self.words_of(engine, files),
                            [program, "run", str(job), "--task", "1"])
                        shutil.rmtree(files)
                    else:
                        self.assert_error(result, 2, f"{engine} cannot be told")
                        self.assertFalse(files.exists())
        self.assertFalse((self.folder / "pwned").exists())
        for name in self.HOSTILE:
            self.assertIn((name, "make"), planned)
            self.assertIn((name, "slurm"), planned)
        self.assertIn(("a&b<c>]]>", "opencue"), planned)

    def test_names_that_end_lines(self):
        for name in ("i\ntask-0:;touch pwned #", "a\rb", "a\tb", "a\x7fb"):
            job = self.write_job(name, TASKS)
            fine = self.write_job("fine", TASKS)
            for engine in "make", "slurm", "opencue", "deadline":
                for words in ([job], [fine, "--program", name]):
                    self.assert_error(
                        self.run_program(
                            "plan", *words, "--engine", engine, "-o",
                            self.folder / "files"), 2, "control character")
            shutil.rmtree(fine.parent)
        self.assertFalse((self.folder / "files").exists())

    def test_names_that_are_not_utf8(self):
        job = self.write_job("fine", TASKS)
        odd = os.fsdecode(b"/opt/\xff/osdtex")
        self.assert_error(
            self.run_program(
                "plan", job, "--engine", "opencue", "-o", self.folder / "x",
                "--program", odd), 2, "not UTF-8")
        self.assert_exit(
            self.run_program(
                "plan", job, "-o", self.folder / "x", "--program", odd), 0)

    def test_printed_commands_are_quoted(self):
        job = self.write_job("job", TASKS)
        folder = self.folder / "a b'c"
        result = self.run_program("plan", job, "-o", folder)
        self.assert_exit(result, 0)
        self.assertEqual(
            shlex.split(result.stdout.split(": ", 1)[1])[-1],
            f"{folder}/Makefile")

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
                ({"tasks": []}, "no \"tasks\""), ({"name": "a/b"}, "\"name\""),
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
