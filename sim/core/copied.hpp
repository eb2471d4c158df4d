// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A value of any class that derives from Base. A copy of it holds a copy of the object.
#ifndef MB4SIM_COPIED_HPP_
#define MB4SIM_COPIED_HPP_

#include <concepts>
#include <memory>
#include <utility>

namespace mb4::sim {

template <typename Base>
class Copied {
 public:
  Copied() = default;
  template <std::derived_from<Base> Object>
  Copied(Object object)  // NOLINT(google-explicit-constructor): it is such an object
      : object_(std::make_unique<Object>(std::move(object))), copy_(&copy_of<Object>) {}
  Copied(const Copied& other)
      : object_(other.copy_ == nullptr ? nullptr : other.copy_(*other.object_)),
        copy_(other.copy_) {}
  Copied(Copied&&) = default;
  Copied& operator=(Copied other) {
    object_ = std::move(other.object_);
    copy_ = other.copy_;
    return *this;
  }
  ~Copied() = default;

  Base& operator*() { return *object_; }
  const Base& operator*() const { return *object_; }
  Base* operator->() { return object_.get(); }
  const Base* operator->() const { return object_.get(); }
  // For a program that knows the class. Throws std::bad_cast if it is wrong.
  template <typename Object>
  Object& as() {
    return dynamic_cast<Object&>(*object_);
  }
  template <typename Object>
  const Object& as() const {
    return dynamic_cast<const Object&>(*object_);
  }

 private:
  using Copy = std::unique_ptr<Base> (*)(const Base& object);
  template <typename Object>
  static std::unique_ptr<Base> copy_of(const Base& object) {
    return std::make_unique<Object>(static_cast<const Object&>(object));
  }

  std::unique_ptr<Base> object_;
  Copy copy_ = nullptr;
};

}  // namespace mb4::sim

#endif  // MB4SIM_COPIED_HPP_
