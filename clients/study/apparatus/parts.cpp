// SPDX-License-Identifier: BSD-3-Clause
#include "study/apparatus/parts.h"

#include <chrono>
#include <utility>

#include "run/recorder/loss.h"
#include "system/system.h"

namespace forceshade::apparatus {

struct Parts::Part {
  Part(const std::string& path_of_it, recorder::Metadata metadata, const recorder::Recorder::Options& options)
      : path(path_of_it), recorder(path_of_it, std::move(metadata), options) {}

  std::string path;
  recorder::Recorder recorder;
  std::uint64_t ticks = 0;  // the loop's
};

Parts::Parts(const recorder::Recorder::Options& options) : options_(options) {}

Parts::~Parts() {
  if (closing_.is_joinable()) closing_.join();
}

void Parts::begin(const std::string& path, recorder::Metadata metadata) {
  expect_closed();
  metadata["part"] = std::to_string(number_ + 1);
  auto next = std::make_unique<Part>(path, std::move(metadata), options_);
  ++number_;
  // A hazard pointer: the loop says what it uses before it looks again whether that is still current.
  system::step();
  current_ = next.get();
  if (std::unique_ptr<Part> before = std::exchange(part_, std::move(next))) {
    while (in_use_ == before.get()) system::sleep_for(std::chrono::microseconds(50));
    close(std::move(before), "the next part began");
  }
}

void Parts::end(const std::string& end_reason) {
  system::step();
  current_ = nullptr;
  std::unique_ptr<Part> last = std::move(part_);
  try {
    expect_closed();
  } catch (const Error&) {
    if (last) last->recorder.close(end_reason);
    throw;
  }
  if (last) close(std::move(last), end_reason);
  expect_closed();
}

bool Parts::failing() const noexcept {
  return part_ && part_->recorder.failing();
}

void Parts::push(const device::Sample& sample) noexcept {
  Part* part = nullptr;
  do {
    system::step();
    part = current_;
    system::step();
    in_use_ = part;
    system::step();
  } while (part != current_);
  if (part != nullptr) {
    device::Sample own = sample;
    own.tick = part->ticks++;
    part->recorder.push(own);
  }
  system::step();
  in_use_ = nullptr;
}

void Parts::close(std::unique_ptr<Part> part, const std::string& why) {
  closing_ = system::Thread("closing part", [this, closed = std::shared_ptr<Part>(std::move(part)), why] {
    if (const std::string words = recorder::words_of_loss(closed->path, closed->recorder.close(why)); !words.empty())
      lost_ = words;
  });
}

void Parts::expect_closed() {
  if (!closing_.is_joinable()) return;
  closing_.join();
  if (const std::string lost = std::exchange(lost_, {}); !lost.empty()) throw Error(lost);
}

}  // namespace forceshade::apparatus
