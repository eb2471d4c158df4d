// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// The resources of an encoder, which long messages reach: each has a number, a name, a type, levels
// of access, a time-out and, if it is no node, a value.
//
// A direct read brings what is said of a resource: offset 0 its name, 1 its size, 2 the level
// that a read needs, 3 that of a write, 4 its time-out in ms, 5 its type. An indirect access
// reaches the value, and of a node the number of its children (offset 0) and their numbers (offset
// 1 and so on). All numbers are sent with the highest byte first.
#ifndef MB4SIM_DSL_RESOURCES_HPP_
#define MB4SIM_DSL_RESOURCES_HPP_

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mb4::sim::dsl {

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
  kStructure = 0x10,
};
// Bytes of a number; 0 of all other types.
unsigned bytes_of(ResourceType type);

struct Resource {
  static constexpr unsigned kMaxId = 0x3FF;
  static constexpr unsigned kMaxName = 8;
  static constexpr unsigned kNever = 15;  // a level that nobody has

  unsigned id = 0;
  std::string name;
  ResourceType type = ResourceType::kVoid;
  unsigned read_level = 0;
  unsigned write_level = kNever;
  unsigned timeout_ms = 0;
  unsigned parent = 0;
  std::optional<unsigned> latency;  // frames; nothing: as all others
  std::vector<std::uint8_t> value;
};

inline constexpr unsigned kRootId = 0x000;
inline constexpr unsigned kResetId = 0x100;

// What the encoder says of itself.
struct ResourceFacts {
  unsigned position_bits = 32;
  unsigned turn_bits = 20;
  bool is_signed = false;
};
// The resources of every encoder.
std::vector<Resource> standard_resources(const ResourceFacts& facts);

// A long request without its header and its CRC.
struct LongRequest {
  unsigned id = 0;
  bool read = false;
  bool indirect = false;
  unsigned offset = 0;  // 0 if there is none
  unsigned length = 0;  // 0, 2, 4, 8
  std::span<const std::uint8_t> data;
};

// Codes of an error answer, as the line has them: the low one first.
struct ResourceError {
  std::uint8_t low;
  std::uint8_t high;
};
inline constexpr ResourceError kNoResource{0x10, 0x40};
inline constexpr ResourceError kWrongLength{0x11, 0x40};
inline constexpr ResourceError kWrongOffset{0x12, 0x40};
inline constexpr ResourceError kNoWrite{0x10, 0x41};
inline constexpr ResourceError kNoRead{0x11, 0x41};
inline constexpr ResourceError kLowLevel{0x12, 0x41};

struct ResourceAnswer {
  std::optional<ResourceError> error;
  std::vector<std::uint8_t> data;  // of a read
  bool reset = false;              // the resource RESET was written
};

class ResourceTree {
 public:
  // Own ones take the place of standard ones of the same number.
  ResourceTree(std::vector<Resource> standard, const std::vector<Resource>& own, unsigned level);

  ResourceAnswer access(const LongRequest& request);
  const Resource* find(unsigned id) const;
  const std::vector<Resource>& all() const { return resources_; }

 private:
  Resource* at(unsigned id);
  std::vector<unsigned> children(unsigned id) const;
  ResourceAnswer read_direct(const Resource& resource, const LongRequest& request) const;
  ResourceAnswer read_value(const Resource& resource, const LongRequest& request) const;
  ResourceAnswer write_value(Resource& resource, const LongRequest& request) const;

  std::vector<Resource> resources_;  // by number
  unsigned level_;
};

}  // namespace mb4::sim::dsl

#endif  // MB4SIM_DSL_RESOURCES_HPP_
