// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Writes and prints the results of certify.

#include <string>
#include <vector>

#include "files/output_folder.h"
#include "forceshade/certificate.h"

namespace forceshade::apps {

inline constexpr const char* kCertificateFolder = "directory for certificate.json, certificate.html and evidence.json";

std::vector<std::string> certificate_files();

// certificate.json, certificate.html and evidence.json, all or none: the page without pictures, and a warning, where gnuplot
// does not draw them. Prints what was found of each subject, what drive would find lacking and how to gather it, and, in the
// last line, the standing. Returns the exit code. Throws files::OutputError.
int write_certificate(const properties::Certificate& certificate, files::OutputFolder& folder);

}  // namespace forceshade::apps
