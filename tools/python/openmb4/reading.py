# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""What slaves have sent."""

from typing import Any, NamedTuple


class _Reading(NamedTuple):
    raw: int
    position: int
    crc: int
    crc_stored: bool
    slave_error: bool
    slave_warning: bool
    slave: int


class Reading(_Reading):
    """What a slave has sent: mb4_reading of mb4.h.

    raw            all data bits
    position       the data bits without flags
    crc            not inverted; 0 unless crc_stored
    crc_stored     the chip has stored the CRC that came
    slave_error    nE is 0: the encoder says that its position is not to be trusted
    slave_warning  nW is 0
    slave          1 to 8
    """

    __slots__ = ()

    def __getattr__(self, name: str) -> Any:
        if name in ("error", "warning"):
            raise AttributeError(f"'{name}' of a Reading is called 'slave_{name}'")
        raise AttributeError(f"a Reading has no '{name}'")


class Identity(NamedTuple):
    """What one ID of a bus has answered: mb4_identity of mb4.h."""

    device_id: bytes
    manufacturer: bytes
    eds_bank: int
    has_identity: bool
    has_eds: bool
