// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A mesh that a command reads: a file, or standard input where it is called "-".

#include <string>
#include <variant>

#include "forceshade/meshes.h"

namespace forceshade::apps {

// As mesh::load_with_corners(). Standard input has no name that ends in its format; the format is the one that its text begins
// as. Throws Error, with "standard input" for the file where it is that.
mesh::LoadedMesh load_mesh(const std::string& file, mesh::Unit unit);

// mesh::check() with its progress on standard error. file: what the progress is called by.
std::variant<mesh::CheckedMesh, mesh::Findings> checked_with_progress(const std::string& file, mesh::TriangleMesh triangles);

// mesh::irregularities_of() in the same way.
mesh::Irregularities irregularities_with_progress(const std::string& file, const mesh::TriangleMesh& triangles);

}  // namespace forceshade::apps
