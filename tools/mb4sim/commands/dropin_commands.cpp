// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Options and help of the commands that put the simulated chip in place of a real chip.
#include <memory>

#include "command_line.hpp"
#include "commands/commands.hpp"

namespace mb4::tool {
namespace {

void add_spidev(CLI::App& app, Action& action) {
  std::shared_ptr<SpidevOptions> options;
  CLI::App& spidev = *add_command(app, action, "spidev",
                                  "Run a Linux program with the chip in place of its SPI device",
                                  &spidev_command, options);
  spidev
      .add_option("--scenario", options->scenario,
                  "Scenario file (TOML; default one encoder of 26 bits)")
      ->type_name("F")
      ->check(file_name());
  spidev.add_option("--device", options->device, "Node to take (default /dev/spidev0.0)")
      ->type_name("PATH")
      ->check(file_name());
  spidev.add_flag("--simulated-time", options->simulated_time,
                  "Sleeps of the program pass in the simulation, at once");
  spidev.add_option("--library", options->library, "Preload library (default: the one installed)")
      ->type_name("F.so")
      ->check(file_name());
  add_trace(spidev, options->trace);
  add_seed(spidev, options->seed);
  // After "--" all words belong to the program, even if they look like options.
  spidev.add_option("program", options->program, "Program and its arguments, behind --")
      ->required()
      ->type_name("PROGRAM");
  spidev.footer(
      "Exit status: the program's; 128 + n if signal n has ended it, 127 if there is none, 2 wrong "
      "use or\ninput, 3 the model stopped.\n"
      "Example: printf '\\x03\\xEB\\0' | mb4sim spidev -- spi-pipe -d /dev/spidev0.0 -b 3 -n 1 | "
      "xxd");
}

void add_bridge(CLI::App& app, Action& action) {
  std::shared_ptr<BridgeOptions> options;
  CLI::App& bridge =
      *add_command(app, action, "bridge", "Serve the chip to emulators on a Unix or TCP socket",
                   &bridge_command, options);
  add_scenario(bridge, options->scenario);
  CLI::Option* unix = bridge.add_option("--unix", options->unix_path, "Listen on a Unix socket")
                          ->type_name("PATH")
                          ->check(file_name());
  bridge
      .add_option("--tcp", options->tcp,
                  "Listen on a TCP port (without HOST of this machine only; port 0: any free one)")
      ->type_name("[HOST:]PORT")
      ->check(file_name())
      ->excludes(unix);
  bridge.add_flag("--once", options->once, "End when the last client has gone");
  bridge.add_flag("--wall-time", options->wall,
                  "Real time between requests passes in the simulation too");
  add_trace(bridge, options->trace);
  add_seed(bridge, options->seed);
  bridge.footer(
      "Prints 'listening on unix:PATH' or 'listening on tcp:HOST:PORT', then serves until SIGINT "
      "or "
      "SIGTERM.\nThe protocol: docs/bridge.md.\n"
      "Example: mb4sim bridge examples/resolute-26.toml --tcp 5555");
}

void add_plot(CLI::App& app, Action& action) {
  constexpr unsigned kMaxFrames = 10'000;
  constexpr unsigned kMaxChannels = 24;
  std::shared_ptr<PlotOptions> options;
  CLI::App& plot =
      *add_command(app, action, "plot", "Draw a frame or a control frame as a timing diagram (SVG)",
                   &plot_command, options);
  add_scenario(plot, options->scenario);
  plot.add_option("--channel", options->channel, "Channel (default 1)")
      ->type_name("N")
      ->transform(whole_number(1, kMaxChannels));
  plot.add_option("--frame", options->frame, "Which frame (default 1, the first)")
      ->type_name("N")
      ->transform(whole_number(1, kMaxFrames));
  plot.add_option("--read", options->read, "Instead of a frame: a register access that reads")
      ->type_name("ADDRESS[:COUNT]")
      ->check(file_name());
  plot.add_option("--write", options->write, "Instead of a frame: one that writes")
      ->type_name("ADDRESS:BYTE,...")
      ->check(file_name());
  plot.add_option("--command", options->command,
                  "Instead of a frame: a command (without ID to all)")
      ->type_name("CODE[:ID,...]")
      ->check(file_name());
  plot.add_option("--resource", options->resource,
                  "DSL: instead of a frame: a message that reads the name of a resource, or by its "
                  "offset what else is said of it")
      ->type_name("ID[:OFFSET]")
      ->check(file_name());
  plot.add_option("--id", options->id, "Slave for --read and --write (default 0, the last one)")
      ->type_name("ID")
      ->transform(whole_number(0, 7));
  plot.add_option("--title", options->title, "Heading of the picture")->type_name("TEXT");
  add_output(plot, "--svg", options->svg,
             "Write the picture to a file (default standard output); .png: by rsvg-convert",
             "F.svg");
  add_output(plot, "--wavejson", options->wavejson, "Write the same picture for WaveDrom",
             "F.json");
  add_output(plot, "--vcd", options->vcd, "Write MA, MO and SL of the whole run, for sigrok",
             "F.vcd");
  add_seed(plot, options->seed);
  plot.footer(
      "Exit status 1 if the frame is bad.\n"
      "Example: mb4sim plot examples/resolute-26.toml --svg frame.svg\n"
      "Example: mb4sim plot examples/control-bus.toml --read 0x44:2 --id 2 --svg read.svg\n"
      "Example: mb4sim plot examples/dsl/messages.toml --read 0x7F --svg ping.svg");
}

}  // namespace

void add_dropin_commands(CLI::App& app, Action& action) {
  add_spidev(app, action);
  add_bridge(app, action);
  add_plot(app, action);
}

}  // namespace mb4::tool
