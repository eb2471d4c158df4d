# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
'''
BiSS C is a serial interface between drives and position encoders. The master clocks the encoders
over MA; SL brings acknowledge, start bit, the CDS bit and, of each encoder of the chain, position,
error and warning bit and an inverted CRC. The level of MA after the frame is the inverted CDM bit:
CDM and CDS bits of many frames make up control frames, which access registers of the encoders and
carry commands.

The decoder needs the lengths and CRCs of the encoders' data (they are not on the line), finds the
line's delay by itself, checks every CRC and assembles control frames.
'''

from .pd import Decoder
