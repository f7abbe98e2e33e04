// SPDX-License-Identifier: BSD-3-Clause
#include "study/apparatus/motion.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <span>
#include <utility>

#include "device/kinds.h"
#include "forceshade/recording.h"
#include "run/recorder/settings.h"
#include "study/experiments/session_folder.h"

namespace forceshade::apparatus {
namespace {

namespace fs = std::filesystem;

class PartReader {
 public:
  explicit PartReader(std::vector<fs::path> parts) : parts_(std::move(parts)) {}

  std::optional<experiments::MotionSample> next() {
    while (at_ == samples_.size()) {
      if (part_ == parts_.size()) return std::nullopt;
      read(parts_[part_++]);
    }
    const device::Sample& sample = samples_[at_++];
    const auto wide = [](float number) { return static_cast<double>(number); };
    const auto& [x, y, z] = sample.position;
    const auto& [fx, fy, fz] = sample.force;
    return experiments::MotionSample{is_paced_ ? static_cast<double>(sample.wall_ns) / 1e9 : sample.device_time,
                                     wide(x),
                                     wide(y),
                                     wide(z),
                                     wide(fx),
                                     wide(fy),
                                     wide(fz)};
  }

 private:
  void read(const fs::path& part) {
    recorder::Recording recording(part);
    is_paced_ = !recording.metadata().contains("paced") || recording.metadata().at("paced") == "yes";
    samples_.clear();
    at_ = 0;
    recording.for_each_chunk([&](std::span<const device::Sample> chunk) {
      // The zero force that ends a run is no tick.
      std::ranges::copy_if(chunk, std::back_inserter(samples_),
                           [](const device::Sample& sample) { return sample.status != device::Sample::kEnd; });
    });
  }

  std::vector<fs::path> parts_;
  std::size_t part_ = 0, at_ = 0;
  bool is_paced_ = true;
  std::vector<device::Sample> samples_;
};

}  // namespace

std::vector<fs::path> parts_of(const fs::path& run) {
  std::vector<fs::path> parts;
  if (!fs::is_directory(run)) return parts;
  for (const auto& entry : fs::directory_iterator(run))
    if (entry.path().extension() == ".fsr") parts.push_back(entry.path());
  std::ranges::sort(parts);
  return parts;
}

std::optional<experiments::Motion> motion_of(const fs::path& session, int run) {
  std::vector<fs::path> parts = parts_of(experiments::ticks_of_run(session, run));
  if (parts.empty()) return std::nullopt;
  experiments::Motion motion;
  {
    const recorder::Recording first(parts.front());
    if (const auto settings = recorder::safety_settings_in(first.metadata(), first.path()))
      motion.ticks_per_second = settings->rate_hz;
    const auto text = [&](const char* key) {
      const auto found = first.metadata().find(key);
      return found == first.metadata().end() ? std::string() : found->second;
    };
    motion.model = text("device_model");
    if (device::is_simulated(text("device"))) {
      motion.manufacturer = "none, simulated by forceshade";
      motion.model = "simulated " + motion.model;
    }
  }
  motion.next = [reader = std::make_shared<PartReader>(std::move(parts))] { return reader->next(); };
  return motion;
}

}  // namespace forceshade::apparatus
