#!/usr/bin/env python3
"""Saved mappings: what comes back from them, on a farm, with another picture,
another pose, and from damaged files.

    test_saved.py OSDTEX
"""

import json
import os
import re
import shutil
import struct
import subprocess
import sys
import unittest
from pathlib import Path

from program import CAGES, EXEMPLARS, ROOT, ProgramTest, main

CAGE = CAGES / "torus.obj"
EXEMPLAR = EXEMPLARS / "pebbles_tile.png"
BAKE = ("--uvs", "atlas", "--resolution", "128")


class Saved(ProgramTest):
    def setUp(self):
        super().setUp()
        self.saved = self.folder / "m.osdtex"

    def save(self, *more, cage=CAGE, exemplar=EXEMPLAR):
        result = self.run_program(
            "bake", cage, exemplar, "-o", self.folder / "one.obj", "--level",
            "1", *BAKE, "--save", self.saved, *more)
        self.assert_exit(result, 0)

    def bake_from(self, *more, name="two.obj", saved=None, **keywords):
        return self.run_program(
            "bake", "--from", saved or self.saved, *more, "-o",
            self.folder / name, *BAKE, **keywords)

    def test_bakes_again_as_it_was(self):
        self.save()
        self.assert_exit(
            self.bake_from("--save", self.folder / "again.osdtex"), 0)
        self.assert_exit(self.bake_from(name="three.obj"), 0)
        self.assertEqual(
            self.picture("one.1001.exr"),
            self.picture("two.1001.exr"))
        self.assertEqual(
            (self.folder / "two.1001.exr").read_bytes(),
            (self.folder / "three.1001.exr").read_bytes())
        self.assertEqual(
            self.picture("m.osdtex"), self.picture("again.osdtex"))

    def test_tiles_one_by_one_are_the_tiles_of_one_job(self):
        self.save()
        how = ("--uvs", "atlas", "--resolution", "128", "--texels-per-unit",
               "40")
        for name, more in (("whole", ()), ("part", ("--udim", "1002"))):
            result = self.run_program(
                "bake", "--from", self.saved, "-o",
                self.folder / f"{name}.obj", *how, *more)
            self.assert_exit(result, 0)
        self.assertEqual(
            (self.folder / "whole.1002.exr").read_bytes(),
            (self.folder / "part.1002.exr").read_bytes())

    def test_update(self):
        """A bake from a saved mapping is a job like others: it is done again
        when something that the mapping names has changed, not else, and says
        so in its textures."""
        there = self.folder / "there"
        there.mkdir()
        cage = shutil.copy(CAGE, there)
        exemplar = shutil.copy(EXEMPLAR, there)
        self.save(cage=cage, exemplar=exemplar)

        def is_up_to_date(*more, **keywords):
            result = self.bake_from("-u", *more, **keywords)
            self.assert_exit(result, 0)
            return "is up to date" in result.stderr

        self.assertFalse(is_up_to_date())
        self.assertTrue(is_up_to_date())
        self.assertRegex(
            (self.folder / "two.1001.exr").read_bytes(),
            rb"osdtex job [0-9a-f]{32} of torus.obj seal ")
        self.assertFalse(is_up_to_date("--margin", "8"))
        self.assertFalse(
            is_up_to_date(cage, EXEMPLARS / "gravel_tile.png"))
        self.assertFalse(is_up_to_date())
        # The picture as it is now: a warning, and another job.
        shutil.copy(EXEMPLARS / "gravel_tile.png", exemplar)
        self.assertFalse(is_up_to_date())
        self.assertTrue(is_up_to_date())
        # Another mapping in the file's place.
        self.save("--seed", "2", cage=cage, exemplar=exemplar)
        self.assertFalse(is_up_to_date())

    def test_inputs_are_kept(self):
        """Those that the saved mapping names, too."""
        cage = shutil.copy(CAGE, self.folder / "x_cage.obj")
        self.save(cage=cage)
        result = self.bake_from(name="x.obj")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("is an input and would be replaced", result.stderr)

    def test_it_is_an_output_like_others(self):
        """Whole and of this job, or it is made again."""
        def save(*more):
            result = self.run_program(
                "map", CAGE, EXEMPLAR, "-o", self.folder / "a.obj", "--level",
                "1", "--save", self.saved, *more)
            self.assert_exit(result, 0)
            return "up to date" not in result.stderr
        self.assertTrue(save("-u"))
        self.assertFalse(save("-u"))
        whole = self.saved.read_bytes()
        for damaged in whole[:-1] + b"\7", whole[:-9], b"":
            self.saved.write_bytes(damaged)
            self.assertTrue(save("-u"))
            self.assertEqual(self.saved.read_bytes(), whole)
        # Another mapping's, under a name of ours.
        self.assertTrue(save("--seed", "2"))
        other = self.saved.read_bytes()
        self.assertTrue(save())
        self.saved.write_bytes(other)
        self.assertTrue(save("-u"))
        # Another cage's is not replaced.
        result = self.run_program(
            "map", CAGES / "sphere.obj", EXEMPLAR, "-o",
            self.folder / "b.obj", "--level", "1", "--save", self.saved)
        self.assert_error(result, 1, "belongs to another job")

    def test_maps_of_its_material_are_kept(self):
        """They have the names that a job without them would give to its own
        maps."""
        for kind in "normal", "height":
            shutil.copy(ROOT / "models/materials/waves"
                        / f"waves_{kind}{'_gl' * (kind == 'normal')}.png",
                        self.folder / f"n_{kind}.exr")
        before = (self.folder / "n_normal.exr").read_bytes()
        result = self.run_program(
            "map", CAGE, ROOT / "models/materials/waves/waves_color.png",
            "--map", f"normal={self.folder}/n_normal.exr,"
            f"height={self.folder}/n_height.exr", "--level", "1", "-o",
            self.folder / "m.obj", "--save", self.saved)
        self.assert_exit(result, 0)
        how = "map", "--from", self.saved, "-o"
        self.assert_error(
            self.run_program(*how, self.folder / "n.obj"), 1,
            "is an input and would be replaced")
        self.assertEqual((self.folder / "n_normal.exr").read_bytes(), before)
        # And what is written of them is looked at.
        for words in "wrote", "up to date":
            result = self.run_program(*how, self.folder / "o.obj", "-u")
            self.assert_exit(result, 0)
            self.assertIn(words, result.stderr)
        (self.folder / "o_height.exr").unlink()
        self.assertIn("wrote", self.run_program(
            *how, self.folder / "o.obj", "-u").stderr)

    def test_several_exemplars(self):
        """All of their textures are looked at."""
        self.save("--also", f"stem={EXEMPLARS / 'gravel_tile.png'}",
                  cage=CAGES / "materials_and_groups.obj")
        how = ("map", "--from", self.saved, "-o", self.folder / "m.obj", "-u")
        for words in "wrote", "up to date":
            result = self.run_program(*how)
            self.assert_exit(result, 0)
            self.assertIn(words, result.stderr)
        (self.folder / "m_2.exr").unlink()
        result = self.run_program(*how)
        self.assert_exit(result, 0)
        self.assertIn("wrote", result.stderr)

    def test_another_picture_of_the_size(self):
        self.save()
        self.assert_exit(self.bake_from(CAGE, EXEMPLARS / "gravel_tile.png"), 0)
        self.assertNotEqual(
            self.picture("one.1001.exr"),
            self.picture("two.1001.exr"))

    def test_another_pose(self):
        self.save()
        pose = self.folder / "pose.obj"
        pose.write_text(re.sub(
            r"(?m)^v (\S+)", lambda m: f"v {2 * float(m[1])}",
            CAGE.read_text()))
        result = self.bake_from(pose)
        self.assert_exit(result, 0)
        self.assertIn("another pose", result.stderr)

    def test_files_beside_it(self):
        """On another machine the folders are others."""
        there = self.folder / "there"
        there.mkdir()
        for file in (CAGE, EXEMPLAR):
            shutil.copy(file, there)
        self.save(cage=there / CAGE.name, exemplar=there / EXEMPLAR.name)
        here = self.folder / "here"
        there.rename(here)
        shutil.copy(self.saved, here / "m.osdtex")
        self.assert_exit(self.bake_from(saved=here / "m.osdtex"), 0)

    def test_what_is_refused(self):
        self.save()
        for more, words in (
                ((CAGES / "sphere.obj",), "other faces"),
                ((CAGE, ROOT / "docs/gallery/creature.png"), "was made for one"),
                (("--scale", "3"), "decided when the mapping was saved")):
            result = self.bake_from(*more)
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertIn(words, result.stderr)

    def test_damaged_files(self):
        self.save()
        whole = self.saved.read_bytes()
        length = struct.unpack("<Q", whole[:8])[0]
        header = json.loads(whole[8:8 + length])
        header["uvs"]["shape"][0] += 1
        text = json.dumps(header).encode()
        about = json.loads(header["__metadata__"]["osdtex"])
        about["format"] = 2
        header["__metadata__"]["osdtex"] = json.dumps(about)
        later = json.dumps(header).encode()
        patches = json.loads(whole[8:8 + length])["face_patch"]["data_offsets"]
        wild = bytearray(whole)
        wild[8 + length + patches[0]:8 + length + patches[0] + 4] = b"\xff" * 3 + b"\x7f"
        for data in (
                b"", whole[:7], whole[:-1], b"\xff" * 8 + whole[8:],
                struct.pack("<Q", len(text)) + text + whole[8 + length:],
                struct.pack("<Q", len(later)) + later + whole[8 + length:],
                bytes(wild), b"\0" * 4096):
            self.saved.write_bytes(data)
            for command in (("bake", "-o", self.folder / "x.obj", *BAKE,
                             "--from"), ("info",)):
                result = self.run_program(*command, self.saved)
                if command == ("info",) and data == bytes(wild):
                    continue
                self.assertEqual(result.returncode, 2, result.stderr)
            self.assertFalse((self.folder / "x.1001.exr").exists())

    def change(self, **about):
        """Another file that says so of itself."""
        whole = self.saved.read_bytes()
        length = struct.unpack("<Q", whole[:8])[0]
        header = json.loads(whole[8:8 + length])
        said = json.loads(header["__metadata__"]["osdtex"])
        for key, value in about.items():
            of = said["exemplars"][0] if key.startswith("e_") else said["cage"]
            of[key.removeprefix("e_")] = value
        header["__metadata__"]["osdtex"] = json.dumps(said)
        text = json.dumps(header).encode()
        text += b" " * (-(8 + len(text)) % 64)
        other = self.folder / "other.osdtex"
        other.write_bytes(
            struct.pack("<Q", len(text)) + text + whole[8 + length:])
        return other

    def test_what_hostile_files_say(self):
        """Nothing is waited for, made that is not there, or printed that a
        terminal would obey."""
        self.save()
        os.mkfifo(self.folder / "pipe")
        for about, words in (
                ({"level": 10}, "do not fit the cage at its level"),
                ({"path": str(self.folder / "pipe")}, "is a folder, a pipe"),
                ({"e_path": str(self.folder / "pipe")},
                 "exemplar is a folder, a pipe"),
                ({"path": str(self.folder)}, "is a folder, a pipe")):
            with self.subTest(about):
                result = self.bake_from(
                    saved=self.change(**about), timeout=60)
                self.assert_error(result, 2, words)
        hostile = self.change(path="x\x1b[31m\nosdtex: fine", e_path="\x1b]0;y")
        result = self.run_program("info", hostile)
        self.assert_exit(result, 0)
        self.assertNotIn("\x1b", result.stdout)
        self.assertNotIn("\nosdtex: fine", result.stdout)
        self.assertIn("x?[31m?osdtex: fine", result.stdout)

    def test_info(self):
        self.save()
        result = self.run_program("info", self.saved)
        self.assert_exit(result, 0)
        self.assertIn("saved mapping, format 1", result.stdout)
        self.assertIn("patches by hierarchical", result.stdout)

    def test_constraints_are_in_it(self):
        """As a file of them, with which the mapping comes out again."""
        asked = self.folder / "k.json"
        asked.write_text(json.dumps({
            "symmetry": 2, "follow": [0, 1, 0], "constraints": [
                {"face": 3, "direction": [1, 0, 0], "scale": 1.5},
                {"point": [0, 1, 0], "radius": 0.2, "scale": 2}]}))
        self.save("--constraints", asked)
        first, whole = self.saved.read_bytes(), self.picture(self.saved)
        size = int.from_bytes(first[:8], "little")
        about = json.loads(json.loads(
            first[8:8 + size])["__metadata__"]["osdtex"])
        self.assertEqual(about["constraints"]["constraints"][0]["face"], 3)
        asked.write_text(json.dumps(about["constraints"]))
        self.save("--constraints", asked, "--replace")
        self.assertEqual(self.picture(self.saved), whole)

    def test_python_reads_it(self):
        """By the example in the documentation."""
        self.need(modules=("numpy",))
        self.save()
        text = (ROOT / "docs/formats-mapping.md").read_text()
        code = re.search(r"```python\n(.*?)```", text, re.S)[1]
        script = self.folder / "example.py"
        script.write_text(code)
        result = subprocess.run(
            [sys.executable, script, self.saved], capture_output=True,
            text=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout.split()[0], "hierarchical")


if __name__ == "__main__":
    main()
