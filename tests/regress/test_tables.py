#!/usr/bin/env python3
"""osdtex regress: what it says of a table, and one case through its life."""

import json

from suites import TILE, TILE_CASE, SuiteTest, main


class Tables(SuiteTest):
    def test_from_no_reference_to_damage(self):
        self.write_table(TILE, tolerances={"time.*": 100})
        self.assert_exit(self.regress(), 6)
        self.assertEqual(self.results()[TILE_CASE]["status"], "missing")
        self.assertIn("--update " + TILE_CASE, self.page())
        self.assert_exit(self.regress("--update", TILE_CASE), 0)
        self.assert_exit(self.regress(), 0)
        self.assert_exit(self.regress(damage="pixel"), 6)
        case = self.results()[TILE_CASE]
        self.assertEqual(case["tolerance"]["status"], "fail")
        self.assertEqual(case["exact"]["status"], "pass")

    def test_mistakes(self):
        for table, words in (
                ("{", "table.json:1: "), ("{}", 'has no "rows"'),
                ('{"rows": [{}]}', 'row 0 has no "cages"'),
                ('{"rows": [{"cages": [1]}]}', "number 0 is no text"),
                (json.dumps({"rows": [{**TILE, "also": [1]}]}),
                 'in "also", number 0 is no text'),
                (json.dumps({"rows": [TILE, TILE]}), "two cases are called")):
            suite = self.write_table(TILE)
            (suite / "table.json").write_text(table)
            self.assert_error(self.regress(), 2, words)
        self.write_table(TILE)
        self.assert_error(self.regress("none"), 2, "has no case 'none'")
        self.assert_error(
            self.regress("--update", "none"), 2, "has no case 'none'")
        self.assert_error(
            self.run_program("regress", self.folder / "suite"), 1, "-o FOLDER")
        self.assert_error(
            self.run_program(
                "regress", self.folder / "suite", "-o",
                self.folder / "suite" / "table.json"), 3, "cannot be made")


if __name__ == "__main__":
    main()
