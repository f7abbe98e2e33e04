// SPDX-License-Identifier: BSD-3-Clause
// The parts of C++20 that this project uses and the library of emscripten 3.1.6 (LLVM 13) lacks. Each source file of the preset
// wasm includes it first.
#pragma once
#ifdef __cplusplus
#include <algorithm>
#include <array>
#include <bit>
#include <compare>
#include <functional>
#include <iterator>
#include <memory>
#include <thread>
#include <type_traits>

#include "charconv.h"

static_assert(_LIBCPP_VERSION < 14000, "this library may have all that is below: try without this file");

namespace std {

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}

template <class T, size_t n>
constexpr auto operator<=>(const array<T, n>& a, const array<T, n>& b) {
  for (size_t i = 0; i < n; ++i)
    if (const auto order = a[i] <=> b[i]; order != 0) return order;
  return a.size() <=> b.size();
}

template <class T>
  requires is_unbounded_array_v<T>
unique_ptr<T> make_unique_for_overwrite(size_t size) {
  return unique_ptr<T>(new remove_extent_t<T>[size]);
}

// There are no threads: what one would do is done at once.
class jthread {
 public:
  template <class F, class... Arguments>
  explicit jthread(F&& work, Arguments&&... its) {
    invoke(work, its...);
  }
};

// std::ranges of what has iterators, with a projection where this project uses one.
namespace ranges {
template <class R, class P>
constexpr bool all_of(R&& r, P p) { return std::all_of(std::begin(r), std::end(r), p); }
template <class R, class P>
constexpr bool any_of(R&& r, P p) { return std::any_of(std::begin(r), std::end(r), p); }
template <class R, class P>
constexpr bool none_of(R&& r, P p) { return std::none_of(std::begin(r), std::end(r), p); }
template <class R, class T>
constexpr bool binary_search(R&& r, const T& value) { return std::binary_search(std::begin(r), std::end(r), value); }
template <class R, class T>
constexpr auto count(R&& r, const T& value) { return std::count(std::begin(r), std::end(r), value); }
template <class R, class P>
constexpr auto count_if(R&& r, P p) { return std::count_if(std::begin(r), std::end(r), p); }
template <class A, class B, class P = std::equal_to<>>
constexpr bool equal(A&& a, B&& b, P p = {}) { return std::equal(std::begin(a), std::end(a), std::begin(b), std::end(b), p); }
template <class R, class T, class Projection = identity>
constexpr auto find(R&& r, const T& value, Projection of = {}) {
  return std::find_if(std::begin(r), std::end(r), [&](const auto& x) { return invoke(of, x) == value; });
}
template <class R, class P>
constexpr auto find_if(R&& r, P p) { return std::find_if(std::begin(r), std::end(r), p); }
template <class R, class T, class Less = std::less<>, class Projection = identity>
constexpr auto lower_bound(R&& r, const T& value, Less is_less = {}, Projection of = {}) {
  return std::lower_bound(std::begin(r), std::end(r), value, [&](const auto& x, const T& v) { return is_less(invoke(of, x), v); });
}
template <class R, class Less = std::less<>, class Projection = identity>
constexpr auto max_element(R&& r, Less is_less = {}, Projection of = {}) {
  return std::max_element(std::begin(r), std::end(r), [&](const auto& a, const auto& b) { return is_less(invoke(of, a), invoke(of, b)); });
}
template <class R, class Less = std::less<>, class Projection = identity>
constexpr auto max(R&& r, Less is_less = {}, Projection of = {}) {
  return *ranges::max_element(r, is_less, of);
}
template <class R, class Less = std::less<>, class Projection = identity>
constexpr auto min_element(R&& r, Less is_less = {}, Projection of = {}) {
  return std::min_element(std::begin(r), std::end(r), [&](const auto& a, const auto& b) { return is_less(invoke(of, a), invoke(of, b)); });
}
template <class R, class T>
constexpr void replace(R&& r, const T& old, const T& its) { std::replace(std::begin(r), std::end(r), old, its); }
template <class R, class Less = std::less<>, class Projection = identity>
constexpr void sort(R&& r, Less is_less = {}, Projection of = {}) {
  std::sort(std::begin(r), std::end(r), [&](const auto& a, const auto& b) { return is_less(invoke(of, a), invoke(of, b)); });
}
template <class R, class Out, class F>
constexpr auto transform(R&& r, Out out, F f) { return std::transform(std::begin(r), std::end(r), out, f); }
template <class R, class T, class Less = std::less<>, class Projection = identity>
constexpr auto upper_bound(R&& r, const T& value, Less is_less = {}, Projection of = {}) {
  return std::upper_bound(std::begin(r), std::end(r), value, [&](const T& v, const auto& x) { return is_less(v, invoke(of, x)); });
}
}  // namespace ranges
}  // namespace std
#endif
