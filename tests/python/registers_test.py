# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Registers and fields: addresses, places and access are those of the datasheet's tables."""

import openmb4
import pytest

SPI = '[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = "biss-c"\ndata_bits = 16\n'


@pytest.fixture(params=["spi", "motorola", "axi", "wb"])
def chip(request):
    with openmb4.Simulator(f'[host]\ninterface = "{request.param}"\n{SPI}') as opened:
        yield opened


# Name, address, bits that 5 stands in, table of the datasheet.
@pytest.mark.parametrize("name, address, expected", [
    ("FREQS", 0xE6, 0x05),  # 35
    ("FREQR", 0xE6, 5 << 5),  # 36
    ("SCDLEN3", 0xC8, 0x05),  # 21
    ("SLAVEID", 0xE5, 5 << 3),  # 27
    ("REGADR", 0xE2, 0x05),
    ("FREQAGS", 0xE8, 0x05),  # 37
])
def test_field_write_changes_no_other_bit(chip, name, address, expected):
    field = chip.regs[name]
    assert field.register.address == address
    field.register.write(0xFF)
    before = field.register.read()  # a bit without a name stays 0
    field.modify(5)
    mask = (1 << field.width) - 1
    shift = (expected // 5).bit_length() - 1
    assert field.register.read() == before & ~(mask << shift) | expected
    assert field.read() == 5


def test_register_is_written_whole(chip):
    chip.regs.FREQ.write(0x64)
    assert (chip.regs.FREQ.read(), chip.regs.FREQS.read(), chip.regs.FREQR.read()) == (0x64, 4, 3)


def test_field_of_two_bytes_is_one_number(chip):
    chip.regs.SCRCSTART2.modify(0x1234)
    assert chip.regs.SLAVE_CFG_CRCSTART_LO2.read() == 0x34
    assert chip.regs.SLAVE_CFG_CRCSTART_HI2.read() == 0x12
    assert chip.regs.SCRCSTART2.read() == 0x1234


@pytest.mark.parametrize("name", ["AGS", "INSTR", "BREAK", "HOLDBANK", "INIT", "SVALID1", "SVALID8",
                                  "nERR", "VERSION", "SWBANKFAIL"])
def test_field_write_that_does_harm_is_refused(chip, name):
    before = chip.clk_cycles
    with pytest.raises(openmb4.Error, match=name):
        chip.regs[name].modify(0)
    assert chip.clk_cycles == before  # nothing has gone to the chip


@pytest.mark.parametrize("value", [-1, 32])
def test_value_that_does_not_fit_is_refused(chip, value):
    with pytest.raises(openmb4.Error, match="FREQS"):
        chip.regs.FREQS.modify(value)


@pytest.mark.parametrize("name, right", [
    ("FREQS", r"regs\.FREQS\.modify\(3\)"), ("FREQ", r"regs\.FREQ\.write\(3\)"),
    ("SVALID1", r"regs\.SVALID1\.register\.write\(\)"), ("nERR", "can only be read"),
    ("FREX", "did you mean FREQ"), ("freqs", "did you mean FREQS")])
def test_assignment_is_refused_and_says_what_to_write(chip, name, right):
    before = chip.clk_cycles
    with pytest.raises(openmb4.Error, match=right) as told:
        setattr(chip.regs, name, 3)
    assert isinstance(told.value, AttributeError) and "\n" not in str(told.value)
    assert chip.clk_cycles == before
    chip.regs.FREQS.modify(4)
    assert chip.regs.FREQS.read() == 4  # the field is still one


def test_repr_of_registers_says_what_they_are(chip):
    assert repr(chip.regs).startswith("<Registers of mb4: ")
    assert repr(chip.regs.FREQS) == "<field FREQS, 5 bits in <register FREQ at 0xE6>>"


def test_unknown_name_is_refused(chip):
    with pytest.raises(AttributeError, match="FREQX'; did you mean FREQS?"):
        chip.regs.FREQX.read()
    assert {"FREQS", "FREQ", "SCDATA8", "CHSEL2", "LSTOP5"} <= set(dir(chip.regs))


def master(name):
    """A simulator of this master."""
    return openmb4.Simulator({"ic-mb4": SPI, "axi": '[master]\ntype = "axi"\n[host]\ninterface = "axi"\n' + SPI}[name])


@pytest.mark.parametrize("own, other, said", [
    ("axi", "regs.FREQS", "regs are the registers of the master 'ic-mb4'; here it is 'axi', with axi_regs"),
    ("axi", "pru_regs.ID", "pru_regs are the registers of the master 'pru'; here it is 'axi', with axi_regs"),
    ("axi", "dsl_regs.VERSION", "dsl_regs are the registers of the master 'dsl'; here it is 'axi', with axi_regs"),
    ("ic-mb4", "axi_regs.ID", "axi_regs are the registers of the master 'axi'; here it is 'ic-mb4', with regs"),
])
def test_registers_of_another_master_are_refused(own, other, said):
    with master(own) as chip:
        group, name = other.split(".")
        before = chip.clk_cycles
        one = getattr(chip, group)[name]
        register = getattr(one, "register", one)
        for access in (register.read, lambda: register.write(0)):
            with pytest.raises(openmb4.Error, match=f"^{said}$") as error:
                access()
            assert error.value.code == "MB4SIM_ERROR_HOST"
        assert chip.clk_cycles == before
