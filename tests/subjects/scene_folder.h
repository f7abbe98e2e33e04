// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Files of subjects in a folder of their own, and what is read of them or refused.

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

#include "forceshade/subjects.h"
#include "subjects/read.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/words.h"

namespace forceshade::subjects {

// With a plate of two triangles and a tetrahedron with groups and materials.
class SceneFolder : public testing::Test {
 protected:
  SceneFolder() {
    folder.write("plate.off", "OFF\n4 2 0\n-4 -4 0\n4 -4 0\n4 4 0\n-4 4 0\n3 0 1 2\n3 0 2 3\n");
    folder.write(
        "its.obj",
        "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nusemtl rubber\ng tyre\nf 1 3 2\nusemtl steel\nf 1 2 4\ng\nf 1 4 3\nf 2 3 4\n");
  }

  Description read_scene_of(const std::string& text, std::initializer_list<Option> others = {}) {
    Options all{{"scene", folder.write("table.toml", text)}};
    for (const Option& one : others) all.add(one);
    return read_one(all);
  }
  void expect_refusal(const std::string& text, const std::string& words, std::initializer_list<Option> others = {}) {
    const std::string refused = tests::thrown_by<Error>([&] { read_scene_of(text, others); });
    EXPECT_NE(refused.find(words), std::string::npos) << "of:\n" << text << "got: " << refused << "\nexpected: " << words;
  }

  tests::TemporaryDirectory folder;
};

}  // namespace forceshade::subjects
