"""A progress bar on a terminal; nothing in a pipe or a file."""

from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn


@contextmanager
def progress(total):
    """Yields ``step(text)``, to be called ``total`` times, each before the part of the work that ``text`` names."""
    console = Console(stderr=True)
    columns = TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn()
    with Progress(*columns, console=console, disable=not console.is_terminal, transient=True) as bar:
        task = bar.add_task("", total=total)
        begun = 0

        def step(text):
            nonlocal begun
            bar.update(task, description=text, completed=begun)
            begun += 1

        yield step
