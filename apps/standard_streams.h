// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Standard input, output and error of the command.

#include <initializer_list>
#include <string>
#include <string_view>

namespace forceshade::apps {

// Opens the closed ones of the three: else a file that is opened later would get its number and what is printed. Afterwards all
// three are open; reading or writing a formerly closed one fails, and so does writing beyond the limit of a file's size, which
// would end the process. Call first.
void open_standard_streams();

// Writes what was printed and std::cout to standard output. Throws files::OutputError if that fails, or if an earlier write
// failed.
void flush_standard_output();

// Prints and flushes it, unless one of these outputs of the command is "-", which is standard output itself.
void print_beside(std::initializer_list<std::string_view> outputs, const std::string& words);

}  // namespace forceshade::apps
