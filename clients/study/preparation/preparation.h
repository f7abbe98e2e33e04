// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The certificates of an experiment: one for each bump that a session can render. It links
// the exact side.
//
//   const std::atomic<bool> stop = false;
//   const bool held = apparatus::prepare("mine.toml", "certificates", {.threads = 2}, stop);
//   if (!held) std::puts("one of the bumps is not rendered right");
//
// Errors: prepare() throws std::runtime_error for a protocol, a stimulus or a folder that cannot be used, and Interrupted.
//
// Threads: prepare() keeps no state; `stop` may be set by any thread or a signal handler.
//
// Not promised: how long it takes, which is seconds for a law and minutes for a mesh. What was made before it was stopped is
// kept, and a second call makes the rest.

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

namespace forceshade::apparatus {

struct Prepared {
  std::size_t number = 0, of = 0;  // from 1
  std::string bump;                // "bump-1p-shaded, 640 mil"
  bool was_there = false;          // a certificate of this build, which was kept
  std::string why_not = {};        // why it does not let the bump be driven; empty where it does
};

struct PreparationOptions {
  unsigned threads = 1;
  std::function<void(const Prepared&)> done = [](const Prepared&) {};  // called after each bump
};

// Certifies each bump of the protocol of which the folder, which has to exist, lacks a certificate of this build, with as many
// points and cases as driving demands. True where every bump may now be driven.
bool prepare(const std::filesystem::path& protocol, const std::filesystem::path& folder, const PreparationOptions& options,
             const std::atomic<bool>& stop);

}  // namespace forceshade::apparatus
