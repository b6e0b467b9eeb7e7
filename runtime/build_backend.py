"""Build backend of the package: setuptools, with the C library compiled first and the wheel named for its platform."""

import subprocess
import sysconfig
from pathlib import Path

from setuptools import build_meta
from setuptools.build_meta import *  # noqa: F403  what is not changed here

LIBRARY = "runtime/meshwright/_generated/libmeshwright.so"

#: What a source archive holds beside the package, in the words of setuptools: all that the library is built from.
SOURCES = """
include Makefile
graft derive
graft generated
graft runtime
graft tests
prune runtime/meshwright/_generated
global-exclude *.py[cod]
"""



def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """A wheel with the compiled library; it runs on any processor of this platform, and with any Python 3."""
    subprocess.run(["make", "--silent", "-j2", LIBRARY], check=True)
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    options = {**(config_settings or {}), "--build-option": ["--python-tag", "py3", "--plat-name", platform]}
    return build_meta.build_wheel(wheel_directory, options, metadata_directory)


def build_sdist(sdist_directory, config_settings=None):
    """A source archive from which the wheel can be built."""
    manifest = Path("MANIFEST.in")
    manifest.write_text(SOURCES, encoding="utf-8")
    try:
        return build_meta.build_sdist(sdist_directory, config_settings)
    finally:
        manifest.unlink()
