// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Memory for large arrays that are read here and there: in pages of 2 MB where the system has them, since a tick that reaches
// a triangle for the first time would otherwise also wait for the address of its page. No result depends on it.

#include <cstddef>
#include <new>
#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace forceshade::fast {

template <class T>
struct LargePages {
  using value_type = T;
  static constexpr std::size_t kPage = std::size_t{2} << 20;

  LargePages() noexcept = default;
  template <class Other>
  LargePages(const LargePages<Other>&) noexcept {}

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes < kPage) return static_cast<T*>(::operator new (bytes, std::align_val_t{alignof(T)}));
    void* const place = ::operator new (whole_pages(bytes), std::align_val_t{kPage});
#if defined(__linux__)
    ::madvise(place, whole_pages(bytes), MADV_HUGEPAGE);  // a system without such pages refuses, and nothing is lost
#endif
    return static_cast<T*>(place);
  }
  void deallocate(T* place, std::size_t count) noexcept {
    // Without the size, which clang++ 14 takes only with a flag.
    ::operator delete (place, std::align_val_t{count * sizeof(T) < kPage ? alignof(T) : kPage});
  }

  template <class Other>
  bool operator==(const LargePages<Other>&) const noexcept {
    return true;
  }

 private:
  static std::size_t whole_pages(std::size_t bytes) noexcept {
    return (bytes + kPage - 1) / kPage * kPage;
  }
};

}  // namespace forceshade::fast
