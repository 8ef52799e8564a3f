// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

namespace lmdbench {

/// A file of the projects of `lmdbench plugin new`; an empty language means all languages.
struct TemplateFile {
  std::string_view language, name, text;
};
/// The files of template/, as of the build.
const std::vector<TemplateFile>& template_files();

}  // namespace lmdbench
