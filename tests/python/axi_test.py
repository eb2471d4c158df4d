# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""A master on AXI from Python."""

import os
import subprocess
import sys
from pathlib import Path

import openmb4
import pytest

ROOT = Path(__file__).resolve().parents[2]

SCENARIO = ('[master]\ntype = "axi"\n[chip]\nf_clk_hz = 100_000_000\n[[channel]]\nnumber = 1\n'
            'delay_ns = 35\n[[channel.slave]]\nprotocol = "biss-c"\ncrc = 0x43\ndata_bits = 28\n')


@pytest.fixture
def chip():
    with openmb4.Simulator(SCENARIO) as opened:
        yield opened


def test_driver_of_another_master_says_so(chip):
    with pytest.raises(openmb4.Error, match="key 'type': .*iC-MB4.*\"axi\""):
        chip.driver.configure()
    with pytest.raises(openmb4.Error) as error:
        chip.spi(b"\x05\x00")
    assert error.value.code == "MB4SIM_ERROR_HOST"
    chip.advance_ns(1000)


def test_registers_have_their_generated_names(chip):
    regs = chip.axi_regs
    assert regs.MA_DIVIDER.register.address == 0x14
    regs.MODE.write(1)
    assert regs.SINGLE_POINT.read() == chip.axi_read(0x08) == 1
    regs.SAMPLE_DIVIDER.modify(0x234_5678)
    chip.axi_write(0x10, 0xFFFF_FFFF, 0x2)
    assert regs.SAMPLE_DIVIDER.read() == 0x234_FF78
    with pytest.raises(openmb4.Error, match="SINGLE_POINT_DATA: can only be read"):
        regs.SINGLE_POINT_DATA.modify(1)
    with pytest.raises(openmb4.Error, match="4294967296 is no word"):
        regs.MODE.write(1 << 32)


def test_frame_brings_the_word_of_the_encoder(chip):
    regs = chip.axi_regs
    for name, value in (("SINGLE_POINT", 1), ("MA_DIVIDER", 5), ("POSITION_BITS", 26), ("CRC_CHECK", 1),
                        ("CHANNEL_ENABLE", 1)):
        regs[name].register.write(value)
    chip.set_data(1, 0x123_4567 << 2 | 3)
    chip.advance_ns(41_000)  # the reset holds starts back
    regs.REQUEST.modify(1)
    chip.advance_ns(20_000)
    assert regs.SINGLE_POINT_VALID.read() == 1
    assert regs.SINGLE_POINT_DATA.read() == 0x123_4567
    assert regs.LINE_DELAY.read() in (3, 4)  # 35 ns in clocks of 10 ns


@pytest.mark.parametrize("address, strobe", [(0x01, 15), (0x100, 15), (0x00, 16)])
def test_wrong_accesses_are_told(chip, address, strobe):
    with pytest.raises(openmb4.Error) as error:
        chip.axi_write(address, 0, strobe)
    assert error.value.code == "MB4SIM_ERROR_VALUE"


def test_bytes_are_parts_of_words(chip):
    before = chip.mem_read(0x10, 4)
    chip.mem_write(0x11, b"\xFF")
    assert chip.mem_read(0x10, 4)[1:2] == chip.axi_read(0x10).to_bytes(4, "little")[1:2]
    assert chip.mem_read(0x10, 1) == before[:1]
    assert chip.mem_read(0x0E, 5) == chip.mem_read(0x0C, 8)[2:7]
    with pytest.raises(openmb4.Error) as error:
        chip.mem_read(0xFE, 3)
    assert error.value.code == "MB4SIM_ERROR_VALUE"


def test_other_masters_have_no_such_bus():
    with openmb4.Simulator("") as chip, pytest.raises(openmb4.Error) as error:
        chip.axi_read(0)
    assert error.value.code == "MB4SIM_ERROR_HOST"


@pytest.mark.parametrize("access, said", [
    (lambda chip: chip.axi_read(0x11), "axi_read 0x11: an address is that of a word, a multiple of 4"),
    (lambda chip: chip.axi_write(0x12, 0), "axi_write 0x12: an address is that of a word, a multiple of 4"),
    (lambda chip: chip.axi_read(0x10_0000),
     "axi_read 0x100000: the bus of this master does not have this address"),
    (lambda chip: chip.axi_write(0x10, 1 << 32), "axi_write 0x10: value is 0 to 0xFFFFFFFF, not 4294967296"),
    (lambda chip: chip.axi_write(0x10, 0, 16), "axi_write 0x10: strobe is 0 to 0xF, not 16"),
])
def test_wrong_access_says_what_is_right(chip, access, said):
    with pytest.raises(openmb4.Error, match=f"^{said}$") as error:
        access(chip)
    assert error.value.code == "MB4SIM_ERROR_VALUE"


def test_bus_without_a_clock_is_an_error():
    with openmb4.Simulator(SCENARIO.replace("100_000_000", "0")) as chip:
        with pytest.raises(openmb4.Error) as error:
            chip.axi_read(0)
        assert error.value.code == "MB4SIM_ERROR_SILENT"


def test_stream_of_other_masters_is_none(chip):
    assert chip.stream_read() is None
    with openmb4.Simulator("") as other, pytest.raises(openmb4.Error) as error:
        other.stream_read()
    assert error.value.code == "MB4SIM_ERROR_HOST"


def run_example(folder):
    path = os.pathsep.join(sys.path)
    return subprocess.run([sys.executable, folder / "external_clock.py"], capture_output=True,
                          text=True, check=True, env={**os.environ, "PYTHONPATH": path})


@pytest.mark.parametrize("slave", [0, 1])
def test_example_calls_no_position_good_whose_ne_is_0(tmp_path, slave):
    folder = ROOT / "examples" / "axi"
    (tmp_path / "external_clock.py").write_bytes((folder / "external_clock.py").read_bytes())
    parts = (folder / "external-clock.toml").read_text().split("start = ")
    parts[slave] += "flags = 0b01\n"  # nE = 0, nW = 1
    (tmp_path / "external-clock.toml").write_text("start = ".join(parts))
    lines = run_example(tmp_path).stdout.splitlines()
    assert len(lines) == 4
    assert all(line.endswith("good 00") for line in lines)


def page_code():
    """The Python of docs/axi.md."""
    page = (ROOT / "docs" / "axi.md").read_text(encoding="utf-8")
    return page.split("```python\n")[1].split("```")[0]


@pytest.mark.parametrize("flags, printed", [(0b11, "1000000\n"), (0b01, "")])
def test_example_of_the_page_prints_a_position_whose_ne_is_1(tmp_path, flags, printed):
    scenario = (ROOT / "examples" / "axi" / "one-encoder.toml").read_text()
    (tmp_path / "examples" / "axi").mkdir(parents=True)
    (tmp_path / "examples" / "axi" / "one-encoder.toml").write_text(f"{scenario}flags = {flags}\n")
    done = subprocess.run([sys.executable, "-c", page_code()], cwd=tmp_path, capture_output=True,
                          text=True, check=True,
                          env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)})
    assert done.stdout == printed


def test_example_prints_what_the_page_shows():
    """The encoders count by 1 and by 5 from their start; the line delays do not matter."""
    done = run_example(ROOT / "examples" / "axi")
    for n, line in enumerate(done.stdout.splitlines()):
        assert f"positions [{1000 + n}, {2000 + 5 * n}], good 11" in line
    assert f"```text\n{done.stdout}```" in (ROOT / "docs" / "axi.md").read_text(encoding="utf-8")
