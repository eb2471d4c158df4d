# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The shared library beside this file, declared by the C headers beside it."""

import difflib
import re
from pathlib import Path
from typing import Any, Iterable, Optional, Union

import cffi

from .codes import Code, SimulatorCode
from .reading import Reading

HERE = Path(__file__).parent


class Error(Exception):
    """A call that failed; its text names the call, the place and what would be right.

    code     the C name of the error, such as "MB4SIM_ERROR_HOST" or "MB4_CRC"; "" where the C
             interface has none
    number   the same as Code.CRC or SimulatorCode.HOST; None where there is none
    reading  what the slave has sent, where a read of one slave is Code.SLAVE_ERROR; otherwise None
    """

    def __init__(self, message: str, code: str = ""):
        super().__init__(message)
        self.code = code
        self.reading: Optional[Reading] = None

    @property
    def number(self) -> Union[Code, SimulatorCode, None]:
        """The error as Code or SimulatorCode; None where the C interface has no number for it."""
        if self.code.startswith("MB4SIM_ERROR_"):
            return SimulatorCode[self.code[len("MB4SIM_ERROR_"):]]
        return Code[self.code[len("MB4_"):]] if self.code else None


class NameMistake(Error, AttributeError):
    """An attribute that is not there, or is not assigned."""


class RangeMistake(Error, OverflowError):
    """A number that does not fit its C type."""


def similar(name: str, names: Iterable[str]) -> str:
    """The end of a message about an unknown name: those that look like it, or nothing."""
    by_upper = {one.upper(): one for one in names}
    found = [by_upper[one] for one in difflib.get_close_matches(name.upper(), by_upper, 3, 0.6)]
    return f"; did you mean {' or '.join(found)}?" if found else ""


def _declarations(name: str) -> str:
    text = (HERE / name).read_text(encoding="utf-8")
    text = re.sub(r"#ifdef __cplusplus.*?#endif", "", text, flags=re.S)
    text = re.sub(r"^#.*|\bMB4SIM_API\b", "", text, flags=re.M)
    return text.replace("MB4_RESULT ", "mb4_result ")


_headers = [_declarations(name) for name in ("mb4sim.h", "mb4_types.h", "mb4.h", "openmb4_session.h")]
ffi = cffi.FFI()
ffi.cdef("\n".join(_headers))
lib: Any = ffi.dlopen(str(HERE / "libopenmb4.so"))

# The comments of mb4sim.h: {number: text}.
_SIMULATOR_ERRORS = {
    int(number): re.sub(r"\s+", " ", text) for number, text in
    re.findall(r"MB4SIM_ERROR_\w+ = (-\d+),?\s*/\*\s*(.*?)\s*\*/", _headers[0], re.S)}


def simulator_error(code: int, what: str = "", text: str = "") -> Error:
    """From a negative result: `text` instead of the words of mb4sim.h."""
    text = text or _SIMULATOR_ERRORS[code]
    return Error(f"{what}: {text}" if what else text, f"MB4SIM_ERROR_{SimulatorCode(code).name}")


def driver_error(result: Any, what: str = "", right: str = "") -> Error:
    """From mb4_result: what `mb4sim` says too, behind the call, and what would be right."""
    text = ffi.string(lib.mb4_error_text(result.code)).decode()
    if result.field:
        text += f": {ffi.string(lib.mb4_field_text(result.field)).decode()}"
    if result.number:
        text += f" of {result.number}"
    if result.code == lib.MB4_VERIFY:
        text += f" at register 0x{result.detail:02X}"
    text = f"{what}: {text}" if what else text
    return Error(f"{text}: {right}" if right else text, f"MB4_{Code(result.code).name}")


def field_name(result: Any) -> str:
    """The member of the configuration that an mb4_result names."""
    return str(ffi.string(lib.mb4_field_text(result.field)).decode())


def version() -> str:
    """Version of the library."""
    return str(ffi.string(lib.mb4sim_version()).decode())
