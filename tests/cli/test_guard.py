#!/usr/bin/env python3
"""What is read is never written: outputs that are inputs, or each other."""

import json
import os
import shutil
import unittest

from program import CAGES, EXEMPLARS, SHARED, ProgramTest, main

CAGE = CAGES / "plane.obj"
EXEMPLAR = EXEMPLARS / "gravel_tile.png"
QUICK = ("--level", "0", "--scale", "4", "-q")

QUAD = ("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
        "f 1/1 2/2 3/3 4/4\n")


class Guard(ProgramTest):
    def bytes_here(self):
        return {p.relative_to(self.folder): p.read_bytes()
                for p in self.folder.rglob("*") if p.is_file()}

    def assert_refused(self, words, *arguments, code=1, **keywords):
        """One sentence, the right code, and every file as it was."""
        before = self.bytes_here()
        result = self.run_program(
            *arguments, cwd=self.folder, **keywords)
        self.assert_error(result, code, words)
        self.assertEqual(result.stderr.count("error: "), 1, result.stderr)
        self.assertEqual(self.bytes_here(), before)

    def put(self, name, text):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
        return name

    def cage(self, name="shirt.obj", head="", text=QUAD):
        return self.put(name, head + text)

    def picture(self, name="rock.png"):
        shutil.copy(EXEMPLAR, self.folder / name)
        return name

    def test_libraries_of_the_cage(self):
        """However programs write their names."""
        for line, library in (
                ("mtllib shirt.mtl", "shirt.mtl"),
                ("mtllib ./shirt.mtl\r", "shirt.mtl"),
                ("mtllib a.mtl shirt.mtl", "shirt.mtl"),
                ("mtllib \"shirt.mtl\"", "shirt.mtl"),
                ("mtllib C:\\show\\shirt.mtl", "shirt.mtl"),
                ("mtllib \\\nshirt.mtl", "shirt.mtl"),
                ("mtllib my shirt.mtl", "my shirt.mtl")):
            with self.subTest(line):
                self.cage("old.obj", line + "\n")
                self.picture()
                (self.folder / library).write_text("newmtl a\n")
                self.assert_refused(
                    "is an input", "map", "old.obj", "rock.png", *QUICK,
                    "--json-report", library, "-o", "new.obj")
                (self.folder / library).unlink()

    def test_maps_of_the_libraries(self):
        self.picture()
        for statement in ("map_Kd shirt.exr", "map_Kd -s 1 1 1 shirt.exr",
                          "bump -bm 0.2 shirt.exr", "MAP_KS tex/../shirt.exr",
                          "norm shirt.exr", "map_Kd D:\\tex\\shirt.exr"):
            with self.subTest(statement):
                self.put("tex/m.mtl", "newmtl a\n" + statement + "\n")
                self.put("m.mtl", "newmtl a\n" + statement + "\n")
                self.cage("old.obj", "mtllib m.mtl\n")
                self.put("shirt.exr", "the artist's")
                self.assert_refused(
                    "'shirt.exr' is an input", "map", "old.obj", "rock.png",
                    *QUICK, "-o", "shirt.obj")

    def test_tiles_of_a_material(self):
        self.picture()
        self.cage("old.obj", "mtllib m.mtl\n")
        self.put("m.mtl", "newmtl a\nmap_Kd shirt.<UDIM>.exr\n")
        self.put("shirt.1001.exr", "the artist's")
        self.assert_refused(
            "'shirt.1001.exr' is an input", "bake", "old.obj", "rock.png",
            *QUICK, "-o", "shirt.obj")

    def test_shared_report(self):
        """A shirt's library, as artists have it."""
        if not (SHARED / "reports").is_dir():
            self.skipTest("../shared/data/reports is not there")
        for name in ("shirt_v1.obj", "shirt.mtl", "base.png"):
            shutil.copy(SHARED / "reports" / name, self.folder / name)
        self.assert_refused(
            "'shirt.mtl' is an input", "map", "shirt_v1.obj", "base.png",
            *QUICK, "-o", "shirt.obj")

    def test_colour_configuration(self):
        if not (SHARED / "reports").is_dir():
            self.skipTest("../shared/data/reports is not there")
        shutil.copy(SHARED / "reports" / "context.ocio", self.folder)
        shutil.copytree(SHARED / "reports" / "luts", self.folder / "luts")
        self.cage()
        self.picture()
        for target in ("context.ocio", "luts/sh010.spi1d"):
            self.assert_refused(
                "is an input", "map", "shirt.obj", "rock.png", *QUICK, "-o",
                "n.obj", "--colorconfig", "context.ocio", "--json-report",
                target)
            self.assert_refused(
                "is an input", "map", "shirt.obj", "rock.png", *QUICK, "-o",
                "n.obj", "--json-report", target,
                environment={"OCIO": "context.ocio"})
        # Another shot's table is no input.
        self.assert_exit(self.run_program(
            "map", "shirt.obj", "rock.png", *QUICK, "-o", "n.obj",
            "--colorconfig", "context.ocio", "--json-report", "r.json",
            cwd=self.folder, environment={"SHOT": "sh020"}), 0)
        self.assert_refused(
            "'luts/sh020.spi1d' is an input", "map", "shirt.obj", "rock.png",
            *QUICK, "-o", "n.obj", "--colorconfig", "context.ocio",
            "--json-report", "luts/sh020.spi1d", environment={"SHOT": "sh020"})

    def test_a_configuration_that_a_command_does_not_read(self):
        self.cage()
        self.put("studio.csv", "ocio_profile_version: 2\n")
        self.assert_refused(
            "'studio.csv' is an input", "field", "shirt.obj", "-o",
            "studio.csv", "--replace", environment={"OCIO": "studio.csv"})

    def test_every_command(self):
        self.cage("m.obj", "mtllib m.mtl\n")
        self.put("m.mtl", "newmtl a\nmap_Kd m.exr\n")
        result = self.run_program(
            "tiles", EXEMPLAR, "-o", "m.exr", "-q", "--tile-size", "16",
            "--gutter", "1", cwd=self.folder)
        self.assert_exit(result, 0)
        self.put("f.csv", "face,x,y,z\n0,1,0,0\n")
        self.put("k.json", '{"constraints": [{"face": 0, "scale": 1}]}')
        self.picture()
        for words in (
                ("render", "m.obj", "-o", "m.exr"),
                ("render", "m.obj", "-o", "./m.exr"),
                ("tiles", "m.exr", "-o", "m.exr"),
                ("tiles", "rock.png", "--for", "m.obj", "-o", "m.exr"),
                ("field", "m.obj", "-o", "f.csv", "--constraints", "f.csv"),
                ("map", "m.obj", "rock.png", "-o", "n.obj", "--constraints",
                 "k.json", "--json-report", "k.json"),
                ("map", "m.obj", "rock.png", "-o", "n.obj", "--also",
                 "a=m.exr", "--preview", "m.exr"),
                ("bake", "m.obj", "rock.png", "-o", "n.obj", "--mask",
                 "rock.png", "--preview", "rock.png")):
            with self.subTest(words):
                self.assert_refused("is an input", *words)

    def test_the_job_of_a_task(self):
        self.cage()
        self.picture()
        self.put("job.json", json.dumps({
            "name": "j", "tasks": [{
                "name": "t", "command": "map", "arguments":
                "shirt.obj rock.png -o n.obj --json-report job.json"}]}))
        self.assert_refused("is an input", "run", "job.json", "--task", "0")

    def test_one_file_by_two_names(self):
        self.cage()
        self.picture()
        (self.folder / "here").symlink_to(".")
        for name in ("q.mtl", "./q.mtl", "here/q.mtl", "Q.MTL",
                     str(self.folder / "q.mtl")):
            with self.subTest(name):
                self.assert_refused(
                    "would be written twice", "map", "shirt.obj", "rock.png",
                    *QUICK, "-o", "q.obj", "--json-report", name)
        self.assert_refused(
            "may be the name of a baked texture", "bake", "shirt.obj",
            "rock.png", *QUICK, "-o", "q.obj", "--preview", "./q.1001.exr")
        self.picture("photo.png")
        os.link(self.folder / "photo.png", self.folder / "other.png")
        self.assert_refused(
            "is an input", "map", "shirt.obj", "photo.png", *QUICK, "-o",
            "q.obj", "--preview", "other.png")

    def test_links_and_protected_files(self):
        self.cage()
        self.picture()
        self.put("elsewhere.mtl", "kept")
        link = self.folder / "q.mtl"
        link.symlink_to("elsewhere.mtl")
        self.assert_refused(
            "'q.mtl' is a link", "map", "shirt.obj", "rock.png", *QUICK, "-o",
            "q.obj", code=3)
        self.assertTrue(link.is_symlink())
        link.unlink()
        link.symlink_to("nowhere")
        self.assert_refused(
            "is a link", "map", "shirt.obj", "rock.png", *QUICK, "-o", "q.obj",
            code=3)
        link.unlink()
        self.put("q.mtl", "kept")
        link.chmod(0o444)
        self.assert_refused(
            "'q.mtl' is write-protected", "map", "shirt.obj", "rock.png",
            *QUICK, "-o", "q.obj", code=3)
        self.put("v.png", "kept")
        (self.folder / "v.png").chmod(0o444)
        self.assert_refused(
            "is write-protected", "render", "shirt.obj", "-o", "v.png", code=3)


if __name__ == "__main__":
    main()
