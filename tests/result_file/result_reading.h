// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <hdf5.h>
#include <support/scratch_directory.h>

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

/// Reading for tests by HDF5's C API alone, so that no code of the writer is trusted.
namespace lmdbench::testing {

class OpenResult {
 public:
  explicit OpenResult(const std::filesystem::path& file)
      : id_(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {
    if (id_ < 0) throw std::runtime_error("cannot open " + file.string());
  }
  ~OpenResult() { H5Fclose(id_); }
  OpenResult(const OpenResult&) = delete;
  OpenResult& operator=(const OpenResult&) = delete;

  bool has(const std::string& path) const { return H5Lexists(id_, path.c_str(), H5P_DEFAULT) > 0; }

  std::vector<std::size_t> shape(const std::string& path) const {
    const hid_t dataset = open(path);
    const hid_t space = H5Dget_space(dataset);
    std::vector<hsize_t> extents(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, extents.data(), nullptr);
    H5Sclose(space);
    H5Dclose(dataset);
    std::vector<std::size_t> result;
    for (const hsize_t extent : extents) result.push_back(static_cast<std::size_t>(extent));
    return result;
  }

  std::vector<double> doubles(const std::string& path) const { return read<double>(path, H5T_NATIVE_DOUBLE); }
  std::vector<std::int64_t> integers(const std::string& path) const {
    return read<std::int64_t>(path, H5T_NATIVE_INT64);
  }
  std::vector<std::uint8_t> bytes(const std::string& path) const {
    return read<std::uint8_t>(path, H5T_NATIVE_UINT8);
  }

  std::vector<std::string> strings(const std::string& path) const {
    const hid_t type = string_type();
    const std::vector<char*> texts = read<char*>(path, type);
    std::vector<std::string> values(texts.begin(), texts.end());
    for (char* text : texts) H5free_memory(text);
    H5Tclose(type);
    return values;
  }

  H5D_layout_t layout(const std::string& path) const {
    const hid_t dataset = open(path);
    const hid_t creation = H5Dget_create_plist(dataset);
    const H5D_layout_t result = H5Pget_layout(creation);
    H5Pclose(creation);
    H5Dclose(dataset);
    return result;
  }

  bool has_attribute(const std::string& object, const std::string& name) const {
    return H5Aexists_by_name(id_, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
  }

  std::string text_attribute(const std::string& object, const std::string& name) const {
    const hid_t type = string_type();
    char* text = nullptr;
    read_attribute(object, name, type, &text);
    std::string value(text);
    H5free_memory(text);
    H5Tclose(type);
    return value;
  }

  std::int64_t integer_attribute(const std::string& object, const std::string& name) const {
    std::int64_t value = 0;
    read_attribute(object, name, H5T_NATIVE_INT64, &value);
    return value;
  }

  double real_attribute(const std::string& object, const std::string& name) const {
    double value = 0.0;
    read_attribute(object, name, H5T_NATIVE_DOUBLE, &value);
    return value;
  }

 private:
  static hid_t string_type() {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, H5T_VARIABLE);
    H5Tset_cset(type, H5T_CSET_UTF8);
    return type;
  }

  hid_t open(const std::string& path) const {
    const hid_t dataset = H5Dopen2(id_, path.c_str(), H5P_DEFAULT);
    if (dataset < 0) throw std::runtime_error("no dataset " + path);
    return dataset;
  }

  template <typename Value>
  std::vector<Value> read(const std::string& path, hid_t type) const {
    std::size_t count = 1;
    for (const std::size_t extent : shape(path)) count *= extent;
    std::vector<Value> values(count);
    const hid_t dataset = open(path);
    const herr_t status = H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(dataset);
    if (status < 0) throw std::runtime_error("cannot read " + path);
    return values;
  }

  void read_attribute(const std::string& object, const std::string& name, hid_t type, void* value) const {
    const hid_t attribute = H5Aopen_by_name(id_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    if (attribute < 0) throw std::runtime_error("no attribute " + name + " of " + object);
    const herr_t status = H5Aread(attribute, type, value);
    H5Aclose(attribute);
    if (status < 0) throw std::runtime_error("cannot read attribute " + name + " of " + object);
  }

  hid_t id_;
};

}  // namespace lmdbench::testing
