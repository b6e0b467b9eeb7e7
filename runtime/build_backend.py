"""Build backend of the package: setuptools, with the C libraries compiled first and a wheel named for its platform."""

import json
import os
import runpy
import subprocess
import sys
import sysconfig
import tomllib
import warnings
from pathlib import Path
from types import SimpleNamespace

from setuptools import build_meta
from setuptools.build_meta import *  # noqa: F403  what is not changed here

ROOT = Path(__file__).resolve().parent.parent


def _program(path):
    """A program of the checkout as a module; the packages that it belongs to need more than a build has."""
    return SimpleNamespace(**runpy.run_path(str(ROOT / path)))


GENERATED = ROOT / "generated"
SHIPPED = ROOT / "runtime" / "meshwright" / "_generated"

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


def get_requires_for_build_wheel(config_settings=None):
    """What deriving needs, where files of generated/ are missing that git does not keep."""
    if not _program("derive/products.py").missing(GENERATED):
        return []
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    return [*project["dependencies"], *project["optional-dependencies"]["derive"]]


get_requires_for_build_sdist = get_requires_for_build_wheel


def _derived():
    """Make the files of generated/ that are missing."""
    if _program("derive/products.py").missing(GENERATED):
        paths = (str(ROOT), str(ROOT / "runtime"), os.environ.get("PYTHONPATH"))
        environment = os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, paths))}
        if subprocess.run([sys.executable, "-m", "derive"], cwd=ROOT, env=environment).returncode:
            raise SystemExit("files of generated/ are missing and could not be derived: see above, or run `make build`")


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """A wheel with the compiled libraries; it runs on any processor of this platform, and with any Python 3.

    With the setting ``libraries = "built"`` it holds those that ``make build`` has left in the checkout.
    """
    settings = dict(config_settings or {})
    _derived()
    families = json.loads((GENERATED / "families.json").read_text(encoding="utf-8"))
    drives = _program("derive/packaged.py").packaged(families)
    arguments = [str(GENERATED), str(SHIPPED), *drives, "--objects", str(ROOT / "build" / "objects"), "--whole"]
    if settings.pop("libraries", None) != "built" and _program("runtime/meshwright/base/compile.py").main(arguments):
        raise SystemExit("the libraries do not compile: see above")
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    options = {**settings, "--build-option": ["--python-tag", "py3", "--plat-name", platform]}
    return build_meta.build_wheel(wheel_directory, options, metadata_directory)


def build_editable(wheel_directory, config_settings=None, metadata_directory=None):
    """An editable installation, without setuptools' general warning that it is one."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message=r"\s*Editable installation")
        return build_meta.build_editable(wheel_directory, config_settings, metadata_directory)


def build_sdist(sdist_directory, config_settings=None):
    """A source archive from which the wheel can be built without deriving anything."""
    _derived()
    manifest = Path("MANIFEST.in")
    manifest.write_text(SOURCES, encoding="utf-8")
    try:
        return build_meta.build_sdist(sdist_directory, config_settings)
    finally:
        manifest.unlink()
