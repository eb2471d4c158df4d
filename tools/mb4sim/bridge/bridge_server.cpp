// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "bridge/bridge_server.hpp"

#include <fmt/core.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>
#include <system_error>

#include "report/exit_status.hpp"

namespace mb4::tool {
namespace {

constexpr int kBacklog = 16;
constexpr std::size_t kReadSize = 65536;
constexpr std::size_t kMaxUnsent = 1U << 20U;  // above this a client must read answers first

[[noreturn]] void fail(const std::string& where, const std::string& what) {
  throw UseError(fmt::format("{}: cannot listen: {}", where, what));
}

FileDescriptor make_socket(int family) {
  return FileDescriptor(::socket(family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
}

sockaddr_un unix_address(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) {
    fail(path, fmt::format("longer than {} bytes", sizeof address.sun_path - 1));
  }
  std::memcpy(address.sun_path, path.data(), path.size());
  return address;
}

// Removes a socket that an ended server has left; true if there was one.
bool remove_stale(const std::string& path, const sockaddr_un& address) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0 || !S_ISSOCK(status.st_mode)) return false;
  const FileDescriptor probe(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const auto* generic = reinterpret_cast<const sockaddr*>(&address);
  if (::connect(probe.get(), generic, sizeof address) == 0 || errno != ECONNREFUSED) return false;
  return ::unlink(path.c_str()) == 0;
}

struct HostAndPort {
  std::string host;
  std::string port;
};

HostAndPort split(const std::string& address) {
  const std::size_t colon = address.rfind(':');
  if (colon == std::string::npos) return {"127.0.0.1", address};
  std::string host = address.substr(0, colon);
  if (host.size() > 1 && host.front() == '[' && host.back() == ']') {
    host = host.substr(1, host.size() - 2);
  }
  return {host, address.substr(colon + 1)};
}

std::string port_of(const FileDescriptor& socket) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  auto* generic = reinterpret_cast<sockaddr*>(&address);
  std::array<char, NI_MAXSERV> port{};
  if (::getsockname(socket.get(), generic, &size) != 0 ||
      ::getnameinfo(generic, size, nullptr, 0, port.data(), port.size(), NI_NUMERICSERV) != 0) {
    return "?";
  }
  return port.data();
}

}  // namespace

BridgeServer::~BridgeServer() {
  if (!socket_path_.empty()) ::unlink(socket_path_.c_str());
}

std::string BridgeServer::listen_unix(const std::string& path) {
  const sockaddr_un address = unix_address(path);
  const auto* generic = reinterpret_cast<const sockaddr*>(&address);
  FileDescriptor socket = make_socket(AF_UNIX);
  int bound = ::bind(socket.get(), generic, sizeof address);
  if (bound != 0 && errno == EADDRINUSE && remove_stale(path, address)) {
    bound = ::bind(socket.get(), generic, sizeof address);
  }
  if (bound != 0) fail(path, std::strerror(errno));
  socket_path_ = path;
  if (::listen(socket.get(), kBacklog) != 0) fail(path, std::strerror(errno));
  listener_ = std::move(socket);
  return "unix:" + path;
}

std::string BridgeServer::listen_tcp(const std::string& address) {
  const auto [host, port] = split(address);
  unsigned value = 0;
  const auto [stop, error_code] = std::from_chars(port.data(), port.data() + port.size(), value);
  if (error_code != std::errc() || stop != port.data() + port.size() || value > 0xFFFF) {
    fail(address, fmt::format("'{}' is no port, a number of 0 to 65535", port));
  }
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  if (const int error = ::getaddrinfo(host.c_str(), port.c_str(), &hints, &found); error != 0) {
    fail(address, ::gai_strerror(error));
  }
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> owner(found, &::freeaddrinfo);
  FileDescriptor socket = make_socket(found->ai_family);
  const int on = 1;
  ::setsockopt(socket.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (::bind(socket.get(), found->ai_addr, found->ai_addrlen) != 0 ||
      ::listen(socket.get(), kBacklog) != 0) {
    fail(address, std::strerror(errno));
  }
  listener_ = std::move(socket);
  const bool v6 = found->ai_family == AF_INET6;
  return fmt::format("tcp:{}{}{}:{}", v6 ? "[" : "", host, v6 ? "]" : "", port_of(listener_));
}

void BridgeServer::serve(int stop_fd, bool once) {
  for (;;) {
    std::vector<pollfd> fds{{stop_fd, POLLIN, 0}, {listener_.get(), POLLIN, 0}};
    for (const auto& client : clients_) {
      const bool full = client->answers.size() > kMaxUnsent;
      const int events = (full ? 0 : POLLIN) | (client->answers.empty() ? 0 : POLLOUT);
      fds.push_back({client->socket.get(), static_cast<short>(events), 0});
    }
    if (::poll(fds.data(), fds.size(), -1) < 0) {
      if (errno == EINTR) continue;
      throw UseError(fmt::format("cannot wait for connections: {}", std::strerror(errno)));
    }
    for (std::size_t i = clients_.size(); i-- > 0;) {
      const short events = fds[i + 2].revents;
      Client& client = *clients_[i];
      bool there = true;
      if ((events & (POLLIN | POLLHUP | POLLERR)) != 0) there = receive(client);
      if (there && !client.answers.empty()) there = send(client);
      if (there) continue;
      client.session.close();
      clients_.erase(clients_.begin() + static_cast<std::ptrdiff_t>(i));
      if (once && clients_.empty()) return;
    }
    if (fds[0].revents != 0) return;
    if (fds[1].revents != 0) accept();
  }
}

void BridgeServer::accept() {
  FileDescriptor socket(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  if (!socket) return;  // the client has closed it already
  // Answers are small and the client waits for them. No effect on a Unix socket.
  const int on = 1;
  ::setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  clients_.push_back(std::make_unique<Client>(Client{std::move(socket), BridgeSession(chip_), {}}));
}

bool BridgeServer::receive(Client& client) {
  std::array<std::uint8_t, kReadSize> buffer;
  const ssize_t count = ::recv(client.socket.get(), buffer.data(), buffer.size(), 0);
  if (count == 0) return false;
  if (count < 0) return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
  const auto answers = client.session.feed({buffer.data(), static_cast<std::size_t>(count)});
  client.answers.insert(client.answers.end(), answers.begin(), answers.end());
  return true;
}

bool BridgeServer::send(Client& client) {
  const ssize_t count =
      ::send(client.socket.get(), client.answers.data(), client.answers.size(), MSG_NOSIGNAL);
  if (count < 0) return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
  client.answers.erase(client.answers.begin(), client.answers.begin() + count);
  return true;
}

}  // namespace mb4::tool
