"""The identities of a chapter are proved, and each of them false with one sign the other way."""

import inspect
from dataclasses import replace

from derive.prove import Outcome, decide

#: In the place of a definition's name: the claim's own equations.
ITSELF = ""


def statements(claim):
    return [claim.scope.statement(claim.key, text) for texts in claim.read().values() for text in texts]


def proved(claim):
    return all(decide(s).outcome is Outcome.PROVED for s in statements(claim))


def outcomes_changed(chapter, module, key, name, change):
    """Outcomes of the claim ``key`` of ``chapter``, whose source is ``module``, with one text put in another's place in
    the definition ``name`` or, ``ITSELF``, in its own equations.
    """
    claim = next(c for c in chapter.claims if c.key == key)
    texts, scope = [text for reading in claim.read().values() for text in reading], claim.scope
    if name == ITSELF:
        changed = [text.replace(*change) for text in texts]
        assert changed != texts
        texts = changed
    else:
        text = next(line for line in inspect.getsource(module).splitlines() if line.startswith(f"{name} = "))
        wrong = text.replace(*change)
        assert wrong != text
        own = {name: scope.read(wrong.split(" = ", 1)[1])}
        scope = replace(scope, definitions=dict(scope.definitions) | own)
    return {decide(scope.statement(key, text)).outcome for text in texts}
