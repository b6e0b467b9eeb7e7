"""A page that solves one design in the browser: the drive's generated C as WebAssembly, in one HTML file."""

from meshwright.live.data import data
from meshwright.live.document import page
from meshwright.live.module import compiled

__all__ = ["compiled", "data", "page"]
