"""The report: pictures, numbers and the teeth in contact, as one self-contained HTML page or as figures for print."""

from meshwright.report.analysis import Analysis, analyse, steps
from meshwright.report.html import page
from meshwright.report.print import write_figures

__all__ = ["Analysis", "analyse", "page", "steps", "write_figures"]
