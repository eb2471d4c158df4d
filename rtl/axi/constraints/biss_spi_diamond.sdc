# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Diamond: constraints of biss_spi with any parameters, made by tools/synth/constraints.py from crossings.toml: do not
# edit. Not run in Diamond. The names of clocks and periods in the first lines are yours to change, as are ports if biss_spi
# is not the top of the design. The lines are point to point: with set_clock_groups the tool would ignore the delays.

set host_period 10.0
create_clock -name host -period $host_period [get_ports clk_i]

# SPI: MISO is a flop of clk_i. What its way to the pin takes is taken from the margin of the host (docs/axi.md).
set_max_delay -from [get_clocks host] -to [get_ports miso_o] $host_period

# SLO, `ext_sample_clk_i`, `sample_en_i` of `biss_spi`
set_false_path -from [get_ports {slo_i* ext_sample_clk_i sample_en_i}] -to [get_clocks host]

# `sclk_i`, `cs_ni`, `mosi_i` of `biss_spi`
set_false_path -from [get_ports {sclk_i cs_ni mosi_i}] -to [get_clocks host]

# `rst_ni` of `biss_spi`
set_false_path -from [get_ports {rst_ni}] -to [get_clocks host]
