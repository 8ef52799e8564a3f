// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/child_process.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/base/limits.h>
#include <lmdbench/record/hdf5_check.h>

#include <fmt/format.h>

#include <cstddef>
#include <span>
#include <vector>

namespace lmdbench {
namespace {

/// Values of a dataset or attribute, as they are stored and as numbers are read; what cannot be read is left.
template <typename Read>
void read_values(const Hdf5Handle& type, const Hdf5Handle& space, const Read& read) {
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  if (count <= 0) return;
  const H5T_class_t kind = H5Tget_class(type.get());
  if (kind == H5T_STRING && H5Tis_variable_str(type.get()) > 0) {
    std::vector<char*> texts(static_cast<std::size_t>(count), nullptr);
    read(type.get(), texts.data());
    return;  // the texts end with this process
  }
  if (kind == H5T_STRING) {
    std::vector<std::byte> bytes(static_cast<std::size_t>(count) * H5Tget_size(type.get()));
    read(type.get(), bytes.data());
    return;
  }
  std::vector<double> numbers(static_cast<std::size_t>(count));
  if (kind == H5T_INTEGER) read(H5T_NATIVE_INT64, numbers.data());
  if (kind == H5T_INTEGER || kind == H5T_FLOAT) read(H5T_NATIVE_DOUBLE, numbers.data());
}

herr_t read_attribute(hid_t object, const char* name, const H5A_info_t* /*info*/, void* /*unused*/) {
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), &H5Aclose);
  if (!attribute.valid()) return 0;
  const Hdf5Handle type(H5Aget_type(attribute.get()), &H5Tclose);
  const Hdf5Handle space(H5Aget_space(attribute.get()), &H5Sclose);
  read_values(type, space,
              [&](hid_t memory_type, void* values) { return H5Aread(attribute.get(), memory_type, values); });
  return 0;
}

herr_t read_object(hid_t file, const char* name, const H5O_info_t* info, void* /*unused*/) {
  const Hdf5Handle object(H5Oopen(file, name, H5P_DEFAULT), &H5Oclose);
  if (!object.valid()) return 0;
  H5Aiterate2(object.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, &read_attribute, nullptr);
  if (info->type != H5O_TYPE_DATASET || !refers_elsewhere(object).empty()) return 0;
  const Hdf5Handle type(H5Dget_type(object.get()), &H5Tclose);
  const Hdf5Handle space(H5Dget_space(object.get()), &H5Sclose);
  read_values(type, space, [&](hid_t memory_type, void* values) {
    return H5Dread(object.get(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
  });
  return 0;
}

/// Every object once, however many links lead to it.
void read_whole_file(const std::filesystem::path& name) {
  silence_hdf5();
  // Without a lock: a part is locked by the process that resumes it.
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose);
  H5Pset_file_locking(access.get(), false, true);
  const Hdf5Handle file(H5Fopen(name.c_str(), H5F_ACC_RDONLY, access.get()), &H5Fclose);
  if (file.valid()) H5Ovisit2(file.get(), H5_INDEX_NAME, H5_ITER_INC, &read_object, nullptr, H5O_INFO_BASIC);
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
  constexpr std::byte WHOLE{1};
  ChildProcess child(
      [&](const ChildProcess::Send& send) {
        read_whole_file(file);
        send(std::span(&WHOLE, 1));
      },
      limits);
  std::byte answer{};
  if (!child.receive(std::span(&answer, 1)) || answer != WHOLE)
    throw InputError(file.string(), "", fmt::format("the process that reads it {}", child.end_in_words()),
                     fmt::format("the file is likely damaged: make it again with lmdbench run; otherwise {}, "
                                 "or --limit import-bytes=NUMBER",
                                 raise_remedy(Limit::IMPORT_SECONDS)));
}

}  // namespace lmdbench
