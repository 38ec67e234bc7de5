#!/usr/bin/env python3
"""What shells complete, and the pages of the manual.

    test_completion.py OSDTEX
"""

import re
import shutil
import subprocess

from program import ROOT, ProgramTest, main


class Completion(ProgramTest):
    def script(self, shell):
        result = self.run_program("help", "--completion", shell)
        self.assert_exit(result, 0)
        path = self.folder / f"completion.{shell}"
        path.write_text(result.stdout)
        return path, result.stdout

    def commands(self):
        text = self.run_program("help", "--man").stdout
        return re.findall(r"^\.B osdtex (\w+)$", text, re.M)

    def test_bash(self):
        path, _ = self.script("bash")

        def complete(*words):
            line = " ".join(f"'{w}'" for w in words)
            return subprocess.run(
                ["bash", "-c", f". {path}; COMP_WORDS=({line}); "
                 f"COMP_CWORD={len(words) - 1}; _osdtex; "
                 "printf '%s\\n' \"${COMPREPLY[@]}\""],
                capture_output=True, text=True, check=True).stdout.split()

        self.assertEqual(complete("osdtex", "ba"), ["bake"])
        self.assertIn("--resolution", complete("osdtex", "bake", "--res"))
        self.assertEqual(complete("osdtex", "render", "--resol"), [])
        self.assertEqual(self.run_program("help", "--completion").stdout,
                         path.read_text())

    def test_every_shell_knows_every_flag(self):
        for shell, form in (("bash", "--{}"), ("zsh", "--{}"),
                            ("fish", "-l {}")):
            _, text = self.script(shell)
            for command in self.commands():
                help_text = self.run_program(command, "--help").stdout
                for flag in set(re.findall(r"^ +(?:-\w, )?--([\w-]+)",
                                           help_text, re.M)):
                    self.assertIn(form.format(flag), text, (shell, command))

    def test_zsh_and_fish_can_read_it(self):
        """Where those shells are; quotes are balanced everywhere."""
        for shell, words in (("zsh", ["-n"]), ("fish", ["--no-execute"])):
            path, text = self.script(shell)
            self.assertNotIn("\x1f", text)
            bare = re.sub(r"'\\''", "", text)
            self.assertEqual(bare.count("'") % 2, 0, shell)
            found = shutil.which(shell)
            if found:
                subprocess.run([found, *words, path], check=True)

    def test_others(self):
        self.assert_error(
            self.run_program("help", "--completion", "tcsh"), 1,
            "knows bash, zsh and fish, not 'tcsh'")


class Manual(ProgramTest):
    def test_a_page_for_each_command(self):
        for path in sorted((ROOT / "docs" / "man").glob("osdtex-*.1")):
            text = path.read_text()
            name = path.stem.split("-", 1)[1]
            with self.subTest(name):
                for title in ("NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS",
                              "EXAMPLES", "EXIT STATUS", "SEE ALSO"):
                    self.assertIn(f".SH {title}\n", text)
                self.assertIn(f"osdtex {name}", text)
                if name not in ("help", "methods"):
                    self.assertIn(".SH FILES\n", text)
        self.assert_exit(self.run_program("help", "--man", "xyzzy"), 1)


if __name__ == "__main__":
    main()
