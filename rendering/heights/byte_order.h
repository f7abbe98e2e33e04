// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Numbers of the other byte order.

#include <algorithm>
#include <bit>
#include <vector>

namespace forceshade::heights {

template <class T>
void reverse_bytes(std::vector<T>& numbers) {
  for (T& number : numbers) {
    auto* bytes = reinterpret_cast<char*>(&number);
    std::reverse(bytes, bytes + sizeof(T));
  }
}

}  // namespace forceshade::heights
