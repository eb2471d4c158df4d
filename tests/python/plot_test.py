# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures: what they draw is compared with the scenario and with the frame's arithmetic."""

import re
from pathlib import Path

import matplotlib
import numpy as np
import openmb4
import pytest

matplotlib.use("Agg")

import openmb4.plot as plot  # noqa: E402

LINE = ('[chip]\nf_clk_hz = 20_000_000\n[[channel]]\nnumber = 1\ndelay_ns = 120\njitter_ns = 20\n'
        '[[channel.slave]]\nprotocol = "biss-c"\ndata_bits = 28\nsource = "ramp"\nstart = 1000\n'
        'step = 3\n')


@pytest.fixture
def chip():
    with openmb4.Simulator(LINE) as opened:
        opened.driver.configure()  # MA 10 MHz, as mb4sim run
        yield opened
    matplotlib.pyplot.close("all")


def frame(chip):
    chip.driver.read_frame(1)
    chip.spi(bytes((7, 4)))  # INSTR = 010: one frame
    return chip.record(("MA1", "SL1", "EOT"), 20_000)


def test_record_holds_the_edges_of_a_frame(chip):
    record = frame(chip)
    assert record.end_ps - record.start_ps == 20_000_000
    times, levels = record.pins["MA1"]
    assert times[0] == record.start_ps and set(levels) == {0, 1}
    # Ack, start, CDS, 28 + 6 bits and the clock of the timeout: between 38 and 42 periods of 100 ns.
    rising = times[1:][levels[1:] == 1]
    assert 38 <= len(rising) <= 42
    assert set(np.diff(rising)) == {100_000}
    assert list(record.pins["EOT"][1])[-1] == 1


def test_timing_draws_a_row_for_each_pin(chip):
    record = frame(chip)
    axes = plot.timing(record)
    assert [label.get_text() for label in axes.get_yticklabels()] == ["EOT", "SL1", "MA1"]
    assert axes.get_xlim() == (0, 20)
    for line, (times, levels) in zip(axes.get_lines(), reversed(record.pins.values())):
        x, y = line.get_data()
        assert np.allclose(x[:-1] * 1e6 + record.start_ps, times)
        assert np.allclose(y % 1 > 0.5, np.append(levels, levels[-1]) == 1)
    axes.figure.canvas.draw()


def test_eye_is_open_where_the_line_is_at_rest(chip):
    chip.driver.read_frame(1)
    chip.driver.automatic_start()
    axes = plot.eye(chip.record(("MA1", "SL1"), 100_000))
    # SL changes 120 ns after MA's rising edge, up to 20 ns later, so 20 to 40 ns after the next.
    changes = {x for line in axes.get_lines()[:-1]
               for x, before, after in zip(line.get_xdata()[1:], line.get_ydata(),
                                           line.get_ydata()[1:]) if before != after}
    assert min(changes) < 0 < max(changes)
    assert all(15 <= x % 100 <= 45 for x in changes), sorted(changes)
    axes.figure.canvas.draw()


AXI = ('[master]\ntype = "axi"\n[chip]\nf_clk_hz = 100_000_000\nfeatures = "frames"\n[[channel]]\nnumber = 1\n'
       'delay_ns = 133\njitter_ns = 40\n[[channel.slave]]\nprotocol = "biss-c"\npreset = "resolute-26"\ndata = 0x2AAAAAA\n')


def test_measured_eye_lies_where_the_line_is_at_rest():
    with openmb4.Simulator(AXI) as chip:
        regs = chip.axi_regs
        for name, value in (("SINGLE_POINT", 1), ("MA_DIVIDER", 5), ("POSITION_BITS", 26), ("CRC_CHECK", 1),
                            ("CHANNEL_ENABLE", 1)):
            regs[name].register.write(value)
        chip.advance_ns(41_000)
        regs.REQUEST.modify(0)
        regs.REQUEST.modify(1)
        record = chip.record(("ma0", "slo0"), 20_000)
        word = regs.EYE_WIDTH.register.read()
        assert word >> 31 == 1
        width, point = word & 0x1F, word >> 8 & 0x1F
        axes = plot.eye(record, "ma0", "slo0", measured=(width, point, 10.0))
        # No edge of SL where the eye is drawn: from the clock behind the latest edge to the last one before the next.
        changes = {x for line in axes.get_lines() if len(line.get_xdata()) > 3
                   for x, before, after in zip(line.get_xdata()[1:], line.get_ydata(), line.get_ydata()[1:])
                   if before != after and 0 < x < 100}
        spans = [patch.get_extents().transformed(axes.transData.inverted()) for patch in axes.patches]
        assert len(spans) == 3 and 4 <= width <= 7
        for span in spans:
            assert not any(span.x0 < x < span.x1 for x in changes), (span, sorted(changes))
        assert any(span.x1 > 0 and span.x0 < 100 for span in spans)
        axes.figure.canvas.draw()
        regs.REQUEST.modify(0)
        regs.REQUEST.modify(1)
        with pytest.raises(openmb4.Error, match="no frame has ended in the record"):
            plot.eye(chip.record(("ma0", "slo0"), 2_000), "ma0", "slo0", measured=(width, point, 10.0))
    matplotlib.pyplot.close("all")


def test_eye_of_a_line_at_rest_is_refused(chip):
    with pytest.raises(openmb4.Error, match="0 rising edges of MA1"):
        plot.eye(chip.record(("MA1", "SL1"), 1000))


def test_positions_tell_good_and_bad_frames(chip):
    first = chip.driver.read_frame(1).position
    chip.inject({"fault": [{"kind": "silent", "slave": 1, "at_us": 1000, "for_us": 1000}]})
    rows = chip.driver.read_all(150)
    bad = rows["frame"]["code"][:, 0] != 0
    assert 0 < bad.sum() < 150
    above, below = plot.positions(rows, expected=first + 3 * np.arange(1, 151))
    assert len(above.get_lines()[0].get_xdata()) == (~bad).sum()
    assert len(above.get_lines()[1].get_xdata()) == bad.sum()
    before = np.cumsum(bad)[~bad] == 0
    assert (below.get_lines()[0].get_ydata()[before] == 0).all()
    assert plot.positions(rows).get_ylabel() == "position"
    with pytest.raises(openmb4.Error, match="2 expected values for 150 rows"):
        plot.positions(rows, expected=[1, 2])
    with pytest.raises(openmb4.Error, match="slave must be 1 to 8, not 9"):
        plot.positions(rows, slave=9)


def test_example_of_the_page_draws_a_file(tmp_path, monkeypatch):
    root = Path(__file__).resolve().parents[2]
    (tmp_path / "build").mkdir()
    (tmp_path / "examples").symlink_to(root / "examples")
    monkeypatch.chdir(tmp_path)
    page = (root / "docs" / "python.md").read_text(encoding="utf-8")
    exec(re.search(r"```python\n(import matplotlib.*?)```", page, re.S)[1], {})
    assert (tmp_path / "build" / "frame.png").read_bytes().startswith(b"\x89PNG")
