// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/doors/answer.h"

#include "files/child_process.h"
#include "files/json_line.h"

namespace forceshade::conformance {

const nlohmann::ordered_json& list_in(const nlohmann::ordered_json& answer, const char* key, std::size_t size,
                                      const char* asked, const char* whose) {
  const auto all = answer.find(key);
  if (all == answer.end() || !all->is_array())
    throw files::ProcessFailed(std::string("the ") + whose + " answered without a list \"" + key +
                               "\": " + files::shown_json(answer));
  if (all->size() != size)
    throw files::ProcessFailed(std::string("the ") + whose + " answered " + std::to_string(size) + ' ' + asked + " with " +
                               std::to_string(all->size()) + " entries of \"" + key + '"');
  return *all;
}

}  // namespace forceshade::conformance
