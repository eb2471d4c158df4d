# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Vivado: constraints of biss_axi with any parameters, made by tools/synth/constraints.py from crossings.toml: do not
# edit. Not run in Vivado. The names of clocks and periods in the first lines are yours to change, as are ports if biss_axi
# is not the top of the design. The lines are point to point: with set_clock_groups the tool would ignore the delays.

set host_period 10.0
create_clock -name host -period $host_period [get_ports axi_aclk]

# SLO, `ext_sample_clk`, `sample_en`
set_false_path -from [get_ports {slo* ext_sample_clk sample_en}] -to [get_clocks host]

# `axi_aresetn`
set_false_path -from [get_ports {axi_aresetn}] -to [get_clocks host]

# `por_n`
set_false_path -from [get_ports {por_n}] -to [get_clocks host]
