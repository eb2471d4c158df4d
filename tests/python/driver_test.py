# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The driver's calls: expected values are those of the scenarios."""

import dataclasses
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import openmb4
import pytest

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"
RAMP = ('[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = "biss-c"\ndata_bits = 28\n'
        'source = "ramp"\nstart = 1000\nstep = 3\nregisters = { 0x44 = [1, 2, 3, 4], '
        '0x78 = [0x4D, 0x42, 0x34, 0, 0, 7, 0x69, 0x43] }\n')


@pytest.fixture
def chip():
    with openmb4.Simulator(RAMP) as opened:
        opened.driver.configure()
        yield opened


def positions(rows, slave=1):
    assert not rows["frame"]["code"][:, slave - 1].any()
    return rows["frame"]["reading"]["position"][:, slave - 1]


def test_frames_are_an_array_of_the_ramp(chip):
    first = chip.driver.read_frame(1).position
    assert (first - 1000) % 3 == 0
    rows = chip.driver.read_all(500)
    assert np.array_equal(positions(rows), first + 3 * np.arange(1, 501))
    assert (np.diff(rows["time_ns"].astype(np.int64)) > 0).all()
    assert rows["time_ns"][-1] == chip.time_ns
    assert not rows["frame"]["reading"]["slave_error"][:, 0].any()


def test_word_whose_ne_is_0_is_an_error_with_its_reading(chip):
    chip.set_data(1, 500 << 2 | 1)
    with pytest.raises(openmb4.Error) as error:
        chip.driver.read_frame(1)
    assert error.value.code == "MB4_SLAVE_ERROR"
    reading = error.value.reading
    assert (reading.position, reading.slave_error, reading.slave_warning) == (500, True, False)
    row, = chip.driver.read_all()
    assert row["frame"]["code"][0] == 21
    assert row["frame"]["reading"]["slave_error"][0]
    chip.driver.automatic_start()
    rows = chip.driver.automatic_next(3)
    chip.driver.automatic_stop()
    assert (rows["frame"]["code"][:, 0] == 21).all()
    assert not rows["result"]["code"].any()  # nothing is wrong with the frames


def test_old_names_of_a_reading_are_refused_with_the_new_ones(chip):
    reading = chip.driver.read_frame(1)
    for name in ("error", "warning"):
        with pytest.raises(AttributeError, match=f"'{name}' of a Reading is called 'slave_{name}'"):
            getattr(reading, name)
    with pytest.raises(AttributeError, match="no 'speed'"):
        getattr(reading, "speed")


def test_automatic_frames_follow_each_other(chip):
    chip.driver.automatic_start()
    found = positions(chip.driver.automatic_next(50))
    chip.driver.automatic_stop()
    assert (np.diff(found.astype(np.int64)) % 3 == 0).all()
    assert (np.diff(found.astype(np.int64)) > 0).all()


def test_registers_of_the_slave_are_read_and_written(chip):
    assert chip.driver.slave_read(1, 0, 0x44, 4) == bytes((1, 2, 3, 4))
    chip.driver.slave_write(1, 0, 0x50, b"\x5A\xA5")
    assert [chip.slave_register(1, 0x50), chip.slave_register(1, 0x51)] == [0x5A, 0xA5]


def test_scan_finds_the_identity_of_the_slave(chip):
    one, = chip.driver.scan(1)
    assert one.device_id == b"MB4\0\0\7" and one.manufacturer == b"iC" and one.has_identity


def test_probe_and_chip_registers(chip):
    assert chip.driver.probe()[0] == 0x84  # VERSION of the iC-MB4
    chip.driver.write_registers(0x80, b"\1\2\3")
    assert chip.driver.read_registers(0x80, 3) == b"\1\2\3"


def test_configuration_may_be_changed_and_is_checked(chip):
    config = chip.driver.config()
    assert config.slaves[0].data_bits == 28 and config.slaves[0].crc_polynomial == 0x43
    config.ma_hz = 2_000_000
    chip.driver.configure(config)
    frames = []
    chip.on_frame(frames.append)
    chip.driver.read_all()
    frame, = frames
    assert frame.end_ns - frame.start_ns == (frame.ma_edges - 1) * 250
    config.slaves[0].data_bits = 65
    with pytest.raises(openmb4.Error, match="data_bits of 1") as error:
        chip.driver.configure(config)
    assert error.value.code == "MB4_INVALID_CONFIG"


def test_configuration_shows_what_is_not_at_its_default(chip):
    config = chip.driver.config()
    assert isinstance(config, openmb4.Config)
    assert config.protocol[0] is openmb4.Protocol.BISS_C and config.spi_check is openmb4.SpiCheck.CRC
    assert repr(config).startswith("Config(ma_hz=10000000, ")
    assert repr(config).endswith("spi_check=SpiCheck.CRC, protocol=[Protocol.BISS_C, Protocol.UNUSED], "
                                 "slaves[0]=SlaveConfig(enabled=True, data_bits=28))")
    assert repr(openmb4.Config()) == "Config()"
    assert chip.driver.config() == config != openmb4.Config()
    for kind in (openmb4.Config, openmb4.SlaveConfig):
        for one in dataclasses.fields(kind):
            assert re.search(rf"^    {one.name} ", kind.__doc__, re.M), one.name


def test_configuration_has_the_members_and_defaults_of_c():
    from openmb4 import config
    from openmb4._library import ffi, lib
    for python, c in ((openmb4.Config, "mb4_config"), (openmb4.SlaveConfig, "mb4_slave_config")):
        assert [one.name for one in dataclasses.fields(python)] == [name for name, _ in ffi.typeof(c).fields]
    default = ffi.new("mb4_config *", lib.mb4_config_default())
    assert config.from_c(default) == openmb4.Config()
    there = config.to_c(openmb4.Config())
    assert bytes(ffi.buffer(there)) == bytes(ffi.buffer(default))


@pytest.mark.parametrize("kind, prefix", [
    (openmb4.Code, "MB4_"), (openmb4.SimulatorCode, "MB4SIM_ERROR_"),
    (openmb4.Protocol, "MB4_PROTOCOL_"), (openmb4.ClockSource, "MB4_CLOCK_"),
    (openmb4.LineInterface, "MB4_LINE_"), (openmb4.FrameStart, "MB4_START_"),
    (openmb4.Flags, "MB4_FLAGS_"), (openmb4.SpiCheck, "MB4_SPI_CHECK_")])
def test_enums_are_those_of_the_headers(kind, prefix):
    from openmb4._library import _headers, lib
    enums = re.findall(r"enum \{(.*?)\}", re.sub(r"/\*.*?\*/", "", "\n".join(_headers), flags=re.S),
                       re.S)
    found, = [names for names in (re.findall(r"\b(MB4\w+)", text) for text in enums)
              if prefix + list(kind)[0].name in names]
    assert [f"{prefix}{one.name}" for one in kind] == found
    assert all(one == getattr(lib, prefix + one.name) for one in kind)


@pytest.mark.parametrize("change, message", [
    (lambda c: setattr(c, "f_clk_hz", 5), "configure: .*f_clk_hz: it is 1_000_000 to 25_000_000.*, not 5$"),
    (lambda c: setattr(c, "ma_hz", 3), "ma_hz: it is one of .*ma_hz_at_most.*, not 3$"),
    (lambda c: setattr(c.slaves[0], "data_bits", 65), "data_bits of 1: it is 1 to 64.*, not 65$"),
    (lambda c: setattr(c.slaves[1], "data_bits", 256), r"^slaves\[1\].data_bits is 1 to 64.*, not 256$"),
    (lambda c: setattr(c, "mo_busy", "x"), "^Config.mo_busy is 0 to 255; 0 without mo, not 'x'$"),
    (lambda c: setattr(c, "spi_check", 9), "^Config.spi_check is of SpiCheck: OFF, CRC, FULL,.* not 9$"),
    (lambda c: c.protocol.__setitem__(1, 4), r"^Config.protocol\[1\] is of Protocol: BISS_B.* not 4$"),
    (lambda c: c.slaves.pop(), "^Config.slaves is a list of 8 SlaveConfig, not 7$"),
])
def test_wrong_member_is_named_with_what_it_takes(chip, change, message):
    config = chip.driver.config()
    change(config)
    with pytest.raises(openmb4.Error, match=message) as told:
        chip.driver.configure(config)
    assert told.value.number is openmb4.Code.INVALID_CONFIG


def test_unknown_member_is_refused(chip):
    config = chip.driver.config()
    with pytest.raises(openmb4.Error, match="Config has no member 'ma_khz'; did you mean ma_hz"):
        config.ma_khz = 1
    with pytest.raises(AttributeError, match="SlaveConfig has no member 'bits'"):
        config.slaves[0].bits = 1
    with pytest.raises(openmb4.Error, match="configure: takes a Config.*not dict"):
        chip.driver.configure({})


@pytest.mark.parametrize("call, message", [
    (lambda d: d.read_frame(300), r"^read_frame\(300\): slave is 1 to 8, and one that the configuration has$"),
    (lambda d: d.slave_read(1, 0, 256), r"^slave_read\(1, 0, 0x100, 1\): channel is 1 or 2, .*at most 128"),
    (lambda d: d.read_frame(9), r"^read_frame\(9\): invalid argument: slave is 1 to 8, and one that the configuration has$"),
    (lambda d: d.clear_valid(0), r"^clear_valid\(0\): invalid argument: slave is 1 to 8, and one that the configuration has$"),
    (lambda d: d.slave_read(3, 0, 0), r"^slave_read\(3, 0, 0x00, 1\): invalid argument: channel is 1 or 2"),
    (lambda d: d.read_registers(0, 65), r"^read_registers\(0x00, 65\): .*size 1 to 64"),
    (lambda d: d.scan(3), r"^scan\(3\): invalid argument: channel is 1 or 2$"),
])
def test_wrong_argument_is_named_with_what_it_takes(chip, call, message):
    with pytest.raises(openmb4.Error, match=message) as told:
        call(chip.driver)
    assert told.value.number is openmb4.Code.INVALID_ARGUMENT


def test_bad_frame_has_a_code_and_the_next_is_good(chip):
    chip.inject({"fault": [{"kind": "wrong-crc", "slave": 1, "at_us": 0, "for_us": 30}]})
    rows = chip.driver.read_all(20)
    codes = rows["frame"]["code"][:, 0]
    assert codes[0] != 0 and codes[-1] == 0
    with pytest.raises(openmb4.Error) as error:
        chip.inject({"fault": [{"kind": "silent", "slave": 1, "at_us": 0}]})
        chip.driver.read_frame(1)
    assert error.value.code.startswith("MB4_")


@pytest.mark.parametrize("name", ["two-channels", "mixed-channels", "sine-internal-osc"])
def test_configuration_of_the_scenario_reads_what_the_slaves_sent(name):
    with openmb4.Simulator(EXAMPLES / f"{name}.toml") as opened:
        opened.driver.configure()
        row, = opened.driver.read_all()
        slaves = [slave for slave in range(1, 9) if opened.frames(slave)]
        assert slaves
        for slave in slaves:
            assert row["frame"]["code"][slave - 1] == 0
            assert row["frame"]["reading"]["raw"][slave - 1] == opened.sent(slave)


def test_driver_with_a_parallel_host_says_why_it_fails():
    with openmb4.Simulator('[host]\ninterface = "intel"\n' + RAMP) as opened:
        with pytest.raises(openmb4.Error, match="driver: the scenario's host"):
            opened.driver.configure()


def test_reading_before_configuration_is_refused():
    with openmb4.Simulator(RAMP) as opened:
        with pytest.raises(openmb4.Error) as error:
            opened.driver.read_all(1000)
        assert error.value.code == "MB4_NOT_CONFIGURED"


@pytest.mark.parametrize("page", ["README.md", "docs/python.md"])
def test_command_of_the_page_reads_the_position_of_its_scenario(page):
    program = re.search(r"python -c '(.*)'", (ROOT / page).read_text(encoding="utf-8"))[1]
    folder = str(Path(openmb4.__file__).parents[1])
    run = subprocess.run([sys.executable, "-B", "-c", program], cwd=ROOT, check=True, text=True,
                         capture_output=True, env=dict(os.environ, PYTHONPATH=folder))
    assert f"position={0x2ABCDEF >> 2}," in run.stdout


def test_configuration_of_the_page_is_the_one_it_says(monkeypatch, capsys):
    page = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
    monkeypatch.chdir(ROOT)
    program, = [text for text in re.findall(r"```python\n(.*?)```", page, re.S) if "ma_hz_at_most" in text]
    exec(program, {})
    assert "Config(ma_hz=2500000, " in capsys.readouterr().out


def test_first_example_of_the_page_runs(monkeypatch, capsys):
    page = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
    monkeypatch.chdir(ROOT)
    exec(re.search(r"```python\n(.*?)```", page, re.S)[1], {})
    assert capsys.readouterr().out.startswith(f"{0x2ABCDEF >> 2}\nTrue ")
