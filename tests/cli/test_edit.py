#!/usr/bin/env python3
"""osdtex edit: what changes, what does not, and that a mapping with edits is
made again from its constraints.

    test_edit.py OSDTEX
"""

import json
import unittest

from program import CAGES, EXEMPLARS, ProgramTest, main
from saved import read_all as read

CAGE = CAGES / "torus.obj"
EXEMPLAR = EXEMPLARS / "grass_tile.png"
HOW = ("--level", "2", "--scale", "1.5", "--exemplar-class", "directional")


def changed(a, b):
    """Faces that show something else."""
    first = a["face_first"]
    return {f for f in range(len(first) - 1)
            if a["face_patch"][f] != b["face_patch"][f] or
            a["uvs"][2 * first[f]:2 * first[f + 1]] !=
            b["uvs"][2 * first[f]:2 * first[f + 1]]}


class Edit(ProgramTest):
    def save(self, *more, name="m.osdtex"):
        path = self.folder / name
        self.assert_exit(self.run_map(
            CAGE, EXEMPLAR, *HOW, "--save", path, "--replace", *more), 0)
        return path

    def edit(self, source, *more, name="n.osdtex"):
        result = self.run_program(
            "edit", source, "-o", self.folder / name, *more)
        self.assert_exit(result, 0)
        return self.folder / name

    def constraints(self, *items, name="c.json"):
        path = self.folder / name
        path.write_text(json.dumps({"constraints": items}))
        return path

    def test_redo_changes_the_spot_and_nothing_else(self):
        source = self.save()
        _, before = read(source)
        made = self.edit(source, "--redo", "9", "--reach", "0.2")
        about, after = read(made)
        faces = changed(before, after)
        self.assertGreater(len(faces), 4)
        self.assertLess(len(faces), len(before["face_patch"]) / 3)
        self.assertEqual(before["guide"], after["guide"])
        self.assertEqual(about["constraints"]["constraints"],
                         [{"face": 9, "edit": 1, "reach": 0.2, "redo": 1}])
        again = self.edit(source, "--redo", "9", "--reach", "0.2",
                          "--threads", "1", name="again.osdtex")
        self.assertEqual(self.picture(made.name), self.picture(again.name))
        other = self.edit(source, "--redo", "9", "--reach", "0.2", "--seed",
                          "2", name="other.osdtex")
        self.assertTrue(changed(after, read(other)[1]))

    def seam_energy(self, *more):
        report = self.folder / "r.json"
        self.assert_exit(self.run_map(
            CAGE, EXEMPLARS / "pebbles_tile.png", "--level", "3", "--replace",
            "--json-report", report, *more), 0)
        return json.loads(report.read_text())["seams"]["energy"]

    def test_six_redos_leave_seams_about_as_good(self):
        redos = [{"face": f, "redo": 1, "edit": k + 1}
                 for k, f in enumerate((0, 9, 18, 27, 4, 13))]
        self.assertLess(
            self.seam_energy("--constraints", self.constraints(*redos)),
            1.3 * self.seam_energy())

    def test_edits_one_by_one_are_those_of_one_file(self):
        """What a person does bit by bit, `osdtex map --constraints` makes at
        once, byte for byte."""
        comb = {"face": 3, "direction": [0, 1, 0.2], "reach": 0.4}
        size = {"point": [1, 0, 0], "radius": 0.2, "scale": 1.5, "reach": 0.5}
        one = self.edit(self.save(), "--constraints", self.constraints(comb),
                        name="one.osdtex")
        two = self.edit(one, "--constraints", self.constraints(size),
                        name="two.osdtex")
        at_once = self.save(
            "--constraints", self.constraints({**comb, "edit": 1},
                                              {**size, "edit": 2}))
        a, b = read(two), read(at_once)
        self.assertEqual(a[1], b[1])
        self.assertEqual(a[0]["constraints"], b[0]["constraints"])

    def moved(self, by):
        """The cage with its first vertex elsewhere."""
        lines = CAGE.read_text().splitlines()
        first = next(i for i, l in enumerate(lines) if l.startswith("v "))
        x, y, z = map(float, lines[first].split()[1:4])
        lines[first] = f"v {x + by} {y} {z}"
        path = self.folder / "moved.obj"
        path.write_text("\n".join(lines) + "\n")
        return path

    def test_keep_through_a_moved_vertex(self):
        source = self.save()
        made = self.folder / "kept.osdtex"
        for by in (0.01, 0.4):
            cage = self.moved(by)
            self.assert_exit(self.run_map(
                cage, EXEMPLAR, "--keep", source, "--save", made, "--replace",
                "--json-report", self.folder / "r.json"), 0)
            before, after = read(source)[1], read(made)[1]
            faces = changed(before, after)
            self.assertLess(len(faces), len(before["face_patch"]) / 3)
            kept = json.loads(
                (self.folder / "r.json").read_text())["mapping"]["kept"]
            self.assertLessEqual(
                len(faces), kept["moved"] + kept["covered"])
            self.assertEqual(
                kept["held"] + kept["moved"] + kept["covered"],
                len(before["face_patch"]))
            self.assertGreater(kept["texels"], 0.7)
        self.assertGreater(len(faces), 0)

    def test_what_cannot_be_kept_is_said(self):
        source = self.save()
        for more, words in (
                (("--keep", source, "--scale", "3"), "has the scale"),
                (("--keep", source, "--follow", "up"), "edit what comes")):
            with self.subTest(more):
                self.assert_error(
                    self.run_map(CAGE, EXEMPLAR, *more), 1, words)

    def test_numbers_too_large_are_refused(self):
        """The next edit has a number, too."""
        source = self.save()
        for number in (1000001, 2 ** 31 - 1):
            item = {"face": 3, "redo": 1, "reach": 0.2, "edit": number}
            for run in (
                    lambda path: self.run_program(
                        "edit", source, "--constraints", path, "-o",
                        self.folder / "n.osdtex"),
                    lambda path: self.run_map(
                        CAGE, EXEMPLAR, *HOW, "--constraints", path,
                        name="n.obj")):
                self.assert_error(
                    run(self.constraints(item)), 1, "from 1 to 1000000")
        last = self.edit(
            source, "--constraints",
            self.constraints({**item, "edit": 1000000}), name="last.osdtex")
        self.assert_error(self.run_program(
            "edit", last, "-o", self.folder / "n.osdtex", "--redo", "9"), 1,
            "from 1 to 1000000")
        self.assertFalse((self.folder / "n.osdtex").exists())

    def test_what_is_wrong_is_said(self):
        source = self.save()
        new = self.folder / "n.osdtex"
        for more, words in (
                ((), "--redo"),
                (("--redo", "1,2"), "--redo takes"),
                (("--redo", "1", "--reach", "-1"), "--reach takes")):
            with self.subTest(more):
                self.assert_error(self.run_program(
                    "edit", source, "-o", new, *more), 1, words)
        self.assert_error(self.run_program(
            "edit", source, "-o", new, "--redo", "99999"), 1, "cage lacks")
        self.assert_error(self.run_program(
            "edit", source, "-o", source, "--redo", "1"), 1, "m.osdtex")
        self.assert_error(self.run_program(
            "edit", CAGE, "-o", new, "--redo", "1"), 1, "saved mapping")
        self.assertFalse(new.exists())


if __name__ == "__main__":
    main()
