#!/usr/bin/env python3
"""The Python module: the same bytes as the program, arrays over the library's
memory, callbacks, exceptions, threads, and nothing left behind.

    test_module.py OSDTEX FOLDER_OF_THE_PACKAGE
"""

import doctest
import gc
import json
import os
import re
import shutil
import sys
import threading
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))
sys.path.insert(0, sys.argv[2])

from program import CAGES, EXEMPLARS, ROOT, ProgramTest, main

try:
    import numpy
except ImportError:
    print("skipped: no Python module numpy (tools/deps medium)")
    sys.exit(77)
import osdtex

PLANE = CAGES / "plane.obj"
TORUS = CAGES / "torus.obj"
PEBBLES = EXEMPLARS / "pebbles_tile.png"
QUICK = {"level": 1}


class ModuleTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.context = osdtex.Context(threads=2)
        self.addCleanup(self.context.close)

    def read(self, cage=PLANE, exemplar=PEBBLES, **options):
        return (self.context.read_cage(cage),
                self.context.read_exemplar(exemplar, **options))


class SameBytes(ModuleTest):
    """Five jobs of the program, and the same through the module."""

    def program(self, command, cage, exemplar, *words):
        there = self.folder / "program"
        there.mkdir()
        self.assert_exit(self.run_program(
            command, cage, exemplar, "-o", there / "out.obj", *words), 0)
        texts = [p.read_bytes() for p in sorted(there.iterdir())]
        job = re.search(rb"osdtex job ([0-9a-f]{32}) of", texts[0])[1]
        return there, job.decode()

    def compare(self, there):
        here = self.folder / "module"
        names = sorted(p.name for p in there.iterdir())
        self.assertEqual(names, sorted(p.name for p in here.iterdir()))
        for name in names:
            self.assertEqual(
                (there / name).read_bytes(), (here / name).read_bytes(), name)

    def outputs(self, job, source):
        (self.folder / "module").mkdir()
        return self.context.outputs(job, source)

    def path(self, name="out.obj"):
        return self.folder / "module" / name

    def test_map_as_it_comes(self):
        there, job = self.program("map", PLANE, PEBBLES)
        with self.outputs(job, PLANE):
            self.context.map(*self.read()).write(self.path())
        self.compare(there)

    def test_map_with_settings_and_heal(self):
        there, job = self.program(
            "map", PLANE, PEBBLES, "--scale", "1.5", "--level", "1", "--seed",
            "7", "--heal", "8", "--set", "mode=paper", "--normals")
        with self.outputs(job, PLANE):
            self.context.map(
                *self.read(), scale=1.5, level=1, seed=7, heal=8,
                settings={"mode": "paper"}).write(self.path(), normals=True)
        self.compare(there)

    def test_another_method(self):
        cage, exemplar = CAGES / "plane.obj", EXEMPLARS / "bricks_tile.png"
        there, job = self.program(
            "map", cage, exemplar, "--method", "material", "--level", "3")
        with self.outputs(job, cage):
            self.context.map(
                *self.read(cage, exemplar), method="material",
                level=3).write(self.path())
        self.compare(there)

    def test_several_exemplars_and_a_saved_mapping(self):
        cage = CAGES / "materials_and_groups.obj"
        first, second = EXEMPLARS / "stones_open.png", PEBBLES
        there, job = self.program(
            "map", cage, first, "--also", f"cap={second}", "--level", "1",
            "--save", self.folder / "program" / "out.osdtex")
        with self.outputs(job, cage):
            read_cage, read = self.read(cage, first)
            mapping = self.context.map(
                read_cage, read, level=1,
                also=[(self.context.read_exemplar(second), "cap")])
            mapping.write(self.path())
            mapping.save(self.path("out.osdtex"))
        self.assertEqual(mapping.exemplar_count, 2)
        self.compare(there)

    def test_bake(self):
        there, job = self.program(
            "bake", TORUS, PEBBLES, "--level", "1", "--uvs", "atlas",
            "--resolution", "128", "--extra", "patch,uv")
        with self.outputs(job, TORUS):
            self.context.map(*self.read(TORUS), **QUICK).bake(
                self.path(), uvs="atlas", resolution=128,
                extras=["patch", "uv"])
        names = {p.name for p in there.iterdir()}
        self.assertIn("out_uv.1001.exr", names)
        self.compare(there)


class Edits(ModuleTest):
    """Edits of the program, and the same through the module."""
    HOW = {"level": 2, "scale": 1.5, "exemplar_class": "directional"}
    COMB = {"face": 3, "direction": [0, 1, 0.2], "reach": 0.4}

    def program_edit(self, source, path, *words):
        self.assert_exit(self.run_program(
            "edit", source, "-o", path, "--replace", *words), 0)
        return path.read_bytes()

    def module_edit(self, source, path, **options):
        edited = self.context.read_mapping(source).edit(**options)
        with self.context.outputs(source=TORUS):
            edited.save(path)
        return path.read_bytes()

    def test_the_same_bytes(self):
        mapping = self.context.map(*self.read(TORUS), **self.HOW)
        source = self.folder / "m.osdtex"
        mapping.save(source)
        asked = self.folder / "c.json"
        asked.write_text(json.dumps({"constraints": [self.COMB]}))
        both = self.folder / "both.json"
        both.write_text(json.dumps({"constraints": [
            {**self.COMB, "edit": 1}, {"face": 9, "redo": 2, "edit": 2,
                                       "reach": 0.2}]}))
        path = self.folder / "n.osdtex"
        x, y, z = mapping.points[mapping.face_verts[0]].tolist()
        for words, options in (
                (("--redo", "9"), {"redo": 9}),
                (("--redo", "9", "--seed", "2", "--reach", "0.2"),
                 {"redo": 9, "seed": 2, "reach": 0.2}),
                (("--redo", f"{x},{y},{z},0.1", "--reach", "0.2"),
                 {"redo": (x, y, z, 0.1), "reach": 0.2}),
                (("--constraints", asked), {"constraints": asked}),
                (("--constraints", asked), {"constraints": [self.COMB]}),
                (("--constraints", both), {"constraints": (
                    {**self.COMB, "edit": 1},
                    {"face": 9, "redo": 2, "edit": 2, "reach": 0.2})})):
            with self.subTest(words):
                self.assertEqual(
                    self.program_edit(source, path, *words),
                    self.module_edit(source, path, **options))
        # One after the other, in memory; and map() with all of it at once.
        edited = mapping.edit([self.COMB]).edit(redo=9, seed=2, reach=0.2)
        self.assertTrue(
            (edited.uvs == self.context.read_mapping(path).uvs).all())
        self.assertFalse((edited.uvs == mapping.uvs).all())
        at_once = self.context.map(*self.read(TORUS), **self.HOW, constraints=[
            {**self.COMB, "edit": 1},
            {"face": 9, "redo": 2, "edit": 2, "reach": 0.2}])
        self.assertTrue((edited.uvs == at_once.uvs).all())

    def test_many_edits_hold_no_more_than_one(self):
        """What lies between two edits goes."""
        cage, exemplar = self.read(TORUS)

        def held(count):
            before = self.context.held_bytes
            mapping = self.context.map(
                cage, exemplar, **self.HOW, constraints=[
                    {"face": k, "redo": 1, "reach": 0.2, "edit": k + 1}
                    for k in range(count)])
            self.assertGreater(mapping.patch_count, 10)
            return self.context.held_bytes - before

        self.assertLess(held(6), 1.3 * held(1))

    def test_what_is_wrong(self):
        mapping = self.context.map(*self.read(), **QUICK)
        for options, error, words in (
                ({}, osdtex.ArgumentError, "changes nothing"),
                ({"redo": -1}, ValueError, "a face of the cage"),
                ({"redo": 1, "seed": 0}, ValueError, "from 1"),
                ({"redo": [1, 2]}, ValueError, "4 numbers"),
                ({"redo": "1"}, ValueError, "4 numbers"),
                ({"redo": 99999}, osdtex.ArgumentError, "cage lacks"),
                ({"reach": "far"}, TypeError, ""),
                ({"constraints": [7]}, TypeError, "list of dictionaries"),
                ({"constraints": {"face": 1}}, TypeError, ""),
                ({"constraints": [{"fase": 1}]}, TypeError, "face, point"),
                ({"constraints": [{"face": 1, "material": "x"}]}, TypeError,
                 ""),
                ({"constraints": self.folder / "no.json"}, osdtex.FileError,
                 "no.json")):
            with self.subTest(options):
                with self.assertRaisesRegex(error, words):
                    mapping.edit(**options)
        for options in ({"keep": 7}, {"place": 7}):
            with self.assertRaises(TypeError):
                self.context.map(*self.read(), **QUICK, **options)

    def test_keep(self):
        cage, exemplar = self.read()
        mapping = self.context.map(cage, exemplar, **QUICK)
        kept = self.context.map(cage, exemplar, keep=mapping)
        self.assertTrue((kept.uvs == mapping.uvs).all())


class Seams(ModuleTest):
    def test_they_lie_between_patches(self):
        mapping = self.context.map(*self.read(), level=2)
        seams = mapping.seams(places=4)
        patch = mapping.face_patch
        face = numpy.searchsorted(
            mapping.face_first, seams.corners, side="right") - 1
        edges = {}
        for f in range(mapping.face_count):
            verts = mapping.face_verts[
                mapping.face_first[f]:mapping.face_first[f + 1]].tolist()
            for a, b in zip(verts, verts[1:] + verts[:1]):
                edges[a, b] = f
        for corner, f in zip(seams.corners, face):
            first, end = mapping.face_first[f], mapping.face_first[f + 1]
            a = mapping.face_verts[corner]
            b = mapping.face_verts[corner + 1 if corner + 1 < end else first]
            self.assertNotEqual(patch[edges[b, a]], patch[f])
        meet = {frozenset(e) for e, f in edges.items()
                if patch[edges.get(e[::-1], f)] != patch[f]}
        self.assertEqual(len(seams.corners), len(meet))
        self.assertTrue((seams.differences >= 0).all())
        self.assertTrue((seams.differences <= 1).all())
        self.assertEqual(len(seams.places), 4)
        worst = seams.places[0]
        self.assertEqual(
            set(worst), {"point", "normal", "length", "difference"})
        self.assertAlmostEqual(
            numpy.linalg.norm(worst["normal"]), 1, places=6)
        corners = seams.corners
        del mapping, seams
        gc.collect()
        self.assertGreater(len(corners), 10)  # it keeps what it lies on
        with self.assertRaises(osdtex.ArgumentError):
            self.context.map(*self.read(), **QUICK).seams(places=100)


class Arrays(ModuleTest):
    def test_arrays_are_the_librarys_memory(self):
        mapping = self.context.map(*self.read(), **QUICK)
        uvs = mapping.uvs
        self.assertEqual(uvs.shape, (mapping.corner_count, 2))
        self.assertEqual(uvs.dtype, numpy.float32)
        self.assertFalse(uvs.flags.writeable)
        self.assertTrue(numpy.shares_memory(uvs, mapping.uvs))
        self.assertEqual(mapping.face_first[-1], mapping.corner_count)
        self.assertEqual(len(mapping.face_patch), mapping.face_count)
        self.assertLess(mapping.face_verts.max(), len(mapping.points))
        before = uvs.copy()
        del mapping
        self.context.close()
        gc.collect()
        self.assertTrue((uvs == before).all())  # it keeps what it lies on

    def test_bake_without_files(self):
        mapping = self.context.map(*self.read(), **QUICK)
        textures = mapping.textures(
            resolution=64, uvs="own", extras=["patch"])
        self.assertEqual(textures.names, ("color", "patch"))
        self.assertEqual(textures.tiles, (1001,))
        color = textures.read()
        self.assertEqual(color.shape, (64, 64, 3))
        self.assertEqual(textures.read("patch", level=1).shape[:2], (32, 32))
        # A fourth of it is the mean of what lies below.
        small = textures.read("color", level=textures.level_count - 1)
        self.assertLess(abs(small - color.mean((0, 1))).max(), 0.02)
        self.assertEqual(len(textures.face_uvs), 4 * 16)
        with self.assertRaises(KeyError):
            textures.read("colour")
        with self.assertRaises(KeyError):
            textures.read(tile=1002)
        with self.assertRaises(ValueError):
            textures.read(level=99)

    def test_cage_and_exemplar_of_arrays(self):
        points = [[x, 0, z] for z in range(3) for x in range(3)]
        faces = [[0, 3, 4, 1], [1, 4, 5, 2], [3, 6, 7, 4], [4, 7, 8, 5]]
        cage = self.context.cage(points, faces, corners={0: 10.0},
                                 creases={(1, 4): 2.0})
        self.assertEqual((cage.face_count, cage.crease_count), (4, 1))
        pixels = numpy.random.default_rng(1).random((32, 48, 3), "f4")
        exemplar = self.context.exemplar(pixels, wrap="yes")
        self.assertEqual((exemplar.width, exemplar.height), (48, 32))
        self.assertTrue(numpy.allclose(exemplar.pixels, pixels))
        mapping = self.context.map(cage, exemplar, level=2)
        array = self.context.map(
            self.context.cage(
                numpy.array(points, "f8"), numpy.array(faces, "i8"),
                corners={0: 10.0}, creases={(1, 4): 2.0}),
            exemplar, level=2)
        self.assertTrue((mapping.uvs == array.uvs).all())
        for bad in ([[0, 3, 4, 9]], [[0, 3]], [[0, 3, 4, 0]]):
            with self.assertRaises(osdtex.Error):
                self.context.cage(points, bad)
        with self.assertRaises(ValueError):
            self.context.cage(points, faces, face_uvs=faces[:1])
        for wrong in ({"faces": numpy.array(faces, "i8") + (1 << 32)},
                      {"faces": numpy.array(faces) + 0.5},
                      {"faces": [[0, 3, 4, 1 << 32]]},
                      {"holes": [1 << 32]}, {"corners": {1 << 32: 1.0}}):
            with self.assertRaisesRegex(ValueError, "whole numbers"):
                self.context.cage(**{"points": points, "faces": faces, **wrong})
        with self.assertRaises(ValueError):
            self.context.exemplar([1.0, 2.0])

    def test_picture(self):
        picture = self.context.map(*self.read(), **QUICK).render(
            width=48, height=27, samples=1, show="patches")
        self.assertEqual(picture.shape, (27, 48, 4))
        self.assertGreater(picture.std(), 0.01)


class Callbacks(ModuleTest):
    def test_progress_cancels(self):
        seen = []

        def progress(stage, fraction):
            seen.append((stage, fraction))
            return not (stage == "fit" and fraction > 0.2)

        context = osdtex.Context(progress=progress)
        cage, exemplar = context.read_cage(PLANE), context.read_exemplar(PEBBLES)
        held = context.held_bytes
        with self.assertRaises(osdtex.Cancelled) as raised:
            context.map(cage, exemplar, level=2)
        self.assertEqual(raised.exception.status, "CANCELLED")
        self.assertTrue(any(stage == "fit" for stage, _ in seen))
        self.assertTrue(all(0 <= share <= 1 for _, share in seen))
        gc.collect()
        self.assertLess(context.held_bytes - held, 10000)  # findings

    def test_what_progress_raises(self):
        def progress(stage, fraction):
            raise ZeroDivisionError("mine")

        context = osdtex.Context(progress=progress)
        with self.assertRaisesRegex(ZeroDivisionError, "mine"):
            context.map(context.read_cage(PLANE),
                        context.read_exemplar(PEBBLES), level=2)

    def test_a_callback_may_not_use_its_context(self):
        def progress(stage, fraction):
            context.read_cage(PLANE)

        context = osdtex.Context(progress=progress)
        with self.assertRaisesRegex(RuntimeError, "at work"):
            context.map(context.read_cage(PLANE),
                        context.read_exemplar(PEBBLES), level=2)

    def test_log(self):
        told = []
        context = osdtex.Context(log=told.append)
        context.read_exemplar(PEBBLES)
        self.assertEqual(told, context.findings)
        self.assertTrue(any(f.stage == "colour" for f in told))
        context.clear()
        self.assertEqual(context.findings, [])

    def test_cancel_from_another_thread(self):
        """It also says that the GIL is released: the other thread runs."""
        cage, exemplar = self.read()
        turns, stop = [0], threading.Event()

        def other():
            while not stop.is_set():
                turns[0] += 1
                if turns[0] == 5:
                    self.context.cancel()
                time.sleep(0.01)

        thread = threading.Thread(target=other)
        thread.start()
        try:
            with self.assertRaises(osdtex.Cancelled):
                self.context.map(cage, exemplar, level=6)
        finally:
            stop.set()
            thread.join()
        self.assertGreaterEqual(turns[0], 5)

    def test_two_contexts_at_once(self):
        results = [None, None]

        def work(k):
            context = osdtex.Context(threads=1)
            results[k] = context.map(
                context.read_cage(PLANE), context.read_exemplar(PEBBLES),
                level=3).uvs

        threads = [threading.Thread(target=work, args=(k,)) for k in (0, 1)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertTrue((results[0] == results[1]).all())


class Errors(ModuleTest):
    def test_file_that_is_not_there(self):
        with self.assertRaises(OSError) as raised:
            self.context.read_cage("none.obj")
        error = raised.exception
        self.assertIsInstance(error, osdtex.FileError)
        self.assertEqual((error.status, error.finding.file),
                         ("IO", "none.obj"))
        self.assertIn("none.obj", str(error))

    def test_findings_say_where(self):
        bad = self.folder / "bad.obj"
        bad.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n")
        for _ in range(2):  # folded the second time, and told still
            with self.assertRaises(osdtex.Error) as raised:
                self.context.read_cage(bad)
            self.assertEqual(raised.exception.finding.line, 4)
            self.assertEqual(raised.exception.finding.severity, "error")
        self.assertIn("bad.obj:4", str(raised.exception))

    def test_words(self):
        cage, exemplar = self.read()
        with self.assertRaisesRegex(TypeError, "levle.*level, scale"):
            self.context.map(cage, exemplar, levle=3)
        with self.assertRaisesRegex(ValueError, "catmark, loop, bilinear"):
            self.context.read_cage(PLANE, scheme="lop")
        with self.assertRaisesRegex(TypeError, "an Exemplar is needed"):
            self.context.map(cage, cage)
        with self.assertRaisesRegex(TypeError, "keywords only"):
            osdtex.Context(4)
        with self.assertRaisesRegex(ValueError, "256"):
            osdtex.Context(threads=1000)
        with self.assertRaisesRegex(TypeError, "callable"):
            osdtex.Context(progress=4)
        with self.assertRaises(osdtex.ArgumentError) as raised:
            self.context.map(cage, exemplar, method="hierarchicl")
        self.assertIn("hierarchical", str(raised.exception))
        for bad in ({"level": "low"}, {"level": 2 ** 40}, {"scale": "big"},
                    {"settings": [1]}, {"generators": [1, 2]},
                    {"also": [cage]}, {"seed": -1}):
            with self.assertRaises((TypeError, ValueError, OverflowError)):
                self.context.map(cage, exemplar, **bad)

    def test_closed(self):
        mapping = self.context.map(*self.read(), **QUICK)
        self.context.close()
        with self.assertRaisesRegex(ValueError, "closed"):
            mapping.write(self.folder / "out.obj")
        with self.assertRaisesRegex(ValueError, "closed"):
            self.context.read_cage(PLANE)

    def test_a_set_of_files_is_whole_or_not_there(self):
        mapping = self.context.map(*self.read(), **QUICK)
        with self.assertRaises(osdtex.FileError):
            with self.context.outputs():
                mapping.write(self.folder / "one.obj")
                mapping.write(self.folder / "none" / "two.obj")
        self.assert_nothing_written()
        with self.context.outputs():
            mapping.write(self.folder / "one.obj")
        self.assertTrue((self.folder / "one.exr").exists())


def resident():
    """Bytes of this process in memory."""
    pages = Path("/proc/self/statm").read_text().split()[1]
    return int(pages) * os.sysconf("SC_PAGE_SIZE")


class Memory(ModuleTest):
    def test_a_hundred_maps(self):
        """After them no more is held than after the first ones; neither by
        handles nor by the process."""
        cage = self.context.cage(
            [[x, y, 0] for y in range(3) for x in range(3)],
            [[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 8, 7]])
        exemplar = self.context.exemplar(
            numpy.random.default_rng(1).random((48, 48, 3), "f4"))

        def work():
            mapping = self.context.map(cage, exemplar, level=0)
            return mapping.uvs.sum() + mapping.textures(
                resolution=64, uvs="atlas").read(tile=1001).sum()

        for _ in range(10):
            work()
        self.context.clear()
        gc.collect()
        held, pages = self.context.held_bytes, resident()
        for _ in range(100):
            work()
        self.context.clear()
        gc.collect()
        # Times of calls are kept, some bytes each.
        self.assertLess(abs(self.context.held_bytes - held), 20000)
        self.assertLess(resident() - pages, 32 << 20)

    def test_failing_maps_leave_no_handle(self):
        self.context = osdtex.Context(threads=2, memory_limit=64 << 20)
        self.addCleanup(self.context.close)
        cage, exemplar = self.read()
        for _ in range(3):
            with self.assertRaises(osdtex.Error):
                self.context.map(cage, exemplar, method="none")
        self.context.clear()
        held = self.context.held_bytes
        count = len(gc.get_objects())
        for _ in range(50):
            with self.assertRaises(osdtex.Error):
                self.context.map(cage, exemplar, method="none")
            with self.assertRaises(osdtex.LimitError):
                self.context.map(cage, exemplar, level=8)
        self.context.clear()
        gc.collect()
        self.assertLess(abs(self.context.held_bytes - held), 2000)
        self.assertLess(abs(len(gc.get_objects()) - count), 200)

    def test_all_goes_with_the_last_object(self):
        mapping = self.context.map(*self.read(), **QUICK)
        uvs = mapping.uvs
        del mapping
        self.context.close()
        gc.collect()
        self.assertGreater(self.context.held_bytes, uvs.nbytes)
        del uvs
        gc.collect()
        self.assertEqual(self.context.held_bytes, 0)


class Guide(unittest.TestCase):
    def test_examples(self):
        """docs/python.md does what it says."""
        os.environ["OSDTEX_THREADS"] = "2"
        shutil.rmtree(ROOT / "out" / "guide", ignore_errors=True)
        result = doctest.testfile(
            str(ROOT / "docs" / "python.md"), module_relative=False,
            optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
        self.assertEqual(result.failed, 0)
        self.assertGreater(result.attempted, 20)

    def test_types_name_what_there_is(self):
        """Each public name and option of the stubs is there."""
        stub = (Path(osdtex.__file__).parent / "_osdtex.pyi").read_text()
        for kind in (osdtex.Cage, osdtex.Exemplar, osdtex.Mapping,
                     osdtex.Textures, osdtex.Context):
            body = re.search(
                rf"^class {kind.__name__}:\n((?:    .*\n|\n)+)", stub, re.M)[1]
            named = set(re.findall(r"^    (?:def )?(\w+)[:(]", body, re.M))
            there = {n for n in vars(
                kind if kind is not osdtex.Context else kind.__base__)
                if not n.startswith("_")}
            self.assertEqual({n for n in named if n[0] != "_"}, there,
                             kind.__name__)


if __name__ == "__main__":
    main()
