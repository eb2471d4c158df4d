# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Simulator: expected values are those of the scenario, or of mb4sim.h."""

import threading
import time
from pathlib import Path

import openmb4
import pytest

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
TEXT = (EXAMPLES / "resolute-26.toml").read_text(encoding="utf-8")
SLAVE = {"protocol": "biss-c", "data_bits": 64, "data": 0xFEDCBA9876543213,
         "registers": {0x44: [0x00, 0xD9]}}
TABLES = {"chip": {"f_clk_hz": 20_000_000}, "channel": [{"number": 1, "slave": [SLAVE]}]}
PARALLEL = {**TABLES, "host": {"interface": "intel"}}


@pytest.mark.parametrize("scenario", [TEXT, EXAMPLES / "resolute-26.toml",
                                      str(EXAMPLES / "resolute-26.toml")])
def test_scenario_text_and_file_give_the_word_of_the_scenario(scenario):
    with openmb4.Simulator(scenario) as chip:
        assert chip.time_ns == 1000
        chip.driver.configure()
        assert chip.driver.read_frame(1).raw == 0x2ABCDEF
        assert chip.sent(1) == 0x2ABCDEF


def test_scenario_dict_may_hold_64_bits_and_register_addresses():
    with openmb4.Simulator(TABLES) as chip:
        assert chip.slave_register(1, 0x45) == 0xD9
        chip.driver.configure()
        assert chip.driver.read_frame(1).raw == 0xFEDCBA9876543213


@pytest.mark.parametrize("scenario, message", [
    ({"chip": {"f_clk": 1}}, "scenario:1:"),
    ("[chip]\nf_clk = 1\n", "scenario:2:1: key 'f_clk'"),
    (Path("no-such.toml"), "no-such.toml: cannot read"),
    ("no-such.toml", "no-such.toml: cannot read: .* in /.*from_text"),
    ("examples/resolute-26", "examples/resolute-26: cannot read: .* in /.*"),
    ("f_clk = 1", "scenario:1:1"),
    (7, "takes the path of a scenario, its text or a dict of its tables, not int"),
])
def test_mistake_in_scenario_is_named(scenario, message):
    with pytest.raises(openmb4.Error, match=message):
        openmb4.Simulator(scenario)


def test_a_text_of_one_line_is_told_from_a_path(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "no ending").write_text(TEXT, encoding="utf-8")
    for scenario in ("no ending", Path("no ending")):
        with openmb4.Simulator(scenario) as chip:
            assert chip.sent.__self__ is chip and "biss-c" in repr(chip)
    for text in ("", "chip.f_clk_hz = 10_000_000", "[chip]", "# x.toml"):
        openmb4.Simulator(text).close()
    with openmb4.Simulator.from_file("no ending") as chip:
        assert "slave 1 biss-c of 28 bits" in repr(chip)
    with pytest.raises(openmb4.Error, match="^scenario:1:"):
        openmb4.Simulator.from_text("x.toml")


def test_repr_tells_scenario_master_slaves_and_time():
    chip = openmb4.Simulator(TEXT)
    assert repr(chip) == "<Simulator of scenario, ic-mb4, slave 1 biss-c of 28 bits, at 1.000 us>"
    assert repr(chip.driver) == "<Driver of scenario, not configured: call configure()>"
    chip.driver.configure()
    assert "ma_hz=10000000" in repr(chip.driver)
    chip.close()
    assert repr(chip) == "<Simulator of scenario, closed>"


@pytest.mark.parametrize("call, code, message", [
    (lambda c: c.set_data(2, 0), "UNKNOWN", "^set_data 2: there is no slave 2; the scenario has 1$"),
    (lambda c: c.set_data(1, 1 << 28), "VALUE",
     "^set_data 1: slave 1 has 28 bits: raw is 0 to 0xFFFFFFF, not 0x10000000$"),
    (lambda c: c.set_data(1, -1), "VALUE", "raw is at most 64 bits, not -1"),
    (lambda c: c.slave_register(9, 0), "UNKNOWN", "no slave 9; the scenario has 1"),
    (lambda c: c.set_slave_register(9, 0, 0), "UNKNOWN", "no slave 9; the scenario has 1"),
    (lambda c: c.slave_register(1, 256), "VALUE", "^slave_register 1: .*address and value are 0 to 0xFF"),
    (lambda c: c.set_data(-1, 0), "VALUE", "^set_data -1: slave counts from 1"),
    (lambda c: c.sent(1), "VALUE", "no word of frame 0; it has sent no frame yet"),
    (lambda c: c.sent(3), "UNKNOWN", "no slave 3"),
    (lambda c: c.pin("MA9"), "UNKNOWN", "^pin MA9: there is no pin 'MA9'; did you mean MA"),
    (lambda c: c.pin("Q"), "UNKNOWN", "no pin 'Q'; there are NCS, .*GETSENS"),
    (lambda c: c.set_pin("GETSEN", 1), "UNKNOWN", "did you mean GETSENS"),
    (lambda c: c.set_pin("GETSENS", 2), "VALUE", "^set_pin GETSENS: level is 0 or 1, not 2$"),
    (lambda c: c.set_pin("EOT", 1), "DRIVEN", "^set_pin EOT: the pin is an output"),
    (lambda c: c.run_until("EOT", 3, 1), "VALUE", "^run_until EOT: level is 0 or 1, not 3"),
    (lambda c: c.record(("MA1", "XY1"), 10), "UNKNOWN", "^record: there is no pin 'XY1'"),
    (lambda c: c.record(("CLK",), 10), "DRIVEN", "f_clk_hz"),
    (lambda c: c.record(("SLO2",), 10), "UNKNOWN", "channel 2 has no line with 'SLO2'"),
])
def test_error_names_slave_pin_and_limit(call, code, message):
    with openmb4.Simulator(TEXT) as chip:
        with pytest.raises(openmb4.Error, match=message) as told:
            call(chip)
        assert told.value.code == f"MB4SIM_ERROR_{code}"
        assert told.value.number is openmb4.SimulatorCode[code]


def test_word_that_is_not_kept_is_named_with_those_that_are():
    with openmb4.Simulator(TEXT) as chip:
        chip.driver.configure()
        chip.driver.read_all(3)
        with pytest.raises(openmb4.Error, match="no word of frame 9; frames 1 to 3 are kept"):
            chip.sent(1, 9)


def test_other_masters_name_their_own_pins():
    with openmb4.Simulator(EXAMPLES / "axi" / "one-encoder.toml") as chip:
        with pytest.raises(openmb4.Error, match="no pin 'MA1'; did you mean ma1"):
            chip.pin("MA1")
        assert "axi, slave 1 biss-c" in repr(chip)
    with openmb4.Simulator(EXAMPLES / "dsl" / "model.toml") as chip:
        with pytest.raises(openmb4.Error, match="this master has no pins"):
            chip.pin("MA1")


def test_spi_reads_the_version():
    with openmb4.Simulator(TEXT) as chip:
        # Opcode 0x03, address 0xEA: REVISION and VERSION = 0x84 (tables 41, 42).
        assert chip.spi(bytes((0x03, 0xEA, 0, 0)))[3] == 0x84


def test_bus_writes_and_reads_and_spi_is_refused():
    with openmb4.Simulator(PARALLEL) as chip:
        chip.bus_write(0xE6, 0x42)
        assert chip.bus_read(0xE6) == 0x42
        with pytest.raises(openmb4.Error, match="another interface") as error:
            chip.spi(b"\x05\x00")
        assert error.value.code == "MB4SIM_ERROR_HOST"


def test_time_passes_as_asked():
    with openmb4.Simulator(TEXT) as chip:
        before = chip.clk_cycles
        chip.advance_ns(10_000)
        assert chip.time_ns == 11_000
        assert chip.clk_cycles - before == 200  # 20 MHz


def test_pins_are_read_driven_and_waited_for():
    with openmb4.Simulator(TEXT) as chip:
        chip.set_pin("NER", 0)
        assert chip.pin("NER") == 0
        chip.set_pin("NER", 1)
        assert chip.pin("NER") == 1
        assert not chip.run_until("MA1", 0, 5_000)
        assert chip.time_ns == 6_000
        for pin, code in (("MA1", "DRIVEN"), ("MA9", "UNKNOWN")):
            with pytest.raises(openmb4.Error) as error:
                chip.set_pin(pin, 1)
            assert error.value.code == f"MB4SIM_ERROR_{code}"


def test_frames_come_with_their_time_and_edges():
    with openmb4.Simulator(TEXT) as chip:
        chip.driver.configure()
        seen = []
        chip.on_frame(seen.append)
        first = chip.frames(1)
        begin = chip.time_ns
        chip.driver.read_all(3)
        chip.on_frame(None)
        chip.driver.read_all()
        assert [frame.channel for frame in seen] == [1, 1, 1]
        assert chip.frames(1) == first + 4
        for frame in seen:
            assert begin < frame.start_ns < frame.end_ns < chip.time_ns
            # 28 data bits, CRC6, start bit, CDS at least, two edges each, at 10 MHz
            assert frame.ma_edges >= 2 * 36
            assert frame.end_ns - frame.start_ns == (frame.ma_edges - 1) * 50
            assert not frame.fault


def test_exception_of_callback_comes_out_of_the_call():
    def callback(frame):
        raise ValueError(f"frame {frame.number}")

    with openmb4.Simulator(TEXT) as chip:
        chip.driver.configure()
        chip.on_frame(callback)
        with pytest.raises(ValueError, match="frame "):
            chip.driver.read_all()
        chip.on_frame(None)
        assert chip.driver.read_frame(1).raw == 0x2ABCDEF


def test_callback_may_read_but_not_let_time_pass_or_close():
    errors, words = [], []
    with openmb4.Simulator(TEXT) as chip:
        def callback(_):
            words.append(chip.sent(1))
            for call in (lambda: chip.advance_ns(1), chip.close, lambda: chip.driver.read_all()):
                with pytest.raises(openmb4.Error) as error:
                    call()
                errors.append(error.value.code)

        chip.driver.configure()
        chip.on_frame(callback)
        chip.driver.read_frame(1)
        assert errors == ["MB4SIM_ERROR_CALLBACK"] * 3
        assert words == [0x2ABCDEF]


def test_injected_fault_is_met_and_reported():
    with openmb4.Simulator(TEXT) as chip:
        chip.driver.configure()
        chip.inject({"fault": [{"kind": "silent", "slave": 1, "at_us": 0, "for_us": 100}]})
        with pytest.raises(openmb4.Error):
            chip.driver.read_frame(1)
        fault, = chip.report()["faults"]
        assert fault["kind"] == "silent" and fault["slave"] == 1 and fault["frames"] == 1
        with pytest.raises(openmb4.Error, match="inject:1:"):
            chip.inject({"fault": [{"kind": "nonsense"}]})


def test_waveform_holds_what_lies_between(tmp_path):
    first, second = tmp_path / "first.fst", tmp_path / "second.fst"
    with openmb4.Simulator(TEXT) as chip:
        chip.driver.configure()
        with chip.trace(first):
            assert chip.driver.read_frame(1).raw == 0x2ABCDEF
            with pytest.raises(openmb4.Error, match="second.fst: a waveform is being written") as told:
                chip.trace_start(second)
            assert told.value.code == "MB4SIM_ERROR_TRACE"
        written = first.read_bytes()
        assert len(written) > 1000
        # GTKWave's view, as `mb4sim run --trace` writes it.
        view = first.with_suffix(".gtkw").read_text(encoding="utf-8")
        assert '[dumpfile] "first.fst"' in view and "MA1" in view
        assert chip.driver.read_frame(1).raw == 0x2ABCDEF
        with pytest.raises(openmb4.Error, match="^trace_stop: no waveform is being written"):
            chip.trace_stop()
        with pytest.raises(openmb4.Error, match="^trace_start: .*cannot write the waveform"):
            chip.trace_start(tmp_path / "no-such-folder" / "x.fst")
        with pytest.raises(ZeroDivisionError), chip.trace(second):
            chip.driver.read_frame(1)
            1 / 0
        assert first.read_bytes() == written and second.stat().st_size > 1000
        view = second.with_suffix(".gtkw")
        view.unlink()
        with chip.trace(second):
            chip.close()
        assert view.exists()


def test_closed_simulator_refuses_every_call():
    chip = openmb4.Simulator(TEXT)
    chip.close()
    chip.close()
    for call in (lambda: chip.time_ns, lambda: chip.spi(b"\5"), lambda: chip.driver.read_all(),
                 lambda: chip.regs.FREQS.read()):
        with pytest.raises(openmb4.Error, match="closed"):
            call()


def test_threads_run_while_time_passes():
    with openmb4.Simulator(TEXT) as chip:
        chip.driver.configure()
        counted = 0
        worker = threading.Thread(target=chip.driver.read_all, args=(1000,))
        worker.start()
        while worker.is_alive():
            counted += 1
            time.sleep(0.001)
    assert counted > 10


def test_simulators_in_threads_do_not_disturb_each_other():
    words = [0x2000001 + i for i in range(6)]
    results = [None] * len(words)

    def run(i):
        with openmb4.Simulator(TEXT.replace("0x2ABCDEF", hex(words[i]))) as chip:
            chip.driver.configure()
            results[i] = set(chip.driver.read_all(200)["frame"]["reading"]["raw"][:, 0].tolist())

    workers = [threading.Thread(target=run, args=(i,)) for i in range(len(words))]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert results == [{word} for word in words]


def test_codes_have_the_names_of_the_register_manual():
    with openmb4.Simulator(TEXT) as chip:
        chip.driver.configure()
        assert chip.regs.CFGCH1.read_name() == "BiSS_C"
        assert chip.regs.CFGCH1.codes == {"BiSS_B": 0, "BiSS_C": 1, "SSI": 2, "UNUSED": 3}
        chip.regs.CFGCH2.modify("SSI")
        assert (chip.regs.CFGCH2.read(), chip.regs.CFGCH2.read_name()) == (2, "SSI")
        chip.regs.FREQAGS.modify("AGSINFINITE")
        assert chip.regs.FREQAGS.read() == 0x7D
        assert chip.regs.FREQS.read_name() == str(chip.regs.FREQS.read())
        with pytest.raises(openmb4.Error, match="CFGCH2: no code has the name 'SPI'; they are BiSS_B, BiSS_C"):
            chip.regs.CFGCH2.modify("SPI")
        with pytest.raises(openmb4.Error, match="FREQS: .*its codes have no names"):
            chip.regs.FREQS.modify("fast")
