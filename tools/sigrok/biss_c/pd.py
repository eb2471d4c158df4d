# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0

import sigrokdecode as srd

from .control import Control, Slot
from .frame import CDM, CDS, Decoded, Frame, REST, Word, data_end

'''
OUTPUT_PYTHON format: packets [type, values]
 - 'FRAME': dict with words (data bits of each encoder as a number), cds, cdm, good
 - 'CONTROL': dict with text and good; of a register access read, id, address, data; of a command
   command, ids
'''

CONTROL_MASTER, CONTROL_SLAVE, TRANSACTION, WARNING = range(8, 12)
UNMEASURED_REST_S = 40e-6  # ends a frame that has no second rising edge yet


class ChannelError(Exception):
    pass


class OptionError(Exception):
    pass


class Decoder(srd.Decoder):
    api_version = 3
    id = 'biss_c'
    name = 'BiSS C'
    longname = 'BiSS C encoder interface'
    desc = 'Position frames and control communication of encoders.'
    license = 'apache-2.0'
    inputs = ['logic']
    outputs = ['biss_c']
    tags = ['Sensor', 'Embedded/industrial']
    channels = (
        {'id': 'ma', 'name': 'MA', 'desc': 'Clock of the master'},
        {'id': 'sl', 'name': 'SL', 'desc': 'Data of the encoders, at the master'},
    )
    options = (
        {'id': 'data_bits', 'desc': 'Data bits of each encoder, the one next to SL first',
         'default': '28'},
        {'id': 'flag_bits', 'desc': 'Of these, flags at the end (2: error, warning)',
         'default': '2'},
        {'id': 'crc', 'desc': 'CRC polynomial of each encoder (0: none)', 'default': '0x43'},
        {'id': 'crc_start', 'desc': 'CRC start value of each encoder', 'default': '0'},
        {'id': 'crc_inverted', 'desc': 'CRC inverted on the line', 'default': 'yes',
         'values': ('yes', 'no')},
        {'id': 'invert', 'desc': 'Inverted channels', 'default': 'none',
         'values': ('none', 'ma', 'sl', 'both')},
        {'id': 'rest_us', 'desc': 'Rest of MA that ends a frame, in us (0: one period)',
         'default': 0.0},
    )
    annotations = (
        ('bit', 'Bit of SL'),
        ('framing', 'Acknowledge, start bit'),
        ('cds', 'CDS'),
        ('data', 'Position'),
        ('flag', 'Error, warning'),
        ('crc', 'CRC'),
        ('rest', 'Timeout'),
        ('cdm', 'CDM'),
        ('control-master', 'Control frame of the master (CDM)'),
        ('control-slave', 'Answer of the encoders (CDS)'),
        ('transaction', 'Register access or command'),
        ('warning', 'Warning'),
    )
    annotation_rows = (
        ('bits', 'SL bits', (0,)),
        ('frames', 'Frame', (1, 2, 3, 4, 5, 6)),
        ('cdm-bits', 'CDM', (7,)),
        ('control-masters', 'Control: CDM', (8,)),
        ('control-slaves', 'Control: CDS', (9,)),
        ('transactions', 'Registers and commands', (10,)),
        ('warnings', 'Warnings', (11,)),
    )

    def __init__(self):
        self.reset()

    def reset(self):
        self.samplerate = None
        self.frame = None
        self.control = Control()
        self.reported = 0

    def metadata(self, key, value):
        if key == srd.SRD_CONF_SAMPLERATE:
            self.samplerate = value

    def start(self):
        self.out_ann = self.register(srd.OUTPUT_ANN)
        self.out_python = self.register(srd.OUTPUT_PYTHON)
        self.words = self.read_words()
        self.inverted = self.options['crc_inverted'] == 'yes'
        self.invert_ma = int(self.options['invert'] in ('ma', 'both'))
        self.invert_sl = int(self.options['invert'] in ('sl', 'both'))

    # --- options -----------------------------------------------------------------------------

    def numbers(self, name, count, minimum, maximum):
        '''One number for each encoder; a single one counts for all.'''
        try:
            values = [int(part, 0) for part in str(self.options[name]).replace(',', '+').split('+')]
        except ValueError:
            raise OptionError(f'{name}: a number, or one for each encoder, is needed') from None
        if count is not None and len(values) == 1:
            values *= count
        if count is not None and len(values) != count:
            raise OptionError(f'{name}: {len(values)} values for {count} encoders')
        for value in values:
            if not minimum <= value <= maximum:
                raise OptionError(f'{name}: {value} is not in {minimum} to {maximum}')
        return values

    def read_words(self):
        data = self.numbers('data_bits', None, 1, 64)
        flags = self.numbers('flag_bits', len(data), 0, 64)
        polynomials = self.numbers('crc', len(data), 0, 0x1FFFF)
        starts = self.numbers('crc_start', len(data), 0, 0xFFFF)
        for bits, flag in zip(data, flags):
            if flag > bits:
                raise OptionError(f'flag_bits: {flag} of {bits} data bits')
        return [Word(*each) for each in zip(data, flags, polynomials, starts)]

    # --- output ------------------------------------------------------------------------------

    def annotate(self, begin, end, kind, texts):
        self.put(begin, max(end, begin + 1), self.out_ann, [kind, texts])

    def flush(self, end):
        '''The frame is known as far as it ever will be; `end` is the present sample.'''
        frame, self.frame = self.frame, None
        if len(frame.rising) < 2:
            return  # a pulse, such as MA going back to 1
        decoded = Decoded(frame, self.words, self.inverted)
        for field in decoded.fields:
            self.annotate(field.begin, field.end, field.kind, field.texts)
        for begin, stop, text in decoded.warnings:
            self.annotate(begin, stop, WARNING, [text])
        self.annotate(frame.last_ma, end, CDM, [f'CDM: {decoded.cdm}', str(decoded.cdm)])
        self.data_end = max(decoded.end, frame.last_ma)
        good = decoded.complete and not decoded.warnings
        self.put(frame.begin, self.data_end, self.out_python,
                 ['FRAME', dict(words=decoded.words, cds=decoded.cds, cdm=decoded.cdm, good=good)])
        if decoded.cds is not None:
            self.push(Slot(frame.begin, self.data_end, decoded.cdm, decoded.cds))

    def push(self, slot):
        for begin, end, row, texts in self.control.push(slot):
            self.annotate(begin, end, CONTROL_MASTER + row, texts)
        for transaction in self.control.transactions[self.reported:]:
            values = {key: value for key, value in transaction.items()
                      if key not in ('begin', 'end')}
            self.put(transaction['begin'], transaction['end'], self.out_python,
                     ['CONTROL', values])
        self.reported = len(self.control.transactions)

    # --- input -------------------------------------------------------------------------------

    def rest(self):
        '''Samples without an edge of MA after which the frame is over.'''
        period = self.frame.period()
        if self.options['rest_us'] > 0 and self.samplerate:
            return max(int(self.options['rest_us'] * 1e-6 * self.samplerate), 1)
        if period is not None:
            return period
        return max(int(UNMEASURED_REST_S * self.samplerate), 1) if self.samplerate else 10000

    def deadline(self):
        '''Sample at which the frame can be looked at: MA rests and the data have arrived.'''
        over = self.frame.last_ma + self.rest() + 1
        if self.frame.period() is not None:
            end = data_end(self.frame, self.words)
            if end is not None:
                over = max(over, end)
        return over

    def levels(self, pins):
        return pins[0] ^ self.invert_ma, pins[1] ^ self.invert_sl

    def decode(self):
        if not (self.has_channel(0) and self.has_channel(1)):
            raise ChannelError('MA and SL are needed.')
        ma, sl = self.levels(self.wait({}))
        self.data_end = None
        while True:
            conditions = [{0: 'e'}, {1: 'e'}]
            if self.frame is not None:
                conditions.append({'skip': max(self.deadline() - self.samplenum, 1)})
            new_ma, new_sl = self.levels(self.wait(conditions))
            now = self.samplenum
            if self.frame is not None and now >= self.deadline():
                self.flush(now)
            if new_ma != ma:
                self.ma_edge(now, new_ma, sl)
            if new_sl != sl:
                self.sl_edge(now, new_sl)
            ma, sl = new_ma, new_sl

    def ma_edge(self, now, level, sl):
        if self.frame is not None:
            self.frame.ma_edge(now, level)
        elif not level:
            # After a rest a falling edge begins a frame; a rising edge ends the last CDM.
            self.frame = Frame(now, sl)
            self.data_end = None

    def sl_edge(self, now, level):
        if self.frame is not None:
            self.frame.sl_edge(now, level)
        elif level and self.data_end is not None and now > self.data_end:
            self.annotate(self.data_end, now, REST, ['Timeout', 'T'])
            self.data_end = None
