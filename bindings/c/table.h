// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Handles of the C interface: the index of a slot with the slot's generation, so that a handle that was freed, or never given,
// is found to be none. Slots are never given back to the system, so that looking at one is always safe.

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace forceshade::c {

template <class T>
class Table {
 public:
  struct Slot {
    std::atomic<std::uint32_t> generation = 1;  // of the handle that is valid now, or will be the next one
    std::atomic<T*> object = nullptr;
    std::atomic<bool> is_busy = false;  // for who uses the object alone
  };

  // 0 where there is no further slot. Throws std::bad_alloc.
  std::uint64_t add(std::unique_ptr<T> object) {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) grow();
    if (free_.empty()) return 0;
    const std::uint32_t index = free_.back();
    free_.pop_back();
    Slot& slot = owned_[index / kPerBlock][index % kPerBlock];
    slot.object.store(object.release(), std::memory_order_release);
    return std::uint64_t{slot.generation.load(std::memory_order_relaxed)} << 32U | (index + 1);
  }

  // Null for a handle that is none.
  Slot* slot(std::uint64_t handle) const noexcept {
    Slot* const slot = slot_at(static_cast<std::uint32_t>(handle) - 1);
    return slot != nullptr && is_of(*slot, handle) ? slot : nullptr;
  }
  T* find(std::uint64_t handle) const noexcept {
    Slot* const found = slot(handle);
    return found == nullptr ? nullptr : found->object.load(std::memory_order_acquire);
  }
  static bool is_of(const Slot& slot, std::uint64_t handle) noexcept {
    return slot.generation.load(std::memory_order_acquire) == handle >> 32U &&
           slot.object.load(std::memory_order_acquire) != nullptr;
  }

  // The handle is none from then on. Null where it was none.
  std::unique_ptr<T> take(std::uint64_t handle) {
    const std::lock_guard lock(mutex_);
    Slot* const its = slot(handle);
    if (its == nullptr) return nullptr;
    std::unique_ptr<T> object(its->object.exchange(nullptr));
    // A slot that has gone through all generations is not used again.
    if (its->generation.fetch_add(1) != UINT32_MAX) free_.push_back(static_cast<std::uint32_t>(handle) - 1);
    return object;
  }

 private:
  static constexpr std::uint32_t kPerBlock = 1024, kBlocks = 1024;

  // Null beyond the last one.
  Slot* slot_at(std::uint32_t index) const noexcept {
    if (index >= kPerBlock * kBlocks) return nullptr;
    Slot* const block = blocks_[index / kPerBlock].load(std::memory_order_acquire);
    return block == nullptr ? nullptr : block + index % kPerBlock;
  }

  void grow() {
    if (used_blocks_ == kBlocks) return;
    free_.reserve(std::size_t{kPerBlock} * (used_blocks_ + 1));  // so that take() never allocates
    owned_.reserve(kBlocks);
    owned_.push_back(std::make_unique<Slot[]>(kPerBlock));
    for (std::uint32_t i = kPerBlock; i-- > 0;) free_.push_back(used_blocks_ * kPerBlock + i);
    blocks_[used_blocks_++].store(owned_.back().get(), std::memory_order_release);
  }

  std::array<std::atomic<Slot*>, kBlocks> blocks_{};
  std::mutex mutex_;
  std::vector<std::uint32_t> free_;  // slots without an object
  std::vector<std::unique_ptr<Slot[]>> owned_;
  std::uint32_t used_blocks_ = 0;
};

}  // namespace forceshade::c
