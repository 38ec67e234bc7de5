#!/usr/bin/env python3
"""ICC profiles, gamma and primaries of pictures are applied; those that cannot
be are one warning that says --from."""

import json
import struct
import zlib

from program import CAGES, SHARED, ProgramTest, main

PLANE = CAGES / "plane.obj"
QUICK = ("--level", "1", "--scale", "2", "--set", "angles=4", "--wrap", "yes")
REPORTS = SHARED / "reports"

# Primaries and white, xy.
SRGB = ((0.64, 0.33), (0.30, 0.60), (0.15, 0.06), (0.3127, 0.3290))
P3 = ((0.680, 0.320), (0.265, 0.690), (0.150, 0.060), (0.3127, 0.3290))
ADOBE = ((0.64, 0.33), (0.21, 0.71), (0.15, 0.06), (0.3127, 0.3290))
D50 = (0.9642, 1.0, 0.8249)
BRADFORD = ((0.8951, 0.2664, -0.1614), (-0.7502, 1.7135, 0.0367),
            (0.0389, -0.0685, 1.0296))
COLOUR = (200, 90, 40)


# -- small matrices -----------------------------------------------------------

def times(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)]
            for i in range(3)]


def apply(a, v):
    return [sum(a[i][k] * v[k] for k in range(3)) for i in range(3)]


def inverse(a):
    cofactor = lambda i, j: (
        a[(i + 1) % 3][(j + 1) % 3] * a[(i + 2) % 3][(j + 2) % 3]
        - a[(i + 1) % 3][(j + 2) % 3] * a[(i + 2) % 3][(j + 1) % 3])
    det = sum(a[0][j] * cofactor(0, j) for j in range(3))
    return [[cofactor(j, i) / det for j in range(3)] for i in range(3)]


def to_d50(primaries):
    """Linear RGB to XYZ under D50, adapted by Bradford."""
    xyz = lambda xy: (xy[0] / xy[1], 1.0, (1 - xy[0] - xy[1]) / xy[1])
    p = [list(row) for row in zip(*map(xyz, primaries[:3]))]
    white = xyz(primaries[3])
    scale = apply(inverse(p), white)
    rgb = [[p[i][j] * scale[j] for j in range(3)] for i in range(3)]
    ratio = [b / a for a, b in zip(apply(BRADFORD, white), apply(BRADFORD, D50))]
    cone = [[BRADFORD[i][j] * ratio[i] for j in range(3)] for i in range(3)]
    return times(times(inverse(BRADFORD), cone), rgb)


def expected(primaries, exponent, colour=COLOUR):
    """What an encoded colour is in 8-bit sRGB."""
    light = [(c / 255) ** exponent for c in colour]
    rgb = apply(times(inverse(to_d50(SRGB)), to_d50(primaries)), light)
    encode = lambda v: (12.92 * v if v <= 0.0031308
                        else 1.055 * v ** (1 / 2.4) - 0.055)
    return [round(255 * encode(min(max(v, 0), 1))) for v in rgb]


# -- files --------------------------------------------------------------------

def tag_text(text):
    return (b"desc\0\0\0\0" + struct.pack(">I", len(text) + 1) + text.encode()
            + b"\0" * (1 + 4 + 4 + 2 + 1 + 67))


def fixed(v):
    return struct.pack(">i", round(v * 65536))


def profile(primaries, exponent, name, space=b"RGB ", kind=b"mntr"):
    """A matrix profile, or a curve of grey."""
    curve = b"curv\0\0\0\0" + struct.pack(">IH", 1, round(exponent * 256)) + b"\0\0"
    xyz = lambda v: b"XYZ \0\0\0\0" + b"".join(map(fixed, v))
    m = to_d50(primaries)
    tags = [(b"desc", tag_text(name)), (b"wtpt", xyz(D50)),
            (b"cprt", b"text\0\0\0\0none\0\0\0\0")]
    if space == b"GRAY":
        tags.append((b"kTRC", curve))
    else:
        for j, letter in enumerate("rgb"):
            tags.append((letter.encode() + b"XYZ", xyz([m[i][j] for i in range(3)])))
            tags.append((letter.encode() + b"TRC", curve))
    at = 132 + 12 * len(tags)
    table, data = struct.pack(">I", len(tags)), b""
    for key, body in tags:
        body += b"\0" * (-len(body) % 4)
        table += key + struct.pack(">II", at + len(data), len(body))
        data += body
    size = at + len(data)
    header = (struct.pack(">I", size) + b"lcms" + b"\x02\x40\0\0" + kind + space
              + b"XYZ " + b"\0" * 12 + b"acsp" + b"\0" * 28
              + b"".join(map(fixed, D50)))
    return header.ljust(128, b"\0") + table + data


def chunk(kind, data):
    return (struct.pack(">I", len(data)) + kind + data
            + struct.pack(">I", zlib.crc32(kind + data)))


def icc_chunk(data):
    return chunk(b"iCCP", b"a\0\0" + zlib.compress(data))


def png(*chunks, colour=COLOUR, side=16):
    grey = len(colour) == 1
    row = b"\0" + bytes(colour) * side
    return (b"\x89PNG\r\n\x1a\n"
            + chunk(b"IHDR", struct.pack(
                ">IIBBBBB", side, side, 8, 0 if grey else 2, 0, 0, 0))
            + b"".join(chunks) + chunk(b"IDAT", zlib.compress(row * side))
            + chunk(b"IEND", b""))


def tiff(icc, claims=None, side=16):
    pixels = bytes(COLOUR) * side * side
    entries = [(256, 3, 1, side), (257, 3, 1, side), (258, 3, 3, 8 + len(pixels)),
               (259, 3, 1, 1), (262, 3, 1, 2), (273, 4, 1, 8), (277, 3, 1, 3),
               (278, 3, 1, side), (279, 4, 1, len(pixels)),
               (34675, 7, claims or len(icc), 8 + len(pixels) + 6)]
    at = 8 + len(pixels) + 6 + len(icc)
    directory = struct.pack("<H", len(entries)) + b"".join(
        struct.pack("<HHII", *e) for e in entries) + b"\0\0\0\0"
    return (b"II*\0" + struct.pack("<I", at) + pixels
            + struct.pack("<3H", 8, 8, 8) + icc + directory)


def first_pixel(data):
    """Of an 8-bit RGB PNG whose first row has no filter but 'none' or 'sub',
    which leave its first pixel as it is; so does every other."""
    idat, at = b"", 8
    while at < len(data):
        length, = struct.unpack(">I", data[at:at + 4])
        if data[at + 4:at + 8] == b"IDAT":
            idat += data[at + 8:at + 8 + length]
        at += 12 + length
    return list(zlib.decompress(idat)[1:4])


class Profiles(ProgramTest):
    def shown(self, name, data, *more):
        """The 8-bit sRGB of the texture that is written, and what was said."""
        path = self.folder / name
        path.write_bytes(data)
        report = self.folder / "report.json"
        done = self.run_map(PLANE, path, *QUICK, "--for", "web",
                            "--json-report", report, *more)
        self.assert_exit(done, 0)
        self.report = json.loads(report.read_text())
        return first_pixel((self.folder / "out.png").read_bytes()), done.stderr

    def assert_near(self, got, want):
        self.assertTrue(all(abs(a - b) <= 1 for a, b in zip(got, want)),
                        f"{got} is not {want}")

    def warnings(self, text):
        return [l for l in text.splitlines() if l.startswith("osdtex: warning")]

    def test_profiles_are_applied(self):
        for primaries, exponent, name in (
                (P3, 2.2, "Some P3"), (ADOBE, 2.19921875, "Adobe RGB (1998)"),
                (SRGB, 1.0, "linear"), (SRGB, 1.8, "old Mac")):
            icc = profile(primaries, exponent, name)
            want = expected(primaries, exponent)
            for file, data in (("a.png", png(icc_chunk(icc))),
                               ("a.tif", tiff(icc))):
                got, text = self.shown(file, data)
                self.assert_near(got, want)
                self.assertIn(f"ICC profile '{name}'", text)
                self.assertIn(name, self.report["colour"]["from"])
                self.assertFalse(self.warnings(text), text)

    def test_srgb_stays_as_it_was(self):
        # The table of a profile of sRGB: a curve of many points.
        plain, _ = self.shown("a.png", png())
        tagged, text = self.shown("b.png", png(chunk(b"sRGB", b"\0")))
        self.assertEqual(plain, list(COLOUR))
        self.assertEqual(tagged, plain)
        gamma = chunk(b"gAMA", struct.pack(">I", 45455))
        self.assertEqual(self.shown("c.png", png(gamma))[0], plain)
        self.assertEqual(self.report["colour"]["from"], "sRGB - Texture")

    def test_grey_profiles(self):
        icc = profile(SRGB, 1.0, "grey light", b"GRAY")
        got, text = self.shown("a.png", png(icc_chunk(icc), colour=(100,)))
        self.assert_near(got, expected(SRGB, 1.0, (100,) * 3))
        self.assertIn("grey light", text)

    def test_gamma_and_primaries(self):
        gamma = chunk(b"gAMA", struct.pack(">I", 100000))
        numbers = [round(v * 100000) for v in (*ADOBE[3], *ADOBE[0], *ADOBE[1],
                                               *ADOBE[2])]
        primaries = chunk(b"cHRM", struct.pack(">8I", *numbers))
        got, text = self.shown("a.png", png(gamma))
        self.assert_near(got, expected(SRGB, 1.0))
        self.assertIn("gAMA", text)
        got, text = self.shown("b.png", png(gamma, primaries))
        self.assert_near(got, expected(ADOBE, 1.0))
        # PNG's own order of precedence: a profile, sRGB, then these.
        icc = icc_chunk(profile(P3, 2.2, "Some P3"))
        got, text = self.shown("c.png", png(gamma, primaries, icc))
        self.assert_near(got, expected(P3, 2.2))
        got, text = self.shown(
            "d.png", png(gamma, primaries, chunk(b"sRGB", b"\0")))
        self.assertEqual(got, list(COLOUR))

    def test_words_beat_profiles(self):
        icc = icc_chunk(profile(P3, 2.2, "Some P3"))
        got, text = self.shown("a.png", png(icc), "--from", "sRGB - Texture")
        self.assertEqual(got, list(COLOUR))
        # A map of normals is data, whatever the painter's screen was.
        path = self.folder / "a_nrm_.png"
        path.write_bytes(png(icc))
        done = self.run_program("info", path)
        self.assertIn("'Raw' (the configuration's file rule", done.stderr)

    def test_what_cannot_be_applied_is_one_warning(self):
        good = profile(P3, 2.2, "Some P3")
        lying = struct.pack(">I", 1 << 31) + good[4:]
        far = good[:136] + struct.pack(">II", 0xFFFFFF00, 64) + good[144:]
        many = good[:128] + struct.pack(">I", 0x10000000) + good[132:]
        cmyk = profile(P3, 2.2, "Press", b"CMYK", b"prtr")
        link = profile(P3, 2.2, "Link", kind=b"link")
        broken = {"short": good[:100], "empty": good[:4], "lying": lying,
                  "far": far, "many": many, "cmyk": cmyk, "link": link,
                  "text": b"this is no profile at all" * 20,
                  "half": good[:len(good) // 2]}
        for name, icc in broken.items():
            for file, data in (("a.png", png(icc_chunk(icc))),
                               ("a.tif", tiff(icc))):
                got, text = self.shown(file, data)
                self.assertEqual(got, list(COLOUR), name)
                said = self.warnings(text)
                self.assertEqual(len(said), 1, (name, file, text))
                self.assertIn("ICC profile", said[0])
                self.assertIn("--from", said[0])
        # The file is shorter than the profile it claims.
        path = self.folder / "b.tif"
        path.write_bytes(tiff(good, claims=1 << 30))
        self.assertIn(self.run_program("info", path).returncode, (0, 2))

    def test_reports_of_others(self):
        if not REPORTS.exists():
            self.skipTest("../shared is not here")
        for name, words in (("adobe.jpg", "ICC profile"), ("gama1.png", "gAMA")):
            done = self.run_program("info", REPORTS / name)
            self.assert_exit(done, 0)
            self.assertIn(words, done.stderr)


main()
