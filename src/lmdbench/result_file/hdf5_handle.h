// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <hdf5.h>

#include <string>
#include <utility>

namespace lmdbench {

/// Owns one HDF5 identifier of any kind and closes it.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, Close closer) : id_(id), close_(closer) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    if (this != &other) {
      close();
      id_ = std::exchange(other.id_, H5I_INVALID_HID);
      close_ = other.close_;
    }
    return *this;
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  ~Hdf5Handle() { close(); }

  hid_t get() const { return id_; }
  bool valid() const { return id_ >= 0; }

  /// False when HDF5 could not close it; for a file that means that data did not reach the disk.
  bool close() {
    if (!valid()) return true;
    return close_(std::exchange(id_, H5I_INVALID_HID)) >= 0;
  }

 private:
  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

/// H5Dread and H5Dwrite of all values of a dataset, without the megabyte that HDF5 clears for each
/// dataset whose values it converts, text above all.
herr_t read_values(const Hdf5Handle& dataset, hid_t memory_type, void* values);
herr_t write_values(const Hdf5Handle& dataset, hid_t memory_type, const void* values);

/// Stops HDF5 from printing its error stack. The setting belongs to the calling thread,
/// so call it before every use.
void silence_hdf5();

/// The innermost message of this thread's last failed HDF5 call, as "No space left on device".
std::string last_hdf5_error();

}  // namespace lmdbench
