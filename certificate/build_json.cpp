// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/build_json.h"

#include <algorithm>

#include "forceshade/fast.h"

namespace forceshade::properties {

nlohmann::ordered_json build_json(const Build& build) {
  return {{"version", build.version},
          {"revision", build.revision},
          {"compiler", build.compiler},
          {"flags", build.flags},
          {"instruction_set", build.instruction_set},
          {"library_digest", build.library_digest}};
}

std::string digest_from(Fields& fields, const char* key) {
  std::string digest = fields.text(key);
  const auto is_hex = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  fields.expect(key, digest.size() == 64 && std::all_of(digest.begin(), digest.end(), is_hex), "a SHA-256 of 64 hex digits");
  return digest;
}

Build build_from(Fields fields) {
  const Build build{fields.text("version"), fields.text("revision"),        fields.text("compiler"),
                    fields.text("flags"),   fields.text("instruction_set"), digest_from(fields, "library_digest")};
  fields.expect("instruction_set", fast::instruction_set_named(build.instruction_set).has_value(), "scalar, avx2 or avx512");
  fields.end();
  return build;
}

}  // namespace forceshade::properties
