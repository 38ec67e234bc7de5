#!/usr/bin/env python3
"""The page of osdtex regress as a browser shows it: passing, failing, missing
and crashed cases; on a laptop and on a phone; without a network."""

import re
import shutil
import subprocess
import unittest

from suites import TILE, TILE_CASE, SuiteTest, main

BROWSER = shutil.which("chromium") or shutil.which("google-chrome")

# Into the page's own DOM: what only a browser can know. The widths tell
# whether anything sticks out.
PROBE = """
<script>
addEventListener('load', () => {
  const out = [];
  for (const shot of document.querySelectorAll('.shot')) {
    const style = getComputedStyle(shot);
    for (const url of style.backgroundImage.split(', '))
      out.push(url.slice(0, 26));
    if (shot.classList.contains('difference'))
      out.push(style.filter + ' ' + style.backgroundBlendMode);
  }
  const probe = document.createElement('pre');
  probe.id = 'probe';
  probe.textContent = out.join('; ') + ' wide ' +
      document.documentElement.scrollWidth + ' of ' + innerWidth;
  document.body.append(probe);
});
</script>
"""


@unittest.skipUnless(BROWSER, "there is no Chromium")
class Page(SuiteTest):
    def setUp(self):
        super().setUp()
        options = {"": "", "b": "--seed 2", "c": "--seed 3", "d": "--seed 4"}
        row = dict(TILE, options={
            name: f"--tile-level 1 {text}" for name, text in options.items()})
        self.write_table(row, tolerances={"time.*": 100})
        self.assert_exit(self.regress("--update", "all"), 0)
        reference = self.folder / "suite" / "reference"
        picture = reference / f"{TILE_CASE}.b.png"
        shutil.copy(reference / f"{TILE_CASE}.c.png", picture)
        (reference / f"{TILE_CASE}.c.png").unlink()
        self.assert_exit(
            self.regress(damage="crash", victim=f"{TILE_CASE}.d"), 6)

    def browse(self, *arguments, page=None):
        page = page or self.folder / "out" / "report.html"
        return subprocess.run(
            [BROWSER, "--headless", "--no-sandbox", "--disable-gpu",
             "--no-first-run", "--disable-background-networking",
             "--hide-scrollbars", "--virtual-time-budget=10000",
             f"--user-data-dir={self.folder / 'browser'}",
             *arguments, page.as_uri()],
            capture_output=True, text=True, timeout=120).stdout

    def test_what_it_shows(self):
        dom = self.browse("--dump-dom")
        shown = re.findall(r'<article class="(\w+)" id="([^"]+)"', dom)
        self.assertEqual(
            shown, [("crashed", f"{TILE_CASE}.d"), ("fail", f"{TILE_CASE}.b"),
                    ("missing", f"{TILE_CASE}.c"), ("pass", TILE_CASE)])
        self.assertIn("<title>osdtex: 1 crashed, 1 fail, 1 missing, 1 pass", dom)
        articles = dom.split("<article")[1:]
        for (_, name), article in zip(shown, articles):
            self.assertIn(f"--update {name}</pre>", article)
        self.assertIn("killed by signal 11", articles[0])
        self.assertIn("worst difference", articles[1])
        self.assertIn("there is no reference", articles[2])
        self.assertEqual(
            [a.count('class="shot') for a in articles], [0, 3, 1, 3])
        self.assertIn('<svg class="trend"', articles[3])
        # Nothing is asked of a network, and nothing runs.
        self.assertNotRegex(dom, r"<script|<link|https?:|src=")

    def test_it_fits_laptop_and_phone(self):
        page = self.folder / "out" / "probe.html"
        page.write_text(self.page().replace("</body>", PROBE + "</body>"))
        for width in (1366, 500, 390):
            dom = self.browse(
                "--dump-dom", f"--window-size={width},800", page=page)
            probe = re.search(r'<pre id="probe">(.*?)</pre>', dom, re.S)
            self.assertTrue(probe, dom[-500:])
            text = probe.group(1)
            self.assertEqual(text.count('url("data:image/png;base64'), 9, text)
            self.assertEqual(
                text.count("brightness(16) difference, normal"), 2)
            wide, of = map(int, re.search(r"wide (\d+) of (\d+)", text).groups())
            self.assertLessEqual(wide, of)
            self.assertLessEqual(of, max(width, 500))

    def test_the_difference_is_sixteenfold(self):
        """A difference of 16 of 255 is as good as white in its channel."""
        self.assert_exit(self.regress(TILE_CASE, damage="pixel"), 6)
        picture = self.folder / "page.png"
        self.browse(
            f"--screenshot={picture}", "--window-size=1366,1200")
        from PIL import Image
        image = Image.open(picture).convert("RGB")
        greens = sum(
            1 for p in image.getdata() if p[1] > 240 and p[0] + p[2] < 20)
        # A pixel of 64 over a third of the page is some 5 x 5 here.
        self.assertGreater(greens, 12)
        self.assertLess(greens, 100)


if __name__ == "__main__":
    main()
