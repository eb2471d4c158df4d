// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

// A view of contiguous memory: pointer and length. C++17 and many freestanding libraries have no
// std::span.

#ifndef ENC_SPAN_HPP_
#define ENC_SPAN_HPP_

#include <array>
#include <cstddef>
#include <type_traits>

namespace enc {

// Does not own the memory; the memory must outlive the view. `Span<T>` converts to
// `Span<const T>`, never back. Indexing is not range checked.
template <typename T>
class Span {
 public:
  constexpr Span() = default;
  constexpr Span(T* data, std::size_t size) : data_(data), size_(size) {}

  template <std::size_t kSize>
  constexpr Span(T (&array)[kSize]) : data_(array), size_(kSize) {}

  template <typename U, std::size_t kSize,
            typename = std::enable_if_t<std::is_convertible_v<U (*)[], T (*)[]>>>
  constexpr Span(std::array<U, kSize>& array) : data_(array.data()), size_(kSize) {}

  template <typename U, std::size_t kSize,
            typename = std::enable_if_t<std::is_convertible_v<const U (*)[], T (*)[]>>>
  constexpr Span(const std::array<U, kSize>& array) : data_(array.data()), size_(kSize) {}

  template <typename U, typename = std::enable_if_t<std::is_convertible_v<U (*)[], T (*)[]>>>
  constexpr Span(Span<U> other) : data_(other.data()), size_(other.size()) {}

  [[nodiscard]] constexpr T* data() const { return data_; }
  [[nodiscard]] constexpr std::size_t size() const { return size_; }
  [[nodiscard]] constexpr bool empty() const { return size_ == 0; }
  [[nodiscard]] constexpr T& operator[](std::size_t index) const { return data_[index]; }
  [[nodiscard]] constexpr T* begin() const { return data_; }
  [[nodiscard]] constexpr T* end() const { return data_ + size_; }

  // The first `count` elements; `count` must not exceed size().
  [[nodiscard]] constexpr Span first(std::size_t count) const { return Span(data_, count); }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace enc

#endif  // ENC_SPAN_HPP_
