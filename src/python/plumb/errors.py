# SPDX-License-Identifier: MIT
"""What the program refuses, as exceptions."""

from dataclasses import dataclass
from typing import Optional


@dataclass(frozen=True)
class Diagnostic:
    """One thing that is wrong. Lines and columns count from 1; None: it has no place."""

    message: str
    file: Optional[str] = None
    line: Optional[int] = None
    column: Optional[int] = None
    severity: str = "error"
    suggestion: Optional[str] = None

    def __str__(self):
        place = "" if self.file is None else f"{self.file}: "
        if self.file is not None and self.line is not None:
            place = f"{self.file}:{self.line}:{self.column}: "
        way_out = f"; {self.suggestion}" if self.suggestion else ""
        return f"{place}{self.severity}: {self.message}{way_out}"


class Error(Exception):
    """The program could not do it. `diagnostics` has everything that is wrong; the attributes are those of the first error."""

    def __init__(self, diagnostics):
        self.diagnostics = list(diagnostics)
        super().__init__("\n".join(str(one) for one in self.diagnostics))

    @property
    def _first(self):
        errors = [one for one in self.diagnostics if one.severity == "error"]
        return (errors or self.diagnostics or [Diagnostic("unknown")])[0]

    @property
    def file(self):
        return self._first.file

    @property
    def line(self):
        return self._first.line

    @property
    def column(self):
        return self._first.column

    @property
    def message(self):
        return self._first.message

    @property
    def suggestion(self):
        return self._first.suggestion


class UsageError(Error):
    """A setting that does not exist, or a value that it cannot have."""
