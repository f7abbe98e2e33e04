// SPDX-License-Identifier: BSD-3-Clause
#include "device/dhd/dhd_models.h"

#include <array>

namespace forceshade::device::dhd {
namespace {

// Reach and peak are those of an open-source client (CHAI3D), which are no more than the data sheets'. Those of sigma.3 and
// lambda.3, which it does not have, are taken from sigma.7 and lambda.7. No continuous force is published: half of the peak.
constexpr std::array kModels{
    Model{63, "delta.3", 150, 20, 10, 1},    Model{33, "omega.3", 75, 12, 6, 1},      Model{34, "omega.6", 75, 12, 6, 1},
    Model{36, "omega.6", 75, 12, 6, 1},      Model{35, "omega.7", 75, 12, 6, 1},      Model{37, "omega.7", 75, 12, 6, 1},
    Model{206, "sigma.3", 75, 12, 6, 1},     Model{104, "sigma.7", 75, 12, 6, 1},     Model{105, "sigma.7", 75, 12, 6, 1},
    Model{203, "lambda.3", 112.5, 12, 6, 1}, Model{108, "lambda.7", 112.5, 12, 6, 1}, Model{109, "lambda.7", 112.5, 12, 6, 1},
    Model{kFalcon, "Falcon", 40, 8, 4, 4},
};

}  // namespace

const Model* model_of(int type) noexcept {
  for (const Model& model : kModels)
    if (model.type == type) return &model;
  return nullptr;
}

}  // namespace forceshade::device::dhd
