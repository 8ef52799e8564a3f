// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/part_file.h>
#include <lmdbench/result_file/hdf5_check.h>
#include <lmdbench/result_file/hdf5_handle.h>
#include <lmdbench/result_file/result_writer.h>

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace lmdbench {

namespace {

/// Datasets of fewer bytes are stored whole: a compressed chunk would cost more than it saves.
constexpr std::size_t SMALLEST_COMPRESSED_BYTES = 16 * 1024;
/// Larger chunks would make readers of a few frames inflate much; HDF5's chunk cache holds 1 MiB.
constexpr std::size_t LARGEST_CHUNK_BYTES = 256 * 1024;
/// Deflate level: beyond 4 the files shrink by a few percent for several times the time.
constexpr unsigned DEFLATE_LEVEL = 4;

/// Growth step of the file in memory; HDF5 clears each step first.
constexpr std::size_t MEMORY_STEP_BYTES = 256 * 1024;

/// Halves the chunk along the first axis, then along the next, until it is small enough.
std::vector<hsize_t> chunk_shape(const std::vector<hsize_t>& shape, std::size_t element_bytes) {
  std::vector<hsize_t> chunk = shape;
  for (hsize_t& extent : chunk) {
    auto bytes = [&] {
      return std::accumulate(chunk.begin(), chunk.end(), hsize_t{element_bytes}, std::multiplies<>());
    };
    while (extent > 1 && bytes() > LARGEST_CHUNK_BYTES) extent = (extent + 1) / 2;
  }
  return chunk;
}

void check_path(const std::string& path) {
  if (path.empty() || path.front() != '/' || (path.size() > 1 && path.back() == '/')) {
    throw std::invalid_argument("not an absolute path in a result file: '" + path + "'");
  }
}

}  // namespace

class ResultWriter::Implementation {
 public:
  explicit Implementation(std::filesystem::path name) : Implementation() { part_.emplace(std::move(name)); }

  Implementation() {
    silence_hdf5();
    Hdf5Handle access = checked(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose, "made");
    // The file grows in memory and reaches the disk in `commit`: HDF5 1.10 corrupts its own state
    // when closing an object meets a full disk, and crashes later.
    check(H5Pset_fapl_core(access.get(), MEMORY_STEP_BYTES, false), "made");
    // Reserved datasets are written through a mapping: no number may cross two pages.
    check(H5Pset_alignment(access.get(), 1, sizeof(double)), "made");
    // HDF5 takes two open files in memory of the same name for one.
    const std::string own_name = fmt::format("result in memory {}", fmt::ptr(this));
    file_ = checked(H5Fcreate(own_name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), &H5Fclose, "made");
    // Strings have a variable length: JSON texts do not fit a fixed one.
    string_type_ = checked(H5Tcopy(H5T_C_S1), &H5Tclose, "made");
    check(H5Tset_size(string_type_.get(), H5T_VARIABLE), "made");
    check(H5Tset_cset(string_type_.get(), H5T_CSET_UTF8), "made");
    // Missing groups on the way to a new object are made with it.
    link_creation_ = checked(H5Pcreate(H5P_LINK_CREATE), &H5Pclose, "made");
    check(H5Pset_create_intermediate_group(link_creation_.get(), 1), "made");
  }

  void write(const DatasetInfo& info, hid_t file_type, hid_t memory_type, const void* values,
             std::size_t count, const std::vector<std::size_t>& shape) {
    begin();
    check_path(info.path);
    const std::vector<hsize_t> extents(shape.begin(), shape.end());
    const hsize_t product = std::accumulate(extents.begin(), extents.end(), hsize_t{1}, std::multiplies<>());
    if (product != count) {
      throw std::invalid_argument(
          fmt::format("{}: the shape has room for {} values, {} were given", info.path, product, count));
    }
    check_new(info);
    const std::string action = "extended by " + info.path;
    Hdf5Handle space =
        extents.empty() ? checked(H5Screate(H5S_SCALAR), &H5Sclose, action)
                        : checked(H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr),
                                  &H5Sclose, action);
    Hdf5Handle creation = checked(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose, action);
    // No time stamps: two runs of one experiment leave the same bytes.
    check(H5Pset_obj_track_times(creation.get(), false), action);
    const std::size_t element_bytes = H5Tget_size(file_type);
    if (!extents.empty() && file_type != string_type_.get() &&
        count * element_bytes >= SMALLEST_COMPRESSED_BYTES) {
      const std::vector<hsize_t> chunk = chunk_shape(extents, element_bytes);
      check(H5Pset_chunk(creation.get(), static_cast<int>(chunk.size()), chunk.data()), action);
      check(H5Pset_shuffle(creation.get()), action);
      check(H5Pset_deflate(creation.get(), DEFLATE_LEVEL), action);
      check(H5Pset_fletcher32(creation.get()),
            action);  // every reader notices flipped bytes
    }
    Hdf5Handle dataset = checked(H5Dcreate2(file_.get(), info.path.c_str(), file_type, space.get(),
                                            link_creation_.get(), creation.get(), H5P_DEFAULT),
                                 &H5Dclose, action);
    if (count > 0) check(write_values(dataset, memory_type, values), action);
    describe(dataset.get(), info, action);
    if (!dataset.close()) fail(action);  // compresses the last chunks
  }

  void reserve(const DatasetInfo& info, ElementKind kind, const std::vector<std::size_t>& shape) {
    begin();
    check_path(info.path);
    check_new(info);
    const std::string action = "extended by " + info.path;
    const std::vector<hsize_t> extents(shape.begin(), shape.end());
    Hdf5Handle space = checked(H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr),
                               &H5Sclose, action);
    Hdf5Handle creation = checked(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose, action);
    check(H5Pset_obj_track_times(creation.get(), false), action);
    check(H5Pset_layout(creation.get(), H5D_CONTIGUOUS), action);
    check(H5Pset_alloc_time(creation.get(), H5D_ALLOC_TIME_EARLY), action);
    const double unset_real = std::numeric_limits<double>::quiet_NaN();
    const std::int64_t unset_integer = UNSET_INTEGER;
    const bool real = kind == ElementKind::REAL;
    check(real ? H5Pset_fill_value(creation.get(), H5T_NATIVE_DOUBLE, &unset_real)
               : H5Pset_fill_value(creation.get(), H5T_NATIVE_INT64, &unset_integer),
          action);
    Hdf5Handle dataset =
        checked(H5Dcreate2(file_.get(), info.path.c_str(), real ? H5T_IEEE_F64LE : H5T_STD_I64LE, space.get(),
                           link_creation_.get(), creation.get(), H5P_DEFAULT),
                &H5Dclose, action);
    describe(dataset.get(), info, action);
  }

  void write_strings(const DatasetInfo& info, const std::vector<std::string>& values) {
    std::vector<const char*> pointers;
    pointers.reserve(values.size());
    for (const std::string& value : values) pointers.push_back(value.c_str());
    write(info, string_type_.get(), string_type_.get(), pointers.data(), pointers.size(), {values.size()});
  }

  void attribute(const std::string& path, const std::string& name, const std::string& value) {
    begin();
    Hdf5Handle object = open_or_make(path);
    string_attribute(object.get(), name, value, "given attribute " + name + " of " + path);
  }

  void attribute(const std::string& path, const std::string& name, hid_t file_type, hid_t memory_type,
                 const void* value) {
    begin();
    Hdf5Handle object = open_or_make(path);
    scalar_attribute(object.get(), name, file_type, memory_type, value,
                     "given attribute " + name + " of " + path);
  }

  std::string image() {
    begin();
    check(H5Fflush(file_.get(), H5F_SCOPE_GLOBAL), "completed");
    const ssize_t size = H5Fget_file_image(file_.get(), nullptr, 0);
    if (size < 0) fail("completed");
    std::string bytes(static_cast<std::size_t>(size), '\0');
    if (H5Fget_file_image(file_.get(), bytes.data(), bytes.size()) != size) fail("completed");
    return bytes;
  }

  PartFile& part() {
    if (!part_) throw std::logic_error("a result in memory has no file");
    return *part_;
  }

  void commit() {
    const std::string_view to_come = CONTENT_HASH_TO_COME;
    const Hdf5Handle digits = checked(H5Tcopy(H5T_C_S1), &H5Tclose, "completed");
    check(H5Tset_size(digits.get(), to_come.size()), "completed");
    check(H5Tset_strpad(digits.get(), H5T_STR_NULLPAD), "completed");
    attribute("/", CONTENT_HASH, digits.get(), digits.get(), to_come.data());
    part().publish(with_content_hash(image()));
    file_.close();
  }

 private:
  /// Every public step starts here: HDF5's printing is set by thread.
  void begin() {
    if (!file_.valid()) throw std::logic_error(name() + ": written to after commit");
    silence_hdf5();
  }

  std::string name() const { return part_ ? part_->final_name().string() : std::string(); }

  void check_new(const DatasetInfo& info) const {
    if (info.units.empty() || info.long_name.empty()) {
      throw std::invalid_argument(info.path + ": a dataset needs units and a long name");
    }
    if (exists(info.path)) throw std::invalid_argument(info.path + ": written twice");
  }

  void describe(hid_t dataset, const DatasetInfo& info, const std::string& action) {
    string_attribute(dataset, "units", info.units, action);
    string_attribute(dataset, "long_name", info.long_name, action);
  }

  [[noreturn]] void fail(const std::string& action) const {
    throw EnvironmentError(name(), "", "the result file cannot be " + action + ": " + last_hdf5_error(),
                           "free memory, or record less");
  }

  void check(herr_t status, const std::string& action) const {
    if (status < 0) fail(action);
  }

  Hdf5Handle checked(hid_t id, Hdf5Handle::Close closer, const std::string& action) const {
    if (id < 0) fail(action);
    return Hdf5Handle(id, closer);
  }

  /// HDF5 answers for a path only when all its parents exist.
  bool exists(const std::string& path) const {
    for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
      const std::string part = path.substr(0, end);
      if (part != "/" && H5Lexists(file_.get(), part.c_str(), H5P_DEFAULT) <= 0) return false;
      if (end == std::string::npos) return true;
    }
  }

  Hdf5Handle open_or_make(const std::string& path) {
    check_path(path);
    const std::string action = "extended by " + path;
    if (exists(path)) return checked(H5Oopen(file_.get(), path.c_str(), H5P_DEFAULT), &H5Oclose, action);
    return checked(H5Gcreate2(file_.get(), path.c_str(), link_creation_.get(), H5P_DEFAULT, H5P_DEFAULT),
                   &H5Gclose, action);
  }

  void string_attribute(hid_t object, const std::string& name, const std::string& value,
                        const std::string& action) {
    const char* text = value.c_str();
    scalar_attribute(object, name, string_type_.get(), string_type_.get(), &text, action);
  }

  void scalar_attribute(hid_t object, const std::string& name, hid_t file_type, hid_t memory_type,
                        const void* value, const std::string& action) {
    const htri_t present = H5Aexists(object, name.c_str());
    if (present < 0) fail(action);
    if (present > 0) check(H5Adelete(object, name.c_str()), action);
    Hdf5Handle space = checked(H5Screate(H5S_SCALAR), &H5Sclose, action);
    Hdf5Handle attribute =
        checked(H5Acreate2(object, name.c_str(), file_type, space.get(), H5P_DEFAULT, H5P_DEFAULT), &H5Aclose,
                action);
    check(H5Awrite(attribute.get(), memory_type, value), action);
  }

  std::optional<PartFile> part_;
  Hdf5Handle file_;
  Hdf5Handle string_type_;
  Hdf5Handle link_creation_;
};

ResultWriter::ResultWriter(std::filesystem::path file)
    : implementation_(std::make_unique<Implementation>(std::move(file))) {}

ResultWriter::ResultWriter() : implementation_(std::make_unique<Implementation>()) {}

ResultWriter::~ResultWriter() {
  silence_hdf5();
}

void ResultWriter::write(const DatasetInfo& info, std::span<const double> values,
                         const std::vector<std::size_t>& shape) {
  implementation_->write(info, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.data(), values.size(), shape);
}

void ResultWriter::write(const DatasetInfo& info, std::span<const std::int64_t> values,
                         const std::vector<std::size_t>& shape) {
  implementation_->write(info, H5T_STD_I64LE, H5T_NATIVE_INT64, values.data(), values.size(), shape);
}

void ResultWriter::write(const DatasetInfo& info, std::span<const std::uint8_t> values,
                         const std::vector<std::size_t>& shape) {
  implementation_->write(info, H5T_STD_U8LE, H5T_NATIVE_UINT8, values.data(), values.size(), shape);
}

void ResultWriter::write(const DatasetInfo& info, const std::vector<std::string>& values) {
  implementation_->write_strings(info, values);
}

void ResultWriter::reserve(const DatasetInfo& info, ElementKind kind, const std::vector<std::size_t>& shape) {
  implementation_->reserve(info, kind, shape);
}

std::string ResultWriter::image() {
  return implementation_->image();
}

PartFile& ResultWriter::part() {
  return implementation_->part();
}

void ResultWriter::attribute(const std::string& path, const std::string& name, const std::string& value) {
  implementation_->attribute(path, name, value);
}

void ResultWriter::attribute(const std::string& path, const std::string& name, std::int64_t value) {
  implementation_->attribute(path, name, H5T_STD_I64LE, H5T_NATIVE_INT64, &value);
}

void ResultWriter::attribute(const std::string& path, const std::string& name, double value) {
  implementation_->attribute(path, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

void ResultWriter::commit() {
  implementation_->commit();
}

}  // namespace lmdbench
