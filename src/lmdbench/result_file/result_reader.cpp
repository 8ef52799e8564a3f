// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/result_file/hdf5_check.h>
#include <lmdbench/result_file/hdf5_handle.h>
#include <lmdbench/result_file/partial_result.h>
#include <lmdbench/result_file/provenance.h>
#include <lmdbench/result_file/result_reader.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace lmdbench {

namespace {

constexpr const char* RUN_AGAIN = "make the file again with lmdbench run";

herr_t append_attribute(hid_t /*object*/, const char* name, const H5A_info_t* /*info*/, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

/// Strips the zeros and blanks that pad strings of fixed length.
std::string unpadded(const char* text, std::size_t size) {
  while (size > 0 && (text[size - 1] == '\0' || text[size - 1] == ' ')) --size;
  return {text, ::strnlen(text, size)};
}

}  // namespace

class ResultReader::Implementation {
 public:
  explicit Implementation(std::filesystem::path name) : name_(std::move(name)) {
    silence_hdf5();
    std::error_code error;
    if (!std::filesystem::exists(name_, error))
      throw InputError(name_.string(), "", "no such result file",
                       "check the name; lmdbench run makes results");
    if (std::filesystem::is_directory(name_, error))
      throw InputError(name_.string(), "", "a directory, not a result file", "name the .h5 file in it");
    check_hdf5(name_);
    file_ = Hdf5Handle(H5Fopen(name_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), &H5Fclose);
    if (!file_.valid())
      throw InputError(name_.string(), "", "cannot be opened as HDF5: " + last_hdf5_error(),
                       "check that it is a complete result of lmdbench run");
    check_format();
    // Older results have no hash.
    if (const auto hash = text_attribute("/", CONTENT_HASH)) check_content_hash(name_, *hash);
  }

  const std::filesystem::path& name() const { return name_; }

  bool has(const std::string& path) const {
    silence_hdf5();
    if (path == "/") return true;
    for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
      const std::string here = path.substr(0, end);
      if (H5Lexists(file_.get(), here.c_str(), H5P_DEFAULT) <= 0) return false;
      H5L_info_t link{};
      if (H5Lget_info(file_.get(), here.c_str(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD)
        fail(here, "is a link, perhaps to another file");
      if (end == std::string::npos) return true;
    }
  }

  std::vector<std::string> members(const std::string& group, H5O_type_t wanted) const {
    std::vector<std::string> names;
    if (!has(group)) return names;
    const Hdf5Handle handle = open_object(group);
    H5G_info_t info{};
    if (H5Gget_info(handle.get(), &info) < 0) fail(group, "is no group");
    for (hsize_t i = 0; i < info.nlinks; ++i) {
      const ssize_t size =
          H5Lget_name_by_idx(handle.get(), ".", H5_INDEX_NAME, H5_ITER_INC, i, nullptr, 0, H5P_DEFAULT);
      if (size < 0) fail(group, "cannot be listed: " + last_hdf5_error());
      std::string name(static_cast<std::size_t>(size) + 1, '\0');
      H5Lget_name_by_idx(handle.get(), ".", H5_INDEX_NAME, H5_ITER_INC, i, name.data(), name.size(),
                         H5P_DEFAULT);
      name.pop_back();
      H5O_info_t object{};
      const std::string path = fmt::format("{}/{}", group == "/" ? "" : group, name);
      static_cast<void>(has(path));  // refuses links
      if (H5Oget_info_by_name2(handle.get(), name.c_str(), &object, H5O_INFO_BASIC, H5P_DEFAULT) < 0)
        fail(path, "cannot be read: " + last_hdf5_error());
      if (object.type == wanted) names.push_back(std::move(name));
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  std::vector<std::size_t> shape(const std::string& path) const {
    const Hdf5Handle dataset = open_dataset(path);
    const std::vector<hsize_t> sizes = extents(path, dataset);
    return {sizes.begin(), sizes.end()};
  }

  ElementKind kind(const std::string& path) const {
    const Hdf5Handle dataset = open_dataset(path);
    const Hdf5Handle type(H5Dget_type(dataset.get()), &H5Tclose);
    return kind_of(path, type);
  }

  std::optional<ElementKind> attribute_kind(const std::string& object, const std::string& name) const {
    const std::optional<Hdf5Handle> attribute = open_attribute(object, name);
    if (!attribute) return std::nullopt;
    const Hdf5Handle type(H5Aget_type(attribute->get()), &H5Tclose);
    return kind_of(object + ", attribute " + name, type);
  }

  template <typename Value>
  std::vector<Value> numbers(const std::string& path, hid_t memory_type) const {
    const ElementKind found = kind(path);
    if (found == ElementKind::TEXT) fail(path, "holds texts where numbers are expected");
    if (found == ElementKind::REAL && std::is_integral_v<Value>)
      fail(path, "holds real numbers where integers are expected");
    const Hdf5Handle dataset = open_dataset(path);
    std::vector<Value> values(checked_count(path, dataset));
    if (!values.empty()) read(path, dataset, memory_type, values.data());
    return values;
  }

  std::vector<std::string> texts(const std::string& path) const {
    if (kind(path) != ElementKind::TEXT) fail(path, "holds numbers where texts are expected");
    const Hdf5Handle dataset = open_dataset(path);
    const Hdf5Handle type(H5Dget_type(dataset.get()), &H5Tclose);
    const std::size_t count = checked_count(path, dataset);
    std::vector<std::string> values;
    values.reserve(count);
    if (count == 0) return values;
    if (H5Tis_variable_str(type.get()) > 0) {
      std::vector<char*> pointers(count, nullptr);
      read(path, dataset, type.get(), pointers.data());
      for (char* text : pointers) {
        values.emplace_back(text == nullptr ? "" : text);
        H5free_memory(text);
      }
    } else {
      const std::size_t size = H5Tget_size(type.get());
      std::vector<char> bytes(count * size);
      read(path, dataset, type.get(), bytes.data());
      for (std::size_t i = 0; i < count; ++i) values.push_back(unpadded(&bytes[i * size], size));
    }
    return values;
  }

  std::vector<std::string> attributes(const std::string& object) const {
    std::vector<std::string> names;
    if (!has(object)) return names;
    const Hdf5Handle handle = open_object(object);
    hsize_t position = 0;
    if (H5Aiterate2(handle.get(), H5_INDEX_NAME, H5_ITER_INC, &position, &append_attribute, &names) < 0)
      fail(object, "its attributes cannot be listed: " + last_hdf5_error());
    return names;
  }

  template <typename Value>
  std::optional<Value> number_attribute(const std::string& object, const std::string& name,
                                        H5T_class_t wanted, hid_t memory_type) const {
    const std::optional<Hdf5Handle> attribute = open_attribute(object, name);
    if (!attribute) return std::nullopt;
    const Hdf5Handle type(H5Aget_type(attribute->get()), &H5Tclose);
    if (H5Tget_class(type.get()) != wanted)
      fail(object, "attribute " + name + " has another type than expected");
    Value value{};
    if (H5Aread(attribute->get(), memory_type, &value) < 0)
      fail(object, "attribute " + name + " cannot be read: " + last_hdf5_error());
    return value;
  }

  std::optional<std::string> text_attribute(const std::string& object, const std::string& name) const {
    const std::optional<Hdf5Handle> attribute = open_attribute(object, name);
    if (!attribute) return std::nullopt;
    const Hdf5Handle type(H5Aget_type(attribute->get()), &H5Tclose);
    if (H5Tget_class(type.get()) != H5T_STRING) fail(object, "attribute " + name + " is no text");
    const std::string unreadable = "attribute " + name + " cannot be read: ";
    if (H5Tis_variable_str(type.get()) > 0) {
      char* text = nullptr;
      if (H5Aread(attribute->get(), type.get(), &text) < 0) fail(object, unreadable + last_hdf5_error());
      std::string value(text == nullptr ? "" : text);
      H5free_memory(text);
      return value;
    }
    std::string bytes(H5Tget_size(type.get()), '\0');
    if (H5Aread(attribute->get(), type.get(), bytes.data()) < 0) fail(object, unreadable + last_hdf5_error());
    return unpadded(bytes.data(), bytes.size());
  }

 private:
  [[noreturn]] void fail(const std::string& place, const std::string& problem) const {
    throw InputError(name_.string(), place, problem, RUN_AGAIN);
  }

  ElementKind kind_of(const std::string& place, const Hdf5Handle& type) const {
    switch (H5Tget_class(type.get())) {
      case H5T_FLOAT:
        return ElementKind::REAL;
      case H5T_INTEGER:
        return ElementKind::INTEGER;
      case H5T_STRING:
        return ElementKind::TEXT;
      default:
        fail(place, "holds neither numbers nor texts");
    }
  }

  void check_format() const {
    const std::optional<std::string> format = text_attribute("/", "format");
    if (format != RESULT_FORMAT)
      throw InputError(name_.string(), "attribute format",
                       format ? "'" + *format + "' instead of '" + RESULT_FORMAT + "'" : "missing",
                       format == PART_FORMAT ? "an unfinished run: finish it with lmdbench run --resume"
                                             : "give a result file of lmdbench run");
    const auto version = number_attribute<std::int64_t>("/", "format_version", H5T_INTEGER, H5T_NATIVE_INT64);
    const auto refuse = [&](const std::string& found, const std::string& remedy) {
      throw InputError(name_.string(), "attribute format_version",
                       fmt::format("{} where this program reads {} to {}", found,
                                   OLDEST_RESULT_FORMAT_VERSION, RESULT_FORMAT_VERSION),
                       remedy);
    };
    if (!version) refuse("missing", "give a result file of lmdbench run");
    if (*version > RESULT_FORMAT_VERSION)
      refuse(std::to_string(*version),
             fmt::format("read it with the lmdbench that wrote it ({}) or a newer one",
                         text_attribute("/", "creator").value_or("attribute creator is missing")));
    if (*version < OLDEST_RESULT_FORMAT_VERSION) refuse(std::to_string(*version), "run the experiment again");
  }

  Hdf5Handle open_object(const std::string& path) const {
    silence_hdf5();
    Hdf5Handle object(H5Oopen(file_.get(), path.c_str(), H5P_DEFAULT), &H5Oclose);
    if (!object.valid()) fail(path, "cannot be read: " + last_hdf5_error());
    return object;
  }

  Hdf5Handle open_dataset(const std::string& path) const {
    if (!has(path))
      throw InputError(
          name_.string(), path, "missing",
          "make the file again with lmdbench run, which keeps what the experiment's /record says");
    Hdf5Handle dataset(H5Dopen2(file_.get(), path.c_str(), H5P_DEFAULT), &H5Dclose);
    if (!dataset.valid()) fail(path, "is no readable dataset: " + last_hdf5_error());
    if (const std::string elsewhere = refers_elsewhere(dataset); !elsewhere.empty()) fail(path, elsewhere);
    return dataset;
  }

  std::optional<Hdf5Handle> open_attribute(const std::string& object, const std::string& name) const {
    if (!has(object)) return std::nullopt;
    const Hdf5Handle handle = open_object(object);
    if (H5Aexists(handle.get(), name.c_str()) <= 0) return std::nullopt;
    Hdf5Handle attribute(H5Aopen(handle.get(), name.c_str(), H5P_DEFAULT), &H5Aclose);
    if (!attribute.valid()) fail(object, "attribute " + name + " cannot be read: " + last_hdf5_error());
    const Hdf5Handle space(H5Aget_space(attribute.get()), &H5Sclose);
    if (H5Sget_simple_extent_npoints(space.get()) != 1)
      fail(object, "attribute " + name + " is no single value");
    return attribute;
  }

  std::vector<hsize_t> extents(const std::string& path, const Hdf5Handle& dataset) const {
    const Hdf5Handle space(H5Dget_space(dataset.get()), &H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space.get());
    if (rank < 0) fail(path, "has no shape: " + last_hdf5_error());
    std::vector<hsize_t> sizes(static_cast<std::size_t>(rank));
    H5Sget_simple_extent_dims(space.get(), sizes.data(), nullptr);
    return sizes;
  }

  /// Number of values, after a check that the stored bytes can hold so many.
  std::size_t checked_count(const std::string& path, const Hdf5Handle& dataset) const {
    const Hdf5Handle type(H5Dget_type(dataset.get()), &H5Tclose);
    const std::size_t value_size = H5Tget_size(type.get());
    if (value_size == 0) fail(path, "is damaged: its values have no size");
    const hsize_t most = H5Dget_storage_size(dataset.get()) * LARGEST_DEFLATE_RATIO / value_size;
    const std::vector<hsize_t> sizes = extents(path, dataset);
    if (std::find(sizes.begin(), sizes.end(), hsize_t{0}) != sizes.end()) return 0;
    hsize_t count = 1;
    for (const hsize_t extent : sizes) {
      if (extent > most / count)
        fail(path, fmt::format("is damaged: its shape asks for more values than its {} bytes can hold",
                               H5Dget_storage_size(dataset.get())));
      count *= extent;
    }
    return static_cast<std::size_t>(count);
  }

  void read(const std::string& path, const Hdf5Handle& dataset, hid_t memory_type, void* values) const {
    if (read_values(dataset, memory_type, values) < 0) fail(path, "cannot be read: " + last_hdf5_error());
  }

  std::filesystem::path name_;
  Hdf5Handle file_;
};

ResultReader::ResultReader(std::filesystem::path file)
    : implementation_(std::make_unique<Implementation>(std::move(file))) {}
ResultReader::~ResultReader() = default;
ResultReader::ResultReader(ResultReader&&) noexcept = default;
ResultReader& ResultReader::operator=(ResultReader&&) noexcept = default;

const std::filesystem::path& ResultReader::file() const {
  return implementation_->name();
}

bool ResultReader::has(const std::string& path) const {
  return implementation_->has(path);
}

std::vector<std::string> ResultReader::groups(const std::string& group) const {
  return implementation_->members(group, H5O_TYPE_GROUP);
}

std::vector<std::string> ResultReader::datasets(const std::string& group) const {
  return implementation_->members(group, H5O_TYPE_DATASET);
}

std::vector<std::size_t> ResultReader::shape(const std::string& dataset) const {
  return implementation_->shape(dataset);
}

ElementKind ResultReader::kind(const std::string& dataset) const {
  return implementation_->kind(dataset);
}

std::vector<double> ResultReader::reals(const std::string& dataset) const {
  return implementation_->numbers<double>(dataset, H5T_NATIVE_DOUBLE);
}

std::vector<std::int64_t> ResultReader::integers(const std::string& dataset) const {
  return implementation_->numbers<std::int64_t>(dataset, H5T_NATIVE_INT64);
}

std::vector<std::string> ResultReader::texts(const std::string& dataset) const {
  return implementation_->texts(dataset);
}

std::vector<std::string> ResultReader::attributes(const std::string& object) const {
  return implementation_->attributes(object);
}

std::optional<ElementKind> ResultReader::attribute_kind(const std::string& object,
                                                        const std::string& name) const {
  return implementation_->attribute_kind(object, name);
}

std::optional<std::string> ResultReader::text_attribute(const std::string& object,
                                                        const std::string& name) const {
  return implementation_->text_attribute(object, name);
}

std::optional<std::int64_t> ResultReader::integer_attribute(const std::string& object,
                                                            const std::string& name) const {
  return implementation_->number_attribute<std::int64_t>(object, name, H5T_INTEGER, H5T_NATIVE_INT64);
}

std::optional<double> ResultReader::real_attribute(const std::string& object, const std::string& name) const {
  return implementation_->number_attribute<double>(object, name, H5T_FLOAT, H5T_NATIVE_DOUBLE);
}

void refuse_sweep(const ResultReader& file) {
  if (file.has("/sweep"))
    throw UsageError(
        file.file().string(), "/sweep", "a sweep of lmdbench work-precision, not the result of a run",
        "give results of lmdbench run; lmdbench report and scripts/figures/sweep.py read sweeps");
}

}  // namespace lmdbench
