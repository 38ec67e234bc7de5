#!/usr/bin/env python3
"""What a colour configuration offers can be listed, and sentences about it are
true."""

import unittest

from program import CAGES, EXEMPLARS, SHARED, ProgramTest, main

PLANE = CAGES / "plane.obj"
GRASS = EXEMPLARS / "grass_tile.png"
STUDIO = SHARED / "ocio" / "mini_rec709_v2.0.ocio"


class Spaces(ProgramTest):
    def test_the_one_in_force_is_listed(self):
        done = self.run_program("info", "-q")
        self.assert_exit(done, 0)
        for line in ("    scene_linear: Linear Rec.709 (sRGB)\n",
                     "    ACEScg (scene-linear); also ACES - ACEScg, lin_ap1,",
                     "    sRGB: Un-tone-mapped, Raw\n"):
            self.assertIn(line, done.stdout)
        for title in ("roles", "spaces", "displays"):
            self.assertEqual(done.stdout.count(f"  {title}\n"), 1)

    @unittest.skipUnless(STUDIO.exists(), "../shared is not here")
    def test_three_ways_to_name_one(self):
        lists = [
            self.run_program("info", "-q", STUDIO),
            self.run_program("info", "-q", "--colorconfig", STUDIO),
            self.run_program("info", "-q", environment={"OCIO": str(STUDIO)})]
        for done in lists:
            self.assert_exit(done, 0)
            self.assertIn("    lin_rec709 (scene-linear)\n", done.stdout)
            self.assertEqual(done.stdout, lists[0].stdout)
        # By what is in it, not by its name.
        copy = self.folder / "config.yaml"
        copy.write_text(STUDIO.read_text())
        self.assertEqual(
            self.run_program("info", "-q", copy).stdout, lists[0].stdout)

    def test_unknown_spaces_name_the_list(self):
        self.assert_error(
            self.run_map(PLANE, GRASS, "--to", "ACESgc"), 4,
            "did you mean 'ACEScg'?; `osdtex info` lists all")
        if STUDIO.exists():
            self.assert_error(
                self.run_map(PLANE, GRASS, "--from", "nothing",
                             "--colorconfig", STUDIO), 4,
                f"`osdtex info {STUDIO}` lists all")

    def test_names_of_carried_configurations(self):
        """OpenColorIO 2.2 and later have them, Debian 12's does not."""
        names = ("ocio://default", "ocio://cg-config-v1.0.0_aces-v1.3_ocio-v2.1",
                 "ocio://studio-config-v1.0.0_aces-v1.3_ocio-v2.1")
        for name in names:
            done = self.run_program("info", environment={"OCIO": name})
            self.assert_exit(done, 0)
            self.assertIn("    scene_linear: ACEScg\n", done.stdout)
        self.assert_error(
            self.run_program("info", "ocio://nobody-s"), 4, "ocio://nobody-s")

    def test_what_is_no_configuration(self):
        self.assert_error(
            self.run_program("info", self.folder / "no.ocio"), 4,
            "does not exist")
        broken = self.folder / "broken.ocio"
        broken.write_text("ocio_profile_version: 2\n\nroles:\n  default: x\n")
        self.assert_error(self.run_program("info", broken), 4, "broken.ocio")


main()
