"""Loads code of users by name: `package.module:function` on the command line.

An exception of their code becomes one sentence; `-vv` shows the traceback.
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
    """The name of a function as given to an option; `right` says what it should be."""

    option: str
    name: str
    right: str

    @property
    def where(self) -> str:
        """The option and name, for error messages."""
        return f"{self.option} {self.name}"

    def imported(self) -> Callable[[Any], object]:
        """Import the function, or other callable, of this name.

        Raises:
            InputError: if it does not exist, or its module cannot be imported.
        """
        module_name, _, attribute = self.name.partition(":")
        here = str(Path.cwd())
        if here not in sys.path:
            sys.path.append(here)  # a console script does not import from the current folder
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
        """Call the function with `given`; return its result, which must be a `kind`.

        Raises:
            ExecutiveError: if it raises, or returns something of another type.
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
