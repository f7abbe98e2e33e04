// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Objects that one thread may be in at a time: sessions and scenes.

#include <atomic>

#include "forceshade/error.h"

namespace forceshade::python {

// This thread alone is in it, as long as this lives. T has a flag is_busy, and kBusy, the sentence for another thread.
template <class T>
class Entered {
 public:
  explicit Entered(T& object) noexcept
      : object_(object.is_busy.exchange(true, std::memory_order_acquire) ? nullptr : &object) {}
  ~Entered() {
    if (object_ != nullptr) object_->is_busy.store(false, std::memory_order_release);
  }
  Entered(const Entered&) = delete;
  Entered& operator=(const Entered&) = delete;

  explicit operator bool() const noexcept { return object_ != nullptr; }
  const Entered& or_throw() const {
    if (object_ == nullptr) throw Error(T::kBusy);
    return *this;
  }

 private:
  T* object_;
};

}  // namespace forceshade::python
