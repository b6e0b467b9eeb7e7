"""Which quotients are computed as products: those by a divisor whose reciprocal the same function computes anyway.

A division takes as long as a dozen products.
"""


def by_reciprocal(tape, outputs, known):
    """Quotient → its dividend and the reciprocal of its divisor, in a function that is given ``known``."""
    one, order = tape.constant(1), tape.needed(outputs, known)
    at_hand, factors = known | {*order}, {}
    for i in order:
        node = tape.nodes[i]
        if node.op == "div" and node.args[0] != one:
            reciprocal = tape.find("div", one, node.args[1])
            if reciprocal in at_hand:
                factors[i] = (node.args[0], reciprocal)
    return factors
