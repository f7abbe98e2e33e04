// SPDX-License-Identifier: BSD-3-Clause
#include "apps/command_check.h"

#include "run/recorder/settings.h"

namespace forceshade::apps {

CommandCheck::CommandCheck(const recorder::Recording& recording) {
  const recorder::Metadata& metadata = recording.metadata();
  const auto is_other = [&](const char* key, const char* plain) { return metadata.contains(key) && metadata.at(key) != plain; };
  if (!recording.has_all_columns())
    why_not_ = "the recording is of an earlier format, without what the device reported";
  else if (is_other("origin_mm", "0,0,0") || is_other("axes", "+x,+y,+z"))
    why_not_ = "the law was placed elsewhere, and the device's own positions are not recorded";
  else if (const auto settings = recorder::safety_settings_in(metadata, recording.path()))
    retrace_.emplace(*settings);
  else
    why_not_ = "the settings of the supervisor and the passivity controller are not recorded";
}

bool CommandCheck::is_same(const device::Sample& sample) {
  if (!retrace_ || sample.status == device::Sample::kEnd) return true;
  ++ticks_;
  changed_ += sample.law_force != sample.force ? 1 : 0;
  if (device::is_same(retrace_->next(sample), sample)) return true;
  ++differences_;
  return false;
}

}  // namespace forceshade::apps
