// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/ply_check.h>
#include <lmdbench/catalogue/stl_check.h>

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/endian/conversion.hpp>
#include <fmt/format.h>

#include <cstddef>
#include <cstdint>

namespace lmdbench {
namespace {

constexpr std::size_t HEADER_BYTES = 84, TRIANGLE_BYTES = 50;

std::string lower(std::string_view text) {
  return boost::algorithm::to_lower_copy(std::string(text));
}

}  // namespace

void check_stl(std::string_view bytes, const std::string& file) {
  std::size_t announced = 0, whole = 0;
  if (bytes.size() >= HEADER_BYTES) {
    announced = boost::endian::load_little_u32(reinterpret_cast<const unsigned char*>(bytes.data()) +
                                               HEADER_BYTES - 4);
    whole = HEADER_BYTES + TRIANGLE_BYTES * announced;
    if (bytes.size() == whole) return;
  }
  // Binary headers may begin with "solid", too.
  const std::string start = lower(bytes.substr(0, 1024));
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  const bool is_text = first != std::string::npos && start.compare(first, 5, "solid") == 0 &&
                       (start.find("facet") != std::string::npos ||
                        start.find("endsolid") != std::string::npos || bytes.size() < HEADER_BYTES);
  if (is_text) {
    const std::string text = lower(bytes);
    const std::size_t end = text.rfind("endsolid"), corner = text.rfind("vertex");
    if (end == std::string::npos || (corner != std::string::npos && corner > end))
      throw InputError(file, "", "ends without 'endsolid'",
                       "the file may be cut short: get it again, or add the line");
  } else if (whole > 0) {
    throw InputError(file, "",
                     fmt::format("holds {} bytes, but a binary STL file of the {} triangles that its header "
                                 "announces has {}",
                                 bytes.size(), announced, whole),
                     CUT_SHORT);
  }
}

}  // namespace lmdbench
