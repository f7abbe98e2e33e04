// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Handles of the C interface: the index of a slot, and in the upper half how often the slot has been given out, so that a
// handle that was freed, or never given, is found to be none. Slots stay where they are, so that looking at one is always safe.

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>

#include "bindings/c/mutex.h"

namespace forceshade::c {

template <class T>
class Table {
 public:
  static constexpr std::uint32_t kSlots = 1U << 16U;

  struct alignas(32) Slot {
    std::atomic<T*> object = nullptr;
    std::atomic<std::uint64_t> handle = 0;  // that of the object, or of the last one; 0: none yet
    std::atomic<bool> is_busy = false;      // the mark of exclusive use
  };

  constexpr Table() = default;

  // 0 where there is no further slot. Throws std::bad_alloc.
  std::uint64_t add(std::unique_ptr<T> object) {
    const std::lock_guard lock(mutex_);
    if (!freed_) freed_ = std::make_unique_for_overwrite<std::uint32_t[]>(kSlots);  // so that take() never allocates
    if (freed_count_ == 0 && touched_ == kSlots) return 0;
    std::uint32_t index = touched_;
    if (freed_count_ == 0)
      ++touched_;
    else
      index = freed_[--freed_count_];
    Slot& slot = slots_[index];
    const std::uint64_t use = (slot.handle.load(std::memory_order_relaxed) >> 32U) + 1;
    const std::uint64_t handle = use << 32U | index;
    slot.handle.store(handle, std::memory_order_release);
    slot.object.store(object.release(), std::memory_order_release);
    return handle;
  }

  // Returns null for an invalid handle.
  T* find(std::uint64_t handle) const noexcept {
    const Slot& its = slots_[handle % kSlots];
    if (its.handle.load(std::memory_order_acquire) != handle) [[unlikely]]
      return nullptr;
    return its.object.load(std::memory_order_acquire);
  }
  // The slot in which the handle is, if it is one.
  Slot& slot_of(std::uint64_t handle) noexcept { return slots_[handle % kSlots]; }

  // Invalidates the handle. Returns null for an invalid one.
  std::unique_ptr<T> take(std::uint64_t handle) {
    const std::lock_guard lock(mutex_);
    if (find(handle) == nullptr) return nullptr;
    std::unique_ptr<T> object(slot_of(handle).object.exchange(nullptr));
    // A slot whose uses can no longer be counted is not given out again.
    if (handle >> 32U != UINT32_MAX) freed_[freed_count_++] = static_cast<std::uint32_t>(handle);
    return object;
  }

 private:
  std::array<Slot, kSlots> slots_{};  // memory that is not touched before it is used
  Mutex mutex_;
  std::unique_ptr<std::uint32_t[]> freed_;  // slots, of which so many are to be given out again
  std::uint32_t freed_count_ = 0;
  std::uint32_t touched_ = 0;  // the number of slots that have been used
};

// A table that is there before the first function runs and is never destroyed, because other threads may still use it while the
// process ends.
template <class T>
union Lasting {
  constexpr Lasting() : table() {}
  ~Lasting() {}
  Table<T> table;
};

}  // namespace forceshade::c
