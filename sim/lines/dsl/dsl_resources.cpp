// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/lines/dsl/dsl_resources.hpp"

#include <algorithm>

namespace mb4::sim::dsl {
namespace {

constexpr unsigned kMaxLength = 8;

// Offsets of a direct read.
enum Said : unsigned { kName, kSize, kReadLevel, kWriteLevel, kTimeout, kType };

std::vector<std::uint8_t> big_endian(std::uint64_t value, unsigned bytes) {
  std::vector<std::uint8_t> all(bytes);
  for (unsigned i = 0; i < bytes; ++i) {
    all[i] = static_cast<std::uint8_t>(value >> 8U * (bytes - 1 - i));
  }
  return all;
}

std::vector<std::uint8_t> text(const std::string& from) { return {from.begin(), from.end()}; }

bool is_signed(ResourceType type) {
  return type >= ResourceType::kI8 && type <= ResourceType::kI64;
}

ResourceAnswer refused(ResourceError error) { return {.error = error, .data = {}}; }
ResourceAnswer answered(std::vector<std::uint8_t> data) {
  return {.error = std::nullopt, .data = std::move(data)};
}

// A number in a field of `length` bytes.
ResourceAnswer number(std::uint64_t value, unsigned length, unsigned needed) {
  if (length == 0) return answered({});
  if (length < needed) return refused(kWrongLength);
  return answered(big_endian(value, length));
}

// Bytes from an offset on, with zeros behind their end.
std::vector<std::uint8_t> part_of(const std::vector<std::uint8_t>& value, unsigned offset,
                                  unsigned length) {
  std::vector<std::uint8_t> part(length);
  for (unsigned i = 0; i < length && offset + i < value.size(); ++i) part[i] = value[offset + i];
  return part;
}

}  // namespace

unsigned bytes_of(ResourceType type) {
  switch (type) {
    case ResourceType::kBit:
    case ResourceType::kU8:
    case ResourceType::kI8:
      return 1;
    case ResourceType::kU16:
    case ResourceType::kI16:
      return 2;
    case ResourceType::kU32:
    case ResourceType::kI32:
      return 4;
    case ResourceType::kU64:
    case ResourceType::kI64:
      return 8;
    default:
      return 0;
  }
}

std::vector<Resource> standard_resources(const ResourceFacts& facts) {
  constexpr unsigned kBipolarRotary = 0;
  constexpr unsigned kUnipolarRotary = 2;
  constexpr unsigned kEepromBytes = 0x2000;
  const auto value = [](unsigned id, const char* name, ResourceType type, std::uint64_t number) {
    Resource resource;
    resource.id = id;
    resource.name = name;
    resource.type = type;
    resource.timeout_ms = 70;
    resource.value = big_endian(number, bytes_of(type));
    return resource;
  };
  std::vector<Resource> all;
  all.push_back(value(kRootId, "ROOT", ResourceType::kNode, 0));
  all.push_back(value(0x080, "ENCTYPE", ResourceType::kU16,
                      facts.is_signed ? kBipolarRotary : kUnipolarRotary));
  all.push_back(value(0x081, "RESOLUTN", ResourceType::kU32, std::uint64_t{1} << facts.turn_bits));
  all.push_back(value(0x082, "RANGE", ResourceType::kU32,
                      std::uint64_t{1} << (facts.position_bits - facts.turn_bits)));
  all.push_back(value(0x086, "FWDATE", ResourceType::kString, 0));
  all.back().value = text("20260101");
  all.push_back(value(0x087, "EESIZE", ResourceType::kU16, kEepromBytes));
  all.push_back(value(0x0D4, "CODEDISC", ResourceType::kU16, 0));
  all.push_back(value(kResetId, "RESET", ResourceType::kVoid, 0));
  all.back().write_level = 0;
  return all;
}

ResourceTree::ResourceTree(std::vector<Resource> standard, const std::vector<Resource>& own,
                           unsigned level)
    : resources_(std::move(standard)), level_(level) {
  for (const Resource& each : own) {
    if (Resource* there = at(each.id)) {
      *there = each;
    } else {
      resources_.push_back(each);
    }
  }
  std::sort(resources_.begin(), resources_.end(),
            [](const Resource& a, const Resource& b) { return a.id < b.id; });
}

Resource* ResourceTree::at(unsigned id) {
  const auto found = std::find_if(resources_.begin(), resources_.end(),
                                  [id](const Resource& each) { return each.id == id; });
  return found == resources_.end() ? nullptr : &*found;
}

const Resource* ResourceTree::find(unsigned id) const {
  return const_cast<ResourceTree*>(this)->at(id);
}

std::vector<unsigned> ResourceTree::children(unsigned id) const {
  std::vector<unsigned> found;
  for (const Resource& each : resources_) {
    if (each.parent == id && each.id != kRootId) found.push_back(each.id);
  }
  return found;
}

ResourceAnswer ResourceTree::access(const LongRequest& request) {
  Resource* resource = at(request.id);
  if (resource == nullptr) return refused(kNoResource);
  if (!request.read) {
    return request.indirect ? write_value(*resource, request) : refused(kNoWrite);
  }
  return request.indirect ? read_value(*resource, request) : read_direct(*resource, request);
}

ResourceAnswer ResourceTree::read_direct(const Resource& resource,
                                         const LongRequest& request) const {
  const auto say = [&](std::uint64_t value) { return number(value, request.length, 2); };
  switch (request.offset) {
    case kName:
      return answered(part_of(text(resource.name), 0, request.length));
    case kSize:
      return say(resource.type == ResourceType::kNode ? 2 : resource.value.size());
    case kReadLevel:
      return say(resource.read_level);
    case kWriteLevel:
      return say(resource.write_level);
    case kTimeout:
      return say(resource.timeout_ms);
    case kType:
      return say(static_cast<unsigned>(resource.type));
    default:
      return refused(kWrongOffset);
  }
}

ResourceAnswer ResourceTree::read_value(const Resource& resource,
                                        const LongRequest& request) const {
  if (resource.type == ResourceType::kVoid) return refused(kNoRead);
  if (level_ < resource.read_level) {
    return refused(resource.read_level == Resource::kNever ? kNoRead : kLowLevel);
  }
  if (resource.type == ResourceType::kNode) {
    const std::vector<unsigned> below = children(resource.id);
    if (request.offset > below.size()) return refused(kWrongOffset);
    const std::size_t said = request.offset == 0 ? below.size() : below[request.offset - 1];
    return number(said, request.length, 2);
  }
  const unsigned bytes = bytes_of(resource.type);
  if (bytes == 0) {
    if (request.offset >= resource.value.size()) return refused(kWrongOffset);
    return answered(part_of(resource.value, request.offset, request.length));
  }
  if (request.offset != 0) return refused(kWrongOffset);
  std::uint64_t value = 0;
  for (const std::uint8_t byte : resource.value) value = value << 8U | byte;
  if (is_signed(resource.type)) {
    const unsigned above = 8 * (kMaxLength - bytes);
    value = static_cast<std::uint64_t>(static_cast<std::int64_t>(value << above) >> above);
  }
  return number(value, request.length, bytes);
}

ResourceAnswer ResourceTree::write_value(Resource& resource, const LongRequest& request) const {
  if (resource.type == ResourceType::kNode || resource.write_level == Resource::kNever) {
    return refused(kNoWrite);
  }
  if (level_ < resource.write_level) return refused(kLowLevel);
  if (resource.type == ResourceType::kVoid) {
    if (request.length != 0) return refused(kWrongLength);
    ResourceAnswer done;
    done.reset = resource.id == kResetId;
    return done;
  }
  const unsigned bytes = bytes_of(resource.type);
  if (bytes == 0) {
    if (request.offset >= resource.value.size()) return refused(kWrongOffset);
    if (request.length == 0 || request.offset + request.length > resource.value.size()) {
      return refused(kWrongLength);
    }
    std::copy(request.data.begin(), request.data.end(), resource.value.begin() + request.offset);
    return {};
  }
  if (request.offset != 0) return refused(kWrongOffset);
  if (request.length < bytes) return refused(kWrongLength);
  std::copy(request.data.end() - bytes, request.data.end(), resource.value.begin());
  return {};
}

}  // namespace mb4::sim::dsl
