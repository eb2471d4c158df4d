# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
'''
HIPERFACE DSL (a trademark of SICK; this project is not connected with SICK or TI) joins a drive and
the encoder of a motor by two wires, on which both talk in turn at 9.375 Mbit/s.

The decoder needs the level of the line as a receiver near the drive sees it. It finds the frames,
learns from the training where the answers begin, and shows the state of the link, the words of each
answer, the second difference of the position, the safe positions and the messages of both ends, and
checks the line code, CRC5 and CRC16. In a recording without a start of the link it finds the answers by their words, from the
second frame on. With the enable of the drive's transmitter it also shows who drives.
'''

from .pd import Decoder
