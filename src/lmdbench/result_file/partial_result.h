// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/part_file.h>
#include <lmdbench/result_file/element_kind.h>
#include <lmdbench/result_file/result_writer.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// The part of a run under way: a result file (HDF5) with room for all values of the run, made by
/// `ResultWriter::reserve` before the first frame. Values are then stored through a memory mapping
/// of the file, without calls of HDF5 or the system. So the file opens at any moment and holds
/// every value stored before, whatever ends the run (even SIGKILL); a full disk shows before the
/// run; unmeasured values are unset. A crash of the machine may lose seconds, or values of a row.
namespace lmdbench {

/// `format` of a part, unlike RESULT_FORMAT: readers must not take it for a complete result.
inline constexpr const char* PART_FORMAT = "lmdbench-part";

/// A reserved dataset: rows of 8-byte numbers.
class ReservedDataset {
 public:
  ReservedDataset() = default;
  ReservedDataset(std::byte* values, std::size_t rows, std::size_t row_bytes)
      : values_(values), rows_(rows), row_bytes_(row_bytes) {}

  /// @param row_values  the row's numbers, 8 bytes each
  void set(std::size_t row, std::span<const std::byte> row_values);
  void get(std::size_t row, std::span<std::byte> row_values) const;
  /// Whether the row has exactly these bits.
  bool holds(std::size_t row, std::span<const std::byte> row_values) const;

  double real(std::size_t row) const;
  void set_real(std::size_t row, double value) { set(row, std::as_bytes(std::span(&value, 1))); }

 private:
  std::byte* place(std::size_t row, std::size_t bytes) const;

  std::byte* values_ = nullptr;
  std::size_t rows_ = 0;
  std::size_t row_bytes_ = 0;
};

class PartialResult {
 public:
  /// Starts a part with the image of a file whose datasets are reserved.
  /// @throws EnvironmentError when there is no room on the disk
  PartialResult(PartFile& part, const std::string& image);
  /// Resumes a part; unset when it is empty.
  /// @throws as `check_hdf5`; EnvironmentError when it is of another format, and so not ours
  static std::optional<PartialResult> open(PartFile& part);

  PartialResult(PartialResult&&) noexcept;
  PartialResult& operator=(PartialResult&&) noexcept;
  ~PartialResult();

  /// Text attribute `fingerprint` of the root; empty where there is none.
  const std::string& fingerprint() const;

  /// Holds the file open over many look-ups; no other reader of this process can open it then.
  void hold_open(bool open);

  /// A reserved dataset.
  /// @param row_values  numbers in a row: of shape (R, N) a row is one number, of (N, 3) three
  /// @throws InputError when the part has no such dataset of this kind and shape
  ReservedDataset dataset(const std::string& path, ElementKind kind, const std::vector<std::size_t>& shape,
                          std::size_t row_values) const;

 private:
  class Implementation;
  explicit PartialResult(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace lmdbench
