// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/child_process.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_hash.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/base/limits.h>
#include <lmdbench/result_file/hdf5_check.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <new>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

/// Of the child's messages.
constexpr std::size_t LONGEST_TEXT = 10'000;

/// The first damage of a file and its place; empty if there is none.
struct Damage {
  std::string place;
  std::string problem;
};

/// Reads the values of a dataset or attribute, as stored and as the numbers that readers want.
/// @param read (memory type, values) -> herr_t
template <typename Read>
bool can_be_read(const Hdf5Handle& type, std::size_t count, const Read& read) {
  if (count == 0) return true;
  const H5T_class_t kind = H5Tget_class(type.get());
  if (kind == H5T_STRING && H5Tis_variable_str(type.get()) > 0) {
    std::vector<char*> texts(count, nullptr);  // what they point to ends with this process
    return read(type.get(), static_cast<void*>(texts.data())) >= 0;
  }
  if (kind == H5T_STRING) {
    std::vector<char> text(count * H5Tget_size(type.get()));
    return read(type.get(), static_cast<void*>(text.data())) >= 0;
  }
  if (kind != H5T_INTEGER && kind != H5T_FLOAT) return true;  // readers refuse other kinds
  std::vector<double> numbers(count);
  if (kind == H5T_INTEGER && read(H5T_NATIVE_INT64, numbers.data()) < 0) return false;
  return read(H5T_NATIVE_DOUBLE, numbers.data()) >= 0;
}

std::size_t value_count(const Hdf5Handle& space) {
  return static_cast<std::size_t>(std::max<hssize_t>(H5Sget_simple_extent_npoints(space.get()), 0));
}

herr_t read_attribute(hid_t object, const char* name, const H5A_info_t* /*info*/, void* damage) {
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), &H5Aclose);
  const Hdf5Handle type(H5Aget_type(attribute.get()), &H5Tclose);
  const Hdf5Handle space(H5Aget_space(attribute.get()), &H5Sclose);
  const bool whole = attribute.valid() && type.valid() && space.valid() &&
                     can_be_read(type, value_count(space), [&](hid_t memory_type, void* values) {
                       return H5Aread(attribute.get(), memory_type, values);
                     });
  if (whole) return 0;
  static_cast<Damage*>(damage)->problem =
      fmt::format("attribute {} cannot be read: {}", name, last_hdf5_error());
  return 1;  // stops here
}

/// What is wrong with the values of a dataset; empty where they can be read.
std::string damage_of_values(const Hdf5Handle& dataset) {
  if (!refers_elsewhere(dataset).empty()) return {};  // not our values: readers refuse them
  const Hdf5Handle type(H5Dget_type(dataset.get()), &H5Tclose);
  const Hdf5Handle space(H5Dget_space(dataset.get()), &H5Sclose);
  if (!type.valid() || !space.valid()) return last_hdf5_error();
  const std::size_t count = value_count(space);
  const hsize_t stored = H5Dget_storage_size(dataset.get());
  if (count > stored * LARGEST_DEFLATE_RATIO / std::max<std::size_t>(H5Tget_size(type.get()), 1))
    return fmt::format("its shape asks for more values than its {} bytes can hold", stored);
  const bool whole = can_be_read(type, count, [&](hid_t memory_type, void* values) {
    return read_values(dataset, memory_type, values);
  });
  return whole ? "" : last_hdf5_error();
}

herr_t read_object(hid_t file, const char* name, const H5O_info_t* info, void* found) {
  Damage& damage = *static_cast<Damage*>(found);
  try {
    const Hdf5Handle object(H5Oopen(file, name, H5P_DEFAULT), &H5Oclose);
    if (!object.valid() ||
        H5Aiterate2(object.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, &read_attribute, found) < 0)
      damage.problem = last_hdf5_error();
    if (damage.problem.empty() && info->type == H5O_TYPE_DATASET) damage.problem = damage_of_values(object);
  } catch (const std::bad_alloc&) {
    damage.problem = "asks for more memory than there is";
  }
  if (damage.problem.empty()) return 0;
  damage.place = fmt::format("/{}", std::string_view(name) == "." ? "" : name);
  return 1;
}

/// Every object once, however many links lead to it. A file that cannot be opened passes here.
Damage read_whole_file(const std::filesystem::path& name) {
  silence_hdf5();
  // Without a lock: a part is locked by the process that resumes it.
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose);
  H5Pset_file_locking(access.get(), false, true);
  const Hdf5Handle file(H5Fopen(name.c_str(), H5F_ACC_RDONLY, access.get()), &H5Fclose);
  Damage damage;
  if (file.valid() &&
      H5Ovisit2(file.get(), H5_INDEX_NAME, H5_ITER_INC, &read_object, &damage, H5O_INFO_BASIC) < 0 &&
      damage.problem.empty())
    damage.problem = last_hdf5_error();
  return damage;
}

}  // namespace

std::string refers_elsewhere(const Hdf5Handle& dataset) {
  const Hdf5Handle creation(H5Dget_create_plist(dataset.get()), &H5Pclose);
  if (!creation.valid()) return "cannot be looked at";
  if (H5Pget_layout(creation.get()) == H5D_VIRTUAL) return "is made of datasets of other files";
  if (H5Pget_external_count(creation.get()) > 0) return "has its values in another file";
  return {};
}

void check_hdf5(const std::filesystem::path& file) {
  refuse_unless_regular(file, {.what = "result file"});
  H5PLset_loading_state(0);
  const ChildLimits limits{limit_of(Limit::IMPORT_SECONDS), limit_of(Limit::IMPORT_BYTES)};
  ChildProcess child(
      [&](const ChildProcess::Send& send) {
        const Damage damage = read_whole_file(file);
        const std::array<std::size_t, 2> lengths{damage.place.size(), damage.problem.size()};
        send(std::as_bytes(std::span(lengths)));
        send(std::as_bytes(std::span(damage.place)));
        send(std::as_bytes(std::span(damage.problem)));
      },
      limits);
  std::array<std::size_t, 2> lengths{};
  Damage damage;
  bool complete = child.receive(std::as_writable_bytes(std::span(lengths)));
  if (complete) {
    damage.place.resize(std::min(lengths[0], LONGEST_TEXT));
    damage.problem.resize(std::min(lengths[1], LONGEST_TEXT));
    complete = child.receive(std::as_writable_bytes(std::span(damage.place))) &&
               child.receive(std::as_writable_bytes(std::span(damage.problem)));
  }
  if (!complete)
    throw InputError(file.string(), "", fmt::format("the process that reads it {}", child.end_in_words()),
                     fmt::format("the file is likely damaged: make it again with lmdbench run; otherwise {}, "
                                 "or --limit import-bytes=NUMBER",
                                 raise_remedy(Limit::IMPORT_SECONDS)));
  if (!damage.problem.empty())
    throw InputError(file.string(), damage.place, "is damaged: " + damage.problem,
                     "make the file again with lmdbench run");
}

namespace {

/// Position of the digits; npos unless they occur exactly once.
std::size_t only_place_of(std::string_view digits, std::string_view bytes) {
  const std::size_t place = bytes.find(digits);
  if (place == std::string_view::npos || bytes.find(digits, place + 1) != std::string_view::npos)
    return std::string_view::npos;
  return place;
}

std::string hash_without_digits(std::string bytes, std::size_t place, std::size_t length) {
  bytes.replace(place, length, length, '0');
  return sha256_of_text(bytes);
}

}  // namespace

std::string with_content_hash(std::string image) {
  const std::string_view digits = CONTENT_HASH_TO_COME;
  const std::size_t place = only_place_of(digits, image);
  if (place == std::string::npos) throw std::logic_error("a result has no place for the hash of its content");
  const std::string hash = hash_without_digits(image, place, digits.size());
  return image.replace(place, digits.size(), hash);
}

void check_content_hash(const std::filesystem::path& file, const std::string& hash) {
  std::string bytes = read_input_file(file, {.what = "result file"}).bytes;
  const std::size_t place = hash.empty() ? std::string::npos : only_place_of(hash, bytes);
  if (place != std::string::npos && hash_without_digits(std::move(bytes), place, hash.size()) == hash) return;
  throw InputError(file.string(), std::string("attribute ") + CONTENT_HASH,
                   "its bytes are not those that were written: damaged, or changed afterwards",
                   "make the file again with lmdbench run; who changed it on purpose deletes the attribute");
}

}  // namespace lmdbench
