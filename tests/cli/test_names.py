#!/usr/bin/env python3
"""Names that formats would take amiss: what is written is valid and finds its
files, or one sentence says why there is nothing."""

import os
import re
import subprocess
import sys
import xml.etree.ElementTree
from pathlib import Path

from program import CAGES, EXEMPLARS, ProgramTest, main

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from oracle_venv import oracle_python  # noqa: E402

CAGE = CAGES / "plane.obj"
EXEMPLAR = EXEMPLARS / "gravel_tile.png"
QUICK = ("--level", "0", "--scale", "4", "--resolution", "32", "-q")

HOSTILE = [
    "a@b", "@a", "a@@@b", "a@@@@b@", "a\nb", "a\tb", "a\x7fb", "a b", "it's",
    'say "x"', "$HOME", "a%d%s", "a<b>&c", "a#b", "back\\slash", "-o", "ü日",
    "a;b", "`id`", "{a}", "a]]>b", "a--b", "..a",
    os.fsdecode(b"a\xffb"), os.fsdecode(b"\xc0\xaf"),
    os.fsdecode(b"\xed\xa0\x80"), "\u0085x", "\ufffey", "x" * 236]

USD = """
import os, sys
from pxr import Usd, UsdShade
for file in sys.argv[1:]:
    stage = Usd.Stage.Open(file)
    paths = [i.Get().path for p in stage.Traverse() if p.IsA(UsdShade.Shader)
             for i in UsdShade.Shader(p).GetInputs()
             if i.GetBaseName() == "file"]
    assert len(paths) == 1, (file, paths)
    assert os.path.exists(os.path.join(os.path.dirname(file), paths[0])), paths
"""


def asset_of(text):
    """The asset path of a USD file, by the grammar of its text format."""
    found = re.search(
        r"inputs:file = (?:@@@((?:\\@@@|[^@]|@{1,2}(?!@))*)@@@|@([^@\n]*)@)",
        text)
    three, one = found.groups()
    return three.replace("\\@@@", "@@@") if three is not None else one


class Names(ProgramTest):
    def check(self, files):
        """Every text is valid, and names files that are there."""
        ends = {e: [n for n in files if n.endswith(e)]
                for e in ("_cage.obj", "_cage.mtl", ".usda", ".mtlx", ".exr")}
        self.assertTrue(all(len(n) == 1 for n in ends.values()), ends)
        texture = ends[".exr"][0]
        obj = os.fsdecode(files[ends["_cage.obj"][0]].read_bytes())
        self.assertEqual(
            re.search("^mtllib (.*)$", obj, re.M).group(1), ends["_cage.mtl"][0])
        mtl = os.fsdecode(files[ends["_cage.mtl"][0]].read_bytes())
        self.assertEqual(
            re.search("^map_Kd (.*)$", mtl, re.M).group(1), texture)
        tree = xml.etree.ElementTree.parse(files[ends[".mtlx"][0]])
        self.assertEqual(
            tree.find(".//input[@name='file']").get("value"), texture)
        usda = files[ends[".usda"][0]]
        self.assertEqual(asset_of(usda.read_bytes().decode("utf-8")), texture)
        return usda

    def test_baked_names(self):
        written = []
        for i, name in enumerate(HOSTILE):
            with self.subTest(name):
                folder = self.folder / str(i)
                folder.mkdir()
                result = self.run_program(
                    "bake", CAGE, EXEMPLAR, *QUICK, "-o",
                    folder / f"{name}.obj")
                self.assert_exit(result, 0)
                written.append(
                    self.check({p.name: p for p in folder.iterdir()}))
        python, reason = oracle_python("pxr")
        if not reason:
            done = subprocess.run(
                [python, "-c", USD, *written], capture_output=True, text=True,
                errors="replace")
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_mapped_names(self):
        """The OBJ keeps its name; a picture of it needs all the others."""
        for name in "a@b\n$", os.fsdecode(b"a\xff#"), "-x y":
            with self.subTest(name):
                obj = self.folder / f"{name}.obj"
                self.assert_exit(self.run_program(
                    "map", CAGE, EXEMPLAR, "--level", "0", "--scale", "4",
                    "-q", "-o", obj), 0)
                self.assertTrue(obj.exists())
                result = self.run_program(
                    "render", obj, "-o", self.folder / "v.png", "--size",
                    "8x8", "-q")
                self.assert_exit(result, 0)
                self.assertEqual(result.stderr, "")
                for path in self.folder.iterdir():
                    path.unlink()

    def test_derived_names_are_guarded(self):
        """What the files beside NAME.obj are really called is compared."""
        for name in "a#b", "a\\b", "a\nb", os.fsdecode(b"a\xffb"), "a b":
            with self.subTest(name):
                picture = self.folder / "a_b.exr"
                self.assert_exit(self.run_program(
                    "tiles", EXEMPLAR, "-o", picture, "-q", "--tile-size",
                    "16", "--gutter", "1"), 0)
                before = picture.read_bytes()
                self.assert_error(
                    self.run_program(
                        "map", CAGE, picture, "-o",
                        self.folder / f"{name}.obj"), 1, "is an input")
                self.assertEqual(picture.read_bytes(), before)
                picture.unlink()


if __name__ == "__main__":
    main()
