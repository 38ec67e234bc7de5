#!/usr/bin/env python3
"""300 random cages through every method, scheme and the bake.

Whatever the cage is, the program ends with one of its exit codes; where that
is no success, it says why and leaves nothing; where it is, all numbers are
finite and no face is turned over in the texture unless stderr says so. A case
is made from its number alone: CASE=17 runs that one and keeps its cage.
"""

import json
import os
import random
import re
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor

import cages
from program import (
    ENVIRONMENT, EXEMPLARS, PROGRAM, ProgramTest, main)

CASES = int(os.environ.get("CASES", 300))
METHODS = ("hierarchical", "material", "tile", "lapped", "vertex")
SCHEMES = (None, None, "catmark", "loop", "bilinear", "none")
TILES = "tiles.exr"  # what method tile takes, made of one of the others
PICTURES = ("gravel_tile.png", "stones_open.png", "bricks_tile.png")
# A machine under load, or a sanitizer; only what never ends is caught.
SECONDS = 600


def case_of(number):
    """The cage's text and the words behind its name."""
    rng = random.Random(1000003 * number)
    method = METHODS[number % len(METHODS)]
    words = ["--method", method, "--seed", str(number), "--threads", "1"]
    words += ["--level", str(rng.choice((0, 1, 1, 2)))]
    scheme = rng.choice(SCHEMES)
    if scheme:
        words += ["--scheme", scheme]
        if scheme == "none":
            words[words.index("--level") + 1] = "0"
    if rng.random() < 0.2:
        words += ["--scale", str(rng.choice((1e-3, 0.5, 4, 1e4, 1e10)))]
    command = "map"
    if rng.random() < 0.4:
        command = "bake"
        words += ["--resolution", "64", "--margin", "4"]
        words += rng.choice(([], ["--uvs", "atlas"], ["--uvs", "own"],
                             ["--seam-blend", "4"], ["--extra", "patch,uv"]))
    elif method in ("lapped", "vertex"):
        words += ["--resolution", "256"]
    picture = rng.choice(PICTURES)
    if method == "tile":
        picture = TILES
    return cages.make(number), command, picture, words


def numbers_of(path):
    for line in path.read_text().splitlines():
        if line.startswith(("v ", "vt ", "vn ", "Kd ", "t ")):
            yield from re.findall(r"(?i)\b(?:nan|inf)\w*", line)


def finite_json(text):
    def refuse(name):
        raise AssertionError(f"the report has {name}")
    return json.loads(text, parse_constant=refuse)


class Generated(ProgramTest):
    def setUp(self):
        super().setUp()
        self.assert_exit(self.run_program(
            "tiles", EXEMPLARS / "gravel_tile.png", "-o", self.folder / TILES,
            "--tile-size", "32"), 0)

    def picture(self, name):
        return self.folder / name if name == TILES else EXEMPLARS / name

    def run_case(self, number):
        """What is wrong with case `number`, None when nothing."""
        text, command, picture, words = case_of(number)
        folder = self.folder / str(number)
        out = folder / "out"
        out.mkdir(parents=True)
        cage = folder / "cage.obj"
        cage.write_text(text)
        words = [command, str(cage), str(self.picture(picture)), "-o",
                 str(out / "x.obj"), "--json-report", str(out / "x.json"),
                 "--memory-limit", "2G", *words]
        try:
            done = subprocess.run(
                [PROGRAM, *words], capture_output=True, text=True,
                errors="replace", env=ENVIRONMENT, timeout=SECONDS)
            wrong = self.judge(done, out)
        except subprocess.TimeoutExpired:
            wrong = f"it does not end in {SECONDS} s"
        except AssertionError as e:
            wrong = str(e)
        if not wrong:
            shutil.rmtree(folder)
            return None
        return f"CASE={number}: {wrong}\n    osdtex {' '.join(words)}"

    def judge(self, done, out):
        errors = [line for line in done.stderr.splitlines()
                  if line.startswith("osdtex: error: ")]
        if not 0 <= done.returncode <= 5:
            return f"it ended with {done.returncode}: {done.stderr[-400:]}"
        if done.returncode != 0:
            if not errors:
                return f"exit {done.returncode} without an error"
            left = sorted(p.name for p in out.iterdir())
            return f"it failed and left {left}" if left else None
        if errors:
            return f"exit 0 with {errors[0]}"
        return self.judge_outputs(done.stderr, out)

    def judge_outputs(self, said, out):
        for path in [*out.glob("*.obj"), *out.glob("*.mtl")]:
            for word in numbers_of(path):
                return f"{path.name} has {word}"
        report = finite_json((out / "x.json").read_text())
        distortion = report["distortion"]
        for what in ("flips", "uncovered"):
            if distortion[what] and not re.search(
                    r"reversed|flip|fold|cover", said):
                return f"{distortion[what]} {what}, and stderr says nothing"
        for path in out.glob("*.exr"):
            wrong = self.judge_picture(path)
            if wrong:
                return wrong
        return None

    def judge_picture(self, path):
        if not shutil.which("oiiotool"):
            return None
        text = subprocess.run(
            ["oiiotool", "--stats", str(path)], capture_output=True,
            text=True).stdout
        for name in ("NanCount", "InfCount"):
            for counts in re.findall(rf"{name}: ([\d ]+)", text):
                if any(map(int, counts.split())):
                    return f"{path.name} has {name} {counts}"
        return None if "Stats" in text else f"{path.name} is unreadable"

    def test_what_holds_for_every_cage(self):
        numbers = range(CASES)
        if "CASE" in os.environ:
            numbers = [int(os.environ["CASE"])]
            print(case_of(numbers[0])[0])
        with ThreadPoolExecutor(2) as pool:
            wrong = [w for w in pool.map(self.run_case, numbers) if w]
        self.assertFalse(wrong, "\n" + "\n".join(wrong))

    def test_many_are_surfaces_and_many_are_not(self):
        """A generator of nothing but nonsense would test nothing but refusals.
        """
        codes = []
        for number in range(0, 40):
            cage = self.folder / "cage.obj"
            cage.write_text(cages.make(number))
            codes.append(self.run_program("info", cage).returncode)
        self.assertGreaterEqual(codes.count(0), 10, codes)
        self.assertGreaterEqual(codes.count(2), 5, codes)


if __name__ == "__main__":
    main()
