"""What goes wrong, as exceptions by whose fault it is."""

import typing


class Finding(typing.NamedTuple):
    """A decision, warning or error, addressed to who owns the file."""

    severity: str  # "info", "warning", "error"
    status: str  # "OK" unless it is an error
    stage: str
    file: typing.Optional[str]
    line: int  # from 1, 0 none
    face: int  # from 0, -1 none
    vertex: int  # from 0, -1 none
    count: int  # findings like this
    message: str

    def __str__(self):
        place = self.file or ""
        if self.line > 0:
            place += f":{self.line}"
        return f"{place}: {self.message}" if place else self.message


class Error(Exception):
    """A call that failed.

    status    its name in the library: "FORMAT", "TOPOLOGY", ...
    finding   why, with file and line, or face and vertex
    findings  all that the call found, warnings too
    """

    status = "INTERNAL"

    def __init__(self, finding, findings=()):
        super().__init__(str(finding))
        self.finding = finding
        self.findings = list(findings)


class ArgumentError(Error, ValueError):
    """The caller's."""

    status = "ARGUMENT"


class FormatError(Error, ValueError):
    """The file's bytes."""

    status = "FORMAT"


class TopologyError(Error, ValueError):
    """The file's mesh."""

    status = "TOPOLOGY"


class LimitError(Error):
    """A stated limit would be exceeded."""

    status = "LIMIT"


class NumericError(Error, ArithmeticError):
    """A value is not finite, a solve failed."""

    status = "NUMERIC"


class FileError(Error, OSError):
    """Open, read, write, rename, disk full."""

    status = "IO"


class OutOfMemory(Error, MemoryError):
    """An allocation failed."""

    status = "MEMORY"


class Cancelled(Error):
    """Progress, or cancel(), said stop."""

    status = "CANCELLED"


class SupportError(Error):
    """Valid, and not supported."""

    status = "SUPPORT"


class ColourError(Error):
    """The colour configuration's."""

    status = "COLOUR"


class InternalError(Error):
    """Ours: a check of osdtex's own failed."""


_BY_STATUS = {kind.status: kind for kind in (
    ArgumentError, FormatError, TopologyError, LimitError, NumericError,
    FileError, OutOfMemory, Cancelled, SupportError, ColourError,
    InternalError)}


def failed(status, finding, findings):
    """The exception of a status; for the module in C."""
    return _BY_STATUS.get(status, InternalError)(finding, findings)
