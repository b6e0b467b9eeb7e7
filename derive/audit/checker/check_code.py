"""Check the generated C itself against calculus: `python check_code.py [folder]`, exit status 0 if everything holds.

The functions of a generated header are straight-line programs. They are read as text and run modulo a prime of 61 bits
drawn at random, with random parameters, a random point of the circle for every independent angle, and dual numbers
along every unknown.
Then, for every drive:

  jacobian   J is the derivative of R, entry by entry
  tangents   each tangent of a flank is the derivative of its point
  normal     the normal of a flank has length one and is perpendicular to every tangent: an explicit wheel flank is
             therefore an envelope, its equation of meshing solved. Where one equation of meshing is left implicit the
             normal meets the tangent along the motion, and there alone, and the recorded slopes are the derivatives of
             that equation
  assembly   the first three residuals are the vector between the two points in the fixed frame, turned or not
  step       the fused Newton step solves J dx = -R
  anchor     the residual by sines of an anchor is that of eval, and the anchor has the angles that it takes
  along      first and second derivatives of the residual along a path of unknowns and input angle
  start      the Jacobian of the start system
  curvature  basis, second form and principal curvatures follow from the normal's derivatives
  lanes      each of two instances is computed as the scalar setup, set_phi and step compute it, guards included
  tangent    changes of the residual and of the contact point along changes of parameters, angle and unknowns
  solver     functions that call the solver stand as they must
  sine       polynomials and reduction of the sine and cosine kernel, against enclosures, and its series for small turns
  atan2      its polynomial against the series of the arc, octants and quadrants
  agreement  a flank has the point, the singular function and the limits that the observation of a contact has there

A wrong program passes with a probability of about degree / 2^61.
"""

import re
from collections.abc import Iterator
from pathlib import Path

from .as_they_stand import SOLVED, check_as_they_stand
from .attempts import attempt
from .calculus import (
    check_agreement,
    check_along,
    check_assembly,
    check_by_anchor,
    check_curvature,
    check_flank,
    check_jacobian,
    check_step,
)
from .command import ended, folder_of
from .kernels import check_arc_kernel, check_kernels, check_near_kernel
from .lanes import check_flank_tangent, check_lanes, check_tangent
from .refusal import UNREADABLE, Rejected
from .straight_line import Header, read_companion, read_header


def checks_of(header: Header) -> Iterator[tuple[str, tuple]]:
    """What is checked of a header: words, and the check with its arguments."""
    yield "jacobian of the residual", (check_jacobian, header, "eval")
    yield "Newton step", (check_step, header)
    yield "residual by an anchor", (check_by_anchor, header)
    yield "derivatives along a path", (check_along, header)
    if header.lanes:
        yield "lanes", (check_lanes, header, header.lanes)
    if header.tangents:
        yield "tangents of parameters", (check_tangent, header, header.tangents)
        for body in header.unknowns:
            yield f"tangents of the {body}", (check_flank_tangent, header, header.tangents, body)
    if "start_eval" in header.functions:
        yield "jacobian of the start system", (check_jacobian, header, "start_eval")
    yield "assembly of the two points", (check_assembly, header)
    for name in header.functions:
        if name.startswith(("flank_", "fillet_")):
            yield f"tangents and normal of {name}", (check_flank, header, name)
        if f"curvature_{name}" in header.functions and not header.functions[name].implicit:
            yield f"curvature of {name}", (check_curvature, header, name)
    for body in header.unknowns:
        yield f"agreement of flank and observation of the {body}", (check_agreement, header, body)


def check_header(path: Path) -> int:
    """All checks of one header; how many were made."""
    try:
        text = path.read_text(encoding="utf-8")
        check_kernels(text)
        check_near_kernel(text)
        check_arc_kernel(text)
        check_as_they_stand(text, re.search(r"static inline int (\w+)_setup\(", text)[1], SOLVED)
        header = read_header(text, read_companion(path, "lanes"), read_companion(path, "sensitivity"))
        checks = list(checks_of(header))
        for _, check in checks:
            attempt(*check)
    except (Rejected, *UNREADABLE) as error:
        raise Rejected(f"{path.name}: {error}") from error
    return len(checks) + 1


def main(arguments: list[str]) -> int:
    def said() -> str:
        drives, folder = "_setup(const double *p, double *s)", folder_of(arguments).parent / "c"
        headers = [path for path in sorted(folder.glob("*.h")) if drives in path.read_text(encoding="utf-8")]
        return (
            f"{sum(map(check_header, headers))} checks of {len(headers)} generated headers hold: J = dR/dx, step, "
            "paths, start, tangents, normals, curvature, lanes, parameters, sine, assembly, agreement"
        )

    return ended(said)
