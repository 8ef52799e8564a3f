// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/result_file/element_kind.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lmdbench {

/// Reads one result file (HDF5, `results/README.md`) by any writer. Opening checks the whole file
/// for damage, format and major version; reading checks a dataset's type. Paths are absolute
/// ("/methods/improved/force"). Links and datasets of other files are refused; HDF5's own crashes
/// and loops on damaged files stay in a child process (`check_hdf5`).
///
/// Every function throws InputError (exit code 3) naming the file, the dataset and a remedy: a file
/// missing, cut off, not HDF5, of another format or version; a dataset missing, damaged or of
/// another type. One reader serves one thread.
class ResultReader {
 public:
  explicit ResultReader(std::filesystem::path file);
  ~ResultReader();
  ResultReader(ResultReader&&) noexcept;
  ResultReader& operator=(ResultReader&&) noexcept;

  const std::filesystem::path& file() const;

  /// Whether there is a group or dataset of that name.
  bool has(const std::string& path) const;
  /// Names inside a group, sorted; empty where the group is missing.
  std::vector<std::string> groups(const std::string& group) const;
  std::vector<std::string> datasets(const std::string& group) const;

  /// Extents, first axis first; empty for a scalar.
  std::vector<std::size_t> shape(const std::string& dataset) const;
  ElementKind kind(const std::string& dataset) const;

  /// All values, row-major. Numbers of either kind can be read as reals, only integers as integers.
  std::vector<double> reals(const std::string& dataset) const;
  std::vector<std::int64_t> integers(const std::string& dataset) const;
  std::vector<std::string> texts(const std::string& dataset) const;

  /// Names of the attributes of a group or dataset, sorted; empty where the object is missing.
  std::vector<std::string> attributes(const std::string& object) const;
  /// Kind of an attribute's value; unset where there is none of that name.
  std::optional<ElementKind> attribute_kind(const std::string& object, const std::string& name) const;
  /// Attributes of a group or dataset ("/" is the root); unset where there is none of that name.
  std::optional<std::string> text_attribute(const std::string& object, const std::string& name) const;
  std::optional<std::int64_t> integer_attribute(const std::string& object, const std::string& name) const;
  std::optional<double> real_attribute(const std::string& object, const std::string& name) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// A sweep has points, not methods with frames: for `lmdbench report`, scripts/figures/sweep.py.
/// @throws UsageError for the result of one
void refuse_sweep(const ResultReader& file);

}  // namespace lmdbench
