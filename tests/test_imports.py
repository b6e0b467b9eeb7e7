"""Modules import one way: no cycle among those that a module names at its top, in the runtime and in derive."""

import ast
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PACKAGES = {"meshwright": ROOT / "runtime" / "meshwright", "derive": ROOT / "derive"}


@cache
def imported(package):
    """Module → modules of its package that it imports when it is imported itself, or when its types are checked."""
    folder = PACKAGES[package]
    files = {_name(package, folder, path): path for path in folder.rglob("*.py") if "_generated" not in path.parts}
    trees = {name: ast.parse(path.read_text(encoding="utf-8")) for name, path in files.items()}
    return {name: set(_imports(tree.body, files)) for name, tree in trees.items()}


def _name(package, folder, path):
    return ".".join((package, *path.relative_to(folder).with_suffix("").parts)).removesuffix(".__init__")


def _imports(statements, files):
    for statement in statements:
        match statement:
            case ast.Import(names=names):
                yield from (alias.name for alias in names if alias.name in files)
            case ast.ImportFrom(module=module, names=names, level=0):
                inner = {f"{module}.{alias.name}" for alias in names} & files.keys()
                yield from inner
                if module in files and len(inner) < len(names):
                    yield module
            case ast.Try(body=body) | ast.With(body=body) | ast.If(body=body):
                yield from _imports(body, files)


def cycle(graph):
    """A cycle of a directed graph as a list of its nodes; [] if there is none."""
    done, way = set(), []

    def visit(node):
        if node in way:
            return [*way[way.index(node) :], node]
        if node in done:
            return []
        way.append(node)
        found = next((c for other in sorted(graph[node]) if (c := visit(other))), [])
        way.pop()
        done.add(node)
        return found

    return next((c for node in sorted(graph) if (c := visit(node))), [])


@pytest.mark.parametrize("package", PACKAGES)
def test_no_module_imports_itself_by_way_of_others(package):
    assert cycle(imported(package)) == []


def test_a_cycle_is_found():
    assert cycle({"a": {"b"}, "b": {"c"}, "c": {"b"}}) == ["b", "c", "b"]


def test_nothing_below_the_facade_imports_it():
    """The façade is for those who use the package: command line and studies on top of it, no room below it."""
    rooms = ("base", "design", "contact", "flank", "cycle", "pattern", "limits")
    climbing = [
        name
        for name, others in imported("meshwright").items()
        if name.split(".")[1:2] and name.split(".")[1] in rooms and "meshwright.drive" in others
    ]
    assert climbing == []
