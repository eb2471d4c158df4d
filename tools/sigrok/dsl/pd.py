# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0

import sigrokdecode as srd

from .frame import ANSWER, BITS, FIELDS, PARAMETER, SWITCH, TRAILER, TRAINING, Line
from .message import NAMES, Talk

'''
OUTPUT_PYTHON format: packets [type, values]
 - 'FRAME': dict with symbol, answer (61 bits as text, or None), acceleration (or None), pattern (of a
   training frame: whether it is the right one)
 - 'MESSAGE': dict with answer (from the encoder), data (bytes without the CRC), good
 - 'SAFE': dict with channel (1 or 2), status, position, good
'''

BIT_RATE = 9375000
LEAST_RATE = 4 * BIT_RATE
MASTER, STATE, WORD, MOTION, SAFE, WARNING, DRIVER, REQUEST, REPLY = range(9)


class SamplerateError(Exception):
    pass


class ChannelError(Exception):
    pass


class Decoder(srd.Decoder):
    api_version = 3
    id = 'dsl'
    name = 'DSL'
    longname = 'DSL motor feedback'
    desc = 'Frames between a drive and the encoder of its motor.'
    license = 'apache-2.0'
    inputs = ['logic']
    outputs = ['dsl']
    tags = ['Sensor', 'Embedded/industrial']
    channels = ({'id': 'line', 'name': 'LINE', 'desc': 'The line, near the master'},)
    optional_channels = ({'id': 'en', 'name': 'EN', 'desc': '1 while the master drives'},)
    options = ({'id': 'invert', 'desc': 'Inverted line', 'default': 'no', 'values': ('no', 'yes')},)
    annotations = (
        ('master', 'Field of the master'),
        ('state', 'State of the link'),
        ('word', 'Word of the answer'),
        ('motion', 'Identity, second difference'),
        ('safe', 'Safe position'),
        ('warning', 'Warning'),
        ('driver', 'Who drives'),
        ('request', 'Message to the encoder'),
        ('reply', 'Message from the encoder'),
    )
    annotation_rows = (
        ('fields', 'Fields', (MASTER, WORD)),
        ('drivers', 'Driver', (DRIVER,)),
        ('states', 'Link', (STATE,)),
        ('motions', 'Motion', (MOTION,)),
        ('safes', 'Safe channels', (SAFE,)),
        ('requests', 'Messages to the encoder', (REQUEST,)),
        ('replies', 'Messages from the encoder', (REPLY,)),
        ('warnings', 'Warnings', (WARNING,)),
    )

    def __init__(self):
        self.reset()

    def reset(self):
        self.samplerate = None
        self.talk = Talk()

    def metadata(self, key, value):
        if key == srd.SRD_CONF_SAMPLERATE:
            self.samplerate = value

    def start(self):
        self.out_ann = self.register(srd.OUTPUT_ANN)
        self.out_python = self.register(srd.OUTPUT_PYTHON)

    # --- output ------------------------------------------------------------------------------

    def annotate(self, begin, end, kind, texts):
        begin = max(round(begin), 0)
        self.put(begin, max(round(end), begin + 1), self.out_ann, [kind, texts])

    def show(self, frame):
        end = frame.at(BITS)
        m_par = 'M_PAR: ?' if frame.byte is None else f'M_PAR: {frame.byte:02X}'
        extra = frame.extra
        for first, last, text in ((-extra, 6 - extra, 'SYNC'), (6 - extra, 9, 'SAMPLE'), (9, 12, 'CYCLE RESET'),
                                  (12, PARAMETER, 'EQ'), (PARAMETER, SWITCH, m_par),
                                  (TRAILER, BITS, 'TRAILER')):
            self.annotate(frame.at(first), frame.at(last), MASTER, [text, text[0]])
        self.annotate(frame.at(-extra), end, STATE, [frame.symbol, frame.symbol[:2]])
        if frame.byte is None:
            self.warn(frame.at(PARAMETER), frame.at(SWITCH), 'M_PAR is no word')
        self.show_driver(frame)
        if frame.answer is not None:
            self.show_answer(frame)
        self.show_messages(frame)
        self.put(max(round(frame.begin), 0), round(end), self.out_python,
                 ['FRAME', dict(symbol=frame.symbol, answer=frame.answer,
                                acceleration=frame.acceleration, pattern=frame.pattern)])

    def show_driver(self, frame):
        '''Only a recording with EN knows it.'''
        if frame.off is not None:
            self.annotate(frame.begin, frame.off, DRIVER, ['Master', 'M'])
            self.annotate(frame.off, frame.on or frame.at(TRAILER), DRIVER, ['Encoder', 'E'])
        if frame.on is not None:
            self.annotate(frame.on, frame.at(BITS), DRIVER, ['Master', 'M'])
        mistake = frame.driver_mistake()
        if mistake:
            self.warn(frame.at(SWITCH), frame.at(TRAILER), mistake)

    def show_messages(self, frame):
        if frame.symbol in (*TRAINING, 'RESET', 'SYNC', 'ID REQ'):
            self.talk.clear()
            return
        byte, special = frame.words.get('s_par', (None, False))
        name = None if byte is None or special else NAMES.get(byte & 0x1F)
        if name is not None and frame.symbol != 'INIT':
            self.annotate(frame.begin, frame.at(BITS), REPLY, [name])
        for message in self.talk.take(frame):
            begin, end = message.first.begin, message.last.at(BITS)
            text = message.text()
            self.annotate(begin, end, REPLY if message.answer else REQUEST, [text])
            if not message.good:
                self.warn(begin, end, f'Message {"from" if message.answer else "to"} the encoder: '
                                      f'{"wrong CRC" if message.whole else text}')
            self.put(max(round(begin), 0), round(end), self.out_python,
                     ['MESSAGE', dict(answer=message.answer, data=message.data, good=message.good)])

    def warn(self, begin, end, text):
        self.annotate(begin, end, WARNING, [text])

    def show_answer(self, frame):
        def at(bit):
            return frame.answer_at + bit * frame.bit
        if frame.pattern is not None:
            self.annotate(at(0), at(ANSWER), WORD, ['Test pattern', 'T'])
            if not frame.pattern:
                self.warn(at(0), at(ANSWER), 'Wrong test pattern')
            return
        for name, first, specials in FIELDS:
            byte, special = frame.words[name]
            text = '?' if byte is None else ('K ' if special else '') + f'{byte:02X}'
            self.annotate(at(first), at(first + 10), WORD, [f'{name}: {text}', text])
            if byte is None:
                self.warn(at(first), at(first + 10), 'No word of the code')
            elif special and byte not in specials and not (name == 'secondary' and byte & 31 == 28):
                self.warn(at(first), at(first + 10), 'Unexpected special character')
        if frame.symbol == 'ID REQ':
            identity = frame.identity()
            if identity is None:
                self.warn(at(0), at(ANSWER), 'The identity is broken')
            else:
                self.annotate(at(0), at(50), MOTION, [f'Identity: {identity}', identity])
            return
        if frame.acceleration is None:
            self.warn(at(30), at(50), 'No second difference')
        else:
            self.annotate(at(30), at(50), MOTION, [f'{frame.acceleration:+d}'])
        if frame.vertical is not None:
            self.show_safe(frame, 1, *frame.vertical)
            self.show_safe(frame, 2, *frame.secondary)

    def show_safe(self, frame, channel, data, good):
        position = None if None in data[1:6] else int.from_bytes(bytes(data[1:6]), 'big')
        begin, end = frame.at(-7 * BITS), frame.at(BITS)
        text = '?' if position is None else f'{position:010X}'
        self.annotate(begin, end, SAFE, [f'Safe position {channel}: {text}', text])
        if not good:
            self.warn(begin, end, f'Safe channel {channel}: no good vertical frame')
        self.put(max(round(begin), 0), round(end), self.out_python,
                 ['SAFE', dict(channel=channel, status=data[0], position=position, good=good)])

    # --- input -------------------------------------------------------------------------------

    def decode(self):
        if not self.samplerate or self.samplerate < LEAST_RATE:
            raise SamplerateError(f'At least {LEAST_RATE} samples a second are needed.')
        if not self.has_channel(0):
            raise ChannelError('LINE is needed.')
        invert = int(self.options['invert'] == 'yes')
        line = Line(self.samplerate / BIT_RATE)
        edges = [{0: 'e'}, {1: 'e'}] if self.has_channel(1) else [{0: 'e'}]
        while True:
            level, driver = self.wait(edges)
            if self.matched[0]:
                frame = line.edge(self.samplenum, level ^ invert)
                if frame is not None:
                    self.show(frame)
            if len(edges) > 1 and self.matched[1]:
                line.driver(self.samplenum, driver)
