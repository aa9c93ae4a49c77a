"""The verbs: what the robot can do, one file for each; a new verb is added to this list."""

from trees.deeds.bring import Bring
from trees.deeds.check import CheckWhether
from trees.deeds.clear import Clear
from trees.deeds.count import Count
from trees.deeds.deed import Deed
from trees.deeds.find import Find
from trees.deeds.go import Go
from trees.deeds.put import Put
from trees.deeds.put_back import PutBack
from trees.deeds.put_down import PutDown
from trees.deeds.take import Take
from trees.deeds.tell import TellWhatIsThere

DEEDS: tuple[Deed, ...] = (
    *(Bring(), Find(), Take(), PutDown(), Put(), PutBack(), Go()),
    *(Count(), TellWhatIsThere(), CheckWhether(), Clear()),
)
"""In the order in which the tree tries them."""


def deed_of(kind: str) -> Deed:
    """The deed that carries out this kind of command."""
    return next(deed for deed in DEEDS if deed.kind == kind)
