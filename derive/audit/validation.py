"""What the record verifies and what it does not, in words."""

from derive.audit.paragraphs import titled

VERIFIED = titled(
    """
Every printed equation of the four documents has a verdict
Encoded as printed, as expression trees; decided by the prover against definitions made of rotation matrices, cross
products and derivatives.

Identities hold for every profile
Profile functions are jets: free symbols for the function and each derivative. One proof covers all flank forms.

Proofs are re-checked by a program that shares no code with the prover
check.py needs only Python. It recomputes every hash, adds up numerator = Σ cofactor × relation in exact integers, and
expands lhs − rhs itself in exact integers where that fits, with free cosines and sines; what does not fit is evaluated
at three points, each modulo a prime of its own, all drawn at random. It differentiates by dual numbers, and reads every
equation anew from the text of the reading.

Proofs are theorems of Coq
make kernel writes each component of each proof as a theorem over the real numbers, with circles, roots and denominators
as hypotheses and the recorded cofactors as evidence; Coq's kernel expands both sides, and where cofactors are long
reduces the difference by the relations itself. These rest on the axioms of Coq's real numbers alone. Locus, normal and
equation of meshing of the ZN wheel are stated with derivatives as limits; this chain also uses excluded middle
(Classical_Prop.classic), from the library of derivatives; of other drives locus, normal and equation of meshing are
identities between derivatives that are formed before Coq reads them. No proof is left out; numbers of tables and
counterexamples are no proofs of this kind: check.py recomputes them, Coq does not read them.

False statements come with numbers
Each refutation names a point with rational cosines and sines at which the two sides differ; the checker recomputes both
sides in exact fractions, or in enclosures where roots, arcs or bare angles enter.

No statement is vacuous
Every proof is also evaluated at a real point, and at a point of the variety modulo a random prime; both sides exist and
agree there.

Corrections are found, not typed
Where a print is refuted, all one-token changes (a sign, sin for cos, an exchanged symbol, a factor) are tried; the
first true one is shown. Corrections that need more than one token are written by us and proved like everything else.

Derived equations tolerate no change
Every sign or term mutation of the derived equations is refuted by the test suite, which prints how many.

The generated C is the mathematics
check_code.py reads the C functions themselves and runs them modulo a random prime: the Jacobian is the derivative of
the residual entry by entry, every tangent the derivative of its point, every flank normal of length one and
perpendicular to all tangents (so an explicit wheel flank is an envelope and its equation of meshing is solved), the
residual the vector between the two points. The Newton step solves J dx = −R, derivatives along a path are derivatives,
curvatures follow from the change of the normal, lanes and tangents of parameters agree with the scalar functions, the
kernel of sine and cosine with enclosures; what calls the solver or chooses equations is compared as text. What is not
noticed stands in the table of changes below.

The generated C is the description
check_description.py evaluates the plain data of each drive (motions as factors, expressions as prefix lists) and the C
functions modulo a random prime at one input: defaults and rules with their changes, systems that fill in a design,
guards, sizes, residuals, natural sizes, guess and first contact; points carried by the factors, normals with their
direction, singular functions, second forms, margins, conditions, placements, lever arms, and every result of the other
functions. A normal that points inward is refused. make audit does so for every drive of generated/.

Edges, limits and CasADi
check_bounded.py compares the equations of edge contact with margins, points and normals of the description, their
Jacobian and the slopes and second derivatives of limits with dual numbers, runs CasADi's own lists of instructions
beside the C functions, result by result, and the tables of certified functions likewise.

Nothing of a header is unread
check_shipped.py cuts each header into its items and accounts for every one, in its order: the signatures of the
functions that the other checks run and what stands around their statements, tables and macros made of the description,
names, units and domains included, the texts of runtime/c token by token, every constant as the double nearest to what
it stands for, and a sample that is a contact. In the header of proofs the functions have the middles of the drive's
own equations and every running error is that of its operation. Of tokens changed at random at most three in a hundred
are accepted: numbers that nothing reads, and radii that are larger than they must be.

The description is what is printed
printed.txt says, family by family, what papers, books and standards print of machine and assembly motions, tool edges,
rules, sizes, guards, margins and outward normals. check_print.py evaluates it beside the plain data of each drive, so
that a description that was changed makes its statements false; what nothing is said of is refused, but for the few
entries that printed.txt lists as open, with the reason. And it requires that every surface is its edge carried by its
chain, that its normal is at right angles to the generating motion and to the tool, and that the residual is that of two
placed surfaces.

Bevel and hypoid gears
The four flank points of the spiral bevel set of NASA CR-191009 come out to 8.3e-8 inch, no better because its settings
are rounded. Pairs that are conjugate by construction (one crown gear for both members, cutters that touch along a
generatrix, a pinion whose cradle is its Formate gear, at any offset) run without transmission error to 1e-9 arcsec, and
touch along lines where they must, face-milled or hobbed. Random misaligned designs that use every setting of the
machine agree with 50-digit arithmetic written from the machine's kinematics alone: points to 1e-12 mm, normals to
1e-12, transmission error to 2e-10 arcsec, its derivatives by every setting to 1e-9. In the developed pitch cone the
tooth of a face-hobbed crown pair is the extended epicycloid to 1e-13; without blade groups the solver of face-hobbed
pairs gives the milled pair to 1e-10 arcsec.

Cylindrical gears
Working pressure angles, centre distances and contact ratios equal the closed forms of ISO 21771 and printed examples to
the last printed digit. Parallel unmodified pairs touch along lines without transmission error; crossed ones keep their
normal, and a constant transmission error, under every misalignment. Random modified and misaligned designs agree with
50-digit arithmetic: transmission error to 1e-10 arcsec.

Side conditions reach the code
Every division, root and arc of the generated functions has its condition, the statement that carries it and a guard
(page Side conditions). The compiler proves on the program itself that a value that does not exist ends in what the
runtime tests, or as a result that is no number; where it would not, it writes a test.

Nothing was changed afterwards
A header names each statement with the hash of its verdict, and the record its sha256: a header that was made of other
definitions cites what this record does not hold. Changing one character of a header, an equation, a certificate or a
cofactor is caught; each is a test.
"""
)

NOT_VERIFIED = titled(
    """
Figures of the documents
All figures are lost in the extraction. Frames are defined by matrices here; where a figure alone fixes a sign or an
order, the verdict says so.

Missing pages
Every even page of the spherical report is missing: its equations (2.3), (2.4), (2.8), (2.9), (2.14)–(2.18),
(2.24)–(2.29), (3.1), (3.2) and (3.8)–(3.11) cannot be judged.

Signs lost in the extraction
Minus, minus-or-plus and less-or-equal share one glyph. Each sensible reading is judged; the print itself is not
repaired.

Numbers that need a solved contact
Tooth contact tables are compared by the runtime's tests, not here; here only numbers that follow from other printed
numbers.

Measurements and finite-element results
They do not follow from equations. The face worm report has, under 50 N m on the gear and with five pairs modelled,
three pairs that share the load and largest von Mises stresses of 168 MPa (bending) and 1090 MPa (contact) for the
conical worm, 195 and 960 MPa for the cylindrical one. At worm angle 0 of the convex designs, on 30 040 elements, three
pairs share. Conical: von Mises is 225 MPa in the gear's fillets, 333 MPa in the worm's and 908 MPa below the flanks
under a pressure of 1482 MPa; cylindrical: 264, 368 and 951 MPa under 1556 MPa. Bending is the higher with the
cylindrical worm, as in the report; contact stress is here so too, and in the report is not. Only the order of magnitude
can agree: the report gives no blade parabola, rule of the pitch point, tooth heights or rounding, and not the angle or
place of its largest stresses; our worm ends in an arc of the blade's edge radius, and our mesh is graded to each
contact point.

The spiral bevel set of NASA CR-191009 as a pair
Its settings are compared as four flanks, not as a pair: as printed the ratio of the speeds is 0.5 to 0.6 % off 12/36
and contact lies about 3.7 mm off mid-face; a mounting figure is missing. Its gear's ratio of roll, 0.9508646, differs
by 2e-6 from sin Γ/cos δ of the exact pitch angle, by 1.1e-5 from that of the printed one. No transmission error of it
is published.

The printed pair of screw gears
KHK's example (module 3, 15 and 24 teeth, helix angles 20° and 30°) goes by virtual spur gears. Print: pressure angle
22.9338°, centre distance 67.1925 mm; exact at its shaft angle of 51.1025°: 22.9394° and 67.1931 mm.

Existence and uniqueness of roots
An identity f = I·g says nothing about roots gained or lost where I = 0; such factors are listed as steps with their
condition.

Floating point
Identities are exact. Round-off of the generated code is measured by its own tests against 50-digit arithmetic.

Probability
Proofs whose trees are too large to be expanded are evaluated at random points instead; check.py prints how many. A
wrong one would be accepted with a probability below (degree/2⁶⁰ + bits/2⁵⁸)³, which it prints too.

What of the C is not compared with the description
Guards whose message names more than one quantity (roots of sums, divisors that are expressions) are compared between
scalar and lanes only. Which of two principal curvatures is the smaller has no meaning modulo a prime. Principal
curvatures of the gap are compared in C, not in CasADi's observation.
"""
)
