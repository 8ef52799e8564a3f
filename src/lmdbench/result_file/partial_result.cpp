// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/result_file/hdf5_check.h>
#include <lmdbench/result_file/hdf5_handle.h>
#include <lmdbench/result_file/partial_result.h>

#include <sys/mman.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace lmdbench {

namespace {

constexpr std::size_t VALUE_BYTES = 8;

/// The file under the part's mapping. Without HDF5's own lock: the part holds another one, and on
/// network file systems the two are of one kind.
Hdf5Handle open_part(const std::filesystem::path& part) {
  silence_hdf5();
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose);
  if (!access.valid() || H5Pset_file_locking(access.get(), false, true) < 0) return {};
  return {H5Fopen(part.c_str(), H5F_ACC_RDONLY, access.get()), &H5Fclose};
}

/// A text attribute of the root; empty where there is none.
std::string root_text(const Hdf5Handle& file, const char* name) {
  if (H5Aexists(file.get(), name) <= 0) return {};
  const Hdf5Handle attribute(H5Aopen(file.get(), name, H5P_DEFAULT), &H5Aclose);
  const Hdf5Handle type(H5Aget_type(attribute.get()), &H5Tclose);
  const Hdf5Handle space(H5Aget_space(attribute.get()), &H5Sclose);
  char* text = nullptr;
  if (H5Tis_variable_str(type.get()) <= 0 || H5Sget_simple_extent_npoints(space.get()) != 1 ||
      H5Aread(attribute.get(), type.get(), static_cast<void*>(&text)) < 0 || text == nullptr)
    return {};
  std::string value(text);
  H5free_memory(text);
  return value;
}

}  // namespace

std::byte* ReservedDataset::place(std::size_t row, std::size_t bytes) const {
  if (row >= rows_ || bytes != row_bytes_) throw std::out_of_range("row outside of a reserved dataset");
  return values_ + row * row_bytes_;
}

void ReservedDataset::set(std::size_t row, std::span<const std::byte> row_values) {
  std::memcpy(place(row, row_values.size()), row_values.data(), row_values.size());
}

void ReservedDataset::get(std::size_t row, std::span<std::byte> row_values) const {
  std::memcpy(row_values.data(), place(row, row_values.size()), row_values.size());
}

bool ReservedDataset::holds(std::size_t row, std::span<const std::byte> row_values) const {
  return std::memcmp(place(row, row_values.size()), row_values.data(), row_values.size()) == 0;
}

double ReservedDataset::real(std::size_t row) const {
  double value = 0.0;
  get(row, std::as_writable_bytes(std::span(&value, 1)));
  return value;
}

class PartialResult::Implementation {
 public:
  explicit Implementation(const PartFile& part) : name_(part.part_name()) {
    const Hdf5Handle file = open_part(name_);
    struct stat status {};
    if (!file.valid() || root_text(file, "format") != PART_FORMAT || ::fstat(part.descriptor(), &status) != 0)
      return;
    fingerprint_ = root_text(file, "fingerprint");
    size_ = static_cast<std::size_t>(status.st_size);
    void* const mapping = ::mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED, part.descriptor(), 0);
    if (mapping == MAP_FAILED)
      throw EnvironmentError(name_.string(), "",
                             "cannot be mapped into memory: " + std::generic_category().message(errno),
                             "allow more memory (ulimit -v), or put --out on another file system");
    mapping_ = static_cast<std::byte*>(mapping);
  }
  ~Implementation() {
    if (mapping_ != nullptr) ::munmap(mapping_, size_);
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  bool valid() const { return mapping_ != nullptr; }
  const std::string& fingerprint() const { return fingerprint_; }

  void hold_open(bool open) { held_ = open ? open_part(name_) : Hdf5Handle(); }

  ReservedDataset dataset(const std::string& path, ElementKind kind, const std::vector<std::size_t>& shape,
                          std::size_t row_values) const {
    const Hdf5Handle opened = held_.valid() ? Hdf5Handle() : open_part(name_);
    const Hdf5Handle& file = held_.valid() ? held_ : opened;
    const Hdf5Handle dataset(H5Dopen2(file.get(), path.c_str(), H5P_DEFAULT), &H5Dclose);
    if (!dataset.valid()) refuse(path);
    const Hdf5Handle type(H5Dget_type(dataset.get()), &H5Tclose);
    const Hdf5Handle space(H5Dget_space(dataset.get()), &H5Sclose);
    std::vector<hsize_t> extents(shape.size());
    if (H5Sget_simple_extent_ndims(space.get()) != static_cast<int>(shape.size()) ||
        H5Sget_simple_extent_dims(space.get(), extents.data(), nullptr) < 0 ||
        !std::equal(extents.begin(), extents.end(), shape.begin()) ||
        H5Tequal(type.get(), kind == ElementKind::REAL ? H5T_IEEE_F64LE : H5T_STD_I64LE) <= 0)
      refuse(path);
    const std::size_t count =
        std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
    if (count == 0) return {};
    const haddr_t offset = H5Dget_offset(dataset.get());
    if (offset == HADDR_UNDEF || offset > size_ || count > (size_ - offset) / VALUE_BYTES) refuse(path);
    return {mapping_ + offset, count / row_values, row_values * VALUE_BYTES};
  }

 private:
  [[noreturn]] void refuse(const std::string& path) const {
    throw InputError(name_.string(), path, "is not what a run of this experiment reserves there",
                     "remove the file and run again");
  }

  std::filesystem::path name_;
  Hdf5Handle held_;
  std::string fingerprint_;
  std::byte* mapping_ = nullptr;
  std::size_t size_ = 0;
};

PartialResult::PartialResult(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}
PartialResult::PartialResult(PartialResult&&) noexcept = default;
PartialResult& PartialResult::operator=(PartialResult&&) noexcept = default;
PartialResult::~PartialResult() = default;

PartialResult::PartialResult(PartFile& part, const std::string& image) {
  part.write(image);
  implementation_ = std::make_unique<Implementation>(part);
  if (!implementation_->valid()) throw std::logic_error("the image of a part is none");
}

std::optional<PartialResult> PartialResult::open(PartFile& part) {
  if (part.is_empty()) return std::nullopt;
  check_hdf5(part.part_name());
  auto implementation = std::make_unique<Implementation>(part);
  if (!implementation->valid()) part.refuse_foreign();  // a result, or any other HDF5 file
  return PartialResult(std::move(implementation));
}

const std::string& PartialResult::fingerprint() const {
  return implementation_->fingerprint();
}

void PartialResult::hold_open(bool open) {
  implementation_->hold_open(open);
}

ReservedDataset PartialResult::dataset(const std::string& path, ElementKind kind,
                                       const std::vector<std::size_t>& shape, std::size_t row_values) const {
  return implementation_->dataset(path, kind, shape, row_values);
}

}  // namespace lmdbench
