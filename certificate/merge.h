// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Certificates made on one machine after the other or on many, joined into one.

#include <string>
#include <vector>

#include "certificate/certificate.h"

namespace forceshade::properties {

struct CertificateFile {
  std::string name;
  Certificate certificate;
};

// At least two certificates in any order, or parts of one exhaustive run, or both. Entries of one subject are added up: their
// seeds differ, so their points do. The parts of the run make up the whole of it. Throws CertificateError, naming the files, if
// builds or lists of sweeps differ, if a part is missing, unfinished or overlaps another, or if two entries of a subject have a
// seed in common or contradict each other.
Certificate merged(std::vector<CertificateFile> files);

}  // namespace forceshade::properties
