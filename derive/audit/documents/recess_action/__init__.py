"""The recess-action paper: ZN worm, wheel cut by an oversize ZN hob. Index 1 is the hob, 2 the wheel, 3 the worm.

In the extracted text the glyph "\ufffd" stands for minus, for minus-or-plus and for less-or-equal alike, "6" for
plus-or-minus; where it matters both readings are judged.
"""

from derive.audit.documents.recess_action import cutting, dimensions, meshing
from derive.audit.documents.recess_action.letters import DOCUMENT
from derive.audit.ledger import Chapter

CLAIMS = cutting.CLAIMS + meshing.CLAIMS + dimensions.CLAIMS

CHAPTER = Chapter(DOCUMENT, CLAIMS)
