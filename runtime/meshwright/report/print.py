"""The report's figures as files, one each."""

import io
from pathlib import Path

from meshwright.base.errors import UsageError
from meshwright.base.files import write_bytes
from meshwright.report import style
from meshwright.report.figures import pictures

#: Resolution of pixel formats, dots per inch.
RESOLUTION = 300


def write_figures(analysis, folder, form):
    """Write every figure to ``folder`` as pdf, svg or png; the folder is made if need be. Returns the paths."""
    folder = Path(folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(f"{folder}: cannot be made ({error.strerror}); name a folder") from error
    paths = []
    with style.drawing():
        for picture in pictures(analysis):
            paths.append(folder / f"{picture.name}.{form}")
            write_bytes(paths[-1], _drawn(picture.figure(analysis), form))
    return paths


def _drawn(figure, form):
    stream = io.BytesIO()
    figure.savefig(stream, format=form, dpi=RESOLUTION)
    return stream.getvalue()
