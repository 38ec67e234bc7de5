#!/usr/bin/env python3
"""osdtex map --keep on cages whose faces have changed.

    test_keep.py OSDTEX
"""

import json

from program import CAGES, EXEMPLARS, SHARED, ProgramTest, main
from remodel import remodel
from saved import read

EXEMPLAR = EXEMPLARS / "pebbles_tile.png"


class Keep(ProgramTest):
    def map(self, cage, *more, name="out"):
        report = self.folder / f"{name}.json"
        self.assert_exit(self.run_map(
            cage, EXEMPLAR, "--json-report", report, "--replace", *more,
            name=f"{name}.obj"), 0)
        return json.loads(report.read_text())

    def save(self, cage, *more):
        path = self.folder / "old.osdtex"
        self.map(cage, "--save", path, *more, name="old")
        return path

    def keep(self, change, cage, *more):
        """What becomes of a saved mapping of a cage that is remodelled."""
        old = self.save(cage, *more)
        made = self.folder / "made.obj"
        remodel(change, cage, made)
        return self.map(made, "--keep", old)

    def check_loop(self, cage, least, *more):
        kept = self.keep("loop", cage, *more)["mapping"]["kept"]
        self.assertGreaterEqual(kept["texels"], least)

    def test_an_edge_loop_on_a_creature(self):
        self.check_loop(CAGES / "creature.obj", 0.85, "--level", "2")

    def test_an_edge_loop_on_spot(self):
        cage = SHARED / "cages" / "spot_control_mesh.obj"
        if not cage.exists():
            self.skipTest("no cages of ../shared")
        self.check_loop(cage, 0.85, "--level", "3")

    def test_a_limb_that_is_gone_leaves_the_rest(self):
        kept = self.keep("cut", CAGES / "creature.obj", "--level", "2")
        self.assertGreater(kept["mapping"]["kept"]["texels"], 0.8)

    def test_another_level_of_the_same_cage(self):
        cage = CAGES / "torus.obj"
        old = self.save(cage, "--level", "2")
        kept = self.map(cage, "--keep", old, "--level", "3")["mapping"]["kept"]
        self.assertGreater(kept["texels"], 0.8)

    def test_what_has_no_common_ground_is_covered_anew(self):
        old = self.save(CAGES / "torus.obj", "--level", "2")
        kept = self.map(CAGES / "sphere.obj", "--keep", old)["mapping"]["kept"]
        self.assertLess(kept["texels"], 0.2)

    def test_placed_pictures_stay(self):
        cage = CAGES / "creature.obj"
        asked = self.folder / "p.json"
        asked.write_text(json.dumps({"placed": [
            {"picture": str(EXEMPLARS / "leaves_cut.png"), "face": f,
             "width": 0.3} for f in (3, 40)]}))
        old = self.save(cage, "--level", "2", "--place", asked)
        made = self.folder / "made.obj"
        remodel("loop", cage, made)
        saved = self.folder / "new.osdtex"
        self.map(made, "--keep", old, "--save", saved)
        before, after = read(old), read(saved)
        self.assertEqual(after["decal_picture"], before["decal_picture"])
        self.assertEqual(set(after["decal_number"]), {0, 1})
        self.assertGreater(
            len(after["decal_number"]), 0.8 * len(before["decal_number"]))
        self.assert_exit(self.run_program(
            "render", "--from", saved, "-o", self.folder / "p.png", "--size",
            "32x32"), 0)

    def test_several_exemplars(self):
        cage = CAGES / "torus.obj"
        rules = self.folder / "c.json"
        rules.write_text(json.dumps({"constraints": [
            {"face": f, "exemplar": 1 + f // 4 % 2} for f in range(0, 32, 4)]}))
        also = ("--also", EXEMPLARS / "gravel_tile.png")
        old = self.save(cage, "--level", "2", *also, "--constraints", rules)
        made = self.folder / "made.obj"
        remodel("loop", cage, made)
        saved = self.folder / "new.osdtex"
        self.map(made, "--keep", old, *also, "--save", saved)
        shown = read(saved)
        self.assertEqual(
            {shown["patch_exemplar"][p] for p in shown["face_patch"]}, {0, 1})

    def test_twice_the_same_for_any_number_of_threads(self):
        cage = CAGES / "creature.obj"
        old = self.save(cage, "--level", "2")
        made = self.folder / "made.obj"
        remodel("loop", cage, made)
        texts = []
        for threads in ("1", "2"):
            self.map(made, "--keep", old, "--threads", threads, "--save",
                     self.folder / "again.osdtex")
            texts.append((self.folder / "again.osdtex").read_bytes())
        self.assertEqual(*texts)


if __name__ == "__main__":
    main()
