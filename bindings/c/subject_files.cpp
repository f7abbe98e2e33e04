// SPDX-License-Identifier: BSD-3-Clause
// Subjects of the C interface from files and texts.

#include <string>

#include "bindings/c/errors.h"
#include "bindings/c/subject.h"
#include "forceshade.h"
#include "forceshade/subjects.h"

using namespace forceshade::c;

forceshade_result forceshade_subject_read(const char* file, forceshade_subject* made) {
  return guarded([&] {
    if (file == nullptr || made == nullptr) return fail(FORCESHADE_NULL_POINTER, "file or made is NULL");
    return add_subject(forceshade::subjects::read_file(file), made);
  });
}

forceshade_result forceshade_subject_parse(const char* text, size_t length, const char* file, forceshade_subject* made) {
  return guarded([&] {
    if (text == nullptr || file == nullptr || made == nullptr)
      return fail(FORCESHADE_NULL_POINTER, "text, file or made is NULL");
    return add_subject(forceshade::subjects::read_text(std::string(text, length), file), made);
  });
}
