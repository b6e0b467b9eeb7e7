"""What a checker ends in that does not accept what it reads."""


class Rejected(Exception):
    """The record is not what it claims to be; the message says where."""


class Undecided(Rejected):
    """The checker does not foresee what it reads: whether that is right is not decided; the message says what it is."""


#: What a checker ends in that cannot read what it is given, or that goes round in what it is given.
UNREADABLE = (ArithmeticError, AttributeError, LookupError, RecursionError, TypeError, ValueError)


def require(condition: object, message: str) -> None:
    if not condition:
        raise Rejected(message)


def foreseen(condition: object, message: str) -> None:
    if not condition:
        raise Undecided(message)
