"""The ZK-ZN paper: a ground ZK worm and a wheel cut by a ZN hob at crossing angles other than 90 degrees.

Nearly every operator and Greek letter of its equations is lost in the extraction. What can be judged is whether some
way to put the signs back is true, and which index or number cannot be right whatever the signs.
"""

from derive.audit.documents.zk_zn import equations, example
from derive.audit.documents.zk_zn.letters import DOCUMENT
from derive.audit.ledger import Chapter

CLAIMS = equations.CLAIMS + example.CLAIMS

CHAPTER = Chapter(DOCUMENT, CLAIMS)
