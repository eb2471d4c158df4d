# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
'''CRC of BiSS: bits go in MSB first, the start value is loaded directly.'''

CONTROL = (0x13, 4)  # polynomial and width of control data


def width(polynomial):
    '''Bits of the CRC of a full polynomial (0x43: 6); 0 for 0.'''
    return max(polynomial.bit_length() - 1, 0)


def compute(bits, polynomial, start=0):
    '''CRC of a list of bits, not inverted.'''
    size = width(polynomial)
    if size == 0:
        return 0
    mask = (1 << size) - 1
    register = start & mask
    for bit in bits:
        feedback = bit ^ (register >> (size - 1))
        register = (register << 1) & mask
        if feedback:
            register ^= polynomial & mask
    return register


def number(bits):
    '''A list of bits, MSB first, as a number.'''
    value = 0
    for bit in bits:
        value = value << 1 | bit
    return value


def fits(bits, line, polynomial, start=0, inverted=True):
    '''Whether the bits `line` are the CRC of `bits`.'''
    mask = (1 << width(polynomial)) - 1
    return number(line) ^ (mask if inverted else 0) == compute(bits, polynomial, start)
