# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The commands with the DSL masters, the model and the RTL. Positions are those of the scenario's source.

  cli_dsl_test.py MB4SIM EXAMPLES
"""

import json
import re
import sys
import unittest
from pathlib import Path

from cli import EXAMPLES, MasterTest, run

FRAME_US = 11.52
CLOCK_US = 1 / 75


def motor(keys="", slave=""):
    return f'[[channel]]\nnumber = 1\n{keys}[[channel.slave]]\nprotocol = "dsl"\n{slave}'


class DslModel(MasterTest):
    TYPE = "dsl-model"
    HEAD = f'[master]\ntype = "{TYPE}"\n'
    NAME = "motor.toml"
    START_US = 0.5  # the first clock

    def rows(self, scenario, frames):
        status, got = self.frames(scenario, "--frames", str(frames))
        return status, got["frames"]

    def test_every_example_has_50_good_frames(self):
        examples = sorted((Path(EXAMPLES) / "dsl").glob("*.toml"))
        self.assertGreaterEqual(len(examples), 3)
        for example in examples:
            text = re.sub(r'type = "dsl(-model)?"', f'type = "{self.TYPE}"', example.read_text(encoding="utf-8"))
            scenario = self.folder / example.name
            scenario.write_text(text, encoding="utf-8")
            status, rows = self.rows(str(scenario), 50)
            self.assertEqual((status, [row["state"] for row in rows]), (0, ["ok"] * 50), example)

    def test_clock_of_zero_is_refused_by_each_command(self):
        scenario = self.path("[chip]\nf_clk_hz = 0\n" + motor())
        for command in (("run",), ("plot",), ("sweep", "--delays", "0", "--jitters", "0")):
            result = run(command[0], scenario, *command[1:])
            self.assertEqual(result.returncode, 2, command)
            self.assertRegex(result.stderr, r"\Amb4sim: .*motor\.toml:4:12: key 'f_clk_hz': 0 is outside "
                                            r"74925000 to 75075000 \(in \[chip\]\)\n\Z")

    def test_stopped_clock_has_its_last_frame_as_picture(self):
        stop = '[[fault]]\nkind = "clock-stop"\nat_us = 1500\n'
        result = run("plot", self.path("[host]\nlink_ms = 2\n" + motor() + stop), "--frame", "90", "--svg",
                     str(self.folder / "x.svg"))
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(result.stderr, "mb4sim: no link within 2 ms\n")

    def test_plot_without_a_frame_says_so(self):
        result = run("plot", self.path("[host]\nlink_ms = 0.001\n" + motor()), "--svg", str(self.folder / "x.svg"))
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertRegex(result.stderr, r"\Amb4sim: .*motor\.toml: there was no frame\n\Z")
        self.assertEqual([path.name for path in self.folder.iterdir()], ["motor.toml"])

    def test_time_is_that_of_the_sample(self):
        _, rows = self.rows(self.path(motor("cable_m = 60\njitter_ns = 5\n")), 40)
        # RESET, SYNC, START with stuffing, LEARN, CHECK, ID REQ, three frames of INIT, 32 running ones behind
        # 32 bits of the restart; the edge is 8 bits behind the begin. The clock begins after 0.5 us.
        bits = 32 + (2 + 16 + 9 + 9 + 16 + 1 + 3 + 31) * 108 + 9 * 24 + 8
        for number, row in enumerate(rows):
            self.assertAlmostEqual(row["time_us"] - rows[0]["time_us"], number * FRAME_US, delta=1e-9)
        self.assertAlmostEqual(rows[0]["time_us"], bits / 9.375 + self.START_US, delta=0.001)

    def test_two_drivers_at_once_are_told(self):
        for keys, slave, told in (("", "", False), ("cable_m = 100\n", "", False),
                                  ("", "lead_ns = 1000\nlatency_ns = 0\n", True),
                                  ("disable_ns = 500\n", "", True)):
            scenario = self.path(motor(keys, slave))
            result = run("run", scenario, "--frames", "2")
            match = re.search(r"^two drivers at once: (\d+) times, at most (\S+) us, (\S+) us in all, first at "
                              r"(\S+) us$", result.stdout, re.MULTILINE)
            self.assertEqual(match is not None, told, (keys, slave, result.stdout))
            summary = json.loads(run("run", scenario, "--frames", "2", "--json").stdout)["summary"]
            self.assertEqual("note" in summary, told)
            if told:
                self.assertGreater(float(match[2]), 0.03)
                self.assertGreater(int(match[1]), 30)  # each frame with an answer

    def test_second_safe_position_is_judged(self):
        for kind, state in (("wrong-crc2", "second safe position: CRC error"),
                            ("safe2-marker", "no second safe position")):
            fault = f'[[fault]]\nkind = "{kind}"\nslave = 1\nat_us = 1200\nfor_us = 100\n'
            status, rows = self.rows(self.path(motor() + fault), 60)
            self.assertEqual(status, 1, kind)
            self.assertEqual({row["state"] for row in rows}, {"ok", state})
        # Signed below zero, and a second channel that is shorter: nothing is wrong with them.
        for keys in ("", "safe2_bits = 20\n"):
            source = 'source = "ramp"\nstart = -4000\nstep = 3\nsigned = true\nposition_bits = 30\n'
            self.assertEqual(self.rows(self.path(motor(slave=source + keys)), 40)[0], 0)

    def test_flip_of_a_frame_before_the_first_row_is_told(self):
        # Frame 12 is RX3; bit 3 is one of the safe position, 33 one of the second difference.
        for bit, told in ((33, "second difference missing"), (3, "safe position: CRC error")):
            fault = f'[[fault]]\nkind = "bit-flip"\nchannel = 1\nframe = 12\nanswer_bit = {bit}\n'
            result = run("run", self.path(motor(slave="data = 5\n") + fault), "--frames", "20", "--json")
            fault, = json.loads(result.stdout)["faults"]
            self.assertEqual((fault["fate"], fault["by"]), ("detected", f"before frame 1: {told}"))
            self.assertGreater(fault["time_us"], 600)

    def test_flip_of_a_frame_that_does_not_come_is_told(self):
        fault = '[[fault]]\nkind = "bit-flip"\nchannel = 1\nframe = 5000\nanswer_bit = 33\n'
        scenario = self.path(motor() + fault)
        result = run("run", scenario, "--frames", "20")
        self.assertEqual(result.returncode, 0)
        self.assertNotIn("fault 1 at", result.stdout)
        self.assertIn("bit-flip         injected 0, detected 0, no effect 0, missed 0\n"
                      "                     did not happen: frame 5000 of channel 1 has not come\n", result.stdout)
        told, = json.loads(run("run", scenario, "--frames", "20", "--json").stdout)["faults"]
        self.assertEqual((told["fault"], told["time_us"], told["fate"]), (None, None, "not reached"))

    def test_speed_that_cannot_be_told_is_refused(self):
        slave = 'position_bits = 12\nsource = "ramp"\nstep = 300\n'
        result = run("run", self.path(motor(slave=slave)))
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr, r"\Amb4sim: .*key 'step': too fast for a position of 12 bits: its speed must "
                                        r"stay below 256 steps a frame \(in \[\[channel\.slave\]\]\)\n\Z")

    def test_ramp_goes_on_by_one_step_a_frame(self):
        scenario = self.path(motor("cable_m = 60\n", 'source = "ramp"\nstart = 7\nstep = -3\n'
                                                     "position_bits = 40\n"))
        status, rows = self.rows(scenario, 30)
        self.assertEqual(status, 0)
        steps = {b["position"] - a["position"] for a, b in zip(rows, rows[1:])}
        self.assertEqual(steps, {-3})
        self.assertAlmostEqual(rows[20]["time_us"] - rows[0]["time_us"], 20 * FRAME_US, delta=0.1)

    def test_named_frame_loses_its_word(self):
        fault = '[[fault]]\nkind = "bit-flip"\nchannel = 1\nframe = 73\nanswer_bit = 33\n'
        status, rows = self.rows(self.path(motor(slave="data = 5\n") + fault), 80)
        self.assertEqual(status, 1)
        # The first row is running frame 32. Frame 73 is RX0, so POS is set for 15 frames.
        bad = [number for number, row in enumerate(rows, 32) if row["state"] != "ok"]
        self.assertEqual(bad, list(range(73, 73 + 15)))

    def test_faults_are_told_and_the_link_comes_back(self):
        result = run("run", str(Path(EXAMPLES) / "dsl" / "faults.toml"), "--frames", "600")
        self.assertEqual(result.returncode, 1)
        self.assertEqual(sum("restart: " in line for line in result.stdout.splitlines()
                             if not line.startswith("errors")), 1)
        self.assertIn("  600 ", result.stdout)
        self.assertTrue([line for line in result.stdout.splitlines()
                         if line.split()[:1] == ["600"]][0].endswith("ok"))

    def test_no_link_is_one_message(self):
        for keys in ("cable_m = 130\n", '[[channel.event]]\nat_us = 0\naction = "unplug"\n'):
            event = keys.startswith("[[")
            text = (motor("" if event else keys)).replace("[[channel.slave]]", (keys if event else "") +
                                                          "[[channel.slave]]")
            result = run("run", self.path("[host]\nlink_ms = 5\n" + text))
            self.assertEqual(result.returncode, 1)
            self.assertRegex(result.stderr, r"\Amb4sim: .*no link within 5 ms: state [A-Z ]+, "
                                            r"\d\d restarts, the last one: no answer was found\n\Z")

    def test_what_the_master_has_not_is_refused_in_one_line(self):
        scenario = self.path("[host]\nlink_ms = 1\n" + motor("cable_m = 200\n"))  # no link either
        for arguments in (("regs", scenario), ("regs", scenario, "--json"), ("spi", scenario),
                          ("bridge", scenario, "--unix", str(self.folder / "x")),
                          ("plot", scenario, "--command", "0"), ("plot", scenario, "--read", "0x3F"),
                          ("plot", scenario, "--read", "0x40:2"), ("plot", scenario, "--resource", "0x400"),
                          ("plot", scenario, "--resource", "1", "--read", "0x40"),
                          ("run", scenario, "--trace", str(self.folder / "x.fst")),
                          ("run", scenario, "--bus-log", str(self.folder / "x.log"))):
            result = run(*arguments)
            self.assertEqual(result.returncode, 2, arguments)
            self.assertEqual(result.stdout, "", arguments)
            self.assertEqual(len(result.stderr.splitlines()), 1, (arguments, result.stderr))
            self.assertIn("--" if "plot" in arguments else "dsl-model", result.stderr)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["motor.toml"])

    def has_messages(self):
        if self.TYPE == "dsl-model":
            return True
        fields = json.loads(run("regs", self.path(motor()), "--json").stdout)["fields"]
        return {field["name"]: field["value"] for field in fields}["MESSAGES_EVENTS"] == 1

    def scan(self, text, *options):
        return run("scan", self.path(text), "--json", *options)

    def test_scan_prints_the_resources_of_the_encoder(self):
        if not self.has_messages():
            result = self.scan(motor())
            self.assertEqual((result.returncode, result.stdout), (1, ""))
            self.assertIn("this master sends no messages", result.stderr)
            return
        own = ('position_bits = 30\nturn_bits = 12\nsigned = true\naccess_level = 1\n'
               '[[channel.slave.resource]]\nid = 0x210\nname = "OWN"\ntype = "node"\n'
               '[[channel.slave.resource]]\nid = 0x211\nname = "TEXT"\ntype = "string"\nvalue = "0123456789AB"\n'
               'parent = 0x210\nread_level = 1\nwrite_level = 2\ntimeout_ms = 300\n'
               '[[channel.slave.resource]]\nid = 0x212\nname = "COLD"\ntype = "i32"\nvalue = -70000\nparent = 0x210\n'
               '[[channel.slave.resource]]\nid = 0x213\nname = "NO"\ntype = "u8"\nvalue = 9\nread_level = 2\n'
               '[[channel.slave.resource]]\nid = 0x3FF\nname = "RAW"\ntype = "structure"\nvalue = [1, 0xFE]\n')
        result = self.scan(motor("cable_m = 40\n", own))
        self.assertEqual(result.returncode, 0, result.stderr)
        found = {each["id"]: each for each in json.loads(result.stdout)["resources"]}
        self.assertEqual(list(found), [0, 0x80, 0x81, 0x82, 0x86, 0x87, 0xD4, 0x100, 0x210, 0x211, 0x212, 0x213, 0x3FF])
        self.assertEqual(found[0x211], {"id": 0x211, "depth": 2, "name": "TEXT", "type": "string", "size": 12,
                                        "read_level": 1, "write_level": 2, "timeout_ms": 300,
                                        "value": '"0123456789AB"'})
        values = {each: found[each]["value"] for each in found}
        self.assertEqual(values[0x81], str(2 ** 12))
        self.assertEqual(values[0x82], str(2 ** 18))
        self.assertEqual(values[0x212], "-70000")
        self.assertEqual(values[0x213], "error 41/12")
        self.assertEqual(values[0x3FF], "01 FE")
        self.assertEqual(found[0]["name"], "ROOT")
        self.assertEqual(values[0], "10 below")

    def test_scan_says_why_it_has_failed(self):
        if not self.has_messages():
            return
        for kind, why in (("no-message", "no answer within 5 ms"), ("message-nak", "was refused"),
                          ("wrong-message", "its answer is wrong"), ("foreign-address", "no answer within 5 ms")):
            fault = f'[[fault]]\nkind = "{kind}"\nslave = 1\nat_us = 1\n'
            result = self.scan("[host]\nlink_ms = 5\n" + motor() + fault)
            self.assertEqual(result.returncode, 1, kind)
            self.assertIn(why, result.stderr)
        result = self.scan("[host]\nlink_ms = 1\n" + motor("cable_m = 200\n"))
        self.assertEqual(result.returncode, 1)
        self.assertIn("no link within 1 ms", result.stderr)

    def test_each_row_tells_speed_safe_position_quality_and_delay(self):
        source = 'source = "ramp"\nstart = -1000\nstep = 3\nsigned = true\nposition_bits = 30\n'
        scenario = self.path(motor("cable_m = 60\n", source))
        csv = self.folder / "rows.csv"
        result = run("run", scenario, "--frames", "20", "--csv", str(csv))
        self.assertEqual(result.returncode, 0, result.stderr)
        header = "frame,time_us,slave,position,speed,safe_position,quality,delay,state".split(",")
        self.assertEqual(csv.read_text(encoding="utf-8").splitlines()[0].split(","), header)
        self.assertEqual(result.stdout.split("\n")[0].split(),
                         "frame time/us slave position speed safe position QM delay state".split())
        rows = self.rows(scenario, 20)[1]
        # The first certain frame is the 32nd running one, the end of a vertical frame.
        self.assertEqual([row["frame"] for row in rows if row["safe_position"] is not None], [1, 9, 17])
        for row in rows:
            self.assertEqual((row["speed"], row["quality"], row["slave"]), (3, 15, 1))
            # 60 m there and back are 636 ns, 95 ns of the encoder, from the end of SWITCH; the first
            # slot begins 40 ns before: 7 whole bits.
            self.assertEqual(row["delay"], round((636 + 95 + 40) / 106.67))
        # The safe position is that of the sample before its vertical frame.
        safe = [row["safe_position"] for row in rows if row["safe_position"] is not None]
        self.assertEqual(safe[1:], [rows[0]["position"], rows[8]["position"]])
        self.assertLess(rows[0]["position"], 0)

    def test_rows_without_a_position_tell_the_quality(self):
        fault = '[[fault]]\nkind = "bit-flip"\nchannel = 1\nframe = 33\nanswer_bit = 33\n'
        _, rows = self.rows(self.path(motor(slave="data = 5\n") + fault), 3)
        self.assertEqual([row["position"] for row in rows], [5, None, None])
        # The block 100111 of a 0 becomes 100011, which is legal, so only CRC5 refuses the word.
        self.assertEqual([row["quality"] for row in rows], [15, 15, 15])
        self.assertEqual([row["delay"] for row in rows], [rows[0]["delay"]] * 3)

    def test_faults_find_the_row_that_tells_of_them(self):
        result = run("run", str(Path(EXAMPLES) / "dsl" / "faults.toml"), "--frames", "600", "--json")
        told = {fault["kind"]: fault for fault in json.loads(result.stdout)["faults"]}
        self.assertEqual({kind: fault["fate"] for kind, fault in told.items()},
                         {kind: "detected" for kind in ("bit-flip", "fast-marker", "wrong-crc", "unplug")})
        self.assertIn("safe position: CRC error", told["wrong-crc"]["by"])
        # The first row is running frame 32.
        self.assertEqual(told["bit-flip"]["by"], f"frame {280 - 31}, slave 1: position not certain")

    def test_link_that_does_not_come_back_is_told_in_each_row(self):
        event = '[[channel.event]]\nat_us = 1100\naction = "unplug"\n'
        text = motor().replace("[[channel.slave]]", event + "[[channel.slave]]")
        status, rows = self.rows(self.path("[host]\nlink_ms = 3\n" + text), 12)
        states = [row["state"] for row in rows if row["state"] != "ok"]
        self.assertEqual(status, 1)
        after = [state.startswith("restart: ") for state in states].index(True) + 1
        self.assertGreaterEqual(len(states[after:]), 2)
        self.assertEqual(set(states[after:]), {"no link within 3 ms"})
        # The list of errors stays short: one entry for each kind.
        result = run("run", self.path("[host]\nlink_ms = 3\n" + text), "--frames", "200")
        errors, = [line for line in result.stdout.splitlines() if line.startswith("errors:")]
        self.assertLessEqual(errors.count(","), 3, errors)

    def picture(self, status, scenario, *arguments):
        svg = self.folder / "frame.svg"
        result = run("plot", scenario, "--svg", str(svg), *arguments)
        self.assertEqual(result.returncode, status, result.stderr)
        picture = svg.read_text(encoding="utf-8")
        texts = re.findall(r'<text [^>]*class="(\w+)">([^<]*)</text>', picture)
        digits = {}  # by their height; the axis has others than 0 and 1
        for y, text in re.findall(r'<text [^>]*y="([\d.]+)" class="digit">([^<]*)</text>', picture):
            digits.setdefault(y, []).append(text)
        return ([text for kind, text in texts if kind in ("field", "tight")],
                "".join("".join(row) for row in digits.values() if set(row) <= {"0", "1"}),
                " ".join(text for kind, text in texts if kind == "note"), picture)

    def message(self, *arguments, slave=""):
        svg = self.folder / "message.svg"
        result = run("plot", self.path("[host]\nlink_ms = 3\n" + motor("cable_m = 30\n", slave)), *arguments,
                     "--svg", str(svg))
        return result.returncode, svg.read_text(encoding="utf-8") if svg.exists() else "", result.stderr

    def test_plot_shows_messages(self):
        if not self.has_messages():
            return
        # The golden messages, and what the encoder holds.
        for arguments, there, back in ((("--read", "0x7F"), "7F 8A 44", "7F 01 71 47"),
                                       (("--write", "0x7F:0xAB"), "3F AB AE 93", "3F 0D CE"),
                                       (("--resource", "0x081"), "CC 81 C1 0B",
                                        "CC 81 52 45 53 4F 4C 55 54 4E DB 8C")):
            status, picture, _ = self.message(*arguments)
            self.assertEqual(status, 0, arguments)
            self.assertIn(f"To the encoder: {there}<", picture)
            self.assertIn(f"From the encoder: {back}<", picture)
        status, picture, _ = self.message("--resource", "0x081:3")
        self.assertIn("To the encoder: E4 81 80 03 ", picture)
        self.assertIn("From the encoder: C4 81 00 0F ", picture)
        # What is wrong, in the picture and in the status.
        status, _, error = self.message("--resource", "0x3FF")
        self.assertEqual((status, error), (1, "mb4sim: error 40/10\n"))
        for kind, text in (("wrong-message", "cut short, or its CRC is wrong"), ("no-message", "From the encoder: nothing"),
                           ("message-nak", ">NAK<")):
            fault = f'[[fault]]\nkind = "{kind}"\nslave = 1\nat_us = 1\n'
            status, picture, error = self.message("--resource", "0x081", slave=fault)
            self.assertEqual(status, 1, kind)
            self.assertIn(text, picture)
            self.assertIn("resource 081h", error)

    def test_plot_shows_the_bytes_that_the_encoder_sends(self):
        keys = "pipeline = 0xA5\nsummary = 0x81\ns_par_bits = 2\ndata = 0x12345678\nstart_disparity = 1\n"
        for metres, rule in ((0, 0), (37, 1), (100, 2)):
            scenario = self.path(f"[chip.quirks]\nSAMPLE = {rule}\n" + motor(f"cable_m = {metres}\n", keys))
            # Frame 1 is RX7 of a vertical frame: VSYNC, and the low byte of the CRC16.
            vertical = [0x81, 0x00, 0x12, 0x34, 0x56, 0x78]
            rest = 0
            for byte in vertical:
                rest ^= byte << 8
                for _ in range(8):
                    rest = (rest << 1 ^ (0x90D9 if rest & 0x8000 else 0)) & 0xFFFF
            vertical += [(rest ^ 0xFF) >> 8, (rest ^ 0xFF) & 0xFF]
            for frame in range(1, 10):
                place = (frame + 6) % 8
                fields, _, note, _ = self.picture(0, scenario, "--frame", str(frame))
                for name in ("SYNC", "SAMPLE", "CYCLE RESET", "EQUALISATION 0000", "SW.", "TRAILER",
                             f"vertical {vertical[place]:02X}", "pipeline A5",
                             "acceleration 00", "acceleration, CRC5 1F",
                             f"S_PAR {'D0' if place == 7 else '50'}"):
                    self.assertIn(name, fields, (metres, frame))
                self.assertIn(f"RX{place} of", note)
                self.assertIn("Second difference +0, position 305419896, speed 0, QM 15", note)
                self.assertIn(f"{(95 + 10.6 * metres) / 106.67:.2f}", note)

    def test_plot_has_the_bits_where_the_master_samples(self):
        scenario = self.path(motor("cable_m = 12\n", "data = 5\n"))
        _, bits, _, _ = self.picture(0, scenario, "--frame", "1")
        self.assertEqual(len(bits), 26 + 61 + 8)
        self.assertEqual(bits[:16], "0010111101100000")
        # RX0 has a summary of 0 and S_PAR 10h: D0.0 and D16.0 of the standard code, from a negative disparity.
        for metres, rule in ((3, 0), (12, 1), (61, 2)):
            scenario = self.path(f"[chip.quirks]\nSAMPLE = {rule}\n" + motor(f"cable_m = {metres}\n", "data = 5\n"))
            _, bits, _, _ = self.picture(0, scenario, "--frame", "2")
            self.assertEqual(bits[26:46], "1001110100" "0110110100", metres)

    def test_plot_marks_what_is_wrong(self):
        fault = '[[fault]]\nkind = "bit-flip"\nchannel = 1\nframe = 34\nanswer_bit = 33\n'
        scenario = self.path(motor(slave="data = 5\n") + fault)
        fields, _, note, _ = self.picture(0, scenario, "--frame", "2")
        self.assertIn("acceleration 00", fields)
        fields, _, note, picture = self.picture(1, scenario, "--frame", "3")
        self.assertNotIn("acceleration 00", fields)
        self.assertIn("acceleration: CRC5 wrong", note)
        self.assertIn("Second difference missing", note)
        self.assertIn("#f6b9b4", picture)
        # Without a link the last frame that asks for an answer.
        text = "[host]\nlink_ms = 2\n" + motor("cable_m = 140\n")
        fields, _, note, picture = self.picture(1, self.path(text))
        self.assertIn("M_PAR 1A: START", fields)
        self.assertNotIn("STUFFING", fields)  # a restart ends its frame with the trailer

        # A shorted line shows no frame: the picture is that of the place where it has to be.
        short = '[[fault]]\nkind = "stuck"\nchannel = 1\nlevel = 0\nat_us = 1\n'
        fields, bits, note, picture = self.picture(1, self.path("[host]\nlink_ms = 2\n" + motor() + short))
        self.assertIn("no SYNC", note)
        self.assertIn("#f6b9b4", picture)
        self.assertNotIn("1", bits)

    def test_plot_writes_the_four_levels(self):
        vcd = self.folder / "line.vcd"
        self.assertEqual(run("plot", self.path(motor("cable_m = 12\n")), "--vcd", str(vcd)).returncode, 0)
        names = re.findall(r"\$var wire 1 . (\w+) ", vcd.read_text(encoding="ascii"))
        self.assertEqual(names, ["OUT1", "EN1", "IN1", "ENCODER1"])

    def test_sweep_counts_starts_and_frames(self):
        scenario, csv, svg = self.path(motor()), self.folder / "eye.csv", self.folder / "eye.svg"
        result = run("sweep", scenario, "--delays", "0,1060,1300", "--jitters", "0,12,90", "--freqs", "all", "--frames",
                     "5", "--csv", str(csv), "--svg", str(svg))
        self.assertEqual(result.returncode, 1, result.stderr)  # no link on 123 m
        lines = [line.split(",") for line in csv.read_text(encoding="utf-8").splitlines()]
        self.assertEqual(lines[0][0], "sample")
        bad = {(int(code), int(delay), int(jitter)): (int(words), int(flagged), int(wrong))
               for code, _, delay, jitter, words, flagged, wrong in lines[1:]}
        for code in range(3):
            self.assertEqual(bad[code, 0, 0], (5, 0, 0))
            self.assertEqual(bad[code, 0, 12], (5, 0, 0))
            self.assertEqual(bad[code, 1060, 0], (5, 0, 0))
            self.assertEqual(bad[code, 1300, 0], (5, 5, 0))
        self.assertNotEqual(bad[0, 0, 90][1], 0)
        picture = svg.read_text(encoding="utf-8")
        for name in ("published", "first zero", "tracking", "% of a bit"):
            self.assertIn(name, picture)
        # Without --freqs the rule is the scenario's.
        quirk = self.path(motor().replace("[[channel]]", "[chip.quirks]\nSAMPLE = 1\n[[channel]]", 1))
        result = run("sweep", quirk, "--delays", "0", "--jitters", "0,30")
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertIn("SAMPLE 1: first zero", result.stdout)
        self.assertNotIn("SAMPLE 2", result.stdout)


class DslRtl(DslModel):
    TYPE = "dsl"
    HEAD = f'[master]\ntype = "{TYPE}"\n'
    START_US = 0.5 + 3 * CLOCK_US  # the reset ends in the third clock

    def test_what_the_master_has_not_is_refused_in_one_line(self):
        scenario = self.path(motor())
        for arguments in (("spi", scenario), ("scan", scenario, "--eds"), ("plot", scenario, "--command", "0")):
            result = run(*arguments)
            self.assertEqual(result.returncode, 2, arguments)
            self.assertEqual(result.stdout, "", arguments)
            self.assertEqual(len(result.stderr.splitlines()), 1, (arguments, result.stderr))

    def test_registers_are_those_of_the_encoder(self):
        # 20 bits of position in 9 + 11, signed, index 5.
        text = motor("cable_m = 60\n", "position_bits = 20\nsigned = true\nindex = 5\ndata = 0x54321\n")
        result = run("regs", self.path(text), "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        fields = {field["name"]: field["value"] for field in json.loads(result.stdout)["fields"]}
        self.assertEqual(fields["LINK"], 1)
        self.assertEqual(fields["DELAY"], 7)
        self.assertEqual(fields["POS_LO"], 0x54321)
        self.assertEqual(fields["SAFE1_LO"], 0x54321)
        self.assertEqual(fields["SAFE2_LO"], 0xFFFABCDE)
        self.assertEqual(fields["LINK_STATE"], 8)
        self.assertEqual(fields["NUM_RESETS"], 0)
        self.assertEqual(fields["CHANNELS"], 1)

    def test_bus_of_any_frequency_reads_right_positions(self):
        for hz in (5_000_000, 10_000_000, 75_000_000, 74_999_000, 100_000_000, 250_000_000):
            source = 'source = "ramp"\nstep = 1000\nposition_bits = 30\n'
            status, rows = self.rows(self.path(f"[host]\nbus_hz = {hz}\n" + motor("cable_m = 30\n", source)), 40)
            self.assertEqual((status, {row["state"] for row in rows}), (0, {"ok"}), hz)
            steps = {after["position"] - before["position"] for before, after in zip(rows, rows[1:])}
            if hz >= 75_000_000:
                self.assertEqual(steps, {1000}, hz)  # no frame is missed
            else:
                self.assertEqual({step % 1000 for step in steps}, {0}, hz)

    def test_slow_bus_says_how_many_frames_it_missed(self):
        result = run("run", self.path("[host]\nbus_hz = 2_000_000\n" + motor()), "--frames", "20")
        self.assertRegex(result.stdout, r"(?m)^\d+ frames ended before the host had read the one before$")
        self.assertNotIn("frames ended before", run("run", self.path(motor()), "--frames", "20").stdout)

    def test_bus_log_and_waveform_are_written(self):
        log, wave = self.folder / "x.log", self.folder / "x.fst"
        scenario = self.path(motor())
        result = run("run", scenario, "--frames", "3", "--bus-log", str(log), "--trace", str(wave))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(log.read_text(encoding="utf-8"), r"(?m)^read 104 [0-9A-F]{8}$")
        self.assertGreater(wave.stat().st_size, 10_000)

    def test_map_of_the_sdk_brings_the_published_rules(self):
        text = "[chip.quirks]\nSDK_MAP = true\n" + motor()
        fields = {field["name"]: field["value"]
                  for field in json.loads(run("regs", self.path(text), "--json").stdout)["fields"]}
        self.assertEqual((fields["SDK_MAP"], fields["RECOVERY"], fields["STRICT_CODE"], fields["SAMPLE_RULE"]),
                         (1, 0, 1, 0))
        self.assertEqual(fields["CODE_VERSION"], 0x10)
        text = "[chip.quirks]\nSDK_MAP = true\nRECOVER = true\nSAMPLE = 1\n" + motor()
        fields = {field["name"]: field["value"]
                  for field in json.loads(run("regs", self.path(text), "--json").stdout)["fields"]}
        self.assertEqual((fields["SDK_MAP"], fields["RECOVERY"], fields["SAMPLE_RULE"]), (1, 1, 1))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
