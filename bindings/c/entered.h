// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Objects that are opened, are for one thread at a time, and are closed: sessions and scenes. T has the error texts: kBusy
// while another thread is in it, kNone for an invalid handle, and kTooMany.

#include <string>

#include "bindings/c/errors.h"
#include "bindings/c/table.h"
#include "forceshade/fast.h"

namespace forceshade::c {

// Returns OK, or an error code after setting the error text, if this thread's arithmetic is at fault.
inline forceshade_result check_arithmetic() {
  const char* const fault = fast::arithmetic_fault();
  if (fault == nullptr) return FORCESHADE_OK;
  return fail(FORCESHADE_BAD_ARITHMETIC, std::string("found ") + fault + "; expected rounding to nearest, with subnormals");
}

// Returns OK and the handle of what make() gives, or an error code after setting the error text.
template <class T, class Make>
forceshade_result open(Table<T>& table, const Make& make, std::uint64_t& handle) {
  if (const forceshade_result wrong = check_arithmetic(); wrong != FORCESHADE_OK) return wrong;
  const std::uint64_t added = table.add(make());
  if (added == 0) return fail(FORCESHADE_NO_MEMORY, T::kTooMany);
  handle = added;
  return FORCESHADE_OK;
}

// Exclusive use of the object by this thread, until destruction; null if it is busy or the handle is invalid: then `result` and
// the error text say which.
template <class T>
class Entered {
 public:
  Entered(Table<T>& table, std::uint64_t handle) noexcept : slot_(table.slot_of(handle)) {
    if (slot_.handle.load(std::memory_order_acquire) != handle) [[unlikely]] {
      result = fail(FORCESHADE_BAD_HANDLE, T::kNone);
      return;
    }
    if (slot_.is_busy.exchange(true, std::memory_order_acquire)) [[unlikely]] {
      result = fail(FORCESHADE_BUSY, T::kBusy);
      return;
    }
    object_ = table.find(handle);  // it may have been closed before this thread was in it
    if (object_ != nullptr) [[likely]]
      return;
    slot_.is_busy.store(false, std::memory_order_release);
    result = fail(FORCESHADE_BAD_HANDLE, T::kNone);
  }
  ~Entered() {
    if (object_ != nullptr) slot_.is_busy.store(false, std::memory_order_release);
  }
  Entered(const Entered&) = delete;
  Entered& operator=(const Entered&) = delete;

  explicit operator bool() const noexcept { return object_ != nullptr; }
  T& operator*() const noexcept { return *object_; }
  T* operator->() const noexcept { return object_; }

  forceshade_result result = FORCESHADE_OK;

 private:
  typename Table<T>::Slot& slot_;
  T* object_ = nullptr;
};

}  // namespace forceshade::c
