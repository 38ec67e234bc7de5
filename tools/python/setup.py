"""The wheel: the module in C against an installed osdtex, which pkg-config
finds. Its version is that of the library. With OSDTEX_STATIC=1 the archive is
linked in place of the shared library."""

import os
import shlex
import subprocess

from setuptools import Extension, setup

try:
    from wheel.bdist_wheel import bdist_wheel
except ImportError:  # setuptools 70 and later have their own
    from setuptools.command.bdist_wheel import bdist_wheel

STATIC = os.environ.get("OSDTEX_STATIC") == "1"


def ask(*words):
    return subprocess.run(
        ["pkg-config", *words, "osdtex"], check=True, capture_output=True,
        text=True).stdout.strip()


def link_words():
    words = shlex.split(ask("--libs", *(["--static"] if STATIC else [])))
    if not STATIC:
        # Found where it is, also outside of the linker's folders.
        return [*words, "-Wl,-rpath," + ask("--variable=libdir")]
    archive = os.path.join(ask("--variable=libdir"), "libosdtex.a")
    return [archive, *(w for w in words if w != "-losdtex")]


class OneForAll(bdist_wheel):
    """A wheel for all Pythons from 3.11 on."""

    def finalize_options(self):
        self.py_limited_api = "cp311"
        super().finalize_options()


setup(
    version=ask("--modversion"),
    cmdclass={"bdist_wheel": OneForAll},
    ext_modules=[Extension(
        "osdtex._osdtex",
        [f"{name}.c" for name in (
            "module", "context", "edit", "handle", "inputs", "mapping", "options",
            "textures")],
        depends=["binding.h", "options.h"],
        extra_compile_args=["-std=c17", *shlex.split(ask("--cflags"))],
        extra_link_args=link_words(),
        py_limited_api=True)])
