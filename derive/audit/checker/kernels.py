"""Sine, cosine and arc: polynomials and reductions against enclosures in exact arithmetic."""

import math
import re
from fractions import Fraction

from .enclosure import Ball, cosine_and_sine, number_of
from .refusal import require

#: What stands around the polynomials of sine and cosine: nearest quarter turn, rest, exchange and signs by quadrant.
SINE_LINES = (
    "const double magic = 6755399441055744.0;",
    "const double k = turned.number - magic;",
    "const double z = r * r;",
    "s.number = MW_FMA(r * z, u, r);",
    "const double w = MW_FNMA(z, 0.5, 1.0);",
    "c.number = w + MW_FMA(z * z, v, MW_FNMA(z, 0.5, 1.0 - w));",
    "const unsigned long long quadrant = turned.bits, odd = 0 - (quadrant & 1);",
    "const unsigned long long exchanged = (s.bits ^ c.bits) & odd;",
    "const unsigned long long sign = quadrant << 62 & 0x8000000000000000;",
    "s.bits ^= exchanged ^ sign;",
    "c.bits ^= exchanged ^ (sign ^ (odd & 0x8000000000000000));",
    "*sine = s.number;",
    "*cosine = c.number;",
)


def check_kernels(text: str) -> None:
    """Sine and cosine: polynomials and constants against enclosures in exact arithmetic, and what stands around."""
    body = re.search(r"_sincos\(double a, double \*sine, double \*cosine\)\n{\n(.*?)\n}", text, re.DOTALL)
    require(body, "no kernel of sine and cosine")
    for line in SINE_LINES:
        require(line in body[1], f"sincos: {line} is not there")
    pi = number_of("pi").middle
    reduced = re.search(
        r"turned\.number = MW_FMA\(a, ([\d.]+), magic\);.*?"
        r"const double r = \(\(a - k \* ([\d.e-]+)\) - k \* ([\d.e-]+)\) - k \* ([\d.e-]+);",
        body[1],
        re.DOTALL,
    )
    require(reduced, "sincos: no reduction to a quarter turn")
    half, first, second, third = (Fraction(float(found)) for found in reduced.groups())
    require(abs(half - 2 / pi) < Fraction(1, 2**53), "sincos: 2/pi is another number")
    require(abs(first + second + third - pi / 2) < Fraction(1, 10**35), "sincos: pi/2 is another number")
    fused = re.search(r"const double r = MW_FNMA\(k, ([\d.e-]+), MW_FNMA\(k, ([\d.e-]+), a\)\);", body[1])
    require(fused, "sincos: no reduction to a quarter turn")
    turns = sum(Fraction(float(found)) for found in fused.groups())
    require(abs(turns - pi / 2) < Fraction(1, 10**30), "sincos: pi/2 is another number")
    lines = re.findall(r"const double (\w+) = (.+?);", body[1])
    for step in range(-8, 9):
        r = Fraction(step, 8) * Fraction(785, 1000)
        known = {"r": r, "z": r * r}
        for name, expression in lines:
            if re.fullmatch(r"[uv]\d?_?\w*", name):
                known[name] = kernel_value(expression, known)
        u, v, z = known["u"], known["v"], known["z"]
        cosine, sine = cosine_and_sine(Ball(r), number_of("pi"))
        require(abs(r + r * z * u - sine.middle) <= abs(r) * Fraction(1, 2**53), "sincos: the polynomial of the sine")
        require(
            abs(1 - z / 2 + z * z * v - cosine.middle) <= Fraction(1, 2**53), "sincos: the polynomial of the cosine"
        )


#: Sine and cosine of an angle close to another by those of that one; numbers left open.
NEAR_LINES = (
    r"const double r = a - at\[0\], z = r \* r;",
    r"const double u = MW_FNMA\(r \* z, MW_FNMA\(z, ([\d.e-]+), ([\d.e-]+)\), r\);",
    r"const double v = z \* MW_FNMA\(z, ([\d.e-]+), 0\.5\);",
    r"\*sine = at\[1\] \+ MW_FMS\(at\[2\], u, at\[1\] \* v\);",
    r"\*cosine = at\[2\] - MW_FMA\(at\[1\], u, at\[2\] \* v\);",
    r"\*away \+= z;",
)


def check_near_kernel(text: str) -> None:
    """Sine and cosine of a small turn: coefficients of their series, and what these leave at the largest distance."""
    body = re.search(r"_near_sincos\([^)]*\)\n{\n(.*?)\n}", text, re.DOTALL)
    found = body and re.fullmatch(r"\s*".join(("", *NEAR_LINES)), body[1])
    require(found, "near_sincos: other statements")
    for number, factorial in zip(found.groups(), (120, 6, 24), strict=True):
        require(float(number) == 1 / factorial, f"near_sincos: 1/{factorial} is another number")
    square = Fraction(float(re.search(r"#define \w+_NEAREST ([\d.e-]+)\n", text)[1]))
    require(0 < square**3 < Fraction(720, 2**63), "near_sincos: the series leave more than round-off")


#: What stands around the polynomial of atan2: the ratio to the nearest of 0 and 45 degrees, octants, quadrants.
ARC_LINES = (
    "const double ax = x < 0.0 ? -x : x, ay = y < 0.0 ? -y : y;",
    "const double large = ax > ay ? ax : ay, small = ax > ay ? ay : ax;",
    "const double top = upper ? small - large : small, bottom = upper ? small + large : large;",
    "const double r = bottom > 0.0 ? top / bottom : (x + y);",
    "const double z = r * r;",
    "const double octant = ax >= ay ? first : 1.5707963267948966 - first;",
    "const double half = x < 0.0 ? 3.141592653589793 - octant : octant;",
    "return y < 0.0 ? -half : half;",
)


def check_arc_kernel(text: str) -> None:
    """atan2: its polynomial against the series of the arc, in exact arithmetic, and the words of its reduction."""
    body = re.search(r"_atan2\(double y, double x\)\n{\n(.*?)\n}", text, re.DOTALL)
    if body is None:
        return
    for line in ARC_LINES:
        require(line in body[1], f"atan2: {line} is not there")
    border = re.search(r"upper = small > ([\d.]+) \* large;", body[1])
    require(border, "atan2: no border of the octants")
    eighth = Fraction(float(border[1]))
    require(abs(eighth * eighth + 2 * eighth - 1) < Fraction(1, 2**49), "atan2: the octants part elsewhere")
    turn = re.search(r"first = \(upper \? ([\d.]+) : 0\.0\) \+ MW_FMA\(r \* z, u, r\);", body[1])
    require(turn and float(turn[1]) == math.pi / 4, "atan2: another eighth of a turn")
    lines = re.findall(r"const double (u\w*) = (.+?);", body[1])
    for step in range(-8, 9):
        r = Fraction(step, 8) * eighth
        known = {"r": r, "z": r * r}
        for name, expression in lines:
            known[name] = kernel_value(expression, known)
        arc = sum(Fraction((-1) ** k, 2 * k + 1) * r ** (2 * k + 1) for k in range(24))
        require(abs(r + r * known["z"] * known["u"] - arc) <= abs(r) * Fraction(1, 2**52), "atan2: the polynomial")


def kernel_value(expression: str, known: dict[str, Fraction]) -> Fraction:
    """A product, or a product and a number."""

    def number(text: str) -> Fraction:
        return known[text] if text in known else Fraction(float(text))

    if match := re.fullmatch(r"MW_FMA\(([^,]+), ([^,]+), ([^,]+)\)", expression):
        return number(match[1]) * number(match[2]) + number(match[3])
    left, right = expression.split(" * ")
    return number(left) * number(right)
