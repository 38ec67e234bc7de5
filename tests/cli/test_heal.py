#!/usr/bin/env python3
"""Healing through the program: what is baked, saved and said of it."""

import json

from program import CAGES, EXEMPLARS, ProgramTest, main

CAGE = CAGES / "torus.obj"
PICTURE = EXEMPLARS / "bricks_tile.png"
MAPPED = CAGE, PICTURE, "--level", "1", "--scale", "2"
BAKE = "--uvs", "atlas", "--resolution", "128"
HEAL = "--heal", "32"


class Heal(ProgramTest):
    def bake(self, name, *more):
        result = self.run_program(
            "bake", *more, *BAKE, "-o", self.folder / f"{name}.obj",
            "--json-report", self.folder / f"{name}.json")
        self.assert_exit(result, 0)
        self.assertNotIn("warning: " + str(self.folder), result.stderr)
        report = json.loads((self.folder / f"{name}.json").read_text())
        return (self.picture(f"{name}.1001.exr"),
                report["mapping"].get("healed"))

    def test_any_number_of_threads(self):
        plain, healed = self.bake("plain", *MAPPED)
        self.assertIsNone(healed)
        one, healed = self.bake("one", *MAPPED, *HEAL, "--threads", "1")
        self.assertTrue(0 < healed["area_share"] < 1)
        self.assertGreater(healed["charts"], 0)
        self.assertNotEqual(one, plain)
        for threads in "2", "8":
            self.assertEqual(
                one, self.bake("many", *MAPPED, *HEAL, "--threads",
                               threads)[0])

    def test_a_saved_mapping_keeps_it_or_gets_it(self):
        healed = self.bake("a", *MAPPED, *HEAL, "--save",
                           self.folder / "healed.osdtex")[0]
        self.bake("b", *MAPPED, "--save", self.folder / "plain.osdtex")
        self.assertEqual(
            healed, self.bake("c", "--from", self.folder / "healed.osdtex")[0])
        self.assertEqual(
            healed,
            self.bake("d", "--from", self.folder / "plain.osdtex", *HEAL)[0])

    def test_what_auto_says(self):
        healed = self.bake("one", CAGE, PICTURE, "--level", "1", "--scale",
                           "5", "--heal", "auto")[1]
        windows = healed["windows"]
        self.assertTrue(0 <= healed["mended"] <= healed["sections"])
        self.assertTrue(0 <= healed["mended_length_share"] <= 1)
        self.assertGreater(windows["exemplar"], 0)
        if healed["mended"] > 0:
            self.assertGreater(
                windows["seams_before"], windows["interior_p90"])
            self.assertLess(windows["seams"], windows["seams_before"])

    def test_windows_are_shown_of_what_is_saved(self):
        self.bake("b", CAGE, PICTURE, "--level", "1", "--scale", "5", "--save",
                  self.folder / "b.osdtex")
        show = ("-o", self.folder / "w.png", "--size", "64x48", "--show",
                "windows")
        result = self.run_program(
            "render", "--from", self.folder / "b.osdtex", *show)
        self.assert_exit(result, 0)
        self.assertIn("times as far from the exemplar", result.stderr)
        result = self.run_program(
            "render", self.folder / "b_cage.obj", *show)
        self.assert_error(result, 1, "windows are those of a mapping")

    def test_uvs_cannot_say_it(self):
        result = self.run_map(*MAPPED, *HEAL)
        self.assert_exit(result, 0)
        self.assertIn("UVs cannot say what was healed", result.stderr)

    def test_what_is_no_band(self):
        for word in "-1", "513", "nan", "wide":
            result = self.run_map(*MAPPED, "--heal", word)
            self.assert_error(result, 1, "--heal takes a number of texels")
        self.assert_nothing_written()


if __name__ == "__main__":
    main()
