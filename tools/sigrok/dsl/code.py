# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
'''The line code of DSL and its check sums, from the rules of 8b/10b. A word has ten bits, its
first one is the highest.'''

# The blocks that a negative disparity takes.
SIX = ('100111 011101 101101 110001 110101 101001 011001 111000 111001 100101 010101 110100 001101 '
       '101100 011100 010111 011011 100011 010011 110010 001011 101010 011010 111010 110011 100110 '
       '010110 110110 001110 101110 011110 101011').split()
FOUR = '1011 1001 0101 1100 1101 1010 0110 1110'.split()
SIX_K28 = '001111'
FOUR_K28 = '1011 0110 1010 1100 1101 0101 1001 0111'.split()
FOUR_SECOND = '0111'  # of x.7, where five equal bits would stand in a row, and of special characters


def inverted(block):
    return block.translate(str.maketrans('01', '10'))


def form(block, positive, pair=False):
    '''The form of a block at a disparity, and the disparity after it.'''
    uneven = 2 * block.count('1') != len(block)
    return inverted(block) if positive and (uneven or pair) else block, positive != uneven


def make_words():
    words = {}
    for start in (False, True):
        for x in range(32):
            six, after = form(SIX[x], start, x == 7)
            for y in range(8):
                second = y == 7 and six.endswith('00' if after else '11')
                four, _ = form(FOUR_SECOND if second else FOUR[y], after, y == 3)
                words[six + four] = (y << 5 | x, False)
            if x in (23, 27, 29, 30):
                four, _ = form(FOUR_SECOND, after, True)
                words[six + four] = (7 << 5 | x, True)
        six, after = form(SIX_K28, start)
        for y in range(8):
            four, _ = form(FOUR_K28[y], after, True)
            words[six + four] = (y << 5 | 28, True)
    return {int(word, 2): value for word, value in words.items()}


WORDS = make_words()  # word: byte, special character


def parameter(word):
    '''The byte of a word in M_PAR, whose disparity the equaliser has changed; None if it is none.'''
    six, four = f'{word:010b}'[:6], f'{word:010b}'[6:]
    for x in range(32):
        if six in (SIX[x], form(SIX[x], True, x == 7)[0]) or \
                x == 28 and six in (SIX_K28, inverted(SIX_K28)):
            for y in range(8):
                if four in (FOUR[y], form(FOUR[y], True, y == 3)[0]):
                    return y << 5 | x
    return None


def remainder(value, bits, polynomial, degree):
    rest = 0
    for i in reversed(range(bits)):
        rest ^= (value >> i & 1) << (degree - 1)
        rest = (rest << 1) ^ (polynomial if rest >> (degree - 1) & 1 else 0)
        rest &= (1 << degree) - 1
    return rest


def crc16(data):
    return remainder(int.from_bytes(bytes(data), 'big'), 8 * len(data), 0x90D9, 16) ^ 0x00FF


def crc5(value):
    return remainder(value, 11, 0x05, 5) ^ 0x1F
