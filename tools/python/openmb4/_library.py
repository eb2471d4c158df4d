# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The shared library beside this file, declared by the C headers beside it."""

import re
from pathlib import Path
from typing import Any

import cffi

HERE = Path(__file__).parent


class Error(Exception):
    """A call that failed. `code` is the C name of the error, such as "MB4SIM_ERROR_HOST" or
    "MB4_CRC"; "" where the C interface has none. `reading`: what the slave has sent, where a read
    of one slave is "MB4_SLAVE_ERROR"; otherwise None."""

    def __init__(self, message: str, code: str = ""):
        super().__init__(message)
        self.code = code
        self.reading: Any = None


def _declarations(name: str) -> str:
    text = (HERE / name).read_text(encoding="utf-8")
    text = re.sub(r"#ifdef __cplusplus.*?#endif", "", text, flags=re.S)
    text = re.sub(r"^#.*|\bMB4SIM_API\b", "", text, flags=re.M)
    return text.replace("MB4_RESULT ", "mb4_result ")


_headers = [_declarations(name) for name in ("mb4sim.h", "mb4.h", "openmb4_session.h")]
ffi = cffi.FFI()
ffi.cdef("\n".join(_headers))
lib: Any = ffi.dlopen(str(HERE / "libopenmb4.so"))

# The words of mb4sim.h: {number: (name, comment)}.
_SIMULATOR_ERRORS = {
    int(number): (name, re.sub(r"\s+", " ", text)) for name, number, text in
    re.findall(r"(MB4SIM_ERROR_\w+) = (-\d+),?\s*/\*\s*(.*?)\s*\*/", _headers[0], re.S)}
_DRIVER_ERRORS = {
    int(number): name for name, number in
    re.findall(r"(MB4_\w+) = (\d+)", re.search(r"enum \{\s*MB4_OK.*?\}", _headers[1], re.S)[0])}


def simulator_error(code: int, what: str = "") -> Error:
    name, text = _SIMULATOR_ERRORS[code]
    return Error(f"{what}: {text}" if what else text, name)


def driver_error(result: Any) -> Error:
    """From mb4_result: what `mb4sim` says too."""
    text = ffi.string(lib.mb4_error_text(result.code)).decode()
    if result.field:
        text += f": {ffi.string(lib.mb4_field_text(result.field)).decode()}"
    if result.number:
        text += f" of {result.number}"
    if result.code == lib.MB4_VERIFY:
        text += f" at register 0x{result.detail:02X}"
    return Error(text, _DRIVER_ERRORS[result.code])


def version() -> str:
    return ffi.string(lib.mb4sim_version()).decode()
