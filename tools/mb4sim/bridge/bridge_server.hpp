// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The bridge's sockets: any number of connections to one chip. One thread serves them, one request
// after another.
#ifndef MB4SIM_TOOL_BRIDGE_SERVER_HPP_
#define MB4SIM_TOOL_BRIDGE_SERVER_HPP_

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bridge/bridge_session.hpp"
#include "bridge/file_descriptor.hpp"
#include "mb4sim/simulator.hpp"

namespace mb4::tool {

class BridgeServer {
 public:
  BridgeServer(sim::Simulator& simulator, Pace pace) : chip_(simulator, pace) {}
  BridgeServer(const BridgeServer&) = delete;
  BridgeServer& operator=(const BridgeServer&) = delete;
  ~BridgeServer();

  // Returns the address, "unix:PATH". Replaces a socket at `path` that no process serves. Throws
  // UseError.
  std::string listen_unix(const std::string& path);
  // "PORT" (of the loopback interface), "HOST:PORT" or "[HOST]:PORT"; port 0: any free one. Returns
  // "tcp:HOST:PORT". Throws UseError.
  std::string listen_tcp(const std::string& address);

  // Serves until `stop_fd` is readable or, with `once`, until the last connection is closed.
  void serve(int stop_fd, bool once);

  // The text of the assertion that has ended the simulation.
  const std::optional<std::string>& stopped() const { return chip_.stopped(); }

 private:
  struct Client {
    FileDescriptor socket;
    BridgeSession session;
    std::vector<std::uint8_t> answers;  // not sent yet
  };

  void accept();
  // False: the client has closed the connection.
  bool receive(Client& client);
  static bool send(Client& client);

  BridgeChip chip_;
  FileDescriptor listener_;
  std::string socket_path_;  // to be removed
  std::vector<std::unique_ptr<Client>> clients_;
};

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_BRIDGE_SERVER_HPP_
