"""Build backend of the package: setuptools, with the C library compiled first and the wheel named for its platform."""

import subprocess
import sysconfig

from setuptools import build_meta
from setuptools.build_meta import *  # noqa: F403  what is not changed here

LIBRARY = "runtime/meshwright/_generated/libmeshwright.so"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """A wheel with the compiled library; it runs on any processor of this platform, and with any Python 3."""
    subprocess.run(["make", "--silent", "-j2", LIBRARY], check=True)
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    options = {**(config_settings or {}), "--build-option": ["--python-tag", "py3", "--plat-name", platform]}
    return build_meta.build_wheel(wheel_directory, options, metadata_directory)
