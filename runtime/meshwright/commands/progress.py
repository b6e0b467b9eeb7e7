"""A progress bar on a terminal; nothing in a pipe or a file."""

import sys
from contextlib import contextmanager


@contextmanager
def progress(total):
    """Yields ``step(text)``, to be called ``total`` times, each before the part of the work that ``text`` names."""
    if not sys.stderr.isatty():
        yield lambda text: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn()
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("", total=total)
        begun = 0

        def step(text):
            nonlocal begun
            bar.update(task, description=text, completed=begun)
            begun += 1

        yield step
