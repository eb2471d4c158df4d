# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
'''One frame: edges in, fields out. Times are sample numbers.'''

from . import crc

# Kinds of fields; the indices are those of the annotations in pd.py.
BIT, FRAMING, CDS, DATA, FLAG, CRC, REST, CDM = range(8)


class Word:
    '''What one encoder sends.'''

    def __init__(self, data_bits, flag_bits, polynomial, start):
        self.data_bits, self.flag_bits = data_bits, flag_bits
        self.polynomial, self.start = polynomial, start

    def length(self):
        return self.data_bits + crc.width(self.polynomial)


class Field:
    def __init__(self, begin, end, kind, texts):
        self.begin, self.end, self.kind, self.texts = begin, end, kind, texts


class Frame:
    def __init__(self, begin, sl):
        self.begin = begin    # first falling edge of MA
        self.last_ma = begin  # last edge of MA
        self.ma = 0
        self.rising = []
        self.first_sl = sl
        self.sl = []          # (sample, level)

    # --- taking edges -----------------------------------------------------------------------

    def ma_edge(self, sample, level):
        self.last_ma, self.ma = sample, level
        if level:
            self.rising.append(sample)

    def sl_edge(self, sample, level):
        self.sl.append((sample, level))

    def period(self):
        '''Of MA in samples; None before the second rising edge.'''
        if len(self.rising) < 2:
            return None
        # The shortest of the first periods, because a master may pause.
        return min(b - a for a, b in zip(self.rising[:4], self.rising[1:5]))

    # --- looking at them ---------------------------------------------------------------------

    def level(self, sample):
        level = self.first_sl
        for when, new in self.sl:
            if when > sample:
                break
            level = new
        return level

    def acknowledge(self):
        '''Sample at which SL falls after the second rising edge; None if it does not.'''
        if len(self.rising) < 2:
            return None
        for when, level in self.sl:
            if when >= self.rising[1] and not level:
                return when
        return None

    def nominal(self, index):
        '''Where bit `index` of SL would begin on a line without delay. Bit 0 is the acknowledge.'''
        if index + 1 < len(self.rising):
            return self.rising[index + 1]
        return self.rising[-1] + (index + 2 - len(self.rising)) * self.period()

    def bit(self, index, delay):
        '''(begin, end, level) of a bit: it is read in its middle.'''
        begin, end = self.nominal(index) + delay, self.nominal(index + 1) + delay
        return begin, end, self.level((begin + end) // 2)


class Decoded:
    '''Fields, words and complaints of a frame.'''

    def __init__(self, frame, words, inverted):
        self.frame, self.words_wanted, self.inverted = frame, words, inverted
        self.fields, self.warnings, self.words = [], [], []
        self.cds, self.cdm = None, 1 - frame.ma
        self.complete = False
        self.end = frame.last_ma
        self.index = 0
        ack = frame.acknowledge()
        if ack is None:
            self.warn('no acknowledge')
            return
        self.delay = ack - frame.rising[1]
        if self.find_start():
            for number, word in enumerate(words, 1):
                self.take_word(number, word)
            self.complete = True

    def warn(self, text):
        self.warnings.append((self.frame.begin, self.frame.last_ma, text))

    def take(self, count):
        '''(begin, end, bits) of the next bits.'''
        first = self.frame.bit(self.index, self.delay)[0]
        bits, end = [], first
        for _ in range(count):
            begin, end, level = self.frame.bit(self.index, self.delay)
            self.fields.append(Field(begin, end, BIT, [str(level)]))
            bits.append(level)
            self.index += 1
        self.end = end
        return first, end, bits

    def find_start(self):
        limit = self.frame.last_ma + self.delay
        index = 0
        while not self.frame.bit(index, self.delay)[2]:
            index += 1
            if self.frame.bit(index, self.delay)[0] > limit:
                self.warn('no start bit')
                return False
        begin, end, _ = self.take(index)
        busy = f', processing {index - 1} clocks' if index > 1 else ''
        self.fields.append(Field(begin, end, FRAMING, ['Acknowledge' + busy, 'Ack', 'A']))
        begin, end, _ = self.take(1)
        self.fields.append(Field(begin, end, FRAMING, ['Start bit', 'Start', 'S']))
        begin, end, bits = self.take(1)
        self.cds = bits[0]
        self.fields.append(Field(begin, end, CDS, [f'CDS: {bits[0]}', f'CDS {bits[0]}', 'C']))
        return True

    def take_word(self, number, word):
        who = f'{number}: ' if len(self.words_wanted) > 1 else ''
        position_bits = word.data_bits - word.flag_bits
        begin, end, bits = self.take(position_bits)
        if position_bits:
            value = f'0x{crc.number(bits):0{(position_bits + 3) // 4}X}'
            self.fields.append(Field(begin, end, DATA, [f'{who}Position: {value}', value]))
        names = ['Error', 'Warning'] if word.flag_bits == 2 else \
            [f'Flag {i}' for i in reversed(range(word.flag_bits))]
        for name in names:
            begin, end, flag = self.take(1)
            bits += flag
            # Both are active low.
            active = ' (active)' if word.flag_bits == 2 and not flag[0] else ''
            self.fields.append(Field(begin, end, FLAG,
                                     [f'{who}n{name}: {flag[0]}{active}' if word.flag_bits == 2
                                      else f'{who}{name}: {flag[0]}', name[0]]))
        self.words.append(crc.number(bits))
        size = crc.width(word.polynomial)
        if size == 0:
            return
        begin, end, line = self.take(size)
        mask = (1 << size) - 1 if self.inverted else 0
        value = f'0x{crc.number(line) ^ mask:0{(size + 3) // 4}X}'
        if crc.fits(bits, line, word.polynomial, word.start, self.inverted):
            self.fields.append(Field(begin, end, CRC, [f'{who}CRC: {value} (good)', value]))
        else:
            expected = crc.compute(bits, word.polynomial, word.start)
            self.fields.append(Field(begin, end, CRC, [f'{who}CRC: {value} (wrong)', value]))
            self.warnings.append((begin, end, f'{who}CRC error: {value} instead of '
                                  f'0x{expected:0{(size + 3) // 4}X}'))


def data_end(frame, words):
    '''Sample after the last bit of the data as far as it is known; None before the start bit.'''
    ack = frame.acknowledge()
    if ack is None:
        return None
    delay, index = ack - frame.rising[1], 0
    limit = frame.last_ma + delay
    while not frame.bit(index, delay)[2]:
        index += 1
        if frame.bit(index, delay)[0] > limit:
            return None
    return frame.nominal(index + 2 + sum(word.length() for word in words)) + delay
