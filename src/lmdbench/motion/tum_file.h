// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/motion/path.h>

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

namespace lmdbench {

/// Largest relative deviation of a quaternion's length from 1 that reading accepts (and
/// normalises). Trajectory files often have four decimals, which leaves about 1e-4; more is an
/// error of the data.
inline constexpr double QUATERNION_LENGTH_TOLERANCE = 1e-3;

/// Brings a quaternion to unit length. One that was normalised in double precision keeps its bits.
void normalize_beyond_rounding(Eigen::Quaterniond& rotation);

/// Reads a TUM trajectory: lines `time x y z qx qy qz qw` (seconds, metres), separated by blanks or
/// tabs; `#` begins a comment line; empty lines are skipped; LF or CRLF. Numbers are read with '.'
/// whatever the locale. A quaternion that is unit to rounding keeps its bits, so reading what
/// `write_tum` wrote gives the same path bit for bit; one within QUATERNION_LENGTH_TOLERANCE is
/// normalised. Signs of quaternions are kept as written.
/// @throws InputError naming file, line and remedy: not a number, NaN or infinity, a coordinate
///         above `LARGEST_COORDINATE`, wrong number of columns, time not strictly increasing,
///         quaternion not of unit length, no pose at all, unreadable file
Path read_tum(const std::filesystem::path& file);

/// The same from text; `name` stands for the file in messages.
Path parse_tum(std::string_view text, const std::string& name);

/// The same from a stream, e.g. standard input, which is read to its end first.
/// @throws InputError also for more than FILE_BYTES bytes
Path read_tum(std::istream& stream, const std::string& name);

/// Text of a TUM trajectory.
/// @param comment  lines written first, each behind "# "; may be empty
/// @param decimals digits after the point; unset: the shortest text that reads back the same bits
/// @throws std::invalid_argument when the path could not be read back (empty, not finite, time
///         not increasing, quaternion not of unit length)
std::string tum_text(const Path& path, const std::string& comment = "",
                     std::optional<int> decimals = std::nullopt);

/// Writes `tum_text` to a file in one step (`write_file_atomically`): all of it or nothing.
/// @throws EnvironmentError when the file cannot be written; std::invalid_argument as `tum_text`
void write_tum(const std::filesystem::path& file, const Path& path, const std::string& comment = "",
               std::optional<int> decimals = std::nullopt);

}  // namespace lmdbench
