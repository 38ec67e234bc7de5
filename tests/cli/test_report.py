#!/usr/bin/env python3
"""The JSON report as hand-over: its schema, what was asked, which files came of
it, and verdicts.

    test_report.py OSDTEX
"""

import copy
import json
import sys
import unittest

from program import CAGES, EXEMPLARS, ROOT, ProgramTest, main

PLANE = CAGES / "plane.obj"
PEBBLES = EXEMPLARS / "pebbles_tile.png"
BAKE = ("--uvs", "own", "--resolution", "64")
SCHEMA = ROOT / "docs" / "report.schema.json"


class Report(ProgramTest):
    def report(self, command, *words, code=0):
        path = self.folder / "out.json"
        result = self.run_program(
            command, *words, "-o", self.folder / "out.obj", "--json-report",
            path, "--replace")
        self.assert_exit(result, code)
        return json.loads(path.read_text())

    def check(self, report):
        self.need(modules=("jsonschema",))
        import jsonschema
        if not hasattr(Report, "validator"):
            schema = json.loads(SCHEMA.read_text())
            jsonschema.Draft202012Validator.check_schema(schema)
            Report.validator = jsonschema.Draft202012Validator(schema)
        found = [f"{list(e.absolute_path)}: {e.message[:300]}"
                 for e in Report.validator.iter_errors(report)]
        self.assertEqual(found, [])

    def test_reports_of_all_kinds(self):
        """What map and bake report by every method and with every addition is
        what the schema says."""
        bricks, mushroom = (EXEMPLARS / "bricks_tile.png",
                            CAGES / "materials_and_groups.obj")
        jobs = {
            "plain mesh": ("map", PLANE, PEBBLES, "--scheme", "none"),
            "healed": ("map", PLANE, PEBBLES, "--level", "1", "--heal", "8",
                       "--scale", "8", "--first-patch", "3,.5,.5,30"),
            "material": ("map", PLANE, bricks, "--method", "material",
                         "--level", "2"),
            "lapped": ("map", PLANE, PEBBLES, "--method", "lapped", "--level",
                       "1", "--scale", "8"),
            "vertex": ("map", PLANE, PEBBLES, "--method", "vertex", "--level",
                       "0", "--scale", "8"),
            "several": ("map", mushroom, PEBBLES, "--also", f"cap={bricks}",
                        "--level", "0", "--scale", "4"),
            "bake": ("bake", PLANE, PEBBLES, "--level", "1", *BAKE, "--for",
                     "blender", "--save", self.folder / "out.osdtex"),
            "saved": ("bake", "--from", self.folder / "out.osdtex", *BAKE),
        }
        for name, words in jobs.items():
            with self.subTest(name):
                self.check(self.report(*words))

    def test_the_schema_finds_what_is_wrong(self):
        report = self.report("map", PLANE, PEBBLES, "--level", "0")
        self.check(report)
        wrong = [("schema", 2), ("surprise", 1), ("seams", {}),
                 ("verdicts", []), ("outputs", [{"path": "x"}])]
        for key, value in wrong:
            with self.subTest(key):
                bad = {**copy.deepcopy(report), key: value}
                self.assertFalse(Report.validator.is_valid(bad))

    def test_what_was_asked_and_what_it_cost(self):
        words = ("map", PLANE, "--level", "1", PEBBLES, "--seed", "3")
        process = self.report(*words)["process"]
        self.assertEqual(process["arguments"][:7], [str(w) for w in words])
        self.assertEqual(process["arguments"][-1], "--replace")
        self.assertGreater(process["cpu_seconds"], 0)
        self.assertGreater(process["wall_seconds"], 0)

    def test_files_with_roles_and_hashes(self):
        """They are those that are there, hashed as they are there: a report
        hashes the cage in the same way."""
        report = self.report(
            "map", PLANE, PEBBLES, "--level", "1", "--bake", *BAKE, "--extra",
            "uv", "--preview", self.folder / "out.png", "--size", "64x48",
            "--samples", "1", "--save", self.folder / "out.osdtex")
        files = {f["path"].split("/")[-1]: f for f in report["outputs"]}
        self.assertEqual(
            {name: (f["role"], f.get("map")) for name, f in files.items()},
            {"out.obj": ("model", None), "out.mtl": ("materials", None),
             "out.exr": ("texture", "color"), "out_cage.obj": ("cage", None),
             "out_cage.mtl": ("materials", None),
             "out.1001.exr": ("texture", "color"),
             "out_uv.1001.exr": ("texture", "uv"), "out.usda": ("usd", None),
             "out.mtlx": ("materialx", None), "out.png": ("picture", None),
             "out.osdtex": ("mapping", None)})
        there = {p.name for p in self.folder.iterdir()}
        self.assertEqual(set(files), there - {"out.json"})
        for name, file in files.items():
            self.assertEqual(
                (self.folder / name).stat().st_size, file["bytes"], name)
        # Read as a cage it has the hash that the report says.
        self.assertEqual(
            self.report("map", self.folder / "out_cage.obj", PEBBLES,
                        "--level", "0")[
                "inputs"]["cage"]["hash"],
            files["out_cage.obj"]["hash"])

    def test_verdicts(self):
        def of(report):
            return {v["what"]: v for v in report["verdicts"]}

        bricks = EXEMPLARS / "bricks_tile.png"
        calm = of(self.report("map", PLANE, bricks, "--method", "material",
                              "--level", "2"))
        self.assertEqual(calm["faces"]["verdict"], "good")
        self.assertEqual(calm["stretch"]["verdict"], "good")
        self.assertIn("seam", calm["seams"]["sentence"])
        # A picture far too large for the surface is hardly used.
        large = of(self.report("map", PLANE, PEBBLES, "--level", "2",
                               "--scale", "40"))
        self.assertEqual(large["variety"]["verdict"], "poor")
        self.assertRegex(large["variety"]["sentence"], r"^\d+ % of the picture")

    def test_receivers(self):
        nobody = self.report("map", PLANE, PEBBLES, "--level", "0")["receiver"]
        self.assertEqual((nobody["for"], nobody["hints"]), (None, []))
        for name, word in (("blender", "Non-Color"), ("maya", "Raw"),
                           ("web", "sRGB")):
            told = self.report(
                "map", PLANE, PEBBLES, "--level", "0", "--for", name)["receiver"]
            self.assertEqual(told["for"], name)
            self.assertIn(word, " ".join(told["hints"]))


if __name__ == "__main__":
    main()
