#!/usr/bin/env python3
"""Every program and Python module that a test runs is in a list of tools/deps.

Read from the sources: imports of Python, the first word of the lists and calls
that start a process, the words of shell scripts that stand where a command
does, and what tests in C ask for by test_has_tool.
"""

import ast
import re
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
GROUPS = ["build", "test", "medium", "oracles"]

# Which package brings what does not go by its package's name.
PACKAGES = {
    "PIL": "python3-pil", "numpy": "python3-numpy",
    "jsonschema": "python3-jsonschema",
    "pxr": "usd-core", "MaterialX": "materialx",
    "OpenImageIO": "openimageio", "PyOpenColorIO": "opencolorio",
    "oiiotool": "openimageio-tools", "idiff": "openimageio-tools",
    "exrheader": "openexr", "exrmultipart": "openexr",
    "tiffinfo": "libtiff-tools",
    "munged": "munge", "slurmctld": "slurm-wlm", "slurmd": "slurm-wlm",
    "sbatch": "slurm-wlm", "scontrol": "slurm-wlm", "sinfo": "slurm-wlm",
    "squeue": "slurm-wlm", "node": "nodejs", "nm": "binutils",
    "pkg-config": "pkgconf", "ctest": "cmake", "cpack": "cmake",
    "ninja": "ninja-build",
    "c++": "g++", "clang++": "clang", "cc": "gcc", "git": "git",
    "abidiff": "abigail-tools", "abidw": "abigail-tools", "objdump": "binutils",
}
# Of packages that every Debian has (Essential, or apt itself).
ESSENTIAL = set(
    "apt-get awk basename cat chmod cmp cp cut date df diff dirname dpkg-query "
    "du echo env expr find grep head id kill ls mkdir mktemp mount mv nproc "
    "printf pwd readlink realpath rm rmdir sed seq sh sleep sort stat tail tar "
    "tee test timeout touch tr true umount uname uniq unshare wc xargs bash "
    "chroot ln apt-cache setpriv setsid nohup truncate mkfifo dd md5sum "
    "sha256sum stdbuf yes gzip gunzip".split())
# Comes with Blender's own Python.
INSIDE_BLENDER = {"mathutils", "bpy"}
# Instead of what is in a list, on other systems.
INSTEAD = {"google-chrome"}
STARTERS = {"run", "need", "which", "Popen", "check_output", "start", "slurm"}
SHELL_WORDS = set(
    "if then else elif fi for do done while until case esac in exit set export "
    "trap cd shift return exec unset command break continue read . : ! { } "
    "local eval exit".split())


def python_files():
    yield from sorted((ROOT / "tests").rglob("*.py"))
    for name in ("check-layers", "make-models"):
        yield ROOT / "tools" / name


def imports(tree):
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (a.name.split(".")[0] for a in node.names)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            yield node.module.split(".")[0]


def texts(nodes):
    return [n.value for n in nodes
            if isinstance(n, ast.Constant) and isinstance(n.value, str)]


def started(tree):
    """First words of what is run, and all arguments of need() and which()."""
    for node in ast.walk(tree):
        if not isinstance(node, ast.Call):
            continue
        name = getattr(node.func, "attr", getattr(node.func, "id", ""))
        if name not in STARTERS:
            continue
        # Of modules; the same name starts processes elsewhere.
        if name == "run" and "self" == getattr(
                getattr(node.func, "value", None), "id", ""):
            continue
        if name in ("need", "which"):
            yield from texts(node.args)
        elif node.args and isinstance(node.args[0], (ast.List, ast.Tuple)):
            yield from texts(node.args[0].elts[:1])
        else:
            yield from texts(node.args[:1])


def shell_commands(text):
    """The words that stand where a command does."""
    text = re.sub(r"<<-?'?(\w+)'?.*?\n\1\n", "\n", text, flags=re.S)
    text = text.replace("\\\n", " ")
    text = re.sub(r"(?m)(^|\s)#.*$", "", text)
    text = re.sub(r"'[^']*'", "Q", text)
    text = re.sub(r'"([^"$\n]|\$[^(\n])*"', "Q", text)
    text = re.sub(r"(?m)^\s*[^()\s][^()\n]*\)", "", text)  # of case
    text = re.sub(r"\bfor \w+( in\b.*)?", "", text)
    text = re.sub(r"\$\(\([^()]*\)\)", "Q", text)  # arithmetic
    functions = set(re.findall(r"(?m)^(\w+)\(\)", text))
    for line in re.split(r"\n|;|&&|\|\||\||\$\(|`|\(|\)|\{ |&", text):
        words = line.split()
        while words and (
                words[0] in SHELL_WORDS or re.match(r"\w+=", words[0])):
            words.pop(0)
        if words and re.fullmatch(r"[a-z][a-z0-9+-]*", words[0]):
            if words[0] not in functions:
                yield words[0]


def shell_files():
    yield from sorted((ROOT / "tests").rglob("*.sh"))
    for name in ("demo", "fuzz", "test", "test-summary", "make-man"):
        yield ROOT / "tools" / name


def c_tools():
    for path in sorted((ROOT / "tests").rglob("*.c")):
        for name in re.findall(r'test_has_tool\("(\w+)"\)', path.read_text()):
            yield path, name


class Deps(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        text = subprocess.run(
            [ROOT / "tools" / "deps", "--list", *GROUPS],
            capture_output=True, text=True, check=True).stdout
        cls.listed = {w.split("==")[0] for w in text.split()}

    def check(self, path, name):
        package = PACKAGES.get(name, name)
        self.assertTrue(
            package in self.listed,
            f"{path.relative_to(ROOT)} uses {name}; tools/deps does not list "
            "its package")

    def test_modules(self):
        # The tree's own, wherever they are: scripts for Blender, say.
        own = {p.stem for folder in ("tests", "tools", "osdtex")
               for p in (ROOT / folder).rglob("*.py")}
        own |= {p.parent.name for p in (ROOT / "tools").rglob("__init__.py")}
        known = set(sys.stdlib_module_names) | own | INSIDE_BLENDER
        for path in python_files():
            for name in set(imports(ast.parse(path.read_text()))) - known:
                with self.subTest(name=name):
                    self.check(path, name)

    def test_programs_of_python(self):
        for path in python_files():
            for name in set(started(ast.parse(path.read_text()))):
                if not re.fullmatch(r"[a-z][a-z0-9+-]*", name):
                    continue
                if name not in ESSENTIAL | INSTEAD:
                    with self.subTest(name=name):
                        self.check(path, name)

    def test_programs_of_shell(self):
        for path in shell_files():
            for name in set(shell_commands(path.read_text())) - ESSENTIAL:
                with self.subTest(name=name):
                    self.check(path, name)

    def test_programs_of_c(self):
        for path, name in c_tools():
            self.check(path, name)

    def test_tools_would_be_missed(self):
        """What is looked for is found: a reader that sees nothing passes."""
        self.assertEqual(
            set(shell_commands("a=1 nm -D $x | sort; test $((b & 4)) = 0\n")),
            {"nm", "sort", "test"})
        tree = ast.parse("run('oiiotool', '-v')\nimport scipy.fft\n")
        self.assertEqual(list(started(tree)), ["oiiotool"])
        self.assertEqual(list(imports(tree)), ["scipy"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
