#!/usr/bin/env python3
"""Help, versions, mistakes on the command line."""

import re

from program import CAGES, EXEMPLARS, ProgramTest, main

CAGE = CAGES / "sphere.obj"
EXEMPLAR = EXEMPLARS / "gravel_tile.png"


class Help(ProgramTest):
    def commands(self):
        """As the program lists them."""
        text = self.run_program("--help").stdout.split("Commands:\n")[1]
        found = re.findall(r"^    (\w+) +\w", text.split("\n\n")[0], re.M)
        self.assertTrue({"map", "bake", "studio", "help"} <= set(found), found)
        return found

    def test_help_opens_with_examples(self):
        result = self.run_program("--help")
        self.assert_exit(result, 0)
        examples = result.stdout.index("    osdtex map ")
        self.assertLess(examples, result.stdout.index("Usage:"))
        for line in result.stdout.split("\n"):
            self.assertLess(len(line), 80, line)

    def test_every_command_has_help(self):
        for command in self.commands():
            result = self.run_program(command, "--help")
            self.assert_exit(result, 0)
            self.assertIn(f"Usage: osdtex {command} ", result.stdout)
            self.assertEqual(
                result.stdout, self.run_program("help", command).stdout)

    def test_help_fits_a_terminal(self):
        for command in self.commands():
            for line in self.run_program(command, "--help").stdout.split("\n"):
                self.assertLess(len(line), 80, line)

    def test_version(self):
        for arguments in (["--version"], ["map", "--version"]):
            result = self.run_program(*arguments)
            self.assert_exit(result, 0)
            self.assertRegex(result.stdout, r"^osdtex \d+\.\d+\.\d+ \(build [\w.-]+\+[0-9a-f]{12}\)\n$")

    def test_man_page_has_every_flag(self):
        page = self.run_program("help", "--man").stdout.replace("\\-", "-")
        for command in ("map", "render"):
            flags = re.findall(
                r"^    (?:-\w, )?(--[a-z-]+)",
                self.run_program(command, "--help").stdout, re.M)
            self.assertGreater(len(flags), 10)
            for flag in flags:
                self.assertIn(f"\\fB{flag}\\fR", page)

    def test_methods(self):
        result = self.run_program("methods")
        self.assert_exit(result, 0)
        names = [line.split()[0] for line in result.stdout.splitlines()]
        self.assertIn("hierarchical", names)
        for name in names:
            result = self.run_program("methods", name)
            self.assert_exit(result, 0)
            self.assertIn("--set KEY=VALUE", result.stdout)


class Mistakes(ProgramTest):
    def refused(self, words, *arguments, code=1):
        self.assert_error(self.run_program(*arguments), code, words)
        self.assert_nothing_written()

    def map_refused(self, words, *more, code=1):
        self.assert_error(self.run_map(CAGE, EXEMPLAR, *more), code, words)
        self.assert_nothing_written()

    def test_no_command(self):
        self.assert_exit(self.run_program(), 1)

    def test_near_names_are_suggested(self):
        self.refused("did you mean 'map'?", "mpa")
        self.refused("did you mean 'render'?", "rendr")
        self.refused("did you mean 'hierarchical'?", "methods", "hierarchcal")
        self.map_refused("did you mean '--scale'?", "--sclae", "3")
        self.map_refused("did you mean 'hierarchical'?", "--method", "hierarch")
        self.refused("no command 'xyzzy'", "xyzzy")
        self.refused("did you mean 'tiles'?", "help", "tile")
        self.map_refused("it is for other commands", "--task", "0")
        self.map_refused("no option '--xyzzy'; see --help", "--xyzzy")

    def test_unknown_flags_and_missing_values(self):
        self.map_refused("no option '-z'", "-z")
        self.map_refused("'--level' needs a value", "--level")
        self.map_refused("cannot stand here", "--oriented")
        self.map_refused("'--quiet' takes no value", "--quiet=3")

    def test_operands(self):
        self.refused("takes CAGE.obj EXEMPLAR", "map", CAGE)
        self.refused("takes CAGE.obj EXEMPLAR", "map", CAGE, CAGE, CAGE)
        self.refused(
            "is a picture, where the cage, an OBJ, is expected",
            "map", EXEMPLAR, CAGE, "-o", self.folder / "x.obj")
        self.refused("one file too many", "info", *["x"] * 9)
        self.refused("-o DIR/NAME.obj", "map", CAGE, EXEMPLAR)
        self.refused("-o NAME.png", "render", CAGE)
        self.refused(
            "-o DIR/NAME.obj", "map", CAGE, EXEMPLAR, "-o",
            self.folder / "out.ply")

    def test_values(self):
        self.map_refused("--level takes", "--level", "11")
        self.map_refused("--level takes", "--level", "2.5")
        self.map_refused("--scale takes", "--scale", "0")
        self.map_refused("--scale takes", "--scale", "nan")
        self.map_refused("--scale takes", "--scale", "1,5")
        self.map_refused("--seed takes", "--seed", "-1")
        self.map_refused("--scheme takes", "--scheme", "doosabin")
        self.map_refused("--boundary takes", "--boundary", "sharp")
        self.map_refused("--fvar takes", "--fvar", "some")
        self.map_refused("--threads takes", "--threads", "-1")
        self.map_refused("--memory-limit takes", "--memory-limit", "8Q")
        self.map_refused("--match-in takes", "--match-in", "yuv")
        self.map_refused("--wrap takes", "--wrap", "maybe")
        self.map_refused("--set takes KEY=VALUE", "--set", "mode")
        self.map_refused("no setting 'nonsense'", "--set", "nonsense=1")
        self.map_refused("--first-patch takes", "--first-patch", "1,2,3")
        self.map_refused("faces 0 to 95", "--first-patch", "96,0,0,0")
        self.refused(
            "which is a hole", "map", CAGES / "hole.obj", EXEMPLAR, "-o",
            self.folder / "out.obj", "--level", "1", "--first-patch",
            "10,0,0,0")
        self.map_refused("--preview writes", "--preview", "x.jpg")

    def test_what_a_method_leaves_out_is_said(self):
        result = self.run_map(
            CAGES / "torus.obj", EXEMPLARS / "bricks_tile.png", "--level", "1",
            "--method", "material",
            "--first-patch", "3,0,0,0")
        self.assert_exit(result, 0)
        self.assertIn("has no first patch", result.stderr)

    def test_flags_of_a_bake_that_is_not_made(self):
        result = self.run_map(
            CAGES / "torus.obj", EXEMPLARS / "bricks_tile.png", "--level", "1",
            "--margin", "8", "--extra", "uv")
        self.assert_exit(result, 0)
        for flag in "--margin", "--extra":
            self.assertIn(f"warning: {flag} is for a bake", result.stderr)

    def test_render_values(self):
        out = self.folder / "x.png"
        for flag, value in (("--size", "12"), ("--size", "0x4"),
                            ("--samples", "17"), ("--turn", "x"),
                            ("--camera", "1,2,3"),
                            ("--camera", "0,0,5,0,0,0,180")):
            self.refused(
                f"{flag} takes", "render", CAGE, "-o", out, flag, value)
        self.refused(
            "did you mean 'front'?", "render", CAGE, "-o", out, "--camera",
            "fornt")
        self.refused(
            "did you mean 'patches'?", "render", CAGE, "-o", out, "--show",
            "patchs")
        self.refused(
            "--follow is for --show field", "render", CAGE, "-o", out,
            "--follow", "up")
        self.refused(
            "--symmetry takes", "render", CAGE, "-o", out, "--show", "field",
            "--symmetry", "3")

    def test_outputs_may_not_replace_inputs(self):
        cage = self.folder / "cage.obj"
        cage.write_bytes(CAGE.read_bytes())
        result = self.run_map(cage, EXEMPLAR, name="cage.obj")
        self.assert_error(result, 1, "is an input and would be replaced")
        self.assertEqual(cage.read_bytes(), CAGE.read_bytes())
        result = self.run_map(
            CAGE, EXEMPLAR, "--json-report", self.folder / "out.mtl")
        self.assert_error(result, 1, "would be written twice")


class Files(ProgramTest):
    def test_missing_inputs_are_io(self):
        self.assert_error(self.run_map("nowhere.obj", EXEMPLAR), 3, "nowhere")
        self.assert_error(self.run_map(CAGE, "nowhere.png"), 3, "nowhere")
        self.assert_nothing_written()

    def test_missing_folder_is_io(self):
        result = self.run_map(CAGE, EXEMPLAR, name="no/such/out.obj")
        self.assert_error(result, 3, "folder")

    def test_damaged_inputs_are_data(self):
        bad = self.folder / "bad.obj"
        bad.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 2\n")
        result = self.run_map(bad, EXEMPLAR)
        self.assert_error(result, 2, f"{bad}:4: ")
        picture = self.folder / "bad.png"
        picture.write_bytes(EXEMPLAR.read_bytes()[:1000])
        self.assert_error(self.run_map(CAGE, picture), 2, f"{picture}: ")
        self.assertFalse((self.folder / "out.obj").exists())

    def test_findings_hold_no_commands_for_terminals(self):
        path = self.folder / "a.obj"
        path.write_text("usemtl a\33[31mred\n" + CAGE.read_text())
        result = self.run_map(path, EXEMPLAR, "--also", f"b={EXEMPLAR}")
        self.assert_error(result, 1, "there are 'a?[31mred'")

    def test_colour_errors(self):
        self.assert_error(
            self.run_map(CAGE, EXEMPLAR, "--from", "sRBG"), 4, "--from")
        config = self.folder / "config.ocio"
        config.write_text("ocio_profile_version: 2\nnonsense")
        self.assert_error(
            self.run_map(CAGE, EXEMPLAR, "--colorconfig", config), 4, "")
        self.assert_error(
            self.run_map(CAGE, EXEMPLAR, environment={"OCIO": str(config)}),
            4, "")
        self.assertFalse((self.folder / "out.obj").exists())

    def test_limits(self):
        result = self.run_map(
            CAGE, EXEMPLAR, "--level", "9", "--memory-limit", "100M")
        self.assert_error(result, 5, "")
        self.assert_nothing_written()
        result = self.run_map(
            CAGE, EXEMPLAR, "--scale", "1e-30", "--level", "1")
        self.assert_error(result, 5, "pictures long, over the limit of 1024")
        self.assert_nothing_written()


class Info(ProgramTest):
    def test_cage(self):
        result = self.run_program("info", CAGES / "several_components.obj")
        self.assert_exit(result, 0)
        self.assertIn("87 quads", result.stdout)
        self.assertIn("components  4,", result.stdout)

    def test_tags_and_hints(self):
        self.assertIn(
            "2 holes", self.run_program("info", CAGES / "hole.obj").stdout)
        self.assertIn(
            "--scheme loop",
            self.run_program("info", CAGES / "loop_closed.obj").stdout)

    def test_picture(self):
        result = self.run_program("info", EXEMPLAR)
        self.assert_exit(result, 0)
        self.assertIn("256 x 256", result.stdout)
        self.assertIn("tiles       both ways", result.stdout)

    def test_other_pictures_are_no_cages(self):
        for name, head in (("a.tga", b"\0\0\2"), ("a.dds", b"DDS |\0\0\0")):
            path = self.folder / name
            path.write_bytes(head + b"\0" * 100)
            self.assert_error(
                self.run_program("info", path), 2,
                "is not an EXR, PNG, TIFF or JPEG picture; convert it")


if __name__ == "__main__":
    main()
