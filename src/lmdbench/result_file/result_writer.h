// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/part_file.h>
#include <lmdbench/result_file/element_kind.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace lmdbench {

/// What a reader must know of a dataset; the writer cannot make one without it.
struct DatasetInfo {
  std::string path;       ///< Absolute, e.g. "/methods/improved/force"; groups are made.
  std::string units;      ///< SI symbol, "1" for counts, ratios and indices
  std::string long_name;  ///< One phrase
};

/// Unknown values in `ResultWriter::reserve` are NaN, or this for integers.
inline constexpr std::int64_t UNSET_INTEGER = -1;

/// Writes one result file (HDF5). `commit` writes it from memory to a `.part` file, flushes that to
/// disk and gives it the final name: until then an earlier result stays whole, and an interrupted
/// run never looks finished. The `.part` file is made at once, so that a bad place shows before a
/// long run.
/// @throws EnvironmentError when the file cannot be made, written or renamed, or when another run
///         is writing it
/// @throws std::invalid_argument for a shape that does not fit, a path that is not absolute or was
///         written before, and missing units or long name: mistakes of the calling code
class ResultWriter {
 public:
  explicit ResultWriter(std::filesystem::path file);
  ResultWriter();   ///< In memory only, for `image`.
  ~ResultWriter();  ///< Closes; leaves the `.part` file where nothing was committed.
  ResultWriter(const ResultWriter&) = delete;
  ResultWriter& operator=(const ResultWriter&) = delete;

  /// Row-major datasets; the product of `shape` equals `values.size()`, and a zero-sized shape is
  /// allowed.
  /// Chunked along the first axis, shuffled and deflated where they are large enough for it.
  void write(const DatasetInfo& info, std::span<const double> values, const std::vector<std::size_t>& shape);
  void write(const DatasetInfo& info, std::span<const std::int64_t> values,
             const std::vector<std::size_t>& shape);
  void write(const DatasetInfo& info, std::span<const std::uint8_t> values,
             const std::vector<std::size_t>& shape);
  void write(const DatasetInfo& info, const std::vector<std::string>& values);

  /// A dataset whose values come later by `PartialResult`: contiguous, every value unset.
  void reserve(const DatasetInfo& info, ElementKind kind, const std::vector<std::size_t>& shape);

  /// Attributes of the group or dataset at `path` ("/" is the root; missing groups are made).
  void attribute(const std::string& path, const std::string& name, const std::string& value);
  void attribute(const std::string& path, const std::string& name, std::int64_t value);
  void attribute(const std::string& path, const std::string& name, double value);

  /// The file so far.
  std::string image();

  /// The part that `commit` turns into the result.
  PartFile& part();

  /// Adds the content's hash (`hdf5_check.h`), flushes to disk and gives the file its name,
  /// replacing an earlier one at once. After a throw nothing is lost: call it again.
  void commit();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace lmdbench
