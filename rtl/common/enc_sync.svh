// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The attributes of flops that take an asynchronous bit, before their declaration: `ENC_SYNC_FLOPS
// They keep the flops apart, close together, and out of memories.
//   ASYNC_REG                       Vivado
//   SYNCHRONIZER_IDENTIFICATION     Quartus
//   syn_preserve                    Synplify (Libero, Diamond, Radiant), Gowin
// A tool ignores the attributes that it does not know. A design that needs others defines the macro
// for all files (-D); an empty one leaves them out.

`ifndef ENC_SYNC_FLOPS
  `define ENC_SYNC_FLOPS (* ASYNC_REG = "TRUE", syn_preserve = 1, \
    altera_attribute = "-name SYNCHRONIZER_IDENTIFICATION FORCED_IF_ASYNCHRONOUS" *)
`endif
