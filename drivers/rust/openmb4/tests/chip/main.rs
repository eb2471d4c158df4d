// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

//! The crate on the simulated chip: libmb4sim.so in the folder MB4SIM_LIB.

mod codes;
#[allow(unused_attributes)] // no_std
#[path = "../../examples/positions.rs"]
mod example;
mod faults;
mod positions;
mod simulator;
