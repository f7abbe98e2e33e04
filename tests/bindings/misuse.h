// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Misuses of a C interface: each is a call with its result and a part of its sentence. Those of files, texts and batches are
// the same for both interfaces.

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "forceshade.h"

namespace forceshade::tests {

using Use = std::function<forceshade_result()>;

struct Misuse {
  std::string what;
  Use call;
  forceshade_result expected;
  std::string words;
};

// read and parse: of the interface whose handles are of this type.
template <class Made>
std::vector<Misuse> misuses_of_files(forceshade_result (*read)(const char*, Made*),
                                     forceshade_result (*parse)(const char*, std::size_t, const char*, Made*)) {
  static Made made{};
  const auto text = [=](const std::string& its) {
    return [=] {
      Made untouched{42};
      const forceshade_result result = parse(its.data(), its.size(), "x.toml", &untouched);
      EXPECT_EQ(untouched.handle, 42U) << "nothing is written where nothing is made";
      return result;
    };
  };
  const auto null = FORCESHADE_NULL_POINTER, input = FORCESHADE_BAD_INPUT;
  return {{"file null", [=] { return read(nullptr, &made); }, null, "NULL"},
          {"file made null", [=] { return read("x.toml", nullptr); }, null, "NULL"},
          {"file absent", [=] { return read("/nowhere/x.toml", &made); }, input, "/nowhere/x.toml"},
          {"file empty name", [=] { return read("", &made); }, input, "cannot be opened"},
          {"file a folder", [=] { return read("/", &made); }, input, "/"},
          {"text null", [=] { return parse(nullptr, 3, "x", &made); }, null, "NULL"},
          {"text file null", [=] { return parse("x", 1, nullptr, &made); }, null, "NULL"},
          {"text made null", [=] { return parse("x", 1, "x", nullptr); }, null, "NULL"},
          {"text empty", text(""), input, "x.toml: has none of the keys"},
          {"text key", text("lav = 1\n"), input, "line 1: unknown key lav"},
          {"text syntax", text("law = =\n"), input, "x.toml: line 1"},
          {"text of a scene that moves", text("scene = \"" FORCESHADE_SOURCE_DIR "/examples/scenes/moving.toml\"\n"), input,
           "moving.toml: expected no object with a motion here; a session of a scene takes the poses of each tick"},
          {"text zeros", text(std::string(3, '\0')), input, "x.toml"},
          {"text stiffness", text("law = \"wall\"\nstiffness = \"0N/mm\"\n"), input, "stiffness"},
          {"text mesh absent", text("mesh = \"absent.off\"\nunit = \"mm\"\nstiffness = \"1N/mm\"\n"), input, "absent.off"}};
}

// with: makes the use of a batch that is right but for this change.
template <class With>
std::vector<Misuse> misuses_of_batches(const std::string& of, const With& with) {
  using Its = forceshade_batch&;
  const auto moved = [](auto* pointer, int bytes) {
    return reinterpret_cast<decltype(pointer)>(reinterpret_cast<std::uintptr_t>(pointer) + static_cast<std::uintptr_t>(bytes));
  };
  const auto null = FORCESHADE_NULL_POINTER, size = FORCESHADE_BAD_SIZE;
  return {{of + "size", with([](Its its) { its.size = 4; }), size, "sizeof(forceshade_batch)"},
          {of + "position stride", with([](Its its) { its.position_stride = 13; }), size, "multiple of 4"},
          {of + "position component", with([](Its its) { its.position_component = 2; }), size, "multiple of 4"},
          {of + "force stride", with([](Its its) { its.force_stride = -6; }), size, ""},
          {of + "force component", with([](Its its) { its.force_component = 0; }), size, ""},
          {of + "force stride 0", with([](Its its) { its.force_stride = 0; }), size, "not 0"},
          {of + "status stride 0", with([](Its its) { its.status_stride = 0; }), size, "expected"},
          {of + "count", with([](Its its) { its.count = SIZE_MAX; }), size, "count"},
          {of + "positions not aligned", with([=](Its its) { its.positions = moved(its.positions, 1); }), size, "expected"},
          {of + "forces not aligned", with([=](Its its) { its.forces = moved(its.forces, 2); }), size, ""},
          {of + "positions null", with([](Its its) { its.positions = nullptr; }), null, "NULL"},
          {of + "forces null", with([](Its its) { its.forces = nullptr; }), null, "NULL"}};
}

// uses: every use of a handle that there is not.
template <class Handle, class Uses>
void add_handles(std::vector<Misuse>& all, const std::string& name, const std::vector<Handle>& handles, const Uses& uses) {
  for (const Handle handle : handles)
    for (const Use& use : uses(handle))
      all.push_back({name + " " + std::to_string(handle.handle), use, FORCESHADE_BAD_HANDLE, "handle: it was never"});
}

inline void add(std::vector<Misuse>& all, std::vector<Misuse> more) {
  for (Misuse& one : more) all.push_back(std::move(one));
}

inline void expect_each(const std::vector<Misuse>& all, const char* (*message)(), std::size_t least) {
  for (const Misuse& misuse : all) {
    EXPECT_EQ(misuse.call(), misuse.expected) << misuse.what << ": " << message();
    const std::string sentence = message();
    EXPECT_FALSE(sentence.empty()) << misuse.what;
    EXPECT_NE(sentence.find(misuse.words), std::string::npos) << misuse.what << ": " << sentence;
  }
  std::printf("%zu misuses\n", all.size());
  EXPECT_GE(all.size(), least);
}

}  // namespace forceshade::tests
