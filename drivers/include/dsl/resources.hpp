// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// The resources of a DSL encoder, a tree below ROOT: what each is, and a walk over all of them.

#ifndef DSL_RESOURCES_HPP_
#define DSL_RESOURCES_HPP_

#include "enc/cpp17.hpp"
#if __cplusplus >= 201703L

#include <array>
#include <cstdint>

#include "dsl/messages.hpp"

namespace dsl {

inline constexpr std::uint16_t kRoot = 0x000;

// Types of a resource; 10h to 4Fh are structures.
enum class ResourceType : std::uint8_t {
  kNode = 0x00,
  kVoid = 0x01,
  kBit = 0x02,
  kU8 = 0x03,
  kU16 = 0x04,
  kU32 = 0x05,
  kU64 = 0x06,
  kI8 = 0x07,
  kI16 = 0x08,
  kI32 = 0x09,
  kI64 = 0x0A,
  kString = 0x0B,
};

struct Resource {
  std::uint16_t id = 0;
  std::array<char, 9> name{};   // ended by 0
  std::uint16_t size = 0;       // bytes; of a node 2
  std::uint8_t read_level = 0;  // access level that a read needs; 15: nobody may
  std::uint8_t write_level = 0;
  std::uint16_t time_ms = 0;  // the longest time of an access
  ResourceType type = ResourceType::kNode;
};

// What a resource is: six messages of `limit_us` each. Errors: those of Messages::ask(), and
// kArgument for an id above 3FFh.
template <typename Port, typename Clock>
Result<Resource> describe(Messages<Port, Clock>& messages, std::uint16_t id,
                          std::uint32_t limit_us) {
  // By offset: name, size, levels of read and write, time, type.
  constexpr unsigned kAsked = 6;
  constexpr std::uint8_t kNameBytes = 8, kNumberBytes = 2;
  Resource resource;
  resource.id = id;
  std::array<std::uint16_t, kAsked> numbers{};
  LongRequest request;
  request.resource = id;
  for (unsigned offset = 0; offset < kAsked; ++offset) {
    request.offset = static_cast<std::uint16_t>(offset);
    request.size = offset == 0 ? kNameBytes : kNumberBytes;
    const Result<LongAnswer> answer = messages.ask(request, limit_us);
    if (!answer) return answer.failure();
    for (unsigned i = 0; offset == 0 && i < kNameBytes; ++i)
      resource.name[i] = static_cast<char>(answer->data[i]);
    numbers[offset] = static_cast<std::uint16_t>(answer->number());
  }
  resource.size = numbers[1];
  resource.read_level = static_cast<std::uint8_t>(numbers[2]);
  resource.write_level = static_cast<std::uint8_t>(numbers[3]);
  resource.time_ms = numbers[4];
  resource.type = static_cast<ResourceType>(numbers[5]);
  return resource;
}

// A number that a resource or, of a node, one of its places holds: of a node 0 is how many are
// below it, then their ids. Errors as describe().
template <typename Port, typename Clock>
Result<std::uint16_t> number_in(Messages<Port, Clock>& messages, std::uint16_t id,
                                std::uint16_t offset, std::uint32_t limit_us) {
  LongRequest request;
  request.resource = id;
  request.indirect = true;
  request.offset = offset;
  request.size = 2;
  const Result<LongAnswer> answer = messages.ask(request, limit_us);
  if (!answer) return answer.failure();
  return static_cast<std::uint16_t>(answer->number());
}

// Calls found(resource, depth) for `from` and all below it, each before those below it. A node that
// is below itself is visited once; more than `kDeepest` nodes above one another are not followed.
// Errors as describe(); the walk ends with the first one.
template <typename Port, typename Clock, typename Found>
Result<void> walk(Messages<Port, Clock>& messages, std::uint32_t limit_us, Found&& found,
                  std::uint16_t from = kRoot) {
  constexpr unsigned kDeepest = 8;
  struct Level {
    std::uint16_t id = 0, next = 0, children = 0;
  };
  std::array<Level, kDeepest> path{};
  unsigned depth = 0;
  std::uint16_t id = from;
  for (;;) {
    const Result<Resource> resource = describe(messages, id, limit_us);
    if (!resource) return resource.failure();
    found(*resource, depth);
    bool above = false;
    for (unsigned i = 0; i < depth; ++i) above = above || path[i].id == id;
    if (resource->type == ResourceType::kNode && !above && depth < kDeepest) {
      const Result<std::uint16_t> children = number_in(messages, id, 0, limit_us);
      if (!children) return children.failure();
      path[depth] = {id, 0, *children};
      ++depth;
    }
    while (depth > 0 && path[depth - 1].next == path[depth - 1].children) --depth;
    if (depth == 0) return {};
    Level& node = path[depth - 1];
    ++node.next;
    const Result<std::uint16_t> child = number_in(messages, node.id, node.next, limit_us);
    if (!child) return child.failure();
    id = *child;
  }
}

}  // namespace dsl

#endif  // __cplusplus >= 201703L

#endif  // DSL_RESOURCES_HPP_
