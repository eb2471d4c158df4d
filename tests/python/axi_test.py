# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""A master on AXI from Python."""

import openmb4
import pytest

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
