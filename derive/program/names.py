"""Names of values by what they are: the same in whichever function and after whatever is changed elsewhere.

A value that a description defines has the name of the definition, a sine or cosine that of its angle; any other has a
few letters of a hash of its operation and of the names of what it is computed from. What a definition holds may
therefore change without another name than its own parts'.
"""

import hashlib
import re
from collections.abc import Callable, Mapping

from derive.program.tape import COMMUTATIVE, Tape

#: What hashes are written with: without vowels no word comes out.
_LETTERS, _DIGITS = "bcdfghjkmnpqrstvwxyz", "0123456789bcdfghjkmnpqrstvwxyz"

#: Letters of a hash in a name; longest name of a definition that is taken as it is.
SHORT, LONGEST = 5, 24


class Names:
    """Names of the nodes of one tape. ``defined`` are those that a description gives: node → name, of which the first
    node of a name has it.
    """

    def __init__(self, tape: Tape, defined: Mapping[int, str]) -> None:
        self.tape = tape
        first: dict[str, int] = {}
        for i, name in defined.items():
            first.setdefault(name, i)
        self._spoken = {i: re.sub(r"\W", "_", name) for name, i in first.items() if len(name) <= LONGEST}
        self._said = {i: f"definition {name}" for name, i in first.items()}
        self._of: dict[str, int] = {}  # what is said of nodes → the first of which it is

    def of(self, i: int, letters: int = SHORT) -> str:
        """The name of a node; with more than so many ``letters`` where two would have the same."""
        node = self.tape.nodes[i]
        if i in self._spoken:
            name = self._spoken[i]
        elif node.op == "input" and len(str(node.value)) <= LONGEST:
            name = re.sub(r"\W", "_", str(node.value))
        elif node.op in ("sin", "cos"):
            return f"{node.op}_{self.of(node.args[0], letters)}"
        else:
            return _letters(self._hash(i), letters)
        return name if letters == SHORT else f"{name}_{_letters(self._hash(i), letters)}"

    def apart(self) -> Callable[[int], str]:
        """Function: node → its name, with more letters where that is the name of another that it was asked for."""
        known: dict[str, int] = {}

        def name(i: int) -> str:
            letters = SHORT
            while known.setdefault(found := self.of(i, letters), i) != i:
                letters += 1
            return found

        return name

    def _hash(self, i: int) -> str:
        """What a node is: of a definition the hash of its name, of others that of what is said of them
        (:meth:`Tape.means`), of any else that of its operation and what it takes.
        """
        nodes, said, stack = self.tape.nodes, self._said, [i]
        while stack:
            top = stack[-1]
            node, what = nodes[top], self.tape.meanings.get(top, ())
            if top in said:
                stack.pop()
            elif missing := [a for a in (*node.args, *what) if isinstance(a, int) and a not in said]:
                stack += missing
            else:
                told = [said[a] if isinstance(a, int) else a for a in what]
                if not told or self._of.setdefault(" ".join(told), top) != top:
                    taken = [said[a] for a in node.args]
                    told = [node.op, *(sorted(taken) if node.op in COMMUTATIVE else taken)]
                    told += [] if taken else [str(node.value)]
                said[top] = hashlib.sha256(" ".join(told).encode()).hexdigest()
        return said[i]


def _letters(text: str, count: int) -> str:
    """So many letters of a hash of a text, the first no digit."""
    number = int.from_bytes(hashlib.sha256(text.encode()).digest(), "big")
    number, first = divmod(number, len(_LETTERS))
    found = _LETTERS[first]
    for _ in range(count - 1):
        number, digit = divmod(number, len(_DIGITS))
        found += _DIGITS[digit]
    return found
