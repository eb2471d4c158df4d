# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Quartus: constraints of biss_pru with any parameters, made by tools/synth/constraints.py from crossings.toml: do not
# edit. Not run in Quartus. The names of clocks and periods in the first lines are yours to change, as are ports if biss_pru
# is not the top of the design. The lines are point to point: with set_clock_groups the tool would ignore the delays.

set host_period 5.0
create_clock -name host -period $host_period [get_ports clk_i]

# `sl_i` of `biss_pru`
set_false_path -from [get_ports {sl_i}] -to [get_clocks host]

# `rst_ni` of `biss_pru`
set_false_path -from [get_ports {rst_ni}] -to [get_clocks host]

# `trigger_i`
set_false_path -from [get_ports {trigger_i}] -to [get_clocks host]
