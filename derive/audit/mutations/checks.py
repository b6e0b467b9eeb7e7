"""The checks of generated files, and which functions each reads."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from derive.audit.checker import attempts, check_bounded, check_code, check_description
from derive.audit.checker.any_root import kept_draws, with_any_root
from derive.audit.checker.casadi_functions import Casadi
from derive.audit.checker.design import check_open, check_unit
from derive.audit.checker.draws import Draws, on_both_flanks
from derive.audit.checker.drive import Drive
from derive.audit.checker.edges import BoundedDrive, check_systems
from derive.audit.checker.kernels import check_arc_kernel, check_kernels, check_near_kernel
from derive.audit.checker.straight_line import read_header
from derive.audit.mutations.stages import CASADI, DESCRIPTION, TABLES

#: Words of a check -> the functions that it reads beside setup and set_phi, where its words do not name them.
READ = (
    (r"jacobian of the residual|residual \d", ("eval",)),
    (r"Newton step", ("eval", "step")),
    (r"derivatives along", ("eval", "along")),
    (r"by an anchor", ("eval", "by_anchor", "anchor")),
    (r"lanes", ("step",)),
    (r"tangents of parameters|assembly", ("eval", "observe")),
    (r"start", ("start_eval", "start_scale", "guess", "start_solution")),
    (r"natural sizes", ("scale",)),
    (r"observation", ("observe",)),
    (r"edges", ("edges",)),
    (r"placement", ("placement",)),
    (r"size ", ("size",)),
    (r"table (equations|observed)", ("eval", "observe")),
    (r"of the (pinion|wheel)", ("flank_pinion", "flank_wheel", "observe")),
)
#: What is read by all checks but those of rules, sizes and design systems.
STATE = ("setup", "set_phi")


def reads(check: Check, name: str) -> bool:
    """May a check read a function of the scalar C or of the bounded flanks?"""
    bare = re.sub(r"^(curvature|slopes|second)_", "", name)
    if name in STATE or re.search(rf"\b({name}|{bare})\b", check.words):
        return True
    return any(name in names and re.search(pattern, check.words) for pattern, names in READ)


@dataclass
class Check:
    """One check of a drive: the module that it is of, its words, and what runs it with some draws."""

    module: str
    words: str
    run: Callable[[dict], None]


class Checks:
    """All checks of one drive of some texts: header endings, description, CasADi functions by their ending."""

    def __init__(self, name: str, texts: dict, folder: Path):
        self.name, self.texts = name, texts
        described = texts[DESCRIPTION]
        self.header = read_header(texts["scalar C"], texts["lanes"], texts["sensitivity"])
        self.drive = Drive(described, texts["scalar C"], texts["sensitivity"])
        self.bounded = BoundedDrive(described, texts["scalar C"], texts["bounded"], texts[TABLES])
        self.casadi = Casadi(folder, name)
        for ending, function in texts.get(CASADI, {}).items():
            self.casadi.replace(ending, function)

    @cached_property
    def all(self) -> list[Check]:
        found = [
            Check("code", "kernels", lambda _: check_kernels(self.texts["scalar C"])),
            Check("code", "near kernel", lambda _: check_near_kernel(self.texts["scalar C"])),
            Check("code", "arc", lambda _: check_arc_kernel(self.texts["scalar C"])),
        ]
        for words, (check, *arguments) in check_code.checks_of(self.header):
            found.append(Check("code", words, lambda _, c=check, a=arguments: attempts.attempt(c, *a)))
        for number in range(len(self.drive.description["keys"])):
            found.append(Check("description", "unit", lambda _, k=number: check_unit(self.drive, k)))
        for system in self.drive.description["design_systems"]:
            found.append(Check("description", "open", lambda _, s=system: check_open(self.drive, s)))
        for words, check in check_description.checks_of(self.drive):
            found.append(Check("description", words, lambda d, c=check: on_both_flanks(*c, draws=d["description"])))
        if self.bounded.bounded:
            found.append(Check("bounded", "systems", lambda _: check_systems(self.bounded)))
        for words, (check, *arguments) in check_bounded.checks_of(self.bounded, self.casadi):
            own = tuple(arguments)
            found.append(Check("bounded", words, lambda d, c=check, a=own: with_any_root(c, a, d["any"])))
        return found


def draws() -> dict:
    return {"description": (Draws(1), Draws(-1)), "any": kept_draws()}
