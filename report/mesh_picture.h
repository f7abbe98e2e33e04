// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A mesh from one direction, with the path of the device on it, the god-object's, and some of the forces.

#include <span>
#include <string>
#include <vector>

#include "properties/mesh_properties.h"
#include "report/depth_buffer.h"
#include "report/gnuplot.h"
#include "report/side_view.h"

namespace forceshade::properties {

// name: of the mesh, unique in a page. What the mesh hides of the path is dotted. A tick with an invalid position interrupts
// both lines. At most 40 forces are drawn, at ticks that are evenly spaced among those on the surface; each begins at the
// god-object. An empty path gives a picture of the mesh alone. values: one for each triangle, at least 0, which
// gives it its colour; none: triangles have brightness and lines.
Picture mesh_picture(const mesh::TriangleMesh& mesh, std::span<const Ticked> path, const ViewDirection& direction,
                     const std::string& name, const Heading& heading, std::span<const double> values = {});

}  // namespace forceshade::properties
