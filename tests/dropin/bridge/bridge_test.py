#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""`mb4sim bridge` through its sockets, by a client written from docs/bridge.md.

  bridge_test.py MB4SIM SCENARIO      SCENARIO: golden.toml
"""

import os
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest

MB4SIM, SCENARIO = sys.argv[1:3]
GOOD, MALFORMED, REFUSED = 0, 1, 2
# A client knows no generated names. REVISION, VERSION and SLAVELOC5, from 0xEA on.
ID = bytes([0x20, 0x84, 0x01])


def request(kind, payload=b""):
    return kind.encode() + struct.pack("<H", len(payload)) + payload


def transfer(length, tx=None, speed=0, delay=0, word_delay=0, bits=0, cs_change=False):
    head = struct.pack("<HIHBBB", length, speed, delay, word_delay, bits,
                       (1 if cs_change else 0) | (2 if tx is not None else 0))
    return head + (tx or b"")


class Client:
    def __init__(self, address):
        if isinstance(address, str):
            self.socket = socket.socket(socket.AF_UNIX)
        else:
            self.socket = socket.socket()
        self.socket.settimeout(30)
        self.socket.connect(address)

    def receive(self, count):
        data = b""
        while len(data) < count:
            part = self.socket.recv(count - len(data))
            if not part:
                raise EOFError
            data += part
        return data

    def answer(self):
        status, length = struct.unpack("<BH", self.receive(3))
        return status, self.receive(length)

    def ask(self, kind, payload=b""):
        self.socket.sendall(request(kind, payload))
        return self.answer()

    def close(self):
        self.socket.close()


class Bridge(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = os.path.join(self.folder.name, "socket")

    def serve(self, *options, scenario=SCENARIO):
        server = subprocess.Popen([MB4SIM, "bridge", scenario, *options], text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(server.communicate)
        self.addCleanup(server.kill)
        line = server.stdout.readline()
        self.assertTrue(line.startswith("listening on "), line + server.stderr.read()
                        if not line else line)
        return server, line.removeprefix("listening on ").strip()

    def connect(self, *options):
        server, where = self.serve("--unix", self.path, *options)
        self.assertEqual(where, "unix:" + self.path)
        client = Client(self.path)
        self.addCleanup(client.close)
        return server, client

    # --- requests ----------------------------------------------------------------------------

    def test_several_frames(self):
        _, client = self.connect()
        self.assertEqual(client.ask("V"), (GOOD, b"\x01\x00"))
        self.assertEqual(client.ask("T", b"\x03\xEA\0\0\0"), (GOOD, b"\0\0" + ID))
        for frame in (b"\x02\xC0\x5B\x06\0\0", b"\x02\xED\x01", b"\x02\xE5\x40\xA0", b"\x07\x04"):
            self.assertEqual(client.ask("T", frame)[0], GOOD)
        before = client.ask("W", bytes(8))[1]
        after = client.ask("W", struct.pack("<Q", 100_000))[1]
        self.assertEqual(struct.unpack("<Q", after)[0] - struct.unpack("<Q", before)[0], 100_000)
        self.assertEqual(client.ask("T", b"\x03\0" + bytes(8))[1][2:],
                         b"\xBF\x37\xAF\x0A\0\0\0\x18")

    def test_time_stands_still_between_requests(self):
        _, client = self.connect()
        first = client.ask("W", bytes(8))
        time.sleep(0.05)
        self.assertEqual(client.ask("W", bytes(8)), first)

    def test_wall_time_passes_in_the_simulation(self):
        _, client = self.connect("--wall-time")
        now = [struct.unpack("<Q", client.ask("W", bytes(8))[1])[0]]
        time.sleep(0.05)
        client.ask("T", b"\x05\0")
        now.append(struct.unpack("<Q", client.ask("W", bytes(8))[1])[0])
        self.assertGreaterEqual(now[1] - now[0], 50_000_000)

    def test_byte_by_byte(self):
        _, client = self.connect()
        self.assertEqual(client.ask("S", b"\x01"), (GOOD, b""))
        for sent, expected in ((b"\x03", b"\0"), (b"\xEA", b"\0"), (b"\0\0", ID[:2])):
            self.assertEqual(client.ask("X", sent), (GOOD, expected))
        self.assertEqual(client.ask("S", b"\0"), (GOOD, b""))
        self.assertEqual(client.ask("X", b"\0\0"), (GOOD, b"\0\0"))

    def test_pins(self):
        _, client = self.connect()
        self.assertEqual(client.ask("R", b"EOT"), (GOOD, b"\x01"))
        self.assertEqual(client.ask("P", b"\x01GETSENS"), (GOOD, b""))
        self.assertEqual(client.ask("R", b"GETSENS"), (GOOD, b"\x01"))
        self.assertEqual(client.ask("P", b"\x01EOT")[0], REFUSED)
        self.assertEqual(client.ask("R", b"EOTX")[0], REFUSED)
        self.assertEqual(client.ask("P", b"\x02GETSENS")[0], MALFORMED)

    def test_messages_and_settings(self):
        _, client = self.connect()
        both = transfer(2, b"\x03\xEA") + transfer(3)
        self.assertEqual(client.ask("M", both), (GOOD, b"\0\0" + ID))
        apart = transfer(2, b"\x03\xEA", cs_change=True) + transfer(3)
        self.assertEqual(client.ask("M", apart), (GOOD, bytes(5)))
        self.assertEqual(client.ask("G"), (GOOD, struct.pack("<III", 0, 8, 5_000_000)))
        self.assertEqual(client.ask("C", struct.pack("<BI", 2, 1_000_000)), (GOOD, b""))
        self.assertEqual(client.ask("G"), (GOOD, struct.pack("<III", 0, 8, 1_000_000)))
        self.assertEqual(client.ask("C", struct.pack("<BI", 1, 33))[0], REFUSED)
        self.assertEqual(client.ask("C", struct.pack("<BI", 3, 0))[0], MALFORMED)

    def test_a_message_takes_its_time(self):
        _, client = self.connect()

        def took(payload):
            before = struct.unpack("<Q", client.ask("W", bytes(8))[1])[0]
            self.assertEqual(client.ask("M", payload)[0], GOOD)
            return struct.unpack("<Q", client.ask("W", bytes(8))[1])[0] - before

        # 10 bytes at 1 MHz last 80 us; NCS adds half a clock before and after at most.
        self.assertLess(abs(took(transfer(10, bytes(10), speed=1_000_000)) - 80_000), 2000)
        self.assertLess(abs(took(transfer(10, bytes(10), speed=100_000)) - 800_000), 20_000)
        plain = took(transfer(10, bytes(10), speed=1_000_000))
        # The time that NCS stays low after the last clock counts in the delay.
        late = took(transfer(10, bytes(10), speed=1_000_000, delay=70))
        self.assertLess(abs(late - plain - 70_000), 1000)
        slow = took(transfer(10, bytes(10), speed=1_000_000, word_delay=5))
        self.assertLess(abs(slow - plain - 50_000), 1000)

    # --- bytes in any portions ----------------------------------------------------------------

    def test_partial_requests_and_several_at_once(self):
        _, client = self.connect()
        for byte in request("T", b"\x03\xEA\0\0\0"):
            client.socket.sendall(bytes([byte]))
            time.sleep(0.002)
        self.assertEqual(client.answer(), (GOOD, b"\0\0" + ID))
        client.socket.sendall(request("T", b"\x03\xEA\0\0\0") * 5 + request("V")[:2])
        for _ in range(5):
            self.assertEqual(client.answer(), (GOOD, b"\0\0" + ID))
        client.socket.sendall(request("V")[2:])
        self.assertEqual(client.answer(), (GOOD, b"\x01\x00"))

    def test_longest_frames_without_reading_in_between(self):
        _, client = self.connect()
        frame = request("T", b"\x09" + bytes(0xFFFE))
        client.socket.settimeout(90)
        for _ in range(4):
            client.socket.sendall(frame)
        for _ in range(4):
            status, answer = client.answer()
            self.assertEqual((status, len(answer)), (GOOD, 0xFFFF))

    def test_malformed_requests_leave_the_connection_usable(self):
        _, client = self.connect()
        for bad in (request("?"), request("Z", b"123"), request("W", b"1"), request("S"),
                    request("M", b"123"), request("M", transfer(9, b"\0" * 9)[:-1])):
            client.socket.sendall(bad)
            status, text = client.answer()
            self.assertEqual(status, MALFORMED, bad)
            self.assertTrue(text)
        self.assertEqual(client.ask("T", b"\x03\xEA\0\0\0"), (GOOD, b"\0\0" + ID))

    # --- connections --------------------------------------------------------------------------

    def test_clients_come_and_go(self):
        server, client = self.connect("--once")
        client.ask("T", b"\x02\x80\x77")
        for cut in (b"", b"T", b"T\x05", b"T\x05\0\x02\x80"):
            other = Client(self.path)
            other.socket.sendall(cut)
            other.close()
        # A frame that a client has left open ends with it.
        other = Client(self.path)
        other.ask("S", b"\x01")
        other.ask("X", b"\x02\x80")
        other.close()
        time.sleep(0.1)
        self.assertEqual(client.ask("T", b"\x03\x80\0"), (GOOD, b"\0\0\x77"))
        self.assertIsNone(server.poll())
        client.close()
        self.assertEqual(server.wait(20), 0)
        self.assertFalse(os.path.exists(self.path))

    def test_two_clients_share_the_chip(self):
        _, client = self.connect()
        other = Client(self.path)
        for value in range(20):
            client.ask("T", bytes([0x02, 0x80, value]))
            self.assertEqual(other.ask("T", b"\x03\x80\0"), (GOOD, bytes([0, 0, value])))
        other.close()

    def test_tcp(self):
        server, where = self.serve("--tcp", "0", "--once")
        scheme, host, port = where.split(":")
        self.assertEqual((scheme, host), ("tcp", "127.0.0.1"))
        client = Client((host, int(port)))
        self.assertEqual(client.ask("T", b"\x03\xEA\0\0\0"), (GOOD, b"\0\0" + ID))
        client.close()
        self.assertEqual(server.wait(20), 0)

    def test_signals_end_it(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            server, _ = self.serve("--unix", self.path)
            server.send_signal(number)
            self.assertEqual(server.wait(20), 0)
            self.assertFalse(os.path.exists(self.path))

    def test_a_socket_left_behind_is_replaced_and_nothing_else(self):
        server, _ = self.serve("--unix", self.path)
        server.kill()
        server.wait()
        self.assertTrue(os.path.exists(self.path))
        self.connect()
        self.refuses("--unix", self.path)
        plain = os.path.join(self.folder.name, "plain")
        with open(plain, "w", encoding="ascii") as file:
            file.write("x")
        self.refuses("--unix", plain)
        with open(plain, encoding="ascii") as file:
            self.assertEqual(file.read(), "x")

    def refuses(self, *options):
        done = subprocess.run([MB4SIM, "bridge", SCENARIO, *options], capture_output=True,
                              timeout=20, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)

    def test_wrong_use(self):
        for options in ((), ("--tcp", "1", "--unix", self.path), ("--tcp", "x"),
                        ("--tcp", "70000"), ("--tcp", "203.0.113.1:5"),
                        ("--unix", "x" * 200), ("--unix", "/no/such/folder/socket")):
            with self.subTest(options=options):
                self.refuses(*options)

    def test_a_parallel_host_takes_frames_only(self):
        path = os.path.join(self.folder.name, "intel.toml")
        with open(path, "w", encoding="ascii") as file:
            file.write('[host]\ninterface = "intel"\n')
        self.serve("--unix", self.path, scenario=path)
        client = Client(self.path)
        self.addCleanup(client.close)
        self.assertEqual(client.ask("T", b"\x03\xEA\0\0\0"), (GOOD, b"\0\0" + ID))
        for kind, payload in (("S", b"\1"), ("X", b"\0"), ("G", b""), ("M", transfer(1))):
            self.assertEqual(client.ask(kind, payload)[0], REFUSED)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
