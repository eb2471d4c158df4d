// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// rtl_run MODULE < steps: plays input steps to the Verilated RTL of one module and prints the
// outputs after each. rtl_run --sources: of which sources the models were made. The ports are
// listed in rtl_run_models.inc, made from the sources by make_harness.py.

#include "rtl_run.hpp"

#include <iostream>

namespace {

// Checks are off: random inputs leave the region in which they hold.
template <class Model>
int play() {
  VerilatedContext context;
  context.randReset(2);
  context.randSeed(1);
  context.assertOn(false);
  Model model(&context);
  std::string line;
  while (std::getline(std::cin, line)) {
    BitReader reader(line);
    apply(model, reader);
    model.eval();
    BitWriter writer;
    collect(model, writer);
    std::cout << writer.text() << '\n';
  }
  model.final();
  return std::cout.good() ? 0 : 1;
}

}  // namespace

#include "rtl_run_models.inc"

int main(int argc, char** argv) {
  const std::string module = argc == 2 ? argv[1] : "";
  if (module == "--sources") {
    std::cout << kSources << '\n';
    return 0;
  }
  const int status = play_module(module);
  if (status < 0) std::cerr << "usage: rtl_run MODULE < steps (not a module: " << module << ")\n";
  return status < 0 ? 2 : status;
}
