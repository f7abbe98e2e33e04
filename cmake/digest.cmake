# Writes OUTPUT, a source file that returns the SHA-256 of the SHA-256 sums of OBJECTS, a list of COUNT files, in the order given.
list(LENGTH OBJECTS given)
if(NOT given EQUAL COUNT)
  message(FATAL_ERROR "cmake/digest.cmake: expected ${COUNT} objects, got ${given}: ${OBJECTS}")
endif()
set(sums "")
foreach(object IN LISTS OBJECTS)
  file(SHA256 ${object} sum)
  string(APPEND sums ${sum})
endforeach()
string(SHA256 digest "${sums}")
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT [[// Made by cmake/digest.cmake.
#include "forceshade/fast.h"

namespace forceshade::fast {

const char* library_digest() noexcept {
  return "@digest@";
}

}  // namespace forceshade::fast
]] @ONLY)
