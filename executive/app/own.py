"""Parts of somebody's own, by name: `package.module:function` on the command line.

Whatever their code raises is told in a sentence, and `-vv` says where it was raised.
"""

import importlib
import logging
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from executive.errors import ExecutiveError, InputError
from executive.guards import in_words

T = TypeVar("T")

FILE = ".py"

log = logging.getLogger(__name__)


@dataclass(frozen=True)
class Named:
    """A name as it was given, for instance after `--world`; `right` is what it should be."""

    option: str
    name: str
    right: str

    @property
    def where(self) -> str:
        """Where a fault of it is."""
        return f"{self.option} {self.name}"

    def imported(self) -> Callable[[Any], object]:
        """The function of this name, or what else can be called.

        Raises:
            InputError: if there is none, or its module cannot be imported.
        """
        module_name, _, attribute = self.name.partition(":")
        here = str(Path.cwd())
        if here not in sys.path:
            sys.path.append(here)  # a console script does not look where it is started
        try:
            module = importlib.import_module(module_name)
        except ModuleNotFoundError as error:
            if module_name.endswith(FILE):
                raise self._file(module_name, attribute) from None
            what = f"there is no module {error.name}"
            right = "run in its folder, or name that in PYTHONPATH"
            raise InputError(self.where, what, right) from None
        except (Exception, SystemExit) as error:
            raise self._broken("cannot be imported", error) from None
        found: object = getattr(module, attribute, None)
        if not callable(found):
            raise InputError(self.where, f"{module_name} has no function {attribute}", self.right)
        return found

    def called(self, function: Callable[[Any], object], given: object, kind: type[T]) -> T:
        """What the function returns for what it is given.

        Raises:
            ExecutiveError: if it raises, or returns something of another kind.
        """
        try:
            made = function(given)
        except ExecutiveError:
            raise
        except (Exception, SystemExit) as error:
            raise self._broken("cannot be built", error) from None
        if not isinstance(made, kind):
            raise InputError(self.where, f"returned a {type(made).__name__}", self.right)
        return made

    def _file(self, name: str, attribute: str) -> InputError:
        module = Path(name).stem
        return InputError(
            self.where, f"{name} is a file, not a module", f"leave out {FILE}: {module}:{attribute}"
        )

    def _broken(self, what: str, error: BaseException) -> InputError:
        log.debug("raised by code of somebody's own", exc_info=error)
        return InputError(self.where, f"{what}: {in_words(error)}", "-vv says where")
