// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// printf() whatever the locale.

#include <locale.h>

#include <cstdarg>
#include <cstdio>
#include <string>

namespace forceshade {

// As printf() writes them in the locale C.
[[gnu::format(printf, 1, 2)]] inline std::string formatted(const char* format, ...) {
  static const locale_t c_locale = newlocale(LC_ALL_MASK, "C", nullptr);
  char text[400];  // a binary64 has up to 309 digits in front of the point
  va_list values;
  va_start(values, format);
  const locale_t callers = uselocale(c_locale);
  std::vsnprintf(text, sizeof text, format, values);
  uselocale(callers);
  va_end(values);
  return text;
}

}  // namespace forceshade
