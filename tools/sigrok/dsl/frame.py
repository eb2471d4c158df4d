# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
'''Frames of DSL from the edges of the line. The line is the sum of both directions, as a probe
sees it near the master: the frame's bits are the master's, and the answer comes some bits late.

Times are in any unit. The training shows where the answers begin; where a recording has none, it is
where two frames in a row have legal words and a right CRC5.'''

import cmath

from .code import WORDS, crc16, crc5, parameter

BITS = 108
EDGE = 8             # bit where SAMPLE falls
SAMPLE_ONES = 4      # before it, the last two of SYNC and those of SAMPLE
PARAMETER = 16       # first bit of M_PAR
SWITCH = 26
TRAILER = 100
ANSWER = 61
NEAR = 0.75          # bits that a driver may be away from its place
LATEST = 11          # bits that an answer can be late
PATTERN = '0100110011' '0010000001' '0001010111' '0111111011' '0011001101' '0' '0010011001'
SYMBOLS = {0x10: 'IDLE', 0x19: 'SYNC', 0x1A: 'START', 0x1B: 'LEARN', 0x1C: 'CHECK', 0x1D: 'ID REQ',
           0x1E: 'INIT', 0x1F: 'RESET'}
SIX_K28_NEGATIVE = '110000'
TRAINING = ('START', 'LEARN', 'CHECK')
# Fields of an answer: name, first bit, special characters that may stand there.
FIELDS = (('vertical', 0, (0xFD,)), ('s_par', 10, ()), ('pipeline', 20, ()),
          ('acceleration high', 30, (0xFD,)), ('acceleration low', 40, (0xFD,)),
          ('secondary', 51, (0xFB,)))


class Frame:
    '''What is known of a frame: its begin, the length of a bit, the symbol of the master, and of the
    answer its begin, its bits, and its words as (byte, special); byte is None if a word is illegal.'''

    def __init__(self, begin, bit, byte, extra=0):
        self.begin, self.bit, self.byte = begin, bit, byte
        # Ones more in SAMPLE, of a drive that sends as many frames as its own cycle needs. `begin` is where
        # the frame would begin without them; so at() is right from SAMPLE's edge on.
        self.extra = extra
        self.symbol = 'illegal' if byte is None else SYMBOLS.get(byte & 0x1F, f'nibble {byte & 15:X}')
        self.answer_at = None
        self.answer = None
        self.words = {}
        self.acceleration = None   # None: there is none
        self.pattern = None        # of a training frame: as it has to be
        self.off = self.on = None  # times of the master's driver, if they are known
        self.vertical = None       # the frame ends a vertical frame: bytes, good
        self.secondary = None

    def at(self, bit):
        return self.begin + bit * self.bit

    def driver_mistake(self):
        '''What is wrong with the master's driver, if its times are known; else None.'''
        if self.off is None and self.on is None:
            return None
        if self.symbol in ('RESET', 'SYNC'):
            return 'The master does not fill the window'
        for time, bit in ((self.off, SWITCH), (self.on, TRAILER)):
            if time is None or abs(time - self.at(bit)) > NEAR * self.bit:
                return 'The window is not where it should be'
        return None

    def identity(self):
        '''What the answer to ID REQ says, as text; None if its two copies differ.'''
        vertical, s_par, pipeline, high, low = (self.words[name][0] for name, _, _ in FIELDS[:5])
        if None in (vertical, s_par, pipeline, high, low) or (vertical, s_par) != (low, high) or \
                pipeline >> 4 != pipeline & 15:
            return None
        acceleration = 8 + (vertical & 15)
        position = acceleration + ((s_par << 8 | vertical) >> 4 & 0x3F)
        return f'position {position} bits, {"signed" if s_par & 4 else "unsigned"}, ' \
            f'second difference {acceleration} bits, index {s_par >> 4}'

    def is_legal(self):
        return self.acceleration is not None and all(byte is not None for byte, _ in self.words.values())


def as_data(word, byte):
    '''K28.1, K28.2, K28.5 and K28.6 after 110000 as a table of data reads them: a single wrong bit of
    D7 makes such a word, and CRC5 would not see it.'''
    return byte ^ 0xE0 if word.startswith(SIX_K28_NEGATIVE) and byte >> 5 in (1, 2, 5, 6) else byte


def read_words(frame):
    for name, first, _ in FIELDS:
        word = int(frame.answer[first:first + 10], 2)
        frame.words[name] = WORDS.get(word, (None, False))
    (high, special_high), (low, special_low) = (frame.words[f'acceleration {half}']
                                                for half in ('high', 'low'))
    for byte, special in ((high, special_high), (low, special_low)):
        if byte is None or special and byte & 0x1F != 28:
            return
    high, low = (as_data(frame.answer[first:first + 10], byte) for first, byte in ((30, high), (40, low)))
    word = high << 8 | low
    if crc5(word >> 5) == word & 0x1F:
        frame.acceleration = (word >> 5) - (2048 if word >> 15 else 0)


class Line:
    '''Takes edges, (time, new level), and gives frames.

    `nominal`: length of a bit.'''

    def __init__(self, nominal):
        self.nominal = nominal
        self.edges = []       # of the running frame, from its edge in SAMPLE on
        self.drives = []      # the same of the master's driver
        self.runs = []        # lengths of the last runs
        self.last = None
        self.sample = None    # time of the edge in SAMPLE of the running frame
        self.extra = 0        # Frame.extra of it
        self.delay = None     # of the answer, from the end of SWITCH
        self.guess = None     # ... as the last frame would have it
        self.place = None     # in the vertical frame
        self.bytes = [[], []]

    def edge(self, time, level):
        '''Returns the frame that ends with this edge, or None.'''
        done = None
        if self.last is not None:
            bits = (time - self.last) / self.nominal
            self.runs = [*self.runs[-3:], int(bits + 0.5)]
        # 00 1 0 11 and the ones of SAMPLE before a falling edge, not within a frame.
        if not level and self.is_sync() and (
                self.sample is None or time > self.sample + (BITS - EDGE - 2) * self.nominal):
            done = self.flush(time)
            self.sample = time
            self.extra = max(round(8 * bits) / 8 - SAMPLE_ONES, 0) if bits >= SAMPLE_ONES + 0.5 else 0
            self.edges, self.drives = [], []
        self.last = time
        self.edges.append((time, level))
        return done

    def driver(self, time, level):
        '''An edge of the master's driver, for a recording that has it.'''
        self.drives.append((time, level))

    def is_sync(self):
        return len(self.runs) == 4 and self.runs[0] >= 2 and self.runs[1] == 1 == self.runs[2] \
            and self.runs[3] >= 4

    def levels(self, times):
        '''The level at each of some rising times.'''
        found, next_edge, level = [], 0, 0
        for time in times:
            while next_edge < len(self.edges) and self.edges[next_edge][0] <= time:
                level = self.edges[next_edge][1]
                next_edge += 1
            found.append('01'[level])
        return ''.join(found)

    def flush(self, time):
        '''The frame that is known, if it is whole.'''
        if self.sample is None or time < self.sample + (BITS - EDGE - 1) * self.nominal:
            return None
        bit = self.nominal
        begin = self.sample - EDGE * bit
        word = self.levels(begin + (PARAMETER + i + 0.5) * bit for i in range(10))
        frame = Frame(begin, bit, parameter(int(word, 2)), self.extra)
        frame.off = next((time for time, level in self.drives if not level), None)
        frame.on = next((time for time, level in self.drives if level), None)
        if frame.symbol in ('RESET', 'SYNC'):
            self.delay = self.guess = self.place = None
            return frame
        self.find_answer(frame)
        if self.delay is None and frame.symbol not in TRAINING and frame.symbol != 'ID REQ':
            self.search(frame)
        if frame.answer is None:
            return frame
        if frame.symbol in TRAINING:
            frame.pattern = frame.answer == PATTERN
        else:
            read_words(frame)
            if frame.symbol != 'ID REQ':
                self.take_bytes(frame)
        return frame

    def find_answer(self, frame):
        '''A training frame shows where the answer begins: its pattern begins with 0.'''
        begin = frame.at(SWITCH + 1)
        if frame.symbol in TRAINING:
            falls = [time for time, level in self.edges
                     if not level and frame.at(SWITCH + 0.5) < time < begin + LATEST * frame.bit]
            if falls:
                # The mean of all edges, from the first one on.
                near = [time for time, _ in self.edges
                        if falls[0] <= time < falls[0] + (ANSWER - 0.5) * frame.bit]
                away = [((time - falls[0]) / frame.bit + 0.5) % 1 - 0.5 for time in near]
                self.delay = falls[0] + frame.bit * sum(away) / len(away) - begin
        if self.delay is None:
            return
        frame.answer_at = begin + self.delay
        frame.answer = self.levels(frame.answer_at + (i + 0.5) * frame.bit for i in range(ANSWER))

    def search(self, frame):
        '''The answer's place without a training: all edges but the first have one phase.'''
        window = [time for time, _ in self.edges if frame.at(SWITCH + 1) <= time < frame.at(TRAILER - 0.5)]
        if len(window) < 8:
            self.guess = None
            return
        turns = sum(cmath.exp(2j * cmath.pi * (time - frame.begin) / frame.bit) for time in window)
        phase = cmath.phase(turns) / (2 * cmath.pi) % 1
        fits = []
        for late in range(LATEST + 1):
            trial = Frame(frame.begin, frame.bit, frame.byte)
            trial.answer_at = frame.at(SWITCH + 1 + late + phase)
            trial.answer = self.levels(trial.answer_at + (i + 0.5) * frame.bit for i in range(ANSWER))
            read_words(trial)
            if trial.is_legal():
                fits.append(trial)
        guess, self.guess = self.guess, None
        if len(fits) == 1:
            self.guess = fits[0].answer_at - frame.at(SWITCH + 1)
        if guess is not None and self.guess is not None and abs(guess - self.guess) < frame.bit / 4:
            self.delay = self.guess
            frame.answer_at, frame.answer = fits[0].answer_at, fits[0].answer

    def take_bytes(self, frame):
        '''VSYNC stands in the last frame of a vertical frame.'''
        s_par, _ = frame.words['s_par']
        if self.place is not None:
            for channel, name in ((0, 'vertical'), (1, 'secondary')):
                self.bytes[channel].append(frame.words[name])
            self.place += 1
            if self.place == 8:
                frame.vertical, frame.secondary = (self.close(channel) for channel in (0, 1))
                self.place = 0
        elif s_par is not None and s_par & 0x80:
            self.place = 0
            self.bytes = [[], []]

    def close(self, channel):
        words, self.bytes[channel] = self.bytes[channel], []
        data = [byte for byte, _ in words]
        special = any(flag and byte & 0x1F != 28 for byte, flag in words if byte is not None)
        good = None not in data and not special and \
            crc16(data[:6]) == data[6] << 8 | data[7]
        return data, good
