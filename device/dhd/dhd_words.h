// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Texts for errors of a DHD device, with advice for each.

#include <string>

namespace forceshade::device::dhd {

struct Meaning {
  int code;
  const char *name, *advice;
};

// An error number of DHD; one that is unknown has words, too.
const Meaning& meaning_of_error(int code) noexcept;

// The cause that a status gives for forces that the device switched off by itself.
const Meaning& meaning_of_cause(int cause) noexcept;

// "reading the position: communication with the device failed (DHD error 2, the vendor says "..."): check cable and power"
std::string sentence(const char* what, int error, const char* vendors_words);

// "the device has switched its forces off: the force button was pressed: ..."
std::string forces_are_off(int cause);

}  // namespace forceshade::device::dhd
