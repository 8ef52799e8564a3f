// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

namespace lmdbench {

/// A file of the projects that `lmdbench plugin new` writes; of no language: of every one.
struct TemplateFile {
  std::string_view language, name, text;
};
/// What stands in template/, as it was when the program was built.
const std::vector<TemplateFile>& template_files();

}  // namespace lmdbench
