// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Parts of an exhaustive run, made on one machine after the other or on many, joined into one certificate.

#include <string>
#include <vector>

#include "forceshade/certificate/certificate.h"

namespace forceshade::properties {

struct CertificateFile {
  std::string name;
  Certificate certificate;
};

// The parts of one exhaustive run, in any order, and at most one certificate of points and properties, which the result then
// has too. Throws CertificateError, naming the files, if builds or lists of sweeps differ, or if a part is missing,
// unfinished or overlaps another.
Certificate merged(std::vector<CertificateFile> files);

}  // namespace forceshade::properties
