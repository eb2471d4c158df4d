# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
'''Control frames: one CDM and one CDS bit from each frame in, fields and transactions out. CDS
answers the CDM of the frame before.'''

from . import crc

ZEROS = 14  # frames with CDM = 0 that must precede a control frame, and that end any

MASTER, SLAVE, TRANSACTION, WARNING = range(4)


class Slot:
    def __init__(self, begin, end, cdm, cds):
        self.begin, self.end, self.cdm, self.cds = begin, end, cdm, cds


class Aborted(Exception):
    '''14 zeros in the middle of a control frame.'''


class Control:
    '''push() takes a slot and returns what has become known: (begin, end, row, texts).'''

    def __init__(self):
        self.out = []
        self.zeros = 0
        self.slots = []      # since S
        self.counting = True
        self.transactions = []
        self.machine = self.run()
        next(self.machine)

    def push(self, slot):
        self.out = []
        self.machine.send(slot)
        return self.out

    # --- slots -------------------------------------------------------------------------------

    def next(self):
        slot = yield
        self.slots.append(slot)
        if slot.cdm:
            self.zeros = 0
        elif self.counting:
            self.zeros += 1
            if self.zeros >= ZEROS:
                raise Aborted
        return slot

    def until(self, count):
        while len(self.slots) < count:
            yield from self.next()

    def cdm(self, first, last):
        return [slot.cdm for slot in self.slots[first:last + 1]]

    def cds(self, first, last):
        return [slot.cds for slot in self.slots[first:last + 1]]

    def put(self, row, first, last, *texts):
        self.out.append((self.slots[first].begin, self.slots[last].end, row, list(texts)))

    def put_crc(self, row, first, data):
        '''Four bits of CRC of `data` at slot `first`; whether they fit.'''
        line = self.cdm(first, first + 3) if row == MASTER else self.cds(first, first + 3)
        good = crc.fits(data, line, crc.CONTROL[0])
        value = f'0x{crc.number(line) ^ 15:X}'
        self.put(row, first, first + 3, f'CRC: {value} ({"good" if good else "wrong"})', value)
        if not good:
            self.put(WARNING, first, first + 3, f'Control CRC error: {value} instead of '
                     f'0x{crc.compute(data, crc.CONTROL[0]):X}')
        return good

    def finish(self, last, text, **values):
        self.put(TRANSACTION, 0, last, text)
        self.transactions.append(dict(text=text, begin=self.slots[0].begin,
                                      end=self.slots[last].end, **values))

    # --- the protocol --------------------------------------------------------------------------

    def run(self):
        while True:
            slot = yield
            if not slot.cdm:
                self.zeros += 1
                continue
            ready, self.zeros = self.zeros >= ZEROS, 0
            if not ready:
                continue
            self.slots, self.counting = [slot], True
            self.put(MASTER, 0, 0, 'Start (S)', 'S')
            try:
                yield from self.header()
            except Aborted:
                self.put(WARNING, 0, len(self.slots) - 1, 'Control frame aborted')

    def header(self):
        yield from self.until(16)
        register = self.slots[1].cdm
        self.put(MASTER, 1, 1, f'CTS: {"register" if register else "command"}', 'CTS')
        if register:
            self.put(MASTER, 2, 4, f'ID: {crc.number(self.cdm(2, 4))}')
            address = crc.number(self.cdm(5, 11))
            self.put(MASTER, 5, 11, f'Address: 0x{address:02X}', f'0x{address:02X}')
        else:
            self.put(MASTER, 2, 9, 'IDS: ' + ids(self.cdm(2, 9), 'all'), 'IDS')
            self.put(MASTER, 10, 11, f'CMD: {crc.number(self.cdm(10, 11))}', 'CMD')
        self.put(SLAVE, 1, 8, 'IDL: ' + ids(self.cds(1, 8), 'none'), 'IDL')
        good = self.put_crc(MASTER, 12, self.cdm(1, 11))
        # After a wrong header the slaves do not answer: the following bits have no meaning.
        if good:
            yield from self.registers() if register else self.command()

    def registers(self):
        yield from self.until(18)
        read, write = self.slots[16].cdm, self.slots[17].cdm
        device, address = crc.number(self.cdm(2, 4)), crc.number(self.cdm(5, 11))
        self.put(MASTER, 16, 16, f'R: {read}', 'R')
        self.put(MASTER, 17, 17, f'W: {write}', 'W')
        self.put(SLAVE, 17, 17, f'R: {self.slots[17].cds}', 'R')
        confirmed = read != write and self.slots[17].cds == read
        if confirmed:
            yield from self.until(19)
            self.put(SLAVE, 18, 18, f'W: {self.slots[18].cds}', 'W')
            confirmed = self.slots[18].cds == write
        what = 'Read' if read else 'Write'
        if not confirmed:
            last = len(self.slots) - 1
            self.put(WARNING, 17, last, 'R and W are not confirmed')
            self.finish(last, f'{what} ID {device} 0x{address:02X}: not confirmed',
                        read=bool(read), id=device, address=address, data=[], good=False)
            return
        values, good, at = [], True, 18
        while self.slots[at].cdm:
            value, fits, at = yield from self.byte(at)
            values.append(value)
            good = good and fits
        listed = ' '.join(f'{value:02X}' for value in values)
        self.finish(at, f'{what} ID {device} 0x{address:02X}: {listed}', read=bool(read),
                    id=device, address=address, data=values, good=good)

    def byte(self, at):
        '''One byte whose S is at slot `at`: (value, whether all checks are good, slot of the next S
        or of the 0 in its place).'''
        read = self.slots[16].cdm
        while True:
            slot = yield from self.next()
            if slot.cds:
                break
            if not slot.cdm:  # the master has given up
                self.put(WARNING, at, len(self.slots) - 1, 'The slave does not answer')
                raise Aborted
        s = len(self.slots) - 1
        self.put(MASTER, at, s - 1, 'Start (S)' if s == at + 1 else 'Start (S), slave is busy', 'S')
        if s > at + 1:
            self.put(SLAVE, at + 1, s - 1, 'Busy')
        self.put(SLAVE, s, s, 'Start (S)', 'S')
        yield from self.until(s + 13)
        self.zeros = 1  # the stop bit counts as the first
        yield from self.until(s + 14)
        sent, got = self.cdm(s, s + 7), self.cds(s + 1, s + 8)
        value = crc.number(got if read else sent)
        if read:
            self.put(SLAVE, s + 1, s + 8, f'Data: 0x{value:02X}', f'0x{value:02X}')
            good = self.put_crc(SLAVE, s + 9, got)
        else:
            self.put(MASTER, s, s + 7, f'Data: 0x{value:02X}', f'0x{value:02X}')
            good = self.put_crc(MASTER, s + 8, sent)
            echo = self.cds(s + 1, s + 12) == self.cdm(s, s + 11)
            self.put(SLAVE, s + 1, s + 12, f'Echo: {"good" if echo else "wrong"}', 'Echo')
            if not echo:
                self.put(WARNING, s + 1, s + 12, 'The echo differs from what was written')
            good = good and echo
        self.put(MASTER, s + 12, s + 12, 'Stop (P)', 'P')
        self.put(SLAVE, s + 13, s + 13, 'Stop (P)', 'P')
        return value, good, s + 13

    def command(self):
        selected, code = self.cdm(2, 9), crc.number(self.cdm(10, 11))
        self.counting = False  # no abort before EX
        yield from self.until(17)
        tested = not self.slots[16].cdm
        execute = 24 if tested else 16
        yield from self.until(execute + 2)
        self.put(MASTER, execute, execute, f'EX: {self.slots[execute].cdm}', 'EX')
        self.put(MASTER, execute + 1, execute + 1, 'Stop (P)', 'P')
        good, answer = True, None
        if any(selected):
            yield from self.until(25)
            answer = self.cds(17, 24)
            self.put(SLAVE, 17, 24, 'IDA: ' + ids(answer, 'none'), 'IDA')
            good = answer == selected
            if not good:
                self.put(WARNING, 17, 24, 'Command not acknowledged by ' +
                         ids([a & (1 - b) for a, b in zip(selected, answer)], 'others'))
        done = '' if self.slots[execute].cdm else ', not executed'
        self.zeros = 1 + len(self.slots) - (execute + 2)
        self.finish(len(self.slots) - 1, f'Command {code} to {ids(selected, "all")}{done}',
                    command=code, ids=selected, good=good)


def ids(bits, none):
    found = [str(number) for number, bit in enumerate(bits) if bit]
    return none if not found else ('ID ' if len(found) == 1 else 'IDs ') + ', '.join(found)
