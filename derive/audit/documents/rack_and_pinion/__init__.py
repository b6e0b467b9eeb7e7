"""The rack-and-pinion paper.

The worm as a sliding rack, limit points, meshing axes. All profiles generic (jets xi, eta, zeta).
"""

from derive.audit.documents.rack_and_pinion import axes, contact
from derive.audit.documents.rack_and_pinion.letters import DOCUMENT
from derive.audit.ledger import Chapter

CLAIMS = contact.CLAIMS + axes.CLAIMS

CHAPTER = Chapter(DOCUMENT, CLAIMS)
