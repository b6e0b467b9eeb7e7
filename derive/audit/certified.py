"""What a certificate of contact proves, by which argument, what it trusts and what it leaves open, in words."""

from derive.audit.paragraphs import paragraphs, titled

OUTCOMES = titled(
    """
unique
The equations have exactly one solution in the box, the Jacobian is regular in it, and the solution lies in the
enclosure. Said of the decimals of the design and of the angle, not of their doubles. A tangency that bodies cannot make
is unique as well, and named as impossible.

none
The equations have no solution in the box that was given.

unknown
Neither is shown, for the reason that is named. It is evidence of nothing.
"""
)

#: Step, argument and source.
STEPS = titled(
    """
Rounding to nearest
Sum, difference, product, quotient and root of doubles are within 2⁻⁵³ of their own size of the exact result, and within
half of the least double where they are subnormal. A number is a midpoint and a radius; each operation adds its own
rounding to what the radii of its arguments make of it. Radii are rounded too: a function has at most 8000 such
roundings in a row, which the printer counts, and a factor 1 + 2⁻⁴⁰ covers.
> Rump 1999; Higham 2002, 2.1

Sine and cosine
The argument less k·π/2, the latter in three parts of which two are multiplied exactly; Taylor polynomials whose first
omitted term is below 1e-19; every rounding of their evaluation. Together below 2⁻⁵² for arguments below 1.6e6. The
radius is carried by the slope and half the square.
> Sterbenz 1974; Taylor with Lagrange's remainder

Arc tangent
About any angle t: t + atan((y cos t − x sin t)/(x cos t + y sin t)), where the arc is within a third of the cube of its
tangent. Where the box holds the cut or the origin, nothing is said.
> addition theorem

Design
Every number that the file gives is the decimal that it shows; degrees are turned by bounds of π. Rules, design systems
(by the test below) and the design stage run in double-double with a radius: sums and products split exactly, quotients
and roots by the residual of their own equation. Constants of the program that are no fractions come with how far their
double is off.
> Dekker 1971; Knuth 1998

One solution
z = C R(x̃), M = |I − C J(X)| with any matrix C, X = x̃ + [−d, d]: |z| + M d < d in every component. R in double-double,
or where many points are asked for and in the header that stands alone in doubles, J over the box by midpoint and
radius. A comparison with what is not a number fails.
> Krawczyk 1969; Neumaier 1990, 5.1; Higham 2002, 3.1

One fold or crossing
The same test on the extended system of unknowns, angle and a left null vector ψ of the Jacobian, regular where two
contacts meet. Of a crossing with one more unknown μ, of the equations changed by μ ψ: branches cross once the equations
are changed by so little, a number between two bounds.
> Moore 1980; Moore and Spence 1980

One branch
The same for every angle of a piece at once: all numbers are polynomials of order 8 in the angle with a radius.
Neighbouring pieces are joined where the solution of the one lies in the box of the other.
> Makino and Berz 2003

Ends of contact, contact ratio, peak to peak
Margins and transmission error as such polynomials; their ranges by the mean value over halved intervals. An end lies
between an angle up to which every margin is positive and one at which one is negative.

First contact, at one angle or over a range
Taylor models of order 4 in two parameters of a part of the wheel's flank and the angle. Where the pinion has the same
distance from the wheel's axis and the same place along it: a polynomial by Newton's method; Krawczyk's operator over a
box that holds all parts of the pinion's flank that may meet the part bounds how far from it anything lies that does.
The angle between both is bounded from below by halving the polynomials, and where they are convex by value and slope at
one place. Said of bounded flanks within the parameters named, of overlaps above 1e-6 mm, and of the wheel turned back
by half a pitch at most.
> Makino and Berz 2003; Krawczyk 1969
""",
    sources=True,
)

TRUSTED = titled(
    """
The equations are those of contact
The other pages of this record.

The tables are the program
One printer writes them from the tape, another the same operations as code; enclosures are compared with sixty-digit
solutions of independently written equations for drives of every family.

Compiler and processor keep IEEE arithmetic, to nearest, with subnormal numbers, without wider doubles
The library tests rounding, ties, subnormal numbers and contraction before it claims anything, and refuses else.

The bounds of each operation are written down rightly
Tests compare every operation with exact fractions and with FLINT's balls; with half of any of its error terms, the
tests fail.
"""
)

OPEN = paragraphs(
    """
First contact of flanks whose places have an equation of their own, and of parts that would have to be looked at more
closely than is allowed: they are unknown. Fillets and whatever else lies beyond the limits is not asked.

Contact along a line, and contacts next to a fold or crossing: they are unknown.

Designs whose placing systems have no regular solution within the reach of the test: the design is then the reason.
"""
)
