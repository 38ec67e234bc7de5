#!/usr/bin/env python3
"""The examples at the head of the public headers compile as they stand."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

INCLUDE = pathlib.Path(__file__).resolve().parents[2] / "include"

# What an example takes as given, and what it does with what it gets.
PRELUDE = """
#include <osdtex/osdtex.h>
#include <stdio.h>
extern osdtex_context *context;
extern osdtex_cage *cage;
extern osdtex_surface *surface;
extern osdtex_exemplar *exemplar, *tiles, *spots, *stripes;
extern osdtex_image *image, *heights;
extern osdtex_mapping *mapping;
extern osdtex_map_options map_options;
extern osdtex_bake_options bake_options;
extern osdtex_status status;
extern const char *path;
extern const float *points, *pixels, *directions;
extern const osdtex_index *sizes, *verts;
extern double free_bytes;
extern void *menu;
bool show_progress(void *user, const char *stage, double fraction);
int out_of_memory(void);
int menu_add(void *menu, ...);
int use(const void *what, ...);
int use_uv(osdtex_index corner, float u, float v);
int submit(const void *what, ...);
"""


def example_of(header):
    """The indented lines of the comment that opens a header."""
    head = header.read_text().split("*/")[0].splitlines()
    lines = [l[7:] for l in head if l.startswith(" *     ") or l == " *"]
    return "\n".join(l for l in lines if l.strip() != "...")


def program_of(example):
    """Functions stand by themselves, statements in one."""
    functions = "\n".join(re.findall(r"^static \w+\n.*?^}$", example,
                                     re.S | re.M))
    rest = re.sub(r"^static \w+\n.*?^}$", "", example, flags=re.S | re.M)
    return f"{PRELUDE}{functions}\nint example(void)\n{{\n{rest}\nreturn 0;\n}}"


class Examples(unittest.TestCase):
    def check(self, header):
        example = example_of(header)
        # The one that lists the others has a table in that place.
        if header.name == "osdtex.h":
            return
        self.assertTrue(example.strip(), f"{header.name} has no example")
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder, "example.c")
            source.write_text(program_of(example))
            done = subprocess.run(
                [shutil.which("cc") or "gcc", "-std=c17", "-fsyntax-only",
                 "-Wall", "-Werror", "-Wno-unused-variable",
                 "-Wno-unused-but-set-variable", "-I", INCLUDE, source],
                capture_output=True, text=True)
            self.assertEqual(done.returncode, 0,
                             f"{header.name}:\n{done.stderr}")

    def test_headers(self):
        for header in sorted(INCLUDE.glob("osdtex/*.h")):
            with self.subTest(header.name):
                self.check(header)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
