// SPDX-License-Identifier: BSD-3-Clause
#include <sstream>

#include "files/csv.h"
#include "tests/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace forceshade;
  std::istringstream in{std::string(fuzz::text_of(data, size))};
  fuzz::read_or_refuse<Error>("in.csv:", [&] {
    files::Reader rows(in, "in.csv", {"x_mm", "y_mm", "z_mm"});
    std::size_t last = 1;
    while (rows.next()) {
      fuzz::require(rows.line() > last, "each row begins on a later line");
      last = rows.line();
      for (std::size_t i = 0; i < 3; ++i) {
        rows.binary32(i);
        rows.binary64(i);
      }
    }
  });
  return 0;
}
