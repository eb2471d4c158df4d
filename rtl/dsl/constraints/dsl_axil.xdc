# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# Vivado: constraints of dsl_axil with any parameters, made by tools/synth/constraints.py from crossings.toml: do not
# edit. Not run in Vivado. The names of clocks and periods in the first lines are yours to change, as are ports if dsl_axil
# is not the top of the design. The lines are point to point: with set_clock_groups the tool would ignore the delays.

set core_period 13.333
create_clock -name core -period $core_period [get_ports clk_i]
set host_period 10.0
create_clock -name host -period $host_period [get_ports s_axi_aclk]

# request (`req_q`)
set_max_delay -datapath_only -from [get_cells -hierarchical -filter {NAME =~ *u_bridge/gen_cross*req_q* || NAME =~ *u_bridge/gen_cross*write_q* || NAME =~ *u_bridge/gen_cross*addr_q* || NAME =~ *u_bridge/gen_cross*data_q* || NAME =~ *u_bridge/gen_cross*be_q*}] -to [get_clocks core] $core_period

# answer (`ack_q`)
set_max_delay -datapath_only -from [get_cells -hierarchical -filter {NAME =~ *u_bridge/gen_cross*ack_q* || NAME =~ *u_core/u_regs/word_q*}] -to [get_clocks host] $host_period

# `irq_o` of `dsl_axil`
set_max_delay -datapath_only -from [get_cells -hierarchical -filter {NAME =~ *u_core/u_events/enable_q* || NAME =~ *u_core/u_events/status_q*}] -to [get_clocks host] $host_period

# `s_axi_aresetn`, `rst_ni` of `dsl_axil`
set_false_path -from [get_ports {s_axi_aresetn}] -to [get_clocks host]

# `s_axi_aresetn`, `rst_ni` of `dsl_axil`
set_false_path -from [get_ports {s_axi_aresetn rst_ni}] -to [get_clocks core]

# `dsl_in_i`
set_false_path -from [get_ports {dsl_in_i}] -to [get_clocks core]
