// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
// The models of mb4_axil and mb4_wb that coverage or mutants run: the simulator's own source on
// other classes takes the place of sim/masters/mb4/words/bus_model.cpp.
#include <Vmb4_axil.h>
#include <Vmb4_axil___024root.h>
#include <Vmb4_wb.h>
#include <Vmb4_wb___024root.h>
#include <Vmeasured_axil.h>
#include <Vmeasured_axil___024root.h>
#include <Vmeasured_wb.h>
#include <Vmeasured_wb___024root.h>

#define Vmb4_axil Vmeasured_axil
#define Vmb4_wb Vmeasured_wb
#include "sim/masters/mb4/words/bus_model.cpp"
