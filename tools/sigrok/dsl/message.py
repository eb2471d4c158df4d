# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
'''Messages of DSL: runs of nibbles, one in each frame and direction, a CRC16 at their end. The highest
bit of a message is 0 for a short and 1 for a long one. An IDLE may part a long answer where a short
request is open.'''

from .code import crc16

NIBBLE = 0x10  # symbols below it
IDLE = 0x10
INIT = 0x1E
NAMES = {0x15: 'Short NAK', 0x1A: 'Long NAK', 0x1F: 'INIT'}  # of the encoder
LENGTHS = (0, 2, 4, 8)
LONG, READ, OFFSET, INDIRECT = 0x80, 0x40, 0x20, 0x10


class Message:
    '''Its bytes without the CRC, the frames of its first and its last nibble, and whether it is whole
    and its CRC right.'''

    def __init__(self, nibbles, answer, first, last, whole):
        self.first, self.last, self.answer = first, last, answer
        data = bytes(high << 4 | low for high, low in zip(nibbles[::2], nibbles[1::2]))
        self.whole = whole
        self.good = whole and crc16(data[:-2]) == data[-2] << 8 | data[-1]
        self.data = data[:-2] if whole else data

    def text(self):
        if not self.whole:
            return 'cut short'
        head, rest = self.data[0], self.data[1:]
        if not head & LONG:
            name = f'{0x40 | head & 0x3F:02X}h'
            if self.answer:
                return f'{name} is {rest[0]:02X}' if head & READ else f'{name} written'
            return f'read {name}' if head & READ else f'write {name} = {rest[0]:02X}'
        name, rest = f'{(head & 3) << 8 | rest[0]:03X}h', rest[1:]
        if head & INDIRECT:
            name += ' value'
        if self.answer:
            if head & OFFSET:
                return f'{name}: error ' + '/'.join(f'{byte:02X}' for byte in reversed(rest))
            return f'{name}: {rest.hex(" ").upper()}' if rest else f'{name}: done'
        if head & OFFSET:
            name += f' offset {(rest[0] & 0x7F) << 8 | rest[1]}'
            rest = rest[2:]
        if head & READ:
            return f'read {name}, {LENGTHS[head >> 2 & 3]} bytes'
        return f'write {name}: {rest.hex(" ").upper()}' if rest else f'write {name}'


class Run:
    '''The nibbles of a message of one direction that comes.'''

    def __init__(self, answer):
        self.answer = answer
        self.clear()

    def clear(self):
        self.nibbles, self.first, self.last = [], None, None

    def add(self, nibble, frame):
        '''Returns the message that ends with this nibble, or None.'''
        self.first = self.first or frame
        self.last = frame
        self.nibbles.append(nibble)
        return self.close(True) if len(self.nibbles) == self.size() else None

    def size(self):
        if len(self.nibbles) < 2:
            return None
        head = self.nibbles[0] << 4 | self.nibbles[1]
        read = bool(head & READ)
        if not head & LONG:
            return 8 if read == self.answer else 6
        data = 2 * LENGTHS[head >> 2 & 3]
        if self.answer:
            return 8 + data
        return 8 + 4 * bool(head & OFFSET) + (0 if read else data)

    def close(self, whole):
        message = Message(self.nibbles, self.answer, self.first, self.last, whole)
        self.clear()
        return message


class Talk:
    '''Takes frames and gives the messages that end with them.'''

    def __init__(self):
        self.request = Run(False)
        self.answers = {False: Run(True), True: Run(True)}  # short, long
        self.clear()

    def clear(self):
        self.request.clear()
        for run in self.answers.values():
            run.clear()
        self.running = None    # True: a long answer, False: a short one
        self.paused = False    # a long answer
        self.open = False      # a short request has no answer
        self.ignored = {False: False, True: False}  # by direction, up to a symbol that is no nibble

    def take(self, frame):
        '''A frame behind the training.'''
        sent = None if frame.byte is None else frame.byte & 0x1F
        found = self.take_request(frame, sent)
        if sent == INIT:
            self.clear()
            return found
        byte, special = frame.words.get('s_par', (None, False))
        return found + self.take_answer(frame, None if byte is None or special else byte & 0x1F)

    def take_request(self, frame, symbol):
        if symbol is None or symbol >= NIBBLE:
            self.ignored[False] = False
            return [self.request.close(False)] if self.request.nibbles else []
        if self.ignored[False]:
            return []
        message = self.request.add(symbol, frame)
        if message is None:
            return []
        self.ignored[False] = True
        if message.good and not message.data[0] & LONG:
            self.open = True
        return [message]

    def take_answer(self, frame, symbol):
        if symbol is None or symbol >= NIBBLE:
            self.ignored[True] = False
            running, self.running = self.running, None
            if running is None:
                return []
            if running and symbol == IDLE and self.open:
                self.paused = True
                return []
            return [self.answers[running].close(False)]
        if self.ignored[True]:
            return []
        if self.running is None:
            goes_on = self.paused and (symbol >= 8 or not self.open)
            self.running = goes_on or symbol >= 8
            self.paused = self.paused and not goes_on
        message = self.answers[self.running].add(symbol, frame)
        if message is None:
            return []
        if not self.running and message.good:
            self.open = False
        self.running = None
        self.ignored[True] = True
        return [message]
