// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/atomic_file.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/base/limits.h>
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/motion/tum_file.h>

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <istream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace lmdbench {
namespace {

constexpr std::string_view COLUMNS = "time x y z qx qy qz qw";
constexpr std::size_t COLUMN_COUNT = 8;
constexpr std::size_t QUOTED_LENGTH = 40;  ///< Of a word in a message: it may be binary.
constexpr std::string_view BLANKS = " \t\r";

/// What is wrong with a pose and what to do about it; empty when nothing is.
struct Complaint {
  std::string problem;
  std::string remedy;
};

Complaint complaint_about(const TimedPose& timed, const TimedPose* previous) {
  if (!std::isfinite(timed.time) || !timed.pose.translation.allFinite() ||
      !timed.pose.rotation.coeffs().allFinite())
    return {"NaN or infinity in a pose", "remove the pose or repair the tool that recorded it"};
  if (previous != nullptr && !(timed.time > previous->time))
    return {fmt::format("time {} does not lie after the time before it, {}", timed.time, previous->time),
            "sort the poses by time and keep one pose a time"};
  if (!(timed.pose.translation.cwiseAbs().maxCoeff() <= LARGEST_COORDINATE))
    return {fmt::format("a coordinate above {:g} m", LARGEST_COORDINATE), "give metres, near the meshes"};
  // The tolerance is one of lengths, not of |q|^2.
  const double length = timed.pose.rotation.coeffs().stableNorm();
  if (std::abs(length - 1.0) > QUATERNION_LENGTH_TOLERANCE)
    return {fmt::format("the quaternion's length is {:.6g}, not 1", length),
            fmt::format("normalise it and check the order of the columns: {}", COLUMNS)};
  return {};
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t begin = line.find_first_not_of(BLANKS); begin != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(BLANKS, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(BLANKS, end);
  }
  return words;
}

double parse_number(std::string_view word, const std::string& name, const std::string& place) {
  // from_chars accepts no leading '+', which some tools write.
  const std::string_view digits = word.starts_with('+') && !word.starts_with("+-") ? word.substr(1) : word;
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range)
    throw InputError(name, place, fmt::format("'{}' is out of the range of double precision", word),
                     "use seconds and metres");
  if (error != std::errc() || end != digits.data() + digits.size())
    throw InputError(
        name, place, fmt::format("'{}' is not a number", word.substr(0, QUOTED_LENGTH)),
        "write numbers with a decimal point and separate them by blanks; comments begin with '#'");
  return value;
}

void append_number(std::string& text, double value, std::optional<int> decimals) {
  // The longest fixed form of a double: 309 digits before the point, and the decimals.
  std::array<char, 400> buffer;
  const auto result = decimals ? std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                               std::chars_format::fixed, *decimals)
                               : std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  if (result.ec != std::errc()) throw std::invalid_argument("too many decimals");
  std::string_view digits(buffer.data(), static_cast<std::size_t>(result.ptr - buffer.data()));
  if (decimals && digits.find('.') != std::string_view::npos) {
    digits = digits.substr(0, digits.find_last_not_of('0') + 1);
    if (digits.ends_with('.')) digits.remove_suffix(1);
  }
  text += digits;
}

}  // namespace

void normalize_beyond_rounding(Eigen::Quaterniond& rotation) {
  constexpr double ROUNDING = 8.0 * std::numeric_limits<double>::epsilon();  // of |q|^2
  if (std::abs(rotation.squaredNorm() - 1.0) > ROUNDING) rotation.normalize();
}

Path parse_tum(std::string_view text, const std::string& name) {
  Path path;
  text = without_byte_order_mark(text);
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const std::vector<std::string_view> words = split(line);
    if (words.empty() || words.front().starts_with('#')) continue;
    const std::string place = fmt::format("line {}", number);
    if (words.size() != COLUMN_COUNT)
      throw InputError(name, place, fmt::format("{} columns instead of {}", words.size(), COLUMN_COUNT),
                       fmt::format("write '{}' in each line, separated by blanks", COLUMNS));
    std::array<double, COLUMN_COUNT> values;
    for (std::size_t i = 0; i < COLUMN_COUNT; ++i) values[i] = parse_number(words[i], name, place);

    TimedPose timed;
    timed.time = values[0];
    timed.pose.translation = {values[1], values[2], values[3]};
    timed.pose.rotation.coeffs() = Eigen::Vector4d(values[4], values[5], values[6], values[7]);
    const Complaint complaint = complaint_about(timed, path.empty() ? nullptr : &path.back());
    if (!complaint.problem.empty()) throw InputError(name, place, complaint.problem, complaint.remedy);
    normalize_beyond_rounding(timed.pose.rotation);
    path.push_back(timed);
  }
  if (path.empty())
    throw InputError(name, "", "holds no pose", fmt::format("give at least one line of '{}'", COLUMNS));
  return path;
}

Path read_tum(std::istream& stream, const std::string& name) {
  std::string text;
  std::array<char, 1 << 16> block;
  while (stream.read(block.data(), block.size()), stream.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
    if (static_cast<std::int64_t>(text.size()) > limit_of(Limit::FILE_BYTES))
      throw InputError(name, "", fmt::format("more than {} bytes of poses", limit_of(Limit::FILE_BYTES)),
                       "give fewer poses, or " + raise_remedy(Limit::FILE_BYTES));
  }
  if (stream.bad()) throw InputError(name, "", "cannot be read to its end", "check the file and its disk");
  return parse_tum(text, name);
}

Path read_tum(const std::filesystem::path& file) {
  return parse_tum(read_input_file(file, {.what = "path"}).bytes, file.string());
}

std::string tum_text(const Path& path, const std::string& comment, std::optional<int> decimals) {
  if (path.empty()) throw std::invalid_argument("a path without poses cannot be written");
  std::string text;
  std::istringstream comment_lines(comment);
  for (std::string line; std::getline(comment_lines, line);) text += "# " + line + "\n";
  text += fmt::format("# {}\n", COLUMNS);
  const TimedPose* previous = nullptr;
  for (const TimedPose& timed : path) {
    const Complaint complaint = complaint_about(timed, previous);
    if (!complaint.problem.empty())
      throw std::invalid_argument("a path cannot be written: " + complaint.problem);
    previous = &timed;
    append_number(text, timed.time, decimals);
    for (const double value : timed.pose.translation) append_number(text += ' ', value, decimals);
    for (const double value : timed.pose.rotation.coeffs()) append_number(text += ' ', value, decimals);
    text += '\n';
  }
  return text;
}

void write_tum(const std::filesystem::path& file, const Path& path, const std::string& comment,
               std::optional<int> decimals) {
  write_file_atomically(file, tum_text(path, comment, decimals));
}

}  // namespace lmdbench
